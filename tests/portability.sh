#!/usr/bin/env bash
# Builds the library for the platforms that this machine can run, compares their results with GCC on Linux, runs
# the OpenGL tests on other drivers, and ends with a table. A row whose packages are missing names them; a row that fails makes
# the exit status 1. With row names as arguments it does those alone; --quick takes the rows windows, arm64 and wasm, without
# their OpenGL half; --list prints the names. tests/portability/packages.txt lists the packages.
#
# NOOK_BUILD_DIR (default: build) is the first part of the folders' names. NOOK_NATIVE is a folder that has Linux's cpu_results and
# write_portability_inputs; without it the row linux builds them. NOOK_CHARACTER and NOOK_MATERIAL are files to
# evaluate in place of the tests' own.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${NOOK_BUILD_DIR:-$root/build}-portability
all="linux clang libcxx windows windows-gl windows-static arm64 arm64-bakers wasm msvc-syntax gl-zink gl-softpipe es30 es31 es32 es31-softpipe browser"
quick=OFF
[ "${1:-}" = --quick ] && { quick=ON; build+=-quick; }
native=$build-linux
if [ -n "${NOOK_NATIVE:-}" ]; then native=$(cd "$NOOK_NATIVE" && pwd) || exit 2; fi
case ${1:-} in
  --list) echo "$all" | tr ' ' '\n'; exit 0 ;;
  --quick) shift; rows=${*:-windows arm64 wasm} ;;
  *) rows=${*:-$all} ;;
esac
jobs=${NOOK_JOBS:-$(nproc)}
launcher=()
command -v ccache > /dev/null && launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)

# The largest differences that a comparison allows: AO, light relative to its largest value, materials.
# The same instruction set by another compiler, or with another C library: rounding of the last bits, by which shadows may have
# codes a step apart, for 7e-5 of AO (kernel_agreement.cpp).
same_set=(8e-5 3e-6 3e-6)
# An instruction set that x86 lacks, against scalar: other roots and exponentials, another order of sums.
other_set=(1.2e-4 4e-5 4e-5)

missing() {  # Writes the reason and ends the row.
  echo "$*" > "$build-$row.reason"
  exit 77
}

need() {
  local command
  for command in "$@"; do command -v "$command" > /dev/null || missing "$command is not installed"; done
}

compile() {  # options...: cpu_results and the library for a platform, in $build-$row
  local folder=$build-$row options=(-DNOOK_GL=ON)
  # Compiled in less time; the kernels have an optimisation level of their own.
  [ $quick = ON ] && options=(-DNOOK_GL=OFF "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG")
  "${wrapper[@]}" cmake -S "$root/tests/portability" -B "$folder" -G Ninja -DNOOK_WERROR=ON "${options[@]}" "${launcher[@]}" "$@" &&
    cmake --build "$folder" -j "$jobs"
}

results() {  # command...: runs cpu_results by this command and compares its values with Linux
  local folder=$build-$row values=$build-linux/native.values set sets
  (cd "$build-linux" && "$@" run character.nook material.nook "$folder/$row.values") > "$folder/output" || return 1
  # Windows ends lines with two characters.
  tr -d '\r' < "$folder/output" | tee "$folder/sets"
  sets=$(awk '$2 ~ /^[0-9a-f]+$/ && length($2) == 16 {print $1}' "$folder/sets")
  [ -n "$sets" ] || { echo "cpu_results printed no hash"; return 1; }
  for set in $sets; do
    if grep -q "^$set " "$build-linux/sets"; then
      "$native/cpu_results" compare "$values" "$folder/$row.values" "${same_set[@]}" "$set" "$set" || return 1
    else
      "$native/cpu_results" compare "$values" "$folder/$row.values" "${other_set[@]}" scalar "$set" || return 1
    fi
  done | tee "$folder/compared"
}

row_linux() {
  wrapper=()
  if [ -z "${NOOK_NATIVE:-}" ]; then
    compile -DBUILD_SHARED_LIBS=ON "-DCMAKE_C_COMPILER=$(command -v gcc)" "-DCMAKE_CXX_COMPILER=$(command -v g++)" || return 1
  fi
  cd "$build-linux" || return 1
  "$native/write_portability_inputs" character.nook material.nook || return 1
  if [ -n "${NOOK_CHARACTER:-}" ]; then cp "$NOOK_CHARACTER" character.nook || return 1; fi
  if [ -n "${NOOK_MATERIAL:-}" ]; then cp "$NOOK_MATERIAL" material.nook || return 1; fi
  "$native/cpu_results" run character.nook material.nook native.values > sets || return 1
  cat sets
}

row_clang() {
  need clang-16 clang++-16
  wrapper=()
  compile "-DCMAKE_C_COMPILER=$(command -v clang-16)" "-DCMAKE_CXX_COMPILER=$(command -v clang++-16)" && results "$build-$row/cpu_results"
}

row_libcxx() {
  need clang-16 clang++-16
  [ -d /usr/lib/llvm-16/include/c++/v1 ] || missing "libc++-16-dev is not installed"
  wrapper=()
  compile "-DCMAKE_C_COMPILER=$(command -v clang-16)" "-DCMAKE_CXX_COMPILER=$(command -v clang++-16)" \
    -DCMAKE_CXX_FLAGS=-stdlib=libc++ && results "$build-$row/cpu_results"
}

under_wine() {
  # A folder of its own for wine's settings, and no display.
  env -u DISPLAY WINEPREFIX="$build-wine" WINEDEBUG=-all "WINEPATH=$build-$row/nook/sdk" wine "$build-$row/cpu_results.exe" "$@"
}

row_windows() {
  need x86_64-w64-mingw32-g++-posix x86_64-w64-mingw32-objdump wine
  wrapper=()
  compile --toolchain "$root/cmake/toolchains/mingw-w64.cmake" -DBUILD_SHARED_LIBS=ON || return 1
  [ $quick = ON ] || exported_functions || return 1
  results under_wine
}

exported_functions() {  # of the DLL and of Linux's library
  local folder=$build-$row linux=$build-linux/nook/sdk/libnook.so
  [ -f "$linux" ] || { echo "the row linux has built no shared library"; return 1; }
  nm -D --defined-only "$linux" | awk '{print $3}' | sort > "$folder/functions.linux"
  x86_64-w64-mingw32-objdump -p "$folder/nook/sdk/libnook.dll" |
    awk '/^\[Ordinal\/Name Pointer\]/ {table = 1; next} table && NF == 0 {exit} table {print $NF}' | sort > "$folder/functions"
  echo "$(wc -l < "$folder/functions") exported functions"
  diff "$folder/functions.linux" "$folder/functions" || { echo "the DLL exports other functions than the library of Linux"; return 1; }
}

# OpenGL on the DLL that the row windows has built, in a context that wine makes on a virtual screen.
row_windows-gl() {
  need wine xvfb-run
  [ -f "$build-windows/windows_gl.exe" ] || missing "the row windows has not built windows_gl.exe"
  xvfb-run -a -s "-screen 0 640x480x24" env LIBGL_ALWAYS_SOFTWARE=1 WINEPREFIX="$build-wine" WINEDEBUG=-all \
    "WINEPATH=$build-windows/nook/sdk" wine "$build-windows/windows_gl.exe" "$build-linux/character.nook"
  local status=$?
  [ $status -ne 77 ] || missing "wine has no OpenGL 3.3 here"
  return $status
}

row_windows-static() {
  need x86_64-w64-mingw32-g++-posix wine
  wrapper=()
  compile --toolchain "$root/cmake/toolchains/mingw-w64.cmake" && results under_wine
}

row_arm64() {
  need aarch64-linux-gnu-g++ qemu-aarch64-static
  wrapper=()
  compile --toolchain "$root/cmake/toolchains/aarch64-linux-gnu.cmake" &&
    results qemu-aarch64-static -L /usr/aarch64-linux-gnu "$build-$row/cpu_results"
}

# The bakers and the tool as the ARM64 compiler reads them, without a link. Debian's packages have the same headers of Embree and
# of the other libraries for both processors, so this machine's headers serve.
row_arm64-bakers() {
  need aarch64-linux-gnu-g++
  [ -d /usr/include/embree4 ] || [ -d /usr/include/embree3 ] || missing "libembree-dev is not installed"
  local folder=$build-$row flags glad=$build-linux/nook/sdk/src/gl/glad/include
  [ -d "$glad" ] || missing "the row linux has not made the header of OpenGL"
  flags=(-std=c++20 -Wall -Wextra -Wshadow -Werror -DNOOK_STATIC "-DNOOK_SOURCE_ROOT=\"$root\"" -I. -Isdk/include
         -isystem "$glad" -isystem /usr/include/eigen3 -idirafter /usr/include)
  cd "$root" || return 1
  printf '#include <%s>\n' algorithm filesystem functional map memory random string vector nlohmann/json.hpp > "$folder/common.h"
  aarch64-linux-gnu-g++ "${flags[@]}" -x c++-header "$folder/common.h" -o "$folder/common.h.gch" || return 1
  git ls-files 'bakers/*.cpp' 'platform/*.cpp' | tee "$folder/files" |
    xargs -P "$jobs" -n 1 aarch64-linux-gnu-g++ "${flags[@]}" -include "$folder/common.h" -fsyntax-only || return 1
  echo "$(wc -l < "$folder/files") files"
}

row_wasm() {
  need emcmake node
  [ -d /usr/share/nodejs/acorn ] && export NODE_PATH=/usr/share/nodejs
  wrapper=(emcmake)
  compile || return 1
  local options=()
  # Emscripten 3.1.6 takes the fetch of newer versions of node for a browser's.
  node --no-experimental-fetch -e 0 2> /dev/null && options=(--no-experimental-fetch)
  results node "${options[@]}" "$build-$row/cpu_results.js"
}

# The sources of the library as Clang reads them in its MSVC mode, with the headers of libc++ and MinGW in place of
# Microsoft's. These were not made for each other, so only errors in the library's own lines count, and what they lack does not.
row_msvc-syntax() {
  need clang++-16
  [ -d /usr/lib/llvm-16/include/c++/v1 ] || missing "libc++-16-dev is not installed"
  [ -d /usr/share/mingw-w64/include ] || missing "mingw-w64-common is not installed"
  # CMake passes these from the list of instruction sets; the kernels' own files are left out below.
  local set built=()
  for set in SCALAR SSE2 AVX2 AVX512 NEON WASM128; do built+=("-DNOOK_BUILT_$set=0"); done
  built[0]=-DNOOK_BUILT_SCALAR=1
  local file errors="" count=0 glad=$build-linux/nook/sdk/src/gl/glad/include
  [ -d "$glad" ] || missing "the row linux has not made the header of OpenGL"
  while read -r file; do
    count=$((count + 1))
    errors+=$(cd "$root" && clang++-16 --target=x86_64-pc-windows-msvc -fms-compatibility-version=19.38 -fms-extensions -std=c++20 \
      -fsyntax-only -ferror-limit=0 -nostdinc++ -D_LIBCPP_NO_VCRUNTIME -isystem /usr/lib/llvm-16/include/c++/v1 \
      -isystem /usr/share/mingw-w64/include -isystem "$glad" -I. -Isdk/include -DNOOK_BUILDING "${built[@]}" "$file" 2>&1 |
      grep -E "^(\./)?(sdk|shaders)/.* error:" | grep -v "'isfinite' in namespace 'std'")
  done < <(cd "$root" && git ls-files 'sdk/src/*.cpp' | grep -vE 'sse2|avx2|avx512|neon|wasm')
  echo "$errors"
  echo "$count files"
  [ -z "$errors" ]
}

gl_tests() {  # variables...: the OpenGL tests of $build-gl
  local folder=$build-gl
  cmake -S "$root" -B "$folder" -G Ninja -DNOOK_WERROR=ON -DNOOK_BAKERS=OFF -DNOOK_SAMPLES=OFF "${launcher[@]}" &&
    cmake --build "$folder" -j "$jobs" --target nook_gl_tests || return 1
  env NOOK_REQUIRE_GL=1 NOOK_TEST_CONTEXT=egl LIBGL_ALWAYS_SOFTWARE=1 "$@" "$folder/tests/gl/nook_gl_tests"
}

row_gl-zink() {
  local icd=/usr/share/vulkan/icd.d/lvp_icd.x86_64.json
  [ -f $icd ] || missing "lavapipe is not installed"
  gl_tests GALLIUM_DRIVER=zink VK_ICD_FILENAMES=$icd
}
row_gl-softpipe() { gl_tests GALLIUM_DRIVER=softpipe NOOK_TEST_VERSION=3.3; }
es_tests() {  # version, variables...
  local version=$1
  shift
  gl_tests "NOOK_TEST_VERSION=es$version" "MESA_GLES_VERSION_OVERRIDE=$version" "$@"
}
row_es30() { es_tests 3.0; }
row_es31() { es_tests 3.1; }
row_es32() { es_tests 3.2; }
row_es31-softpipe() { es_tests 3.1 GALLIUM_DRIVER=softpipe; }

row_browser() {
  need emcmake node chromium
  [ -x "$root/samples/web/test.sh" ] || missing "samples/web/test.sh does not exist"
  NOOK_BUILD_DIR=$build-$row "$root/samples/web/test.sh"
}

# Every comparison needs the values of Linux.
case " $rows " in *" linux "*) ;; *) rows="linux $rows" ;; esac
failed=0
table=""
for row in $rows; do
  case " $all " in *" $row "*) ;; *) echo "portability.sh: there is no row $row (there are: $all)" >&2; exit 2 ;; esac
  mkdir -p "$(dirname "$build")" "$build-$row"
  echo "== $row"
  start=$SECONDS
  ("row_$row") > "$build-$row/log" 2>&1
  status=$?
  case $status in
    0) state=ran; text=$(grep -hoE "^[0-9]+ exported functions|^tier .*|^All tests passed.*|^[0-9]+ files$" "$build-$row/log" | tail -1)
       [ -f "$build-$row/compared" ] && cat "$build-$row/compared" ;;
    77) state="not had"; text=$(cat "$build-$row.reason"); rm -f "$build-$row.reason" ;;
    *) state=FAILED; text="see $build-$row/log"; failed=1; tail -30 "$build-$row/log" ;;
  esac
  table+=$(printf '%-15s %-8s %4d s  %s' "$row" "$state" $((SECONDS - start)) "$text")$'\n'
done
printf '\n%s' "$table"
exit $failed
