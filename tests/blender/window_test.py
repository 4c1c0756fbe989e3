"""The bake in a window: two at once, Escape, undo and redo. Runs on a display without a person.

  blender --enable-event-simulate SCENE --python window_test.py -- FOLDER      SCENE: of render_test.py
"""
import os
import pathlib
import sys
import traceback

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import watch  # noqa: E402
from checks import check, fails_with  # noqa: E402

FOLDER = pathlib.Path(sys.argv[sys.argv.index("--") + 1])


def rig():
    return next(o for o in bpy.data.objects if o.type == "ARMATURE")


def view():
    window = bpy.context.window_manager.windows[0]
    area = next(a for a in window.screen.areas if a.type == "VIEW_3D")
    return bpy.context.temp_override(window=window, area=area, region=next(r for r in area.regions if r.type == "WINDOW"))


def bake():
    with view():
        return bpy.ops.nook.bake("INVOKE_DEFAULT")


def colours():
    mesh = bpy.data.objects["Limb"].data
    return [c.color[0] for c in mesh.attributes["Nook AO"].data]


def script():
    """Each yield gives Blender time for its own work."""
    from nook_ao import operators, records, shown
    bpy.context.view_layer.objects.active = rig()
    for scene in bpy.data.scenes:
        scene.nook_characters.clear()
    bpy.context.scene.nook.folder = str(FOLDER)
    yield
    with view():
        bpy.ops.ed.undo_push(message="start")
    check(bake() == {"RUNNING_MODAL"}, "a bake runs beside the window")
    fails_with(bake, ["Rig is being baked"])
    yield
    check(not list(FOLDER.glob("Rig*")), "while it runs, no file has its final name")
    bpy.context.window_manager.windows[0].event_simulate(type="ESC", value="PRESS", x=100, y=100)
    while operators._baking:
        yield
    check(not FOLDER.exists() and not operators._baking and records.find(rig()) is None, "after Escape nothing is left")
    bake()
    while records.find(rig()) is None or not records.find(rig()).says:
        yield
    yield
    check(sorted(p.name for p in FOLDER.iterdir()) == ["Rig.glb", "Rig.nook"], "the next bake leaves both files")
    with view():
        rig().name = "Hero"
        bpy.ops.ed.undo_push(message="rename")
        for name in ("the renaming", "the bake", "the bake again"):
            bpy.ops.ed.redo() if name == "the bake again" else bpy.ops.ed.undo()
            bpy.context.scene.frame_set(1)
            first = colours()
            bpy.context.scene.frame_set(3)
            check(records.files_of(rig()).model.is_file() and shown.get(rig()) is not None and colours() != first,
                  f"after undo or redo of {name}, the bake is found and its colours follow")
    print("the window passes", flush=True)


work = script()


def step():
    try:
        next(work)
    except StopIteration:
        os._exit(0)
    except BaseException:  # a timer that fails would leave the window open
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(1)
    return 0.3


watch.begin()
bpy.app.timers.register(step, first_interval=1, persistent=True)
