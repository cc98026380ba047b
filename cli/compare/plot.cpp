#include "compare/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pullfocus::cli {

namespace {

constexpr double kWidth = 520, kHeight = 320, kLeft = 66, kRight = 14, kTop = 34, kBottom = 48;
constexpr std::size_t kColours = 8;

// Data to pixels along one axis. Zeros of a logarithmic axis lie in a lane at its low end.
class Scale {
 public:
  Scale(const Axis& axis, const std::vector<double>& values, double from, double to)
      : logarithmic_(axis.logarithmic), least_(axis.integers ? 1 : 0), from_(from), to_(to) {
    low_ = std::numeric_limits<double>::infinity();
    high_ = -low_;
    for (const double value : values) {
      if (logarithmic_ && value <= 0) {
        zeros_ = true;
        continue;
      }
      low_ = std::min(low_, value);
      high_ = std::max(high_, value);
    }
    if (low_ > high_) low_ = high_ = 1;
    if (logarithmic_) {
      low_ = std::pow(10, std::floor(std::log10(low_) * 2 - 0.1) / 2);
      high_ = std::pow(10, std::ceil(std::log10(high_) * 2 + 0.1) / 2);
    } else {
      const double room = high_ > low_ ? 0.06 * (high_ - low_) : std::max(0.5, 0.1 * std::fabs(high_));
      low_ = low_ >= 0 && low_ - room < 0 ? 0 : low_ - room;
      high_ += room;
    }
    start_ = zeros_ ? from_ + 0.1 * (to_ - from_) : from_;
  }
  double operator()(double value) const {
    if (logarithmic_ && value <= 0) return from_ + 0.03 * (to_ - from_);
    const double part =
        logarithmic_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
    return start_ + part * (to_ - start_);
  }
  std::vector<double> tick_values() const {
    std::vector<double> values = ticks(low_, high_, logarithmic_, least_);
    if (zeros_) values.insert(values.begin(), 0);
    return values;
  }

 private:
  bool logarithmic_, zeros_ = false;
  double least_, from_, to_, start_ = 0, low_, high_;
};

std::string tick_text(double value) {
  const double size = std::fabs(value);
  if (size == 0) return "0";
  if (size >= 1e5 || size < 1e-3) {
    std::string text = fmt::format("{:.0e}", value);
    for (const char* zero : {"e-0", "e+0"}) {  // 1e-05 -> 1e-5
      const std::size_t at = text.find(zero);
      if (at != std::string::npos) text.erase(at + 2, 1);
    }
    return text;
  }
  return fmt::format("{:.6g}", value);
}

// Markers tell styles of the same colour apart: disc, square, triangle, diamond.
std::string marker(double x, double y, std::size_t style, double r) {
  const std::string colour = fmt::format("class=\"m c{}\"", style % kColours);
  switch (style / kColours % 4) {
    case 0:
      return fmt::format("<circle {} cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>", colour, x, y, r);
    case 1:
      return fmt::format("<rect {} x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\"/>", colour, x - r, y - r, 2 * r,
                         2 * r);
    case 2:
      return fmt::format("<path {} d=\"M{:.1f} {:.1f}l{} {}h{}z\"/>", colour, x, y - r * 1.2, r * 1.2, r * 2.1,
                         -r * 2.4);
    default:
      return fmt::format("<path {} d=\"M{:.1f} {:.1f}l{} {}l{} {}l{} {}z\"/>", colour, x, y - r * 1.3, r * 1.3, r * 1.3,
                         -r * 1.3, r * 1.3, -r * 1.3, -r * 1.3);
  }
}

std::string path(const std::vector<std::pair<double, double>>& points, const Scale& x, const Scale& y) {
  std::string text;
  for (const auto& [px, py] : points) text += fmt::format("{}{:.1f} {:.1f}", text.empty() ? "M" : "L", x(px), y(py));
  return text;
}

// Without what is not finite or beyond any measure; with the tiny, which would be lost in a logarithm, as 0.
std::vector<std::pair<double, double>> drawable(std::vector<std::pair<double, double>> points) {
  constexpr double most = 1e30;
  std::erase_if(points, [](const auto& p) { return !(std::fabs(p.first) < most && std::fabs(p.second) < most); });
  for (auto& [x, y] : points) {
    if (std::fabs(x) < 1 / most) x = 0;
    if (std::fabs(y) < 1 / most) y = 0;
  }
  return points;
}

std::string axes(const Plot& plot, const Scale& x, const Scale& y) {
  const double right = kWidth - kRight, bottom = kHeight - kBottom;
  std::string text;
  for (const double value : y.tick_values()) {
    text += fmt::format(
        "<line class=\"grid\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>"
        "<text class=\"tick\" text-anchor=\"end\" x=\"{3}\" y=\"{4:.1f}\">{5}</text>\n",
        kLeft, right, y(value), kLeft - 7, y(value) + 4, tick_text(value));
  }
  for (const double value : x.tick_values()) {
    text += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
        "<text class=\"tick\" text-anchor=\"middle\" x=\"{0:.1f}\" y=\"{3}\">{4}</text>\n",
        x(value), kTop, bottom, bottom + 16, tick_text(value));
  }
  text += fmt::format("<path class=\"axis\" d=\"M{0} {1}V{2}H{3}\"/>\n", kLeft, kTop, bottom, right);
  text += fmt::format("<text class=\"title\" x=\"{}\" y=\"18\">{}</text>\n", kLeft, escaped(plot.title));
  text += fmt::format("<text class=\"name\" text-anchor=\"middle\" x=\"{}\" y=\"{}\">{}</text>\n", (kLeft + right) / 2,
                      kHeight - 10, escaped(plot.x.title));
  text +=
      fmt::format("<text class=\"name\" text-anchor=\"middle\" transform=\"translate(14 {}) rotate(-90)\">{}</text>\n",
                  (kTop + bottom) / 2, escaped(plot.y.title));
  return text;
}

}  // namespace

std::vector<double> ticks(double low, double high, bool logarithmic, double least) {
  std::vector<double> values;
  if (logarithmic) {
    const double decades = std::log10(high / low);
    const double every = std::max(1., std::ceil(decades / 7));
    for (double exponent = std::floor(std::log10(low)); exponent <= std::log10(high) + 1e-9; exponent += every) {
      for (const double digit : {1., 2., 5.}) {
        if (digit != 1 && decades > 2) continue;
        const double value = digit * std::pow(10, exponent);
        if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)) values.push_back(value);
      }
    }
    return values;
  }
  const double rough = std::max(least, (high - low) / 5), power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double digit : {5., 2., 1.}) {
    if (digit * power >= rough) step = digit * power;
  }
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    values.push_back(i == 0 ? 0 : i * step);
  return values;
}

namespace {

// Bytes of the UTF-8 sequence that begins at `at`; 0 if there is no valid one.
std::size_t utf8_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(at);
  const std::size_t length = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  unsigned code = length == 1 ? first : first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if (byte(at + i) >> 6 != 2) return 0;
    code = code << 6 | (byte(at + i) & 0x3f);
  }
  const unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool legal = code >= least[length] && code <= 0x10ffff && !(code >= 0xd800 && code < 0xe000) &&
                     code != 0xfffe && code != 0xffff;
  return legal ? length : 0;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const char c = text[i];
    if (length == 0 || (length == 1 && (static_cast<unsigned char>(c) < 0x20 || c == 0x7f))) {
      out += '?';
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += text.substr(i, length);
    }
    i += std::max<std::size_t>(1, length);
  }
  return out;
}

std::vector<std::pair<double, double>> pareto(std::vector<std::pair<double, double>> points, bool higher_y_is_better) {
  const auto better = [&](double a, double b) { return higher_y_is_better ? a > b : a < b; };
  std::ranges::sort(points, [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : better(a.second, b.second);
  });
  std::vector<std::pair<double, double>> front;
  for (const auto& point : points) {
    if (front.empty() || better(point.second, front.back().second)) front.push_back(point);
  }
  return front;
}

std::string svg(const Plot& plot) {
  std::vector<double> xs, ys;
  std::vector<Series> kept = plot.series;
  for (Series& series : kept) {
    series.points = drawable(series.points);
    for (const auto& [x, y] : series.points) {
      xs.push_back(x);
      ys.push_back(y);
    }
  }
  const Scale x(plot.x, xs, kLeft, kWidth - kRight), y(plot.y, ys, kHeight - kBottom, kTop);
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 {} {}\" "
      "role=\"img\">\n<title>{}</title>\n",
      kWidth, kHeight, escaped(plot.title));
  text += axes(plot, x, y);
  if (plot.front.size() > 1)
    text += fmt::format("<path class=\"front\" d=\"{}\"/>\n", path(drawable(plot.front), x, y));
  for (const Series& series : kept) {
    text += fmt::format("<g><title>{}</title>", escaped(series.label));
    if (series.line && series.points.size() > 1) {
      text += fmt::format("<path class=\"l c{}\" d=\"{}\"/>", series.style % kColours, path(series.points, x, y));
    }
    const double radius = series.line ? (series.points.size() > 40 ? 1.5 : 2.5) : 5;
    for (const auto& [px, py] : series.points) text += marker(x(px), y(py), series.style, radius);
    text += "</g>\n";
  }
  return text + "</svg>\n";
}

std::string marker_svg(std::size_t style) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"key\" viewBox=\"0 0 14 14\">" + marker(7, 7, style, 4.5) +
         "</svg>";
}

}  // namespace pullfocus::cli
