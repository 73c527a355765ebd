"""`--precision double`: the same scene in 64-bit floats, what it says of itself, and what it says when it cannot."""
import json
import struct
import wave

from support import png
from support.program import ProgramTest, main

HASHED = """#define SPEED 1.0
float scatter(vec2 p) {
    return fract(sin(dot(p, vec2(127.1, 311.7))) * 43758.5453);
}
void mainImage(out vec4 c, in vec2 p) { c = vec4(scatter(floor(p / 4.0)), fract(iTime * SPEED), 0, 1); }
"""
TONE = """vec2 mainSound(int n, float t) { return vec2(0.9 * sin(6.2831 * 440.0 * t), 0.5); }
void unused() {}
"""
KEPT = {"pass": "Image", "function": "scatter", "file": "hashed.glsl", "line": 2, "kind": "sine"}


class Precision(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("hashed.glsl", HASHED)

    def capture(self, *options):
        done = self.succeed("capture", "hashed.glsl", "--size", "16x8", "-o", "x.png", "--json", *options)
        return json.loads(done.stdout), png.read(self.folder / "x.png")

    def test_the_report_names_the_precision_and_the_float_hashes(self):
        single, before = self.capture("--time", "3.25")
        self.assertEqual(single["precision"], "single")
        self.assertNotIn("float_hashes", single)
        double, after = self.capture("--time", "3.25", "--precision", "double")
        self.assertEqual(double["precision"], "double")
        self.assertEqual(double["float_hashes"], [KEPT])
        self.assertEqual(after.rows, before.rows)
        self.assertEqual((before.text["tidemark:Precision"], after.text["tidemark:Precision"]), ("single", "double"))

    def test_hashes_are_promoted_on_demand_and_then_differ(self):
        _, before = self.capture()
        whole, after = self.capture("--precision", "double", "--double-hashes")
        self.assertEqual(whole["float_hashes"], [])
        self.assertNotEqual(after.rows, before.rows)

    def test_time_keeps_its_digits(self):
        single, double = (self.capture("--time", "10000000.25", "--precision", p)[1].pixel(0, 0)[1]
                          for p in ("single", "double"))
        self.assertEqual((single, double), (0, 64))

    def test_definitions_and_knobs_work_in_double(self):
        _, picture = self.capture("--time", "0.5", "--precision", "double", "--define", "SPEED=0.5")
        self.assertEqual(picture.pixel(0, 0)[1], 64)

    def test_inspect_shows_the_text_and_the_float_hashes(self):
        source = self.succeed("inspect", "hashed.glsl", "--source", "--precision", "double").stdout.decode()
        self.assertTrue(source.startswith("#version 450 core\n"))
        self.assertIn("double scatter(dvec2 a0) { return tidemark_float_scatter(vec2(a0)); }", source)
        facts = json.loads(self.succeed("inspect", "hashed.glsl", "--json", "--precision", "double").stdout)
        self.assertEqual(facts["float_hashes"], [KEPT])
        lines = self.succeed("inspect", "hashed.glsl", "--precision", "double").stdout.decode()
        self.assertIn("  precision double\n  float     sine hash scatter, hashed.glsl:2\n", lines)

    def test_sound_is_promoted(self):
        self.write("project/image.glsl", HASHED)
        self.write("project/sound.glsl", TONE)
        for precision in ("single", "double"):
            self.succeed("capture", "project", "-o", f"{precision}.wav", "--duration", "0.1", "--precision", precision)
        single, double = (self.samples(name) for name in ("single.wav", "double.wav"))
        self.assertEqual(len(single), len(double))
        self.assertLessEqual(max(abs(a - b) for a, b in zip(single, double)), 4)
        self.assertGreater(max(single), 28000)

    def samples(self, name):
        with wave.open(str(self.folder / name)) as file:
            data = file.readframes(file.getnframes())
        return struct.unpack(f"<{len(data) // 2}h", data)

    def test_invalid_options(self):
        self.expect_failure_like(["capture", "hashed.glsl", "--precision", "quadruple"], 2,
                                 r"tidemark: error: --precision: .*single.*double.*")
        self.expect_failure_like(["capture", "hashed.glsl", "--double-hashes"], 2,
                                 r"tidemark: error: .*--double-hashes.*--precision.*")

    def test_code_without_a_double_form_is_named(self):
        self.write("depth.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(1);\n    gl_FragDepth = 0.5;\n}\n")
        self.expect_error(["capture", "depth.glsl", "--precision", "double"], 3,
                          "depth.glsl:3:5: error:", "'gl_FragDepth'")


if __name__ == "__main__":
    main()
