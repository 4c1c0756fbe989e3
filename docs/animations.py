#!/usr/bin/env python3
"""Makes the animations of the documents, docs/*.webp, from pictures that programs of a build draw.

  animations.py BUILD [NAME ...]      makes the animations with these names, or all of them

BUILD is a build folder that was configured with -DNOOK_LAB=ON. The programs that draw need no display. Their pictures are kept in
BUILD/animations, and a picture that is already there is not drawn again. The script needs the Debian packages python3-pil and
fonts-dejavu-core.
"""
import pathlib
import subprocess
import sys

from PIL import Image, ImageDraw, ImageFont

DOCS = pathlib.Path(__file__).resolve().parent
ROOT = DOCS.parent
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"
MAX_BYTES = 2_000_000
MODEL = "samples/minimal/mannequin.nook"
KINDS = (("off", "No occlusion"), ("nook", "Nook"), ("traced", "Ray traced"))


def run(build, folder, last, *command):
    """Draws pictures into a folder, unless the last of them is there."""
    if (folder / last).exists():
        return
    folder.mkdir(parents=True, exist_ok=True)
    print("$", *command, "--out", folder, flush=True)
    subprocess.run([str(build / command[0]), *map(str, command[1:]), "--quiet", "--out", str(folder)], check=True, cwd=ROOT)


def font(size_px):
    return ImageFont.truetype(FONT, size_px)


def label(picture, x, y, words, size_px=20):
    """Writes white words on a dark plate; x and y are the plate's corner."""
    draw = ImageDraw.Draw(picture, "RGBA")
    left, _, right, _ = draw.textbbox((0, 0), words, font=font(size_px))
    # All plates are equally high, whatever the letters.
    _, top, _, bottom = draw.textbbox((0, 0), "Ay", font=font(size_px))
    pad = size_px // 3
    draw.rounded_rectangle((x, y, x + right - left + 2 * pad, y + bottom - top + 2 * pad), pad, fill=(20, 24, 30, 200))
    draw.text((x + pad - left, y + pad - top), words, font=font(size_px), fill=(255, 255, 255, 255))


def side_by_side(pictures, gap_px=4):
    width, height = pictures[0].size
    row = Image.new("RGB", (len(pictures) * (width + gap_px) - gap_px, height), "white")
    for i, picture in enumerate(pictures):
        row.paste(picture, (i * (width + gap_px), 0))
    return row


def save(name, frames, frame_ms):
    """Writes the animation with the best quality that MAX_BYTES leaves."""
    path = DOCS / f"{name}.webp"
    for quality in (88, 82, 76, 70, 64, 58, 50):
        frames[0].save(path, save_all=True, append_images=frames[1:], duration=frame_ms, loop=0, quality=quality, method=4,
                       minimize_size=False)
        if path.stat().st_size <= MAX_BYTES:
            break
    else:
        sys.exit(f"{path} is larger than {MAX_BYTES} bytes: draw fewer or smaller frames")
    print(f"{path.relative_to(ROOT)}: {len(frames)} frames of {frames[0].width} x {frames[0].height}, quality {quality}, "
          f"{path.stat().st_size / 1e6:.2f} MB", flush=True)


def stacked(pictures, gap_px=4):
    width = pictures[0].width
    column = Image.new("RGB", (width, sum(p.height + gap_px for p in pictures) - gap_px), "white")
    y = 0
    for picture in pictures:
        column.paste(picture, (0, y))
        y += picture.height + gap_px
    return column


def motion(build, name, scene, shots, count, loop_ms):
    """A few moving bodies three times: without occlusion, with Nook, ray traced. The shots are put below each other."""
    folder = build / "animations" / scene
    run(build, folder, f"traced_body_{count - 1:04}.png", "bakers/lab/crowd/nook-lab-motion", MODEL, "--scene", scene,
        "--frames", count, "--width", 432, "--rays", 24)
    frames = []
    for i in range(count):
        columns = [stacked([Image.open(folder / f"{kind}_{shot}_{i:04}.png").convert("RGB") for shot in shots]) for kind, _ in KINDS]
        for column, (_, words) in zip(columns, KINDS):
            label(column, 6, 5, words)
        frames.append(side_by_side(columns))
    save(name, frames, round(loop_ms / count))


ANIMATIONS = {
    # One cycle of the clip takes 1.1 s.
    "motion_walk": lambda build: motion(build, "motion_walk", "walk", ("body", "detail"), 14, 1100),
    "motion_feet": lambda build: motion(build, "motion_feet", "walk", ("detail",), 14, 1100),
}


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    build = pathlib.Path(sys.argv[1]).resolve()
    names = sys.argv[2:] or list(ANIMATIONS)
    for name in names:
        if name not in ANIMATIONS:
            sys.exit(f"animations.py: there is no animation {name}; there are {', '.join(ANIMATIONS)}")
    for name in names:
        ANIMATIONS[name](build)


if __name__ == "__main__":
    main()
