#!/usr/bin/env bash
# The Blender add-on: installs what packaging/blender/packages.txt lists, makes the add-on's .zip file, installs it into a Blender
# without a screen, bakes a small character that Blender makes, and compares its colours with the C interface. Then it does what artists
# do (rows_test.py), measures shared characters (shared_test.py), renders animations in every way (render_test.py), and presses buttons in a
# window (window_test.py).
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
  env -u SOURCE_DATE_EPOCH python3 "$root/packaging/blender/make_addon.py" test "$folder"
fi
env -u SOURCE_DATE_EPOCH python3 "$root/packaging/python/make_wheel.py" 0.0.0 "$folder"
python3 -m zipfile -t "$folder"/nook_ao-*.whl
export BLENDER_USER_SCRIPTS="$folder/user" BLENDER_USER_CONFIG="$folder/user" PYTHONDONTWRITEBYTECODE=1
tests=$root/tests/blender

# A bake of few steps: for tests of whether colours belong to vertices, not of how good they are.
quick=$folder/nook-quick
printf '#!/bin/sh\n[ "$1" = bake ] && set -- "$@" --steps 100 --auto-poses 30 --rays 64\nexec "%s" "$@"\n' "$NOOK_TOOL" > "$quick"
chmod +x "$quick"

run() { # NAME COMMAND...: its output, and an end with a message if it fails
  local name=$1 status=0 start=$SECONDS
  shift
  "$@" > "$folder/$name.log" 2>&1 || status=$?
  if [ $status -ne 0 ]; then
    cat "$folder/$name.log"
    case $status in
      124 | 137) echo "tests/blender.sh: $name did not end and was stopped after $((SECONDS - start)) s" >&2 ;;
      *) echo "tests/blender.sh: $name failed with status $status after $((SECONDS - start)) s" >&2 ;;
    esac
    exit 1
  fi
  grep "^ok" "$folder/$name.log" || true
  echo "stage $name passed in $((SECONDS - start)) s"
}
# The scripts stop a Blender that hangs and print where it hangs (watch.py). The limit here is for what hangs before or after them.
export NOOK_WINDOW_SECONDS=${NOOK_WINDOW_SECONDS:-600}
on_display() { timeout -k 10 $((NOOK_WINDOW_SECONDS + 120)) xvfb-run -a -s "-screen 0 1000x700x24" "$@"; }

blender -b --factory-startup --python-exit-code 1 --python "$tests/blender_test.py" -- \
  "$addon" "$NOOK_TOOL" "$NOOK_LIBRARY" "$folder/character" ${1:+"$1"} | tee "$folder/log"
grep -q "^the add-on passes" "$folder/log"
left=$(find "$folder/temporary" -mindepth 1)
[ -z "$left" ] || { echo "tests/blender.sh: Blender left $left" >&2; exit 1; }

(cd "$folder" && run rows blender -b --factory-startup --python-exit-code 1 --python "$tests/rows_test.py" -- \
  "$quick" "$NOOK_LIBRARY" "$folder/rows")

# Five shared characters in two poses each, where they are.
characters=${NOOK_ASSETS:-$root/../shared/assets}/characters
if [ -d "$characters" ]; then
  blender -b --factory-startup --python-exit-code 1 --python "$tests/shared_test.py" -- "$NOOK_TOOL" "$NOOK_LIBRARY" "$folder/shared" \
    "$characters"/{cesium_man_CC-BY,fox_CC-BY,quaternius_horse_CC0,kaykit_knight_CC0,rocketbox_Male_Adult_04_MIT}.glb > "$folder/shared.log" 2>&1 ||
    { cat "$folder/shared.log"; echo "the shared characters failed"; exit 1; }
  grep -E "^(character |ok|.*\.glb +)" "$folder/shared.log"
else
  echo "skipped: the shared characters, as there is no folder $characters; set NOOK_ASSETS"
fi

frames=$folder/frames
mkdir "$frames"
run make blender -b --factory-startup --python-exit-code 1 --python "$tests/render_test.py" -- make "$quick" "$NOOK_LIBRARY" "$frames"
run animation blender -b -y "$frames/scene.blend" -o "$frames/background_" -a
run untrusted blender -b -Y "$frames/scene.blend" -o "$frames/untrusted_" -f 1
grep -q "^Nook: the ambient occlusion of Rig is not shown: auto-execution is off" "$folder/untrusted.log"
echo "ok    without auto-execution, stderr says why nothing is shown"
mkdir "$folder/elsewhere"
cp "$frames/scene.blend" "$folder/elsewhere"
run elsewhere blender -b -y "$folder/elsewhere/scene.blend" -o "$frames/elsewhere_" -f 1
grep -q "^Nook: the ambient occlusion of Rig is not shown: .* is not in the folder of " "$folder/elsewhere.log"
echo "ok    a bake outside of the folder of the .blend is not loaded unasked, and stderr says so"
for lock in 0 1; do
  run "window$lock" on_display blender "$frames/scene.blend" --python "$tests/render_test.py" -- window "$frames" $lock
done
run compare blender -b --factory-startup --python-exit-code 1 --python "$tests/render_test.py" -- \
  compare "$frames" script background window0 window1
run window on_display blender --enable-event-simulate "$frames/scene.blend" --python "$tests/window_test.py" -- "$folder/pressed"
grep -q "^the window passes" "$folder/window.log"
echo "the add-on passes"
