#include "importance/select.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>

#include "importance/tile_ranks.h"

namespace pullfocus {

namespace {

using Masks = std::vector<TileMask>;  // of every changed tile

constexpr std::size_t kGrain = 8;  // tiles that a thread looks at together

// Numbers of pixels by a digit of their keys; in parts, so that pixels with the same digit do not wait for each other.
class Digits {
 public:
  static constexpr unsigned kValues = 256;

  template <typename Digit>
  void count(const TileKeys& keys, const TileMask& mask, Digit&& digit) noexcept {
    for (int i = 0; i < kTileHeight; ++i) {
      const std::uint16_t* const row = keys.of[i];
      if (~mask.rows[i] == 0) {
        for (int p = 0; p < kTileWidth; ++p) ++of_[p % kParts][digit(row[p])];
      } else {
        for_each_pixel(mask.rows[i], [&](int p) { ++of_[p % kParts][digit(row[p])]; });
      }
    }
  }

  void add_to(std::vector<std::int64_t>& sums) const {
    for (const auto& part : of_) {
      for (unsigned value = 0; value < kValues; ++value) sums[value] += part[value];
    }
  }

 private:
  static constexpr int kParts = 4;
  std::uint32_t of_[kParts][kValues] = {};
};

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
    std::int64_t rest = n;
    const Last last = take_greatest(waits(), left(), static_cast<unsigned>(waiting_.most()), rest);
    if (last.key == 0) return n - rest;  // the others do not wait
    take(rest, last.pixels);
    return n;
  }

  // Takes all that have waited so long, >= 1.
  void take_all(int wait) {
    if (!waiting_.any() || wait > waiting_.most()) return;
    const std::vector<TileKeys>& of = waits();
    for_each_tile([&](std::size_t t) {
      add(within(of[t], tiles_[t].mask, static_cast<unsigned>(wait), TileKeys::kMost), taken_[t]);
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
  // The pixels of the last key of which any might be taken.
  struct Last {
    unsigned key;
    Masks pixels;
  };

  template <typename Visit>
  void for_each_tile(Visit&& visit) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles_.size(), kGrain), [&](const auto& range) {
      for (std::size_t t = range.begin(); t < range.end(); ++t) visit(t);
    });
  }

  static void add(const TileMask& pixels, TileMask& to) noexcept {
    for (int i = 0; i < kTileHeight; ++i) to.rows[i] |= pixels.rows[i];
  }

  // Of every changed pixel.
  const std::vector<TileKeys>& waits() {
    if (waits_.empty()) {
      waits_.resize(tiles_.size());
      for_each_tile([&](std::size_t t) {
        const int tile = tiles_[t].tile;
        for (int i = 0; i < grid_.tile_height(tile); ++i) {
          if (tiles_[t].mask.rows[i] == 0) continue;
          const auto first = static_cast<std::size_t>(grid_.y(tile) + i) * static_cast<std::size_t>(grid_.width) +
                             static_cast<std::size_t>(grid_.x(tile));
          waiting_.of_row(first, grid_.tile_width(tile), waits_[t].of[i]);
        }
      });
    }
    return waits_;
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
    if (!ranks_.any_never_committed()) return take_ranks(n, eligible);
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
    take_ties(std::min(n, count), never);
    take_ranks(n - count, others);
  }

  // Units by rank, and ties as below.
  void take_ranks(std::int64_t n, const Masks& eligible) {
    if (n <= 0) return;
    const Last last = take_greatest(ranks_.ranks(), eligible, TileKeys::kMost, n);
    take_ties(n, last.pixels);
  }

  // Units by scrambled position, and of the last unit pixels by scrambled position.
  void take_ties(std::int64_t n, const Masks& eligible) {
    if (n <= 0) return;
    std::vector<TileKeys> keys(tiles_.size());
    for_each_tile([&](std::size_t t) {
      for (int i = 0; i < kTileHeight; ++i) {
        for_each_pixel(eligible[t].rows[i], [&](int p) {
          keys[t].of[i][p] = static_cast<std::uint16_t>(ranks_.scrambled_unit(t, i, p) >> 16);
        });
      }
    });
    const Last last = take_greatest(keys, eligible, TileKeys::kMost, n);
    if (n <= 0) return;
    struct Tied {
      std::uint32_t unit, pixel;
      std::size_t t;
      int row, column;
    };
    std::vector<Tied> pixels;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      for (int i = 0; i < kTileHeight; ++i) {
        for_each_pixel(last.pixels[t].rows[i], [&](int p) {
          pixels.push_back({ranks_.scrambled_unit(t, i, p), ranks_.scrambled_pixel(t, i, p), t, i, p});
        });
      }
    }
    std::sort(pixels.begin(), pixels.end(),
              [](const Tied& a, const Tied& b) { return a.unit != b.unit ? a.unit > b.unit : a.pixel > b.pixel; });
    for (std::size_t i = 0; i < std::min(static_cast<std::size_t>(n), pixels.size()); ++i) {
      taken_[pixels[i].t].rows[pixels[i].row] |= std::uint64_t{1} << pixels[i].column;
    }
  }

  // Takes the eligible pixels of the greatest keys as long as all of the same key are among the first n, and lowers n
  // by their number. `most`: no key is greater.
  Last take_greatest(const std::vector<TileKeys>& keys, const Masks& eligible, unsigned most, std::int64_t& n) {
    unsigned key = 0;
    const auto descend = [&](const std::vector<std::int64_t>& counts) {  // the last digit of which any might be taken
      unsigned digit = Digits::kValues - 1;
      for (; digit > 0 && counts[digit] <= n; --digit) n -= counts[digit];
      return digit;
    };
    if (most >= Digits::kValues) {
      key = Digits::kValues * descend(digits(eligible, keys, [](unsigned k) { return k / Digits::kValues; }));
      Masks alike(tiles_.size());
      for_each_tile([&](std::size_t t) {
        if (eligible[t].any()) alike[t] = within(keys[t], eligible[t], key, key + Digits::kValues - 1);
      });
      key += descend(digits(alike, keys, [](unsigned k) { return k % Digits::kValues; }));
    } else {
      key = descend(digits(eligible, keys, [](unsigned k) { return k; }));
    }
    Last last{key, Masks(tiles_.size())};
    for_each_tile([&](std::size_t t) {
      if (!eligible[t].any()) return;
      add(within(keys[t], eligible[t], key + 1, TileKeys::kMost), taken_[t]);
      last.pixels[t] = within(keys[t], eligible[t], key, key);
    });
    return last;
  }

  template <typename Digit>
  std::vector<std::int64_t> digits(const Masks& of, const std::vector<TileKeys>& keys, Digit&& digit) const {
    tbb::enumerable_thread_specific<Digits> parts;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles_.size(), kGrain), [&](const auto& range) {
      Digits& part = parts.local();
      for (std::size_t t = range.begin(); t < range.end(); ++t) part.count(keys[t], of[t], digit);
    });
    std::vector<std::int64_t> sums(Digits::kValues);
    for (const Digits& part : parts) part.add_to(sums);
    return sums;
  }

  const std::vector<TileWork>& tiles_;
  const TileGrid grid_;
  const WaitingTimes& waiting_;
  const TileRanks ranks_;
  std::vector<TileKeys> waits_;  // once asked for
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
