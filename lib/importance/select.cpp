#include "importance/select.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <utility>

namespace pullfocus {

namespace {

constexpr std::size_t kGrain = 1 << 14;  // candidates that a thread looks at together

// All changed pixels, tile after tile.
class Candidates {
 public:
  Candidates(const Changes& changes, const Pending& pending, const ImportanceOptions& options,
             const WaitingTimes& waiting) {
    const TileGrid grid = grid_of(pending.frame.window());
    const auto of_tile = priorities(changes.tiles, pending, options);
    for (const TileWork& work : changes.tiles)
      first_.push_back(first_.back() + static_cast<std::size_t>(work.mask.count()));
    rank_.resize(first_.back());
    waited_.resize(first_.back());
    taken_.resize(first_.back());
    const std::uint32_t round = scrambled(pending.round);
    tbb::parallel_for(std::size_t{0}, changes.tiles.size(), [&](std::size_t t) {
      std::size_t i = 0;
      for_each_tile_pixel(grid, changes.tiles[t], [&](int, int, int x, int y) {
        const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + x;
        // Bits of floats >= 0 order as the floats do.
        const std::uint64_t priority = std::bit_cast<std::uint32_t>(of_tile[t][i]);
        rank_[first_[t] + i] = priority << 32 | scrambled(static_cast<std::uint32_t>(pixel) ^ round);
        waited_[first_[t] + i] = static_cast<std::uint16_t>(waiting.of(pixel));
        ++i;
      });
    });
  }

  std::size_t first(std::size_t tile) const noexcept { return first_[tile]; }
  bool is_taken(std::size_t i) const noexcept { return taken_[i] != 0; }

  // Takes the n of those not yet taken that have the largest rank.
  void take_highest(std::int64_t n) {
    take_ranks(n, [&](std::size_t i) { return taken_[i] == 0; });
  }

  // Takes the n that have waited longest, of the same wait those of the largest rank; returns how many there were.
  std::int64_t take_oldest(std::int64_t n) {
    constexpr std::size_t waits = 1 << 16;
    const auto of_wait = histogram(waits, [&](std::size_t i, auto&& count) { count(waited_[i]); });
    std::int64_t left = n;
    std::size_t wait = waits - 1;
    for (; wait > 0 && of_wait[wait] <= left; --wait) left -= of_wait[wait];
    for_all([&](std::size_t i) { taken_[i] |= std::uint8_t{waited_[i] > wait}; });
    if (wait > 0 && left > 0) {
      take_ranks(left, [&](std::size_t i) { return waited_[i] == wait; });
      left = 0;
    }
    return n - left;
  }

  // Takes all that have waited so long.
  void take_waiting(int wait) {
    for_all([&](std::size_t i) { taken_[i] |= std::uint8_t{waited_[i] >= wait}; });
  }

 private:
  template <typename Visit>
  void for_all(Visit&& visit) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rank_.size(), kGrain), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) visit(i);
    });
  }

  // visit(i, count) for every candidate may count(bin).
  template <typename Visit>
  std::vector<std::int64_t> histogram(std::size_t bins, Visit&& visit) const {
    tbb::enumerable_thread_specific<std::vector<std::int64_t>> parts(bins);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rank_.size(), kGrain), [&](const auto& range) {
      std::vector<std::int64_t>& part = parts.local();
      for (std::size_t i = range.begin(); i < range.end(); ++i) visit(i, [&](std::size_t bin) { ++part[bin]; });
    });
    std::vector<std::int64_t> sum(bins);
    for (const auto& part : parts) std::transform(sum.begin(), sum.end(), part.begin(), sum.begin(), std::plus<>());
    return sum;
  }

  // Of the eligible ones the n with the largest ranks. Ranks are no two equal; the n-th is found 16 bits at a time,
  // from the counts of those that agree with it so far.
  template <typename Eligible>
  void take_ranks(std::int64_t n, Eligible&& eligible) {
    constexpr int digit = 16;
    constexpr std::size_t bins = 1 << digit;
    if (n <= 0) return;
    std::uint64_t least = 0;
    for (int shift = 64 - digit; shift >= 0; shift -= digit) {
      const auto agrees = [&](std::uint64_t rank) {
        return shift == 64 - digit || rank >> (shift + digit) == least >> (shift + digit);
      };
      const auto counts = histogram(bins, [&](std::size_t i, auto&& count) {
        if (eligible(i) && agrees(rank_[i])) count(static_cast<std::size_t>(rank_[i] >> shift) % bins);
      });
      std::size_t bin = bins - 1;
      while (bin > 0 && counts[bin] < n) n -= counts[bin--];
      least |= std::uint64_t{bin} << shift;
      if (counts[bin] <= n) break;  // all of the bin
    }
    for_all([&](std::size_t i) { taken_[i] |= std::uint8_t{eligible(i) && rank_[i] >= least}; });
  }

  std::vector<std::size_t> first_{0};  // candidate of each tile
  std::vector<std::uint64_t> rank_;    // priority, then scrambled position: no two are equal
  std::vector<std::uint16_t> waited_;
  std::vector<std::uint8_t> taken_;
};

}  // namespace

std::vector<TileWork> select_pixels(const Changes& changes, const Pending& pending, const ImportanceOptions& options,
                                    const WaitingTimes& waiting, const Allowance& allowance) {
  if (allowance.pixels >= changes.pixels) return changes.tiles;
  Candidates candidates(changes, pending, options, waiting);
  const std::int64_t oldest = candidates.take_oldest((allowance.pixels + 1) / 2);
  candidates.take_highest(allowance.pixels - oldest);
  if (allowance.longest_wait > 0) candidates.take_waiting(allowance.longest_wait);

  std::vector<TileWork> selected;
  const TileGrid grid = grid_of(pending.frame.window());
  for (std::size_t t = 0; t < changes.tiles.size(); ++t) {
    const TileWork& changed = changes.tiles[t];
    TileWork work{changed.tile, changed.max_index, {}};
    std::size_t i = candidates.first(t);
    for_each_tile_pixel(grid, changed, [&](int row, int p, int, int) {
      work.mask.rows[row] |= std::uint64_t{candidates.is_taken(i++)} << p;
    });
    if (work.mask.any()) selected.push_back(work);
  }
  return selected;
}

}  // namespace pullfocus
