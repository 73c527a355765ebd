"""The memory that the process which draws has after a hundred frames is enough for all. TIDEMARK_SOAK_FRAMES says how many
are drawn."""
import os
import pathlib
import subprocess
import time
import unittest

from support import footprint
from support.program import PROGRAM, ProgramTest, environment, is_sanitized, main

FRAMES = int(os.environ.get("TIDEMARK_SOAK_FRAMES", "600"))
WARM = 100
KIBIBYTES_MORE = 4096  # what malloc keeps for later, not what is kept
SCENE = """vec4 at(vec2 p) { return texture(iChannel0, p / iResolution.xy + 0.01 * iTime); }
void mainImage(out vec4 c, in vec2 p) { c = vec4(at(p).rgb * (0.5 + 0.5 * sin(float(iFrame))), 1.0); }
"""


class ManyFrames(ProgramTest):
    def drawing(self, capture: subprocess.Popen) -> int:
        """`capture` watches over a process that draws."""
        children = pathlib.Path(f"/proc/{capture.pid}/task/{capture.pid}/children").read_text().split()
        return int(children[0]) if children else capture.pid

    def test_memory_and_descriptors_do_not_grow(self):
        self.write("a.glsl", SCENE)
        (self.folder / "f").mkdir()
        capture = subprocess.Popen([PROGRAM, "capture", "a.glsl", "--frames", f"0-{FRAMES - 1}", "--size", "32x32",
                                    "-o", "f/%06d.png"], cwd=self.folder, env=environment(), stderr=subprocess.DEVNULL)
        self.addCleanup(capture.kill)
        while not (self.folder / f"f/{WARM:06d}.png").exists():
            self.assertIsNone(capture.poll())
            time.sleep(0.01)
        process = self.drawing(capture)
        warm = last = footprint.kibibytes(process)
        while capture.poll() is None:
            try:
                last = footprint.kibibytes(process)
            except (OSError, AttributeError):  # it ends
                break
            time.sleep(0.05)
        self.assertEqual(capture.wait(), 0)
        self.assertEqual(len(list((self.folder / "f").iterdir())), FRAMES)
        print(f"{warm / 1024:.1f} MiB after {WARM} frames, {last / 1024:.1f} after {FRAMES}")
        if not is_sanitized():
            self.assertLess(last, warm + KIBIBYTES_MORE)


if __name__ == "__main__":
    main()
