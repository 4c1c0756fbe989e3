"""Draws docs/blender.png. It shows the built-in character in Blender in one frame of each of three clips,
baked and coloured by the add-on.

  blender -b --factory-startup --python-exit-code 1 --python bakers/lab/tables/blender_picture.py -- CHARACTER.glb TOOL LIBRARY PICTURE.png

`samples/run.sh` writes the character. The colours show only the ambient occlusion, without light.
"""
import pathlib
import sys
import tempfile

import bpy
import numpy as np
from mathutils import Vector

ROOT = pathlib.Path(__file__).resolve().parents[3]
# The glTF importer of Blender 3.4 uses the name np.bool, which does not exist in Debian's numpy 1.24.
np.bool = bool
sys.path[:0] = [str(ROOT / "packaging/blender"), str(ROOT / "packaging/python")]
import nook_ao  # noqa: E402
from nook_ao import preferences, shown  # noqa: E402

CHARACTER, TOOL, LIBRARY, PICTURE = sys.argv[sys.argv.index("--") + 1:]
WIDTH_PX, HEIGHT_PX, SAMPLES = 320, 440, 32
# Clips of the built-in character. The second value says where the frame is in the clip, 0 to 1.
FRAMES = (("Sit", 0.5), ("Dance", 0.3), ("Punch", 0.4))


def colour_by_attribute(material, name):
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    attribute, emission, output = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("Attribute", "Emission", "OutputMaterial"))
    attribute.attribute_name = name
    tree.links.new(attribute.outputs["Color"], emission.inputs["Color"])
    tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])


def look_at(camera, target, offset):
    camera.location = target + offset
    camera.rotation_euler = (-offset).to_track_quat("-Z", "Y").to_euler()


def main():
    nook_ao.register()
    preferences.Unregistered.tool, preferences.Unregistered.library = TOOL, LIBRARY
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=CHARACTER)
    scene = bpy.context.scene
    armature = next(o for o in scene.objects if o.type == "ARMATURE")
    bpy.context.view_layer.objects.active = armature
    with tempfile.TemporaryDirectory() as folder:
        scene.nook.folder = folder
        bpy.ops.nook.bake()
        entry = shown.get(armature)
        print("largest distance to Blender's vertices, metres:", entry.deviation(bpy.context.evaluated_depsgraph_get()))
        for mesh in entry.meshes:
            mesh.data.materials.clear()
            mesh.data.materials.append(bpy.data.materials.new("ao"))
            colour_by_attribute(mesh.data.materials[0], shown.AO)
        camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        scene.collection.objects.link(camera)
        scene.camera = camera
        scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", SAMPLES, False
        scene.render.resolution_x, scene.render.resolution_y = WIDTH_PX, HEIGHT_PX
        # Shows AO values unchanged, without a tone curve for the display.
        scene.view_settings.view_transform, scene.display_settings.display_device = "Raw", "sRGB"
        scene.world = bpy.data.worlds.new("grey")
        scene.world.color = (0.45, 0.55, 0.65)
        look_at(camera, Vector((0, 0, 0.85)), Vector((1.6, -2.9, 0.9)))
        parts = []
        for track in armature.animation_data.nla_tracks:
            track.mute = True
        for clip, share in FRAMES:
            action = next(a for a in bpy.data.actions if a.name.startswith(clip))
            armature.animation_data.action = action
            begin, end = action.frame_range
            scene.frame_set(round(begin + (end - begin) * share))
            scene.render.filepath = f"{folder}/{clip}.png"
            bpy.ops.render.render(write_still=True)
            image = bpy.data.images.load(scene.render.filepath)
            parts.append(np.array(image.pixels[:]).reshape(HEIGHT_PX, WIDTH_PX, 4))
        sheet = np.concatenate(parts, axis=1)
        image = bpy.data.images.new("sheet", sheet.shape[1], sheet.shape[0])
        image.pixels = sheet.ravel()
        image.filepath_raw, image.file_format = PICTURE, "PNG"
        image.save()


main()
