#include "exr/pixels.h"

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "exr/extra.h"
#include "exr/file_info.h"

namespace pullfocus::exr {
namespace {

void read_rows(Imf::InputPart& part, const std::vector<ChannelTarget>& targets, const Imath::Box2i& box) {
  Imf::FrameBuffer buffer;
  for (const ChannelTarget& target : targets) {
    buffer.insert(target.channel, Imf::Slice::Make(target.type, target.base, box, target.x_stride, target.y_stride));
  }
  part.setFrameBuffer(buffer);
  part.readPixels(box.min.y, box.max.y);
}

template <typename Sample>
void copy_samples(const std::byte* from, std::size_t from_stride, std::byte* to, std::size_t to_stride, int count) {
  for (int i = 0; i < count; ++i, from += from_stride, to += to_stride) std::memcpy(to, from, sizeof(Sample));
}

void copy_columns(const ChannelTarget& from, const ChannelTarget& to, const Window& common) {
  const auto copy = to.type == Imf::HALF ? copy_samples<std::uint16_t> : copy_samples<std::uint32_t>;
  for (std::size_t y = 0; y < static_cast<std::size_t>(common.height()); ++y) {
    copy(from.base + y * from.y_stride, from.x_stride, to.base + y * to.y_stride, to.x_stride, common.width());
  }
}

// Rows reach past the state window at a side: whole rows into scratch memory, then the common columns, in
// blocks that bound the memory and split no compressed block.
void read_cropped(Imf::InputPart& part, const std::vector<ChannelTarget>& targets, const Window& data,
                  const Window& common) {
  constexpr int block_rows = 256;
  const std::size_t columns = static_cast<std::size_t>(data.width());
  std::vector<std::vector<std::byte>> scratch(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto rows = static_cast<std::size_t>(std::min(block_rows, common.height()));
    scratch[i].resize(columns * rows * sample_bytes(targets[i].type));
  }
  for (int y = common.y0, end; y < common.y1; y = end) {
    end = std::min(common.y1, y + block_rows - (y - data.y0) % block_rows);
    const Window rows = {data.x0, y, data.x1, end};
    std::vector<ChannelTarget> whole = targets;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      whole[i].base = scratch[i].data();
      whole[i].x_stride = sample_bytes(targets[i].type);
      whole[i].y_stride = whole[i].x_stride * columns;
    }
    read_rows(part, whole, to_box(rows));
    for (std::size_t i = 0; i < targets.size(); ++i) {
      ChannelTarget from = whole[i], to = targets[i];
      from.base += static_cast<std::size_t>(common.x0 - data.x0) * from.x_stride;
      to.base += static_cast<std::size_t>(y - common.y0) * to.y_stride;
      copy_columns(from, to, intersect(common, rows));
    }
  }
}

}  // namespace

void read_pixels(Imf::MultiPartInputFile& file, const std::vector<ChannelTarget>& targets, const Window& data_window,
                 const Window& window) {
  Imf::InputPart part(file, 0);
  if (window.x0 == data_window.x0 && window.x1 == data_window.x1) {
    read_rows(part, targets, to_box(window));
  } else {
    read_cropped(part, targets, data_window, window);
  }
}

}  // namespace pullfocus::exr
