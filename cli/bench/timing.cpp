#include "bench/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "filter/core.h"

namespace pullfocus::cli::bench {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Spread spread(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {median(values), *least, *most};
}

std::vector<Times> in_turn(int runs, const std::vector<std::function<double()>>& things) {
  std::vector<Times> times(things.size());
  for (int run = 0; run <= runs; ++run) {
    for (std::size_t i = 0; i < things.size(); ++i) {
      const double ms = things[i]();
      if (run > 0) times[i].push_back(ms);
    }
  }
  return times;
}

double wall_ms(const std::function<void()>& call) {
  const Stopwatch watch;
  call();
  return watch.ms();
}

Spread ratio(const Times& of, const Times& to) {
  std::vector<double> ratios(of.size());
  for (std::size_t i = 0; i < of.size(); ++i) ratios[i] = of[i] / to[i];
  return spread(ratios);
}

std::string text(const Spread& s, int places) {
  if (s.least == s.most) return fmt::format("{:.{}f}", s.median, places);
  return fmt::format("{:.{}f} ({:.{}f}-{:.{}f})", s.median, places, s.least, places, s.most, places);
}

std::string text(double value) {
  const int whole = value > 0 ? static_cast<int>(std::floor(std::log10(value))) : 0;
  return fmt::format("{:.{}f}", value, std::clamp(2 - whole, 0, 5));
}

double ns_a_pixel(const Times& times, std::size_t pixels) { return median(times) * 1e6 / static_cast<double>(pixels); }

}  // namespace pullfocus::cli::bench
