#!/usr/bin/env bash
# Makes the npm package nook-web: the library as one WebAssembly module, with its JavaScript code and TypeScript types.
#   packaging/web/build.sh [FOLDER]     writes FOLDER/package and FOLDER/nook-web-VERSION.tgz
# FOLDER is build-web by default.
# You need Emscripten, CMake, Ninja, Node.js and npm (samples/web/packages.txt). As in every build of the library, you also need
# python3 with pip or glad for the OpenGL header.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
mkdir -p "${1:-$root/build-web}"
folder=$(cd "${1:-$root/build-web}" && pwd)
# Debian's Emscripten needs the module acorn from this folder.
[ -d /usr/share/nodejs/acorn ] && export NODE_PATH=/usr/share/nodejs
launcher=()
command -v ccache > /dev/null && launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
emcmake cmake -S "$here" -B "$folder/wasm" -G Ninja "${launcher[@]}" > "$folder/configure.log" 2>&1 || {
  cat "$folder/configure.log" >&2
  exit 1
}
cmake --build "$folder/wasm" -j "${NOOK_JOBS:-$(nproc)}" --target nook_module
rm -rf "$folder/package" "$folder"/nook-web-*.tgz
mkdir -p "$folder/package"
cp "$here"/src/*.js "$here"/src/*.d.ts "$here/README.md" "$root/LICENSE" "$root/NOTICE" "$folder/wasm/package.json" \
  "$folder/wasm/nook.mjs" "$folder/wasm/nook.wasm" "$folder/package/"
# The class for three.js is in the sample's folder, because the sample's test tests it.
cp "$root/samples/hosts/three/nook_three.js" "$folder/package/three.js"
chmod 644 "$folder/package/nook.wasm"
(cd "$folder" && npm pack --silent ./package)
