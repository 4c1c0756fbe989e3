"""Characters of the bakers: import, poses, skinning."""
import ctypes
import os
from typing import Any, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _layouts as c
from ._library import FloatArray, Handle, call, described, descriptor, floats, integers, pointer, text


class Character(Handle):
    """A rigged character in its rest pose, in metres. Vertices are in the order of its file.

    A pose is an array of bones x 3 x 4: from rest space to world space, row by row.
    """

    _kind = c.nook_bake_character
    _destroy = "nook_bake_character_destroy"

    def __init__(self, path: Union[str, "os.PathLike[str]", None] = None, *, data: Optional[bytes] = None) -> None:
        """Imports a .glb or .gltf file, or the bytes of one whose buffers are embedded."""
        super().__init__()
        if (path is None) == (data is None):
            raise TypeError("Character: give either a path or data")
        if path is not None:
            call("nook_bake_import_gltf", os.fspath(path).encode("utf-8"), ctypes.byref(self._handle))
        else:
            assert data is not None
            call("nook_bake_import_gltf_bytes", data, len(data), ctypes.byref(self._handle))
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
        desc = descriptor(c.nook_bake_mesh_desc, "nook_bake_mesh_desc_init")
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
        self.bone_names: List[str] = [text(call("nook_bake_character_bone_name", self.handle, i)) for i in range(info.bone_count)]
        self.clip_names: List[str] = [text(call("nook_bake_character_clip_name", self.handle, i)) for i in range(info.clip_count)]
        self.warnings: List[str] = [text(call("nook_bake_character_warning", self.handle, i)) for i in range(info.warning_count)]

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
        call("nook_bake_character_read_vertices", self.handle, pointer(positions), pointer(normals), self.vertex_count)
        return positions, normals

    def triangles(self) -> npt.NDArray[np.uint32]:
        """Indices of vertices, triangles x 3."""
        indices = np.empty((self.triangle_count, 3), np.uint32)
        call("nook_bake_character_read_triangles", self.handle, pointer(indices), indices.size)
        return indices

    def skin(self, pose: Any) -> Tuple[FloatArray, FloatArray]:
        """Positions and normals of a pose in world space."""
        bones = floats(pose, (self.bone_count, 3, 4), "pose")
        positions, normals = (np.empty((self.vertex_count, 3), np.float32) for _ in range(2))
        call("nook_bake_character_skin", self.handle, pointer(bones), self.bone_count, pointer(positions), pointer(normals), self.vertex_count)
        return positions, normals
