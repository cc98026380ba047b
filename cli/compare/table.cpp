#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/report.h"
#include "exr/range.h"

namespace pullfocus::cli {

std::string shown(const Measure& measure, double value) {
  if (!std::isfinite(value)) return fmt::format("{}", value);
  const std::string name = measure.name;
  if (name == "psnr") return fmt::format("{:.2f}", value);
  if (name == "ssim") return fmt::format("{:.5f}", value);
  return value == 0 ? "0" : fmt::format("{:.3e}", value);
}

std::string shown_ms(double ms) { return fmt::format("{:.{}f}", ms, ms < 10 ? 2 : ms < 100 ? 1 : 0); }

std::string heading(const ShotResult& shot, Against against) {
  if (shot.given) return "against the reference";
  if (against == Against::linear) return "against linear (same kernel, visibility and CoC step)";
  if (against == Against::truth) return "against the truth";
  return "of quantisation: linear against linear with CoC steps of 1/8 pixel";
}

std::vector<std::string> time_texts(const ShotResult& shot, const Row& row) {
  const auto ms = median_ms(row), speed_up = median_speed_up(shot, row), share = updated_share(shot, row);
  return {shown_ms(row.first_ms()), ms ? shown_ms(*ms) : "-", speed_up ? fmt::format("{:.2f}", *speed_up) : "-",
          share ? fmt::format("{:.2f}", 100 * *share) : "-"};
}

std::string measured_frames_text(const ShotResult& shot) {
  if (shot.measure_every == 1) return "";
  std::vector<int> frames;
  for (std::size_t i = 0; i < shot.rows.front().frames.size(); i += static_cast<std::size_t>(shot.measure_every)) {
    frames.push_back(shot.rows.front().frames[i].frame);
  }
  return fmt::format("errors are of one frame in {}: {}", shot.measure_every, exr::format_frames(frames));
}

std::string frames_of(const ShotResult& shot) {
  std::vector<int> frames;
  for (const FrameResult& frame : shot.rows.front().frames) frames.push_back(frame.frame);
  return exr::format_frames(frames);
}

namespace {

using Line = std::vector<std::string>;

// First column to the left, numbers to the right.
std::string aligned(const std::vector<Line>& lines) {
  std::vector<std::size_t> widths;
  for (const Line& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const Line& line : lines) {
    text += fmt::format("  {:<{}}", line[0], widths[0]);
    for (std::size_t i = 1; i < line.size(); ++i) text += fmt::format("  {:>{}}", line[i], widths[i]);
    text += '\n';
  }
  return text;
}

std::string times_table(const ShotResult& shot) {
  std::vector<Line> lines{{""}};
  lines.front().insert(lines.front().end(), kTimeTitles.begin(), kTimeTitles.end());
  for (const Row& row : shot.rows) {
    lines.push_back({row.label});
    for (const std::string& text : time_texts(shot, row)) lines.back().push_back(text);
  }
  return aligned(lines);
}

std::string errors_table(const ShotResult& shot, Against against) {
  std::vector<Line> lines{{""}};
  for (const Measure& m : measures()) lines.front().push_back(m.title);
  for (const Row& row : shot.rows) {
    const auto errors = row.errors(against);
    if (errors.empty()) continue;
    lines.push_back({row.label});
    for (const Measure& m : measures()) lines.back().push_back(shown(m, m.of_frames(errors, shot.peak)));
  }
  return fmt::format("error {}\n{}", heading(shot, against), aligned(lines));
}

}  // namespace

std::string table(const ShotResult& shot) {
  std::string text =
      fmt::format("{}: frames {}, {}x{}\n", shot.input, frames_of(shot), shot.window.width(), shot.window.height());
  if (!shot.camera.empty()) text += fmt::format("camera of the first frame: {}\n", shot.camera);
  const std::string measured = measured_frames_text(shot);
  if (!measured.empty()) text += measured + '\n';
  if (!shot.given) text += times_table(shot);
  for (const Against against : kAgainst) {
    if (shot.measured(against)) text += errors_table(shot, against);
  }
  return text;
}

}  // namespace pullfocus::cli
