"""Ray-traced references, and the error of a model against them."""
import ctypes
import threading
from typing import Any, NamedTuple, Sequence, Tuple

import numpy as np

from . import _layouts as c
from ._library import FloatArray, call_interruptibly, descriptor, floats, integers, need, pointer, put
from .characters import Character
from .scenes import CharacterModel, evaluate_pose

VISIBLE = 0.01  # vertex-poses whose traced AO is smaller are inside the body


def trace_ao(meshes: Sequence[Tuple[Any, Any]], positions: Any, normals: Any, *, rays: int = 64, seed: int = 1, threads: int = 0,
             radius: float = float("inf"), origin_offset: float = 1e-4) -> FloatArray:
    """Returns the cosine-weighted visibility of points. Each mesh is (positions, triangles), in world space and metres. Ctrl+C ends
    the call quickly."""
    for mesh in meshes:
        if not isinstance(mesh, (tuple, list)) or len(mesh) != 2:
            raise TypeError("meshes: need a list of pairs (positions, triangles)")
    kept = [(floats(p, (None, 3), "positions of a mesh"), integers(t, np.uint32, (None, 3), "triangles of a mesh")) for p, t in meshes]
    occluders = (c.nook_bake_occluder_mesh * max(len(kept), 1))()
    for occluder, (p, t) in zip(occluders, kept):
        put(occluder, positions=pointer(p), indices=pointer(t), vertex_count=len(p), index_count=t.size)
    at = floats(positions, (None, 3), "positions")
    facing = floats(normals, (len(at), 3), "normals")
    desc = descriptor(c.nook_bake_trace_desc)
    put(desc, meshes=occluders, mesh_count=len(kept), positions=pointer(at), normals=pointer(facing), point_count=len(at), rays=rays,
        seed=seed, threads=threads, radius=radius, origin_offset=origin_offset)
    stopped = threading.Event()
    go_on = c.nook_bake_progress_fn(lambda _user, _at: 0 if stopped.is_set() else 1)
    desc.progress = go_on
    ao = np.empty(len(at), np.float32)
    call_interruptibly("nook_bake_trace_ao", ctypes.byref(desc), pointer(ao), len(at), stop=stopped.set,
                       keep=(kept, occluders, at, facing, go_on))
    return ao


class ModelError(NamedTuple):
    """Mean squared errors over vertices of the file and poses. `mse_visible` leaves out vertices whose ray-traced AO is almost 0."""

    mse: float
    mse_visible: float
    mse_static: float
    mse_static_visible: float


def model_error(character: Character, model: CharacterModel, poses: Any, *, rays: int = 128, seed: int = 1, threads: int = 0) -> ModelError:
    """Measures the errors of a model, and of AO baked once in the rest pose, against ray tracing in poses.

    `nook evaluate character` gives all welded vertices the same weight. This function gives all vertices of the file the same
    weight, so its numbers differ if the file splits vertices.
    """
    need(character, Character, "character")
    need(model, CharacterModel, "model")
    if character.vertex_count != model.vertex_count:
        raise ValueError(f"model: has {model.vertex_count} vertices, but the character has {character.vertex_count}")
    each = floats(poses, (None, character.bone_count, 3, 4), "poses")
    triangles, static = character.triangles(), model.static_ao()
    offset = 1e-4 * float(np.linalg.norm(character.bounds[1] - character.bounds[0]))
    sums = np.zeros(4)
    seen = 0
    for number, pose in enumerate(each):
        positions, normals = character.skin(pose)
        truth = trace_ao([(positions, triangles)], positions, normals, rays=rays, seed=seed + number, threads=threads, origin_offset=offset)
        visible = truth >= VISIBLE
        seen += int(visible.sum())
        for place, values in ((0, evaluate_pose(model, pose)), (2, static)):
            squares = (values.astype(np.float64) - truth) ** 2
            sums[place] += squares.sum()
            sums[place + 1] += squares[visible].sum()
    count = max(len(each) * character.vertex_count, 1)
    return ModelError(sums[0] / count, sums[1] / max(seen, 1), sums[2] / count, sums[3] / max(seen, 1))
