#!/usr/bin/env python3
"""Writes nook/_layouts.py: the ctypes declarations of the constants, structures and functions in the public C headers.

With --check, writes nothing, and exits with code 1 if the file is not up to date with the headers.
tests/abi/describe.py parses the headers. The ABI test uses it too. The OpenGL headers are left out, because asset pipelines have
no OpenGL context and the module's library is built without OpenGL.
"""
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tests/abi"))
from describe import constants, declarations  # noqa: E402

HEADERS = ["nook", "nook_probe", "nook_character", "nook_material", "nook_bake", "experimental/nook_bake_key",
           "experimental/nook_bake_materials", "experimental/nook_calibration", "experimental/nook_debug", "experimental/nook_lod",
           "experimental/nook_match", "experimental/nook_poses", "experimental/nook_sg", "experimental/nook_trace", "experimental/nook_transfer"]
# Functions of experimental headers that need OpenGL. The module's library is built without OpenGL.
LEFT_OUT = re.compile(r"nook_gl_")
PAGE = HERE / "nook/_layouts.py"
SCALARS = {"void": "None", "char": "ctypes.c_char", "float": "ctypes.c_float", "double": "ctypes.c_double", "size_t": "ctypes.c_size_t",
           "int32_t": "ctypes.c_int32", "uint8_t": "ctypes.c_uint8", "uint16_t": "ctypes.c_uint16", "uint32_t": "ctypes.c_uint32",
           "int64_t": "ctypes.c_int64", "uint64_t": "ctypes.c_uint64", "int": "ctypes.c_int"}


def ctype(text, known):
    """Returns the ctypes form of a C type. A pointer to a type that these headers do not define becomes c_void_p."""
    words = [w for w in re.findall(r"\w+|\*", text) if w not in ("const", "struct")]
    base, stars = words[0], words.count("*")
    if stars and base == "void":
        form, stars = "ctypes.c_void_p", stars - 1
    elif stars and base == "char":
        form, stars = "ctypes.c_char_p", stars - 1
    elif stars and base not in SCALARS and base not in known:
        form, stars = "ctypes.c_void_p", stars - 1
    else:
        form = SCALARS.get(base, base)
    for _ in range(stars):
        form = f"ctypes.POINTER({form})"
    return form


def parameter(text, known):
    """Returns the name and the type of a parameter or a field. A parameter that is an array becomes a pointer."""
    match = re.fullmatch(r"(.*?)(\w+)((?:\[\w+\])*)", text.strip())
    return match.group(2), ctype(match.group(1), known), re.findall(r"\[(\w+)\]", match.group(3))


def split(text, letter):
    """Splits text at a separator character, but not inside parentheses."""
    parts, depth, start = [], 0, 0
    for i, c in enumerate(text):
        depth += {"(": 1, ")": -1}.get(c, 0)
        if c == letter and depth == 0:
            parts.append(text[start:i])
            start = i + 1
    return [p.strip() for p in parts + [text[start:]] if p.strip()]


def callback(result, parameters, known):
    kinds = [parameter(p, known)[1] for p in split(parameters, ",") if p != "void"]
    return f"ctypes.CFUNCTYPE({', '.join([ctype(result, known)] + kinds)})"


def fields(body, known, sizes):
    out = []
    for entry in split(body, ";"):
        pointer = re.fullmatch(r"(.*)\(\*(\w+)\)\((.*)\)", entry)
        if pointer:
            out.append((pointer.group(2), callback(pointer.group(1), pointer.group(3), known)))
            continue
        first, *others = split(entry, ",")
        kind = re.match(r"(.*?)\w+(?:\[\w+\])*$", first).group(1)
        for text in [first] + [f"{kind} {name}" for name in others]:
            name, form, dimensions = parameter(text, known)
            for size in reversed(dimensions):
                form = f"{form} * {sizes.get(size, size)}"
            out.append((name, form))
    return out


def page():
    known, sizes, body, functions = set(), {}, [], []
    values = {}
    for header in HEADERS:
        found, defines = declarations((ROOT / f"sdk/include/nook/{header}.h").read_text(encoding="utf-8"))
        for name, value in defines:
            number = value.strip("()").rstrip("fu")
            if re.fullmatch(r'"[^"]*"', value):
                values[name] = value
            elif re.fullmatch(r"-?[\d.]+", number):
                values[name] = number
                sizes[name] = number
        for code in found:
            enumeration = re.fullmatch(r"(?:typedef )?enum ?\w* ?\{(.*)\} ?\w*", code)
            structure = re.fullmatch(r"typedef struct \w* ?\{(.*)\} (\w+)", code)
            handle = re.fullmatch(r"typedef struct \w+\* (\w+)", code)
            function_type = re.fullmatch(r"typedef (.*)\(\*(\w+)\)\((.*)\)", code)
            function = re.fullmatch(r"NOOK_API (.*?)(\w+)\((.*)\)", code)
            alias = re.fullmatch(r"typedef (\w+) (\w+)", code)
            if enumeration:
                for line in constants(enumeration.group(1)):
                    name, value = line.removeprefix("constant ").split(" = ")
                    values[name] = value
            elif structure:
                known.add(structure.group(2))
                rows = "".join(f'        ("{name}", {form}),\n' for name, form in fields(structure.group(1), known, sizes))
                body.append(f"class {structure.group(2)}(ctypes.Structure):\n    _fields_ = [\n{rows}    ]\n")
            elif handle:
                known.add(handle.group(1))
                body.append(f"class {handle.group(1)}(ctypes.c_void_p):\n    pass\n")
            elif function_type:
                known.add(function_type.group(2))
                body.append(f"{function_type.group(2)} = {callback(function_type.group(1), function_type.group(3), known)}\n")
            elif function and not LEFT_OUT.match(function.group(2)):
                kinds = []
                for text in split(function.group(3), ","):
                    if text != "void":
                        _, form, dimensions = parameter(text, known)
                        kinds.append(f"ctypes.POINTER({form})" if dimensions else form)
                functions.append(f'    "{function.group(2)}": ({ctype(function.group(1), known)}, [{", ".join(kinds)}]),\n')
            elif alias:
                known.add(alias.group(2))
                body.append(f"{alias.group(2)} = {SCALARS[alias.group(1)]}\n")
    version = "((MAJOR << 22) | (MINOR << 12) | PATCH)"
    for part in ("MAJOR", "MINOR", "PATCH"):
        version = version.replace(part, values[f"NOOK_VERSION_{part}"])
    values["NOOK_VERSION"] = version
    head = '"""Made from the public C headers by read_headers.py; do not edit."""\nimport ctypes\nfrom typing import Any, Dict, List, Tuple\n\n'
    lines = "".join(f"{name} = {value}\n" for name, value in sorted(values.items()))
    blocks = []
    for block in body:
        blocks.append(("\n\n" if block.startswith("class") or blocks and blocks[-1].lstrip().startswith("class") else "") + block)
    return f"{head}{lines}{''.join(blocks)}\n\nFUNCTIONS: Dict[str, Tuple[Any, List[Any]]] = {{\n{''.join(functions)}}}\n"


def main():
    text = page()
    if "--check" in sys.argv[1:]:
        if not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
            print(f"{PAGE.relative_to(ROOT)} is not what the headers give; run python3 packaging/python/read_headers.py")
            return 1
        return 0
    PAGE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
