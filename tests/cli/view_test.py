"""`view` where there is no window to be had. What it does in one is in tests/live."""
import unittest

from support.program import ProgramTest, environment, main

GOOD = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n"


class NoDisplay(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", GOOD)
        if b"\n  view " not in self.succeed("--help").stdout:
            raise unittest.SkipTest("this build has no window")

    def test_error_names_capture(self):
        for arguments in (["view", "a.glsl"], ["a.glsl"]):
            with self.subTest(arguments=arguments):
                self.expect_error(arguments, 77, "neither", "WAYLAND_DISPLAY", "`tidemark capture`")

    def test_unreachable_display(self):
        self.expect_failure(["view", "a.glsl"], 77,
                            "tidemark: error: cannot open a window: X11: Failed to open display :4711; "
                            "`tidemark capture` draws without one", env=environment(DISPLAY=":4711"))

    def test_option_errors_are_reported_first(self):
        self.expect_error(["view", "a.glsl", "--size", "0x5"], 2, "--size 0x5")
        self.expect_failure(["view", "a.glsl", "--size", "99999x5"], 2,
                            "tidemark: error: --size 99999x5: a window has at most 32767 pixels on a side")
        self.expect_error(["view", "a.glsl", "--camera", "1"], 2, "--camera 1")
        self.expect_failure(["view", "a.glsl", "--set", "x=1"], 2,
                            "tidemark: error: the scene has no knob 'x': it declares none with #iUniform")


if __name__ == "__main__":
    main(needs_context=False)
