"""`capture --samples` and `--shutter`: frames that are the mean of several."""
import shutil
import unittest

from support import png
from support.program import ProgramTest, main

DISC = "void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(step(distance(p, vec2(8.0 + 40.0 * iTime, 8.0)), 5.0)), 1.0); }\n"


class Exposure(ProgramTest):
    def setUp(self) -> None:
        super().setUp()
        self.write("disc.glsl", DISC)

    def levels(self, *options: str) -> set[int]:
        """Of red, in one frame."""
        self.succeed("capture", "disc.glsl", "--size", "16x16", "-o", "a.png", *options)
        return set(b"".join(png.read(self.folder / "a.png").rows)[::3])

    def test_edges_become_smooth(self) -> None:
        self.assertEqual(self.levels(), {0, 255})
        self.assertEqual(self.levels("--samples", "1"), {0, 255})
        smooth = self.levels("--samples", "64")
        self.assertGreater(len(smooth), 8)
        self.assertLessEqual({0, 255}, smooth)

    def test_a_shutter_alone_takes_16_samples(self) -> None:
        self.assertGreater(len(self.levels("--shutter", "1", "--fps", "10")), 8)
        self.assertIn("Samples=16", self.facts("a.png"))
        self.assertIn("Shutter=1", self.facts("a.png"))

    def facts(self, name: str) -> set[str]:
        return {f"{key.removeprefix('tidemark:')}={value}" for key, value in png.read(self.folder / name).text.items()}

    def test_the_same_picture_from_its_own_metadata(self) -> None:
        self.levels("--samples", "5", "--shutter", "0.5", "--frame", "3")
        self.succeed("capture", "--like", "a.png", "-o", "b.png")
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())
        self.succeed("capture", "--like", "a.png", "--samples", "6", "-o", "b.png")
        self.assertIn("Samples=6", self.facts("b.png"))

    def test_frames_with_other_samples_are_not_kept(self) -> None:
        sequence = ["capture", "disc.glsl", "--size", "16x16", "--frames", "0-2", "-o", "%d.png", "--resume", "--samples"]
        self.succeed(*sequence, "4")
        self.assertIn("kept 3 of 3", self.succeed(*sequence, "4").stderr)
        self.assertIn("kept 0 of 3", self.succeed(*sequence, "5").stderr)

    @unittest.skipUnless(shutil.which("ffmpeg"), "there is no ffmpeg")
    def test_videos_and_raw_frames(self) -> None:
        self.succeed("capture", "disc.glsl", "--size", "16x16", "--frames", "0-9", "--samples", "8", "-o", "a.mp4")
        raw = self.succeed("capture", "disc.glsl", "--size", "16x16", "--frames", "0-1", "--samples", "8", "-o", "-").stdout
        self.assertEqual(len(raw), 2 * 16 * 16 * 3)
        self.assertGreater(len(set(raw)), 4)

    def test_floats_are_not_clamped(self) -> None:
        self.write("bright.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(9.0 * step(8.0, p.x)); }\n")
        self.succeed("capture", "bright.glsl", "--size", "16x16", "--samples", "2", "-o", "a.exr", "--depth", "float")
        self.succeed("capture", "bright.glsl", "--size", "16x16", "-o", "b.exr", "--depth", "float")
        self.assertIn("RMSE 0,", self.succeed("compare", "a.exr", "b.exr").stdout.decode())

    def test_refuses_passes_that_cannot_be_averaged(self) -> None:
        self.write("trail.glsl", '#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n')
        self.write("shows.glsl", '#iChannel0 "trail.glsl"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n')
        self.write("holes.glsl", "void mainImage(out vec4 c, in vec2 p) { if (p.x < 9.0) discard; c = vec4(1.0); }\n")
        for words, says in ((["holes.glsl", "--samples", "4"], "Image cannot be drawn several times"),
                            (["shows.glsl", "--pass", "trail.glsl", "--samples", "4"], "only frames of Image can be averaged"),
                            (["shows.glsl", "--shutter", "0.5"], "reads its own last frame"),
                            (["disc.glsl", "--samples", "0"], "give a whole number from 1 to 65536"),
                            (["disc.glsl", "--shutter", "2"], "give a number from 0 to 1")):
            self.expect_failure_like(["capture", *words, "-o", "a.png"], 2, f".*{says}.*")


if __name__ == "__main__":
    main()
