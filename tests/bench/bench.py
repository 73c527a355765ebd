"""Whole-process figures of tidemark beside the floor: ./dev bench.

Both programs draw the very same fragment shader (`tidemark inspect --source`, the knobs' values written in).
Runs are interleaved, so that a drifting machine hurts both; what is quoted is the median of the ratios of
neighbouring runs, with the smallest and the largest. The driver's shader cache is warm (one round is thrown
away). Nothing here passes or fails.
"""
import argparse
import json
import os
import pathlib
import platform
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
TIDEMARK = str(BUILD / "tidemark")
FLOOR = str(BUILD / "tests" / "bench" / "tidemark_floor")
SCENE = str(ROOT / "shaders" / "water_surface.glsl")
DOCUMENT = ("--define", "DOCUMENT=1")  # as heavy as the document's own text
FEEDBACK = str(ROOT / "tests" / "bench" / "feedback" / "feedback.glsl")
BUFFERS = ("a.glsl", "b.glsl", "c.glsl", "d.glsl")
SIZE = (640, 360)


def run(command):
    """Wall and CPU seconds and peak memory (MiB) of one process."""
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"bench: {command} failed with {process.returncode}")
    return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "memory": usage.ru_maxrss / 1024}


def spread(values):
    return {"median": statistics.median(values), "low": min(values), "high": max(values)}


def against(name, ours, floor, rounds):
    """Interleaved: floor, ours, floor, ours … The first round warms caches and is dropped."""
    pairs = [(run(floor), run(ours)) for _ in range(rounds + 1)][1:]
    row = {"name": name}
    for figure in ("wall", "cpu", "memory"):
        row[figure] = {
            "floor": spread([a[figure] for a, _ in pairs]),
            "ours": spread([b[figure] for _, b in pairs]),
            "ratio": spread([b[figure] / a[figure] for a, b in pairs]),
        }
    return row


def inspected(*arguments):
    return subprocess.run([TIDEMARK, "inspect", *arguments], check=True, capture_output=True, text=True).stdout


def complete_shader(folder, scene, *options):
    """The scene as the driver sees it, its knobs' values as initialisers, for a program that knows no knobs."""
    text = inspected(scene, *options, "--source")
    facts = json.loads(inspected(scene, *options, "--json"))
    for knob in facts["knobs"]:
        glsl = "vec3" if knob["type"] == "color3" else knob["type"]
        value = f"{glsl}({', '.join(map(repr, knob['value']))})"
        text = re.sub(rf"^uniform {glsl} {knob['name']};", f"uniform {glsl} {knob['name']} = {value};", text,
                      flags=re.MULTILINE)
    path = pathlib.Path(folder) / f"{abs(hash((scene, *options)))}.frag"
    path.write_text(text)
    return str(path)


def floor(shader, frames, buffers=()):
    return [FLOOR, shader, str(SIZE[0]), str(SIZE[1]), str(frames), "30", *buffers]


def ours(frames, out, scene=SCENE, *options):
    return [TIDEMARK, "capture", scene, *options, "--fps", "30", "--frames", f"0-{frames - 1}",
            "--size", f"{SIZE[0]}x{SIZE[1]}", "-o", out]


def capture_rows(folder, rounds):
    shader = complete_shader(folder, SCENE)
    heavy = complete_shader(folder, SCENE, *DOCUMENT)
    one, many = f"{folder}/one.png", f"{folder}/many.%04d.png"
    few = max(3, rounds // 3)
    yield against("one frame, PNG", ours(1, one), floor(shader, 1), rounds)
    yield against("one frame, PNG, the document's marching", ours(1, one, SCENE, *DOCUMENT), floor(heavy, 1), rounds)
    yield against("30 frames, PNG", ours(30, many), floor(shader, 30), few)
    yield against("30 frames, PNG, the document's marching", ours(30, many, SCENE, *DOCUMENT), floor(heavy, 30), few)
    yield against("one frame, raw", ours(1, "-"), floor(shader, 1), rounds)
    feedback = complete_shader(folder, FEEDBACK)
    buffers = [complete_shader(folder, FEEDBACK, "--pass", name) for name in BUFFERS]
    yield against("four buffers that read themselves, 120 frames, raw", ours(120, "-", FEEDBACK),
                  floor(feedback, 120, buffers), few)


def start_up(rounds):
    walls = [run([TIDEMARK, "--version"])["wall"] * 1000 for _ in range(3 * rounds)]
    return spread(walls)


def reload_times(folder, rounds):
    """From saving a file to the new picture in a window, as the window itself reports it."""
    if not shutil.which("Xvfb"):
        return None
    display = ":97"
    shutil.copytree(ROOT / "shaders", f"{folder}/shaders")
    scene = pathlib.Path(folder) / "shaders" / "live.glsl"
    text = pathlib.Path(SCENE).read_text()
    scene.write_text(text)
    server = subprocess.Popen(["Xvfb", display, "-screen", "0", "800x600x24", "-nolisten", "tcp"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(1)
    viewer = subprocess.Popen([TIDEMARK, "view", str(scene), "--fps", "1"], env=os.environ | {"DISPLAY": display},
                              stderr=subprocess.PIPE, text=True)
    rows = []
    try:
        time.sleep(3)
        for i in range(rounds + 1):
            time.sleep(1.5)
            scene.write_text(f"// save {i}\n{text}")
            line = viewer.stderr.readline()
            rows.append([float(number) for number in re.findall(r"[\d.]+", line)])
    finally:
        viewer.send_signal(signal.SIGTERM)
        viewer.wait()
        server.terminate()
        server.wait()
    names = ("total", "notice", "load", "compile", "first draw")
    table = dict(zip(names, (spread(column) for column in zip(*rows[1:]))))
    table["ours"] = spread([row[1] + row[2] for row in rows[1:]])
    return table


def machine():
    model = next((line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if "model name" in line), "?")
    facts = json.loads(inspected(SCENE, "--json"))
    return {"processor": model, "cores": os.cpu_count(), "system": platform.platform(),
            "driver": facts["driver"], "renderer": facts["renderer"]}


def show(row):
    print(f"{row['name']}")
    for figure, unit in (("wall", "s"), ("cpu", "s"), ("memory", "MiB")):
        ours, floor, ratio = (row[figure][key] for key in ("ours", "floor", "ratio"))
        print(f"  {figure:<7} {ours['median']:8.3f} {unit:<3} floor {floor['median']:8.3f}"
              f"   ratio {ratio['median']:.3f} [{ratio['low']:.3f}, {ratio['high']:.3f}]")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("-o", "--output", default=str(ROOT / "build" / "bench.json"))
    options = parser.parse_args()
    report = {"machine": machine(), "rows": []}
    print(f"{report['machine']['processor']}, {report['machine']['cores']} cores, {report['machine']['renderer']}")
    with tempfile.TemporaryDirectory() as folder:
        for row in capture_rows(folder, options.rounds):
            report["rows"].append(row)
            show(row)
        report["version_ms"] = start_up(options.rounds)
        print("tidemark --version: {median:.1f} ms [{low:.1f}, {high:.1f}]".format(**report["version_ms"]))
        report["reload_ms"] = reload_times(folder, options.rounds)
        if report["reload_ms"]:
            for name, figures in report["reload_ms"].items():
                print("reload, {}: {median:.1f} ms [{low:.1f}, {high:.1f}]".format(name, **figures))
    pathlib.Path(options.output).write_text(json.dumps(report, indent=2) + "\n")


if __name__ == "__main__":
    main()
