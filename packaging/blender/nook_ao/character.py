"""A rigged character of the scene: an armature and the meshes that it deforms."""
import fnmatch
import re

import numpy as np

from .faults import Fault

# Where an armature keeps the names of the objects that its bake leaves out.
WITHOUT_PROPERTY = "nook_without"
LEVEL = re.compile(r"(?:^|[_.\- ])LOD(\d+)$", re.IGNORECASE)


def armature_of(context):
    """The selected armature, or that of the selected mesh."""
    for candidate in [context.active_object, *context.selected_objects]:
        armature = armature_of_object(candidate)
        if armature is not None:
            return armature
    raise Fault("no rigged character is selected; select its armature, or a mesh that an armature modifier deforms")


def armature_of_object(candidate):
    if candidate is None:
        return None
    if candidate.type == "ARMATURE":
        return candidate
    for modifier in candidate.modifiers:
        if modifier.type == "ARMATURE" and modifier.object is not None:
            return modifier.object
    return None


def level_of(candidate):
    """The level of detail that an object or its mesh is named as, 0 for the finest."""
    return max((int(found[1]) for found in map(LEVEL.search, (candidate.name, candidate.data.name)) if found), default=0)


def is_left_out(name, patterns):
    """Whether one of some names with * and ?, separated by commas, is that of an object."""
    # Brackets have no meaning of their own here, as in the command.
    return any(fnmatch.fnmatchcase(name, p.strip().replace("[", "[[]")) for p in patterns.split(",") if p.strip())


def meshes_of(armature, view_layer):
    """The meshes of a view layer that an armature deforms, in the order of their names, so that numbers of vertices are stable.

    Lower levels of detail are left out, and what the settings name.
    """
    found = [o for o in view_layer.objects
             if o.type == "MESH" and o.data.polygons and o.visible_get(view_layer=view_layer)
             and any(m.type == "ARMATURE" and m.object == armature for m in o.modifiers)]
    if not found:
        raise Fault(f"the armature {armature.name} deforms no visible mesh; add an armature modifier to the body")
    without = armature.get(WITHOUT_PROPERTY, "")
    left = [o for o in found if not is_left_out(o.name, without)]
    if not left:
        raise Fault(f"{without} leaves out every mesh of the armature {armature.name}: {', '.join(o.name for o in found)}")
    finest = min(level_of(o) for o in left)
    found = [o for o in left if level_of(o) == finest]
    return sorted(found, key=lambda o: o.name)


def matrix(values):
    return np.array(values, dtype=np.float64)


def bind_points(armature, meshes):
    """The undeformed vertices of all meshes in armature space, in metres of the scene."""
    to_armature = np.linalg.inv(matrix(armature.matrix_world))
    parts = []
    for mesh in meshes:
        points = np.empty(3 * len(mesh.data.vertices), dtype=np.float32)
        mesh.data.vertices.foreach_get("co", points)
        placed = to_armature @ matrix(mesh.matrix_world)
        parts.append(points.reshape(-1, 3).astype(np.float64) @ placed[:3, :3].T + placed[:3, 3])
    return np.concatenate(parts)


def skinning_matrices(armature, bone_names):
    """How each bone moves points of the bind pose, in armature space; a name that is no bone moves nothing, as the exporter's bone of
    vertices without weights."""
    matrices = np.tile(np.eye(4), (len(bone_names), 1, 1))
    for at, name in enumerate(bone_names):
        bone = armature.pose.bones.get(name)
        if bone is not None:
            matrices[at] = matrix(bone.matrix) @ np.linalg.inv(matrix(bone.bone.matrix_local))
    return matrices


def shown_points(meshes, depsgraph):
    """Vertices as Blender shows them, in world space; None where a modifier changes their number."""
    parts = []
    for mesh in meshes:
        evaluated = mesh.evaluated_get(depsgraph)
        data = evaluated.to_mesh()
        points = np.empty(3 * len(data.vertices), dtype=np.float32)
        data.vertices.foreach_get("co", points)
        evaluated.to_mesh_clear()
        if len(points) != 3 * len(mesh.data.vertices):
            return None
        world = matrix(mesh.matrix_world)
        parts.append(points.reshape(-1, 3).astype(np.float64) @ world[:3, :3].T + world[:3, 3])
    return np.concatenate(parts)


def has_other_modifiers(meshes):
    """Names of modifiers that change vertices behind or before the armature's."""
    return sorted({m.name for o in meshes for m in o.modifiers if m.type != "ARMATURE" and m.show_viewport})
