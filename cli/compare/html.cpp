#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "compare/plot.h"
#include "compare/report.h"
#include "metrics/flip.h"
#include "version.h"

namespace pullfocus::cli {

namespace {

constexpr char kStyle[] = R"(
:root { color-scheme: light dark; --ink: #1c1e21; --soft: #5c636b; --line: #d9dde2; --page: #ffffff; --band: #f5f6f8;
  --c0: #0067a9; --c1: #cc5200; --c2: #00835f; --c3: #b3488c; --c4: #a97900; --c5: #2e9bd6; --c6: #6a4fb3; --c7: #6b6b6b; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e6e9; --soft: #9aa2ab; --line: #363b42; --page: #16181b;
  --band: #1e2125; --c0: #5ab0ea; --c1: #ff8f4d; --c2: #3cc79c; --c3: #e58cc3; --c4: #e0b040; --c5: #8fd0f5;
  --c6: #ab95ee; --c7: #b0b0b0; } }
body { margin: 2rem auto; max-width: 70rem; padding: 0 1.2rem; background: var(--page); color: var(--ink);
  font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size: 1.5rem; margin: 0 0 .2rem; } h2 { font-size: 1.2rem; margin: 2.4rem 0 .2rem; overflow-wrap: anywhere; }
h3 { font-size: 1rem; margin: 1.6rem 0 .4rem; } p { margin: .2rem 0 .8rem; } .soft { color: var(--soft); font-size: .9rem; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-size: .9rem; white-space: nowrap; }
th, td { padding: .22rem .7rem; text-align: right; font-variant-numeric: tabular-nums; border-bottom: 1px solid var(--line); }
th { font-weight: 600; color: var(--soft); vertical-align: bottom; } th:first-child, td:first-child { text-align: left; padding-left: .3rem; }
tr.group th { border-bottom: 0; padding-top: .5rem; text-align: center; } tbody tr:hover { background: var(--band); }
td.first, th.first { border-left: 1px solid var(--line); }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(26rem, 1fr)); gap: 1rem; }
.plot { width: 100%; height: auto; } .key { width: .9em; height: .9em; vertical-align: -.08em; margin-right: .5em; }
svg text { fill: var(--soft); font: 12px system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
svg .title { fill: var(--ink); font-size: 14px; font-weight: 600; }
svg .grid { stroke: var(--line); } svg .axis { fill: none; stroke: var(--soft); }
svg .front { fill: none; stroke: var(--soft); stroke-width: 1.2; stroke-dasharray: 5 4; } svg .l { fill: none; stroke-width: 1.6; }
.m { stroke: var(--page); stroke-width: .8; }
.m.c0 { fill: var(--c0) } .m.c1 { fill: var(--c1) } .m.c2 { fill: var(--c2) } .m.c3 { fill: var(--c3) }
.m.c4 { fill: var(--c4) } .m.c5 { fill: var(--c5) } .m.c6 { fill: var(--c6) } .m.c7 { fill: var(--c7) }
.l.c0 { stroke: var(--c0) } .l.c1 { stroke: var(--c1) } .l.c2 { stroke: var(--c2) } .l.c3 { stroke: var(--c3) }
.l.c4 { stroke: var(--c4) } .l.c5 { stroke: var(--c5) } .l.c6 { stroke: var(--c6) } .l.c7 { stroke: var(--c7) }
.pictures { display: flex; flex-wrap: wrap; gap: .8rem; margin: .3rem 0 1rem; }
figure { margin: 0; max-width: 100%; } figure img { display: block; max-width: 100%; height: auto; background: #000; }
figcaption { color: var(--soft); font-size: .82rem; } .none { color: var(--soft); align-self: center; font-size: .85rem; }
.scale { display: inline-block; width: 9rem; height: .7rem; vertical-align: -.05rem; margin: 0 .4rem;
  background: linear-gradient(to right, #000005, #261259, #661c80, #b3337a, #ed5e5e, #fca873, #fcfcbf); }
)";

std::string cell(const std::string& text, bool first = false) {
  return fmt::format("<td{}>{}</td>", first ? " class=\"first\"" : "", text);
}

std::string table_head(const ShotResult& shot) {
  std::string groups = "<tr class=\"group\"><th></th>", names = "<tr><th>filter</th>";
  if (!shot.given) {
    groups += "<th class=\"first\" colspan=\"4\">a frame</th>";
    names += "<th class=\"first\">first ms</th><th>median ms</th><th>speed-up</th><th>updated&#160;%</th>";
  }
  for (const Against against : kAgainst) {
    if (!shot.measured(against)) continue;
    const std::string title = shot.given                   ? "error against the reference"
                              : against == Against::linear ? "error against linear"
                              : against == Against::truth  ? "error against the truth"
                                                           : "error of quantisation";
    groups += fmt::format("<th class=\"first\" colspan=\"{}\">{}</th>", measures().size(), title);
    for (const Measure& m : measures()) {
      names += fmt::format("<th{}>{}</th>", &m == &measures().front() ? " class=\"first\"" : "", m.title);
    }
  }
  return groups + "</tr>\n" + names + "</tr>\n";
}

std::string table_row(const ShotResult& shot, std::size_t i) {
  const Row& row = shot.rows[i];
  std::string text = fmt::format("<tr><td>{}{}</td>", marker_svg(i), escaped(row.label));
  if (!shot.given) {
    const auto ms = median_ms(row), speed_up = median_speed_up(shot, row), share = updated_share(shot, row);
    text += cell(shown_ms(row.first_ms()), true) + cell(ms ? shown_ms(*ms) : "") +
            cell(speed_up ? fmt::format("{:.2f}", *speed_up) : "") +
            cell(share ? fmt::format("{:.2f}", 100 * *share) : "");
  }
  for (const Against against : kAgainst) {
    if (!shot.measured(against)) continue;
    const auto errors = row.errors(against);
    for (const Measure& m : measures()) {
      text += cell(errors.empty() ? "" : shown(m, m.of_frames(errors, shot.peak)), &m == &measures().front());
    }
  }
  return text + "</tr>\n";
}

const Measure& measure(const std::string& name) { return *std::ranges::find(measures(), name, &Measure::name); }

// Points that nothing beats in both, by rising time.
std::vector<std::pair<double, double>> pareto(std::vector<std::pair<double, double>> points, bool higher_is_better) {
  std::ranges::sort(points, [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : higher_is_better ? a.second > b.second : a.second < b.second;
  });
  std::vector<std::pair<double, double>> front;
  for (const auto& p : points) {
    if (front.empty() || (higher_is_better ? p.second > front.back().second : p.second < front.back().second))
      front.push_back(p);
  }
  return front;
}

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
  Plot plot{title, {"frame"}, y, {}, {}};
  for (std::size_t i = 0; i < shot.rows.size(); ++i) {
    Series series{shot.rows[i].label, i, {}, true};
    for (const FrameResult& frame : shot.rows[i].frames) {
      if (const auto v = value(shot.rows[i], frame)) series.points.emplace_back(frame.frame, *v);
    }
    if (!series.points.empty()) plot.series.push_back(series);
  }
  return plot.series.empty() ? "" : svg(plot);
}

std::string error_over_frames(const ShotResult& shot, Against against, const std::string& title) {
  const Measure& m = measure("rmse");
  return over_frames(shot, title, {m.title, true},
                     [&](const Row& row, const FrameResult& frame) -> std::optional<double> {
                       if (against == Against::linear && !shot.given && &row == &shot.rows[row.linear])
                         return std::nullopt;
                       const auto& errors = frame.errors[static_cast<std::size_t>(against)];
                       if (!errors) return std::nullopt;
                       return m.of_frame(*errors, shot.peak);
                     });
}

std::string plots(const ShotResult& shot) {
  const bool several = shot.rows.front().frames.size() > 1;
  std::string text;
  if (!shot.given && several) {
    text += time_against(shot, Against::linear, measure("rmse"), "Time against error (linear)");
    text += time_against(shot, Against::truth, measure("psnr"), "Time against PSNR to the truth");
  }
  if (several) {
    text +=
        error_over_frames(shot, Against::linear, shot.given ? "Error over frames" : "Error against linear over frames");
    if (shot.measured(Against::truth))
      text += error_over_frames(shot, Against::truth, "Error against the truth over frames");
  }
  if (!shot.given && several) {
    text +=
        over_frames(shot, "Updated pixels over frames", {"% of the picture", false},
                    [&](const Row& row, const FrameResult& frame) -> std::optional<double> {
                      if (&row == &shot.rows[row.linear] || frame.frame == row.frames.front().frame)
                        return std::nullopt;
                      return 100 * static_cast<double>(frame.stats.updated) / static_cast<double>(shot.window.pixels());
                    });
  }
  if (text.empty()) return "";
  return "<div class=\"plots\">\n" + text + "</div>\n" +
         (shot.given ? ""
                     : "<p class=\"soft\">Markers as in the table. Dashed: the Pareto front, filters that no other one "
                       "beats in "
                       "both. A 0 on a logarithmic axis is exactly no error.</p>\n");
}

std::string figures(const std::vector<Picture64>& pictures, const std::string& of) {
  std::string text = "<div class=\"pictures\">\n";
  for (const Picture64& p : pictures) {
    if (p.base64.empty()) {
      text += fmt::format("<p class=\"none\">{}: exactly 0</p>\n", escaped(p.caption));
    } else {
      text += fmt::format(
          "<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"/><figcaption>{}</figcaption></figure>\n",
          escaped(of + ": " + p.caption), p.base64, escaped(p.caption));
    }
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
  std::string text = fmt::format("<h2>{}</h2>\n<p class=\"soft\">frames {}, {}&#215;{}{}{}{}</p>\n",
                                 escaped(shot.input), frames_of(shot), shot.window.width(), shot.window.height(),
                                 shot.camera.empty() ? "" : "; " + escaped(shot.camera),
                                 shot.truth.empty() ? "" : "; truth " + escaped(shot.truth),
                                 shot.reference.empty() ? "" : "; reference " + escaped(shot.reference));
  text += "<div class=\"wide\"><table>\n<thead>\n" + table_head(shot) + "</thead>\n<tbody>\n";
  for (std::size_t i = 0; i < shot.rows.size(); ++i) text += table_row(shot, i);
  return text + "</tbody>\n</table></div>\n" + plots(shot) + picture_section(shot);
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
