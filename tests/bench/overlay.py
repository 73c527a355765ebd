"""What a hidden overlay costs the window: `overlay.py PROGRAM WITHOUT [ROUNDS]`, two builds against each other."""
import os
import pathlib
import re
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
os.environ.setdefault("TIDEMARK", sys.argv[1] if len(sys.argv) > 1 else "")

from measure import spread
from support import live

SCENE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(p / 64.0 + iTime), 1.0, 1.0); }\n"
SECONDS = 3


def cpu_seconds(process):
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def moment(view):
    """The number of the frame on show, and the CPU time so far."""
    said = len(re.findall("saving", view.stderr()))
    view.key("s")
    saved = live.wait_for(lambda: re.findall(r"saving a-(\d+)\.png", view.stderr())[said:], "the saved picture")
    return int(saved[0]), cpu_seconds(view.program)


def open_view(program, screen, folder, *arguments):
    live.PROGRAM = program
    return live.View(screen, folder, *arguments)


def frame_costs(programs, screens, folder):
    """CPU milliseconds of a frame, as fast as they come: both at a time, so that other work slows both."""
    views = [open_view(program, screen, folder, "a.glsl", "--fps", "100000", "--plain")
             for program, screen in zip(programs, screens)]
    before = [moment(view) for view in views]
    time.sleep(SECONDS)
    after = [moment(view) for view in views]
    for view in views:
        view.close()
    return [1000 * (b[1] - a[1]) / (b[0] - a[0]) for a, b in zip(before, after)]


def start_ups(programs, screens, folder):
    """CPU milliseconds of a window that shows its first picture and is closed: one after the other."""
    return [start_up(program, screens[0], folder) for program in programs]


def start_up(program, screen, folder):
    view = open_view(program, screen, folder, "still.glsl")
    view.quit()
    _, _, usage = os.wait4(view.program.pid, 0)
    view.program.returncode = 0
    view.close()
    return 1000 * (usage.ru_utime + usage.ru_stime)


def main():
    programs, rounds = [str(pathlib.Path(name).resolve()) for name in sys.argv[1:3]], int((sys.argv[3:] or ["8"])[0])
    screens = [live.Screen(), live.Screen()]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "a.glsl").write_text(SCENE)
        (folder / "still.glsl").write_text(SCENE.replace("iTime", "0.0"))
        for what, measure in (("frame, CPU ms", frame_costs), ("start and end, CPU ms", start_ups)):
            pairs = [measure(programs, screens, folder) for _ in range(rounds + 1)][1:]
            for label, values in (("with", [a for a, _ in pairs]), ("without", [b for _, b in pairs]),
                                  ("ratio", [a / b for a, b in pairs]), ("difference", [a - b for a, b in pairs])):
                print("{}, {}: {median:.4f} [{low:.4f}, {high:.4f}]".format(what, label, **spread(values)))
    for screen in screens:
        screen.close()


if __name__ == "__main__":
    main()
