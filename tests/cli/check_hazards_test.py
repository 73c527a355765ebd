"""`check` finds, with its line, what other GPUs, other sizes or later frames make of a text, and `check --fix` mends it."""
import json
import random

from support import png
from support.program import ProgramTest, main

BUDGET = ("--budget", "900")  # else a busy machine cuts it
BODY = "void mainImage(out vec4 c, in vec2 p) {\n    %s\n}\n"
TEXTURED = '#iChannel0 "noise.png"\n#iChannel0::MinFilter "LinearMipMapLinear"\n#iChannel0::WrapMode "Repeat"\n'
HEAT = """#iChannel0 "self"
void mainImage(out vec4 c, in vec2 p) {
    ivec2 q = ivec2(p), last = ivec2(iResolution.xy) - 1;
    if (iFrame == 0) { c = vec4(length(p - 0.5 * iResolution.xy) < 0.2 * iResolution.y ? 1.0 : 0.0); return; }
    float m = texelFetch(iChannel0, q, 0).r;
    float sum = texelFetch(iChannel0, min(q + ivec2(1, 0), last), 0).r + texelFetch(iChannel0, max(q - ivec2(1, 0), 0), 0).r
              + texelFetch(iChannel0, min(q + ivec2(0, 1), last), 0).r + texelFetch(iChannel0, max(q - ivec2(0, 1), 0), 0).r;
    c = vec4(m + %s * (sum - 4.0 * m));
}
"""


class CheckHazards(ProgramTest):
    def setUp(self):
        super().setUp()
        lot = random.Random(3)
        rows = [bytes(lot.randrange(256) for _ in range(64 * 3)) for _ in range(64)]
        (self.folder / "noise.png").write_bytes(png.encode(64, 64, 3, rows))

    def probe(self, name: str, text: str, file: str = "a.glsl") -> dict:
        self.write(file, text)
        done = self.run_program("check", file, "--json", *BUDGET, "--probe", name)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        found, = json.loads(done.stdout)["probes"]
        return found

    def finding(self, name: str, verdict: str, text: str) -> str:
        found = self.probe(name, text)
        self.assertEqual(found["verdict"], verdict, found)
        return json.dumps(found)

    def growing_lines(self, text: str) -> list[int]:
        self.write("a.glsl", text)
        done = self.run_program("check", "a.glsl", "--json", *BUDGET, "--probe", "frames")
        finding, = json.loads(done.stdout)["findings"]
        self.assertIn("it overflows", finding["message"] + json.loads(done.stdout)["probes"][0]["found"])
        return [place["line"] for place in finding["places"]]

    def test_coordinates_computed_before_a_branch_are_harmless(self):
        inside = "vec2 uv = p / iResolution.xy; vec2 q = vec2(length(uv), uv.x);\n    if (uv.x > uv.y * uv.y) c = texture(iChannel0, %s);"
        for coordinates, verdict in (("q", "note"), ("uv * 2.0 - vec2(iTime, 0.5)", "note"), ("vec2(p.y, 3.0)", "note"),
                                     ("sin(q), -100.0", "note"), ("uv * uv", "warn"), ("vec2(sin(9.0 * uv.x))", "warn")):
            with self.subTest(coordinates):
                self.finding("divergence", verdict, TEXTURED + BODY % (inside % coordinates))
        loop = "vec2 q = p / iResolution.xy;\n    while (q.x < q.y) { c += texture(iChannel0, q); q *= 1.5; }"
        self.finding("divergence", "warn", TEXTURED + BODY % loop)
        called = "vec4 read(vec2 q) { return texture(iChannel0, q); }\n"
        for argument, verdict in ("p * 0.01", "note"), ("p * p", "warn"):
            self.finding("divergence", verdict, TEXTURED + called + BODY % f"if (p.x * p.y > 9.0) c = read({argument});")

    def test_a_variable_unset_on_one_branch_is_named_if_visible(self):
        text = "float h;\n    if (p.x > 20.0) h = 0.2;\n    else if (p.y > %s) h = 0.5;\n    c = vec4(h);"
        said = self.finding("unassigned", "warn", BODY % (text % "9.0"))
        self.assertIn("h (a.glsl:5, on some path); the picture is another one if it is 1", said)
        self.finding("unassigned", "note", BODY % (text % "-9.0"))  # each pixel takes one of the branches

    def fixed(self, text: str, code: int = 0) -> str:
        scene = self.write("a.glsl", text)
        done = self.run_program("check", "--fix", "a.glsl", "--write", *BUDGET)
        self.assertEqual(done.returncode, code, f"{done.stdout}{done.stderr}")
        return scene.read_text()

    def test_remainders_of_negative_integers(self):
        fault = BODY % "int i = (int(p.x) - 20) %% 3; c = vec4(0.3 * abs(float(i)));".replace("%%", "%")
        said = self.finding("bounds", "warn", fault)
        self.assertIn("a.glsl:2: `(int(p.x) - 20) % 3`: the remainder of a negative integer (-", said)
        self.assertIn("int i = (sign(int(p.x) - 20) * (abs((int(p.x) - 20)) % 3));", self.fixed(fault))
        self.finding("bounds", "pass", BODY % "int i = int(p.x) % 3; c = vec4(0.3 * float(i));")

    def test_divisions_of_negative_integers_that_leave_a_remainder(self):
        said = self.finding("bounds", "warn", BODY % "ivec2 i = (ivec2(p) - 20) / 3; c = vec4(vec2(i), 0.0, 1.0);")
        self.assertIn("a negative integer (-10) divided with a remainder", said)
        self.finding("bounds", "pass", BODY % "ivec2 i = (ivec2(p) - 20) * 3 / 3; c = vec4(vec2(i), 0.0, 1.0);")

    def test_atan_of_zero_in_the_middle_of_an_odd_picture(self):
        fault = BODY % "vec2 d = p - 0.5 * iResolution.xy; c = vec4(abs(atan(d.y, d.x)));"
        said = self.finding("undefined", "warn", fault)
        self.assertIn("atan of 0 and 0 (0, first at pixel 63,36 of 127x73) at a.glsl:2", said)
        self.assertIn("atan(d.y, (d.x + ", self.fixed(fault))

    def test_integer_quotients_differ_when_computed_by_reciprocals(self):
        fault = BODY % "float k = floor(p.x); c = vec4(mod(k, 41.0) / 41.0);"
        said = self.finding("undefined", "warn", fault)
        self.assertIn("`mod(k, 41.0)`: a whole quotient that GPUs with reciprocals miss (1, first at pixel 41,", said)
        self.assertIn("(mod((k + 0.5), 41.0) - 0.5)", self.fixed(fault))
        said = self.finding("undefined", "warn", BODY % "float k = floor(p.x); c = vec4(floor(k / 41.0));")
        self.assertIn("`k / 41.0`", said)
        for sound in "mod(k, 32.0) / 32.0", "mod(k + 0.5, 41.0) / 41.0", "k / 41.0":
            self.finding("undefined", "pass", BODY % f"float k = floor(p.x); c = vec4({sound});")

    def test_limits_in_the_wrong_order(self):
        fault = BODY % "c = vec4(clamp(p.x / 64.0, 0.8, 0.2));"
        said = self.finding("edges", "warn", fault)
        self.assertIn("`clamp(p.x / 64.0, 0.8, 0.2)` (a.glsl:2, its low edge is above its high one)", said)
        self.assertIn("c = vec4(min(max(p.x / 64.0, 0.8), 0.2));", self.fixed(fault))
        said = self.finding("undefined", "warn", BODY % "c = vec4(clamp(0.5, p.x / 64.0, p.y / 36.0));")
        self.assertIn("clamp with its low limit above its high one", said)

    def test_smooth_steps_with_equal_and_with_reversed_edges(self):
        self.finding("edges", "warn", BODY % "c = vec4(smoothstep(0.5, 0.5, p.x / 64.0));")
        reversed_edges = BODY % "c = vec4(smoothstep(0.8, 0.2, p.x / 64.0));"
        self.assertIn("a.glsl:2", self.finding("edges", "pass", reversed_edges))
        self.assertIn("c = vec4((1.0 - smoothstep(0.2, 0.8, p.x / 64.0)));", self.fixed(reversed_edges))

    def test_seams_of_mipmaps(self):
        fault = TEXTURED + BODY % "vec2 d = p / iResolution.y - vec2(0.9, 0.5); " \
                                  "c = texture(iChannel0, vec2(atan(d.y, d.x) / 6.2831853, length(d)));"
        said = self.finding("seams", "fail", fault)
        self.assertIn("a.glsl:5: the coordinates of `texture(", said)
        self.assertIn("jump by atan", said)
        fixed = self.fixed(fault)
        self.assertIn("textureGrad(iChannel0, vec2(atan(d.y, d.x) / 6.2831853, length(d)), ", fixed)
        self.assertEqual(self.probe("seams", fixed)["verdict"], "pass")
        self.finding("seams", "fail", TEXTURED + BODY % "c = texture(iChannel0, fract(4.0 * p / iResolution.y));")
        for sound in "4.0 * p / iResolution.y", "sin(fract(p / iResolution.y))":
            self.finding("seams", "pass", TEXTURED + BODY % f"c = texture(iChannel0, {sound});")

    def test_consequences_of_an_index_out_of_range_are_one_finding(self):
        self.write("a.glsl", "const float k[3] = float[3](0.1, 0.5, 0.9);\n"
                             + BODY % "c = vec4(k[int(floor(p.x / 8.0 + 0.01 * iTime))]);")
        done = self.run_program("check", "a.glsl", "--json", *BUDGET, "--probe", "tiles", "--probe", "bounds", "--probe", "repeats")
        finding, = json.loads(done.stdout)["findings"]
        self.assertEqual([place["line"] for place in finding["places"]], [3])
        self.assertIn("bounds", finding["probes"])

    def test_growing_values_are_reported_with_the_frame_of_overflow(self):
        said = self.probe("frames", HEAT % "0.26")
        self.assertEqual(said["verdict"], "warn", said)
        self.assertRegex(json.dumps(said), r"at about frame 1[2-6]\d\d \(2\d s\) it overflows")
        self.assertEqual(self.growing_lines(HEAT % "0.26"), [8])
        trail = '#iChannel0 "self"\n' + BODY % ("vec4 old = texture(iChannel0, p / iResolution.xy);\n    old.rgb *= 1.05;\n"
                                                "    float spot = 0.01 * exp(-0.01 * dot(p, p));\n    c = old + spot;")
        self.assertEqual(self.growing_lines(trail), [4])
        self.finding("frames", "pass", HEAT % "0.24")
        self.finding("frames", "pass", '#iChannel0 "self"\n' + BODY % "c = texelFetch(iChannel0, ivec2(p), 0) + 1.0;")

    def test_the_line_of_cancellation_is_named(self):
        for body, line in (("vec2 q = p / iResolution.y +\n        vec2(5.0e6, 3.0e6);\n    c = vec4(abs(fract(q.x * 8.0) - 0.5));",
                            "a.glsl:[23]"),
                           ("float s = 0.0, q = 0.0;\n    for (int i = 0; i < 16; i++) { float x = 1000.0 + 0.05 * "
                            "sin(float(i) + p.x); s += x; q += x * x; }\n    float v = q / 16.0 - (s / 16.0) * (s / 16.0);\n"
                            "    c = vec4(20.0 * sqrt(max(v, 0.0)));", "a.glsl:4")):
            self.assertRegex(self.finding("horizon", "warn", BODY % body), f"; {line} (loses|adds) ")

    def test_hashes_of_products_that_a_fused_multiply_add_changes(self):
        large = "float hash(vec2 p) { p = fract(p * vec2(5.3987, 5.4421)); p += dot(p.yx, p + vec2(21.5351, 14.3137)); " \
                "return fract(p.x * p.y * 95.4307); }\n"
        self.assertIn("a.glsl:1 hash", self.finding("hashes", "note", large + BODY % "c = vec4(hash(floor(p)));"))
        self.finding("hashes", "pass", BODY % "c = vec4(fract(p * 0.1031), 0.0, 1.0);")

    def test_letters_outside_glsl_are_errors_in_every_command(self):
        text = "#define A \u22120.5\n#define B (A)\n// \u2212 in a comment\n" + BODY % "c = vec4(B + 1.0);"
        self.write("a.glsl", text)
        for command in (["capture", "a.glsl"], ["check", "a.glsl"], ["check", "--fix", "a.glsl"], ["inspect", "a.glsl"],
                        ["export", "a.glsl"], ["export", "a.glsl", "--html", "a.html"], ["simplify", "a.glsl"]):
            with self.subTest(command):
                done = self.run_program(*command)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn("a.glsl:1:11: error: '\u2212' (U+2212) is not a character of GLSL: write -", done.stderr)

    def test_findings_without_a_fix_give_the_reason(self):
        self.write("a.glsl", HEAT % "0.26")
        done = self.run_program("check", "--fix", "a.glsl", *BUDGET)
        self.assertEqual(done.returncode, 1, f"{done.stdout}{done.stderr}")
        self.assertIn("it overflows\n  not fixed: no fix is known", done.stdout.decode())


if __name__ == "__main__":
    main()
