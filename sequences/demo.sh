#!/usr/bin/env bash
# Builds pullfocus, makes the demo shot, filters it with both methods, and says what came of it.
#   sequences/demo.sh [WIDTHxHEIGHT] [FRAMES]      default: 256x256 1-100; frames go to out/demo
set -euo pipefail
cd "$(dirname "$0")/.."
size=${1:-256x256}
frames=${2:-1-100}
build=${PULLFOCUS_BUILD:-build}
out=out/demo

sequences/setup.sh
cmake --preset release -B "$build" >/dev/null
cmake --build "$build" --target pullfocus_tool
tool=$build/cli/pullfocus

rm -rf "$out"
echo
echo "Rendering the shot: star-lateral, $size, frames $frames"
"$tool" render star-lateral -o "$out/shot" --size "$size" --frames "$frames"
# One thread each: frames this small are over before other threads have woken up.
for method in linear incremental; do
  echo "Filtering it: $method"
  "$tool" filter "$out/shot/star-lateral.####.exr" -o "$out/$method" --mkdir --method "$method" --lens paper \
    --threads 1 --stats "$out/$method.json"
done

# Headers tell the method, so pixels are compared, not files.
same=0
for frame in "$out"/linear/*.exr; do
  oiiotool "$frame" "$out/incremental/$(basename "$frame")" --diff >/dev/null || { echo "DIFFERENT: $frame" >&2; exit 1; }
  same=$((same + 1))
done

# Mean filter time of all frames but the first, which both methods compute in full.
mean() { grep -o '"filter":[0-9.]*' "$1" | cut -d: -f2 | awk 'NR > 1 { sum += $1; n++ } END { if (n) print sum / n; else print 0 }'; }
linear=$(mean "$out/linear.json")
incremental=$(mean "$out/incremental.json")

middle=$(ls "$out"/shot/*.exr | sed -n "$(( (same + 3) / 4 ))p")
oiiotool "$middle" --ch R,G,B "$out/incremental/$(basename "$middle")" --ch R,G,B --mosaic 2x1 \
  --colorconvert linear sRGB -d uint8 -o "$out/side-by-side.png"

echo
echo "$same frames, identical pixels with both methods."
awk -v l="$linear" -v i="$incremental" 'BEGIN { if (i > 0) printf "Filter time a frame on one thread, after the first: linear %.2f ms, incremental %.2f ms: %.1f times faster.\n", l, i, l / i }'
echo "Frames:       $out/shot (input), $out/linear, $out/incremental"
echo "Side by side: $out/side-by-side.png (input, filtered)"
