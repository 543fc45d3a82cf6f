"""A virtual screen (Xvfb) whose pixels can be read, and pictures kept as PNG. Python's standard library alone."""

import ctypes
import mmap
import os
import select
import signal
import struct
import subprocess
import tempfile
import zlib


def end_with_parent():
    """For preexec_fn: the child is killed when this program ends, however it ends (prctl PR_SET_PDEATHSIG)."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)


class Picture:
    """width x height pixels, three bytes each, rows from the top."""

    def __init__(self, width, height, rgb):
        self.width, self.height, self.rgb = width, height, bytes(rgb)

    def __eq__(self, other):
        return (self.width, self.height, self.rgb) == (other.width, other.height, other.rgb)

    def crop(self, box):
        """The part in box = (x, y, width, height), cut to what there is."""
        x, y, width, height = (round(v) for v in box)
        x, y = max(x, 0), max(y, 0)
        width, height = min(width, self.width - x), min(height, self.height - y)
        rows = [self.rgb[3 * (row * self.width + x):3 * (row * self.width + x + width)] for row in range(y, y + height)]
        return Picture(width, height, b"".join(rows))

    def pixel(self, x, y):
        at = 3 * (y * self.width + x)
        return tuple(self.rgb[at:at + 3])

    def row(self, y):
        """The pixels of a row as triples."""
        line = self.rgb[3 * y * self.width:3 * (y + 1) * self.width]
        return list(zip(line[0::3], line[1::3], line[2::3]))

    def differs_from(self, other, threshold=8):
        """The part of all pixels in which a channel differs by more than the threshold, 0 to 1."""
        assert (self.width, self.height) == (other.width, other.height), "pictures of different sizes"
        if self.rgb == other.rgb:
            return 0.0
        count = 0
        length = 3 * self.width
        for y in range(self.height):
            if self.rgb[length * y:length * (y + 1)] != other.rgb[length * y:length * (y + 1)]:
                count += sum(a != b and distance(a, b) > threshold for a, b in zip(self.row(y), other.row(y)))
        return count / (self.width * self.height)

    @classmethod
    def read(cls, file):
        """A PNG of eight bits a channel, three of them, not interlaced."""
        with open(file, "rb") as source:
            data = source.read()
        at, packed = 8, b""
        while at < len(data):
            length, name = struct.unpack(">I4s", data[at:at + 8])
            body = data[at + 8:at + 8 + length]
            if name == b"IHDR":
                width, height, depth, colours = struct.unpack(">IIBB", body[:10])
                assert (depth, colours) == (8, 2), "a PNG of three bytes a pixel is expected"
            packed += body if name == b"IDAT" else b""
            at += 12 + length
        lines, size, rows, above = zlib.decompress(packed), 3 * width, [], bytes(3 * width)
        for y in range(height):
            start = y * (size + 1)
            above = unfiltered(lines[start], bytearray(lines[start + 1:start + 1 + size]), above)
            rows.append(above)
        return cls(width, height, b"".join(rows))

    def save(self, file):
        """Writes a PNG: filter 0 on every row, one block."""

        def chunk(name, data):
            body = name + data
            return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

        rows = b"".join(b"\0" + self.rgb[3 * self.width * y:3 * self.width * (y + 1)] for y in range(self.height))
        head = struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)
        with open(file, "wb") as out:
            out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 6)) +
                      chunk(b"IEND", b""))


def unfiltered(kind, row, above):
    """A row of a PNG of three bytes a pixel, from what stands in the file and the row above."""
    for k in range(len(row) if kind else 0):
        left, up, corner = (row[k - 3], above[k], above[k - 3]) if k >= 3 else (0, above[k], 0)
        if kind == 1:
            guess = left
        elif kind == 2:
            guess = up
        elif kind == 3:
            guess = (left + up) // 2
        else:
            p = left + up - corner
            guess = min((abs(p - left), 0, left), (abs(p - up), 1, up), (abs(p - corner), 2, corner))[2]
        row[k] = (row[k] + guess) & 255
    return bytes(row)


def distance(a, b):
    """The largest difference of a channel."""
    return max(abs(a[0] - b[0]), abs(a[1] - b[1]), abs(a[2] - b[2]))


class Screen:
    """An X server of its own. It keeps its pixels in a file (-fbdir) in the format of xwd."""

    def __init__(self, width=1600, height=1000, options=()):
        self.width, self.height = width, height
        self.folder = tempfile.TemporaryDirectory(prefix="tyglab-screen-")
        reading, writing = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp", *options,
             "-noreset",  # or it would start anew, and refuse who comes then, whenever its last window closes
             "-fbdir", self.folder.name], pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            preexec_fn=end_with_parent)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            ready, _, _ = select.select([pipe], [], [], 60)
            number = pipe.readline().strip() if ready else ""
        if not number:
            raise RuntimeError("Xvfb did not start. Is the package xvfb installed?")
        self.display = ":" + number

    def picture(self):
        """What the screen shows now."""
        with open(os.path.join(self.folder.name, "Xvfb_screen0"), "rb") as file:
            with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
                head = struct.unpack(">25I", data[:100])
                pixels = data[head[0] + 12 * head[19]:]
        width, height, stride = head[4], head[5], head[12]
        assert head[11] == 32 and head[7] == 0, "a screen of 32 bits a pixel, blue first, is expected"
        rgb = bytearray(3 * width * height)
        for channel in range(3):
            plane = pixels[2 - channel:stride * height:4]
            rgb[channel::3] = plane if stride == 4 * width else b"".join(
                plane[y * stride // 4:y * stride // 4 + width] for y in range(height))
        return Picture(width, height, rgb)

    def close(self):
        self.server.kill()
        self.server.wait()
        for leftover in (f"/tmp/.X{self.display[1:]}-lock", f"/tmp/.X11-unix/X{self.display[1:]}"):
            if os.path.exists(leftover):
                os.remove(leftover)
        self.folder.cleanup()
