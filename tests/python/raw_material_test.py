"""The writer of raw materials in packaging/blender against the reader of the command.

    raw_material_test.py NOOK
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "packaging/blender"))
import raw_material  # noqa: E402

NOOK = sys.argv.pop(1)


class Writer(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.raw, self.kept = pathlib.Path(folder.name, "a.raw"), pathlib.Path(folder.name, "b.raw")
        self.material = pathlib.Path(folder.name, "a.nook")

    def bake(self):
        return subprocess.run([NOOK, "bake", "material", "--raw", self.raw, "-o", self.material, "--keep-raw", self.kept,
                               "--ranks", "4,4,6,6", "--votf-ranks", "4,4", "--view-map", "0", "--quiet"],
                              capture_output=True, text=True)

    def kept_as_written(self):
        done = self.bake()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.kept.read_bytes(), self.raw.read_bytes())

    def test_the_example_is_read_and_written_back_byte_by_byte(self):
        subprocess.run([sys.executable, str(ROOT / "packaging/blender/raw_material.py"), self.raw, "--directions", "9",
                        "--texels", "8"], check=True)
        self.kept_as_written()

    def test_masks_of_no_whole_bytes_are_kept(self):
        random = numpy.random.default_rng(1)
        directions = raw_material.spiral_directions(5)
        raw_material.write(self.raw, "holes", directions, directions, random.random((5, 3, 5, 7, 9)),
                           random.random((5, 7, 9)) > 0.4)
        self.kept_as_written()

    def test_plain_checksum_is_that_of_the_command(self):
        directions = raw_material.spiral_directions(5)
        fast, raw_material.checksum = raw_material.checksum, raw_material._plain_xxh64
        self.addCleanup(setattr, raw_material, "checksum", fast)
        raw_material.write(self.raw, "plain", directions, directions, numpy.ones((5, 3, 5, 6, 7)))
        self.kept_as_written()

    def test_faults_are_named(self):
        directions = raw_material.spiral_directions(5)
        radiance = numpy.ones((5, 3, 5, 6, 6))
        for word, arguments in {"length": (2 * directions, directions, radiance), "shape": (directions, directions, radiance[1:]),
                                "finite": (directions, directions, radiance * 1e6),
                                "mask": (directions, directions, radiance, radiance > 0)}.items():
            with self.assertRaisesRegex(ValueError, word):
                raw_material.write(self.raw, "a", *arguments)
        raw_material.write(self.raw, "a", directions, directions, radiance)
        damaged = bytearray(self.raw.read_bytes())
        damaged[-1] ^= 1
        self.raw.write_bytes(damaged)
        done = self.bake()
        self.assertEqual(done.returncode, 3)
        self.assertIn("a.raw", done.stderr)


unittest.main()
