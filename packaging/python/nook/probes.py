"""Light probes: fits, files, radiance and irradiance."""
import ctypes
from typing import Any, Callable, Tuple

import numpy as np

from . import _layouts as c
from ._library import FloatArray, Handle, NookError, call, call_interruptibly, choice, described, descriptor, file_bytes, floats, integer, need, pointer, put
from .scenes import shared_context


_METHODS = ("least_squares", "least_squares_non_negative", "running_average", "running_average_non_negative")
# Methods that exist only for comparison.
_STUDIES = ("naive", "running_average_original", "moments")


class Probe(Handle):
    """One probe, or a grid of probes. Pass its .nook file as a path, or as bytes in any form.

    Directions are n x 3 unit vectors, light is n x 3 linear RGB.
    """

    _kind = c.nook_probe
    _destroy = "nook_probe_destroy"

    def __init__(self, data: Any) -> None:
        super().__init__()
        found = file_bytes(data, "Probe")
        call("nook_probe_load", shared_context().handle, found, len(found), ctypes.byref(self._handle))
        self._describe()

    def __reduce_ex__(self, protocol: Any) -> Tuple[Callable[..., "Probe"], Tuple[Any, ...]]:
        """A copy loads the file that save("float") makes, which is lossless."""
        return type(self), (self.save("float"),)

    def _describe(self) -> None:
        info = described(c.nook_probe_info, "nook_probe_describe", self.handle)
        self.function_count: int = info.function_count
        self.counts = tuple(int(n) for n in info.counts)
        self.origin = np.array(info.origin_ws[:], dtype=np.float32)
        self.spacing = np.array(info.spacing_ws[:], dtype=np.float32)

    def radiance(self, directions: Any, position: Any = None) -> FloatArray:
        """Returns the radiance from directions. position, in metres, is where a grid is evaluated: one position for all directions,
        or one for each."""
        return self._evaluate("nook_probe_radiance", directions, "directions", position)

    def irradiance(self, normals: Any, position: Any = None) -> FloatArray:
        """Returns the irradiance on surfaces. A white surface reflects irradiance / pi. position is one position for all normals,
        or one for each normal."""
        return self._evaluate("nook_probe_irradiance", normals, "normals", position)

    def _evaluate(self, function: str, directions: Any, what: str, position: Any) -> FloatArray:
        d = floats(directions, (None, 3), what)
        at = None
        if position is not None:
            shape = (3,) if np.ndim(position) == 1 else (len(d), 3)
            at = np.ascontiguousarray(np.broadcast_to(floats(position, shape, "position"), d.shape))
        rgb = np.empty_like(d)
        call_interruptibly(function, self.handle, pointer(at), pointer(d), pointer(rgb), len(d), keep=self, entries=len(d))
        return rgb

    def coefficients(self, index: int = 0) -> FloatArray:
        """Returns the coefficients of one probe of the grid, function_count x 3, for tools that edit or plot them."""
        rgb = np.empty((self.function_count, 3), dtype=np.float32)
        call("nook_probe_read_coefficients", self.handle, integer(index, ctypes.c_uint32, "index"), pointer(rgb), self.function_count)
        return rgb

    def save(self, packing: str = "half") -> bytes:
        """Returns the bytes of the probe's .nook file. packing is float, half or rgb9e5."""
        kind, size = choice("NOOK_PROBE_PACKING_", packing, "packing"), ctypes.c_size_t()
        call("nook_probe_save", self.handle, kind, None, ctypes.byref(size))
        data = ctypes.create_string_buffer(size.value)
        call("nook_probe_save", self.handle, kind, data, ctypes.byref(size))
        return data.raw[: size.value]


class ProbeFit(Handle):
    """A probe that is fitted while samples arrive."""

    _kind = c.nook_probe_fit
    _destroy = "nook_probe_fit_destroy"
    _no_copy = "the sums of the fit stay in the library; call solve() and pass on the probe, or make one fit for each thread and merge() them"

    def __init__(self, lobes: int = 12, *, method: str = "least_squares", ambient: bool = False, form: str = "default") -> None:
        """form is default, or paper for the published method. With paper, method must be default."""
        super().__init__()
        desc, study = descriptor(c.nook_probe_fit_desc), descriptor(c.nook_probe_fit_study_desc)
        desc.lobe_count = integer(lobes, ctypes.c_uint32, "lobes")
        put(desc, ambient=bool(ambient), form=choice("NOOK_FORM_", form, "form"))
        if method in _STUDIES:
            study.method = choice("NOOK_PROBE_FIT_STUDY_", method, "method")
        elif method in _METHODS:
            desc.method = choice("NOOK_PROBE_FIT_", method, "method")
        else:
            raise ValueError(f"method: {method!r} is not one of {', '.join(_METHODS + _STUDIES)}")
        desc.next = ctypes.addressof(study)
        call("nook_probe_fit_create", shared_context().handle, ctypes.byref(desc), ctypes.byref(self._handle))

    def add_samples(self, directions: Any, radiance: Any, weights: Any = None) -> None:
        """Adds radiance from unit directions. weights are 1 / (4 pi p) for directions with the probability density p, or None for
        uniform directions. Ctrl+C closes the fit, because it may contain only a part of the samples."""
        d = floats(directions, (None, 3), "directions")
        rgb = floats(radiance, (len(d), 3), "radiance")
        w = None if weights is None else floats(weights, (len(d),), "weights")
        try:
            call_interruptibly("nook_probe_fit_add_samples", self.handle, pointer(d), pointer(rgb), pointer(w), len(d), entries=len(d))
        except NookError:
            raise
        except BaseException:
            self._handle = self._kind()  # not destroyed: the call may still add to it
            raise

    def merge(self, other: "ProbeFit") -> None:
        """Adds the samples of another fit with the same settings, such as a fit from another thread."""
        call("nook_probe_fit_merge", self.handle, need(other, ProbeFit, "other").handle)

    def solve(self) -> Probe:
        """Returns a probe from the samples so far. You can add more samples afterwards."""
        probe = Probe.__new__(Probe)
        Handle.__init__(probe)
        call("nook_probe_fit_solve", self.handle, ctypes.byref(probe._handle))
        probe._describe()
        return probe
