"""A capture that cannot write, or not draw: a full disk, a folder that went, a permission that did, an encoder that is
missing, fails or is killed, memory that ran out. What is on disk is whole, the frame is named, --resume goes on."""
from __future__ import annotations

import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import time
import unittest

from support.program import PROGRAM, driver, environment, main, not_sanitized
from support.resume import SCENE, SEQUENCE, Resume

NOBODY = 61234
NOISE = """#iUniform float speed = 0.5
void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(sin(dot(p, vec2(91.7, 3.1)) + iTime * speed) * 4311.3)); }
"""


def become_nobody() -> None:
    os.setgroups([])
    os.setgid(NOBODY)
    os.setuid(NOBODY)


class Failures(Resume):
    """What is on disk is whole, the frame is named, and --resume goes on."""

    WORDS = r"(\d+) frames? (?:is|are) complete; to continue, run the same command with --resume\n"

    def expect_cut(self, done: subprocess.CompletedProcess, code: int, error: str) -> int:
        """How many frames are whole."""
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertRegex(done.stderr, error)
        words = re.search(self.WORDS, done.stderr)
        self.assertIsNotNone(words, done.stderr)
        return int(words.group(1))

    def expect_whole(self) -> None:
        """The frames are those of a capture that nothing went wrong with."""
        found = self.contents()
        for name in found:
            (self.folder / "out" / name).unlink()
        self.assertEqual(found, self.whole(*SEQUENCE))

    def start_slow(self, env: dict[str, str] | None = None, **options) -> subprocess.Popen:
        """Until its third frame is there."""
        self.write("a.glsl", SCENE.replace("400", "5000"))
        process = subprocess.Popen([PROGRAM, *SEQUENCE], cwd=self.folder, env=env or environment(), text=True,
                                   stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, **options)
        while not (self.folder / "out/f_0002.png").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.002)
        return process

    def finished(self, process: subprocess.Popen) -> subprocess.CompletedProcess:
        stderr = process.communicate()[1]
        return subprocess.CompletedProcess(process.args, process.returncode, None, stderr)


class Folders(Failures):
    def test_a_full_disk(self):
        """A limit on the size of files, which the one noisy frame is beyond."""
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); if (iFrame == 7) "
                             "c = vec4(fract(sin(dot(p, vec2(91.7, 3.1))) * 4311.3)); }\n")
        whole = self.whole(*SEQUENCE)
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        done = self.run_program(*SEQUENCE, preexec_fn=limit)
        kept = self.expect_cut(done, 4, "error: cannot write 'out/f_0007.png': File too large; ")
        self.assertEqual(self.contents(), {name: whole[name] for name in self.contents()})
        self.assertEqual(len(self.contents()), kept)
        self.assertEqual(self.resume(*SEQUENCE)[0], f"kept {kept} of 20 frames")
        self.assertEqual(self.contents(), whole)

    def test_the_folder_is_removed(self):
        process = self.start_slow()
        (self.folder / "out").rename(self.folder / "gone")
        self.expect_cut(self.finished(process), 4, r"'out/f_00\d\d.png': No such file or directory; ")
        (self.folder / "gone").rename(self.folder / "out")
        self.assertRegex(self.resume(*SEQUENCE)[0], r"kept \d+ of 20 frames")
        self.expect_whole()

    def test_the_permission_is_removed(self):
        someone = become_nobody if os.geteuid() == 0 else None  # root may write everywhere
        self.folder.chmod(0o755)
        (self.folder / "out").chmod(0o777)
        home = self.folder / "home"
        home.mkdir()
        home.chmod(0o777)
        env = environment(HOME=str(home), XDG_CACHE_HOME=str(home))
        if self.run_program("--version", preexec_fn=someone, env=env).returncode != 0:
            self.skipTest(f"other users cannot run {PROGRAM}")
        process = self.start_slow(preexec_fn=someone, env=env)
        (self.folder / "out").chmod(0o555)
        self.expect_cut(self.finished(process), 4, r"error: cannot write 'out/f_00\d\d.png': Permission denied; ")
        (self.folder / "out").chmod(0o777)
        self.resume(*SEQUENCE, preexec_fn=someone, env=env)
        self.expect_whole()

    def test_a_frame_takes_too_long(self):
        self.write_feedback()
        done = self.run_program("capture", "fb", "--size", "8x8", "--frames", "0-6,100000000", "-o", "out/f_%d.png",
                                "--timeout", "2")
        self.assertEqual(self.expect_cut(done, 5, r"error: stopped drawing frame \d+ after 2(\.\d+)? s \(--timeout\)"), 7)
        self.assertEqual(set(self.contents()), {f"f_{i}.png" for i in range(7)})
        self.assertEqual(self.resume("capture", "fb", "--size", "8x8", "--frames", "0-6", "-o", "out/f_%d.png"),
                         ["kept 7 of 7 frames"])


class FullDisk(Failures):
    """A disk of our own, which becomes larger before the capture goes on."""

    def setUp(self):
        super().setUp()
        self.write("a.glsl", NOISE)
        self.write_feedback()

    def mount(self, *options: str) -> None:
        if subprocess.run(["mount", *options, str(self.folder / "out")], stderr=subprocess.DEVNULL).returncode:
            self.skipTest("needs the right to mount")

    def fill_and_go_on(self, arguments: tuple[str, ...], kibibytes: int) -> None:
        whole = self.whole(*arguments)
        self.mount("-t", "tmpfs", "-o", f"size={kibibytes}k", "none")
        try:
            done = self.run_program(*arguments)
            kept = self.expect_cut(done, 4, r"error: cannot write 'out/[^']*': .*No space left on device")
            self.assertGreater(kept, 0)
            if not arguments[-1].endswith(".mp4"):
                self.assertLessEqual({n: b for n, b in self.contents().items() if n in whole}.items(), whole.items())
            self.assertFalse([name for name in self.contents() if ".part-" in name])
            self.mount("-o", f"remount,size={16 * kibibytes}k")
            self.assertRegex("\n".join(self.resume(*arguments)), rf"kept {kept} of \d+ frames")
            self.assertEqual(self.contents(), whole)
        finally:
            subprocess.run(["umount", "-l", str(self.folder / "out")], check=True)

    def test_pictures(self):
        self.fill_and_go_on(SEQUENCE, 60)

    def test_buffers(self):
        self.fill_and_go_on(("capture", "fb", "--size", "64x36", "--frames", "0-39", "--state-every", "5", "-o",
                             "out/f_%04d.png"), 200)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_a_video(self):
        self.fill_and_go_on(("capture", "a.glsl", "--size", "64x36", "--frames", "0-49", "--state-every", "10", "-o",
                             "out/a.mp4"), 120)


@unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
class Encoders(Failures):
    FILM = ("capture", "a.glsl", "--size", "64x36", "--frames", "0-29", "--state-every", "10", "-o", "out/a.mp4")
    film: dict[str, bytes] = {}  # what FILM makes that nothing goes wrong with

    def whole(self, *arguments: str) -> dict[str, bytes]:
        """Captured once for all tests."""
        if not Encoders.film:
            Encoders.film = super().whole(*self.FILM)
        self.assertEqual(arguments, self.FILM)
        return Encoders.film

    def with_ffmpeg(self, script: str) -> dict[str, str]:
        """One that counts its runs first."""
        tools = self.folder / "tools"
        self.write("tools/ffmpeg", f"#!/bin/sh\nreal={shutil.which('ffmpeg')}\necho run >> count\n"
                                   f"run=$(wc -l < count)\n{script}\nexec $real \"$@\"\n")
        (tools / "ffmpeg").chmod(0o755)
        return environment(PATH=f"{tools}:{os.environ['PATH']}")

    def go_wrong_and_on(self, script: str, words: str) -> None:
        whole = self.whole(*self.FILM)
        done = self.run_program(*self.FILM, env=self.with_ffmpeg(script))
        self.assertEqual(self.expect_cut(done, 4, rf"error: cannot write 'out/a.mp4': {words} \(in frame 2\d\)"), 20)
        self.assertEqual(self.resume(*self.FILM)[0], "kept 20 of 30 frames")
        self.assertEqual(self.contents(), whole)

    def test_failing_encoder(self):
        self.go_wrong_and_on('[ $run = 3 ] && { head -c 9216 > /dev/null; echo "x264: malloc failed" >&2; exit 1; }',
                             "ffmpeg says: x264: malloc failed")

    def test_killed_encoder(self):
        self.go_wrong_and_on("[ $run = 3 ] && { head -c 9216 > /dev/null; kill -9 $$; }", "ffmpeg ended without a message")

    def test_encoder_that_reports_success_without_a_video(self):
        for script in ("", 'for last; do :; done; echo junk > "${last#file:}"; '):
            with self.subTest(script):
                self.go_wrong_and_on(f"[ $run = 3 ] && {{ cat > /dev/null; {script}exit 0; }}",
                                     "ffmpeg reported success, but .*")
                for name in ("out", "tools"):
                    shutil.rmtree(self.folder / name)
                (self.folder / "out").mkdir()
                (self.folder / "count").unlink()

    HANGS = "[ $run = 3 ] && exec sleep 1000"

    def start_hanging(self) -> subprocess.Popen:
        """Until the third segment's ffmpeg takes no more frames."""
        process = subprocess.Popen([PROGRAM, *self.FILM], cwd=self.folder, env=self.with_ffmpeg(self.HANGS), text=True,
                                   stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        for line in process.stderr:
            if "still encoding frame 2" in line:
                return process
        self.fail("it ended")

    def test_hanging_encoder_times_out(self):
        done = self.run_program(*self.FILM, "--timeout", "6", env=self.with_ffmpeg(self.HANGS))
        self.assertEqual(self.expect_cut(done, 5, r"error: stopped encoding frame 2\d after 6(\.\d+)? s \(--timeout\)"), 20)
        self.assertEqual(self.resume(*self.FILM)[0], "kept 20 of 30 frames")

    def test_hanging_encoder_ends_with_one_interrupt(self):
        process = self.start_hanging()
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 130)
        self.assertEqual(self.resume(*self.FILM)[0], "kept 20 of 30 frames")

    def test_a_second_capture_of_the_same_video_is_refused(self):
        first = self.start_hanging()
        before = self.contents()
        done = self.run_program(*self.FILM, "--resume")
        self.assertEqual(done.returncode, 4)
        self.assertRegex(done.stderr, r"error: cannot write 'out/a.mp4': process \d+ ")
        self.assertEqual(self.contents(), before)
        self.run_program("capture", "a.glsl", "--size", "64x36", "--frames", "0-2", "-o", "out/b.mp4", check=True)
        first.kill()
        first.wait()
        self.assertEqual(self.resume(*self.FILM)[0], "kept 20 of 30 frames")

    def test_the_folder_of_a_video_is_removed(self):
        self.write("a.glsl", SCENE.replace("400", "10000"))
        process = subprocess.Popen([PROGRAM, "capture", "a.glsl", "--size", "64x36", "--frames", "0-9999", "-o", "out/a.mp4"],
                                   cwd=self.folder, env=environment(), text=True, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
        while not list((self.folder / "out").glob(".a.mp4.segment-*")):
            self.assertIsNone(process.poll())
            time.sleep(0.002)
        shutil.rmtree(self.folder / "out")
        done = self.finished(process)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertRegex(done.stderr, r"error: cannot write 'out/a\.mp4[^']*': No such file or directory")

    def test_encoder_removed_between_segments(self):
        """After two segments; the next one finds none."""
        whole = self.whole(*self.FILM)
        env = self.with_ffmpeg('[ $run = 2 ] && rm tools/ffmpeg')
        env["PATH"] = str(self.folder / "tools")
        (self.folder / "tools").mkdir(exist_ok=True)
        for tool in ("sh", "wc", "rm"):
            (self.folder / "tools" / tool).symlink_to(shutil.which(tool))
        done = self.run_program(*self.FILM, env=env)
        kept = self.expect_cut(done, 4, r"error: cannot write 'out/a.mp4': there is no program 'ffmpeg'.* \(in frame \d+\)")
        self.assertEqual(self.resume(*self.FILM)[0], f"kept {kept} of 30 frames")
        self.assertEqual(self.contents(), whole)


@not_sanitized
class Memory(Failures):
    LARGE = ("capture", "fb", "--size", "16384x16384", "--frames", "3-4", "-o", "out/f_%d.png")

    def test_the_driver_is_out_of_memory(self):
        """Two pictures of 4 GiB, each more than llvmpipe makes."""
        if "llvmpipe" not in driver():  # whose limits the sizes are about
            self.skipTest("another driver may have the memory")
        self.write_feedback()
        self.expect_error([*self.LARGE], 4, "--size 16384x16384", "Buffer A")

    def test_memory_limit_is_exceeded(self):
        self.write_feedback()
        done = self.run_program("capture", "fb", "--size", "3000x3000", "--frames", "0-1", "-o", "out/f_%d.png", "--memory", "250M")
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertRegex(done.stderr, r"error: .* takes more than 250 MiB of memory \(--memory\)")
        self.assertRegex(done.stderr, r"preparing the first frame|\((before|in) frame \d\)")

    def test_drawing_process_killed_by_the_system(self):
        """As it does where memory has run out: the process that draws, not the one that looks after it."""
        process = self.start_slow()
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        os.kill(int(children[0]), signal.SIGKILL)
        done = self.finished(process)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertRegex(done.stderr, r"error: .* \(SIGKILL\), .* --memory .* \(in frame \d+\); .* --resume\n\Z")
        self.assertRegex(self.resume(*SEQUENCE)[0], r"kept \d+ of 20 frames")
        self.expect_whole()


if __name__ == "__main__":
    main()
