"""Characters for the bakers: import, poses and skinning."""
import ctypes
import operator
import os
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _layouts as c
from ._library import (
    FloatArray, Handle, came, call, call_interruptibly, described, descriptor, floats, integer, integers, name_array, names, number,
    path_or_bytes, pointer, put, text,
)


class Character(Handle):
    """A rigged character in its rest pose, in metres. Vertices are in the order of its file.

    A pose is an array of bones x 3 x 4: one row-major matrix from rest space to world space for each bone.
    """

    _kind = c.nook_bake_character
    _destroy = "nook_bake_character_destroy"

    def __init__(self, path: Any = None, *, data: Any = None, meshes: Union[str, Sequence[str]] = (),
                 without: Union[str, Sequence[str]] = (), allow_outside_files: bool = False) -> None:
        """Imports a .glb or .gltf file from its path, or from its bytes if its buffers are embedded.

        path is a str, an os.PathLike, or bytes in any form: bytes, bytearray, memoryview, a numpy array, a binary file that is
        open. You can pass it as `data` instead. `meshes` and `without` are names of nodes or meshes to import and to skip. A single
        str is one name; * and ? stand for any text and any character. If you pass no `meshes`, you get everything that the file
        shows, except lower levels of detail. The file may refer to other files in its own folder, and with allow_outside_files to
        files in any folder.
        """
        super().__init__()
        if (path is None) == (data is None):
            raise TypeError("Character: give either a path or data, not both")
        source = path_or_bytes(data if path is None else path, "Character")
        if isinstance(source, str):
            source = os.path.abspath(source)  # so that a copy finds the file from any working folder
        self._import({"source": source, "meshes": names(meshes, "meshes"), "without": names(without, "without"),
                      "allow_outside_files": bool(allow_outside_files)})

    @classmethod
    def from_arrays(cls, positions: Any, triangles: Any, joints: Any, weights: Any, bone_parents: Sequence[int], bone_frames: Any,
                    bone_names: Optional[Sequence[str]] = None) -> "Character":
        """Makes a character from arrays. joints and weights are vertices x influences; bone_frames is bones x 3 x 4, in rest
        space."""
        p = floats(positions, (None, 3), "positions")
        bones = integers(joints, np.uint16, (len(p), None), "joints")
        parents = integers(bone_parents, np.int32, (None,), "bone_parents")
        found = None if bone_names is None else names(bone_names, "bone_names")
        if found is not None and len(found) != len(parents):
            raise ValueError(f"bone_names: has {len(found)} names, need {len(parents)}, one for each bone")
        arrays = {"positions": p, "triangles": integers(triangles, np.uint32, (None, 3), "triangles"), "joints": bones,
                  "weights": floats(weights, bones.shape, "weights"), "bone_parents": parents,
                  "bone_frames": floats(bone_frames, (len(parents), 3, 4), "bone_frames"), "bone_names": found}
        # Copies the arrays, so that later changes by the caller do not affect copies and pickles of the character.
        return _character(cls, {name: value.copy() if isinstance(value, np.ndarray) else value for name, value in arrays.items()})

    def _import(self, origin: Dict[str, Any]) -> None:
        """Creates the character from its file or its arrays. A pickle contains the same."""
        desc = descriptor(c.nook_bake_source_desc)
        held: Any = None
        if "source" in origin:
            source = origin["source"]
            if isinstance(source, str):
                desc.path = source.encode("utf-8", "surrogateescape")
            else:
                # Uses a buffer, because ctypes would pass empty bytes as NULL.
                held = ctypes.create_string_buffer(source, max(len(source), 1))
                put(desc, bytes=ctypes.cast(held, ctypes.c_void_p), byte_count=len(source))
            put(desc, meshes=name_array(origin["meshes"]), mesh_count=len(origin["meshes"]), without=name_array(origin["without"]),
                without_count=len(origin["without"]), allow_outside_files=origin["allow_outside_files"])
        else:
            p, triangles, joints, parents = (origin[name] for name in ("positions", "triangles", "joints", "bone_parents"))
            put(desc, positions=pointer(p), indices=pointer(triangles), joints=pointer(joints), weights=pointer(origin["weights"]),
                vertex_count=len(p), index_count=triangles.size, influences=joints.shape[1], bone_parents=pointer(parents),
                bone_frames_3x4=pointer(origin["bone_frames"]), bone_count=len(parents))
            if origin["bone_names"] is not None:
                desc.bone_names = name_array(origin["bone_names"])
        call_interruptibly("nook_bake_character_create", ctypes.byref(desc), ctypes.byref(self._handle), keep=(origin, held, self))
        self._origin = origin
        self._describe()

    def __reduce_ex__(self, protocol: Any) -> Tuple[Callable[..., "Character"], Tuple[Any, ...]]:
        """A copy imports the same path, bytes or arrays again."""
        self.handle  # raises if it is closed
        return _character, (type(self), self._origin, (self.vertex_count, self.triangle_count, self.bone_names))

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
        if not self.clip_names:
            raise ValueError(f"clip {clip!r}: the character has no clip")
        said = ", ".join(repr(name) for name in self.clip_names)
        if isinstance(clip, str):
            if clip not in self.clip_names:
                raise ValueError(f"clip {clip!r} is not one of {said}")
            return self.clip_names.index(clip)
        try:
            index = operator.index(clip)
        except TypeError:
            raise TypeError(f"clip: need a name or a number, got {came(clip)}; there are {said}") from None
        if not 0 <= index < len(self.clip_names):
            raise ValueError(f"clip {index} is not in 0 to {len(self.clip_names) - 1}: {said}")
        return index

    def clip_duration(self, clip: Union[int, str]) -> float:
        """Returns the duration of a clip in seconds."""
        seconds = ctypes.c_float()
        call("nook_bake_character_clip_duration", self.handle, self._clip(clip), ctypes.byref(seconds))
        return float(seconds.value)

    def sample_clip(self, clip: Union[int, str], time_s: float) -> FloatArray:
        """Returns the pose of a clip at a time in seconds, counted from the first key of the clip."""
        bones = np.empty((self.bone_count, 3, 4), np.float32)
        at = number(time_s, ctypes.c_float, "time_s")
        call("nook_bake_character_sample_clip", self.handle, self._clip(clip), at, pointer(bones), self.bone_count)
        return bones

    def rest_pose(self) -> FloatArray:
        """Returns the matrices of the rest pose: identities."""
        return np.tile(np.eye(3, 4, dtype=np.float32), (self.bone_count, 1, 1))

    def auto_poses(self, count: int, seed: int = 1) -> FloatArray:
        """Returns generated whole-body poses, count x bones x 3 x 4."""
        count, seed = integer(count, ctypes.c_uint32, "count"), integer(seed, ctypes.c_uint64, "seed")
        bones = np.empty((count, self.bone_count, 3, 4), np.float32)
        call_interruptibly("nook_bake_character_auto_poses", self.handle, seed, count, pointer(bones), self.bone_count, keep=self)
        return bones

    def vertices(self) -> Tuple[FloatArray, FloatArray]:
        """Returns rest positions in metres, and unit normals."""
        positions, normals = (np.empty((self.vertex_count, 3), np.float32) for _ in range(2))
        for array, values in ((c.NOOK_BAKE_ARRAY_POSITIONS, positions), (c.NOOK_BAKE_ARRAY_NORMALS, normals)):
            call("nook_bake_character_read", self.handle, array, pointer(values), self.vertex_count, 0)
        return positions, normals

    def triangles(self) -> npt.NDArray[np.uint32]:
        """Returns vertex indices, triangles x 3."""
        indices = np.empty((self.triangle_count, 3), np.uint32)
        call("nook_bake_character_read", self.handle, c.NOOK_BAKE_ARRAY_TRIANGLES, pointer(indices), len(indices), 0)
        return indices

    def skin(self, pose: Any) -> Tuple[FloatArray, FloatArray]:
        """Returns positions and normals of a pose in world space."""
        bones = floats(pose, (self.bone_count, 3, 4), "pose")
        positions, normals = (np.empty((self.vertex_count, 3), np.float32) for _ in range(2))
        call("nook_bake_character_skin", self.handle, pointer(bones), self.bone_count, pointer(positions), pointer(normals), self.vertex_count)
        return positions, normals


def _character(kind: Any, origin: Dict[str, Any], expected: Any = None) -> Character:
    """Makes a character from its file or its arrays. Copies and pickles call it."""
    made: Character = kind.__new__(kind)
    Handle.__init__(made)
    made._import(origin)
    if expected is not None and expected != (made.vertex_count, made.triangle_count, made.bone_names):
        raise ValueError(f"Character: {origin.get('source')!r} has changed since the character was pickled; import it again")
    return made
