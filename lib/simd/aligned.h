// Memory that begins on a cache line.
#pragma once

#include <cstddef>
#include <new>

namespace pullfocus {

inline constexpr std::size_t kCacheLine = 64;  // bytes

// For standard containers whose values are read and written as vectors: fewer of these straddle two cache lines. Goes
// through operator new, so that sanitizers and valgrind see every allocation.
template <typename T>
struct CacheAligned {
  using value_type = T;
  static constexpr std::align_val_t kLine{kCacheLine};

  CacheAligned() = default;
  template <typename U>
  CacheAligned(const CacheAligned<U>&) noexcept {}

  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
  void deallocate(T* values, std::size_t) noexcept { ::operator delete(values, kLine); }
  bool operator==(const CacheAligned&) const = default;
};

}  // namespace pullfocus
