#include "compare/results.h"

#include <algorithm>
#include <cmath>

namespace pullfocus::cli {

const char* name(Against against) noexcept {
  return against == Against::linear ? "linear" : against == Against::truth ? "truth" : "quantisation";
}

namespace {

using Frames = std::vector<PictureErrors>;

template <typename Value>
double mean_of(const Frames& frames, Value value) {
  double sum = 0;
  for (const PictureErrors& e : frames) sum += value(e);
  return sum / static_cast<double>(frames.size());
}

Differences mean_squares(const Frames& frames) {
  Differences mean;
  mean.mse = mean_of(frames, [](const PictureErrors& e) { return e.differences.mse; });
  mean.shown_mse = mean_of(frames, [](const PictureErrors& e) { return e.differences.shown_mse; });
  return mean;
}

double largest(const Frames& frames) {
  double value = 0;
  for (const PictureErrors& e : frames) {
    if (std::isnan(e.differences.largest)) return e.differences.largest;
    value = std::max(value, e.differences.largest);
  }
  return value;
}

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace

const std::vector<Measure>& measures() {
  static const std::vector<Measure> all{
      {"psnr", "PSNR", true, [](const PictureErrors& e, double peak) { return e.differences.psnr(peak); },
       [](const Frames& f, double peak) { return mean_squares(f).psnr(peak); }},
      {"rmse", "RMSE", false, [](const PictureErrors& e, double) { return e.differences.rmse(); },
       [](const Frames& f, double) { return mean_squares(f).rmse(); }},
      {"relmse", "relMSE", false, [](const PictureErrors& e, double) { return e.differences.relative_mse; },
       [](const Frames& f, double) { return mean_of(f, [](const auto& e) { return e.differences.relative_mse; }); }},
      {"largest", "largest", false, [](const PictureErrors& e, double) { return e.differences.largest; },
       [](const Frames& f, double) { return largest(f); }},
      {"ssim", "SSIM", true, [](const PictureErrors& e, double) { return e.ssim; },
       [](const Frames& f, double) { return mean_of(f, [](const auto& e) { return e.ssim; }); }},
      {"flip", "FLIP", false, [](const PictureErrors& e, double) { return e.flip; },
       [](const Frames& f, double) { return mean_of(f, [](const auto& e) { return e.flip; }); }}};
  return all;
}

std::vector<PictureErrors> Row::errors(Against against) const {
  std::vector<PictureErrors> found;
  for (const FrameResult& frame : frames) {
    const auto& errors = frame.errors[static_cast<std::size_t>(against)];
    if (errors) found.push_back(*errors);
  }
  return found;
}

bool ShotResult::measured(Against against) const {
  return std::ranges::any_of(rows, [&](const Row& row) { return !row.errors(against).empty(); });
}

std::optional<double> median_ms(const Row& row) {
  std::vector<double> times;
  for (std::size_t i = 1; i < row.frames.size(); ++i) times.push_back(row.frames[i].stats.filter_ms);
  return median(times);
}

std::optional<double> median_speed_up(const ShotResult& shot, const Row& row) {
  std::vector<double> ratios;
  const auto& linear = shot.rows[row.linear].frames;
  for (std::size_t i = 1; i < row.frames.size(); ++i) {
    ratios.push_back(linear[i].stats.filter_ms / row.frames[i].stats.filter_ms);
  }
  return median(ratios);
}

std::optional<double> updated_share(const ShotResult& shot, const Row& row) {
  if (row.frames.size() < 2) return std::nullopt;
  double sum = 0;
  for (std::size_t i = 1; i < row.frames.size(); ++i) sum += static_cast<double>(row.frames[i].stats.updated);
  return sum / static_cast<double>(row.frames.size() - 1) / static_cast<double>(shot.window.pixels());
}

void set_labels(ShotResult& shot) {
  const auto differs = [&](std::string Row::*part) {
    return std::ranges::any_of(shot.rows, [&](const Row& row) {
      return !(row.*part).empty() && !(shot.rows.front().*part).empty() && row.*part != shot.rows.front().*part;
    });
  };
  std::vector<std::string> orders;
  for (const Row& row : shot.rows) {
    if (!row.order.empty() && std::ranges::find(orders, row.order) == orders.end()) orders.push_back(row.order);
  }
  for (Row& row : shot.rows) {
    row.label = row.method;
    const auto add = [&](const std::string& text) {
      if (!text.empty()) row.label += " " + text;
    };
    add(row.budget);
    if (orders.size() > 1) add(row.order);
    if (differs(&Row::kernel)) add(row.kernel);
    if (differs(&Row::visibility)) add(row.visibility);
    if (differs(&Row::coc_step)) add("step " + row.coc_step);
  }
}

}  // namespace pullfocus::cli
