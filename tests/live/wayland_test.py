"""The window on a Wayland compositor."""
import signal
import time

from support import png, probe
from support.live import wait_for
from support.wayland import WaylandTest, main

PATTERN = """void mainImage(out vec4 c, in vec2 p) {
    c = vec4(p.x / 255.0, fract(sin(dot(p, vec2(91.7, 3.1))) * 4311.3), fract(float(iFrame) * 0.21), 0.5);
}
"""
SIZE = probe.vector("iResolution", "xy")


class Wayland(WaylandTest):
    def test_the_picture_equals_capture(self):
        self.write("wave.glsl", PATTERN)
        view = self.view("wave.glsl", "--size", "200x100", "--fps", "10")
        view.restart_paused()
        view.key("Right")
        view.wait_for_title(r" - paused at 0\.100 s$")
        saved = png.read(view.save())
        self.succeed("capture", "wave.glsl", "--size", "200x100", "--frame", "1", "--fps", "10", "-o", "headless.png")
        self.assertEqual(png.read(self.folder / "headless.png").sha256(), saved.sha256())
        wait_for(lambda: self.screen.find(saved.rows), "the picture on the screen")
        self.assertEqual(view.stderr(), "saving wave-00001.png\n")

    def test_a_save_reloads_the_scene(self):
        self.write("a.glsl", probe.shader({"it": "1.0"}))
        view = self.view("a.glsl", "--size", "200x100")
        self.assertEqual(view.told({"it": ""}), {"it": 1})
        self.write("a.glsl", probe.shader({"it": "2.0"}))
        view.wait_until_told({"it": ""}, lambda told: told["it"] == 2)
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(nothing); }")
        view.wait_for_words(r"^a\.glsl:1:\d+: error: ")

    def test_f_toggles_full_screen(self):
        self.write("size.glsl", probe.shader(SIZE))
        view = self.view("size.glsl", "--size", "200x100")
        view.key("f")
        view.wait_until_told(SIZE, lambda told: list(told.values()) == [1000, 700])
        view.key("f")
        view.wait_until_told(SIZE, lambda told: list(told.values()) == [200, 100])

    def test_escape_closes_the_window(self):
        self.write("a.glsl", PATTERN)
        view = self.view("a.glsl", "--size", "200x100")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        self.assertEqual(view.stderr(), "")


class Hidden(WaylandTest):
    """On another workspace, where a compositor asks for no frames."""
    CONFIG = "[shell]\nnum-workspaces=2\n"

    def test_a_hidden_window_continues_and_can_be_closed(self):
        self.write("a.glsl", PATTERN)
        view = self.view("a.glsl", "--size", "200x100")
        view.key("super+F2")
        time.sleep(1)  # a second of frames that nobody sees
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(nothing); }")
        view.wait_for_words(r"^a\.glsl:1:\d+: error: ")
        view.program.send_signal(signal.SIGINT)
        self.assertEqual(view.wait_for_end(), 130)


if __name__ == "__main__":
    main()
