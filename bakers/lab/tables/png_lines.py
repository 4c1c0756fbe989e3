"""Reads and writes PNG pictures as lines of RGB pixels with 8 bits per channel, without a library."""
import pathlib
import struct
import sys
import zlib

DOCS = pathlib.Path(__file__).resolve().parents[3] / "docs"


def unfilter(kind, line, above, step):
    """Decodes the filtered bytes of a line of pixels in place (section 9 of the PNG specification)."""
    for i in range(len(line)):
        a = line[i - step] if i >= step else 0
        b = above[i]
        c = above[i - step] if i >= step else 0
        if kind == 1:
            line[i] = (line[i] + a) & 255
        elif kind == 2:
            line[i] = (line[i] + b) & 255
        elif kind == 3:
            line[i] = (line[i] + (a + b) // 2) & 255
        elif kind == 4:
            p = a + b - c
            nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            line[i] = (line[i] + nearest) & 255
    return line


def read(path):
    """Returns the lines of an RGB picture with 8 bits per channel."""
    data = path.read_bytes()
    at, packed, width = 8, b"", 0
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, _, bits, colour, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            if (bits, colour, interlaced) != (8, 2, 0):
                sys.exit(f"{path} is not a plain RGB picture")
        elif kind == b"IDAT":
            packed += body
        at += 12 + size
    raw, pitch = zlib.decompress(packed), 3 * width + 1
    lines = [bytearray(3 * width)]
    for start in range(0, len(raw), pitch):
        lines.append(unfilter(raw[start], bytearray(raw[start + 1:start + pitch]), lines[-1], 3))
    return width, lines[1:]


def write(path, width, lines):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    # Each line is stored as the difference from the line above.
    above, rows = bytes(3 * width), []
    for line in lines:
        rows.append(b"\2" + bytes((x - y) & 255 for x, y in zip(line, above)))
        above = line
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(lines), 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b""))
