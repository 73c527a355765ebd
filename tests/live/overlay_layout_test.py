"""The layout of the panels: small windows, long names, the font, and the help that hides what is below."""
from support import probe
from support.live import main, wait_for
from support.overlay import MARGIN, PAUSE, PANEL_WIDTH, ROW, OverlayTest, row_centre

LONG = "a_knob_with_a_name_that_is_much_longer_than_its_panel_is_wide"
VALUES = {"long": LONG}
WHITE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n"
PANEL_COLOUR = bytes((15, 15, 15))


def knob(name: str) -> str:
    return f"#iUniform float {name} = 0.5 in {{ 0.0, 1.0 }}\n"


class Layout(OverlayTest):
    def test_a_long_name_leaves_room_for_its_reset(self):
        view = self.open_controls(probe.shader(VALUES, knob(LONG)))
        view.drag_row(1, 0.1, 0.4)
        view.wait_until_told(VALUES, lambda told: told["long"] > 0.6)
        view.click_row(1, 0.93)
        view.wait_until_told(VALUES, lambda told: told["long"] == 0.5)

    def test_a_long_name_ends_in_dots(self):
        black = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.0, 0.0, 0.0, " + LONG + "); }\n"
        view = self.open_controls(knob(LONG) + black)
        view.point(600, 10)
        first, last = row_centre(1) - 9, row_centre(1) + 9

        def bright() -> list[tuple[int, int]]:
            rows = view.picture()[first:last]
            return [(x, y) for y, row in enumerate(rows) for x in range(MARGIN, MARGIN + PANEL_WIDTH)
                    if min(row[3 * x:3 * x + 3]) > 180]

        right = max(x for x, _ in wait_for(bright, "the name"))
        heights = {y for x, y in bright() if x > right - 5}
        self.assertEqual(len(heights), 1, "the three dots are in one row of pixels")
        self.assertGreater(heights.pop(), 9)

    def test_the_controls_leave_the_bar_free(self):
        self.write("a.glsl", "".join(knob(f"k{i}") for i in range(30)) + WHITE.replace("1.0", "k0"))
        view = self.open("a.glsl", "--size", "320x180", first_title=" (fps|still)")
        before = view.picture()
        view.key("Tab")
        view.wait_for_change(before)
        view.click(PAUSE, view.bar_y() - ROW)  # the slider has a row of its own
        view.wait_for_title(" - paused at ")

    def test_help_is_opaque(self):
        self.write("a.glsl", WHITE)
        view = self.open("a.glsl", "--size", "640x360")
        before = view.picture()
        view.key("h")
        view.wait_for_change(before)
        wait_for(lambda: sum(row.count(PANEL_COLOUR) for row in view.picture()) > 50000, "an opaque panel")


if __name__ == "__main__":
    main()
