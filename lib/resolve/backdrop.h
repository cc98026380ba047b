// What lies behind a foreground that is too thin or too blurred to hide it.
//
// A blurred object in front of focus lets through what is behind it, but an image holds nothing there: where the
// object's own pixels are, a sharp background has left a hole. A hole is a pixel that layers in front of focus alone
// reach, and do not cover. What they leave free there is filled from the nearest pixels to its left, right, above and
// below at which both can be seen, a foreground and enough of what lies behind it:
//
//   result = present + k (fill - present)       k    = max(0, min(free, 2 free - 1/4))
//   fill   = sum of w_i behind_i / sum of w_i   w_i  = 1/d_i - 1/(kReach + 1), d_i the distance in pixels
//
// with `present`, what the foreground alone would give, among them with weight kPresentWeight, so that the fill sets in
// smoothly with distance. All of it is a function of the sums around a pixel, so that linear and incremental agree.
// What it gains: docs/visibility.md.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "image/frame.h"

namespace pullfocus {

class Backdrop {
 public:
  static constexpr int kReach = 64;             // pixels
  static constexpr int kChunk = 32;             // pixels of a row that are resolved together, from a multiple of it on
  static constexpr double kLeastFree = 1. / 8;  // less is not filled: an object's curved back would shine through
  static constexpr double kEnoughBehind = 1. / 8;  // weight, in units that cover a pixel
  static constexpr float kPresentWeight = 1.f / 256;

  // What resolving a chunk finds out: bit i is its i-th pixel. At a pixel that shows what is behind, `colour` is that
  // (RGBA, as if nothing were before it); at a hole it is `present`, and `amount` is k.
  struct Chunk {
    std::uint32_t shows = 0, holes = 0;
    float colour[kChunk][4];
    float amount[kChunk];
  };

  // Size of the window in pixels.
  Backdrop(int width, int height);

  // Nothing is known of any pixel; no memory is held.
  void reset();
  // Nothing is known of any pixel, as before all of them are resolved: rows that no light reaches are not handed over.
  void begin_anew();

  // Takes over the chunk of row y that begins at column x. Different rows may be taken by different threads.
  void take(int x, int y, const Chunk& chunk);
  // The same for a chunk without holes that shows nothing.
  void take_none(int x, int y) noexcept;

  // Fills the holes near chunks that were taken since the last call. `out` holds resolved pixels and has the window's
  // size. Runs in the calling task arena.
  void fill(ColourImage& out);

  std::size_t bytes() const noexcept;

 private:
  std::size_t at(int x, int y) const noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x / kChunk);
  }
  bool is_set(const std::vector<std::uint32_t>& bits, int x, int y) const noexcept {
    return (bits[at(x, y)] >> (x % kChunk) & 1) != 0;
  }
  void mark(int x, int y) noexcept;
  int left(int x, int y) const noexcept;
  int right(int x, int y) const noexcept;
  void fill_cell(int cx, int cy, ColourImage& out) const noexcept;

  const int height_, columns_;                  // columns of chunks
  std::vector<std::uint32_t> shows_, holes_;    // by chunk
  std::vector<std::uint8_t> touched_;           // by chunk
  std::vector<std::unique_ptr<Chunk>> chunks_;  // null where neither is
  std::vector<std::uint8_t> row_touched_;
};

}  // namespace pullfocus
