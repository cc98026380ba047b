#include "kernel_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/error.h"
#include "imageio/picture.h"

namespace pullfocus::cli {

namespace {

std::shared_ptr<const AperturePicture> read_aperture(const std::string& file) {
  if (file.empty()) throw Error(ErrorCode::usage, "--kernel image:FILE needs the name of a picture");
  const auto aperture = std::make_shared<AperturePicture>();
  try {
    const imageio::Picture picture = imageio::read_picture(file);
    aperture->width = picture.width;
    aperture->height = picture.height;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      const float* rgb = &picture.rgba[i];
      const float luminance = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
      aperture->luminance.push_back(std::isfinite(luminance) && luminance > 0 ? luminance : 0.f);
    }
  } catch (const Error& error) {
    throw Error(ErrorCode::usage, fmt::format("--kernel image:{}", error.what()));
  }
  if (std::ranges::all_of(aperture->luminance, [](float value) { return value == 0; })) {
    throw Error(ErrorCode::usage, fmt::format("--kernel image:{}: the picture is black: no light would pass", file));
  }
  return aperture;
}

}  // namespace

KernelShape kernel_shape(const KernelArguments& a) {
  constexpr std::string_view image = "image:";
  KernelShape shape;
  if (a.kernel.starts_with(image)) {
    shape.kind = KernelShape::Kind::image;
    shape.picture = read_aperture(a.kernel.substr(image.size()));
  } else {
    shape = KernelShape::parse(a.kernel);
  }
  shape.blade_rotation_deg = a.blade_rotation;
  shape.blade_roundness = a.blade_roundness;
  validate(shape);
  return shape;
}

}  // namespace pullfocus::cli
