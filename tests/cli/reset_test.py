"""A graphics driver that is reset, or has no memory: support/reset_driver.cpp, preloaded, says so at a draw of the test's
choosing. The drawing itself goes on; what a real one loses with its context is for machines that have one."""
import pathlib
import shutil
import unittest

from support.program import PROGRAM, ProgramTest, environment, main, not_sanitized

DRIVER = pathlib.Path(PROGRAM).parent / "tidemark_reset_driver.so"
SCENE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, fract(iTime), 1.0); }\n"
KNOBS = """#iUniform int turns = 8 in { 1, 16 }
void mainImage(out vec4 c, in vec2 p) {
    float sum = 0.0;
    for (int i = 0; i < turns; i++) sum += sin(p.x * float(i) + iTime) / float(i + 1);
    c = vec4(0.5 + 0.2 * sum, sin(p.y), 0.0, 1.0);
}
"""
SEQUENCE = ("capture", "a.glsl", "--size", "32x18", "--frames", "0-19", "-o", "out/f_%02d.png")


@unittest.skipUnless(DRIVER.exists(), "the library that resets the driver is not built")
class Reset(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)
        (self.folder / "out").mkdir()

    def contents(self) -> dict[str, bytes]:
        return {path.name: path.read_bytes() for path in (self.folder / "out").iterdir()}

    def struck(self, *arguments: str, **faults: str):
        """The program is prepared by one draw, and each frame is another."""
        return self.run_program(*arguments, env=environment(LD_PRELOAD=str(DRIVER), **faults))

    def expect_cut(self, fault: str, words: str, code: int, read_back: str) -> None:
        self.succeed(*SEQUENCE)
        whole = self.contents()
        for name in whole:
            (self.folder / "out" / name).unlink()
        done = self.struck(*SEQUENCE, TIDEMARK_READ_BACK=read_back, **{fault: "6"})
        self.assertEqual(done.returncode, code, done.stderr)
        frame = len(self.contents())  # the next one is named
        self.assertRegex(done.stderr, rf"\Atidemark: error: .* {words} .* frame {frame}\b.*; {frame} frames .* --resume\n\Z")
        self.assertEqual(self.contents(), {name: whole[name] for name in sorted(whole)[:frame]})
        self.assertEqual(self.succeed(*SEQUENCE, "--resume").stderr.splitlines()[0], f"kept {frame} of 20 frames")
        self.assertEqual(self.contents(), whole)

    @not_sanitized
    def test_sequences(self):
        for read_back in ("at-once", "ahead"):
            with self.subTest(read_back):
                self.expect_cut("TIDEMARK_TEST_RESET", "reset", 5, read_back)
                self.expect_cut("TIDEMARK_TEST_OUT_OF_MEMORY", "out of memory", 4, read_back)

    @not_sanitized
    def test_tiles(self):
        done = self.struck("capture", "a.glsl", "--size", "64x64", "--tile", "16", "-o", "out/a.png", TIDEMARK_TEST_RESET="6")
        self.assertRegex(done.stderr, r"\Atidemark: error: .* reset .* frame 0: .+\n\Z")
        self.assertEqual((done.returncode, self.contents()), (5, {}))

    @not_sanitized
    def test_before_the_first_frame(self):
        done = self.struck("capture", "a.glsl", "--size", "8x8", "-o", "out/a.png", TIDEMARK_TEST_RESET="1")
        self.assertRegex(done.stderr, r"\Atidemark: error: .* reset .* the first frame: .+\n\Z")
        self.assertEqual((done.returncode, self.contents()), (5, {}))

    @not_sanitized
    def test_reset_without_memory_for_the_picture(self):
        done = self.struck("capture", "a.glsl", "--size", "2048x2048", "-o", "out/a.png", TIDEMARK_TEST_NO_TARGET="1")
        self.assertRegex(done.stderr, r"\Atidemark: error: --size 2048x2048: .* \(before frame 0\)\n\Z")
        self.assertEqual((done.returncode, self.contents()), (4, {}))

    @not_sanitized
    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_videos(self):
        run = ("capture", "a.glsl", "--size", "32x18", "--frames", "0-19", "--state-every", "5", "-o", "out/a.mp4")
        self.succeed(*run)
        whole = self.contents()
        (self.folder / "out/a.mp4").unlink()
        done = self.struck(*run, TIDEMARK_TEST_RESET="14")  # frame 12
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("reset while drawing frame 12", done.stderr)
        self.assertRegex(done.stderr, "; 10 frames .* --resume\n")
        self.assertIn("kept 10 of 20 frames", self.succeed(*run, "--resume").stderr)
        self.assertEqual(self.contents(), whole)

    @not_sanitized
    def test_measuring_commands_print_nothing(self):
        """A number that was taken of a lost context is none: nothing is printed, nothing is written."""
        self.write("k.glsl", KNOBS)
        of_measuring = "reset while measuring: .* --size"
        for command, words in {("study", "k.glsl", "--vary", "turns=2,4,8"): of_measuring,
                               ("tune", "k.glsl", "--vary", "turns=2,4,8", "--max-error", "rmse=0.1"): of_measuring,
                               ("simplify", "k.glsl"): of_measuring,
                               ("trace", "k.glsl", "--pixel", "3,3"): "reset while drawing the pixel: "}.items():
            with self.subTest(command[0]):
                output = () if command[0] == "trace" else ("-o", "out/report")
                done = self.struck(*command, "--size", "32x18", *output, TIDEMARK_TEST_RESET="1")
                self.assertEqual((done.returncode, done.stdout), (5, b""), done.stderr)
                self.assertRegex(done.stderr, f"tidemark: error: .* {words}")
                self.assertEqual([path.name for path in (self.folder / "out").rglob("*") if path.is_file()], [])

    @not_sanitized
    def test_probes(self):
        """The probe that it met has that as its answer; the others get a driver that works."""
        probes = ("check", "a.glsl", "--probe", "times", "--probe", "repeats")
        self.assertRegex(self.succeed(*probes).stdout, rb"(?s)^pass  times .*\npass  repeats .*\nnothing found; ")
        done = self.struck(*probes, TIDEMARK_TEST_RESET="10")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout.decode(), "(?m)^fail +times +.* reset while drawing: ")
        self.assertRegex(done.stdout.decode(), "(?m)^pass +repeats")

    @not_sanitized
    def test_fixes(self):
        self.write("faulty.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(sqrt(p.x - 3.0), 0.0, 0.0, 1.0); }\n")
        self.assertIn(b"+void mainImage", self.run_program("check", "faulty.glsl", "--fix").stdout)
        done = self.struck("check", "faulty.glsl", "--fix", TIDEMARK_TEST_RESET="2")
        self.assertEqual((done.returncode, done.stdout), (5, b""), done.stderr)
        self.assertIn("reset while drawing fixes: ", done.stderr)


if __name__ == "__main__":
    main()
