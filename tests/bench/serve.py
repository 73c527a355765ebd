"""From the mouse to the picture through `tidemark serve`, by a client on this machine: the time between sending a press of
the mouse and having all of the picture that shows it, beside what drawing and encoding took of that by the program's clock."""
import argparse
import pathlib
import statistics
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))

from support.websocket import Service

# So much work for each pixel; it stands still, so that each picture is the answer to one event.
SCENE = """\
void mainImage(out vec4 c, in vec2 p) {
    float x = 0.0;
    for (int i = 0; i < WORK; ++i)
        x += sin(float(i) * 0.01 + p.x * 0.1 + iMouse.x) * cos(p.y * 0.1);
    c = vec4(fract(x), p / iResolution.xy, 1.0);
}
"""


def interval(values):
    """The median and the 95 % interval that its order statistics give."""
    ordered, half = sorted(values), 0.98 * len(values) ** 0.5
    low, high = int(len(ordered) / 2 - half), int(len(ordered) / 2 + half)
    return f"{statistics.median(ordered):6.1f} [{ordered[low]:.1f}, {ordered[high]:.1f}]"


def measure(work, size, count):
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "a.glsl").write_text(SCENE.replace("WORK", str(work)))
        service = Service(folder, "a.glsl", "--size", size, "--once")
        viewer = service.viewer()
        at_rest(viewer)
        viewer.send("press", button="left", x=1, y=1)
        last = at_rest(viewer)
        rows = []
        for i in range(count):
            time.sleep(0.01)  # the picture before is behind everybody
            begin = time.perf_counter()
            viewer.send("move", x=2 + i, y=1)
            head, file = viewer.picture()
            took = (time.perf_counter() - begin) * 1000
            assert head["number"] == last + 1, "a picture of another event"
            last = head["number"]
            rows.append((took, head["draw"], head["encode"], len(file) / 1024))
        viewer.close()
        service.end()
    return rows


def at_rest(viewer):
    """The number of the last picture before the scene stands still, which is when none comes any more."""
    number = viewer.picture()[0]["number"]
    viewer.connection.settimeout(3)
    try:
        while True:
            number = viewer.picture()[0]["number"]
    except TimeoutError:
        viewer.connection.settimeout(60)
    return number


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    options = parser.parse_args()
    for work, size in ((1, "640x360"), (100, "640x360"), (400, "640x360"), (1, "1920x1080")):
        rows = measure(work, size, options.count)
        print(f"{size}, work {work}: mouse to picture {interval([row[0] for row in rows])} ms, drawing {interval([row[1] for row in rows])}, "
              f"encoding {interval([row[2] for row in rows])}, the rest {interval([row[0] - row[1] - row[2] for row in rows])}; "
              f"a picture has {statistics.median(row[3] for row in rows):.0f} KiB", flush=True)


if __name__ == "__main__":
    main()
