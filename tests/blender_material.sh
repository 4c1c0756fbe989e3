#!/usr/bin/env bash
# The Blender script that renders a tile into a raw material: a scene with a closed form, rendered in a Blender without a screen at
# 5 lights x 5 views x 8 x 8 texels, compared, and compressed by the command.
#   tests/blender_material.sh
# NOOK_TOOL names a built command; without it, it is built in build.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
NOOK_PACKAGES="$root/packaging/blender/packages.txt" "$root/install_packages.sh"
if [ -z "${NOOK_TOOL:-}" ]; then
  "$root/install_packages.sh"
  [ -e "$root/build/build.ninja" ] || cmake --preset dev -S "$root"
  ninja -C "$root/build" nook_tool
  NOOK_TOOL=$root/build/bakers/tool/nook
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export BLENDER_USER_SCRIPTS="$folder/user" BLENDER_USER_CONFIG="$folder/user" PYTHONDONTWRITEBYTECODE=1
mkdir "$folder/user"
test=$root/tests/blender/render_material_test.py
blender -b --factory-startup --python-exit-code 1 --python "$test" -- --scene "$folder/plates.blend" > "$folder/log"
blender -b "$folder/plates.blend" --python-exit-code 1 --python "$root/packaging/blender/render_material.py" -- \
  "$folder/plates.raw" --directions 5 --max-tilt 60 --texels 8 --samples 16 | grep "^render_material.py"
/usr/bin/python3 "$test" "$folder/plates.raw"
"$NOOK_TOOL" bake material --raw "$folder/plates.raw" --ranks 8,4,8,8 --votf-ranks 8,8 --view-map 0 --quiet -o "$folder/plates.nook"
echo "the raw material was compressed"
