#!/usr/bin/env bash
# Tests the page in Chromium without a window. Builds it with build.sh, which gets this script's arguments, and runs
# test.mjs. Then runs match_test.mjs, which matches the vertices of the shared characters in NOOK_ASSETS/characters.
#   samples/hosts/three/test.sh [FOLDER]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=${1:-$here/../../../build-three}
"$here/build.sh" "$folder"
node "$here/test.mjs" "$folder/site" "$folder/three.png"
characters=${NOOK_ASSETS:-$here/../../../../shared/assets}/characters
if [ -d "$characters" ]; then
  node "$here/match_test.mjs" "$folder/site" "$characters" "${NOOK_BUILD_DIR:-$here/../../../build}/bakers/tool/nook"
else
  echo "skipped: the matches of shared characters, because the folder $characters does not exist; set NOOK_ASSETS" >&2
fi
