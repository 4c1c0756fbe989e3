"""The Python module: bakes with progress and cancel, AO of poses, probes and materials, faults of callers."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import nook

RINGS, SIDES = 14, 10


def tube():
    """Two bones along x, a closed ring of vertices at each of 14 places."""
    turn = np.linspace(0, 2 * math.pi, SIDES, endpoint=False)
    x = np.linspace(0, 1, RINGS)
    positions = np.array([[at, 0.1 * math.cos(t), 0.1 * math.sin(t)] for at in x for t in turn])
    triangles = []
    for ring in range(RINGS - 1):
        for side in range(SIDES):
            a, b = ring * SIDES + side, ring * SIDES + (side + 1) % SIDES
            triangles += [[a, b, a + SIDES], [b, b + SIDES, a + SIDES]]
    second = np.clip((positions[:, 0] - 0.35) / 0.3, 0, 1)
    joints = np.tile([0, 1], (len(positions), 1))
    frames = np.tile(np.eye(3, 4), (2, 1, 1))
    frames[1, 0, 3] = 0.5
    return nook.Character.from_arrays(positions, triangles, joints, np.stack([1 - second, second], axis=1), [-1, 0], frames, ["root", "tip"])


def bent(angle):
    """The pose in which the second bone turns about z, at x = 0.5."""
    pose = np.tile(np.eye(3, 4), (2, 1, 1))
    c, s = math.cos(angle), math.sin(angle)
    pose[1] = [[c, -s, 0, 0.5 - 0.5 * c], [s, c, 0, -0.5 * s], [0, 0, 1, 0]]
    return pose


SMALL = {"preset": "draft", "poses": "extra", "extra_poses": [bent(a) for a in np.linspace(-1.6, 1.6, 17)], "rays": 64, "steps": 60,
         "spheres": 6, "key_points": 20}


class Characters(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.character = tube()
        cls.steps = []
        with nook.bake_character(cls.character, progress=cls.steps.append, **SMALL) as job:
            cls.data, cls.report = job.wait(), job.report()
        cls.model = nook.CharacterModel(cls.data)

    def test_a_character_from_arrays_keeps_its_vertices(self):
        self.assertEqual(self.character.vertex_count, RINGS * SIDES)
        self.assertEqual(self.character.bone_names, ["root", "tip"])
        positions, normals = self.character.vertices()
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
        moved, _ = self.character.skin(bent(0.0) + np.array([0, 0, 0, 1.0]))
        np.testing.assert_allclose(moved, positions + 1, atol=1e-6)

    def test_a_bake_reports_its_stages_and_gives_a_model(self):
        stages = {step.stage for step in self.steps}
        self.assertIn("ray tracing", stages)
        self.assertIn("fitting", stages)
        self.assertEqual(self.model.vertex_count, RINGS * SIDES)
        self.assertEqual(self.model.bone_names, ["root", "tip"])
        self.assertIn("iterations", self.report)

    def test_one_seed_gives_the_same_bytes_on_any_number_of_threads(self):
        with nook.bake_character(self.character, threads=1, **SMALL) as job:
            self.assertEqual(job.wait(), self.data)

    def test_the_model_is_nearer_to_ray_tracing_than_a_static_bake(self):
        error = nook.model_error(self.character, self.model, [bent(1.5), bent(-1.3)], rays=256)
        # The static bake has the rest pose alone; a fit must be better than that in the poses that it was given.
        self.assertLess(error.mse_visible, error.mse_static_visible)

    def test_a_neighbour_and_the_ground_darken(self):
        alone = nook.evaluate_pose(self.model, bent(0))
        grounded = nook.evaluate_pose(self.model, bent(0), ground=(0, 1, 0, -0.1))
        self.assertLess(grounded.mean(), alone.mean() - 0.02)
        with nook.Scene() as scene:
            left, right = scene.add_instance(self.model), scene.add_instance(self.model)
            left.set_pose(bent(0))
            right.set_pose(bent(0) + np.array([[0, 0, 0, 0], [0, 0, 0, 0.25], [0, 0, 0, 0]]))
            left.link(right)
            scene.update()
            self.assertLess(left.read_ao().mean(), alone.mean())
            sphere = scene.add_sphere((0.5, -0.3, 0), 0.15)
            scene.update()
            darker = left.read_ao().mean()
            scene.remove_sphere(sphere)
            scene.update()
            self.assertGreater(left.read_ao().mean(), darker)

    def test_a_job_is_cancelled_from_outside_and_from_its_progress(self):
        endless = dict(SMALL, steps=1_000_000)
        with nook.bake_character(self.character, **endless) as job:
            job.cancel()
            self.assertRaises(nook.Cancelled, job.wait)
        with nook.bake_character(self.character, progress=lambda at: at.stage != "fitting", **endless) as job:
            self.assertRaises(nook.Cancelled, job.wait)

    def test_what_a_progress_function_raises_comes_out_of_wait(self):
        def broken(_at):
            raise KeyError("mine")

        with nook.bake_character(self.character, progress=broken, **SMALL) as job:
            self.assertRaises(KeyError, job.wait)

    def test_iterating_a_job_ends(self):
        with nook.bake_character(self.character, **SMALL) as job:
            *_, last = job
            self.assertEqual(last.stage, "done")
            self.assertEqual(job.wait(), self.data)

    def test_faults_have_the_words_of_the_library(self):
        with self.assertRaises(nook.NookError) as caught:
            nook.CharacterModel(self.data[:-1])
        self.assertEqual(caught.exception.code, "BAD_FILE")
        self.assertIn("nook_model_load", str(caught.exception))
        with self.assertRaises(nook.NookError) as caught:
            nook.Character("/no/such/file.glb")
        self.assertEqual(caught.exception.code, "BAD_FILE")
        with self.assertRaises(nook.NookError) as caught:
            nook.evaluate_pose(self.model, np.full((2, 3, 4), np.nan))
        self.assertEqual(caught.exception.code, "INVALID_ARGUMENT")
        with self.assertRaisesRegex(ValueError, "pose: has the shape"):
            nook.evaluate_pose(self.model, np.zeros((3, 3, 4)))
        with self.assertRaisesRegex(ValueError, "draft, production, standard"):
            nook.bake_character(self.character, preset="best")
        with self.assertRaisesRegex(TypeError, "'ray' is no setting"):
            nook.bake_character(self.character, ray=3)
        with self.assertRaisesRegex(ValueError, "whole numbers"):
            nook.trace_ao([(np.zeros((3, 3)), [[0, 1, -1]])], np.zeros((1, 3)), [[0, 1, 0]])

    def test_meshes_of_a_file_are_chosen_by_name(self):
        data = json.dumps({
            "asset": {"version": "2.0"}, "nodes": [{"name": "Body", "mesh": 0}, {"name": "Sword", "mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}).encode()
        self.assertEqual(nook.Character(data=data).triangle_count, 2)
        self.assertEqual(nook.Character(data=data, without=["Sw*"]).triangle_count, 1)
        self.assertEqual(nook.Character(data=data, meshes=["Body"]).triangle_count, 1)
        with self.assertRaisesRegex(nook.NookError, '"Axe".*"Body", "Sword"'):
            nook.Character(data=data, meshes=["Axe"])
        with self.assertRaisesRegex(TypeError, "without is a list of names"):
            nook.Character(data=data, without="Sword")

    def test_a_closed_object_says_so(self):
        model = nook.CharacterModel(self.data)
        model.close()
        model.close()
        with self.assertRaisesRegex(nook.NookError, "closed"):
            model.static_ao()


class Traces(unittest.TestCase):
    def test_an_infinite_wall_halves_the_light_of_its_foot(self):
        wall = ([[0, -1e4, -1e4], [0, 1e4, -1e4], [0, 1e4, 1e4], [0, -1e4, 1e4]], [[0, 1, 2], [0, 2, 3]])
        ao = nook.trace_ao([wall], [[1e-3, 0, 0]], [[0, 1, 0]], rays=16384)
        # A wall beside a floor hides half of the hemisphere; four standard deviations of 16,384 rays are 0.016.
        self.assertAlmostEqual(float(ao[0]), 0.5, delta=0.016)

    def test_no_mesh_is_open(self):
        np.testing.assert_array_equal(nook.trace_ao([], np.zeros((5, 3)), np.tile([0, 1, 0], (5, 1))), 1)


class Probes(unittest.TestCase):
    def test_constant_light_has_the_irradiance_pi(self):
        rng = np.random.default_rng(1)
        directions = rng.normal(size=(4096, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        with nook.ProbeFit(lobes=12, ambient=True) as fit:
            fit.add_samples(directions, np.full((4096, 3), 2.0))
            probe = fit.solve()
        # The ambient term holds constant light exactly; what is left is rounding to float.
        np.testing.assert_allclose(probe.irradiance([[0, 1, 0], [1, 0, 0]]), 2 * math.pi, rtol=1e-3)
        np.testing.assert_allclose(probe.radiance(directions[:8]), 2, rtol=1e-3)
        again = nook.Probe(probe.save("float"))
        np.testing.assert_array_equal(again.radiance(directions[:8]), probe.radiance(directions[:8]))
        np.testing.assert_array_equal(again.radiance(directions[:8], [0, 0, 0]), again.radiance(directions[:8], np.zeros((8, 3))))
        with self.assertRaisesRegex(ValueError, "position"):
            again.radiance(directions[:8], np.zeros((7, 3)))
        self.assertEqual(again.counts, (1, 1, 1))
        self.assertLess(len(probe.save("half")), len(probe.save("float")))
        # 13 functions, of which the ambient term is the constant light.
        np.testing.assert_allclose(probe.coefficients()[12], 2, rtol=1e-3)
        with self.assertRaisesRegex(nook.NookError, "index"):
            probe.coefficients(1)

    def test_fits_of_two_threads_merge_into_the_fit_of_all_samples(self):
        rng = np.random.default_rng(3)
        directions = rng.normal(size=(2048, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        light = 1 + directions @ rng.random((3, 3))
        with nook.ProbeFit() as whole, nook.ProbeFit() as first, nook.ProbeFit() as second:
            whole.add_samples(directions, light)
            first.add_samples(directions[:700], light[:700])
            second.add_samples(directions[700:], light[700:])
            alone = first.solve().coefficients()
            first.merge(second)
            # The sums are the same but for the order of their additions.
            np.testing.assert_allclose(first.solve().coefficients(), whole.solve().coefficients(), rtol=1e-4, atol=1e-5)
            self.assertGreater(np.abs(alone - whole.solve().coefficients()).max(), 1e-3)


    def test_methods_and_the_papers_form(self):
        directions = np.array([[0, 0, 1], [1, 0, 0], [0, -1, 0]])
        light = {}
        for options in ({}, {"form": "paper"}, {"method": "moments"}, {"method": "running_average"}):
            with nook.ProbeFit(**options) as fit:
                fit.add_samples(directions, [[1, 2, 3], [3, 2, 1], [1, 1, 1]])
                light[str(options)] = fit.solve().radiance(directions).tobytes()
        self.assertEqual(len(set(light.values())), len(light))
        with self.assertRaisesRegex(nook.NookError, "NOOK_FORM_PAPER"):
            nook.ProbeFit(form="paper", method="running_average")
        with self.assertRaisesRegex(ValueError, "study_naive"):
            nook.ProbeFit(method="study_naive")


class Materials(unittest.TestCase):
    def test_a_lambertian_material_reflects_its_albedo(self):
        tilts, turns = (0.1, 0.5, 0.9, 1.2), 5
        directions = np.array([[math.sin(t) * math.cos(a + t), math.sin(t) * math.sin(a + t), math.cos(t)]
                               for t in tilts for a in np.linspace(0, 2 * math.pi, turns, endpoint=False)])
        count, albedo = len(directions), 0.6
        btf = np.zeros((count, count, 8, 8, 3)) + (albedo / math.pi * directions[:, 2])[:, None, None, None, None]
        with nook.bake_material(btf=btf, lights=directions, views=directions, method="n_svd", rank_light=2, rank_view=2, rank_x=2,
                                rank_y=2) as job:
            material = nook.Material(job.wait())
        self.assertEqual((material.width, material.height, material.view_count), (8, 8, count))
        uv = np.random.default_rng(2).random((20, 2))
        values = material.evaluate(uv, directions, directions)
        # The light table has 64 cells a side. Half a cell is up to 0.02 radians, which changes the cosine of 1.2 radians by 5 %.
        np.testing.assert_allclose(values.radiance, np.repeat(albedo / math.pi * directions[:, 2:], 3, axis=1), rtol=0.05)
        np.testing.assert_array_equal(values.visibility, 1)
        nothing = np.zeros_like(uv)
        pixels = material.evaluate(uv, directions, directions, dx=nothing, dy=nothing, fetches=3)
        np.testing.assert_array_equal(pixels.radiance, values.radiance)


class Module(unittest.TestCase):
    def test_a_missing_library_is_an_error_that_names_the_cure(self):
        code = "import nook\ntry:\n  nook.Context()\nexcept ImportError as e:\n  print(e)"
        with tempfile.TemporaryDirectory() as folder:
            import os
            environment = dict(os.environ, NOOK_LIBRARY=str(pathlib.Path(folder) / "none.so"))
            said = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True).stdout
        self.assertIn("NOOK_LIBRARY", said)

    def test_every_public_name_is_there(self):
        for name in nook.__all__:
            self.assertTrue(hasattr(nook, name), name)
        self.assertTrue((pathlib.Path(nook.__file__).parent / "py.typed").exists())


if __name__ == "__main__":
    unittest.main()
