#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds, and runs all tests.
#   tests/run.sh [ctest options]        PULLFOCUS_BUILD: build folder, PULLFOCUS_PRESET: release, debug or sanitize
set -euo pipefail
cd "$(dirname "$0")/.."
sequences/setup.sh
preset=${PULLFOCUS_PRESET:-release}
build=${PULLFOCUS_BUILD:-build}
[ "$preset" = release ] || build=${PULLFOCUS_BUILD:-build-$preset}
cmake --preset "$preset" -B "$build"
cmake --build "$build"
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" "$@"
