#include "stats_file.h"

#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "image/error.h"

namespace pullfocus::cli {

struct StatsFile::Output {
  std::string path;
  std::ofstream file;
  std::ostream& stream() { return path == "-" ? std::cout : file; }
};

StatsFile::StatsFile(const std::string& path) {
  if (path.empty()) return;
  output_ = std::make_unique<Output>();
  output_->path = path;
  if (path != "-") output_->file.open(path);
  if (!output_->stream()) {
    throw Error(ErrorCode::unwritable, "--stats " + path + ": cannot be written: name a file in an existing folder");
  }
}

StatsFile::~StatsFile() = default;

void StatsFile::write(const FrameRecord& r) {
  if (!output_) return;
  const auto ms = [](double value) { return std::round(value * 1000) / 1000; };
  const Stats& s = r.stats;
  nlohmann::ordered_json line;
  line["frame"] = r.frame;
  line["width"] = r.window.width();
  line["height"] = r.window.height();
  line["mode"] = name(s.mode);
  line["changed"] = s.changed;
  line["updated"] = s.updated;
  line["left_over"] = s.left_over;
  line["edges"] = s.edges;
  line["resolved"] = s.resolved;
  line["slices"] = s.slices;
  line["repaired"] = {{"colour", s.repaired_colour}, {"depth", s.repaired_depth}, {"clamped", s.clamped_radiance},
                      {"outside", r.outside},        {"coc", s.clamped_coc},      {"mixed", r.mixed}};
  line["ms"] = {{"read", ms(r.read_ms)},       {"detect", ms(s.detect_ms)}, {"scatter", ms(s.scatter_ms)},
                {"resolve", ms(s.resolve_ms)}, {"filter", ms(s.filter_ms)}, {"overshoot", ms(s.overshoot_ms)},
                {"write", ms(r.write_ms)}};
  output_->stream() << line.dump() << std::endl;
  if (!output_->stream())
    throw Error(ErrorCode::unwritable, "--stats " + output_->path + ": cannot be written: is the disk full?");
}

}  // namespace pullfocus::cli
