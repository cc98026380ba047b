#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/report.h"
#include "exr/range.h"
#include "metrics/flip.h"
#include "version.h"

namespace pullfocus::cli {

namespace {

using nlohmann::ordered_json;

ordered_json number(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr); }

template <typename Value>
ordered_json number(const std::optional<Value>& value) {
  return value ? number(static_cast<double>(*value)) : ordered_json(nullptr);
}

// Names with an empty text stand for what does not matter to a method.
ordered_json text_or_null(const std::string& text) { return text.empty() ? ordered_json(nullptr) : ordered_json(text); }

ordered_json frame_json(const FrameResult& frame, const ShotResult& shot) {
  ordered_json out{{"frame", frame.frame}};
  if (!shot.given) {
    out["mode"] = name(frame.stats.mode);
    out["changed"] = frame.stats.changed;
    out["updated"] = frame.stats.updated;
    out["left_over"] = frame.stats.left_over;
    out["ms"] = number(frame.stats.filter_ms);
  }
  for (const Against against : kAgainst) {
    const auto& errors = frame.errors[static_cast<std::size_t>(against)];
    if (!errors) continue;
    for (const Measure& m : measures()) {
      out["errors"][shot.given ? "reference" : name(against)][m.name] = number(m.of_frame(*errors, shot.peak));
    }
  }
  return out;
}

ordered_json row_json(const Row& row, const ShotResult& shot) {
  ordered_json out{{"label", row.label}, {"method", row.method}};
  if (!shot.given) {
    out["kernel"] = row.kernel;
    out["visibility"] = row.visibility;
    out["coc_step"] = ordered_json::parse(row.coc_step);
    out["budget"] = text_or_null(row.budget);
    out["order"] = text_or_null(row.order);
    out["first_ms"] = number(row.first_ms());
    out["median_ms"] = number(median_ms(row));
    out["speed_up"] = number(median_speed_up(shot, row));
    out["updated_share"] = number(updated_share(shot, row));
  }
  for (const Against against : kAgainst) {
    const auto errors = row.errors(against);
    if (errors.empty()) continue;
    for (const Measure& m : measures()) {
      out["errors"][shot.given ? "reference" : name(against)][m.name] = number(m.of_frames(errors, shot.peak));
    }
  }
  for (const FrameResult& frame : row.frames) out["frames"].push_back(frame_json(frame, shot));
  return out;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

}  // namespace

std::string json_report(const std::vector<ShotResult>& shots) {
  ordered_json out{{"pullfocus", kVersion}, {"flip_pixels_per_degree", kFlipPixelsPerDegree}};
  for (const ShotResult& shot : shots) {
    ordered_json one{{"input", shot.input}};
    if (!shot.reference.empty()) one["reference"] = shot.reference;
    if (!shot.given) one["truth"] = text_or_null(shot.truth);
    if (!shot.camera.empty()) one["camera"] = shot.camera;
    if (!shot.given) one["threads"] = shot.threads;
    if (!shot.given) one["measure_every"] = shot.measure_every;
    one["width"] = shot.window.width();
    one["height"] = shot.window.height();
    one["psnr_peak"] = shot.peak;
    for (const Row& row : shot.rows) one["filters"].push_back(row_json(row, shot));
    out["shots"].push_back(one);
  }
  return out.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string csv_report(const std::vector<ShotResult>& shots) {
  std::string text =
      "input,method,kernel,visibility,coc_step,budget,order,frames,first_ms,median_ms,speed_up,updated_share";
  for (const Against against : kAgainst) {
    const bool reference = !shots.empty() && shots.front().given && against == Against::linear;
    for (const Measure& m : measures()) text += fmt::format(",{}_{}", reference ? "reference" : name(against), m.name);
  }
  text += "\r\n";
  for (const ShotResult& shot : shots) {
    for (const Row& row : shot.rows) {
      for (const std::string& field :
           {shot.input, row.method, row.kernel, row.visibility, row.coc_step, row.budget, row.order}) {
        text += csv_field(field) + ",";
      }
      text += fmt::format("{}", row.frames.size());
      const bool timed = !shot.given;
      for (const std::optional<double>& value :
           {timed ? std::optional(row.first_ms()) : std::nullopt, timed ? median_ms(row) : std::nullopt,
            timed ? median_speed_up(shot, row) : std::nullopt, timed ? updated_share(shot, row) : std::nullopt}) {
        text += ',';
        text += csv_number(value);
      }
      for (const Against against : kAgainst) {
        const auto errors = row.errors(against);
        for (const Measure& m : measures()) {
          text += ',';
          if (!errors.empty()) text += csv_number(m.of_frames(errors, shot.peak));
        }
      }
      text += "\r\n";
    }
  }
  return text;
}

}  // namespace pullfocus::cli
