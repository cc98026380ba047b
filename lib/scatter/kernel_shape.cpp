#include "scatter/kernel_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "image/error.h"

namespace pullfocus {

namespace {

constexpr int kFewestBlades = 3, kMostBlades = 16, kLargestPicture = 4096;

Error wrong(const std::string& message) { return Error(ErrorCode::usage, message); }

void validate(const AperturePicture& picture) {
  const auto legal = [](int side) { return side >= 1 && side <= kLargestPicture; };
  if (!legal(picture.width) || !legal(picture.height)) {
    throw wrong(fmt::format("--kernel image: a picture of {} x {} pixels: it must have 1 to {} a side", picture.width,
                            picture.height, kLargestPicture));
  }
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  if (picture.luminance.size() != pixels) throw wrong("--kernel image: luminance must have width * height values");
  float largest = 0;
  for (const float value : picture.luminance) {
    if (!(value >= 0 && std::isfinite(value))) {
      throw wrong("--kernel image: the picture has negative or non-finite values");
    }
    largest = std::max(largest, value);
  }
  if (largest == 0) throw wrong("--kernel image: the picture is black: no light would pass");
}

}  // namespace

KernelShape KernelShape::parse(std::string_view text) {
  KernelShape shape;
  constexpr std::string_view polygon = "polygon:";
  if (text == "disc") {
    shape.kind = Kind::disc;
  } else if (text == "gaussian") {
    shape.kind = Kind::gaussian;
  } else if (text == "diffraction") {
    shape.kind = Kind::diffraction;
  } else if (text.starts_with(polygon)) {
    shape.kind = Kind::polygon;
    const std::string_view digits = text.substr(polygon.size());
    const char* end = digits.data() + digits.size();
    const auto parsed = std::from_chars(digits.data(), end, shape.blades);
    if (parsed.ec != std::errc{} || parsed.ptr != end) shape.blades = 0;
    validate(shape);
  } else {
    throw wrong(
        fmt::format("--kernel '{}' is not known: use disc, polygon:N, gaussian, diffraction or image:FILE", text));
  }
  return shape;
}

void validate(const KernelShape& shape) {
  if (shape.kind == KernelShape::Kind::polygon && (shape.blades < kFewestBlades || shape.blades > kMostBlades)) {
    throw wrong(fmt::format("--kernel polygon:N needs a number of blades N from {} to {}", kFewestBlades, kMostBlades));
  }
  if (!std::isfinite(shape.blade_rotation_deg)) throw wrong("--blade-rotation must be a number of degrees");
  if (!(shape.blade_roundness >= 0 && shape.blade_roundness <= 1)) {
    throw wrong("--blade-roundness must lie between 0 (straight blades) and 1 (a disc)");
  }
  if (shape.kind == KernelShape::Kind::image) {
    if (!shape.picture) throw wrong("--kernel image needs a picture: image:FILE");
    validate(*shape.picture);
  }
}

std::string describe(const KernelShape& shape) {
  switch (shape.kind) {
    case KernelShape::Kind::disc:
      return "disc";
    case KernelShape::Kind::polygon:
      return fmt::format("polygon:{}, rotation {:g}, roundness {:g}", shape.blades, shape.blade_rotation_deg,
                         shape.blade_roundness);
    case KernelShape::Kind::gaussian:
      return "gaussian";
    case KernelShape::Kind::diffraction:
      return "diffraction";
    case KernelShape::Kind::image:
      return fmt::format("image, {}x{} pixels", shape.picture->width, shape.picture->height);
  }
  return "";
}

}  // namespace pullfocus
