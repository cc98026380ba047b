// From a frame as it came to sources: sanitised colours, signed CoC indices, what was repaired, where content
// is.
#pragma once

#include <cstdint>

#include "camera/thin_lens.h"
#include "image/frame.h"
#include "image/sanitise.h"
#include "image/tiles.h"
#include "importance/remembered_depths.h"
#include "importance/segment.h"
#include "scatter/coc_table.h"

namespace pullfocus {

// Repairs and findings over a frame or part of it; coordinates count from the state window's corner.
struct FrameFindings {
  ColourRepairs colour;
  std::int64_t depth = 0;        // suspect depths taken as background (see is_suspect)
  std::int64_t coc_clamped = 0;  // diameters beyond the table's largest
  Window content;                // bounds of pixels with colour, alpha or a surface
  int content_index = 0;         // largest |index| among them, held-out ones left aside

  void add(const FrameFindings& other) noexcept;
};

// Reads tile rows of one frame. Pure: any number of threads, each with findings of its own.
template <SampleType type>
class SegmentIngest {
 public:
  SegmentIngest(const Frame& frame, const CocFunction& coc, const CocTable& table, const Sanitiser& sanitiser)
      : frame_(frame),
        to_index_(coc, table),
        sanitiser_(sanitiser),
        window_(frame.window()),
        has_mask_(frame.has_mask()) {}

  // Pixels x .. x + n - 1 (n <= kTileWidth) of row y, from the window's corner.
  const Pixel<type>* colours(int x, int y) const noexcept {
    return reinterpret_cast<const Pixel<type>*>(frame_.colour.pixel(window_.x0 + x, window_.y0 + y));
  }

  // Writes the signed indices of the n pixels, kHeldOut where the frame's mask says so. Counts repairs of depth and
  // clamps, and extends the content bounds.
  void indices(int x, int y, int n, std::int16_t* out, FrameFindings& findings) const noexcept;

  // The same, and what differs from the committed pixels. `out` has room for kTileWidth indices; where the answer says
  // that all depths are known it is not written: the committed ones are the frame's. `remembered` may be null, and must
  // be for frames with a mask; it is read and brought up to date.
  SegmentDifference compare(int x, int y, int n, const Pixel<type>* old_colours, const std::int16_t* old_index,
                            RememberedDepths* remembered, std::int16_t* out, FrameFindings& findings) const noexcept;

  // How many whole rows of tiles from (x, y) on, `most` at most, are as remembered and committed, bit for bit. Adds
  // what there is to find in them.
  int unchanged(int x, int y, int most, const Pixel<type>* old_colours, const std::int16_t* old_index,
                const RememberedDepths& remembered, FrameFindings& findings) const noexcept;

  // Sanitised colours; counts repairs. Returns whether there were none.
  bool sanitised(int x, int y, int n, Pixel<type>* out, FrameFindings& findings) const noexcept {
    const Pixel<type>* in = colours(x, y);
    if (all_sane<type>(sanitiser_, in, n)) {
      std::copy_n(in, n, out);
      return true;
    }
    for (int i = 0; i < n; ++i) out[i] = sanitiser_(in[i], findings.colour);
    return false;
  }

 private:
  const float* depths(int x, int y) const noexcept { return frame_.depth.row(window_.y0 + y) + x; }
  void hold_out(int x, int y, int n, std::int16_t* indices) const noexcept;
  void add(int x, int y, int n, const SegmentFindings& segment, const std::int16_t* indices,
           FrameFindings& findings) const noexcept;
  void extend_content(int x, int y, int n, FrameFindings& findings) const noexcept;
  // `largest`: no |index| of the n is larger.
  void raise_content_index(int x, int y, int n, int largest, const std::int16_t* indices,
                           FrameFindings& findings) const noexcept;
  bool has_content(int x, int y) const noexcept;
  void count_suspects(int x, int y, int n, FrameFindings& findings) const noexcept;

  const Frame& frame_;
  const DepthToIndex to_index_;
  const Sanitiser& sanitiser_;
  const Window window_;
  const bool has_mask_;
};

}  // namespace pullfocus
