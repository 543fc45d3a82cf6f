#!/usr/bin/env python3
"""Makes the textures of this folder, byte for byte the same each time: python3 textures/make.py

Nothing but Python's standard library is needed. Every picture has a palette, so that fine weave stays small as a file. Row 0 is the top edge of the cloth, column 0 its left edge, seen from the front.
"""

import math
import pathlib
import struct
import zlib

SIZE = 512   # pixels a side
FINE = 1024  # of what is looked at from near


# ---- pictures as files ----------------------------------------------------------------------------------------------


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_png(path, palette, rows):
    """An 8-bit palette PNG. `rows` are bytes objects of palette indices."""
    height, width = len(rows), len(rows[0])
    body = b"".join(b"\0" + row for row in rows)
    colors = b"".join(bytes(color) for color in palette)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0))
        + chunk(b"PLTE", colors)
        + chunk(b"IDAT", zlib.compress(body, 9))
        + chunk(b"IEND", b"")
    )


def ramp(dark, light, steps):
    """Colors from dark to light, ends included."""
    return [
        tuple(round(a + (b - a) * k / (steps - 1)) for a, b in zip(dark, light)) for k in range(steps)
    ]


def index(shade, steps):
    return min(steps - 1, max(0, int(shade * steps)))


# ---- noise ----------------------------------------------------------------------------------------------------------


def noise(*key):
    """A number in 0 to 1 that depends on the integers given alone, and well mixed."""
    h = 2166136261
    for k in key:
        h = ((h ^ (k & 0xFFFFFFFF)) * 16777619) & 0xFFFFFFFF
        h ^= h >> 15
        h = (h * 0x2C1B3C6D) & 0xFFFFFFFF
        h ^= h >> 12
    h = (h * 0x297A2D39) & 0xFFFFFFFF
    return ((h ^ (h >> 15)) & 0xFFFFFF) / 0xFFFFFF


def smooth_noise(x, *key):
    """Noise along a line, one value a unit, smoothly joined."""
    k = math.floor(x)
    t = x - k
    t = t * t * (3 - 2 * t)
    return noise(k, *key) * (1 - t) + noise(k + 1, *key) * t


def thread_tables(seed, count, wander, length=SIZE):
    """For each thread: its own tone, and how tone wanders along it (in steps of one texel), -1 to 1."""
    tables = []
    for k in range(count):
        own = noise(k, seed) - 0.5
        tables.append([own + (smooth_noise(s / wander + 7 * k, seed + 1, k) - 0.5) for s in range(length)])
    return tables


# ---- the cloths -----------------------------------------------------------------------------------------------------


def fibers(along, across, thread):
    """The twisted fibers of a yarn, -1 to 1: fine lines at a slant, none as bright as the next."""
    strand = math.floor(0.62 * across + 0.30 * along)
    return 2 * noise(strand, thread, 61) - 1


def yarn(along, across, half_length, half_width):
    """Shade of a yarn where it lies on top: 1 on its crown, 0 at the edge of what is seen of it and beyond."""
    inside = 1 - (along / half_length) ** 2 - (across / half_width) ** 2
    return math.sqrt(inside) if inside > 0 else 0.0


def denim():
    """A 3/1 twill: indigo warp over three pale weft threads, under one, which rises to the right."""
    width, steps = 6, 26
    warp_colors = ramp((10, 22, 56), (92, 132, 200), steps)
    weft_colors = ramp((24, 40, 86), (122, 146, 192), steps)
    threads = FINE // width + 1
    warp, weft = thread_tables(11, threads, 110, FINE), thread_tables(12, threads, 60, FINE)
    rows = []
    for y in range(FINE):
        b, v = y // width, y % width + 0.5 - width / 2
        row = bytearray()
        for x in range(FINE):
            a, u = x // width, x % width + 0.5 - width / 2
            phase = (a + b) % 4
            # The weft is seen between the ends of two floats of the warp, which reach in from above and below.
            dot = yarn(u, v + 0.3 * u, 0.68 * width, 0.42 * width) if phase == 0 else 0.0
            if dot > 0.25:
                shade = 0.12 + 0.62 * dot + 0.14 * weft[b][x] + 0.08 * fibers(x, v, b)
                row.append(steps + index(shade, steps))
            else:
                # A float of the warp spans three weft threads, and is highest over the middle one.
                along = v + width * ((phase if phase else 4 if v < 0 else 0) - 2)
                crown = yarn(along, u, 2.05 * width, 0.56 * width)
                shade = 0.04 + 0.58 * crown + 0.16 * warp[a][y] + 0.09 * fibers(y, u, threads + a)
                row.append(index(shade, steps))
        rows.append(bytes(row))
    return warp_colors + weft_colors, rows


def linen():
    """Plain weave of uneven natural threads with slubs."""
    width, steps = 6, 32
    colors = ramp((98, 86, 66), (246, 238, 220), steps)
    threads = FINE // width + 1
    warp, weft = thread_tables(21, threads, 150, FINE), thread_tables(22, threads, 90, FINE)
    rows = []
    for y in range(FINE):
        b, v = y // width, y % width + 0.5 - width / 2
        row = bytearray()
        for x in range(FINE):
            a, u = x // width, x % width + 0.5 - width / 2
            if (a + b) % 2 == 0:
                tone, along, across, place, thread = warp[a][y], v, u, y, a
            else:
                tone, along, across, place, thread = weft[b][x], u, v, x, threads + b
            crown = yarn(along, across, 0.86 * width, (0.50 + 0.10 * tone) * width)
            shade = 0.27 + 0.45 * crown + 0.19 * tone + 0.08 * fibers(place, across, thread)
            row.append(index(shade, steps))
        rows.append(bytes(row))
    return colors, rows


def flag():
    """A blue field with a yellow cross that stands nearer the hoist, in a light plain weave."""
    steps = 32
    blue = ramp((0, 62, 122), (30, 112, 182), steps)
    yellow = ramp((212, 164, 0), (255, 214, 48), steps)
    threads = thread_tables(31, SIZE // 2, 48)
    rows = []
    for y in range(SIZE):
        in_bar = 4 / 10 <= (y + 0.5) / SIZE < 6 / 10
        row = bytearray()
        for x in range(SIZE):
            in_post = 5 / 16 <= (x + 0.5) / SIZE < 7 / 16
            over = (x // 2 + y // 2) % 2 == 0
            tone = threads[x // 2][y] if over else threads[y // 2][x]
            shade = 0.48 + 0.22 * tone + (0.07 if over else -0.07)
            row.append((steps if in_bar or in_post else 0) + index(shade, steps))
        rows.append(bytes(row))
    return blue + yellow, rows


def rubber():
    """Black rubber with ribs across and a fine grain."""
    rib, steps = 16, 64
    colors = ramp((22, 23, 26), (122, 124, 130), steps)
    rows = []
    for y in range(SIZE):
        t = (y % rib) / rib
        # Lit from above: the upper flank of a rib is bright, the groove below it dark.
        profile = 0.5 + 0.5 * math.sin(2 * math.pi * t)
        groove = 0.16 if t > 0.82 else 0.0
        row = bytearray()
        for x in range(SIZE):
            grain = noise(x // 2, y // 2, 41) - 0.5
            shade = 0.20 + 0.24 * profile - groove + 0.10 * grain
            row.append(index(shade, steps))
        rows.append(bytes(row))
    return colors, rows


# ---- the grid -------------------------------------------------------------------------------------------------------

# Seven rows of five dots a letter.
GLYPHS = {
    "A": "01110 10001 10001 11111 10001 10001 10001",
    "B": "11110 10001 10001 11110 10001 10001 11110",
    "C": "01111 10000 10000 10000 10000 10000 01111",
    "D": "11110 10001 10001 10001 10001 10001 11110",
    "E": "11111 10000 10000 11110 10000 10000 11111",
    "F": "11111 10000 10000 11110 10000 10000 10000",
    "G": "01111 10000 10000 10011 10001 10001 01111",
    "H": "10001 10001 10001 11111 10001 10001 10001",
    "1": "00100 01100 00100 00100 00100 00100 01110",
    "2": "01110 10001 00001 00110 01000 10000 11111",
    "3": "11110 00001 00001 01110 00001 00001 11110",
    "4": "00010 00110 01010 10010 11111 00010 00010",
    "5": "11111 10000 11110 00001 00001 10001 01110",
    "6": "01110 10000 10000 11110 10001 10001 01110",
    "7": "11111 00001 00010 00100 01000 01000 01000",
    "8": "01110 10001 10001 01110 10001 10001 01110",
    "u": "00000 00000 10001 10001 10001 10011 01101",
    "v": "00000 00000 10001 10001 10001 01010 00100",
    ">": "00000 00100 00010 11111 00010 00100 00000",
    "^": "00100 01110 10101 00100 00100 00100 00100",
}


def write_text(rows, text, left, top, scale, color):
    for n, letter in enumerate(text):
        for dy, line in enumerate(GLYPHS[letter].split()):
            for dx, dot in enumerate(line):
                if dot == "1":
                    x, y = left + (6 * n + dx) * scale, top + dy * scale
                    for yy in range(y, y + scale):
                        rows[yy][x : x + scale] = bytes([color]) * scale


def hue(h, lightness):
    """A soft color of hue h (turns)."""
    channels = [0.5 + 0.5 * math.cos(2 * math.pi * (h - k / 3)) for k in range(3)]
    return tuple(round(255 * lightness * (0.45 + 0.55 * c)) for c in channels)


def uv_grid():
    """Eight by eight labeled cells: A to H along u (to the right), 1 to 8 along v (upwards), to check orientation."""
    cells = 8
    cell = SIZE // cells
    palette, rows = [(24, 26, 30), (250, 250, 250)], [bytearray(SIZE) for _ in range(SIZE)]
    for c in range(cells):
        for r in range(cells):
            lightness = (0.62 if (c + r) % 2 else 0.80) * (0.75 + 0.25 * r / (cells - 1))
            palette.append(hue(c / cells * 0.85, lightness))
    for y in range(SIZE):
        r = cells - 1 - y // cell
        for x in range(SIZE):
            on_line = x % cell in (0, cell - 1) or y % cell in (0, cell - 1)
            rows[y][x] = 1 if on_line else 2 + (x // cell) * cells + r
    for c in range(cells):
        for r in range(cells):
            left, top = c * cell + 10, (cells - 1 - r) * cell + 14
            write_text(rows, "ABCDEFGH"[c] + "12345678"[r], left, top, 4, 0)
    write_text(rows, "u>", 36, SIZE - 14, 1, 0)
    write_text(rows, "v^", 4, SIZE - 14, 1, 0)
    return palette, [bytes(row) for row in rows]


def main():
    folder = pathlib.Path(__file__).resolve().parent
    for make in (denim, linen, flag, rubber, uv_grid):
        path = folder / f"{make.__name__}.png"
        write_png(path, *make())
        print(f"{path.name}: {path.stat().st_size // 1024} KB")


if __name__ == "__main__":
    main()
