// Plots as SVG, for pages: colours come from the page's styles (classes c0 .. c7, axis, grid, front).
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pullfocus::cli {

struct Axis {
  std::string title;
  bool logarithmic = false;  // zeros then get a place of their own at the low end
  bool integers = false;     // no ticks between whole numbers
};

struct Series {
  std::string label;                              // shown when the pointer rests on it
  std::size_t style = 0;                          // colour and marker
  std::vector<std::pair<double, double>> points;  // x, y; what is not finite is left out
  bool line = false;
};

struct Plot {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  std::vector<std::pair<double, double>> front;  // joined by a thin line, beneath the series
};

std::string svg(const Plot& plot);

// The Pareto front: points that no other one beats in both, by rising x; of x less is better.
std::vector<std::pair<double, double>> pareto(std::vector<std::pair<double, double>> points, bool higher_y_is_better);

// The marker of a style alone, for legends.
std::string marker_svg(std::size_t style);

// Positions of labelled ticks from `low` to `high`, about five: 1, 2, 5 times powers of ten; on logarithmic axes powers
// of ten, with 2 and 5 between them if there are few. Not closer than `least`.
std::vector<double> ticks(double low, double high, bool logarithmic, double least = 0);

// &, <, >, quotes and control characters made safe for XML text and attributes.
std::string escaped(const std::string& text);

}  // namespace pullfocus::cli
