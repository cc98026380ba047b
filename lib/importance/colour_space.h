// Spaces in which the distance of two colours is measured.
#pragma once

#include <array>
#include <string_view>

namespace pullfocus {

// CIE 1931 xy of the primaries and the white of linear RGB; Rec. 709 unless the file says otherwise.
struct Chromaticities {
  std::array<double, 2> red{0.64, 0.33}, green{0.30, 0.60}, blue{0.15, 0.06}, white{0.3127, 0.3290};
};

enum class ColourDistance {
  rgb,    // Euclidean in linear RGB
  cieluv  // Euclidean in CIE 1976 L*u*v*, in hundredths: 1 from black to white
};

std::string_view name(ColourDistance distance) noexcept;      // as --colour-distance spells it
ColourDistance parse_colour_distance(std::string_view text);  // throws Error(usage) naming --colour-distance

// Maps linear RGB to coordinates whose Euclidean distance is the distance of colours.
class ColourMetric {
 public:
  ColourMetric() = default;
  // Throws Error(content) if cieluv is asked for and the chromaticities span no triangle.
  explicit ColourMetric(ColourDistance distance, const Chromaticities& chromaticities = {});

  ColourDistance distance() const noexcept { return distance_; }

  // Any finite values; luminance below black continues L* linearly, and a colour without a chromaticity (its sum of
  // tristimulus values is not positive) counts as grey.
  std::array<double, 3> operator()(const std::array<double, 3>& rgb) const noexcept {
    return distance_ == ColourDistance::rgb ? rgb : cieluv(rgb);
  }

 private:
  std::array<double, 3> cieluv(const std::array<double, 3>& rgb) const noexcept;

  ColourDistance distance_ = ColourDistance::rgb;
  std::array<std::array<double, 3>, 3> to_xyz_{};  // rows X, Y, Z; white has Y = 1
  double white_u_ = 0, white_v_ = 0;               // u', v' of white
};

}  // namespace pullfocus
