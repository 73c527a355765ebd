"""`capture --crop X,Y,W,H`: a part of each picture is written, of the frame drawn whole."""
import json
import shutil
import subprocess
import unittest

from support import exr, png
from support.program import ProgramTest, main

SIZE = ("--size", "40x24")
# Depends on the place and on the size: a smaller frame would have other pixels.
SCENE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, fract(iTime + p.x * 0.3), 1.0); }\n"
LEFT, BOTTOM, WIDTH, HEIGHT = 7, 3, 16, 10
CROP = ("--crop", f"{LEFT},{BOTTOM},{WIDTH},{HEIGHT}")


class Crop(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)

    def picture(self, name: str, *options: str, scene: str = "a.glsl") -> png.Picture:
        self.succeed("capture", scene, "-o", name, *options)
        return png.read(self.folder / name)

    def part(self, whole: png.Picture, area: tuple[int, int, int, int] = (LEFT, BOTTOM, WIDTH, HEIGHT)) -> list[bytes]:
        """Rows of that rectangle, from the top."""
        left, bottom, width, height = area
        step = whole.channels * whole.depth // 8
        top = whole.height - bottom - height
        return [row[left * step:(left + width) * step] for row in whole.rows[top:top + height]]

    def expect_part(self, *options: str, scene: str = "a.glsl", size: tuple[str, ...] = SIZE) -> None:
        whole = self.picture("whole.png", *size, *options, scene=scene)
        cropped = self.picture("crop.png", *size, *options, *CROP, scene=scene)
        self.assertEqual((cropped.width, cropped.height), (WIDTH, HEIGHT), options)
        self.assertEqual(cropped.rows, self.part(whole), options)

    def test_pixels_are_those_of_the_whole_frame(self):
        for options in ((), ("--frame", "9"), ("--depth", "16"), ("--alpha", "keep"), ("--samples", "4"),
                        ("--samples", "4", "--alpha", "keep"), ("--tile", "16"), ("--tile", "4", "--depth", "16"),
                        ("--tile", "16", "--samples", "2")):
            self.expect_part(*options)

    def test_crop_of_one_pixel_and_of_the_whole_frame(self):
        whole = self.picture("whole.png", *SIZE)
        for area in ((0, 0, 1, 1), (39, 23, 1, 1), (0, 5, 40, 1)):
            cropped = self.picture("crop.png", *SIZE, "--crop", ",".join(map(str, area)))
            self.assertEqual(cropped.rows, self.part(whole, area))
        self.succeed("capture", "a.glsl", *SIZE, "--crop", "0,0,40,24", "-o", "all.png")
        self.assertEqual((self.folder / "all.png").read_bytes(), (self.folder / "whole.png").read_bytes())

    def test_size_that_the_scene_states(self):
        self.write("s.glsl", "#iSize 40x24\n" + SCENE)
        self.expect_part(scene="s.glsl", size=())
        self.expect_error(["capture", "s.glsl", "--crop", "0,0,41,24"], 2, "--crop 0,0,41,24", "40x24 pixels")

    def test_a_buffer(self):
        self.write("s/image.glsl", '#iChannel0 "Buffer A"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n')
        self.write("s/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / 64.0, 0.5, p.y > 4.0 ? 0.5 : 1.0); }\n")
        self.expect_part("--pass", "Buffer A", scene="s")
        self.expect_part(scene="s")

    def test_layers_of_an_exr(self):
        self.write("s/image.glsl", '#iChannel0 "Buffer A"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n')
        self.write("s/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / 37.0, 1.0e6 / 3.0, p.x); }\n")
        self.write("s/cube_a.glsl", "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(d, 1.0); }\n")
        self.succeed("capture", "s", *SIZE, "--layers", "-o", "whole.exr")
        self.succeed("capture", "s", *SIZE, "--layers", "-o", "crop.exr", *CROP)
        whole, cropped = (exr.read(self.folder / name) for name in ("whole.exr", "crop.exr"))
        self.assertEqual([part.name for part in cropped], [part.name for part in whole])
        for one, other in zip(whole, cropped):
            if one.name.startswith("Cube"):
                self.assertEqual((other.size, other.blocks == one.blocks), ((1024, 1024), True))
                continue
            self.assertEqual(other.size, (WIDTH, HEIGHT))
            top = 24 - BOTTOM - HEIGHT
            for channel, kind in one.channels:
                samples = one.values(channel)
                wanted = [samples[y * 40 + LEFT:y * 40 + LEFT + WIDTH] for y in range(top, top + HEIGHT)]
                self.assertEqual(other.values(channel), tuple(value for row in wanted for value in row), (one.name, channel))

    def test_a_cube_is_cut_as_its_panorama(self):
        self.write("s/image.glsl", SCENE)
        self.write("s/cube_a.glsl", "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(d * 0.5 + 0.5, 1.0); }\n")
        raw = self.succeed("capture", "s", "--pass", "Cube A", "-o", "-").stdout
        whole = png.from_raw(4096, 2048, raw)
        area = (4000, 2000, 96, 48)
        cropped = self.picture("crop.png", "--pass", "Cube A", "--crop", "4000,2000,96,48", scene="s")
        self.assertEqual(cropped.rows, self.part(whole, area))
        self.expect_error(["capture", "s", "--pass", "Cube A", "--crop", "0,0,16,16", "-o", "sky_{}.png"], 2,
                          "--crop 0,0,16,16", "faces of a cube")

    def test_raw_frames_and_sheets(self):
        whole = self.picture("whole.png", *SIZE, "--frame", "5")
        raw = self.succeed("capture", "a.glsl", *SIZE, *CROP, "--frames", "5-6", "-o", "-").stdout
        self.assertEqual(len(raw), 2 * 3 * WIDTH * HEIGHT)
        self.assertEqual(raw[:3 * WIDTH * HEIGHT], b"".join(self.part(whole)))
        sheet = self.picture("sheet.png", *SIZE, *CROP, "--frames", "5-6", "--sheet", "2x1")
        self.assertEqual((sheet.width, sheet.height), (2 * WIDTH + 8, HEIGHT))
        self.assertEqual([row[:3 * WIDTH] for row in sheet.rows], self.part(whole))

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_video_has_the_size_of_the_crop(self):
        self.succeed("capture", "a.glsl", *SIZE, *CROP, "--frames", "0-9", "-o", "a.mp4")
        done = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "stream=width,height", "-of", "csv=p=0", "a.mp4"],
                              cwd=self.folder, stdout=subprocess.PIPE, text=True, check=True)
        self.assertEqual(done.stdout.strip(), f"{WIDTH},{HEIGHT}")
        (self.folder / "out").mkdir()
        for shard in ("1/2", "2/2"):
            self.succeed("capture", "a.glsl", *SIZE, *CROP, "--frames", "0-9", "--state-every", "5", "--shard", shard, "-o", "out/a.mp4")
        self.succeed("gather", "out")
        self.succeed("capture", "a.glsl", *SIZE, *CROP, "--frames", "0-9", "--state-every", "5", "-o", "b.mp4")
        self.assertEqual((self.folder / "out/a.mp4").read_bytes(), (self.folder / "b.mp4").read_bytes())

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_shards_of_unevenly_spaced_frames(self):
        """How long each frame is shown is part of the whole capture's identity, not of a shard's."""
        (self.folder / "out").mkdir()
        for shard in ("1/2", "2/2"):
            self.succeed("capture", "a.glsl", *SIZE, *CROP, "--frames", "0,1,4,6,16,17", "--state-every", "3", "--shard", shard,
                         "-o", "out/a.mp4")
        self.succeed("gather", "out")

    def test_crop_is_part_of_the_fingerprint(self):
        sequence = ("capture", "a.glsl", *SIZE, "--frames", "0-2", "-o", "%d.png", "--resume")
        self.succeed(*sequence, *CROP)
        self.assertIn("kept 3 of 3", self.succeed(*sequence, *CROP).stderr)
        for other in ((), ("--crop", "7,3,16,9"), ("--crop", "8,3,16,10")):
            done = self.succeed(*sequence, *other)
            self.assertIn("kept 0 of 3", done.stderr, other)
            self.assertIn("other drawing options", done.stderr)

    def test_shards(self):
        (self.folder / "out").mkdir()
        for shard in ("1/2", "2/2"):
            self.succeed("capture", "a.glsl", *SIZE, *CROP, "--frames", "0-5", "-o", "out/%d.png", "--shard", shard)
        self.assertIn("the same pixels", self.succeed("gather", "out").stderr)
        self.assertEqual(self.part(self.picture("whole.png", *SIZE, "--frame", "4")), png.read(self.folder / "out/4.png").rows)

    def test_report_and_metadata(self):
        done = self.succeed("capture", "a.glsl", *SIZE, *CROP, "-o", "crop.png", "--json")
        report = json.loads(done.stdout)
        self.assertEqual((report["size"], report["crop"]), ([40, 24], [LEFT, BOTTOM, WIDTH, HEIGHT]))
        picture = png.read(self.folder / "crop.png")
        self.assertEqual(report["frames"][0]["sha256"], picture.sha256())
        self.assertEqual((picture.text["tidemark:Size"], picture.text["tidemark:Crop"]),
                         ("40x24", f"{LEFT},{BOTTOM},{WIDTH},{HEIGHT}"))
        done = self.succeed("capture", "a.glsl", *SIZE, "-o", "whole.png", "--json")
        self.assertNotIn("crop", json.loads(done.stdout))
        self.assertNotIn("tidemark:Crop", png.read(self.folder / "whole.png").text)

    def test_like_repeats_the_crop(self):
        cropped = self.picture("crop.png", *SIZE, *CROP, "--frame", "9")
        self.succeed("capture", "--like", "crop.png", "-o", "again.png")
        self.assertEqual(png.read(self.folder / "again.png").rows, cropped.rows)
        self.succeed("capture", "--like", "crop.png", "--crop", "0,0,40,24", "-o", "whole.png")
        self.assertEqual(self.part(png.read(self.folder / "whole.png")), cropped.rows)
        self.succeed("capture", "--like", "crop.png", "--size", "80x48", "-o", "large.png")
        self.assertEqual(png.read(self.folder / "large.png").width, 80)

    def test_non_finite_pixels_are_counted_in_the_crop_only(self):
        self.write("nan.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p.x < 1.0 ? sqrt(-1.0 - iTime) : 0.5, 0.5, 0.5, 1.0); }\n")
        for name in ("a.png", "a.exr"):
            for crop, count in (("0,0,3,5", 5), ("1,0,3,5", 0)):
                done = self.succeed("capture", "nan.glsl", *SIZE, "--crop", crop, "-o", name, "--json")
                self.assertEqual(json.loads(done.stdout)["frames"][0]["not_finite"], count, (name, crop))

    def test_a_loop(self):
        """The part is still while the rest moves."""
        self.write("half.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p.x < 20.0 ? 0.5 : fract(iTime), 0.0, 0.0, 1.0); }\n")
        done = self.succeed("capture", "half.glsl", *SIZE, "--crop", "0,0,20,24", "--frames", "0-3", "--loop", "-o", "%d.png", "--json")
        self.assertIsNone(json.loads(done.stdout)["loop"]["closing_psnr"])

    def test_errors(self):
        def refused(crop: str, words: str, *options: str) -> None:
            with self.subTest(crop=crop):
                self.expect_error(["capture", "a.glsl", *SIZE, f"--crop={crop}", *options], 2, f"--crop {crop}:", words)

        for wrong in ("x", "1,2", "1,2,3", "1,2,3,4,5", "1,2,0,4", "1,2,3,-4", "1.5,2,3,4", "0,0,99999999999,1"):
            refused(wrong, "X,Y,WIDTH,HEIGHT")
        for outside in ("-1,0,4,4", "0,-1,4,4", "0,0,41,1", "0,0,1,25", "37,0,4,4", "0,24,1,1", "2147483647,0,2147483647,1"):
            refused(outside, "40x24")


if __name__ == "__main__":
    main()
