"""Renders a tile of a Blender scene from many views under many lights, and writes a raw material for `nook bake material --raw`.

    blender -b SCENE.blend --python render_material.py -- TILE.raw [--tile-size 1] [--directions 49] [--texels 48]

The tile is a square on the plane z = 0 (z up), from (0, 0) to (tile size, tile size) in metres. Parts above or below this plane
shift with the view. The script repeats everything that the scene renders around the tile (--repeats). It removes the lights,
the cameras and the world of the scene. It renders with Cycles, with the bounces that the scene sets. It needs raw_material.py in
the same folder.
"""
import argparse
import pathlib
import sys
import tempfile

import bpy
import mathutils
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import raw_material  # noqa: E402


def repeat(scene, tile, repeats):
    """Adds instances of all visible objects around the tile."""
    kinds = {"MESH", "CURVE", "CURVES", "SURFACE", "META", "FONT", "VOLUME", "EMPTY"}
    whole = bpy.data.collections.new("tile")
    for thing in list(scene.objects):
        if thing.type in kinds and not thing.hide_render:
            whole.objects.link(thing)
    for x in range(-repeats, repeats + 1):
        for y in range(-repeats, repeats + 1):
            if x or y:
                copy = bpy.data.objects.new("tile", None)
                copy.instance_type, copy.instance_collection = "COLLECTION", whole
                copy.location = (x * tile, y * tile, 0)
                scene.collection.objects.link(copy)


def remove_lights(scene):
    for thing in list(scene.objects):
        if thing.type in ("LIGHT", "LIGHT_PROBE", "CAMERA"):
            bpy.data.objects.remove(thing)
    scene.world = bpy.data.worlds.new("dark")
    scene.world.color = (0, 0, 0)


def add_sun(scene):
    lamp = bpy.data.lights.new("sun", "SUN")
    lamp.energy, lamp.angle, lamp.color = 1, 0, (1, 1, 1)  # an irradiance of 1
    sun = bpy.data.objects.new("sun", lamp)
    sun.rotation_mode = "QUATERNION"
    scene.collection.objects.link(sun)
    return sun


def add_camera(scene, tile):
    """Adds an orthographic camera whose image plane is z = 0 for every view direction. This needs a shear, which only the
    matrix of a parent object can represent."""
    lens = bpy.data.cameras.new("view")
    lens.type, lens.ortho_scale = "ORTHO", tile
    camera, parent = bpy.data.objects.new("view", lens), bpy.data.objects.new("view", None)
    camera.parent = parent
    for thing in (camera, parent):
        scene.collection.objects.link(thing)
    scene.camera = camera
    return camera


def look_along(camera, view, tile, far):
    lift = far / view[2]
    camera.data.clip_start, camera.data.clip_end = 1e-3 * tile, 2 * lift + tile
    camera.matrix_parent_inverse = mathutils.Matrix((
        (1, 0, view[0], tile / 2 + lift * view[0]),
        (0, 1, view[1], tile / 2 + lift * view[1]),
        (0, 0, view[2], far), (0, 0, 0, 1)))


def set_up(scene, texels, samples):
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 1
    scene.cycles.film_exposure = 1
    render = scene.render
    render.resolution_x = render.resolution_y = texels
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1
    render.film_transparent = render.use_persistent_data = True
    render.use_compositing = render.use_sequencer = render.use_border = False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode, render.image_settings.color_depth = "RGBA", "32"


def rendered(scene, path):
    """Returns an array of 4 x width x height: the colour times the coverage, and the coverage. The coverage is the fraction of the
    texel's area in which the view sees the surface."""
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    pixels = numpy.empty(len(image.pixels), numpy.float32)
    image.pixels.foreach_get(pixels)
    height, width = image.size[1], image.size[0]
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4).transpose(2, 1, 0)


def filled(seen):
    """Returns the colour of the surface, 3 x width x height. Gaps are filled from their border inwards. Each texel of a gap gets
    the mean of its neighbours."""
    colour, share = seen[:3].copy(), seen[3].copy()
    colour /= numpy.maximum(share, 1e-6)
    known = share > 0.02
    while known.any() and not known.all():
        total, count = numpy.zeros_like(colour), numpy.zeros_like(share)
        for axis in (0, 1):
            for step in (-1, 1):
                count += numpy.roll(known, step, axis)
                total += numpy.roll(colour * known, step, axis + 1)
        reached = ~known & (count > 0)
        colour[:, reached] = (total / numpy.maximum(count, 1))[:, reached]
        known |= reached
    return colour if known.all() else numpy.zeros_like(colour)


def read_options():
    parser = argparse.ArgumentParser(prog="render_material.py", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=pathlib.Path, help="write the raw material to this file")
    parser.add_argument("--tile-size", type=float, default=1, help="side of the tile in metres; default 1")
    parser.add_argument("--directions", type=int, default=49, help="number of view directions to render; without --lights, also the number of light directions. Default 49")
    parser.add_argument("--lights", type=int, default=0, help="number of light directions to render; 0 (default) uses the view directions as light directions")
    parser.add_argument("--max-tilt", type=float, default=75, help="largest angle in degrees between the normal (+z) and a view or light direction; default 75")
    parser.add_argument("--texels", type=int, default=48, help="number of texels along a side of the tile; default 48")
    parser.add_argument("--samples", type=int, default=64, help="number of paths per texel that Cycles traces; default 64")
    parser.add_argument("--repeats", type=int, default=1, help="number of copies of the scene on each side of the tile; 0 if the scene already repeats. Default 1")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])


def main():
    options = read_options()
    scene, tile = bpy.context.scene, options.tile_size
    views = raw_material.spiral_directions(options.directions, options.max_tilt)
    lights = raw_material.spiral_directions(options.lights or options.directions, options.max_tilt)
    remove_lights(scene)
    repeat(scene, tile, options.repeats)
    set_up(scene, options.texels, options.samples)
    sun, camera = add_sun(scene), add_camera(scene, tile)
    radiance = numpy.empty((len(lights), 3, len(views), options.texels, options.texels), numpy.float32)
    mask = numpy.empty((len(views), options.texels, options.texels), bool)
    with tempfile.TemporaryDirectory() as folder:
        for i, view in enumerate(views):
            look_along(camera, view, tile, 8 * tile)
            for j, light in enumerate(lights):
                sun.rotation_quaternion = mathutils.Vector(light).to_track_quat("Z", "Y")
                seen = rendered(scene, str(pathlib.Path(folder, "seen.exr")))
                radiance[j, :, i] = filled(seen)
            mask[i] = seen[3] > 0.5
            print(f"render_material.py: view {i + 1} of {len(views)}", flush=True)
    raw_material.write(options.output, options.output.stem, lights, views, radiance, None if mask.all() else mask)


if __name__ == "__main__":
    main()
