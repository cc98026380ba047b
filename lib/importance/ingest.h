// From a frame as it came to sources: sanitised colours, signed CoC indices, what was repaired, where content
// is.
#pragma once

#include <cstdint>

#include "camera/thin_lens.h"
#include "image/frame.h"
#include "image/sanitise.h"
#include "image/tiles.h"
#include "scatter/coc_table.h"

namespace pullfocus {

// Repairs and findings over a frame or part of it; coordinates count from the state window's corner.
struct FrameFindings {
  ColourRepairs colour;
  std::int64_t depth = 0;        // suspect depths taken as background (see is_suspect)
  std::int64_t coc_clamped = 0;  // diameters beyond the table's largest
  Window content;                // bounds of pixels with colour, alpha or a surface
  int content_index = 0;         // largest |index| among them

  void add(const FrameFindings& other) noexcept;
};

// Reads tile rows of one frame. Pure: any number of threads, each with findings of its own.
template <SampleType type>
class SegmentIngest {
 public:
  SegmentIngest(const Frame& frame, const CocFunction& coc, const CocTable& table, const Sanitiser& sanitiser)
      : frame_(frame), coc_(coc), table_(table), sanitiser_(sanitiser), window_(frame.window()) {}

  // Pixels x .. x + n - 1 (n <= kTileWidth) of row y, from the window's corner.
  const Pixel<type>* colours(int x, int y) const noexcept {
    return reinterpret_cast<const Pixel<type>*>(frame_.colour.pixel(window_.x0 + x, window_.y0 + y));
  }

  // Writes the signed indices of the n pixels, and counts repairs of depth and clamps.
  void indices(int x, int y, int n, std::int16_t* out, FrameFindings& findings) const noexcept;

  // Sanitised colours; counts repairs.
  void sanitised(int x, int y, int n, Pixel<type>* out, FrameFindings& findings) const noexcept {
    const Pixel<type>* in = colours(x, y);
    for (int i = 0; i < n; ++i) out[i] = sanitiser_(in[i], findings.colour);
  }

  // Extends the content bounds by these pixels, whose indices are given.
  void content(int x, int y, int n, const std::int16_t* indices, FrameFindings& findings) const noexcept;

 private:
  bool has_content(int x, int y) const noexcept;
  void count_suspects(int x, int y, int n, FrameFindings& findings) const noexcept;

  const Frame& frame_;
  const CocFunction coc_;
  const CocTable& table_;
  const Sanitiser& sanitiser_;
  const Window window_;
};

}  // namespace pullfocus
