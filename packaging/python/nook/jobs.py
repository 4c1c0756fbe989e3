"""Runs bakes as jobs on their own threads, with progress and cancel."""
import contextlib
import ctypes
import json
import os
import time
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _layouts as c
from ._library import (
    Handle, NookError, came, call, call_interruptibly, choice, described, descriptor, encoded, file_bytes, floats, integers, name_array, names, need,
    pointer, put, put_settings, text,
)
from .characters import Character
from .materials import Material


class Progress(NamedTuple):
    """`stage` is a short text for users about the current step, such as "ray tracing". `is_done` is True when the job has
    ended."""

    stage: str
    done: int
    total: int
    is_done: bool = False


ProgressFunction = Callable[[Progress], Optional[bool]]


class Job(Handle):
    """A running bake. Iterate over it to get its progress until it ends."""

    _kind = c.nook_bake_job
    _destroy = "nook_bake_job_destroy"
    _no_copy = "the job runs on threads of this process; call wait(), and pass on the bytes that it returns"

    def __init__(self, desc: Any, progress: Optional[ProgressFunction], keep: Any) -> None:
        super().__init__()
        if progress is not None and not callable(progress):
            raise TypeError(f"progress: need a function, got {came(progress)}")
        self._process = os.getpid()
        self._error: Optional[BaseException] = None

        def report(_user: Any, at: Any) -> int:
            try:
                assert progress is not None
                return 0 if progress(_progress(at.contents)) is False else 1
            except BaseException as error:  # no exception may cross the C interface, so wait() raises it
                self._error = error
                return 0

        # The job calls the progress function from its own threads, so the function must live as long as the job.
        self._report = c.nook_bake_progress_fn(report) if progress else c.nook_bake_progress_fn(0)
        desc.progress = self._report
        # nook_bake_start makes the poses before it returns, which takes time. If Ctrl+C interrupts it, the job is closed together
        # with this object.
        call_interruptibly("nook_bake_start", ctypes.byref(desc), ctypes.byref(self._handle), keep=(keep, self))

    @property
    def handle(self) -> Any:
        if self._process != os.getpid():
            raise NookError("INVALID_HANDLE", "Job: the job belongs to the process that started it; wait for the job in that process, and pass its bytes to other processes")
        return super().handle

    def close(self) -> None:
        """Cancels the job if it is running, waits until it has stopped, and destroys it. A second call does nothing."""
        if getattr(self, "_process", None) not in (None, os.getpid()):
            self._handle = self._kind()  # a forked process has no threads of the job, and would wait forever
        super().close()

    def poll(self) -> Progress:
        """Returns the current progress, without waiting."""
        return _progress(described(c.nook_bake_progress, "nook_bake_job_poll", self.handle))

    def __iter__(self) -> Iterator[Progress]:
        while True:
            progress = self.poll()
            yield progress
            if progress.is_done:
                return
            with self._cancelled_by_ctrl_c():
                time.sleep(0.1)

    @contextlib.contextmanager
    def _cancelled_by_ctrl_c(self) -> Iterator[None]:
        try:
            yield
        except NookError:
            raise
        except BaseException:  # Ctrl+C, or an exception from another signal handler
            self.cancel()
            raise

    def cancel(self) -> None:
        """Requests that the job stop soon. wait() then raises Cancelled."""
        call("nook_bake_job_cancel", self.handle)

    def wait(self) -> bytes:
        """Waits for the end and returns the bytes of the .nook file. Raises what the progress function raised, Cancelled,
        or NookError. Ctrl+C cancels the job and raises KeyboardInterrupt."""
        # Polls, because Python handles Ctrl+C only after a C call has returned. A waiting C call would last until the bake has ended.
        with self._cancelled_by_ctrl_c():
            pause = 0.001
            while not self.poll().is_done:
                time.sleep(pause)
                pause = min(2 * pause, 0.05)
        try:
            call("nook_bake_job_wait", self.handle)
        except Exception:
            if self._error is not None:
                raise self._error
            raise
        data, size = ctypes.c_void_p(), ctypes.c_size_t()
        call("nook_bake_job_file", self.handle, ctypes.byref(data), ctypes.byref(size))
        return ctypes.string_at(data, size.value)

    def report(self) -> Dict[str, Any]:
        """Returns settings, times, errors and the curve of the fit. Call it only after the job has ended."""
        json_text = ctypes.c_char_p()
        call("nook_bake_job_report", self.handle, ctypes.byref(json_text))
        found: Dict[str, Any] = json.loads((json_text.value or b"{}").decode("utf-8"))
        return found


def _progress(at: Any) -> Progress:
    return Progress(text(at.stage), int(at.done), int(at.total), at.state == c.NOOK_BAKE_DONE)


def bake_character(character: Character, *, preset: str = "standard", poses: Optional[str] = None, clips: Union[str, Sequence[str]] = (),
                   clip_split: Optional[str] = None, extra_poses: Any = None, calibration_poses: Any = None, form: Optional[str] = None,
                   progress: Optional[ProgressFunction] = None, **settings: Any) -> Job:
    """Starts to bake a character model and returns at once.

    preset: draft, standard or production. poses: auto, single_joint, clips, all or extra. form: default, or paper: Le et al. 2019.
    clips: names of the clips to take poses from; one str is one name. calibration_poses: recorded poses of your game, in the form
    of extra_poses. The bake ends with a fit of the constant and the scale of each vertex to these poses. clip_split: all, half or
    families, for comparisons. settings: spheres, key_points, rays, steps, auto_pose_count, samples_per_clip, seed, threads, gamma,
    saturation, time_limit_s. They have the meanings of the fields of nook_bake_character_desc. progress: a function that the job
    calls on its threads; return False from it to cancel.
    """
    desc, keep = _character_bake(character, preset=preset, poses=poses, clips=clips, clip_split=clip_split, extra_poses=extra_poses,
                                 calibration_poses=calibration_poses, form=form, **settings)
    return Job(desc, progress, keep)


def _character_bake(character: Character, *, preset: str = "standard", poses: Optional[str] = None, clips: Union[str, Sequence[str]] = (),
                    clip_split: Optional[str] = None, extra_poses: Any = None, calibration_poses: Any = None, form: Optional[str] = None,
                    **settings: Any) -> Tuple[Any, Any]:
    """Returns the descriptor of the bake, and the objects that must live as long as the descriptor."""
    desc = descriptor(c.nook_bake_character_desc)
    desc.character = need(character, Character, "character").handle
    desc.preset = choice("NOOK_BAKE_PRESET_", preset, "preset")
    if poses is not None:
        desc.pose_mode = choice("NOOK_BAKE_POSES_", poses, "poses")
    study = descriptor(c.nook_bake_character_study_desc)
    if clip_split is not None:
        study.clip_split = choice("NOOK_BAKE_SPLIT_", clip_split, "clip_split")
    calibration = None
    if calibration_poses is not None:
        calibration = floats(calibration_poses, (None, character.bone_count, 3, 4), "calibration_poses")
        put(study, calibration_poses_3x4=pointer(calibration), calibration_pose_count=len(calibration))
    if clip_split is not None or calibration is not None:
        desc.next = ctypes.cast(ctypes.pointer(study), ctypes.c_void_p)
    if form is not None:
        desc.form = choice("NOOK_FORM_", form, "form")
    taken = names(clips, "clips")
    put(desc, clip_count=len(taken), clip_names=name_array(taken))
    extra = None
    if extra_poses is not None:
        extra = floats(extra_poses, (None, character.bone_count, 3, 4), "extra_poses")
        put(desc, extra_poses_3x4=pointer(extra), extra_pose_count=len(extra))
    put_settings(desc, settings, ("spheres", "key_points", "rays", "steps", "auto_pose_count", "samples_per_clip", "seed", "threads",
                                  "gamma", "saturation", "time_limit_s"), "a character's bake")
    return desc, (character, study, extra, calibration, taken)


def bake_material(*, meso: Optional[str] = None, btf: Any = None, coverage: Any = None, lights: Any = None, views: Any = None,
                  method: Optional[str] = None, form: Optional[str] = None, relief: bool = False, heights: Any = None,
                  progress: Optional[ProgressFunction] = None, **settings: Any) -> Job:
    """Starts to bake a material and returns at once.

    Pass meso (fiber, roughhole or weave), or btf (lights x views x height x width x 3). With btf, lights and views are directions
    in tangent space, and coverage is views x height x width. method: k_cta, cta, n_svd or neural. form: default, or paper (Tsai and
    Shih 2012). With relief, the views are aligned by a relief. With meso, it comes from the built-in structure. With btf, it comes
    from `heights` (height x width, in tiles), or the bake searches for it. settings: numeric fields of nook_bake_material_desc,
    such as seed.
    """
    desc, keep = _material_bake(meso=meso, btf=btf, coverage=coverage, lights=lights, views=views, method=method, form=form, relief=relief,
                                heights=heights, **settings)
    return Job(desc, progress, keep)


def _material_bake(*, meso: Optional[str] = None, btf: Any = None, coverage: Any = None, lights: Any = None, views: Any = None,
                   method: Optional[str] = None, form: Optional[str] = None, relief: bool = False, heights: Any = None,
                   **settings: Any) -> Tuple[Any, Any]:
    """Returns the descriptor of the bake, and the objects that must live as long as the descriptor."""
    desc = descriptor(c.nook_bake_material_desc)
    kept: List[Any] = []
    own = {"struct_size", "type", "next", "meso", "btf", "coverage", "lights", "views", "method", "form", "relief", "heights",
           "progress", "progress_user"}
    # The size of an array defines these counts, so they must not be passed as settings.
    own |= {"light_count"} if lights is not None else set()
    own |= {"view_count"} if views is not None else set()
    own |= {"width", "height"} if btf is not None else set()
    put_settings(desc, settings, [name for name, *_ in c.nook_bake_material_desc._fields_ if name not in own], "this bake of a material")

    def give(field: str, values: Any, shape: Any) -> Any:
        array = floats(values, shape, field)
        kept.append(array)
        setattr(desc, field, pointer(array))
        return array

    if meso is not None:
        desc.meso = encoded(meso, "meso")
    if lights is not None:
        put(desc, light_count=len(give("lights", lights, (None, 3))))
    if views is not None:
        put(desc, view_count=len(give("views", views, (None, 3))))
    if btf is not None:
        if lights is None or views is None:
            raise ValueError("btf: needs lights and views, the directions of its first two axes")
        height, width = give("btf", btf, (desc.light_count, desc.view_count, None, None, 3)).shape[2:4]
        put(desc, height=height, width=width)
    if coverage is not None:
        give("coverage", coverage, (desc.view_count, desc.height, desc.width))
    if method is not None:
        desc.method = choice("NOOK_BAKE_METHOD_", method, "method")
    if form is not None:
        desc.form = choice("NOOK_FORM_", form, "form")
    desc.relief = 1 if relief else 0
    if heights is not None:
        give("heights", heights, (desc.height, desc.width))
    return desc, kept


def bake_transfer(positions: Any, normals: Any, uvs: Any, triangles: Any, *, tangents: Any = None, holes_of: Any = None,
                  progress: Optional[ProgressFunction] = None, **settings: Any) -> Job:
    """Starts to bake radiance transfer of a static shape and returns at once.

    holes_of: a material; light falls through the holes of its VOTF. Pass a Material, or its .nook file as a path or bytes.
    settings: lobes, ray_side, threads, bounces, tiles.
    """
    desc, keep = _transfer_bake(positions, normals, uvs, triangles, tangents=tangents, holes_of=holes_of, **settings)
    return Job(desc, progress, keep)


def _transfer_bake(positions: Any, normals: Any, uvs: Any, triangles: Any, *, tangents: Any = None, holes_of: Any = None,
                   **settings: Any) -> Tuple[Any, Any]:
    """Returns the descriptor of the bake, and the objects that must live as long as the descriptor."""
    desc = descriptor(c.nook_bake_transfer_desc)
    holes: Optional[bytes] = None
    p = floats(positions, (None, 3), "positions")
    n = floats(normals, (len(p), 3), "normals")
    uv = floats(uvs, (len(p), 2), "uvs")
    tangent = None if tangents is None else floats(tangents, (len(p), 4), "tangents")
    indices = integers(triangles, np.uint32, (None, 3), "triangles")
    desc.positions, desc.normals, desc.uvs, desc.tangents = pointer(p), pointer(n), pointer(uv), pointer(tangent)
    put(desc, indices=pointer(indices), vertex_count=len(p), index_count=indices.size)
    if holes_of is not None:
        holes = holes_of.data if isinstance(holes_of, Material) else file_bytes(holes_of, "holes_of")
        put(desc, votf=ctypes.cast(ctypes.c_char_p(holes), ctypes.c_void_p), votf_size=len(holes))
    put_settings(desc, settings, ("lobes", "ray_side", "threads", "bounces", "tiles"), "a transfer's bake")
    return desc, (p, n, uv, tangent, indices, holes)


def bake_key(bake: Callable[..., Job], *arguments: Any, **settings: Any) -> str:
    """Returns the key of a bake, 64 hexadecimal digits, without baking. Two bakes with the same key give the same file.

    bake: bake_character, bake_material or bake_transfer; the rest is what you would pass to it. `nook bake character --print-key` gives
    the same key for the same character and settings.
    """
    describers: Dict[Any, Callable[..., Tuple[Any, Any]]] = {
        bake_character: _character_bake, bake_material: _material_bake, bake_transfer: _transfer_bake}
    describe = describers.get(bake)
    if describe is None:
        raise ValueError(f"bake: need bake_character, bake_material or bake_transfer, got {came(bake)}")
    settings.pop("progress", None)
    desc, keep = describe(*arguments, **settings)
    key = ctypes.create_string_buffer(c.NOOK_BAKE_KEY_SIZE)
    call_interruptibly("nook_bake_key", ctypes.byref(desc), key, len(key), keep=keep)
    return key.value.decode("ascii")
