// Which pixels of an image are to be resolved again.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace pullfocus {

// Dirty columns by row, in cells of 32. Rows may be marked by different threads at once, one row by one
// thread.
class DirtySpans {
 public:
  static constexpr int kCell = 32;

  void reset(int width, int height) {
    width_ = width;
    words_ = (static_cast<std::size_t>(width) + kCell * 64 - 1) / (kCell * 64);
    bits_.assign(words_ * static_cast<std::size_t>(height), 0);
  }

  void mark(int y, int x0, int x1) noexcept {
    std::uint64_t* row = bits_.data() + static_cast<std::size_t>(y) * words_;
    for (int cell = x0 / kCell; cell <= (x1 - 1) / kCell; ++cell) row[cell / 64] |= std::uint64_t{1} << (cell % 64);
  }

  // Pixels of all dirty cells, those past the right border included.
  std::int64_t pixels() const noexcept {
    std::int64_t cells = 0;
    for (const std::uint64_t word : bits_) cells += std::popcount(word);
    return cells * kCell;
  }

  // Calls visit(x0, x1) for every stretch of dirty columns of row y, and cleans the row.
  template <typename Visit>
  void drain_row(int y, Visit&& visit) {
    std::uint64_t* row = bits_.data() + static_cast<std::size_t>(y) * words_;
    const int cells = (width_ + kCell - 1) / kCell;
    const auto dirty = [&](int cell) { return cell < cells && (row[cell / 64] >> (cell % 64) & 1) != 0; };
    for (int cell = 0; cell < cells; ++cell) {
      if (!dirty(cell)) continue;
      int end = cell + 1;
      while (dirty(end)) ++end;
      visit(cell * kCell, end * kCell < width_ ? end * kCell : width_);
      cell = end;
    }
    for (std::size_t w = 0; w < words_; ++w) row[w] = 0;
  }

 private:
  int width_ = 0;
  std::size_t words_ = 0;
  std::vector<std::uint64_t> bits_;
};

}  // namespace pullfocus
