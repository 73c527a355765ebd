"""Draws with the program of a Debian package that is unpacked elsewhere: try_package.py FILE.deb."""
from __future__ import annotations

import pathlib
import subprocess
import sys
import tempfile

SCENE = """#include <tidemark/noise.glsl>
void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(value_noise(p / 8.0, ivec2(0))), 1.0); }
"""


def try_package(package: pathlib.Path, folder: pathlib.Path) -> None:
    root = folder / "root"
    subprocess.run(["dpkg-deb", "-x", package, root], check=True)
    program = root / "usr/bin/tidemark"
    shaders = root / "usr/share/tidemark/shaders"
    (folder / "mine.glsl").write_text(SCENE)
    # An EXR is written by the plug-in; the proofs of `check` load the other one.
    small = ["--size", "64x36", "-o"]
    for words in (["capture", "mine.glsl", *small, "mine.exr"],
                  ["capture", shaders / "stylized_waves.glsl", *small, "waves.png"],
                  ["check", shaders / "examples/ripples.glsl", "--probe", "no_nan"]):
        subprocess.run([program, *words], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    for name in ("mine.exr", "waves.png"):
        assert (folder / name).stat().st_size > 1000, name


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="tidemark-package-") as scratch:
        try_package(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(scratch))
