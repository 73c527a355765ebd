"""Turns files into lines that can be compared: pixels of pictures by their SHA-256, text as text, the rest by its bytes."""
from __future__ import annotations

import hashlib
import pathlib
import re

from normal import Normal
from support import exr, png

TEXT = (".glsl", ".txt", ".html", ".svg", ".csv", ".gp", ".md", ".bash", ".1", ".sarif", ".patch", ".frag")
# EXR attributes that name the moment or the program.
UNSTEADY = ("capDate", "Software", "software", "DateTime", "tidemark:Version")


def sha(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def snapshot(folder: pathlib.Path) -> dict[str, tuple[int, int]]:
    """Returns time and size of each file, to find out which ones a command wrote."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.is_symlink():
            state = path.stat()
            found[str(path.relative_to(folder))] = (state.st_mtime_ns, state.st_size)
    return found


def exr_parts(path: pathlib.Path) -> dict[str, list[str]]:
    """Returns what each part of an .exr holds, by its name. Blocks are compared as stored: the same samples are stored the same."""
    found = {}
    for number, part in enumerate(exr.read(path)):
        stored = hashlib.sha256()
        for block in part.blocks:
            stored.update(block)
        width, height = part.size
        found[part.name or f"part {number}"] = [f"{width}x{height} {' '.join(f'{name}:{kind}' for name, kind in part.channels)}",
                                                f"sha256 {stored.hexdigest()}"]
    return found


def described(path: pathlib.Path, normal: Normal) -> list[str]:
    """Returns the lines of a file. Under the marks "%" and "?" only those that do not depend on time."""
    timed = normal.mark in ("%", "?")
    suffix = path.suffix.lower()
    if normal.mark == "?" or (timed and suffix in TEXT) or (timed and "-vs-" in path.name):
        return ["some file"]
    if suffix == ".png":
        picture = png.read(path)
        lines = [f"{picture.width}x{picture.height}, {picture.channels} channels of {picture.depth} bits",
                 f"sha256 {sha(b''.join(picture.rows))}"]
        return lines + [f"{name} = {line}" for name, value in picture.text.items() for line in normal.text(value.encode())]
    if suffix == ".exr":
        lines = [f"{name}: {line}" for name, lines in exr_parts(path).items() for line in lines]
        for part in exr.read(path):
            for name, value in part.attributes.items():
                if name not in UNSTEADY:
                    lines.append(f"{name} = " + " ".join(normal.text(value)))
        return lines
    data = path.read_bytes()
    if suffix == ".json":
        return normal.output(data)
    if suffix in TEXT or not suffix:
        try:
            data.decode()
        except UnicodeDecodeError:
            return [f"sha256 {sha(data)}"]
        return normal.text(data)
    return [f"{len(data)} bytes", f"sha256 {sha(data)}"]


def written(folder: pathlib.Path, before: dict, normal: Normal) -> dict[str, list[str]]:
    """Returns what each file holds that is new or changed since `before`, and names those that are gone."""
    after = snapshot(folder)
    found = {}
    for name, state in after.items():
        if before.get(name) != state:
            shown = re.sub(r"\d+", "#", name) if normal.mark == "?" else normal.steady(name)
            try:
                found[f"file {shown}"] = described(folder / name, normal)
            except Exception as wrong:  # a file that is damaged is a difference, not the end of the run
                found[f"file {shown}"] = [f"cannot be read: {wrong}"]
    for name in before.keys() - after.keys():
        found[f"file {name}"] = ["removed"]
    return found
