"""Reads and writes PNG, so that the program's pictures are judged by other code than its own."""
from __future__ import annotations

import dataclasses
import hashlib
import itertools
import pathlib
import struct
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"
CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}  # by PNG's colour type; palettes are not for us


@dataclasses.dataclass
class Picture:
    """`rows` from the top, samples as in the file: big-endian where they have 16 bits."""
    width: int
    height: int
    channels: int
    depth: int
    rows: list[bytes]
    text: dict[str, str] = dataclasses.field(default_factory=dict)

    def pixel(self, x: int, y: int) -> tuple[int, ...]:
        """Samples of the pixel in column x, row y from the *bottom*, as shaders count."""
        size = self.depth // 8
        row = self.rows[self.height - 1 - y]
        start = x * self.channels * size
        pixel = row[start:start + self.channels * size]
        return struct.unpack(f">{self.channels}{'B' if size == 1 else 'H'}", pixel)

    def rgba_from_top(self) -> bytes:
        """The bytes as they were drawn, of a picture with 8 bits and no transparency."""
        assert self.depth == 8 and self.channels == 3
        pixels = bytearray()
        for row in self.rows:
            rgba = bytearray(b"\xff" * (self.width * 4))
            for channel in range(3):
                rgba[channel::4] = row[channel::3]
            pixels += rgba
        return bytes(pixels)

    def sha256(self) -> str:
        """What `capture --json` reports of the frame."""
        return hashlib.sha256(self.rgba_from_top()).hexdigest()


def chunks(file: bytes):
    """(type, data) of each chunk. Raises on a file that is cut short or damaged."""
    if not file.startswith(SIGNATURE):
        raise ValueError("no PNG signature")
    at = len(SIGNATURE)
    while at < len(file):
        length, kind = struct.unpack_from(">I4s", file, at)
        data = file[at + 8:at + 8 + length]
        (checksum,) = struct.unpack_from(">I", file, at + 8 + length)
        if zlib.crc32(kind + data) != checksum:
            raise ValueError(f"wrong checksum in chunk {kind}")
        yield kind, data
        at += 12 + length
        if kind == b"IEND":
            return
    raise ValueError("the file ends before its end")


def unfiltered(filter_type: int, row: bytearray, above: bytes, step: int) -> bytes:
    """PNG 1.2, section 6."""
    if filter_type == 1:  # the one that we write
        for channel in range(step):
            row[channel::step] = bytes(map((255).__and__, itertools.accumulate(row[channel::step])))
    elif filter_type == 2:
        return bytes((a + b) & 255 for a, b in zip(row, above))
    elif filter_type != 0:
        for i, value in enumerate(row):
            left = row[i - step] if i >= step else 0
            corner = above[i - step] if i >= step else 0
            if filter_type == 3:
                guess = (left + above[i]) // 2
            else:
                estimate = left + above[i] - corner
                guess = min((left, above[i], corner), key=lambda c: abs(estimate - c))
            row[i] = (value + guess) & 255
    return bytes(row)


def decode(file: bytes) -> Picture:
    packed, text, header = b"", {}, b""
    for kind, data in chunks(file):
        if kind == b"IHDR":
            header = data
        elif kind == b"IDAT":
            packed += data
        elif kind == b"tEXt":
            name, _, value = data.partition(b"\0")
            text[name.decode("latin-1")] = value.decode("latin-1")
        elif kind == b"iTXt":
            name, _, rest = data.partition(b"\0")
            _, _, value = rest[2:].split(b"\0", 2)
            text[name.decode("latin-1")] = (zlib.decompress(value) if rest[0] else value).decode()
        elif kind == b"zTXt":
            name, _, rest = data.partition(b"\0")
            text[name.decode("latin-1")] = zlib.decompress(rest[1:]).decode("latin-1")
    width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", header)
    assert depth in (8, 16) and not interlaced
    channels = CHANNELS[colour]
    stride = width * channels * depth // 8
    samples = zlib.decompress(packed)
    assert len(samples) == height * (stride + 1)
    rows, above = [], bytes(stride)
    for y in range(height):
        start = y * (stride + 1)
        above = unfiltered(samples[start], bytearray(samples[start + 1:start + 1 + stride]), above,
                           channels * depth // 8)
        rows.append(above)
    return Picture(width, height, channels, depth, rows, text)


def read(path: pathlib.Path) -> Picture:
    return decode(path.read_bytes())


def from_raw(width: int, height: int, frame: bytes) -> Picture:
    """A frame as `capture -o -` puts it out."""
    stride = 3 * width
    assert len(frame) == stride * height
    return Picture(width, height, 3, 8, [frame[y * stride:(y + 1) * stride] for y in range(height)])


def encode(width: int, height: int, channels: int, rows: list[bytes]) -> bytes:
    """A PNG of 8-bit rows, from the top."""
    colour = {count: kind for kind, count in CHANNELS.items()}[channels]

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0)
    packed = zlib.compress(b"".join(b"\0" + row for row in rows))
    return SIGNATURE + chunk(b"IHDR", header) + chunk(b"IDAT", packed) + chunk(b"IEND", b"")
