#!/bin/sh
# Nook in OGRE, OpenSceneGraph and VTK: installs what samples/hosts/packages.txt lists, builds the hosts and runs their tests.
# The build folder is NOOK_BUILD_DIR (default: build-hosts).
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${NOOK_BUILD_DIR:-$root/build-hosts}
"$root/install_packages.sh"
NOOK_PACKAGES="$root/samples/hosts/packages.txt" "$root/install_packages.sh"
cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DNOOK_HOSTS=ON \
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
ninja -C "$build" nook_hosts_tests nook_ogre_loader_tests
"$build/tests/hosts/nook_ogre_loader_tests"
"$build/tests/hosts/nook_hosts_tests"
