"""The Python module: bakes with progress and cancel, AO of poses, probes and materials, faults of callers."""
import array
import base64
import copy
import ctypes
import hashlib
import io
import json
import math
import multiprocessing
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from unittest import mock

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

    def test_the_key_of_a_bake_is_the_hash_of_what_its_file_holds(self):
        key = nook.bake_key(nook.bake_character, self.character, **SMALL)
        # The recipe is the last text of the file, which is not compressed.
        text = self.data.decode("latin-1")
        start = text.index('"bake":') + len('"bake":')
        end = json.JSONDecoder().raw_decode(text, start)[1]
        self.assertEqual(key, hashlib.sha256(text[start:end].encode("latin-1")).hexdigest())
        self.assertEqual(key, nook.bake_key(nook.bake_character, tube(), threads=1, **SMALL))
        self.assertNotEqual(key, nook.bake_key(nook.bake_character, self.character, seed=2, **SMALL))
        weave = dict(meso="weave", light_count=12, view_count=12, width=16, height=16)
        self.assertNotEqual(nook.bake_key(nook.bake_material, **weave), nook.bake_key(nook.bake_material, **dict(weave, bits=16)))
        with self.assertRaisesRegex(ValueError, "bake_character, bake_material or bake_transfer"):
            nook.bake_key(print)

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
        with self.assertRaisesRegex(TypeError, "'ray' is not a setting of a character"):
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
        self.assertEqual(nook.Character(data=data, without="Sword").triangle_count, 1)
        self.assertEqual(nook.Character(data=data, meshes="Sw*").triangle_count, 1)

    def test_a_closed_object_says_so(self):
        model = nook.CharacterModel(self.data)
        model.close()
        model.close()
        with self.assertRaisesRegex(nook.NookError, "closed"):
            model.static_ao()


def skinned_file(character):
    """The tube as a .glb of centimetres with one skin and two clips, whose bytes need no other file."""
    positions, normals = character.vertices()
    second = np.clip((positions[:, 0] - 0.35) / 0.3, 0, 1)
    inverse = np.tile(np.eye(4), (2, 1, 1))
    inverse[1, 0, 3] = -50  # the joint is at 50 cm
    joints = np.tile(np.array([0, 1, 0, 0], np.uint8), (len(positions), 1))
    weights = np.stack([1 - second, second, 0 * second, 0 * second], axis=1)
    turn = np.array([[0, 0, 0, 1], [0, 0, math.sin(0.6), math.cos(0.6)]])
    arrays = [(100 * positions, "f4", 5126, "VEC3"), (normals, "f4", 5126, "VEC3"), (joints, "u1", 5121, "VEC4"),
              (weights, "f4", 5126, "VEC4"), (character.triangles().reshape(-1), "u4", 5125, "SCALAR"),
              (inverse.transpose(0, 2, 1), "f4", 5126, "MAT4"), (np.array([0, 1]), "f4", 5126, "SCALAR"), (turn, "f4", 5126, "VEC4")]
    blob, views, accessors = b"", [], []
    for values, kind, component, shape in arrays:
        raw = np.ascontiguousarray(values, dtype="<" + kind).tobytes()
        views.append({"buffer": 0, "byteOffset": len(blob), "byteLength": len(raw)})
        accessors.append({"bufferView": len(accessors), "componentType": component, "count": len(values), "type": shape})
        blob += raw
    accessors[0].update(min=(100 * positions).min(axis=0).tolist(), max=(100 * positions).max(axis=0).tolist())
    accessors[6].update(min=[0], max=[1])
    clip = {"samplers": [{"input": 6, "output": 7}], "channels": [{"sampler": 0, "target": {"node": 3, "path": "rotation"}}]}
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"scale": [0.01, 0.01, 0.01], "children": [1, 2]}, {"mesh": 0, "skin": 0}, {"name": "root", "children": [3]},
                  {"name": "tip", "translation": [50, 0, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "JOINTS_0": 2, "WEIGHTS_0": 3}, "indices": 4}]}],
        "skins": [{"joints": [2, 3], "inverseBindMatrices": 5}], "animations": [dict(clip, name="Survey"), dict(clip, name="Walk")],
        "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": len(blob), "uri": "data:application/octet-stream;base64," + base64.b64encode(blob).decode()}]}).encode()


def forms(data):
    """Bytes in every form that Python has."""
    spread = np.zeros((len(data), 2), np.uint8)
    spread[:, 0] = np.frombuffer(data, np.uint8)
    return [data, bytearray(data), memoryview(data), np.frombuffer(data, np.uint8), np.frombuffer(data, np.int8), spread[:, 0],
            array.array("B", data), ctypes.create_string_buffer(data, len(data)), io.BytesIO(data)]


def worker(task):
    """Runs in another process."""
    model, character = task
    if character is None:
        return nook.evaluate_pose(model, np.full((2, 3, 4), np.nan))
    return nook.evaluate_pose(model, bent(1)), character.skin(bent(1))[0]


class Arguments(unittest.TestCase):
    """The arguments and copies of Python programs."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.file = skinned_file(tube())
        cls.path = pathlib.Path(cls.folder.name) / "tübe.gltf"
        cls.path.write_bytes(cls.file)
        cls.character = nook.Character(cls.path)
        settings = dict(SMALL, rays=16, steps=5, threads=1, extra_poses=[bent(a) for a in (-1, -0.5, 0, 0.5, 1)])
        with nook.bake_character(cls.character, **settings) as job:
            cls.data = job.wait()
        cls.baked = cls.path.with_name("tübe.nook")
        cls.baked.write_bytes(cls.data)
        cls.model = nook.CharacterModel(cls.data)
        cls.ao = nook.evaluate_pose(cls.model, bent(1))
        with nook.ProbeFit() as fit:
            fit.add_samples([[0, 0, 1], [1, 0, 0]], [[1, 2, 3], [3, 2, 1]])
            cls.probe = fit.solve()

    def test_a_file_is_a_path_or_bytes_in_any_form(self):
        for form in forms(self.data) + [str(self.baked), self.baked, self.baked.open("rb")]:
            np.testing.assert_array_equal(nook.evaluate_pose(nook.CharacterModel(form), bent(1)), self.ao, str(type(form)))
            getattr(form, "close", int)()
        for form in forms(self.file) + [str(self.path), self.path]:
            self.assertEqual(nook.Character(form).clip_names, ["Survey", "Walk"], str(type(form)))
        for form in forms(self.file):
            self.assertEqual(nook.Character(data=form).bone_count, 2)
        saved = self.probe.save("float")
        on_disk = self.path.with_name("probe.nook")
        on_disk.write_bytes(saved)
        for form in forms(saved) + [str(on_disk), on_disk]:
            self.assertEqual(nook.Probe(form).counts, (1, 1, 1))

    def test_what_is_no_file_is_named(self):
        for kind in (nook.CharacterModel, nook.Probe, nook.Material, nook.Character):
            for wrong, said in ((3, "int 3"), ([1, 2], r"list \[1, 2\]"), (io.StringIO("x"), "rb"), (np.array([None]), "objects")):
                with self.assertRaisesRegex(TypeError, f"{kind.__name__}: .*{said}"):
                    kind(wrong)
            for path, said in (("a\0b", "NUL"), ("", "empty"), ("\ud800", "surrogate")):
                with self.assertRaisesRegex(ValueError, f"{kind.__name__}: .*{said}"):
                    kind(path)
        with self.assertRaisesRegex(FileNotFoundError, "none.nook"):
            nook.CharacterModel("none.nook")
        for kind in (nook.CharacterModel, nook.Probe, nook.Material, nook.Character):
            self.assertRaises(nook.NookError, kind, b"")

    def test_clips_are_named_or_numbered_by_any_whole_number(self):
        pose = self.character.sample_clip("Walk", 0.5)
        for clip in (1, np.int64(1), np.uint8(1), np.array(1), np.str_("Walk")):
            np.testing.assert_array_equal(self.character.sample_clip(clip, np.float32(0.5)), pose)
            self.assertEqual(self.character.clip_duration(clip), 1)
        for wrong in (2, -1, np.int64(-1), 2**32, "Run"):
            with self.assertRaisesRegex(ValueError, "'Survey', 'Walk'"):
                self.character.sample_clip(wrong, 0)
        for wrong in (0.0, None, b"Walk", [0]):
            with self.assertRaisesRegex(TypeError, "clip: .*'Survey', 'Walk'"):
                self.character.clip_duration(wrong)

    def test_one_text_is_one_name(self):
        settings = dict(SMALL, poses="clips", extra_poses=None, rays=8, steps=2, threads=1, samples_per_clip=2)
        for clips in ("Survey", ["Survey"], ("Survey",), iter(["Survey"]), np.array(["Survey"])):
            with nook.bake_character(self.character, clips=clips, **settings) as job:
                job.cancel()
        with self.assertRaisesRegex(nook.NookError, '"Sur"'):
            nook.bake_character(self.character, clips="Sur", **settings)
        for wrong in (b"Survey", 3, [b"Survey"], [None]):
            with self.assertRaisesRegex(TypeError, "clips"):
                nook.bake_character(self.character, clips=wrong, **settings)
        with self.assertRaisesRegex(ValueError, "NUL"):
            nook.bake_character(self.character, clips=["Survey\0x"], **settings)

    def test_integers_out_of_range_raise_everywhere(self):
        no_light, up = np.zeros((1, 3)), [[0, 1, 0]]
        box = (np.zeros((3, 3)), np.zeros((3, 3)), np.zeros((3, 2)), [[0, 1, 2]])
        calls = {name: lambda value, name=name: nook.bake_character(self.character, **dict(SMALL, **{name: value}))
                 for name in ("spheres", "key_points", "rays", "steps", "auto_pose_count", "samples_per_clip", "seed", "threads")}
        for name, kind in nook.jobs.c.nook_bake_material_desc._fields_:
            if kind in nook._library._RANGES and name not in ("struct_size", "type", "method", "form", "relief"):
                calls["material " + name] = lambda value, name=name: nook.bake_material(meso="weave", **{name: value})
        for name in ("lobes", "ray_side", "threads", "bounces"):
            calls["transfer " + name] = lambda value, name=name: nook.bake_transfer(*box, **{name: value})
        for name in ("rays", "seed", "threads"):
            calls["trace " + name] = lambda value, name=name: nook.trace_ao([], no_light, up, **{name: value})
            calls["error " + name] = lambda value, name=name: nook.model_error(self.character, self.model, [bent(0)], **{name: value})
        for name in ("lod_max_interval", "strict_poses"):
            calls["scene " + name] = lambda value, name=name: nook.Scene(**{name: value})
        scene = nook.Scene()
        calls.update({
            "auto_poses": self.character.auto_poses, "auto_poses seed": lambda value: self.character.auto_poses(1, value),
            "coefficients": lambda value: self.probe.coefficients(value), "lobes": lambda value: nook.ProbeFit(value),
            "remove_sphere": scene.remove_sphere, "clip": lambda value: self.character.sample_clip(value, 0),
            "skin": lambda value: nook.evaluate_pose(self.model, bent(0), kind="skinning", skin=value),
            "primitive": lambda value: self.model.match_vertices(no_light, primitive=value),
            "remap": lambda value: self.model.remap([value]),
            "parents": lambda value: nook.Character.from_arrays(box[0], box[3], [[0]] * 3, [[1]] * 3, [value], np.eye(3, 4)[None]),
            "joints": lambda value: nook.Character.from_arrays(box[0], box[3], [[value]] * 3, [[1]] * 3, [-1], np.eye(3, 4)[None])})
        for name, function in calls.items():
            for wrong in (2**64, -(2**63) - 1, 2**64 + 8):
                with self.subTest(name, value=wrong), self.assertRaises(ValueError):
                    function(wrong)
            if "seed" not in name:
                with self.subTest(name), self.assertRaises(ValueError):
                    function(2**32 + 8)
            with self.subTest(name), self.assertRaises((TypeError, ValueError)):
                function(8.5)
        with self.assertRaisesRegex(ValueError, "spheres: need a whole number of 0 to 4294967295, got 4294967304"):
            calls["spheres"](2**32 + 8)
        with self.assertRaisesRegex(TypeError, "rays: need a whole number, got str '8'"):
            calls["rays"]("8")
        with self.assertRaisesRegex(ValueError, "nook_probe_read_coefficients, argument 2"):
            nook._library.call("nook_probe_read_coefficients", self.probe.handle, 2**32, None, 0)
        self.assertEqual(nook.trace_ao([], no_light, up, rays=np.int16(4), seed=np.uint64(2**64 - 1)), 1)

    def test_numbers_are_numbers(self):
        for wrong in ("1", b"1", None):
            with self.assertRaisesRegex(TypeError, "radius: need a number"):
                nook.Scene().add_sphere((0, 0, 0), wrong)
        for wrong in (1e39, 10**400):
            with self.assertRaisesRegex(ValueError, "radius"):
                nook.Scene().add_sphere((0, 0, 0), wrong)
        for wrong in ([["a", "b", "c"]], [[1j, 0, 0]], [[1, 2], [3]]):
            with self.assertRaisesRegex(ValueError, "positions: "):
                nook.trace_ao([], wrong, [[0, 1, 0]])
            with self.assertRaisesRegex(ValueError, "pose: "):
                nook.evaluate_pose(self.model, wrong)

    def test_a_setting_cannot_contradict_the_size_of_an_array(self):
        up = [[0, 0, 1]]
        for name in ("width", "height", "light_count", "view_count"):
            with self.assertRaisesRegex(TypeError, f"'{name}' is not a setting"):
                nook.bake_material(btf=np.zeros((1, 1, 8, 8, 3)), lights=up, views=up, **{name: 4096})

    def test_a_wrong_object_is_named(self):
        with self.assertRaisesRegex(TypeError, "model: need a nook.CharacterModel, got nook|model: need a nook.CharacterModel, got str"):
            nook.evaluate_pose("hero.nook", bent(0))
        with self.assertRaisesRegex(TypeError, "character: need a nook.Character, got CharacterModel"):
            nook.bake_character(self.model)
        with self.assertRaisesRegex(TypeError, "progress: need a function"):
            nook.bake_character(self.character, progress=3)
        for wrong in ((np.zeros((3, 3)), [[0, 1, 2]]), [np.zeros((3, 3))], [3]):
            with self.assertRaisesRegex(TypeError, "meshes: need a list of pairs"):
                nook.trace_ao(wrong, np.zeros((1, 3)), [[0, 1, 0]])
        with self.assertRaisesRegex(TypeError, "preset: need one of the words"):
            nook.bake_character(self.character, preset=["draft"])

    def test_models_and_characters_are_copied(self):
        for again in (pickle.loads(pickle.dumps(self.model)), copy.copy(self.model), copy.deepcopy({"model": self.model})["model"]):
            np.testing.assert_array_equal(nook.evaluate_pose(again, bent(1)), self.ao)
            again.close()
        np.testing.assert_array_equal(nook.evaluate_pose(self.model, bent(1)), self.ao)
        positions, _ = self.character.skin(bent(1))
        for one in (self.character, nook.Character(self.file), tube()):
            for again in (pickle.loads(pickle.dumps(one)), copy.copy(one), copy.deepcopy(one)):
                np.testing.assert_array_equal(again.skin(bent(1))[0], one.skin(bent(1))[0])
                self.assertEqual((again.bone_names, again.clip_names), (one.bone_names, one.clip_names))
        self.assertNotIn(self.file[:200], pickle.dumps(self.character))  # by its path
        probe = pickle.loads(pickle.dumps(self.probe))
        np.testing.assert_array_equal(probe.coefficients(), self.probe.coefficients())

    def test_a_pool_gives_the_results_of_one_process(self):
        skinned = self.character.skin(bent(1))[0]
        for start in [each for each in ("fork", "spawn") if each in multiprocessing.get_all_start_methods()]:
            with multiprocessing.get_context(start).Pool(1) as pool:
                for ao, positions in pool.map_async(worker, [(self.model, self.character)] * 2).get(300):
                    np.testing.assert_array_equal(ao, self.ao)
                    np.testing.assert_array_equal(positions, skinned)
                with self.assertRaises(nook.NookError) as caught:
                    pool.map_async(worker, [(self.model, None)]).get(60)
                self.assertEqual(caught.exception.code, "INVALID_ARGUMENT")
                self.assertIn("nook_scene_set_pose", str(caught.exception))

    def test_errors_are_copied(self):
        for kind in (nook.NookError, nook.Cancelled, nook.MissingLibrary):
            again = pickle.loads(pickle.dumps(kind("BAD_FILE", "the words")))
            self.assertEqual((type(again), again.code, str(again)), (kind, "BAD_FILE", "the words"))

    def test_what_cannot_be_copied_says_why(self):
        scene = nook.Scene()
        with nook.bake_character(self.character, **SMALL) as job:
            for one, said in ((scene, "models and poses"), (scene.add_instance(self.model), "its scene"), (job, r"wait\(\)"),
                              (nook.ProbeFit(), r"solve\(\)"), (nook.Context(), "must make its own")):
                for function in (pickle.dumps, copy.copy, copy.deepcopy, lambda x: copy.deepcopy([x])):
                    with self.assertRaisesRegex(TypeError, f"cannot be pickled or copied: .*{said}"):
                        function(one)
        closed = nook.CharacterModel(self.data)
        closed.close()
        with self.assertRaisesRegex(nook.NookError, "closed"):
            pickle.dumps(closed)

    @unittest.skipUnless(hasattr(os, "fork"), "needs fork")
    def test_a_job_does_not_hold_up_a_process_that_was_forked(self):
        with nook.bake_character(self.character, **dict(SMALL, steps=1_000_000, threads=1)) as job:
            child = os.fork()
            if not child:
                code = 1
                try:
                    job.poll()
                except nook.NookError:
                    job.close()
                    code = 0
                finally:
                    os._exit(code)
            end = time.monotonic() + 60
            done, status = os.waitpid(child, os.WNOHANG)
            while not done and time.monotonic() < end:
                time.sleep(0.02)
                done, status = os.waitpid(child, os.WNOHANG)
            if not done:
                os.kill(child, signal.SIGKILL)
                os.waitpid(child, 0)
            self.assertTrue(done)
            self.assertEqual(status, 0)

    def test_many_poses_have_the_numbers_of_one_at_a_time(self):
        poses = [bent(angle) for angle in np.linspace(-1.5, 1.5, 300)]
        ground = (0, 1, 0, -0.2)
        for options in ({}, {"ground": ground}):
            expected = np.stack([nook.evaluate_pose(self.model, pose, **options) for pose in poses])
            self.assertGreater(np.ptp(expected), 0.1)
            for threads in (1, 3, 0):
                np.testing.assert_array_equal(nook.evaluate_poses(self.model, poses, threads=threads, **options), expected)
        whole = np.concatenate([poses, np.tile([[[[0, 0, 0, 1]]]], (len(poses), 2, 1, 1))], axis=2)
        given = {"skinning": (whole @ np.diag([0.01, 0.01, 0.01, 1.0]))[:, :, :3], "rest_to_world": whole[:, ::-1].transpose(0, 1, 3, 2)}
        options = {"skinning": {}, "rest_to_world": {"layout": "columns_4x4", "transform_of_bone": [1, 0]}}
        expected = nook.evaluate_poses(self.model, poses)
        for kind, transforms in given.items():
            np.testing.assert_allclose(nook.evaluate_poses(self.model, transforms, kind=kind, **options[kind]), expected, atol=1e-4)
        self.assertEqual(nook.evaluate_poses(self.model, np.empty((0, 2, 3, 4))).shape, (0, self.model.vertex_count))

    def test_many_poses_name_what_is_wrong(self):
        poses = np.stack([bent(0)] * 40)
        for wrong, words in ((poses[0], r"poses: has the shape \(2, 3, 4\)"), (poses[:, :1], r"poses: has the shape \(40, 1, 3, 4\)")):
            with self.assertRaisesRegex(ValueError, words):
                nook.evaluate_poses(self.model, wrong)
        poses[[33, 37], 1, 0, 0] = math.nan
        for threads in (1, 3):
            with self.assertRaisesRegex(nook.NookError, "nook_model_evaluate_poses: pose 33: "):
                nook.evaluate_poses(self.model, poses, threads=threads)
        with self.assertRaisesRegex(ValueError, "threads: need a whole number of 0 to 1024, got 1025"):
            nook.evaluate_poses(self.model, poses, threads=1025)
        with self.assertRaisesRegex(TypeError, "model: need a nook.CharacterModel, got "):
            nook.evaluate_poses(self.data, poses)

    def test_ctrl_c_ends_every_long_call(self):
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        positions, normals = self.character.vertices()
        body = [(positions, self.character.triangles())]
        many = np.random.default_rng(1).integers(0, len(positions), 3_000_000)
        directions = np.random.default_rng(2).normal(size=(6_000_000, 3)).astype(np.float32)
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        fit, light = nook.ProbeFit(), np.ones_like(directions)
        fit.add_samples(directions[:1000], light[:1000])
        probe = fit.solve()
        # Each takes many seconds.
        calls = {
            "trace_ao": lambda: nook.trace_ao(body, positions[many], normals[many], rays=4096),
            "model_error": lambda: nook.model_error(self.character, self.model, [bent(0)] * 100_000, rays=4096),
            "evaluate_poses": lambda: [nook.evaluate_poses(self.model, [bent(0)] * 20_000) for _ in range(1000)],
            "auto_poses": lambda: [self.character.auto_poses(100_000) for _ in range(1000)],
            "match_vertices": lambda: [self.model.match_vertices(positions[many], normals[many], in_rest_space=True) for _ in range(1000)],
            "add_samples": lambda: [nook.ProbeFit(lobes=64).add_samples(directions, light) for _ in range(1000)],
            "radiance": lambda: [probe.radiance(directions) for _ in range(1000)],
            "Character": lambda: [tube() for _ in range(100_000)],
        }
        for name, work in calls.items():
            sent = []

            def send():
                sent.append(time.monotonic())
                signal.raise_signal(signal.SIGINT) if os.name == "nt" else os.kill(os.getpid(), signal.SIGINT)

            timer = threading.Timer(0.7, send)
            timer.start()
            with self.subTest(name):
                with self.assertRaises(KeyboardInterrupt):
                    work()
                took = time.monotonic() - sent[0]
                print(f"Ctrl+C in {name}: {took:.2f} s")
                # Half a second on a free machine; a busy one gets ten times that.
                self.assertLess(took, 5)
            timer.join()
        # Later calls are right.
        np.testing.assert_array_equal(nook.evaluate_pose(self.model, bent(1)), self.ao)

    def test_ctrl_c_ends_a_wait_and_cancels_the_job(self):
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        for wait in (nook.Job.wait, list):
            # Without Ctrl+C the bake would go on for a minute.
            with nook.bake_character(self.character, **dict(SMALL, steps=10_000_000, time_limit_s=60, threads=1)) as job:
                sent = []
                timer = threading.Timer(0.5, lambda: (sent.append(time.monotonic()), signal.raise_signal(signal.SIGINT)
                                                      if os.name == "nt" else os.kill(os.getpid(), signal.SIGINT)))
                timer.start()
                with self.assertRaises(KeyboardInterrupt):
                    wait(job)
                timer.join()
                self.assertRaises(nook.Cancelled, job.wait)
            # Half a second on a free machine, with the end of the job's threads; a busy one gets ten times that.
            self.assertLess(time.monotonic() - sent[0], 5)

    def test_instances_and_spheres_of_two_scenes_do_not_mix(self):
        with nook.Scene() as one, nook.Scene() as two:
            a, b, other = one.add_instance(self.model), two.add_instance(self.model), one.add_instance(self.model)
            with self.assertRaisesRegex(ValueError, "caster: the instance is in another scene"):
                a.link(b)
            with self.assertRaisesRegex(TypeError, "caster: need a nook.Instance, got int"):
                a.link(other.number)
            a.link(other)
            sphere = two.add_sphere((0, 0, 0), 1)
            one.add_sphere((0, 0, 0), 1)
            with self.assertRaisesRegex(ValueError, "another scene"):
                one.remove_sphere(sphere)
            two.remove_sphere(int(sphere))

    def test_joint_and_skinning_poses(self):
        pose = self.character.sample_clip("Survey", 0.5)
        whole = np.concatenate([pose, np.tile([[[0, 0, 0, 1]]], (2, 1, 1))], axis=1)
        joint_rest = np.tile(np.diag([0.01, 0.01, 0.01, 1.0]), (2, 1, 1))
        joint_rest[1, 0, 3] = 0.5
        joints = whole @ joint_rest
        skinning = whole @ np.diag([0.01, 0.01, 0.01, 1.0])
        for kind, given in (("rest_to_world", whole), ("joint_to_world", joints), ("skinning", skinning)):
            for form, options in ((given[:, :3], {}), (given, {}), (given.transpose(0, 2, 1), {"layout": "columns_4x4"}),
                                  (given[::-1], {"transform_of_bone": self.model.map_bones(["tip", "root"])})):
                if kind == "skinning" and options.get("transform_of_bone") is not None:
                    continue
                np.testing.assert_allclose(self.model.convert_pose(form, kind, **options), pose, atol=1e-5, err_msg=f"{kind} {options}")
            np.testing.assert_allclose(nook.evaluate_pose(self.model, given, kind=kind), nook.evaluate_pose(self.model, pose), atol=1e-4)
        self.assertEqual(self.model.skins, [nook.Skin(0, 2)])
        moved = self.model.convert_pose(pose, place=[[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0]])
        np.testing.assert_allclose(moved[:, 0, 3], pose[:, 0, 3] + 2, atol=1e-6)
        with self.assertRaisesRegex(ValueError, "kind: 'joints' is not one of rest_to_world, joint_to_world, skinning"):
            self.model.convert_pose(pose, "joints")
        with self.assertRaisesRegex(ValueError, "pose: has the shape"):
            self.model.convert_pose(skinning[:1], "skinning")
        with self.assertRaisesRegex(ValueError, "skin: 1 is not one of 0"):
            self.model.convert_pose(skinning, "skinning", skin=1)

    def test_triangles_tell_the_sides_of_a_card_apart(self):
        # A card above the tube: two squares in the same place that look up and down. The tube darkens the lower one.
        positions, _ = self.character.vertices()
        square = [[x, 0.13, z] for x in (0.4, 0.5, 0.6) for z in (-0.1, 0, 0.1)]
        faces = np.array([[i, i + 1, i + 3] for i in (0, 1, 3, 4)] + [[i + 1, i + 4, i + 3] for i in (0, 1, 3, 4)])
        first = len(positions)
        points = np.concatenate([positions, square, square])
        triangles = np.concatenate([self.character.triangles(), first + faces, first + 9 + faces[:, ::-1]])
        one = np.tile([1.0, 0.0], (len(points), 1))
        frames = np.tile(np.eye(3, 4), (2, 1, 1))
        card = nook.Character.from_arrays(points, triangles, np.tile([0, 1], (len(points), 1)), one, [-1, 0], frames, ["root", "tip"])
        with nook.bake_character(card, **SMALL) as job:
            model = nook.CharacterModel(job.wait())
        order = np.random.default_rng(7).permutation(len(points))
        place = np.argsort(order)
        # By places alone, the shuffled vertices of the card can be of either side.
        self.assertGreater(model.match_vertices(points[order]).ambiguous, 0)
        found = model.match_vertices(points[order], triangles=place[triangles])
        np.testing.assert_array_equal(found.vertices, order)
        self.assertEqual((found.unmatched, found.ambiguous, found.text), (0, 0, ""))
        for wrong, words in (([[0, 1]], "triangles: has the shape"), ([[0, 1, -1]], "triangles: need whole numbers"),
                             ([[0, 1, len(points)]], "indices.2. is out of range")):
            with self.assertRaisesRegex((ValueError, nook.NookError), words):
                model.match_vertices(points, triangles=wrong)

    def test_a_mesh_in_another_order_gets_its_own_ao(self):
        positions, normals = self.character.vertices()
        order = np.random.default_rng(5).permutation(len(positions))
        match = self.model.match_vertices(100 * positions[order], normals[order])
        self.assertEqual(match.unmatched, 0)
        np.testing.assert_array_equal(match.vertices, order)
        np.testing.assert_array_equal(self.model.match_vertices(positions, in_rest_space=True, primitive=0).vertices, np.arange(len(order)))
        for mine in (self.model.remap(match), self.model.remap(order), pickle.loads(pickle.dumps(self.model.remap(match)))):
            np.testing.assert_array_equal(nook.evaluate_pose(mine, bent(1)), self.ao[order])
        twice = copy.deepcopy(self.model.remap(order).remap([3, 1]))
        np.testing.assert_array_equal(nook.evaluate_pose(twice, bent(1)), self.ao[order][[3, 1]])
        far = self.model.match_vertices([[1e4, 0, 0]])
        self.assertEqual((far.unmatched, far.vertices.tolist()), (1, [nook.NO_VERTEX]))
        with self.assertRaises(nook.NookError):
            self.model.remap(far)


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
        # 13 functions; the ambient term is the constant light.
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
    def test_threads_that_come_at_once_share_one_context(self):
        def slow(make=nook.Context):
            made = make()
            time.sleep(0.2)
            return made

        found = []
        with mock.patch.dict(nook.scenes._shared, clear=True), mock.patch.object(nook.scenes, "Context", slow):
            threads = [threading.Thread(target=lambda: found.append(nook.scenes.shared_context())) for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        self.assertEqual(len({id(context) for context in found}), 1)

    def test_a_missing_library_is_an_error_that_names_the_cure(self):
        code = "import nook\ntry:\n  nook.Context()\nexcept ImportError as e:\n  print(e)"
        with tempfile.TemporaryDirectory() as folder:
            environment = dict(os.environ, NOOK_LIBRARY=str(pathlib.Path(folder) / "none.so"))
            said = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True).stdout
        self.assertIn("NOOK_LIBRARY", said)

    def test_every_public_name_is_there(self):
        for name in nook.__all__:
            self.assertTrue(hasattr(nook, name), name)
        self.assertTrue((pathlib.Path(nook.__file__).parent / "py.typed").exists())


if __name__ == "__main__":
    unittest.main()
