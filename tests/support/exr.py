"""Reads OpenEXR files as the program writes them: scan lines, ZIP, one part or several. By the layout that the
OpenEXR project documents (openexr.com, "OpenEXR File Layout"), and by nothing that the program links."""
from __future__ import annotations

import dataclasses
import functools
import pathlib
import struct
import zlib

MULTI_PART = 0x1000
LINES_IN_A_BLOCK = {0: 1, 2: 1, 3: 16}  # by compression: none, ZIPS, ZIP
SAMPLE_BYTES = (4, 2, 4)  # by type: uint, half, float


@dataclasses.dataclass
class Part:
    attributes: dict[str, bytes]
    channels: list[tuple[str, int]]  # name and type
    blocks: list[bytes]  # of lines, from the top, as they are stored

    @property
    def name(self) -> str:
        return self.attributes.get("name", b"").decode()

    @property
    def size(self) -> tuple[int, int]:
        left, top, right, bottom = struct.unpack("<4i", self.attributes["dataWindow"])
        return right - left + 1, bottom - top + 1

    @property
    def lines_in_a_block(self) -> int:
        return LINES_IN_A_BLOCK[self.attributes["compression"][0]]

    @functools.cached_property
    def samples(self) -> dict[str, bytes]:
        """The bytes of each channel's samples, top row first, from the left."""
        width, height = self.size
        row_bytes = [(name, width * SAMPLE_BYTES[kind]) for name, kind in self.channels]
        planes = {name: [] for name, _ in self.channels}
        for number, block in enumerate(self.blocks):
            rows = min(self.lines_in_a_block, height - number * self.lines_in_a_block)
            data = unzipped(block, rows * sum(count for _, count in row_bytes))
            place = 0
            for _ in range(rows):
                for name, count in row_bytes:
                    planes[name].append(data[place:place + count])
                    place += count
        return {name: b"".join(rows) for name, rows in planes.items()}

    def values(self, channel: str) -> tuple[float, ...]:
        kind = dict(self.channels)[channel]
        data = self.samples[channel]
        return struct.unpack(f"<{len(data) // SAMPLE_BYTES[kind]}{'Ief'[kind]}", data)


def header(file: bytes, at: int) -> tuple[dict[str, bytes], int]:
    """The attributes from there on, and the place behind the byte that ends them."""
    attributes = {}
    while file[at]:
        name, kind = file[at:at + 600].split(b"\0", 2)[:2]
        at += len(name) + len(kind) + 2
        size, = struct.unpack_from("<I", file, at)
        attributes[name.decode()] = file[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def channels_of(attributes: dict[str, bytes]) -> list[tuple[str, int]]:
    channels, data = [], attributes["channels"]
    while data[0]:
        name, rest = data.split(b"\0", 1)
        channels.append((name.decode(), struct.unpack_from("<I", rest)[0]))
        data = rest[16:]
    return channels


def unzipped(data: bytes, size: int) -> bytes:
    """A block that did not become smaller is there as it was."""
    if len(data) == size:
        return data
    coded = bytearray(zlib.decompress(data))
    for i in range(1, len(coded)):
        coded[i] = (coded[i - 1] + coded[i] - 128) & 255
    half = (len(coded) + 1) // 2
    plain = bytearray(len(coded))
    plain[0::2], plain[1::2] = coded[:half], coded[half:]
    return bytes(plain)


def read(path: pathlib.Path) -> list[Part]:
    file = path.read_bytes()
    assert file[:4] == b"v/1\1"
    flags, = struct.unpack_from("<I", file, 4)
    headers, at = [], 8
    while True:
        attributes, at = header(file, at)
        headers.append(attributes)
        if not flags & MULTI_PART:
            break
        if file[at] == 0:  # an empty header ends them
            at += 1
            break
    parts = []
    for attributes in headers:
        part = Part(attributes, channels_of(attributes), [])
        count = -(-part.size[1] // part.lines_in_a_block)
        for offset in struct.unpack_from(f"<{count}Q", file, at):
            offset += 4 if flags & MULTI_PART else 0  # behind the part's number
            size, = struct.unpack_from("<I", file, offset + 4)  # behind the first line's
            part.blocks.append(file[offset + 8:offset + 8 + size])
        at += 8 * count
        parts.append(part)
    return parts
