"""`capture --resume`: what is there already is kept, the rest is drawn, and nobody can tell the result from one of
a capture that was never cut short. TIDEMARK_KILLS says how many captures are killed."""
import fcntl
import hashlib
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import threading
import time
import unittest

from support.program import PROGRAM, environment, main
from support.resume import SCENE, SEQUENCE, Resume

KILLS = int(os.environ.get("TIDEMARK_KILLS", "4"))

class Sequences(Resume):
    def test_keeps_existing_frames(self):
        for extension in ("png", "jpg", "tif", "exr"):
            sequence = (*SEQUENCE[:-1], f"out/f_%04d.{extension}")
            self.succeed(*sequence)
            whole = self.contents()
            before = os.stat(self.folder / f"out/f_0002.{extension}").st_mtime_ns
            for number in (3, 12):
                (self.folder / f"out/f_{number:04}.{extension}").unlink()
            self.assertEqual(self.resume(*sequence), [
                "kept 18 of 20 frames", f"wrote 2 frames, out/f_0003.{extension} to out/f_0012.{extension}"])
            self.assertEqual(self.contents(), whole)
            self.assertEqual(os.stat(self.folder / f"out/f_0002.{extension}").st_mtime_ns, before)
            if extension == "png":
                self.assertEqual(self.resume(*sequence), ["kept 20 of 20 frames"])
            for name in whole:
                (self.folder / "out" / name).unlink()

    def expect_redrawn(self, reason: str, *changes: str) -> None:
        lines = self.resume(*SEQUENCE, *changes)
        self.assertRegex(lines[0], f"drawing 20 frames again, from out/f_0000.png: .* {reason}$")
        self.assertEqual(lines[1], "kept 0 of 20 frames")
        self.assertEqual(self.resume(*SEQUENCE, *changes), ["kept 20 of 20 frames"])

    def test_redraws_frames_with_other_settings(self):
        self.succeed(*SEQUENCE)
        self.expect_redrawn("other knobs", "--set", "speed=0.75")
        self.expect_redrawn("other knobs, another time, size, mouse or camera", "--mouse", "3,4")
        self.expect_redrawn("another time, size, mouse or camera", "--size", "32x36")
        self.expect_redrawn("other drawing options, another time, size, mouse or camera", "--depth", "16")
        self.write("a.glsl", SCENE.replace("400", "401"))
        self.expect_redrawn("another text of the scene, other drawing options")

    def test_a_changed_input_redraws(self):
        def picture(value: int) -> bytes:
            return b"P6 1 1 255\n" + bytes([value] * 3)

        self.write("in.ppm", picture(10))
        self.write("a.glsl", '#iChannel0 "in.ppm"\n'
                             "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, vec2(0.5)); }\n")
        self.succeed(*SEQUENCE)
        self.write("in.ppm", picture(20))
        self.expect_redrawn("other inputs")

    def test_damaged_and_foreign_files(self):
        self.succeed(*SEQUENCE)
        whole = self.contents()
        self.write("out/f_0001.png", whole["f_0001.png"][:200])
        damaged = bytearray(whole["f_0005.png"])
        damaged[-40] ^= 1
        self.write("out/f_0005.png", bytes(damaged))
        self.write("out/f_0006.png", b"")
        self.write("out/f_0007.png", b"hello\n")
        lines = self.resume(*SEQUENCE)
        self.assertEqual(lines, [
            "drawing out/f_0001.png again: the file is damaged or cut short",
            "drawing out/f_0005.png again: the file is damaged: a checksum in it is wrong",
            "drawing out/f_0006.png again: the file is empty",
            "drawing out/f_0007.png again: it is not a picture",
            "kept 16 of 20 frames", "wrote 4 frames, out/f_0001.png to out/f_0007.png"])
        self.assertEqual(self.contents(), whole)

    def test_refuses_outputs_that_cannot_be_resumed(self):
        for output, why in (("-", "frames on standard output cannot be resumed"),
                            ("f_%d.hdr", "a .hdr cannot record how it was drawn: give a .png, .jpg, .tif or .exr"),
                            ("a.wav", "a sound cannot be resumed")):
            self.expect_failure(["capture", "a.glsl", "--frames", "0-1", "-o", output, "--resume"], 2,
                                f"tidemark: error: --resume: {why}")

    def test_six_faces_count_as_one_frame(self):
        self.write("cube/image.glsl", '#iChannel0 "Cube A"\n'
                                      "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, vec3(1)); }\n")
        self.write("cube/cube_a.glsl", "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) "
                                       "{ c = vec4(abs(d), 1); }\n")
        faces = ("capture", "cube", "--pass", "Cube A", "--frames", "0-1", "-o", "out/f_%d_{}.png")
        self.succeed(*faces)
        whole = self.contents()
        self.assertEqual(len(whole), 12)
        (self.folder / "out/f_1_ny.png").unlink()
        self.assertEqual(self.resume(*faces)[0], "kept 1 of 2 frames")
        self.assertEqual(self.contents(), whole)


class Feedback(Resume):
    RUN = ("capture", "fb", "--size", "32x18", "--frames", "0-49", "--state-every", "10", "-o", "out/f_%04d.png")

    def setUp(self):
        super().setUp()
        self.write_feedback()

    def cut(self, *arguments: str) -> None:
        """A capture whose frame 37 cannot be written: a folder is in its place."""
        (self.folder / "out/f_0037.png").mkdir()
        self.assertEqual(self.run_program(*arguments).returncode, 4)
        (self.folder / "out/f_0037.png").rmdir()

    def test_continues_from_the_state(self):
        whole = self.whole(*self.RUN)
        self.cut(*self.RUN)
        states = [name for name in self.contents() if name.endswith(".state")]
        self.assertEqual(states, ["f_0030.png.state"])
        for name in self.contents():
            if "f_003" in name and name > "f_0033.png":
                (self.folder / "out" / name).unlink()
        done = self.succeed(*self.RUN, "--resume", "--json")
        self.assertIn("state before frame 30", done.stderr)
        frames = {f["frame"]: f for f in json.loads(done.stdout)["frames"]}
        self.assertEqual(frames[min(frames)]["passes_drawn"], (min(frames) - 30) * 2 + 2)
        self.assertEqual(self.contents(), whole)

    def test_a_damaged_state_is_ignored(self):
        whole = self.whole(*self.RUN)
        for damage in (lambda b: b[:100], lambda b: b[:-70] + b"x" + b[-69:], lambda b: b"",
                       lambda b: b"[]\n" + hashlib.sha256(b"[]\n").hexdigest().encode()):
            self.cut(*self.RUN)
            state = self.folder / "out/f_0030.png.state"
            state.write_bytes(damage(state.read_bytes()))
            self.assertNotIn("continuing from", "".join(self.resume(*self.RUN)))
            self.assertEqual(self.contents(), whole)
            for name in whole:
                (self.folder / "out" / name).unlink()

    def test_an_oversized_state_is_ignored(self):
        """It takes no room on disk, and would take all memory."""
        whole = self.whole(*self.RUN)
        self.cut(*self.RUN)
        os.truncate(self.folder / "out/f_0030.png.state", 30 << 30)
        self.assertNotIn("continuing from", "".join(self.resume(*self.RUN)))
        self.assertEqual(self.contents(), whole)


@unittest.skipUnless(shutil.which("ffmpeg") and shutil.which("ffprobe"), "ffmpeg is not installed")
class Videos(Resume):
    KINDS = ((".webm", "a.glsl"), (".gif", "a.glsl"), (".mov", "a.glsl"), (".mp4", "fb"))

    def video(self, extension: str, scene: str = "a.glsl") -> list[str]:
        return ["capture", scene, "--size", "64x36", "--fps", "25", "--frames", "0-49", "--state-every", "10", "-o",
                f"out/a{extension}"]

    def cut(self, arguments: list[str], segments: int) -> None:
        """Killed when so many segments are whole."""
        name = arguments[-1][4:]
        last = self.folder / "out" / f"{name}.segment-{segments - 1:04}{'.mov' if name.endswith('.mov') else '.mp4'}"
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, env=environment(),
                                   stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not last.exists():
            self.assertIsNone(process.poll())
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        process.wait()

    def decoded(self, name: str) -> bytes:
        """Each frame's time and checksum."""
        return subprocess.run(["ffmpeg", "-v", "error", "-i", f"out/{name}", "-f", "framemd5", "-"], cwd=self.folder,
                              stdout=subprocess.PIPE, check=True).stdout

    def test_continues_after_whole_segments(self):
        self.write_feedback()
        for extension, scene in self.KINDS:
            arguments = self.video(extension, scene)
            whole = self.whole(*arguments)
            self.assertEqual(set(whole), {f"a{extension}"})
            self.cut(arguments, 2)
            self.assertNotIn(f"a{extension}", self.contents())
            lines = self.resume(*arguments)
            self.assertRegex(lines[0], r"kept [2345]0 of 50 frames")
            self.assertEqual(lines[-1], f"wrote out/a{extension}: 50 frames")
            self.assertEqual(scene == "fb" and lines[0] != "kept 50 of 50 frames",
                             any(line.startswith("continuing from ") for line in lines))
            self.assertEqual(self.contents(), whole)
            (self.folder / f"out/a{extension}").unlink()

    def test_waits_for_what_a_killed_capture_was_about_to_start(self):
        """A child has its parent's files open, and their locks, until it runs its own program: here for two seconds."""
        arguments = self.video(".mp4")
        self.cut(arguments, 2)
        mark, = (path for path in (self.folder / "out").iterdir() if path.suffix == ".capture")
        with mark.open() as file:
            fcntl.flock(file, fcntl.LOCK_EX)  # when the capture itself has ended
            timer = threading.Timer(2, file.close)
            timer.start()
            lines = self.resume(*arguments)
            timer.join()
        self.assertEqual(lines[-1], "wrote out/a.mp4: 50 frames")

    def test_damaged_and_foreign_segments_are_redrawn(self):
        arguments = self.video(".mp4")
        whole = self.whole(*arguments)
        self.cut(arguments, 3)
        damaged = self.folder / "out/a.mp4.segment-0000.mp4"
        content = bytearray(damaged.read_bytes())
        content[len(content) // 2] ^= 1
        damaged.write_bytes(content)
        self.assertNotIn("kept 50", self.resume(*arguments)[0])
        self.assertEqual(self.contents(), whole)
        self.cut(arguments, 2)
        self.assertTrue(self.resume(*arguments, "--set", "speed=0.75")[0].startswith("drawing frames 0 to 9 again: "))

    def test_segments_keep_the_frame_times(self):
        """Each frame appears when it does in a video of one segment, at a rate that no clock divides."""
        for extension in (".mp4", ".webm"):
            times = []
            for every in ("7", "1000"):
                self.succeed("capture", "a.glsl", "--size", "64x36", "--fps", "29.97", "--frames", "0-15", "--state-every",
                             every, "-o", f"out/{every}{extension}")
                lines = self.decoded(f"{every}{extension}").decode().splitlines()
                times.append([line.split(",")[:5] for line in lines if not line.startswith("#")])
            self.assertEqual(len(times[0]), 16)
            self.assertEqual(times[0], times[1])


class Killed(Resume):
    """At any instant, with a signal that nobody can answer."""

    def killed(self, arguments: list[str], seconds: float) -> bool:
        """False: it was ready before."""
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, env=environment(), start_new_session=True,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            process.wait(seconds)
            return False
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
            return True

    def kill_and_resume(self, sequence: list[str], kills: int) -> None:
        start = time.monotonic()
        whole = self.whole(*sequence)
        seconds = time.monotonic() - start
        chance = random.Random(1)
        killed = 0
        while killed < kills:
            resumed = [*sequence, "--resume"] if self.contents() else list(sequence)
            if self.killed(resumed, chance.uniform(0, seconds)):
                killed += 1
                continue
            self.assertEqual(self.contents(), whole)
            for name in whole:
                (self.folder / "out" / name).unlink()
        self.resume(*sequence)
        self.assertEqual(self.contents(), whole)

    def test_feedback(self):
        self.write_feedback()
        self.kill_and_resume([*Feedback.RUN[:4], "--frames", "0-199", *Feedback.RUN[6:]], KILLS)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_video(self):
        self.kill_and_resume(["capture", "a.glsl", "--size", "64x36", "--frames", "0-39", "--state-every", "20", "-o",
                              "out/a.mp4"], KILLS)

    def test_pictures(self):
        self.kill_and_resume(["capture", "a.glsl", "--size", "64x36", "--frames", "0-79", "-o", "out/f_%04d.png"],
                             KILLS)


if __name__ == "__main__":
    main()
