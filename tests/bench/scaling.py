"""How the cost of a capture grows: with the picture, with the number of frames; and what specialising saves."""
import json
import os
import pathlib
import subprocess

from measure import against, run, spread

LIGHT = "void mainImage(out vec4 color, in vec2 place) { color = vec4(fract(place * 0.01 + iTime), 0.5, 1.0); }\n"
HEAVY = """void mainImage(out vec4 color, in vec2 place) {
    vec2 at = place * 0.01;
    for (int i = 0; i < 12; ++i)
        at += sin(at.yx + iTime) * cos(at * 1.5);
    color = vec4(at, 0.5, 1.0);
}
"""
SIZES = ((160, 90), (320, 180), (640, 360), (1280, 720), (2560, 1440), (3840, 2160), (7680, 4320))
FRAMES = (1, 10, 100, 1000, 10000)
PIXELS_A_RUN = 4e7  # as many of the light scene are drawn at every size


def capture(program, scene, size, frames, *options):
    return [program, "capture", scene, "--size", f"{size[0]}x{size[1]}", "--frames", f"0-{frames - 1}", "-o", "-", *options]


def light_scene(folder):
    return written(folder, "light", LIGHT)


def written(folder, name, text):
    path = pathlib.Path(folder) / f"{name}.glsl"
    path.write_text(text)
    return str(path)


def nanoseconds_a_pixel(command, size, pixels):
    """CPU, drawn and read back, start-up and the first frame differenced away. `command` makes the one for so many
    frames."""
    frames = max(1, round(pixels / (size[0] * size[1])))
    few = run(command(size, 1))
    many = run(command(size, 1 + frames))
    return (many["cpu"] - few["cpu"]) / (frames * size[0] * size[1]) * 1e9


def by_size(program, floor, folder, rounds):
    """Rounds over all sizes, so that a drifting machine hurts them alike; the floor, which draws no tiles, where its
    frame is small enough for its own cost to show. `floor` makes its command for a scene."""
    light, heavy = light_scene(folder), written(folder, "heavy", HEAVY)
    bare = floor(light)
    kinds = {"light": (lambda size, frames: capture(program, light, size, frames), SIZES, PIXELS_A_RUN),
             "floor": (lambda size, frames: bare(size, frames), SIZES[:4], PIXELS_A_RUN),
             "heavy": (lambda size, frames: capture(program, heavy, size, frames), SIZES, PIXELS_A_RUN / 4)}
    rows = [{(kind, size): nanoseconds_a_pixel(command, size, pixels)
             for kind, (command, sizes, pixels) in kinds.items() for size in sizes} for _ in range(rounds)]
    return [{"what": kind, "size": f"{size[0]}x{size[1]}", "ns_a_pixel": spread([row[kind, size] for row in rows])}
            for kind, size in rows[0]]


def by_frames(program, folder):
    scene = light_scene(folder)
    return [{"frames": frames, "memory": run(capture(program, scene, (64, 36), frames))["memory"]} for frames in FRAMES]


def specialised(program, shaders, rounds, frames=120):
    """Every scene as a sequence of it is captured, the trial of its programs included, against its text compiled whole."""
    for scene in sorted(pathlib.Path(shaders).glob("*.glsl")):
        ours = capture(program, str(scene), (160, 90), frames)
        yield against(f"{scene.stem}, specialised against plain", ours, [*ours, "--plain"], rounds)


def front_end(program):
    """Google Benchmark's own report."""
    done = subprocess.run([program, "--benchmark_format=json", "--benchmark_min_time=0.2"], check=True,
                          capture_output=True, text=True, env=os.environ | {"LC_ALL": "C"})
    return [{"kilobytes": int(row["name"].split("/")[1]), "ms": row["cpu_time"]}
            for row in json.loads(done.stdout)["benchmarks"] if "run_type" in row and row["run_type"] == "iteration"]
