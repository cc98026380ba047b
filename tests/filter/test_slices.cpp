// Work cut into slices.
#include <gtest/gtest.h>

#include <limits>

#include "importance/change.h"
#include "importance/slices.h"
#include "random_frames.h"

namespace pullfocus {
namespace {

const Window window{0, 0, 300, 120};

class Slices : public testing::TestWithParam<Order> {};

TEST_P(Slices, KeepToTheirEdgesAndWorkAndHandEverythingOutOnce) {
  constexpr std::int64_t any = std::numeric_limits<std::int64_t>::max() / 2;
  KernelOptions kernel_options;
  kernel_options.max_coc_px = 30;
  const KernelTable kernels(kernel_options);
  const Sanitiser sanitiser(kernel_options.max_radiance);
  test::RandomShot shot(window, 21, SampleType::half, true, false);
  SourceState state;
  state.reset(window, SampleType::half);
  std::vector<std::int16_t> index(window.pixels());
  const ColourImage shown(window, SampleType::half);
  ImportanceOptions options;
  options.order = GetParam();
  for (int step = 0; step < 12; ++step) {
    if (step > 0) shot.step();
    const Changes changes = find_changes(shot.frame(), test::random_lens(shot.random(), 30), kernels.coc(), sanitiser,
                                         state, {}, index, nullptr);
    const Pending pending{shot.frame(), state, index, kernels, sanitiser, shown, 1};
    const WaitingTimes waiting;
    const EdgeCount all = count_edges(changes.tiles, pending);
    const std::int64_t edges = step % 2 == 0 ? any : 1 + static_cast<std::int64_t>(shot.random()() % 20000);
    const std::int64_t work = step % 3 == 0 ? any : 1 + static_cast<std::int64_t>(shot.random()() % 2000000);
    SliceQueue queue(changes.tiles, pending, options, waiting, all);
    EdgeCount handed_out;
    std::vector<TileMask> seen(static_cast<std::size_t>(TileGrid{window.width(), window.height()}.count()));
    while (!queue.empty()) {
      const SliceQueue::Slice slice = queue.next(edges, work);
      ASSERT_FALSE(slice.tiles.empty());
      int rows = 0;
      for (const TileWork& tile : slice.tiles) {
        for (int i = 0; i < kTileHeight; ++i) {
          std::uint64_t& before = seen[static_cast<std::size_t>(tile.tile)].rows[i];
          EXPECT_EQ(before & tile.mask.rows[i], 0u);
          before |= tile.mask.rows[i];
          rows += tile.mask.rows[i] != 0;
        }
      }
      EXPECT_EQ(slice.edges.written, count_edges(slice.tiles, pending).written);
      EXPECT_GT(slice.work, slice.edges.written);
      if (rows > 1) {
        EXPECT_LE(slice.edges.written, edges);
        EXPECT_LE(slice.work, work);
      }
      handed_out.add(slice.edges);
      EXPECT_EQ(queue.edges_left().written, all.written - handed_out.written);
      EXPECT_GE(queue.work_left(), 0);
    }
    EXPECT_EQ(handed_out.written, all.written);
    EXPECT_EQ(handed_out.committed, all.committed);
    for (const TileWork& tile : changes.tiles) {
      for (int i = 0; i < kTileHeight; ++i) {
        EXPECT_EQ(seen[static_cast<std::size_t>(tile.tile)].rows[i], tile.mask.rows[i]);
      }
    }
    commit(shot.frame(), sanitiser, index, changes.tiles, state);
  }
}
INSTANTIATE_TEST_SUITE_P(Orders, Slices, testing::Values(Order::gain, Order::fearing, Order::random),
                         [](const auto& instance) { return std::string(name(instance.param)); });

TEST(HurriedSlices, TakeTheMostImportantTileFirst) {
  KernelOptions kernel_options;
  kernel_options.max_coc_px = 30;
  const KernelTable kernels(kernel_options);
  const Sanitiser sanitiser(kernel_options.max_radiance);
  Frame frame{ColourImage(window, SampleType::half), Plane(window, 0), false, {}};
  SourceState state;
  state.reset(window, SampleType::half);
  std::vector<std::int16_t> index(window.pixels());
  const ColourImage shown(window, SampleType::half);
  const CocFunction coc{DepthKind::coc, 1, 0};
  Changes changes = find_changes(frame, coc, kernels.coc(), sanitiser, state, {}, index, nullptr);
  commit(frame, sanitiser, index, changes.tiles, state);
  for (int x = 0; x < window.x1; ++x) frame.colour.set(x, 40, 0, 0.1f);  // faint, in a row of tiles
  frame.colour.set(200, 90, 0, 50);                                      // one strong pixel elsewhere
  changes = find_changes(frame, coc, kernels.coc(), sanitiser, state, {}, index, nullptr);
  const Pending pending{frame, state, index, kernels, sanitiser, shown, 1};
  SliceQueue queue(changes.tiles, pending, {}, WaitingTimes(), count_edges(changes.tiles, pending));
  const TileGrid grid{window.width(), window.height()};
  EXPECT_EQ(queue.next(1, 1).tiles.front().tile, 90 / kTileHeight * grid.columns() + 200 / kTileWidth);
}

}  // namespace
}  // namespace pullfocus
