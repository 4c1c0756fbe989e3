"""The add-on inside of Blender: bakes a limb, and compares its colours with the C interface's AO of the same pose.

  blender -b --factory-startup --python-exit-code 1 --python blender_test.py -- ADDON.zip TOOL LIBRARY FOLDER [PICTURES]

The truth takes another way than the add-on: poses are sampled from the clip that the exporter wrote, and vertices are matched by their
rest positions, which are all apart in this character.
"""
import os
import pathlib
import sys
import tempfile

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import limb as character  # noqa: E402
from checks import check, colours, fails_with  # noqa: E402

ADDON, TOOL, LIBRARY, FOLDER, *PICTURES = sys.argv[sys.argv.index("--") + 1:]
FOLDER = pathlib.Path(FOLDER)


def rest_points(mesh):
    points = np.empty(3 * len(mesh.data.vertices), dtype=np.float32)
    mesh.data.vertices.foreach_get("co", points)
    placed = np.array(mesh.matrix_world) @ np.column_stack([points.reshape(-1, 3), np.ones(len(points) // 3)]).T
    x, y, z, _ = placed
    return np.column_stack([x, z, -y])  # y up, as in the file


def nearest(points, places):
    """For each point the nearest of the places, and its distance."""
    distance = np.linalg.norm(points[:, None, :] - places[None, :, :], axis=2)
    return distance.argmin(axis=1), distance.min(axis=1)


def install():
    bpy.ops.preferences.addon_install(filepath=ADDON, overwrite=True)
    bpy.ops.preferences.addon_enable(module="nook_ao")
    return bpy.context.preferences.addons["nook_ao"].preferences


def test_errors(preferences):
    bpy.ops.wm.read_homefile(use_empty=True)
    preferences.tool, preferences.library = TOOL, LIBRARY
    fails_with(bpy.ops.nook.bake, ["No rigged character is selected"])
    armature, body, _ = character.make()
    fails_with(bpy.ops.nook.show, ["has no bake"])
    fails_with(bpy.ops.nook.report, ["has no bake"])
    fails_with(bpy.ops.nook.trace, ["is not shown"])
    preferences.tool = "/nowhere/nook"
    fails_with(bpy.ops.nook.bake, ["/nowhere/nook was not found", "preferences"])
    preferences.tool, preferences.library = TOOL, "/nowhere/libnook.so"
    fails_with(bpy.ops.nook.bake, ["/nowhere/libnook.so does not exist", "preferences"])
    preferences.library = LIBRARY
    for part in (body, bpy.data.objects["Cuff"]):
        part.hide_render = True
    fails_with(bpy.ops.nook.bake, ["deforms no mesh that is rendered", "Limb is disabled for renders"])
    check("NOOK_VERTEX" not in body.data.attributes and armature.name in bpy.data.objects, "the scene is as it was")


def test_bake(preferences):
    preferences.tool, preferences.library = TOOL, LIBRARY
    armature, body, cuff = character.make()
    names = [o.data.name for o in (body, cuff)]
    bpy.context.scene.nook.folder = str(FOLDER)
    bpy.ops.object.mode_set(mode="POSE")
    check(bpy.ops.nook.bake() == {"FINISHED"}, "the limb was baked with the draft preset")
    check([o.data.name for o in (body, cuff)] == names and len(bpy.data.meshes) == 2 and "NOOK_VERTEX" not in body.data.attributes,
          "the artist's meshes are untouched but for the colours")
    check(bpy.context.selected_objects == [armature] and armature.mode == "POSE", "selection and mode are as they were")
    bpy.ops.object.mode_set(mode="OBJECT")

    from nook_ao import measure, nook, shown
    entry = shown.get(armature)
    file = nook.Character(FOLDER / "Rig.glb")
    model = nook.CharacterModel((FOLDER / "Rig.nook").read_bytes())
    vertices = sum(len(o.data.vertices) for o in (body, cuff))
    check(file.vertex_count > vertices, f"the file splits {vertices} vertices into {file.vertex_count}")
    rest, _ = file.vertices()
    places = np.concatenate([rest_points(o) for o in (body, cuff)])
    at, distance = nearest(places, rest)
    # Positions of the file are floats of about 1 m, after a chain of matrices.
    check(distance.max() < 1e-5, f"every vertex is in the file, within {distance.max():.1e} m")

    scene = bpy.context.scene
    seconds = file.clip_duration(0)
    worst = worst_place = 0.0
    for frame in (1, 8, 15, character.LAST_FRAME):
        scene.frame_set(frame)
        painted = np.concatenate([colours(o)[:, 0] for o in (body, cuff)])
        pose = file.sample_clip(0, seconds * (frame - 1) / (character.LAST_FRAME - 1))
        truth = nook.evaluate_pose(model, pose)[at]
        worst = max(worst, float(np.abs(painted - truth).max()))
        depsgraph = bpy.context.evaluated_depsgraph_get()
        still = measure.Still(entry, entry.pose(depsgraph), [o.evaluated_get(depsgraph) for o in (cuff, body)])
        worst_place = max(worst_place, still.distance)
    check(0.5 < painted.mean() < 1, f"the colours are neither black nor white (mean {painted.mean():.2f})")
    # The exporter writes rotations as quaternions of floats, 1e-6 of a radian; AO changes by less than 1 in 0.01 radians, so that
    # ten times 1e-4 bounds it with room for the mean over copies.
    check(worst < 1e-3, f"colours over the timeline are those of the C interface at the same pose, within {worst:.1e}")
    check(worst_place < 1e-5, f"Blender's vertices and Nook's are at the same places, within {worst_place:.1e} m")

    test_crease(scene, body)
    test_trace(body)
    test_switch(scene, body)
    return armature, body, cuff


def elbow(body):
    """Vertices at the inner and at the outer side of the elbow, and those at the end far from it."""
    x = np.array([v.co.x for v in body.data.vertices]) / character.LENGTH_M
    world = np.array([body.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices[i].co[:] for i in range(len(x))])
    hand = world[x > 0.99].mean(axis=0)
    near = np.abs(x - 0.5) < 0.06
    distance = np.linalg.norm(world - hand, axis=1)
    inner = near & (distance < np.quantile(distance[near], 0.25))
    outer = near & (distance > np.quantile(distance[near], 0.75))
    return inner, outer


def test_crease(scene, body):
    scene.frame_set(character.LAST_FRAME)
    inner, outer = elbow(body)
    bent = colours(body)[:, 0]
    scene.frame_set(1)
    straight = colours(body)[:, 0]
    # A draft is wrong by less than 0.1 on the mean of a region; a fold of 135 degrees hides more than half of what the inner side sees.
    check(bent[inner].mean() < 0.6 < 0.85 < bent[outer].mean(), f"bent, the crease is dark ({bent[inner].mean():.2f}) and the elbow open ({bent[outer].mean():.2f})")
    check(straight[inner].mean() > 0.85, f"straight, the same place is open ({straight[inner].mean():.2f})")


def test_trace(body):
    scene = bpy.context.scene
    scene.frame_set(character.LAST_FRAME)
    check(bpy.ops.nook.trace() == {"FINISHED"}, "the frame was ray traced")
    traced, modelled = colours(body, "Nook traced")[:, 0], colours(body)[:, 0]
    rms = float(np.sqrt(((traced - modelled) ** 2).mean()))
    # A draft bake of a limb; other vertex orders or poses give 0.3 and more.
    check(rms < 0.12, f"the model is near ray tracing (rms {rms:.3f})")


def test_switch(scene, body):
    scene.frame_set(1)
    before = colours(body)
    bpy.ops.nook.show()
    scene.frame_set(character.LAST_FRAME)
    check((colours(body) == before).all(), "switched off, colours stay")
    bpy.ops.nook.show()
    check((colours(body) != before).any(), "switched on, they follow")
    scene.nook.ground = True
    scene.frame_set(1)
    check((colours(body) <= before + 1e-6).all(), "a floor makes nothing lighter")
    scene.nook.ground = False
    scene.frame_set(1)
    test_posing(body)


def test_posing(body):
    """A pose that no key has, in pose mode, as an artist makes it."""
    straight = colours(body)
    bpy.ops.object.mode_set(mode="POSE")
    bpy.data.objects["Rig"].pose.bones["lower"].rotation_euler = (character.BEND_RADIANS, 0, 0)
    bpy.context.view_layer.update()
    inner, _ = elbow(body)
    check(colours(body)[inner, 0].mean() < straight[inner, 0].mean() - 0.3, "colours follow while a bone is turned")
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.scene.frame_set(1)


def test_saved_scene(folder):
    path = str(folder / "limb.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    armature = bpy.data.objects["Rig"]
    bpy.context.view_layer.objects.active = armature
    bpy.ops.nook.confirm(folder=str(folder))
    check(bpy.ops.nook.show() == {"FINISHED"}, "a scene that was saved shows its bake again")
    body = bpy.data.objects["Limb"]
    bpy.ops.nook.show()
    extra = body.data.vertices
    extra.add(1)
    fails_with(bpy.ops.nook.show, ["bake again"])
    open_again(path)
    return path


def open_again(path):
    bpy.ops.wm.open_mainfile(filepath=path)
    armature = bpy.data.objects["Rig"]
    bpy.context.view_layer.objects.active = armature
    return armature


def test_trust(path, folder, preferences):
    """A .blend file from somebody else chooses neither what is loaded nor where is written."""
    page = folder / "Rig.html"
    before = sorted(folder.iterdir())
    armature = open_again(path)
    unconfirmed = [str(folder), "not confirmed"]
    fails_with(bpy.ops.nook.show, unconfirmed)
    fails_with(bpy.ops.nook.report, unconfirmed)
    fails_with(bpy.ops.nook.bake, unconfirmed)  # the folder of the scene is the file's as well
    check(sorted(folder.iterdir()) == before and not page.exists(), "nothing was written before the folder was confirmed")
    elsewhere = folder.parent / "chosen by the file"
    bpy.ops.nook.confirm(folder=str(folder))
    armature["nook_folder"] = str(elsewhere)
    fails_with(bpy.ops.nook.show, [str(elsewhere), "not confirmed"])
    fails_with(bpy.ops.nook.report, [str(elsewhere), "not confirmed"])
    check(not elsewhere.exists(), "a folder that was not confirmed is not made")
    hidden = str(folder) + "\u202e\n\x1b"
    armature["nook_folder"] = hidden
    fails_with(bpy.ops.nook.show, ["\\u202e\\u000a\\u001b"])
    for value in (7, [1.0, 2.0], ""):
        armature["nook_folder"] = value
        fails_with(bpy.ops.nook.show, ["does not name a folder"])
    armature["nook_folder"] = str(folder)
    part = bpy.context.scene.nook_characters[0].parts[0]
    part.vertices += 1
    fails_with(bpy.ops.nook.show, ["bake again"])
    part.vertices -= 1
    check(bpy.ops.nook.show() == {"FINISHED"}, "a confirmed folder is used")
    bpy.ops.nook.show()
    target = folder.parent / "victim"
    target.write_text("kept")
    page.symlink_to(target)
    fails_with(bpy.ops.nook.report, ["symbolic link"])
    check(target.read_text() == "kept", "a link in the folder is not followed")
    page.unlink()
    open_again(path)
    fails_with(bpy.ops.nook.show, unconfirmed)
    # Whoever types a folder has chosen it; setting the same one again counts.
    bpy.context.scene.nook.folder = str(folder)
    check(bpy.ops.nook.show() == {"FINISHED"}, "a folder that was chosen since needs no question")
    bpy.ops.nook.show()


def test_temporary(path, folder, preferences):
    """Temporary folders go when a bake fails, when the next one replaces it, and with the add-on."""
    temporary = folder.parent / "temporary"
    temporary.mkdir()
    tempfile.tempdir = str(temporary)
    own = lambda: [p for p in temporary.iterdir() if p.name.startswith("nook-")]  # noqa: E731
    armature = open_again(path)
    bpy.context.scene.nook.folder = ""
    failing = folder.parent / "failing"
    failing.write_text("#!/bin/sh\necho 'nook: no luck' >&2\nexit 3\n")
    failing.chmod(0o755)
    preferences.tool = str(failing)
    fails_with(bpy.ops.nook.bake, ["no luck"])
    check(own() == [], "a bake that fails leaves no temporary folder")
    preferences.tool = TOOL
    check(bpy.ops.nook.bake() == {"FINISHED"}, "the limb was baked into a temporary folder")
    first = own()
    check(len(first) == 1 and armature["nook_folder"] == str(first[0]), "there is one temporary folder")
    bpy.ops.nook.show()
    check(bpy.ops.nook.show() == {"FINISHED"}, "what was baked now needs no question")
    check(bpy.ops.nook.bake() == {"FINISHED"} and len(own()) == 1 and own() != first, "the next bake replaces it")
    bpy.ops.preferences.addon_disable(module="nook_ao")
    check(own() == [], "nothing is left without the add-on")
    bpy.ops.preferences.addon_enable(module="nook_ao")
    again = bpy.context.preferences.addons["nook_ao"].preferences
    again.tool, again.library = TOOL, LIBRARY
    check(bpy.ops.nook.bake() == {"FINISHED"} and len(own()) == 1, "a folder is left for Blender's end, which the script looks at")


def test_report(folder):
    bpy.ops.nook.confirm(folder=str(folder))
    check(bpy.ops.nook.report() == {"FINISHED"}, "the report was written")
    page = (folder / "Rig.html").read_text(encoding="utf-8")
    check(page.startswith("<!DOCTYPE html>") or page.startswith("<!doctype html>"), "it is a page")


def draw_pictures(folder):
    """The limb straight and bent, the colours alone."""
    from mathutils import Vector
    scene = bpy.context.scene
    bpy.ops.nook.show()
    for material in bpy.data.materials:
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        attribute = tree.nodes.new("ShaderNodeAttribute")
        attribute.attribute_name = "Nook AO"
        emission = tree.nodes.new("ShaderNodeEmission")
        output = tree.nodes.new("ShaderNodeOutputMaterial")
        tree.links.new(attribute.outputs["Color"], emission.inputs["Color"])
        tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 8, False
    scene.render.resolution_x, scene.render.resolution_y = 480, 360
    scene.view_settings.view_transform = "Standard"
    scene.world = bpy.data.worlds.new("grey")
    scene.world.color = (0.2, 0.3, 0.4)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    rig = bpy.data.objects["Rig"]
    target = rig.matrix_world @ Vector((0.5 * character.LENGTH_M, 0, 0.1 * character.LENGTH_M))
    camera.location = target + Vector((0.6, -1.9, 0.9))
    camera.rotation_euler = (target - camera.location).to_track_quat("-Z", "Y").to_euler()
    for frame in (1, character.LAST_FRAME):
        scene.frame_set(frame)
        scene.render.filepath = os.path.join(folder, f"limb_{frame:02}.png")
        bpy.ops.render.render(write_still=True)


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    preferences = install()
    test_errors(preferences)
    test_bake(preferences)
    path = test_saved_scene(FOLDER)
    test_trust(path, FOLDER, preferences)
    test_report(FOLDER)
    if PICTURES:
        draw_pictures(PICTURES[0])
    test_temporary(path, FOLDER, preferences)
    print("the add-on passes", flush=True)


main()
