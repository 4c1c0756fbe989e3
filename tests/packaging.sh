#!/usr/bin/env bash
# Builds the packages of the committed tree, as far as this machine has their tools: Debian's, checked by lintian, whose
# library a C program then links; the vcpkg port; the Conan recipe. The folder is NOOK_PACKAGES_DIR, by default
# build-packages.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=${NOOK_PACKAGES_DIR:-$root/build-packages}
version=$(sed -n 's/^project(nook VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")

has() {  # what, commands...
  local what=$1 command
  shift
  for command in "$@"; do
    command -v "$command" > /dev/null || { echo "== $what: left out, $command is not installed"; return 1; }
  done
  echo "== $what"
}

debian() {
  rm -rf "$out/debian"
  mkdir -p "$out/debian"
  cd "$out/debian"
  git -C "$root" archive --prefix="nook-$version/" HEAD -- . ':!debian' | gzip -n > "nook_$version.orig.tar.gz"
  git -C "$root" archive --prefix="nook-$version/" HEAD | tar x
  (cd "nook-$version" && dpkg-buildpackage -us -uc)
  # The first upload to Debian closes a bug, which has a number then only.
  lintian --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs "nook_${version}"-*.changes
  for package in lib*.deb; do
    case $package in *dbgsym*) ;; *) dpkg-deb -x "$package" installed ;; esac
  done
  local libraries
  libraries=$(dirname "$(find "$PWD/installed" -name libnook.so)")
  # shellcheck disable=SC2046
  cc "$root/tests/install/consumer/main.c" -o consumer \
    $(PKG_CONFIG_PATH="$libraries/pkgconfig" pkg-config --cflags --libs nook)
  LD_LIBRARY_PATH="$libraries" ./consumer
}

if has Debian dpkg-buildpackage dh lintian pkg-config; then debian; fi
if has vcpkg vcpkg; then
  (mkdir -p "$out/vcpkg" && cd "$out/vcpkg" && vcpkg install --classic --overlay-ports="$root/packaging/vcpkg" nook)
fi
if has Conan conan; then
  (cd "$root" && conan create packaging/conan --build=missing)
fi
