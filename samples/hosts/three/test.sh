#!/usr/bin/env bash
# The page in Chromium without a window: builds it by build.sh, whose arguments these are, and runs test.mjs.
#   samples/hosts/three/test.sh [FOLDER]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=${1:-$here/../../../build-three}
"$here/build.sh" "$folder"
node "$here/test.mjs" "$folder/site" "$folder/three.png"
