"""From saving a file to the new picture in a window, as the window itself reports it."""
import contextlib
import os
import pathlib
import re
import select
import shutil
import signal
import subprocess
import sys
import time

from measure import spread

DISPLAY = ":97"
FIGURES = ("total", "notice", "load", "compile", "first draw")
BUFFERS = ("buffer_a.glsl", "buffer_b.glsl", "buffer_c.glsl", "buffer_d.glsl")
SEA = """float wave(vec3 at) {
    float sum = 0.0, size = 0.5;
    for (int i = 0; i < 6; ++i, size *= 0.5) {
        vec3 turned = vec3(0.8 * at.x + 1.4 * at.y, 1.4 * at.z - 0.8 * at.y, 1.6 * at.x - 0.3 * at.z);
        sum += size * (sin(turned.x + iTime) * cos(turned.y) + exp(-turned.z * turned.z));
        at = turned + 0.1 * sum;
    }
    return sum;
}
void mainImage(out vec4 c, in vec2 p) {
    vec3 way = normalize(vec3((p - 0.5 * iResolution.xy) / iResolution.y, 1.0)), at = vec3(0.0);
    for (int i = 0; i < 40; ++i)
        at += way * max(0.05, 1.0 - wave(at));
    vec3 n = normalize(cross(dFdx(at), dFdy(at)));
    c = vec4(0.5 + 0.5 * n, 1.0) + pow(max(0.0, dot(n, -way)), 20.0);
}
"""


@contextlib.contextmanager
def a_screen():
    server = subprocess.Popen(["Xvfb", DISPLAY, "-screen", "0", "800x600x24", "-nolisten", "tcp", "-noreset"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    ready = ["xdotool", "getdisplaygeometry"]
    while server.poll() is None and subprocess.run(ready, env=os.environ | {"DISPLAY": DISPLAY}, stdout=subprocess.DEVNULL,
                                                   stderr=subprocess.DEVNULL).returncode != 0:
        time.sleep(0.1)
    try:
        yield
    finally:
        server.terminate()
        server.wait()


def reloaded(viewer):
    """Its own words after a save, in numbers."""
    patience = 120
    while select.select([viewer.stderr], [], [], patience)[0]:
        line = viewer.stderr.readline().decode()
        if line.startswith("reloaded"):
            return [float(number) for number in re.findall(r"[\d.]+", line)]
        if not line:
            sys.exit("bench: the window has closed")
    sys.exit("bench: the window does not reload")


def wait_for_picture(viewer):
    """The window's title says how fast it draws from the first frame on."""
    title = ["xdotool", "search", "--onlyvisible", "--class", "tidemark", "getwindowname"]
    while viewer.poll() is None and not re.search(r"fps|still", subprocess.run(
            title, env=os.environ | {"DISPLAY": DISPLAY}, capture_output=True, text=True).stdout):
        time.sleep(0.2)


def saves(program, scene, file, text, rounds):
    """Reloads of `scene` after saves of a file of its; the first one warms caches and is dropped."""
    viewer = subprocess.Popen([program, "view", str(scene), "--size", "320x180", "--fps", "1"], bufsize=0,
                              env=os.environ | {"DISPLAY": DISPLAY}, stderr=subprocess.PIPE)
    rows = []
    try:
        wait_for_picture(viewer)
        for i in range(rounds + 1):
            time.sleep(0.5)
            file.write_text(f"// save {i} of {time.time()}\n{text}")  # no cache has seen that text
            rows.append(reloaded(viewer))
    finally:
        viewer.send_signal(signal.SIGTERM)
        viewer.wait()
    table = dict(zip(FIGURES, (spread(column) for column in zip(*rows[1:]))))
    table["ours"] = spread([row[1] + row[2] for row in rows[1:]])
    return table


def project(folder, passes):
    """Passes that each hold a sea of their own. The texts of the files that will be saved."""
    folder.mkdir()
    buffers = BUFFERS[:passes - 1]
    for name in buffers:
        (folder / name).write_text(f"// {name}\n{SEA}")
    reads = "".join(f'#iChannel{i} "{name}"\n' for i, name in enumerate(buffers))
    sums = "".join(f"    c += 0.01 * texelFetch(iChannel{i}, ivec2(p), 0);\n" for i in range(len(buffers)))
    image = (reads + SEA.replace("void mainImage(", "void sea(") +
             f"void mainImage(out vec4 c, in vec2 p) {{\n    sea(c, p);\n{sums}}}\n")
    texts = {"image.glsl": image, "common.glsl": "// in front of every pass\n"}
    for name, text in texts.items():
        (folder / name).write_text(text)
    return texts


def by_passes(program, folder, rounds):
    """One pass changed (Image), and every pass changed (Common stands in front of all)."""
    rows = []
    for passes in (1, 2, 5):
        place = folder / f"passes_{passes}"
        texts = project(place, passes)
        row = {"passes": passes}
        for what, name in (("one", "image.glsl"), ("all", "common.glsl")):
            row[what] = saves(program, place, place / name, texts[name], rounds)
        rows.append(row)
    return rows


def times(program, folder, shaders, rounds):
    """None where there is no screen to be had."""
    if not (shutil.which("Xvfb") and shutil.which("xdotool")):
        return None
    folder = pathlib.Path(folder)
    shutil.copytree(shaders, folder / "shaders")
    scene = folder / "shaders" / "live.glsl"
    text = (shaders / "water_surface.glsl").read_text()
    scene.write_text(text)
    with a_screen():
        return {"scene": saves(program, scene, scene, text, rounds),
                "by_passes": by_passes(program, folder, max(3, rounds // 3))}
