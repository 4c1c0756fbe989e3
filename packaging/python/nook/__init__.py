"""Nook for pipelines: bakes as jobs, ambient occlusion of poses, probes and materials, with numpy arrays.

    import nook
    character = nook.Character("hero.glb")
    with nook.bake_character(character, preset="draft") as job:
        for progress in job:
            print(progress.stage, progress.done, progress.total)
        data = job.wait()                                   # the bytes of hero.nook
    model = nook.CharacterModel(data)
    ao = nook.evaluate_pose(model, character.sample_clip(0, 0.5))   # one value for each vertex of the file

The module calls the C interface of the shared libraries libnook and libnook_bake. A failed call raises NookError with the library's
message. Arrays of a wrong shape and numbers out of range raise ValueError before the call.
"""
from ._layouts import NOOK_VERSION_MAJOR, NOOK_VERSION_MINOR, NOOK_VERSION_PATCH, NOOK_VERSION_SUFFIX
from ._library import Cancelled, MissingLibrary, NookError
from .characters import Character
from .jobs import Job, Progress, bake_character, bake_key, bake_material, bake_transfer
from .materials import Material, MaterialValues
from .probes import Probe, ProbeFit
from .scenes import NO_VERTEX, CharacterModel, Context, Instance, Scene, Skin, VertexMatch, evaluate_pose, evaluate_poses
from .traces import ModelError, model_error, trace_ao

__version__ = f"{NOOK_VERSION_MAJOR}.{NOOK_VERSION_MINOR}.{NOOK_VERSION_PATCH}{NOOK_VERSION_SUFFIX.replace('-', '')}"
__all__ = [
    "Cancelled", "Character", "CharacterModel", "Context", "Instance", "Job", "Material", "MaterialValues", "MissingLibrary", "ModelError",
    "NO_VERTEX", "NookError", "Probe", "ProbeFit", "Progress", "Scene", "Skin", "VertexMatch", "bake_character", "bake_key",
    "bake_material", "bake_transfer", "evaluate_pose", "evaluate_poses", "model_error", "trace_ao",
]
