"""The colours that the add-on shows on shared characters, against ray tracing of the meshes that Blender evaluates.

  blender -b --factory-startup --python-exit-code 1 --python shared_test.py -- TOOL LIBRARY FOLDER CHARACTER.glb...

The add-on is installed. Each character is imported, baked with the draft preset, and measured in the two poses of its
actions that differ most from the rest pose and from each other. Prints one row for each pose, and fails where the colours are wrong by
more than the model's own error and 0.01: then they belong to other vertices or to another pose.
"""
import pathlib
import sys

import bpy
import numpy as np

if not hasattr(np, "bool"):
    np.bool = bool  # the glTF importer of Debian's Blender 3.4 uses it, and Debian's numpy has it no more

TOOL, LIBRARY, FOLDER, *CHARACTERS = sys.argv[sys.argv.index("--") + 1:]
# With 512 rays, the noise of both errors is below 0.02 rms of each vertex, and their difference over thousands of vertices below 1e-3.
RAYS, POINTS, POSES = 512, 4000, 2
ALLOWED = 0.01


def bake(path):
    """Imports a character into an empty scene and bakes it; returns what the add-on shows."""
    from nook_ao import shown
    bpy.ops.wm.read_homefile(use_empty=True)
    preferences = bpy.context.preferences.addons["nook_ao"].preferences
    preferences.tool, preferences.library = TOOL, LIBRARY
    bpy.ops.import_scene.gltf(filepath=path)
    rig = next(o for o in bpy.data.objects if o.type == "ARMATURE")
    for item in bpy.context.selected_objects:
        item.select_set(False)
    rig.select_set(True)
    bpy.context.view_layer.objects.active = rig
    settings = bpy.context.scene.nook
    settings.folder, settings.preset = str(pathlib.Path(FOLDER) / pathlib.Path(path).stem), "draft"
    if bpy.ops.nook.bake() != {"FINISHED"}:
        raise SystemExit(f"{path} was not baked")
    return rig, shown.get(rig)


def errors_of(entry, rig):
    """The pose and its errors, for each pose."""
    from nook_ao import clips, measure
    actions = clips.chosen_actions(rig, bpy.data.actions)
    ways = measure.farthest(entry, measure.candidates(entry, bpy.context.scene, actions))[:POSES]
    for way in ways:
        still = measure.take_pose(entry, way, actions)
        entry.painted = None
        errors = measure.Errors()
        for _ in measure.add_errors(errors, entry, still, POINTS, RAYS):
            pass
        yield way, errors


def main():
    bpy.ops.preferences.addon_enable(module="nook_ao")
    wrong = 0
    print(f"{'character':<34} {'pose':<36} {'colours':>8} {'model':>8} {'more':>8}", flush=True)
    for path in CHARACTERS:
        rig, entry = bake(path)
        for (kind, name, frame), errors in errors_of(entry, rig):
            more = errors["bake"] - errors["model"]
            wrong += more > ALLOWED
            pose = f"{name or kind}, {frame:.0f}"
            print(f"{pathlib.Path(path).name:<34} {pose:<36.36} {errors['bake']:8.4f} {errors['model']:8.4f} {more:8.4f}", flush=True)
    print(f"{'FAILS' if wrong else 'ok   '} {wrong} poses are wrong by more than the model's own error and {ALLOWED}", flush=True)
    raise SystemExit(1 if wrong else 0)


main()
