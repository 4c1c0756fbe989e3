"""Compares a raw material that packaging/blender/render_material.py has rendered with the closed form of its scene.

  blender -b --factory-startup --python render_material_test.py -- --scene SCENE.blend      writes the scene
  render_material_test.py TILE.raw                                                          compares, with numpy alone

Two matt plates meet at half of the tile, 0.25 m above the plane of its texels: what a view sees at x lies at
x + 0.25 view.x / view.z, under an irradiance of light.z. A strip between 3/4 and 1 of the tile is open.
"""
import pathlib
import struct
import sys

import numpy

LIFT, COLOURS = 0.25, ((0.8, 0.4, 0.2), (0.1, 0.2, 0.3))


def write_scene(path):
    import bpy
    for thing in list(bpy.data.objects):
        if thing.type == "MESH":
            bpy.data.objects.remove(thing)
    for i, (low, high) in enumerate(((0, 0.5), (0.5, 0.75))):
        mesh = bpy.data.meshes.new("plate")
        mesh.from_pydata([(low, 0, LIFT), (high, 0, LIFT), (high, 1, LIFT), (low, 1, LIFT)], [], [(0, 1, 2, 3)])
        material = bpy.data.materials.new("matt")
        material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        nodes.clear()
        diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
        diffuse.inputs["Color"].default_value = (*COLOURS[i], 1)
        links.new(diffuse.outputs[0], output.inputs["Surface"])
        mesh.materials.append(material)
        bpy.context.scene.collection.objects.link(bpy.data.objects.new("plate", mesh))
    bpy.ops.wm.save_as_mainfile(filepath=path)


def read_raw(path):
    data = pathlib.Path(path).read_bytes()
    sections = {}
    for at in range(40, 40 + 24 * 4, 24):
        name, _, offset, size = struct.unpack_from("<4sIQQ", data, at)
        sections[name] = data[offset:offset + size]
    lights, views, width, height, _, _ = struct.unpack_from("<6I", sections[b"HEAD"])
    directions = numpy.frombuffer(sections[b"DIRS"], "<f4").reshape(-1, 3)
    radiance = numpy.frombuffer(sections[b"BTF_"], "<f2").reshape(lights, 3, views, width, height).astype(float)
    bits = numpy.unpackbits(numpy.frombuffer(sections[b"MASK"], numpy.uint8), bitorder="little")
    return directions[:lights], directions[lights:], radiance, bits[:views * width * height].reshape(views, width, height)


def compare(path):
    lights, views, radiance, mask = read_raw(path)
    width = radiance.shape[3]
    compared = 0
    for v, view in enumerate(views):
        # Both borders of each texel, where they meet the plates; texels with an edge inside are left out.
        low = (numpy.arange(width) / width + LIFT * view[0] / view[2]) % 1
        part = numpy.digitize(low, (0.5, 0.75))
        whole = part == numpy.digitize((low + 1 / width - 2e-3) % 1, (0.5, 0.75))
        whole &= part == numpy.digitize((low + 2e-3) % 1, (0.5, 0.75))
        for x in numpy.flatnonzero(whole):
            met = part[x] < 2
            assert numpy.all(mask[v, x] == met), f"view {v}: the mask at {x} is {mask[v, x]}, need {met}"
            if not met:
                continue
            for j, light in enumerate(lights):
                wanted = numpy.array(COLOURS[part[x]]) * light[2] / numpy.pi
                seen = radiance[j, :, v, x]
                # Half floats have 11 bits; light between the plates is none.
                assert numpy.allclose(seen, wanted[:, None], rtol=2e-3, atol=1e-5), (v, j, x, seen[:, 0], wanted)
                compared += seen[0].size
    print(f"render_material.py agrees with its closed form in {compared} texels")


if __name__ == "__main__":
    if "--scene" in sys.argv:
        write_scene(sys.argv[-1])
    else:
        compare(sys.argv[1])
