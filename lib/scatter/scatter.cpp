#include "scatter/scatter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <iterator>
#include <utility>

#include "scatter/blocks.h"
#include "scatter/edges.h"
#include "scatter/occluded_edges.h"
#include "scatter/occlusion.h"

namespace pullfocus {

Scatter::Scatter(const KernelTable& kernels, int width, int height) : kernels_(kernels), grid_{width, height} {
  int reach_x = 0, reach_y = 0;
  for (int i = 0; i < kernels.coc().size(); ++i) {
    reach_x = std::max(reach_x, kernels.kernel(i).radius_x);
    reach_y = std::max(reach_y, kernels.kernel(i).radius_y);
    reach_x_.push_back(reach_x);
    reach_y_.push_back(reach_y);
  }
}

namespace {

// Columns [first, last] of the image that hold the sources of a row.
template <int lanes>
struct Extent {
  int first, last;
  explicit Extent(const SourceRow<lanes>& row) noexcept
      : first(row.x + std::countr_zero(row.mask)), last(row.x + 63 - std::countl_zero(row.mask)) {}
};

// The k-th image of a row beyond its left (k < 0) or right border, mirrored where k is odd: those of its sources that
// lie within `reach` of the picture.
template <int lanes>
void image_of(const SourceRow<lanes>& row, RowKind kind, int k, int width, int reach, SourceRow<lanes>& out) noexcept {
  const bool mirrored = k % 2 != 0;
  out.x = mirrored ? (k + 1) * width - kTileWidth - row.x : row.x + k * width;
  out.mask = 0;
  std::fill(std::begin(out.index), std::end(out.index), kNeverCommitted);
  std::fill(std::begin(out.old), std::end(out.old), kNeverCommitted);
  for_each_pixel(row.mask, [&](int i) {
    const int to = mirrored ? kTileWidth - 1 - i : i, x = out.x + to;
    if (x < -reach || x >= width + reach) return;
    out.mask |= std::uint64_t{1} << to;
    out.index[to] = row.index[i];
    std::copy_n(row.plus + i * lanes, lanes, out.plus + to * lanes);
    if (kind != RowKind::plain) std::copy_n(row.minus + i * lanes, lanes, out.minus + to * lanes);
    if (kind == RowKind::moved) out.old[to] = row.old[i];
  });
}

}  // namespace

std::vector<Scatter::Placed> Scatter::placed(const LayerWork& layer) const {
  std::vector<Placed> tiles;
  tiles.reserve(layer.tiles.size());
  for (const TileWork& work : layer.tiles) {
    tiles.push_back({&work, grid_.x(work.tile), grid_.y(work.tile), reach_x(work.max_index), reach_y(work.max_index),
                     work.mask.bounds()});
  }
  return tiles;
}

// Kernels that are their own mirror images may fall on the pads, which are folded back in. For others this would turn
// the light the wrong way round: there the sources are mirrored instead, and the pads are dropped.
template <int lanes, typename Write>
void Scatter::write_beyond(Band& band, const SourceRow<lanes>& row, RowKind kind, int y, int reach,
                           const BandImage& image, Write&& write) const {
  SourceRow<lanes> beyond;
  const int most = reach / grid_.width + 1;
  for (int k = -most; k <= most; ++k) {
    if (k == 0 || row.mask == 0) continue;
    image_of(row, kind, k, grid_.width, reach, beyond);
    if (beyond.mask == 0) continue;
    const int ya = std::max(image.y0, y - reach_y_.back()), yb = std::min(image.y1, y + reach_y_.back() + 1);
    const int row_a = image.band_row(ya), row_b = image.band_row(yb - 1);
    const Extent extent(beyond);
    band.mark(std::min(row_a, row_b), std::max(row_a, row_b) + 1, extent.first - reach, extent.last + reach + 2);
    write(beyond, k % 2 != 0);
  }
}

// Of the committed pixels `mask` of a tile row: what they give to pixels that hide them.
template <int lanes>
void Scatter::write_hidden(Band& band, const Sources& sources, int x, int y, std::uint64_t mask, int reach,
                           const BandImage& image, bool fold) const {
  const Occlusion& occlusion = *sources.occlusion;
  const int window = occlusion.options().bitmap_size;
  const WriteHidden<lanes> write_one = hidden_writer<lanes>();
  const auto write = [&](const SourceRow<lanes>& row, bool mirrored) {
    for_each_pixel(row.mask, [&](int i) {
      Emission<lanes> emission{row.x + i, row.index[i], {}};
      std::copy_n(row.plus + i * lanes, lanes, emission.plus);
      const int column = mirror(emission.x, grid_.width);
      const HiddenSource hidden{&occlusion.planes(),
                                occlusion.planes().keys(y)[column],
                                occlusion.near(occlusion.planes().sizes(y)[column]),
                                window,
                                mirrored ? 1 - window / 2 : -window / 2,
                                sources.frame == nullptr};
      write_one(kernels_.kernel(emission.index), emission, hidden, y, image, band);
    });
  };
  RowSources<lanes> row;
  collect<lanes>(Sources{sources.state}, x, y, mask, row);
  write(row.added, false);
  if (!fold) write_beyond(band, row.added, RowKind::plain, y, reach, image, write);
}

// Of the selected pixels of a tile: those of kBlockRows rows from row `first` of the tile on.
template <int lanes>
void Scatter::write_lines(Band& band, const Placed& tile, int first, const Sources& sources, const BandImage& image,
                          bool fold, Scratch& scratch) const {
  const int x = tile.x, y = tile.y + first;
  Lines<lanes>& lines = scratch.template lines<lanes>();
  std::array<bool, kBlockRows> any{};
  for (std::size_t h = 0; h < kBlockRows; ++h) {
    const int row = static_cast<int>(h);
    const std::uint64_t mask = tile.work->mask.rows[first + row];
    const int away = std::max({image.y0 - (y + row), y + row - (image.y1 - 1), 0});  // from the band, in rows
    any[h] = mask != 0 && away <= tile.ry;
    if (!any[h]) continue;
    Sources reaching = sources;
    reaching.least = least_reaching(away);
    collect<lanes>(reaching, x, y + row, mask, lines[h]);
  }
  if (std::none_of(any.begin(), any.end(), [](bool is) { return is; })) return;
  const auto write = [&](SourceRow<lanes> RowSources<lanes>::*of_kind, RowKind kind) {
    SourceBlock<lanes> block{{}, {}, x, y};
    std::uint64_t columns = 0;
    for (std::size_t h = 0; h < kBlockRows; ++h) {
      block.rows[h] = &(lines[h].*of_kind);
      block.masks[h] = any[h] ? block.rows[h]->mask : 0;
      columns |= block.masks[h];
    }
    if (columns == 0) return;
    int count = 0;
    for (const std::uint64_t mask : block.masks) count += std::popcount(mask);
    if (count >= kFewestInBlock) block_writer<lanes>(kind)(kernels_, block, image, band, scratch.values);
    const WriteRow<lanes> write_row = row_writer<lanes>(kind);
    for (std::size_t h = 0; h < kBlockRows; ++h) {
      SourceRow<lanes>& row = lines[h].*of_kind;
      if (!any[h] || row.mask == 0) continue;
      const int at = y + static_cast<int>(h);
      const std::uint64_t all = std::exchange(row.mask, block.masks[h]);
      if (row.mask != 0) write_row(kernels_, row, at, image, band);
      row.mask = all;
      if (fold) continue;
      write_beyond(band, row, kind, at, tile.rx, image,
                   [&](const SourceRow<lanes>& beyond, bool) { write_row(kernels_, beyond, at, image, band); });
    }
  };
  write(&RowSources<lanes>::added, RowKind::plain);
  write(&RowSources<lanes>::taken_back, RowKind::plain);
  write(&RowSources<lanes>::recoloured, RowKind::recoloured);
  write(&RowSources<lanes>::moved, RowKind::moved);
}

// What write_lines() will read of a tile.
void Scatter::fetch_lines(const Placed& tile, int first, const Sources& sources) noexcept {
  for (int i = first; i < first + kBlockRows; ++i) {
    if (tile.work->mask.rows[i] != 0) fetch_ahead(sources, tile.x, tile.y + i);
  }
}

template <int lanes>
void Scatter::fill(Band& band, std::span<const Placed> tiles, const Sources& sources, const BandLayout& layout,
                   Scratch& scratch) const {
  // Every reflection of the band within reach of the image: index k counts borders crossed, downwards.
  std::vector<BandImage> images;
  const int h = layout.height, reach = reach_y_.empty() ? 0 : reach_y_.back();
  const int most = reach / h + 2;
  for (int k = -most; k <= most; ++k) {
    const bool flipped = k % 2 != 0;
    const int y0 = flipped ? (k + 1) * h - band.y1() : k * h + band.y0();
    const int y1 = y0 + band.y1() - band.y0();
    if (y0 < h + reach && y1 > -reach)
      images.push_back({y0, y1, flipped ? band.y1() - 1 : band.y0(), flipped ? -1 : 1});
  }

  for (const BandImage& image : images) {
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      const Placed& tile = tiles[t];
      const int ya = std::max(image.y0, tile.y + tile.part.y0 - tile.ry);
      const int yb = std::min(image.y1, tile.y + tile.part.y1 + tile.ry);
      if (ya >= yb) continue;
      const int row_a = image.band_row(ya), row_b = image.band_row(yb - 1);
      band.mark(std::min(row_a, row_b), std::max(row_a, row_b) + 1, tile.x + tile.part.x0 - tile.rx,
                tile.x + tile.part.x1 + tile.rx + 1);
      for (int i = tile.part.y0; i < tile.part.y1 && sources.occlusion != nullptr; ++i) {
        const int y = tile.y + i;
        if (y + tile.ry < image.y0 || y - tile.ry >= image.y1) continue;
        const std::uint64_t hidden = tile.work->mask.rows[i] & sources.occlusion->columns(tile.work->tile);
        if (hidden != 0) write_hidden<lanes>(band, sources, tile.x, y, hidden, tile.rx, image, layout.fold);
      }
      if (!sources.is_plain) continue;
      for (int i = 0; i < kTileHeight; i += kBlockRows) {
        if (t + 1 < tiles.size()) fetch_lines(tiles[t + 1], i, sources);
        write_lines<lanes>(band, tile, i, sources, image, layout.fold, scratch);
      }
    }
  }
}

void Scatter::run(std::span<const TileWork> tiles, const Sources& sources, int lanes, int threads, const Take& take) {
  const LayerWork all{0, sources.range, {tiles.begin(), tiles.end()}};
  run(std::span(&all, 1), sources, lanes, threads, [&](int y, std::span<const LayerRow> rows) {
    for (const ColumnSpan& span : rows[0].spans) {
      take(y, span.x0, span.x1, rows[0].values + static_cast<std::ptrdiff_t>(span.x0) * lanes);
    }
  });
}

void Scatter::run(std::span<const LayerWork> work, const Sources& sources, int lanes, int threads,
                  const TakeRow& take) {
  std::vector<std::vector<Placed>> tiles;
  for (const LayerWork& layer : work) tiles.push_back(placed(layer));
  int largest = 0, y_first = grid_.height, y_last = 0;
  for (const std::vector<Placed>& layer : tiles) {
    for (const Placed& tile : layer) {
      largest = std::max(largest, tile.work->max_index);
      y_first = std::min(y_first, tile.y + tile.part.y0 - tile.ry);
      y_last = std::max(y_last, tile.y + tile.part.y1 + tile.ry);
    }
  }
  // Mirrored rows land no farther from the border than the reach beyond it, so these bounds hold them too.
  y_first = std::max(y_first, 0);
  y_last = std::min(y_last, grid_.height);
  if (y_first >= y_last) return;
  // Beyond the reach lies room for the last edge, and for the zeros that fill up groups of sources and chains of edges.
  const bool fold = kernels_.symmetric();
  const int pad = (fold ? 1 : 2) * reach_x(largest) + kBlockColumns + BlockPlan::kMostSpread;
  const BandLayout layout{grid_.width, grid_.height, pad, lanes, fold};

  const int band_rows = band_height(y_last - y_first, reach_y(largest), static_cast<int>(work.size()), threads, layout);
  const int band_count = (y_last - y_first + band_rows - 1) / band_rows;
  // Column by column, what a column of tiles reaches of a band stays in the second cache, where large kernels reach the
  // same accumulators from many tile rows.
  for (std::vector<Placed>& layer : tiles) {
    if (reach_y(largest) >= kReachOfColumns) {
      std::stable_sort(layer.begin(), layer.end(), [](const Placed& a, const Placed& b) { return a.x < b.x; });
    }
  }
  const auto write_band = [&](int b) {
    Scratch& scratch = scratch_.local();
    std::vector<Band>& bands = scratch.bands;
    bands.resize(std::max(bands.size(), work.size()));
    const int y0 = y_first + b * band_rows, y1 = std::min(y0 + band_rows, y_last);
    for (std::size_t l = 0; l < work.size(); ++l) {
      Sources of_layer = sources;
      of_layer.range = work[l].range;
      bands[l].begin(layout, y0, y1);
      if (lanes == kOpaqueLanes) {
        fill<kOpaqueLanes>(bands[l], tiles[l], of_layer, layout, scratch);
      } else {
        fill<kAlphaLanes>(bands[l], tiles[l], of_layer, layout, scratch);
      }
    }
    std::vector<std::vector<ColumnSpan>> spans(work.size());
    std::vector<LayerRow> rows;
    for (int y = y0; y < y1; ++y) {
      rows.clear();
      for (std::size_t l = 0; l < work.size(); ++l) {
        bands[l].finish_row(y, spans[l]);
        if (!spans[l].empty()) rows.push_back({work[l].layer, bands[l].row(y), spans[l]});
      }
      if (!rows.empty()) take(y, rows);
      for (std::size_t l = 0; l < work.size(); ++l) bands[l].clear_row(y, spans[l]);
    }
  };
  // Whoever is free takes the next one: there are too few of them to be dealt out beforehand.
  std::atomic<int> next{0};
  tbb::parallel_for(
      0, std::min(threads, band_count),
      [&](int) {
        for (int b = next++; b < band_count; b = next++) write_band(b);
      },
      tbb::simple_partitioner());
}

}  // namespace pullfocus
