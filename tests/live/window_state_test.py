"""What a window remembers of a scene: knobs, time, camera, size, place, panel and views; and what it must not change."""
import json
import pathlib

from support import png, probe
from support.live import main
from support.overlay import PAUSE, OverlayTest

KNOBS = "#iUniform float height = 0.5 in { 0.0, 2.0 } step 0.1\n#iUniform float width = 0.5 in { 0.0, 2.0 } step 0.1"
VALUES = {"height": "height", "width": "width", "camera": "iCamera[3].x", "time": "iTime", "mouse": "iMouse.x",
          "wide": "iResolution.x"}
SCENE = probe.shader(VALUES, KNOBS + "\nuniform mat4 iCamera;")
PAUSED = " - paused at "
PLAIN_CAMERA = 10 * 0.5 * 0.9396926  # at azimuth 30 and elevation 20


class WindowState(OverlayTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)
        self.state = self.folder / "state"

    def again(self, *options: str, **arguments):
        return self.open("a.glsl", *options, XDG_STATE_HOME=str(self.state), **arguments)

    def leave(self, view) -> None:
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)

    def leave_something(self, scale: int = 1) -> dict[str, float]:
        view = self.again("--fresh", "--size", "600x340", scale=scale)
        view.show_controls()
        view.click_bar(PAUSE)
        view.wait_for_title(" - paused at ")
        view.drag_row(1, 0.3, 0.9)
        view.drag(view.at(450, 150), view.at(420, 170))
        view.type_time("42")
        told = view.wait_until_told(VALUES, lambda told: told["time"] == 42 and told["height"] == 2)
        view.key("k")
        view.screen.xdotool("windowmove", "--sync", str(view.window), "30", "40")
        self.leave(view)
        return told

    def file(self) -> pathlib.Path:
        files = list((self.state / "tidemark").iterdir())
        self.assertEqual(len(files), 1)
        return files[0]

    def test_the_next_window_restores_the_last_state(self):
        for scale in (1, 2):
            with self.subTest(scale=scale):
                left = self.leave_something(scale)
                view = self.again(scale=scale, first_title=PAUSED)
                view.wait_for_words(r"^restored: height = 2, camera [^ ]*, 42\.000 s, paused; --fresh starts anew$")
                told = view.wait_until_told(VALUES, lambda told: told["time"] == 42)
                self.assertEqual({**told, "time": 0, "mouse": 0}, {**left, "time": 0, "mouse": 0})
                place = view.place()
                self.assertEqual((place["X"], place["Y"], place["WIDTH"]), (30, 40, 600 * scale))
                self.assertIn("tidemark_overlay", view.loaded())
                view.close()

    def test_options_override_the_stored_state(self):
        self.leave_something()
        view = self.again("--set", "height=1", "--camera", "30,20,10", "--size", "500x300", first_title=PAUSED)
        told = view.wait_until_told(VALUES, lambda told: told["time"] == 42)
        self.assertEqual((told["height"], told["wide"]), (1, 500))
        self.assertAlmostEqual(told["camera"], PLAIN_CAMERA, 4)

    def test_feedback_begins_at_0(self):
        self.write("count.glsl", '#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0) + 1.0; }\n')
        values = {"count": "texelFetch(iChannel0, ivec2(0), 0).r", "frame": "float(iFrame)"}
        self.write("a.glsl", probe.shader(values, '#iChannel0 "count.glsl"'))
        self.leave(self.again())
        view = self.again()
        view.wait_for_words("^starting at 0 s: the scene reads its own last frame$")
        told = view.told(values)
        self.assertEqual(told["count"], told["frame"] + 1)

    def test_fresh_ignores_the_stored_state(self):
        self.leave_something()
        view = self.again("--fresh")
        told = view.told(VALUES)
        self.assertEqual((told["height"], told["wide"]), (0.5, 640))
        self.assertLess(told["time"], 40)
        self.assertNotIn("restored", view.stderr())

    def test_capture_and_recordings_ignore_the_stored_state(self):
        self.leave_something()
        before = self.file().read_bytes()
        self.succeed("capture", "a.glsl", "-o", "plain.png")
        self.assertEqual(probe.read(png.read(self.folder / "plain.png"), VALUES)["height"], 0.5)
        view = self.again("--record", "take.txt")
        told = view.told(VALUES)
        self.assertEqual((told["height"], told["wide"]), (0.5, 640))
        self.leave(view)
        self.assertEqual(self.file().read_bytes(), before)

    def test_foreign_files_are_ignored(self):
        self.leave_something()
        whole = json.loads(self.file().read_text())
        for text in ("", "{", "[]", "null", json.dumps(whole | {"window": 5}), json.dumps(whole | {"scene": "/b.glsl"})):
            with self.subTest(text=text[:40]):
                self.file().write_text(text)
                view = self.again()
                self.assertEqual(view.told(VALUES)["height"], 0.5)
                view.wait_for_words(r"^cannot read the last window's state from '.*': the window starts anew$")
                view.close()


if __name__ == "__main__":
    main()
