"""Sizes and offsets of every structure of the Python module against a C compiler."""
import ctypes
import os
import pathlib
import subprocess
import tempfile
import unittest

from nook import _layouts as layouts

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADERS = ["nook_character.h", "nook_material.h", "nook_bake.h"] + [f"experimental/nook_{name}.h" for name in
           ("bake_key", "bake_materials", "debug", "lod", "poses", "sg", "trace", "transfer")]


def structures():
    return [s for s in vars(layouts).values() if isinstance(s, type) and issubclass(s, ctypes.Structure) and s is not ctypes.Structure]


class Layouts(unittest.TestCase):
    def test_every_field_lies_where_a_compiler_puts_it(self):
        lines = [f"#include <nook/{name}>" for name in HEADERS] + ["#include <stdio.h>", "int main(void) {"]
        expected = []
        for s in structures():
            lines.append(f'printf("{s.__name__} %zu\\n", sizeof({s.__name__}));')
            expected.append(f"{s.__name__} {ctypes.sizeof(s)}")
            for name, _ in s._fields_:
                lines.append(f'printf("{s.__name__}.{name} %zu %zu\\n", offsetof({s.__name__}, {name}), sizeof((({s.__name__}*)0)->{name}));')
                field = getattr(s, name)
                expected.append(f"{s.__name__}.{name} {field.offset} {field.size}")
        lines += [f'printf("{name} %lld\\n", (long long)({name}));' for name in vars(layouts) if name.startswith("NOOK_") and
                  isinstance(getattr(layouts, name), int)] + ["return 0; }"]
        expected += [f"{name} {value}" for name, value in vars(layouts).items() if name.startswith("NOOK_") and isinstance(value, int)]
        self.assertGreater(len(structures()), 20)
        with tempfile.TemporaryDirectory() as folder:
            source, program = pathlib.Path(folder) / "layouts.c", pathlib.Path(folder) / "layouts"
            source.write_text("\n".join(lines), encoding="utf-8")
            subprocess.run([os.environ.get("CC", "cc"), "-I", str(ROOT / "sdk/include"), str(source), "-o", str(program)], check=True)
            found = subprocess.run([str(program)], check=True, capture_output=True, text=True).stdout.splitlines()
        self.assertEqual(found, expected)


if __name__ == "__main__":
    unittest.main()
