// The Markdown that `pullfocus bench` prints: headings, sentences, and tables row by row.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace pullfocus::cli::bench {

// Thrown between two rows once the program was asked to end.
struct Interrupted {};

class Report {
 public:
  // Every line goes to `out` at once.
  explicit Report(std::FILE* out) : out_(out) {}

  // A paragraph, with an empty line after it.
  void paragraph(const std::string& text);

  // The first row of a table; the first column is aligned to the left.
  void columns(const std::vector<std::string>& names);

  // One row, as many cells as there are columns. Throws Interrupted once interrupted() is true.
  void row(const std::vector<std::string>& cells);

  // Ends a table.
  void end();

 private:
  void line(const std::string& text);
  std::FILE* out_;
};

}  // namespace pullfocus::cli::bench
