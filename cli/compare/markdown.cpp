#include <fmt/format.h>

#include "compare/report.h"

namespace pullfocus::cli {

namespace {

// Of these measures there is room for; JSON and CSV have all.
constexpr std::array kShown{"psnr", "rmse", "ssim", "flip"};

// What would end a cell or begin markup.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '*' || c == '_' || c == '`' || c == '<' || c == '\\' || c == '#') out += '\\';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out;
}

bool is_shown(const Measure& m) {
  for (const std::string name : kShown) {
    if (name == m.name) return true;
  }
  return false;
}

std::string error_cells(const ShotResult& shot, const Row& row, Against against) {
  const auto errors = row.errors(against);
  std::string text;
  for (const Measure& m : measures()) {
    if (is_shown(m)) text += errors.empty() ? " - |" : fmt::format(" {} |", shown(m, m.of_frames(errors, shot.peak)));
  }
  return text;
}

std::string section(const ShotResult& shot) {
  std::string text = fmt::format("### {}\n\nFrames {}, {}x{}", plain(shot.input), frames_of(shot), shot.window.width(),
                                 shot.window.height());
  const std::string measured = measured_frames_text(shot);
  if (!measured.empty()) text += "; " + measured;
  text += ".\n\n| filter |";
  std::string rule = "|---|";
  const auto column = [&](const std::string& title) {
    text += fmt::format(" {} |", title);
    rule += "---:|";
  };
  if (!shot.given) {
    for (const char* title : kTimeTitles) column(title);
  }
  for (const Against against : kAgainst) {
    if (!shot.measured(against)) continue;
    for (const Measure& m : measures()) {
      if (is_shown(m)) column(fmt::format("{} {}", shot.given ? "reference" : name(against), m.title));
    }
  }
  text += "\n" + rule + "\n";
  for (const Row& row : shot.rows) {
    text += fmt::format("| {} |", plain(row.label));
    if (!shot.given) {
      for (const std::string& time : time_texts(shot, row)) text += fmt::format(" {} |", time);
    }
    for (const Against against : kAgainst) {
      if (shot.measured(against)) text += error_cells(shot, row, against);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string markdown_report(const std::vector<ShotResult>& shots) {
  std::string text;
  for (const ShotResult& shot : shots) {
    if (!text.empty()) text += '\n';
    text += section(shot);
  }
  return text;
}

}  // namespace pullfocus::cli
