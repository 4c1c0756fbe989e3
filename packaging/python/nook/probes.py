"""Light probes: fits, files, radiance and irradiance."""
import ctypes
from typing import Any, Optional, Sequence

import numpy as np

from . import _layouts as c
from ._library import FloatArray, Handle, call, choice, described, descriptor, floats, pointer
from .scenes import shared_context


class Probe(Handle):
    """One probe, or a grid of them: the bytes of a .nook file. Directions are n x 3 unit vectors, light is n x 3 linear RGB."""

    _kind = c.nook_probe
    _destroy = "nook_probe_destroy"

    def __init__(self, data: bytes) -> None:
        super().__init__()
        call("nook_probe_load", shared_context().handle, data, len(data), ctypes.byref(self._handle))
        self._describe()

    def _describe(self) -> None:
        info = described(c.nook_probe_info, "nook_probe_describe", self.handle)
        self.function_count: int = info.function_count
        self.counts = tuple(int(n) for n in info.counts)
        self.origin = np.array(info.origin_ws[:], dtype=np.float32)
        self.spacing = np.array(info.spacing_ws[:], dtype=np.float32)

    def radiance(self, directions: Any, position: Optional[Sequence[float]] = None) -> FloatArray:
        """Light from directions; position, in metres, is where a grid is looked up."""
        d = floats(directions, (None, 3), "directions")
        at = None if position is None else floats(position, (3,), "position")
        rgb = np.empty_like(d)
        call("nook_probe_radiance", self.handle, pointer(at), pointer(d), pointer(rgb), len(d))
        return rgb

    def irradiance(self, normals: Any, position: Optional[Sequence[float]] = None, form: str = "bands") -> FloatArray:
        """Light on surfaces; a white one reflects it divided by pi."""
        n = floats(normals, (None, 3), "normals")
        at = None if position is None else floats(position, (3,), "position")
        rgb = np.empty_like(n)
        call("nook_probe_irradiance", self.handle, pointer(at), choice("NOOK_PROBE_IRRADIANCE_", form, "form"), pointer(n), pointer(rgb), len(n))
        return rgb

    def save(self, packing: str = "half") -> bytes:
        """The bytes of its .nook file; packing is float, half or rgb9e5."""
        kind, size = choice("NOOK_PROBE_PACKING_", packing, "packing"), ctypes.c_size_t()
        call("nook_probe_save", self.handle, kind, None, ctypes.byref(size))
        data = ctypes.create_string_buffer(size.value)
        call("nook_probe_save", self.handle, kind, data, ctypes.byref(size))
        return data.raw[: size.value]


class ProbeFit(Handle):
    """A probe that is fitted while samples arrive."""

    _kind = c.nook_probe_fit
    _destroy = "nook_probe_fit_destroy"

    def __init__(self, lobes: int = 12, *, method: str = "least_squares", ambient: bool = False) -> None:
        super().__init__()
        desc = descriptor(c.nook_probe_fit_desc, "nook_probe_fit_desc_init")
        desc.lobe_count, desc.ambient, desc.method = lobes, int(ambient), choice("NOOK_PROBE_", method, "method")
        call("nook_probe_fit_create", shared_context().handle, ctypes.byref(desc), ctypes.byref(self._handle))

    def add_samples(self, directions: Any, radiance: Any, weights: Any = None) -> None:
        """Light from unit directions; weights are 1 / (4 pi p) for directions of density p, None for uniform ones."""
        d = floats(directions, (None, 3), "directions")
        rgb = floats(radiance, (len(d), 3), "radiance")
        w = None if weights is None else floats(weights, (len(d),), "weights")
        call("nook_probe_fit_add_samples", self.handle, pointer(d), pointer(rgb), pointer(w), len(d))

    def solve(self) -> Probe:
        """A probe of the samples so far; more may follow."""
        probe = Probe.__new__(Probe)
        Handle.__init__(probe)
        call("nook_probe_fit_solve", self.handle, ctypes.byref(probe._handle))
        probe._describe()
        return probe
