#include "importance/select.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <utility>

#include "importance/tile_ranks.h"

namespace pullfocus {

namespace {

using Masks = std::vector<TileMask>;  // of every changed tile

constexpr std::size_t kGrain = 8;  // tiles that a thread looks at together

class Selection {
 public:
  Selection(const Changes& changes, const Pending& pending, const ImportanceOptions& options,
            const WaitingTimes& waiting)
      : tiles_(changes.tiles),
        grid_(grid_of(pending.frame.window())),
        waiting_(waiting),
        ranks_(changes.tiles, pending, options),
        taken_(changes.tiles.size()) {}

  // Takes the n of those not yet taken that come first.
  void take_first(std::int64_t n) { take(n, left()); }

  // Takes the n that have waited longest, of the same wait those that come first; returns how many there were.
  std::int64_t take_oldest(std::int64_t n) {
    if (!waiting_.any() || n <= 0) return 0;
    const auto bins = static_cast<std::size_t>(waiting_.most()) + 1;
    const auto of_wait = histogram(bins, [&](std::size_t t, auto&& count) {
      for_each_wait(t, [&](int, std::uint64_t pixels, int wait) {
        count(static_cast<std::size_t>(wait), std::popcount(pixels));
      });
    });
    std::int64_t rest = n;
    int wait = waiting_.most();
    for (; wait > 0 && of_wait[static_cast<std::size_t>(wait)] <= rest; --wait) {
      rest -= of_wait[static_cast<std::size_t>(wait)];
    }
    if (wait == 0) {
      take_all(1);
      return n - rest;
    }
    Masks eligible(tiles_.size());
    for_each_tile([&](std::size_t t) {
      for_each_wait(t, [&](int row, std::uint64_t pixels, int w) {
        taken_[t].rows[row] |= w > wait ? pixels : 0;
        eligible[t].rows[row] |= w == wait ? pixels : 0;
      });
    });
    take(rest, eligible);
    return n;
  }

  // Takes all that have waited so long, >= 1.
  void take_all(int wait) {
    if (!waiting_.any() || wait > waiting_.most()) return;
    for_each_tile([&](std::size_t t) {
      for_each_wait(t, [&](int row, std::uint64_t pixels, int w) { taken_[t].rows[row] |= w >= wait ? pixels : 0; });
    });
  }

  std::vector<TileWork> selected() const {
    std::vector<TileWork> selected;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      if (taken_[t].any()) selected.push_back({tiles_[t].tile, tiles_[t].max_index, taken_[t]});
    }
    return selected;
  }

 private:
  template <typename Visit>
  void for_each_tile(Visit&& visit) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles_.size(), kGrain), [&](const auto& range) {
      for (std::size_t t = range.begin(); t < range.end(); ++t) visit(t);
    });
  }

  // visit(t, count) may count(bin, pixels).
  template <typename Visit>
  std::vector<std::int64_t> histogram(std::size_t bins, Visit&& visit) const {
    tbb::enumerable_thread_specific<std::vector<std::int64_t>> parts(bins);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles_.size(), kGrain), [&](const auto& range) {
      std::vector<std::int64_t>& part = parts.local();
      for (std::size_t t = range.begin(); t < range.end(); ++t) {
        visit(t, [&](std::size_t bin, int pixels) { part[bin] += pixels; });
      }
    });
    std::vector<std::int64_t> sum(bins);
    for (const auto& part : parts) std::transform(sum.begin(), sum.end(), part.begin(), sum.begin(), std::plus<>());
    return sum;
  }

  // visit(row, pixels, wait) for the changed pixels of a tile that wait, those of one wait in a row together if all
  // are.
  template <typename Visit>
  void for_each_wait(std::size_t t, Visit&& visit) const {
    const int x = grid_.x(tiles_[t].tile), n = grid_.tile_width(tiles_[t].tile);
    for (int i = 0; i < grid_.tile_height(tiles_[t].tile); ++i) {
      const std::uint64_t row = tiles_[t].mask.rows[i];
      if (row == 0) continue;
      int waits[kTileWidth], others = 0;
      waiting_.of_row(static_cast<std::size_t>(grid_.y(tiles_[t].tile) + i) * static_cast<std::size_t>(grid_.width) + x,
                      n, waits);
      for (int p = 0; p < n; ++p) others |= waits[p] ^ waits[0];
      if (others == 0) {
        if (waits[0] > 0) visit(i, row, waits[0]);
        continue;
      }
      for_each_pixel(row, [&](int p) {
        if (waits[p] > 0) visit(i, std::uint64_t{1} << p, waits[p]);
      });
    }
  }

  Masks left() const {
    Masks left(tiles_.size());
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      for (int i = 0; i < kTileHeight; ++i) left[t].rows[i] = tiles_[t].mask.rows[i] & ~taken_[t].rows[i];
    }
    return left;
  }

  // Takes the n of the eligible that come first: pixels never committed, then by rank.
  void take(std::int64_t n, const Masks& eligible) {
    if (!ranks_.any_never_committed())
      return take_ranks(n, eligible, [&](std::size_t t, int unit) { return ranks_.rank(t, unit); });
    Masks never(eligible), others(eligible);
    std::int64_t count = 0;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      const TileMask mask = ranks_.never_committed(t);
      for (int i = 0; i < kTileHeight; ++i) {
        never[t].rows[i] &= mask.rows[i];
        others[t].rows[i] &= ~mask.rows[i];
      }
      count += never[t].count();
    }
    take_ranks(std::min(n, count), never, [](std::size_t, int) { return std::size_t{0}; });
    take_ranks(n - count, others, [&](std::size_t t, int unit) { return ranks_.rank(t, unit); });
  }

  // Units by rank, of the same rank by scrambled position, and of the last unit pixels by scrambled position.
  template <typename Rank>
  void take_ranks(std::int64_t n, const Masks& eligible, Rank&& rank) {
    if (n <= 0) return;
    const auto take_above = [&](const Masks& of, auto&& rank_of, std::int64_t& left) {
      const auto counts = histogram(TileRanks::kRanks, [&](std::size_t t, auto&& count) {
        ranks_.for_each_unit(t, of[t], [&](int unit, int pixels) { count(rank_of(t, unit), pixels); });
      });
      std::size_t least = TileRanks::kRanks - 1;
      for (; least > 0 && counts[least] <= left; --least) left -= counts[least];
      Masks at_least(tiles_.size());
      for_each_tile([&](std::size_t t) {
        ranks_.for_each_unit(t, of[t], [&](int unit, int) {
          const std::size_t r = rank_of(t, unit);
          if (r > least) ranks_.add(t, unit, of[t], taken_[t]);
          if (r == least) ranks_.add(t, unit, of[t], at_least[t]);
        });
      });
      return at_least;
    };
    const Masks ties = take_above(eligible, rank, n);
    if (n <= 0) return;
    const auto hash = [&](std::size_t t, int unit) { return ranks_.scrambled_position(t, unit); };
    const Masks last = take_above(
        ties, [&](std::size_t t, int unit) { return std::size_t{hash(t, unit) >> 17}; }, n);
    if (n <= 0) return;
    struct Tied {
      std::uint32_t unit, pixel;
      std::size_t t;
      int row, column;
    };
    std::vector<Tied> pixels;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      for_each_tile_pixel(grid_, {tiles_[t].tile, 0, last[t]}, [&](int row, int p, int, int) {
        pixels.push_back({hash(t, ranks_.unit(t, row, p)), hash(t, row * kTileWidth + p), t, row, p});
      });
    }
    std::sort(pixels.begin(), pixels.end(),
              [](const Tied& a, const Tied& b) { return a.unit != b.unit ? a.unit > b.unit : a.pixel > b.pixel; });
    for (std::size_t i = 0; i < std::min(static_cast<std::size_t>(n), pixels.size()); ++i) {
      taken_[pixels[i].t].rows[pixels[i].row] |= std::uint64_t{1} << pixels[i].column;
    }
  }

  const std::vector<TileWork>& tiles_;
  const TileGrid grid_;
  const WaitingTimes& waiting_;
  const TileRanks ranks_;
  Masks taken_;
};

}  // namespace

std::vector<TileWork> select_pixels(const Changes& changes, const Pending& pending, const ImportanceOptions& options,
                                    const WaitingTimes& waiting, const Allowance& allowance) {
  if (allowance.pixels >= changes.pixels) return changes.tiles;
  if (allowance.pixels <= 0 && allowance.longest_wait <= 0) return {};
  Selection selection(changes, pending, options, waiting);
  const std::int64_t oldest = selection.take_oldest((allowance.pixels + 1) / 2);
  selection.take_first(allowance.pixels - oldest);
  if (allowance.longest_wait > 0) selection.take_all(allowance.longest_wait);
  return selection.selected();
}

}  // namespace pullfocus
