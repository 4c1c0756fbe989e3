#!/usr/bin/env python3
"""Writes the drawings of docs/concepts.md and ARCHITECTURE.md, docs/drawing_*.svg.

With --check nothing is written; drawings that differ from what this script gives are named, and the exit code is 1.
Each drawing has a white ground of its own, so that it reads on dark pages too.
"""
import math
import pathlib
import sys

DOCS = pathlib.Path(__file__).resolve().parent
INK, GREY, BLUE, RED, GREEN, PALE = "#222", "#777", "#1f6fb2", "#b5401f", "#2c7d3f", "#e8eef5"


class Drawing:
    def __init__(self, width, height, title):
        self.width, self.height, self.title, self.parts = width, height, title, []

    def add(self, part):
        self.parts.append(part)

    def text(self, x, y, words, size=14, colour=INK, anchor="middle"):
        lines = words.split("\n")
        for i, line in enumerate(lines):
            line = line.replace("&", "&amp;").replace("<", "&lt;")
            self.add(f'<text x="{x:.1f}" y="{y + i * size * 1.25:.1f}" font-size="{size}" fill="{colour}" '
                     f'text-anchor="{anchor}">{line}</text>')

    def line(self, x1, y1, x2, y2, colour=INK, width=1.5, dash="", arrow=False):
        end = f' marker-end="url(#arrow{colour[1:]})"' if arrow else ""
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
                 f'stroke-width="{width}"{dashes}{end}/>')

    def circle(self, x, y, r, colour=INK, fill="none", opacity=1.0, width=1.5, dash=""):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r:.1f}" stroke="{colour}" stroke-width="{width}" fill="{fill}" '
                 f'fill-opacity="{opacity}"{dashes}/>')

    def box(self, x, y, width, height, words, fill=PALE, colour="#456", size=13):
        self.add(f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="8" fill="{fill}" stroke="{colour}" '
                 'stroke-width="1.5"/>')
        lines = words.split("\n")
        self.text(x + width / 2, y + height / 2 + size * 0.35 - (len(lines) - 1) * size * 0.625, words, size)

    def path(self, points, colour=INK, width=1.5, fill="none", opacity=1.0, closed=False, dash=""):
        steps = " ".join(f"{'M' if i == 0 else 'L'}{x:.1f} {y:.1f}" for i, (x, y) in enumerate(points))
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(f'<path d="{steps}{" Z" if closed else ""}" stroke="{colour}" stroke-width="{width}" fill="{fill}" '
                 f'fill-opacity="{opacity}" stroke-linejoin="round"{dashes}/>')

    def capsule(self, x1, y1, r1, x2, y2, r2, fill="#f1ece4", colour="#b8a98f"):
        """The outline of a limb: the hull of two discs."""
        length = math.hypot(x2 - x1, y2 - y1)
        along, lean = math.atan2(y2 - y1, x2 - x1), math.acos((r1 - r2) / length)
        points = []
        for i in range(25):
            a = along + lean + (2 * math.pi - 2 * lean) * i / 24
            points.append((x1 + r1 * math.cos(a), y1 + r1 * math.sin(a)))
        for i in range(25):
            a = along - lean + 2 * lean * i / 24
            points.append((x2 + r2 * math.cos(a), y2 + r2 * math.sin(a)))
        self.path(points, colour, 1.5, fill, 1.0, True)

    def svg(self):
        arrows = "".join(f'<marker id="arrow{c[1:]}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" '
                         f'orient="auto"><path d="M0 0 L10 5 L0 10 z" fill="{c}"/></marker>' for c in (INK, GREY, BLUE, RED, GREEN))
        return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" height="{self.height}" '
                f'viewBox="0 0 {self.width} {self.height}" font-family="sans-serif" role="img">\n<title>{self.title}</title>\n'
                f'<defs>{arrows}</defs>\n<rect width="{self.width}" height="{self.height}" rx="10" fill="#fff"/>\n'
                + "\n".join(self.parts) + "\n</svg>\n")


def occlusion():
    """A point of a floor beside a wall: the share of directions that are open."""
    d = Drawing(760, 300, "A point on a floor beside a wall: rays to the sky are open, rays to the wall are blocked")
    d.path([(40, 250), (720, 250)], INK, 2.5)
    d.path([(470, 250), (470, 60), (620, 60), (620, 250)], INK, 2, "#ddd6cb", 1, True)
    px, py, reach = 330, 250, 170
    wall_m = 470 - px
    for i in range(1, 16):
        a = math.pi * i / 16
        dx, dy = math.cos(a), -math.sin(a)
        hit = dx > 0 and wall_m * -dy / dx < 190
        length = wall_m / dx if hit else reach
        d.line(px, py, px + dx * length, py + dy * length, RED if hit else BLUE, 1.6, "", True)
    d.circle(px, py, 5, INK, INK)
    d.text(px, 275, "a point of the floor")
    d.text(545, 160, "wall")
    d.text(120, 70, "open directions", 14, BLUE)
    d.text(400, 45, "blocked directions", 14, RED)
    d.text(690, 110, "AO = open share,\ndirections near\nthe normal count\nmore", 13, INK)
    return d


def character():
    """An arm beside a torso: proxy spheres, key points, and the vertex between them."""
    d = Drawing(820, 400, "Two bodies: proxy spheres within the limbs, key points on the skin, and links between bodies")
    d.capsule(150, 110, 48, 150, 330, 62)        # torso
    d.capsule(235, 120, 26, 300, 235, 20)        # upper arm
    d.capsule(300, 235, 19, 262, 340, 14)        # forearm
    spheres = [(150, 125, 34), (150, 195, 38), (150, 265, 42), (150, 330, 40),
               (244, 138, 20), (272, 186, 18), (297, 232, 16), (284, 276, 14), (268, 322, 12)]
    for x, y, r in spheres:
        d.circle(x, y, r, BLUE, BLUE, 0.13, 1.4)
    keys = [(204, 200, 1, -0.1), (209, 262, 1, 0.0), (255, 205, -0.9, 0.35), (275, 270, -1, -0.3)]
    for x, y, nx, ny in keys:
        d.line(x, y, x + 26 * nx, y + 26 * ny, RED, 1.8, "", True)
        d.circle(x, y, 5, RED, RED)
    vx, vy = 207, 231
    for x, y, _, _ in keys[:3]:
        d.line(vx, vy, x, y, GREEN, 1.6, "4 3")
    d.circle(vx, vy, 5.5, GREEN, GREEN)
    d.capsule(610, 95, 46, 610, 330, 58)         # the neighbour
    for y, r in ((115, 32), (185, 36), (255, 38), (325, 38)):
        d.circle(610, y, r, BLUE, BLUE, 0.13, 1.4)
    d.line(550, 175, 330, 175, GREY, 1.6, "6 4", True)
    d.text(440, 160, "link: its spheres darken this body", 13, GREY)
    d.path([(30, 392), (790, 392)], INK, 2)
    d.text(720, 384, "ground", 13)
    d.text(440, 232, "proxy sphere: rides on one bone", 14, BLUE)
    d.text(440, 258, "key point: place and normal,\nblended bones", 14, RED)
    d.text(440, 312, "vertex: mixes the shadows\nof a few key points", 14, GREEN)
    d.text(150, 45, "the character", 14)
    d.text(610, 35, "its neighbour", 14)
    return d


def levels():
    """The steps of a frame, from bones to values at vertices."""
    d = Drawing(860, 190, "Bones place spheres and key points; each key point sums the shadows of all spheres; vertices mix")
    d.box(15, 60, 130, 70, "pose:\n57 matrices")
    d.box(195, 20, 150, 60, "130 spheres\nplaced", "#e3eef8")
    d.box(195, 110, 150, 60, "500 key points\nplaced", "#f9e7e1")
    d.box(410, 60, 190, 70, "shadow at each key point:\nsum over the spheres of\nsize in the sky × facing")
    d.box(660, 60, 185, 70, "AO of each vertex:\n1 − (sum of up to 7\nshadows × weights + β)", "#e5f2e7")
    d.line(145, 85, 193, 55, arrow=True)
    d.line(145, 105, 193, 135, arrow=True)
    d.line(345, 55, 408, 85, arrow=True)
    d.line(345, 135, 408, 105, arrow=True)
    d.line(600, 95, 658, 95, arrow=True)
    return d


def profile(x):
    """The height of the surface that the camera of `tap` sees, in the drawing's units."""
    if x < 290:
        return 250
    if x < 360:
        return 175
    if x < 560:
        return 250
    return 110


def tap():
    """A row of a depth buffer from the side."""
    d = Drawing(820, 340, "A row of pixels from the side: taps around a pixel see heights above its tangent plane, and nothing behind")
    surface = [(40, 250), (290, 250), (290, 175), (360, 175), (360, 250), (560, 250), (560, 110), (640, 110), (640, 250), (790, 250)]
    d.path(surface, INK, 2.5)
    d.path([(640, 112), (640, 250)], "#bbb", 3, dash="5 5")
    d.text(700, 190, "the camera does not\nsee this side: no tap\nknows what is here", 12, GREY)
    px, py = 455, 250
    for x in (325, 345, 400, 430, 490, 530, 575, 600):
        y = profile(x)
        high = y < 249
        d.line(px, py - 2, x, y, RED if high else GREY, 1.5, "" if high else "3 3")
        d.circle(x, y, 4, RED if high else GREY, "#fff")
    d.circle(px, py, 6, GREEN, GREEN)
    d.line(px, py, px, py - 60, GREEN, 2, "", True)
    d.text(px + 8, py - 66, "normal", 12, GREEN, "start")
    d.line(px - 190, 272, px + 190, 272, BLUE, 1.3)
    d.line(px - 190, 266, px - 190, 278, BLUE, 1.3)
    d.line(px + 190, 266, px + 190, 278, BLUE, 1.3)
    d.text(px, 292, "radius in metres: what is farther away does not darken", 13, BLUE)
    for x in range(60, 790, 28):
        d.add(f'<rect x="{x}" y="22" width="26" height="12" fill="{PALE}" stroke="#9ab"/>')
    d.text(420, 16, "pixels of the depth buffer, seen from above", 12, GREY)
    d.text(180, 120, "a tap above the tangent plane\ndarkens, by its elevation\nand its nearness", 13, RED)
    d.text(180, 215, "a tap on the plane: nothing", 13, GREY)
    d.text(420, 326, "The network gets these elevations and gives one number: the open share of the hemisphere.", 13)
    return d


def lobe_points(cx, cy, axis, sharpness, amplitude, scale):
    points = []
    for i in range(181):
        a = 2 * math.pi * i / 180
        r = scale * amplitude * math.exp(sharpness * (math.cos(a - axis) - 1))
        points.append((cx + r * math.cos(a), cy - r * math.sin(a)))
    return points


def lobes():
    """A probe as lobes, and the share of one lobe that a body takes."""
    d = Drawing(820, 340, "Left: the light around a point as lobes. Right: a sphere in front of the bright lobe takes that lobe's light alone")
    light = [(math.radians(55), 6, 1.0), (math.radians(120), 6, 0.45), (math.radians(185), 6, 0.3),
             (math.radians(250), 6, 0.15), (math.radians(310), 6, 0.25), (math.radians(10), 6, 0.5)]
    for cx, hidden in ((200, False), (560, True)):
        cy = 200
        for axis, sharpness, amplitude in light:
            takes = hidden and abs(axis - light[0][0]) < 0.1
            d.path(lobe_points(cx, cy, axis, sharpness, amplitude, 150), BLUE, 1.4, BLUE, 0.16, True)
            if takes:
                d.path(lobe_points(cx, cy, axis, sharpness, 0.25 * amplitude, 150), RED, 1.6, RED, 0.35, True)
        d.circle(cx, cy, 5, INK, INK)
    ax, ay = 560 + 105 * math.cos(light[0][0]), 200 - 105 * math.sin(light[0][0])
    d.circle(ax, ay, 34, "#b8a98f", "#f1ece4", 0.95)
    d.text(ax, ay + 5, "a body", 12)
    d.line(200 + 150 * math.cos(light[0][0]), 200 - 150 * math.sin(light[0][0]), 335, 60, GREY, 1.2)
    d.text(345, 48, "length: amplitude", 12, GREY)
    d.text(200, 30, "a probe: the light around a point", 14)
    d.text(560, 30, "the same light, one lobe occluded", 14)
    d.text(715, 120, "what is left of\nthe bright lobe", 13, RED)
    d.line(672, 140, 600, 165, RED, 1.2)
    d.text(410, 322, "A lobe has an axis, a sharpness and a colour. AO times a probe darkens all lobes alike; Nook darkens each by what stands before it.", 12)
    return d


def clusters():
    """The way from a pixel's view to its colour in a compressed material."""
    d = Drawing(860, 360, "The hemisphere of view directions in clusters; each cluster has modes; a pixel mixes K clusters by its view")
    cx, cy, radius = 150, 185, 120
    d.circle(cx, cy, radius, GREY)
    colours = ["#8ab6d6", "#e7b08c", "#9cc9a4", "#d7c27a", "#b9a3d0", "#d99aa8", "#8fc7c2"]
    centres = [(0.0, 0.0)] + [(0.62 * math.cos(2 * math.pi * i / 6), 0.62 * math.sin(2 * math.pi * i / 6)) for i in range(6)]
    views = []
    for n in range(100):
        r, a = math.sqrt((n + 0.5) / 100), n * 2.39996
        views.append((r * math.cos(a), r * math.sin(a)))
    for x, y in views:
        nearest = min(range(7), key=lambda c: (x - centres[c][0]) ** 2 + (y - centres[c][1]) ** 2)
        d.circle(cx + x * (radius - 8), cy + y * (radius - 8), 5, colours[nearest], colours[nearest], 1.0)
    view = (0.32, -0.20)
    d.circle(cx + view[0] * radius, cy + view[1] * radius, 7, RED, "none", 1, 2.5)
    d.text(cx, 40, "view directions from above:\na colour for each cluster", 13)
    d.text(cx, 330, "the pixel's view", 13, RED)
    d.line(cx + 8, 316, cx + view[0] * radius, cy + view[1] * radius + 8, RED, 1.3)
    chosen = [0, 6, 1]
    for row, cluster in enumerate(chosen):
        y = 80 + row * 78
        d.add(f'<rect x="330" y="{y}" width="52" height="52" rx="6" fill="{colours[cluster]}"/>')
        for m in range(4):
            x = 400 + 42 * m
            d.add(f'<rect x="{x}" y="{y + 9}" width="34" height="34" fill="#fff" stroke="{colours[cluster]}" stroke-width="2"/>')
            for k in range(4):
                tone = 0.5 + 0.5 * math.sin((m + 1) * (k + 1) * 1.7 + cluster)
                shade = int(90 + 140 * tone)
                d.add(f'<rect x="{x + 3 + 14 * (k % 2)}" y="{y + 12 + 14 * (k // 2)}" width="14" height="14" '
                      f'fill="rgb({shade},{shade},{shade})"/>')
        d.text(590, y + 32, "× weight", 13, GREY)
        d.line(630, y + 26, 690, 184, GREY, 1.4, "", True)
    d.text(356, 62, "cluster", 13)
    d.text(482, 62, "its spatial modes", 13)
    d.box(695, 150, 150, 70, "light modes of\nthe pixel: multiply\nby each light", "#e5f2e7")
    d.text(500, 330, "K = 3 clusters of many: a pixel fetches a few texels instead of a hundred pictures.", 13)
    return d


def frame():
    """The life of a frame."""
    d = Drawing(900, 330, "The life of a frame: poses, update, AO of vertices, depth, screen pass, world pass, light")
    y = 40
    for x, words, fill in ((20, "set_pose\nfor each body", PALE), (200, "link_nearest,\nset_camera", PALE),
                           (380, "scene update:\ncull, levels,\nshadows at\nkey points", "#f9e7e1"),
                           (560, "vertex pass:\nmix key points\ninto AO", "#e5f2e7"), (740, "buffer:\na vertex attribute", PALE)):
        d.box(x, y, 140, 84, words, fill)
        if x > 20:
            d.line(x - 40, y + 42, x - 2, y + 42, arrow=True)
    y = 200
    for x, words, fill in ((20, "engine draws\ndepth", "#fff"), (200, "screen pass:\nlinear depth,\nnetwork, filter", "#f9e7e1"),
                           (380, "world pass:\ncasters darken\nwhat depth shows", "#f9e7e1"), (560, "texture: AO of\neverything", PALE),
                           (740, "engine lights:\nambient × AO", "#fff")):
        d.box(x, y, 140, 84, words, fill)
        if x > 20:
            d.line(x - 40, y + 42, x - 2, y + 42, arrow=True)
    d.line(810, 124, 810, 198, arrow=True)
    d.text(450, 318, "White: the engine. Red: arithmetic of Nook. Green: done for each vertex. Blue: what is handed over.", 12, GREY)
    return d


def bake():
    """The life of a bake."""
    d = Drawing(900, 200, "The life of a bake: import, poses, ray tracing, initialisation, fit, file")
    boxes = (("import\nglTF or arrays,\nvalidated", PALE), ("poses:\nautomatic ones\nand clips", PALE),
             ("ray tracing:\nAO of every\nvertex, every pose", "#f9e7e1"), ("initialise:\nspheres and\nkey points", "#e3eef8"),
             ("fit: Adam on\nmini-batches,\ncasters", "#e5f2e7"), ("file: half floats,\nchecksum,\nrecipe", PALE))
    for i, (words, fill) in enumerate(boxes):
        x = 15 + i * 149
        d.box(x, 50, 124, 84, words, fill, size=12)
        if i:
            d.line(x - 25, 92, x - 2, 92, arrow=True)
    d.text(450, 172, "Each step reports progress, can be cancelled, and gives the same bytes for the same seed on any number of threads.", 12, GREY)
    return d


def rooms():
    """The rooms, and what each may include."""
    d = Drawing(860, 400, "Rooms of the repository: arrows point to what a room may include")
    d.box(330, 330, 200, 50, "sdk/src/core\nresults, files, maths", "#e5f2e7")
    for i, name in enumerate(("character", "nnao", "probe", "material", "world", "transfer")):
        d.box(20 + i * 138, 240, 124, 44, "sdk/src/" + name, "#e3eef8", size=12)
        d.line(82 + i * 138, 284, 430, 328, GREY, 1.1, "", True)
    d.box(60, 150, 170, 50, "sdk/src/gl\nOpenGL halves", "#f9e7e1")
    d.box(60, 60, 170, 50, "sdk/src/api\nthe C symbols", PALE)
    d.box(330, 150, 200, 50, "bakers/*\nmake data", PALE)
    d.box(330, 60, 200, 50, "bakers/measure\ntruth and pictures", PALE)
    d.box(610, 60, 120, 50, "bakers/tool\nnook", PALE)
    d.box(740, 60, 110, 50, "bakers/lab\nnook-lab", PALE)
    d.box(610, 150, 200, 50, "samples\npublic headers only", "#fff")
    d.line(145, 110, 145, 148, arrow=True)
    d.line(145, 200, 160, 238, arrow=True)
    d.line(430, 200, 430, 238, arrow=True)
    d.line(430, 110, 430, 148, arrow=True)
    d.line(610, 85, 532, 85, arrow=True)
    d.line(740, 85, 732, 85, arrow=True)
    d.line(330, 85, 232, 165, GREY, 1.3, "5 4", True)
    d.text(285, 110, "draws", 12, GREY)
    d.text(430, 30, "tests/architecture reads every include and fails where an arrow would point upwards", 13, GREY)
    return d


DRAWINGS = {"occlusion": occlusion, "character": character, "levels": levels, "tap": tap, "lobes": lobes, "clusters": clusters,
            "frame": frame, "bake": bake, "rooms": rooms}


def main():
    stale = []
    for name, draw in DRAWINGS.items():
        path, text = DOCS / f"drawing_{name}.svg", draw().svg()
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            stale.append(path.name)
        if "--check" not in sys.argv[1:]:
            path.write_text(text, encoding="utf-8")
    if "--check" in sys.argv[1:] and stale:
        print(f"not what docs/drawings.py gives: {', '.join(stale)}; run it")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
