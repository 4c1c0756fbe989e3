"""Helpers of the tests of the add-on. They run inside of Blender."""
import bpy
import numpy as np


def check(holds, text):
    print(("ok    " if holds else "FAILS ") + text, flush=True)
    if not holds:
        raise SystemExit(1)


def fails_with(operator, words):
    """Checks that an operator fails with a text that has all words; such errors are exceptions in scripts."""
    try:
        operator()
    except RuntimeError as error:
        missing = [w for w in words if w not in str(error)]
        check(not missing, f"error: {str(error).strip()}" if not missing else f"the error {error} lacks {missing}")
        return
    check(False, f"an error with {words} was expected")


def colours(item, name="Nook AO"):
    attribute = item.data.attributes[name]
    values = np.empty(4 * len(item.data.vertices), dtype=np.float32)
    attribute.data.foreach_get("color", values)
    return values.reshape(-1, 4)


def evaluated_arrays(items):
    """World positions and triangles of the meshes as Blender shows them, and the colours that they show."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    positions, triangles, greys, first = [], [], [], 0
    for item in items:
        shown = item.evaluated_get(depsgraph)
        mesh = shown.to_mesh()
        mesh.calc_loop_triangles()
        world = np.array(shown.matrix_world)
        own = np.array([v.co[:] for v in mesh.vertices])
        faces = np.array([t.vertices[:] for t in mesh.loop_triangles])
        if np.linalg.det(world[:3, :3]) < 0:
            faces = faces[:, ::-1]
        positions.append(own @ world[:3, :3].T + world[:3, 3])
        triangles.append(faces + first)
        greys.append([c.color[0] for c in mesh.attributes["Nook AO"].data])
        first += len(own)
        shown.to_mesh_clear()
    return np.concatenate(positions), np.concatenate(triangles), np.concatenate(greys)


def error_to_truth(items, nook, rays=256):
    """The root of the mean squared error of the shown colours against ray tracing of the shown meshes, with normals weighted by area."""
    positions, triangles, grey = evaluated_arrays(items)
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    normals = np.zeros_like(positions)
    for k in range(3):
        np.add.at(normals, triangles[:, k], np.cross(b - a, c - a))
    used = np.linalg.norm(normals, axis=1) > 0
    normals[used] /= np.linalg.norm(normals[used], axis=1, keepdims=True)
    truth = nook.trace_ao([(positions, triangles)], positions[used], normals[used], rays=rays, origin_offset=1e-4 * np.ptp(positions, axis=0).max())
    seen = truth >= 0.01
    return float(np.sqrt(((truth - grey[used])[seen] ** 2).mean()))
