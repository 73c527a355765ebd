"""Errors in the window itself: there as long as something is wrong, with a way into the editor."""
from support.live import main, wait_for
from support.overlay import MARGIN, OverlayTest, OverlayView

GOOD = "void mainImage(out vec4 color, in vec2 at) { color = vec4(0.0, 0.25, 0.5, 1.0); }\n"
BAD = "void mainImage(out vec4 color, in vec2 at) {\n    color = vec4(0.0, missing, 0.5, 1.0);\n}\n"
SIZES = (("640x360", 1), ("900x600", 1), ("500x300", 2), ("400x250", 2))

# The panel's message is in this colour, of which anti-aliased text has some whole pixels.
RED = bytes((255, 115, 102))
LARGE_ROW = 26


def has_errors(view: OverlayView) -> bool:
    return any(RED in row for row in view.picture())


class Errors(OverlayTest):
    def open_bad(self, size: str = "640x360", scale: int = 1, **variables: str) -> OverlayView:
        self.write("a.glsl", BAD)
        view = self.open("a.glsl", "--size", size, scale=scale, first_title="missing", **variables)
        wait_for(lambda: has_errors(view), "the panel of errors")
        return view

    def test_the_panel_is_shown_while_there_is_an_error(self):
        for size, scale in SIZES:
            with self.subTest(size=size, scale=scale):
                view = self.open_bad(size, scale)
                self.write("a.glsl", GOOD)
                view.wait_for_words("^a.glsl: compiles$")
                wait_for(lambda: len(set(view.picture())) == 1, "a picture with nothing over it")
                self.write("a.glsl", BAD)
                wait_for(lambda: has_errors(view), "the panel over the last good picture")
                view.close()

    def test_a_missing_file(self):
        view = self.open("later.glsl", "--size", "640x360", first_title="waiting: ")
        wait_for(lambda: has_errors(view), "the panel of errors")
        self.write("later.glsl", GOOD)
        wait_for(lambda: not has_errors(view), "the picture")

    def test_the_panel_is_shown_in_full_screen(self):
        view = self.open_bad()
        view.key("f")
        wait_for(lambda: view.place()["WIDTH"] == 1280, "the full screen")
        wait_for(lambda: has_errors(view), "the panel of errors")

    def test_texts_of_any_length_are_shown(self):
        """Dear ImGui ends the program at 16,384 characters in one call."""
        view = self.open_bad()
        name = "n" * 20000
        for text in (BAD.replace("missing", name), f"#error {name}\n{GOOD}", GOOD + f"#iUniform float {name} = 1.0 in {{ 0.0, 2.0 }}\n"):
            self.write("a.glsl", text)
            view.key("Tab")
            wait_for(lambda: name[:100] in view.title() or text.startswith(GOOD), "the long word in the title")
            self.write("a.glsl", BAD)
            view.wait_for_title("missing")

    def click_the_place(self, view: OverlayView) -> None:
        """It stands under the first error's large letters."""
        rows = [y for y, row in enumerate(view.picture()) if RED in row]
        view.click(MARGIN + 20, min(rows) + LARGE_ROW)

    def test_a_click_opens_the_editor(self):
        script = self.write("edit.sh", "#!/bin/sh\necho \"$@\" > edited.txt\n")
        script.chmod(0o755)
        view = self.open_bad(VISUAL=f"{script} --wait", EDITOR="no-such-editor")
        self.click_the_place(view)
        edited = self.folder / "edited.txt"
        wait_for(lambda: edited.exists() and edited.read_text(), "the editor")
        self.assertEqual(edited.read_text(), "--wait +2 a.glsl\n")

    def test_an_editor_that_does_not_start_is_reported(self):
        view = self.open_bad(VISUAL="", EDITOR="no-such-editor")
        self.click_the_place(view)
        view.wait_for_words("^tidemark: error: cannot start the editor 'no-such-editor': No such file or directory$")
        view.close()
        view = self.open_bad(VISUAL="", EDITOR="")
        self.click_the_place(view)
        view.wait_for_words("^tidemark: error: no editor to open: set VISUAL or EDITOR, as in VISUAL='code --wait'$")


if __name__ == "__main__":
    main()
