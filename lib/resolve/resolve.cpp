#include "resolve/resolve.h"

#include <algorithm>
#include <limits>

#include "resolve/compose.h"
#include "resolve/divide.h"

namespace pullfocus {

namespace {

// A pixel without weight takes its own colour.
void take_own(const ColourImage& own, int x, int y, ColourImage& out) noexcept {
  for (int c = 0; c < 4; ++c) {
    const float value = own.get(x, y, c);
    out.set(x, y, c, out.type() == SampleType::half ? std::clamp(value, -65504.f, 65504.f) : value);
  }
}

bool has_weight(const Accumulator* values, int lanes, int n) noexcept {
  Accumulator any = 0;
  for (int i = 0; i < n; ++i) any |= values[i * lanes + kWeightLane];
  return any != 0;
}

}  // namespace

bool resolve_span(const Accumulator* values, int lanes, int x0, int x1, int y, const ColourImage& own,
                  ColourImage& out) noexcept {
  const int x = out.window().x0 + x0, row = out.window().y0 + y;
  if (divide(values, lanes, x1 - x0, out.type(), out.pixel(x, row))) return true;
  for (int i = 0; i < x1 - x0; ++i, values += lanes) {
    if (values[kWeightLane] == 0) take_own(own, x + i, row, out);
  }
  return false;
}

namespace {

// Whether a layer in front of focus that is alone covers all pixels that it reaches.
bool covers(const Accumulator* values, int lanes, int n) noexcept {
  constexpr auto enough = static_cast<Accumulator>((1 - Backdrop::kLeastFree) * static_cast<double>(kCoveringWeight));
  Accumulator least = std::numeric_limits<Accumulator>::max();
  for (int i = 0; i < n; ++i) least = std::min(least, values[i * lanes + kWeightLane] - 1);  // 0 becomes the largest
  return least >= enough;
}

}  // namespace

bool resolve_layers(std::span<const Accumulator* const> layers, int lanes, int x0, int x1, int y,
                    const ColourImage& own, ColourImage& out, std::size_t near, Backdrop* backdrop) {
  bool all = true;
  constexpr int chunk_width = Backdrop::kChunk;  // pixels that are looked at together
  // Chunks that show one layer alone are resolved together, in long runs.
  const Accumulator* alone = nullptr;
  int alone_from = x0, alone_to = x0;
  const auto flush = [&] {
    if (alone != nullptr) all &= resolve_span(alone, lanes, alone_from, alone_to, y, own, out);
    alone = nullptr;
  };
  for (int x = x0; x < x1; x += chunk_width) {
    const int n = std::min(chunk_width, x1 - x);
    const Accumulator* present[kMostLayers];
    std::size_t count = 0, in_front = 0;
    for (std::size_t l = 0; l < layers.size(); ++l) {
      if (layers[l] == nullptr) continue;
      const Accumulator* values = layers[l] + static_cast<std::ptrdiff_t>(x - x0) * lanes;
      if (layers.size() > 1 && !has_weight(values, lanes, n)) continue;
      present[count++] = values;
      in_front += l < near;
    }
    const bool looks = backdrop != nullptr && in_front > 0 && !(count == 1 && covers(present[0], lanes, n));
    if (backdrop != nullptr && !looks) backdrop->take_none(x, y);
    if (count == 1 && !looks) {
      if (alone == nullptr || present[0] != alone + static_cast<std::ptrdiff_t>(x - alone_from) * lanes) {
        flush();
        alone = present[0];
        alone_from = x;
      }
      alone_to = x + n;
      continue;
    }
    flush();
    const int column = out.window().x0 + x, row = out.window().y0 + y;
    Backdrop::Chunk chunk;
    const bool all_here = count > 0 && compose({present, count}, in_front, lanes, n, out.type(), out.pixel(column, row),
                                               looks ? &chunk : nullptr);
    if (looks) backdrop->take(x, y, chunk);
    if (all_here) continue;
    all = false;
    for (int i = 0; i < n; ++i) {
      Accumulator any = 0;
      for (std::size_t l = 0; l < count; ++l) any |= present[l][i * lanes + kWeightLane];
      if (any == 0) take_own(own, column + i, row, out);
    }
  }
  flush();
  return all;
}

void resolve_rows(std::span<const LayerRow> rows, int lanes, int y, const ColourImage& own, ColourImage& out, int near,
                  Backdrop* backdrop) {
  const int width = out.window().width();
  const auto down = [](int x) { return x / Backdrop::kChunk * Backdrop::kChunk; };
  const auto up = [&](int x) { return std::min(down(x + Backdrop::kChunk - 1), width); };
  std::span<const ColumnSpan> ahead[kMostLayers];
  for (std::size_t l = 0; l < rows.size(); ++l) ahead[l] = rows[l].spans;
  // Stretches that the same layers have spans in: others' sums, which nobody wrote, are not read.
  for (int x = 0, end = 0; x < width; x = end) {
    end = width;
    const Accumulator* layers[kMostLayers];
    std::size_t count = 0, in_front = 0;
    for (std::size_t l = 0; l < rows.size(); ++l) {
      while (!ahead[l].empty() && up(ahead[l].front().x1) <= x) ahead[l] = ahead[l].subspan(1);
      if (ahead[l].empty()) continue;
      const ColumnSpan& span = ahead[l].front();
      const bool is_here = down(span.x0) <= x;
      end = std::min(end, is_here ? up(span.x1) : down(span.x0));
      if (!is_here) continue;
      layers[count++] = rows[l].values + static_cast<std::ptrdiff_t>(x) * lanes;
      in_front += rows[l].layer < near;
    }
    resolve_layers({layers, count}, lanes, x, end, y, own, out, in_front, backdrop);
  }
}

}  // namespace pullfocus
