#!/usr/bin/env bash
# Builds the packages of the committed tree, as far as this machine has their tools: Debian's, checked by lintian and by the
# programs of debian/tests against the unpacked packages; the vcpkg port; the Conan recipe. The folder is NOOK_PACKAGES_DIR, by default
# build-packages.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=${NOOK_PACKAGES_DIR:-$root/build-packages}
version=$(sed -n '1s/^nook (\(.*\)-[^-]*).*/\1/p' "$root/debian/changelog")

has() {  # what, commands...
  local what=$1 command
  shift
  for command in "$@"; do
    command -v "$command" > /dev/null || { echo "== $what: left out, $command is not installed"; return 1; }
  done
  echo "== $what"
}

# Unpacks the packages, so that no root is needed, and runs what debian/tests has for installed ones.
test_packages() {  # SOURCE FOLDER
  local prefix=$2/installed package test library
  rm -rf "$prefix"
  for package in "$2"/*.deb; do
    case $package in *dbgsym*) ;; *)
      dpkg-deb -x "$package" "$prefix"
      # Each package states its licence.
      [ -e "$prefix/usr/share/doc/$(dpkg-deb -f "$package" Package)/copyright" ] || { echo "$package has no copyright file"; return 1; } ;;
    esac
  done
  library=$(dirname "$(find "$prefix" -name libnook.so)")
  for test in $(sed -n 's/^Tests: //p' "$1/debian/tests/control"); do
    echo "== debian/tests/$test"
    mkdir -p "$2/tests/$test"
    (cd "$1" && AUTOPKGTEST_TMP="$2/tests/$test" PATH="$prefix/usr/bin:$PATH" LD_LIBRARY_PATH="$library" \
      PKG_CONFIG_PATH="$library/pkgconfig" PYTHONPATH="$prefix/usr/lib/python3/dist-packages" PYTHONDONTWRITEBYTECODE=1 \
      "debian/tests/$test")
  done
  gzip -dc "$prefix/usr/share/man/man1/nook-bake-character.1.gz" > "$2/tests/man_page"
  grep -q preset "$2/tests/man_page"
  [ -e "$prefix/usr/share/doc/nook-doc/html/index.html" ]
}

debian() {
  rm -rf "$out/debian"
  mkdir -p "$out/debian"
  cd "$out/debian"
  git -C "$root" archive --prefix="nook-$version/" HEAD -- . ':!debian' | gzip -n > "nook_$version.orig.tar.gz"
  git -C "$root" archive --prefix="nook-$version/" HEAD | tar x
  (cd "nook-$version" && dpkg-buildpackage -us -uc ${NOOK_JOBS:+-j$NOOK_JOBS})
  # The first upload to Debian closes a bug, which has a number then only.
  lintian --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs "nook_${version}"-*.changes
  test_packages "$PWD/nook-$version" "$PWD"
}

if has Debian dpkg-buildpackage dh lintian pkg-config; then debian; fi
if has vcpkg vcpkg; then
  (mkdir -p "$out/vcpkg" && cd "$out/vcpkg" && vcpkg install --classic --overlay-ports="$root/packaging/vcpkg" nook)
fi
if has Conan conan; then
  (cd "$root" && conan create packaging/conan --build=missing)
fi
