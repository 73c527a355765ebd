"""A scene that the driver compiles for long does not stop the window."""
import random
import time

from support import probe
from support.live import LiveTest, View, main

SIZE = ("--size", "200x100")
VALUES = {"mark": "MARK", "iFrame": "float(iFrame)"}


def marked(mark: int) -> str:
    return probe.shader(VALUES, f"#define MARK {mark}.0\n")


def heavy(mark: int) -> str:
    """Some seconds of the driver's time, whatever it compiled before: its caches have never seen these numbers."""
    lines = "".join(f"    s = fract(sin(s * {random.random() + i}) * 4371.0) + cos(s * {i}.7) * "
                    f"(s > {random.random()} ? s : {i}.5 - s);\n" for i in range(450))
    return probe.shader({"mark": "heavy(MARK)", "iFrame": "float(iFrame)"},
                        f"#define MARK {mark}.0\nfloat heavy(float x) {{\n    float s = iTime;\n{lines}"
                        "    return s > 1e30 ? s : x;\n}\n")


class Compile(LiveTest):
    def start(self) -> View:
        self.write("a.glsl", marked(1))
        view = self.view("a.glsl", *SIZE)
        view.wait_until_told(VALUES, lambda told: told["mark"] == 1)
        return view

    def test_compiles_on_the_thread_of_the_window(self):
        self.write("a.glsl", marked(1))
        view = self.view("a.glsl", *SIZE, TIDEMARK_ASYNC_COMPILE="off")
        view.wait_until_told(VALUES, lambda told: told["mark"] == 1)
        for mark in (2, 3):
            self.write("a.glsl", marked(mark))
            view.wait_until_told(VALUES, lambda told: told["mark"] == mark)
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)

    def begin_to_compile(self, view: View, mark: int) -> None:
        self.write("a.glsl", heavy(mark))
        view.wait_for_title(r"\Aa - tidemark - compiling… \d+ s, Esc cancels\Z")

    def test_the_last_good_picture_moves_until_the_new_program_is_ready(self):
        view = self.start()
        self.begin_to_compile(view, 2)
        first = view.told(VALUES)
        second = view.told(VALUES)
        self.assertEqual((first["mark"], second["mark"]), (1, 1))
        self.assertGreater(second["iFrame"], first["iFrame"])
        self.assertRegex(view.title(), "compiling…")  # else the machine was too fast to tell
        view.wait_until_told(VALUES, lambda told: told["mark"] == 2)
        view.wait_for_title(r" fps\Z")

    def test_escape_cancels_compiling(self):
        view = self.start()
        self.begin_to_compile(view, 2)
        view.key("Escape")
        view.wait_for_title(r" fps\Z")
        self.write("a.glsl", marked(3))
        view.wait_until_told(VALUES, lambda told: told["mark"] == 3)
        view.quit()  # the driver may still be at it
        self.assertEqual(view.wait_for_end(), 0)

    def test_a_new_save_replaces_the_running_compilation(self):
        view = self.start()
        for mark in (2, 3, 4, 5):  # more than are compiled at once
            self.begin_to_compile(view, mark)
            self.write("a.glsl", "float x;\n")  # and what is being saved may be broken
            view.wait_for_title("has no mainImage")
        self.write("a.glsl", marked(6))
        view.wait_until_told(VALUES, lambda told: told["mark"] == 6)
        view.wait_for_words(r"^a\.glsl: compiles again$")

    def test_the_window_can_be_closed_before_the_first_picture(self):
        self.write("a.glsl", heavy(1))
        view = View(self.screen, self.folder, "a.glsl", *SIZE, first_title="compiling… ")
        self.addCleanup(view.close)
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)


if __name__ == "__main__":
    main()
