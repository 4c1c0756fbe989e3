#!/bin/sh
# Builds the library without its OpenGL half and runs the two smallest programs, on the model in the same folder.
# It needs a compiler, CMake and Ninja, and no bake.
#   samples/minimal/run.sh [MODEL.nook]
set -eu
if [ $# -gt 0 ]; then
  model="$(cd "$(dirname "$1")" && pwd)/$(basename "$1")"
else
  model=samples/minimal/mannequin.nook
fi
cd "$(dirname "$0")/../.."
NOOK_PACKAGES=samples/minimal/packages.txt ./install_packages.sh
mkdir -p build-cpu-only
cmake --workflow --preset cpu-only > build-cpu-only/run.log 2>&1 || {
  cat build-cpu-only/run.log >&2
  exit 1
}
library=$(find build-cpu-only -name libnook.a)
c++ -std=c++20 -O2 -I sdk/include samples/minimal/ten_lines.cpp "$library" -o build-cpu-only/ten_lines
cc -std=c99 -O2 -I sdk/include samples/minimal/main.c "$library" -lstdc++ -lm -o build-cpu-only/minimal
build-cpu-only/ten_lines "$model"
build-cpu-only/minimal "$model"
