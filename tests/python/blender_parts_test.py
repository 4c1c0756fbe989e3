"""The parts of the Blender add-on that do without Blender: numbers of vertices in files, matrices, and the command. tests/blender.sh
tests the rest inside of Blender."""
import json
import pathlib
import struct
import sys
import time
import types
import unittest

import numpy as np

# The package itself imports Blender; its parts do not.
package = types.ModuleType("nook_ao")
package.__path__ = [str(pathlib.Path(__file__).resolve().parents[2] / "packaging/blender/nook_ao")]
sys.modules["nook_ao"] = package

from nook_ao import poses, tool, vertex_numbers  # noqa: E402
from nook_ao.faults import Fault  # noqa: E402


def glb(document, binary):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), vertex_numbers.JSON_CHUNK) + text + struct.pack("<II", len(binary), vertex_numbers.BINARY_CHUNK) + binary
    return struct.pack("<III", vertex_numbers.GLB_MAGIC, 2, 12 + len(chunks)) + chunks


def character(attribute="_NOOK_VERTEX"):
    """Two nodes whose meshes stand in the other order, one primitive of points, and numbers between other floats."""
    interleaved = np.array([[7, -1], [3, -1], [3, -1]], "<f4").tobytes()
    shorts = np.array([0, 2, 1, 5], "<u2").tobytes()
    return glb({
        "nodes": [{"name": "root"}, {"mesh": 1}, {"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {attribute: 0}}, {"mode": 0, "attributes": {"POSITION": 0}}]},
                   {"primitives": [{"attributes": {attribute: 1}, "mode": 4}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3}, {"bufferView": 1, "componentType": 5123, "count": 3, "byteOffset": 2}],
        "bufferViews": [{"byteStride": 8, "byteLength": 24}, {"byteOffset": 24, "byteLength": 8}],
    }, interleaved + shorts)


class Numbers(unittest.TestCase):
    def test_numbers_come_in_the_order_of_nodes(self):
        for attribute in ("_NOOK_VERTEX", "__NOOK_VERTEX", "_nook_vertex"):
            self.assertEqual(vertex_numbers.read_vertex_numbers(character(attribute)).tolist(), [2, 1, 5, 7, 3, 3])

    def test_files_without_numbers_are_refused(self):
        with self.assertRaisesRegex(Fault, "no attribute NOOK_VERTEX"):
            vertex_numbers.read_vertex_numbers(character("_OTHER"))
        for data in (b"", b"gl", b"no file of this kind"):
            with self.assertRaisesRegex(Fault, "not a .glb"):
                vertex_numbers.read_vertex_numbers(data)

    def test_copies_of_a_vertex_share_its_mean(self):
        mean = poses.mean_of_copies(np.array([0.2, 0.4, 1.0, 0.5]), np.array([0, 0, 3, 1]), 5)
        np.testing.assert_allclose(mean, [0.3, 0.5, 1, 1, 1])


class Matrices(unittest.TestCase):
    def setUp(self):
        random = np.random.default_rng(1)
        self.points = random.normal(size=(200, 3)) * [0.3, 0.2, 0.9]
        turn, _ = np.linalg.qr(random.normal(size=(3, 3)))
        self.rest = np.eye(4)
        self.rest[:3, :3], self.rest[:3, 3] = 0.01 * turn, [1, 2, -3]

    def test_a_planted_matrix_is_found(self):
        found = poses.find_rest_matrix(self.points, poses.moved(self.rest, self.points))
        np.testing.assert_allclose(found, self.rest, atol=1e-12)

    def test_other_vertices_are_refused(self):
        with self.assertRaisesRegex(Fault, "do not match the mesh"):
            poses.find_rest_matrix(self.points, poses.moved(self.rest, self.points[::-1]))
        with self.assertRaisesRegex(Fault, "flat"):
            poses.find_rest_matrix(self.points * [1, 1, 0], poses.moved(self.rest, self.points * [1, 1, 0]))
        with self.assertRaisesRegex(Fault, "do not match the mesh"):
            poses.find_rest_matrix(self.points, poses.moved(self.rest, self.points) + 0.01 * np.sin(40 * self.points))

    def test_bones_move_rest_points_to_where_blender_has_them(self):
        world = np.array([[0, -2, 0, 1], [2, 0, 0, 2], [0, 0, 2, 3], [0, 0, 0, 1.0]])
        skinning = np.tile(np.eye(4), (2, 1, 1))
        skinning[1, :3, 3] = [0, 0, 0.5]
        matrices = poses.bone_matrices(world, skinning, self.rest)
        self.assertEqual(matrices.dtype, np.float32)
        rest = poses.moved(self.rest, self.points)
        for bone in range(2):
            moved = rest @ matrices[bone, :, :3].T + matrices[bone, :, 3]
            x, y, z = poses.moved(world @ skinning[bone], self.points).T
            # Floats of about 3 m times a scale of 100: 3e-7 of 300.
            np.testing.assert_allclose(moved, np.column_stack([x, z, -y]), atol=1e-4)


class Commands(unittest.TestCase):
    def test_the_last_line_is_the_progress(self):
        run = tool.Run([sys.executable, "-c", "print('first'); print('last')"])
        run.wait()
        run.check()
        self.assertEqual(run.last_line, "last")

    def test_the_message_of_the_tool_is_the_error(self):
        run = tool.Run([sys.executable, "-c", "import sys; print('nook: hero.glb: no triangles', file=sys.stderr); sys.exit(3)"])
        run.wait()
        with self.assertRaisesRegex(Fault, "exit code 3: hero.glb: no triangles"):
            run.check()

    def test_a_command_is_cancelled(self):
        run = tool.Run([sys.executable, "-c", "import time; time.sleep(60)"])
        begin = time.monotonic()
        self.assertFalse(run.is_done())
        run.cancel()
        self.assertLess(time.monotonic() - begin, 30)
        with self.assertRaises(Fault):
            run.check()

    def test_a_missing_command_is_named(self):
        with self.assertRaisesRegex(Fault, "/nowhere/nook was not found"):
            tool.find("/nowhere/nook")
        with self.assertRaisesRegex(Fault, "does not start"):
            tool.Run(["/nowhere/nook"])


if __name__ == "__main__":
    unittest.main()
