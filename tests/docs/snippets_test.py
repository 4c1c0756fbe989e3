#!/usr/bin/env python3
"""Compiles the fenced blocks of C, C++, GLSL and JavaScript in the documents.

  snippets_test.py C_COMPILER CXX_COMPILER

Blocks that docs/include_snippets.py copies from samples are left out: their programs compile them. The blocks of C and C++ of a page
follow one another in one function, and each block of GLSL has a scope of its own. What an engine would have, such as a texture or
a pose, is declared in tests/docs/snippets: engine.h for all pages of C and C++, and a file for each page with GLSL. In
GLSL, lines that begin with a qualifier (in, out, uniform) stand before the function. Blocks are compiled, not run:
tests/docs/printed_test.py runs the programs that README.md shows.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent / "snippets"
# The API reference repeats the headers, and printed_test.py has the block of the README.
PAGES = sorted(p for p in (ROOT / "docs").rglob("*.md") if p.parent.name != "api")


def blocks(page, language):
    text = re.sub(r"^<!-- samples/\S+: \w+ -->\n```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.M | re.S)


def name_of(page):
    return str(page.relative_to(ROOT / "docs")).removesuffix(".md").replace("/", "_")


def include(path, seen):
    """The text of a shader with its includes, each once, as the library puts them together."""
    if path in seen:
        return ""
    seen.add(path)
    return re.sub(r'^#include "(.*)"$', lambda match: include(ROOT / match.group(1), seen),
                  path.read_text(encoding="utf-8"), flags=re.M)


def compiled(command, text, suffix):
    """The compiler's messages, or nothing."""
    with tempfile.NamedTemporaryFile("w", suffix=suffix, encoding="utf-8") as file:
        file.write(text)
        file.flush()
        done = subprocess.run([*command, file.name], capture_output=True, text=True)
        return "" if done.returncode == 0 else done.stdout + done.stderr


def c_text(page, found):
    own = HERE / f"{name_of(page)}.h"
    first = f'#include "{HERE}/engine.h"\n' + (f'#include "{own}"\n' if own.exists() else "")
    return first + "void snippets(void);\nvoid snippets(void) {\n" + "\n".join(found) + "}\n"


def glsl_text(page, found):
    own = HERE / f"{name_of(page)}.frag"
    if not own.exists():
        sys.exit(f"{page.relative_to(ROOT)} has GLSL: declare what it needs in {own.relative_to(ROOT)}")
    outside, inside = [], []
    for block in found:
        inside.append("{")
        for line in block.split("\n"):
            (outside if re.match(r"(in|out|uniform|layout)\b", line) else inside).append(line)
        inside.append("}")
    return "#version 330 core\n" + include(own, set()) + "\n".join(outside) + "\nvoid main() {\n" + "\n".join(inside) + "}\n"


def javascript_of(_page, blocks):
    """A module with the imports of all blocks, and each block in a scope of its own."""
    lines = [line for block in blocks for line in block.split("\n")]
    imports = dict.fromkeys(line for line in lines if line.startswith("import "))
    # An export has no place in a scope, so that its value alone is checked.
    bodies = ["\n".join(re.sub("^export default ", "void ", line) for line in block.split("\n") if not line.startswith("import ")) for block in blocks]
    return "\n".join(imports) + "".join("\n{\n" + body + "\n}" for body in bodies) + "\n"


def main():
    c_compiler, cxx_compiler = sys.argv[1:3]
    warnings = ["-Wall", "-Wextra", "-Werror", "-Wno-unused", "-Wno-missing-field-initializers", "-Wno-sign-conversion", "-fsyntax-only", "-I", str(ROOT / "sdk/include")]
    languages = [("c", [c_compiler, "-std=c99", *warnings], c_text, ".c"),
                 ("cpp", [cxx_compiler, "-std=c++20", *warnings], c_text, ".cpp")]
    validator = shutil.which("glslangValidator")
    if validator:
        languages.append(("glsl", [validator], glsl_text, ".frag"))
    else:
        print("SKIPPED: the blocks of GLSL, which glslangValidator compiles (Debian: glslang-tools)")
    node = shutil.which("node")
    if node:
        languages.append(("js", [node, "--check"], javascript_of, ".mjs"))
    else:
        print("SKIPPED: the blocks of JavaScript, whose grammar node checks")
    failed = count = 0
    for language, command, text_of, suffix in languages:
        for page in PAGES:
            found = blocks(page, language)
            if not found:
                continue
            count += len(found)
            messages = compiled(command, text_of(page, found), suffix)
            if messages:
                failed += 1
                print(f"{page.relative_to(ROOT)}, {language}:\n{messages}")
    print(f"{count} blocks compiled, {failed} pages failed")
    return 1 if failed or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
