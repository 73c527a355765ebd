"""Frames that are read back behind the drawing: the bytes of those that are read at once, in every kind of output,
and nothing is lost by it. Where the processor draws it is not done unless TIDEMARK_READ_BACK says so."""
import os
import re
import shutil
import signal
import subprocess
import time
import unittest
from unittest import mock

import lost_output_test
import resume_test
from support.program import PROGRAM, ProgramTest, environment, main

AHEAD = environment(TIDEMARK_READ_BACK="ahead")
AT_ONCE = environment(TIDEMARK_READ_BACK="at-once")

SCENE = """void mainImage(out vec4 c, in vec2 p) {
    c = vec4(p / iResolution.xy, fract(iTime), p.x / iResolution.x);
    if (iFrame == 3 && p.x < 4.0) c.r = sqrt(-p.x);
}
"""


class SameBytes(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)
        self.write("fb/image.glsl", '#iChannel0 "Buffer A"\n'
                                    "void mainImage(out vec4 c, in vec2 p) { c = fract(texelFetch(iChannel0, ivec2(p), 0)); }\n")
        self.write("fb/buffer_a.glsl", '#iChannel0 "Buffer A"\nvoid mainImage(out vec4 c, in vec2 p) {\n'
                                       "  c = texelFetch(iChannel0, ivec2(p), 0) * 1.01 + vec4(p.x, p.y, 1.0, iTime) * 0.001;\n}\n")

    def outcome(self, env: dict[str, str], *arguments: str) -> tuple[str, bytes, dict[str, bytes]]:
        out = self.folder / "out"
        out.mkdir()
        done = self.run_program("capture", *arguments, env=env)
        self.assertEqual(done.returncode, 1 if "--loop" in arguments else 0, done.stderr)  # the scene is no loop
        files = {str(path.relative_to(out)): path.read_bytes() for path in out.rglob("*")}
        shutil.rmtree(out)
        slow = re.compile(r"Ctrl-C (ends it|stops)|^\d+/\d+ frames, ")  # what a busy machine says besides
        said = [line for line in done.stderr.splitlines() if not slow.search(line)]
        return "\n".join(said), done.stdout, files

    def same(self, *arguments: str) -> dict[str, bytes]:
        """How many outputs there are is for the caller to say: nothing is the same as nothing."""
        at_once, ahead = self.outcome(AT_ONCE, *arguments), self.outcome(AHEAD, *arguments)
        self.assertEqual(ahead[:2], at_once[:2])
        self.assertEqual(set(ahead[2]), set(at_once[2]))
        self.assertEqual([name for name in ahead[2] if ahead[2][name] != at_once[2][name]], [])
        self.assertTrue(ahead[1] or ahead[2])
        return ahead[2]

    def test_pictures(self):
        run = ("a.glsl", "--size", "37x21", "--frames")
        self.assertEqual(len(self.same(*run, "0-9", "-o", "out/%d.png")), 10)
        self.assertEqual(len(self.same(*run, "0-1", "-o", "out/%d.png")), 2)
        self.assertEqual(len(self.same(*run, "7,2,5", "-o", "out/%d.png")), 3)
        self.same(*run, "0-4", "-o", "out/%d.exr", "--depth", "float", "--alpha", "premultiplied")
        self.same(*run, "0-4", "-o", "out/%d.tif", "--depth", "16")

    def test_a_nan_is_counted_in_its_own_frame(self):
        said, _, _ = self.outcome(AHEAD, "a.glsl", "--size", "8x4", "--frames", "0-9", "-o", "out/%d.png")
        self.assertIn("warning: 16 pixels of frame 3 are not finite;", said)

    def test_standard_output(self):
        done = self.succeed("capture", "a.glsl", "--size", "16x8", "--frames", "0-9", "-o", "-", env=AHEAD)
        self.assertEqual(len(done.stdout), 10 * 16 * 8 * 3)
        self.same("a.glsl", "--size", "16x8", "--frames", "0-9", "-o", "-")

    def test_sheets_loops_and_passes(self):
        self.same("a.glsl", "--size", "16x8", "--sheet", "3x2", "-o", "out/a.png")
        self.assertEqual(len(self.same("a.glsl", "--size", "16x8", "--frames", "0-5", "--loop", "-o", "out/%d.png")), 6)
        self.same("fb", "--size", "16x8", "--frames", "0-5", "--pass", "Buffer A", "-o", "out/%d.exr")
        self.same("fb", "--size", "16x8", "--frames", "0-5", "--pass", "Buffer A", "-o", "out/%d.png")
        self.same("a.glsl", "--size", "16x8", "--frames", "0-5", "--samples", "3", "-o", "out/%d.png")
        self.same("a.glsl", "--size", "16x8", "--frames", "0-5", "--tile", "4", "-o", "out/%d.png")

    def test_feedback(self):
        self.assertEqual(len(self.same("fb", "--size", "16x8", "--frames", "3-9", "-o", "out/%d.png")), 7)
        self.same("fb", "--size", "16x8", "--frames", "0-40x8", "--state-every", "4", "-o", "out/%d.png")

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_videos(self):
        for name in ("a.mp4", "a.webm", "a.mov"):
            self.same("fb", "--size", "64x36", "--frames", "0-11", "--state-every", "5", "-o", f"out/{name}")


class Ends(ProgramTest):
    def test_drawn_frames_are_written_after_an_interrupt(self):
        self.write("a.glsl", resume_test.SCENE.replace("400", "40000"))
        (self.folder / "out").mkdir()
        process = subprocess.Popen([PROGRAM, *resume_test.SEQUENCE], cwd=self.folder, env=AHEAD, text=True,
                                   stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
        while not (self.folder / "out/f_0002.png").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.002)
        process.send_signal(signal.SIGINT)
        stderr = process.communicate()[1]
        self.assertEqual(process.returncode, 130, stderr)
        whole = len(list((self.folder / "out").iterdir()))
        self.assertIn(f"interrupted after {whole} of 20 frames; ", stderr)
        self.assertEqual({path.name for path in (self.folder / "out").iterdir()},
                         {f"f_{i:04}.png" for i in range(whole)})


# Tests of other files that are run with the variable set; `./dev soak` (TIDEMARK_KILLS) runs all of theirs.
RESUMED = (
    (resume_test.Feedback, ("continues_from_the_state",)),
    (resume_test.Videos, ("continues_after_whole_segments",)),
    (lost_output_test.Folders, ("a_full_disk", "the_folder_is_removed")),
    (lost_output_test.Encoders, ("killed_encoder", "hanging_encoder_ends_with_one_interrupt", "the_folder_of_a_video_is_removed")),
)


class Ahead(unittest.TestCase):

    def setUp(self):
        self.enterContext(mock.patch.dict(os.environ, TIDEMARK_READ_BACK="ahead"))
        super().setUp()


def load_tests(loader: unittest.TestLoader, tests: unittest.TestSuite, _pattern: str | None) -> unittest.TestSuite:
    for case, names in RESUMED:
        soak = "TIDEMARK_KILLS" in os.environ
        ahead = type(case.__name__, (Ahead, case), {} if soak else {"KINDS": ((".mp4", "fb"),)})  # test_videos has others
        wanted = loader.getTestCaseNames(ahead) if soak else [f"test_{name}" for name in names]
        tests.addTests(ahead(name) for name in wanted)
    return tests


if __name__ == "__main__":
    main()
