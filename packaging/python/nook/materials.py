"""Compressed materials, decoded on the processor."""
import ctypes
from typing import Any, Callable, NamedTuple, Tuple

import numpy as np

from . import _layouts as c
from ._library import FloatArray, Handle, call, call_interruptibly, described, file_bytes, floats, integer, word
from .scenes import shared_context


class MaterialValues(NamedTuple):
    """`radiance` is n x 3 linear RGB for an irradiance of 1. `occlusion` and `visibility` have n values each."""

    radiance: FloatArray
    occlusion: FloatArray
    visibility: FloatArray


class Material(Handle):
    """A baked material. Pass its .nook file as a path, or as bytes in any form."""

    _kind = c.nook_material
    _destroy = "nook_material_destroy"

    def __init__(self, data: Any) -> None:
        super().__init__()
        self.data: bytes = file_bytes(data, "Material")
        call("nook_material_load", shared_context().handle, self.data, len(self.data), None, ctypes.byref(self._handle))
        info = described(c.nook_material_info, "nook_material_describe", self.handle)
        self.width: int = info.width
        self.height: int = info.height
        self.light_count: int = info.light_count
        self.view_count: int = info.view_count
        self.visibility: str = word("NOOK_MATERIAL_VISIBILITY_", info.visibility)

    def __reduce_ex__(self, protocol: Any) -> Tuple[Callable[..., "Material"], Tuple[Any, ...]]:
        """A copy loads the same bytes."""
        self.handle  # raises if it is closed
        return type(self), (self.data,)

    def evaluate(self, uv: Any, view: Any, light: Any, dx: Any = None, dy: Any = None, fetches: int = 1) -> MaterialValues:
        """Evaluates the material in n pixels. uv is n x 2. view and light are n x 3 unit vectors in tangent space that point away
        from the surface. dx and dy are n x 2, the changes of uv to the next pixel to the right and above; None means the finest
        level. Each value is the mean over `fetches` samples along the longer side of the pixel, 1 to NOOK_MATERIAL_MAX_FETCHES."""
        fetches = integer(fetches, ctypes.c_uint32, "fetches")
        points = floats(uv, (None, 2), "uv")
        sides = [floats(np.zeros_like(points) if side is None else side, (len(points), 2), name) for side, name in ((dx, "dx"), (dy, "dy"))]
        views, lights = floats(view, (len(points), 3), "view"), floats(light, (len(points), 3), "light")
        # The structures contain only floats, so arrays of floats have the same layout.
        rows = np.concatenate([points, *sides, views, lights], axis=1).astype(np.float32)
        values = np.empty((len(rows), ctypes.sizeof(c.nook_material_value) // 4), np.float32)
        pixels = ctypes.cast(rows.ctypes.data, ctypes.POINTER(c.nook_material_pixel))
        out = ctypes.cast(values.ctypes.data, ctypes.POINTER(c.nook_material_value))
        call_interruptibly("nook_material_evaluate", self.handle, pixels, len(rows), fetches, out, keep=(rows, values, self),
                           entries=len(rows) * max(fetches, 1))
        return MaterialValues(values[:, 0:3].copy(), values[:, 3].copy(), values[:, 4].copy())
