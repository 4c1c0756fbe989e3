#!/usr/bin/env python3
"""Writes docs/api/*.md, one page for each public C header, from the header's comments.

With --check nothing is written; pages that differ from what the headers give are named, and the exit code is 1.
"""
import itertools
import pathlib
import re
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = ROOT / "sdk/include/nook"
HEADERS = sorted(INCLUDE.glob("*.h")) + sorted((INCLUDE / "experimental").glob("*.h"))
PAGES = ROOT / "docs/api"
# A header, such as nook_bake.h, or a name that headers declare.
NAME = re.compile(r"\b(?:(nook(?:_\w+)?)\.(?:hpp|h)\b|((?:nook|NOOK)_\w+)(?:\(\))?)")
# First sentences that do not describe the function.
CONTRACT = re.compile(r"(Any thread|One at a time|Context thread|On failure|Errors)\b")


class Item:
    """A section title, or declarations that share one comment."""

    def __init__(self, comment, code):
        self.comment = comment
        self.code = [re.sub(r"^NOOK_API ", "", line) for line in code]
        if code and any(line.startswith("NOOK_API ") for line in code):
            # Parameters stay below the parenthesis.
            self.code = [line[len("NOOK_API "):] if line.startswith(" " * 20) else line for line in self.code]
        self.names = declared_names("\n".join(code))

    def title(self):
        if len(self.names) > 1 and self.names[0].isupper():
            return f"{self.names[0]} to {self.names[-1]}"
        return ", ".join(self.names)

    def anchor(self):
        """The anchor that Markdown renderers derive from the title."""
        return re.sub(r"[^\w -]", "", self.title().lower()).replace(" ", "-")

    def summary(self):
        sentence = re.split(r"(?<=[\w)]\.)\s", " ".join(self.comment).strip())[0]
        return "" if CONTRACT.match(sentence) else sentence.rstrip(".")


def declared_names(code):
    """The names of a block of declarations: functions and types, or constants if nothing else has a name."""
    code = re.sub(r"/\*.*?\*/", "", code, flags=re.S)
    functions = re.findall(r"^(?:NOOK_API|static inline) [^;(]*?(nook_\w+)\(", code, re.M)
    types = re.findall(r"^typedef [^;{]*\(\*(nook_\w+)\)", code, re.M)
    types += re.findall(r"^typedef [^;{(]*?(nook_\w+);", code, re.M)
    types += re.findall(r"^\} (nook_\w+);", code, re.M)
    macros = re.findall(r"^#define (\w+)", code, re.M)
    return functions + types + macros or re.findall(r"\bNOOK_\w+", code)


def comment_lines(lines):
    text = "\n".join(lines).strip()[2:-2]
    return [re.sub(r"^ ?\* ?", "", line).rstrip() if i else line.strip() for i, line in enumerate(text.split("\n"))]


def parse(text):
    """The comment at the top, then sections (their title, and their text as a list of lines) and items in the
    header's order."""
    blocks, comment, code, depth = [], [], [], 0

    def close():
        nonlocal comment, code
        if code:
            blocks.append(Item(comment, code))
        comment, code = [], []

    lines = iter(text.split("\n"))
    for line in lines:
        # Depth 1 is the include guard; deeper levels only serve compilers.
        if re.match(r"#\s*if", line):
            depth += 1
        elif re.match(r"#\s*endif", line):
            depth -= 1
        elif depth > 1 or re.match(r"#include|#define \w+$", line):
            continue
        elif line.startswith("/*"):
            found = [line]
            while not found[-1].rstrip().endswith("*/"):
                found.append(next(lines))
            close()
            comment = comment_lines(found)
            section = re.match(r"-+ (.*?) -+$", comment[0])
            if not blocks:
                blocks.append(comment)
                comment = []
            elif section:
                blocks.append(section.group(1))
                # The text of a section follows its title.
                if len(comment) > 1:
                    blocks.append(comment[1:])
                comment = []
        elif line.strip():
            code.append(line)
        elif code and code[-1].endswith((";", "}")) or code and code[0].startswith("#define"):
            close()
    close()
    return blocks


def escape(text):
    """Escapes the characters that have a meaning in Markdown."""
    return re.sub(r"([*<\[])", r"\\\1", text)


def prose(lines, link):
    """Comment lines as Markdown; indented text keeps its lines."""
    out = []
    for indented, run in itertools.groupby(lines, key=lambda line: line.startswith("  ")):
        if indented:
            out += ["", "```text", textwrap.dedent("\n".join(run)), "```", ""]
        else:
            out += [NAME.sub(link, escape(line)) for line in run]
    return "\n".join(out).strip()


def where_of(name):
    return next(h.relative_to(ROOT).as_posix() for h in HEADERS if h.stem == name)


def page(name, blocks, places):
    headers = {header.name for header in HEADERS}

    def link_from(item):
        def link(match):
            header = match.group(1)
            if header:
                has_page = header != name and match.group(0) in headers
                return f"[`{match.group(0)}`]({header}.md)" if has_page else f"`{match.group(0)}`"
            target = places.get(match.group(2))
            if not target or item and match.group(2) in item.names:
                return f"`{match.group(0)}`"
            where = "" if target[0] == name else f"{target[0]}.md"
            return f"[`{match.group(0)}`]({where}#{target[1]})"

        return link

    out = [f"# {name}.h", "", f"Made from `{where_of(name)}` by `docs/generate_api.py`.", "",
           prose(blocks[0], link_from(None)), ""]
    for block in blocks[1:]:
        if isinstance(block, list):
            continue
        if isinstance(block, str):
            out += ["", f"**{block}**", ""]
            continue
        summary = block.summary()
        out.append(f"- [{block.title()}](#{block.anchor()})" + (f": {escape(summary)}" if summary else ""))
    for block in blocks[1:]:
        if isinstance(block, str):
            out += ["", f"## {block}"]
            continue
        if isinstance(block, list):
            out += ["", prose(block, link_from(None))]
            continue
        out += ["", f"### {block.title()}", ""]
        if block.comment:
            out += [prose(block.comment, link_from(block)), ""]
        out += ["```c", *block.code, "```"]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(out)) + "\n"


def index(parsed):
    """The page that lists the headers, each with the first sentence of its comment."""
    out = ["# Reference", "", "One page for each C header, made by `docs/generate_api.py` from the headers' comments.",
           "`nook/nook.hpp` has the same functions as C++ classes, with the same names.", "", "| header | subject |", "|---|---|"]
    for name, blocks in parsed.items():
        sentence = re.split(r"(?<=[\w)])[.:](?:\s|$)", " ".join(" ".join(blocks[0]).split()))[0]
        out.append(f"| [{name}.h]({name}.md) | {escape(sentence)} |")
    return "\n".join(out) + "\n"


def main():
    parsed = {header.stem: parse(header.read_text(encoding="utf-8")) for header in HEADERS}
    places = {}
    for name, blocks in parsed.items():
        for item in (block for block in blocks if isinstance(block, Item)):
            constants = re.findall(r"\bNOOK_\w+(?= = )", "\n".join(item.code))
            for word in item.names + constants:
                places.setdefault(word, (name, item.anchor()))
    pages = {PAGES / f"{name}.md": page(name, blocks, places) for name, blocks in parsed.items()}

    pages[PAGES / "README.md"] = index(parsed)

    if "--check" in sys.argv[1:]:
        found = {path: path.read_text(encoding="utf-8") for path in PAGES.glob("*.md")}
        stale = [path for path in sorted(pages.keys() | found.keys()) if pages.get(path) != found.get(path)]
        for path in stale:
            print(f"{path.relative_to(ROOT)} is not what its header gives; run python3 docs/generate_api.py")
        return 1 if stale else 0
    PAGES.mkdir(exist_ok=True)
    for path, text in pages.items():
        path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
