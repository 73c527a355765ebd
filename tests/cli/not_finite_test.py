"""What `capture` says of pixels that are no numbers, which few files can show."""
import json
import re
import shlex

from support import png
from support.program import ProgramTest, main

# The left half from frame 2 on; one pixel has it in a channel alone.
SCENE = """void mainImage(out vec4 c, in vec2 p) {
    c = vec4(0.25);
    if (p.x < 8.0 && iFrame > 1)
        c = vec4(log(iTime - 100.0), 0.5, 0.5, 1.0);
    if (int(p.x) == 12 && int(p.y) == 1)
        c.b = 1.0 / (iTime - iTime);
}
"""
SIZE = ("--size", "16x4")


class NotFinite(ProgramTest):
    def counts(self, *options: str) -> list[int]:
        done = self.succeed("capture", *options, "--json")
        return [frame["not_finite"] for frame in json.loads(done.stdout)["frames"]]

    def test_one_line_gives_the_count_and_the_first_place(self):
        self.write("a b.glsl", SCENE)
        done = self.succeed("capture", "a b.glsl", *SIZE, "--frames", "0-5", "--fps", "30", "-o", "f%d.png")
        said = [line for line in done.stderr.splitlines() if "finite" in line]
        self.assertEqual(said, ["warning: 1 pixel of frame 0 is not finite (and of 5 other frames); find the origin with: "
                                "tidemark check --trace 'a b.glsl' --frame 0 --size 16x4 --fps 30"])
        command = shlex.split(re.search("find the origin with: tidemark (.*)", done.stderr)[1])
        self.assertIn("a b.glsl:6", self.run_program(*command).stdout.decode())

    def test_finite_pictures_give_no_warning(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1e30, -1e30, p.x, 0.2); }")
        done = self.succeed("capture", "a.glsl", *SIZE, "-o", "a.png")
        self.assertEqual(done.stderr, "wrote a.png\n")
        self.assertEqual(self.counts("a.glsl", *SIZE, "-o", "a.exr", "--depth", "float"), [0])

    def test_every_kind_of_file_counts_alike(self):
        self.write("a.glsl", SCENE)
        for options in ("-o f%d.png", "-o f%d.png --depth 16", "-o f%d.exr", "-o f%d.jpg", "-o f%d.png --tile 4",
                        "-o f%d.exr --tile 6", "-o f.gif --fps 50", "-o f%d.png --plain",
                        "-o f%d.png --precision double"):
            with self.subTest(options):
                self.assertEqual(self.counts("a.glsl", *SIZE, "--frames", "0-3", *options.split()), [1, 1, 33, 33])
        raw = self.succeed("capture", "a.glsl", *SIZE, "--frames", "1-2", "-o", "-")
        self.assertIn("1 pixel of frame 1 is not finite (and of 1 other frame)", raw.stderr)

    def test_a_text_with_a_main_of_its_own(self):
        self.write("a.glsl", "#version 300 es\nprecision highp float;\nuniform float iTime;\nout vec4 colour;\n"
                             "void main() { colour = vec4(gl_FragCoord.x < 3.0 ? sqrt(-1.0 - iTime) : 0.5); }\n")
        self.assertEqual(self.counts("a.glsl", *SIZE, "-o", "a.png"), [12])

    def test_marks_are_not_in_the_saved_picture(self):
        """Alpha is 1 in the file and in the digest, and in what a pass reads of Image."""
        self.write("a.glsl", SCENE)
        self.succeed("capture", "a.glsl", *SIZE, "--frame", "2", "-o", "a.tif")
        self.succeed("capture", "a.glsl", *SIZE, "--frame", "2", "-o", "a.png")
        self.assertEqual(png.read(self.folder / "a.png").pixel(12, 0)[:3], (64, 64, 64))
        self.succeed("capture", "a.glsl", *SIZE, "--frame", "2", "--tile", "4", "-o", "b.png")
        self.succeed("compare", "a.png", "b.png", "--max-difference", "0")
        digests = [json.loads(self.succeed("capture", "a.glsl", *SIZE, "--frame", "2", "-o", "c.png", "--json",
                                           *more).stdout)["frames"][0]["sha256"] for more in ([], ["--tile", "4"])]
        self.assertEqual(digests[0], digests[1])

    def test_a_buffer_that_is_shown_keeps_its_alpha(self):
        self.write("b.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5, 0.5, 0.5, 0.2); "
                             "if (p.x < 2.0) c.a = log(-1.0 - iTime); }")
        self.write("a.glsl", '#iChannel0 "b.glsl"\nvoid mainImage(out vec4 c, in vec2 p) '
                             "{ c = texelFetch(iChannel0, ivec2(p), 0); }")
        buffer = ["a.glsl", *SIZE, "--pass", "b.glsl"]
        self.assertEqual(self.counts(*buffer, "-o", "a.png"), [8])
        self.assertEqual(self.counts(*buffer, "-o", "a.exr"), [8])
        self.assertEqual(self.counts("a.glsl", *SIZE, "-o", "a.png"), [0])


if __name__ == "__main__":
    main()
