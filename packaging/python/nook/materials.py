"""Compressed materials, decoded on the processor."""
import ctypes
from typing import Any, NamedTuple

import numpy as np

from . import _layouts as c
from ._library import FloatArray, Handle, call, described, floats, word
from .scenes import shared_context


class MaterialValues(NamedTuple):
    """radiance is n x 3 linear RGB for an irradiance of 1; occlusion and visibility are n values."""

    radiance: FloatArray
    occlusion: FloatArray
    visibility: FloatArray


class Material(Handle):
    """The bytes of a .nook file of a material."""

    _kind = c.nook_material
    _destroy = "nook_material_destroy"

    def __init__(self, data: bytes) -> None:
        super().__init__()
        call("nook_material_load", shared_context().handle, data, len(data), ctypes.byref(self._handle))
        info = described(c.nook_material_info, "nook_material_describe", self.handle)
        self.width: int = info.width
        self.height: int = info.height
        self.light_count: int = info.light_count
        self.view_count: int = info.view_count
        self.visibility: str = word("NOOK_MATERIAL_VISIBILITY_", info.visibility)

    def evaluate(self, uv: Any, view: Any, light: Any, level: float = 0.0) -> MaterialValues:
        """The material at n points: uv is n x 2, view and light are n x 3 unit vectors in tangent space, away from the surface."""
        points = floats(uv, (None, 2), "uv")
        views, lights = floats(view, (len(points), 3), "view"), floats(light, (len(points), 3), "light")
        # The structures hold floats alone, so that arrays of floats have their layout.
        samples = np.concatenate([points, np.full((len(points), 1), level, np.float32), views, lights], axis=1).astype(np.float32)
        values = np.empty((len(points), ctypes.sizeof(c.nook_material_value) // 4), np.float32)
        call("nook_material_evaluate", self.handle, ctypes.cast(samples.ctypes.data, ctypes.POINTER(c.nook_material_sample)), len(points),
             ctypes.cast(values.ctypes.data, ctypes.POINTER(c.nook_material_value)))
        return MaterialValues(values[:, 0:3].copy(), values[:, 3].copy(), values[:, 4].copy())
