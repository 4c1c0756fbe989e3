#!/bin/sh
# From a clone to the showcase: builds, fetches the characters and props, bakes, draws, and combines the pictures into one.
# It needs no display.
#   samples/showcase/run.sh                   out/showcase/showcase.webp
#   samples/showcase/run.sh --mirrors FOLDER  reads the repositories from git directories named owner+name
#   samples/showcase/run.sh street            the street corner, which needs no other file
# NOOK_BUILD names the build folder; default: build.
set -eu
here="$(cd "$(dirname "$0")" && pwd)"
cd "$here/../.."
build="${NOOK_BUILD:-build}"
out=out/showcase
if [ ! -f "$build/build.ninja" ]; then
  ./install_packages.sh
  mkdir -p "$build"
  cmake -G Ninja -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DNOOK_PRECOMPILE=ON -DNOOK_PRECOMPILE_LIBRARY=ON
fi
ninja -C "$build" showcase nook_tool mannequin

# draw SHOT WIDTH HEIGHT RAYS STAGE...
draw() {
  shot=$1 width=$2 height=$3 rays=$4
  shift 4
  "$build/samples/showcase/showcase" "$@" --shot "$shot" --width "$width" --height "$height" --rays "$rays" \
    --sun-rays "$rays" --out "$pictures/$shot"
}

if [ "${1:-}" = street ]; then
  pictures=$out/street
  mkdir -p "$pictures"
  "$build/bakers/mannequin/mannequin" "$out/mannequin.glb"
  set -- --character "$out/mannequin.glb" --model samples/minimal/mannequin.nook
else
  pictures=$out/yard
  samples/showcase/fetch.py "$out/assets" "$@"
  mkdir -p "$out/models"
  # bake NAME MESH...: bakes a character without these meshes. yard.json leaves out the same meshes.
  bake() {
    name=$1
    shift
    [ -f "$out/models/$name.nook" ] || "$build/bakers/tool/nook" bake character "$out/assets/characters/$name.glb" "$@" \
      --preset draft -o "$out/models/$name.nook"
  }
  bake Barbarian --without 1H_Axe_Offhand --without Barbarian_Round_Shield --without 1H_Axe --without 2H_Axe
  bake Mage --without Spellbook --without Spellbook_open --without 1H_Wand --without 2H_Staff
  bake Knight --without 1H_Sword_Offhand --without Badge_Shield --without Rectangle_Shield --without Spike_Shield --without 2H_Sword
  bake Rogue_Hooded --without Knife_Offhand --without 1H_Crossbow --without 2H_Crossbow --without Knife --without Throwable
  set -- --stage samples/showcase/yard.json --assets "$out/assets" --models "$out/models"
fi
draw whole 1600 900 6 "$@"
draw feet 264 300 32 "$@"
draw hands 264 300 32 "$@"
samples/showcase/sheet.py "$pictures" "$out/$(basename "$pictures").webp"
echo "look at $out/$(basename "$pictures").webp"
