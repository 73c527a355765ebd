"""`capture --from, --to, --duration`: the part of the scene's time that is captured; folders of outputs; a scene from standard input."""
import array
import subprocess

from support import png
from support.program import PROGRAM, ProgramTest, environment, main

SCENE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(float(iFrame) / 255.0, iTime / 10.0, 0.0, 1.0); }\n"
SIZE = ("--size", "8x8")


class Time(ProgramTest):
    def setUp(self) -> None:
        super().setUp()
        self.write("a.glsl", SCENE)

    def captured(self, *options: str) -> list[int]:
        """The numbers of the frames."""
        for old in self.folder.glob("s_*.png"):
            old.unlink()
        self.succeed("capture", "a.glsl", *SIZE, *options, "-o", "s_%d.png")
        return sorted(int(file.stem[2:]) for file in self.folder.glob("s_*.png"))

    def test_part_of_the_duration(self) -> None:
        self.assertEqual(self.captured("--from", "1", "--to", "1.5", "--fps", "10"), [10, 11, 12, 13, 14])
        self.assertEqual(png.read(self.folder / "s_12.png").pixel(0, 0)[:2], (12, round(25.5 * 1.2)))
        self.assertEqual(self.captured("--duration", "0.3", "--fps", "10"), [0, 1, 2])
        self.assertEqual(self.captured("--from", "2", "--duration", "0.1"), [120, 121, 122, 123, 124, 125])
        self.assertEqual(self.captured("--to", "0.05", "--fps", "10"), [0])  # one frame at least
        self.assertEqual(self.captured("--from", "1.001", "--to", "1.1", "--fps", "24000/1001"), [24, 25])
        raw = self.succeed("capture", "a.glsl", *SIZE, "--duration", "0.5", "--fps", "10", "-o", "-").stdout
        self.assertEqual(len(raw), 5 * 8 * 8 * 3)
        sheet = self.succeed("capture", "a.glsl", *SIZE, "--sheet", "2x1", "--from", "1", "--duration", "1", "--fps", "10", "-o", "x.png")
        self.assertIn("frames 10 to 15", sheet.stderr)

    def test_like_keeps_the_frame_rate_of_its_picture(self) -> None:
        self.succeed("capture", "a.glsl", *SIZE, "--fps", "10", "--frame", "3", "-o", "one.png")
        self.succeed("capture", "--like", "one.png", "--from", "1", "--to", "1.2", "-o", "t_%d.png")
        self.assertEqual({file.name for file in self.folder.glob("t_*")}, {"t_10.png", "t_11.png"})

    def test_sound_of_a_part(self) -> None:
        self.write("s/image.glsl", SCENE)
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) { return vec2(t < 1.0 ? 0.0 : 0.5); }")
        self.succeed("capture", "s", "--from", "0.75", "--to", "1.25", "-o", "new/s.wav")
        data = (self.folder / "new/s.wav").read_bytes()[44:]
        self.assertEqual(len(data), 4 * 22050)
        samples = array.array("h", data)
        self.assertEqual([samples.index(16384), set(samples[:22050]), set(samples[22050:])], [22050, {0}, {16384}])
        # Across the blocks of 262,144 samples in which it is drawn.
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) { return vec2(0.5); }")
        self.succeed("capture", "s", "--from", "3.1", "--duration", "9", "-o", "long.wav")
        self.assertEqual(set(array.array("h", (self.folder / "long.wav").read_bytes()[44:])), {16384})

    def test_errors(self) -> None:
        def refused(options: str, words: str) -> None:
            self.expect_error(["capture", "a.glsl", *options.split()], 2, words)

        refused("--from 1 -o s_%d.png", "--from 1: also give --to or --duration")
        refused("--from -1 --to 1 -o s_%d.png", "--from: give a number of seconds from 0 up")
        refused("--from 1 --to 1 -o s_%d.png", "--to 1: give a time after the beginning at 1 s")
        refused("--to 2 --duration 1 -o s_%d.png", "give --to or --duration, not both")
        refused("--duration 0 -o s_%d.png", "--duration 0: give a number of seconds above 0")
        refused("--duration 1 --frames 0-9 -o s_%d.png", "--frames: --from, --to and --duration select the frames already")
        refused("--duration 1 --time 2 -o s_%d.png", "--time: --from, --to and --duration select the frames already")
        refused("--duration 1e9 -o s_%d.png", "are too many frames")
        refused("--duration 1 -o s.png", "60 frames need a frame number in the name")

    def test_missing_folders_are_created(self) -> None:
        self.succeed("capture", "a.glsl", *SIZE, "--frames", "0-1", "-o", "new/deep/a_%04d.png")
        self.assertEqual({file.name for file in (self.folder / "new/deep").iterdir()}, {"a_0000.png", "a_0001.png"})
        self.succeed("capture", "a.glsl", *SIZE, "--frames", "0-1", "-o", "n%d/a.png")
        self.assertTrue((self.folder / "n0/a.png").exists() and (self.folder / "n1/a.png").exists())
        self.expect_error(["capture", "a.glsl", *SIZE, "-o", "a.glsl/a.png"], 4, "'a.glsl/a.png': Not a directory")
        self.expect_error(["capture", "none.glsl", *SIZE, "-o", "other/a.png"], 3, "none.glsl")
        self.assertFalse((self.folder / "other").exists())

    def test_scene_from_standard_input(self) -> None:
        def fed(text: str, *options: str) -> subprocess.CompletedProcess:
            return subprocess.run([PROGRAM, "capture", "-", *SIZE, *options], input=text, cwd=self.folder, env=environment(),
                                  text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

        self.write("lib.glsl", "vec4 red() { return vec4(1.0, 0.0, 0.0, 1.0); }\n")
        done = fed('#include "lib.glsl"\nvoid mainImage(out vec4 c, in vec2 p) { c = red(); }\n')
        self.assertEqual((done.returncode, done.stderr), (0, "wrote stdin.png\n"))
        self.assertEqual(png.read(self.folder / "stdin.png").pixel(3, 3)[:3], (255, 0, 0))
        done = fed("void mainImage(out vec4 c, in vec2 p) {\n    c = nothing;\n}\n")
        self.assertEqual(done.returncode, 3)
        self.assertIn("-:2", done.stderr)


if __name__ == "__main__":
    main()
