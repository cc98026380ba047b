// Scatter in runs, bands and deltas against a plain sum over every pixel of every kernel.
#include "scatter/scatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "reference.h"

namespace pullfocus {
namespace {

struct Case {
  int width, height;
  double max_coc_px, pixel_aspect;
  SampleType type;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.width << "x" << c.height << " to " << c.max_coc_px << " px, aspect " << c.pixel_aspect;
}

class Scattering : public testing::TestWithParam<Case> {
 protected:
  Scattering() : kernels_(options()), window_{-5, 3, -5 + GetParam().width, 3 + GetParam().height} {}

  static KernelOptions options() {
    KernelOptions options;
    options.max_coc_px = GetParam().max_coc_px;
    options.pixel_aspect = GetParam().pixel_aspect;
    return options;
  }

  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  float colour() { return std::uniform_real_distribution<float>(-1, below(9) == 0 ? 65504.f : 1.f)(random_); }
  std::int16_t any_index() {
    const int last = kernels_.coc().size() - 1;
    return static_cast<std::int16_t>(below(2 * last + 1) - last);
  }
  // Mostly one of a few, so that near neighbours share one, side by side or with others in between.
  std::int16_t index() { return below(4) != 0 ? few_[below(3)] : any_index(); }

  // Runs of one index or none, and every ninth pixel was never committed.
  SourceState random_state() {
    SourceState state;
    state.reset(window_, GetParam().type);
    for (std::int16_t& few : few_) few = any_index();
    const int run = 1 + below(6);
    std::int16_t current = index();
    for (std::size_t i = 0; i < state.index.size(); ++i) {
      if (below(run) == 0) current = index();
      if (below(9) != 0) state.index[i] = current;
      for (int c = 0; c < 4; ++c) state.colour.set(x_of(i), y_of(i), c, colour());
    }
    return state;
  }

  int x_of(std::size_t i) const { return window_.x0 + static_cast<int>(i) % window_.width(); }
  int y_of(std::size_t i) const { return window_.y0 + static_cast<int>(i) / window_.width(); }

  // Sums over the image. No pixel is handed over twice.
  std::vector<Accumulator> scatter(const std::vector<TileWork>& tiles, const Sources& sources, int lanes, int threads) {
    std::vector<Accumulator> sums(window_.pixels() * static_cast<std::size_t>(lanes));
    std::vector<int> taken(window_.pixels());
    scatter_.run(tiles, sources, lanes, threads, [&](int y, int x0, int x1, const Accumulator* values) {
      const std::size_t first = static_cast<std::size_t>(y) * GetParam().width + x0;
      std::copy_n(values, static_cast<std::size_t>(x1 - x0) * lanes, &sums[first * lanes]);
      for (int x = x0; x < x1; ++x) ++taken[first + static_cast<std::size_t>(x - x0)];
    });
    EXPECT_LE(*std::max_element(taken.begin(), taken.end()), 1);
    return sums;
  }

  const KernelTable kernels_;
  const Window window_;
  Scatter scatter_{kernels_, GetParam().width, GetParam().height};
  std::mt19937 random_{7};
  std::int16_t few_[3] = {};
};

TEST_P(Scattering, OfAStateEqualsThePlainSumBitForBit) {
  for (const int lanes : {kOpaqueLanes, kAlphaLanes}) {
    for (int round = 0; round < 2; ++round) {
      const SourceState state = random_state();
      const auto expected = test::exact_sums(state, kernels_, lanes);
      for (const int threads : {1, 2, 3, 4}) {
        ASSERT_TRUE(scatter(whole_state(state), {&state}, lanes, threads) == expected) << threads << " threads";
      }
    }
  }
}

// Masks, old and new indices all at random; the expected sums know nothing of deltas.
TEST_P(Scattering, OfAChangeEqualsTheDifferenceOfTwoPlainSumsBitForBit) {
  const Sanitiser sanitiser(65504.f);
  for (int round = 0; round < 3; ++round) {
    const SourceState before = random_state();
    Frame frame{random_state().colour, Plane(window_, 0.f)};
    std::vector<std::int16_t> pending(before.index);
    SourceState after = before;
    std::vector<TileWork> tiles;
    const TileGrid grid{window_.width(), window_.height()};
    for (int tile = 0; tile < grid.count(); ++tile) {
      TileWork work{tile, 0, {}};
      const int sparseness = 1 + below(6);
      for (int y = 0; y < grid.tile_height(tile); ++y) {
        for (int x = 0; x < grid.tile_width(tile); ++x) {
          const int image_x = grid.x(tile) + x, image_y = grid.y(tile) + y;
          const std::size_t i = static_cast<std::size_t>(image_y) * window_.width() + image_x;
          if (pending[i] == kNeverCommitted || below(2)) pending[i] = index();
          if (below(sparseness) != 0) continue;
          work.mask.rows[y] |= std::uint64_t{1} << x;
          const int was = before.index[i] == kNeverCommitted ? 0 : std::abs(before.index[i]);
          work.max_index = std::max({work.max_index, was, std::abs(static_cast<int>(pending[i]))});
          after.index[i] = pending[i];
          for (int c = 0; c < 4; ++c) {
            after.colour.set(x_of(i), y_of(i), c, frame.colour.get(x_of(i), y_of(i), c));
          }
        }
      }
      if (work.mask.any()) tiles.push_back(work);
    }
    const int lanes = round % 2 ? kOpaqueLanes : kAlphaLanes;
    auto expected = test::exact_sums(after, kernels_, lanes);
    const auto sums_before = test::exact_sums(before, kernels_, lanes);
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] -= sums_before[i];
    const Sources sources{&before, &frame, pending.data(), &sanitiser};
    ASSERT_TRUE(scatter(tiles, sources, lanes, 1 + round) == expected) << "round " << round;
  }
}

TEST_P(Scattering, OfNothingHandsOverNothing) {
  SourceState state;
  state.reset(window_, GetParam().type);
  EXPECT_TRUE(whole_state(state).empty());
  scatter_.run({}, {&state}, kAlphaLanes, 2, [](int, int, int, const Accumulator*) { ADD_FAILURE(); });
}

constexpr auto half = SampleType::half;
constexpr auto float32 = SampleType::float32;

INSTANTIATE_TEST_SUITE_P(Images, Scattering,
                         testing::Values(Case{1, 1, 60, 1, half}, Case{1, 9, 40, 1, float32}, Case{200, 1, 30, 1, half},
                                         Case{5, 4, 90, 1, float32}, Case{7, 3, 24, 4, half},
                                         Case{17, 13, 12, 1, float32}, Case{63, 15, 20, 1, half},
                                         Case{64, 16, 9, 1, float32}, Case{65, 17, 70, 1, half},
                                         Case{33, 50, 16, 0.3, float32}, Case{130, 33, 14, 2, half},
                                         Case{200, 90, 10, 1, float32}, Case{150, 60, 80, 1, half}));

// Wide enough for three words of dirty bits a row, and low enough for a plain sum.
INSTANTIATE_TEST_SUITE_P(Wide, Scattering, testing::Values(Case{2047, 2, 6, 1, half}, Case{4500, 3, 6, 1, float32}));

}  // namespace
}  // namespace pullfocus
