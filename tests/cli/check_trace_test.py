"""tidemark check --trace: where a NaN has its origin, as people and as scripts read it."""
import json

from support.program import ProgramTest, main

FAULTY = """void mainImage(out vec4 c, in vec2 p) {
    float none = floor(p.x / 1000.0), wave = 0.31 / none;
    c = vec4(wave);
}
"""
SOUND = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, 0.0, 1.0); }\n"


class CheckTrace(ProgramTest):
    def check(self, text, *options):
        self.write("waves.glsl", text)
        run = self.run_program("check", "waves.glsl", "--trace", "--size", "16x9", *options)
        run.stdout = run.stdout.decode()
        return run

    def test_the_statement_is_named(self):
        run = self.check(FAULTY)
        self.assertEqual(run.returncode, 1)
        self.assertEqual(run.stdout, "waves.glsl:2:46: `wave = 0.31 / none` gave +Inf: none = 0 "
                                     "(division by zero) in Image, frame 0, pixel 0,0\n")

    def test_json(self):
        run = self.check(FAULTY, "--json", "--frame", "7", "--pixel", "3,2")
        self.assertEqual(run.returncode, 1)
        report = json.loads(run.stdout)
        self.assertFalse(report["finite"])
        trace = report["trace"]
        self.assertEqual((trace["frame"], trace["pixel"]), (7, [3, 2]))
        first = trace["first"]
        self.assertEqual((first["file"], first["line"], first["column"]), ("waves.glsl", 2, 46))
        self.assertEqual(first["operands"], [{"text": "none", "value": "0"}])
        self.assertEqual(trace["fix"]["line"], 2)

    def test_a_finite_scene(self):
        run = self.check(SOUND)
        self.assertEqual((run.returncode, run.stdout), (0, "every pixel is finite; --hidden searches for a NaN that was "
                                                           "masked\n"))
        run = self.check(SOUND, "--hidden", "--json")
        self.assertEqual(run.returncode, 0)
        self.assertTrue(json.loads(run.stdout)["finite"])

    def test_operands_do_not_contradict_the_reason(self):
        run = self.check("void mainImage(out vec4 c, in vec2 p) {\n"
                         "    float one = iResolution.x / iResolution.x + 1.2e-7;\n    c = vec4(acos(one));\n}\n")
        self.assertIn("one = 1.0000001 (acos outside of [-1, 1])", run.stdout)
        run = self.check("void mainImage(out vec4 c, in vec2 p) {\n"
                         "    uint bits = uint(iResolution.x) + 2143289328u;\n    c = vec4(uintBitsToFloat(bits));\n}\n")
        self.assertIn("bits = 2143289344 (0x7fc00000)", run.stdout)

    def test_the_largest_frame_number(self):
        run = self.check(SOUND, "--frame", "100000000")
        self.assertEqual(run.returncode, 0, run.stderr)
        run = self.check(FAULTY, "--frame", "100000000")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("none = 0 (division by zero) in Image, frame 100000000, pixel 0,0\n", run.stdout)
        self.assertNotIn("note:", run.stdout)

    def test_a_far_frame_of_a_feedback_scene_times_out_with_a_reason(self):
        run = self.check('#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) '
                         "{ c = 0.5 * texelFetch(iChannel0, ivec2(p), 0) + 0.5; }\n", "--frame", "100000000",
                         "--timeout", "5")
        self.assertEqual(run.returncode, 5)
        self.assertRegex(run.stderr, r"stopped after 5 s at frame \d+ of 100000000: a scene with feedback must be drawn frame "
                                     r"by frame from 0\n")

    def test_a_scene_that_does_not_compile(self):
        run = self.check("void mainImage(out vec4 c, in vec2 p) { c = x; }\n")
        self.assertEqual(run.returncode, 3)
        self.assertIn("waves.glsl:1", run.stderr)

    def test_stops_after_the_time_limit(self):
        run = self.check(SOUND, "--timeout", "0.001")  # no context is made so fast
        self.assertEqual(run.returncode, 5)
        self.assertIn("stopped after 0.001 s", run.stderr)

    def test_usage(self):
        for options in (("--pixel", "16,0"), ("--pixel", "x"), ("--timeout", "0"), ("--frames", "0-3"),
                        ("--portable",), ("--precision", "double")):
            with self.subTest(options=options):
                self.assertEqual(self.check(SOUND, *options).returncode, 2)


if __name__ == "__main__":
    main()
