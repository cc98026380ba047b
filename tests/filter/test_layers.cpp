// Layers: who lies before whom, what leaks, and what the sums of several layers become.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "camera/usage.h"
#include "filter/incremental_filter.h"
#include "filter/linear_filter.h"
#include "plain_frames.h"
#include "random_frames.h"
#include "reference.h"
#include "resolve/resolve.h"

namespace pullfocus {
namespace {

using test::coc_as_depth;
using test::flat_frame;
using test::for_each_in;
using test::options_up_to;
using test::set_colour;

FilterOptions with_layers(double max_coc, std::vector<double> borders = {-2, 2}) {
  FilterOptions options = options_up_to(max_coc);
  options.visibility.kind = VisibilityOptions::Kind::layers;
  options.visibility.borders = std::move(borders);
  return options;
}

TEST(LayersOf, SplitAtTheirBordersAndTheBorderBelongsToTheSideNearerToFocus) {
  const CocTable coc(0, 20);
  const std::vector<double> borders{-2, 0, 2, 6.5};
  const Layers layers(coc, borders);
  EXPECT_EQ(layers.count(), 5);
  const auto layer = [&](float c) { return layers.of(coc.index(c)); };
  EXPECT_EQ(layer(-20), 0);
  EXPECT_EQ(layer(-2.5f), 0);
  EXPECT_EQ(layer(-2), 1);
  EXPECT_EQ(layer(-0.5f), 1);
  EXPECT_EQ(layer(0), 2);
  EXPECT_EQ(layer(2), 2);
  EXPECT_EQ(layer(2.5f), 3);
  EXPECT_EQ(layer(6.5f), 3);
  EXPECT_EQ(layer(7), 4);
  for (int i = -coc.size() + 1; i < coc.size(); ++i) {
    const auto range = layers.range(layers.of(i));
    EXPECT_TRUE(i >= range.first && i <= range.last);
  }
}

// Indices of smooth stretches and of noise, some of pixels that are no sources.
std::vector<std::int16_t> random_indices(std::mt19937& random, std::size_t n, int most) {
  std::vector<std::int16_t> indices(n);
  const bool noise = random() % 2, holes = random() % 2;
  const auto any = [&] { return static_cast<std::int16_t>(static_cast<int>(random() % (2u * most + 1)) - most); };
  std::int16_t at = any();
  for (std::int16_t& index : indices) {
    if (noise || random() % 50 == 0) at = any();
    index = holes && random() % 9 == 0 ? (random() % 2 ? kHeldOut : kNeverCommitted) : at;
  }
  return indices;
}

TEST(ByLayer, GivesEveryPixelToTheLayersOfItsOldAndNewIndex) {
  const CocTable coc(0, 20);
  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    std::vector<double> borders;
    for (double at = -20; random() % 8 != 0 && borders.size() < Layers::kMostBorders;) {
      borders.push_back(at += 0.5 + static_cast<double>(random() % 12));
    }
    const Layers layers(coc, borders);
    const Window window{0, 0, 1 + static_cast<int>(random() % 200), 1 + static_cast<int>(random() % 40)};
    SourceState state;
    state.reset(window, SampleType::half);
    state.index = random_indices(random, window.pixels(), coc.size() - 1);
    const std::vector<std::int16_t> pending = random_indices(random, window.pixels(), coc.size() - 1);
    const bool moves = round % 2;
    const TileGrid grid{window.width(), window.height()};
    std::vector<TileWork> tiles;
    for (int tile = 0; tile < grid.count(); ++tile) {
      TileWork work{tile, 0, {}};
      for (int i = 0; i < grid.tile_height(tile); ++i) {
        const std::uint64_t all = first_pixels(grid.tile_width(tile));
        work.mask.rows[i] = random() % 3 ? all : all & (std::uint64_t{random()} << 32 | random());
      }
      if (work.mask.any()) tiles.push_back(work);
    }
    std::map<std::pair<int, int>, TileWork> expected;  // by layer and tile
    for (const TileWork& work : tiles) {
      for_each_tile_pixel(grid, work, [&](int i, int p, int x, int y) {
        const auto at = static_cast<std::size_t>(y * window.width() + x);
        const auto add = [&](std::int16_t index) {
          if (!is_source(index)) return;
          TileWork& part =
              expected.try_emplace({layers.of(index), work.tile}, TileWork{work.tile, 0, {}}).first->second;
          part.mask.rows[i] |= std::uint64_t{1} << p;
          part.max_index = std::max(part.max_index, std::abs(int{index}));
        };
        add(state.index[at]);
        if (moves) add(pending[at]);
      });
    }
    std::size_t parts = 0;
    int before = -1;
    for (const LayerWork& layer : by_layer(tiles, layers, state, moves ? pending.data() : nullptr)) {
      ASSERT_GT(layer.layer, before);
      before = layer.layer;
      ASSERT_EQ(layer.range.first, layers.range(layer.layer).first);
      if (layers.count() == 1) continue;  // all of the tiles, as they are
      for (const TileWork& part : layer.tiles) {
        const auto found = expected.find({layer.layer, part.tile});
        ASSERT_NE(found, expected.end());
        ASSERT_TRUE(std::equal(part.mask.rows, part.mask.rows + kTileHeight, found->second.mask.rows));
        ASSERT_EQ(part.max_index, found->second.max_index);
        ++parts;
      }
    }
    if (layers.count() > 1) {
      ASSERT_EQ(parts, expected.size());
    }
  }
}

TEST(LayersOf, BordersBeyondEveryDiameterGiveEmptyLayersThatHarmNothing) {
  const Window window{0, 0, 40, 30};
  test::RandomShot shot(window, 3, SampleType::half, true, false);
  const CocFunction coc = test::random_lens(shot.random(), 10);
  LinearFilter one(window, with_layers(10, {})), many(window, with_layers(10, {-90, 70, 80}));
  one.filter(shot.frame(), coc);
  many.filter(shot.frame(), coc);
  EXPECT_EQ(test::difference(one.result(), many.result()), "");
}

TEST(VisibilityText, IsReadAndWrongOnesAreNamed) {
  EXPECT_EQ(parse_visibility("auto").kind, VisibilityOptions::Kind::layers);
  EXPECT_EQ(parse_visibility("none").kind, VisibilityOptions::Kind::none);
  EXPECT_EQ(parse_visibility("layers").borders, (std::vector<double>{-2, 2}));
  EXPECT_EQ(parse_visibility("layers:-8,-2.5,0,3").borders, (std::vector<double>{-8, -2.5, 0, 3}));
  for (const char* text : {"", "layer", "layers:", "layers:1,", "layers:,1", "layers:2,1", "layers:1,1", "layers:nan",
                           "layers:1;2", "layers:1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16", "None"}) {
    expect_usage_error([&] { parse_visibility(text); }, "--visibility");
  }
}

// A pixel from plain sums in long double, after the formula.
std::array<double, 4> combined(const std::vector<std::array<double, 5>>& layers) {
  constexpr long double cover = 15 / 16.l;
  long double free = cover, colour[4] = {};
  const std::array<double, 5>* last = nullptr;
  for (const auto& layer : layers) {
    if (layer[4] == 0) continue;
    last = &layer;
    const long double taken = std::min<long double>(layer[4], free);
    for (int c = 0; c < 4; ++c) colour[c] += layer[static_cast<std::size_t>(c)] / layer[4] * taken;
    free -= taken;
  }
  std::array<double, 4> result{};
  for (std::size_t c = 0; c < 4; ++c) {
    result[c] = static_cast<double>((colour[c] + (*last)[c] / (*last)[4] * free) / cover);
  }
  return result;
}

TEST(ResolveLayers, FollowsTheFormulaForAnyNumberOfLayersSpanAndType) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 60; ++round) {
    const int width = 1 + static_cast<int>(random() % 90), count = 1 + static_cast<int>(random() % 5);
    const Window window{0, 0, width, 1};
    std::vector<std::vector<Accumulator>> sums(static_cast<std::size_t>(count));
    std::vector<std::vector<std::array<double, 5>>> truth(static_cast<std::size_t>(width));
    std::vector<const Accumulator*> pointers;
    for (auto& layer : sums) {
      for (int x = 0; x < width; ++x) {
        // Often nothing, often more than enough.
        const double weight = random() % 3 ? uniform(random) * (random() % 2 ? 1.4 : 0.3) : 0;
        std::array<double, 5> pixel{};
        for (std::size_t c = 0; c < 4; ++c) pixel[c] = weight * uniform(random) * 4;
        pixel[4] = weight;
        const auto fixed = [](double v) { return static_cast<Accumulator>(std::llrint(v * 0x1p40)); };
        const std::array<Accumulator, 5> lanes{fixed(pixel[0]), fixed(pixel[1]), fixed(pixel[2]), fixed(pixel[4]),
                                               fixed(pixel[3])};
        layer.insert(layer.end(), lanes.begin(), lanes.end());
        truth[static_cast<std::size_t>(x)].push_back(pixel);
      }
      pointers.push_back(layer.data());
    }
    if (count > 1 && round % 4 == 0) {
      pointers[1] = nullptr;
      for (auto& pixel : truth) pixel[1] = {};
    }
    const ColourImage own = flat_frame(window, SampleType::float32, {9, 8, 7, 6}, 0).colour;
    ColourImage out(window, SampleType::float32);
    resolve_layers(pointers, kAlphaLanes, 0, width, 0, own, out);
    for (int x = 0; x < width; ++x) {
      const auto& layers = truth[static_cast<std::size_t>(x)];
      const bool any = std::any_of(layers.begin(), layers.end(), [](const auto& l) { return l[4] != 0; });
      const auto expected = any ? combined(layers) : std::array<double, 4>{9, 8, 7, 6};
      for (int c = 0; c < 4; ++c) {
        ASSERT_NEAR(out.get(x, 0, c), expected[static_cast<std::size_t>(c)], 1e-6) << x << " channel " << c;
      }
    }
  }
}

TEST(ResolveLayers, APixelOfOneLayerHasTheBitsItHasWithoutLayersWhateverItsNeighboursHave) {
  std::mt19937 random(6);
  const Window window{0, 0, 64, 1};
  std::vector<Accumulator> a(64 * kOpaqueLanes), b(64 * kOpaqueLanes);
  for (int x = 0; x < 64; ++x) {
    for (int c = 0; c < kOpaqueLanes; ++c) {
      a[static_cast<std::size_t>(x * kOpaqueLanes + c)] = random() * 311ull;
      if (x % 3 == 0) b[static_cast<std::size_t>(x * kOpaqueLanes + c)] = random() * 77ull;
    }
  }
  const ColourImage own(window, SampleType::float32);
  ColourImage alone(window, SampleType::float32), both(window, SampleType::float32);
  resolve_span(a.data(), kOpaqueLanes, 0, 64, 0, own, alone);
  const Accumulator* layers[] = {a.data(), b.data()};
  resolve_layers(layers, kOpaqueLanes, 0, 64, 0, own, both);
  for (int x = 0; x < 64; ++x) {
    for (int c = 0; c < 3 && x % 3 != 0; ++c) ASSERT_EQ(alone.get(x, 0, c), both.get(x, 0, c)) << x;
  }
}

// The paper's figure 5: a dark sharp band before a bright blurred background.
double leaked(const Window& window, const Window& band, float band_coc, float background_coc, const Window& judged) {
  Frame frame = flat_frame(window, SampleType::float32, {1, 1, 1}, background_coc);
  for_each_in(band, [&](int x, int y) {
    set_colour(frame.colour, x, y, {0, 0, 0});
    frame.depth.at(x, y) = band_coc;
  });
  IncrementalFilter filter(window, with_layers(40));
  filter.filter(frame, coc_as_depth);
  double most = 0;
  for_each_in(judged, [&](int x, int y) { most = std::max(most, static_cast<double>(filter.result().get(x, y, 0))); });
  return most;
}

TEST(Leaking, OntoASharpBandIsBelowOnePercentOfTheBackground) {
  const Window window{0, 0, 160, 60};
  EXPECT_LT(leaked(window, {70, 0, 90, 60}, 0, 30, {70, 0, 90, 60}), 0.01);
  EXPECT_LT(leaked(window, {0, 20, 160, 26}, 0, 40, {0, 20, 160, 26}), 0.01);
  // A band of a few px of blur is sharp inside.
  EXPECT_LT(leaked(window, {70, 0, 90, 60}, -1.5f, 30, {72, 0, 88, 60}), 0.01);
}

TEST(Leaking, AtThePicturesBorderIsBelowOnePercentToo) {
  const Window window{0, 0, 120, 60};
  EXPECT_LT(leaked(window, {0, 0, 12, 60}, 0, 30, {0, 0, 12, 60}), 0.01);
  EXPECT_LT(leaked(window, {108, 0, 120, 60}, 0, 30, {108, 0, 120, 60}), 0.01);
  // Blurred itself, the band covers wholly what lies its own radius inside: nothing comes in over the border.
  EXPECT_LT(leaked(window, {0, 0, 40, 60}, -12, 30, {0, 0, 32, 60}), 0.01);
  EXPECT_LT(leaked(window, {0, 0, 120, 20}, -12, 30, {0, 0, 120, 12}), 0.01);
}

TEST(Layers, AContinuousSurfaceThatABorderCutsStaysConstant) {
  const Window window{0, 0, 140, 40};
  Frame frame = flat_frame(window, SampleType::float32, {0.6f, 0.3f, 0.1f}, 0);
  for_each_in(window, [&](int x, int y) { frame.depth.at(x, y) = static_cast<float>(x - 70) / 8; });
  LinearFilter filter(window, with_layers(20));
  filter.filter(frame, coc_as_depth);
  for_each_in(window, [&](int x, int y) {
    ASSERT_NEAR(filter.result().get(x, y, 0), 0.6f, 1e-6f);
    ASSERT_NEAR(filter.result().get(x, y, 2), 0.1f, 1e-6f);
  });
}

TEST(Layers, ABlurredForegroundLetsTheRestThrough) {
  const Window window{0, 0, 120, 60};
  Frame frame = flat_frame(window, SampleType::float32, {1, 1, 1}, 0);
  for_each_in({50, 0, 70, 60}, [&](int x, int y) {
    set_colour(frame.colour, x, y, {0, 0, 0});
    frame.depth.at(x, y) = -16;
  });
  LinearFilter filter(window, with_layers(30));
  filter.filter(frame, coc_as_depth);
  // Half covered at the band's geometric edge, less outside, and the sharp background untouched beyond its reach.
  EXPECT_NEAR(filter.result().get(49, 30, 0), 0.5, 0.06);
  EXPECT_GT(filter.result().get(45, 30, 0), 0.6);
  EXPECT_EQ(filter.result().get(38, 30, 0), 1);
}

TEST(Layers, HoldMemoryOnlyWhereTheyReach) {
  const Window window{0, 0, 640, 320};
  Frame frame = flat_frame(window, SampleType::half, {0.5f, 0.5f, 0.5f}, 0);
  for_each_in({20, 20, 40, 30}, [&](int x, int y) { frame.depth.at(x, y) = 9; });
  IncrementalFilter filter(window, with_layers(10));
  filter.filter(frame, coc_as_depth);
  const std::size_t one = 640 * 320 * kOpaqueLanes * sizeof(Accumulator);
  EXPECT_LT(filter.sum_bytes(), one + one / 20);
}

}  // namespace
}  // namespace pullfocus
