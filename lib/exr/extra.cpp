#include "exr/extra.h"

#include <cstring>
#include <utility>

namespace pullfocus::exr {
namespace {

void copy_rows(const ExtraChannel& from, const Window& from_window, ExtraChannel& to, const Window& to_window) {
  const Window common = intersect(from_window, to_window);
  if (common.empty()) return;
  const std::size_t bytes = sample_bytes(from.type);
  const auto offset = [bytes](const Window& window, int x, int y) {
    return (static_cast<std::size_t>(y - window.y0) * static_cast<std::size_t>(window.width()) +
            static_cast<std::size_t>(x - window.x0)) *
           bytes;
  };
  for (int y = common.y0; y < common.y1; ++y) {
    std::memcpy(to.samples.data() + offset(to_window, common.x0, y),
                from.samples.data() + offset(from_window, common.x0, y),
                bytes * static_cast<std::size_t>(common.width()));
  }
}

}  // namespace

std::size_t sample_bytes(Imf::PixelType type) noexcept { return type == Imf::HALF ? 2 : 4; }

void ExtraChannels::reset(const Window& new_window, std::size_t count) {
  window = new_window;
  channels.resize(count);
}

ExtraChannels pass_through(const ExtraChannels& extra, const Window& window) {
  ExtraChannels result;
  const ExtraChannels& passed = pass_through(extra, window, result);
  return &passed == &extra ? extra : std::move(result);
}

const ExtraChannels& pass_through(const ExtraChannels& extra, const Window& window, ExtraChannels& scratch) {
  if (extra.window == window) return extra;
  scratch.reset(window, extra.channels.size());
  for (std::size_t i = 0; i < extra.channels.size(); ++i) {
    const ExtraChannel& from = extra.channels[i];
    ExtraChannel& to = scratch.channels[i];
    to.name = from.name;
    to.type = from.type;
    to.samples.assign(window.pixels() * sample_bytes(from.type), std::byte{0});
    copy_rows(from, extra.window, to, window);
  }
  return scratch;
}

}  // namespace pullfocus::exr
