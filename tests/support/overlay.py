"""Where the window's overlay has its widgets: in points of an ordinary display, from the top left."""
from __future__ import annotations

from support.live import LiveTest, Screen, View, wait_for

# What Dear ImGui's default style and font come to.
MARGIN = 8
PADDING = 8
TITLE = 19
ROW = 23
FRAME = 19
PANEL_WIDTH = 320
VIEW = 49  # the height of a kept view, with the gap after it


# The bar of time: its upper row's middle above the window's lower edge, and what stands in it from the left.
BAR_ROW = 35
END = 65  # the button that shows the bar's end, and the gap before it
RESTART, PAUSE, LOOP_FROM, LOOP_TO, SPEED_BEGIN, SPEED_END, SCRUBBER = 18, 60, 96, 119, 135, 233, 241


def row_centre(row: int) -> int:
    """The middle of a row of the panel of controls; the buttons are row 0."""
    return MARGIN + TITLE + PADDING + row * ROW + FRAME // 2


class OverlayView(View):
    """A View with the overlay's panel in it."""

    scale = 1

    def at(self, x: float, y: float) -> tuple[int, int]:
        return round(x * self.scale), round(y * self.scale)

    def drag_row(self, row: int, start: float, end: float) -> None:
        """Across the widgets of a row, from one share of the panel's inner width to another."""
        inner = PANEL_WIDTH - 2 * PADDING
        y = row_centre(row)
        self.drag(self.at(MARGIN + PADDING + start * inner, y), self.at(MARGIN + PADDING + end * inner, y))

    def click(self, x: float, y: float) -> None:
        self.point(*self.at(x, y))
        self.button(1, True)
        self.button(1, False)

    def click_row(self, row: int, share: float) -> None:
        self.click(MARGIN + PADDING + share * (PANEL_WIDTH - 2 * PADDING), row_centre(row))

    def click_view(self, row: int, index: int, share: float) -> None:
        """In the upper half of a view, below the row of the button that keeps one."""
        y = row_centre(row) - FRAME // 2 + ROW + index * VIEW + FRAME // 2
        self.click(MARGIN + PADDING + share * (PANEL_WIDTH - 2 * PADDING), y)

    def bar_y(self) -> float:
        return self.place()["HEIGHT"] / self.scale - BAR_ROW

    def click_bar(self, x: float) -> None:
        self.click(x, self.bar_y())

    def drag_bar(self, start: float, end: float) -> None:
        y = self.bar_y()
        self.drag(self.at(start, y), self.at(end, y))

    def scrubber(self, share: float) -> float:
        """A place on the bar's slider of time."""
        width = self.place()["WIDTH"] / self.scale - SCRUBBER - PADDING - END
        return SCRUBBER + share * width

    def type_time(self, seconds: str, frames_held: int = 0, end: str = "Return") -> None:
        """The button that opens the field is held down for so many pictures; the key `end` closes it."""
        self.screen.xdotool("keydown", "ctrl")
        self.point(*self.at(self.scrubber(0.5), self.bar_y()))
        self.button(1, True)
        for _ in range(frames_held):
            self.wait_for_change(self.picture())
        self.button(1, False)
        self.screen.xdotool("keyup", "ctrl")
        self.screen.xdotool("type", seconds)
        self.key(end)

    def loaded(self) -> str:
        """What the process has mapped into its memory."""
        with open(f"/proc/{self.program.pid}/maps", encoding="utf-8") as maps:
            return maps.read()

    def picture(self) -> list[bytes]:
        """The rows of the window as it is on the screen, but for the lowest, in which shaders tell numbers."""
        place = self.place()
        return self.screen.rows(place["X"], place["Y"], place["WIDTH"], place["HEIGHT"] - 1)

    def show_controls(self) -> None:
        """Only their title's right part is looked at: shaders tell numbers on the left of every row."""
        def title() -> list[bytes]:
            rows = self.picture()[MARGIN * self.scale:(MARGIN + TITLE) * self.scale]
            return [row[3 * PANEL_WIDTH // 2 * self.scale:3 * PANEL_WIDTH * self.scale] for row in rows]

        before = title()
        self.key("Tab")
        wait_for(lambda: self.running() and title() != before, "the controls")

    def wait_for_change(self, before: list[bytes]) -> None:
        wait_for(lambda: self.running() and self.picture() != before, "another picture")


class OverlayTest(LiveTest):
    """A test class with an ordinary screen and a dense one."""

    dense: Screen

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.dense = Screen()
        cls.dense.set_density(192)
        cls.addClassCleanup(cls.dense.close)

    def open(self, scene: str, *options: str, scale: int = 1, **arguments: str) -> OverlayView:
        opened = OverlayView(self.dense if scale == 2 else self.screen, self.folder, scene, *options, **arguments)
        opened.scale = scale
        self.addCleanup(opened.close)
        return opened

    def open_controls(self, text: str, *options: str, size: str = "640x360", scale: int = 1) -> OverlayView:
        """A view of `a.glsl` with that text, and the panel of controls."""
        self.write("a.glsl", text)
        view = self.open("a.glsl", "--size", size, *options, scale=scale)
        view.show_controls()
        return view
