// Adding a block's value rows to the sums in a band. Included once per SIMD target (see Highway's foreach_target.h).
#if defined(PULLFOCUS_SCATTER_BLOCK_CHAINS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PULLFOCUS_SCATTER_BLOCK_CHAINS_INL_H_
#undef PULLFOCUS_SCATTER_BLOCK_CHAINS_INL_H_
#else
#define PULLFOCUS_SCATTER_BLOCK_CHAINS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <span>

#include "scatter/band.h"
#include "scatter/block_plan.h"

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Of a value row, and of it with the zeros behind it.
template <int lanes>
constexpr int kBlockValues = kBlockColumns * lanes;
// A chain's terms are read as far as it spreads, and on to the end of a vector of at most 8.
template <int lanes>
constexpr int kBlockPad = (BlockPlan::kMostSpread * lanes + 7) / 8 * 8;
template <int lanes>
constexpr int kBlockStride = kBlockValues<lanes> + kBlockPad<lanes>;

// Rows [dy0, dy1) of the band, counted from the block's first; `first_row` is at its first column, in row dy0.
struct BlockPlace {
  Accumulator* first_row;
  std::ptrdiff_t row_step;
  int dy0, dy1;
};

// Of what a chain covers.
using BlockTag = hn::CappedTag<Accumulator, 8>;
template <int lanes, int spread>
struct ChainVectors {
  static constexpr int size = static_cast<int>(hn::MaxLanes(BlockTag()));
  static constexpr int all = ((kBlockColumns + spread) * lanes + size - 1) / size;
  static constexpr int together = std::min(all, 10);  // in registers
};

// Where a chain's sums begin; null if it is not in the band.
template <int lanes>
HWY_INLINE Accumulator* SumsOf(const BlockChain& chain, const BlockPlace& place) {
  if (chain.dy < place.dy0 || chain.dy >= place.dy1) return nullptr;
  return place.first_row + (chain.dy - place.dy0) * place.row_step + chain.dx * lanes;
}

// Where a term's value row lies under a chain's first column.
template <int lanes>
HWY_INLINE const Accumulator* RowOf(const BlockTerm& term, const Accumulator* values) {
  return values + term.row * kBlockStride<lanes> - term.shift * lanes;
}

// Chains that all have this row alone, added or taken.
template <int lanes, int spread>
HWY_INLINE void WriteGroupOfChains(std::span<const BlockChain> chains, const Accumulator* HWY_RESTRICT row,
                                   const BlockPlace& place) {
  using V = ChainVectors<lanes, spread>;
  const BlockTag d;
  const bool taken = chains.front().taken != 0;
  for (int first = 0; first < V::all; first += V::together) {
    hn::Vec<BlockTag> of_row[V::together];
    const int left = std::min(V::together, V::all - first);
    for (int i = 0; i < V::together; ++i) {
      if (i < left) of_row[i] = hn::LoadU(d, row + (first + i) * V::size);
      if (i < left && taken) of_row[i] = hn::Sub(hn::Zero(d), of_row[i]);
    }
    for (const BlockChain& chain : chains) {
      Accumulator* const sums = SumsOf<lanes>(chain, place);
      if (sums == nullptr) continue;
      Accumulator* const out = sums + first * V::size;
      for (int i = 0; i < V::together; ++i) {
        if (i < left) hn::StoreU(hn::Add(of_row[i], hn::LoadU(d, out + i * V::size)), d, out + i * V::size);
      }
    }
  }
}

// A chain of several terms.
template <int lanes, int spread>
HWY_INLINE void WriteChain(const BlockChain& chain, const BlockTerm* terms, const Accumulator* HWY_RESTRICT values,
                           const BlockPlace& place) {
  using V = ChainVectors<lanes, spread>;
  const BlockTag d;
  Accumulator* const out = SumsOf<lanes>(chain, place);
  if (out == nullptr) return;
  const int added = chain.added, count = added + chain.taken;
  for (int first = 0; first < V::all; first += V::together) {
    hn::Vec<BlockTag> v[V::together];
    const int left = std::min(V::together, V::all - first);
    for (int i = 0; i < V::together; ++i) {
      if (i < left) v[i] = hn::LoadU(d, out + (first + i) * V::size);
    }
    int t = 0;
    for (; t < added; ++t) {
      const Accumulator* const in = RowOf<lanes>(terms[t], values) + first * V::size;
      for (int i = 0; i < V::together; ++i) {
        if (i < left) v[i] = hn::Add(v[i], hn::LoadU(d, in + i * V::size));
      }
    }
    for (; t < count; ++t) {
      const Accumulator* const in = RowOf<lanes>(terms[t], values) + first * V::size;
      for (int i = 0; i < V::together; ++i) {
        if (i < left) v[i] = hn::Sub(v[i], hn::LoadU(d, in + i * V::size));
      }
    }
    for (int i = 0; i < V::together; ++i) {
      if (i < left) hn::StoreU(v[i], d, out + (first + i) * V::size);
    }
  }
}

template <int lanes, int spread>
HWY_INLINE void WriteBlockChains(const BlockPlan& plan, const Accumulator* HWY_RESTRICT values,
                                 const BlockPlace& place) {
  const BlockPlan::Chains& list = plan.of_spread[spread / BlockPlan::kSpreadStep];
  std::span<const BlockChain> left = list.chains;
  const BlockTerm* terms = list.terms.data();
  for (const std::uint16_t size : list.groups) {
    WriteGroupOfChains<lanes, spread>(left.first(size), RowOf<lanes>(*terms, values), place);
    left = left.subspan(size);
    terms += size;
  }
  for (const BlockChain& chain : left) {
    WriteChain<lanes, spread>(chain, terms, values, place);
    terms += chain.added + chain.taken;
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
