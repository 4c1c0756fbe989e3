#!/bin/sh
# From a fresh Debian to pictures: installs packages, builds, draws one character, bakes, and draws a crowd. It needs no display.
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
  echo "samples/run.sh: $1 is not a file; give a .glb or nothing" >&2
  exit 2
fi
cd "$(dirname "$0")/.."
./install_packages.sh
mkdir -p build out/first
cmake -G Ninja -S . -B build -DCMAKE_BUILD_TYPE=Release -DNOOK_PRECOMPILE=ON -DNOOK_PRECOMPILE_LIBRARY=ON \
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache > build/configure.log 2>&1 || {
  cat build/configure.log >&2
  exit 1
}
# Without these settings, ccache does not store objects that were compiled with a precompiled header.
export CCACHE_SLOPPINESS="${CCACHE_SLOPPINESS:+$CCACHE_SLOPPINESS,}pch_defines,time_macros"

# The viewer and the character need less than half of the objects of the crowd, and the character's model is part of the
# repository.
ninja -C build mannequin gltf_viewer
build/bakers/mannequin/mannequin out/first/mannequin.glb
build/samples/gltf_viewer/gltf_viewer out/first/mannequin.glb samples/minimal/mannequin.nook --clip Crouch --out out/first
mv out/first/frame_0000.png out/first.png
echo "look at out/first.png: one character, with a model that was baked before; the bake and the crowd follow"

ninja -C build crowd
# The arguments of the caller come last and override others. Tier 33 is used because without a GPU, Mesa is several times
# faster with it.
build/samples/crowd/crowd --context egl --tier 33 --characters 100 --frames 4 --out out/crowd "$@"
echo "look at out/crowd/frame_0000.png, and at out/crowd/without_ao.png beside it"
