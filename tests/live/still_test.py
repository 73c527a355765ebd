"""What does not move costs nothing: a still scene and a paused one draw no frame and wake no thread."""
import pathlib
import re
import time

from support import probe
from support.live import LiveTest, View, main

SIZE = ("--size", "200x100")
MOUSE = probe.vector("iMouse", "xyzw")
STILL = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.5, 1.0); }\n"
MOVING = "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(iTime)); }\n"
REST_SECONDS = 3.0


class Still(LiveTest):
    def wakes(self, view: View) -> int:
        """How often its threads, the driver's too, gave up a processor to wait."""
        status = [task / "status" for task in pathlib.Path(f"/proc/{view.program.pid}/task").iterdir()]
        return sum(int(re.search(r"^voluntary_ctxt_switches:\s*(\d+)$", path.read_text(), re.M)[1]) for path in status)

    def expect_rest(self, view: View) -> None:
        time.sleep(0.5)  # what the last change set off
        before = self.wakes(view)
        time.sleep(REST_SECONDS)
        # A frame drawn wakes the driver's threads, too: 60 frames a second are some hundred in each second.
        self.assertLess(self.wakes(view) - before, 20 * REST_SECONDS)

    def test_a_still_scene_is_not_redrawn(self):
        self.write("a.glsl", STILL)
        view = self.view("a.glsl", *SIZE)
        view.wait_for_title(r"\Aa - tidemark - still\Z")
        self.expect_rest(view)

    def test_a_paused_scene_is_not_redrawn(self):
        self.write("a.glsl", MOVING)
        view = self.view("a.glsl", *SIZE)
        view.pause()
        self.expect_rest(view)

    def test_redraws_for_the_mouse_only(self):
        self.write("a.glsl", probe.shader(MOUSE))
        view = self.view("a.glsl", *SIZE)
        view.wait_for_title(r" still\Z")
        view.drag((100, 50), (60, 70))
        # The frame of the press is not the last: its w is positive.
        view.wait_until_told(MOUSE, lambda told: (told["iMouse.x"], told["iMouse.z"]) == (60, -100) and told["iMouse.w"] < 0)
        view.wait_for_title(r" still\Z")
        self.expect_rest(view)

    def test_redraws_after_a_reload_with_movement(self):
        self.write("a.glsl", STILL)
        view = self.view("a.glsl", *SIZE)
        view.wait_for_title(r" still\Z")
        self.write("a.glsl", MOVING)
        view.wait_for_title(r" \d+ fps\Z")
        self.write("a.glsl", STILL)
        view.wait_for_title(r" still\Z")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)


if __name__ == "__main__":
    main()
