"""A graphics driver that is reset while a window is open: support/reset_driver.cpp, preloaded, says so once, at a draw."""
import pathlib
import unittest

from support import probe
from support.live import LiveTest, main
from support.program import PROGRAM, not_sanitized

DRIVER = pathlib.Path(PROGRAM).parent / "tidemark_reset_driver.so"
VALUES = {"height": "height", "width": "width", "time": "iTime"}
KNOBS = "#iUniform float height = 0.5 in { 0.0, 2.0 }\n#iUniform float width = 0.5 in { 0.0, 2.0 }"
RESET = "tidemark: error: the graphics driver was reset: a draw call took too long or crashed it; "


@unittest.skipUnless(DRIVER.exists(), "the library that resets the driver is not built")
class Reset(LiveTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", probe.shader(VALUES, KNOBS))

    def struck(self, draw: int, *options: str, **arguments):
        return self.view("a.glsl", "--size", "200x120", *options, LD_PRELOAD=str(DRIVER), TIDEMARK_TEST_RESET=str(draw),
                         **arguments)

    @not_sanitized
    def test_the_window_reopens_with_its_state(self):
        """Some eight seconds after the start, at 60 frames a second."""
        view = self.struck(500, "--set", "height=1.5")
        view.wait_for_words(f"^{RESET}opening the window again$")
        left = view.wait_for_words(r"^restored: (?:.*, )?(\d+\.\d+) s; --fresh starts anew$")
        view.wait_for_window(r" fps$")
        told = view.told(VALUES)
        self.assertGreaterEqual(told["time"], float(left.group(1)))
        self.assertEqual((told["height"], told["width"]), (1.5, 0.5))
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)

    @not_sanitized
    def test_an_early_reset_is_not_retried(self):
        view = self.struck(3, first_title=None)
        self.assertEqual(view.wait_for_end(), 5)
        self.assertEqual(view.stderr(), f"{RESET}it happened soon after the start, so the window is not opened again; "
                                        f"`tidemark capture --tile 64` draws this scene in small parts\n")

    @not_sanitized
    def test_a_reset_completes_the_recording(self):
        view = self.struck(100, "--record", "clicks.txt", first_title=None)
        self.assertEqual(view.wait_for_end(), 5)
        self.assertEqual(view.stderr(), f"{RESET}the recording is in clicks.txt\n")
        self.succeed("capture", "a.glsl", "--input", "clicks.txt", "--size", "200x120", "--frame", "3", "-o", "a.png")


if __name__ == "__main__":
    main()
