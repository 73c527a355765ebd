"""`capture --alpha`: what Image writes into fragColor.a, and how a file holds it."""
import json
import shutil
import struct
import subprocess
import unittest

from support import exr, png
from support.program import ProgramTest, main

SIZE = ("--size", "16x16")
# The colour of a pixel, and an alpha that is another in each column.
COLOUR = (0.5, 0.25, 1.0)
SCENE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5, 0.25, 1.0, floor(p.x) / 15.0); }\n"


def light(sample: float) -> float:
    """IEC 61966-2-1."""
    return sample / 12.92 if sample <= 0.04045 else ((sample + 0.055) / 1.055) ** 2.4


def tiff_fields(file: bytes) -> dict[int, int]:
    """The first value of each field of a little-endian TIFF's first directory."""
    at, = struct.unpack_from("<I", file, 4)
    count, = struct.unpack_from("<H", file, at)
    fields = (struct.unpack_from("<HHII", file, at + 2 + 12 * i) for i in range(count))
    return {tag: value & 0xffff if kind == 3 else value for tag, kind, _, value in fields}


class Alpha(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)

    def capture(self, name: str, *options: str, scene: str = "a.glsl") -> bytes:
        self.succeed("capture", scene, *SIZE, "-o", name, *options)
        return (self.folder / name).read_bytes()


class Pictures(Alpha):
    def test_alpha_is_one_by_default(self):
        plain = self.capture("a.png")
        self.assertEqual(png.read(self.folder / "a.png").channels, 3)
        self.assertEqual(self.capture("b.png", "--alpha", "opaque"), plain)

    def test_png_stores_straight_alpha(self):
        for depth, largest in (("8", 255), ("16", 65535)):
            self.capture("a.png", "--alpha", "keep", "--depth", depth)
            picture = png.read(self.folder / "a.png")
            self.assertEqual(picture.text["tidemark:Alpha"], "straight")
            for x in range(16):
                wanted = (*COLOUR, x / 15)
                for got, want in zip(picture.pixel(x, 3), wanted, strict=True):
                    self.assertLessEqual(abs(got - largest * want), 0.51)

    def test_all_frames_have_an_alpha_channel(self):
        """Compositors want one layout of a sequence; an alpha of 1 all over is there too."""
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5, 0.25, 1.0, 1.0); }\n")
        self.capture("a.png", "--alpha", "keep")
        picture = png.read(self.folder / "a.png")
        self.assertEqual({picture.pixel(x, y) for x in range(16) for y in range(16)}, {(128, 64, 255, 255)})

    def test_exr_stores_straight_or_premultiplied_alpha(self):
        for kind, times in (("keep", lambda a: 1.0), ("premultiplied", lambda a: a)):
            for transfer, decoded in (("srgb", lambda c: c), ("linear", light)):
                self.capture("a.exr", "--alpha", kind, "--transfer", transfer, "--depth", "float")
                part, = exr.read(self.folder / "a.exr")
                for x in range(16):
                    alpha = part.values("A")[x]
                    self.assertAlmostEqual(alpha, x / 15, places=6)
                    for channel, colour in zip("RGB", COLOUR):
                        self.assertAlmostEqual(part.values(channel)[x], decoded(colour) * times(alpha), places=6)

    def test_tiff_tags_the_kind_of_alpha(self):
        """Its field ExtraSamples: 1 for alpha that colours are multiplied by, 2 for alpha that they are not."""
        for depth in ("8", "16", "float"):
            for kind, value in (("keep", 2), ("premultiplied", 1)):
                self.assertEqual(tiff_fields(self.capture("a.tif", "--alpha", kind, "--depth", depth))[338], value)
        # Another reader of the file gets the numbers as they are stored.
        self.capture("a.tif", "--alpha", "premultiplied")
        self.write("reads.glsl", '#iChannel0 "a.tif"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n')
        self.succeed("capture", "reads.glsl", *SIZE, "--alpha", "keep", "-o", "b.png")
        picture = png.read(self.folder / "b.png")
        for x in range(16):
            for got, want in zip(picture.pixel(x, 0), (*(colour * x / 15 for colour in COLOUR), x / 15), strict=True):
                self.assertLessEqual(abs(got - 255 * want), 0.51)

    def test_bands_are_the_picture_drawn_whole(self):
        for name, options in (("a.png", ("--alpha", "keep")), ("a.exr", ("--alpha", "premultiplied")),
                              ("a.tif", ("--alpha", "premultiplied", "--depth", "16"))):
            self.assertEqual(self.capture(name, *options), self.capture("bands" + name, *options, "--tile", "4"))

    def test_scene_with_its_own_main(self):
        self.write("m.glsl", "out vec4 colour; void main() { colour = vec4(1.0, 0.0, 0.0, 0.2); }\n")
        self.capture("m.png", "--alpha", "keep", scene="m.glsl")
        self.assertEqual(png.read(self.folder / "m.png").pixel(0, 0), (255, 0, 0, 51))
        self.capture("n.png", scene="m.glsl")
        self.assertEqual(png.read(self.folder / "n.png").pixel(0, 0), (255, 0, 0))

    def test_alpha_of_a_layer(self):
        self.capture("a.exr", "--alpha", "premultiplied")
        alone, = exr.read(self.folder / "a.exr")
        self.capture("b.exr", "--alpha", "premultiplied", "--layers")
        layer, = exr.read(self.folder / "b.exr")
        self.assertEqual((layer.name, layer.samples), ("Image", alone.samples))

    def test_smooth_edges_keep_the_colour_of_the_covering_part(self):
        """Red up to the middle of a pixel, behind it green of no coverage: half of a red pixel, not a brown one."""
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = p.x < 8.5 ? vec4(1, 0, 0, 1) : vec4(0, 1, 0, 0); }\n")
        self.capture("a.png", "--alpha", "keep", "--samples", "64")
        picture = png.read(self.folder / "a.png")
        self.assertEqual(picture.pixel(7, 4), (255, 0, 0, 255))
        self.assertEqual(picture.pixel(9, 4), (0, 0, 0, 0))
        red, green, blue, alpha = picture.pixel(8, 4)
        self.assertEqual((red, green, blue), (255, 0, 0))
        self.assertLessEqual(abs(alpha - 127.5), 4)

    def test_warns_of_alpha_outside_0_to_1(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { float a = p.x < 1.0 ? -0.5 : p.x < 3.0 ? 1.5 : p.x < 4.0 ? sqrt(-p.x) : 0.5;"
                             " c = vec4(0.5, 0.25, 1.0, a); }\n")
        done = self.succeed("capture", "a.glsl", *SIZE, "--alpha", "keep", "-o", "a.png", "--json")
        self.assertIn("warning: alpha is below 0 or above 1 in 48 pixels of frame 0; the file stores them as 0 or "
                      "1\n", done.stderr)
        self.assertIn("warning: 16 pixels of frame 0 are not finite; find the origin with: tidemark check --trace a.glsl", done.stderr)
        frame, = json.loads(done.stdout)["frames"]
        self.assertEqual((frame["no_coverage"], frame["not_finite"]), (48, 16))
        picture = png.read(self.folder / "a.png")
        self.assertEqual([picture.pixel(x, 0)[3] for x in range(5)], [0, 255, 255, 0, 128])
        done = self.succeed("capture", "a.glsl", *SIZE, "--alpha", "keep", "-o", "a.exr", "--frames", "0-2",
                            "-o", "%d.exr", "--tile", "4")
        self.assertIn("in 48 pixels of frame 0 (and of 2 other frames); the file stores them unchanged\n", done.stderr)
        part, = exr.read(self.folder / "0.exr")
        self.assertEqual([*part.values("A")[:3], part.values("A")[4]], [-0.5, 1.5, 1.5, 0.5])
        self.assertNotEqual(part.values("A")[3], part.values("A")[3])

    def test_resume_redraws_frames_with_another_alpha(self):
        sequence = ["capture", "a.glsl", *SIZE, "--frames", "0-2", "-o", "%d.tif", "--resume"]
        self.succeed(*sequence, "--alpha", "keep")
        self.assertIn("kept 3 of 3", self.succeed(*sequence, "--alpha", "keep").stderr)
        self.assertIn("kept 0 of 3", self.succeed(*sequence, "--alpha", "premultiplied").stderr)

    def test_refused(self):
        def refused(words: str, *options: str) -> None:
            self.expect_error(["capture", "a.glsl", "--alpha", *options], 2, f"--alpha {options[0]}:", words)

        for name in ("a.jpg", "a.hdr", "a.mp4", "a.gif", "-"):
            refused("no alpha", "keep", "-o", name)
        refused("no alpha", "keep", "-o", "a.webm", "--codec", "av1")
        for name in ("a.png", "a.webp", "a.webm"):
            refused(f"{name[1:]} stores straight alpha", "premultiplied", "-o", name)
        refused("only Image ", "keep", "-o", "a.png", "--pass", "Buffer A")
        refused("give opaque, keep or premultiplied", "straight", "-o", "a.png")


@unittest.skipUnless(shutil.which("ffmpeg") and shutil.which("ffprobe"), "ffmpeg is not installed")
class Videos(Alpha):
    def test_prores(self):
        for kind in ("keep", "premultiplied"):
            self.capture("a.mov", "--alpha", kind, "--frames", "0-2")
            probed = subprocess.run(["ffprobe", "-v", "error", "-show_streams", "-of", "json", "a.mov"], cwd=self.folder,
                                    stdout=subprocess.PIPE, check=True).stdout
            stream, = json.loads(probed)["streams"]
            self.assertEqual((stream["codec_name"], stream["pix_fmt"], stream["nb_frames"]), ("prores", "yuva444p12le", "3"))
            raw = subprocess.run(["ffmpeg", "-v", "error", "-i", "a.mov", "-frames:v", "1", "-pix_fmt", "yuva444p12le",
                                  "-f", "rawvideo", "-"], cwd=self.folder, stdout=subprocess.PIPE, check=True).stdout
            planes = struct.unpack("<1024H", raw)
            for x in range(16):
                alpha = x / 15
                luma = (0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722) * (1 if kind == "keep" else alpha)
                self.assertLessEqual(abs(planes[8 * 16 + x] - 16 * (16 + 219 * luma)), 16, (kind, x))
                self.assertLessEqual(abs(planes[3 * 256 + 8 * 16 + x] - 4095 * alpha), 5, (kind, x))
        self.capture("b.mov", "--frames", "0-2")
        self.assertNotEqual((self.folder / "a.mov").read_bytes(), (self.folder / "b.mov").read_bytes())

    def test_vp9(self):
        """Halves of other colours and coverage, from segments with a sound."""
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = p.x < 32.0 ? vec4(1, 0, 0, 0.5) : vec4(0, 0, 1, 1); }\n")
        self.capture("a.webm", "--alpha", "keep", "--frames", "0-6", "--size", "64x36", "--state-every", "3")
        probed = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", "a.webm"],
                                cwd=self.folder, stdout=subprocess.PIPE, check=True).stdout
        stream, = json.loads(probed)["streams"]
        self.assertEqual((stream["codec_name"], stream["nb_read_frames"], stream["color_space"]), ("vp9", "7", "bt709"))
        self.assertEqual({key.lower(): value for key, value in stream["tags"].items()}["alpha_mode"], "1")
        # ffmpeg's own decoder drops the alpha.
        raw = subprocess.run(["ffmpeg", "-v", "error", "-c:v", "libvpx-vp9", "-i", "a.webm", "-pix_fmt", "rgba", "-f", "rawvideo", "-"],
                             cwd=self.folder, stdout=subprocess.PIPE, check=True).stdout
        self.assertEqual(len(raw), 7 * 64 * 36 * 4)
        for frame in range(7):
            for x, wanted in ((8, (255, 0, 0, 128)), (56, (0, 0, 255, 255))):
                at = 4 * (frame * 64 * 36 + 18 * 64 + x)
                for got, want in zip(raw[at:at + 4], wanted, strict=True):
                    self.assertLessEqual(abs(got - want), 4, (frame, x, tuple(raw[at:at + 4])))
        once = (self.folder / "a.webm").read_bytes()
        self.assertEqual(self.capture("a.webm", "--alpha", "keep", "--frames", "0-6", "--size", "64x36"), once)

    def test_webp_is_read_as_it_is_written(self):
        """Its colours not multiplied by alpha: 0 where that is 0, which WebP drops."""
        self.write("reads.glsl", '#iChannel0 "a.webp"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n')
        self.capture("a.webp", "--alpha", "keep", "--frame", "0")
        self.capture("b.png", "--alpha", "keep", scene="reads.glsl")
        picture = png.read(self.folder / "b.png")
        for x in range(1, 16):
            self.assertEqual(picture.pixel(x, 5), (128, 64, 255, 17 * x))
        self.write("a.glsl", SCENE.replace("0.5, 0.25, 1.0", "p / iResolution.xy, 1.0"))  # rows are where they were
        self.capture("a.webp", "--alpha", "keep", "--frame", "0")
        self.capture("b.png", "--alpha", "keep", scene="reads.glsl")
        picture = png.read(self.folder / "b.png")
        self.assertEqual([picture.pixel(9, y)[1] for y in (0, 15)], [8, 247])

    def test_an_animation_is_divided_again(self):
        self.write("reads.glsl", '#iChannel0 "a.webp"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n')
        self.capture("a.webp", "--alpha", "keep", "--frames", "0-2")
        self.capture("b.png", "--alpha", "keep", scene="reads.glsl")
        picture = png.read(self.folder / "b.png")
        for x in range(1, 16):
            for got, want in zip(picture.pixel(x, 5), (128, 64, 255, 17 * x), strict=True):
                self.assertLessEqual(abs(got - want), 128 / (17 * x) + 1)

    def test_webp_keeps_every_visible_byte(self):
        self.write("a.glsl", SCENE.replace("floor(p.x) / 15.0", "(floor(p.x) + 1.0) / 16.0"))
        self.capture("a.webp", "--alpha", "keep", "--frame", "0")  # ffmpeg reads no animated ones
        raw = subprocess.run(["ffmpeg", "-v", "error", "-i", "a.webp", "-pix_fmt", "rgba", "-f", "rawvideo", "-"],
                             cwd=self.folder, stdout=subprocess.PIPE, check=True).stdout
        self.capture("a.png", "--alpha", "keep", "--frame", "0")
        self.assertEqual(raw, b"".join(png.read(self.folder / "a.png").rows))
        self.assertEqual(tuple(raw[12:16]), (128, 64, 255, 64))


if __name__ == "__main__":
    main()
