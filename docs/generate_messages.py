#!/usr/bin/env python3
"""Writes docs/messages.md: every message of the library, of the bakers and of the tool, from the sources.

With --check nothing is written; the exit code is 1 if the page differs from what the sources give.
A message is the text of a Failure, a ToolError, a runtime_error, a refusal of an importer, or a line of the log.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/messages.md"
# The rooms, each with a title; the first that contains a file takes its messages.
ROOMS = [("sdk/src/api", "The C interface"), ("sdk/src/core", "Files and memory"), ("sdk/src/character", "Characters"),
         ("sdk/src/nnao", "Networks and recorded frames"), ("sdk/src/probe", "Probes"), ("sdk/src/material", "Materials"),
         ("sdk/src/world", "The world"), ("sdk/src/synthesis", "Synthesis"), ("sdk/src/transfer", "Transfer"), ("sdk/src/isa", "Instruction sets"), ("sdk/src/gl", "OpenGL"),
         ("sdk/src", "The library, other"), ("bakers/import", "Import of glTF and arrays"), ("bakers/images", "Images and measured materials"),
         ("bakers/tool", "The tool"), ("bakers/api", "The bakers' C interface"), ("bakers/measure", "Measurements"), ("bakers", "Bakes")]
CALL = re.compile(r"\b(Failure|ToolError|std::runtime_error|refuse|fault|warn|log|require|need|say|explain|warnings\.push_back)\s*\(")
# Texts that are put together first.
ASSIGNED = re.compile(r"\b(?:text|fault_?|warning)\s*\+?=(?!=)")
# The functions of sdk/src/core/checks.h, whose messages have the name of the value in front.
CHECK = re.compile(r"\b(check_fits|check_range|check_index|check_known|check_at_most|check_switch)\s*\(")
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
FORMAT = re.compile(r"%[-+ #0]*(?:\d+|\*)?(?:\.(?:\d+|\*))?(?:hh|h|ll|l|z|j|t)?[diuoxXeEfgGcsp]|%%")


def strip_comments(text):
    """Comments become spaces, so that positions stay."""
    pattern = re.compile(r'"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\'|//[^\n]*|/\*.*?\*/', re.S)
    return pattern.sub(lambda m: m.group(0) if m.group(0)[0] in "\"'" else re.sub(r"[^\n]", " ", m.group(0)), text)


def argument_text(text, start):
    """The text between a parenthesis and its partner."""
    depth, i = 1, start
    while i < len(text) and depth:
        if text[i] == '"':
            i = LITERAL.match(text, i).end()
            continue
        if text[i] == "'" and (close := re.compile(r"'(?:[^'\\\n]|\\.)+'").match(text, i)):
            i = close.end()
            continue
        depth += {"(": 1, ")": -1}.get(text[i], 0)
        i += 1
    return text[start:i - 1]


def message(argument):
    """The words of the literals of an argument, with an ellipsis in place of each value."""
    pieces, last = [], 0
    for match in LITERAL.finditer(argument):
        between = argument[last:match.start()].strip()
        if pieces and between and "," in between:
            break
        if pieces and between:
            pieces.append("…")
        pieces.append(match.group(1))
        last = match.end()
    text = "".join(pieces)
    if argument[last:].lstrip().startswith("+"):
        text += "…"
    text = FORMAT.sub(lambda m: "%" if m.group(0) == "%%" else "…", text)
    return text.replace('\\"', '"').replace("\\n", " ").replace("\\t", " ").replace("\\\\", "\\").strip()


def split_arguments(argument):
    """The arguments of a call, which commas part outside of brackets and literals."""
    parts, depth, last, i = [], 0, 0, 0
    while i < len(argument):
        if argument[i] == '"':
            i = LITERAL.match(argument, i).end()
            continue
        depth += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(argument[i], 0)
        if argument[i] == "," and depth == 0:
            parts.append(argument[last:i].strip())
            last = i + 1
        i += 1
    return [*parts, argument[last:].strip()]


def check_messages(function, argument):
    """The messages of a check, with the numbers that the call has in its text; none if the name is no literal."""
    arguments = split_arguments(argument)
    if len(arguments) < 2 or not LITERAL.fullmatch(arguments[0]):
        return []
    name = message(arguments[0])
    numbers = [re.fullmatch(r"(-?[\d.]+)f?", a) for a in arguments[2:4]]
    first, second = ([m.group(1) if m else "…" for m in numbers] + ["…", "…"])[:2]
    if function == "check_known":
        return [f"{name} is unknown (got …, need 0 to {first})"]
    if function == "check_switch":
        return [f"{name} is neither on nor off (got …, need 0 or 1)"]
    if function == "check_fits":
        # A need may depend on a condition.
        alternatives = arguments[3].split("?", 1)[-1].split(" : ")
        needs = [message(text) for text in alternatives]
    else:
        needs = [{"check_range": f"{first} to {second}", "check_index": "less than …", "check_at_most": f"at most {first}"}[function]]
    return [f"{name} is out of range (got …, need {need})" for need in needs]


def messages_of(path):
    text = strip_comments(path.read_text(encoding="utf-8"))
    arguments = [argument_text(text, call.end()) for call in CALL.finditer(text)]
    # Warnings of the import with numbers in them; elsewhere snprintf writes other things.
    if "import" in path.parts:
        arguments += [argument_text(text, call.end()) for call in re.finditer(r"\bsnprintf\s*\(", text)]
    arguments += [text[found.end():text.index(";", found.end())] for found in ASSIGNED.finditer(text)]
    # Importers return the end of a message.
    arguments += [text[found.end():text.index(";", found.end())] for found in re.finditer(r"\breturn\s+(?=\"[^\"]* [^\"]* )", text)]
    for call in CHECK.finditer(text):
        yield from check_messages(call.group(1), argument_text(text, call.end()))
    for argument in arguments:
        found = message(argument)
        # Names of arguments, source code, tables and pieces that are no words are no messages.
        if " " in found and not re.search(r"#define|layout\(|\|---|\{", found) and len(re.findall(r"[A-Za-z]{2,}", found)) >= 2:
            yield found


def collect():
    found = {title: set() for _, title in ROOMS}
    for path in sorted([*(ROOT / "sdk/src").rglob("*"), *(ROOT / "bakers").rglob("*")]):
        if path.suffix not in (".cpp", ".h", ".inl"):
            continue
        place = path.relative_to(ROOT).as_posix()
        title = next(t for folder, t in ROOMS if place.startswith(folder + "/"))
        found[title].update(messages_of(path))
    return found


def escape(text):
    return re.sub(r"([|<\[\]*_`])", r"\\\1", text)


def page(found):
    count = sum(map(len, found.values()))
    out = ["# Messages", "", f"Every message of the library, the bakers and the tool, {count} of them, by `docs/generate_messages.py` from the sources. An ellipsis stands for",
           "a value. A message begins with the name of the function or the file that it is about, then what is wrong, what was given, what is",
           "needed, and often the cure; so search for a few words from its middle. [Troubleshooting](troubleshooting.md) begins with symptoms.", "",
           "`NULL` pointers have one message: *name* is NULL; a valid pointer or handle is needed. A context, a model or another handle that was", "destroyed, or was never created, is such a pointer.", ""]
    for _, title in ROOMS:
        if found[title]:
            out += [f"## {title}", "", *(f"- {escape(text)}" for text in sorted(found[title], key=str.lower)), ""]
    return "\n".join(out)


def unknown_quotes(found):
    """Texts of several words that the symptoms of the troubleshooting page quote, and that no message has."""
    all_messages = " ".join(m for room in found.values() for m in room)
    rows = re.findall(r"^\| ([^|]*) \|", (ROOT / "docs/troubleshooting.md").read_text(encoding="utf-8"), re.M)
    quotes = [q for row in rows for q in re.findall(r"`([^`]+)`", row)]
    quotes += [q for row in rows for q in re.findall(r"\*([^*]+)\*", re.sub(r"`[^`]*`", "", row))]
    quotes = [q for q in quotes if " " in q]
    return [q for q in quotes if not all(part.strip() in all_messages for part in q.split("…"))]


def main():
    found = collect()
    text, unknown = page(found), unknown_quotes(found)
    if unknown:
        print("docs/troubleshooting.md quotes messages that are not there:\n  " + "\n  ".join(unknown))
        return 1
    if "--check" in sys.argv[1:]:
        if not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
            print("docs/messages.md is not what the sources give; run python3 docs/generate_messages.py")
            return 1
        return 0
    PAGE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
