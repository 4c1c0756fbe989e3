"""Rendered animations show the ambient occlusion of each frame, in every way to render them.

  blender -b ... --python render_test.py -- make TOOL LIBRARY FOLDER      a baked scene, its stills, and an animation by a script
  blender SCENE --python render_test.py -- window FOLDER LOCK             an animation from the window; LOCK: 0 or 1
  blender -b ... --python render_test.py -- compare FOLDER KIND...        animations against stills
"""
import os
import pathlib
import sys
import traceback

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import limb  # noqa: E402
import watch  # noqa: E402
from checks import check  # noqa: E402

FRAMES = range(1, 6)
# The same model at the same pose; what differs is rounding.
ALLOWED = 1e-3


def show_colours_alone():
    for material in bpy.data.materials:
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        attribute, emission, output = (tree.nodes.new(f"ShaderNode{name}") for name in ("Attribute", "Emission", "OutputMaterial"))
        attribute.attribute_name = "Nook AO"
        tree.links.new(attribute.outputs["Color"], emission.inputs["Color"])
        tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])


def set_render(scene):
    render = scene.render
    render.engine, scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.pixel_filter_type = "CYCLES", 1, False, "BOX"
    render.resolution_x = render.resolution_y = 64
    render.resolution_percentage = 100
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera, camera.location, camera.rotation_euler = camera, (0.9, -4, 1.2), (1.57, 0, 0)


def make(tool, library, folder):
    limb.SIDES, limb.RINGS, limb.LAST_FRAME = 12, 20, FRAMES[-1]
    bpy.ops.preferences.addon_enable(module="nook_ao")
    limb.make()
    preferences = bpy.context.preferences.addons["nook_ao"].preferences
    preferences.tool, preferences.library = tool, library
    scene = bpy.context.scene
    scene.nook.folder = os.path.join(folder, "bake")
    bpy.ops.nook.bake()
    show_colours_alone()
    set_render(scene)
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scene.blend"))
    for frame in FRAMES:
        scene.frame_set(frame)
        scene.render.filepath = os.path.join(folder, f"still_{frame:04}")
        bpy.ops.render.render(write_still=True)
    scene.frame_set(FRAMES[-1])
    scene.render.filepath = os.path.join(folder, "script_")
    bpy.ops.render.render(animation=True)
    bpy.ops.wm.save_userpref()


def render_in_window(folder, lock):
    scene = bpy.context.scene
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.context.view_layer.objects.active = bpy.data.objects["Rig"]
        bpy.ops.nook.confirm(folder=os.path.join(folder, "bake"))
        bpy.ops.nook.show()
        scene.render.use_lock_interface = lock == "1"
        scene.render.filepath = os.path.join(folder, f"window{lock}_")
        bpy.context.preferences.view.render_display_type = "NONE"
        bpy.ops.render.render("INVOKE_DEFAULT", animation=True)


def check_is_rendered(folder, lock):
    lacks = [frame for frame in FRAMES if not os.path.isfile(os.path.join(folder, f"window{lock}_{frame:04}.exr"))]
    check(not lacks, f"the window renders an animation, Lock Interface {lock}" if not lacks else f"the animation has ended without the frames {lacks}")


def in_window(folder, lock):
    watch.begin()
    bpy.app.handlers.render_write.append(lambda scene, *_: watch.say(f"frame {scene.frame_current} is written"))
    started = [False]

    def step():
        try:
            if not started[0]:
                watch.say("the window is open")
                started[0] = True
                render_in_window(folder, lock)
            elif not bpy.app.is_job_running("RENDER"):
                check_is_rendered(folder, lock)
                os._exit(0)
        except BaseException:  # a timer that fails would leave the window open
            traceback.print_exc()
            sys.stderr.flush()
            os._exit(1)
        return 0.2

    bpy.app.timers.register(step, first_interval=1)


def pixels(path):
    return np.array(bpy.data.images.load(path).pixels[:]).reshape(-1, 4)


def compare(folder, *kinds):
    stills = [pixels(os.path.join(folder, f"still_{frame:04}.exr")) for frame in FRAMES]
    moves = min(np.abs(a - b).max() for a, b in zip(stills, stills[1:]))
    check(moves > 0.1, f"each still differs from the one before by {moves:.2f} and more")
    for kind in kinds:
        worst = max(np.abs(still - pixels(os.path.join(folder, f"{kind}_{frame:04}.exr"))).max() for frame, still in zip(FRAMES, stills))
        check(worst < ALLOWED, f"animation {kind}: its frames are the stills within {worst:.1e}")


command, *rest = sys.argv[sys.argv.index("--") + 1:]
{"make": make, "window": in_window, "compare": compare}[command](*rest)
