#!/usr/bin/env python3
"""Draws what pictures of the documentation need beside the built-in scenes: draw_test_pictures.py DIR

ramps.hdr        saturated colours, one row each, doubled ten times from left to right
lights.hdr       three equal lights of one pixel on black
lamps.hdr        lamps and a sign of whole pixels over a dim ground
star-filter.png  a regular grid of wires, as an occluder
scratches.png    a scratched front element
"""

import math
import pathlib
import random
import struct
import sys
import zlib


def write_png(path, width, height, value):
    """value(x, y): grey, 0 to 1."""
    rows = b"".join(
        b"\0" + bytes(round(255 * value(x, y)) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def write_hdr(path, width, height, rgb):
    """rgb(x, y): linear, in the shared-exponent format of Radiance."""
    pixels = bytearray()
    for y in range(height):
        for x in range(width):
            color = rgb(x, y)
            largest = max(color)
            if largest < 1e-30:
                pixels += b"\0\0\0\0"
                continue
            exponent = math.frexp(largest)[1]
            scale = 256 / 2.0**exponent
            pixels += bytes(min(255, int(c * scale)) for c in color) + bytes([exponent + 128])
    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
    path.write_bytes(head.encode() + bytes(pixels))


def ramps(path):
    colors = [(1, 0, 0), (1, 0.25, 0), (1, 1, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1), (0.5, 0, 1),
              (1, 0.5, 0.5)]
    cell, steps = 56, 11

    def rgb(x, y):
        stops = x // cell - 5
        return [2.0**stops * c for c in colors[y // cell]]

    write_hdr(path, cell * steps, cell * len(colors), rgb)


def lights(path):
    write_hdr(path, 822, 270,
              lambda x, y: (3e4, 3e4, 3e4) if y == 135 and x in (137, 411, 685) else (0, 0, 0))


def lamps(path):
    width, height = 640, 360
    discs = [(100, 75, 11, (900, 700, 400)), (302, 243, 16, (500, 550, 600)),
             (475, 103, 6, (1200, 1200, 1200))]

    def rgb(x, y):
        for left, top, radius, color in discs:
            if math.hypot(x - left, y - top) < radius:
                return color
        if abs(3 * (y - 275) - (x - 512)) < 37 and abs(x - 512) < 75:
            return (80, 20, 20)
        return (0.02, 0.02, 0.02)

    write_hdr(path, width, height, rgb)


def star_filter(path):
    write_png(path, 2048, 2048, lambda x, y: 0 if x % 8 < 1 or y % 8 < 1 else 1)


def scratches(path):
    size = 1024
    lines = random.Random(4)
    marks = []
    for _ in range(14):
        angle = math.radians(lines.gauss(25, 12))
        x, y, half = lines.uniform(0, size), lines.uniform(0, size), lines.uniform(150, 500)
        marks.append((x, y, math.cos(angle), math.sin(angle), half, lines.uniform(1, 2.5)))

    def value(px, py):
        for x, y, c, s, half, width in marks:
            along = (px - x) * c + (py - y) * s
            across = (py - y) * c - (px - x) * s
            if abs(along) < half and abs(across) < width:
                return 0
        return 1

    write_png(path, size, size, value)


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    ramps(folder / "ramps.hdr")
    lights(folder / "lights.hdr")
    lamps(folder / "lamps.hdr")
    star_filter(folder / "star-filter.png")
    scratches(folder / "scratches.png")


if __name__ == "__main__":
    main()
