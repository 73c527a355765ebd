"""A picture that is not made of numbers, in a window."""
import re
import shlex

from support import png
from support.live import LiveTest, main

SIZE = ("--size", "64x36")
# Draws the columns left of pixel 8, from the second COUNT on.
SCENE = """#iUniform float level = 0.5
void mainImage(out vec4 c, in vec2 p) {
    c = vec4(level + 0.1 * sin(iTime));
    if (p.x < 8.0 && iTime > 0.0)
        c.g = sqrt(-level - iTime);
}
"""
GOOD = SCENE.replace("sqrt(-level - iTime)", "sqrt(level + iTime)")
WORDS = r"^warning: 288 pixels at \d+\.\d{3} s are not finite; find the origin with: (tidemark check --trace .*)$"


class NotFinite(LiveTest):
    def test_one_warning_per_text_with_the_command_to_trace(self):
        self.write("a b.glsl", SCENE)
        view = self.view("a b.glsl", *SIZE, "--set", "level=0.25")
        words = view.wait_for_words(WORDS)
        view.wait_for_title(r"\Aa b - tidemark - \d+ fps, 288 pixels not finite\Z")
        command = shlex.split(words[1])
        self.assertEqual(command[3:4], ["a b.glsl"])
        self.assertIn("--set level=0.25", " ".join(command[4:]))
        traced = self.run_program(*command[1:])
        self.assertEqual(traced.returncode, 1)
        self.assertIn("a b.glsl:5:15: `c.g = sqrt(-level - iTime)` gave NaN", traced.stdout.decode())
        self.write("a b.glsl", GOOD)
        view.wait_for_title(r"\Aa b - tidemark - \d+ fps\Z")
        self.write("a b.glsl", SCENE)
        view.wait_for_words(f"(?:{WORDS}(.|\n)*){{2}}")
        self.assertEqual(len(re.findall(WORDS, view.stderr(), re.MULTILINE)), 2)

    def test_still_pictures_and_mouse_dependent_pixels_are_counted(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); if (iMouse.x > 30.0 && p.x < 1.0) "
                             "c.r = log(-iMouse.x); }\n")
        view = self.view("a.glsl", *SIZE)
        self.assertNotIn("finite", view.stderr())
        view.drag((10, 10), (40, 20))
        words = view.wait_for_words(r"warning: 36 pixels .* find the origin with: tidemark (check .*)")
        view.wait_for_title(r"\Aa - tidemark - still, 36 pixels not finite\Z")
        self.assertIn("--mouse 40,16,10,26", words[1])
        self.assertEqual(self.run_program(*shlex.split(words[1])).returncode, 1)

    def test_marks_are_not_saved(self):
        self.write("a.glsl", SCENE)
        view = self.view("a.glsl", *SIZE)
        view.wait_for_words(WORDS)
        view.pause()
        saved = png.read(view.save())
        self.assertEqual(saved.channels, 3)

    def test_pixels_of_a_shown_buffer_are_counted(self):
        self.write("b.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5, 0.5, 0.5, p.x < 2.0 ? log(-1.0 - iTime) "
                             ": 0.2); }")
        self.write("a.glsl", '#iChannel0 "b.glsl"\nvoid mainImage(out vec4 c, in vec2 p) '
                             "{ c = texelFetch(iChannel0, ivec2(p), 0); }")
        view = self.view("a.glsl", *SIZE, "--pass", "b.glsl")
        view.wait_for_words(r"^warning: 72 pixels at .* --pass b\.glsl$")

    def test_finite_pictures_give_no_warning(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1e30, -1e30, p.x, 0.2); }")
        view = self.view("a.glsl", *SIZE)
        view.key("h")
        view.wait_for_words("full screen")
        self.write("a.glsl", GOOD)
        view.wait_for_title(r" fps\Z")
        self.assertNotIn("finite", view.stderr())


if __name__ == "__main__":
    main()
