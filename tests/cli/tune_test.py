"""`tune`: the settings of scenes whose error and cost are known; what is offered, written, refused."""
import json
import re

from support.program import ProgramTest, main

# Riemann's sum, at a cost that a person could measure: its error falls with the steps, its time grows with them.
SUM = """#define STEPS 1024
#define SIDES 3
void mainImage(out vec4 c, in vec2 p) {
    float sum = 0.0;
    for (int i = 0; i < STEPS; ++i) sum += exp(-3.0 * (float(i) + 0.5) / float(STEPS)) * (0.5 + 0.5 * sin(p.x));
    for (int i = 0; i < SIDES; ++i) sum += 0.0;
    c = vec4(vec3(sum / float(STEPS) * p.x / iResolution.x), 1.0);
}
"""
# A sphere before a wall; eight turns do not come to where rays graze it.
MARCH = """void mainImage(out vec4 c, in vec2 f) {
    vec3 ray = normalize(vec3(f / iResolution.xy - 0.5, -1.0)), at = vec3(0.0, 0.0, 4.0);
    float t = 0.0;
    for (int i = 0; i < 8 && t < 20.0; ++i) {
        float d = min(length(at + t * ray) - 1.0, at.z + t * ray.z + 3.0);
        if (d < 0.001) break;
        t += d;
    }
    c = vec4(vec3(t / 20.0), 1.0);
}
"""
QUICK = ("--size", "48x27", "--budget", "40")


class Tune(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("sum.glsl", SUM)

    def tune(self, *arguments: str) -> tuple[dict, str]:
        done = self.succeed("tune", "sum.glsl", "--json", *QUICK, *arguments)
        return json.loads(done.stdout), done.stderr

    def choice(self, *arguments: str) -> tuple[dict, str]:
        """The same where something better is there."""
        found, said = self.tune(*arguments)
        self.assertTrue(found["chosen"], said)
        return found, said

    def test_fewer_steps_are_offered_within_an_allowed_error(self):
        found, said = self.choice("--max-error", "psnr=50dB")
        self.assertIn("varies STEPS (bounds the loop at sum.glsl:5): 256, ", said)
        self.assertIn("leaves SIDES unchanged", said)
        self.assertLess(int(found["chosen"]["STEPS"]), 1024)
        self.assertIn("-#define STEPS 1024\n+#define STEPS ", found["difference"][0])
        self.assertEqual((self.folder / "sum.glsl").read_text(), SUM)
        self.assertTrue((self.folder / "sum-tune" / "report.html").exists())
        names = list(found["study"]["points"][0]["views"])
        self.assertEqual(len(names), 4)
        self.assertIn("not searched", names[-1])

    def test_the_chosen_settings_are_written(self):
        found, _ = self.choice("--max-error", "psnr=50dB", "--write", "-o", "report")
        steps = found["chosen"]["STEPS"]
        self.assertEqual((self.folder / "sum.glsl").read_text(), SUM.replace("STEPS 1024", f"STEPS {steps}"))

    def test_a_knob_is_written_into_its_line(self):
        self.write("sum.glsl", SUM.replace("#define STEPS 1024", "#iUniform int STEPS = 1024 in { 1, 9999 }"))
        found, _ = self.choice("--max-error", "psnr=50dB", "--write")
        self.assertIn(f"#iUniform int STEPS = {found['chosen']['STEPS']} in {{ 1, 9999 }}\n",
                      (self.folder / "sum.glsl").read_text())

    def test_most_exact_settings_within_a_time(self):
        self.write("sum.glsl", SUM.replace("STEPS 1024", "STEPS 16"))
        found, said = self.choice("--max-time", "100000")
        self.assertGreater(int(found["chosen"]["STEPS"]), 16, said)

    def test_literals_of_the_march_are_varied(self):
        self.write("march.glsl", MARCH)
        done = self.succeed("tune", "march.glsl", "--json", *QUICK, "--max-time", "100000", "--write")
        self.assertIn("varies march.glsl:4:25 (8, which bounds the march): 2, 3, 4, 6, 8, 12, 16\n", done.stderr)
        self.assertIn("varies march.glsl:6:17 (0.001, which is the threshold): 0.032, ", done.stderr)
        chosen = json.loads(done.stdout)["chosen"]
        self.assertIn(chosen["march.glsl:4:25"], ("12", "16"))
        turns, threshold = chosen["march.glsl:4:25"], chosen.get("march.glsl:6:17", "0.001")
        self.assertEqual((self.folder / "march.glsl").read_text(),
                         MARCH.replace("i < 8", f"i < {turns}").replace("d < 0.001", f"d < {threshold}"))
        self.succeed("study", "march.glsl", "--vary", "march.glsl:4:25=4,8,16", "--size", "32x18", "--budget", "2")

    def test_a_picture_of_nan_is_refused_as_reference(self):
        self.write("sum.glsl", SUM.replace("vec3(sum /", "vec3(sqrt(-1.0 - sum) /"))
        done = self.run_program("tune", "sum.glsl", *QUICK, "--as-it-is", "--max-error", "flip=0.02")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("nothing can be compared with the scene's picture", done.stderr)

    def test_the_unchanged_scene_as_reference(self):
        found, said = self.choice("--as-it-is", "--max-error", "flip=0.02")
        self.assertIn("unchanged: ", said)
        self.assertLess(int(found["chosen"]["STEPS"]), 1024)
        points = found["study"]["points"]
        self.assertEqual([points[0]["all"]["picture"][measure] for measure in ("flip", "rmse")], [0, 0])
        self.assertLess(max(int(point["settings"].get("STEPS", 1024)) for point in points), 1025)  # nothing stricter
        chosen = next(point for point in points if point["settings"] == found["chosen"])
        self.assertLessEqual(chosen["all"]["picture"]["flip"], 0.02)

    def test_values_of_vary_replace_the_defaults(self):
        found, said = self.choice("--max-error", "psnr=50dB", "--vary", "STEPS=128,256,512,1024")
        self.assertIn("varies STEPS (--vary): 128, 256, 512, 1024", said)
        self.assertIn(found["chosen"]["STEPS"], ["128", "256", "512"])  # a busy machine tells near ones apart badly

    def test_kept_and_unknown_settings_are_refused(self):
        for arguments, words in (
                (("--keep", "STEPS"), "found no number in this scene that trades time for exactness"),
                (("--vary", "STEP=1,2"), "did you mean 'STEPS'"),
                (("--max-error", "ssim=1"), "give rmse=0.01, psnr=40dB"),
                (("--max-error", "rmse=1", "--max-time", "5"), "give one of them"),
                (("--as-it-is", "--max-error", "wrong=1%"), "--as-it-is compares pictures"),
                (("--as-it-is", "--max-time", "5"), "--max-time excludes --as-it-is"),
                (("--budget", "0"), "--budget: give a number of seconds above 0"),
                (("--for", "0"), "--budget: give a number of seconds above 0")):  # its name in version 0.1
            with self.subTest(arguments=arguments):
                done = self.run_program("tune", "sum.glsl", *QUICK, *arguments)
                self.assertEqual(done.returncode, 2)
                self.assertIn(words, done.stderr)

    def test_without_a_truth_the_verdict_is_missing(self):
        """A loop whose sum grows without end converges to nothing."""
        self.write("sum.glsl", "#define STEPS 64\nvoid mainImage(out vec4 c, in vec2 p) {\n    float sum = 0.0;\n"
                               "    for (int i = 0; i < STEPS; ++i) sum += p.x;\n    c = vec4(sum);\n}\n")
        done = self.run_program("tune", "sum.glsl", *QUICK)
        self.assertEqual(done.returncode, 1)
        self.assertIn("no result: ", done.stderr)
        self.assertNotIn("chosen", done.stderr)

    def test_without_a_truth_max_error_compares_with_the_unchanged_scene(self):
        self.write("sum.glsl", "#define STEPS 64\nvoid mainImage(out vec4 c, in vec2 p) {\n    float sum = 0.0;\n"
                               "    for (int i = 0; i < STEPS; ++i) sum += 0.004 * p.x / iResolution.x;\n    c = vec4(sum);\n}\n")
        _, said = self.tune("--max-error", "psnr=40dB")
        self.assertIn("the scene as it is takes the place of a reference: it does not converge", said)
        self.assertNotIn("error:", said)

    def test_steps_lengthen_when_the_reach_is_kept(self):
        self.write("sum.glsl", """#define TURNS 200
const float OMEGA = 0.4;
float map(vec3 p) { return min(length(p) - 0.8, p.y + 0.9); }
void mainImage(out vec4 c, in vec2 f) {
    vec3 ray = normalize(vec3((2.0 * f - iResolution.xy) / iResolution.y, -1.8)), at = vec3(0.0, 0.4, 3.5);
    float t = 0.0; bool hit = false;
    for (int i = 0; i < TURNS; i++) {
        float d = map(at + t * ray);
        if (d < 0.0005) { hit = true; break; }
        t += OMEGA * d;
        if (t > 25.0) break;
    }
    c = vec4(vec3(hit ? exp(-0.15 * t) : 0.1), 1.0);
}
""")
        found, said = self.choice("--max-error", "psnr=35dB")
        self.assertIn("varies OMEGA (scales the step at sum.glsl:10)", said)
        self.assertNotIn("only the march's own settings", said)
        self.assertGreater(float(found["chosen"]["OMEGA"]), 0.5, said)

    def test_a_project_is_imported_beside_itself(self):
        code = SUM.replace("\n", "\\n")
        self.write("sum.json", '{"Shader": {"info": {"name": "sum"}, "renderpass": [{"type": "image", "name": "Image", '
                               f'"inputs": [], "outputs": [], "code": "{code}"}}]}}}}')
        before = (self.folder / "sum.json").read_bytes()
        done = self.succeed("tune", "sum.json", *QUICK, "--max-error", "psnr=50dB", "--write")
        self.assertIn("wrote sum: image.glsl, scene.json\n", done.stderr)
        chosen = re.search("^chosen: STEPS = (\\d+)", done.stderr, re.MULTILINE)[1]
        self.assertTrue((self.folder / "sum/image.glsl").read_text().startswith(f"#define STEPS {chosen}\n"))
        self.assertEqual((self.folder / "sum.json").read_bytes(), before)


if __name__ == "__main__":
    main()
