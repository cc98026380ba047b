#!/usr/bin/env bash
# Makes docs/shots.png: of every shot the middle frame, sharp and through the lens, in the order of docs/sequences.md.
#   sequences/contact_sheet.sh [LENS SAMPLES]      default: 256
set -euo pipefail
cd "$(dirname "$0")/.."
samples=${1:-256}
tool=${PULLFOCUS_BUILD:-build}/cli/pullfocus
out=out/contact-sheet
mkdir -p "$out"

pictures=()
show() { # shot, frame
  local number
  number=$(printf '%04d' "$2")
  "$tool" render "$1" -o "$out" --size 240x135 --frames "$2"
  "$tool" render "$1" -o "$out" --size 240x135 --frames "$2" --truth "$samples"
  for picture in "$1.$number" "$1.truth.$number"; do
    oiiotool "$out/$picture.exr" --ch R,G,B --colorconvert linear sRGB -d uint8 -o "$out/$picture.png"
    pictures+=("$out/$picture.png")
  done
}
show fearing-1 50
show fearing-2 40
show fearing-3 10
show fearing-4 60
show fearing-5 70
show branches 20
show bokeh 20
show texture 1
show dolly 30
show lighting 30
show noise 12
show focus-pull 50
show cut 12
show cut 13
oiiotool "${pictures[@]}" --mosaic 4x7 -d uint8 -o docs/shots.png
