#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "compare/html_style.h"
#include "compare/plot.h"
#include "compare/report.h"
#include "metrics/flip.h"
#include "version.h"

namespace pullfocus::cli {

namespace {

std::string cell(const std::string& text, bool first = false) {
  return fmt::format("<td{}>{}</td>", first ? " class=\"first\"" : "", text);
}

constexpr const char* kFirst = " class=\"first\"";

std::string error_names() {
  std::string text;
  for (const Measure& m : measures()) {
    text += fmt::format("<th{}>{}</th>", &m == &measures().front() ? kFirst : "", m.title);
  }
  return text;
}

std::string error_cells(const ShotResult& shot, const Row& row, Against against) {
  const auto errors = row.errors(against);
  std::string text;
  for (const Measure& m : measures()) text += cell(shown(m, m.of_frames(errors, shot.peak)), &m == &measures().front());
  return text;
}

std::string time_cells(const ShotResult& shot, const Row& row) {
  std::string text;
  for (const std::string& time : time_texts(shot, row)) text += cell(time, text.empty());
  return text;
}

// One table for each error; times stand beside the first.
std::string error_table(const ShotResult& shot, Against against) {
  const bool timed = !shot.given && against == Against::linear;
  std::string text = "<div class=\"wide\"><table>\n<thead>\n<tr class=\"group\"><th></th>";
  if (timed) text += "<th class=\"first\" colspan=\"4\">a frame</th>";
  text += fmt::format("<th class=\"first\" colspan=\"{}\">error {}</th></tr>\n<tr><th>filter</th>", measures().size(),
                      heading(shot, against));
  if (timed) text += "<th class=\"first\">first ms</th><th>median ms</th><th>speed-up</th><th>updated&#160;%</th>";
  text += error_names() + "</tr>\n</thead>\n<tbody>\n";
  for (std::size_t i = 0; i < shot.rows.size(); ++i) {
    const Row& row = shot.rows[i];
    if (row.errors(against).empty()) continue;
    text += fmt::format("<tr><td>{}{}</td>{}{}</tr>\n", marker_svg(i), escaped(row.label),
                        timed ? time_cells(shot, row) : "", error_cells(shot, row, against));
  }
  return text + "</tbody>\n</table></div>\n";
}

const Measure& measure(const std::string& name) { return *std::ranges::find(measures(), name, &Measure::name); }

std::string time_against(const ShotResult& shot, Against against, const Measure& m, const std::string& title) {
  Plot plot{title, {"median ms a frame"}, {m.title, !m.higher_is_better}, {}, {}};
  std::vector<std::pair<double, double>> all;
  for (std::size_t i = 0; i < shot.rows.size(); ++i) {
    const auto errors = shot.rows[i].errors(against);
    const auto ms = median_ms(shot.rows[i]);
    if (errors.empty() || !ms) continue;
    const double value = m.of_frames(errors, shot.peak);
    plot.series.push_back({fmt::format("{}: {} ms, {} {}", shot.rows[i].label, shown_ms(*ms), m.title, shown(m, value)),
                           i,
                           {{*ms, value}},
                           false});
    if (std::isfinite(value)) all.emplace_back(*ms, value);
  }
  if (all.empty()) return "";
  plot.front = pareto(all, m.higher_is_better);
  return svg(plot);
}

std::string over_frames(const ShotResult& shot, const std::string& title, const Axis& y,
                        const std::function<std::optional<double>(const Row&, const FrameResult&)>& value) {
  Plot plot{title, {"frame", false, true}, y, {}, {}};
  for (std::size_t i = 0; i < shot.rows.size(); ++i) {
    Series series{shot.rows[i].label, i, {}, true};
    for (const FrameResult& frame : shot.rows[i].frames) {
      if (const auto v = value(shot.rows[i], frame)) series.points.emplace_back(frame.frame, *v);
    }
    if (!series.points.empty()) plot.series.push_back(series);
  }
  return plot.series.empty() ? "" : svg(plot);
}

std::string error_over_frames(const ShotResult& shot, Against against, const Measure& m, const std::string& title) {
  return over_frames(shot, title, {m.title, !m.higher_is_better},
                     [&](const Row& row, const FrameResult& frame) -> std::optional<double> {
                       const auto& errors = frame.errors[static_cast<std::size_t>(against)];
                       const bool self = against == Against::linear && !shot.given && &row == &shot.rows[row.linear];
                       if (!errors || self) return std::nullopt;
                       return m.of_frame(*errors, shot.peak);
                     });
}

std::string updated_over_frames(const ShotResult& shot) {
  return over_frames(shot, "Updated pixels over frames", {"% of the picture"},
                     [&](const Row& row, const FrameResult& frame) -> std::optional<double> {
                       const bool first = frame.frame == row.frames.front().frame;
                       if (&row == &shot.rows[row.linear] || first) return std::nullopt;
                       const auto pixels = static_cast<double>(shot.window.pixels());
                       return 100 * static_cast<double>(frame.stats.updated) / pixels;
                     });
}

// A single frame has no course.
std::string plots(const ShotResult& shot) {
  if (shot.rows.front().frames.size() < 2) return "";
  std::string text = "<div class=\"plots\">\n";
  if (shot.given) {
    return text + error_over_frames(shot, Against::linear, measure("rmse"), "Error over frames") + "</div>\n";
  }
  text += time_against(shot, Against::linear, measure("rmse"), "Time against error (linear)");
  text += time_against(shot, Against::truth, measure("psnr"), "Time against PSNR to the truth");
  text += error_over_frames(shot, Against::linear, measure("rmse"), "Error against linear over frames");
  text += error_over_frames(shot, Against::truth, measure("psnr"), "PSNR to the truth over frames");
  text += updated_over_frames(shot) + "</div>\n";
  return text +
         "<p class=\"soft\">Markers as in the table. Dashed: the Pareto front, filters that no other one beats in "
         "both. A 0 on a logarithmic axis is exactly no error.</p>\n";
}

std::string figures(const std::vector<Picture64>& pictures, const std::string& of) {
  std::string text = "<div class=\"pictures\">\n";
  for (const Picture64& p : pictures) {
    text += "<figure>";
    if (p.base64.empty()) {
      text += fmt::format("<div class=\"none\" style=\"width:{}px;height:{}px\">exactly 0</div>", p.width, p.height);
    } else {
      text += fmt::format("<img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\"/>", p.width,
                          p.height, escaped(of + ": " + p.caption), p.base64);
    }
    text += fmt::format("<figcaption>{}</figcaption></figure>\n", escaped(p.caption));
  }
  return text + "</div>\n";
}

std::string picture_section(const ShotResult& shot) {
  if (!shot.picture_frame) return "";
  std::string text =
      fmt::format("<h3>Frame {}</h3>\n<p class=\"soft\">Error maps are FLIP: 0 <span class=\"scale\"></span> 1</p>\n",
                  *shot.picture_frame);
  text += figures(shot.pictures, shot.input);
  for (std::size_t i = 0; i < shot.rows.size(); ++i) {
    text += fmt::format("<p>{}{}</p>\n", marker_svg(i), escaped(shot.rows[i].label)) +
            figures(shot.rows[i].pictures, shot.rows[i].label);
  }
  return text;
}

std::string section(const ShotResult& shot) {
  const std::string measured = measured_frames_text(shot);
  std::string text = fmt::format("<h2>{}</h2>\n<p class=\"soft\">frames {}, {}&#215;{}{}{}{}{}</p>\n",
                                 escaped(shot.input), frames_of(shot), shot.window.width(), shot.window.height(),
                                 measured.empty() ? "" : fmt::format("; {}", measured),
                                 shot.camera.empty() ? "" : "; " + escaped(shot.camera),
                                 shot.truth.empty() ? "" : "; truth " + escaped(shot.truth),
                                 shot.reference.empty() ? "" : "; reference " + escaped(shot.reference));
  for (const Against against : kAgainst) {
    if (shot.measured(against)) text += error_table(shot, against);
  }
  return text + plots(shot) + picture_section(shot);
}

}  // namespace

std::string html_report(const std::vector<ShotResult>& shots) {
  std::string text =
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<title>pullfocus: speed against error</title>\n<style>" +
      std::string(kStyle) + "</style>\n</head>\n<body>\n<h1>Speed against error</h1>\n";
  text += fmt::format("<p class=\"soft\">pullfocus {}{}</p>\n", kVersion,
                      shots.front().given ? std::string() : fmt::format("; {} threads", shots.front().threads));
  for (const ShotResult& shot : shots) text += section(shot);
  text += fmt::format(
      "<h3>What the numbers are</h3>\n<p class=\"soft\">Times are of the filter alone, from the input in memory to the "
      "result in "
      "memory; median over the frames after the first, all filters taking turns on every frame; speed-up is the median "
      "of "
      "linear's time over this filter's, frame by frame. Errors are over all frames: PSNR (peak {}, both pictures "
      "clamped to "
      "it) and RMSE of the mean square, the mean of relative MSE (eps 0.01), SSIM (display luma) and FLIP ({:.0f} "
      "pixels a "
      "degree), and the largest difference of any sample, alpha included. Errors against linear and of quantisation "
      "are "
      "over everything that is written, errors against the truth over the display window.</p>\n</body>\n</html>\n",
      shots.front().peak, kFlipPixelsPerDegree);
  return text;
}

}  // namespace pullfocus::cli
