"""`compare`: two pictures or two sequences, their numbers, limits and errors."""
import json
import math
import shutil
import unittest

from support import browser, png
from support.program import ProgramTest, environment, main

METRICS = ["rmse", "psnr", "relative_mse", "largest", "ssim", "flip", "differing"]


class Compare(ProgramTest):
    def picture(self, name: str, value: int, size: tuple[int, int] = (16, 12)) -> str:
        width, height = size
        self.write(name, png.encode(width, height, 3, [bytes([value]) * (3 * width)] * height))
        return name

    def compared(self, *arguments: str, code: int = 0) -> dict:
        done = self.run_program("compare", *arguments, "--json")
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(done.stdout)

    def refuse(self, arguments: str, code: int, *named: str) -> None:
        with self.subTest(arguments=arguments):
            self.expect_error(["compare", *arguments.split()], code, *named)


class Pictures(Compare):
    def test_numbers(self):
        frame, = self.compared(self.picture("a.png", 100), self.picture("b.png", 151))["frames"]
        self.assertEqual(frame["largest"], 0.2)
        self.assertAlmostEqual(frame["rmse"], 0.2)
        self.assertAlmostEqual(frame["psnr"], -20 * math.log10(0.2))
        self.assertAlmostEqual(frame["relative_mse"], (0.2 / (100 / 255 + 0.01)) ** 2)
        # Two flat pictures: no variance, so that the luminance term of the definition is all there is.
        a, b = 100 / 255, 151 / 255
        self.assertAlmostEqual(frame["ssim"], (2 * a * b + 1e-4) / (a * a + b * b + 1e-4))
        self.assertEqual((frame["differing"], frame["equal"]), (100, False))
        self.assertEqual(frame["non_finite"], {"one": 0, "both": 0})

    def test_equal(self):
        self.picture("a.png", 9)
        done = self.succeed("compare", "a.png", "a.png", "--min-psnr", "99", "--max-flip", "0", "--min-ssim", "1")
        self.assertEqual(done.stdout.decode(), "RMSE 0, PSNR inf dB, relative MSE 0, largest difference 0, SSIM 1, "
                                               "FLIP 0, differing pixels 0 %\n")
        frame, = self.compared("a.png", "a.png")["frames"]
        self.assertEqual((frame["psnr"], frame["equal"]), (None, True))

    def test_limits(self):
        self.picture("a.png", 100), self.picture("b.png", 151)
        done = self.run_program("compare", "a.png", "b.png", "--max-rmse", "0.1", "--min-psnr", "5", "--max-differing",
                                "1")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "RMSE 0.2 is above --max-rmse 0.1\n"
                                      "differing pixels 100 % is above --max-differing 1\n")
        self.compared("a.png", "b.png", "--max-differing", "1", "--tolerance", "0.21")
        for limit in ("--max-rmse", "--max-relative-mse", "--max-difference", "--max-flip", "--max-differing"):
            self.compared("a.png", "b.png", limit, "0", code=1)
            self.compared("a.png", "b.png", limit, "101")
        for limit in ("--min-psnr", "--min-ssim"):
            self.compared("a.png", "b.png", limit, "99", code=1)
            self.compared("a.png", "b.png", limit, "0")

    def test_nan_is_counted_and_fails_every_limit(self):
        self.write("good.glsl", "void mainImage(out vec4 c, vec2 p) { c = vec4(.5); }")
        self.write("nan.glsl", "void mainImage(out vec4 c, vec2 p) { c = vec4(p.x < 1. ? sqrt(-p.x) : .5); }")
        for name in ("good", "nan"):
            self.succeed("capture", f"{name}.glsl", "--size", "20x20", "-o", f"{name}.exr", "--depth", "float")
        frame, = self.compared("good.exr", "nan.exr", "--max-rmse", "1e9", code=1)["frames"]
        self.assertEqual(frame["non_finite"], {"one": 20, "both": 0})
        self.assertEqual((frame["rmse"], frame["flip"], frame["largest"]), (None, None, 0))
        frame, = self.compared("nan.exr", "nan.exr", "--max-rmse", "0")["frames"]
        self.assertEqual(frame["non_finite"], {"one": 0, "both": 20})

    def test_every_limit_fails_for_nan_or_infinity_against_a_number(self):
        self.write("good.glsl", "void mainImage(out vec4 c, vec2 p) { c = vec4(.5); }")
        for name, value in (("nan", "sqrt(-p.x)"), ("inf", "1. / (p.x - .5)"), ("minus", "-1. / (p.x - .5)")):
            self.write(f"{name}.glsl", f"void mainImage(out vec4 c, vec2 p) {{ c = vec4(p.x < 1. ? {value} : .5); }}")
        for name in ("good", "nan", "inf", "minus"):
            self.succeed("capture", f"{name}.glsl", "--size", "20x20", "-o", f"{name}.exr", "--depth", "float")
        for frame, pair in enumerate((("good", "nan"), ("inf", "good"), ("nan", "inf"), ("inf", "minus"))):
            for side, name in zip("ab", pair):
                for sequence in (side if "good" in pair else "", side + "all"):
                    if sequence:
                        shutil.copy(self.folder / f"{name}.exr", self.folder / f"{sequence}_{frame:02}.exr")
        for frame, name in enumerate(("nan", "inf")):
            shutil.copy(self.folder / f"{name}.exr", self.folder / f"same_{frame:02}.exr")
        limits = [("--max-rmse", "1e9"), ("--max-relative-mse", "1e9"), ("--max-difference", "0"),
                  ("--max-difference", "1e9"), ("--max-flip", "2"), ("--max-differing", "100"), ("--min-psnr", "-1e9"),
                  ("--min-ssim", "-2")]
        for limit in limits:  # every frame of the sequence fails
            with self.subTest(limit=limit):
                done = self.run_program("compare", "a_##.exr", "b_##.exr", *limit)
                self.assertEqual(done.returncode, 1)
                self.assertEqual([line.split(":")[0] for line in done.stderr.splitlines()], ["frame 0", "frame 1"])
        done = self.run_program("compare", "aall_##.exr", "ball_##.exr", "--max-difference", "0")
        self.assertEqual(done.returncode, 1)
        self.assertEqual([line.split(":")[0] for line in done.stderr.splitlines()], [f"frame {n}" for n in range(4)])
        # The same of them in both is equal.
        every = [word for limit in limits for word in limit if limit != ("--max-difference", "1e9")]
        self.compared("same_##.exr", "same_##.exr", *every)
        self.compared("same_##.exr", "same_##.exr", "--max-differing", "0", "--min-ssim", "1", "--max-flip", "0")
        done = self.run_program("compare", "good.exr", "nan.exr", "--max-difference", "0", "--json")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(json.loads(done.stdout)["frames"]), 1)
        self.assertEqual(done.stderr, "largest difference 0 is not within --max-difference 0: NaN or infinity where the other "
                                      "picture has another value\n")

    def channels(self, name: str, *pixel: int) -> str:
        self.write(name, png.encode(16, 12, len(pixel), [bytes(pixel) * 16] * 12))
        return name

    def test_pictures_with_different_channels(self):
        rgb, grey = self.channels("rgb.png", 40, 40, 40), self.channels("grey.png", 40)
        opaque, clear = self.channels("opaque.png", 40, 40, 40, 255), self.channels("clear.png", 40, 40, 40, 204)
        coloured = self.channels("coloured.png", 40, 91, 40)
        for a, b, largest, note in (
                (rgb, opaque, 0, "only B has an alpha, 1 throughout: it is not compared"),
                (opaque, rgb, 0, "only A has an alpha, 1 throughout: it is not compared"),
                (rgb, clear, 0.2, "A has no alpha: it counts as 1"),
                (clear, rgb, 0.2, "B has no alpha: it counts as 1"),
                (opaque, clear, 0.2, None),
                (grey, rgb, 0, "A is grey: its value counts as red, green and blue"),
                (coloured, grey, 0.2, "B is grey: its value counts as red, green and blue"),
                (grey, opaque, 0, "A is grey: its value counts as red, green and blue; only B has an alpha, 1 "
                                  "throughout: it is not compared"),
                (clear, grey, 0.2, "B is grey: its value counts as red, green and blue; B has no alpha: it counts "
                                   "as 1")):
            with self.subTest(a=a, b=b):
                frame, = self.compared(a, b)["frames"]
                self.assertAlmostEqual(frame["largest"], largest)
                self.assertEqual(frame.get("note"), note)
                self.assertEqual(frame["equal"], largest == 0)
                if note:
                    self.assertIn("; " + note, self.succeed("compare", a, b, "-o", "d.png").stdout.decode())

    def test_ssim_of_small_pictures(self):
        self.picture("a.png", 100, (8, 20)), self.picture("b.png", 101, (8, 20))
        self.succeed("compare", "a.png", "a.png", "--min-ssim", "1")
        done = self.run_program("compare", "a.png", "b.png", "--min-ssim", "0.1")
        self.assertEqual((done.returncode, done.stderr), (1, "SSIM needs pictures of at least 11 pixels a side: use --min-psnr or "
                                                             "--max-rmse instead of --min-ssim\n"))
        self.assertIn(", no SSIM below 11 pixels a side, ", self.succeed("compare", "a.png", "b.png").stdout.decode())
        # A tolerance does not make pictures equal.
        self.compared("a.png", "b.png", "--min-ssim", "0.1", "--tolerance", "0.5", code=1)

    def test_difference_picture(self):
        self.picture("a.png", 100), self.picture("b.png", 110)
        self.succeed("compare", "a.png", "b.png", "-o", "d.png")
        self.assertEqual(png.read(self.folder / "d.png").pixel(3, 3), (80, 80, 80))
        self.succeed("compare", "a.png", "b.png", "-o", "d.png", "--gain", "2")
        self.assertEqual(png.read(self.folder / "d.png").pixel(3, 3), (20, 20, 20))
        self.succeed("compare", "a.png", "a.png", "-o", "d.png", "--map", "flip")
        self.assertEqual(png.read(self.folder / "d.png").pixel(3, 3), (0, 0, 5))

    def test_errors(self):
        self.picture("a.png", 1), self.picture("small.png", 1, (8, 8))
        self.refuse("a.png small.png", 1, "'a.png' and 'small.png': ", "16x12", "8x8")
        self.refuse("a.png none.png", 3, "cannot read 'none.png': no such file")
        self.refuse("a.png a.png -o no/d.png", 4, "'no/d.png': No such file or directory")
        self.refuse("a.png a.png -o -", 2, "-o: ")
        self.refuse("a.png a.png --gain 0", 2, "--gain: give a number above 0")
        self.refuse("a.png a.png --tolerance -1", 2, "--tolerance: give a number from 0")
        self.refuse("a.png a.png --max-rmse nan", 2, "--max-rmse: give a number, not 'nan'")


class Sequences(Compare):
    def setUp(self):
        super().setUp()
        for frame in (3, 4, 12):
            self.picture(f"a_{frame:04}.png", 100)
            self.picture(f"b{frame}.png", 100 + frame)

    def test_frames_are_paired_by_number(self):
        frames = self.compared("a_%04d.png", "b%d.png")["frames"]
        self.assertEqual([f["frame"] for f in frames], [3, 4, 12])
        for frame in frames:
            self.assertAlmostEqual(frame["largest"], frame["frame"] / 255)
        self.assertEqual(frames[2]["test"], "b12.png")

    def test_limits_name_the_frame(self):
        done = self.run_program("compare", "a_####.png", "b%d.png", "--max-difference", "0.02")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "frame 12: largest difference 0.0470588 is above --max-difference 0.02\n")

    def test_difference_pictures(self):
        self.succeed("compare", "a_####.png", "b%d.png", "-o", "d##.png", "--gain", "1")
        self.assertEqual([png.read(self.folder / f"d{n}.png").pixel(0, 0)[0] for n in ("03", "04", "12")], [3, 4, 12])

    def test_errors(self):
        self.picture("a_0005.png", 0)
        self.refuse("a_%04d.png b%d.png", 1, "frame 5 is missing: 'a_0005.png' has no counterpart in 'b%d.png'")
        self.refuse("b%d.png a_%04d.png", 1, "frame 5 is missing: 'a_0005.png' has no counterpart in 'b%d.png'")
        self.refuse("a_%04d.png b3.png", 2, "'a_%04d.png' is a sequence", "'b3.png'")
        self.refuse("x_%04d.png b%d.png", 3, "there is no file 'x_%04d.png'")
        self.refuse("a_%04x.png b%d.png", 2, "a_%04x.png: ", "%04d or ####")
        self.refuse("b%d.png b%d.png -o d.png", 2, "-o d.png: 3 frames ", "frame number")
        self.picture("b4.png", 0, (4, 4)), self.picture("b5.png", 0)
        self.refuse("a_%04d.png b%d.png", 1, "frame 4: 'a_0004.png' and 'b4.png': ", "16x12", "4x4")


class OnDevices(Compare):
    HASH = ("float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }\n"
            "void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(hash(p)), 1.0); }\n")

    def outcomes(self, devices: str, *arguments: str, code: int = 0, size: str = "32x18") -> dict[str, dict]:
        done = self.run_program("compare", "--devices", devices, "--size", size, "--json", *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        return {scene["scene"].removeprefix("./"): scene for scene in json.loads(done.stdout)["scenes"]}

    def write_scenes(self):
        """Noise with mipmaps, and a buffer with feedback."""
        self.write("sides.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.5, 1.0); }\n")
        self.write("noise.glsl", "void mainImage(out vec4 c, in vec2 p) { c = textureLod(iChannel0, p / 50.0, 2.0); }\n")
        self.write("project/image.glsl", '#iChannel0 "buffer_a.glsl"\nvoid mainImage(out vec4 c, in vec2 p) {'
                                         " c = texelFetch(iChannel0, ivec2(p), 0) / 16.0; }\n")
        self.write("project/buffer_a.glsl", '#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) {'
                                            " c = texelFetch(iChannel0, ivec2(p), 0) + vec4(1.0, p.x > 9.0, 0.5, 1.0); }\n")


class Devices(OnDevices):
    """`--devices`: llvmpipe against itself and against zink, which draws on it through Vulkan."""

    def test_a_device_equals_itself(self):
        self.write("a.glsl", self.HASH)
        self.write("scenes/b.glsl", self.HASH.replace("43758", "17"))
        (self.folder / "scenes" / "notes.txt").write_text("no scene\n")
        found = self.outcomes("surfaceless,mesa:llvmpipe", "a.glsl", "scenes")
        self.assertEqual({name: scene["verdict"] for name, scene in found.items()}, {"a.glsl": "same", "scenes/b.glsl": "same"})
        self.assertEqual(found["a.glsl"]["differing"], 0)

    def test_a_scene_that_compiles_on_neither_device(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(missing); }\n")
        scene = self.outcomes("surfaceless,mesa:llvmpipe", "a.glsl", code=1)["a.glsl"]
        self.assertEqual(scene["verdict"], "neither")
        self.assertIn("a.glsl:1", scene["problems"]["surfaceless"])

    def test_a_device_without_opengl_4_5_is_named(self):
        self.write("a.glsl", self.HASH)
        scene = self.outcomes("surfaceless,mesa:softpipe", "a.glsl", code=1)["a.glsl"]
        self.assertEqual(scene["verdict"], "one side only")
        self.assertIn("OpenGL 4.5", scene["problems"]["mesa:softpipe"])
        self.assertNotIn("Install", scene["problems"]["mesa:softpipe"])

    def test_zink_draws_and_is_explained(self):
        """A hash of products, whose constants compilers fold each in its own way."""
        if "unusable" in self.succeed("inspect", "--devices").stdout.decode().split("mesa:zink")[1].splitlines()[0]:
            self.skipTest("no zink here")
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.5, 1.0); }\n")
        self.write("b.glsl", "vec2 hash(vec2 p) {\n"
                             "    vec3 a = fract(p.xyy * vec3(123.34, 234.45, 345.56));\n"
                             "    a += dot(a, a + 67.78);\n"
                             "    return fract(vec2(a.x * a.y, a.y * a.z) * 1000.0);\n}\n"
                             "void mainImage(out vec4 c, in vec2 p) { c = vec4(hash(p * 1.37), 0.0, 1.0); }\n")
        found = self.outcomes("surfaceless,mesa:zink", "a.glsl", "b.glsl", "-o", "page")
        self.assertIn(found["a.glsl"]["verdict"], ("same", "within one level"))
        self.assertIn(found["b.glsl"]["verdict"], ("same", "within one level", "explained"))
        for cause in found["b.glsl"]["causes"]:
            self.assertIn(cause["places"][0]["line"], range(1, 7))
        page = (self.folder / "page" / "index.html").read_text()
        self.assertEqual(page.count("<article"), found["b.glsl"]["verdict"] == "explained")
        self.assertEqual('class="compare"' in page, found["b.glsl"]["verdict"] == "explained")
        self.assertIn('querySelector(".compare")', page)  # the script of the divider

    def test_errors(self):
        self.write("a.glsl", self.HASH)
        self.refuse("--devices surfaceless a.glsl", 2, "--devices")
        self.refuse("a.png", 2, "two pictures", "--devices")

    def test_opengl_es_draws_the_same(self):
        """softpipe weights neighbouring texels in another way, so its mipmaps are not compared."""
        self.write_scenes()
        self.write("volume.glsl", "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, vec3(p / 32.0, 0.3)); }\n")
        for device, scenes in (("es:surfaceless", ["."]), ("es:mesa:softpipe", ["sides.glsl", "volume.glsl", "project"])):
            for name, scene in self.outcomes(f"surfaceless,{device}", *scenes).items():
                with self.subTest(device=device, scene=name):
                    self.assertIn(scene["verdict"], ("same", "within one level"))

    def test_pictures_from_another_machine(self):
        sides = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.37, 1.0); }\n"
        for name, text in (("a", sides), ("b", sides), ("c", self.HASH)):
            self.write(f"{name}.glsl", text)
        self.succeed("capture", "a.glsl", "--size", "32x18", "--time", "10", "-o", "theirs/a.png")
        self.succeed("capture", "a.glsl", "--size", "16x9", "--time", "10", "-o", "theirs/b.png")
        self.assertEqual(self.outcomes("surfaceless,pictures:theirs", "a.glsl")["a.glsl"]["verdict"], "same")
        found = self.outcomes("surfaceless,pictures:theirs", "b.glsl", "c.glsl", code=1)
        self.assertEqual({scene["verdict"] for scene in found.values()}, {"one side only"})
        self.assertIn("give --size 16x9", found["b.glsl"]["problems"]["pictures:theirs"])
        self.assertIn("no picture c.png", found["c.glsl"]["problems"]["pictures:theirs"])

    def test_a_strict_device_must_be_second(self):
        self.write("a.glsl", self.HASH)
        for first in ("es:surfaceless", "chromium"):
            self.refuse(f"--devices {first},surfaceless a.glsl", 2, "second")


@unittest.skipUnless(browser.program(), "no Chromium here")
class Browsers(OnDevices):
    """The second device is headless Chromium, which draws the exported page."""

    def test_a_page_draws_the_same_with_the_same_driver(self):
        self.write_scenes()
        for name, scene in self.outcomes("surfaceless,chromium:egl", ".").items():
            with self.subTest(scene=name):
                self.assertIn(scene["verdict"], ("same", "within one level"))

    def test_swiftshaders_differences_are_explained(self):
        """All in one run, since a browser starts slowly. In the project each frame amplifies the one before it, so that Buffer A soon
        has nothing in common on the two devices."""
        hash, _ = self.HASH.splitlines()
        self.write("hash.glsl", self.HASH)
        self.write("project/image.glsl", '#iChannel0 "buffer_a.glsl"\nvoid mainImage(out vec4 c, in vec2 p) {'
                                         " c = texelFetch(iChannel0, ivec2(p), 0); }\n")
        self.write("project/buffer_a.glsl", f'#iChannel0 "self"\n{hash}\nvoid mainImage(out vec4 c, in vec2 p) {{'
                                            " c = fract(texelFetch(iChannel0, ivec2(p), 0) * 37.7 + hash(p)); }\n")
        self.write("remainder.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    int low = int(p.x) - 40;\n"
                                     "    c = vec4(float(low % 7) / 7.0, 0.5, 0.5, 1.0);\n}\n")
        self.write("derivative.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    float v = p.x * p.y * p.y;\n"
                                      "    c = vec4(fract(fwidth(v) / 64.0), 0.5, 0.5, 1.0);\n}\n")
        self.write("zero.glsl", "float near(float a, float b, float k) {\n    return clamp(0.5 - 0.5 * (a + b) / k, 0.0, 1.0);\n}\n"
                                "void mainImage(out vec4 c, in vec2 p) {\n"
                                "    c = vec4(near(p.x - 20.0, p.y * 0.3, 0.0), 0.5, 0.5, 1.0);\n}\n")
        self.write("order.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    float n = floor(p.x / 8.0);\n"
                                 "    c = vec4(vec2(n * 0.05, n += 3.0).x, 0.5, 0.5, 1.0);\n}\n")
        self.write("repeated.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    vec2 size = vec2(20.0, 0.0);\n"
                                    "    float d = length(mod(p, size) - 0.5 * size);\n"
                                    "    c = vec4(min(d, 5.0) / 5.0, 0.5, 0.5, 1.0);\n}\n")
        self.write("branch.glsl", "const float levels[4] = float[4](0.9, 0.3, 0.7, 0.2);\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                                  "    int k = int(p.x * 0.6) % 4;\n    c = vec4(0.5);\n    if ((int(p.x) & 1) == 1)\n"
                                  "        c.x = abs(dFdx(levels[k]));\n}\n")
        self.write("quotient.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(0.5);\n    if ((int(p.x) & 1) == 1)\n"
                                    "        c.x = fract(dFdx(mod(p.x * p.x / (1.0 + p.y), 7.0)));\n}\n")
        self.succeed("capture", "hash.glsl", "--size", "64x64", "-o", "noise.png")
        self.write("nearest.glsl", '#iChannel0 "noise.png"\n#iChannel0::MinFilter "Nearest"\n#iChannel0::MagFilter "Nearest"\n'
                                   "void mainImage(out vec4 c, in vec2 p) {\n"
                                   "    c = texture(iChannel0, floor(p) / -64.0 - 6e-6);\n}\n")
        self.write("levels.glsl", '#iChannel0 "noise.png"\n#iChannel0::MinFilter "LinearMipMapLinear"\n'
                                  "void mainImage(out vec4 c, in vec2 p) {\n    float step = (int(p.x) & 2) == 0 ? 0.011 : 0.037;\n"
                                  "    c = 8.0 * texture(iChannel0, step * p) - 3.5;\n}\n")
        self.write("known.glsl", "float wave(float x, float y) {\n    return fract(43758.5 * sin(x) + sin(y));\n}\n"
                                 "void mainImage(out vec4 c, in vec2 p) {\n    float t = 0.0;\n"
                                 "    c = vec4(wave(0.5 + t * 2.0, p.x), wave(p.y, 0.5), 0.5, 1.0);\n}\n")
        self.write("arc.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    float a = acos(0.3);\n"
                               "    c = vec4(fract(437.5 * cos(a) * a + p.x / 40.0), 0.5, 0.5, 1.0);\n}\n")
        self.write("steps.glsl", "float random(inout float seed) {\n    return fract(sin(seed += 0.1) * 43758.5453);\n}\n"
                                 "void mainImage(out vec4 c, in vec2 p) {\n    float seed = p.x * p.y * 0.37;\n"
                                 "    c = vec4(random(seed) * random(seed) * random(seed), 0.5, 0.5, 1.0);\n}\n")
        self.write("late/image.glsl", '#iChannel0 "buffer_a.glsl"\nvoid mainImage(out vec4 c, in vec2 p) {'
                                      " c = texelFetch(iChannel0, ivec2(p), 0); }\n")
        self.write("late/buffer_a.glsl", f'#iChannel0 "self"\n{hash}\nvoid mainImage(out vec4 c, in vec2 p) {{'
                                         " c = iFrame % 4 == 2 ? vec4(step(0.5, hash(p))) : texelFetch(iChannel0, ivec2(p), 0); }\n")
        # Both compilers multiply by 0.3 * 0.7; the sine of the model must not keep the driver from it.
        self.write("merged.glsl", "float third(float x) { return x * 0.3; }\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                                  "    float v = third(p.x * 1.37 + p.y * 0.11) * 0.7;\n"
                                  "    c = vec4(fract(sin(v) * 43758.5), 0.5, 0.5, 1.0);\n}\n")
        self.write("wrong.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    float f = 1;\n    c = vec4(f);\n}\n")
        found = self.outcomes("surfaceless,chromium:swiftshader", ".", code=1)
        for name, cause, place, line in (
                ("hash.glsl", "sine", "", 1), ("project", "sine", "Buffer A", 2), ("remainder.glsl", "undefined", "", 3),
                ("derivative.glsl", "derivatives", "", 3), ("zero.glsl", "undefined", "", 2), ("order.glsl", "order", "", 3),
                ("repeated.glsl", "undefined", "", 3), ("branch.glsl", "undefined", "", 6), ("quotient.glsl", "derivatives", "", 4),
                ("nearest.glsl", "filter", "", 5), ("levels.glsl", "filter", "", 5), ("known.glsl", "sine", "", 2),
                ("arc.glsl", "functions", "", 2), ("steps.glsl", "sine", "", 2), ("late", "sine", "Buffer A", 2),
                ("merged.glsl", "sine", "", 4)):
            with self.subTest(scene=name):
                scene = found[name]
                first = scene["causes"][0]
                self.assertEqual((scene["verdict"], first["cause"], first["pass"], first["places"][0]["line"]),
                                 ("explained", cause, place, line))
        self.assertGreater(found["project"]["differing"], 500)
        self.assertEqual(found["late"]["examined_frame"], 594)  # of 592 to 600, the frames that are drawn
        self.assertNotIn("examined_frame", found["project"])
        self.assertEqual(found["wrong.glsl"]["verdict"], "one side only")
        self.assertIn("wrong.glsl:2", found["wrong.glsl"]["problems"]["chromium:swiftshader"])

    def test_a_slow_scene_is_examined_in_a_smaller_picture(self):
        """Every pixel of the whole picture computes 50,000 random numbers, which takes seconds; of a smaller one 500."""
        hash, _ = self.HASH.splitlines()
        self.write("a.glsl", f"{hash}\nvoid mainImage(out vec4 c, in vec2 p) {{\n    uvec4 s = uvec4(p, p + 7.0);\n"
                             "    for (int i = 0; i < (iResolution.x > 300.0 ? 50000 : 500); ++i) s = s * 1664525u + s.yzwx;\n"
                             "    c = vec4(vec3(hash(p)) + 1e-20 * vec3(s.xyz), 1.0);\n}\n")
        scene = self.outcomes("surfaceless,chromium:swiftshader", "a.glsl", size="320x180")["a.glsl"]
        self.assertEqual((scene["verdict"], scene["causes"][0]["cause"]), ("explained", "sine"))
        self.assertEqual(scene["pixels"], 320 * 180)
        self.assertIn(scene["examined"], ([160, 90], [80, 45], [40, 22]))

    def test_without_chromium(self):
        self.write("a.glsl", self.HASH)
        done = self.run_program("compare", "--devices", "surfaceless,chromium", "a.glsl", env=environment(PATH="/nowhere"))
        self.assertEqual(done.returncode, 77)
        self.assertIn("install Debian's package chromium", done.stderr)


if __name__ == "__main__":
    main()
