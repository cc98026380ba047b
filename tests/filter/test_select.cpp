// Which pixels a budget affords, against the same by sorting all of them.
#include "importance/select.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <tuple>

#include "random_change.h"

namespace pullfocus {
namespace {

struct Candidate {
  std::size_t t;
  int row, column, wait;
  bool never;
  std::uint32_t rank, unit, pixel;

  // What comes first has more of the first of these in which two differ.
  auto importance() const { return std::tuple(never, never ? 0 : rank, unit, pixel); }
};

std::vector<TileMask> plain_selection(const Changes& changes, const Pending& pending, const ImportanceOptions& options,
                                      const WaitingTimes& waiting, const Allowance& allowance) {
  const TileGrid grid = grid_of(pending.frame.window());
  const Priorities priorities(pending, options);
  const auto rank_of = [&](float priority) {
    return options.order == Order::gain ? std::bit_cast<std::uint32_t>(priority) >> 16
                                        : static_cast<std::uint32_t>(priority);
  };
  std::vector<Candidate> all;
  for (std::size_t t = 0; t < changes.tiles.size(); ++t) {
    const TileWork& work = changes.tiles[t];
    const auto hash = [&](int unit) {
      return scrambled((static_cast<std::uint32_t>(work.tile) * 2048 + static_cast<std::uint32_t>(unit)) ^
                       scrambled(pending.round));
    };
    std::map<int, std::vector<double>> blocks;  // priorities by the block's unit
    std::vector<std::pair<Candidate, int>> of_blocks;
    for (int row = 0; row < grid.tile_height(work.tile); ++row) {
      float priority[kTileWidth];
      const int x = grid.x(work.tile), y = grid.y(work.tile) + row;
      const std::uint64_t in_block = priorities.row(x, y, grid.tile_width(work.tile), priority);
      for_each_pixel(work.mask.rows[row], [&](int p) {
        const auto at = static_cast<std::size_t>(y * grid.width + x + p);
        const int unit = row * kTileWidth + p, block = 1024 + row / 4 * 8 + p / 8;
        Candidate pixel{
            t,          row,       p, waiting.of(at), pending.state.index[at] == kNeverCommitted, rank_of(priority[p]),
            hash(unit), hash(unit)};
        if ((in_block >> p & 1) == 0) {
          all.push_back(pixel);
          return;
        }
        blocks[block].push_back(static_cast<double>(priority[p]));
        pixel.unit = hash(block);
        of_blocks.emplace_back(pixel, block);
      });
    }
    for (auto& [pixel, block] : of_blocks) {
      double sum = 0;
      for (const double priority : blocks[block]) sum += priority;
      pixel.rank = rank_of(static_cast<float>(sum / static_cast<double>(blocks[block].size())));
      all.push_back(pixel);
    }
  }
  std::vector<TileMask> taken(changes.tiles.size());
  std::int64_t left = allowance.pixels;
  const auto take = [&](const Candidate& pixel) {
    taken[pixel.t].rows[pixel.row] |= std::uint64_t{1} << pixel.column;
    --left;
  };
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(a.wait, a.importance()) > std::tuple(b.wait, b.importance());
  });
  const std::int64_t half = (allowance.pixels + 1) / 2;
  const auto waiting_end = std::find_if(all.begin(), all.end(), [](const Candidate& p) { return p.wait == 0; });
  const auto oldest = all.begin() + std::min<std::int64_t>(half, waiting_end - all.begin());
  std::for_each(all.begin(), oldest, take);
  std::sort(oldest, all.end(), [](const Candidate& a, const Candidate& b) { return a.importance() > b.importance(); });
  std::for_each(oldest, oldest + std::min<std::int64_t>(left, all.end() - oldest), take);
  for (const Candidate& pixel : all) {
    if (allowance.longest_wait > 0 && pixel.wait >= allowance.longest_wait) take(pixel);
  }
  return taken;
}

using test::Change;

class Selecting : public testing::Test {
 protected:
  std::vector<TileWork> any_tiles(int of_four) {
    std::vector<TileWork> tiles;
    for (int tile = 0; tile < grid_.count(); ++tile) {
      TileWork work{tile, 0, {}};
      for (int row = 0; row < grid_.tile_height(tile); ++row) {
        for (int p = 0; p < grid_.tile_width(tile); ++p) {
          work.mask.rows[row] |= std::uint64_t{random_() % 4 < static_cast<unsigned>(of_four)} << p;
        }
      }
      if (random_() % 5 == 0) work.mask = {};
      if (random_() % 5 == 0) {
        for (int row = 0; row < grid_.tile_height(tile); ++row) {
          work.mask.rows[row] = first_pixels(grid_.tile_width(tile));
        }
      }
      if (work.mask.any()) tiles.push_back(work);
    }
    return tiles;
  }

  // Allowances from nothing to nearly all, on pixels that have and have not waited.
  void expect_the_plain_one(const Change& change, const Changes& changes, const WaitingTimes& waiting, Order order) {
    ImportanceOptions options;
    options.order = order;
    const Pending pending{change.frame,
                          change.state,
                          change.index,
                          kernels_,
                          sanitiser_,
                          change.shown,
                          static_cast<std::uint32_t>(random_())};
    for (const int percent : {0, 1, 7, 33, 50, 90, 99}) {
      const Allowance allowance{changes.pixels * percent / 100 + 1,
                                random_() % 2 ? 1 + static_cast<int>(random_() % 9) : 0};
      if (allowance.pixels >= changes.pixels) continue;
      const auto expected = plain_selection(changes, pending, options, waiting, allowance);
      const auto selected = select_pixels(changes, pending, options, waiting, allowance);
      auto at = selected.begin();
      for (std::size_t t = 0; t < changes.tiles.size(); ++t) {
        const bool is_there = at != selected.end() && at->tile == changes.tiles[t].tile;
        const TileMask got = is_there ? at->mask : TileMask{};
        for (int row = 0; row < kTileHeight; ++row) {
          ASSERT_EQ(got.rows[row], expected[t].rows[row])
              << name(order) << ", " << percent << " %, tile " << changes.tiles[t].tile << ", row " << row;
        }
        if (is_there) ++at;
      }
      ASSERT_EQ(at, selected.end());
    }
  }

  const Window window_{-3, 2, 147, 61};
  const TileGrid grid_ = grid_of(window_);
  std::mt19937 random_{17};
  const KernelTable kernels_{[] {
    KernelOptions options;
    options.max_coc_px = 30;
    return options;
  }()};
  const Sanitiser sanitiser_{65504};
};

TEST_F(Selecting, TakesWhatSortingAllPixelsWouldPutFirst) {
  for (const Order order : {Order::gain, Order::fearing, Order::random}) {
    for (const SampleType type : {SampleType::half, SampleType::float32}) {
      for (const int calls : {0, 3, 400}) {  // 400 waits do not fit a byte
        Change change = test::random_change(window_, type, kernels_.coc().size(), random_);
        if (calls == 3) {  // with pixels never committed, and without
          std::replace(change.state.index.begin(), change.state.index.end(), kNeverCommitted, std::int16_t{5});
        }
        Changes changes;
        changes.tiles = any_tiles(3);
        changes.pixels = count_pixels(changes.tiles);
        WaitingTimes waiting;
        std::vector<TileWork> left = any_tiles(2);
        for (int call = 0; call < calls; ++call) {
          if (call % 97 < 3) left = any_tiles(2);
          waiting.update(grid_, left);
        }
        expect_the_plain_one(change, changes, waiting, order);
      }
    }
  }
}

TEST_F(Selecting, SpreadsManyTiesAsSortingWould) {
  Change change = test::random_change(window_, SampleType::half, kernels_.coc().size(), random_);
  for (std::size_t i = 0; i < change.index.size(); ++i) {
    change.state.index[i] = static_cast<std::int16_t>(i % 7 < 4 ? 40 : 30);
    change.index[i] = 35;
  }
  test::for_each_in(window_, [&](int x, int y) {
    for (int c = 0; c < 4; ++c) {
      change.frame.colour.set(x, y, c, 0.5f);
      change.state.colour.set(x, y, c, 0.5f);
      change.shown.set(x, y, c, 0.5f);
    }
  });
  Changes changes;
  changes.tiles = any_tiles(4);
  changes.pixels = count_pixels(changes.tiles);
  for (const Order order : {Order::gain, Order::fearing}) expect_the_plain_one(change, changes, {}, order);
}

}  // namespace
}  // namespace pullfocus
