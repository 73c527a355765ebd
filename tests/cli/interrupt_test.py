"""Capture that is stopped: by Ctrl-C, which finishes the frame in hand, and by force."""
import re
import signal
import subprocess
import time

from support import png
from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, main

SHADER = "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(sin(dot(p, vec2(91.7, 3.1))) * 4311.3)); }\n"


class Interrupted(ProgramTest):
    def start(self) -> subprocess.Popen:
        """A capture that would take hours, with a few frames written."""
        self.write("wave.glsl", SHADER)
        running = subprocess.Popen([PROGRAM, "capture", "wave.glsl", "--size", "256x256", "--frames", "0-9999999"],
                                   cwd=self.folder, env=environment(), stderr=subprocess.PIPE, text=True)
        self.addCleanup(running.stderr.close)
        self.addCleanup(running.kill)
        deadline = time.monotonic() + TIME_LIMIT
        while not (self.folder / "wave.0002.png").exists():
            self.assertIsNone(running.poll())
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        return running

    def expect_whole_pictures(self) -> list[str]:
        """All files under a final name are whole; their names in order."""
        names = sorted(name for name in self.files() if not name.startswith(".") and name != "wave.glsl")
        rows = {tuple(png.read(self.folder / name).rows) for name in names[:2] + names[-2:]}
        self.assertEqual(len(rows), 1)
        return names

    def test_finishes_the_frame_in_hand(self):
        for stop in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(stop=stop.name):
                running = self.start()
                running.send_signal(stop)
                _, stderr = running.communicate(timeout=TIME_LIMIT)
                self.assertEqual(running.returncode, 130)
                names = self.expect_whole_pictures()
                count = len(names)
                self.assertEqual(names, [f"wave.{i:04}.png" for i in range(count)])
                self.assertEqual(self.files(), {"wave.glsl", *names})
                lines = [line for line in stderr.splitlines() if not re.match(r"\d+/\d+ frames, ", line)]
                self.assertEqual(lines, [f"wrote {count} frames, wave.0000.png to wave.{count - 1:04}.png",
                                         f"interrupted after {count} of 10000000 frames"])
                for name in self.files():
                    (self.folder / name).unlink()

    def test_killed_leaves_no_half_file_under_a_final_name(self):
        running = self.start()
        running.kill()
        running.wait(timeout=TIME_LIMIT)
        names = self.expect_whole_pictures()
        for name in self.files() - {"wave.glsl", *names}:
            self.assertRegex(name, r"\A\.wave\.\d{4}\.part-\d+-\d+\.png\Z")


if __name__ == "__main__":
    main()
