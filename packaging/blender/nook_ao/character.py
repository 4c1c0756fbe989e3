"""A rigged character of the scene: an armature, the meshes that it deforms, and the meshes that follow its bones."""
import fnmatch
import re

import numpy as np

from .faults import Fault

LEVEL = re.compile(r"(?:^|[_.\- ])LOD(\d+)$", re.IGNORECASE)

# Constraints that make an object follow a bone, such as a sword in a hand.
HOLDING = ("CHILD_OF", "COPY_TRANSFORMS", "ARMATURE")
SURFACES = ("CURVE", "SURFACE", "FONT", "META")


def armature_of(context):
    """Returns the selected armature, or the armature of the selected mesh."""
    candidates = [o for o in (context.active_object, *context.selected_objects) if o is not None]
    for candidate in candidates:
        armature = armature_of_object(candidate)
        if armature is not None:
            return armature
    for candidate in candidates:
        if candidate.instance_collection and any(o.type == "ARMATURE" for o in candidate.instance_collection.all_objects):
            raise Fault(f"the character of {candidate.name} is an instance of a collection; choose Object > Library Override > Make, "
                        "or Object > Apply > Make Instances Real, and select its armature")
    raise Fault("no rigged character is selected; select its armature, or a mesh that an armature modifier deforms")


def armature_of_object(candidate):
    if candidate is None:
        return None
    if candidate.type == "ARMATURE":
        return candidate
    for modifier in candidate.modifiers:
        if modifier.type == "ARMATURE" and modifier.object is not None:
            return modifier.object
    for holder in (candidate.parent, *(target for target, _ in held_by(candidate))):
        if holder is not None and holder.type == "ARMATURE":
            return holder
    return None


def held_by(item):
    """Returns the objects and bones that the constraints of an object follow."""
    for constraint in item.constraints:
        if constraint.type in HOLDING and not constraint.mute and constraint.influence > 0:
            for target in constraint.targets if constraint.type == "ARMATURE" else (constraint,):
                yield target.target, target.subtarget


def armature_modifiers(item, armature):
    return [m for m in item.modifiers if m.type == "ARMATURE" and m.object == armature]


def is_deformed(item, armature):
    return bool(armature_modifiers(item, armature)) or (item.parent == armature and item.parent_type == "ARMATURE")


def matrix(values):
    return np.array(values, dtype=np.float64)


def local_place(item):
    return matrix(item.matrix_parent_inverse) @ matrix(item.matrix_basis)


def hanging_place(item, armature):
    """Returns the bone that an object follows, and the matrix from the object to armature space in the rest
    pose. Returns None if the object does not follow a bone."""
    bones = armature.data.bones
    for target, name in held_by(item):
        if target == armature and name in bones:
            held = np.linalg.inv(matrix(armature.matrix_world) @ matrix(armature.pose.bones[name].matrix)) @ matrix(item.matrix_world)
            return name, matrix(bones[name].matrix_local) @ held
    if item.parent == armature and item.parent_type == "BONE" and item.parent_bone in bones:
        bone = bones[item.parent_bone]
        tail = np.eye(4)
        tail[1, 3] = bone.length
        place = np.eye(4) if bone.use_relative_parent else matrix(bone.matrix_local) @ tail
        return bone.name, place @ local_place(item)
    if item.parent is not None and item.parent != armature and item.parent_type == "OBJECT":
        found = hanging_place(item.parent, armature)
        if found is not None:
            return found[0], found[1] @ local_place(item)
    return None


def belongs_to(item, armature):
    """Returns whether an object moves with an armature in any way."""
    parent = item.parent
    while parent is not None and parent != armature:
        parent = parent.parent
    return parent == armature or is_deformed(item, armature) or any(target == armature for target, _ in held_by(item))


class Part:
    """A mesh of a character. The armature deforms it, or it follows one bone."""

    def __init__(self, item, armature):
        self.item = item
        self.bone, self._hanging = "", None
        if not is_deformed(item, armature):
            self.bone, self._hanging = hanging_place(item, armature) or ("", None)

    def bind_matrix(self, armature):
        """Returns the matrix from the mesh to armature space, in the rest pose."""
        if self._hanging is not None:
            return self._hanging
        if self.item.parent == armature and self.item.parent_type in ("OBJECT", "ARMATURE") and not self.item.constraints:
            return local_place(self.item)  # also correct for hidden objects, whose world matrix Blender does not update
        return np.linalg.inv(matrix(armature.matrix_world)) @ matrix(self.item.matrix_world)


def rendered_objects(layer_collection):
    """Returns the names of the view layer's objects that are in a rendered collection."""
    if layer_collection.exclude or layer_collection.collection.hide_render:
        return set()
    found = {o.name_full for o in layer_collection.collection.objects}
    for child in layer_collection.children:
        found |= rendered_objects(child)
    return found


def reason_to_leave_out(item, armature, rendered):
    if item.display_type in ("WIRE", "BOUNDS"):
        return "is drawn as a wireframe"
    if item.hide_render or item.name_full not in rendered:
        return "is disabled for renders"
    if item.type != "MESH":
        return f"is a {item.type.lower()}; convert it to a mesh"
    if not item.data.polygons:
        return "has no faces"
    if not is_deformed(item, armature) and hanging_place(item, armature) is None:
        return "is not attached to a bone"
    return None


def level_of(item):
    """Returns the level of detail that the name of an object or of its mesh states. 0 is the finest."""
    return max((int(found[1]) for found in map(LEVEL.search, (item.name, item.data.name)) if found), default=0)


def is_left_out(name, patterns):
    """Returns whether an object's name matches one of the comma-separated patterns. Patterns may contain *
    and ?."""
    # Brackets do not have a special meaning, as in the command `nook`.
    return any(fnmatch.fnmatchcase(name, p.strip().replace("[", "[[]")) for p in patterns.split(",") if p.strip())


def without_coarse(parts, left_out):
    """Returns the parts of the finest level of detail."""
    finest = min((level_of(p.item) for p in parts), default=0)
    left_out += [(p.item.name, "is a lower level of detail") for p in parts if level_of(p.item) > finest]
    return [p for p in parts if level_of(p.item) == finest]


def parts_of(armature, view_layer, without=""):
    """Returns the parts of a character, sorted by name. Also returns what is left out, as pairs of name and
    reason."""
    rendered = rendered_objects(view_layer.layer_collection)
    shapes = {b.custom_shape for b in armature.pose.bones if b.custom_shape is not None}
    parts, left_out = [], []
    for item in sorted(view_layer.objects, key=lambda o: o.name_full):
        if item.type not in ("MESH", *SURFACES) or item in shapes or not belongs_to(item, armature):
            continue
        reason = "is left out by the settings" if is_left_out(item.name, without) else reason_to_leave_out(item, armature, rendered)
        if reason is None:
            parts.append(Part(item, armature))
        else:
            left_out.append((item.name, reason))
    parts = without_coarse(parts, left_out)
    if not parts:
        others = "".join(f"; {name} {reason}" for name, reason in left_out)
        raise Fault(f"the armature {armature.name} deforms no mesh that is rendered{others}; add an armature modifier to the body")
    return parts, left_out


def check_paintable(armature, parts, scenes):
    """Raises a Fault if the meshes cannot keep the colours. A mesh has only one set of colours. A rig from a
    library cannot store a bake."""
    if armature.library is not None:
        raise Fault(f"the armature {armature.name} is linked from {armature.library.filepath}; choose Object > Library Override > Make, or append it")
    for part in parts:
        mesh = part.item.data
        users = sorted({o.name for scene in scenes for o in scene.objects if o.data == mesh})
        if len(users) > 1:
            raise Fault(f"the objects {', '.join(users)} share the mesh {mesh.name}, which can keep only one set of colours; select the objects and choose "
                        "Object > Relations > Make Single User > Object & Data")


def bind_points(armature, parts):
    """Returns the undeformed vertices of all parts in armature space. Lengths are in the metres of the
    scene."""
    points = []
    for part in parts:
        own = np.empty(3 * len(part.item.data.vertices), dtype=np.float32)
        part.item.data.vertices.foreach_get("co", own)
        placed = part.bind_matrix(armature)
        points.append(own.reshape(-1, 3).astype(np.float64) @ placed[:3, :3].T + placed[:3, 3])
    return np.concatenate(points)


def pose_matrices(armature):
    """Returns the pose matrix of each bone in armature space, in the order of the bones."""
    flat = np.empty(16 * len(armature.pose.bones), dtype=np.float32)
    armature.pose.bones.foreach_get("matrix", flat)
    return flat.reshape(-1, 4, 4).transpose(0, 2, 1).astype(np.float64)


def skinning_matrices(armature, bone_names):
    """Returns, for each name, the matrix by which the bone moves points of the bind pose, in armature space.
    For a name without a bone, it is the identity. An example is the bone of vertices without weights."""
    matrices = np.tile(np.eye(4), (len(bone_names), 1, 1))
    bones = armature.pose.bones
    place = {bone.name: at for at, bone in enumerate(bones)}
    poses = pose_matrices(armature)
    for at, name in enumerate(bone_names):
        if name in place:
            matrices[at] = poses[place[name]] @ np.linalg.inv(matrix(bones[name].bone.matrix_local))
    return matrices
