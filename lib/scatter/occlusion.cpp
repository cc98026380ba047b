#include "scatter/occlusion.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

namespace pullfocus {

namespace {

void hold_out(const std::int16_t* index, int n, std::uint16_t* keys) noexcept {
  for (int i = 0; i < n; ++i) keys[i] = key_unless_held_out(keys[i], index[i]);
}

}  // namespace

Occlusion::Occlusion(const VisibilityOptions& options, const KernelTable& kernels, int width, int height)
    : options_(options),
      kernels_(kernels),
      grid_{width, height},
      cells_x_((width + kCell - 1) / kCell),
      cells_y_(grid_.rows()),
      around_((options.bitmap_size / 2 + kCell - 1) / kCell) {
  const CocTable& coc = kernels.coc();
  int reach = 0;
  for (int size = 0; size < coc.size(); ++size) {
    const auto is_near = [&](int other) {
      return std::fabs(coc.diameter(size) - coc.diameter(other)) <= options.cutoff_px;
    };
    int first = size, last = size;
    while (first > 0 && is_near(first - 1)) --first;
    while (last + 1 < coc.size() && is_near(last + 1)) ++last;
    near_.push_back({static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(last - first)});
    reach = std::max({reach, kernels.kernel(size).radius_x, kernels.kernel(size).radius_y});
    reach_.push_back(reach);
  }
  reset();
}

void Occlusion::reset() {
  planes_.reset(grid_.width, grid_.height);
  const Bounds background{kBackgroundKey, kBackgroundKey, 0, 0};
  cells_.assign(cell(0, cells_y_), background);
  neighbourhoods_ = cells_;
  columns_.assign(static_cast<std::size_t>(grid_.count()), 0);
  whole_need_ = {};
}

void Occlusion::Bounds::add(const Bounds& other) noexcept {
  key_min = std::min(key_min, other.key_min);
  key_max = std::max(key_max, other.key_max);
  size_min = std::min(size_min, other.size_min);
  size_max = std::max(size_max, other.size_max);
}

void Occlusion::take_row(const Frame& frame, DepthKind kind, const SourceState& state, const TileWork& work,
                         int row) noexcept {
  const int x = grid_.x(work.tile), y = grid_.y(work.tile) + row, n = grid_.tile_width(work.tile);
  const std::int16_t* index = &state.index[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.width) + x];
  std::uint16_t key[kTileWidth];
  depth_keys(kind, frame.depth.row(frame.window().y0 + y) + x, n, key);
  std::uint16_t *const keys = planes_.keys(y) + x, *const sizes = planes_.sizes(y) + x;
  const std::uint64_t mask = work.mask.rows[row];
  if (state.may_hold_out) hold_out(index, n, key);
  if (mask == first_pixels(n)) {
    std::copy_n(key, n, keys);
    for (int i = 0; i < n; ++i) sizes[i] = static_cast<std::uint16_t>(reach_index(index[i]));
  } else {
    for_each_pixel(mask, [&](int i) {
      keys[i] = key[i];
      sizes[i] = static_cast<std::uint16_t>(reach_index(index[i]));
    });
  }
}

Occlusion::Bounds Occlusion::bounds_of(int cx, int cy) const noexcept {
  const int y = cy * kCell, rows = std::min(kCell, grid_.height - y);
  const int n = std::min(kCell, grid_.width - cx * kCell), x0 = cx * kCell;
  if (n == kCell) {
    const ValueRange key = range_of_cell(planes_.keys(y) + x0, planes_.stride(), rows);
    const ValueRange size = range_of_cell(planes_.sizes(y) + x0, planes_.stride(), rows);
    return {key.least, key.most, size.least, size.most};
  }
  Bounds bounds;
  for (int i = 0; i < rows; ++i) {
    const std::uint16_t *keys = planes_.keys(y + i) + x0, *sizes = planes_.sizes(y + i) + x0;
    for (int x = 0; x < n; ++x) bounds.add({keys[x], keys[x], sizes[x], sizes[x]});
  }
  return bounds;
}

// Mirrored pixels beyond a border lie within the same reach on this side of it.
void Occlusion::look_around(int cx, int cy) noexcept {
  Bounds around;
  for (int y = std::max(cy - around_, 0); y <= std::min(cy + around_, cells_y_ - 1); ++y) {
    for (int x = std::max(cx - around_, 0); x <= std::min(cx + around_, cells_x_ - 1); ++x)
      around.add(cells_[cell(x, y)]);
  }
  neighbourhoods_[cell(cx, cy)] = around;
  const Bounds& own = cells_[cell(cx, cy)];
  const NearSizes smallest = near_[own.size_min], largest = near_[own.size_max];
  const bool needed = reach_[own.size_max] > 0 && own.key_max > around.key_min &&
                      (around.size_min < largest.first || around.size_max > smallest.first + smallest.span);
  const int tile = cy * grid_.columns() + cx * kCell / kTileWidth;
  const std::uint64_t bits = first_pixels(kCell) << (cx * kCell % kTileWidth);
  std::uint64_t& columns = columns_[static_cast<std::size_t>(tile)];
  columns = needed ? columns | bits : columns & ~bits;
}

void Occlusion::take(const Frame& frame, DepthKind kind, const SourceState& state, std::span<const TileWork> tiles) {
  constexpr int cells = kTileWidth / kCell;
  std::vector<std::uint8_t> is_row_taken(static_cast<std::size_t>(cells_y_)), looks(is_row_taken.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), kTilesTogether / 8), [&](const auto& range) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) {
      const int tile = tiles[t].tile, cy = tile / grid_.columns(), cx = tile % grid_.columns() * cells;
      for (int i = 0; i < kTileHeight; ++i) {
        if (tiles[t].mask.rows[i] != 0) take_row(frame, kind, state, tiles[t], i);
      }
      for (int c = cx; c < std::min(cx + cells, cells_x_); ++c) cells_[cell(c, cy)] = bounds_of(c, cy);
    }
  });
  for (const TileWork& work : tiles) {
    const int cy = work.tile / grid_.columns();
    is_row_taken[static_cast<std::size_t>(cy)] = 1;
    for (int y = std::max(cy - around_, 0); y <= std::min(cy + around_, cells_y_ - 1); ++y) {
      looks[static_cast<std::size_t>(y)] = 1;
    }
  }
  tbb::parallel_for(0, cells_y_, [&](int cy) {
    if (is_row_taken[static_cast<std::size_t>(cy)] != 0) {
      for (int y = cy * kCell; y < std::min((cy + 1) * kCell, grid_.height); ++y) planes_.mirror_margins(y);
    }
    if (looks[static_cast<std::size_t>(cy)] == 0) return;
    for (int cx = 0; cx < cells_x_; ++cx) look_around(cx, cy);
  });
  whole_need_ = {};
  for (int tile = 0; tile < grid_.count(); ++tile) {
    if (columns(tile) == 0) continue;
    TileWork work{tile, 0, {}};
    std::fill_n(work.mask.rows, grid_.tile_height(tile), first_pixels(grid_.tile_width(tile)));
    const Need added = need({&work, 1});
    whole_need_.pixels += added.pixels;
    whole_need_.rows += added.rows;
  }
}

std::uint64_t Occlusion::changed_keys(DepthKind kind, const float* depth, const std::int16_t* index, int x, int y,
                                      int n) const noexcept {
  std::uint16_t key[kTileWidth];
  depth_keys(kind, depth, n, key);
  if (index != nullptr) hold_out(index, n, key);
  const std::uint16_t* const committed = planes_.keys(y) + x;
  if (std::equal(key, key + n, committed)) return 0;
  std::uint64_t changed = 0;
  for (int i = 0; i < n; ++i) changed |= std::uint64_t{key[i] != committed[i]} << i;
  return changed;
}

bool Occlusion::may_hide(int x, int y, std::uint16_t key_a, std::uint16_t key_b, int size_a,
                         int size_b) const noexcept {
  const Bounds& around = neighbourhoods_[cell(x / kCell, y / kCell)];
  const NearSizes smaller = near(std::min(size_a, size_b)), larger = near(std::max(size_a, size_b));
  return around.key_max > std::min(key_a, key_b) &&
         (around.size_min < larger.first || around.size_max > smaller.first + smaller.span);
}

int Occlusion::rows_around(int x, int y) const noexcept {
  return std::min(reach_[neighbourhoods_[cell(x / kCell, y / kCell)].size_max], options_.bitmap_size / 2);
}

std::int64_t Occlusion::rows_of(const Bounds& bounds) const noexcept {
  return std::min(2 * reach_[bounds.size_max] + 1, options_.bitmap_size);
}

Occlusion::Need Occlusion::need(std::span<const TileWork> tiles) const noexcept {
  Need sum;
  for (const TileWork& work : tiles) {
    for (int c = 0; c < kTileWidth / kCell; ++c) {
      const std::uint64_t bits = columns(work.tile) & first_pixels(kCell) << (c * kCell);
      if (bits == 0) continue;
      std::int64_t pixels = 0;
      for (const std::uint64_t row : work.mask.rows) pixels += std::popcount(row & bits);
      sum.pixels += pixels;
      sum.rows += pixels * rows_of(cells_[cell(grid_.x(work.tile) / kCell + c, work.tile / grid_.columns())]);
    }
  }
  return sum;
}

std::size_t Occlusion::bytes() const noexcept {
  return planes_.bytes() + (cells_.size() + neighbourhoods_.size()) * sizeof(Bounds) +
         columns_.size() * sizeof columns_[0];
}

std::vector<TileWork> Occlusion::needing(std::span<const TileWork> tiles) const {
  std::vector<TileWork> result;
  for (TileWork work : tiles) {
    for (std::uint64_t& row : work.mask.rows) row &= columns(work.tile);
    if (work.mask.any()) result.push_back(work);
  }
  return result;
}

}  // namespace pullfocus
