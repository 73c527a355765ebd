"""tidemark capture --lens: one number per pixel, against numbers that are known beforehand."""
import json
import random
import statistics

from support.march import HALVING
from support.program import ProgramTest, environment, has_mesa_22, main

WIDTH, HEIGHT = 24, 16

LOOPS = """void mainImage(out vec4 color, in vec2 place) {
    float sum = 0.0;
    int count = int(place.x);
    for (int i = 0; i < count; ++i) {
        sum += 0.001 * float(i);
    }
    vec3 shade = vec3(sum, place / iResolution.xy);
    if (place.x < 12.0)
        shade *= 0.5;
    color = vec4(shade, 1.0);
}
"""
SINES = """void mainImage(out vec4 color, in vec2 place) {
    int count = place.x < 12.0 ? 2000 : 20;
    float x = place.y;
    for (int i = 0; i < count; ++i)
        x = sin(x) + 0.5;
    color = vec4(fract(x), 0.0, 0.0, 1.0);
}
"""
COARSE = """void mainImage(out vec4 color, in vec2 place) {
    float far = 1000000.0 + place.x / 7.0;
    color = vec4(fract(far), fract(far * 3.0), 0.5, 1.0);
}
"""


# A buffer that counts frames: in frame N the loop has N + 1 iterations, because it reads itself.
COUNTING = """#iChannel0 "Buffer A"
#iChannel1 "Buffer B"
void mainImage(out vec4 color, in vec2 place) {
    float frames = texelFetch(iChannel0, ivec2(place), 0).x + 1.0;
    float later = texelFetch(iChannel1, ivec2(place), 0).x;
    float sum = 0.0;
    for (int i = 0; i < int(frames); ++i)
        sum += sin(float(i) + place.x);
    color = vec4(frames, sum, later, 3.0);
}
"""
SECOND = """#iChannel0 "Buffer A"
void mainImage(out vec4 color, in vec2 place) {
    color = 10.0 * texelFetch(iChannel0, ivec2(place), 0);
}
"""
SHOWN = """#iChannel0 "Buffer B"
void mainImage(out vec4 color, in vec2 place) {
    color = vec4(fract(texelFetch(iChannel0, ivec2(place), 0).rgb), 1.0);
}
"""


class Passes(ProgramTest):
    """Lenses of a buffer."""

    def setUp(self):
        super().setUp()
        for name, text in (("image", SHOWN), ("buffer_a", COUNTING), ("buffer_b", SECOND)):
            self.write(f"counting/{name}.glsl", text)

    def values(self, lens, frame, name="Buffer A"):
        run = self.run_program("capture", "counting", "--size", f"{WIDTH}x{HEIGHT}", "--lens", lens, "--pass", name, "--frame",
                               str(frame), "-o", "lens.png", "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        report = json.loads(run.stdout)["frames"][0]["lens"]
        return report, set(report["values"])

    def test_a_buffer_reads_what_it_reads_without_the_lens(self):
        report, values = self.values("steps:7", 4)
        self.assertEqual(values, {5.0})
        self.assertIn("Buffer A", report["title"])
        self.assertEqual(self.values("value:5", 4)[1], {40.0})
        self.assertEqual(self.values("value:3:color.x", 4, "Buffer B")[1], {50.0})

    def test_the_cost_of_a_buffer_grows_with_its_iterations(self):
        costs = [self.values("cost", frame)[0]["median"] for frame in (1, 2, 3)]
        self.assertGreater(costs[1], costs[0])
        self.assertEqual(costs[2] - costs[1], costs[1] - costs[0])

    def test_errors_of_a_buffer_are_in_its_own_numbers(self):
        report, _ = self.values("error", 3)
        self.assertEqual(report["unit"], "of the buffer's numbers")
        self.assertTrue(0 < report["max"] < 1e-4, report["max"])

    def test_only_flat_passes_have_lenses(self):
        self.write("counting/cube_a.glsl", "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(1.0); }\n")
        run = self.run_program("capture", "counting", "--size", "24x16", "--lens", "cost", "--pass", "Cube A", "-o", "lens.png")
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertIn("only Image and buffers have lenses", run.stderr)

    def test_hot_lines_are_those_of_all_passes(self):
        hot = json.loads(self.succeed("inspect", "counting", "--hot-lines", "--json", "--size", "24x16", "--time", "1", "--budget", "0").stdout)
        self.assertEqual(hot["not_counted"], [])
        files = {line["file"].rpartition("/")[2] for line in hot["lines"]}
        self.assertEqual(files, {"image.glsl", "buffer_a.glsl", "buffer_b.glsl"})
        self.assertTrue(hot["lines"][0]["file"].endswith("buffer_a.glsl"))
        self.assertAlmostEqual(sum(line["share"] for line in hot["lines"]), 1, places=6)
        one = json.loads(self.succeed("inspect", "counting", "--hot-lines", "--json", "--size", "24x16", "--time", "1", "--budget",
                                      "0", "--pass", "Buffer B").stdout)
        self.assertEqual({line["file"].rpartition("/")[2] for line in one["lines"]}, {"buffer_b.glsl"})

    def test_hot_lines_are_measured_by_doing_them_twice(self):
        self.write("heavy.glsl", """void mainImage(out vec4 c, in vec2 p) {
    float x = p.x, y = p.y, unread = sin(sin(x + y));
    for (int i = 0; i < 60; ++i)
        x = sin(x) + exp(cos(x * 1.1 + y));
    y += x * 0.5;
    c = vec4(fract(x), fract(y), 0.0, 1.0);
}
""")
        arguments = ("inspect", "heavy.glsl", "--hot-lines", "--size", "64x36", "--budget", "4")
        table = environment(XDG_CACHE_HOME=str(self.folder / "cache"))  # weights of the table, whatever a self test has kept
        hot = json.loads(self.succeed(*arguments, "--json", env=table).stdout)
        lines = {line["line"]: line for line in hot["lines"]}
        self.assertEqual(hot["lines"][0]["line"], 4)
        self.assertEqual(lines[4]["basis"], "measured")
        self.assertLess(lines[4]["interval"][0], lines[4]["interval"][1])
        self.assertTrue(lines[4]["interval"][0] <= lines[4]["share"] <= lines[4]["interval"][1])
        self.assertGreater(lines[4]["counted"], 0.9)
        self.assertEqual((lines[3]["basis"], lines[3]["interval"]), ("counted", None), "the head of a loop")
        self.assertEqual(lines[3]["share"], lines[3]["counted"])
        self.assertNotIn(2, lines, "nothing reads what the line computes")
        text = self.succeed(*arguments, env=table).stdout.decode()
        self.assertRegex(text, r"(?m)^ +[\d.]+ %  -?[\d.]+ to [\d.]+ +heavy\.glsl:4: x = sin")
        self.assertRegex(text, r"(?m)^ +[\d.]+ %  counted +heavy\.glsl:3: for")
        counted = self.succeed(*arguments[:-1], "0", env=table).stdout.decode()
        self.assertNotIn("counted", counted)
        self.assertRegex(counted, r"(?m)^ +[\d.]+ %  heavy\.glsl:4: x = sin")


class Weights(ProgramTest):
    """Weights that the self test has measured."""

    def hot(self, cache):
        run = self.succeed("inspect", "scene.glsl", "--hot-lines", "--json", "--size", "24x16", "--budget", "0", env=cache)
        return json.loads(run.stdout)

    def test_the_self_test_measures_weights_that_are_used_from_then_on(self):
        self.write("scene.glsl", """void mainImage(out vec4 c, in vec2 p) {
    float x = p.x;
    if (p.x < -1.0)
        x = sin(x) + sin(x + 1.0) + sin(x + 2.0);
    c = vec4(x);
}
""")
        cache = environment(XDG_CACHE_HOME=str(self.folder / "cache"))
        before = self.hot(cache)
        self.assertEqual(before["weights"], "weights of the table")
        shares = {line["line"]: line["share"] for line in before["lines"]}
        self.assertEqual(shares.get(4, 0), 0, "no pixel takes the branch")
        devices = json.loads(self.succeed("inspect", "--devices", "--json").stdout)["devices"]
        device = next(device for device in devices if "unusable" not in device)
        tested = json.loads(self.succeed("inspect", "--devices", "--self-test", "--json", "--device", device["name"], env=cache).stdout)
        check = next(check for check in tested["devices"][0]["checks"] if check["check"] == "weights")
        self.assertEqual(check["verdict"], "pass")
        if "too busy" in check["says"]:
            self.skipTest("the machine is too busy to measure")
        self.assertRegex(check["says"], r"sine [\d.]+ \([\d.-]+ to [\d.]+\).*texture read [\d.]+.*kept for the lens cost")
        after = self.hot(cache)
        self.assertEqual(after["weights"], f"weights measured on {device['renderer']}")
        if device["renderer"].startswith("llvmpipe") and has_mesa_22():
            # It runs both sides of a branch, whatever its condition.
            self.assertGreater({line["line"]: line["share"] for line in after["lines"]}[4], 0.5)
        run = self.succeed("capture", "scene.glsl", "--size", "24x16", "--lens", "cost", "-o", "lens.png", "--json", env=cache)
        self.assertEqual(json.loads(run.stdout)["frames"][0]["lens"]["weights"], after["weights"])
        self.assertEqual(self.hot(environment(XDG_CACHE_HOME=str(self.folder / "cache"), TIDEMARK_CACHE="off")), before)


class Lens(ProgramTest):
    def lens(self, text, lens, *options, **more):
        self.write("scene.glsl", text)
        return self.run_program("capture", "scene.glsl", "--size", f"{WIDTH}x{HEIGHT}", "--lens", lens, "-o", "lens.png",
                                *options, **more)

    def report(self, text, lens, *options):
        run = self.lens(text, lens, "--json", *options)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(run.stdout)["frames"][0]["lens"]

    def columns(self, report):
        """One number for each column, which all of its pixels have."""
        rows = [report["values"][y * WIDTH:(y + 1) * WIDTH] for y in range(HEIGHT)]
        for row in rows:
            self.assertEqual(row, rows[0])
        return rows[0]

    def refuses(self, code, pattern, text, lens, *options):
        run = self.lens(text, lens, *options)
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertRegex(run.stderr, r"\A[^\n]+\n\Z")
        self.assertRegex(run.stderr, pattern)

    def test_the_steps_of_a_march_match_its_formula(self):
        report = self.report(HALVING.replace("LIMIT", "99"), "steps")
        self.assertEqual(self.columns(report), [x % 8 + 8 for x in range(WIDTH)])
        self.assertEqual((report["unit"], report["basis"], report["marked"]), ("iterations", "counted", 0))
        self.assertEqual((report["min"], report["max"]), (8, 15))

    def test_rays_that_run_out_of_iterations_are_marked(self):
        report = self.report(HALVING.replace("LIMIT", "12"), "steps")
        self.assertEqual(self.columns(report), [min(x % 8 + 8, 12) for x in range(WIDTH)])
        self.assertEqual(report["marked"], 3 * WIDTH // 8 * HEIGHT)

    def test_a_march_and_any_other_loop_are_chosen_by_their_line(self):
        march = self.report(HALVING.replace("LIMIT", "99"), "steps:8")
        self.assertEqual(self.columns(march), [x % 8 + 8 for x in range(WIDTH)])
        self.assertEqual(self.columns(self.report(LOOPS, "steps:4")), list(range(WIDTH)))
        self.refuses(2, "no loop begins at scene.glsl:3; loops of that file begin at line 4", LOOPS, "steps:3")

    def test_the_cost_of_a_loop_grows_with_its_iterations(self):
        cost = self.columns(self.report(LOOPS, "cost"))
        steps = [after - before for before, after in zip(cost, cost[1:])]
        for column, step in enumerate(steps):
            if column != 11:  # where the branch ends
                self.assertEqual(step, steps[0])
        self.assertGreater(steps[0], 0)
        self.assertEqual(steps[0] - steps[11], 3, "the branch multiplies three components")

    def test_clocks_show_where_the_time_goes(self):
        """The left half computes a hundred times as many sines. The device draws blocks whose sides divide 12."""
        report = self.report(SINES, "clocks")
        self.assertEqual((report["basis"], report["unit"], report["numbers"]), ("measured", "cycles", WIDTH * HEIGHT))
        left, right = (statistics.median(value for i, value in enumerate(report["values"]) if (i % WIDTH < 12) == side)
                       for side in (True, False))
        self.assertGreater(left, 10 * right)
        self.assertGreater(right, 0)

    def test_clocks_need_a_driver_with_clocks(self):
        """A program that was linked with other extensions is not taken from the cache."""
        cache = str(self.folder / "cache")
        for extensions, code in (("-GL_ARB_shader_clock", 3), (None, 0), ("-GL_ARB_shader_clock", 3)):
            run = self.lens(SINES, "clocks", env=environment(MESA_EXTENSION_OVERRIDE=extensions, XDG_CACHE_HOME=cache))
            self.assertEqual(run.returncode, code)
            if code:
                self.assertIn("the driver's shaders have no clock (GL_ARB_shader_clock)", run.stderr)

    def test_a_value_is_the_last_one_or_one_of_the_iterations(self):
        self.assertEqual(self.columns(self.report(LOOPS, "value:3")), [float(x) for x in range(WIDTH)])
        third = self.columns(self.report(LOOPS, "value:5:sum@3"))
        self.assertEqual(third[:3], [None] * 3)
        for value in third[3:]:
            self.assertAlmostEqual(value, 0.003, places=6)
        first = self.columns(self.report(LOOPS, "value:5:i@min"))
        self.assertEqual(first, [None] + [0] * (WIDTH - 1))
        last = self.columns(self.report(LOOPS, "value:5:i@max"))
        self.assertEqual(last, [None] + list(range(WIDTH - 1)))

    def test_a_vector_gives_three_numbers_and_a_component_one_number(self):
        shade = self.report(LOOPS, "value:7")
        self.assertEqual(len(shade["values"]), 3 * WIDTH * HEIGHT)
        self.assertAlmostEqual(shade["values"][1], 0.5 / WIDTH, places=6)
        part = self.columns(self.report(LOOPS, "value:7:shade.y"))
        self.assertAlmostEqual(part[23], 23.5 / WIDTH, places=6)

    def test_a_value_equals_the_value_of_trace(self):
        text = HALVING.replace("LIMIT", "99")
        values = self.report(text, "value:9:d")["values"]
        chance = random.Random(7)
        for _ in range(4):
            x, y = chance.randrange(WIDTH), chance.randrange(HEIGHT)
            traced = json.loads(self.run_program(
                "trace", "scene.glsl", "--size", f"{WIDTH}x{HEIGHT}", "--pixel", f"{x},{y}", "--line", "9",
                "--json").stdout)
            last = [value["float"][0] for call in traced["calls"] for value in call["values"] if value["name"] == "d"][-1]
            self.assertAlmostEqual(values[y * WIDTH + x], last, places=5)

    def test_a_branch_divides_the_picture(self):
        report = self.report(LOOPS, "branch:8")
        self.assertEqual(self.columns(report), [1.0] * 12 + [0.0] * 12)
        self.assertEqual(report["classes"], {"false": 12 * HEIGHT, "true": 12 * HEIGHT, "both in one pixel": 0})
        self.assertEqual(report["parting"], HEIGHT)

    def test_the_error_equals_the_difference_of_two_captures(self):
        report = self.report(COARSE, "error")
        for precision in ("single", "double"):
            self.run_program("capture", "scene.glsl", "--size", f"{WIDTH}x{HEIGHT}", "--precision", precision, "--depth",
                             "float", "-o", f"{precision}.exr")
        compared = json.loads(self.run_program("compare", "double.exr", "single.exr", "--json").stdout)
        largest = compared["frames"][0]["largest"]
        self.assertGreater(report["max"], 1)
        self.assertAlmostEqual(report["max"] / 255, largest, places=6)

    def test_rounding_names_the_variant_that_moves_the_picture(self):
        text = "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5)); }"
        report = self.report(text, "rounding")
        self.assertGreater(report["max"], 1)
        self.assertRegex(report["note"], "largest most often: .*sine")
        self.assertEqual(self.report("void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }", "rounding")["max"], 0)

    def test_proof_finds_the_rays_that_step_over(self):
        text = """float map(vec3 p) { return abs(p.z - 4.0) - 0.05; }
void mainImage(out vec4 color, in vec2 place) {
    vec3 ro = vec3(0.0), rd = normalize(vec3(0.001 * place, 1.0));
    float t = 0.0;
    float scale = place.x < 12.0 ? 1.0 : 1.9;
    for (int i = 0; i < 64; ++i) {
        float d = map(ro + t * rd);
        if (d < 0.001 || t > 20.0)
            break;
        t += d * scale;
    }
    color = vec4(vec3(t / 20.0), 1.0);
}
"""
        report = self.report(text, "proof")
        self.assertEqual(self.columns(report)[0], 0)
        self.assertEqual(report["basis"], "proved")
        self.assertIn(self.columns(report)[20], (1, 2))

    def test_an_exr_holds_the_numbers_and_a_png_a_legend(self):
        self.write("scene.glsl", LOOPS)
        for name in ("lens.exr", "lens.png"):
            run = self.run_program("capture", "scene.glsl", "--size", f"{WIDTH}x{HEIGHT}", "--lens", "value:3", "-o", name)
            self.assertEqual(run.returncode, 0, run.stderr)
        picture = (self.folder / "lens.png").read_bytes()
        width, height = int.from_bytes(picture[16:20], "big"), int.from_bytes(picture[20:24], "big")
        self.assertEqual((width, height % 2), (240, 0))
        self.assertEqual(height, HEIGHT + 74)  # margins, a bar and five rows: title, basis, numbers of the bar, two of statistics
        again = self.run_program("capture", "scene.glsl", "--size", f"{WIDTH}x{HEIGHT}", "--lens", "value:3", "-o", "two.png")
        self.assertEqual(again.returncode, 0, again.stderr)
        compared = self.run_program("compare", "lens.png", "two.png")
        self.assertEqual(compared.returncode, 0, compared.stdout)

    def test_a_scene_without_numbers_for_the_lens_is_refused(self):
        flat = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }"
        self.refuses(3, "--lens steps: no marching loop was found in Image$", flat, "steps")
        self.refuses(3, "--lens steps: no marching loop was found in Image; to count the iterations of any loop, give the line where it begins: steps:4$",
                     LOOPS, "steps")
        self.refuses(3, "--lens proof: no marching loop was found in Image", flat, "proof")
        holes = "void mainImage(out vec4 c, in vec2 p) { if (p.x > 9.0) discard; c = vec4(0.5); }"
        self.refuses(3, "--lens cost: the text discards pixels", holes, "cost")
        self.refuses(2, "scene.glsl:1 has no condition", flat, "branch:1")
        self.refuses(2, "scene.glsl:7 neither sets nor reads a variable nothing; it sets shade", LOOPS, "value:7:nothing")

    def test_a_text_that_shows_its_line_numbers_is_refused(self):
        lines = "void mainImage(out vec4 c, in vec2 p) { float a = float(__LINE__); c = vec4(a / 255.0); }"
        self.refuses(3, "--lens cost: the instrumented text draws another picture: .*; the text uses __LINE__, .*replace it", lines, "cost")

    def test_a_refusal_names_the_buffer_that_has_a_march(self):
        self.write("pair/buffer_a.glsl", HALVING.replace("LIMIT", "99"))
        self.write("pair/image.glsl", '#iChannel0 "Buffer A"\nvoid mainImage(out vec4 c, in vec2 p) {\n    c = texelFetch(iChannel0, ivec2(p), 0);\n}\n')
        for lens in ("steps", "proof"):
            run = self.run_program("capture", "pair", "--size", f"{WIDTH}x{HEIGHT}", "--lens", lens, "-o", "lens.png")
            self.assertEqual(run.returncode, 3, run.stderr)
            self.assertRegex(run.stderr, f'--lens {lens}: no marching loop was found in Image; Buffer A has one: add --pass "Buffer A"$')
        again = self.run_program("capture", "pair", "--size", f"{WIDTH}x{HEIGHT}", "--lens", "steps", "--pass", "Buffer A", "-o", "lens.png")
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_an_unknown_lens_is_refused(self):
        self.refuses(2, "give one of cost, steps.*branch:LINE", LOOPS, "speed")
        self.refuses(2, "give a line from 1, as in value:12", LOOPS, "value")
        self.refuses(2, "after @ give min, max, last or a number", LOOPS, "value:3:sum@often")
        self.refuses(2, "only value has", LOOPS, "cost@max")
        self.refuses(2, "--pass Buffer A: no such pass|--pass Buffer A: the scene has no such pass", LOOPS, "cost", "--pass", "Buffer A")

    def test_a_sequence_has_a_number_for_each_frame(self):
        self.write("scene.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    float t = iTime;\n    c = vec4(t); }")
        run = self.run_program("capture", "scene.glsl", "--size", "16x16", "--fps", "4", "--frames", "0-2", "--lens",
                               "value:2", "-o", "t.%d.png", "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual([frame["lens"]["max"] for frame in json.loads(run.stdout)["frames"]], [0, 0.25, 0.5])
        heads = [(self.folder / f"t.{frame}.png").read_bytes()[16:24] for frame in range(3)]
        self.assertEqual(len(set(heads)), 1)  # the size is that of the longest legend


if __name__ == "__main__":
    main()
