"""Esc, undo and redo, messages, a paused start, the range of the time bar."""
import time

from support import probe
from support.live import main, wait_for
from support.overlay import END, PAUSE, SPEED_BEGIN, OverlayTest

VALUES = {"level": "level", "tint": "tint.r", "steps": "float(STEPS)", "camera": "iCamera[3].x", "time": "iTime"}
SCENE = probe.shader(VALUES, "#iUniform float level = 0.5 in { 0.0, 1.0 }\n#iUniform color3 tint = color3(1.0, 0.5, 0.0)\n"
                             "#define STEPS 8\nuniform mat4 iCamera;")
BLACK = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.0, 0.0, 0.0, 1.0); }\n"
LEVEL, TINT, DEFINITIONS, STEPS = 1, 2, 3, 4


class Undo(OverlayTest):
    def test_changes_are_undone_and_done_again(self):
        view = self.open_controls(SCENE)
        first = view.told(VALUES)
        view.drag_row(LEVEL, 0.1, 0.4)
        turned = view.wait_until_told(VALUES, lambda told: told["level"] > 0.6)["level"]
        view.drag(view.at(450, 100), view.at(420, 120))
        moved = view.wait_until_told(VALUES, lambda told: told["camera"] != first["camera"])["camera"]
        view.click_row(DEFINITIONS, 0.3)
        view.drag_row(STEPS, 0.1, 0.3)
        steps = view.wait_until_told(VALUES, lambda told: told["steps"] > 8)["steps"]
        told = lambda wanted: view.wait_until_told(VALUES, lambda told: {**told, "time": 0} == {**wanted, "time": 0})
        with_all = {**first, "level": turned, "camera": moved, "steps": steps}
        for wanted in ({**with_all, "steps": 8}, {**with_all, "steps": 8, "camera": first["camera"]}, first):
            view.key("ctrl+z")
            told(wanted)
        for _ in range(4):  # the last one has nothing to do
            view.key("ctrl+y")
        told(with_all)

    def test_a_kept_view_comes_back(self):
        self.write("a.glsl", SCENE)
        view = self.open("a.glsl", XDG_STATE_HOME=str(self.folder / "state"))
        view.key("k")
        view.wait_for_words("^kept: ")
        view.key("ctrl+z")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        self.assertNotIn("1 view", self.restored())

    def restored(self) -> str:
        view = self.open("a.glsl", XDG_STATE_HOME=str(self.folder / "state"))
        return view.wait_for_words("^restored: .*$")[0]


class Escape(OverlayTest):
    def test_closes_the_innermost_thing_first(self):
        self.write("a.glsl", SCENE)
        view = self.open("a.glsl", "--size", "640x360", "--paused", first_title=" - paused at ")
        view.point(600, 10)
        plain = view.picture()
        for keys in (("h",), ("Tab",), ("Tab", "h")):
            with self.subTest(keys=keys):
                for key in keys:
                    before = view.picture()
                    view.key(key)
                    view.wait_for_change(before)
                view.screen.xdotool("key", *["Escape"] * len(keys), "Escape")
                wait_for(lambda: view.running() and view.picture() == plain, "the picture alone")
        view.show_controls()
        before = view.picture()
        view.click_row(TINT, 0.57)  # opens the colour picker
        view.wait_for_change(before)
        view.screen.xdotool("key", "Escape", "Escape", "Escape")  # the picker, the controls, and one that asks
        view.point(600, 10)
        wait_for(lambda: view.running() and view.picture() == plain, "the picture alone")
        view.key("f")
        wait_for(lambda: view.place()["WIDTH"] == 1280, "full screen")
        view.screen.xdotool("key", "Escape", "Escape")
        wait_for(lambda: view.running() and view.place()["WIDTH"] == 640, "the window")
        view.screen.xdotool("key", "Escape", "Escape")
        self.assertEqual(view.wait_for_end(), 0)

    def test_two_presses_far_apart_do_not_close_the_window(self):
        self.write("a.glsl", BLACK)
        view = self.open("a.glsl", "--size", "300x100")
        for _ in range(2):
            view.key("Escape")
            time.sleep(1.1)
        self.assertTrue(view.running())
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)


class Messages(OverlayTest):
    def test_they_come_and_fade(self):
        self.write("a.glsl", BLACK)
        view = self.open("a.glsl", "--size", "400x200", TIDEMARK_MESSAGES="on")
        black = lambda: not any(any(row) for row in view.picture())
        wait_for(lambda: not black(), "the keys over the first picture")
        wait_for(black, "their end")
        for key in ("s", "c", "k", "n", "n", "z", "z", "i", "v", "ctrl+z", "Escape"):
            with self.subTest(key=key):
                view.key(key)
                wait_for(lambda: view.running() and not black(), "a message")
                if key in ("s", "Escape"):
                    wait_for(black, "its end")


class Pause(OverlayTest):
    def test_opens_paused_by_option_and_as_it_was_left(self):
        self.write("a.glsl", SCENE)
        state = {"XDG_STATE_HOME": str(self.folder / "state")}
        for options, opens_paused, key in ((["--paused"], True, None), ([], True, "space"), ([], False, None)):
            with self.subTest(options=options):
                title = " - paused at " if opens_paused else " fps$"
                view = self.open("a.glsl", *options, first_title=title, **state)
                if key:
                    view.key(key)
                    view.wait_for_title(" fps$")
                view.quit()
                self.assertEqual(view.wait_for_end(), 0)

    def test_a_key_returns_speed_to_1(self):
        view = self.open_controls(SCENE)
        view.drag_bar(150, SPEED_BEGIN)  # backwards
        view.wait_until_told(VALUES, lambda told: told["time"] == 0)
        view.key("v")
        view.wait_until_told(VALUES, lambda told: told["time"] > 0.2)


class Bar(OverlayTest):
    def test_a_drag_keeps_the_range(self):
        view = self.open_controls(SCENE, size="800x450")
        view.click_bar(PAUSE)
        view.type_time("200")  # the bar ends at 320 s
        view.wait_until_told(VALUES, lambda told: told["time"] == 200)
        view.click_bar(view.scrubber(0.45))
        view.wait_until_told(VALUES, lambda told: 135 < told["time"] < 155)
        view.drag_bar(view.scrubber(0.45), view.scrubber(0.4))
        view.wait_until_told(VALUES, lambda told: 120 < told["time"] < 135)
        view.click_bar(view.scrubber(1) + END - 20)  # the button doubles the range
        view.click_bar(view.scrubber(0.75))
        view.wait_until_told(VALUES, lambda told: 460 < told["time"] < 500)


if __name__ == "__main__":
    main()
