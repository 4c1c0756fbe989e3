#!/usr/bin/env python3
"""window_test.py CROWD CHARACTER MODEL: the crowd's window as a person uses it, on virtual displays.

Gives every argument of the program once, and uses every control of the panel once, by mouse or by keys. What the program
draws is read from the display. Set NOOK_WINDOW_PICTURES to a folder to keep what the display showed."""
import mmap
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

crowd, character, model = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
kept_pictures = os.environ.get("NOOK_WINDOW_PICTURES")
# Busy machines draw less than a frame in a second.
PATIENCE_S = 120


class Display:
    """An X server in memory. Its picture lies in a file of the format XWD."""

    def __init__(self, folder, width, height, dots_per_inch=96):
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=folder))
        reading, writing = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{width}x{height}x24", "-fbdir", str(self.folder),
             "-nolisten", "tcp"], pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as answer:
            self.name = ":" + answer.readline().strip()
        self.environment = {**os.environ, "DISPLAY": self.name}
        if dots_per_inch != 96:
            # The resource stays as long as a client does.
            self.x("xrdb", "-nocpp", "-retain", "-merge", "-", text=f"Xft.dpi: {dots_per_inch}\n")
        with open(self.folder / "Xvfb_screen0", "rb") as file:
            self.memory = mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ)
        head = struct.unpack(">25I", self.memory[:100])
        self.width, self.height, self.stride, self.first = head[4], head[5], head[12], head[0] + 12 * head[19]

    def x(self, *command, text=None):
        return subprocess.run(command, env=self.environment, input=text, text=True, check=True,
                              stdout=subprocess.PIPE).stdout

    def pixels(self, left, top, right, bottom):
        rows = (self.first + y * self.stride for y in range(top, bottom))
        return b"".join(self.memory[row + 4 * left:row + 4 * right] for row in rows)

    def keep(self, name):
        """Writes a PNG file of the display."""
        if not kept_pictures:
            return
        rows = b""
        for y in range(self.height):
            bgrx = self.pixels(0, y, self.width, y + 1)
            row = bytearray(3 * self.width)
            row[0::3], row[1::3], row[2::3] = bgrx[2::4], bgrx[1::4], bgrx[0::4]
            rows += b"\0" + bytes(row)

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        head = struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)
        (pathlib.Path(kept_pictures) / f"{name}.png").write_bytes(
            b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))

    def close(self):
        self.server.terminate()
        self.server.wait()


class Window:
    """The program in a window of the size of its display, which shows two characters that hold still."""

    def __init__(self, display, *arguments, scale=1):
        self.display, self.scale = display, scale
        self.out = pathlib.Path(tempfile.mkdtemp(dir=display.folder))
        self.errors = self.out / "errors.txt"
        with open(self.errors, "w") as errors:
            self.program = subprocess.Popen(
                [crowd, "--quiet", "--context", "window", "--size", f"{display.width}x{display.height}", "--characters", "2",
                 "--out", self.out, *arguments], env=display.environment, stderr=errors)
        # The characters stand beside the panel.
        self.scene = (325 * scale, 1, display.width - 1, display.height - 1)
        self.wait(self.has_panel, "the panel comes")
        # The clips play, so that every frame differs.
        everything, times = (0, 0, display.width, display.height), [time.monotonic()]
        for _ in range(4):
            before = self.seen(everything)
            self.wait(lambda: self.seen(everything) != before, "the next frame comes")
            times.append(time.monotonic())
        # On a busy machine, later frames may take longer.
        self.few_frames_s = 0.3 + 4 * sorted(b - a for a, b in zip(times, times[1:]))[-2]

    def wait(self, is_done, what):
        end = time.monotonic() + PATIENCE_S
        while not is_done():
            if self.program.poll() is not None:
                sys.exit(f"the program has ended with {self.program.returncode}, waiting until {what}: "
                         f"{self.errors.read_text()}")
            if time.monotonic() > end:
                self.display.keep("failure")
                sys.exit(f"{PATIENCE_S} s passed, waiting until {what}; the program says: {self.errors.read_text()}")
            time.sleep(0.02)

    def seen(self, region=None):
        return self.display.pixels(*(region or self.scene))

    def settled(self, times=1):
        """The scene once it holds still for a few frames, or a multiple of them."""
        last, since = self.seen(), time.monotonic()

        def holds():
            nonlocal last, since
            now = self.seen()
            if now != last:
                last, since = now, time.monotonic()
            return time.monotonic() - since > times * self.few_frames_s
        self.wait(holds, "the picture holds still")
        return last

    def do(self, *command):
        """Runs xdotool. None waits for a few frames; xdotool's own sleep would hold events back."""
        if None in command:
            at = command.index(None)
            self.do(*command[:at])
            time.sleep(self.few_frames_s)
            return self.do(*command[at + 1:])
        if command:
            self.display.x("xdotool", *[str(word) for word in command])

    def place(self, row, x):
        """Where a control lies: x in pixels at a scale of 1, from the left edge of the panel's controls."""
        top = self.top + 19 + 8 + 23 * row + 9
        return round((self.left + 8 + x) * self.scale), round(top * self.scale)

    left = top = 13  # of the panel

    def until_changed(self, begin, end, what):
        before = self.seen()
        begin()
        self.wait(lambda: self.seen() != before, what)
        end()
        return self.settled()

    def back(self, picture, what):
        self.wait(lambda: self.seen() == picture, f"the picture of before is back: {what}")

    def stop(self):
        """Turns play off, and returns the scene that holds still from then on."""
        self.click(*PLAY, "play is turned off")
        return self.settled(3)

    def click(self, row, x, what):
        self.do("mousemove", *self.place(row, x))
        return self.until_changed(lambda: self.do("click", 1), lambda: None, what)

    def hold(self, key, what):
        return self.until_changed(lambda: self.do("keydown", key), lambda: self.do("keyup", key), what)

    def slider_region(self, row):
        x, y = self.place(row, 2)
        return (x, y - 5, x + 150 * self.scale, y + 5)

    def rest(self):
        """The pointer lies over no control."""
        self.do("mousemove", *self.place(6, 250), None)

    def type_into(self, row, text):
        """Ctrl and a click open a slider for typing, and Return takes the text. A text cursor blinks meanwhile."""
        self.do("mousemove", *self.place(row, 60), "keydown", "ctrl", None, "click", 1, None, "keyup", "ctrl")
        self.do("type", "--", text)
        self.do(None, "keydown", "Return", None, "keyup", "Return")
        return self.settled()

    def drag_slider(self, row):
        self.rest()
        before = self.seen(self.slider_region(row))
        self.do("mousemove", *self.place(row, 100), None, "mousedown", 1, None, "mouseup", 1, None)
        self.rest()
        self.wait(lambda: self.seen(self.slider_region(row)) != before, f"the slider in row {row} moves")

    def pixel(self, x, y):
        return self.display.pixels(x, y, x + 1, y + 1)[:3]

    def title(self):
        """The colour of the panel's title, which is blue where the panel has the keys."""
        return self.pixel(round((self.left + 150) * self.scale), round((self.top + 3) * self.scale))

    def has_panel(self):
        blue, _, red = self.title()
        return blue > 100 and red < 60

    def panel_right(self):
        """The last column of the panel, by the colour of its title."""
        y, title = round((self.top + 3) * self.scale), self.title()
        return max(x for x in range(self.display.width) if self.pixel(x, y) == title)

    def end(self):
        self.program.terminate()
        self.program.wait()
        said = self.errors.read_text()
        assert "OpenGL error" not in said, said
        return said


def differ(a, b, what):
    assert a != b, f"nothing changed: {what}"


BOX = 9
# Check boxes: row, x, name.
boxes = [(0, BOX, "ambient occlusion"), (0, 159, "AO on the floor"), (1, BOX, "self"), (1, 68, "neighbours"),
         (1, 169, "ground"), (5, BOX, "spheres"), (5, 89, "links")]
INTENSITY, NEIGHBOURS, BODIES = 2, 3, 4
PLAY = (5, 155)


def test_controls(display):
    own = display.folder / "model.nook"
    shutil.copy(model, own)
    window = Window(display, character, own)
    still = window.stop()
    display.keep("controls")
    for row, x, name in boxes:
        differ(window.click(row, x, f"{name} is switched"), still, name)
        window.click(row, x, f"{name} is switched back")
        window.back(still, name)
    # Numbers outside a slider's range end at its ends.
    without = window.type_into(INTENSITY, "-5")
    differ(without, still, "an intensity below 0")
    window.type_into(INTENSITY, "7")
    window.back(still, "an intensity above 1")
    window.click(5, BOX, "spheres are shown")
    links = window.click(5, 89, "links are shown")
    window.type_into(NEIGHBOURS, "-3")
    differ(window.settled(), links, "no neighbours")
    window.type_into(NEIGHBOURS, "99")
    window.back(links, "all neighbours")
    window.type_into(BODIES, "5000000")
    differ(window.settled(), links, "spheres of both bodies")
    window.type_into(BODIES, "0")
    window.back(links, "spheres of one body")
    # Sliders by the mouse.
    for row in (INTENSITY, NEIGHBOURS, BODIES):
        window.drag_slider(row)
    # The camera: drag, wheel and keys.
    x, y = display.width - 40, display.height // 2
    window.do("mousemove", x, y, "mousedown", 1, None)
    window.until_changed(lambda: window.do("mousemove", x - 60, y + 30), lambda: window.do("mouseup", 1), "it turns")
    window.until_changed(lambda: window.do("click", 4), lambda: None, "it comes nearer")
    for key in "qedaws":
        window.hold(key, f"the key {key} moves the camera")
    # The first arrow shows where the keys are, and space switches the box there.
    box = window.settled()
    window.do("keydown", "Down", None, "keyup", "Down")
    differ(window.hold("space", "space switches a box"), box, "a box by keys")
    window.hold("space", "space switches it back")
    window.back(box, "a box by keys")
    # A file that does not fit, and the same one again: Nook deletes the buffers of the old model.
    own.write_bytes(b"not a model")
    time.sleep(window.few_frames_s)
    shutil.copy(model, own)
    time.sleep(window.few_frames_s)
    window.back(box, "the model loaded again")
    # The smallest window, and the old size.
    name = display.x("xdotool", "search", "--name", "Nook crowd").split()[0]
    window.do("windowsize", name, 1, 1)
    # New sizes take new passes, whose shaders are compiled.
    time.sleep(3 * window.few_frames_s)
    window.do("windowsize", name, display.width, display.height)
    window.wait(lambda: len(set(window.seen()[::4])) > 16, "the scene is back")
    window.settled()
    display.keep("after_smallest")
    window.left = window.top = 0  # it has moved inside the smallest window
    window.wait(window.has_panel, "the panel lies inside the smallest window")
    window.click(*boxes[0][:2], "the panel is inside the window")
    window.end()


def test_small(display):
    """Messages break into lines, and the panel stays inside a window of 420 pixels."""
    own = display.folder / "model.nook"
    shutil.copy(model, own)
    window = Window(display, character, own)
    # Below the panel, which grows over it.
    window.scene = (21, 240, 300, display.height - 1)
    window.stop()
    before = window.panel_right()
    window.until_changed(lambda: own.write_bytes(b"not a model"), lambda: None, "a message comes")
    display.keep("small")
    assert before == window.panel_right() < display.width - 8, (before, window.panel_right())
    window.end()


def test_high_density(display):
    """Twice the dots to an inch: the panel is twice as large, as the places of its controls tell."""
    window = Window(display, character, model, scale=2)
    still = window.stop()
    display.keep("high_density")
    row, x, name = boxes[0]
    differ(window.click(row, x, f"{name} is switched"), still, name)
    window.end()


def run(environment, *arguments):
    return subprocess.run([crowd, *arguments], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def test_arguments(display):
    """Each argument is given once, and what follows one is not taken for a part of it."""
    folder = display.folder
    pictures = iter(range(100))

    def picture(*arguments):
        file = folder / f"{next(pictures)}.png"
        made = run(display.environment, "--quiet", "--context", "window", "--size", "320x240", "--seed", "3", "--tier", "33",
                   "--window-picture", file, *arguments)
        assert made.returncode == 0, made.stderr
        return file.read_bytes()
    few = ["--characters", "3", "--neighbours", "2"]
    spheres = picture(*few, "--debug-bodies", "2", "--debug", "spheres", character, model)
    both = picture(*few, "--debug-bodies", "2", "--debug=spheres,links", character, model)
    twice = picture(*few, "--debug-bodies", "2", "--debug", "spheres", "--debug", "links", character, model)
    one = picture(*few, "--debug", "spheres", character, model)
    assert len({spheres, both, one}) == 3 and len(both) > 1000 and len(twice) > 1000
    made = run(display.environment, "--context", "egl", "--frames", "2", "--out", folder / "frames", *few, "--size", "64x48",
               "--quiet", character, model)
    assert made.returncode == 0, made.stderr
    assert len(list((folder / "frames").glob("frame_*.png"))) == 2
    refused = run(display.environment, "--debug", "spheres", "bones", "--context", "window")
    assert refused.returncode == 2 and "bones" in refused.stderr, refused.stderr
    given = {"--help", "--context", "--characters", "--neighbours", "--frames", "--size", "--out", "--tier", "--seed",
             "--debug", "--debug-bodies", "--window-picture", "--quiet"}
    told = set(re.findall(r"^ +(?:-h,)?(--[a-z-]+)", run(display.environment, "--help").stdout, re.MULTILINE))
    assert told == given, told ^ given


with tempfile.TemporaryDirectory() as base:
    for test, size in ((test_arguments, (640, 480)), (test_small, (420, 300)), (test_high_density, (1100, 640, 192)),
                       (test_controls, (640, 300))):
        begun = time.monotonic()
        display = Display(base, *size)
        try:
            test(display)
        finally:
            display.close()
        print(f"{test.__name__}: {time.monotonic() - begun:.0f} s", flush=True)
