"""Knobs in the window's overlay: turned, reset, copied, written into the file, recorded and replayed."""
import re

from support import png, probe
from support.live import main, wait_for
from support.overlay import OverlayTest
from support.program import not_sanitized

KNOBS = ["#iUniform float height = 0.5 in { 0.0, 2.0 } step 0.1",
         "#iUniform color3 deep = color3(0.25, 0.5, 1.0)",
         "#iUniform vec2 shift = vec2(0.25, 0.5) in { 0.0, 1.0 }",
         "#iUniform int on = 1 in { 0, 1 }",
         "#iUniform float free = 12.0"]
HEIGHT, DEEP, SHIFT, ON, FREE = range(1, 6)
VALUES = {"height": "height", "red": "deep.r", "shift.x": "shift.x", "shift.y": "shift.y", "on": "float(on)",
          "free": "free", "mouse": "iMouse.x", "frame": "float(iFrame)"}
SCENE = probe.shader(VALUES, "\n".join(KNOBS))
SIZES = (("640x360", 1), ("900x600", 1), ("500x300", 2), ("400x250", 2))


class Knobs(OverlayTest):
    def test_a_slider_keeps_its_range_and_step(self):
        for size, scale in SIZES:
            with self.subTest(size=size, scale=scale):
                view = self.open_controls(SCENE, size=size, scale=scale)
                view.drag_row(HEIGHT, 0.1, 0.3)
                told = view.wait_until_told(VALUES, lambda told: told["height"] != 0.5)
                self.assertAlmostEqual(told["height"], round(told["height"], 1), 6)
                self.assertEqual(told["mouse"], 0)
                view.drag_row(HEIGHT, 0.3, 0.9)
                view.wait_until_told(VALUES, lambda told: told["height"] == 2)
                view.close()

    def test_each_type_of_knob_has_a_widget(self):
        view = self.open_controls(SCENE)
        view.click_row(ON, 0.03)
        view.wait_until_told(VALUES, lambda told: told["on"] == 0)
        view.drag_row(SHIFT, 0.1, 0.2)
        view.wait_until_told(VALUES, lambda told: told["shift.x"] > 0.25 and told["shift.y"] == 0.5)
        view.drag_row(FREE, 0.2, 0.4)
        view.wait_until_told(VALUES, lambda told: told["free"] > 12)
        view.drag_row(DEEP, 0.05, 0.15)
        view.wait_until_told(VALUES, lambda told: told["red"] > 0.25)

    def test_events_outside_of_panels_reach_the_scene(self):
        view = self.open_controls(SCENE)
        view.drag((500, 300), (450, 280))
        view.wait_until_told(VALUES, lambda told: told["mouse"] == 450)

    def test_a_number_is_typed(self):
        view = self.open_controls(SCENE)
        self.screen.xdotool("keydown", "ctrl")
        view.click_row(HEIGHT, 0.3)
        self.screen.xdotool("keyup", "ctrl")
        self.screen.xdotool("type", "3.5")
        view.key("space") # the field's, no pause
        view.key("Return")
        view.wait_until_told(VALUES, lambda told: told["height"] == 3.5)
        self.assertNotIn("paused", view.title())

    @not_sanitized  # whose first frame is slow, and a slow frame's clock needs it
    def test_the_overlay_is_loaded_when_first_shown(self):
        self.write("a.glsl", KNOBS[0] + "\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(height); }\n")
        view = self.open("a.glsl", "--size", "640x360")
        self.assertNotRegex(view.loaded(), "tidemark_overlay|imgui")
        plain = view.picture()
        view.key("Tab")
        wait_for(lambda: "tidemark_overlay" in view.loaded(), "the plug-in")
        view.wait_for_change(plain)
        view.key("Tab")
        wait_for(lambda: view.picture() == plain, "the picture without the panel")

    def test_reset_copy_and_write(self):
        view = self.open_controls(SCENE)
        view.drag_row(HEIGHT, 0.3, 0.9)
        view.click_row(ON, 0.03)
        view.wait_until_told(VALUES, lambda told: told["height"] == 2 and told["on"] == 0)
        view.click_row(0, 0.4)
        view.wait_for_words(r"^copied: --set height=2 --set on=0$")
        view.click_row(HEIGHT, 0.85)  # its own reset
        view.wait_until_told(VALUES, lambda told: told["height"] == 0.5 and told["on"] == 0)
        view.click_row(0, 0.85)
        view.wait_for_words(r"^a\.glsl: on = 0$")
        self.assertEqual((self.folder / "a.glsl").read_text(), SCENE.replace("int on = 1", "int on = 0"))
        view.wait_for_words("^reloaded in ")
        self.assertEqual(view.told(VALUES)["on"], 0)
        view.drag_row(HEIGHT, 0.3, 0.9)
        view.wait_until_told(VALUES, lambda told: told["height"] == 2)  # the button that resets all is off until then
        view.click_row(0, 0.1)
        view.wait_until_told(VALUES, lambda told: told["height"] == 0.5)

    def test_an_edited_default_changes_knobs_that_were_not_set(self):
        view = self.open_controls(SCENE, "--set", "free=3")
        view.drag_row(HEIGHT, 0.3, 0.9)
        view.wait_until_told(VALUES, lambda told: told["height"] == 2 and told["free"] == 3)
        self.write("a.glsl", SCENE.replace("height = 0.5", "height = 0.7").replace("free = 12.0", "free = 13.0"))
        view.wait_until_told(VALUES, lambda told: told["free"] == 13 and told["height"] == 2)
        view.wait_for_words(r"^height stays 2, as you set it; the file's default is now 0\.7$")
        view.wait_for_words(r"^free is now 13, from the file; --set free=3 no longer applies$")

    def test_a_thousand_moves_are_replayed_to_the_same_bytes(self):
        view = self.open_controls(SCENE, "--record", "take.txt", "--fps", "30")
        view.point(*view.at(40, 66))
        view.button(1, True)
        moves = [f"mousemove --window {view.window} {20 + (7 * i) % 180} 66" for i in range(1000)]
        self.screen.xdotool(*" ".join(moves).split())
        view.button(1, False)
        view.drag_row(DEEP, 0.05, 0.15)
        view.click_row(SHIFT, 0.1)
        picture = view.save()
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        script = (self.folder / "take.txt").read_text()
        self.assertGreater(len(re.findall(r"^\d+ set height=", script, re.MULTILINE)), 100)
        frame = str(int(picture.stem.split("-")[1]))
        done = self.succeed("capture", "a.glsl", "--size", "640x360", "--fps", "30", "--input", "take.txt",
                            "--frame", frame, "-o", "-")
        replayed = png.from_raw(640, 360, done.stdout)
        self.assertEqual(probe.read(png.read(picture), VALUES), probe.read(replayed, VALUES))
        self.assertTrue(png.read(picture).rows == replayed.rows)


if __name__ == "__main__":
    main()
