"""Draws with the program of a Debian package that is unpacked elsewhere, and holds what it declares against what is in it:
try_package.py FILE.deb BUILD_FOLDER."""
from __future__ import annotations

import pathlib
import subprocess
import sys
import tempfile

import package_contents

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


def check_fields(package: pathlib.Path, root: pathlib.Path, build: pathlib.Path) -> None:
    programs = [root / "usr/bin/tidemark", *sorted((root / "usr/lib/tidemark").glob("*.so"))]
    assert len(programs) > 1, "no plug-ins"
    depends = package_contents.output_of("dpkg-deb", "-f", package, "Depends")
    undeclared = package_contents.undeclared(depends, programs)
    assert not undeclared, (f"its Depends does not bring {', '.join(undeclared[:8])} ({len(undeclared)} in all): "
                            "name in runner/install/package.cmake what the program loads by itself")
    unnamed = package_contents.unnamed((root / "usr/share/doc/tidemark/copyright").read_text(), build)
    assert not unnamed, f"its copyright does not name {', '.join(unnamed)}: add a field to runner/install/copyright.in"


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="tidemark-package-") as scratch:
        deb = pathlib.Path(sys.argv[1]).resolve()
        try_package(deb, pathlib.Path(scratch))
        check_fields(deb, pathlib.Path(scratch) / "root", pathlib.Path(sys.argv[2]).resolve())
