// What `pullfocus compare` found out, before it becomes a table, JSON, CSV or a page.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "filter/stats.h"
#include "image/window.h"
#include "metrics/metrics.h"

namespace pullfocus::cli {

// The three errors that are never mixed (--given: `linear` is the error against the reference).
enum class Against { linear, truth, quantisation };
inline constexpr std::array kAgainst{Against::linear, Against::truth, Against::quantisation};
const char* name(Against against) noexcept;

using ErrorsAgainst = std::array<std::optional<PictureErrors>, 3>;  // by Against; unset: not measured

struct FrameResult {
  int frame = 0;
  Stats stats;  // all zero with --given
  ErrorsAgainst errors;
};

// One measure of the table, everywhere in the same order and under the same name.
struct Measure {
  const char* name;   // in options and files
  const char* title;  // in tables
  bool higher_is_better;
  double (*of_frame)(const PictureErrors&, double peak);
  // Over frames: the mean of squares, then its root or decibels; the mean; the largest.
  double (*of_frames)(const std::vector<PictureErrors>&, double peak);
};
const std::vector<Measure>& measures();

struct Picture64 {
  std::string caption, base64;  // PNG; empty base64: there is nothing to see
  int width = 0, height = 0;
};

// One filter, or with --given the sequence itself.
struct Row {
  std::string kernel, visibility, coc_step, method, budget, order;  // empty: does not matter to this method
  std::string label;                                                // what tells it from the other rows of its shot
  std::size_t linear = 0;                                           // row of its linear filter
  std::vector<FrameResult> frames;
  std::vector<Picture64> pictures;

  double first_ms() const { return frames.front().stats.filter_ms; }
  std::vector<PictureErrors> errors(Against against) const;
};

struct ShotResult {
  std::string input, truth, reference;  // patterns; empty: none
  std::string camera;                   // of the first frame
  Window window;                        // the picture
  double peak = 1;
  int threads = 0;
  int measure_every = 1;  // errors on every k-th frame, from the first; times and counts on all
  bool given = false;
  std::vector<Row> rows;
  std::vector<Picture64> pictures;  // input, truth
  std::optional<int> picture_frame;

  bool measured(Against against) const;
};

// Medians over the frames after the first; unset if there are none.
std::optional<double> median_ms(const Row& row);
std::optional<double> median_speed_up(const ShotResult& shot,
                                      const Row& row);  // of linear's over this one's time, frame by frame
std::optional<double> updated_share(const ShotResult& shot, const Row& row);  // mean, of the picture's pixels

// Sets every row's label.
void set_labels(ShotResult& shot);

}  // namespace pullfocus::cli
