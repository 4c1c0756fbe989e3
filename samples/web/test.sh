#!/usr/bin/env bash
# Builds the package and the page, installs the package into an empty folder, and tests the page in Chromium without a
# window. Then follows docs/engines/three.md and the examples for bundlers in docs/web.md, and tests samples/hosts/three.
# These last steps need npm's registry.
#   samples/web/test.sh [--quick] [FOLDER]     --quick: 5 s of frames in place of 60; FOLDER as for build.sh
# Pictures and results.json go to FOLDER/test. The exit status is 0 if every check holds.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
seconds=60
if [ "${1:-}" = --quick ]; then
  seconds=5
  shift
fi
mkdir -p "${1:-$root/build-web}"
folder=$(cd "${1:-$root/build-web}" && pwd)
build=${NOOK_BUILD_DIR:-$root/build}
"$here/build.sh" "$folder"

# The package is installed elsewhere. If it lacked a file, it would still work next to its sources.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
printf '{ "private": true, "type": "module" }\n' > "$scratch/package.json"
(cd "$scratch" && npm install --silent --no-audit --no-fund --no-package-lock --offline "$folder"/nook-web-*.tgz)
cp "$here/package_test.mjs" "$scratch/"
# Emscripten 3.1.6 mistakes the fetch function of newer node versions for a browser's fetch.
(cd "$scratch" && node package_test.mjs "$folder/site/data")

cmake --build "$build" -j "${NOOK_JOBS:-$(nproc)}" --target web_screen web_picture
"$build/tests/web/web_screen" "$folder/site/data"
"$build/tests/web/web_picture" "$folder/site/data"
mkdir -p "$folder/test"
node "$here/test.mjs" "$folder/site" "$folder/test" "$seconds"
node "$here/faults_test.mjs" "$folder/site"

# These tests need npm's registry, for axe-core and for the packages that the guides of docs/ use.
if ! (cd "$scratch" && npm install --silent --no-audit --no-fund --no-package-lock --no-save axe-core@4); then
  echo "samples/web/test.sh: npm cannot install axe-core@4 from $(npm config get registry). NOT TESTED: axe-core's findings, the first" >&2
  echo "picture on a slow line, four bundlers, three.js from an empty folder, the page of samples/hosts/three. Everything before has passed." >&2
  exit 1
fi
node "$here/visit_test.mjs" "$folder/site" "$scratch/node_modules/axe-core/axe.min.js"
node "$here/guides_test.mjs" "$folder"/nook-web-*.tgz "$folder/models/mannequin.glb" "$folder/models/mannequin.nook" "$build/bakers/tool"

# The page of samples/hosts/three uses the same package and bake.
mkdir -p "$folder/three/site/data"
cp "$folder/models/mannequin.glb" "$folder/three/site/data/character.glb"
cp "$folder/models/mannequin.nook" "$folder/three/site/data/character.nook"
NOOK_WEB_DIR=$folder NOOK_BUILD_DIR=$build "$root/samples/hosts/three/test.sh" "$folder/three"
