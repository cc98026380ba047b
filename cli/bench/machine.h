// Where figures were measured.
#pragma once

#include <string>

namespace pullfocus::cli::bench {

// "Intel(R) Xeon(R) Processor, 4 processors, SIMD AVX3; g++ 12.2.0, optimised"
std::string machine_and_compiler();

}  // namespace pullfocus::cli::bench
