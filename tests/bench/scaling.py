"""How the cost of a capture grows: with the picture, with the number of frames; and what specialising saves."""
import json
import os
import pathlib
import subprocess

from measure import against, run, spread

LIGHT = "void mainImage(out vec4 color, in vec2 place) { color = vec4(fract(place * 0.01 + iTime), 0.5, 1.0); }\n"
SIZES = ((160, 90), (320, 180), (640, 360), (1280, 720), (2560, 1440), (3840, 2160), (7680, 4320))
FRAMES = (1, 10, 100, 1000, 10000)
PIXELS_A_RUN = 4e7  # as many are drawn at every size


def capture(program, scene, size, frames, *options):
    return [program, "capture", scene, "--size", f"{size[0]}x{size[1]}", "--frames", f"0-{frames - 1}", "-o", "-", *options]


def light_scene(folder):
    path = pathlib.Path(folder) / "light.glsl"
    path.write_text(LIGHT)
    return str(path)


def nanoseconds_a_pixel(program, scene, size):
    """CPU, drawn and read back, start-up and the first frame differenced away."""
    frames = max(2, round(PIXELS_A_RUN / (size[0] * size[1])))
    few = run(capture(program, scene, size, 1))
    many = run(capture(program, scene, size, 1 + frames))
    return (many["cpu"] - few["cpu"]) / (frames * size[0] * size[1]) * 1e9


def by_size(program, folder, rounds):
    """Rounds over all sizes, so that a drifting machine hurts them alike."""
    scene = light_scene(folder)
    rows = [[nanoseconds_a_pixel(program, scene, size) for size in SIZES] for _ in range(rounds)]
    return [{"size": f"{width}x{height}", "ns_a_pixel": spread([row[i] for row in rows])}
            for i, (width, height) in enumerate(SIZES)]


def by_frames(program, folder):
    scene = light_scene(folder)
    return [{"frames": frames, "memory": run(capture(program, scene, (64, 36), frames))["memory"]} for frames in FRAMES]


def specialised(program, shaders, rounds, frames=10):
    """Every scene as it is captured against its text compiled whole."""
    for scene in sorted(pathlib.Path(shaders).glob("*.glsl")):
        ours = capture(program, str(scene), (320, 180), frames)
        yield against(f"{scene.stem}, specialised against plain", ours, [*ours, "--plain"], rounds)


def laboratory(program, shaders):
    """`check` and `study` as whole processes, and how much of a study's time went into frames that count."""
    rows = []
    for scene in sorted(pathlib.Path(shaders).glob("*.glsl")):
        done = run([program, "check", str(scene), "--json"], codes=(0, 1))
        rows.append({"scene": scene.stem, "check": done})
    return rows


def front_end(program):
    """Google Benchmark's own report."""
    done = subprocess.run([program, "--benchmark_format=json", "--benchmark_min_time=0.2"], check=True,
                          capture_output=True, text=True, env=os.environ | {"LC_ALL": "C"})
    return [{"kilobytes": int(row["name"].split("/")[1]), "ms": row["cpu_time"]}
            for row in json.loads(done.stdout)["benchmarks"] if "run_type" in row and row["run_type"] == "iteration"]
