"""The pictures of every scene: all passes at frames 0 and 30, the PNG that users get, and the sound."""
from __future__ import annotations

import json
import pathlib
import shutil

from contents import described, exr_parts
from items import Item, Seen
from normal import Normal, parsed
from sides import ROOT, Side

SIZE = ("--size", "64x36")
FRAMES = ("--frames", "0-30x30")
CASES = ROOT / "tests" / "cases"
JSON_KEYS = ("passes_drawn", "not_finite", "sha256", "iTime", "iMouse", "frame")
SOUND = ("mainSound", '"sound"')


def is_scene_folder(folder: pathlib.Path) -> bool:
    return any((folder / name).is_file() for name in ("image.glsl", "scene.json"))


def events_of(case: dict) -> str:
    """Returns the recording that does what a conformance case says happens before its frames; "" if nothing happens."""
    lines = []
    for frame in case.get("frames", []):
        number = frame.get("frame", 0)
        for what, *place in frame.get("mouse", []):
            lines.append(" ".join([str(number), what, *(["left"] if what != "move" else []), *map(str, place)]))
        for what, code in frame.get("keys", []):
            lines.append(f"{number} {'keydown' if what == 'press' else 'keyup'} {code}")
    return "\n".join(lines) + "\n" if lines else ""


def has_sound(scene: pathlib.Path) -> bool:
    files = [scene] if scene.is_file() else [path for path in scene.iterdir() if path.suffix in (".glsl", ".json")]
    return any(word in file.read_text(errors="replace") for file in files for word in SOUND)


def look_at(side: Side, name: str, scene: pathlib.Path, options: list[str], events: str, frames: list[str], wording: bool,
            copied: bool, pictured: bool = True) -> Seen:
    folder = side.fresh_folder("picture " + name)
    normal = Normal(folder, wording)
    if copied:  # a file is captured beside the other files of its folder
        source = scene.parent if scene.is_file() and scene.parent.parent == CASES / "conformance" else scene
        target = folder / source.name
        shutil.copytree(source, target) if source.is_dir() else shutil.copy(source, target)
        path = f"{source.name}/{scene.name}" if source != scene else source.name
    else:
        path = str(scene)
    if events:
        (folder / "events.txt").write_text(events)
        options = [*options, "--input", "events.txt"]
    captures = {"layers": ["--layers", "--depth", "float", "-o", "layers_%d.exr", "--json"]}
    if pictured:
        captures["picture"] = ["-o", "frame_%d.png", "--json"]
    seen: Seen = {}
    for kind, more in captures.items():
        done = side.run(["capture", path, *frames, *options, *more], folder)
        seen[f"{kind}: exit code"] = [done.code]
        seen[f"{kind}: standard error"] = normal.text(done.stderr)
        report = parsed(done.stdout)
        for frame in report.get("frames", []) if isinstance(report, dict) else []:
            seen[f"{kind}: report of frame {frame.get('frame')}"] = [f"{key} = {frame.get(key)}" for key in JSON_KEYS]
    if has_sound(scene):
        done = side.run(["capture", path, "-o", "sound.wav", "--duration", "1"], folder)
        seen["sound: exit code"] = [done.code]
    for file in sorted(folder.glob("layers_*.exr")):
        for part, lines in exr_parts(file).items():
            seen[f"frame {file.stem[7:]}, {part}"] = lines
    for file in [*sorted(folder.glob("frame_*.png")), *folder.glob("sound.wav")]:
        seen[file.name] = described(file, normal)[:2]
    shutil.rmtree(folder)
    return seen


def golden_views():
    """Yields (scene, view, options) as tests/golden has them."""
    import importlib.util
    found = importlib.util.spec_from_file_location("golden_test", ROOT / "tests" / "golden" / "golden_test.py")
    module = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    for scene, views in module.SCENES.items():
        for view, options in views.items():
            yield scene, view, options


def projects_in(folder: pathlib.Path):
    """Yields the scenes in a folder of projects: .json, .glsl and .frag files, scene folders, and those in other folders."""
    for path in sorted(folder.iterdir()):
        if path.is_dir():
            if is_scene_folder(path):
                yield path
            elif not path.name.startswith("."):
                yield from projects_in(path)
        elif path.suffix in (".json", ".glsl", ".frag") and not path.name.endswith((".study.json", ".check.json")):
            yield path


def scenes_of_cases():
    """Yields (name, scene, options, events) of tests/cases."""
    for folder in sorted((CASES / "conformance").iterdir()):
        if not folder.is_dir():
            continue
        case = json.loads((folder / "expected.json").read_text())
        options = [word for channel, value in case.get("channels", {}).items() for word in ("--channel", f"{channel}={value}")]
        dates = [frame["date"] for frame in case.get("frames", []) if "date" in frame]
        options += ["--date", dates[0]] if dates else []
        scene = next((folder / name for name in ("scene.glsl", "project.json") if (folder / name).is_file()), folder)
        yield f"conformance/{folder.name}", scene, options, events_of(case)
    for part in ("dialect", "glsl", "projects", "trace/faults", "trace/sound"):
        for scene in sorted((CASES / part).iterdir()):
            if scene.suffix in (".glsl", ".json"):
                yield f"{part}/{scene.stem}", scene, [], ""


def items(wording: bool, projects: pathlib.Path | None):
    def item(name, scene, options, events="", frames=FRAMES, size=SIZE, copied=False, pictured=True):
        return Item("pictures", name, lambda side: look_at(side, name, scene, [*size, *options], events, list(frames), wording,
                                                           copied, pictured))

    for name, scene, options, events in scenes_of_cases():
        of_conformance = name.startswith("conformance/")
        yield item(name, scene, options, events, copied=of_conformance, pictured=of_conformance)
    shaders = ROOT / "shaders"
    for scene in [*sorted(shaders.glob("*.glsl")), *sorted((shaders / "examples").glob("*.glsl"))]:
        yield item(str(scene.relative_to(ROOT)), scene, [])
    for scene, view, options in golden_views():
        yield item(f"golden/{scene}/{view}", shaders / f"{scene}.glsl", options, frames=(), size=("--size", "160x90"))
    if projects:
        for scene in projects_in(projects):
            yield item(f"projects/{scene.relative_to(projects)}", scene, [])
