#!/usr/bin/env python3
"""Writes the synthetic rigs: one body in the world, in files that differ as exporters differ.

  rigs.py FOLDER [NAME...]

Each file is a .gltf with its buffer inside. In every pose of the clip all rigs of a body put its vertices at the same
places of the world, up to the rig's unit of length.
"""
import base64
import json
import pathlib
import struct
import sys

import body
import matrix

KEY_STEP_S = 0.25


class Rig:
    """The differences between the files of a body.

    armature: the node above the skeleton. It must be a similarity.
    joint_scale: what a joint's axes have beyond the plain rig's: the scale and the mirror of the armature.
    mesh: from the space of POSITION to the world; for each part of the body, or one for all.
    """

    def __init__(self, armature=None, joint_scale=(1.0, 1.0, 1.0), mesh=None, **options):
        self.armature = armature or matrix.identity()
        self.joint_scale = matrix.scaling(*joint_scale)
        self.mesh = mesh or [matrix.identity()]
        self.is_beast = options.get("beast", False)
        self.is_rigid = options.get("rigid", False)  # vertices of two bones lie at one place where segments meet
        self.prop = options.get("prop")  # "rigid": a mesh under the joint; "skinned": with weight 1 on it
        self.wide_joints = options.get("wide_joints", False)
        self.two_skins = options.get("two_skins", False)
        self.unused_joint = options.get("unused_joint", False)
        self.bind = options.get("bind", "own")  # "one_place": all joints at the origin; "none": so, and no matrices
        self.mesh_node = options.get("mesh_node")  # the matrix of the node that holds the mesh; skinning ignores it
        self.unit = options.get("unit", 1.0)  # of the world, in units for each metre


def rigs():
    up_z = matrix.rotation(0, -90)
    apart = matrix.chain(matrix.translation(0.4, -0.3, 0.7), matrix.rotation(1, 130), matrix.rotation(0, 25))
    shear = [[1.0, 0.35, 0.0, 0.1], [0.0, 1.0, -0.25, 0.0], [0.0, 0.0, 1.3, 0.0], [0.0, 0.0, 0.0, 1.0]]
    small, large, mirror = matrix.scaling(0.01, 0.01, 0.01), matrix.scaling(100.0, 100.0, 100.0), matrix.scaling(-1.0, 1.0, 1.0)
    turned = matrix.chain(matrix.rotation(1, 90), matrix.translation(0.1, 0.2, 0.3), matrix.scaling(2.0, 2.0, 2.0))
    return {
        "plain": Rig(),
        "scaled_down": Rig(small, (0.01,) * 3, [small]),
        "scaled_up": Rig(large, (100.0,) * 3, [large]),
        "rotated": Rig(up_z, mesh=[up_z]),
        "mirrored": Rig(mirror, (-1.0, 1.0, 1.0), [mirror]),
        "sheared": Rig(mesh=[shear]),
        "apart": Rig(apart, mesh=[matrix.inverse(apart)], mesh_node=matrix.chain(apart, large)),
        "two_skins": Rig(up_z, mesh=[up_z, turned], two_skins=True),
        "wide_joints": Rig(wide_joints=True),
        "unused_joint": Rig(unused_joint=True),
        "one_place": Rig(bind="one_place"),
        "no_inverse_bind": Rig(bind="none"),
        "prop_skinned": Rig(prop="skinned"),
        "prop": Rig(small, (0.01,) * 3, [small], prop="rigid"),
        "segments": Rig(small, (0.01,) * 3, [small], rigid=True),
        "quadruped": Rig(beast=True),
        "quadruped_blender": Rig(matrix.product(up_z, small), (0.01,) * 3, [matrix.product(up_z, small)], beast=True),
        "centimetres": Rig(unit=100.0),
    }


class Buffer:
    """Accessors and the bytes behind them."""

    def __init__(self):
        self.bytes, self.views, self.accessors = bytearray(), [], []

    def add(self, values, kind, component, bounds=False):
        """values: tuples of numbers. Returns the index of the accessor."""
        letter = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}[component]
        data = b"".join(struct.pack(f"<{len(v)}{letter}", *v) for v in values)
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data
        accessor = {"bufferView": len(self.views) - 1, "componentType": component, "count": len(values), "type": kind}
        if bounds:
            rounded = [struct.unpack(f"<{len(v)}f", struct.pack(f"<{len(v)}f", *v)) for v in values]
            accessor["min"] = [min(v[i] for v in rounded) for i in range(len(values[0]))]
            accessor["max"] = [max(v[i] for v in rounded) for i in range(len(values[0]))]
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def in_unit(m, unit):
    """A map of the world as a map of a world with another unit."""
    return [row[:3] + [row[3] * unit] for row in m[:3]] + [m[3]]


def bind_globals(rig, joints):
    """The joints' world matrices in the file's default pose."""
    if rig.bind != "own":
        return [matrix.identity() for _ in joints]
    return [in_unit(matrix.product(body.bind_matrix(joint), rig.joint_scale), rig.unit) for joint in joints]


def locals_of(rig, joints, globals_):
    out = []
    for joint, own in zip(joints, globals_):
        above = globals_[joint.parent] if joint.parent >= 0 else rig.armature
        out.append(matrix.product(matrix.inverse(above), own))
    return out


def node_of(name, local, children):
    node = {"name": name, "translation": [local[i][3] for i in range(3)], "rotation": matrix.quaternion(local)}
    if children:
        node["children"] = children
    return node


def add_animation(rig, shape, document, buffer, bind):
    times = buffer.add([(k * KEY_STEP_S,) for k in range(len(shape.keys))], "SCALAR", 5126, bounds=True)
    samplers, channels = [], []
    keys = []
    for pose in shape.keys:
        posed = [matrix.product(in_unit(pose[j], rig.unit), bind[j]) for j in range(len(bind))]
        keys.append(locals_of(rig, shape.joints, posed))
    for j in range(len(shape.joints)):
        for path in ("rotation", "translation"):
            if path == "rotation":
                values = [matrix.quaternion(locals_[j]) for locals_ in keys]
            else:
                values = [tuple(locals_[j][i][3] for i in range(3)) for locals_ in keys]
            samplers.append({"input": times, "output": buffer.add(values, "VEC4" if path == "rotation" else "VEC3", 5126)})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": 1 + j, "path": path}})
    document["animations"] = [{"name": "bend", "samplers": samplers, "channels": channels}]


def primitive_of(rig, shape, part, space, joint_number, buffer):
    """The vertices from part[0] to part[1]; joint_number: of each joint in the skin, or None for a mesh without one."""
    first, last = part
    to_mesh = matrix.inverse(space)
    vertices = range(first, last)
    positions = [tuple(matrix.point(to_mesh, [x * rig.unit for x in shape.position[v]])) for v in vertices]
    normals = []
    for v in vertices:
        n = [sum(space[j][i] * shape.normal[v][j] for j in range(3)) for i in range(3)]
        length = sum(x * x for x in n) ** 0.5
        normals.append(tuple(x / length for x in n))
    order = (0, 2, 1) if matrix.determinant(space) < 0 else (0, 1, 2)
    corners = [(t[order[i]] - first,) for t in shape.triangles if first <= t[0] < last for i in range(3)]
    attributes = {"POSITION": buffer.add(positions, "VEC3", 5126, bounds=True), "NORMAL": buffer.add(normals, "VEC3", 5126)}
    if joint_number is not None:
        joints, weights = [], []
        for v in vertices:
            pairs = [(joint_number[j], w) for j, w in shape.weights[v].items()] + [(0, 0.0)] * 4
            joints.append(tuple(j for j, _ in pairs[:4]))
            weights.append(tuple(w for _, w in pairs[:4]))
        attributes["JOINTS_0"] = buffer.add(joints, "VEC4", 5123 if rig.wide_joints else 5121)
        attributes["WEIGHTS_0"] = buffer.add(weights, "VEC4", 5126)
    return {"attributes": attributes, "indices": buffer.add(corners, "SCALAR", 5125)}


def add_skin(rig, document, buffer, bind, space, nodes):
    skin = {"joints": [1 + j for j in nodes]}
    if rig.bind != "none":
        skin["inverseBindMatrices"] = buffer.add(
            [tuple(matrix.columns(matrix.product(matrix.inverse(bind[j]), space))) for j in nodes], "MAT4", 5126)
    document["skins"].append(skin)


def add_meshes(rig, shape, document, buffer, bind):
    """A mesh and a node for each part; parts share a skin unless the rig has two."""
    joints = range(len(shape.joints))
    halves = [range(0, 10), range(10, len(joints))] if rig.two_skins else [joints]
    spaces = [in_unit(space, rig.unit) for space in rig.mesh]
    for half, nodes in enumerate(halves):
        listed = list(nodes) + ([len(joints)] if rig.unused_joint else [])
        add_skin(rig, document, buffer, bind + [bind[0]], spaces[half], listed)
    body_parts = shape.parts if rig.two_skins else [(0, shape.parts[min(1, len(shape.parts) - 1)][1])]
    props = shape.parts[2:]
    for p, part in enumerate(body_parts + props):
        is_rigid = p >= len(body_parts) and rig.prop == "rigid"
        skin = p if rig.two_skins else 0
        number = {j: n for n, j in enumerate(halves[skin])}
        space = bind[19] if is_rigid else spaces[skin]
        document["meshes"].append({"primitives": [primitive_of(rig, shape, part, space, None if is_rigid else number, buffer)]})
        node = {"name": f"mesh_{p}", "mesh": len(document["meshes"]) - 1}
        if not is_rigid:
            node["skin"] = skin
            if rig.mesh_node:
                node["matrix"] = matrix.columns(rig.mesh_node)
        document["nodes"].append(node)
        number_of_node = len(document["nodes"]) - 1
        if is_rigid:
            document["nodes"][1 + 19].setdefault("children", []).append(number_of_node)
        else:
            document["scenes"][0]["nodes"].append(number_of_node)


def document_of(rig):
    shape = body.beast() if rig.is_beast else body.person(rig.prop is not None, rig.is_rigid)
    buffer = Buffer()
    bind = bind_globals(rig, shape.joints)
    document = {"asset": {"version": "2.0", "generator": "tests/stranger/rigs.py"}, "scene": 0, "scenes": [{"nodes": [0]}],
                "nodes": [{"name": "armature", "matrix": matrix.columns(rig.armature), "children": [1]}], "meshes": [], "skins": []}
    for j, local in enumerate(locals_of(rig, shape.joints, bind)):
        children = [1 + c for c, joint in enumerate(shape.joints) if joint.parent == j]
        document["nodes"].append(node_of(shape.joints[j].name, local, children))
    if rig.unused_joint:
        document["nodes"].append({"name": "twist", "translation": [0.0, 0.1, 0.0]})
        document["nodes"][1 + 13].setdefault("children", []).append(len(document["nodes"]) - 1)
    add_meshes(rig, shape, document, buffer, bind)
    add_animation(rig, shape, document, buffer, bind)
    document["accessors"], document["bufferViews"] = buffer.accessors, buffer.views
    uri = "data:application/octet-stream;base64," + base64.b64encode(bytes(buffer.bytes)).decode()
    document["buffers"] = [{"byteLength": len(buffer.bytes), "uri": uri}]
    return document


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    table = rigs()
    for name in sys.argv[2:] or table:
        (folder / f"{name}.gltf").write_text(json.dumps(document_of(table[name])), encoding="utf-8")


if __name__ == "__main__":
    main()
