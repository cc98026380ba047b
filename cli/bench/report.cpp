#include "bench/report.h"

#include <fmt/format.h>

#include "command.h"

namespace pullfocus::cli::bench {

void Report::paragraph(const std::string& text) { line(text + "\n"); }

void Report::columns(const std::vector<std::string>& names) {
  std::string rule = "|---|";
  for (std::size_t i = 1; i < names.size(); ++i) rule += "---:|";
  line(fmt::format("| {} |\n{}", fmt::join(names, " | "), rule));
}

void Report::row(const std::vector<std::string>& cells) {
  line(fmt::format("| {} |", fmt::join(cells, " | ")));
  if (interrupted()) throw Interrupted{};
}

void Report::end() { line(""); }

void Report::line(const std::string& text) {
  std::fprintf(out_, "%s\n", text.c_str());
  std::fflush(out_);
}

}  // namespace pullfocus::cli::bench
