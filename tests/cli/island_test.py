"""`tidemark_bake` of shaders/bake: the ramps; the fields of an island, by what a scene reads of them; its study."""
import json
import math

from support import png
from support.program import BAKE, ROOT, ProgramTest, has_context, main


class Ramps(ProgramTest):
    def test_equal_the_pictures_of_the_scenes(self):
        done = self.succeed("--ramps", ".", program=BAKE)
        self.assertEqual(done.stderr, "wrote ./water_ramp.png\nwrote ./foam_ramp.png\nwrote ./wave_ramps.png\n")
        self.assertEqual(self.files(), {"water_ramp.png", "foam_ramp.png", "wave_ramps.png"})
        for name in ("water_ramp.png", "foam_ramp.png", "wave_ramps.png"):
            baked, kept = png.read(self.folder / name), png.read(ROOT / "textures" / name)
            self.assertEqual((baked.width, baked.height, baked.channels), (kept.width, kept.height, kept.channels))
            self.assertTrue(baked.rows == kept.rows, name)

    def test_errors(self):
        self.expect_error(["--ramps", "none"], 4, "'none/water_ramp.png'", "No such file or directory", program=BAKE)


class Island(ProgramTest):
    """What a scene reads of the file, through a scene: each texel once, as bytes of a picture."""

    def bake(self, *arguments: str):
        return self.succeed(*arguments, program=BAKE)

    def refuse(self, arguments: list[str], code: int, *named: str) -> None:
        self.expect_error(arguments, code, *named, program=BAKE)

    def heights(self, name: str, height) -> str:
        """A PNG of 64x64 whose value 128 is the sea; `height(column, row)`, the row from the top."""
        rows = [bytes(height(x, y) for x in range(64)) for y in range(64)]
        self.write(name, png.encode(64, 64, 1, rows))
        return name

    def need_context(self) -> None:
        if not has_context():
            self.skipTest("no OpenGL context")

    def seen(self, island: str, color: str, side: int = 64) -> png.Picture:
        self.write("see.glsl", f'''#iChannel0 "{island}"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {{
    vec4 t = texelFetch(iChannel0, ivec2(fragCoord), 0);
    fragColor = vec4({color}, 1.0);
}}''')
        self.succeed("capture", "see.glsl", "--size", f"{side}x{side}", "-o", "seen.png")
        return png.read(self.folder / "seen.png")

    def test_writes_one_file_small_enough_to_keep(self):
        done = self.bake()
        self.assertEqual((done.stdout, done.stderr), (b"", "wrote island.exr\n"))
        self.assertEqual(self.files(), {"island.exr"})
        self.assertLess((self.folder / "island.exr").stat().st_size, 600_000)

    def test_metadata_describe_the_map(self):
        self.bake("--size", "64", "--seed", "3")
        content = (self.folder / "island.exr").read_bytes()
        for fact in (b"path distance, wave mask, depth, height", b"tidemark:extent", b"tidemark:radius",
                     b"tidemark:seed"):
            self.assertIn(fact, content)

    def test_size_seed_and_depth_decide(self):
        sizes = {}
        for name, *options in [("a.exr",), ("b.exr",), ("seed.exr", "--seed", "9"), ("float.exr", "--depth", "float")]:
            self.bake("--size", "64", "-o", name, *options)
            sizes[name] = (self.folder / name).read_bytes()
        self.assertEqual(sizes["a.exr"], sizes["b.exr"])
        self.assertNotEqual(sizes["a.exr"], sizes["seed.exr"])
        self.assertGreater(len(sizes["float.exr"]), 1.3 * len(sizes["a.exr"]))

    def test_heights_of_a_file(self):
        self.need_context()
        # A bank across the eastern half: the water beyond it is dark, the water on this side is not.
        name = self.heights("bank.png", lambda x, y: 160 if x in (46, 47) and 20 < y < 44 else 100)
        self.bake("--heights", name, "--sea", "0.5", "--metres", "10", "--extent", "128")
        mask = self.seen("island.exr", "vec3(t.y)")
        self.assertEqual(mask.pixel(40, 32), (0, 0, 0))
        self.assertEqual(mask.pixel(55, 32), (255, 255, 255))
        self.assertEqual(mask.pixel(10, 32), (255, 255, 255))
        # Metres: the circle's radius is 60 and a texel 2; (100/255 - 0.5) * 10 = -1.078.
        path = self.seen("island.exr", "vec3(t.x / 60.0, t.z, -t.w / 2.0)")
        x, y = 10.5 * 2 - 64, 32.5 * 2 - 64
        self.assertAlmostEqual(path.pixel(10, 32)[0] / 255, (60 - math.hypot(x, y)) / 60, delta=0.01)
        self.assertEqual(path.pixel(10, 32)[1], 255)
        self.assertAlmostEqual(path.pixel(10, 32)[2] / 255, 1.078 / 2, delta=0.005)
        self.assertEqual(path.pixel(46, 32)[1:], (0, 0))

    def test_unusable_heights(self):
        def refused(name: str, why: str, *options: str) -> None:
            self.refuse(["--heights", name, *options], 3, f"cannot use '{name}': ", why)
            self.assertNotIn("island.exr", self.files())

        sand = self.heights("sand.png", lambda x, y: 128)
        refused(sand, "0.502 m above the sea")
        edge = self.heights("edge.png", lambda x, y: 200 if x > 60 else 0)
        refused(edge, "land at column 61, row 47", "--sea", "0.5")
        self.write("wide.png", png.encode(80, 64, 1, [bytes(80)] * 64))
        refused("wide.png", "80x64")
        self.write("small.png", png.encode(16, 16, 1, [bytes(16)] * 16))
        refused("small.png", "64 to 4096 pixels")
        self.refuse(["--heights", "none.exr"], 3, "tidemark: error: cannot read 'none.exr': no such file")

    def test_nan_heights_are_refused(self):
        self.need_context()
        self.write("nan.glsl", "void mainImage(out vec4 c, in vec2 p) {"
                   "c = vec4(p == vec2(3.5, 60.5) ? uintBitsToFloat(0x7fc00000u) : -1.0); }")
        self.succeed("capture", "nan.glsl", "--size", "64x64", "-o", "nan.exr", "--depth", "float")
        self.refuse(["--heights", "nan.exr"], 3, "tidemark: error: cannot use 'nan.exr': "
                            "the height at column 3, row 3 is not a number")

    def test_replaces_neither_a_links_target_nor_the_heights(self):
        (self.folder / "island.exr").symlink_to("/nowhere/island.exr")
        self.refuse([], 4, "'island.exr': it is a link to '/nowhere/island.exr'")
        self.write("h.exr", b"heights")
        self.refuse(["--heights", "h.exr", "--extent", "8", "-o", "h.exr"], 4, "cannot write 'h.exr': ")
        self.assertEqual((self.folder / "h.exr").read_bytes(), b"heights")

    def test_usage(self):
        self.refuse(["-o", "island.png"], 2,
                    "tidemark: error: 'island.png' cannot hold half samples: .png holds 8-bit, 16-bit")
        self.refuse(["--size", "20"], 2, "--size: ", "from 64 to 4096", "'20'")
        self.refuse(["--heights", "a.png", "--size", "64"], 2, "tidemark: error: --size excludes --heights")
        self.refuse(["--sea", "1"], 2, "tidemark: error: --sea requires --heights")

    def test_study(self):
        lines = self.bake("--study").stdout.decode().splitlines()
        self.assertEqual(self.files(), set())
        titles = [line for line in lines if ", order " in line]
        self.assertEqual(titles, [f"{case}, order {order}"
                                  for case in ("open water", "a disc to go round", "a ring with a gap")
                                  for order in (1, 2)])
        rows = [line.split("|") for line in lines if line[:5].strip().isdigit()]
        self.assertEqual([int(row[0]) for row in rows], [64, 128, 256, 512, 1024] * 6)
        for title, last in zip(titles, rows[4::5]):
            largest, _, rms, order = last[1].split()
            self.assertAlmostEqual(float(order), float(title[-1]), delta=0.1, msg=title)
            self.assertLess(float(rms), float(largest), title)

    def test_study_as_a_report(self):
        done = self.bake("--study", "-o", "march", "--budget", "0.01")
        self.assertIn("wrote march/report.html", done.stderr)
        study = json.loads((self.folder / "march/study.json").read_text())
        self.assertEqual((study["schema"], study["complete"]), ("tidemark study 1", True))
        points = {point["label"]: point for point in study["points"]}
        self.assertEqual(len(points), 11)
        rms = [points[f"order = 2, nodes a side = {n}"]["all"]["hits"]["rms_t"] for n in (64, 128, 256, 512, 1024)]
        self.assertEqual(rms, sorted(rms, reverse=True))
        self.assertEqual(points["defaults"]["all"]["hits"]["rms_t"], rms[3])
        # The table's figure of the same marches: all nodes of open water but the middle, 2.7e-5 at 256.
        table = [line.split("|") for line in done.stdout.decode().splitlines()]
        smooth = [float(row[1].split()[2]) for row in table if row[0].strip() == "256"][1]
        overall = points["order = 2, nodes a side = 256"]["views"]["open water"]["hits"]["rms_t"]
        self.assertTrue(smooth < overall < 2 * smooth, (smooth, overall))
        for name in ("points.csv", "report.html"):
            self.assertGreater((self.folder / "march" / name).stat().st_size, 1000, name)
        self.refuse(["--budget", "3"], 2, "tidemark: error: --budget requires --study")


if __name__ == "__main__":
    main(needs_context=False)
