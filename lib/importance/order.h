// Priorities: which of the changed pixels to update first.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "importance/change.h"
#include "importance/importance.h"

namespace pullfocus {

class Gain;

// Everything a change is judged by.
struct Pending {
  const Frame& frame;
  const SourceState& state;
  const std::vector<std::int16_t>& index;  // of the frame, where changed
  const KernelTable& kernels;
  const Sanitiser& sanitiser;
  const ColourImage& shown;  // the last result, over the state window
  std::uint32_t round = 0;   // differs from call to call: ties fall differently each time
};

// Priority of pixels never committed: they come before all others.
inline constexpr float kFirstOfAll = std::numeric_limits<float>::infinity();

// Under Order::gain, pixels of which only the kernel changes, between kernels that cover 8 pixels or more, are judged
// together: in blocks of columns x rows, from a tile's corner on. Scatter writes pixels that lie side by side in a row
// together, which those of blocks do.
inline constexpr int kBlockWidth = 8, kBlockHeight = 4;

// A priority >= 0 of every changed pixel; larger comes first.
//
// Order::fearing: the bucket. Order::random: 0, since ties fall at random. Order::gain: an estimate of the squared
// error that the pending change leaves in the picture. A pixel of colour I and kernel w adds (I - R) w / W to the
// result R, W being about 1. With a = I_new - R, b = I_old - R and A = 1 / sum w^2, the area of a kernel,
//
//   gain = max(a^2 / A_new + b^2 / A_old - 2 a b / A_larger,  |I_new - I_old|^2 / A_smaller^(1/4))
//
// The first term is the squared norm of a w_new - b w_old, concentric kernels overlapping as flat discs do. It misses
// sharp pixels that R consists of (uncovered background), hence the second. That one alone counts where the kernel
// stays: changes of neighbours add up to |dI|^2 a pixel if they are alike and to |dI|^2 / A if they are noise; the
// root lies in between. Where only the kernel changes, as in a focus pull, neighbours change alike too, and the first
// few of them remove most of the error: there the gain is multiplied by a random number of [0, 1), which spreads a
// partial update; pixels judged together share it. Measured in docs/orders.md.
class Priorities {
 public:
  // What is referred to must outlive this.
  Priorities(const Pending& pending, const ImportanceOptions& options);
  ~Priorities();

  // Of pixels x .. x + n - 1 (1 <= n <= kTileWidth) of row y, from the window's corner, all in one tile; what they are
  // where nothing has changed means nothing. The same bits everywhere. Returns which of them are to be judged as
  // blocks, bit i of pixel x + i.
  std::uint64_t row(int x, int y, int n, float* out) const noexcept;

 private:
  template <SampleType type>
  void row_of_pixels(int x, int y, int n, float* out) const noexcept;

  const Pending& pending_;
  const ImportanceOptions& options_;
  std::unique_ptr<Gain> gain_;  // with Order::gain
};

}  // namespace pullfocus
