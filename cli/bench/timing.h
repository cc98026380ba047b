// Times of things that run in turn, so that what else the machine does falls on all of them alike.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace pullfocus::cli::bench {

// The upper one of two in the middle; not of nothing.
double median(std::vector<double> values);

struct Spread {
  double median, least, most;
};
Spread spread(const std::vector<double>& values);  // not of nothing

// Milliseconds of one thing, a value a round.
using Times = std::vector<double>;

// Runs all of `things` once a round, one after the other: one round that warms up and `runs` >= 1 that count. Each
// returns the milliseconds that it took.
std::vector<Times> in_turn(int runs, const std::vector<std::function<double()>>& things);

// Milliseconds of wall time of a call.
double wall_ms(const std::function<void()>& call);

// Round by round.
Spread ratio(const Times& of, const Times& to);

// "12.9 (12.7-13.5)", `places` digits after the point; the median alone if there is one value.
std::string text(const Spread& spread, int places);

// "2.41": three significant digits, but no exponent.
std::string text(double value);

// Median of nanoseconds a pixel.
double ns_a_pixel(const Times& times, std::size_t pixels);

}  // namespace pullfocus::cli::bench
