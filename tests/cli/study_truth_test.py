"""`study`: what its figures are worth: truths that converge, that do not, that are no number; which text a reference in
double belongs to; knobs that do nothing; what is held fixed; the order of an error."""
import csv
import json
import math
import re
import shutil

from support.program import ROOT, ProgramTest, main

QUICK = ["--size", "16x9", "--budget", "1"]


def scene(value: str, before: str = "") -> str:
    return (f"{before}\nvoid mainImage(out vec4 c, in vec2 p) {{\n{value}\nc = vec4(vec3(x), 1.0); }}\n")


def sum_of(term: str, count: str = "N") -> str:
    return scene(f"float x = 0.0; for (int k = 1; k <= {count}; ++k) {{ float f = float(k); x += {term}; }}", "#define N 4")


class Truth(ProgramTest):
    def study(self, text: str, *arguments: str, name: str = "a.glsl", size=()) -> dict:
        self.write(name, text)
        done = self.run_program("study", name, *arguments, "--json", *QUICK, *size, "-o", "report")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.words = done.stderr
        return json.loads(done.stdout)

    def page(self) -> str:
        return (self.folder / "report/report.html").read_text()

    def expect_no_truth(self, study: dict, why: str) -> None:
        self.assertRegex(study["references"]["picture"]["none"], why)
        self.assertTrue([line for line in study["verdict"] if line.startswith("no reference for the pictures: ")])
        self.assertFalse([line for line in study["verdict"] if "cheapest" in line or "equal error" in line])
        for point in study["points"]:
            self.assertIsNone(point["all"]["picture"]["rmse"])
            self.assertTrue(point["hollow"])
        self.assertRegex(self.words, "no reference for the pictures: .*" + why)
        self.assertIn("Reference of the pictures</dt><dd>none: ", self.page())


class OwnError(Truth):
    """Every pixel has one value, so that the error of the truth is known."""

    def expect_bound(self, text: str, limit: float, value, vary="N=4,8,16,32", most=3.0) -> None:
        study = self.study(text, "--vary", vary)
        reference = study["references"]["picture"]
        steps = int(re.search(r"N = (\d+)", reference["method"]).group(1))
        really = abs(limit - value(steps))
        self.assertLessEqual(really, 1.001 * reference["uncertainty"], reference)
        self.assertLess(reference["uncertainty"], most * really + 1e-6, reference)

    def test_bounds_of_slow_sums(self):
        self.expect_bound(sum_of("pow(f, -1.1) / 16.0"), 10.5844484649508098 / 16,
                          lambda n: math.fsum(k ** -1.1 for k in range(1, n + 1)) / 16)
        self.expect_bound(sum_of("pow(f, -1.5) / 4.0"), 2.6123753486854883 / 4,
                          lambda n: math.fsum(k ** -1.5 for k in range(1, n + 1)) / 4)
        self.expect_bound(sum_of("1.0 / (f * f)"), math.pi ** 2 / 6,
                          lambda n: math.fsum(1 / k ** 2 for k in range(1, n + 1)))

    def test_bounds_of_fast_sums(self):
        self.expect_bound(sum_of("pow(0.9, f) / 9.0"), 1, lambda n: 1 - 0.9 ** n, vary="N=16,32,64", most=1e9)
        self.expect_bound(scene("float x = 0.0; for (int k = 0; k < N; ++k) x += exp((float(k) + 0.5) / float(N)) / "
                                "(2.0 * float(N));", "#define N 4"), (math.e - 1) / 2,
                          lambda n: sum(math.exp((k + 0.5) / n) for k in range(n)) / (2 * n))

    def test_divergent_series_have_no_truth(self):
        self.expect_no_truth(self.study(sum_of("1.0 / f"), "--vary", "N=4,8,16,32"), "it does not converge: ")
        self.expect_no_truth(self.study(sum_of("0.01"), "--vary", "N=4,8"), "it does not converge: ")

    def test_a_chaotic_map_gives_no_verdict(self):
        study = self.study(scene("float x = 0.1 + 0.8 * p.x / iResolution.x; for (int k = 0; k < N; ++k) "
                                 "x = 3.99 * x * (1.0 - x);", "#define N 4"), "--vary", "N=4,8,16,32")
        self.assertTrue(all(point["hollow"] for point in study["points"]))
        self.assertFalse([line for line in study["verdict"] if line.startswith(("cheapest", "at equal error"))])

    def test_a_cycle_visible_only_at_odd_steps_is_found(self):
        two = scene("float x = 0.25; for (int k = 0; k < N; ++k) x = 0.125 / x;", "#define N 2")
        self.expect_no_truth(self.study(two, "--vary", "N=2,4,8"),
                             r"it does not converge: N = 8 and N = 16 show the same, but N = \d+ differs by 0\.25")

    def test_a_cycle_of_any_length_is_found(self):
        for length in (3, 5, 7):
            cycle = scene(f"float x = 0.25 + 0.5 * float(N % {length} == 0);", f"#define N {length}")
            study = self.study(cycle, "--vary", f"N={length},{2 * length},{4 * length}")
            self.assertIn("it does not converge: ", study["references"]["picture"]["none"])

    def test_a_loop_that_is_capped_is_not_certain(self):
        study = self.study(sum_of("1.0 / (f * f)", "min(N, 64)"), "--vary", "N=8,16,32,64")
        reference = study["references"]["picture"]
        self.assertGreater(reference["uncertainty"], 0.8 / 64)
        self.assertIn("if only a limit stopped it", reference["self_check"])
        strictest = {point["label"]: point for point in study["points"]}["N = 64"]
        self.assertTrue(strictest["hollow"])

    def test_knobs_without_a_stricter_value_give_no_truth(self):
        text = scene("float x = FINE ? 0.25 : 0.5;", "#define FINE false")
        self.expect_no_truth(self.study(text, "--vary", "FINE=false,true"),
                             "no knob of the study is a number that can be made stricter")
        study = self.study(text, "--vary", "FINE=false,true", "--reference", "FINE=true")
        self.assertIsNone(study["references"]["picture"]["uncertainty"])
        self.assertEqual(study["points"][0]["all"]["picture"]["rmse"], 0.25)
        self.assertEqual(study["verdict"][0], "no verdict on PSNR >= 50 dB: the reference's own error is unknown")


class Limits(Truth):
    """What the device, the text and the user allow."""

    def test_the_ladder_stays_within_the_loops_that_the_driver_runs(self):
        text = scene("float v = 0.2 + 0.6 * p.x / iResolution.x, x = 0.0; for (int k = 0; k < N; k++) x += v; x /= float(N);",
                     "#define N 50")
        study = self.study(text, "--vary", "N=500,5000,50000,500000")
        reference = study["references"]["picture"]
        self.assertLess(reference["uncertainty"], 1e-6)
        points = {point["label"]: point for point in study["points"]}
        if "failure" not in points["N = 500000"]:  # Mesa 25 runs such a loop to its end
            self.assertLess(points["N = 500000"]["all"]["picture"]["rmse"], 1e-2)
            self.skipTest("this driver does not cut loops")
        self.assertIn("the driver ends a pixel's loops after 65535 iterations", points["N = 500000"]["failure"])
        self.assertIn("the driver ends a pixel's loops", reference["self_check"])
        self.assertIn("not measured: N = 500000: ", self.words)
        self.assertLess(points["N = 50000"]["all"]["picture"]["rmse"], 1e-3)  # of a sum of floats

    def test_the_ladder_ends_at_non_finite_values(self):
        """Past 256 terms there is no number, as where whole numbers overflow."""
        text = scene("float x = 0.0; for (int k = 1; k <= N; k++) x += 0.5 / (float(k) * float(k)); "
                     "if (N > 256) x = sqrt(-x);", "#define N 8")
        reference = self.study(text, "--vary", "N=8,16,32")["references"]["picture"]
        self.assertGreater(reference["uncertainty"], 0.3 / 256)
        self.assertLess(reference["uncertainty"], 3.0 / 256)
        self.assertIn("are NaN or infinite with N = 512", reference["self_check"])

    def test_a_march_whose_rays_all_end_has_an_exact_truth(self):
        study = self.study("""#define TURNS 12
void mainImage(out vec4 c, in vec2 p) {
    vec3 ray = normalize(vec3((2.0 * p - iResolution.xy) / iResolution.y, 2.0)), at = vec3(0.1, 0.0, -4.0);
    float t = 0.0;
    for (int i = 0; i < TURNS; i++) {
        float d = length(at + t * ray) - 1.2;
        if (d < 0.002 || t > 9.0) break;
        t += d;
    }
    c = vec4(vec3(t < 9.0 ? t / 6.0 : 0.0), 1.0);
}
""", "--vary", "TURNS=4,8,16,512")
        reference = study["references"]["picture"]
        self.assertEqual(reference["uncertainty"], 0, reference)
        self.assertIn("to the bit, and no loop ended by its count", reference["self_check"])
        self.assertFalse([point["label"] for point in study["points"] if point["hollow"]])

    def test_buffers_of_floats_widen_the_truth(self):
        self.write("scene/buffer_a.glsl", "#define N 6\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                   "    float x = 2.0 * p.x / iResolution.x, s = 0.0;\n"
                   "    for (int k = 0; k < N; k++) s += exp(-(float(k) + 0.5) * x / float(N));\n"
                   "    c = vec4(500.0 + 0.001 * s * x / float(N));\n}\n")
        self.write("scene/image.glsl", '#iChannel0 "buffer_a.glsl"\nvoid mainImage(out vec4 c, in vec2 p) {\n'
                   "    c = vec4(vec3((texelFetch(iChannel0, ivec2(p), 0).r - 500.0) * 1000.0), 1.0);\n}\n")
        done = self.succeed("study", "scene", "--vary", "N=4,8,16,32", "--json", *QUICK, "-o", "report")
        reference = json.loads(done.stdout)["references"]["picture"]
        step = 2.0 ** -15  # of a float near 500
        self.assertGreater(reference["uncertainty"], 1000 * step / math.sqrt(12))
        self.assertLess(reference["uncertainty"], 1000 * step)
        self.assertIn("its buffers are stored as floats", reference["self_check"])

    def test_a_rule_that_needs_even_steps_is_named(self):
        simpson = scene("float h = 1.0 / float(N), x = 0.0; for (int k = 0; k <= N; k++) x += h / 3.0 * exp(-float(k) * h) * "
                        "(k == 0 || k == N ? 1.0 : k % 2 == 1 ? 4.0 : 2.0); x += N % 2 == 1 ? 0.1 : 0.0;", "#define N 4")
        none = self.study(simpson, "--vary", "N=8,64,512")["references"]["picture"]["none"]
        self.assertIn("if N must be even, say so with --even N", none)
        study = self.study(simpson, "--vary", "N=8,64,512", "--even", "N")
        self.assertIsNone(study["references"]["picture"].get("none") or None)
        self.assertLess(study["references"]["picture"]["uncertainty"], 1e-4)

    def test_the_error_of_random_samples_falls_by_half_a_power(self):
        study = self.study(scene("float x = 0.0; uint s = uint(p.x) * 7919u + uint(p.y) * 104729u + 1u;\n"
                                 "for (int k = 0; k < N; k++) { s ^= s << 13; s ^= s >> 17; s ^= s << 5;\n"
                                 "float u = float(s >> 8) / 16777216.0; x += u * u / float(N); }", "#define N 8"),
                           "--vary", "N=8,16,32,64,128", size=("--size", "96x54"))
        observed, = study["orders"]
        self.assertIsNotNone(observed["order"], observed)
        self.assertAlmostEqual(observed["order"], 0.5, delta=0.07)


class Ranking(Truth):
    SPHERE = """#define STEPS 48
float map(vec3 p) { return length(p - vec3(0.0, 0.0, 5.0)) - 1.6; }
float march(vec3 ray, out float turns) {
    float t = 0.0; turns = 0.0;
    for (int i = 0; i < STEPS; i++) { float d = map(t * ray); turns += 1.0; if (d < 1e-4) return t; t += d; if (t > 20.0) break; }
    return -1.0;
}
vec3 ray(vec2 p) { return normalize(vec3((2.0 * p - iResolution.xy) / iResolution.y, 2.0)); }
void mainImage(out vec4 c, in vec2 p) { float n, t = march(ray(p), n); c = vec4(vec3(t < 0.0 ? 0.0 : 1.0 - 0.1 * t), 1.0); }
#ifdef TIDEMARK_HIT
void mainHit(out vec4 hit, in vec2 p) { float n, t = march(ray(p), n); hit = vec4(t, n, 0.0, 0.0); }
#endif
"""

    def test_few_steps_that_miss_rays_are_less_exact(self):
        study = self.study(self.SPHERE, "--vary", "STEPS=4,24,48,96", size=("--size", "64x36"))
        points = {point["label"]: point for point in study["points"]}
        self.assertGreater(points["STEPS = 4"]["all"]["hits"]["wrong_0.1_percent"], 3)
        for line in study["verdict"]:
            self.assertNotRegex(line, r"at equal error .*STEPS = 4\b")

    def test_the_default_is_not_compared_with_itself(self):
        study = self.study(sum_of("exp(-f / 4.0) / float(N)"), "--vary", "N=1,4,16", "--reference", "N=4096")
        for line in study["verdict"]:
            self.assertNotRegex(line, r"faster than .*: N = 4(;|$)")

    def test_knobs_are_found_in_the_text(self):
        study = self.study(self.SPHERE.split("#ifdef")[0], size=("--size", "48x27"))
        self.assertIn("varies STEPS (bounds the march at a.glsl:5)", self.words)
        self.assertTrue([line for line in study["verdict"] if line.startswith(("cheapest", "no tested", "at equal"))], study["verdict"])


class NonFinite(Truth):
    MIDPOINT = ("float x = 0.0; for (int k = 0; k < N; ++k) x += exp(-3.0 * (float(k) + 0.5) / float(N)) / float(N);"
                "if ({}) x = sqrt(-1.0 - p.x);")

    def test_nan_pixels_of_the_truth_are_left_out_of_errors(self):
        plain = self.study(scene(self.MIDPOINT.format("false"), "#define N 4"), "--vary", "N=4,8,16")
        study = self.study(scene(self.MIDPOINT.format("p.x < 1.0"), "#define N 4"), "--vary", "N=4,8,16")
        reference = study["references"]["picture"]
        self.assertEqual(reference["no_truth_pixels"], 2 * 9)
        self.assertAlmostEqual(reference["uncertainty"] / plain["references"]["picture"]["uncertainty"], 1, places=4)
        for one, other in zip(study["points"], plain["points"]):
            mine, whole = one["all"]["picture"], other["all"]["picture"]
            self.assertAlmostEqual(mine["rmse"] / whole["rmse"], 1, places=4)
            self.assertAlmostEqual(mine["psnr_db"], whole["psnr_db"], places=3)
            self.assertEqual((mine["no_truth_pixels"], mine["non_finite_pixels"]), (18, 18))
        self.assertIn("the reference for the pictures is NaN or infinite in 18 pixels, whose error is unknown",
                      study["verdict"])
        self.assertIn("is NaN or infinite in 18 pixels", self.words)
        self.assertIn("It is NaN or infinite in 18 pixels", self.page())

    def test_a_truth_with_many_nan_pixels_is_rejected(self):
        self.expect_no_truth(self.study(scene(self.MIDPOINT.format("p.x < 4.0"), "#define N 4"), "--vary", "N=4,8,16"),
                             r"25 % of its pixels are NaN or infinite")
        self.expect_no_truth(self.study(scene(self.MIDPOINT.format("N > 8"), "#define N 4"), "--vary", "N=4,8,16"),
                             r"100 % of its pixels are NaN or infinite")

    def test_a_point_with_nan_in_finite_pixels_has_no_error(self):
        study = self.study(scene(self.MIDPOINT.format("N == 8 && p.x < 1.0"), "#define N 4"), "--vary", "N=4,8,16")
        bad = study["points"][2]["all"]["picture"]
        self.assertEqual((bad["rmse"], bad["non_finite_pixels"], bad["no_truth_pixels"]), (None, 18, 0))

    def test_nan_hits_of_the_truth_are_left_out_of_errors(self):
        def plane(bad: str) -> str:
            return (scene("float x = 0.5;", "#define N 4") +
                    "#ifdef TIDEMARK_HIT\nvoid mainHit(out vec4 hit, in vec2 p) {\nfloat t = 0.0;\n"
                    "for (int i = 0; i < N; ++i) t += 0.5 * (5.0 - t);\n"
                    f"hit = vec4({bad} ? sqrt(-p.x) : t, float(N), 0, 0);\n}}\n#endif\n")
        plain = self.study(plane("false"), "--vary", "N=4,8,16")
        study = self.study(plane("p.x < 1.0"), "--vary", "N=4,8,16")
        for one, other in zip(study["points"], plain["points"]):
            mine, whole = one["all"]["hits"], other["all"]["hits"]
            self.assertEqual((mine["no_truth_pixels"], mine["no_answer_percent"]), (18, 0))
            self.assertAlmostEqual(mine["rms_t"], whole["rms_t"], places=6)
            self.assertEqual(mine["false_hit_percent"], 0)
            self.assertEqual(one["all"]["causes"]["no truth"], 18)
        self.assertEqual(study["references"]["hits"]["no_truth_pixels"], 18)


class Facts(Truth):
    def test_a_knob_without_effect_is_named_and_gives_no_verdict(self):
        study = self.study(scene("float x = p.x / 16.0;", "#define FOO 1"), "--vary", "FOO=1,2,4,8")
        self.assertEqual(study["idle"], [{"knob": "FOO", "series": "FOO"}])
        self.assertEqual(study["verdict"][0], "FOO changes nothing here: the scene shows the same picture, bit for bit, at all its values")
        self.assertFalse([line for line in study["verdict"] if "cheapest" in line or "equal error" in line])
        self.assertTrue(all(point["idle"] for point in study["points"][1:]))
        self.assertIn("FOO changes nothing here", self.words)

    def test_one_of_two_knobs_has_no_effect(self):
        text = scene("float x = 0.0; for (int k = 0; k < N; ++k) x += exp((float(k) + 0.5) / float(N)) / "
                     "(4.0 * float(N));", "#define FOO 1\n#define N 4")
        self.write("a.study.json", json.dumps({
            "series": [{"name": "steps", "vary": {"N": [4, 8, 16]}}, {"name": "nothing", "vary": {"FOO": [1, 2, 3]}}],
            "reference": {"N": 256}}))
        study = self.study(text)
        self.assertEqual(study["idle"], [{"knob": "FOO", "series": "nothing"}])
        idle = {point["label"] for point in study["points"] if point["idle"]}
        self.assertEqual(idle, {"FOO = 1", "FOO = 2", "FOO = 3"})
        self.assertFalse([point for point in study["points"] if point["idle"] and point["on_front"]])
        self.assertRegex("\n".join(study["verdict"]), r"cheapest setting with PSNR >= 50 dB: (N = \d+|defaults) \(")

    def test_observed_order(self):
        rules = {"midpoint": ("(float(k) + 0.5)", 2), "left": ("float(k)", 1)}
        for name, (place, order) in rules.items():
            study = self.study(scene(f"float x = 0.0; for (int k = 0; k < N; ++k) x += exp({place} / float(N)) / "
                                     "(4.0 * float(N));", "#define N 4"), "--vary", "N=4,8,16,32")
            observed, = study["orders"]
            self.assertEqual((observed["series"], observed["knob"], observed["fixed"]), ("N", "N", {}))
            self.assertAlmostEqual(observed["order"], order, delta=0.1)
            self.assertLess(abs(observed["order"] - order), 3 * observed["uncertainty"] + 0.05)
            self.assertRegex(observed["fit"], r"least squares of log error over log N at [34] points, 4 to (16|32)")
            self.assertRegex(self.words, rf"observed order in N: {observed['order']:.2f} \+- 0\.\d\d, least squares")
            self.assertIn("observed order in N: ", self.page())
        step = scene("float x = 0.0; for (float t = 0.5 * H; t < 1.0; t += H) x += 0.25 * H * exp(t);", "#define H 0.25")
        observed, = self.study(step, "--vary", "H=0.25,0.125,0.0625,0.03125")["orders"]
        self.assertAlmostEqual(observed["order"], 2, delta=0.1)  # falls with the step, too

    def test_no_order_without_a_power_law(self):
        geometric = scene("float x = 0.0; float y = 0.5; for (int k = 0; k < N; ++k) { x += y; y *= 0.5; }", "#define N 1")
        observed, = self.study(geometric, "--vary", "N=1,2,4,8")["orders"]
        self.assertIsNone(observed["order"])
        self.assertRegex(observed["fit"], r"no single power: between neighbouring points it is \d\.\d\d to \d\.\d\d")
        self.assertNotIn("observed order", self.words)
        observed, = self.study(sum_of("1.0 / f"), "--vary", "N=4,8,16,32")["orders"]
        self.assertIsNone(observed["order"])

    def test_fixed_settings_are_listed(self):
        text = scene("float x = 0.0; for (int k = 0; k < STEPS; ++k) x += exp((float(k) + 0.5) / float(STEPS)) / "
                     "(4.0 * float(STEPS)); x += EPS * gain;",
                     "#define STEPS 4\n#define EPS 0.01\n#iUniform float gain = 0.5\n#define NAME x")
        study = self.study(text, "--vary", "STEPS=4,8,16")
        self.assertEqual(study["held"], {"EPS": "0.01", "gain": "0.5"})
        self.assertIn("held fixed, also in the reference, so its error is not measured: EPS = 0.01, gain = 0.5\n",
                      self.words)
        self.assertIn("<dt>Held fixed</dt><dd>EPS = 0.01, gain = 0.5.", self.page())
        self.assertEqual(self.study(text, "--vary", "STEPS=4,8,16", "--vary", "EPS=0.1,0.05")["held"], {"gain": "0.5"})

    def test_picture_and_hits_are_checked_separately(self):
        text = (scene("float x = 0.0; for (int k = 0; k < N; ++k) x += exp((float(k) + 0.5) / float(N)) / "
                      "(4.0 * float(N));", "#define N 4") +
                "#ifdef TIDEMARK_HIT\nvoid mainHit(out vec4 hit, in vec2 p) {\nfloat t = 0.0;\n"
                "for (int i = 0; i < N; ++i) t += 5.0 / float(N * (N + i));\nhit = vec4(t, float(N), 0, 0);\n}\n#endif\n")
        references = self.study(text, "--vary", "N=4,8,16")["references"]
        self.assertNotEqual(references["hits"]["self_check"], references["picture"]["self_check"])
        self.assertNotEqual(references["hits"]["uncertainty"], references["picture"]["uncertainty"])

    def test_columns_of_the_settings(self):
        text = scene("float x = 0.0; for (int k = 0; k < N; ++k) x += exp((float(k) + 0.5) / float(N)) * view / "
                     "(4.0 * float(N));", "#define N 4\n#define view 1.0")
        self.study(text, "--vary", "view=1.0,0.5", "--vary", "N=4,8,16")
        rows = list(csv.DictReader((self.folder / "report/points.csv").read_text().splitlines()))
        self.assertEqual([(row["set view"], row["N"]) for row in rows if row["view"] == "all"],
                         [("1.0", "4"), ("1.0", "4"), ("1.0", "8"), ("1.0", "16"), ("0.5", "4"), ("0.5", "8"), ("0.5", "16")])


class Proved(Truth):
    def setUp(self):
        super().setUp()
        shutil.copytree(ROOT / "shaders/lib", self.folder / "lib")
        self.text = (ROOT / "shaders/water_surface.glsl").read_text()

    def expect_proof_from_the_text(self, study: dict) -> None:
        hits = study["references"]["hits"]
        self.assertRegex(hits["method"], r"first zeros of the distance that \S+:\d+ tests")
        self.assertLess(hits["uncertainty"], 1e-6)
        self.assertRegex(hits["self_check"], r"\A288 of 288 rays, evenly spread")
        self.assertNotIn("no proof", self.words)

    def test_a_renamed_water_and_an_edited_water_are_proved(self):
        moved = self.text.replace("return sea_step * (position.y + crests", "return sea_step * (position.y - 1.5 + crests")
        self.assertNotEqual(moved, self.text)
        for text in ("// mine\n" + self.text, moved):
            study = self.study(text, "--vary", "MAX_STEPS=64,128", name="my_sea.glsl")
            self.expect_proof_from_the_text(study)
            self.assertLess(study["points"][0]["all"]["hits"]["wrong_0.1_percent"], 5)

    def test_without_a_march_the_reason_is_given(self):
        study = self.study("#define N 4\nvoid mainHit(out vec4 hit, in vec2 p) { hit = vec4(1.0 / float(N), 1.0, 0.0, 0.0); }\n"
                           "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0 / float(N)); }\n", "--vary", "N=4,8,16")
        said = "the hits are not proved: no ray-marching loop found in Image"
        self.assertIn(said, self.words)
        self.assertTrue([remark for remark in study["remarks"] if remark.startswith(said)])
        self.assertIn(said, self.page())

    def test_the_march_of_a_scene_without_mainHit_is_recorded_and_the_picture_ranks(self):
        text = """#define STEPS 8
float map(vec3 p) { return min(length(p - vec3(0.0, 0.0, 4.0)) - 1.0, p.y + 1.0); }
void mainImage(out vec4 c, in vec2 f) {
    vec3 rd = normalize(vec3((2.0 * f - iResolution.xy) / iResolution.y, 1.5));
    float t = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        float d = map(rd * t);
        if (d < 1e-4 || t > 30.0) break;
        t += d;
    }
    c = vec4(exp(-0.2 * t));
}
"""
        study = self.study(text, "--vary", "STEPS=8,32,128,512")
        self.expect_proof_from_the_text(study)
        first, *_, last = study["points"][1:]
        self.assertGreater(first["all"]["hits"]["wrong_0.1_percent"], 10)
        self.assertGreater(first["all"]["hits"]["exhausted_percent"], 10)
        self.assertLess(last["all"]["hits"]["wrong_0.1_percent"], 1)
        self.assertLess(last["all"]["hits"]["rms_right_t"], 1e-2)
        self.assertNotIn("wrong <=", self.words)
        self.assertIn("PSNR >=", self.words)

    def test_the_program_contains_no_scene_name(self):
        names = [path.stem for path in (ROOT / "shaders").glob("*.glsl")]
        for source in (ROOT / "runner").rglob("*.?pp"):
            for name in names:
                self.assertNotIn(f'"{name}', source.read_text(), source)


if __name__ == "__main__":
    main()
