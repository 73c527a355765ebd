"""Capture that is stopped: by Ctrl-C, which finishes the frame in hand, and by force."""
import contextlib
import fcntl
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

from support import png
from support.lsp_client import Client
from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, main

SHADER = "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(sin(dot(p, vec2(91.7, 3.1))) * 4311.3)); }\n"


class Interrupted(ProgramTest):
    def start(self) -> subprocess.Popen:
        """A capture that would take hours, with a few frames written."""
        self.write("wave.glsl", SHADER)
        running = subprocess.Popen([PROGRAM, "capture", "wave.glsl", "--size", "96x96", "--frames", "0-9999999"],
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

    def test_finishes_the_current_frame(self):
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
                self.assertEqual(lines[0], f"wrote {count} frames, wave.0000.png to wave.{count - 1:04}.png")
                self.assertRegex(lines[1], f"^interrupted after {count} of 10000000 frames; {count} frames .* --resume$")
                self.assertEqual(len(lines), 2)
                for name in self.files():
                    (self.folder / name).unlink()

    def test_kill_leaves_no_partial_file(self):
        running = self.start()
        running.kill()
        running.wait(timeout=TIME_LIMIT)
        names = self.expect_whole_pictures()
        for name in self.files() - {"wave.glsl", *names}:
            self.assertRegex(name, r"\A\.wave\.\d{4}\.part-[0-9a-f]{8}-\d+-\d+\.png\Z")
        for name in self.files() - {"wave.glsl", *names}:
            with (self.folder / name).open() as file:
                fcntl.flock(file, fcntl.LOCK_EX)  # whoever wrote it is gone
        self.succeed("capture", "wave.glsl", "--size", "16x16", "--frames", "0-1")  # the next run tidies up
        drawn = {"wave.0000.png", "wave.0001.png"}  # encoders work side by side: a later one may have been done first
        self.assertEqual(self.files(), {"wave.glsl", *names, *drawn})

    def test_every_signal_keeps_complete_pictures(self):
        for stops in ([signal.SIGINT] * 5, [signal.SIGTERM, signal.SIGINT], [signal.SIGHUP, signal.SIGHUP],
                      [signal.SIGQUIT], [signal.SIGHUP, signal.SIGTERM]):
            with self.subTest(stops=stops):
                running = self.start()
                for stop in stops:
                    running.send_signal(stop)
                running.communicate(timeout=TIME_LIMIT)
                self.assertIn(running.returncode, (130, -signal.SIGQUIT))
                self.assertEqual(self.files(), {"wave.glsl", *self.expect_whole_pictures()})
                for name in self.files():
                    (self.folder / name).unlink()

    def test_stopped_child_is_ended(self):
        running = self.start()
        with open(f"/proc/{running.pid}/task/{running.pid}/children", encoding="ascii") as file:
            child = int(file.read().split()[0])
        os.kill(child, signal.SIGSTOP)
        running.send_signal(signal.SIGTERM)
        running.communicate(timeout=TIME_LIMIT)
        self.assertEqual(running.returncode, 130)
        self.expect_whole_pictures()

    def test_language_server_ends_like_other_commands(self):
        for stop in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(stop=stop.name):
                client = Client()  # it has answered
                client.process.send_signal(stop)
                self.assertEqual(client.process.wait(timeout=TIME_LIMIT), 130)

    def test_ignored_hang_up_is_ignored(self):
        self.write("wave.glsl", SHADER)
        with subprocess.Popen(["nohup", PROGRAM, "capture", "wave.glsl", "--size", "96x96", "--frames", "0-60"],
                              cwd=self.folder, env=environment(), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE) as running:
            while not (self.folder / "wave.0002.png").exists() and running.poll() is None:
                time.sleep(0.01)
            running.send_signal(signal.SIGHUP)
            running.communicate(timeout=TIME_LIMIT)
            self.assertEqual(running.returncode, 0)
        self.assertEqual(len(self.files()), 62)

    def grows(self) -> bool:
        """Whether a file under construction has a content; one that only tried the folder is empty and goes away."""
        for part in self.folder.glob(".*.part-*"):
            with contextlib.suppress(FileNotFoundError):
                if part.stat().st_size > 0:
                    return True
        return False

    def end_at_once(self, stop: signal.Signals, *options: str) -> None:
        """As soon as there is something in the file under construction."""
        self.write("wave.glsl", SHADER.replace("4311.3)", "4311.3 + iTime)"))  # a GIF grows by what changes
        running = subprocess.Popen([PROGRAM, "capture", "wave.glsl", *options], cwd=self.folder, env=environment(),
                                   stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.addCleanup(running.stderr.close)
        self.addCleanup(running.kill)
        deadline = time.monotonic() + TIME_LIMIT
        while not self.grows():
            self.assertIsNone(running.poll())
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        for _ in range(5):
            running.send_signal(stop)
        running.communicate(timeout=TIME_LIMIT)
        self.assertEqual(self.files(), {"wave.glsl"})

    def test_tiles(self):
        for stop in (signal.SIGQUIT, signal.SIGINT):
            with self.subTest(stop=stop.name):
                self.end_at_once(stop, "--size", "30000x30000", "-o", "big.tif")

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_videos(self):
        for name, stop in (("film.mp4", signal.SIGQUIT), ("film.mp4", signal.SIGTERM), ("film.webm", signal.SIGINT),
                           ("film.gif", signal.SIGHUP)):
            with self.subTest(name, stop=stop.name):
                self.end_at_once(stop, "--size", "160x90", "--fps", "50", "--frames", "0-9999999", "-o", name)


if __name__ == "__main__":
    main()
