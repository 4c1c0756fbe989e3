#!/usr/bin/env python3
"""cases_test.py FOLDER TOOL COMPARE: files of each kind, one line each, with the exit code and the words that `nook inspect`
must give, and the AO by ray tracing.

Writes the files into FOLDER. Exit code 3 is a refusal; code 0 with words is a repair or a note. A line without words
must print no warning at all. The AO of a file that says which plain file shows the same body is equal to the AO of that
file; COMPARE is the program compare_ao."""
import base64
import json
import os
import pathlib
import struct
import subprocess
import sys

sys.dont_write_bytecode = True
from write_gltf import FLOAT, I16, U8, U16, U32, Gltf, column  # noqa: E402

OUTSIDE = "--allow-outside-files"


def edited(change):
    """A column after `change`, which gets the file and its document."""
    def write(folder, name):
        file = column()
        change(file, file.document)
        file.write(folder / f"{name}.glb")
        return f"{name}.glb"
    return write


def asset(**words):
    return edited(lambda file, document: document["asset"].update(words))


def attribute(name, values, element, component, **more):
    def change(file, document):
        document["meshes"][0]["primitives"][0]["attributes"][name] = file.add(values, element, component, **more)
    return edited(change)


def indices(component):
    def change(file, document):
        document["accessors"][3]["componentType"] = component
        document["accessors"][3]["count"] //= 2
    return edited(change)


def zero_weights(count, value=0.0, of_four=4):
    """The first vertices with this value in place of their weights."""
    def change(file, document):
        at = document["bufferViews"][2]["byteOffset"]
        for vertex in range(count):
            struct.pack_into(f"<{of_four}f", file.data, at + 16 * vertex, *of_four * [value])
    return edited(change)


def node(index, **words):
    return edited(lambda file, document: document["nodes"][index].update(words))


def key_times(*times):
    def change(file, document):
        sampler = document["animations"][0]["samplers"][0]
        sampler["input"] = file.add(times, "SCALAR")
        sampler["output"] = file.add([0, 0, 0, 1] * len(times), "VEC4")
    return edited(change)


def rotations(*values):
    return edited(lambda file, document: document["animations"][0]["samplers"][0].update(output=file.add(values, "VEC4")))


def joints_twice(file, document):
    identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    matrices = identity + 2 * (identity[:13] + [-1, 0, 1])
    document["skins"][0] = {"joints": [1, 2, 2], "inverseBindMatrices": file.add(matrices, "MAT4")}


def header_version(folder, name):
    path = folder / edited(lambda file, document: None)(folder, name)
    data = bytearray(path.read_bytes())
    data[4:8] = struct.pack("<I", 1)
    path.write_bytes(data)
    return path.name


def unused_vertices(count):
    def change(file, document):
        document["accessors"][0].update(count=count, sparse={
            "count": 160, "indices": {"bufferView": file.view(struct.pack("<160I", *range(160))), "componentType": U32},
            "values": {"bufferView": document["accessors"][0].pop("bufferView")}})
        for accessor in (1, 2):
            document["meshes"][0]["primitives"][0]["attributes"].pop(("JOINTS_0", "WEIGHTS_0")[accessor - 1])
        on_the_tip(document)
    return edited(change)


def on_the_tip(document):
    """The mesh without its skin, as a rigid part of node 2."""
    document["nodes"][3].pop("skin")
    document["nodes"][2]["children"] = [3]
    document["nodes"][0]["children"] = [1]


def restart(mode, component):
    def change(file, document):
        last = 255 if component == U8 else 65535
        on_the_tip(document)
        positions = [0, 0, 0, 1, 0, 0] + [0, 1, 0] * (last - 1)
        document["meshes"][0]["primitives"][0] = {"attributes": {"POSITION": file.add(positions, "VEC3")}, "mode": mode,
                                                  "indices": file.add([0, 1, last], "SCALAR", component)}
    return edited(change)


def no_position(file, document):
    on_the_tip(document)
    document["meshes"][0]["primitives"][0]["attributes"] = {"NORMAL": file.add([0, 0, 1] * 160, "VEC3")}


def second_body(name, **node_words):
    """Another node that shows the same mesh."""
    def change(file, document):
        document["nodes"].append({"name": name, "mesh": 0, "skin": 0, **node_words})
        document["nodes"][0]["children"].append(4)
    return edited(change)


def pushed_copy(push, inside=True, is_open=False, primitive=False):
    """The column again, pushed outwards by `push`, as the hull of a toon outline is: its faces look inside. is_open: without
    its ends; primitive: in the same mesh."""
    def change(file, document):
        body = document["meshes"][0]["primitives"][0]
        position = list(struct.unpack_from("<480f", file.data, document["bufferViews"][0]["byteOffset"]))
        view = document["bufferViews"][3]
        index = list(struct.unpack_from(f"<{view['byteLength'] // 2}H", file.data, view["byteOffset"]))
        middle = [0, 1, 0]
        for i, x in enumerate(position):
            if i % 3 != 1 or x in (0, 2):
                position[i] += push if x > middle[i % 3] else -push
        if is_open:
            index = index[:-12]
        copy = {"attributes": {**body["attributes"], "POSITION": file.add(position, "VEC3")},
                "indices": file.add(turned(index) if inside else index, "SCALAR", U16)}
        if primitive:
            document["meshes"][0]["primitives"].append(copy)
            return
        document["meshes"].append({"name": "black", "primitives": [copy]})
        document["nodes"].append({"name": "outline", "mesh": 1, "skin": 0})
        document["nodes"][0]["children"].append(4)
    return edited(change)


def hidden_parent(file, document):
    document["nodes"] += [{"name": "hull", "mesh": 0, "skin": 0},
                          {"children": [4], "extensions": {"KHR_node_visibility": {"visible": False}}}]
    document["nodes"][0]["children"].append(5)


def instances(file, document):
    on_the_tip(document)
    moves = {"TRANSLATION": file.add([0, 0, 0, 3, 0, 0, 6, 0, 0], "VEC3")}
    document["nodes"][3]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": moves}}


def buffer_in(uri, stored, link=None):
    """A .gltf in a folder of its own that names `uri`; the buffer is in `stored`, and `link` leads from one to another."""
    def write(folder, name):
        own = folder / name
        (own / "inner").mkdir(parents=True, exist_ok=True)
        file = column()
        file.write(own / "inner/file.gltf", uri)
        (own / "inner" / stored).write_bytes(file.data)
        if link:
            place = own / "inner" / link[0]
            if not place.is_symlink():
                place.symlink_to(link[1])
        return f"{name}/inner/file.gltf"
    return write


def no_change(file, document):
    pass


def fractions(file, document):
    """Whole numbers as 1.0, which glTF allows."""
    for accessor in document["accessors"]:
        accessor["count"] = float(accessor["count"])
    document["nodes"][3].update(mesh=0.0, skin=0.0)
    document["nodes"][0]["children"] = [1.0, 3.0]
    document["skins"][0]["joints"] = [1.0, 2.0]


def inverse_bind(*changes):
    """The second matrix with other numbers, by their index."""
    def change(file, document):
        matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1]
        for index, number in changes:
            matrix[index] = number
        identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
        document["skins"][0]["inverseBindMatrices"] = file.add(identity + matrix, "MAT4")
    return edited(change)


def second_scene(file, document):
    """A sword in a scene of its own, and no default scene."""
    document["nodes"].append({"name": "sword", "mesh": 0, "skin": 0})
    document["scenes"].append({"nodes": [4]})
    document.pop("scene")


def transparent_hull(file, document):
    document["materials"] = [{"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0]}}]
    hull = {**document["meshes"][0]["primitives"][0], "material": 0}
    document["meshes"].append({"name": "physics", "primitives": [hull]})
    document["nodes"].append({"name": "hull", "mesh": 1, "skin": 0})
    document["nodes"][0]["children"].append(4)


def foreign(begin):
    def write(folder, name):
        (folder / f"{name}.glb").write_bytes(begin + bytes(200))
        return f"{name}.glb"
    return write


def sparse_indices(*indices):
    def change(file, document):
        document["accessors"][0]["sparse"] = {
            "count": len(indices), "values": {"bufferView": file.view(bytes(12 * len(indices)))},
            "indices": {"bufferView": file.view(struct.pack(f"<{len(indices)}H", *indices)), "componentType": U16}}
    return edited(change)


def external(before=b"", after=b"", uri=None):
    """A .gltf whose buffer is in a file with more bytes than it needs; or in a data URI that begins with `uri`."""
    def write(folder, name):
        file = column()
        text = uri + base64.b64encode(file.data).decode() if uri else f"{name}.bin"
        file.write(folder / f"{name}.gltf", text)
        (folder / f"{name}.bin").write_bytes(before + file.data + after)
        return f"{name}.gltf"
    return write


def room_without_bytes(folder, name):
    """A .gltf whose second buffer has no URI, which glTF allows; nothing reads it."""
    file = column()
    file.write(folder / f"{name}.gltf", f"{name}.bin")
    (folder / f"{name}.bin").write_bytes(file.data)
    document = json.loads((folder / f"{name}.gltf").read_text())
    document["buffers"].append({"byteLength": 4096})
    (folder / f"{name}.gltf").write_text(json.dumps(document))
    return f"{name}.gltf"


def sparse_floats(file, document):
    document["accessors"][0]["sparse"] = {
        "count": 1, "indices": {"bufferView": file.view(struct.pack("<f", 0)), "componentType": FLOAT},
        "values": {"bufferView": file.view(struct.pack("<3f", 0, 0, 0))}}


def turned(indices_):
    """Triangles whose corners go round the other way."""
    return [i for t in range(0, len(indices_), 3) for i in (indices_[t], indices_[t + 2], indices_[t + 1])]


MIRROR = [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
LOWERED_MIRROR = MIRROR[:13] + [-1, 0, 1]


def mirrored(positions=False, corners=False, normals=False, matrices=False, **scales):
    """A column below mirrored nodes. What is true is mirrored in x in the file: positions, with the normals; the order of
    corners; the inverse bind matrices. scales: the nodes, armature, root or body, that are scaled by -1."""
    def change(file, document):
        attributes = document["meshes"][0]["primitives"][0]["attributes"]
        position = list(struct.unpack_from("<480f", file.data, document["bufferViews"][0]["byteOffset"]))
        index_view = document["bufferViews"][3]
        index = list(struct.unpack_from(f"<{index_view['byteLength'] // 2}H", file.data, index_view["byteOffset"]))
        sign = -1 if positions else 1
        if normals:
            across = [[sign * position[3 * v], 0, position[3 * v + 2]] for v in range(160)]
            attributes["NORMAL"] = file.add([x / 0.08 ** 0.5 for normal in across for x in normal], "VEC3")
        if positions:
            attributes["POSITION"] = file.add([-x if i % 3 == 0 else x for i, x in enumerate(position)], "VEC3")
        if corners:
            document["meshes"][0]["primitives"][0]["indices"] = file.add(turned(index), "SCALAR", U16)
        if matrices:
            document["skins"][0]["inverseBindMatrices"] = file.add(MIRROR + LOWERED_MIRROR, "MAT4")
        for name in scales:
            document["nodes"][["armature", "root", "tip", "body"].index(name)]["scale"] = [-1, 1, 1]
    return edited(change)


# Name, how the file is made, options of the command, exit code, words of its message or warnings; and for a file that
# shows the body of another one, the name of that file.
INSIDE_OUT = ['a closed part of node "body" (mesh "column" primitive 0', "is inside out"]
OUTLINE = ['"outline" closely surrounds', 'of node "body"', '--without "outline"']
CASES = [
    ("plain", edited(no_change), [], 0, []),
    # Versions.
    ("version_3", asset(version="3.0"), [], 3, ['glTF version "3.0"']),
    ("version_1", asset(version="1.0"), [], 3, ['glTF version "1.0"']),
    ("version_2_1", asset(version="2.1"), [], 0, [], "plain"),
    ("minimum_2_1", asset(version="2.1", minVersion="2.1"), [], 3, ['glTF version "2.1"', "minVersion"]),
    ("header_1", header_version, [], 3, ["binary header says that the file has glTF version 1"]),
    # Types of accessors.
    ("indices_float", indices(FLOAT), [], 3, ["indices (accessor 3) contains SCALAR of FLOAT"]),
    ("indices_signed", indices(I16), [], 3, ["indices (accessor 3) contains SCALAR of SHORT"]),
    ("joints_float", attribute("JOINTS_0", [0] * 640, "VEC4", FLOAT), [], 3, ["JOINTS_0 (accessor 7) contains VEC4 of FLOAT"]),
    ("joints_u32", attribute("JOINTS_0", [0] * 640, "VEC4", U32), [], 3, ["JOINTS_0 (accessor 7) contains VEC4 of UNSIGNED_INT"]),
    ("weights_u16", attribute("WEIGHTS_0", [1] * 640, "VEC4", U16), [], 3, ["WEIGHTS_0 (accessor 7) contains VEC4 of UNSIGNED_SHORT"]),
    ("positions_u16", attribute("POSITION", [1] * 480, "VEC3", U16), [], 3, ["list KHR_mesh_quantization"]),
    ("sparse_float", edited(sparse_floats), [], 3, ["sparse indices have component type 5126"]),
    ("times_u16", edited(lambda f, d: d["accessors"][5].update(componentType=U16)), [], 3, ["input (accessor 5) contains SCALAR of UNSIGNED_SHORT"]),
    ("colours_u8", attribute("COLOR_0", [1] * 640, "VEC4", U8), [], 0, ["COLOR_0, VEC4 of UNSIGNED_BYTE"], "plain"),
    # Weights.
    ("weights_zero_one", zero_weights(1), [], 0, ["1 of 160 skinned vertices have no weights"], "plain"),
    ("weights_zero_two", zero_weights(2), [], 3, ["2 of 160 skinned vertices have no weights (need at most 1 %)"]),
    ("weights_nan_one", zero_weights(1, float("nan")), [], 0, ["1 of 160 skinned vertices have no weights"], "plain"),
    ("weights_nan_two", zero_weights(2, float("nan")), [], 3, ["2 of 160 skinned vertices have no weights (need at most 1 %)"]),
    ("weights_infinite", zero_weights(1, float("inf"), 1), [], 3, ["vertex 0 has a weight that is not finite"]),
    # Faults that leave one way to read the file.
    *[(f"restart_{mode}_{component}", restart(mode, component), [], 0, ["restarts primitives"])
      for mode in (4, 5, 6) for component in (U8, U16)],
    *[(f"restart_{mode}_{component}", restart(mode, component), [], 3, ["no triangles"])
      for mode in (0, 1, 2, 3) for component in (U8, U16)],
    ("no_position", edited(no_position), [], 3, ["has no POSITION"]),
    ("joint_twice", edited(joints_twice), [], 0, ["lists joint node 2 twice"], "plain"),
    ("matrix_and_translation", node(0, matrix=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], translation=[9, 0, 0]), [], 0,
     ["matrix as well as a translation"]),
    ("rotation_of_length_2", node(0, rotation=[0, 0, 0, 2]), [], 0, ["not a unit quaternion"]),
    ("key_of_length_2", rotations(0, 0, 0, 1, 0, 0, 0, 2), [], 0, ["not unit quaternions"]),
    ("times_equal", key_times(0, 1, 1), [], 0, ["several keys at the same time"]),
    ("times_falling", key_times(0, 2, 1), [], 3, ["key times that decrease"]),
    ("bounds_false", edited(lambda f, d: d["accessors"][0].update(min=[-1, 0, -1], max=[1, 1, 1])), [], 0,
     ["min and max that do not match"], "plain"),
    ("row_of_node", node(0, matrix=[1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]), [], 0, ["last row is not 0 0 0 1", 'node 0, "armature"'], "plain"),
    ("row_of_skin", inverse_bind((3, 1)), [], 0, ["last row is not 0 0 0 1", "skin 0 matrix 1"], "plain"),
    ("row_of_skin_half", inverse_bind((15, 0.5)), [], 0, ["last row is not 0 0 0 1"], "plain"),
    # Types of members.
    ("fractions", edited(fractions), [], 0, [], "plain"),
    ("scale_string", node(0, scale="2"), [], 3, ["nodes[0].scale is a string (need an array)"]),
    ("scale_of_strings", node(0, scale=["2", "2", "2"]), [], 3, ["nodes[0].scale[0] is a string (need a number)"]),
    ("skin_string", node(3, skin="0"), [], 3, ["nodes[3].skin is a string (need a whole number)"]),
    ("skin_half", node(3, skin=0.5), [], 3, ["nodes[3].skin is a number (need a whole number)"]),
    ("skin_null", node(0, skin=None), [], 0, [], "plain"),
    ("children_number", node(1, children=2), [], 3, ["nodes[1].children is a number (need an array)"]),
    ("nodes_object", edited(lambda f, d: d.update(nodes={"0": {}})), [], 3, ["nodes is an object (need an array)"]),
    ("required_object", edited(lambda f, d: d.update(extensionsRequired={"A": 1})), [], 3, ["extensionsRequired is an object"]),
    ("normalized_string", edited(lambda f, d: d["accessors"][2].update(normalized="no")), [], 3, ["accessors[2].normalized is a string"]),
    ("joints_of_strings", edited(lambda f, d: d["skins"][0].update(joints=["1", "2"])), [], 3, ["skins[0].joints[0] is a string"]),
    ("attribute_string", edited(lambda f, d: d["meshes"][0]["primitives"][0]["attributes"].update(POSITION="0")), [], 3,
     ["meshes[0].primitives[0].attributes.POSITION is a string"]),
    ("target_list", edited(lambda f, d: d["animations"][0]["channels"][0].update(target=[])), [], 3, ["animations[0].channels[0].target is an array"]),
    ("sparse_twice", sparse_indices(3, 3), [], 3, ["sparse indices do not increase (got 3 after 3)"]),
    ("sparse_back", sparse_indices(9, 3), [], 3, ["sparse indices do not increase (got 3 after 9)"]),
    # Files and their bytes.
    ("buffer_longer", external(after=b"more"), [], 0, [], "plain"),
    ("data_uri", external(uri="data:application/octet-stream;base64,"), [], 0, [], "plain"),
    ("data_uri_gltf", external(uri="data:application/gltf-buffer;base64,"), [], 0, [], "plain"),
    ("data_uri_bare", external(uri="data:;base64,"), [], 3, ['buffers[0].uri begins with "data:;base64,"']),
    ("data_uri_capitals", external(uri="DATA:application/octet-stream;base64,"), [], 3, ['buffers[0].uri begins with "DATA:']),
    ("fbx", foreign(b"Kaydara FBX Binary  "), [], 3, ["this is an FBX file"]),
    ("blend", foreign(b"BLENDER-v402"), [], 3, ["this is a Blender file"]),
    ("gzip", foreign(b"\x1f\x8b\x08"), [], 3, ["this is compressed by gzip"]),
    ("utf_16", foreign(b"\xff\xfe{"), [], 3, ["this is text in UTF-16"]),
    ("lfs", foreign(b"version https://git-lfs.github.com/spec/v1"), [], 3, ["this is a pointer of Git LFS"]),
    ("buffer_without_uri", room_without_bytes, [], 0, [], "plain"),
    # Which meshes are in.
    ("second_scene", edited(second_scene), [], 0, ["not in the default scene", "sword"], "plain"),
    ("transparent", edited(transparent_hull), [], 0, ["alpha 0", '--without "hull"']),
    ("transparent_without", edited(transparent_hull), ["--without", "hull"], 0, []),
    ("hidden", second_body("hull", extensions={"KHR_node_visibility": {"visible": False}}), [], 0, ["hidden by KHR_node_visibility", "hull"], "plain"),
    ("hidden_parent", edited(hidden_parent), [], 0, ["hidden by KHR_node_visibility", "hull"], "plain"),
    ("lod1", second_body("body_LOD1"), [], 0, ["lower level of detail", "body_LOD1"], "plain"),
    ("lod2_lower_case", second_body("body.lod2"), [], 0, ["lower level of detail", "body.lod2"], "plain"),
    ("copy", second_body("copy"), [], 0, ["coincide on"]),
    ("copy_without", second_body("copy"), ["--without", "copy"], 0, []),
    *[(f"outline_{name}", pushed_copy(push, **how), [], 0, words) for name, push, how, words in (
        ("hull", 0.01, {}, OUTLINE), ("hull_open", 0.01, {"is_open": True}, OUTLINE), ("hull_thin", 0.002, {}, OUTLINE),
        ("primitive", 0.01, {"primitive": True}, ['primitive 1 of node "body" closely surrounds', "of primitive 0", "remove it from the mesh"]),
        ("outside", 0.01, {"inside": False}, ['nodes "body" and "outline" coincide on', '--without "outline"']))],
    # Both sides of a sheet, as some exporters write two-sided cloth. Rays begin beyond it.
    ("outline_sheet", pushed_copy(0), [], 0, [], "plain"),
    ("outline_far", pushed_copy(0.2), [], 0, ["is inside out"]),
    ("outline_without", pushed_copy(0.01), ["--without", "outline"], 0, []),
    ("instances", edited(instances), [], 0, []),
    # Mirrored rigs.
    *[(f"{name}{'' if has else '_no_normals'}", mirrored(normals=has, **how), [], 0, [], "plain") for has in (True, False)
      for name, how in {
          "mirrored_armature": {"positions": True, "corners": True, "armature": True},
          "mirrored_armature_blender": {"corners": True, "matrices": True, "armature": True},
          "mirrored_root": {"matrices": True, "root": True},
          "mirrored_root_and_mesh": {"positions": True, "corners": True, "root": True}}.items()],
    ("mirrored_object_blender", mirrored(corners=True, normals=True), [], 0, [], "plain"),
    ("mirrored_object_no_normals", mirrored(corners=True), [], 0, INSIDE_OUT),
    # Names of files.
    ("percent_bare", buffer_in("100%.bin", "100%.bin"), [], 0, [], "plain"),
    ("percent_space", buffer_in("a%20b.bin", "a b.bin"), [], 0, []),
    ("plus", buffer_in("a+b.bin", "a+b.bin"), [], 0, []),
    ("link_out", buffer_in("link.bin", "../outside.bin", ("link.bin", "../outside.bin")), [], 3, ["a link that leads outside", OUTSIDE]),
    ("link_out_allowed", buffer_in("link.bin", "../outside.bin", ("link.bin", "../outside.bin")), [OUTSIDE], 0, []),
    ("folder_out", buffer_in("up/outside.bin", "../outside.bin", ("up", "..")), [], 3, ["a link that leads outside"]),
    ("link_inside", buffer_in("link.bin", "real.bin", ("link.bin", "real.bin")), [], 0, []),
    ("dots", buffer_in("../outside.bin", "../outside.bin"), [], 3, ["outside the folder of this file"]),
    ("dots_encoded", buffer_in("%2e%2e/outside.bin", "../outside.bin"), [], 3, ["outside the folder of this file"]),
    ("dots_allowed", buffer_in("../outside.bin", "../outside.bin"), [OUTSIDE], 0, []),
    ("absolute", buffer_in("/etc/hostname", "x.bin"), [], 3, ["outside the folder of this file"]),
    # Time: with a quadratic stage, this one takes hours.
    ("unused_vertices", unused_vertices(1_000_000), [], 0, []),
]


def refused(text):
    """`nook inspect` also lists files that a bake of a character refuses, and tells why."""
    return "cannot be baked as a character: " in text


def difference_of_ao(compare, given, plain):
    run = subprocess.run([compare, str(given), str(plain)], capture_output=True, text=True, timeout=120)
    if run.returncode != 0:
        return float("inf"), run.stderr.strip()
    difference, mean = map(float, run.stdout.split())
    return difference, f"the AO differs by {difference:.6f} from a mean of {mean:.6f}"


def main():
    folder, tool, compare = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
    folder.mkdir(parents=True, exist_ok=True)
    faults, path_of, compared = [], {}, 0
    for name, make, options, code, words, *plain in CASES:
        path = path_of[name] = folder / make(folder, name)
        run = subprocess.run([tool, "inspect", str(path), *options], capture_output=True, text=True, timeout=120,
                             env={**os.environ, "LC_ALL": "C"})
        got = 3 if run.returncode == 0 and refused(run.stderr) else run.returncode
        missing = [word for word in words if word not in run.stderr]
        too_much = not words and run.stderr.strip()
        if got != code or missing or too_much:
            faults.append(f"{name}: exit code {got} (need {code}), missing {missing}\n{run.stderr.strip()}")
        # The same rays from the same places: only those that graze an edge may differ. compare_ao takes no options.
        if plain and not options:
            difference, text = difference_of_ao(compare, path, path_of[plain[0]])
            compared += 1
            if not difference <= 1e-3:
                faults.append(f"{name} beside {plain[0]}: {text}")
    print("\n".join(faults) or f"{len(CASES)} cases are as the table says, {compared} of them with equal AO")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
