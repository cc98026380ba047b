// The part of a source that others hide, as run edges. SIMD with run-time dispatch; every target gives the same bits.
#pragma once

#include <cstdint>

#include "scatter/depth_planes.h"
#include "scatter/edges.h"

namespace pullfocus {

// Sizes that are within the cut-off of some size: first <= size <= first + span. They are a stretch of indices, since
// diameters ascend with them.
struct NearSizes {
  std::uint16_t first = 0, span = 0;
  bool contain(int size) const noexcept { return size >= first && size <= first + span; }
};

// Bit i: pixel i of n (1..64) lies in front of `key` (its key is smaller), and its size is none of `near`: it hides a
// source with that key from itself. Reads up to 31 values past the end.
std::uint64_t hidden_by(const std::uint16_t* keys, const std::uint16_t* sizes, int n, std::uint16_t key,
                        NearSizes near) noexcept;

// Bit i: pixel i lies behind, and its size is none of `near`: it is hidden from a pixel with that key.
std::uint64_t hidden_from(const std::uint16_t* keys, const std::uint16_t* sizes, int n, std::uint16_t key,
                          NearSizes near) noexcept;

// One source: its contribution at weight w is round(plus * w), lane by lane.
template <int lanes>
struct Emission {
  int x;               // image column
  std::int16_t index;  // whose kernel
  double plus[lanes];
};

// One source that others may hide.
struct HiddenSource {
  const DepthPlanes* planes;
  std::uint16_t key;
  NearSizes near;
  int window;     // L: rows -L/2 .. L/2 - 1 as the picture goes on
  int first_dx;   // leftmost column of the window, seen from the source: -L/2, or 1 - L/2 if the source is mirrored
  bool take_out;  // subtracts what is hidden; else adds it
};

// Adds or subtracts what `source`, at column source.x (of an image of the picture beside the picture, where kernels are
// not symmetric) and row y, would give to the pixels that hide it, in the band rows of one of its images.
template <int lanes>
using WriteHidden = void (*)(const Kernel& kernel, const Emission<lanes>& source, const HiddenSource& hidden, int y,
                             const BandImage& image, Band& band);

// For the processor at hand.
template <int lanes>
WriteHidden<lanes> hidden_writer() noexcept;

}  // namespace pullfocus
