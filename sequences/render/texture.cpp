#include "render/texture.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace pullfocus::sequences {
namespace {

// A coordinate in texels, and the two texels around it.
struct Between {
  int low = 0, high = 0;
  float share = 0;
};

int wrapped(int texel, int size, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(texel, 0, size - 1);
  const int period = wrap == Wrap::mirror ? 2 * size : size;
  const int folded = (texel % period + period) % period;
  return folded < size ? folded : period - 1 - folded;
}

Between between(float u, int size, Wrap wrap) {
  if (!(std::abs(u) < 1e6f)) u = 0;
  const float texel = (u - 2 * std::floor(u / 2)) * static_cast<float>(size) - 0.5f;  // u and u + 2 look alike
  const float place = wrap == Wrap::clamp ? std::clamp(u, 0.0f, 1.0f) * static_cast<float>(size) - 0.5f : texel;
  const float low = std::floor(place);
  return {wrapped(static_cast<int>(low), size, wrap), wrapped(static_cast<int>(low) + 1, size, wrap), place - low};
}

}  // namespace

glm::vec3 texture_colour(const Texture& texture, glm::vec2 uv) noexcept {
  const Between x = between(uv.x, texture.width, texture.wrap_u);
  const Between y = between(uv.y, texture.height, texture.wrap_v);
  const auto texel = [&](int column, int row) {
    return texture.texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.width) +
                          static_cast<std::size_t>(column)];
  };
  return glm::mix(glm::mix(texel(x.low, y.low), texel(x.high, y.low), x.share),
                  glm::mix(texel(x.low, y.high), texel(x.high, y.high), x.share), y.share);
}

}  // namespace pullfocus::sequences
