#include "resolve/backdrop.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>

namespace pullfocus {

namespace {

constexpr int kCellRows = 16;  // rows of chunks that are filled together
constexpr int kNone = Backdrop::kReach + 1;

// w of distances 1 .. kReach.
constexpr auto kWeights = [] {
  std::array<float, Backdrop::kReach + 1> weights{};
  for (int d = 1; d <= Backdrop::kReach; ++d) {
    weights[static_cast<std::size_t>(d)] = 1.f / static_cast<float>(d) - 1.f / static_cast<float>(Backdrop::kReach + 1);
  }
  return weights;
}();

}  // namespace

Backdrop::Backdrop(int width, int height) : height_(height), columns_((width + kChunk - 1) / kChunk) { reset(); }

void Backdrop::reset() {
  const std::size_t count = at(0, height_);
  shows_.assign(count, 0);
  holes_.assign(count, 0);
  touched_.assign(count, 0);
  row_touched_.assign(static_cast<std::size_t>(height_), 0);
  chunks_.clear();
  chunks_.resize(count);
}

void Backdrop::begin_anew() {
  std::fill(shows_.begin(), shows_.end(), 0);
  std::fill(holes_.begin(), holes_.end(), 0);
}

void Backdrop::mark(int x, int y) noexcept {
  touched_[at(x, y)] = 1;
  row_touched_[static_cast<std::size_t>(y)] = 1;
}

void Backdrop::take(int x, int y, const Chunk& chunk) {
  if ((chunk.shows | chunk.holes) == 0) return take_none(x, y);
  const std::size_t i = at(x, y);
  if (!chunks_[i]) chunks_[i] = std::make_unique<Chunk>();
  *chunks_[i] = chunk;
  shows_[i] = chunk.shows;
  holes_[i] = chunk.holes;
  mark(x, y);
}

void Backdrop::take_none(int x, int y) noexcept {
  const std::size_t i = at(x, y);
  if (!chunks_[i]) return;
  chunks_[i].reset();
  shows_[i] = holes_[i] = 0;
  mark(x, y);
}

// Distance to the nearest pixel of the row that shows what is behind; kNone if it is farther away than kReach.
int Backdrop::left(int x, int y) const noexcept {
  const std::uint32_t* row = &shows_[at(0, y)];
  int chunk = x / kChunk;
  std::uint32_t bits = row[chunk] & ((std::uint32_t{1} << (x % kChunk)) - 1);
  while (bits == 0 && chunk > 0 && x - chunk * kChunk <= kReach) bits = row[--chunk];
  return bits == 0 ? kNone : std::min(x - (chunk * kChunk + static_cast<int>(std::bit_width(bits)) - 1), kNone);
}

int Backdrop::right(int x, int y) const noexcept {
  const std::uint32_t* row = &shows_[at(0, y)];
  int chunk = x / kChunk;
  std::uint32_t bits = row[chunk] & ~((std::uint32_t{2} << (x % kChunk)) - 1);
  while (bits == 0 && chunk + 1 < columns_ && (chunk + 1) * kChunk - x <= kReach) bits = row[++chunk];
  return bits == 0 ? kNone : std::min(chunk * kChunk + std::countr_zero(bits) - x, kNone);
}

// The holes of one column of chunks in rows cy * kCellRows and on.
void Backdrop::fill_cell(int cx, int cy, ColourImage& out) const noexcept {
  const int y0 = cy * kCellRows, y1 = std::min(y0 + kCellRows, height_), x0 = cx * kChunk;
  std::uint32_t columns = 0;
  for (int y = y0; y < y1; ++y) columns |= holes_[at(x0, y)];
  if (columns == 0) return;

  // Rows of the nearest pixels above and below that show what is behind.
  int above[kCellRows][kChunk], below[kCellRows][kChunk], nearest[kChunk];
  const auto pass = [&](int y, int(*found)[kChunk]) {
    if (y >= y0 && y < y1) std::copy_n(nearest, kChunk, found[y - y0]);
    for (std::uint32_t bits = shows_[at(x0, y)] & columns; bits != 0; bits &= bits - 1) {
      nearest[std::countr_zero(bits)] = y;
    }
  };
  std::fill_n(nearest, kChunk, -kNone);
  for (int y = std::max(y0 - kReach, 0); y < y1; ++y) pass(y, above);
  std::fill_n(nearest, kChunk, height_ + kNone);
  for (int y = std::min(y1 - 1 + kReach, height_ - 1); y >= y0; --y) pass(y, below);

  for (int y = y0; y < y1; ++y) {
    for (std::uint32_t bits = holes_[at(x0, y)]; bits != 0; bits &= bits - 1) {
      const int i = std::countr_zero(bits), x = x0 + i;
      const Chunk& own = *chunks_[at(x, y)];
      const int distance[4] = {left(x, y), right(x, y), std::min(y - above[y - y0][i], kNone),
                               std::min(below[y - y0][i] - y, kNone)};
      const int column[4] = {x - distance[0], x + distance[1], x, x},
                row[4] = {y, y, above[y - y0][i], below[y - y0][i]};
      float sum[4], weight = kPresentWeight;
      for (int c = 0; c < 4; ++c) sum[c] = kPresentWeight * own.colour[i][c];
      for (int d = 0; d < 4; ++d) {
        if (distance[d] > kReach) continue;
        const float w = kWeights[static_cast<std::size_t>(distance[d])];
        const float* behind = chunks_[at(column[d], row[d])]->colour[column[d] % kChunk];
        for (int c = 0; c < 4; ++c) sum[c] += w * behind[c];
        weight += w;
      }
      for (int c = 0; c < 4; ++c) {
        const float present = own.colour[i][c];
        const float value = present + own.amount[i] * (sum[c] / weight - present);
        out.set(out.window().x0 + x, out.window().y0 + y, c,
                out.type() == SampleType::half ? std::clamp(value, -65504.f, 65504.f) : value);
      }
    }
  }
}

void Backdrop::fill(ColourImage& out) {
  constexpr int reach_x = (kReach + kChunk - 1) / kChunk, reach_y = (kReach + kCellRows - 1) / kCellRows;
  const int rows = (height_ + kCellRows - 1) / kCellRows;
  std::vector<std::uint8_t> near(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
  bool any = false;
  for (int y = 0; y < height_; ++y) {
    if (row_touched_[static_cast<std::size_t>(y)] == 0) continue;
    row_touched_[static_cast<std::size_t>(y)] = 0;
    const int cy = y / kCellRows;
    for (int cx = 0; cx < columns_; ++cx) {
      std::uint8_t& touched = touched_[at(cx * kChunk, y)];
      if (touched == 0) continue;
      touched = 0;
      any = true;
      const auto mark_cell = [&](int x, int row) { near[static_cast<std::size_t>(row * columns_ + x)] = 1; };
      for (int x = std::max(cx - reach_x, 0); x <= std::min(cx + reach_x, columns_ - 1); ++x) mark_cell(x, cy);
      for (int row = std::max(cy - reach_y, 0); row <= std::min(cy + reach_y, rows - 1); ++row) mark_cell(cx, row);
    }
  }
  if (!any) return;
  tbb::parallel_for(0, columns_ * rows, [&](int cell) {
    if (near[static_cast<std::size_t>(cell)] != 0) fill_cell(cell % columns_, cell / columns_, out);
  });
}

std::size_t Backdrop::bytes() const noexcept {
  std::size_t held = 0;
  for (const auto& chunk : chunks_) held += chunk != nullptr;
  return held * sizeof(Chunk) + shows_.size() * (2 * sizeof(std::uint32_t) + sizeof chunks_[0] + 1);
}

}  // namespace pullfocus
