"""Characters of the bakers: import, poses, skinning."""
import ctypes
import os
from typing import Any, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _layouts as c
from ._library import FloatArray, Handle, call, described, descriptor, floats, integers, pointer, text


def _patterns(names: Sequence[str], argument: str) -> Any:
    if isinstance(names, str):
        raise TypeError(f"Character: {argument} is a list of names, not one text")
    return (ctypes.c_char_p * len(names))(*[name.encode("utf-8") for name in names]) if names else None


class Character(Handle):
    """A rigged character in its rest pose, in metres. Vertices are in the order of its file.

    A pose is an array of bones x 3 x 4: from rest space to world space, row by row.
    """

    _kind = c.nook_bake_character
    _destroy = "nook_bake_character_destroy"

    def __init__(self, path: Union[str, "os.PathLike[str]", None] = None, *, data: Optional[bytes] = None, meshes: Sequence[str] = (),
                 without: Sequence[str] = ()) -> None:
        """Imports a .glb or .gltf file, or the bytes of one whose buffers are embedded.

        meshes and without are names of its nodes or meshes to take and to leave out, in which * and ? stand for any text and any
        character. Without meshes it takes all that the file shows but lower levels of detail.
        """
        super().__init__()
        if (path is None) == (data is None):
            raise TypeError("Character: give either a path or data")
        desc = descriptor(c.nook_bake_source_desc)
        if path is not None:
            desc.path = os.fspath(path).encode("utf-8")
        else:
            assert data is not None
            # A buffer, because ctypes makes NULL of empty bytes.
            held = ctypes.create_string_buffer(data, max(len(data), 1))
            desc.bytes, desc.byte_count = ctypes.cast(held, ctypes.c_void_p), len(data)
        desc.meshes, desc.mesh_count = _patterns(meshes, "meshes"), len(meshes)
        desc.without, desc.without_count = _patterns(without, "without"), len(without)
        call("nook_bake_character_create", ctypes.byref(desc), ctypes.byref(self._handle))
        self._describe()

    @classmethod
    def from_arrays(cls, positions: Any, triangles: Any, joints: Any, weights: Any, bone_parents: Sequence[int], bone_frames: Any,
                    bone_names: Optional[Sequence[str]] = None) -> "Character":
        """A character without a file: joints and weights are vertices x influences, bone_frames bones x 3 x 4 in rest space."""
        made = cls.__new__(cls)
        Handle.__init__(made)
        p = floats(positions, (None, 3), "positions")
        indices = integers(triangles, np.uint32, (None, 3), "triangles")
        bones = integers(joints, np.uint16, (len(p), None), "joints")
        w = floats(weights, bones.shape, "weights")
        parents = integers(bone_parents, np.int32, (None,), "bone_parents")
        frames = floats(bone_frames, (len(parents), 3, 4), "bone_frames")
        desc = descriptor(c.nook_bake_source_desc)
        desc.positions, desc.indices, desc.joints, desc.weights = pointer(p), pointer(indices), pointer(bones), pointer(w)
        desc.vertex_count, desc.index_count, desc.influences = len(p), indices.size, bones.shape[1]
        desc.bone_parents, desc.bone_frames_3x4, desc.bone_count = pointer(parents), pointer(frames), len(parents)
        if bone_names is not None:
            if len(bone_names) != len(parents):
                raise ValueError(f"bone_names: has {len(bone_names)}, need {len(parents)}")
            desc.bone_names = (ctypes.c_char_p * len(parents))(*[name.encode("utf-8") for name in bone_names])
        call("nook_bake_character_create", ctypes.byref(desc), ctypes.byref(made._handle))
        made._describe()
        return made

    def _describe(self) -> None:
        info = described(c.nook_bake_character_info, "nook_bake_character_describe", self.handle)
        self.vertex_count: int = info.file_vertex_count
        self.welded_vertex_count: int = info.vertex_count
        self.triangle_count: int = info.triangle_count
        self.bone_count: int = info.bone_count
        self.bounds: FloatArray = np.array([info.bounds_min[:], info.bounds_max[:]], dtype=np.float32)
        self.bone_names = self._names(c.NOOK_BAKE_NAME_BONE, info.bone_count)
        self.clip_names = self._names(c.NOOK_BAKE_NAME_CLIP, info.clip_count)
        self.warnings = self._names(c.NOOK_BAKE_NAME_WARNING, info.warning_count)

    def _names(self, kind: int, count: int) -> List[str]:
        return [text(call("nook_bake_character_name", self.handle, kind, i)) for i in range(count)]

    def _clip(self, clip: Union[int, str]) -> int:
        if isinstance(clip, int):
            return clip
        if clip not in self.clip_names:
            raise ValueError(f"clip {clip!r} is none of {', '.join(self.clip_names) or 'none: the file has no clip'}")
        return self.clip_names.index(clip)

    def clip_duration(self, clip: Union[int, str]) -> float:
        """Seconds."""
        seconds = ctypes.c_float()
        call("nook_bake_character_clip_duration", self.handle, self._clip(clip), ctypes.byref(seconds))
        return float(seconds.value)

    def sample_clip(self, clip: Union[int, str], time_s: float) -> FloatArray:
        """The pose of a clip at a time in seconds from its first key."""
        bones = np.empty((self.bone_count, 3, 4), np.float32)
        call("nook_bake_character_sample_clip", self.handle, self._clip(clip), time_s, pointer(bones), self.bone_count)
        return bones

    def rest_pose(self) -> FloatArray:
        """The matrices of the rest pose, identities."""
        return np.tile(np.eye(3, 4, dtype=np.float32), (self.bone_count, 1, 1))

    def auto_poses(self, count: int, seed: int = 1) -> FloatArray:
        """Generated whole-body poses, count x bones x 3 x 4."""
        bones = np.empty((count, self.bone_count, 3, 4), np.float32)
        call("nook_bake_character_auto_poses", self.handle, seed, count, pointer(bones), self.bone_count)
        return bones

    def vertices(self) -> Tuple[FloatArray, FloatArray]:
        """Rest positions in metres, and unit normals."""
        positions, normals = (np.empty((self.vertex_count, 3), np.float32) for _ in range(2))
        for array, values in ((c.NOOK_BAKE_ARRAY_POSITIONS, positions), (c.NOOK_BAKE_ARRAY_NORMALS, normals)):
            call("nook_bake_character_read", self.handle, array, pointer(values), self.vertex_count, 0)
        return positions, normals

    def triangles(self) -> npt.NDArray[np.uint32]:
        """Indices of vertices, triangles x 3."""
        indices = np.empty((self.triangle_count, 3), np.uint32)
        call("nook_bake_character_read", self.handle, c.NOOK_BAKE_ARRAY_TRIANGLES, pointer(indices), len(indices), 0)
        return indices

    def skin(self, pose: Any) -> Tuple[FloatArray, FloatArray]:
        """Positions and normals of a pose in world space."""
        bones = floats(pose, (self.bone_count, 3, 4), "pose")
        positions, normals = (np.empty((self.vertex_count, 3), np.float32) for _ in range(2))
        call("nook_bake_character_skin", self.handle, pointer(bones), self.bone_count, pointer(positions), pointer(normals), self.vertex_count)
        return positions, normals
