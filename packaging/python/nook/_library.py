"""The shared library, the results of its calls, and numpy arrays as its pointers."""
import ctypes
import ctypes.util
import os
import pathlib
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _layouts as c

FloatArray = npt.NDArray[np.float32]


class NookError(Exception):
    """A call that failed. code is the name of the result, such as "BAD_FILE"."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code


class Cancelled(NookError):
    """A job that was stopped, by cancel() or by its progress function."""


class MissingLibrary(NookError, ImportError):
    """No library was found, or it lacks a function, such as those of the bakers."""


def _candidates() -> List[str]:
    """Paths of libraries, each of which may hold a part of the functions; the first that has one gives it."""
    named = os.environ.get("NOOK_LIBRARY")
    if named:
        return named.split(os.pathsep)
    beside = sorted(str(p) for p in pathlib.Path(__file__).parent.glob("*nook_python*") if p.suffix in (".so", ".dll", ".dylib"))
    installed = [ctypes.util.find_library(name) for name in ("nook_python", "nook", "nook_bake")]
    return beside or [path for path in installed if path]


class _Library:
    """Functions by name, with the types of the headers; they are looked up when they are first called."""

    def __init__(self) -> None:
        self._parts: Optional[List[ctypes.CDLL]] = None
        self._found: Dict[str, Any] = {}

    def _load(self) -> List[ctypes.CDLL]:
        if self._parts is None:
            paths = _candidates()
            if not paths:
                raise MissingLibrary("UNSUPPORTED", "nook: no shared library of Nook is installed; install libnook and libnook_bake, or set "
                                     "NOOK_LIBRARY to their paths")
            try:
                self._parts = [ctypes.CDLL(path) for path in paths]
            except OSError as error:
                raise MissingLibrary("UNSUPPORTED", f"nook: a shared library cannot be loaded ({error}); check NOOK_LIBRARY") from error
        return self._parts

    def function(self, name: str) -> Any:
        found = self._found.get(name)
        if found is None:
            for part in self._load():
                try:
                    found = part[name]
                except AttributeError:
                    continue
                break
            else:
                raise MissingLibrary("UNSUPPORTED", f"nook: the loaded library has no {name}; install libnook_bake as well, of the same version")
            found.restype, found.argtypes = c.FUNCTIONS[name]
            self._found[name] = found
        return found


_library = _Library()
_RESULTS = {value: name.removeprefix("NOOK_ERROR_") for name, value in vars(c).items() if name.startswith("NOOK_ERROR_")}


def call(name: str, *arguments: Any) -> Any:
    """Calls a function; a result that is an error becomes NookError with the library's message."""
    result = _library.function(name)(*arguments)
    if c.FUNCTIONS[name][0] is c.nook_result and result != c.NOOK_OK:
        part = "nook_bake_last_message" if name.startswith("nook_bake_") else "nook_last_message"
        message = _library.function(part)().decode("utf-8", "replace")
        kind = Cancelled if result == c.NOOK_ERROR_CANCELLED else NookError
        raise kind(_RESULTS.get(result, str(result)), message)
    return result


def described(kind: Any, name: str, *arguments: Any) -> Any:
    """A structure that a call fills."""
    info = kind()
    info.struct_size = ctypes.sizeof(kind)
    call(name, *arguments, ctypes.byref(info))
    return info


def descriptor(kind: Any) -> Any:
    """A descriptor with the defaults of the library."""
    desc = kind()
    name = kind.__name__.removeprefix("nook_").removesuffix("_desc").upper()
    init = "nook_bake_desc_init" if name.startswith("BAKE_") else "nook_desc_init"
    call(init, getattr(c, f"NOOK_DESC_{name}"), ctypes.byref(desc), ctypes.sizeof(kind), c.NOOK_VERSION)
    return desc


class Handle:
    """An object of the library that lives until close() or until nobody uses it."""

    _kind: Any = None
    _destroy = ""

    def __init__(self) -> None:
        self._handle = self._kind()

    @property
    def handle(self) -> Any:
        """The C handle, for calls that this module does not wrap."""
        if not self._handle:
            raise NookError("INVALID_HANDLE", f"{type(self).__name__}: it is closed")
        return self._handle

    def close(self) -> None:
        """Destroys the object; a second call does nothing."""
        if getattr(self, "_handle", None):
            call(self._destroy, ctypes.byref(self._handle))
            self._handle = self._kind()

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *reason: object) -> None:
        self.close()

    def __del__(self) -> None:
        try:
            self.close()
        except Exception:  # the interpreter may be ending
            pass


def floats(values: Any, shape: Tuple[Optional[int], ...], what: str) -> FloatArray:
    """Values as packed floats of a shape, in which None is any length. Raises ValueError, which names what came."""
    array = np.ascontiguousarray(values, dtype=np.float32)
    if array.ndim != len(shape) or any(need is not None and have != need for have, need in zip(array.shape, shape)):
        wanted = " x ".join("any" if n is None else str(n) for n in shape)
        raise ValueError(f"{what}: has the shape {array.shape}, need {wanted}")
    return array


def integers(values: Any, kind: Any, shape: Tuple[Optional[int], ...], what: str) -> npt.NDArray[Any]:
    """The same for integers. Raises ValueError for values that the type does not hold."""
    array = np.asarray(values)
    info = np.iinfo(kind)
    if array.size and (not np.issubdtype(array.dtype, np.integer) or array.min() < info.min or array.max() > info.max):
        raise ValueError(f"{what}: need whole numbers of {info.min} to {info.max}")
    if array.ndim != len(shape) or any(need is not None and have != need for have, need in zip(array.shape, shape)):
        raise ValueError(f"{what}: has the shape {array.shape}")
    return np.ascontiguousarray(array, dtype=kind)


def pointer(array: Optional[npt.NDArray[Any]]) -> Any:
    """The C pointer of an array, which the caller keeps alive; None is NULL."""
    if array is None:
        return None
    kinds = {"f": ctypes.c_float, "u4": ctypes.c_uint32, "i4": ctypes.c_int32, "u2": ctypes.c_uint16}
    key = "f" if array.dtype == np.float32 else array.dtype.str[1:]
    return array.ctypes.data_as(ctypes.POINTER(kinds[key]))


def choice(beginning: str, name: str, what: str) -> int:
    """The constant that a word stands for: "standard" is NOOK_BAKE_PRESET_STANDARD. Raises ValueError with all words."""
    words = {key.removeprefix(beginning).lower(): value for key, value in vars(c).items() if key.startswith(beginning)}
    if name not in words:
        raise ValueError(f"{what}: {name!r} is none of {', '.join(sorted(words))}")
    return int(words[name])


def word(beginning: str, value: int) -> str:
    """The word of a constant."""
    for key, number in vars(c).items():
        if key.startswith(beginning) and number == value:
            return key.removeprefix(beginning).lower()
    return str(value)


def text(value: Optional[bytes]) -> str:
    return value.decode("utf-8", "replace") if value else ""
