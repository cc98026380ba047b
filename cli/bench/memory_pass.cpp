#include "bench/memory_pass.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/memory_pass.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pullfocus::cli::bench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

std::uint64_t XorOf(const std::byte* bytes, std::size_t words) {
  const hn::ScalableTag<std::uint64_t> d;
  const std::size_t step = hn::Lanes(d);
  const auto* from = reinterpret_cast<const std::uint64_t*>(bytes);
  hn::Vec<decltype(d)> parts[4] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  std::size_t i = 0;
  for (; i + 4 * step <= words; i += 4 * step) {
    for (std::size_t k = 0; k < 4; ++k) parts[k] = hn::Xor(parts[k], hn::LoadU(d, from + i + k * step));
  }
  HWY_ALIGN std::uint64_t lanes[hn::MaxLanes(d)];
  hn::Store(hn::Xor(hn::Xor(parts[0], parts[1]), hn::Xor(parts[2], parts[3])), d, lanes);
  std::uint64_t result = 0;
  for (std::size_t k = 0; k < step; ++k) result ^= lanes[k];
  for (; i < words; ++i) {
    std::uint64_t word;
    __builtin_memcpy(&word, bytes + i * sizeof word, sizeof word);
    result ^= word;
  }
  return result;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus::cli::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus::cli::bench {

HWY_EXPORT(XorOf);

std::uint64_t read_all(std::span<const std::span<const std::byte>> buffers) {
  constexpr std::size_t kWords = std::size_t{1} << 15;  // of a piece
  struct Piece {
    const std::byte* bytes;
    std::size_t words;
  };
  std::vector<Piece> pieces;
  for (const auto& buffer : buffers) {
    const std::size_t words = buffer.size() / sizeof(std::uint64_t);
    for (std::size_t i = 0; i < words; i += kWords)
      pieces.push_back({buffer.data() + i * sizeof(std::uint64_t), std::min(kWords, words - i)});
  }
  std::atomic<std::uint64_t> result = 0;
  tbb::parallel_for(std::size_t{0}, pieces.size(),
                    [&](std::size_t i) { result ^= HWY_DYNAMIC_DISPATCH(XorOf)(pieces[i].bytes, pieces[i].words); });
  return result;
}

}  // namespace pullfocus::cli::bench
#endif
