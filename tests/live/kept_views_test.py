"""Kept views: a moment is kept by a key or the panel, and a click goes back to it."""
from support import probe
from support.live import main
from support.overlay import PAUSE, OverlayTest

COUNT = '#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0) + 1.0; }\n'
KNOB = "#iUniform float height = 0.5 in { 0.0, 2.0 } step 0.1"
VALUES = {"height": "height", "turns": "float(TURNS)", "mouse": "iMouse.x", "time": "iTime",
          "count": "texelFetch(iChannel0, ivec2(0), 0).r"}
SCENE = probe.shader(VALUES, f'#iChannel0 "count.glsl"\n{KNOB}\n#define TURNS 3')
# Rows of the panel: the buttons, the knob, the headers, and below the last one the button and the views.
HEIGHT, DEFINITIONS, _PICTURES, VIEWS, KEEP, FIRST, SECOND = range(1, 8)


class KeptViews(OverlayTest):
    def test_a_click_goes_back(self):
        self.write("count.glsl", COUNT)
        view = self.open_controls(SCENE)
        view.click_bar(PAUSE)
        view.wait_for_title(" - paused at ")
        view.drag(view.at(400, 150), view.at(420, 170))
        view.drag_row(HEIGHT, 0.3, 0.9)
        view.type_time("2")
        view.wait_until_told(VALUES, lambda told: told["height"] == 2 and told["time"] == 2)
        view.key("k")
        view.wait_for_words(r"^kept: 2\.000 s, height = 2$")
        view.drag(view.at(400, 150), view.at(450, 170))
        view.drag_row(HEIGHT, 0.3, 0.01)
        view.type_time("4")
        view.wait_until_told(VALUES, lambda told: told["height"] == 0 and told["time"] == 4)
        view.click_row(VIEWS, 0.5)
        view.click_row(KEEP, 0.2)
        view.wait_for_words(r"^kept: 4\.000 s, height = 0$")
        view.click_row(FIRST, 0.2)
        told = view.wait_until_told(VALUES, lambda told: told["height"] == 2 and told["time"] == 2)
        self.assertEqual((told["mouse"], told["count"]), (420, 121))
        view.click_row(SECOND, 0.2)
        told = view.wait_until_told(VALUES, lambda told: told["height"] == 0 and told["time"] == 4)
        self.assertEqual((told["mouse"], told["count"]), (450, 241))

    def test_definitions_are_compiled_first(self):
        self.write("count.glsl", COUNT)
        view = self.open_controls(SCENE, "--define", "TURNS=5")
        view.click_bar(PAUSE)
        view.type_time("2")
        view.wait_until_told(VALUES, lambda told: told["time"] == 2 and told["turns"] == 5)
        view.key("k")
        view.wait_for_words(r"^kept: 2\.000 s$")
        view.type_time("4")
        view.wait_until_told(VALUES, lambda told: told["time"] == 4)
        view.click_row(DEFINITIONS, 0.5)
        view.click_row(DEFINITIONS + 1, 0.85)  # reset
        view.wait_until_told(VALUES, lambda told: told["turns"] == 3)
        view.click_row(DEFINITIONS, 0.5)
        view.click_row(VIEWS, 0.5)
        view.click_row(FIRST, 0.2)
        told = view.wait_until_told(VALUES, lambda told: told["turns"] == 5 and told["time"] == 2)
        self.assertEqual(told["count"], 121)

    def test_a_view_is_forgotten(self):
        self.write("count.glsl", COUNT)
        view = self.open_controls(SCENE)
        view.click_bar(PAUSE)
        for seconds in ("2", "4"):
            view.type_time(seconds)
            view.wait_until_told(VALUES, lambda told: told["time"] == float(seconds))
            view.key("k")
            view.wait_for_words(rf"^kept: {seconds}\.000 s$")
        view.click_row(VIEWS, 0.5)
        view.click_row(FIRST, 0.02)  # its x
        view.type_time("1")
        view.wait_until_told(VALUES, lambda told: told["time"] == 1)
        view.click_row(FIRST, 0.2)
        view.wait_until_told(VALUES, lambda told: told["time"] == 4)


if __name__ == "__main__":
    main()
