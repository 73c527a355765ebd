"""The bar of time in the window's overlay: pause, scrub, a number, speed, loop; scenes with feedback are stepped."""
import re

from support import probe
from support.live import main
from support.overlay import LOOP_FROM, LOOP_TO, PAUSE, RESTART, SPEED_BEGIN, SPEED_END, OverlayTest

CLOCK = {"iTime": "iTime", "iFrame": "float(iFrame)"}
COUNTED = CLOCK | {"count": "texelFetch(iChannel0, ivec2(0), 0).r"}
COUNT = '#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) {{ c = texelFetch(iChannel0, ivec2(p), 0) + 1.0{}; }}\n'
SIZES = (("900x600", 1), ("400x250", 2))
SMALL = "400x250"


class Time(OverlayTest):
    def test_scrub_and_pause(self):
        for size, scale in SIZES:
            with self.subTest(size=size, scale=scale):
                view = self.open_controls(probe.shader(CLOCK), size=size, scale=scale)
                view.click_bar(PAUSE)
                view.wait_for_title(" - paused at ")
                view.drag_bar(view.scrubber(0.2), view.scrubber(0.75))
                told = view.wait_until_told(CLOCK, lambda told: 7 < told["iTime"] < 8.5)
                self.assertEqual(told["iFrame"], int(round(told["iTime"] * 60, 3)))
                view.click_bar(RESTART)
                view.wait_until_told(CLOCK, lambda told: told["iTime"] == 0)
                view.close()

    def test_go_to_a_number(self):
        view = self.open_controls(probe.shader(CLOCK), size=SMALL)
        view.click_bar(PAUSE)
        view.type_time("42.5")
        self.assertEqual(view.wait_until_told(CLOCK, lambda told: told["iTime"] == 42.5)["iFrame"], 2550)

    def test_escape_cancels_typing_a_number(self):
        view = self.open_controls(probe.shader(CLOCK), size=SMALL)
        for paused in (False, True):
            with self.subTest(paused=paused):
                if paused:
                    view.click_bar(PAUSE)
                    view.wait_for_title(" - paused at ")
                before = view.told(CLOCK)["iTime"]
                view.type_time("3000", frames_held=0 if paused else 5, end="Escape")
                after = view.told(CLOCK)["iTime"]
                if paused:
                    self.assertEqual(after, before)
                else:
                    self.assertTrue(before < after < 2000, after)

    def test_speed_and_backwards(self):
        view = self.open_controls(probe.shader(CLOCK), size=SMALL)
        view.type_time("42.5")
        view.wait_until_told(CLOCK, lambda told: told["iTime"] > 42.5)
        view.drag_bar(150, SPEED_BEGIN)
        view.wait_until_told(CLOCK, lambda told: 5 < told["iTime"] < 42)
        view.drag_bar(150, SPEED_END)
        low = view.told(CLOCK)["iTime"]
        view.wait_until_told(CLOCK, lambda told: told["iTime"] > low + 1)

    def test_loop(self):
        view = self.open_controls(probe.shader(CLOCK))
        view.click_bar(PAUSE)
        for seconds, button in (("7", LOOP_FROM), ("7.25", LOOP_TO)):
            view.type_time(seconds)
            view.wait_until_told(CLOCK, lambda told: told["iTime"] == float(seconds))
            view.click_bar(button)
        view.click_bar(PAUSE)
        times = [view.told(CLOCK)["iTime"] for _ in range(12)]
        self.assertGreaterEqual(min(times), 7)
        self.assertLess(max(times), 7.4)
        self.assertNotEqual(times, sorted(times))

    def test_feedback_is_stepped_to(self):
        self.write("count.glsl", COUNT.format(""))
        view = self.open_controls(probe.shader(COUNTED, '#iChannel0 "count.glsl"'), size=SMALL)
        view.click_bar(PAUSE)
        for seconds in ("5", "3", "11.5", "0"):
            view.type_time(seconds)
            told = view.wait_until_told(COUNTED, lambda told: abs(told["iTime"] - float(seconds)) < 0.01)
            self.assertEqual(told["count"], 60 * float(seconds) + 1)

    def test_a_number_is_typed_while_time_runs(self):
        self.write("count.glsl", COUNT.format(""))
        view = self.open_controls(probe.shader(COUNTED, '#iChannel0 "count.glsl"'), size=SMALL)
        view.type_time("30", frames_held=5)
        told = view.wait_until_told(COUNTED, lambda told: told["iTime"] >= 30)
        self.assertEqual(told["count"], told["iFrame"] + 1)

    def test_stepping_can_be_cancelled(self):
        heavy = "; for (int i = 0; i < 300; ++i) c.g += sin(c.r + float(i))"
        self.write("count.glsl", COUNT.format(heavy))
        view = self.open_controls(probe.shader(COUNTED, '#iChannel0 "count.glsl"'), size=SMALL)
        view.type_time("4000")
        view.wait_for_title("stepping to frame ")
        view.key("Escape")
        view.wait_for_title(" - paused at ")
        told = view.told(COUNTED)
        self.assertEqual(told["count"], told["iFrame"] + 1)

    def test_a_recording_follows_a_seek(self):
        view = self.open_controls("#iUniform float level = 0.5 in { 0.0, 1.0 }\n" + probe.shader(CLOCK), "--record", "take.txt")
        view.type_time("100")
        view.wait_until_told(CLOCK, lambda told: told["iFrame"] >= 6000)
        view.drag_row(1, 0.1, 0.4)
        view.click_bar(PAUSE)
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        frames = [int(frame) for frame in re.findall(r"^(\d+) set level=", (self.folder / "take.txt").read_text(),
                                                     re.MULTILINE)]
        self.assertGreaterEqual(min(frames), 6000)


if __name__ == "__main__":
    main()
