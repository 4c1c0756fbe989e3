#!/usr/bin/env bash
# The Blender add-on: installs what packaging/blender/packages.txt lists, makes the add-on's .zip file, installs it into a Blender
# without a screen, bakes a small character that Blender makes, and compares its colours with the C interface.
#   tests/blender.sh [--addon FILE.zip] [PICTURES]     PICTURES: a folder for two rendered pictures
# NOOK_TOOL and NOOK_LIBRARY name a built command and libnook_python; without them, both are built in build.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
addon=
if [ "${1:-}" = --addon ]; then
  addon=$2
  shift 2
fi
NOOK_PACKAGES="$root/packaging/blender/packages.txt" "$root/install_packages.sh"
if [ -z "${NOOK_TOOL:-}" ] || [ -z "${NOOK_LIBRARY:-}" ]; then
  "$root/install_packages.sh"
  [ -e "$root/build/build.ninja" ] || cmake --preset dev -S "$root"
  ninja -C "$root/build" nook_tool nook_python
  NOOK_TOOL=$root/build/bakers/tool/nook
  NOOK_LIBRARY=$root/build/tests/python/library/libnook_python.so
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/user" ${1:+"$1"}
if [ -z "$addon" ]; then
  addon=$folder/nook-blender-test.zip
  SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct)} \
    python3 "$root/packaging/blender/make_addon.py" test "$folder"
fi
BLENDER_USER_SCRIPTS="$folder/user" BLENDER_USER_CONFIG="$folder/user" PYTHONDONTWRITEBYTECODE=1 \
  blender -b --factory-startup --python-exit-code 1 --python "$root/tests/blender/blender_test.py" -- \
  "$addon" "$NOOK_TOOL" "$NOOK_LIBRARY" "$folder/character" ${1:+"$1"} | tee "$folder/log"
grep "^the add-on passes" "$folder/log"
left=$(find "$folder/temporary" -mindepth 1)
[ -z "$left" ] || { echo "tests/blender.sh: Blender left $left" >&2; exit 1; }
