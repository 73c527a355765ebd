"""Esc, undo and redo, messages, a paused start, the range of the time bar."""
import json
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
    def test_changes_are_undone_and_redone(self):
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

    def test_undo_removes_a_kept_view(self):
        self.write("a.glsl", SCENE)
        view = self.open("a.glsl", XDG_STATE_HOME=str(self.folder / "state"))
        view.key("k")
        view.wait_for_words("^kept view 1: ")
        presets = self.folder / "a.presets.json"
        kept = lambda: json.loads(presets.read_text())["presets"] if presets.exists() else []
        wait_for(kept, "the view in its file")
        view.key("ctrl+z")
        wait_for(lambda: not kept(), "the file without it")


class Escape(OverlayTest):
    def test_closes_the_topmost_panel_first(self):
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
    def test_messages_appear_and_fade(self):
        self.write("a.glsl", BLACK)
        view = self.open("a.glsl", "--size", "400x200", TIDEMARK_MESSAGES="on")
        black = lambda: not any(any(row) for row in view.picture())
        wait_for(lambda: not black(), "the keys over the first picture")
        wait_for(black, "their end")
        for key in ("s", "c", "k", "n", "n", "z", "z", "v", "minus", "equal", "a", "a", "ctrl+z", "Escape"):
            with self.subTest(key=key):
                view.key(key)
                wait_for(lambda: view.running() and not black(), "a message")
                if key in ("s", "Escape"):
                    wait_for(black, "its end")

    def test_buttons_of_the_controls_answer(self):
        self.write("a.glsl", "#iUniform float level = 0.0 in { 0.0, 1.0 }\n" + BLACK.replace("0.0, 0.0, 1.0", "0.0, level, 1.0"))
        view = self.open("a.glsl", "--size", "640x360", "--paused", first_title=" - paused at ", TIDEMARK_MESSAGES="on")
        view.show_controls()
        black = lambda: not any(any(row[3 * 400:]) for row in view.picture()[:100])
        for share, words in ((0.4, "^nothing to copy: "), (0.85, "^nothing to write: ")):
            wait_for(black, "the picture without messages")
            view.click_row(0, share)
            view.wait_for_words(words)
            wait_for(lambda: view.running() and not black(), "the message in the window")


class Pause(OverlayTest):
    def test_opens_paused_by_option_and_by_the_stored_state(self):
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
        # The button doubles the range for a click within the same frame, too.
        clicks = [("mousemove", "--window", str(view.window), str(round(x)), str(round(view.bar_y())), "click", "1")
                  for x in (view.scrubber(1) + END - 20, view.scrubber(0.75))]
        view.screen.xdotool(*clicks[0], *clicks[1])
        view.wait_until_told(VALUES, lambda told: 460 < told["time"] < 500)


if __name__ == "__main__":
    main()
