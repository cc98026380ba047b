#include "scatter/occlusion_flips.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "scatter/source_row.h"

namespace pullfocus {

namespace {

// Number of the image of [0, size) that x lies in, 0 the picture itself; odd ones are mirrored.
int image_of(int x, int size) noexcept { return (x >= 0 ? x : x - size + 1) / size; }

struct DepthAndSize {
  std::uint16_t key;
  int size;
  bool operator==(const DepthAndSize&) const = default;
};

template <SampleType type>
class Flips {
 public:
  Flips(const std::vector<TileWork>& tiles, const Sources& sources, DepthKind kind, const KernelTable& kernels,
        int lanes, const AddAtPixel& add)
      : sources_(sources),
        occlusion_(*sources.occlusion),
        planes_(occlusion_.planes()),
        kind_(kind),
        kernels_(kernels),
        lanes_(lanes),
        add_(add),
        half_(occlusion_.options().bitmap_size / 2),
        grid_{planes_.width(), planes_.height()},
        masks_(static_cast<std::size_t>(grid_.count())) {
    for (const TileWork& work : tiles) masks_[static_cast<std::size_t>(work.tile)] = &work.mask;
  }

  void of_tile(const TileWork& work) const {
    const Window& window = sources_.frame->window();
    for (int i = 0; i < kTileHeight; ++i) {
      for_each_pixel(work.mask.rows[i], [&](int p) {
        const int x = grid_.x(work.tile) + p, y = grid_.y(work.tile) + i;
        const DepthAndSize was{planes_.keys(y)[x], planes_.sizes(y)[x]};
        const std::int16_t index = sources_.pending[position(x, y)];
        const std::uint16_t key = depth_key(kind_, sources_.frame->depth.at(window.x0 + x, window.y0 + y));
        const DepthAndSize is{key_unless_held_out(key, index), reach_index(index)};
        if (was == is || !occlusion_.may_hide(x, y, was.key, is.key, was.size, is.size)) return;
        Accumulator change[kAlphaLanes] = {};
        if (of_pixel(x, y, was, is, change)) add_(y, x, change);
      });
    }
  }

 private:
  std::size_t position(int x, int y) const noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.width) + static_cast<std::size_t>(x);
  }

  // Sources around U as the picture goes on: an offset from a mirrored one to U is the mirrored offset from the source
  // to an image of U.
  bool of_pixel(int x, int y, const DepthAndSize& was, const DepthAndSize& is, Accumulator* change) const {
    bool any = false;
    const int rows = occlusion_.rows_around(x, y);
    for (int py = y - rows; py <= y + rows; ++py) {
      const bool mirrored = image_of(py, grid_.height) % 2 != 0;
      if (py == (mirrored ? y + half_ : y - half_)) continue;  // the window's far end
      const int row = mirror(py, grid_.height);
      for (int begin = x - half_; begin <= x + half_;) {
        const int image = image_of(begin, grid_.width), end = std::min((image + 1) * grid_.width, x + half_ + 1);
        const int a = image % 2 == 0 ? std::max(begin, x - half_ + 1) : begin;
        const int b = image % 2 == 0 ? end : std::min(end, x + half_);
        begin = end;
        if (a >= b) continue;
        const std::uint16_t *keys = planes_.keys(row) + a, *sizes = planes_.sizes(row) + a;
        const std::uint64_t before = hidden_from(keys, sizes, b - a, was.key, occlusion_.near(was.size));
        const std::uint64_t after = hidden_from(keys, sizes, b - a, is.key, occlusion_.near(is.size));
        for_each_pixel(before ^ after, [&](int i) {
          any |= give(mirror(a + i, grid_.width), row, x - a - i, y - py, (after >> i & 1) != 0, change);
        });
      }
    }
    return any;
  }

  // Of source (px, py), what its kernel gives at an offset.
  bool give(int px, int py, int dx, int dy, bool taken, Accumulator* change) const {
    const TileMask* selected = masks_[static_cast<std::size_t>(py / kTileHeight * grid_.columns() + px / kTileWidth)];
    if (selected != nullptr && (selected->rows[py % kTileHeight] >> (px % kTileWidth) & 1) != 0) return false;
    const std::int16_t index = sources_.state->index[position(px, py)];
    if (!is_source(index)) return false;
    const std::int64_t weight = kernels_.kernel(index).weight(dx, dy);
    if (weight == 0) return false;
    const Window& window = sources_.state->colour.window();
    double values[kAlphaLanes];
    colour_lanes<kAlphaLanes>(load_pixel<type>(sources_.state->colour.pixel(window.x0 + px, window.y0 + py)), values);
    for (int lane = 0; lane < lanes_; ++lane) {
      const auto given = static_cast<Accumulator>(std::llrint(values[lane] * static_cast<double>(weight)));
      change[lane] += taken ? Accumulator{0} - given : given;
    }
    return true;
  }

  const Sources& sources_;
  const Occlusion& occlusion_;
  const DepthPlanes& planes_;
  const DepthKind kind_;
  const KernelTable& kernels_;
  const int lanes_;
  const AddAtPixel& add_;
  const int half_;
  const TileGrid grid_;
  std::vector<const TileMask*> masks_;  // by tile; null: no pixel of it
};

}  // namespace

void correct_flips(const std::vector<TileWork>& tiles, const Sources& sources, DepthKind kind,
                   const KernelTable& kernels, int lanes, const AddAtPixel& add) {
  const TileGrid grid{sources.occlusion->planes().width(), sources.occlusion->planes().height()};
  std::vector<std::vector<const TileWork*>> rows(static_cast<std::size_t>(grid.rows()));
  for (const TileWork& work : tiles) rows[static_cast<std::size_t>(work.tile / grid.columns())].push_back(&work);
  dispatch(sources.state->colour.type(), [&]<SampleType type>() {
    const Flips<type> flips(tiles, sources, kind, kernels, lanes, add);
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t r) {
      for (const TileWork* work : rows[r]) flips.of_tile(*work);
    });
  });
}

}  // namespace pullfocus
