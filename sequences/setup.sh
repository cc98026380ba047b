#!/usr/bin/env bash
# Installs the Debian 12 packages that building, testing and the demo need and that are not there yet.
set -euo pipefail
packages=(
  g++ cmake ninja-build
  libopenexr-dev libimath-dev   # EXR files, half floats
  libopenimageio-dev            # pictures: aperture images, reports; an independent compare in the tests
  libtbb-dev                    # threads
  libhwy-dev                    # SIMD with run-time dispatch
  libfmt-dev libcli11-dev       # text, command line
  nlohmann-json3-dev libtomlplusplus-dev
  libglm-dev                    # geometry of shots
  libembree-dev libtinygltf-dev # rays, glTF scenes
  libimgui-dev libglfw3-dev libgl-dev  # the preview's window
  python3 gnuplot-nox           # the report of speed against error
  libgtest-dev                  # tests
  libbenchmark-dev              # micro-benchmarks
  openimageio-tools             # the demo's PNG; an independent reader in the tests
  xvfb xdotool libgl1-mesa-dri  # the window's tests: a display, mouse and keyboard, OpenGL in software
)
missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0
echo "Installing: ${missing[*]}" >&2
if [ "$(id -u)" -eq 0 ]; then
  run=()
elif command -v sudo >/dev/null; then
  run=(sudo)
else
  echo "setup.sh: these packages are missing and need root or sudo: ${missing[*]}" >&2
  exit 1
fi
"${run[@]}" apt-get update -qq
"${run[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
