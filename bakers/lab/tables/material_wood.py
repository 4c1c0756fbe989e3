#!/usr/bin/env python3
"""Writes a wood-like raw material, for `nook bake material --raw` and `nook evaluate material`.

    bakers/lab/tables/material_wood.py wood.raw [--texels 64] [--seed 1] [--views fitted|between]

The material does not have geometry. Each texel has its own colour and consists of fibres under a varnish.
Light that enters the varnish leaves in a diffuse lobe and in the cone of the fibres. The tilt of the fibres
varies from place to place, as in curly maple. Light that does not enter is reflected in a glossy lobe around
the uneven normal of the varnish (S. Marschner and others: Measuring and Modeling the Appearance of Finished
Wood, 2005, equations 1 to 4). The 81 directions are from the measurements of the University of Bonn in 2003:
tilts of 0 to 75 degrees in steps of 15, with 1, 6, 12, 18, 20 and 24 azimuths. With `between`, the same
number of views lies halfway between these azimuths. Use it to measure errors at views that were not fitted.
"""
import argparse
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "packaging/blender"))
import raw_material  # noqa: E402

RINGS = ((0, 1), (15, 6), (30, 12), (45, 18), (60, 20), (75, 24))  # degrees of tilt, azimuths


def directions(shift):
    """Returns x, y, z of the measured directions. Azimuths are shifted by the share `shift` of their
    spacing."""
    found = []
    for tilt, count in RINGS:
        for i in range(count):
            azimuth = 2 * numpy.pi * (i + shift) / count
            z, r = numpy.cos(numpy.radians(tilt)), numpy.sin(numpy.radians(tilt))
            found.append((r * numpy.cos(azimuth), r * numpy.sin(azimuth), z))
    return numpy.array(found, numpy.float32)


def noise(random, side, wide, high, octaves):
    """Returns periodic noise with mean 0 and standard deviation 1. Features have the size 1/wide of a tile
    along x and 1/high along y."""
    u, v = numpy.meshgrid(numpy.fft.fftfreq(side) * side, numpy.fft.fftfreq(side) * side, indexing="ij")
    total = numpy.zeros((side, side))
    for octave in range(octaves):
        scale = 2.0 ** octave
        power = numpy.exp(-0.5 * ((u / (wide * scale)) ** 2 + (v / (high * scale)) ** 2))
        field = numpy.fft.ifft2(numpy.fft.fft2(random.standard_normal((side, side))) * power).real
        total += field / field.std() / scale
    total -= total.mean()
    return total / total.std()


def maps(side, seed):
    """Returns the maps of a tile: colour, tilt and rotation of the fibres, and slopes of the varnish. x is
    along the fibres."""
    random = numpy.random.default_rng(seed)
    figure = noise(random, side, 3, 2, 2)
    grain = noise(random, side, 1, 12, 3)
    pores = numpy.clip(noise(random, side, 3, 24, 1) - 1.3, 0, 1)
    share = 1 / (1 + numpy.exp(-1.5 * grain))
    light, dark = numpy.array([0.62, 0.40, 0.22]), numpy.array([0.36, 0.18, 0.08])
    colour = light * share[..., None] + dark * (1 - share[..., None])
    colour *= (1 - 0.7 * pores)[..., None]
    varnish = noise(random, side, 6, 10, 2)
    return {"colour": colour, "tilt": numpy.radians(9) * figure, "turn": numpy.radians(5) * noise(random, side, 2, 3, 2),
            "slope_x": 0.03 * varnish + 0.1 * (numpy.roll(pores, 1, 0) - numpy.roll(pores, -1, 0)),
            "slope_y": 0.03 * numpy.roll(varnish, 7, 0) + 0.4 * (numpy.roll(pores, 1, 1) - numpy.roll(pores, -1, 1))}


def refracted(d):
    """Returns the refracted direction inside the varnish. The index of refraction is 1.5."""
    inside = d / 1.5
    inside[2] = numpy.sqrt(1 - inside[0] ** 2 - inside[1] ** 2)
    return inside


def entering(z):
    """Returns the share of light that enters: 1 minus Schlick's approximation of the Fresnel reflection."""
    return 1 - (0.04 + 0.96 * (1 - z) ** 5)


def radiance(m, light, view):
    """Returns RGB of all texels for a light of irradiance 1 on a plane that faces it."""
    axis = numpy.stack([numpy.cos(m["tilt"]) * numpy.cos(m["turn"]), numpy.cos(m["tilt"]) * numpy.sin(m["turn"]),
                        numpy.sin(m["tilt"])])
    inside_light, inside_view = refracted(light.astype(float)), refracted(view.astype(float))
    sine_in = numpy.tensordot(inside_light, axis, 1)
    sine_out = numpy.tensordot(inside_view, axis, 1)
    width = numpy.radians(10)
    cone = numpy.exp(-0.5 * ((numpy.arcsin(sine_in) + numpy.arcsin(sine_out)) / width) ** 2)
    half_difference = 0.5 * (numpy.arcsin(sine_in) - numpy.arcsin(sine_out))
    fibres = 0.1 * cone / (width * numpy.sqrt(2 * numpy.pi)) / numpy.maximum(numpy.cos(half_difference), 0.3) ** 2
    through = entering(light[2]) * entering(view[2])
    normal = numpy.stack([-m["slope_x"], -m["slope_y"], numpy.ones_like(m["slope_x"])])
    normal /= numpy.linalg.norm(normal, axis=0)
    half = (light + view) / numpy.linalg.norm(light + view)
    exponent = 60
    gloss = (exponent + 2) / (8 * numpy.pi) * numpy.clip(numpy.tensordot(half, normal, 1), 0, 1) ** exponent
    gloss *= 1 - entering(half @ light)
    return light[2] * (through * (m["colour"] / numpy.pi * 0.8 + fibres[..., None] * m["colour"]) + gloss[..., None])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", help="write the raw material to this file")
    parser.add_argument("--texels", type=int, default=64, help="number of texels along a side of the material; default 64")
    parser.add_argument("--seed", type=int, default=1, help="seed of the random fibres and normals; default 1")
    parser.add_argument("--views", choices=("fitted", "between"), default="fitted",
                        help="which view directions to write: fitted (default, the measured directions) or between (halfway between their azimuths)")
    options = parser.parse_args()
    side = options.texels
    lights, views = directions(0), directions(0.5 if options.views == "between" else 0)
    textures = maps(side, options.seed)
    btf = numpy.empty((len(lights), 3, len(views), side, side), numpy.float16)
    for j, light in enumerate(lights):
        for i, view in enumerate(views):
            btf[j, :, i] = numpy.moveaxis(radiance(textures, light, view), -1, 0)
    raw_material.write(options.output, "wood", lights, views, btf)


if __name__ == "__main__":
    main()
