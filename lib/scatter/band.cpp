#include "scatter/band.h"

#include "scatter/sums.h"

namespace pullfocus {

namespace {

constexpr int kLeastHeight = 8, kMostHeight = 128;
constexpr int kLeastOfCaches = 64;            // rows of all layers, however few the caches hold
constexpr std::size_t kBandBytes = 11 << 19;  // of sums: a thread's part of caches that several share

// An odd number of cache lines a row keeps the rows of one kernel out of the same cache sets.
std::size_t stride_of(const BandLayout& layout) noexcept {
  constexpr std::size_t line = 64 / sizeof(Accumulator);
  const auto values = static_cast<std::size_t>((layout.width + 2 * layout.pad) * layout.lanes);
  return ((values + line - 1) / line | 1) * line;
}

}  // namespace

int band_height(int span, int reach, int layers, int threads, const BandLayout& layout) noexcept {
  const auto up = [](int a, int b) { return (a + b - 1) / b; };
  const auto in_caches = static_cast<int>(kBandBytes / (stride_of(layout) * sizeof(Accumulator))) / layers;
  const int least = std::clamp(reach * 5 / 2, std::max(kLeastOfCaches / layers, kLeastHeight), kMostHeight);
  const int most = std::clamp(in_caches, least, kMostHeight);
  const int quarter = up(span, 4 * threads), eighth = up(span, 8 * threads);
  const int even = threads == 1 ? quarter : std::max(eighth, std::min(2 * reach, quarter));
  const int high = std::clamp(even, std::clamp(reach / 2, kLeastHeight, 64), most);
  return up(span, up(span, high * threads) * threads);
}

void Band::begin(const BandLayout& layout, int y0, int y1) {
  layout_ = layout;
  y0_ = y0;
  y1_ = y1;
  const auto padded = static_cast<std::size_t>(layout.width + 2 * layout.pad);
  stride_ = stride_of(layout);
  words_ = (padded + kCell * 64 - 1) / (kCell * 64);
  const auto rows = static_cast<std::size_t>(y1 - y0);
  values_.resize(std::max(values_.size(), rows * stride_));  // finished rows are zero already
  dirty_.assign(rows * words_, 0);
}

void Band::mark(int ya, int yb, int x0, int x1) noexcept {
  ya = std::max(ya, y0_);
  yb = std::min(yb, y1_);
  const int first = (std::max(x0, -layout_.pad) + layout_.pad) / kCell;
  const int last = (std::min(x1, layout_.width + layout_.pad) - 1 + layout_.pad) / kCell;
  for (int y = ya; y < yb; ++y) {
    std::uint64_t* bits = cells(y);
    for (int word = first / 64; word <= last / 64; ++word) {
      const int low = std::max(first - word * 64, 0), high = std::min(last - word * 64, 63);
      bits[word] |= (~std::uint64_t{0} >> (63 - (high - low))) << low;
    }
  }
}

void Band::integrate(Accumulator* first, int columns) noexcept { prefix_sum(first, columns, layout_.lanes); }

void Band::fold(Accumulator* image_row, int from, int to) noexcept {
  const int lanes = layout_.lanes;
  const auto fold_column = [&](int x) {
    Accumulator* out = image_row + static_cast<std::ptrdiff_t>(x) * lanes;
    Accumulator* in = image_row + static_cast<std::ptrdiff_t>(mirror(x, layout_.width)) * lanes;
    for (int c = 0; c < lanes; ++c) {
      in[c] += out[c];
      out[c] = 0;
    }
  };
  for (int x = from; x < std::min(to, 0); ++x) fold_column(x);
  for (int x = std::max(from, layout_.width); x < to; ++x) fold_column(x);
}

void Band::finish_row(int y, std::vector<ColumnSpan>& spans) {
  spans.clear();
  const std::uint64_t* const bits = cells(y);
  Accumulator* const image_row = row(y);
  const int cell_count = (layout_.width + 2 * layout_.pad + kCell - 1) / kCell;
  const auto is_dirty = [&](int cell) { return (bits[cell / 64] >> (cell % 64) & 1) != 0; };
  for (int cell = 0; cell < cell_count; ++cell) {
    if (!is_dirty(cell)) continue;
    int end = cell + 1;
    while (end < cell_count && is_dirty(end)) ++end;
    // Every source's footprint lies in one stretch of dirty cells, and so does its mirror image (a source at
    // x >= 0 that reaches down to x - r < 0 is mirrored to at most r - x - 1 < x + r): sums begin and end at
    // 0.
    const int from = cell * kCell - layout_.pad;
    const int to = std::min(end * kCell - layout_.pad, layout_.width + layout_.pad);
    integrate(image_row + static_cast<std::ptrdiff_t>(from) * layout_.lanes, to - from);
    if (layout_.fold) {
      fold(image_row, from, to);
    } else {
      clear(image_row, from, std::min(to, 0));
      clear(image_row, std::max(from, layout_.width), to);
    }
    const int x0 = std::max(from, 0), x1 = std::min(to, layout_.width);
    if (x0 < x1) spans.push_back({x0, x1});
    cell = end;
  }
}

void Band::clear_row(int y, std::span<const ColumnSpan> spans) noexcept {
  for (const ColumnSpan& span : spans) clear(row(y), span.x0, span.x1);
  std::fill_n(cells(y), words_, std::uint64_t{0});
}

}  // namespace pullfocus
