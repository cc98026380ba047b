// How single sources are written: where no neighbour shares a source's kernel, making value rows and following lists of
// chains costs more than the edges do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scatter/kernel.h"

namespace pullfocus {

// What happens at two neighbouring columns: the level before them, that of the first, that of the second and on.
struct LevelPair {
  std::uint8_t before, first, second;
  bool operator==(const LevelPair&) const = default;
};

// The edges at columns dx and dx + 1 of row dy: values[first] - values[before] and values[second] - values[first] of
// the kind, values being the source's at the kernel's levels. Of a single edge, second == first.
struct EdgePair {
  std::int16_t dx, dy;
  std::uint8_t kind;
};

struct EdgePairs {
  static constexpr std::size_t kMostKinds = 256;
  static constexpr std::size_t kMostLevels = 256;

  // Row by row; no two of a row share a column. `row_begin` is of row dy at dy + radius_y.
  struct List {
    std::vector<EdgePair> pairs;
    std::vector<std::uint32_t> row_begin;
  };

  int radius_y = 0;
  std::vector<LevelPair> kinds;
  List of_columns[2];  // of single edges, of pairs

  bool empty() const noexcept { return kinds.empty(); }
  // Those with `columns` edges of rows [dy0, dy1), -radius_y <= dy0 <= dy1 <= radius_y + 1.
  std::span<const EdgePair> rows(int columns, int dy0, int dy1) const noexcept {
    const List& list = of_columns[columns - 1];
    const std::uint32_t begin = list.row_begin[static_cast<std::size_t>(dy0 + radius_y)];
    return {list.pairs.data() + begin, list.row_begin[static_cast<std::size_t>(dy1 + radius_y)] - begin};
  }
};

// Of what `kernel` spreads. Empty if that takes more kinds than kMostKinds.
EdgePairs pairs_of(const Kernel& kernel);

}  // namespace pullfocus
