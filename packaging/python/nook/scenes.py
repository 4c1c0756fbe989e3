"""The runtime part for baked characters: models, scenes, and ambient occlusion of poses."""
import ctypes
import logging
import os
import re
import threading
import time
import weakref
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _layouts as c
from ._library import (
    FloatArray, Handle, NookError, call, call_interruptibly, choice, described, descriptor, file_bytes, floats, integer, integers, name_array,
    names, need, numbers, pointer, put, put_settings, text,
)


_log = logging.getLogger("nook")


def _write_log(_user: Any, severity: int, line: bytes) -> None:
    """Passes the log of the library to the logger "nook"."""
    levels = {c.NOOK_LOG_WARNING: logging.WARNING, c.NOOK_LOG_ERROR: logging.ERROR}
    _log.log(levels.get(severity, logging.DEBUG), "%s", text(line))


_log_line = c.nook_log_fn(_write_log)


class Context(Handle):
    """The context of the library, from which all other objects are created."""

    _kind = c.nook_context
    _destroy = "nook_context_destroy"
    _no_copy = "each process must make its own"

    def __init__(self) -> None:
        super().__init__()
        desc = descriptor(c.nook_context_desc)
        desc.log = _log_line
        call("nook_context_create", ctypes.byref(desc), ctypes.byref(self._handle))


_shared: Dict[str, Context] = {}


def shared_context() -> Context:
    """The context of this module, which any thread may use."""
    # If two threads create a context at the same time, setdefault keeps one of the two, and the other one is never used.
    return _shared.get("context") or _shared.setdefault("context", Context())


class Skin(NamedTuple):
    """Pass `file_index` as `skin` of a skinning pose. `joint_count` is the number of matrices of such a pose."""

    file_index: int
    joint_count: int


class VertexMatch(NamedTuple):
    """`vertices` has the model's vertex for each of your vertices, or NO_VERTEX if there is no match. `unmatched` counts these.
    `ambiguous` counts the vertices that fit several vertices with different AO. `text` names the first vertex of each kind."""

    vertices: npt.NDArray[np.uint32]
    unmatched: int
    ambiguous: int
    text: str


NO_VERTEX = 0xFFFFFFFF
# The shape of one transform in each layout of nook_character.h.
_LAYOUTS = {"rows_3x4": (3, 4), "rows_4x4": (4, 4), "columns_4x4": (4, 4), "columns_4x3": (4, 3), "dual_quaternion": (2, 4), "trs": (10,)}
_KINDS = ("rest_to_world", "joint_to_world", "skinning")


class CharacterModel(Handle):
    """A baked character. Pass its .nook file as a path, or as bytes in any form."""

    _kind = c.nook_model
    _destroy = "nook_model_destroy"

    def __init__(self, data: Any) -> None:
        super().__init__()
        # A pickle contains these bytes, and the maps of all later calls of remap().
        self._data = file_bytes(data, "CharacterModel")
        self._maps: Tuple[npt.NDArray[np.uint32], ...] = ()
        call("nook_model_load", shared_context().handle, self._data, len(self._data), ctypes.byref(self._handle))
        self._describe()

    def _describe(self) -> None:
        info = described(c.nook_model_info, "nook_model_describe", self.handle)
        self.bone_count: int = info.bone_count
        self.sphere_count: int = info.sphere_count
        self.key_point_count: int = info.key_point_count
        self.vertex_count: int = info.file_vertex_count
        self.bone_names: List[str] = [text(call("nook_model_bone_name", self.handle, i)) for i in range(info.bone_count)]
        skins = [described(c.nook_skin_info, "nook_model_describe_skin", self.handle, i) for i in range(info.skin_count)]
        self.skins: List[Skin] = [Skin(skin.file_index, skin.joint_count) for skin in skins]

    def __reduce_ex__(self, protocol: Any) -> Tuple[Callable[..., "CharacterModel"], Tuple[Any, ...]]:
        """A copy loads the same bytes."""
        self.handle  # raises if it is closed
        return _model, (type(self), self._data, self._maps)

    def static_ao(self) -> FloatArray:
        """Returns the AO of the rest pose, as from a static AO bake: one value for each vertex of the file."""
        ao = np.empty(self.vertex_count, np.float32)
        call("nook_model_read", self.handle, c.NOOK_MODEL_STATIC_AO, pointer(ao), self.vertex_count, 0)
        return ao

    def match_vertices(self, positions: Any, normals: Any = None, *, joints: Any = None, weights: Any = None, skin: int = 0,
                       primitive: Optional[int] = None, triangles: Any = None, in_rest_space: bool = False,
                       tolerance: float = 0.0) -> VertexMatch:
        """Finds the model's vertex for each vertex of your mesh, for remap().

        positions are n x 3, in the space of the file's POSITION attribute, or with in_rest_space in rest space and metres. normals
        are n x 3; they distinguish the two sides of a card. joints and weights are n x k, with k from 1 to 8; they distinguish
        vertices where meshes meet. skin is the index of their skin in the file. primitive is the file's primitive that your
        vertices come from; None means all primitives. triangles are m x 3 indices of your vertices; they distinguish the two sides
        of a sharp fold. tolerance is the largest distance of a match, as a share of the diagonal of the model's box; 0 means 1e-4.
        """
        desc = descriptor(c.nook_vertex_match_desc)
        p = floats(positions, (None, 3), "positions")
        n = None if normals is None else floats(normals, (len(p), 3), "normals")
        j = None if joints is None else integers(joints, np.uint16, (len(p), None), "joints")
        w = None if weights is None else floats(weights, (len(p), None), "weights")
        if j is not None and w is not None and j.shape != w.shape:
            raise ValueError(f"joints and weights have different shapes (got {j.shape} and {w.shape})")
        put(desc, positions=pointer(p), normals=pointer(n), vertex_count=len(p), in_rest_space=bool(in_rest_space), tolerance=tolerance,
            joints=pointer(j), weights=pointer(w), skin=skin, primitive=c.NOOK_ALL_PRIMITIVES if primitive is None else primitive)
        if j is not None:
            put(desc, influences=j.shape[1])
        vertices, info = np.empty(len(p), np.uint32), c.nook_vertex_match_info()
        info.struct_size = ctypes.sizeof(info)
        if triangles is None:
            call_interruptibly("nook_model_match_vertices", self.handle, ctypes.byref(desc), pointer(vertices), ctypes.byref(info),
                               keep=(p, n, j, w, self), entries=len(p))
        else:
            t = integers(triangles, np.uint32, (None, 3), "triangles")
            call_interruptibly("nook_model_match_mesh", self.handle, ctypes.byref(desc), pointer(t), t.size, pointer(vertices),
                               ctypes.byref(info), keep=(p, n, j, w, t, self), entries=len(p))
        return VertexMatch(vertices, info.unmatched, info.ambiguous, info.text.decode())

    def remap(self, vertices: Any) -> "CharacterModel":
        """Returns a model whose vertex i is this model's vertex vertices[i], so that AO is in the order of your mesh. You can also
        pass the result of match_vertices()."""
        if isinstance(vertices, VertexMatch):
            vertices = vertices.vertices
        indices = integers(vertices, np.uint32, (None,), "vertices").copy()
        made: CharacterModel = type(self).__new__(type(self))
        Handle.__init__(made)
        made._data, made._maps = self._data, self._maps + (indices,)
        call_interruptibly("nook_model_remap", self.handle, pointer(indices), len(indices), ctypes.byref(made._handle), keep=(self, made),
                           entries=len(indices))
        made._describe()
        return made

    def map_bones(self, names_of_transforms: Union[str, Sequence[str]], *, loose: bool = False,
                  drop_shared_prefix: bool = False) -> npt.NDArray[np.int32]:
        """Finds the transform of each bone by its name. Returns one index for each bone, or -1 if no name fits. Assign the result to
        transform_of_bone of a pose. loose ignores case and
        the characters space . _ - : |. drop_shared_prefix removes the prefix that all names share, such as "mixamorig:"."""
        desc = descriptor(c.nook_bone_map_desc)
        found = names(names_of_transforms, "names_of_transforms")
        flags = (c.NOOK_BONE_MAP_LOOSE if loose else 0) | (c.NOOK_BONE_MAP_DROP_SHARED_PREFIX if drop_shared_prefix else 0)
        put(desc, names=name_array(found), name_count=len(found), flags=flags)
        transforms = np.empty(self.bone_count, np.int32)
        call("nook_model_map_bones", self.handle, ctypes.byref(desc), pointer(transforms), self.bone_count, None)
        return transforms

    def convert_pose(self, pose: Any, kind: str = "rest_to_world", **options: Any) -> FloatArray:
        """Returns a pose of any kind as bones x 3 x 4, from rest space to the world. Takes the options of Instance.set_pose()."""
        bones = np.empty((self.bone_count, 3, 4), np.float32)
        desc, _kept = _pose(self, pose, kind, **options)
        call("nook_model_convert_pose", self.handle, ctypes.byref(desc), pointer(bones), self.bone_count)
        return bones


def _model(kind: Any, data: bytes, maps: Tuple[Any, ...]) -> CharacterModel:
    """Makes a model from its bytes and its maps. Copies and pickles call it."""
    made: CharacterModel = kind(data)
    for indices in maps:
        made = made.remap(indices)
    return made


def _pose(model: CharacterModel, pose: Any, kind: str, *, layout: Optional[str] = None, skin: int = 0, transform_of_bone: Any = None,
          place: Any = None, strict: bool = False, many: bool = False) -> Tuple[Any, List[Any]]:
    """Returns a pose for C, and the arrays that it points to, transforms first. With `many`, the matrices are an array of poses,
    and the pose for C is the first one."""
    what = "poses" if many else "pose"
    if not isinstance(kind, str) or kind not in _KINDS:
        raise ValueError(f"kind: {kind!r} is not one of {', '.join(_KINDS)}")
    if layout is None:
        pose = numbers(pose, what)
        layout = "rows_4x4" if pose.shape[1 + many:] == (4, 4) else "rows_3x4"
    number = choice("NOOK_TRANSFORM_", layout, "layout")
    skin = integer(skin, ctypes.c_uint32, "skin")
    count: Optional[int] = model.bone_count
    if kind == "skinning":
        joints = {each.file_index: each.joint_count for each in model.skins}
        if joints and skin not in joints:
            raise ValueError(f"skin: {skin} is not one of {', '.join(str(each) for each in joints)}")
        count = joints.get(skin)
    bones = None
    if transform_of_bone is not None:
        bones, count = integers(transform_of_bone, np.int32, (model.bone_count,), "transform_of_bone"), None
    of_all: Tuple[Optional[int], ...] = (None,) if many else ()
    transforms = floats(pose, of_all + (count,) + _LAYOUTS[layout], what)
    at = None if place is None else floats(place, (3, 4), "place")
    desc = descriptor(c.nook_pose_desc)
    put(desc, kind=choice("NOOK_POSE_", kind, "kind"), layout=number, transforms=pointer(transforms), transform_count=transforms.shape[many],
        skin=skin, place_3x4=pointer(at), flags=c.NOOK_POSE_FLAG_STRICT if strict else 0)
    if bones is not None:
        put(desc, transform_of_bone=pointer(bones), bone_count=len(bones))
    return desc, [transforms, bones, at]


class Instance:
    """A character in a scene."""

    def __init__(self, scene: "Scene", model: CharacterModel, number: int) -> None:
        self.scene, self.model, self.number = scene, model, number

    def __reduce_ex__(self, protocol: Any) -> Any:
        raise TypeError("a nook.Instance cannot be pickled or copied: an instance belongs to its scene; pass on the model and the pose instead")

    def set_pose(self, pose: Any, kind: str = "rest_to_world", **options: Any) -> None:
        """Sets the pose for the next update.

        kind is the kind of the matrices. rest_to_world: bones x 3 x 4, from rest space to world space. joint_to_world: the world
        matrices of the joints, one for each bone. skinning: joint matrix times inverse bind matrix, one for each joint of the
        file's skin. Matrices are n x 3 x 4, or n x 4 x 4 for column vectors, with the translation in the last column.

        options: layout (rows_3x4, rows_4x4, columns_4x4, columns_4x3, dual_quaternion, trs) is the form of a transform. skin is the
        file's index of the skin. transform_of_bone is the result of CharacterModel.map_bones(). place is a 3 x 4 matrix that is
        applied after every transform. strict makes a sheared bone an error.
        """
        desc, _kept = _pose(self.model, pose, kind, **options)
        call("nook_scene_set_pose", self.scene.handle, self.number, ctypes.byref(desc))

    def set_ground(self, plane: Optional[Sequence[float]]) -> None:
        """Sets the ground: the plane a x + b y + c z = d as (a, b, c, d) with a unit normal, or None for no ground."""
        values = None if plane is None else floats(plane, (4,), "plane")
        call("nook_scene_set_ground", self.scene.handle, self.number, pointer(values))

    def link(self, caster: "Instance") -> None:
        """Lets another instance of the same scene darken this one."""
        if need(caster, Instance, "caster").scene is not self.scene:
            # The library identifies an instance by its number within a scene. In another scene, this number is a different instance.
            raise ValueError("caster: the instance is in another scene; add its model to this scene, and link the new instance")
        call("nook_scene_link", self.scene.handle, self.number, caster.number)

    def record_pose(self) -> bytes:
        """Returns the pose as a record. Append it to a pose file for `nook bake character --calibrate`."""
        size = ctypes.c_size_t()
        call("nook_scene_record_pose", self.scene.handle, self.number, None, ctypes.byref(size))
        record = ctypes.create_string_buffer(size.value)
        call("nook_scene_record_pose", self.scene.handle, self.number, record, ctypes.byref(size))
        return record.raw

    def read_ao(self) -> FloatArray:
        """Returns the AO of the last update of the scene, one value for each vertex of the file. 1 means not occluded."""
        ao = np.empty(self.model.vertex_count, np.float32)
        call("nook_scene_read", self.scene.handle, self.number, c.NOOK_CHANNEL_AO, c.NOOK_FORMAT_FLOAT, pointer(ao),
             self.model.vertex_count, 0)
        return ao


class Sphere(int):
    """The id of an occluder, valid in one scene."""

    _scene: Any = None

    def __reduce_ex__(self, protocol: Any) -> Any:
        return int, (int(self),)


class Scene(Handle):
    """Instances that may darken each other."""

    _kind = c.nook_scene
    _destroy = "nook_scene_destroy"
    _no_copy = "the scene belongs to this process; pass on the models and poses, and make a new scene from them in the other process"

    def __init__(self, **settings: Any) -> None:
        """settings: numeric fields of nook_scene_desc, such as cutoff_error."""
        super().__init__()
        desc = descriptor(c.nook_scene_desc)
        put_settings(desc, settings, [field for field, *_ in c.nook_scene_desc._fields_[3:]], "a scene")
        call("nook_scene_create", shared_context().handle, ctypes.byref(desc), ctypes.byref(self._handle))

    def add_instance(self, model: CharacterModel) -> Instance:
        number = c.nook_instance_id()
        call("nook_scene_add_instance", self.handle, need(model, CharacterModel, "model").handle, ctypes.byref(number))
        return Instance(self, model, int(number.value))

    def add_sphere(self, centre: Sequence[float], radius: float) -> int:
        """Adds an occluder, in metres. Use the returned id to remove it."""
        number = c.nook_occluder_id()
        ball = c.nook_occluder()
        ball.centre_ws[:] = floats(centre, (3,), "centre").tolist()
        put(ball, radius=radius)
        call("nook_scene_add_occluder", self.handle, ctypes.byref(ball), ctypes.byref(number))
        sphere = Sphere(number.value)
        sphere._scene = weakref.ref(self)
        return sphere

    def remove_sphere(self, number: int) -> None:
        if isinstance(number, Sphere) and number._scene() is not self:
            raise ValueError("number: this sphere is in another scene")
        call("nook_scene_remove_occluder", self.handle, integer(number, ctypes.c_uint32, "number"))

    @property
    def uneven_instances(self) -> int:
        """The number of instances whose pose has a bone that was sheared or scaled unevenly, and was corrected."""
        return int(described(c.nook_scene_info, "nook_scene_describe", self.handle).uneven_instances)

    def update(self) -> None:
        """Evaluates all instances on this thread."""
        call("nook_scene_update", self.handle)


def evaluate_pose(model: CharacterModel, pose: Any, *, ground: Optional[Sequence[float]] = None, kind: str = "rest_to_world",
                  **options: Any) -> FloatArray:
    """Returns the AO of one character in one pose. kind and options are as in Instance.set_pose(). For many poses, call
    evaluate_poses()."""
    with Scene() as scene:
        instance = scene.add_instance(model)
        instance.set_pose(pose, kind, **options)
        if ground is not None:
            instance.set_ground(ground)
        scene.update()
        return instance.read_ao()


def evaluate_poses(model: CharacterModel, poses: Any, *, ground: Optional[Sequence[float]] = None, kind: str = "rest_to_world",
                   threads: int = 0, **options: Any) -> FloatArray:
    """Returns the AO of one character in many poses, poses x vertices. For each pose, the values are the same as from
    evaluate_pose().

    poses has one more axis than a pose: poses x bones x 3 x 4. kind and options are as in Instance.set_pose(), and apply to all
    poses. threads is 0 for all cores, or up to 1024; the values do not depend on it. Ctrl+C ends the call quickly.
    """
    handle = need(model, CharacterModel, "model").handle
    if integer(threads, ctypes.c_uint32, "threads") > _MOST_THREADS:
        raise ValueError(f"threads: need a whole number of 0 to {_MOST_THREADS}, got {threads}")
    desc, kept = _pose(model, poses, kind, many=True, **options)
    plane = None if ground is None else floats(ground, (4,), "ground")
    each: FloatArray = kept[0]
    ao = np.empty((len(each), model.vertex_count), np.float32)

    def evaluate(first: int, end: int) -> None:
        own = type(desc).from_buffer_copy(desc)
        own.transforms = pointer(each[first:end])
        try:
            call("nook_model_evaluate_poses", handle, None, ctypes.byref(own), end - first, 0, pointer(plane), pointer(ao[first:end]),
                 (end - first) * model.vertex_count)
        except NookError as error:
            # The library's pose index is relative to the first pose of this call. Converts it to an index into all poses.
            said = re.sub(r"(?<=: pose )\d+(?=:)", lambda found: str(first + int(found.group())), str(error), count=1)
            raise NookError(error.code, said) from None

    _share(evaluate, len(each), int(threads) or _cores())
    return ao


_MOST_THREADS = 1024


def _cores() -> int:
    """Returns the number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _share(work: Callable[[int, int], None], count: int, threads: int) -> None:
    """Calls work(first, end) for runs of 0 to count, on this thread and others. Raises the error of the first run that failed.

    A run takes about 50 ms: short enough to react to Ctrl+C between two runs, and long enough that the cost of a call does not
    matter.
    """
    lock, taken = threading.Lock(), 0
    errors: List[Tuple[int, BaseException]] = []

    def run() -> None:
        nonlocal taken
        size = 8
        while not errors:
            with lock:
                first, taken = taken, min(taken + size, count)
                end = taken
            if first == end:
                return
            began = time.perf_counter()
            try:
                work(first, end)
            except Exception as error:
                errors.append((first, error))
            each = (time.perf_counter() - began) / (end - first)
            size = max(1, min(4 * size, int(0.05 / max(each, 1e-9)), -(-count // threads)))

    others = [threading.Thread(target=run, name="nook", daemon=True) for _ in range(min(threads, count) - 1)]
    for thread in others:
        thread.start()
    try:
        run()
        for thread in others:
            thread.join()
    except BaseException as error:  # Ctrl+C, or an exception from another signal handler
        errors.append((-1, error))
        for thread in others:
            thread.join()
        raise
    if errors:
        raise min(errors, key=lambda each: each[0])[1]
