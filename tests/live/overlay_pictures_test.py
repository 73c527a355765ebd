"""How the large picture in the overlay is looked at: exposure, channels, faces of a cube, slices of a volume."""
import struct

from support.live import main, wait_for
from support.overlay import FRAME, MARGIN, PADDING, PANEL_WIDTH, ROW, OverlayTest, OverlayView, row_centre

WIDTH, HEIGHT = 900, 600
KNOB = "#iUniform float level = 0.5 in { 0.0, 1.0 }\n"
HEADER = 2 # of the pictures, where a scene has one knob and no definition
SPACING = ROW - FRAME
SMALL_WIDTH = 120
ITEM, SHOWN_ITEMS = 17, 8 # of a list that opens
GREEN = "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, %s).r < 9.0 ? vec4(0.0, 1.0, 0.0, 1.0) : vec4(1.0); }\n"
CHANNELS, EXPOSURE, AUTO, SLICE = range(4)


class Pictures(OverlayTest):
    def small_heights(self, *shapes: float) -> float:
        return sum(min(max(SMALL_WIDTH / shape, SMALL_WIDTH / 4), SMALL_WIDTH) + SPACING for shape in shapes)

    def field(self, row: int) -> float:
        """The middle of a field below the small pictures."""
        return row_centre(HEADER + 1 + row) + self.small

    def colour(self, view: OverlayView, x: float, y: float) -> tuple[int, ...]:
        """Of the window, at shares of its width and height from the top left."""
        place = view.place()
        at = 3 * round(x * place["WIDTH"])
        return tuple(view.picture()[round(y * place["HEIGHT"])][at:at + 3])

    def wait_for_colour(self, view: OverlayView, place: tuple[float, float], wanted: tuple[int, ...]) -> None:
        try:
            wait_for(lambda: self.colour(view, *place) == wanted, f"{wanted} at {place}", 20)
        except AssertionError as missed:
            raise AssertionError(f"{missed}; it is {self.colour(view, *place)}") from None

    def click_field(self, view: OverlayView, row: int, share: float) -> None:
        view.click(MARGIN + PADDING + share * (PANEL_WIDTH - 2 * PADDING), self.field(row))

    def type_into(self, view: OverlayView, row: int, text: str) -> None:
        self.screen.xdotool("keydown", "ctrl")
        self.click_field(view, row, 0.3)
        self.screen.xdotool("keyup", "ctrl")
        self.screen.xdotool("type", text)
        view.key("Return")

    def choose(self, view: OverlayView, item: int) -> None:
        """From the list of channels."""
        self.click_field(view, CHANNELS, 0.3)
        top = self.field(CHANNELS) + FRAME // 2
        view.click(MARGIN + 4 * PADDING, top + PADDING + item * ITEM + ITEM // 2)

    def open_large(self, text: str, *shapes: float) -> OverlayView:
        """The first picture large, with the fields that say how it is looked at."""
        self.small = self.small_heights(*shapes)
        view = self.open_controls(KNOB + text, size=f"{WIDTH}x{HEIGHT}")
        view.key("1")
        view.click_row(HEADER, 0.3)
        return view

    def test_a_buffer_under_an_exposure_and_by_channels(self):
        self.write("numbers.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.125, 0.5, -0.25, 8.0); }\n")
        view = self.open_large('#iChannel0 "numbers.glsl"\n' + GREEN % "vec2(0.5)", 1.5, 1.5)
        place = (0.9, 0.4)
        self.wait_for_colour(view, place, (32, 128, 0))
        self.type_into(view, EXPOSURE, "2")
        self.wait_for_colour(view, place, (128, 255, 0))
        self.click_field(view, AUTO, 0.02)
        self.wait_for_colour(view, place, (64, 255, 0))  # 0.5 comes to 1
        view.key("2")  # Image in floats, by the same fields
        self.wait_for_colour(view, place, (0, 255, 0))
        view.key("1")
        self.wait_for_colour(view, place, (64, 255, 0))
        self.choose(view, 4)  # A, 8 comes to 1
        self.wait_for_colour(view, place, (255, 255, 255))
        self.choose(view, 6)  # R - B: 0.375 comes to 1
        self.wait_for_colour(view, place, (180, 4, 38))
        self.click_field(view, AUTO, 0.02)  # stays what it was
        self.wait_for_colour(view, place, (180, 4, 38))
        self.choose(view, 5)  # R - G is as far below zero
        self.wait_for_colour(view, place, (59, 76, 192))
        self.type_into(view, EXPOSURE, "0")
        self.wait_for_colour(view, place, (160, 167, 210))  # 221 - 0.375 * 162, and so on
        view.key("0")
        self.wait_for_colour(view, place, (0, 255, 0))

    def test_a_cube_is_unfolded(self):
        self.write("s/cube_a.glsl", "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) {\n"
                                    "    vec3 a = abs(d);\n"
                                    "    vec3 axis = vec3(greaterThanEqual(a, vec3(max(a.x, max(a.y, a.z)))));\n"
                                    "    c = vec4(dot(axis, d) > 0.0 ? axis : axis * 0.4, 1.0);\n}\n")
        self.write("s/image.glsl", '#iChannel0 "cube_a.glsl"\n' + GREEN % "vec3(1.0)")
        view = self.open("s", "--size", "800x600")
        view.show_controls()
        view.key("1")
        # Four cells by three over the whole window, seen in their right halves: panels lie over its left edge.
        for column, row, wanted in ((1, 1, (0, 0, 255)), (2, 1, (255, 0, 0)), (3, 1, (0, 0, 102)), (1, 0, (0, 255, 0)),
                                    (2, 0, (0, 0, 0)), (2, 2, (0, 0, 0))):
            with self.subTest(column=column, row=row):
                self.wait_for_colour(view, ((column + 0.8) / 4, (row + 0.5) / 3), wanted)
        self.wait_for_colour(view, (1.8 / 4, 2.4 / 3), (0, 102, 0))

    def test_a_slice_of_a_volume(self):
        head = struct.pack("<4sIIIBBH", b"BIN\0", 2, 2, 5, 1, 0, 0)
        self.write("v.bin", head + b"".join(bytes([40 * slice]) * 4 for slice in range(5)))
        view = self.open_large('#iChannel0 "v.bin"\n' + GREEN % "vec3(0.5)", 1.5, 1)
        view.key("2")
        place = (0.7, 0.4)  # of a square in the middle
        self.wait_for_colour(view, place, (80, 0, 0))
        self.type_into(view, SLICE, "4")
        self.wait_for_colour(view, place, (160, 0, 0))
        self.type_into(view, SLICE, "0")
        self.wait_for_colour(view, place, (0, 0, 0))
        view.key("0")
        self.wait_for_colour(view, place, (0, 255, 0))


if __name__ == "__main__":
    main()
