"""`#iSize`: the size that a scene says it is seen in, for the commands that draw it; and who has no say in it."""
import json

from support import png
from support.program import ProgramTest, main

SHADER = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.0, 1.0); }\n"
SIZED = "#iSize 80x45\n" + SHADER


class Size(ProgramTest):
    def size_of(self, scene: str, *options: str) -> tuple[int, int]:
        self.succeed("capture", scene, "-o", "x.png", *options)
        picture = png.read(self.folder / "x.png")
        return picture.width, picture.height

    def test_capture_uses_the_stated_size_unless_size_is_given(self):
        self.write("a.glsl", SIZED)
        self.assertEqual(self.size_of("a.glsl"), (80, 45))
        self.assertEqual(self.size_of("a.glsl", "--size", "20x10"), (20, 10))
        self.write("a.glsl", SHADER)
        self.assertEqual(self.size_of("a.glsl"), (640, 360))

    def test_size_dependent_options_use_the_stated_size(self):
        self.write("a.glsl", SIZED)
        self.assertEqual(self.size_of("a.glsl", "--sheet", "2x2"), (168, 98))  # and the lines between them
        self.succeed("capture", "a.glsl", "-o", "b.png")
        self.write("a.glsl", SIZED.replace("80x45", "30x20"))
        self.assertEqual(self.size_of("a.glsl", "--like", "b.png"), (80, 45))
        self.expect_error(["trace", "a.glsl", "--pixel", "40,10"], 2, "--pixel 40,10", "30x20")

    def test_only_the_file_of_image_states_the_size(self):
        left_out = "warning: #iSize is ignored: it only has an effect in the file of Image"
        for name, text in {"s/common.glsl": "#iSize 1x1\n", "s/lib.glsl": "\n#iSize 2x2\n",
                           "s/buffer_a.glsl": "#iSize 3x3\n" + SHADER,
                           "s/image.glsl": '#include "lib.glsl"\n#iChannel0 "buffer_a.glsl"\n' + SIZED +
                                           "// iChannel0\n"}.items():
            self.write(name, text)
        done = self.succeed("capture", "s", "-o", "x.png")
        self.assertEqual(sorted(line for line in done.stderr.splitlines() if "iSize" in line),
                         [f"s/buffer_a.glsl:1: {left_out}", f"s/common.glsl:1: {left_out}", f"s/lib.glsl:2: {left_out}"])
        self.assertEqual(png.read(self.folder / "x.png").width, 80)
        self.assertEqual(self.size_of("s/buffer_a.glsl"), (3, 3))

    def test_a_second_size_is_an_error(self):
        self.write("a.glsl", SIZED + "#iSize 80x45\n")
        self.expect_failure(["capture", "a.glsl"], 3, "a.glsl:3: error: #iSize is given twice\n"
                                                      "a.glsl:1: note: first given here")

    def test_an_invalid_size_is_reported_at_its_place(self):
        self.write("a.glsl", "\n#iSize 80 x 45\n" + SHADER)
        words = ("a.glsl:2:8: error: '80' is not a size: give WIDTHxHEIGHT in pixels, each from 1 to 32767, as in "
                 "#iSize 800x450")
        self.expect_failure(["capture", "a.glsl"], 3, words)

    def test_a_stated_size_survives_export_and_import(self):
        self.write("a.glsl", SIZED)
        self.succeed("export", "a.glsl", "-o", "p.json")
        image = json.loads((self.folder / "p.json").read_text())["Shader"]["renderpass"][0]
        self.assertEqual((image["size"], image["code"]), ("80x45", "\n" + SHADER))
        self.assertEqual(self.size_of("p.json"), (80, 45))
        self.succeed("import", "p.json", "-o", "there")
        self.assertEqual(self.size_of("there"), (80, 45))
        back = self.succeed("export", "there").stdout
        self.assertEqual(json.loads(back), json.loads((self.folder / "p.json").read_text()))
        self.write("there/image.glsl", "#iSize 50x20\n" + SHADER)  # who edits it means it
        self.assertEqual(self.size_of("there"), (50, 20))
        self.write("p.json", (self.folder / "p.json").read_text().replace("80x45", "80"))
        self.expect_error(["capture", "p.json"], 3, "p.json: error:", "Image", "'80'")

    def test_inspect_and_a_page_use_the_stated_size(self):
        self.write("a.glsl", SIZED)
        self.assertEqual(json.loads(self.succeed("inspect", "a.glsl", "--json", "--device", "none").stdout)["size"], [80, 45])
        self.succeed("export", "a.glsl", "--html", "a.html")
        self.assertIn('"size":[80,45]', (self.folder / "a.html").read_text())


if __name__ == "__main__":
    main()
