"""Writes input files, so that reports need no assets: maps, measured images, meshes, a list of views."""
import base64
import json
import math
import struct


def write_sky(path):
    """A sky with a sun over a dark ground, 64 x 32 texels, as uncompressed RGBE."""
    width, height = 64, 32
    texels = bytearray()
    for y in range(height):
        for x in range(width):
            sky = 1.5 - y / height if y < height // 2 else 0.2
            sun = 80.0 if (x, y) in ((12, 6), (13, 6), (12, 7)) else 0.0
            rgb = (0.8 * sky + sun, 0.9 * sky + sun, sky + 0.8 * sun + 0.3 * (x / width))
            mantissa, exponent = math.frexp(max(rgb))
            texels += bytes(int(c * mantissa * 256 / max(rgb)) for c in rgb) + bytes([exponent + 128])
    path.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width) + bytes(texels))


def write_ppm(path, width, height, colour):
    """colour(x, y) is red, green and blue from 0 to 255."""
    texels = bytes(min(255, max(0, round(c))) for y in range(height) for x in range(width) for c in colour(x, y))
    path.write_bytes(b"P6\n%d %d\n255\n" % (width, height) + texels)


def write_mounds(folder):
    """The maps of a physically based material: coloured mounds, some of them metal."""
    folder.mkdir(exist_ok=True)
    side = 16
    wave = lambda x, y: math.sin(2 * math.pi * (x + 0.5) / side) * math.cos(2 * math.pi * (y + 0.5) / side)
    grey = lambda value: (value, value, value)
    write_ppm(folder / "mounds_albedo.ppm", side, side, lambda x, y: (150 + 60 * wave(x, y), 120, 90 - 40 * wave(x, y)))
    write_ppm(folder / "mounds_roughness.ppm", side, side, lambda x, y: grey(140 + 80 * wave(y, x)))
    write_ppm(folder / "mounds_metalness.ppm", side, side, lambda x, y: grey(255 if x > 11 and y > 11 else 0))
    write_ppm(folder / "mounds_height.ppm", side, side, lambda x, y: grey(128 + 90 * wave(x, y)))


def write_measured(folder):
    """Images of a measured material by the names of UBO 2003: 9 lights, 9 views, 8 x 8 texels."""
    folder.mkdir(exist_ok=True)
    directions = [(0, 0), *((30, a) for a in range(0, 360, 120)), *((60, a) for a in range(0, 360, 72))]
    for number, (light_tilt, light_angle) in enumerate(directions):
        for view_tilt, view_angle in directions:
            bright = 220 * math.cos(math.radians(light_tilt))
            turn = math.radians(view_angle - light_angle)
            shine = 30 * math.cos(turn) * math.sin(math.radians(view_tilt))
            name = f"{number:05}_tl{light_tilt:03}_pl{light_angle:03}_tv{view_tilt:03}_pv{view_angle:03}.ppm"
            write_ppm(folder / name, 8, 8, lambda x, y: (bright * (0.6 + 0.05 * x), bright * 0.5 + shine, 20 * y + shine))


def write_gltf(path, triangles, **vectors):
    """A mesh with its attributes, such as POSITION, as lists of tuples."""
    parts, views, accessors = [], [], []

    def add(rows, form, component, kind):
        data = b"".join(struct.pack(f"<{len(row)}{form}", *row) for row in rows)
        views.append({"buffer": 0, "byteOffset": sum(map(len, parts)), "byteLength": len(data)})
        parts.append(data + bytes(-len(data) % 4))
        count = len(rows) * (3 if kind == "SCALAR" else 1)
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": count, "type": kind})
        return len(accessors) - 1

    attributes = {name: add(rows, "f", 5126, f"VEC{len(rows[0])}") for name, rows in vectors.items()}
    for bound in (min, max):
        accessors[attributes["POSITION"]][bound.__name__] = [bound(axis) for axis in zip(*vectors["POSITION"])]
    indices = add(triangles, "H", 5123, "SCALAR")
    data = b"".join(parts)
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": indices}]}],
        "buffers": [{"byteLength": len(data),
                     "uri": f"data:application/octet-stream;base64,{base64.b64encode(data).decode()}"}],
        "bufferViews": views, "accessors": accessors}))


def write_tile(path):
    """A pyramid with its base at y = 0 that fills most of a tile of 1 m: a closed mesh, y up."""
    corners = [(0.1, 0, 0.1), (0.9, 0, 0.1), (0.9, 0, 0.9), (0.1, 0, 0.9), (0.5, 0.3, 0.5)]
    write_gltf(path, [(0, 1, 2), (0, 2, 3), (1, 0, 4), (2, 1, 4), (3, 2, 4), (0, 3, 4)], POSITION=corners)


def write_hills(path):
    """Hills with texture coordinates, 20 x 20 vertices, that shade each other."""
    side, height = 20, 0.15
    places = [(x / (side - 1), z / (side - 1)) for z in range(side) for x in range(side)]
    position, normal = [], []
    for u, v in places:
        position.append((u - 0.5, height * math.sin(9 * u) * math.sin(9 * v), v - 0.5))
        slope = (-9 * height * math.cos(9 * u) * math.sin(9 * v), 1, -9 * height * math.sin(9 * u) * math.cos(9 * v))
        normal.append(tuple(c / math.hypot(*slope) for c in slope))
    corners = [z * side + x for z in range(side - 1) for x in range(side - 1)]
    write_gltf(path, [t for i in corners for t in ((i, i + side, i + 1), (i + 1, i + side, i + side + 1))],
               POSITION=position, NORMAL=normal, TEXCOORD_0=places)


def write_views(path, scene):
    """A list for --views: one scene, two cameras."""
    cameras = [{"name": "front", "eye": [0, 1.2, 2.5], "target": [0, 0.9, 0], "fov": 50},
               {"name": "feet", "eye": [0.6, 0.4, 0.9], "target": [0, 0.1, 0], "fov": 60, "radius": 0.25}]
    path.write_text(json.dumps({
        "size": "96x64", "rays": 16, "ratios": ["nnao:16,gtao:16", "nnao:9,hbao:16"],
        "sources": [{"name": "body", "scenes": [{"name": scene, "radius": 0.5, "cameras": cameras}]}]}))


def write_all(files, mannequin):
    """Writes every input into the folder; mannequin(path) writes the built-in character."""
    if not (files / "mannequin.glb").exists():
        mannequin(files / "mannequin.glb")
    write_sky(files / "sky.hdr")
    write_mounds(files / "mounds")
    write_measured(files / "measured")
    write_tile(files / "tile.gltf")
    write_hills(files / "hills.gltf")
    write_views(files / "views.json", "mannequin")
