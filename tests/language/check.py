#!/usr/bin/env python3
"""Finds sentences that readers read twice, in comments, messages, help texts and documents.

CONTRIBUTING.md has the rules. The check counts five habits, and a part of the tree may have so many of each
for 1,000 of its words (limits.json). A part is a top-level folder; sdk/include and sdk/src are parts of their own.

  that-of     "that of", "those of", "the latter", "of which", "which it is": the reader has to search for the thing
  is-no       "is no sphere" in place of "is not a sphere"; "there is no sphere" is plain
  no-verb     a sentence of twelve words or more without a finite verb (verbs.txt lists the verbs of this project)
  too-long    a sentence of more than 30 words
  wrapped     a table inside a comment that a formatter wrapped

  check.py                 prints the counts beside their limits; exit code 1 if one is above its limit
  check.py --list [PART]   prints each sentence with its file and line
  check.py --words         prints how often public headers address the reader, and the number of comment words
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
FOLDERS = ["sdk/include", "sdk/src", "shaders", "bakers", "platform", "samples", "packaging", "tests", "docs", "cmake"]
FILES_AT_ROOT = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "SECURITY.md", "CMakeLists.txt"]
# Written by scripts, or texts of others; node_modules and build are not of this project.
LEFT_OUT = re.compile(r"docs/(api/|messages\.md)|node_modules/|/build/|\.pyc$")
KINDS = ["that-of", "is-no", "no-verb", "too-long", "wrapped"]
LONGEST_SENTENCE = 30
SHORTEST_WITH_VERB = 12
COMMENT_OR_STRING = re.compile(
    r"""//(?P<line>[^\n]*)|/\*(?P<block>.*?)\*/|"(?P<string>(?:[^"\\\n]|\\.)*)"|'(?:[^'\\\n]|\\.)*'""", re.S)
THAT_OF = re.compile(r"\b(that|those) of\b|\bthe (latter|former)\b|\bof (which|whom|whose)\b|\bwhich (it is|they are)\b", re.I)
IS_NO = re.compile(r"(?<!\bthere )\b(is|are|was|were) no (?!(longer|more|less|fewer|matter|one|other|such|better|worse)\b)", re.I)
AUXILIARY = set("""am is are was were be been has have had do does did can cannot could may might must shall should will would
isn't aren't doesn't don't can't won't needn't""".split())


def verb_forms():
    """Finite forms of the verbs in verbs.txt: the base form and the third person."""
    forms = set()
    for base in (HERE / "verbs.txt").read_text(encoding="utf-8").split():
        third = base + ("es" if re.search(r"(s|sh|ch|x|z|o)$", base) else "s")
        forms |= {base, re.sub(r"([^aeiou])ys$", r"\1ies", third)}
    return forms


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


PLAIN = re.compile(r"`[^`]*`|https?://\S+|\[([^\]]*)\]\([^)]*\)")
# The remarks in parentheses, and the lists of results that end the comment of a C function.
LIST = re.compile(r"\([^()]*\)|Errors: .*$")
NOT_PROSE = re.compile(r"^\s*([|#>*+-]|\d+\.|clang-format |$)|[{};=]\s*$|\w+\(.*\);?\s*$|[^ ]  +[^ ]")


def sentences(text):
    """Sentences of a comment or paragraph, without tables, code and formulas."""
    prose, flat = [], []
    for line in text.split("\n"):
        if NOT_PROSE.search(line):
            flat.append(" ".join(prose))
            prose = []
        else:
            prose.append(line.strip())
    flat.append(" ".join(prose))
    for piece in flat:
        for sentence in re.split(r"(?<=[.!?])(?<!\bal\.)\s+(?!.{0,3}\))|(?<=:)\s+(?=[A-Z])", LIST.sub(" ", PLAIN.sub(r"\1 code", piece))):
            if sentence.strip():
                yield sentence.strip()


def words_of(sentence):
    return re.findall(r"[A-Za-z][A-Za-z'_-]*", sentence)


def has_verb(words, verbs):
    lower = [word.lower() for word in words]
    return any(word in AUXILIARY or word in verbs for word in lower)


def matches(path, verbs):
    """(line, kind, sentence) of each habit in a file."""
    for line, text in texts_of(path):
        is_string, text = text.startswith("\0"), text.replace("\0", "")
        if is_string and len(text.split()) < 4:
            continue
        for sentence in sentences(text):
            words = words_of(sentence)
            for match in THAT_OF.finditer(sentence):
                yield line, "that-of", sentence
            if IS_NO.search(sentence):
                yield line, "is-no", sentence
            if is_string or re.search(r"[=^*/<>]|\w\(", sentence):
                continue
            if len(words) > LONGEST_SENTENCE:
                yield line, "too-long", sentence
            # A short noun phrase may explain itself after a colon: "8 floats: a unit dual quaternion."
            longest = max(len(words_of(part)) for part in re.split("[:;]", sentence))
            if longest >= SHORTEST_WITH_VERB and sentence.endswith(".") and not has_verb(words, verbs):
                yield line, "no-verb", sentence
        # A row of a table that ends in the middle of a cell was wrapped by a formatter. Strings are tables of programs.
        rows = [row for row in text.split("\n") if row.strip().startswith("| ") and row.count("|") > 1]
        if path.suffix != ".md" and not is_string and any(not row.strip().endswith("|") for row in rows):
            yield line, "wrapped", rows[0].strip()


def files_of(part):
    root = ROOT / part
    files = [root] if root.is_file() else sorted(p for p in root.rglob("*") if p.is_file())
    return [p for p in files if p.parent != HERE and not LEFT_OUT.search(str(p.relative_to(ROOT)))]


def parts():
    return FOLDERS + FILES_AT_ROOT


def count_words(part):
    texts = (text for path in files_of(part) for _, text in texts_of(path) if not text.startswith("\0"))
    return sum(len(text.split()) for text in texts)


def print_address():
    words = [word.lower() for path in files_of("sdk/include") for _, text in texts_of(path)
             if not text.startswith("\0") for word in words_of(text)]
    for group in (["you", "your"], ["must", "should", "can"]):
        count = sum(words.count(word) for word in group)
        print(f"public headers: {', '.join(group)}: {1000 * count / len(words):.1f} in 1,000 words")
    print("comment words:", sum(count_words(part) for part in FOLDERS if part != "docs"))


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--list", nargs="?", const="", metavar="PART")
    arguments.add_argument("--words", action="store_true")
    arguments.add_argument("--lower", action="store_true")
    options = arguments.parse_args()
    if options.words:
        print_address()
        return 0
    verbs = verb_forms()
    limits_file = HERE / "limits.json"
    limits = json.loads(limits_file.read_text(encoding="utf-8"))
    print(f"{'in 1,000 words':16}" + "".join(f"{kind:>10}" for kind in KINDS))
    failed, found = False, {}
    for part in parts():
        counts = collections.Counter()
        for path in files_of(part):
            for line, kind, sentence in matches(path, verbs):
                counts[kind] += 1
                if options.list is not None and str(path.relative_to(ROOT)).startswith(options.list):
                    print(f"{path.relative_to(ROOT)}:{line}: {kind}: {sentence}")
        total = max(count_words(part), 1000)
        found[part] = {kind: round(1000 * counts[kind] / total + 0.0049, 2) for kind in KINDS}
        above = [kind for kind in KINDS if found[part][kind] > limits.get(part, {}).get(kind, 0)]
        failed |= bool(above)
        print(f"{part:16}" + "".join(f"{found[part][kind]:10.2f}" for kind in KINDS)
              + (f"  {', '.join(above)} above the limit; see check.py --list {part}" if above else ""))
    if options.lower:
        lowered = {part: {kind: min(found[part][kind], limits.get(part, {}).get(kind, 1e9)) for kind in KINDS}
                   for part in parts()}
        limits_file.write_text(json.dumps(lowered, indent=1) + "\n", encoding="utf-8")
    return 1 if failed and not options.lower else 0


if __name__ == "__main__":
    sys.exit(main())
