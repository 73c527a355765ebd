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


def complete_shader(scene, folder):
    """The scene as the driver sees it, its knobs' values as initialisers, for a program that knows no knobs."""
    text = subprocess.run([TIDEMARK, "inspect", scene, "--source"], check=True, capture_output=True, text=True).stdout
    facts = json.loads(
        subprocess.run([TIDEMARK, "inspect", scene, "--json"], check=True, capture_output=True, text=True).stdout)
    for knob in facts["knobs"]:
        glsl = "vec3" if knob["type"] == "color3" else knob["type"]
        value = f"{glsl}({', '.join(map(repr, knob['value']))})"
        text = re.sub(rf"^uniform {glsl} {knob['name']};", f"uniform {glsl} {knob['name']} = {value};", text,
                      flags=re.MULTILINE)
    path = pathlib.Path(folder) / "complete.frag"
    path.write_text(text)
    return str(path)


def capture_rows(folder, rounds):
    shader = complete_shader(SCENE, folder)
    width, height = map(str, SIZE)

    def floor(frames):
        return [FLOOR, shader, width, height, str(frames), "30"]

    def ours(frames, out):
        return [TIDEMARK, "capture", SCENE, "--fps", "30", "--frames", f"0-{frames - 1}",
                "--size", f"{width}x{height}", "-o", out]

    yield against("one frame, PNG", ours(1, f"{folder}/one.png"), floor(1), rounds)
    yield against("30 frames, PNG", ours(30, f"{folder}/many.%04d.png"), floor(30), max(3, rounds // 3))
    yield against("one frame, raw", ours(1, "-"), floor(1), rounds)


def start_up(rounds):
    walls = [run([TIDEMARK, "--version"])["wall"] * 1000 for _ in range(3 * rounds)]
    return spread(walls)


def reload_times(folder, rounds):
    """From saving a file to the new picture in a window, as the window itself reports it."""
    if not shutil.which("Xvfb"):
        return None
    display = ":97"
    scene = pathlib.Path(folder) / "live.glsl"
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
    facts = json.loads(subprocess.run([TIDEMARK, "inspect", SCENE, "--json"], check=True, capture_output=True,
                                      text=True).stdout)
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
