"""A Wayland compositor of our own: weston, which shows its screen and takes keys and pointer in an Xvfb."""
from __future__ import annotations

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import png
from support.live import LiveTest, Screen, View, wait_for
from support.program import PROGRAM, ROOT, SKIPPED, environment

SIZE = (1000, 700)
SOCKET = "tidemark-test"


def glfw_folder() -> str | None:
    """Where GLFW's library for Wayland is, of which Debian installs no two: "" where it is the system's own."""
    linked = subprocess.run(["ldd", PROGRAM], stdout=subprocess.PIPE, text=True, check=True).stdout
    own = re.search(r"libglfw\S* => (\S+)", linked)
    if own and b"wl_display_connect" in pathlib.Path(own[1]).read_bytes():
        return ""
    unpacked = next((ROOT / "build" / "wayland").glob("usr/lib/*/libglfw.so.3"), None)
    return str(unpacked.parent) if unpacked else None


def main() -> None:
    for tool in ("Xvfb", "xdotool", "weston"):
        if not shutil.which(tool):
            print(f"skipped: {tool} is not installed")
            sys.exit(SKIPPED)
    if glfw_folder() is None:
        print("skipped: GLFW is X11's alone (./dev test --long unpacks libglfw3-wayland into build/wayland)")
        sys.exit(SKIPPED)
    unittest.main()


class Compositor(Screen):
    """A Screen with weston on it, whose windows are Wayland's."""

    def __init__(self, *options: str, config: str = "") -> None:
        """`config`: what stands in a weston.ini; empty: there is none."""
        super().__init__()
        self.runtime = tempfile.mkdtemp(prefix="tidemark-wayland-")  # only its owner's: XDG_RUNTIME_DIR has to be
        self.log = open(pathlib.Path(self.runtime) / "log", "wb")
        file = pathlib.Path(self.runtime) / "weston.ini"
        file.write_text(config)
        self.weston = subprocess.Popen(
            ["weston", f"--config={file}" if config else "--no-config", "--backend=x11-backend.so", "--use-pixman", f"--socket={SOCKET}", "--idle-time=0",
             f"--width={SIZE[0]}", f"--height={SIZE[1]}", *options],
            env=environment(DISPLAY=self.display, XDG_RUNTIME_DIR=self.runtime), stdout=self.log, stderr=self.log)
        wait_for((pathlib.Path(self.runtime) / SOCKET).exists, "weston")

    def close(self) -> None:
        self.end_weston()
        super().close()
        self.log.close()
        shutil.rmtree(self.runtime, ignore_errors=True)

    def end_weston(self) -> None:
        self.weston.terminate()
        self.weston.wait()

    def variables(self) -> dict[str, str]:
        found = {"DISPLAY": "", "WAYLAND_DISPLAY": SOCKET, "XDG_RUNTIME_DIR": self.runtime, "WAYLAND_DEBUG": "client"}
        if folder := glfw_folder():
            found["LD_LIBRARY_PATH"] = folder
        return found

    def find(self, rows: list[bytes]) -> tuple[int, int] | None:
        """The left upper corner of where a picture is shown."""
        shown = self.rows(0, 0, *SIZE)
        for top in range(SIZE[1] - len(rows) + 1):
            start = shown[top].find(rows[0])
            while start >= 0:
                if start % 3 == 0 and all(shown[top + y].startswith(row, start) for y, row in enumerate(rows)):
                    return start // 3, top
                start = shown[top].find(rows[0], start + 1)
        return None


class WaylandView(View):
    """A `tidemark view` on a Compositor. No other program learns of a window's title there but from what is said
    to the compositor; its place is where its picture is."""

    def wait_for_window(self, first_title: str) -> None:
        wait_for(lambda: self.running() and re.search(first_title, self.title()), "the first frame")
        self.point(SIZE[0] - 1, SIZE[1] - 1)  # over no window; keys go to the newest

    def title(self) -> str:
        titles = re.findall(r'xdg_toplevel[@#]\d+\.set_title\("(.*)"\)', super().stderr())
        return titles[-1] if titles else ""

    def stderr(self) -> str:
        """Without what libwayland says of its messages, and libdecor of its plug-ins, which draw title bars, if there are none."""
        return re.sub(r"^(\[ *\d+\.\d+\]|Couldn't open plugin directory: |No plugins found, ).*\n", "", super().stderr(), flags=re.MULTILINE)

    def find(self) -> tuple[int, int]:
        """Where it is, by a picture that stands still."""
        rows = png.read(self.save()).rows
        return wait_for(lambda: self.running() and self.screen.find(rows), "the picture on the screen")

    def point(self, x: int, y: int) -> None:
        """Of the screen."""
        self.screen.xdotool("mousemove", str(x), str(y))


class WaylandTest(LiveTest):
    screen: Compositor
    CONFIG = ""

    @classmethod
    def setUpClass(cls) -> None:
        cls.screen = Compositor(config=cls.CONFIG)
        cls.addClassCleanup(cls.screen.close)

    def view(self, scene: str, *options: str, **variables: str) -> WaylandView:
        opened = WaylandView(self.screen, self.folder, scene, *options, **variables)
        self.addCleanup(opened.close)
        return opened
