#!/usr/bin/env python3
"""Writes a C program that calls every function of the public headers with NULL and 0 alone.

  write_calls.py OUT          the functions of libnook and of libnook_bake
  write_calls.py --sdk OUT    the functions of libnook alone

The program fails unless each function refuses its arguments by its own name, destroy functions take NULL, and init functions
fill their descriptor. Its argument is the path of abi.txt: it calls as many functions as that file lists, or fails.
"""
import pathlib
import re
import sys

from describe import HEADERS, ROOT, describe, name_of

# Functions that do not refuse zeros, each with the condition that the program checks instead.
ANSWERS = {
    "nook_version": "nook_version() == NOOK_VERSION",
    "nook_version_text": "nook_version_text()[0] - '0' == NOOK_VERSION_MAJOR && strstr(nook_version_text(), NOOK_VERSION_SUFFIX)",
    "nook_result_name": 'strcmp(nook_result_name(0), "NOOK_OK") == 0',
    "nook_last_message": "nook_last_message() != NULL",
    "nook_bake_last_message": "nook_bake_last_message() != NULL",
    # No lobes at no points: there is nothing to write.
    "nook_sg_radiance": "nook_sg_radiance(NULL, 0, NULL, NULL, 0) == NOOK_OK",
    "nook_sg_irradiance": "nook_sg_irradiance(NULL, 0, 0, NULL, NULL, 0) == NOOK_OK",
    "nook_sg_specular": "nook_sg_specular(NULL, 0, 0, NULL, NULL, 0) == NOOK_OK",
}
BEGINNING = r"""/* Written by tests/abi/write_calls.py. */
#include <stdio.h>
#include <string.h>
%(includes)s

typedef const char* (*last_message)(void);
static int called, failures;

static void expect(int condition, const char* what, last_message message) {
  if (condition) return;
  ++failures;
  printf("failed: %%s; the last message is \"%%s\"\n", what, message());
}

static void expect_refused(nook_result result, const char* function, last_message message) {
  const size_t length = strlen(function);
  const int named = strncmp(message(), function, length) == 0 && strncmp(message() + length, ": ", 2) == 0;
  expect(result < NOOK_OK && named, function, message);
}

/* The number of functions that abi.txt lists. */
static int listed(const char* path) {
  static char line[1 << 16];
  int count = 0;
  FILE* file = fopen(path, "r");
  if (!file) return -1;
  while (fgets(line, sizeof line, file))
    count += strncmp(line, "function ", 9) == 0 && (%(bake)d || !strstr(line, " nook_bake_"));
  fclose(file);
  return count;
}
"""
END = r"""
int main(int count, char** arguments) {
  const int expected = count == 2 ? listed(arguments[1]) : -1;
  call_functions();
  check_structs();
  printf("%d functions called, %d listed, %d expectations failed\n", called, expected, failures);
  return called != expected || failures > 0;
}
"""


def last_message(name):
    return "nook_bake_last_message" if name.startswith("nook_bake_") else "nook_last_message"


def zeros(parameters, handles):
    """One argument for each parameter: NULL for a pointer, an array or a handle, 0 for a number."""
    each = [] if parameters == "void" else parameters.split(", ")
    return ", ".join("NULL" if re.search(r"[*\[]", p) or p.split()[0] in handles else "0" for p in each)


def call(line, handles):
    """The statements that call one function."""
    returned, name, parameters = re.fullmatch(r"function (.*?)(\w+)\((.*)\)", line).groups()
    made, reported = f"{name}({zeros(parameters, handles)})", f'"{name}", {last_message(name)});'
    if name in ANSWERS:
        return f"expect({ANSWERS[name]}, {reported}"
    if returned.strip() == "nook_result":
        return f"expect_refused({made}, {reported}"
    if returned.strip() == "void":
        handle = parameters.split("*")[0]
        return f"{{\n    {handle} handle = NULL;\n    {made};\n    {name}(&handle);\n    expect(handle == NULL, {reported}\n  }}"
    return f"expect(!{made}, {reported}"


def check(line, initialised):
    """The statements that check one structure: its size comes first, and its init function fills it."""
    name, fields = re.fullmatch(r"struct (\w+) \{ (.*) \}", line).groups()
    reported, out = f'"{name}_init", {last_message(name)});', []
    if re.search(r"\bstruct_size\b", fields):
        out.append(f'expect(offsetof({name}, struct_size) == 0, "{name}.struct_size comes first", {last_message(name)});')
    if name in initialised:
        out.append(f"{{\n    {name} desc;\n    expect({name}_init(&desc) == NOOK_OK, {reported}\n"
                   f"    expect(desc.struct_size == sizeof desc && desc.type != 0, {reported}\n"
                   f"    expect_refused({name}_init(NULL), {reported}\n  }}")
    return out


def program(bake):
    lines = [line for line in describe(HEADERS) if bake or "nook_bake_" not in line]
    handles = {name_of(line) for line in lines if re.match(r"type struct \w+\* \w+$", line)}
    initialised = {name_of(line).removesuffix("_init") for line in lines if line.startswith("inline") and "_desc_init(" in line}
    calls = [f"++called;\n  {call(line, handles)}" for line in lines if line.startswith("function")]
    checks = [statement for line in lines if line.startswith("struct") for statement in check(line, initialised)]
    includes = "\n".join(f"#include <{h.relative_to(ROOT / 'sdk/include').as_posix()}>" for h in HEADERS)
    return "\n".join([BEGINNING % {"includes": includes, "bake": bake}, "static void call_functions(void) {",
                      *("  " + c for c in calls), "}\n", "static void check_structs(void) {", *("  " + c for c in checks), "}", END])


if __name__ == "__main__":
    pathlib.Path(sys.argv[-1]).write_text(program("--sdk" not in sys.argv), encoding="utf-8")
