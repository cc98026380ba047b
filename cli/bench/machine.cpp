#include "bench/machine.h"

#include <fmt/format.h>
#include <hwy/targets.h>
#include <tbb/info.h>

#include <fstream>

namespace pullfocus::cli::bench {

namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "processor of unknown name";
}

const char* simd() {
  const std::int64_t targets = hwy::SupportedTargets();
  return hwy::TargetName(targets & -targets);  // the lowest bit is the best one
}

constexpr const char* kCompiler =
#if defined(__clang__)
    "clang " __clang_version__
#else
    "g++ " __VERSION__
#endif
    ;

constexpr const char* kOptimised =
#if defined(__OPTIMIZE__)
    "optimised"
#else
    "not optimised"
#endif
    ;

}  // namespace

std::string machine_and_compiler() {
  return fmt::format("{}, {} processors, SIMD {}; {}, {}", processor(), tbb::info::default_concurrency(), simd(),
                     kCompiler, kOptimised);
}

}  // namespace pullfocus::cli::bench
