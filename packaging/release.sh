#!/usr/bin/env bash
# Builds a release of the committed tree in a clean folder, and tests it with example consumer programs.
#   packaging/release.sh [--only PART,...] [FOLDER]
# The parts are built in this order: source, python, blender, windows, debian, web. Checksums and third-party notices are
# always written. If the tools for a part are missing, the script skips the part and names it at the end. If a part fails, the script stops.
# The script empties FOLDER (default: build-release) and writes the files of the release to FOLDER/release. File names contain the
# version NOOK_RELEASE, such as 1.0.0-rc1 (default: the version in nook.h).
# The script refuses a commit that has not passed the platform tests in docs/platforms.md. Run them with docs/platforms_run.py.
# Every run makes identical files. Their timestamps are SOURCE_DATE_EPOCH, by default the time of the commit.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
parts=source,python,blender,windows,debian,web
if [ "${1:-}" = --only ]; then
  parts=$2
  shift 2
fi
out=${1:-$root/build-release}
header_value() { sed -n "s/^#define NOOK_VERSION_$1 \"\{0,1\}\([^\"]*\)\"\{0,1\}\$/\1/p" "$root/sdk/include/nook/nook.h"; }
version=${NOOK_RELEASE:-$(header_value MAJOR).$(header_value MINOR).$(header_value PATCH)$(header_value SUFFIX)}
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct)}
export TZ=UTC LC_ALL=C.UTF-8 PYTHONDONTWRITEBYTECODE=1
jobs=${NOOK_JOBS:-$(nproc)}
name=nook-$version
left_out=()

# Checks that the platform tests have been run with these sources.
"$root/docs/platforms_run.py" --check

rm -rf "$out"
mkdir -p "$out/release"
out=$(cd "$out" && pwd)
git -C "$root" archive --prefix="$name/" HEAD | tar x -C "$out"
tree=$out/$name

has() {  # PART COMMAND...
  local part=$1 command
  shift
  case ,$parts, in *",$part,"*) ;; *) return 1 ;; esac
  for command in "$@"; do
    command -v "$command" > /dev/null || { left_out+=("$part: $command is not installed"); return 1; }
  done
  echo "== $part"
}

# Sorted names, a fixed time and no owner make the archive reproducible.
archive() {  # ARCHIVE FOLDER NAME: FOLDER/NAME as .tar.gz or .zip
  case $1 in
    *.tar.gz) tar c -C "$2" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner "$3" | gzip -9n > "$1" ;;
    *.zip) python3 "$tree/packaging/zip_folder.py" "$1" "$2" "$3" ;;
  esac
}

# Writes the licences of all third-party code that the release contains or was compiled with.
notices() {
  local package file
  {
    echo "Third-party notices of $name"
    echo
    echo "The library contains code from the glad generator and from GLM's headers. The tool and nook_bake use the other libraries, which are"
    echo "not part of these files if a package manager installs them. Each text comes from the Debian package that the build used."
    for package in python3-glad libglm-dev libembree-dev libtbb-dev libeigen3-dev liblbfgspp-dev libopenimageio-dev libtinygltf-dev \
                   libcli11-dev libmeshoptimizer-dev libdraco-dev nlohmann-json3-dev; do
      file=/usr/share/doc/$package/copyright
      [ -e "$file" ] || continue
      printf '\n%s\n%s %s\n%s\n\n' "$(printf '=%.0s' {1..78})" "$package" "$(dpkg-query -W -f '${Version}' "$package")" "$(printf '=%.0s' {1..78})"
      cat "$file"
    done
  } > "$out/release/THIRD_PARTY_NOTICES.txt"
}

source_archive() {
  archive "$out/release/$name.tar.gz" "$out" "$name"
  # The archive must hold exactly the files of the tree.
  rm -rf "$out/from-archive"
  mkdir -p "$out/from-archive"
  tar xz -C "$out/from-archive" < "$out/release/$name.tar.gz"
  diff -r "$tree" "$out/from-archive/$name"
}

python_module() {
  local python=python3 module=$out/python-consumer
  # Uses the system's interpreter if the first python3 does not have numpy.
  "$python" -c "import numpy" 2> /dev/null || python=/usr/bin/python3
  "$python" "$tree/packaging/python/read_headers.py" --check
  "$python" "$tree/packaging/python/make_wheel.py" "$version" "$out/release"
  mkdir -p "$module"
  "$python" -m zipfile -e "$out"/release/nook_ao-*.whl "$module"
  # The test of struct layouts needs only a C compiler. If NOOK_LIBRARY names a library, the whole module is tested.
  (cd "$module" && PYTHONPATH=$module "$python" "$tree/tests/python/layouts_test.py")
  if [ -n "${NOOK_LIBRARY:-}" ]; then (cd "$module" && PYTHONPATH=$module "$python" "$tree/tests/python/module_test.py"); fi
}

blender_addon() {
  python3 "$tree/packaging/blender/make_addon.py" "$version" "$out/release"
  # If the command and the library are built, Blender installs the add-on, bakes a character and compares the colours.
  if [ -n "${NOOK_TOOL:-}" ] && [ -n "${NOOK_LIBRARY:-}" ] && command -v blender > /dev/null; then
    "$root/tests/blender.sh" --addon "$out/release/nook-blender-$version.zip" > "$out/blender.log" 2>&1 || { tail -20 "$out/blender.log"; return 1; }
    tail -1 "$out/blender.log"
  fi
}

windows_sdk() {
  local build=$out/windows-build folder=$name-windows-x86_64
  cmake -S "$tree" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE="$tree/cmake/toolchains/mingw-w64.cmake" \
    -DBUILD_SHARED_LIBS=ON -DNOOK_BAKERS=OFF -DNOOK_SAMPLES=OFF -DNOOK_TESTS=OFF \
    -DCMAKE_SHARED_LINKER_FLAGS="-Wl,--no-insert-timestamp -static" ${NOOK_LAUNCHER:+-DCMAKE_CXX_COMPILER_LAUNCHER=$NOOK_LAUNCHER} > "$out/windows.log"
  cmake --build "$build" -j "$jobs" >> "$out/windows.log"
  cmake --install "$build" --strip --prefix "$out/$folder" >> "$out/windows.log"
  cp "$tree/LICENSE" "$tree/NOTICE" "$tree/README.md" "$out/release/THIRD_PARTY_NOTICES.txt" "$out/$folder/"
  archive "$out/release/$folder.zip" "$out" "$folder"
  rm -rf "$out/windows-consumer"
  mkdir -p "$out/windows-consumer"
  python3 -m zipfile -e "$out/release/$folder.zip" "$out/windows-consumer"
  (cd "$out/windows-consumer" && x86_64-w64-mingw32-gcc "$tree/tests/install/consumer/main.c" -I "$folder/include" -L "$folder/lib" -lnook \
    -o consumer.exe && cp "$folder"/bin/*.dll . && WINEDEBUG=-all wine ./consumer.exe)
}

debian_packages() {
  # tests/packaging.sh builds the packages from the commit, checks them with lintian and runs programs that use them.
  (cd "$out" && CMAKE_C_COMPILER_LAUNCHER=${NOOK_LAUNCHER:-} CMAKE_CXX_COMPILER_LAUNCHER=${NOOK_LAUNCHER:-} \
    NOOK_PACKAGES_DIR="$out/packages" "$root/tests/packaging.sh")
  cp "$out"/packages/debian/*.deb "$out/release/"
}

web_package() {
  "$tree/packaging/web/build.sh" "$out/web" > "$out/web.log"
  cp "$out"/web/nook-web-*.tgz "$out/release/"
  mkdir -p "$out/web-consumer"
  printf '{ "private": true, "type": "module" }\n' > "$out/web-consumer/package.json"
  (cd "$out/web-consumer" && npm install --silent --no-audit --no-fund --no-package-lock --offline "$out"/release/nook-web-*.tgz &&
    node -e 'import("nook-web").then((m) => console.log("the package exports", Object.keys(m).length, "names"))')
}

notices
if has source tar gzip; then source_archive; fi
if has python python3; then python_module; fi
if has blender python3; then blender_addon; fi
if has windows x86_64-w64-mingw32-g++ cmake ninja wine; then windows_sdk; fi
if has debian dpkg-buildpackage dh lintian pkg-config; then debian_packages; fi
if has web emcmake node npm; then web_package; fi
(cd "$out/release" && find . -type f ! -name SHA256SUMS -printf '%P\n' | sort | xargs sha256sum > SHA256SUMS)
cat "$out/release/SHA256SUMS"
for reason in ${left_out[@]+"${left_out[@]}"}; do echo "LEFT OUT: $reason"; done
