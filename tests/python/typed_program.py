"""A program that uses the module, for mypy --strict: right uses are accepted, and wrong ones are refused.

mypy complains about a "type: ignore" whose line has no error, so that each of them is a check.
"""
from typing import List, Tuple

import numpy as np
import numpy.typing as npt

import nook

Floats = npt.NDArray[np.float32]


def bake(path: str) -> Tuple[nook.Character, bytes]:
    character = nook.Character(path, without="Cape*")
    with nook.bake_character(character, preset="draft", clips=["Walk"], rays=64) as job:
        for progress in job:
            stage: str = progress.stage
            print(stage.upper(), progress.done + 1, progress.is_done)
        data: bytes = job.wait()
        print(job.report()["iterations"])
    return character, data


def evaluate(character: nook.Character, data: bytes) -> Floats:
    model = nook.CharacterModel(data)
    match: nook.VertexMatch = model.match_vertices(*character.vertices())
    mine: nook.CharacterModel = model.remap(match)
    poses: Floats = character.auto_poses(10, seed=2)
    with nook.Scene(cutoff_error=0.0) as scene:
        hero: nook.Instance = scene.add_instance(mine)
        hero.set_pose(poses[0], place=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]])
        scene.update()
        one: Floats = hero.read_ao()
    many: Floats = nook.evaluate_poses(mine, poses, ground=(0, 1, 0, 0), threads=2)
    truth: Floats = nook.trace_ao([character.skin(poses[0])], [[0, 1, 0]], [[0, 1, 0]])
    error: float = nook.model_error(character, model, poses).mse_visible
    print(one.mean(), truth.mean(), error)
    return many


def light(directions: Floats, radiance: Floats) -> List[str]:
    with nook.ProbeFit(lobes=8) as fit:
        fit.add_samples(directions, radiance)
        probe: nook.Probe = fit.solve()
    try:
        nook.Material(probe.save()).evaluate([[0, 0]], [[0, 0, 1]], [[0, 0, 1]])
    except nook.NookError as error:
        return [error.code, str(error)]
    return []


def wrong(model: nook.CharacterModel, scene: nook.Scene) -> None:
    nook.evaluate_pose("hero.nook", [])  # type: ignore[arg-type]
    nook.evaluate_poses(model, [], threads="all")  # type: ignore[arg-type]
    nook.bake_character(model)  # type: ignore[arg-type]
    scene.add_instance(b"hero")  # type: ignore[arg-type]
    model.bones  # type: ignore[attr-defined]
    text: str = nook.evaluate_pose(model, [])  # type: ignore[assignment]
    print(text)
