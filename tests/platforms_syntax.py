#!/usr/bin/env python3
"""Reads all sources of the library and of the web glue by the compilers of Windows, ARM64 and WebAssembly.

Each compiler gets the flags of a real build, with -fsyntax-only in place of -c, and warnings are errors. It sees the
instruction sets of its own platform. A source that no platform reads is an error. Nothing is linked or run:
tests/portability.sh does that.

  platforms_syntax.py [PLATFORM...]     all by default: wasm windows arm64

It installs tests/portability/syntax_packages.txt. NOOK_BUILD_DIR (default: build) is the first part of the folders'
names, NOOK_JOBS the number of compilers at a time.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = os.environ.get("NOOK_BUILD_DIR", str(ROOT / "build")) + "-syntax"
JOBS = int(os.environ.get("NOOK_JOBS", os.cpu_count()))

# The web project takes the library as a sub-project, the others are the library alone.
LIBRARY = ["-DNOOK_BAKERS=OFF", "-DNOOK_SAMPLES=OFF", "-DNOOK_TESTS=OFF", "-DBUILD_SHARED_LIBS=ON"]
TOOLCHAINS = ROOT / "cmake/toolchains"
PLATFORMS = {
    "wasm": (["emcmake"], ROOT / "packaging/web", []),
    "windows": ([], ROOT, [*LIBRARY, f"--toolchain={TOOLCHAINS}/mingw-w64.cmake"]),
    "arm64": ([], ROOT, [*LIBRARY, f"--toolchain={TOOLCHAINS}/aarch64-linux-gnu.cmake"]),
}


def run(command, **options):
    """The output of the command. The script ends with it if the command fails."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode:
        sys.exit(f"{shlex.join(map(str, command))}\n{done.stdout}")
    return done.stdout


def configure(platform):
    """Configures the platform's build, makes its generated sources, and returns its compile commands."""
    wrapper, source, options = PLATFORMS[platform]
    folder = f"{BUILD}-{platform}"
    environment = dict(os.environ)
    # Debian's Emscripten takes acorn from there.
    if os.path.isdir("/usr/share/nodejs/acorn"):
        environment["NODE_PATH"] = "/usr/share/nodejs"
    run([*wrapper, "cmake", "-S", source, "-B", folder, "-G", "Ninja", "-DNOOK_WERROR=ON",
         "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *options], env=environment)
    generated = run(["ninja", "-C", folder, "-t", "targets", "rule", "CUSTOM_COMMAND"]).splitlines()
    made = [name for name in generated if pathlib.Path(name).suffix in {".cpp", ".h", ".inc"}]
    run(["ninja", "-C", folder, "-j", str(JOBS), *made], env=environment)
    return json.loads((pathlib.Path(folder) / "compile_commands.json").read_text(encoding="utf-8"))


def syntax_command(entry):
    """The compile command of a source without its object."""
    words, kept = shlex.split(entry["command"]), []
    while words:
        word = words.pop(0)
        if word == "-o":
            words.pop(0)
        elif word != "-c":
            kept.append(word)
    return [*kept, "-fsyntax-only"]


def check(entry):
    """The errors of the compiler for a source; empty without errors."""
    done = subprocess.run(syntax_command(entry), cwd=entry["directory"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    return done.stdout if done.returncode else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("platforms", nargs="*", metavar="PLATFORM")
    platforms = parser.parse_args().platforms or list(PLATFORMS)
    for platform in platforms:
        if platform not in PLATFORMS:
            parser.error(f'there is no platform "{platform}"; choose from {" ".join(PLATFORMS)}')
    subprocess.run([ROOT / "install_packages.sh"], check=True,
                   env={**os.environ, "NOOK_PACKAGES": str(ROOT / "tests/portability/syntax_packages.txt")})

    start = time.monotonic()
    failed, read = 0, set()
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        commands = dict(zip(platforms, pool.map(configure, platforms)))
        entries = [(platform, entry) for platform in platforms for entry in commands[platform]]
        for (platform, entry), text in zip(entries, pool.map(check, [entry for _, entry in entries])):
            read.add(pathlib.Path(entry["directory"], entry["file"]).resolve())
            if text:
                failed += 1
                print(f"{platform}: {entry['file']}\n{text}", flush=True)
    counts = ", ".join(f"{platform} {len(commands[platform])} sources" for platform in platforms)
    print(f"{counts}: {time.monotonic() - start:.0f} s")

    if set(platforms) == set(PLATFORMS):
        sources = [*(ROOT / "sdk").rglob("*.cpp"), *(ROOT / "packaging/web").rglob("*.cpp")]
        for source in sorted(set(sources) - read):
            failed += 1
            print(f"no platform reads {source.relative_to(ROOT)}; add it to the sources in CMake")
    if failed:
        sys.exit(f"{failed} sources failed")


if __name__ == "__main__":
    main()
