"""Scenes that are not there yet or that do not compile: the window opens, says so and waits."""
import json
import shutil

from support import probe
from support.live import LiveTest, View, main
from support.program import environment

SIZE = ("--size", "200x100")
MARK = {"mark": "MARK"}
BROKEN = "#define MARK 1.0\n\nvoid mainImage(out vec4 c, in vec2 p) {\n    c = nothing;\n}\n"


def marked(mark: int, include: str = "") -> str:
    return probe.shader(MARK, f"#define MARK {mark}.0\n{include}")


class Wait(LiveTest):
    def wait(self, scene: str, title: str, *options: str) -> View:
        view = View(self.screen, self.folder, scene, *SIZE, *options, first_title=title)
        self.addCleanup(view.close)
        return view

    def expect_mark(self, view: View, mark: float) -> None:
        view.wait_for_title(r" (fps|still)\Z")  # before, there is no picture to save
        view.wait_until_told(MARK, lambda told: told["mark"] == mark)

    def test_a_file_that_does_not_compile(self):
        self.write("a.glsl", BROKEN)
        view = self.wait("a.glsl", r"\Awaiting: a\.glsl:4(:9)?: error: .")
        view.wait_for_words(r"^tidemark: error: 'a\.glsl' does not compile\na\.glsl:4(:9)?: error: .*\n"
                            r"(a\.glsl:.*\n)*waiting for a\.glsl: loads once the error is fixed and saved$")
        self.write("a.glsl", "\n" + BROKEN)
        view.wait_for_title(r"\Awaiting: a\.glsl:5(:9)?: error: ")
        self.write("a.glsl", marked(2))
        self.expect_mark(view, 2)
        view.wait_for_words(r"^a\.glsl: compiles$")
        view.wait_for_title(r"\Aa - tidemark - (\d+ fps|still)\Z")
        self.assertEqual(view.stderr().count("waiting for"), 1)

    def test_a_text_that_does_not_load(self):
        self.write("a.glsl", "#iUniform flaot x = 1.0\n")
        view = self.wait("a.glsl", r"\Awaiting: a\.glsl:1(:\d+)?: error: expected a type")
        self.write("a.glsl", marked(2))
        self.expect_mark(view, 2)

    def test_a_missing_file(self):
        view = self.wait("a.glsl", r"\Awaiting: cannot read 'a\.glsl': no such file\Z")
        self.write("a.glsl", marked(1))
        self.expect_mark(view, 1)
        self.write("a.glsl", marked(2))
        self.expect_mark(view, 2)

    def test_a_file_in_a_missing_folder(self):
        view = self.wait("x/y/a.glsl", r"\Awaiting: cannot read 'x/y/a\.glsl': no such file\Z")
        self.write("x/y/a.glsl", marked(1))
        self.expect_mark(view, 1)

    def test_a_missing_include_and_a_missing_picture(self):
        self.write("a.glsl", probe.shader(MARK, '#include "lib/mark.glsl"'))
        view = self.wait("a.glsl", r"\Awaiting: a\.glsl:1(:\d+)?: error: cannot read 'lib/mark\.glsl': no such file\Z")
        self.write("lib/mark.glsl", "#define MARK x\n")
        view.wait_for_title(r"\Awaiting: (a|lib/mark)\.glsl:\d+(:\d+)?: error: `x' undeclared\Z")
        self.write("lib/mark.glsl", "#define MARK 3.0\n")
        self.expect_mark(view, 3)

    def test_a_missing_empty_or_broken_folder(self):
        view = self.wait("s", r"\Awaiting: cannot read 's': no such file\Z")
        (self.folder / "s").mkdir()
        view.wait_for_title(r"\Awaiting: 's' has no image\.glsl")
        self.write("s/common.glsl", "#iUniform flaot x = 1.0\n")
        self.write("s/image.glsl", marked(1))
        view.wait_for_title(r"\Awaiting: s/common\.glsl:1(:\d+)?: error: expected a type")
        self.write("s/common.glsl", "float one() { return one; }\n")
        view.wait_for_title(r"\Awaiting: s/common\.glsl:1(:\d+)?: error: ")
        self.write("s/common.glsl", "")
        self.expect_mark(view, 1)
        shutil.rmtree(self.folder / "s")
        view.wait_for_title("s' has no image|cannot read 's")
        self.write("s/image.glsl", marked(2))
        self.expect_mark(view, 2)

    def test_a_missing_or_broken_project(self):
        view = self.wait("p.json", r"\Awaiting: cannot read 'p\.json': no such file\Z")
        self.write("p.json", "{")
        view.wait_for_title(r"\Awaiting: p\.json:")
        self.write("p.json", json.dumps({"info": {"id": "x", "name": "x"}, "renderpass": [
            {"type": "image", "name": "Image", "inputs": [], "outputs": [{"id": 37, "channel": 0}],
             "code": marked(1)}]}))
        self.expect_mark(view, 1)

    def test_a_save_during_the_start_is_loaded(self):
        for mark in (1, 2, 3):
            with self.subTest(mark):
                (self.folder / "a.glsl").unlink(missing_ok=True)
                view = View(self.screen, self.folder, "a.glsl", *SIZE, first_title=None)
                self.addCleanup(view.close)
                self.write("a.glsl", marked(mark))
                view.wait_for_window(r" (fps|still)$")
                self.expect_mark(view, mark)
                view.close()

    def test_a_waiting_window_can_be_closed(self):
        view = self.wait("a.glsl", r"\Awaiting: ")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)

    def test_invalid_options_end_the_command(self):
        self.write("a.glsl", marked(1))
        for options, words in ((["--set", "x=1"], "the scene has no knob 'x': it declares none with #iUniform"),
                               (["--define", "X=1"], "the scene has no #define or const 'X'"),
                               (["--pass", "Buffer A"], "--pass Buffer A: no such pass; the scene has Image")):
            with self.subTest(options):
                done = self.run_program("view", "a.glsl", *SIZE, *options, env=environment(DISPLAY=self.screen.display))
                self.assertIn(words, done.stderr)
                self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    main()
