#!/usr/bin/env python3
"""Counts words of a private dialect, of goals and of history in comments, messages and documents.

words.txt lists the expressions, limits.json the largest count that each part of the tree may have. A part is a
top-level folder; sdk/include and sdk/src are parts of their own. The exit code is 1 if a count is above its limit.

  check.py                 prints the counts beside their limits
  check.py --list [PART]   prints each match with its file and line
  check.py --lower         writes the counts that are below their limits as the new limits
"""
import argparse
import bisect
import collections
import io
import json
import pathlib
import re
import sys
import tokenize

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
C_LIKE = {".h", ".hpp", ".c", ".cpp", ".inl", ".glsl", ".vert", ".frag", ".comp", ".in"}
HASH = {".cmake", ".sh", ".txt"}
FOLDERS = ["sdk/include", "sdk/src", "shaders", "bakers", "platform", "samples", "tests", "docs", "cmake"]
FILES_AT_ROOT = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "SECURITY.md", "CMakeLists.txt"]
COMMENT_OR_STRING = re.compile(
    r"""//(?P<line>[^\n]*)|/\*(?P<block>.*?)\*/|"(?P<string>(?:[^"\\\n]|\\.)*)"|'(?:[^'\\\n]|\\.)*'""", re.S)


def words():
    """The expressions of words.txt, all of a kind as one."""
    kinds, kind = {}, None
    for line in (HERE / "words.txt").read_text(encoding="utf-8").splitlines():
        line = line.split("  #")[0].strip()
        if line.startswith("[") and line.endswith("]") and " " not in line:
            kind = line[1:-1]
            kinds[kind] = []
        elif line and not line.startswith("#"):
            kinds[kind].append(f"(?i:{line[4:]})" if line.startswith("(?i)") else f"(?:{line})")
    return {kind: re.compile("|".join(expressions)) for kind, expressions in kinds.items()}


def c_texts(text):
    """(line number, text) of each comment, where adjoining line comments are one, and of each string."""
    run, run_line, last_line = [], 0, -2
    line_ends = [match.start() for match in re.finditer("\n", text)]
    for match in COMMENT_OR_STRING.finditer(text):
        line = bisect.bisect(line_ends, match.start()) + 1
        alone = text[text.rfind("\n", 0, match.start()) + 1:match.start()].strip() == ""
        if match.group("line") is not None:
            if run and alone and line == last_line + 1:
                run.append(match.group("line"))
            else:
                if run:
                    yield run_line, "\n".join(run)
                run, run_line = [match.group("line")], line
            last_line = line if alone else -2
        elif match.group("block") is not None:
            yield line, re.sub(r"(?m)^[ \t]*\*", "", match.group("block"))
        elif match.group("string") and "#include" not in text[text.rfind("\n", 0, match.start()) + 1:match.start()]:
            # A string need not be a sentence; the mark keeps it from matching the expressions for a comment's start.
            yield line, "\0" + match.group("string")
    if run:
        yield run_line, "\n".join(run)


def python_texts(text):
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            yield token.start[0], token.string[1:]
        elif token.type == tokenize.STRING and token.string.startswith(('"""', 'r"""')):
            yield token.start[0], token.string.strip('r"')


def hash_texts(text):
    for number, line in enumerate(text.split("\n"), 1):
        match = re.search(r"(^|\s)#(?!!)(.*)", line)
        if match:
            yield number, match.group(2)


def document_texts(text):
    """Paragraphs without inline code, and the comments of fenced code."""
    fenced, paragraph, start = False, [], 1
    for number, line in enumerate(text.split("\n"), 1):
        if line.startswith("```"):
            fenced = not fenced
            line = ""
        if fenced:
            match = re.search(r"(//|(^|\s)#)\s(.*)", line)
            line = match.group(3) if match else ""
        if not line.strip():
            if paragraph:
                yield start, "\n".join(paragraph)
            paragraph = []
            continue
        if not paragraph:
            start = number
        paragraph.append(re.sub(r"`[^`]*`", "`code`", line))
    if paragraph:
        yield start, "\n".join(paragraph)


def texts_of(path):
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix == ".md":
        return document_texts(text)
    if path.suffix == ".py":
        return python_texts(text)
    if path.suffix in C_LIKE:
        return c_texts(text)
    if path.suffix in HASH:
        return hash_texts(text)
    return ()


def matches(path, kinds):
    """(line, kind, matched text) of each match in a file."""
    for line, text in texts_of(path):
        # An expression may go across the end of a line.
        flat = re.sub(r"\s+", " ", text.strip())
        for kind, expression in kinds.items():
            for match in expression.finditer(flat):
                yield line, kind, flat[max(0, match.start() - 30):match.end() + 30].replace("\0", "")


def files_of(part):
    root = ROOT / part
    if root.is_file():
        return [root]
    return sorted(p for p in root.rglob("*") if p.is_file() and p.resolve().parent != HERE)


def parts():
    return FOLDERS + FILES_AT_ROOT


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--list", nargs="?", const="", metavar="PART")
    arguments.add_argument("--lower", action="store_true")
    options = arguments.parse_args()
    kinds = words()
    limits_file = HERE / "limits.json"
    limits = json.loads(limits_file.read_text(encoding="utf-8")) if limits_file.exists() else {}
    counts = {part: collections.Counter() for part in parts()}
    for part in parts():
        for path in files_of(part):
            for line, kind, text in matches(path, kinds):
                counts[part][kind] += 1
                if options.list is not None and str(path.relative_to(ROOT)).startswith(options.list):
                    print(f"{path.relative_to(ROOT)}:{line}: {kind}: {text}")
    print(f"{'part':16}" + "".join(f"{kind:>10}" for kind in kinds) + f"{'all':>10}{'limit':>10}")
    failed = False
    for part in parts():
        total, limit = sum(counts[part].values()), limits.get(part, 0)
        failed |= total > limit
        print(f"{part:16}" + "".join(f"{counts[part][kind]:10}" for kind in kinds) + f"{total:10}{limit:10}"
              + ("  above its limit; see check.py --list " + part if total > limit else ""))
    if options.lower:
        lowered = {part: min(sum(counts[part].values()), limits.get(part, sum(counts[part].values())))
                   for part in parts()}
        limits_file.write_text(json.dumps(lowered, indent=2) + "\n", encoding="utf-8")
    return 1 if failed and not options.lower else 0


if __name__ == "__main__":
    sys.exit(main())
