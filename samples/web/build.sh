#!/usr/bin/env bash
# Builds the page: the native tools bake its data, packaging/web/build.sh makes nook-web, and npm installs it beside the page.
#   samples/web/build.sh [FOLDER]        FOLDER (default: build-web) takes FOLDER/site, which any file server can serve
# Native tools are built in NOOK_BUILD_DIR (default: build). It needs the packages of packages.txt and of samples/web/packages.txt.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
mkdir -p "${1:-$root/build-web}"
folder=$(cd "${1:-$root/build-web}" && pwd)
build=${NOOK_BUILD_DIR:-$root/build}
jobs=${NOOK_JOBS:-$(nproc)}
site=$folder/site
"$root/packaging/web/build.sh" "$folder"

launcher=()
command -v ccache > /dev/null && launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
[ -f "$build/build.ninja" ] || cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release "${launcher[@]}" > "$folder/native.log"
cmake --build "$build" -j "$jobs" --target nook_tool mannequin web_data

# Bakes are kept in FOLDER/models.
models=$folder/models
mkdir -p "$models"
nook=$build/bakers/tool/nook
"$build/bakers/mannequin/mannequin" "$models/mannequin.new.glb"
if ! cmp -s "$models/mannequin.new.glb" "$models/mannequin.glb" || [ ! -f "$models/mannequin.nook" ]; then
  mv "$models/mannequin.new.glb" "$models/mannequin.glb"
  "$nook" bake character "$models/mannequin.glb" --preset draft --quiet -o "$models/mannequin.nook"
fi
[ -f "$models/material.nook" ] || "$nook" bake material --meso roughhole --directions 25 --texels 48 --view-map 32 --quiet \
  -o "$models/material.nook"

rm -rf "$site"
mkdir -p "$site/data"
cp "$here"/page/* "$site/"
cp "$models/mannequin.nook" "$site/data/character.nook"
cp "$models/material.nook" "$site/data/material.nook"
"$build/samples/web/web_data" "$models/mannequin.glb" "$models/mannequin.nook" "$site/data"
printf '{ "private": true }\n' > "$site/package.json"
(cd "$site" && npm install --silent --no-audit --no-fund --no-package-lock --offline "$folder"/nook-web-*.tgz)
rm "$site/package.json"
echo "the page is in $site; node samples/web/serve.mjs $site serves it"
