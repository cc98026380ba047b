#include "scatter/scatter.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "scatter/emit.h"
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

// Sources are written in groups of equal kernel within windows of kWindow columns. Columns of a group that hold another
// kernel are written as zeros: that is cheaper than splitting the group.
template <int lanes>
void write_sources(const KernelTable& kernels, const GroupWriters<lanes>& writers, const Emission<lanes>* sources,
                   int count, int y, const BandImage& image, Band& band) {
  for (int i = 0; i < count;) {
    const Emission<lanes>* const window = sources + i;
    int in_window = 1;
    while (i + in_window < count && window[in_window].x < window->x + kWindow) ++in_window;
    std::uint32_t pending = (1u << in_window) - 1;
    while (pending != 0) {
      const int first = std::countr_zero(pending);
      std::uint32_t members = 0;
      for (int m = first; m < in_window; ++m) {
        members |= std::uint32_t{window[m].index == window[first].index} << m;
      }
      members &= pending;
      const int x = window[first].x, width = window[std::bit_width(members) - 1].x - x + 1;
      if (width > 2 * std::popcount(members)) members &= ~members + 1;  // too sparse: one at a time
      pending &= ~members;

      const auto write = writers.writer(std::popcount(members) == 1 ? 1 : width);
      write(kernels.kernel(window[first].index), window, members, x, y, image, band);
    }
    i += in_window;
  }
}

}  // namespace

namespace {

// The k-th image of a row beyond its left (k < 0) or right border, mirrored where k is odd.
struct RowImage {
  int k, width;
  int column(int x) const noexcept { return k % 2 == 0 ? x + k * width : (k + 1) * width - 1 - x; }

  // Those of `count` sources whose images lie within `reach` of the row, ascending in x.
  template <int lanes>
  int of(const Emission<lanes>* sources, int count, int reach, Emission<lanes>* out) const noexcept {
    int n = 0;
    for (int i = 0; i < count; ++i) {
      const Emission<lanes>& source = sources[k % 2 == 0 ? i : count - 1 - i];
      const int x = column(source.x);
      if (x < -reach || x >= width + reach) continue;
      out[n] = source;
      out[n++].x = x;
    }
    return n;
  }
};

}  // namespace

// Kernels that are their own mirror images may fall on the pads, which are folded back in. For others this would turn
// the light the wrong way round: there the sources are mirrored instead, and the pads are dropped.
template <int lanes, typename Write>
void Scatter::write_beyond(Band& band, const EmissionRow<lanes>& row, int y, int reach, const BandImage& image,
                           Write&& write) const {
  Emission<lanes> images[kTileWidth];
  const int most = reach / grid_.width + 1;
  for (int k = -most; k <= most; ++k) {
    if (k == 0) continue;
    const RowImage beyond{k, grid_.width};
    const auto write_images = [&](const Emission<lanes>* sources, int count) {
      const int n = beyond.of(sources, count, reach, images);
      if (n == 0) return;
      const int ya = std::max(image.y0, y - reach_y_.back()), yb = std::min(image.y1, y + reach_y_.back() + 1);
      const int row_a = image.band_row(ya), row_b = image.band_row(yb - 1);
      band.mark(std::min(row_a, row_b), std::max(row_a, row_b) + 1, images[0].x - reach, images[n - 1].x + reach + 2);
      write(images, n, k % 2 != 0);
    };
    write_images(row.emissions, row.count);
    write_images(row.removed, row.removed_count);
  }
}

// Of the committed pixels `mask` of a tile row: what they give to pixels that hide them.
template <int lanes>
void Scatter::write_hidden(Band& band, const Sources& sources, int x, int y, std::uint64_t mask, int reach,
                           const BandImage& image, bool fold) const {
  const Occlusion& occlusion = *sources.occlusion;
  const int window = occlusion.options().bitmap_size;
  const WriteHidden<lanes> write_one = hidden_writer<lanes>();
  const auto write = [&](const Emission<lanes>* emissions, int count, bool mirrored) {
    for (int i = 0; i < count; ++i) {
      const int column = mirror(emissions[i].x, grid_.width);
      const HiddenSource hidden{&occlusion.planes(),
                                occlusion.planes().keys(y)[column],
                                occlusion.near(occlusion.planes().sizes(y)[column]),
                                window,
                                mirrored ? 1 - window / 2 : -window / 2,
                                sources.frame == nullptr};
      write_one(kernels_.kernel(emissions[i].index), emissions[i], hidden, y, image, band);
    }
  };
  EmissionRow<lanes> row;
  const Sources committed{sources.state};
  dispatch(sources.state->colour.type(), [&]<SampleType type>() { collect<lanes, type>(committed, x, y, mask, row); });
  write(row.emissions, row.count, false);
  if (!fold) write_beyond(band, row, y, reach, image, write);
}

template <int lanes>
void Scatter::fill(Band& band, std::span<const TileWork> tiles, const Sources& sources,
                   const BandLayout& layout) const {
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

  const GroupWriters<lanes> writers = group_writers<lanes>(sources.frame != nullptr);
  EmissionRow<lanes> row;
  for (const BandImage& image : images) {
    for (const TileWork& work : tiles) {
      const int x = grid_.x(work.tile), y = grid_.y(work.tile);
      const TileMask::Bounds part = work.mask.bounds();
      const int rx = reach_x(work.max_index), ry = reach_y(work.max_index);
      const int ya = std::max(image.y0, y + part.y0 - ry), yb = std::min(image.y1, y + part.y1 + ry);
      if (ya >= yb) continue;
      const int row_a = image.band_row(ya), row_b = image.band_row(yb - 1);
      band.mark(std::min(row_a, row_b), std::max(row_a, row_b) + 1, x + part.x0 - rx, x + part.x1 + rx + 1);
      for (int i = part.y0; i < part.y1; ++i) {
        if (work.mask.rows[i] == 0 || y + i + ry < image.y0 || y + i - ry >= image.y1) continue;
        const std::uint64_t hidden =
            sources.occlusion != nullptr ? work.mask.rows[i] & sources.occlusion->columns(work.tile) : 0;
        if (hidden != 0) write_hidden<lanes>(band, sources, x, y + i, hidden, rx, image, layout.fold);
        if (!sources.is_plain) continue;
        dispatch(sources.state->colour.type(),
                 [&]<SampleType type>() { collect<lanes, type>(sources, x, y + i, work.mask.rows[i], row); });
        write_sources(kernels_, writers, row.emissions, row.count, y + i, image, band);
        write_sources(kernels_, writers, row.removed, row.removed_count, y + i, image, band);
        if (layout.fold) continue;
        write_beyond(band, row, y + i, rx, image, [&](const Emission<lanes>* emissions, int count, bool) {
          write_sources(kernels_, writers, emissions, count, y + i, image, band);
        });
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
  int largest = 0, y_first = grid_.height, y_last = 0;
  for (const LayerWork& layer : work) {
    for (const TileWork& tile : layer.tiles) {
      const int reach = reach_y(tile.max_index);
      const TileMask::Bounds part = tile.mask.bounds();
      largest = std::max(largest, tile.max_index);
      y_first = std::min(y_first, grid_.y(tile.tile) + part.y0 - reach);
      y_last = std::max(y_last, grid_.y(tile.tile) + part.y1 + reach);
    }
  }
  // Mirrored rows land no farther from the border than the reach beyond it, so these bounds hold them too.
  y_first = std::max(y_first, 0);
  y_last = std::min(y_last, grid_.height);
  if (y_first >= y_last) return;
  // Beyond the reach lies room for the last edge, and for the zeros that fill up a group of sources.
  const bool fold = kernels_.symmetric();
  const int pad = (fold ? 1 : 2) * reach_x(largest) + kWindow;
  const BandLayout layout{grid_.width, grid_.height, pad, lanes, fold};

  // Low bands feed all threads evenly, but the lower they are, the more of them visit a source.
  const int span = y_last - y_first;
  const int share = (span + 4 * threads - 1) / (4 * threads);
  const int band_rows = std::clamp(share, std::clamp(reach_y(largest) / 2, 8, 64), 128);
  const int band_count = (span + band_rows - 1) / band_rows;
  tbb::parallel_for(0, band_count, [&](int b) {
    std::vector<Band>& bands = bands_.local();
    bands.resize(std::max(bands.size(), work.size()));
    const int y0 = y_first + b * band_rows, y1 = std::min(y0 + band_rows, y_last);
    for (std::size_t l = 0; l < work.size(); ++l) {
      Sources of_layer = sources;
      of_layer.range = work[l].range;
      bands[l].begin(layout, y0, y1);
      if (lanes == kOpaqueLanes) {
        fill<kOpaqueLanes>(bands[l], work[l].tiles, of_layer, layout);
      } else {
        fill<kAlphaLanes>(bands[l], work[l].tiles, of_layer, layout);
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
  });
}

}  // namespace pullfocus
