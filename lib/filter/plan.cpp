#include "filter/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "filter/core.h"
#include "importance/slices.h"

namespace pullfocus {

namespace {

void measure_coc(const Frame& frame, const CocFunction& coc, const CocTable& table, Plan& plan) {
  plan.coc_min = std::numeric_limits<float>::infinity();
  plan.coc_max = -plan.coc_min;
  plan.index_min = table.size();
  plan.index_max = -table.size();
  const Window& w = frame.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      const float depth = frame.depth.at(x, y);
      const bool background = is_background(coc.kind, depth);
      const float c = background ? coc.background() : coc(depth);
      plan.background += background;
      plan.held_out += frame.holds_out(x, y);
      plan.coc_min = std::min(plan.coc_min, c);
      plan.coc_max = std::max(plan.coc_max, c);
      plan.index_min = std::min<int>(plan.index_min, table.index(c));
      plan.index_max = std::max<int>(plan.index_max, table.index(c));
    }
  }
}

std::vector<Plan::Layer> measure_layers(const FilterOptions& options, const KernelTable& kernels,
                                        const SourceState& state, const std::vector<TileWork>& tiles) {
  const Layers layers(kernels.coc(), layer_borders(options.visibility));
  const Window& w = state.colour.window();
  const Scatter scatter(kernels, w.width(), w.height());
  const TileGrid grid{w.width(), w.height()};
  std::vector<Plan::Layer> found;
  for (const LayerWork& work : by_layer(tiles, layers, state, nullptr)) {
    Plan::Layer layer{kernels.coc().signed_diameter(work.range.first), kernels.coc().signed_diameter(work.range.last),
                      0, 0};
    std::vector<bool> reached(static_cast<std::size_t>(grid.count()));
    for (const TileWork& tile : work.tiles) {
      layer.pixels += tile.mask.count();
      const TileMask::Bounds part = tile.mask.bounds();
      const int rx = scatter.reach_x(tile.max_index), ry = scatter.reach_y(tile.max_index);
      const int x0 = std::max(grid.x(tile.tile) + part.x0 - rx, 0) / kTileWidth;
      const int x1 = std::min(grid.x(tile.tile) + part.x1 + rx, w.width()) - 1;
      const int y1 = std::min(grid.y(tile.tile) + part.y1 + ry, w.height()) - 1;
      for (int y = std::max(grid.y(tile.tile) + part.y0 - ry, 0) / kTileHeight; y <= y1 / kTileHeight; ++y) {
        for (int x = x0; x <= x1 / kTileWidth; ++x) reached[static_cast<std::size_t>(y * grid.columns() + x)] = true;
      }
    }
    layer.reached =
        static_cast<double>(std::count(reached.begin(), reached.end(), true)) / static_cast<double>(grid.count());
    found.push_back(layer);
  }
  return found;
}

}  // namespace

Plan make_plan(const FilterOptions& options, const KernelTable& kernels, const Frame& frame, const CocFunction& coc,
               const Frame* next, const CocFunction& next_coc) {
  Plan plan;
  plan.window = frame.window();
  plan.table_size = kernels.coc().size();
  measure_coc(frame, coc, kernels.coc(), plan);

  const Sanitiser sanitiser(kernels.options().max_radiance);
  SourceState state;
  state.reset(frame.window(), frame.colour.type());
  std::vector<TileWork> tiles;
  const Committed all = commit_all(frame, coc, kernels, sanitiser, state, tiles);
  plan.clamped_coc = all.findings.coc_clamped;
  plan.alpha = !all.opaque;
  plan.linear_edges = all.edges;

  const double colour = static_cast<double>(frame.colour.pixel_bytes());
  const int lanes = all.opaque ? kOpaqueLanes : kAlphaLanes;
  plan.layers = measure_layers(options, kernels, state, tiles);
  double sums = 0;
  for (const Plan::Layer& layer : plan.layers) sums += layer.reached * lanes * 8.;
  double in_front = 0;  // share of the tiles in which something may be seen behind
  for (const Plan::Layer& layer : plan.layers) in_front += layer.coc_last < 0 ? layer.reached : 0;
  if (plan.layers.size() > 1) sums += std::min(in_front, 1.) * sizeof(Backdrop::Chunk) / Backdrop::kChunk;
  plan.state_bytes_per_pixel = sums + colour + 2 + 2 + 4 + 3. / 8;  // sums, colour, index, pending index, depth, masks
  plan.frame_bytes_per_pixel =
      colour + 4 + 4. * static_cast<double>(sample_bytes(options.output_type.value_or(frame.colour.type())));

  std::optional<Occlusion> occlusion;
  plan.tiles = static_cast<int>(tiles.size());
  if (options.visibility.kind == VisibilityOptions::Kind::bitmap) {
    occlusion.emplace(options.visibility, kernels, plan.window.width(), plan.window.height());
    occlusion->take(frame, coc.kind, state, tiles);
    plan.bitmap_tiles = static_cast<int>(occlusion->needing(tiles).size());
    plan.bitmap_pixels = occlusion->need().pixels;
    plan.state_bytes_per_pixel +=
        static_cast<double>(occlusion->bytes()) / static_cast<double>(frame.window().pixels());
  }

  if (next != nullptr && next->window() == frame.window() && next->colour.type() == frame.colour.type()) {
    std::vector<std::int16_t> pending(frame.window().pixels());
    const Changes changes = find_changes(*next, next_coc, kernels.coc(), sanitiser, state, options.thresholds, pending,
                                         occlusion ? &*occlusion : nullptr);
    plan.changed_share = static_cast<double>(changes.pixels) / static_cast<double>(frame.window().pixels());
    plan.next_edges = count_edges(changes.tiles, {*next, state, pending, kernels, sanitiser, state.colour}).written;
  }
  return plan;
}

}  // namespace pullfocus
