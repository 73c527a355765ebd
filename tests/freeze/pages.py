"""The pages of `export`: byte for byte, apart from the version of the program."""
from __future__ import annotations

import pathlib
import re
import shutil

import pictures
from contents import sha
from items import Item, Seen
from normal import Normal
from sides import ROOT, Side

VERSION = re.compile(rb"\b[Tt]idemark \d+\.\d+\.\d+[-+.\w]*|\b[0-9a-f]{40}\b")


def same_bytes(data: bytes) -> list[str]:
    """Returns the lines of a page, so that a difference can be shown, and the SHA-256 of all."""
    data = VERSION.sub(b"VERSION", data)
    return [f"sha256 {sha(data)}", *data.decode("utf-8", "backslashreplace").split("\n")]


def look_at(side: Side, name: str, scene: pathlib.Path, wording: bool) -> Seen:
    folder = side.fresh_folder("page " + name)
    normal = Normal(folder, wording)
    seen: Seen = {}
    for kind, options in {"page": ["--html", "page.html"], "figure": ["--embed", "--html", "figure.html"],
                          "project": ["-o", "project.json"]}.items():
        done = side.run(["export", str(scene), *options], folder)
        seen[f"{kind}: exit code"] = [done.code]
        seen[f"{kind}: standard output"] = normal.text(done.stdout)
        seen[f"{kind}: standard error"] = normal.text(done.stderr)
        if (file := folder / options[-1]).is_file():
            seen[file.name] = same_bytes(file.read_bytes())
    shutil.rmtree(folder)
    return seen


def items(wording: bool, projects: pathlib.Path | None):
    scenes = [(name, scene) for name, scene, _, _ in pictures.scenes_of_cases()]
    shaders = ROOT / "shaders"
    scenes += [(str(scene.relative_to(ROOT)), scene) for scene in
               [*sorted(shaders.glob("*.glsl")), *sorted((shaders / "examples").glob("*.glsl"))]]
    scenes += [(f"projects/{scene.relative_to(projects)}", scene) for scene in pictures.projects_in(projects)] if projects else []
    for name, scene in scenes:
        yield Item("pages", name, lambda side, name=name, scene=scene: look_at(side, name, scene, wording))
