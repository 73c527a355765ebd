"""`capture --loop`: whether a sequence goes round."""
import json

from support.program import ProgramTest, main

SPIN = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5 + 0.5 * sin(6.2831853 * iTime * TURNS + p.x / 9.0), 0.0, 0.0, 1.0); }\n"


class Loop(ProgramTest):
    def looped(self, turns: str, *options: str, code: int = 0) -> str:
        self.write("spin.glsl", SPIN.replace("TURNS", turns))
        done = self.run_program("capture", "spin.glsl", "--size", "32x18", "--fps", "20", "-o", "%d.png", "--loop", *options)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def test_seamless_sequence(self) -> None:
        said = self.looped("1.0", "--frames", "0-19")
        self.assertRegex(said, r"loop: seamless; the frame after the last matches the first with (inf|[5-9]\d\.\d) dB \(a "
                               r"step inside of the loop: [12]\d\.\d dB\)\n")
        self.assertIn("seamless", self.looped("1.0", "--frames", "0-18x2"))

    def test_jumping_sequence(self) -> None:
        self.assertIn("loop: fails; it jumps at the start; ", self.looped("0.5", "--frames", "0-19", code=1))
        self.assertNotIn("20.png", self.files())  # what was drawn behind the last goes nowhere

    def test_loop_with_a_frame_missing_or_repeated(self) -> None:
        self.assertIn("loop: fails; frame 19 is missing at the end; ", self.looped("1.0", "--frames", "0-18", code=1))
        self.assertIn("loop: fails; frame 18 is missing at the end; ", self.looped("1.0", "--frames", "0-16x2", code=1))
        self.assertIn("loop: fails; frame 20 repeats the first: leave it out; ", self.looped("1.0", "--frames", "0-20", code=1))

    def test_samples_and_json(self) -> None:
        self.write("spin.glsl", SPIN.replace("TURNS", "1.0"))
        done = self.succeed("capture", "spin.glsl", "--size", "32x18", "--fps", "20", "--frames", "0-19", "-o", "%d.png", "--loop",
                            "--shutter", "0.5", "--samples", "4", "--json")
        loop = json.loads(done.stdout)["loop"]
        self.assertTrue(loop["seamless"])
        self.assertGreater(loop["closing_psnr"] or 999, loop["step_psnr"] + 20)

    def test_missing_and_conflicting_options_are_refused(self) -> None:
        self.write("spin.glsl", SPIN.replace("TURNS", "1.0"))
        for words, says in ((["--loop"], "give at least two --frames"),
                            (["--loop", "--frames", "0-9", "-o", "%d.png", "--tile", "8", "--size", "32x32"], "drawn in tiles "
                                    "cannot be compared"),
                            (["--loop", "--frames", "0-9", "-o", "%d.png", "--resume"], "excludes")):
            self.expect_failure_like(["capture", "spin.glsl", *words], 2, f"(.|\n)*{says}(.|\n)*")


if __name__ == "__main__":
    main()
