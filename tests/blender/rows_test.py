"""The add-on where artists do something of their own: hidden, linked, shared, held in a hand, switched off, twice.

  blender -b --factory-startup --python-exit-code 1 --python rows_test.py -- TOOL LIBRARY FOLDER

The add-on is installed and switched on. TOOL bakes with few steps: what is tested is whether the colours belong to the vertices.
"""
import json
import os
import pathlib
import struct
import sys
import time

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import limb  # noqa: E402
limb.SIDES, limb.RINGS = 12, 20  # small, so that bakes are quick
from checks import check, colours, error_to_truth, fails_with  # noqa: E402

TOOL, LIBRARY, FOLDER = sys.argv[sys.argv.index("--") + 1:]
FOLDER = pathlib.Path(FOLDER)
# The colours may be wrong by this much more than the model, which has few steps here. Colours of other vertices or poses are wrong by 0.1
# and more beyond the model's error.
ALLOWED = 0.01


def fresh(name):
    """A new scene with a limb whose bakes go to a folder of its own."""
    armature, body, cuff = limb.make()
    enable()
    bpy.context.scene.nook.folder = str(FOLDER / name)
    return armature, body, cuff


def enable():
    preferences = bpy.context.preferences.addons["nook_ao"].preferences
    preferences.tool, preferences.library = TOOL, LIBRARY


def document(path):
    data = path.read_bytes()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


def select(item):
    bpy.ops.object.select_all(action="DESELECT")
    item.select_set(True)
    bpy.context.view_layer.objects.active = item


def own_error(rays=256):
    """The error of the shown model in the current pose, on the mesh that Nook skins."""
    from nook_ao import shown
    entry = list(shown._shown.values())[-1]
    pose = entry.pose()
    traced, modelled = (entry.to_vertices(values) for values in (entry.trace(pose, rays), entry.evaluate(pose, False)))
    seen = traced >= 0.01
    return float(np.sqrt(((traced - modelled)[seen] ** 2).mean()))


def check_colours(items, text, frames=(1, limb.LAST_FRAME), allowed=ALLOWED):
    from nook_ao import nook
    errors, own = [], []
    for frame in frames:
        bpy.context.scene.frame_set(frame)
        errors.append(error_to_truth(items, nook))
        own.append(own_error())
    check(all(e < o + allowed for e, o in zip(errors, own)),
          f"{text}: within {max(errors):.3f} of ray tracing of what Blender shows, the model's own {max(own):.3f}")


def says(armature):
    from nook_ao import records
    return records.find(armature).says


def test_hidden():
    armature, body, cuff = fresh("hidden")
    select(body)
    armature.hide_set(True)
    body.hide_select = cuff.hide_select = True
    bpy.ops.nook.bake()
    check_colours([body, cuff], "a hidden rig, a body that cannot be selected")
    check(armature.hide_get() and body.hide_select, "hidden and not selectable as before")
    cuff.hide_set(True)
    bpy.ops.nook.bake()
    check("Cuff is hidden in the view, but visible in renders" in says(armature), "a hidden mesh that is rendered is part of the character, which is said")


def test_linked():
    limb.make()
    library = str(FOLDER / "library.blend")
    whole = bpy.data.collections.new("Whole")
    for item in list(bpy.context.scene.objects):
        whole.objects.link(item)
        bpy.context.scene.collection.objects.unlink(item)
    bpy.context.scene.collection.children.link(whole)
    bpy.ops.wm.save_as_mainfile(filepath=library)
    bpy.ops.wm.read_homefile(use_empty=True)
    enable()
    bpy.context.scene.nook.folder = str(FOLDER / "linked")
    with bpy.data.libraries.load(library, link=True) as (_, into):
        into.collections = ["Whole"]
    instance = bpy.data.objects.new("Instance", None)
    instance.instance_type, instance.instance_collection = "COLLECTION", bpy.data.collections["Whole"]
    bpy.context.scene.collection.objects.link(instance)
    select(instance)
    fails_with(bpy.ops.nook.bake, ["instance of a collection", "Library Override"])
    bpy.data.objects.remove(instance)
    linked = bpy.data.collections["Whole"]
    bpy.context.scene.collection.children.link(linked)
    bpy.context.view_layer.objects.active = linked.objects["Rig"]
    fails_with(bpy.ops.nook.bake, ["is linked from", "Library Override"])
    bpy.context.scene.collection.children.unlink(linked)
    override = linked.override_hierarchy_create(bpy.context.scene, bpy.context.view_layer)
    armature = next(o for o in override.all_objects if o.type == "ARMATURE")
    select(armature)
    bpy.context.scene.frame_set(1)
    bpy.ops.nook.bake()
    check_colours([o for o in override.all_objects if o.type == "MESH"], "an override of a linked character")


def test_shared():
    armature, body, _ = fresh("shared")
    other = body.copy()
    bpy.context.scene.collection.objects.link(other)
    fails_with(bpy.ops.nook.bake, ["Limb", "Limb.001", "share the mesh", "Make Single User"])
    other.data = body.data.copy()
    bpy.data.objects.remove(other)
    check(not (FOLDER / "shared").exists(), "nothing was written")


def add_box(name, size, place):
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([[size * c + p for c, p in zip(corner, place)] for corner in corners], [], faces)
    box = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(box)
    return box


def test_held():
    armature, body, cuff = fresh("held")
    helmet = limb.tube("Helmet", 1.3 * limb.RADIUS_M, -0.2, 0.2, 6)
    bpy.context.scene.collection.objects.link(helmet)
    helmet.parent, helmet.parent_type, helmet.parent_bone = armature, "BONE", "lower"
    helmet.rotation_euler = (0, 0, 1.5708)
    eye = add_box("Sword", 0.1, (0.9 * limb.LENGTH_M, 0, 0.6))
    hand = bpy.data.objects.new("Hand", None)
    bpy.context.scene.collection.objects.link(hand)
    hand.parent, hand.parent_type, hand.parent_bone = armature, "BONE", "lower"
    hand.matrix_parent_inverse.identity()
    eye.parent = hand
    shield = add_box("Shield", 0.15, (0, 0, 0))
    holder = shield.constraints.new("CHILD_OF")
    holder.target, holder.subtarget = armature, "upper"
    holder.inverse_matrix.identity()
    shield.location = (0, 0.5, 0.6)
    bpy.context.view_layer.update()
    bpy.ops.nook.bake()
    parts = [body, cuff, helmet, eye, shield]
    check("differently from the bake" not in says(armature), "what hangs on bones is measured as right")
    check({n["name"] for n in document(FOLDER / "held/Rig.glb")["nodes"] if "mesh" in n} == {o.name for o in parts},
          "helmet, sword and shield on bones are in the file")
    check_colours(parts, "with a helmet, a sword and a shield on bones")


def test_left_out():
    armature, body, cuff = fresh("left out")
    boxes = [add_box(name, 0.6, (1, 0, 0)) for name in ("Wire", "Off", "Loose")]
    for box in boxes:
        box.parent = armature
    for box in boxes[:2]:
        box.modifiers.new("Armature", "ARMATURE").object = armature
    boxes[0].display_type, boxes[1].hide_render = "WIRE", True
    bpy.ops.nook.bake()
    check({n["name"] for n in document(FOLDER / "left out/Rig.glb")["nodes"] if "mesh" in n} == {"Limb", "Cuff"}, "collision boxes are not in the file")
    check(all(words in says(armature) for words in ("Wire is drawn as a wireframe", "Off is disabled for renders", "Loose is not attached to a bone")),
          "the panel says what is left out and why")
    check_colours([body, cuff], "beside a collision box")


def test_switched_off():
    armature, body, cuff = fresh("off")
    body.modifiers[0].show_viewport = body.modifiers[0].show_render = False
    bpy.context.scene.frame_set(1)
    bpy.ops.nook.bake()
    check("differently from the bake" in says(armature) and "Armature of Limb is off in views" in says(armature),
          "an armature modifier that is off is said, though the current pose is the rest pose")
    armature, body, cuff = fresh("masked")
    group = body.vertex_groups.new(name="half")
    for vertex in body.data.vertices:
        group.add([vertex.index], 0.5 if vertex.co.x > 1.5 else 1.0, "REPLACE")
    body.modifiers[0].vertex_group = "half"
    bpy.ops.nook.bake()
    check("differently from the bake" not in says(armature), "a masked armature modifier is part of the bake")
    # Half a bend squashes the end: skinned normals differ there from the normals of the squashed faces, with which the test traces.
    check_colours([body, cuff], "with a masked armature modifier", allowed=0.05)


def test_other_modifiers():
    armature, body, _ = fresh("modifiers")
    smooth = body.modifiers.new("Shrink", "SMOOTH")
    smooth.factor, smooth.iterations = 1.0, 60
    armature.scale = (0.5, 0.5, 0.9)
    bpy.ops.nook.bake()
    check("differently from the bake" in says(armature) and "Limb has other modifiers (Shrink)" in says(armature) and "m apart" in says(armature),
          "a modifier that moves vertices is said: " + says(armature).replace("\n", " "))
    body.modifiers.remove(smooth)
    body.modifiers.new("Finer", "SUBSURF").levels = 1
    bpy.ops.nook.bake()
    check("shears or stretches" in says(armature) and "Finer" not in says(armature), "a subdivided body in an unevenly scaled rig is measured: " + says(armature).replace("\n", " "))


def test_second_character():
    armature, body, cuff = fresh("two")
    bpy.ops.nook.bake()
    select(armature)
    for item in (body, cuff):
        item.select_set(True)
    bpy.ops.object.duplicate()
    other = next(o for o in bpy.context.selected_objects if o.type == "ARMATURE")
    bpy.context.view_layer.objects.active = other
    other.location.y += 3
    bpy.ops.nook.bake()
    names = sorted(p.name for p in (FOLDER / "two").iterdir())
    check(names == ["Rig.001.glb", "Rig.001.nook", "Rig.glb", "Rig.nook"], f"two characters have files of their own ({', '.join(names)})")
    (FOLDER / "two" / "Other.glb").write_bytes(b"an artist's own export")
    select(other)
    other.name = "Other"
    bpy.ops.nook.bake()
    check((FOLDER / "two" / "Other.glb").read_bytes() == b"an artist's own export" and (FOLDER / "two" / "Other-2.nook").is_file(),
          "a file of somebody else is not overwritten")
    check_colours([body, cuff], "the first of two characters")
    armature.nook.preset = "standard"
    from nook_ao import records
    check(records.setting(armature, bpy.context.scene, "preset") == "standard" and
          records.setting(other, bpy.context.scene, "preset") == "draft", "settings stay with the rig")


def test_renamed():
    armature, body, cuff = fresh("renamed")
    bpy.ops.nook.bake()
    armature.name, body.name = "Hero", "Skin"
    check_colours([body, cuff], "after rig and body got other names")


def test_unsaved():
    fresh("unsaved")
    for folder in ("//bake", "bake"):
        bpy.context.scene.nook.folder = folder
        fails_with(bpy.ops.nook.bake, [f"folder {folder} is relative", "save the file first"])
    check(not os.path.exists("bake"), "nothing was written into the working folder")


def test_actions():
    armature, body, cuff = fresh("actions")
    own = armature.animation_data.action
    for number in range(75):
        action = own.copy()
        action.name = f"Walk {number}"
        action.use_fake_user = True
    muted, played = (armature.animation_data.nla_tracks.new() for _ in range(2))
    muted.strips.new("m", 1, bpy.data.actions["Walk 1"])
    muted.mute = True
    played.strips.new("p", 1, bpy.data.actions["Walk 2"])
    bpy.data.actions["Walk 3"].nook_bake = True
    bpy.ops.nook.bake()
    names = [a["name"] for a in document(FOLDER / "actions/Rig.glb")["animations"]]
    check(names == [own.name, "Walk 2", "Walk 3"], f"of 76 actions the file has the rig's own and what is ticked ({', '.join(names)})")
    for action in bpy.data.actions:
        action.nook_bake = True
    from nook_ao import clips
    begin = slowest = time.monotonic()
    longest = 0.0
    for action in bpy.data.actions:
        for _ in clips.sample(armature, action, 24):
            longest, slowest = max(longest, time.monotonic() - slowest), time.monotonic()
    check(longest < 5, f"76 actions are sampled in {time.monotonic() - begin:.1f} s, the window stands still for at most {longest:.2f} s")


def test_without_animation():
    armature, body, cuff = fresh("still")
    armature.animation_data_clear()
    bpy.context.scene.frame_set(1)
    armature.nook.poses = "clips"
    fails_with(bpy.ops.nook.bake, ["has no action"])
    armature.nook.poses = "all"
    bpy.ops.nook.bake()
    check("Error in 2 poses" in says(armature), "a rig without animation data is baked, and measured in poses that turn its bones")
    armature.pose.bones["lower"].rotation_euler = (1.2, 0, 0)
    bpy.context.view_layer.update()
    check_colours([body, cuff], "a rig without animation data", frames=(1,))


def test_both_errors():
    armature, _, _ = fresh("errors")
    bpy.ops.nook.bake()
    text = says(armature)
    check("with the bake's normals" in text and "with Blender's" in text and "differently from the bake" not in text,
          "the panel has both errors: " + text.replace("\n", " "))


def test_mirrored():
    armature, body, cuff = fresh("mirrored")
    armature.scale.x *= -1
    bpy.context.view_layer.update()
    bpy.ops.nook.bake()
    check_colours([body, cuff], "a mirrored rig")


TESTS = (test_hidden, test_linked, test_shared, test_held, test_left_out, test_switched_off, test_other_modifiers, test_second_character, test_renamed,
         test_unsaved, test_actions, test_without_animation, test_both_errors, test_mirrored)

bpy.ops.preferences.addon_enable(module="nook_ao")
FOLDER.mkdir(parents=True, exist_ok=True)
chosen = os.environ.get("NOOK_ROWS", "")
for test in TESTS:
    if not chosen or test.__name__ in chosen.split():
        test()
print("the rows pass", flush=True)
