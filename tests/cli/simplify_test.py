"""`simplify`: scenes in which something dear shows little or nothing; what is offered, written, refused."""
import json

from support.program import ProgramTest, main

# 500 iterations of one loop change nothing that is seen; 200 of another change a little.
SCENE = """float dear(float x, int n) {
    float sum = x;
    for (int i = 0; i < 5000; ++i) {
        if (i >= n) break;
        sum = sin(sum * 1.37 + x) + cos(sum * 0.73 - x);
    }
    return sum;
}
void mainImage(out vec4 c, in vec2 p) {
    vec2 uv = p / iResolution.xy;
    vec3 colour = vec3(uv, 0.5 + 0.4 * sin(iTime));
    colour += max(0.0, dear(uv.x, 500) - 50.0);
    colour += 0.002 * dear(uv.y, 200);
    c = vec4(colour, 1.0);
}
"""
QUICK = ("--size", "48x27", "--budget", "240")  # what a search on a full machine may need


class Simplify(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("dear.glsl", SCENE)

    def simplify(self, *arguments: str) -> tuple[dict, str]:
        done = self.succeed("simplify", "dear.glsl", "--json", *QUICK, *arguments)
        return json.loads(done.stdout), done.stderr

    def compare(self, *limit: str) -> None:
        """What is there now with what was, at a size and a moment that nobody searched."""
        self.write("before.glsl", SCENE)
        for name in "before", "dear":
            self.succeed("capture", f"{name}.glsl", "--size", "200x120", "--time", "33", "-o", f"{name}.png")
        self.succeed("compare", "before.png", "dear.png", *limit)

    def test_invisible_work_is_left_out_and_no_byte_changes(self):
        found, said = self.simplify("--exact", "--write")
        self.assertTrue(found["written"], said)
        text = (self.folder / "dear.glsl").read_text()
        self.assertEqual(text.count("\n"), SCENE.count("\n"))
        self.assertNotIn("dear(uv.x, 500) - 50.0);", text, said)
        self.assertIn("0.002 * dear(uv.y, 200)", text)
        self.compare("--max-rmse", "0")
        for cut in found["cuts"]:
            self.assertEqual(cut["error_alone"], 0)

    def test_nearly_invisible_work_is_cut_within_the_error(self):
        found, said = self.simplify("--max-error", "psnr=40dB")
        self.assertEqual((self.folder / "dear.glsl").read_text(), SCENE)
        unseen, *others = found["cuts"]
        self.assertEqual(unseen["error_alone"], 0, said)
        self.assertTrue(any(cut["error_alone"] > 0 for cut in others), said)
        self.assertRegex(said, r"chosen: step \d+: \d+ cuts?: [\d.]+ x \[[\d.]+, [\d.]+\] as fast as unchanged")
        self.assertRegex(said, r"\d+ operations a pixel instead of \d+ \(of Image, counted in the text on \d+ and")
        self.assertTrue((self.folder / "dear-simplify" / "report.html").exists())
        views = list(found["study"]["points"][0]["views"])
        self.assertEqual(len([view for view in views if "not searched" in view]), 3)

    def test_the_picture_stays_within_the_error_at_another_size(self):
        self.simplify("--max-error", "psnr=40dB", "--write")
        self.compare("--min-psnr", "40")

    def test_a_smooth_buffer_is_drawn_at_half_its_size(self):
        self.write("smooth.glsl", """void mainImage(out vec4 c, in vec2 p) {
    float sum = 0.0;
    for (int i = 0; i < 120; ++i) sum += sin(4.0 * p.x / iResolution.x + 0.1 * float(i) + iTime);
    c = vec4(0.5 + 0.1 * sum);
}
""")
        self.write("dear.glsl", """#iChannel0 "file://smooth.glsl"
void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p / iResolution.xy); }
""")
        found, said = self.simplify("--max-error", "psnr=50dB", "--size", "320x180", "--write")
        reasons = [cut["cut"] for cut in found["cuts"]]
        self.assertIn("smooth.glsl:1: draws the buffer at half its width and height", reasons, said)
        self.assertIn("p *= 2.0;", (self.folder / "smooth.glsl").read_text())
        self.assertIn("0.5 * fract(p / iResolution.xy)", (self.folder / "dear.glsl").read_text())

    def test_a_march_ends_at_a_coarser_limit(self):
        """Floats do not get as near as 1e-7, so that rays take all 400 steps."""
        text = """float map(vec3 p) { return min(length(p) - 1.0, p.y + 1.2); }
void mainImage(out vec4 c, in vec2 p) {
    vec3 d = normalize(vec3((2.0 * p - iResolution.xy) / iResolution.y, 1.6)), o = vec3(0.3 * sin(iTime), 0.2, -3.0);
    float t = 0.0;
    for (int i = 0; i < 400; ++i) {
        float h = map(o + t * d);
        if (h < 0.0000001 || t > 40.0) break;
        t += h;
    }
    vec3 q = o + t * d;
    c = vec4(t > 40.0 ? d * 0.5 + 0.5 : 0.5 + 0.4 * sin(2.0 * q), 1.0);
}
"""
        self.write("dear.glsl", text)
        self.write("before.glsl", text)
        found, said = self.simplify("--write", "--views", "1;4.3")
        reasons = " ".join(cut["cut"] for cut in found["cuts"])
        self.assertRegex(reasons, "leaves the loop by `h < 0.0000001` with ", said)
        for name in "before", "dear":
            self.succeed("capture", f"{name}.glsl", "--size", "96x54", "--time", "77", "-o", f"{name}.png")
        done = self.succeed("compare", "before.png", "dear.png", "--json")
        self.assertLessEqual(json.loads(done.stdout)["frames"][0]["flip"], 0.01, reasons)

    def test_feedback_scenes_are_searched_near_the_first_frame(self):
        self.write("dear.glsl", """#iChannel0 "self"
void mainImage(out vec4 c, in vec2 p) { c = 0.9 * texture(iChannel0, p / iResolution.xy) + 0.1 * sin(iTime + p.x); }
""")
        found, said = self.simplify("--budget", "3")
        views = list(found["study"]["points"][0]["views"])
        self.assertEqual(views[:4], ["t=0.2", "t=0.5", "t=1", "t=2"], said)
        self.assertLess(max(float(view.removeprefix("t=").split(",")[0]) for view in views), 6)

    def test_an_endless_loop_is_named_and_kept(self):
        self.write("dear.glsl", SCENE.replace("for (int i = 0; i < 5000; ++i) {", "int i = -1; for (;;) { ++i;"))
        found, said = self.simplify("--exact")
        self.assertIn("dear.glsl:3: this loop may be endless by its head", said)
        for cut in found["cuts"]:
            self.assertNotRegex(cut["cut"], r"dear\.glsl:[3-6]:")

    def test_a_verdict_names_inputs_that_were_silent(self):
        self.write("dear.glsl", '#iChannel0 "keyboard"\n#iChannel1 "microphone"\n' + SCENE.replace(
            "c = vec4", "colour += texture(iChannel0, vec2(0.5)).x + 0.01 * texture(iChannel1, vec2(0.5)).x;\n    c = vec4"))
        _, said = self.simplify("--budget", "10")
        self.assertIn("judged with no key pressed and silence: the cuts may leave out what another input would show", said)
        self.write("dear.glsl", SCENE)
        _, said = self.simplify("--budget", "10")
        self.assertNotIn("judged with", said)

    def test_reports_a_scene_without_cuts(self):
        self.write("dear.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.0, 1.0); }\n")
        found, said = self.simplify("--exact")
        self.assertEqual(found["cuts"], [])
        self.assertIn("no cut is measurably faster", said)

    def test_bad_requests_are_refused(self):
        for arguments, words in ((("--max-error", "wrong=1%"), "simplify compares pictures"),
                                 (("--max-error", "flip"), "give rmse=0.01"),
                                 (("--budget", "0"), "above 0"),
                                 (("--exact", "--max-error", "flip=0.1"), "--exact")):
            with self.subTest(arguments=arguments):
                done = self.run_program("simplify", "dear.glsl", *arguments)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(words, done.stderr)

    def test_a_project_is_imported_beside_itself(self):
        self.succeed("export", "dear.glsl", "-o", "project.json")
        before = (self.folder / "project.json").read_bytes()
        done = self.succeed("simplify", "project.json", *QUICK)
        self.assertIn("wrote project: image.glsl, scene.json\n", done.stderr)
        self.assertIn("--- project/image.glsl\n", done.stdout.decode())
        self.assertEqual((self.folder / "project.json").read_bytes(), before)

    def test_a_picture_of_nan_is_refused_as_reference(self):
        self.write("dear.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(sqrt(-p.x)); }\n")
        done = self.run_program("simplify", "dear.glsl", *QUICK)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("nothing can be compared with the scene's picture: all of its pixels are NaN or infinite", done.stderr)

    def test_pixels_of_nan_are_compared_as_shown(self):
        self.write("dear.glsl", SCENE.replace("c = vec4(colour", "c = vec4(uv.x > 0.5 ? vec3(sqrt(-uv.x)) : colour"))
        found, said = self.simplify("--exact")
        self.assertTrue(found["cuts"], said)
        self.assertRegex(said, r"chosen: step \d+: ")


if __name__ == "__main__":
    main()
