"""What one device draws, how right and how fast: device.py OUT. Needs Python and a build with its benchmarks. Each step has a
time limit; a step that fails is said and does not stop the others.

Writes OUT/device.json and OUT/pictures, the golden views as this device draws them."""
from __future__ import annotations

import argparse
import json
import os
import pathlib
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
os.environ.setdefault("TIDEMARK", str(BUILD / "tidemark"))
sys.path.insert(0, str(ROOT / "tests"))
sys.path.insert(0, str(ROOT / "tests" / "golden"))

import bench  # noqa: E402
import golden_test  # noqa: E402
from measure import against  # noqa: E402

PROGRAM = os.environ["TIDEMARK"]
SCENES = sorted((ROOT / "shaders").glob("*.glsl"))
STUDIED = ("pseudo3d_water", "water_surface")
SIZES = ((640, 360), (1920, 1080), (3840, 2160))
GOLDEN_SIZE = "160x90"
ONE_LINE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.5 + 0.5 * sin(iTime), 1.0); }\n"


DEVICE: list[str] = []  # --device NAME for the commands that draw; empty: the program chooses
DRAWING = ("capture", "check", "study")


def program(*words: str | pathlib.Path, codes: tuple[int, ...] = (0,), limit: float = 120):
    chosen = DEVICE if words[0] in DRAWING else []
    done = subprocess.run([PROGRAM, *map(str, words), *chosen], capture_output=True, text=True, timeout=limit)
    if done.returncode not in codes:
        raise RuntimeError(f"{' '.join(map(str, words))}: {done.returncode}: {done.stderr[-2000:]}")
    return done


def self_test(_out: pathlib.Path) -> dict:
    return json.loads(program("inspect", "--devices", "--self-test", "--json", codes=(0, 1), limit=240).stdout)


def golden_view(out: pathlib.Path, scene: str, view: str, limits: str) -> dict:
    """One golden view drawn here, held against the picture that llvmpipe made."""
    drawn = out / "pictures" / f"{scene}-{view}.png"
    if not drawn.exists():
        drawn.parent.mkdir(exist_ok=True)
        program("capture", ROOT / "shaders" / f"{scene}.glsl", "--size", GOLDEN_SIZE, *golden_test.SCENES[scene][view], "-o", drawn)
    kept = golden_test.GOLDEN / scene / f"{view}.png"
    judged = program("compare", kept, drawn, *getattr(golden_test, limits), "--json", codes=(0, 1))
    return {"scene": scene, "view": view, "limits": limits, "passes": judged.returncode == 0, **json.loads(judged.stdout)}


def golden(out: pathlib.Path) -> list[dict]:
    return [golden_view(out, scene, view, limits) for scene, views in golden_test.SCENES.items() for view in views
            for limits in ("LIMITS", "LIMITS_ELSEWHERE")]


def frames_for(shader: str, size: tuple[int, int]) -> int:
    """As many frames as take half a second or so beyond starting up."""
    def seconds(frames: int) -> float:
        begun = time.perf_counter()
        subprocess.run(bench.floor(shader, frames, size=size), check=True, capture_output=True, timeout=120)
        return time.perf_counter() - begun
    few = seconds(1)
    return max(2, min(3000, int(0.5 / max((seconds(11) - few) / 10, 1e-4))))


def one_line(out: pathlib.Path) -> pathlib.Path:
    """A scene that costs next to nothing."""
    (out / "one_line.glsl").write_text(ONE_LINE)
    return out / "one_line.glsl"


def speed_of(out: pathlib.Path, scene: pathlib.Path, size: tuple[int, int], rounds: int = 2) -> dict:
    """Raw frames beside the bare program, which draws and reads back the same text one frame after the other; the time of a
    frame is that of many less that of one."""
    shader = bench.complete_shader(out, str(scene))
    few, many = 1, 1 + frames_for(shader, size)
    row = {"scene": scene.stem, "size": size, "frames": many}
    for frames in (few, many):
        ours = [PROGRAM, "capture", str(scene), "--size", f"{size[0]}x{size[1]}", "--fps", "30",
                "--frames", f"0-{frames - 1}", "-o", "-"]
        row[str(frames)] = against(str(frames), ours, bench.floor(shader, frames, size=size), rounds)
    for who in ("ours", "floor"):
        row[f"{who}_ms"] = 1e3 * (row[str(many)]["wall"][who]["median"] - row[str(few)]["wall"][who]["median"]) / (many - few)
    print(f"{scene.stem} {size[0]}x{size[1]}: {row['ours_ms']:.3f} ms a frame, floor {row['floor_ms']:.3f}", flush=True)
    return row


def speed(out: pathlib.Path) -> list[dict]:
    return [speed_of(out, scene, size) for scene in (one_line(out), *SCENES) for size in SIZES]


def study_of(out: pathlib.Path, name: str, size: str = "1280x720", budget: float = 15, limit: float = 180) -> dict:
    words = ["study", ROOT / "shaders" / f"{name}.glsl", "--size", size, "--budget", f"{budget:g}", "--json",
             "-o", out / f"study-{name}"]
    done = program(*words, limit=limit)
    return {"scene": name, "says": done.stderr.splitlines()[-12:], "study": json.loads(done.stdout)}


def studies(out: pathlib.Path) -> list[dict]:
    return [study_of(out, name) for name in STUDIED]


def check_of(scene: pathlib.Path, budget: float = 25, codes: tuple[int, ...] = (0, 1), limit: float = 120) -> dict:
    begun = time.perf_counter()
    done = program("check", scene, "--json", "--budget", f"{budget:g}", codes=codes, limit=limit)
    return {"scene": scene.stem, "seconds": time.perf_counter() - begun, "code": done.returncode, "check": json.loads(done.stdout)}


def checks(_out: pathlib.Path) -> list[dict]:
    return [check_of(scene) for scene in SCENES]


def doubles(_out: pathlib.Path) -> list[dict]:
    """The scene in 64-bit floats beside the scene."""
    rows = []
    for scene in SCENES:
        words = [PROGRAM, "capture", str(scene), "--size", "1280x720", "--frames", "0-29", "-o", "-"]
        rows.append({"scene": scene.stem, **against("double", [*words, "--precision", "double"], words, 1)})
    return rows


STEPS = {"self_test": self_test, "golden": golden, "checks": checks, "studies": studies, "speed": speed, "doubles": doubles}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--steps", default=",".join(STEPS), help="of " + ",".join(STEPS))
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    found: dict = {"listed": program("inspect", "--devices").stdout.splitlines()}
    print(*found["listed"], sep="\n", flush=True)
    for step in options.steps.split(","):
        begun = time.perf_counter()
        try:
            found[step] = STEPS[step](options.out)
            problem = ""
        except (RuntimeError, OSError, subprocess.SubprocessError, SystemExit, json.JSONDecodeError) as error:
            problem = f": {error}"
        found[f"{step}_seconds"] = time.perf_counter() - begun
        print(f"{step}: {found[f'{step}_seconds']:.1f} s{problem}", flush=True)
        (options.out / "device.json").write_text(json.dumps(found, indent=1))


if __name__ == "__main__":
    main()
