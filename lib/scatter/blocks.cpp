#include "scatter/blocks.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scatter/blocks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "scatter/block_chains-inl.h"
#include "scatter/value_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kMostKernels = 3;  // of a block that are looked at

// Sources that share a plan, in kBlockColumns columns of the tile from `column` on: bit i of of[h] is one of row h.
struct BlockMembers {
  int column = 0;
  std::uint32_t of[kBlockRows] = {};
};

template <int lanes, RowKind kind>
void WriteBlock(const EdgePlan& edges, const BlockPlan& plan, const SourceBlock<lanes>& block,
                const BlockMembers& members, const BandImage& image, Band& band, BlockValues& memory) {
  // Seen from the band, mirrored sources come from the bottom up.
  const bool up = image.direction > 0;
  const int top = up ? image.band_row(block.y) : image.band_row(block.y + kBlockRows - 1);
  const int first = up ? image.first : image.band_row(image.y1 - 1), last = first + image.y1 - image.y0;
  const int from = std::max(top - plan.radius_y, first), to = std::min(top + plan.radius_y + kBlockRows, last);
  if (from >= to) return;

  constexpr int n = kBlockValues<lanes>, stride = kBlockStride<lanes>;
  Accumulator* const values = memory.rows(BlockPlan::kMostRows + BlockPlan::kMostWide, n, kBlockPad<lanes>);
  Accumulator* out = values;
  for (std::size_t line = 0; line < kBlockRows; ++line) {
    const std::size_t h = up ? line : kBlockRows - 1 - line;
    const SourceRow<lanes>& row = *block.rows[h];
    ValueRows<lanes, kBlockColumns, kind, stride, 0>(edges, row.plus + members.column * lanes,
                                                     row.minus + members.column * lanes, members.of[h], out);
    out += static_cast<std::ptrdiff_t>(plan.rows_a_line) * stride;
  }
  for (const BlockPlan::RowSum& sum : plan.sums) {
    const Accumulator *const a = values + sum.a * stride, *const b = values + sum.b * stride;
    ForEachPart<n>([&](auto d, int i)
                       HWY_ATTR { hn::StoreU(hn::Add(hn::LoadU(d, a + i), hn::LoadU(d, b + i)), d, out + i); });
    out += stride;
  }
  out = values + BlockPlan::kMostRows * stride;
  for (const BlockPlan::RowSum& sum : plan.wide) {
    const Accumulator *const a = values + sum.a * stride, *const b = values + sum.b * stride - sum.shift * lanes;
    ForEachPart<stride>([&](auto d, int i)
                            HWY_ATTR { hn::StoreU(hn::Add(hn::LoadU(d, a + i), hn::LoadU(d, b + i)), d, out + i); });
    out += stride;
  }
  const int x = block.x + members.column;
  const BlockPlace place{band.row(from) + static_cast<std::ptrdiff_t>(x) * lanes, band.stride(), from - top, to - top};
  WriteBlockChains<lanes, 0>(plan, values, place);
  WriteBlockChains<lanes, BlockPlan::kSpreadStep>(plan, values, place);
  WriteBlockChains<lanes, 2 * BlockPlan::kSpreadStep>(plan, values, place);
}

// What these sources of a row cost one by one, of BlockPlan::kAllRows for all rows of a block: by how wide a group they
// make.
int CostOfRow(std::uint32_t members) {
  constexpr int of_count[kWindow + 1] = {0, 4, 4, 5, 5, 8, 8, 8, 8};
  static_assert(kBlockRows * kBlockColumns / kWindow * of_count[kWindow] == BlockPlan::kAllRows);
  int cost = 0;
  for (; members != 0; members >>= kWindow) cost += of_count[std::popcount(members & ((1u << kWindow) - 1))];
  return cost;
}

// Bit i: index[i] == like, of kBlockColumns values.
HWY_INLINE std::uint32_t LikeOfBlock(const std::int16_t* index, std::int16_t like) {
  std::uint32_t all = 0;
  for (int i = 0; i < kBlockColumns; i += kWindow) all |= Like(index + i, like) << i;
  return all;
}

template <int lanes, RowKind kind>
void WriteBlocksOf(const KernelTable& kernels, SourceBlock<lanes>& block, const BandImage& image, Band& band,
                   BlockValues& values) {
  for (int column = 0; column < kTileWidth; column += kBlockColumns) {
    std::uint32_t pending[kBlockRows];
    int left = 0;
    for (int h = 0; h < kBlockRows; ++h) {
      pending[h] = static_cast<std::uint32_t>(block.masks[h] >> column) & ((1u << kBlockColumns) - 1);
      left += std::popcount(pending[h]);
    }
    for (int k = 0; k < kMostKernels && left >= kFewestInBlock; ++k) {
      const auto first = static_cast<std::size_t>(
          std::find_if(pending, pending + kBlockRows, [](std::uint32_t row) { return row != 0; }) - pending);
      const int at = column + std::countr_zero(pending[first]);
      const std::int16_t index = block.rows[first]->index[at], old = block.rows[first]->old[at];
      BlockMembers members{column, {}};
      int count = 0, rows_cost = 0;
      for (std::size_t h = first; h < kBlockRows; ++h) {
        if (pending[h] == 0) continue;
        std::uint32_t like = LikeOfBlock(block.rows[h]->index + column, index) & pending[h];
        if constexpr (kind == RowKind::moved) like &= LikeOfBlock(block.rows[h]->old + column, old);
        members.of[h] = like;
        pending[h] &= ~like;
        count += std::popcount(like);
        rows_cost += CostOfRow(like);
      }
      left -= count;
      if (count < kFewestInBlock) continue;
      const BlockPlan& plan = kind == RowKind::moved ? kernels.block_move(old, index) : kernels.block(index);
      if (plan.empty() || plan.cost >= rows_cost) continue;
      const EdgePlan& edges = kind == RowKind::moved ? kernels.move(old, index)[0] : kernels.plan(index);
      WriteBlock<lanes, kind>(edges, plan, block, members, image, band, values);
      for (std::size_t h = 0; h < kBlockRows; ++h) block.masks[h] &= ~(std::uint64_t{members.of[h]} << column);
    }
  }
}

template <int lanes>
WriteBlocks<lanes> BlockWriter(RowKind kind) {
  switch (kind) {
    case RowKind::recoloured:
      return WriteBlocksOf<lanes, RowKind::recoloured>;
    case RowKind::moved:
      return WriteBlocksOf<lanes, RowKind::moved>;
    case RowKind::plain:
      break;
  }
  return WriteBlocksOf<lanes, RowKind::plain>;
}

WriteBlocks<kOpaqueLanes> OpaqueBlockWriter(RowKind kind) { return BlockWriter<kOpaqueLanes>(kind); }
WriteBlocks<kAlphaLanes> AlphaBlockWriter(RowKind kind) { return BlockWriter<kAlphaLanes>(kind); }

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(OpaqueBlockWriter);
HWY_EXPORT(AlphaBlockWriter);

template <int lanes>
WriteBlocks<lanes> block_writer(RowKind kind) noexcept {
  if constexpr (lanes == kOpaqueLanes) {
    return HWY_DYNAMIC_DISPATCH(OpaqueBlockWriter)(kind);
  } else {
    return HWY_DYNAMIC_DISPATCH(AlphaBlockWriter)(kind);
  }
}
template WriteBlocks<kOpaqueLanes> block_writer(RowKind) noexcept;
template WriteBlocks<kAlphaLanes> block_writer(RowKind) noexcept;

}  // namespace pullfocus
#endif
