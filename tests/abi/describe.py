#!/usr/bin/env python3
"""The public C interface as text, compared with what the repository has and what CHANGELOG.md tells of it.

  describe.py              fails where the headers differ from abi.txt, or where something changed since the last release
                           that CHANGELOG.md does not name
  describe.py --write      writes abi.txt
  describe.py --release    writes released.txt too: what the next changes are compared with

A line of the description is a function with its types, a structure with its fields in their order, a constant with its
value, or another type. A name in CHANGELOG.md counts in full, or by its beginning and a star: nook_world_*.
"""
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
HEADERS = sorted((ROOT / "sdk/include/nook").rglob("*.h"))


def declarations(text):
    """The declarations of a header, each on one line, without comments, guards and other lines of the preprocessor."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", " ", text, flags=re.S)
    text = re.sub(r"\\\n", " ", text)
    defines = re.findall(r"^[ \t]*#[ \t]*define[ \t]+(NOOK_\w+)[ \t]+(\S.*)$", text, re.M)
    text = re.sub(r"^[ \t]*#.*$", "", text, flags=re.M)
    text = re.sub(r'extern "C" \{', "", text)
    # Inline functions end without a semicolon.
    text = re.sub(r"(static inline [^{]*?)\s*\{[^}]*\}", r"\1;", text)
    found, start, depth = [], 0, 0
    for i, letter in enumerate(text):
        depth += {"{": 1, "}": -1}.get(letter, 0)
        # The brace of extern "C" closes last.
        depth = max(depth, 0)
        if letter == ";" and depth == 0:
            found.append(" ".join(text[start:i].split()).lstrip("} "))
            start = i + 1
    return found, defines


def constants(body):
    """Names and values of an enumeration; a value that is not given follows the one before."""
    out, following = [], 0
    for entry in filter(None, (e.strip() for e in body.split(","))):
        name, _, value = (p.strip() for p in entry.partition("="))
        value = value or str(following)
        following = int(value, 0) + 1 if re.fullmatch(r"-?\w+", value) and re.match(r"-?\d", value) else following + 1
        out.append(f"constant {name} = {value}")
    return out


def fields_of(body):
    """The fields of a structure, each by itself, so that `float a, b;` is what `float a; float b;` is."""
    fields = []
    for field in filter(None, (f.strip() for f in body.split(";"))):
        first, *others = [field] if "(" in field else [part.strip() for part in field.split(",")]
        kind = re.match(r"(.*?[ *])\w+(?:\[\w+\])*$", first).group(1) if others else ""
        fields += [first] + [kind + other for other in others]
    return "; ".join(fields)


def describe(paths):
    """The lines of the description, sorted, so that a move between headers changes nothing."""
    lines = set()
    for path in paths:
        found, defines = declarations(path.read_text(encoding="utf-8"))
        # Macros of the compiler and of guards are not part of the interface.
        lines |= {f"constant {name} = {' '.join(value.split())}" for name, value in defines
                  if not re.search(r"__|declspec|attribute", value) and name not in ("NOOK_API",)}
        for code in found:
            enumeration = re.fullmatch(r"(?:typedef )?enum ?\w* ?\{(.*)\} ?\w*", code)
            structure = re.fullmatch(r"typedef struct \w* ?\{(.*)\} (\w+)", code)
            if enumeration:
                lines |= set(constants(enumeration.group(1)))
            elif structure:
                lines.add(f"struct {structure.group(2)} {{ {fields_of(structure.group(1))} }}")
            elif code.startswith("NOOK_API ") or code.startswith("NOOK_BAKE_API "):
                lines.add("function " + code.split(" ", 1)[1])
            elif code.startswith("static inline "):
                lines.add("inline " + code.removeprefix("static inline "))
            elif code.startswith("typedef "):
                lines.add("type " + code.removeprefix("typedef "))
    return sorted(lines)


def name_of(line):
    if line.startswith(("function", "inline")):
        return re.search(r"(\w+)\(", line).group(1)
    if line.startswith("type"):
        return re.search(r"\(\*(\w+)\)|(\w+)$", line).group(0).strip("(*)")
    return line.split()[1]


def unnamed(before, now, changelog):
    """Names of what changed that the changelog does not name."""
    words = set(re.findall(r"\w+\*?", changelog))
    beginnings = tuple(w[:-1] for w in words if w.endswith("*") and len(w) > 6)
    names = sorted({name_of(line) for line in set(before) ^ set(now)})
    return [n for n in names if n not in words and not n.startswith(beginnings or ("\0",))]


def read(name):
    path = HERE / name
    return path.read_text(encoding="utf-8").splitlines() if path.exists() else []


def main():
    now = describe(HEADERS)
    for name, option in (("abi.txt", ("--write", "--release")), ("released.txt", ("--release",))):
        if set(option) & set(sys.argv[1:]):
            (HERE / name).write_text("\n".join(now) + "\n", encoding="utf-8")
    if not sys.argv[1:] and now != read("abi.txt"):
        known = read("abi.txt")
        print("The headers differ from tests/abi/abi.txt:")
        print("\n".join([f"  gone: {line}" for line in known if line not in now] + [f"  new:  {line}" for line in now if line not in known]))
        print("If this is meant, run python3 tests/abi/describe.py --write and name the change in CHANGELOG.md.")
        return 1
    # The newest section of the changelog, and the pages that have each old name beside its new one.
    pages = ["docs/from_rc1.md", "docs/lab/from_rc1.md"]
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").split("\n## ")[1]
    missing = unnamed(read("released.txt"), now, changelog + "".join((ROOT / page).read_text(encoding="utf-8") for page in pages))
    if missing:
        print("Neither the newest section of CHANGELOG.md nor docs/lab/from_rc1.md names these, which changed since the last release:\n  " + "\n  ".join(missing))
        return 1
    functions = sum(line.startswith("function") for line in now)
    print(f"{functions} functions, {sum(line.startswith('struct') for line in now)} structures, {len(now)} lines")
    return 0


if __name__ == "__main__":
    sys.exit(main())
