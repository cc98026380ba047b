#include "image/frame.h"

#include <Imath/half.h>

#include <cstring>

namespace pullfocus {

void ColourImage::reset(const Window& window, SampleType type) {
  window_ = window;
  type_ = type;
  samples_.assign(window.pixels() * pixel_bytes(), std::byte{0});
}

float ColourImage::get(int x, int y, int channel) const noexcept {
  const std::byte* address = pixel(x, y) + static_cast<std::size_t>(channel) * sample_bytes(type_);
  if (type_ == SampleType::float32) {
    float value;
    std::memcpy(&value, address, sizeof value);
    return value;
  }
  std::uint16_t bits;
  std::memcpy(&bits, address, sizeof bits);
  return imath_half_to_float(bits);
}

void ColourImage::set(int x, int y, int channel, float value) noexcept {
  std::byte* address = pixel(x, y) + static_cast<std::size_t>(channel) * sample_bytes(type_);
  if (type_ == SampleType::float32) {
    std::memcpy(address, &value, sizeof value);
    return;
  }
  const std::uint16_t bits = imath_float_to_half(value);
  std::memcpy(address, &bits, sizeof bits);
}

void Plane::reset(const Window& window, float value) {
  window_ = window;
  values_.assign(window.pixels(), value);
}

}  // namespace pullfocus
