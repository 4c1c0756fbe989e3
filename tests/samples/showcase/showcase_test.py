#!/usr/bin/env python3
"""Draws the street corner of the showcase and checks that Nook's picture is nearer to the ray-traced one.

  showcase_test.py SHOWCASE CHARACTER.glb MODEL.nook
"""
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

SHOWCASE, CHARACTER, MODEL = sys.argv[1:4]
SOURCES = pathlib.Path(__file__).resolve().parents[3] / "samples/showcase"
WIDTH, HEIGHT = 320, 180


def draw(out, *options):
    return subprocess.run([SHOWCASE, "--character", CHARACTER, "--model", MODEL, "--width", str(WIDTH), "--height", str(HEIGHT),
                           "--samples-across", "1", "--rays", "16", "--sun-rays", "4", "--out", str(out), *options],
                          capture_output=True, text=True)


class StreetCorner(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.out = pathlib.Path(cls.scratch.name)
        cls.run_ = draw(cls.out)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def rows(self):
        self.assertEqual(self.run_.returncode, 0, self.run_.stderr)
        return {row["picture"]: row for row in json.loads((self.out / "report.json").read_text())["rows"]}

    def test_nook_is_nearer_to_the_truth(self):
        rows = self.rows()
        # At 640 x 360 with 32 rays, Nook has 0.06 of the error on characters and 0.20 on props. The bounds leave room for the noise
        # of 16 rays and for the pixels at edges, which are a larger share of a small picture.
        self.assertLess(rows["nook"]["mse_actors"], 0.15 * rows["off"]["mse_actors"])
        self.assertLess(rows["nook"]["mse_props"], 0.4 * rows["off"]["mse_props"])
        self.assertLess(rows["nook"]["mse"], 0.35 * rows["off"]["mse"])

    def test_the_camera_sees_characters_and_the_street(self):
        row = self.rows()["nook"]
        # Without occlusion, the light on the characters is wrong by about a tenth of the display's range.
        self.assertGreater(self.rows()["off"]["mse_actors"], 0.005)
        self.assertGreater(row["actor_samples"], 0.03 * WIDTH * HEIGHT)
        self.assertEqual(row["actor_samples"] + row["prop_samples"], WIDTH * HEIGHT)  # the house hides the sky

    def test_three_pictures_differ(self):
        self.rows()
        files = [(self.out / f"{kind}.png").read_bytes() for kind in ("off", "nook", "traced")]
        for file in files:
            self.assertEqual(struct.unpack(">II", file[16:24]), (WIDTH, HEIGHT))
        self.assertEqual(len(set(files)), 3)

    def test_an_unknown_shot_is_refused_with_the_names(self):
        run = draw(self.out / "none", "--shot", "sky")
        self.assertEqual(run.returncode, 1)
        self.assertIn("no shot sky; it has feet, hands, whole", run.stderr)

    def test_a_character_without_model_is_refused(self):
        run = subprocess.run([SHOWCASE, "--character", CHARACTER], capture_output=True, text=True)
        self.assertEqual(run.returncode, 2)
        self.assertIn("--model", run.stderr)


class Yard(unittest.TestCase):
    def test_every_file_of_the_stage_has_source_licence_and_hash(self):
        stage = json.loads((SOURCES / "yard.json").read_text())
        used = {prop["file"] for prop in stage["props"]} | {actor["character"] for actor in stage["actors"]}
        listed = set()
        for source in json.loads((SOURCES / "assets.json").read_text())["sources"]:
            self.assertTrue(source["licence"] and source["author"])
            self.assertRegex(source["commit"], "^[0-9a-f]{40}$")
            for file in source["files"]:
                self.assertRegex(file["sha256"], "^[0-9a-f]{64}$")
                listed.add(f"{source['folder']}/{pathlib.PurePosixPath(file['path']).name}")
        self.assertEqual(used, listed)

    def test_the_bakes_leave_out_what_the_stage_leaves_out(self):
        script = (SOURCES / "run.sh").read_text()
        for actor in json.loads((SOURCES / "yard.json").read_text())["actors"]:
            name = pathlib.PurePosixPath(actor["character"]).stem
            bake = re.search(rf"^ *bake {name} (.*)$", script, re.MULTILINE).group(1)
            self.assertEqual(re.findall(r"--without (\S+)", bake), actor["without"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
