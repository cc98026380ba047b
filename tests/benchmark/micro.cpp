// Times of the filter's inner steps, with Google Benchmark: `micro --benchmark_filter=Edges`. Names say the step, the
// method and the size of its input; bytes and items are those that the step reads or writes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <iterator>
#include <random>

#include "importance/segment.h"
#include "importance/select.h"
#include "resolve/resolve.h"
#include "scatter/blocks.h"
#include "scatter/edges.h"
#include "scatter/sums.h"

namespace pullfocus {
namespace {

constexpr CocFunction kPlanar{DepthKind::planar, 40, 0.5f};
constexpr int kRow = 1920;  // pixels

const KernelTable& discs() {
  static const KernelTable table{KernelOptions{}};
  return table;
}

Frame noise(int width, int height) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  Frame frame{ColourImage({0, 0, width, height}, SampleType::half), Plane({0, 0, width, height}, 0), false};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      frame.depth.at(x, y) = 1 + 9 * uniform(random);
      for (int c = 0; c < 3; ++c) frame.colour.set(x, y, c, uniform(random));
      frame.colour.set(x, y, 3, 1);
    }
  }
  return frame;
}

const Pixel<SampleType::half>* row_of(const Frame& frame, int y) {
  return reinterpret_cast<const Pixel<SampleType::half>*>(frame.colour.pixel(0, y));
}

// A tile row against what is committed there; `changed`: all of its colours and depths differ.
void detect_tile_row(benchmark::State& state, bool changed, bool known) {
  const Frame frame = noise(kTileWidth, 2);
  const DepthToIndex to_index(kPlanar, discs().coc());
  std::int16_t old_index[kTileWidth], index[kTileWidth];
  signed_indices(to_index, frame.depth.row(changed ? 1 : 0), kTileWidth, old_index);
  const SegmentPair<SampleType::half> pair{frame.depth.row(0), row_of(frame, 0), row_of(frame, changed ? 1 : 0),
                                           old_index,          kTileWidth,       known ? frame.depth.row(0) : nullptr};
  SegmentDifference difference;
  for (auto _ : state) {
    benchmark::DoNotOptimize(compare<SampleType::half>(to_index, pair, index, difference));
    benchmark::DoNotOptimize(difference);
  }
  state.SetItemsProcessed(state.iterations() * kTileWidth);
}
BENCHMARK_CAPTURE(detect_tile_row, known, false, true);
BENCHMARK_CAPTURE(detect_tile_row, unchanged, false, false);
BENCHMARK_CAPTURE(detect_tile_row, changed, true, false);

// As many tile rows side by side as a picture of 1920 columns has, nothing changed, all depths known.
void detect_unchanged_row(benchmark::State& state) {
  constexpr int count = 1920 / kTileWidth;
  const Frame frame = noise(count * kTileWidth, 1), committed = frame;
  const SegmentPair<SampleType::half> first{frame.depth.row(0), row_of(frame, 0),      row_of(committed, 0), nullptr,
                                            kTileWidth,         committed.depth.row(0)};
  for (auto _ : state) benchmark::DoNotOptimize(unchanged_segments<SampleType::half>(first, count));
  state.SetItemsProcessed(state.iterations() * count * kTileWidth);
}
BENCHMARK(detect_unchanged_row);

void coc_of_tile_row(benchmark::State& state) {
  const Frame frame = noise(kTileWidth, 1);
  const DepthToIndex to_index(kPlanar, discs().coc());
  std::int16_t index[kTileWidth];
  for (auto _ : state) {
    benchmark::DoNotOptimize(signed_indices(to_index, frame.depth.row(0), kTileWidth, index));
    benchmark::DoNotOptimize(index);
  }
  state.SetItemsProcessed(state.iterations() * kTileWidth);
}
BENCHMARK(coc_of_tile_row);

// Neighbouring sources of one radius, all rows of the kernel; moved: from the next smaller index of the table. Items
// are edges times sources.
void edges_of_sources(benchmark::State& state, RowKind kind) {
  const int count = static_cast<int>(state.range(0)), radius = static_cast<int>(state.range(1));
  const int index = discs().coc().index(2 * static_cast<float>(radius));
  const Kernel& kernel = discs().kernel(index);
  Band band;
  const int height = 2 * kernel.radius_y + 1;
  band.begin({kRow, height, kernel.radius_x + kWindow, kOpaqueLanes}, 0, height);
  SourceRow<kOpaqueLanes> sources;
  sources.x = kRow / 2;
  sources.mask = first_pixels(count);
  std::fill(std::begin(sources.index), std::end(sources.index), static_cast<std::int16_t>(index));
  std::fill(std::begin(sources.old), std::end(sources.old), static_cast<std::int16_t>(index - 1));
  for (int i = 0; i < count; ++i) {
    for (int lane = 0; lane < kOpaqueLanes; ++lane) {
      sources.plus[i * kOpaqueLanes + lane] = 0.25 * (lane + 1);
      sources.minus[i * kOpaqueLanes + lane] = 0.125 * (lane + 1);
    }
  }
  const WriteRow<kOpaqueLanes> write = row_writer<kOpaqueLanes>(kind);
  const BandImage image{0, height, 0, 1};
  for (auto _ : state) {
    write(discs(), sources, kernel.radius_y, image, band);
    benchmark::ClobberMemory();
  }
  const int edges = kernel.edge_count() + (kind == RowKind::moved ? discs().kernel(index - 1).edge_count() : 0);
  state.SetItemsProcessed(state.iterations() * edges * count);
}
BENCHMARK_CAPTURE(edges_of_sources, plain, RowKind::plain)
    ->ArgsProduct({{1, 2, 4, 8}, {2, 5, 10, 20, 40, 80}})
    ->ArgNames({"sources", "radius"});
BENCHMARK_CAPTURE(edges_of_sources, recoloured, RowKind::recoloured)->Args({8, 10})->ArgNames({"sources", "radius"});
BENCHMARK_CAPTURE(edges_of_sources, moved, RowKind::moved)
    ->ArgsProduct({{1, 8}, {5, 10, 20, 40, 80}})
    ->ArgNames({"sources", "radius"});

// A block of sources of one radius, as edges_of_sources otherwise; rows: of the same sources, one by one.
void edges_of_blocks(benchmark::State& state, RowKind kind, bool as_rows) {
  const int radius = static_cast<int>(state.range(0));
  const int index = discs().coc().index(2 * static_cast<float>(radius));
  for (int i = 0; i <= KernelTable::kAskedForSums; ++i) {
    discs().block(index);
    discs().block_move(index - 1, index);
  }
  const Kernel& kernel = discs().kernel(index);
  Band band;
  const int height = 2 * kernel.radius_y + kBlockRows;
  band.begin({kRow, height, kernel.radius_x + kBlockColumns + BlockPlan::kMostSpread, kOpaqueLanes}, 0, height);
  std::vector<SourceRow<kOpaqueLanes>> rows(kBlockRows);
  SourceBlock<kOpaqueLanes> block{{}, {}, kRow / 2, kernel.radius_y};
  for (std::size_t h = 0; h < kBlockRows; ++h) {
    rows[h].x = block.x;
    std::fill(std::begin(rows[h].index), std::end(rows[h].index), static_cast<std::int16_t>(index));
    std::fill(std::begin(rows[h].old), std::end(rows[h].old), static_cast<std::int16_t>(index - 1));
    std::fill(std::begin(rows[h].plus), std::end(rows[h].plus), 0.25);
    std::fill(std::begin(rows[h].minus), std::end(rows[h].minus), 0.125);
    block.rows[h] = &rows[h];
  }
  const BandImage image{0, height, 0, 1};
  BlockValues values;
  for (auto _ : state) {
    if (!as_rows) {
      block.masks.fill(first_pixels(kBlockColumns));
      block_writer<kOpaqueLanes>(kind)(discs(), block, image, band, values);
    }
    for (std::size_t h = 0; h < kBlockRows; ++h) {
      rows[h].mask = as_rows ? first_pixels(kBlockColumns) : block.masks[h];
      if (rows[h].mask == 0) continue;
      row_writer<kOpaqueLanes>(kind)(discs(), rows[h], block.y + static_cast<int>(h), image, band);
    }
    benchmark::ClobberMemory();
  }
  const int edges = kernel.edge_count() + (kind == RowKind::moved ? discs().kernel(index - 1).edge_count() : 0);
  state.SetItemsProcessed(state.iterations() * edges * kBlockRows * kBlockColumns);
}
BENCHMARK_CAPTURE(edges_of_blocks, plain, RowKind::plain, false)
    ->ArgsProduct({{2, 5, 10, 20, 40, 80}})
    ->ArgNames({"radius"});
BENCHMARK_CAPTURE(edges_of_blocks, plain_rows, RowKind::plain, true)
    ->ArgsProduct({{2, 5, 10, 20, 40, 80}})
    ->ArgNames({"radius"});
BENCHMARK_CAPTURE(edges_of_blocks, moved, RowKind::moved, false)->ArgsProduct({{10, 20, 40, 80}})->ArgNames({"radius"});
BENCHMARK_CAPTURE(edges_of_blocks, moved_rows, RowKind::moved, true)
    ->ArgsProduct({{10, 20, 40, 80}})
    ->ArgNames({"radius"});

void prefix_sum_of_row(benchmark::State& state) {
  const int lanes = static_cast<int>(state.range(0));
  std::vector<Accumulator, CacheAligned<Accumulator>> values(static_cast<std::size_t>(kRow * lanes), 3);
  for (auto _ : state) {
    prefix_sum(values.data(), kRow, lanes);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * kRow);
}
BENCHMARK(prefix_sum_of_row)->Arg(kOpaqueLanes)->Arg(kAlphaLanes)->ArgName("lanes");

// A row that so many layers reach throughout, each with a share of the weight.
void resolve_row(benchmark::State& state) {
  const int layers = static_cast<int>(state.range(0));
  const Window window{0, 0, kRow, 1};
  const Frame frame = noise(kRow, 1);
  ColourImage out(window, SampleType::half);
  std::mt19937_64 random(2);
  std::vector<std::vector<Accumulator>> sums(static_cast<std::size_t>(layers));
  const ColumnSpan whole[] = {{0, kRow}};
  std::vector<LayerRow> rows;
  for (int layer = 0; layer < layers; ++layer) {
    auto& values = sums[static_cast<std::size_t>(layer)];
    for (int i = 0; i < kRow * kOpaqueLanes; ++i) {
      const Accumulator weight = static_cast<Accumulator>(kWeightUnit / layers);
      values.push_back(i % kOpaqueLanes == kWeightLane ? weight : random() % weight);
    }
    rows.push_back({layer, values.data(), whole});
  }
  for (auto _ : state) {
    resolve_rows(rows, kOpaqueLanes, 0, frame.colour, out);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * kRow);
}
BENCHMARK(resolve_row)->Arg(1)->Arg(3)->ArgName("layers");

// 15 % of a million changed pixels, on all threads.
void select_of_a_million(benchmark::State& state, Order order) {
  constexpr int side = 1000;
  Frame frame = noise(side, side);
  const Sanitiser sanitiser(65504);
  SourceState committed;
  std::vector<TileWork> all;
  committed.reset(frame.window(), SampleType::half);
  commit_all(frame, kPlanar, discs(), sanitiser, committed, all);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) frame.colour.set(x, y, 0, 1 + frame.colour.get(x, y, 0));
  }
  std::vector<std::int16_t> index(committed.index.size());
  const Changes changes =
      find_changes(frame, kPlanar, discs().coc(), sanitiser, committed, ChangeThresholds{}, index, nullptr);
  const Pending pending{frame, committed, index, discs(), sanitiser, committed.colour, 1};
  ImportanceOptions options;
  options.order = order;
  WaitingTimes waiting;
  for (auto _ : state) {
    benchmark::DoNotOptimize(select_pixels(changes, pending, options, waiting, {changes.pixels * 15 / 100, 0}));
  }
  state.SetItemsProcessed(state.iterations() * changes.pixels);
}
BENCHMARK_CAPTURE(select_of_a_million, gain, Order::gain)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(select_of_a_million, fearing, Order::fearing)->UseRealTime()->Unit(benchmark::kMillisecond);

void kernel_table(benchmark::State& state, const char* shape) {
  KernelOptions options;
  options.shape = KernelShape::parse(shape);
  options.max_coc_px = static_cast<double>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(KernelTable(options));
}
BENCHMARK_CAPTURE(kernel_table, disc, "disc")->Arg(50)->Arg(400)->ArgName("max_coc")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kernel_table, polygon, "polygon:6")->Arg(50)->ArgName("max_coc")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kernel_table, gaussian, "gaussian")->Arg(50)->ArgName("max_coc")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pullfocus

BENCHMARK_MAIN();
