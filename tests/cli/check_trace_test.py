"""tidemark check --trace: where a NaN is born, as people and as scripts read it."""
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
        self.assertEqual(trace["cure"]["line"], 2)

    def test_a_finite_scene(self):
        run = self.check(SOUND)
        self.assertEqual((run.returncode, run.stdout), (0, "every pixel is finite\n"))
        run = self.check(SOUND, "--hidden", "--json")
        self.assertEqual(run.returncode, 0)
        self.assertTrue(json.loads(run.stdout)["finite"])

    def test_a_scene_that_does_not_compile(self):
        run = self.check("void mainImage(out vec4 c, in vec2 p) { c = x; }\n")
        self.assertEqual(run.returncode, 3)
        self.assertIn("waves.glsl:1", run.stderr)

    def test_what_takes_too_long_is_given_up(self):
        run = self.check(SOUND, "--timeout", "0.001")  # no context is made so fast
        self.assertEqual(run.returncode, 5)
        self.assertIn("gave up after 0.001 s", run.stderr)

    def test_usage(self):
        for options in (("--pixel", "16,0"), ("--pixel", "x"), ("--timeout", "0"), ("--frames", "0-3"),
                        ("--portable",), ("--precision", "double")):
            with self.subTest(options=options):
                self.assertEqual(self.check(SOUND, *options).returncode, 2)


if __name__ == "__main__":
    main()
