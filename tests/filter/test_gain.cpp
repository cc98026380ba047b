// Order::gain against its formula, pixel by pixel and in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "importance/order.h"
#include "random_change.h"

namespace pullfocus {
namespace {

using test::Change;
using test::random_change;

double plain_gain(const Pending& pending, int x, int y, std::size_t at) {
  const auto area = [&](std::int16_t index) { return pending.kernels.area(is_source(index) ? index : 0); };
  const double now = area(pending.index[at]), then = area(pending.state.index[at]);
  double change = 0, aa = 0, bb = 0, ab = 0;
  for (int c = 0; c < 3; ++c) {
    const double is = static_cast<double>(pending.frame.colour.get(x, y, c));
    const double was = static_cast<double>(pending.state.colour.get(x, y, c));
    const double result = static_cast<double>(pending.shown.get(x, y, c));
    change += (is - was) * (is - was);
    aa += (is - result) * (is - result);
    bb += (was - result) * (was - result);
    ab += (is - result) * (was - result);
  }
  const double of_colour = change / std::sqrt(std::sqrt(std::min(now, then)));
  if (pending.index[at] == pending.state.index[at]) return of_colour;
  const double of_kernel = aa / now + bb / then - 2 * ab / std::max(now, then);
  if (change > 0) return std::max(of_kernel, of_colour);
  const int width = pending.frame.window().width(), column = static_cast<int>(at) % width,
            row = static_cast<int>(at) / width;
  const bool as_block = std::min(now, then) >= 8;
  const int corner = row / kBlockHeight * kBlockHeight * width + column / kBlockWidth * kBlockWidth;
  const std::uint32_t spread = scrambled(
      (as_block ? static_cast<std::uint32_t>(corner) : static_cast<std::uint32_t>(at)) + 0x9e3779b9u * pending.round);
  return of_kernel * std::ldexp(static_cast<double>(spread >> 8), -24);
}

TEST(Gain, IsWhatItsFormulaSaysForEveryChangedPixel) {
  std::mt19937 random(5);
  KernelOptions options;
  options.max_coc_px = 30;
  const KernelTable kernels(options);
  const Sanitiser sanitiser(65504);
  for (const SampleType type : {SampleType::half, SampleType::float32}) {
    const Window window{-3, 2, 140, 41};
    const Change change = random_change(window, type, kernels.coc().size(), random);
    const Pending pending{change.frame, change.state, change.index, kernels, sanitiser, change.shown, 7};
    const TileGrid grid{window.width(), window.height()};
    std::vector<TileWork> tiles;
    for (int tile = 0; tile < grid.count(); ++tile) {
      TileWork work{tile, 0, {}};
      for (int row = 0; row < grid.tile_height(tile); ++row) {
        work.mask.rows[row] = (std::uint64_t{random()} << 32 | random()) & first_pixels(grid.tile_width(tile));
      }
      tiles.push_back(work);
    }
    const ImportanceOptions by_gain;
    const Priorities priorities(pending, by_gain);
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      for (int row = 0; row < kTileHeight; ++row) {
        if (tiles[t].mask.rows[row] == 0) continue;
        float gains[kTileWidth];
        const int first = std::countr_zero(tiles[t].mask.rows[row]);
        priorities.row(grid.x(tiles[t].tile) + first, grid.y(tiles[t].tile) + row,
                       grid.tile_width(tiles[t].tile) - first, gains + first);
        for_each_pixel(tiles[t].mask.rows[row], [&](int p) {
          const int x = grid.x(tiles[t].tile) + p, y = grid.y(tiles[t].tile) + row;
          const auto at = static_cast<std::size_t>(y * grid.width + x);
          const double is = static_cast<double>(gains[p]);
          if (change.state.index[at] == kNeverCommitted) {
            EXPECT_EQ(is, static_cast<double>(kFirstOfAll));
            return;
          }
          const double expected = plain_gain(pending, window.x0 + x, window.y0 + y, at);
          // What cancels in single precision is up to the squares of the colours, here 64.
          ASSERT_NEAR(is, std::max(expected, 0.), 1e-5 * std::fabs(expected) + 2e-5) << x << ", " << y;
        });
      }
    }
  }
}

TEST(Gain, OfHugeColoursIsANumber) {
  KernelOptions options;
  options.max_coc_px = 30;
  const KernelTable kernels(options);
  const Sanitiser sanitiser(65504);
  const Window window{0, 0, 64, 1};
  const Frame frame = test::flat_frame(window, SampleType::float32, {65504, -65504, 65504, 1}, 1);
  SourceState state;
  state.reset(window, SampleType::float32);
  std::fill(state.index.begin(), state.index.end(), std::int16_t{3});
  const std::vector<std::int16_t> index(64, 5);
  ColourImage shown(window, SampleType::float32);
  for (int x = 0; x < 64; ++x) shown.set(x, 0, 0, x % 2 ? 3e38f : -3e38f);
  const Pending pending{frame, state, index, kernels, sanitiser, shown, 1};
  const ImportanceOptions by_gain;
  float gains[64];
  Priorities(pending, by_gain).row(0, 0, 64, gains);
  for (const float gain : gains) {
    EXPECT_TRUE(std::isfinite(gain));
    EXPECT_GE(gain, 0);
  }
}

}  // namespace
}  // namespace pullfocus
