"""What a running program holds: memory, handles, threads, OpenGL objects."""
from __future__ import annotations

import os
import pathlib
import re
import struct

from support.program import PROGRAM

COUNTER = pathlib.Path(PROGRAM).parent / "count_gl_objects.so"
KINDS = ("textures", "samplers", "framebuffers", "vertex arrays", "shaders", "programs", "buffers", "queries")


def variables(counts: pathlib.Path) -> dict[str, str]:
    """Of a program whose objects are counted in that file, which it makes."""
    return {"LD_PRELOAD": str(COUNTER), "TIDEMARK_GL_OBJECTS": str(counts)}


def objects(counts: pathlib.Path) -> dict[str, int]:
    return dict(zip(KINDS, struct.unpack(f"{len(KINDS)}i", counts.read_bytes())))


def kibibytes(process: int) -> int:
    """Resident, but for pages that files lie behind and that others share."""
    status = pathlib.Path(f"/proc/{process}/status").read_text()
    return int(re.search(r"^RssAnon:\s+(\d+) kB", status, re.MULTILINE).group(1))


def handles(process: int) -> list[str]:
    """What each open descriptor leads to."""
    found = []
    for entry in os.scandir(f"/proc/{process}/fd"):
        try:
            found.append(os.readlink(entry.path))
        except OSError:  # closed meanwhile
            pass
    return sorted(re.sub(r"\d+", "N", name) for name in found)


def threads(process: int) -> list[str]:
    """Their names, but for those of Mesa's cache of shaders, which come as they are needed, up to four."""
    found = []
    for task in pathlib.Path(f"/proc/{process}/task").iterdir():
        try:
            found.append((task / "comm").read_text().strip())
        except OSError:  # ended meanwhile
            pass
    return sorted(name for name in found if ":disk$" not in name)
