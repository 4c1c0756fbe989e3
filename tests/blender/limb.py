"""A small rigged character that Blender makes: a limb of two bones that bends, with a cuff as a second mesh.

Seams of UVs and sharp edges make the exporter split vertices; the armature is turned, moved and scaled, and both meshes are made of
two materials, so that nothing of the character's place or order is trivial.
"""
import math

import bpy

SIDES, RINGS, LENGTH_M, RADIUS_M = 24, 40, 2.0, 0.22
LAST_FRAME, BEND_RADIANS = 21, math.radians(135)


def tube(name, radius, begin, end, rings):
    """A closed tube along x with UVs that have a seam, and caps of sharp edges."""
    points = [(begin + (end - begin) * r / (rings - 1), radius * math.cos(2 * math.pi * s / SIDES), radius * math.sin(2 * math.pi * s / SIDES))
              for r in range(rings) for s in range(SIDES)]
    faces = [(r * SIDES + s, r * SIDES + (s + 1) % SIDES, (r + 1) * SIDES + (s + 1) % SIDES, (r + 1) * SIDES + s)
             for r in range(rings - 1) for s in range(SIDES)]
    faces += [tuple(reversed(range(SIDES))), tuple(range((rings - 1) * SIDES, rings * SIDES))]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    for polygon in mesh.polygons:
        polygon.use_smooth = len(polygon.vertices) == 4
        polygon.material_index = polygon.index % 2
    layer = mesh.uv_layers.new(name="uv")
    for polygon in mesh.polygons:
        for corner in polygon.loop_indices:
            vertex = mesh.loops[corner].vertex_index
            side = vertex % SIDES
            # The last column of quads ends at 1 where the first begins at 0.
            if len(polygon.vertices) == 4 and side == 0 and any(v % SIDES == SIDES - 1 for v in polygon.vertices):
                side = SIDES
            layer.data[corner].uv = (side / SIDES, vertex // SIDES / (rings - 1))
    for number in range(2):
        mesh.materials.append(bpy.data.materials.new(f"{name} {number}"))
    mesh.update()
    return bpy.data.objects.new(name, mesh)


def make():
    """The armature and its meshes, selected, with an action that bends the elbow from straight to 135 degrees."""
    bpy.ops.wm.read_homefile(use_empty=True)
    scene = bpy.context.scene
    armature = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    scene.collection.objects.link(armature)
    bpy.context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    upper = armature.data.edit_bones.new("upper")
    upper.head, upper.tail = (0, 0, 0), (LENGTH_M / 2, 0, 0)
    lower = armature.data.edit_bones.new("lower")
    lower.head, lower.tail, lower.parent = upper.tail, (LENGTH_M, 0, 0), upper
    bpy.ops.object.mode_set(mode="OBJECT")

    limb = tube("Limb", RADIUS_M, 0, LENGTH_M, RINGS)
    cuff = tube("Cuff", 1.2 * RADIUS_M, 0.1 * LENGTH_M, 0.25 * LENGTH_M, 6)
    for part in (limb, cuff):
        scene.collection.objects.link(part)
        part.parent = armature
        part.modifiers.new("Armature", "ARMATURE").object = armature
        for name in ("upper", "lower"):
            part.vertex_groups.new(name=name)
        for vertex in part.data.vertices:
            share = min(max((vertex.co.x / LENGTH_M - 0.45) / 0.1, 0), 1)
            part.vertex_groups["upper"].add([vertex.index], 1 - share, "REPLACE")
            part.vertex_groups["lower"].add([vertex.index], share, "REPLACE")
    # A place, a turn and a size that are none of the file's.
    armature.location, armature.rotation_euler, armature.scale = (0.4, -1.2, 0.9), (0.3, -0.5, 1.1), (0.5, 0.5, 0.5)

    scene.frame_start, scene.frame_end = 1, LAST_FRAME
    bone = armature.pose.bones["lower"]
    bone.rotation_mode = "XYZ"
    for frame, angle in ((1, 0.0), (LAST_FRAME, BEND_RADIANS)):
        bone.rotation_euler = (angle, 0, 0)
        bone.keyframe_insert("rotation_euler", frame=frame)
    scene.frame_set(1)
    armature.select_set(True)
    bpy.context.view_layer.objects.active = armature
    bpy.context.view_layer.update()
    return armature, limb, cuff
