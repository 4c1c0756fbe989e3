"""The shared library, the results of its calls, and the conversion of Python values to C arguments: numbers,
names, bytes, arrays."""
import ctypes
import ctypes.util
import functools
import math
import operator
import os
import pathlib
import threading
from typing import Any, Callable, Dict, Iterable, List, Optional, Tuple, Type, TypeVar, Union

import numpy as np
import numpy.typing as npt

from . import _layouts as c

FloatArray = npt.NDArray[np.float32]
Own = TypeVar("Own", bound="Handle")


class NookError(Exception):
    """A failed call. `code` is the name of the result, such as "BAD_FILE"."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code

    def __reduce__(self) -> Tuple[Any, ...]:
        # If an argument were missing, a multiprocessing Pool could not create the error again, and would wait
        # forever.
        return type(self), (self.code, str(self))


class Cancelled(NookError):
    """A job that was stopped, by cancel() or by its progress function."""


class MissingLibrary(NookError, ImportError):
    """No library was found, or it lacks a function, such as a baker's."""


def _candidates() -> List[str]:
    """Paths of libraries. Each may have only some of the functions; a function comes from the first library that has it."""
    named = os.environ.get("NOOK_LIBRARY")
    if named:
        return named.split(os.pathsep)
    beside = sorted(str(p) for p in pathlib.Path(__file__).parent.glob("*nook_python*") if p.suffix in (".so", ".dll", ".dylib"))
    installed = [ctypes.util.find_library(name) for name in ("nook_python", "nook", "nook_bake")]
    return beside or [path for path in installed if path]


class _Library:
    """Finds functions by name when they are first called, and gives them the types of the headers."""

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
                raise MissingLibrary("UNSUPPORTED", f"nook: the loaded library has no {name}; also install libnook_bake of the same version")
            found.restype, found.argtypes = c.FUNCTIONS[name]
            self._found[name] = found
        return found


_library = _Library()
_RESULTS = {value: name.removeprefix("NOOK_ERROR_") for name, value in vars(c).items() if name.startswith("NOOK_ERROR_")}


# The range of each integer type of C that the headers use.
_RANGES: Dict[Any, Tuple[int, int]] = {}
for _kind in (ctypes.c_int32, ctypes.c_uint16, ctypes.c_uint32, ctypes.c_uint64, ctypes.c_size_t):
    _bits = 8 * ctypes.sizeof(_kind)
    _RANGES[_kind] = (-(2 ** (_bits - 1)), 2 ** (_bits - 1) - 1) if _kind(-1).value < 0 else (0, 2**_bits - 1)


def came(value: Any) -> str:
    """Describes a value in a few words for a message: its type, and the value if it is short."""
    kind, said = type(value).__name__, repr(value)
    return f"{kind} {said}" if len(said) <= 60 and not said.startswith("<") else kind


def integer(value: Any, kind: Any, what: str) -> int:
    """Returns a number that fits an integer type of C. Raises ValueError for other whole numbers, and TypeError for other values.

    ctypes itself would silently keep only the lower bits.
    """
    try:
        found = int(value) if isinstance(value, np.bool_) else operator.index(value)
    except TypeError:
        raise TypeError(f"{what}: need a whole number, got {came(value)}") from None
    low, high = _RANGES[kind]
    if not low <= found <= high:
        raise ValueError(f"{what}: need a whole number of {low} to {high}, got {found}")
    return found


def number(value: Any, kind: Any, what: str) -> float:
    """Converts a number to a floating-point type of C. Raises ValueError if a finite number would become infinite."""
    try:
        if isinstance(value, (str, bytes, bytearray)):
            raise TypeError
        found = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{what}: need a number, got {came(value)}") from None
    except OverflowError:
        raise ValueError(f"{what}: the number is too large") from None
    if math.isfinite(found) and not math.isfinite(kind(found).value):
        raise ValueError(f"{what}: {found} is too large for a float")
    return found


def checked(value: Any, kind: Any, what: str) -> Any:
    """Returns a value for a field or an argument of a C type. Numbers are checked; ctypes handles everything else."""
    limits = _RANGES.get(kind)
    if limits is not None:
        # The first condition is for speed: most values are ints that fit.
        return value if type(value) is int and limits[0] <= value <= limits[1] else integer(value, kind, what)
    return number(value, kind, what) if kind in (ctypes.c_float, ctypes.c_double) else value


@functools.lru_cache(maxsize=None)
def _fields(structure: Any) -> Dict[str, Any]:
    """Returns the types of a structure's fields."""
    return {name: kind for name, kind, *_ in structure._fields_}


def put(structure: Any, **values: Any) -> None:
    """Sets fields of a structure. A value that does not fit raises ValueError or TypeError, which names the field."""
    kind: Any = type(structure)
    kinds = _fields(kind)
    for name, value in values.items():
        setattr(structure, name, checked(value, kinds[name], name))


def put_settings(structure: Any, settings: Dict[str, Any], names: Iterable[str], of: str) -> None:
    """Sets fields that a user gave by their names in the C header. Enumerations, such as form, can be given as words."""
    allowed = sorted(names)
    for name, value in settings.items():
        if name not in allowed:
            raise TypeError(f"{name!r} is not a setting of {of}; the settings are {', '.join(allowed)}")
        if name == "form" and isinstance(value, str):
            value = choice("NOOK_FORM_", value, name)
        put(structure, **{name: value})


@functools.lru_cache(maxsize=None)
def _numbers(name: str) -> Tuple[Tuple[int, Any, str], ...]:
    """Returns the numeric arguments of a function: position, type, and words for a message."""
    kinds = enumerate(c.FUNCTIONS[name][1])
    return tuple((at, kind, f"{name}, argument {at + 1}") for at, kind in kinds if kind in _RANGES or kind in (ctypes.c_float, ctypes.c_double))


def call(name: str, *arguments: Any) -> Any:
    """Calls a function. If it fails, raises NookError with the library's message."""
    checks = list(arguments)
    for at, kind, what in _numbers(name):
        checks[at] = checked(checks[at], kind, what)
    result = _library.function(name)(*checks)
    if c.FUNCTIONS[name][0] is c.nook_result and result != c.NOOK_OK:
        part = "nook_bake_last_message" if name.startswith("nook_bake_") else "nook_last_message"
        message = _library.function(part)().decode("utf-8", "replace")
        kind = Cancelled if result == c.NOOK_ERROR_CANCELLED else NookError
        raise kind(_RESULTS.get(result, str(result)), message)
    return result


def call_interruptibly(name: str, *arguments: Any, stop: Optional[Callable[[], None]] = None, keep: Any = None,
                       entries: Optional[int] = None) -> Any:
    """Like call(), but Ctrl+C can end the call. On the main thread, a C call would delay Ctrl+C until it
    returns.

    The call runs on another thread. After Ctrl+C, stop() asks it to end. If it does not end soon, it continues in the background,
    and its result is lost. So it may write only to memory that nobody else uses. keep is the memory that its descriptor points to.
    A call with few entries ends soon, so it needs no thread.
    """
    # Only the main thread receives signals.
    if threading.current_thread() is not threading.main_thread() or (entries is not None and entries < 50_000):
        return call(name, *arguments)
    answers: List[Any] = []
    errors: List[BaseException] = []

    def run(_keep: Any) -> None:
        try:
            answers.append(call(name, *arguments))
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=run, args=(keep,), name="nook", daemon=True)
    thread.start()
    try:
        while thread.is_alive():
            thread.join(0.1)  # with a timeout, because Windows does not interrupt a wait without one
    except BaseException:  # Ctrl+C, or an exception from another signal handler
        if stop is not None:
            stop()
        thread.join(0.2)
        raise
    if errors:
        raise errors[0]
    return answers[0]


def described(kind: Any, name: str, *arguments: Any) -> Any:
    """Returns a structure that a call has filled."""
    info = kind()
    info.struct_size = ctypes.sizeof(kind)
    call(name, *arguments, ctypes.byref(info))
    return info


def descriptor(kind: Any) -> Any:
    """Returns a descriptor with the defaults of the library."""
    desc = kind()
    name = kind.__name__.removeprefix("nook_").removesuffix("_desc").upper()
    init = "nook_bake_desc_init" if name.startswith("BAKE_") else "nook_desc_init"
    call(init, getattr(c, f"NOOK_DESC_{name}"), ctypes.byref(desc), ctypes.sizeof(kind), c.NOOK_VERSION)
    return desc


class Handle:
    """An object of the library that lives until close() or until nobody uses it."""

    _kind: Any = None
    _destroy = ""
    # Says why pickle and copy do not work, and what to do instead.
    _no_copy = "it belongs to this process"

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

    def __reduce_ex__(self, protocol: Any) -> Any:
        # A copied handle would refer to an object that another process does not have, or that would be
        # destroyed twice.
        raise TypeError(f"a nook.{type(self).__name__} cannot be pickled or copied: {self._no_copy}")

    def __enter__(self: Own) -> Own:
        return self

    def __exit__(self, *reason: object) -> None:
        self.close()

    def __del__(self) -> None:
        try:
            self.close()
        except Exception:  # the interpreter may be ending
            pass


def need(value: Any, kind: Type[Any], what: str) -> Any:
    """Returns the value if it is an instance of the class. Otherwise raises TypeError, whose text describes the value."""
    if not isinstance(value, kind):
        raise TypeError(f"{what}: need a nook.{kind.__name__}, got {came(value)}")
    return value


def encoded(value: Any, what: str) -> bytes:
    """Encodes a name or a path for C. C ends a text at its first NUL."""
    if not isinstance(value, str):
        raise TypeError(f"{what}: need a str, got {came(value)}")
    if "\0" in value:
        raise ValueError(f"{what}: {value!r} has a NUL character")
    try:
        # surrogateescape is the form in which Python keeps the bytes of file names that are not UTF-8.
        return value.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        raise ValueError(f"{what}: {value!r} contains half of a surrogate pair, which UTF-8 cannot encode") from None


def names(values: Any, what: str) -> List[bytes]:
    """Names for C: a str becomes one name, and None becomes an empty list."""
    if values is None:
        return []
    if isinstance(values, str):
        values = [values]
    if isinstance(values, (bytes, bytearray, memoryview)) or not isinstance(values, Iterable):
        raise TypeError(f"{what}: need a name or a list of names, got {came(values)}")
    return [encoded(value, f"{what}: each name") for value in values]


def name_array(found: List[bytes]) -> Any:
    return (ctypes.c_char_p * len(found))(*found) if found else None


def path_or_bytes(value: Any, what: str) -> Union[str, bytes]:
    """Converts a file argument: a path (str, os.PathLike) becomes a str; a buffer or an open binary file becomes its bytes."""
    if isinstance(value, (str, os.PathLike)):
        path = os.fsdecode(value)
        if not path:
            raise ValueError(f"{what}: the path is empty")
        encoded(path, what)
        return path
    if isinstance(value, bytes):
        return bytes(value)
    view: Optional[memoryview] = None
    try:
        view = memoryview(value)
    except TypeError:
        pass
    if view is not None:
        if "O" in view.format:
            raise TypeError(f"{what}: need the bytes of a file, got an array of Python objects")
        return view.tobytes()
    data = value.read() if callable(getattr(value, "read", None)) else None
    if isinstance(data, bytes):
        return data
    if isinstance(data, str):
        raise TypeError(f"{what}: the file is open as text; open it with mode \"rb\"")
    raise TypeError(f"{what}: need a path (str or os.PathLike) or bytes (bytes, bytearray, memoryview, numpy array), got {came(value)}")


def file_bytes(value: Any, what: str) -> bytes:
    """Returns the bytes of a file that is given as a path or a buffer. Raises OSError for a path that cannot be read."""
    found = path_or_bytes(value, what)
    return pathlib.Path(found).read_bytes() if isinstance(found, str) else found


def _shaped(array: npt.NDArray[Any], shape: Tuple[Optional[int], ...], what: str) -> None:
    if array.ndim != len(shape) or any(wanted is not None and have != wanted for have, wanted in zip(array.shape, shape)):
        sides = " x ".join("any" if n is None else str(n) for n in shape)
        raise ValueError(f"{what}: has the shape {array.shape}, need {sides}")


def numbers(values: Any, what: str) -> npt.NDArray[Any]:
    """Returns values as an array of any shape. Raises ValueError for lists of different lengths."""
    try:
        return np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{what}: its rows have different lengths ({error})") from None


def floats(values: Any, shape: Tuple[Optional[int], ...], what: str) -> FloatArray:
    """Returns values as packed floats of a shape, in which None means any length. Otherwise raises ValueError, whose text describes
    the values."""
    array = numbers(values, what)
    if array.dtype.kind not in "biufO":
        raise ValueError(f"{what}: need numbers, got an array of {array.dtype}")
    _shaped(array, shape, what)
    if array.dtype == np.float32:
        return np.ascontiguousarray(array)
    try:
        with np.errstate(over="ignore"):
            return np.ascontiguousarray(array, dtype=np.float32)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{what}: need numbers, got {came(values)}") from None


def integers(values: Any, kind: Any, shape: Tuple[Optional[int], ...], what: str) -> npt.NDArray[Any]:
    """Like floats(), but for integers. Raises ValueError for values that do not fit the type."""
    array = numbers(values, what)
    info = np.iinfo(kind)
    if array.size:
        if not np.issubdtype(array.dtype, np.integer):
            raise ValueError(f"{what}: need whole numbers of {info.min} to {info.max}, got an array of {array.dtype}")
        if int(array.min()) < info.min or int(array.max()) > info.max:
            raise ValueError(f"{what}: need whole numbers of {info.min} to {info.max}, got {int(array.min())} to {int(array.max())}")
    _shaped(array, shape, what)
    return np.ascontiguousarray(array, dtype=kind)


def pointer(array: Optional[npt.NDArray[Any]]) -> Any:
    """Returns the C pointer of an array, or NULL for None. The caller must keep the array alive."""
    if array is None:
        return None
    kinds: Dict[str, Any] = {"f": ctypes.c_float, "u4": ctypes.c_uint32, "i4": ctypes.c_int32, "u2": ctypes.c_uint16}
    key = "f" if array.dtype == np.float32 else array.dtype.str[1:]
    return array.ctypes.data_as(ctypes.POINTER(kinds[key]))


@functools.lru_cache(maxsize=None)
def _words(beginning: str) -> Dict[str, Any]:
    return {key.removeprefix(beginning).lower(): value for key, value in vars(c).items() if key.startswith(beginning)}


def choice(beginning: str, name: str, what: str) -> int:
    """Returns the constant for a word: "standard" is NOOK_BAKE_PRESET_STANDARD. Raises ValueError with all words."""
    words = _words(beginning)
    if not isinstance(name, str):
        raise TypeError(f"{what}: need one of the words {', '.join(sorted(words))}, got {came(name)}")
    if name not in words:
        raise ValueError(f"{what}: {name!r} is not one of {', '.join(sorted(words))}")
    return int(words[name])


def word(beginning: str, value: int) -> str:
    """Returns the word of a constant."""
    for key, number in vars(c).items():
        if key.startswith(beginning) and number == value:
            return key.removeprefix(beginning).lower()
    return str(value)


def text(value: Optional[bytes]) -> str:
    return value.decode("utf-8", "replace") if value else ""
