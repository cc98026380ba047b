#include "importance/edge_count.h"

#include <algorithm>
#include <cstring>
#include <iterator>

#include "scatter/state.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "importance/edge_count.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pullfocus {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The masked pixels of the first n, a multiple of the vector length. `edges` by |index|, the last of them, number
// `last`, for what is no index. A row's edges fit an int32: no kernel has more than one at every pixel of its square.
EdgeCount EdgesOfPixels(const int* edges, int last, const std::int16_t* was, const std::int16_t* is, std::uint64_t mask,
                        int n) {
  const hn::CappedTag<std::int32_t, 32> d;
  const hn::Rebind<std::int16_t, decltype(d)> d16;
  const auto none = hn::Set(d, last), far = hn::Set(d, KernelTable::kFarthestMove);
  auto before = hn::Zero(d), after = hn::Zero(d), same = hn::Zero(d), moved = hn::Zero(d);
  for (int i = 0; i < n; i += static_cast<int>(hn::Lanes(d))) {
    const std::uint64_t bits = mask >> i;
    std::uint8_t stored[8];
    std::memcpy(stored, &bits, sizeof stored);
    const auto counted = hn::LoadMaskBits(d, stored);
    const auto from = hn::PromoteTo(d, hn::LoadU(d16, was + i)), to = hn::PromoteTo(d, hn::LoadU(d16, is + i));
    const auto old_edges = hn::GatherIndex(d, edges, hn::IfThenElse(counted, hn::Min(hn::Abs(from), none), none));
    const auto new_edges = hn::GatherIndex(d, edges, hn::IfThenElse(counted, hn::Min(hn::Abs(to), none), none));
    const auto is_same = hn::Eq(from, to);
    // Whether they are sources need not be asked: what is none is far from all that are, and has no edges.
    const auto is_near = hn::Not(hn::Gt(hn::Abs(hn::Sub(to, from)), far));
    before = hn::Add(before, old_edges);
    after = hn::Add(after, new_edges);
    same = hn::Add(same, hn::IfThenElseZero(is_same, new_edges));
    moved = hn::Add(moved, hn::IfThenElseZero(hn::AndNot(is_same, is_near), hn::Add(old_edges, new_edges)));
  }
  const auto sum = [&](auto v) HWY_ATTR { return std::int64_t{hn::GetLane(hn::SumOfLanes(d, v))}; };
  return {sum(before) + sum(after) - sum(same), sum(moved), sum(after) - sum(before)};
}

std::size_t PixelsTogether() { return hn::Lanes(hn::CappedTag<std::int32_t, 32>()); }

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus {

HWY_EXPORT(EdgesOfPixels);
HWY_EXPORT(PixelsTogether);

EdgeCount edges_of_row(const KernelTable& kernels, const std::int16_t* was, const std::int16_t* is, std::uint64_t mask,
                       int n) noexcept {
  const std::span<const int> edges = kernels.edge_counts();
  const auto count = [&](const std::int16_t* from, const std::int16_t* to, std::uint64_t bits, int pixels) {
    return HWY_DYNAMIC_DISPATCH(EdgesOfPixels)(edges.data(), static_cast<int>(edges.size()) - 1, from, to, bits,
                                               pixels);
  };
  const int together = static_cast<int>(HWY_DYNAMIC_DISPATCH(PixelsTogether)()), whole = n / together * together;
  EdgeCount sum = count(was, is, mask, whole);
  if (whole < n && mask >> whole != 0) {  // a vector of its own
    std::int16_t last_was[kTileWidth] = {}, last_is[kTileWidth] = {};
    std::copy(was + whole, was + n, last_was);
    std::copy(is + whole, is + n, last_is);
    sum.add(count(last_was, last_is, mask >> whole, together));
  }
  return sum;
}

std::int64_t edges_of(const KernelTable& kernels, const std::int16_t* index, int n) noexcept {
  const std::span<const int> edges = kernels.edge_counts();
  const auto none = static_cast<std::int16_t>(edges.size() - 1);
  std::int16_t at[kTileWidth];
  std::fill(std::copy_n(index, n, at), std::end(at), kNeverCommitted);
  for (std::int16_t& i : at) {                          // simple enough for the compiler to use vectors
    const std::int16_t within = std::max(i, kHeldOut);  // whose negative is an int16, too
    i = std::min(std::max(within, static_cast<std::int16_t>(-within)), none);
  }
  constexpr int together = 4;
  int sum = 0;  // of a row: fits, as above
  for (int i = 0; i < kTileWidth; i += together) {
    std::uint64_t four = 0;  // one load, where compilers would take vectors apart
    std::memcpy(&four, at + i, sizeof four);
    sum += (edges[four & 0xffff] + edges[four >> 16 & 0xffff]) + (edges[four >> 32 & 0xffff] + edges[four >> 48]);
  }
  return sum;
}

}  // namespace pullfocus
#endif
