#!/usr/bin/env bash
# The page in Chromium without a window: builds it by build.sh, whose arguments these are, and runs test.mjs. Then it matches the
# vertices of shared characters (match_test.mjs), which are in NOOK_ASSETS/characters.
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
  echo "skipped: the matches of shared characters, as there is no folder $characters; set NOOK_ASSETS" >&2
fi
