"""`capture --transfer`: what the samples of a file stand for, and that the file says so."""
import json
import shutil
import struct
import subprocess
import unittest

from support import png
from support.program import ProgramTest, main

# Sixteen levels of each colour; a part of red below the straight beginning of sRGB's curve.
SCENE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p.x / 255.0, p.y / 16.0, 0.5, 1.0); }\n"
SIZE = ("--size", "16x16")
BT709 = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)


def light(sample: float) -> float:
    """IEC 61966-2-1."""
    return sample / 12.92 if sample <= 0.04045 else ((sample + 0.055) / 1.055) ** 2.4


class Transfer(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)

    def capture(self, name: str, *options: str) -> bytes:
        self.succeed("capture", "a.glsl", *SIZE, "-o", name, *options)
        return (self.folder / name).read_bytes()


class Png(Transfer):
    def chunks(self, file: bytes) -> dict[bytes, bytes]:
        return {kind: data for kind, data in png.chunks(file) if kind in (b"sRGB", b"gAMA", b"cHRM")}

    def test_srgb(self):
        chunks = self.chunks(self.capture("a.png"))
        self.assertEqual(chunks[b"sRGB"], b"\0")
        self.assertEqual(struct.unpack(">I", chunks[b"gAMA"]), (45455,))
        self.assertEqual(self.capture("a.png", "--transfer", "srgb"), self.capture("b.png"))

    def test_linear(self):
        chunks = self.chunks(self.capture("a.png", "--transfer", "linear", "--depth", "16"))
        self.assertEqual(set(chunks), {b"gAMA", b"cHRM"})
        self.assertEqual(struct.unpack(">I", chunks[b"gAMA"]), (100000,))
        white, primaries = BT709[6:], BT709[:6]
        self.assertEqual(struct.unpack(">8I", chunks[b"cHRM"]), tuple(round(1e5 * x) for x in (*white, *primaries)))
        picture = png.read(self.folder / "a.png")
        for x in range(16):
            for y in range(16):
                wanted = [65535 * light(sample) for sample in ((x + 0.5) / 255, (y + 0.5) / 16, 0.5)]
                for got, want in zip(picture.pixel(x, y), wanted):
                    self.assertLessEqual(abs(got - want), 0.51, (x, y))

    def test_bands_are_the_picture_drawn_whole(self):
        options = ("--transfer", "linear", "--depth", "16")
        self.assertEqual(self.capture("whole.png", *options), self.capture("bands.png", *options, "--tile", "4"))

    def test_a_buffer_holds_numbers(self):
        self.write("s/image.glsl", '#iChannel0 "Buffer A"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n')
        self.write("s/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }\n")
        buffer = ("capture", "s", *SIZE, "--pass", "Buffer A", "-o")
        self.succeed(*buffer, "a.png")
        self.assertEqual(self.chunks((self.folder / "a.png").read_bytes()), {})
        self.succeed(*buffer, "b.png", "--transfer", "srgb")
        self.assertIn(b"sRGB", self.chunks((self.folder / "b.png").read_bytes()))
        self.succeed(*buffer, "a.exr")
        self.assertEqual(exr_attributes((self.folder / "a.exr").read_bytes())["colorInteropID"], b"data")


def exr_attributes(file: bytes) -> dict[str, bytes]:
    attributes, at = {}, 8
    while file[at]:
        name, kind, rest = file[at:].split(b"\0", 2)
        size, = struct.unpack_from("<I", rest)
        at += len(name) + len(kind) + 2 + 4 + size
        attributes[name.decode()] = rest[4:4 + size]
    return attributes


class Exr(Transfer):
    def expect(self, name: str, interop_id: bytes) -> None:
        attributes = exr_attributes((self.folder / name).read_bytes())
        self.assertEqual(attributes["colorInteropID"], interop_id)
        for got, want in zip(struct.unpack("<8f", attributes["chromaticities"]), BT709):
            self.assertAlmostEqual(got, want, places=6)

    def test_metadata_name_the_transfer(self):
        self.capture("a.exr")
        self.expect("a.exr", b"srgb_rec709_display")
        self.capture("b.exr", "--transfer", "linear")
        self.expect("b.exr", b"lin_rec709_scene")

    def test_light_beyond_0_and_1(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(2.0, -0.5, 0.5, 1.0); }\n")
        self.capture("a.exr", "--transfer", "linear", "--depth", "float")
        wanted = ", ".join(f"{x:.9f}" for x in (light(2), -light(0.5), light(0.5)))
        self.write("reads.glsl", '#iChannel0 "a.exr"\nvoid mainImage(out vec4 c, in vec2 p) '
                                 f"{{ c = vec4(lessThan(abs(texelFetch(iChannel0, ivec2(p), 0).rgb - vec3({wanted})), vec3(1e-6)), 1.0); }}\n")
        self.assertEqual(self.succeed("capture", "reads.glsl", *SIZE, "-o", "-").stdout, b"\xff" * 768)


class Profiles(Transfer):
    def curve(self, file: bytes) -> tuple[float, ...]:
        """Of the profile's red: the parameters of its parametric curve."""
        start = file.index(b"acsp") - 36
        profile = file[start:start + struct.unpack_from(">I", file, start)[0]]
        count, = struct.unpack_from(">I", profile, 128)
        tags = dict((name, (at, size)) for name, at, size in struct.iter_unpack(">4sII", profile[132:132 + 12 * count]))
        self.assertLessEqual({b"desc", b"cprt", b"wtpt", b"chad", b"rXYZ", b"gXYZ", b"bXYZ", b"gTRC", b"bTRC"}, set(tags))
        for at, size in tags.values():
            self.assertEqual((at % 4, at + size <= len(profile)), (0, True))
        sums = [sum(struct.unpack_from(">i", profile, tags[colour][0] + 8 + 4 * i)[0] for colour in (b"rXYZ", b"gXYZ", b"bXYZ"))
                for i in range(3)]
        white = struct.unpack_from(">3i", profile, tags[b"wtpt"][0] + 8)
        self.assertLessEqual(max(abs(a - b) for a, b in zip(sums, white)), 8)  # of 65536
        at, size = tags[b"rTRC"]
        self.assertEqual(profile[at:at + 4], b"para")
        return tuple(x / 65536 for x, in struct.iter_unpack(">i", profile[at + 12:at + size]))

    def test_srgb(self):
        for name in ("a.jpg", "a.tif"):
            g, a, b, c, d = self.curve(self.capture(name))
            for level in range(256):
                x = level / 255
                self.assertAlmostEqual((a * x + b) ** g if x >= d else c * x, light(x), delta=1e-4)

    def test_linear(self):
        for depth in ("16", "float"):
            self.assertEqual(self.curve(self.capture("a.tif", "--transfer", "linear", "--depth", depth)), (1.0,))


class Others(Transfer):
    def test_resume_redraws_frames_with_another_transfer(self):
        sequence = ["capture", "a.glsl", *SIZE, "--depth", "16", "--frames", "0-2", "-o", "%d.png", "--resume"]
        self.succeed(*sequence)
        self.assertIn("kept 3 of 3", self.succeed(*sequence).stderr)
        self.assertIn("kept 0 of 3", self.succeed(*sequence, "--transfer", "linear").stderr)

    def test_refused(self):
        for options, words in (
                (["-o", "a.png"], "linear: 8 bits of linear light show steps in dark areas: give --depth 16, or an .exr"),
                (["-o", "a.jpg"], "linear: 8 bits of linear light show steps in dark areas: give --depth 16, or an .exr"),
                (["-o", "a.mp4"], "linear: videos and raw frames on standard output are always sRGB"),
                (["-o", "-"], "linear: videos and raw frames on standard output are always sRGB")):
            self.expect_failure(["capture", "a.glsl", *options, "--transfer", "linear"], 2,
                                f"tidemark: error: --transfer {words}")
        self.expect_error(["capture", "a.glsl", "--transfer", "log"], 2, "--transfer log")

    @unittest.skipUnless(shutil.which("ffmpeg") and shutil.which("ffprobe"), "ffmpeg is not installed")
    def test_videos_match_their_colour_tags(self):
        """Known colours come back within a code value of BT.709's matrix in the limited range."""
        for name, scale, form in (("a.mp4", 1, "yuv444p"), ("a.webm", 1, "yuv444p"), ("a.mov", 4, "yuv444p10le")):
            for red, green, blue in ((255, 0, 0), (12, 200, 77), (128, 128, 128)):
                self.write("a.glsl", f"void mainImage(out vec4 c, in vec2 p) {{ c = vec4({red}, {green}, {blue}, 255) / 255.0; }}\n")
                self.capture(name, "--frames", "0-1")
                probed = subprocess.run(["ffprobe", "-v", "error", "-show_streams", "-of", "json", name], cwd=self.folder,
                                        stdout=subprocess.PIPE, check=True).stdout
                stream, = json.loads(probed)["streams"]
                # A .mov does not store the range of ProRes, which is always that of television: ffmpeg 7 says nothing.
                self.assertEqual([stream.get(key, "tv") for key in ("color_primaries", "color_transfer", "color_space", "color_range")],
                                 ["bt709", "iec61966-2-1", "bt709", "tv"], name)
                raw = subprocess.run(["ffmpeg", "-v", "error", "-i", name, "-frames:v", "1", "-pix_fmt", form, "-f", "rawvideo", "-"],
                                     cwd=self.folder, stdout=subprocess.PIPE, check=True).stdout
                planes = struct.unpack(f"<{3 * 256}{'B' if scale == 1 else 'H'}", raw)
                luma = (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255
                wanted = (16 + 219 * luma, 128 + 224 * (blue / 255 - luma) / 1.8556, 128 + 224 * (red / 255 - luma) / 1.5748)
                for plane, want in enumerate(wanted):
                    got = planes[256 * plane + 8 * 16 + 8]
                    self.assertLessEqual(abs(got - scale * want), scale, (name, red, green, blue, plane))


if __name__ == "__main__":
    main()
