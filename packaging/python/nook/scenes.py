"""What the runtime does with baked characters: models, scenes, ambient occlusion of poses."""
import ctypes
import logging
import weakref
from typing import Any, List, Optional, Sequence

import numpy as np

from . import _layouts as c
from ._library import (
    FloatArray, Handle, call, described, descriptor, file_bytes, floats, integer, need, pointer, put,
    put_settings, text,
)


_log = logging.getLogger("nook")


@c.nook_log_fn
def _log_line(_user: Any, severity: int, line: bytes) -> None:
    """Passes what the library logs to the logger "nook"."""
    levels = {c.NOOK_LOG_WARNING: logging.WARNING, c.NOOK_LOG_ERROR: logging.ERROR}
    _log.log(levels.get(severity, logging.DEBUG), "%s", text(line))


class Context(Handle):
    """The library's own object, from which all others are created."""

    _kind = c.nook_context
    _destroy = "nook_context_destroy"

    def __init__(self) -> None:
        super().__init__()
        desc = descriptor(c.nook_context_desc)
        desc.log = _log_line
        call("nook_context_create", ctypes.byref(desc), ctypes.byref(self._handle))


_shared: Optional[Context] = None


def shared_context() -> Context:
    """The context of this module, which any thread may use."""
    global _shared
    if _shared is None:
        _shared = Context()
    return _shared


class CharacterModel(Handle):
    """A baked character: its .nook file as a path, or as bytes in any form."""

    _kind = c.nook_model
    _destroy = "nook_model_destroy"

    def __init__(self, data: Any) -> None:
        super().__init__()
        found = file_bytes(data, "CharacterModel")
        call("nook_model_load", shared_context().handle, found, len(found), ctypes.byref(self._handle))
        self._describe()

    def _describe(self) -> None:
        info = described(c.nook_model_info, "nook_model_describe", self.handle)
        self.bone_count: int = info.bone_count
        self.sphere_count: int = info.sphere_count
        self.key_point_count: int = info.key_point_count
        self.vertex_count: int = info.file_vertex_count
        self.bone_names: List[str] = [text(call("nook_model_bone_name", self.handle, i)) for i in range(info.bone_count)]

    def static_ao(self) -> FloatArray:
        """AO of the rest pose as a static bake has it, one value for each vertex of the file."""
        ao = np.empty(self.vertex_count, np.float32)
        call("nook_model_read", self.handle, c.NOOK_MODEL_STATIC_AO, pointer(ao), self.vertex_count, 0)
        return ao


class Instance:
    """A character of a scene."""

    def __init__(self, scene: "Scene", model: CharacterModel, number: int) -> None:
        self.scene, self.model, self.number = scene, model, number

    def set_pose(self, pose: Any) -> None:
        """bones x 3 x 4, from rest space to the world."""
        bones = floats(pose, (self.model.bone_count, 3, 4), "pose")
        desc = descriptor(c.nook_pose_desc)
        put(desc, kind=c.NOOK_POSE_REST_TO_WORLD, layout=c.NOOK_TRANSFORM_ROWS_3X4, transforms=pointer(bones), transform_count=len(bones))
        call("nook_scene_set_pose", self.scene.handle, self.number, ctypes.byref(desc))

    def set_ground(self, plane: Optional[Sequence[float]]) -> None:
        """The plane a x + b y + c z = d as (a, b, c, d) with a unit normal, or None for no ground."""
        values = None if plane is None else floats(plane, (4,), "plane")
        call("nook_scene_set_ground", self.scene.handle, self.number, pointer(values))

    def link(self, caster: "Instance") -> None:
        """The other instance, which is in the same scene, darkens this one."""
        if need(caster, Instance, "caster").scene is not self.scene:
            # The library knows an instance by its number, which another scene has given to another one.
            raise ValueError("caster: it is in another scene; add its model to this scene and link that instance")
        call("nook_scene_link", self.scene.handle, self.number, caster.number)

    def read_ao(self) -> FloatArray:
        """AO after the scene's update, one value for each vertex of the file; 1 is open."""
        ao = np.empty(self.model.vertex_count, np.float32)
        call("nook_scene_read", self.scene.handle, self.number, c.NOOK_CHANNEL_AO, c.NOOK_FORMAT_FLOAT, pointer(ao),
             self.model.vertex_count, 0)
        return ao


class Sphere(int):
    """The number of an occluder, which belongs to one scene."""

    _scene: Any = None


class Scene(Handle):
    """Instances that may darken each other."""

    _kind = c.nook_scene
    _destroy = "nook_scene_destroy"

    def __init__(self, **settings: Any) -> None:
        """settings: numbers of nook_scene_desc, such as cutoff_error."""
        super().__init__()
        desc = descriptor(c.nook_scene_desc)
        put_settings(desc, settings, [field for field, *_ in c.nook_scene_desc._fields_[3:]], "a scene")
        call("nook_scene_create", shared_context().handle, ctypes.byref(desc), ctypes.byref(self._handle))

    def add_instance(self, model: CharacterModel) -> Instance:
        number = c.nook_instance_id()
        call("nook_scene_add_instance", self.handle, need(model, CharacterModel, "model").handle, ctypes.byref(number))
        return Instance(self, model, int(number.value))

    def add_sphere(self, centre: Sequence[float], radius: float) -> int:
        """An occluder in metres; the number that is returned removes it."""
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
        """The number of instances whose pose has a bone that is sheared or scaled unevenly, which is projected."""
        return int(described(c.nook_scene_info, "nook_scene_describe", self.handle).uneven_instances)

    def update(self) -> None:
        """Evaluates all instances on this thread."""
        call("nook_scene_update", self.handle)


def evaluate_pose(model: CharacterModel, pose: Any, *, ground: Optional[Sequence[float]] = None) -> FloatArray:
    """AO of one character in one pose. For many poses, keep a Scene with an instance and call set_pose(), update() and read_ao() for
    each."""
    with Scene() as scene:
        instance = scene.add_instance(model)
        instance.set_pose(pose)
        if ground is not None:
            instance.set_ground(ground)
        scene.update()
        return instance.read_ao()
