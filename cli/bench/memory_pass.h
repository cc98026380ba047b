// Reading memory and nothing else: the least that looking at all bytes of a frame can cost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace pullfocus::cli::bench {

// Exclusive or of all whole 64-bit words of the buffers, whatever their alignment; in pieces, on the threads of the
// calling task arena. SIMD with run-time dispatch.
std::uint64_t read_all(std::span<const std::span<const std::byte>> buffers);

}  // namespace pullfocus::cli::bench
