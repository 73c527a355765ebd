"""tidemark trace: what each line computes for a pixel, as people and as scripts read it."""
import json

from support.program import ProgramTest, main

MARCH = """float map(vec3 p) {
    return length(p) - 1.0;
}
vec3 tint;
void mainImage(out vec4 color, in vec2 place) {
    vec3 ro = vec3(0.0, 0.0, -3.0), rd = normalize(vec3(place - 8.0, 40.0));
    tint = vec3(0.5, 0.25, 1.0) * iResolution.x;
    float t = 0.0;
    // nothing
    for (int i = 0; i < 30; ++i) {
        float d = 0.3 * map(ro + t * rd);
        if (d < 0.001)
            break;
        t += d;
    }
    float heights[4];
    for (int i = 0; i < 4; ++i)
        heights[i] = float(i) * t;
    if (place.x > 100.0)
        t = 3.0;
    color = vec4(t, heights[int(place.x) % 4], tint.x, 1.0);
}
"""
CANCELLED = """void mainImage(out vec4 color, in vec2 place) {
    float small = 0.0001 * place.x;
    float sum = 1.0 + small;
    float left = sum - 1.0;
    color = vec4(left > small ? 1.0 : 0.0, sqrt(-left), left, 1.0);
}
"""


class Trace(ProgramTest):
    def trace(self, text, *options, pixel="8,8"):
        self.write("scene.glsl", text)
        return self.run_program("trace", "scene.glsl", "--size", "16x16", "--pixel", pixel, *options)

    def report(self, text, *options):
        run = self.trace(text, "--json", *options)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(run.stdout)

    def values(self, line, *options, text=MARCH):
        report = self.report(text, "--line", str(line), *options)
        return [value for call in report["calls"] for value in call["values"]]

    def fails(self, code, pattern, text, *options, pixel="8,8"):
        run = self.trace(text, *options, pixel=pixel)
        self.assertEqual(run.returncode, code, run.stdout)
        self.assertRegex(run.stderr, r"\A[^\n]+\n\Z")
        self.assertRegex(run.stderr, pattern)

    def test_reports_computed_and_drawn_colour(self):
        colour = self.report(MARCH)["colour"]
        self.assertTrue(colour["as_drawn"])
        for float_, double, device in zip(colour["float"], colour["double"], colour["device"]):
            self.assertAlmostEqual(float_, double, 5)
            self.assertAlmostEqual(float_, device, 5)

    def test_a_line_names_its_variables(self):
        (ro, rd) = self.values(6)
        self.assertEqual((ro["name"], ro["float"], rd["name"], rd["rows"]), ("ro", [0, 0, -3], "rd", 3))

    def test_a_global_and_an_element_have_their_names(self):
        (tint,) = self.values(7)
        self.assertEqual((tint["name"], tint["float"]), ("tint", [8, 4, 16]))
        names = [value["name"] for value in self.values(18)]
        self.assertEqual(names, ["heights[0]", "heights[1]", "heights[2]", "heights[3]"])

    def test_iterations_of_a_loop(self):
        steps = self.values(14, "--turns", "1-100")
        self.assertEqual([value["turns"] for value in steps], [[turn] for turn in range(1, len(steps) + 1)])
        self.assertGreater(len(steps), 10)
        folded = self.values(14)
        self.assertLess(len(folded), 10)
        self.assertEqual(folded[-1], steps[-1])
        self.assertEqual([value["turns"] for value in self.values(14, "--turns", "3-4")], [[3], [4]])

    def test_a_function_lists_its_call_sites(self):
        report = self.report(MARCH, "--line", "2")
        (call,) = report["calls"]
        self.assertEqual(call["function"], "map")
        self.assertEqual(call["called_at"], [{"file": "scene.glsl", "line": 11}])
        self.assertEqual({value["name"] for value in call["values"]}, {"return"})

    def test_a_cancellation_is_found(self):
        lines = {line["line"]: line for line in self.report(CANCELLED)["lines"]}
        self.assertGreater(lines[4]["lost"], 2)
        self.assertLess(lines[4]["digits"], 5)
        self.assertLess(lines[3]["lost"], 1)
        self.assertIn("not_finite", lines[5])

    def test_reports_non_finite_values(self):
        run = self.trace(CANCELLED)
        self.assertEqual(run.returncode, 0)
        text = run.stdout.decode()
        self.assertRegex(text, r"lost digits \(a float has 7.2\)\n  scene.glsl:4: \d\.\d lost; left has \d\.\d\n"
                               r"      float left = sum - 1.0;\n")
        self.assertRegex(text, r"not finite\n  scene.glsl:5: color\n")
        self.assertRegex(text, r"  g +NaN +NaN +0\.0 +NaN\n")

    def test_divergence_of_float_and_double_is_reported(self):
        lines = {line["line"]: line for line in self.report(
            "void mainImage(out vec4 color, in vec2 place) {\n"
            "    float sum = 1.0;\n"
            "    for (int i = 0; i < 9; ++i)\n"
            "        sum += 5e-9 * place.x;\n"
            "    if (sum > 1.0000001)\n"
            "        sum = 2.0;\n"
            "    color = vec4(sum);\n"
            "}\n")["lines"]}
        self.assertIn("parted", lines[5])
        self.assertEqual(lines[5]["text"], "if (sum > 1.0000001)")

    def test_the_seed_changes_the_samples(self):
        first = self.report(CANCELLED)
        self.assertEqual(first, self.report(CANCELLED))
        other = self.report(CANCELLED, "--seed", "7")
        self.assertEqual(other["seed"], 7)
        self.assertEqual(first["colour"]["float"], other["colour"]["float"])

    def test_a_table(self):
        run = self.trace(MARCH, "--line", "11", "--turns", "2")
        lines = run.stdout.decode().splitlines()
        self.assertEqual(lines[6], "scene.glsl:11:  float d = 0.3 * map(ro + t * rd);")
        self.assertRegex(lines[7], r"^ +iteration  value +float +double  digits$")
        self.assertEqual(lines[8], "          …")
        self.assertRegex(lines[9], r"^ +2  p\.x +0\.\d+ +0\.\d+ +\d\.\d$")
        self.assertRegex(lines[12], r"^ +2  d +0\.\d+ +0\.\d+ +\d\.\d")

    def test_line_that_the_pixel_does_not_reach(self):
        run = self.trace(MARCH, "--line", "20")
        self.assertEqual(run.returncode, 0)
        self.assertTrue(run.stdout.decode().endswith(
            "scene.glsl:20:  t = 3.0;\n  the pixel does not reach this line\n"), run.stdout)

    def test_a_computed_global_has_its_value(self):
        report = self.report("float twice = 2.0 * iTime;\n"
                             "void mainImage(out vec4 color, in vec2 place) { color = vec4(twice); }\n", "--time", "3")
        self.assertEqual(report["colour"]["float"], [6, 6, 6, 1])

    def test_a_buffer(self):
        self.write("both/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p.x); }\n")
        self.write("both/image.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p.y); }\n")
        run = self.run_program("trace", "both", "--size", "16x16", "--pixel", "3,4", "--pass", "Buffer A", "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(json.loads(run.stdout)["colour"]["float"], [3.5] * 4)

    def test_errors_say_what_to_do(self):
        self.fails(2, r"error: --pixel 16,3: .* 16x16$", MARCH, pixel="16,3")
        self.fails(2, r"error: --line 9: .* scene\.glsl .*: 8, 10$", MARCH, "--line", "9")
        self.fails(2, r"error: --line none: .* FILE:LINE$", MARCH, "--line", "none")
        self.fails(2, r"error: --line other\.glsl:3: .* from scene\.glsl$", MARCH, "--line", "other.glsl:3")
        self.fails(2, r"error: --turns 5-2: ", MARCH, "--line", "11", "--turns", "5-2")
        self.fails(2, r"error: .* one frame: .* --frame N or --time T$", MARCH, "--frames", "0-3")
        self.fails(3, r"\Ascene\.glsl:2: error: .* texture read: .* textureGather",
                   "void mainImage(out vec4 c, in vec2 p) {\n    c = textureGather(iChannel0, p);\n}\n")
        run = self.trace(MARCH, "--pass", "Buffer Z")
        self.assertEqual(run.returncode, 2)
        self.assertIn("Buffer Z", run.stderr)

    def test_unused_texture_lookup_does_not_matter(self):
        report = self.report("void mainImage(out vec4 c, in vec2 p) {\n    vec4 unused = texture(iChannel1, p);\n"
                             "    c = vec4(0.5);\n}\n")
        self.assertTrue(report["colour"]["as_drawn"], report["colour"])

    def test_texture_reads_equal_those_of_the_device(self):
        report = self.report("void mainImage(out vec4 c, in vec2 p) {\n"
                             "    c = textureLod(iChannel0, (floor(p) + 0.5) / 256.0, 0.0) + texelFetch(iChannel0, ivec2(p), 1);\n"
                             "    c += vec4(textureSize(iChannel0, 0), 0.0, 0.0);\n}\n")
        self.assertTrue(report["colour"]["as_drawn"], report["colour"])
        self.assertFalse(report["colour"]["textures_at_base_level"])
        report = self.report("void mainImage(out vec4 c, in vec2 p) {\n    c = texture(iChannel0, p / 37.0);\n}\n")
        self.assertTrue(report["colour"]["textures_at_base_level"])

    def test_a_pixel_that_takes_too_long(self):
        run = self.trace("void mainImage(out vec4 c, in vec2 p) {\n    float a = 0.0;\n"
                         "    for (int i = 0; p == vec2(8.5) && i < 20000000; ++i)\n        a += sin(a) + 0.001;\n    c = vec4(a);\n}\n")
        self.assertEqual(run.returncode, 5)
        self.assertIn(b"stopped: the pixel takes too many operations", run.stdout)

    def test_a_discarded_pixel(self):
        run = self.trace("void mainImage(out vec4 c, in vec2 p) {\n    if (p.x > 3.0)\n        discard;\n"
                         "    c = vec4(1);\n}\n")
        self.assertEqual(run.returncode, 0)
        self.assertIn(b"the pixel is discarded\n", run.stdout)


if __name__ == "__main__":
    main()
