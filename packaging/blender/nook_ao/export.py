"""Writes a character as a .glb file in which each vertex stores its index in Blender.

The file is written directly from the objects. It therefore does not depend on the selection, on visibility,
or on an exporter.
"""
import numpy as np

from . import character, clips, glb, vertex_numbers
from .faults import Fault
from .poses import Y_UP
from .surface import Surface

# The name of the joint for vertices that no bone moves.
NEUTRAL_BONE = "neutral_bone"
MOST_JOINTS = 8


def mask_of(item, armature):
    """Returns how strongly the armature moves each vertex, if its modifier is limited to a vertex group."""
    count = len(item.data.vertices)
    for modifier in character.armature_modifiers(item, armature):
        group = item.vertex_groups.get(modifier.vertex_group)
        if group is not None:
            values = np.zeros(count)
            for vertex in item.data.vertices:
                values[vertex.index] = next((g.weight for g in vertex.groups if g.group == group.index), 0.0)
            return 1 - values if modifier.invert_vertex_group else values
    return np.ones(count)


def weights_of(part, armature, bone_at):
    """Returns the joints and weights of each vertex, as arrays of vertices x MOST_JOINTS. Vertices that no
    bone moves follow the neutral bone."""
    item, neutral = part.item, len(bone_at)
    count = len(item.data.vertices)
    joints, weights = np.zeros((count, MOST_JOINTS), np.uint16), np.zeros((count, MOST_JOINTS))
    if part.bone:
        joints[:, 0], weights[:, 0] = bone_at[part.bone], 1
        return joints, weights
    moving = {b.name for b in armature.data.bones if b.use_deform}
    bone_of_group = {g.index: bone_at[g.name] for g in item.vertex_groups if g.name in moving}
    mask = mask_of(item, armature)
    for vertex in item.data.vertices:
        found = sorted(((g.weight, bone_of_group[g.group]) for g in vertex.groups if g.group in bone_of_group and g.weight > 0), reverse=True)
        found = found[:MOST_JOINTS - 1]
        total, share = sum(w for w, _ in found), mask[vertex.index]
        entries = [(share * w / total, bone) for w, bone in found] + ([(1 - share, neutral)] if share < 1 else []) if total > 0 else [(1.0, neutral)]
        for at, (weight, bone) in enumerate(entries):
            weights[vertex.index, at], joints[vertex.index, at] = weight, bone
    return joints, weights


class Geometry:
    """The parts of a character that do not change with the pose, as arrays in the space of the file's
    armature."""

    def __init__(self, armature, parts):
        count = sum(len(p.item.data.vertices) for p in parts)
        if count > vertex_numbers.LARGEST:
            raise Fault(f"the character has {count} vertices; at most {vertex_numbers.LARGEST} can be numbered")
        bones = armature.data.bones
        self.bone_names = [b.name for b in bones]
        at = {name: number for number, name in enumerate(self.bone_names)}
        self.parents = [at[b.parent.name] if b.parent is not None else -1 for b in bones]
        world = character.matrix(armature.matrix_world)
        if not abs(np.linalg.det(world)) > 0:
            raise Fault(f"the armature {armature.name} has a scale of zero; change the scale")
        # If the armature is mirrored, the file has a mirrored body on an unmirrored armature. Programs that
        # read the file then need not handle mirroring.
        self.mirror = np.diag([-1.0, 1, 1, 1]) if np.linalg.det(world) < 0 else np.eye(4)
        self.root = Y_UP @ world @ self.mirror
        self.rest = self.mirror @ np.array([character.matrix(b.matrix_local) for b in bones]).reshape(-1, 4, 4) @ self.mirror
        self.meshes, first = [], 0
        for part in parts:
            surface = Surface(part.item.data)
            if not np.isfinite(surface.positions).all():
                raise Fault(f"the mesh {part.item.name} has vertices whose positions are not finite; remove these vertices")
            surface.move(self.mirror @ part.bind_matrix(armature))
            slots = [m.name if m is not None else "" for m in part.item.data.materials]
            self.meshes.append((part.item.name, surface, *weights_of(part, armature, at), first, slots))
            first += len(surface.positions)


def _primitive(file, surface, joints, weights, first, chosen, sets):
    """Adds the triangles of one material. The file has one vertex for each different combination of vertex,
    normal and UV."""
    corners = surface.corners[chosen].ravel()
    vertices = surface.vertex_of_corner[corners]
    keys = [vertices[:, None], np.rint(surface.normals[corners] * 1e4)]
    if surface.uvs is not None:
        keys.append(surface.uvs[corners])
    _, kept, index = np.unique(np.concatenate(keys, axis=1), axis=0, return_index=True, return_inverse=True)
    corners, vertices = corners[kept], vertices[kept]
    attributes = {"POSITION": file.add(surface.positions[vertices].astype(np.float32), glb.ARRAY_BUFFER, bounds=True),
                  "NORMAL": file.add(surface.normals[corners].astype(np.float32), glb.ARRAY_BUFFER),
                  f"_{vertex_numbers.NAME}": file.add((vertices + first).astype(np.float32), glb.ARRAY_BUFFER)}
    if surface.uvs is not None:
        attributes["TEXCOORD_0"] = file.add((surface.uvs[corners] * (1, -1) + (0, 1)).astype(np.float32), glb.ARRAY_BUFFER)
    for number in range(sets):
        columns = slice(4 * number, 4 * number + 4)
        attributes[f"JOINTS_{number}"] = file.add(joints[vertices, columns], glb.ARRAY_BUFFER)
        attributes[f"WEIGHTS_{number}"] = file.add(weights[vertices, columns].astype(np.float32), glb.ARRAY_BUFFER)
    indices = file.add(index.ravel().astype(np.uint32), glb.ELEMENT_ARRAY_BUFFER)
    return {"attributes": attributes, "indices": indices, "mode": 4}


def _add_bones(file, geometry):
    """Adds a node for the armature, a node for each bone, and the skin. Returns the node indices of the
    bones."""
    names = geometry.bone_names
    node_of_bone = [1 + at for at in range(len(names))]
    nodes = [{"name": "armature", "matrix": geometry.root.T.ravel().tolist(), "children": []}]
    for at, parent in enumerate(geometry.parents):
        local = geometry.rest[at] if parent < 0 else np.linalg.inv(geometry.rest[parent]) @ geometry.rest[at]
        place, turn, _ = (values[0].tolist() for values in glb.to_turns(local[None]))
        nodes.append({"name": names[at], "translation": place, "rotation": turn})
    for at, parent in enumerate(geometry.parents):
        nodes[0 if parent < 0 else node_of_bone[parent]].setdefault("children", []).append(node_of_bone[at])
    inverse = np.linalg.inv(geometry.rest)
    joints = list(node_of_bone)
    if any((weights[joints_ == len(names)] > 0).any() for _, _, joints_, weights, _, _ in geometry.meshes):
        joints.append(len(nodes))
        nodes[0]["children"].append(len(nodes))
        nodes.append({"name": NEUTRAL_BONE})
        inverse = np.concatenate([inverse, np.eye(4)[None]])
    file.document["nodes"] = nodes
    file.document["skins"] = [{"joints": joints, "inverseBindMatrices": file.add(inverse.transpose(0, 2, 1).astype(np.float32))}]
    return node_of_bone


def to_glb(geometry, sampled, key):
    """Returns the bytes of a .glb file. `key` identifies the character to which the file belongs."""
    file = glb.Glb()
    document = file.document
    document["asset"]["extras"] = {vertex_numbers.KEY: key}
    node_of_bone = _add_bones(file, geometry)
    document["meshes"], document["materials"], roots = [], [], [0]
    for name, surface, joints, weights, first, slots in geometry.meshes:
        sets = 2 if (weights[:, 4:] > 0).any() else 1
        primitives = []
        for material in np.unique(surface.materials):
            primitive = _primitive(file, surface, joints, weights, first, surface.materials == material, sets)
            if material < len(slots) and slots[material]:
                primitive["material"] = len(document["materials"])
                document["materials"].append({"name": slots[material]})
            primitives.append(primitive)
        roots.append(len(document["nodes"]))
        document["nodes"].append({"name": name, "mesh": len(document["meshes"]), "skin": 0})
        document["meshes"].append({"name": name, "primitives": primitives})
    if not document["materials"]:
        del document["materials"]
    for clip in sampled:
        clips.add_to(file, clip, geometry.parents, geometry.mirror, node_of_bone)
    document["scene"], document["scenes"] = 0, [{"nodes": roots}]
    return file.to_bytes()
