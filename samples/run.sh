#!/bin/sh
# From a fresh Debian to pictures of a crowd: installs packages, builds, bakes, renders without a display.
#   samples/run.sh                   the built-in character
#   samples/run.sh HERO.glb          a character of your own
# Further arguments go to the crowd; `build/samples/crowd/crowd --help` lists them.
set -eu
# Absolute, because the build begins in the project's folder.
if [ $# -gt 0 ] && [ -f "$1" ]; then
  hero="$(cd "$(dirname "$1")" && pwd)/$(basename "$1")"
  shift
  set -- "$hero" "$@"
elif [ $# -gt 0 ] && [ "${1#-}" = "$1" ]; then
  echo "samples/run.sh: $1 is no file; give a .glb or nothing" >&2
  exit 2
fi
cd "$(dirname "$0")/.."
./install_packages.sh
mkdir -p build
cmake -G Ninja -S . -B build -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache > build/configure.log 2>&1 || {
  cat build/configure.log >&2
  exit 1
}
ninja -C build crowd
# The arguments of the caller come last and override others. Tier 33: without a GPU, Mesa is several times faster at it.
build/samples/crowd/crowd --context egl --tier 33 --characters 100 --frames 4 --out out/crowd "$@"
echo "look at out/crowd/sheet.png first; out/crowd/report.json has the numbers"
