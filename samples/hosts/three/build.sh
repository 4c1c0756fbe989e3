#!/usr/bin/env bash
# Makes the folder of the page: its own files, three.js and nook-web from npm, and the built-in character with its bake.
#   samples/hosts/three/build.sh [FOLDER]     FOLDER (default: build-three) takes FOLDER/site
# NOOK_BUILD_DIR (default: build) is a build of this repository with the targets nook_tool and mannequin. NOOK_WEB_DIR
# (default: build-web) is the folder of packaging/web/build.sh, which is run if the folder does not have a package yet.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)
build=${NOOK_BUILD_DIR:-$root/build}
web=${NOOK_WEB_DIR:-$root/build-web}
mkdir -p "${1:-$root/build-three}"
folder=$(cd "${1:-$root/build-three}" && pwd)
compgen -G "$web/nook-web-*.tgz" > /dev/null || "$root/packaging/web/build.sh" "$web"
mkdir -p "$folder/site/data"
cp "$here"/index.html "$here"/*.js "$here/package.json" "$folder/site/"
(cd "$folder/site" && npm install --silent --no-audit --no-fund --no-package-lock && npm install --silent --no-audit --no-fund \
  --no-package-lock --no-save "$web"/nook-web-*.tgz)
if [ ! -f "$folder/site/data/character.nook" ]; then
  "$build/bakers/mannequin/mannequin" "$folder/site/data/character.glb"
  "$build/bakers/tool/nook" bake character "$folder/site/data/character.glb" --preset draft --quiet -o "$folder/character.nook"
  mv "$folder/character.nook" "$folder/site/data/character.nook"
fi
