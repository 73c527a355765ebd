"""`tidemark check --fix`: what rounding, counting in floats and divergent neighbours do is mended, and measured."""
import json

from support.program import ProgramTest, main

BUDGET = ("--budget", "900")  # else a busy machine cuts it
BODY = "void mainImage(out vec4 c, in vec2 p) {\n    vec2 uv = p / iResolution.xy;\n    %s\n}\n"
VISIBLE = "percent of the pixels that visibly differ from double precision"

# Lines that lose their digits, and what they become.
ROUNDED = {
    "float x = 0.0003 * uv.x + 0.0001; c = vec4((1.0 - cos(x)) / (x * x));":
        "float x = 0.0003 * uv.x + 0.0001; c = vec4((2.0 * sin(0.5 * x) * sin(0.5 * x)) / (x * x));",
    "float a = 3000.0 + uv.x, b = 3000.0; c = vec4(fract((a * a - b * b) / 60.0));":
        "float a = 3000.0 + uv.x, b = 3000.0; c = vec4(fract(((a - b) * (a + b)) / 60.0));",
    "float x = 4000.0 + uv.x, y = x + 1.0; c = vec4(fract(4000.0 * (sqrt(y) - sqrt(x))));":
        "float x = 4000.0 + uv.x, y = x + 1.0; c = vec4(fract(4000.0 * ((y - x) / (sqrt(y) + sqrt(x)))));",
    "float x = floor(64.0 * uv.x) / 32.0, y = x + 1.0 / 262144.0; c = vec4(262144.0 * (cos(x) - cos(y)));":
        "float x = floor(64.0 * uv.x) / 32.0, y = x + 1.0 / 262144.0; "
        "c = vec4(262144.0 * (-2.0 * sin(0.5 * (x + y)) * sin(0.5 * (x - y))));",
    "vec3 a = normalize(vec3(0.3, 0.2, 1.0)), b = normalize(vec3(0.3 + 0.004 * uv, 1.0)); "
    "c = vec4(200.0 * acos(dot(a, b)));":
        "vec3 a = normalize(vec3(0.3, 0.2, 1.0)), b = normalize(vec3(0.3 + 0.004 * uv, 1.0)); "
        "c = vec4(200.0 * (2.0 * atan(length(a - b), length(a + b))));",
}
SPHERE = """float sphere(vec3 ro, vec3 rd, float r) {
    float b = dot(ro, rd), c = dot(ro, ro) - r * r, h = %s;
    return h < 0.0 ? -1.0 : -b - sqrt(h);
}
void mainImage(out vec4 c, in vec2 p) {
    vec3 ro = vec3(0.0, 0.0, -4000.0), rd = normalize(vec3(1.2 * (2.0 * p - iResolution.xy) / iResolution.y, 4000.0));
    float t = sphere(ro, rd, 1.0);
    c = vec4(t > 0.0 ? 0.5 + 0.5 * (ro + t * rd) : vec3(0.1), 1.0);
}
"""
# A ball in a round room: every ray ends somewhere, if the threshold is one that floats come to.
MARCH = """const float NEAR = %s;
float map(vec3 p) { return min(length(p - vec3(0.0, 0.0, 90.0)) - 1.0, 97.0 - length(p)); }
float march(vec2 f, out float n, out float d) {
    vec3 ro = vec3(0.0, 0.5, 94.0), rd = normalize(vec3((2.0 * f - iResolution.xy) / iResolution.y, -1.5));
    float t = 0.0;
    n = d = 0.0;
    for (int i = 0; i < 400; i++) {
        d = map(ro + rd * t);
        n += 1.0;
        if (d < NEAR) break;
        t += d;
    }
    return t;
}
void mainHit(out vec4 hit, in vec2 f) {
    float n, d, t = march(f, n, d);
    hit = d < NEAR ? vec4(t, n, d, 0.0) : vec4(-1.0, n, d, 1.0);
}
void mainImage(out vec4 c, in vec2 f) {
    float n, d, t = march(f, n, d);
    c = vec4(vec3(exp(-0.1 * t)), 1.0);
}
"""


class CheckFixRounding(ProgramTest):
    def fix(self, scene: str, *options: str) -> dict:
        """Exit code 1: a finding is left that has no fix, such as another GPU's rounding of the mended text."""
        done = self.run_program("check", "--fix", scene, "--json", *BUDGET, *options)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return json.loads(done.stdout)

    def probe(self, scene: str, name: str) -> str:
        done = self.run_program("check", scene, "--json", *BUDGET, "--probe", name)
        answer, = json.loads(done.stdout)["probes"]
        return answer["verdict"]

    def test_cancelling_differences_are_rewritten(self):
        for number, (line, mended) in enumerate(ROUNDED.items()):
            with self.subTest(line):
                scene = self.write(f"rounded{number}.glsl", BODY % line)
                cure, = self.fix(scene.name, "--write")["cures"]
                self.assertEqual(scene.read_text(), BODY % mended)
                self.assertEqual(cure["fault"]["of"], VISIBLE)
                self.assertLess(cure["fault"]["after"], 0.5 * cure["fault"]["before"])
                self.assertEqual(self.probe(scene.name, "horizon"), "pass")

    def test_a_far_sphere_keeps_its_outline(self):
        scene = self.write("sphere.glsl", SPHERE % "b * b - c")
        self.fix("sphere.glsl", "--write")
        self.assertEqual(scene.read_text(), SPHERE % "((r * r) - dot(ro - b * rd, ro - b * rd))")
        self.assertEqual(self.probe("sphere.glsl", "horizon"), "pass")

    def test_accurate_expressions_stay_unchanged(self):
        self.write("a.glsl", BODY % "c = vec4(1.0 - cos(uv.x), uv.x * uv.x - uv.y * uv.y, sin(uv.x + iTime), 1.0);")
        self.assertEqual(self.succeed("check", "--fix", "a.glsl", *BUDGET).stdout, b"nothing to fix\n")

    def test_inexact_identities_are_not_offered(self):
        """acos(dot(a, b)) is the angle of vectors of length 1, and one of these is shorter: floats lose nothing in the
        other text either, but it is another picture."""
        line = ("vec3 a = normalize(vec3(0.3, 0.3, 1.0)), b = 0.999999 * normalize(vec3(0.3 + 0.004 * uv, 1.0)); "
                "c = vec4(200.0 * %s);")
        self.write("a.glsl", BODY % (line % "acos(dot(a, b))"))
        self.assertEqual(self.probe("a.glsl", "horizon"), "note")
        self.assertEqual(self.fix("a.glsl")["cures"], [])
        self.write("b.glsl", BODY % (line % "(2.0 * atan(length(a - b), length(a + b)))"))
        self.assertEqual(self.probe("b.glsl", "horizon"), "pass")

    def test_phases_stay_accurate_after_hours(self):
        scene = self.write("time.glsl", BODY % "float t = 25.0 * iTime; c = vec4(fract(uv.x + 7.3 * iTime), "
                           "0.5 + 0.5 * sin(6.0 * uv.x + t), 0.5 + 0.5 * cos(3.0 * (uv.y - 40.0 * iTime)), 1.0);")
        self.assertEqual(self.probe("time.glsl", "horizon"), "note")
        cure, = self.fix("time.glsl", "--write")["cures"]
        self.assertEqual(cure["fault"]["of"], VISIBLE)
        self.assertEqual(self.probe("time.glsl", "horizon"), "pass")
        self.assertEqual(scene.read_text().count("turns_of_time("), 4)
        self.succeed("check", "time.glsl", "--portable")

    def test_float_loop_counters_become_integers(self):
        scene = self.write("a.glsl", BODY % "float s = 0.0; for (float x = 0.0; x < 1.0; x += 0.01) s += 0.001 * uv.x; "
                           "c = vec4(s);")
        self.assertEqual(self.probe("a.glsl", "counters"), "warn")
        cure, = self.fix("a.glsl", "--write")["cures"]
        self.assertEqual(cure["fault"], {"of": "loops that miscount", "before": 1, "after": 0})
        self.assertIn("for (int x_turn = 0; x_turn < 100; ++x_turn) { float x = 0.0 + 0.01 * float(x_turn); s +=",
                      scene.read_text())
        self.assertEqual(self.probe("a.glsl", "counters"), "pass")

    def test_derivatives_are_taken_before_neighbours_diverge(self):
        scene = self.write("a.glsl", BODY % "c = vec4(0.2); if (uv.x > 0.4) c = vec4(10.0 * fwidth(uv.x * uv.y));")
        self.assertEqual(self.probe("a.glsl", "divergence"), "warn")
        self.fix("a.glsl", "--write")
        self.assertIn("float taken_before = fwidth(uv.x * uv.y); if (uv.x > 0.4) c = vec4(10.0 * taken_before);",
                      scene.read_text())
        self.assertEqual(self.probe("a.glsl", "divergence"), "pass")

    def test_a_threshold_below_rounding_is_raised(self):
        scene = self.write("march.glsl", MARCH % "1e-7")
        cure, = self.fix("march.glsl", "--write")["cures"]
        self.assertRegex(cure["cure"], r"^hit threshold \S+ instead of 1e-07")
        self.assertGreater(cure["fault"]["before"], 1)
        self.assertLess(cure["fault"]["after"], 0.1)
        self.assertRegex(scene.read_text(), r"^const float NEAR = [\d.e-]+;\n")
        self.assertEqual(self.probe("march.glsl", "epsilon"), "pass")


if __name__ == "__main__":
    main()
