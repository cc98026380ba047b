// batch [--quick] [--threads N]: what filtering adds to reading and writing EXR files. Prints a table; judges nothing.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "batch.h"

int main(int argc, char** argv) {
  bool quick = false;
  int threads = 0;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) quick = true;
    if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc) threads = std::atoi(argv[++i]);
  }
  try {
    pullfocus::test::measure_batch(quick, threads);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "batch: %s\n", error.what());
    return 1;
  }
  return 0;
}
