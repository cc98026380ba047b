// Runs tests on the SIMD target that PULLFOCUS_SIMD_TARGET names (AVX3, AVX2, SSE4, SSSE3, SCALAR), or on the best one.
// Exits with 77, which ctest takes as skipped, where the processor does not have it.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "targets.h"

int main(int argc, char** argv) {
  using namespace pullfocus::test;
  testing::InitGoogleTest(&argc, argv);
  std::unique_ptr<OnTarget> on_target;
  if (const char* name = std::getenv("PULLFOCUS_SIMD_TARGET")) {
    for (const std::int64_t target : simd_targets()) {
      if (simd_target_name(target) == name) on_target = std::make_unique<OnTarget>(target);
    }
    if (!on_target) {
      std::printf("PULLFOCUS_SIMD_TARGET=%s: this processor has no such target; skipped\n", name);
      return 77;
    }
    std::printf("SIMD target %s\n", name);
  }
  return RUN_ALL_TESTS();
}
