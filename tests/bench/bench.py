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
import subprocess
import tempfile

import laboratory
import peer
import reload
import scaling
from measure import against, run, spread

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
TIDEMARK = str(BUILD / "tidemark")
FLOOR = str(BUILD / "tests" / "bench" / "tidemark_floor")
FRONT_END = str(BUILD / "tests" / "bench" / "tidemark_front_end")
SCENE = str(ROOT / "shaders" / "water_surface.glsl")
DOCUMENT = ("--define", "DOCUMENT=1")  # as heavy as the document's own text
FEEDBACK = str(ROOT / "tests" / "bench" / "feedback" / "feedback.glsl")
BUFFERS = ("a.glsl", "b.glsl", "c.glsl", "d.glsl")
SIZE = (640, 360)


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


def floor(shader, frames, buffers=(), size=SIZE):
    return [FLOOR, shader, str(size[0]), str(size[1]), str(frames), "30", *buffers]


def floor_of(folder):
    """For scaling: from a scene to the floor's command at a size."""
    def of_scene(scene):
        shader = complete_shader(folder, scene)
        return lambda size, frames: floor(shader, frames, size=size)
    return of_scene


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


def light_rows(folder, rounds):
    """What a host adds shows most where the shader costs nothing."""
    light = scaling.light_scene(folder)
    still = pathlib.Path(folder) / "still.glsl"
    still.write_text(scaling.LIGHT.replace("iTime", "0.25"))
    for name, scene in (("120 frames of one line, PNG", light), ("120 frames that stand still, PNG", str(still))):
        shader = complete_shader(folder, scene)
        yield against(name, ours(120, f"{folder}/light.%03d.png", scene), floor(shader, 120), rounds)


def start_up(rounds):
    walls = [run([TIDEMARK, "--version"])["wall"] * 1000 for _ in range(3 * rounds)]
    return spread(walls)


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


def show_reloads(report):
    if not report:
        return
    for name, figures in report["scene"].items():
        print("reload, {}: {median:.1f} ms [{low:.1f}, {high:.1f}]".format(name, **figures))
    for row in report["by_passes"]:
        for what in ("one", "all"):
            print("reload, {} of {} passes changed: {median:.1f} ms [{low:.1f}, {high:.1f}]".format(
                what, row["passes"], **row[what]["total"]))


def show_all(report):
    print("tidemark --version: {median:.1f} ms [{low:.1f}, {high:.1f}]".format(**report["version_ms"]))
    show_reloads(report["reload_ms"])
    for row in report["by_size"]:
        print("{what}, {size}: {ns_a_pixel[median]:.2f} ns of CPU a pixel".format(**row))
    for row in report["by_frames"]:
        print("{frames} frames: {memory:.0f} MiB".format(**row))
    for row in report["front_end"]:
        print("front end, {kilobytes} kB: {ms:.2f} ms".format(**row))
    for row in report["check"]:
        print("check {scene}: {check[wall]:.1f} s, {ratio:.1f} captures".format(**row))
    print("study {scene}, {settings} settings, {frames} frames timed ({frames_cpu:.1f} s): {study[cpu]:.1f} s of CPU, "
          "{ratio[cpu]:.2f} of the bare captures'".format(**report["study"]))
    print("in a browser:", json.dumps(report["browser"]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("-o", "--output", default=str(ROOT / "build" / "bench.json"))
    options = parser.parse_args()
    few = max(3, options.rounds // 3)
    report = {"machine": machine(), "rows": []}
    print(f"{report['machine']['processor']}, {report['machine']['cores']} cores, {report['machine']['renderer']}")
    with tempfile.TemporaryDirectory() as folder:
        for rows in (capture_rows(folder, options.rounds), light_rows(folder, few),
                     scaling.specialised(TIDEMARK, ROOT / "shaders", options.rounds)):
            for row in rows:
                report["rows"].append(row)
                show(row)
        report["version_ms"] = start_up(options.rounds)
        report["reload_ms"] = reload.times(TIDEMARK, folder, ROOT / "shaders", options.rounds)
        report["by_size"] = scaling.by_size(TIDEMARK, floor_of(folder), folder, few)
        report["by_frames"] = scaling.by_frames(TIDEMARK, folder)
        report["front_end"] = scaling.front_end(FRONT_END)
        report["check"] = laboratory.checks(TIDEMARK, ROOT / "shaders")
        report["study"] = laboratory.study(TIDEMARK, ROOT / "shaders", folder)
        shader = complete_shader(folder, SCENE, *DOCUMENT)
        report["browser"] = peer.in_a_browser(folder, shader, ours(30, "-", SCENE, *DOCUMENT), SIZE, 30, few)
    show_all(report)
    pathlib.Path(options.output).write_text(json.dumps(report, indent=2) + "\n")


if __name__ == "__main__":
    main()
