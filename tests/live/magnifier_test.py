"""Looking into the picture: the magnifier, marks where it is not made of numbers, and where those come from."""
from support.live import main, wait_for
from support.overlay import OverlayTest, OverlayView
from support.program import is_sanitized

CELL = 12
SIZES = (("640x360", 1), ("900x600", 1), ("500x300", 2), ("400x250", 2))
MARKED = bytes((255, 0, 128))
MAGENTA, GREEN, BLUE = bytes((255, 0, 255)), bytes((0, 255, 0)), bytes((0, 0, 255))
ERROR_RED = bytes((255, 115, 102))
# The mark under the line is the lowest of its red; the place stands two lines above.
PLACE_ABOVE_MARK = 29

# One pixel has the colour that is looked for.
ONE = """#iChannel0 "b.glsl"
void mainImage(out vec4 c, in vec2 p) {
    c = vec4(0.0, 0.25, 0.0 * texelFetch(iChannel0, ivec2(p), 0).x, 1.0);
    if (ivec2(p) == ivec2(100, 80)) c = vec4(1.0, 0.0, 0.5, 1.0);
}
"""
BUFFER = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, -1.5, 1.0e30); }\n"
# Four columns of pixels: NaN, infinity, below zero, and numbers.
KINDS = """void mainImage(out vec4 c, in vec2 p) {
    c = vec4(0.25);
    if (p.x < 40.0)
        c.r = sqrt(-1.0 - p.x);
    else if (p.x < 80.0)
        c.g = exp(100.0 + p.x);
    else if (p.x < 120.0)
        c.b = -0.5;
}
"""


def count(view: OverlayView, colour: bytes) -> int:
    return sum(row[i:i + 3] == colour for row in view.picture() for i in range(0, len(row), 3))


class Magnifier(OverlayTest):
    def open_text(self, text: str, size: str = "640x360", scale: int = 1, **options: str) -> OverlayView:
        self.write("b.glsl", BUFFER)
        self.write("a.glsl", text)
        return self.open("a.glsl", "--size", size, scale=scale, **options)

    def point_at(self, view: OverlayView, x: int, y: int) -> None:
        """A pixel as shaders count them."""
        view.point(x, view.place()["HEIGHT"] - 1 - y)

    def test_shows_and_hides_the_pixel_under_the_pointer(self):
        for size, scale in SIZES:
            with self.subTest(size=size, scale=scale):
                view = self.open_text(ONE, size, scale)
                wait_for(lambda: count(view, MARKED) == 1, "the scene's pixel")
                self.assertTrue("tidemark_overlay" not in view.loaded() or is_sanitized()) # a slow frame's clock needs it
                self.point_at(view, 100, 80)
                view.key("m")
                inner = (CELL * scale - 4) ** 2
                wait_for(lambda: count(view, MARKED) >= inner, "the pixel, large")
                self.point_at(view, 110, 80)
                wait_for(lambda: count(view, MARKED) <= 1, "the magnifier to follow the pointer")
                self.point_at(view, 100, 80)
                wait_for(lambda: count(view, MARKED) >= inner, "the pixel again")
                view.key("m")
                wait_for(lambda: count(view, MARKED) == 1, "the picture with nothing over it")
                view.close()

    def test_marks_cover_non_finite_pixels(self):
        for size, scale in SIZES:
            with self.subTest(size=size, scale=scale):
                view = self.open_text(KINDS, size, scale)
                rows = view.place()["HEIGHT"] - 1
                plain = view.picture()
                view.key("n")
                for colour in (MAGENTA, GREEN, BLUE):
                    wait_for(lambda: count(view, colour) == 40 * rows, f"the marks {colour!r}")
                self.assertEqual([row[3 * 120:] for row in view.picture()], [row[3 * 120:] for row in plain])
                view.key("n")
                wait_for(lambda: count(view, MAGENTA) + count(view, GREEN) + count(view, BLUE) == 0, "the plain picture")
                view.close()

    def test_enter_finds_the_line_and_a_click_opens_the_editor(self):
        script = self.write("edit.sh", "#!/bin/sh\necho \"$@\" > edited.txt\n")
        script.chmod(0o755)
        view = self.open_text(KINDS, VISUAL=f"{script}")
        self.point_at(view, 60, 300)
        view.key("m")
        view.key("Return")
        view.wait_for_words(r"^a\.glsl:6:15: error: `c\.g = exp\(100\.0 \+ p\.x\)` gave \+Inf: ")

        def red_rows() -> list[int]:
            return [y for y, row in enumerate(view.picture()) if ERROR_RED in row]

        mark = max(wait_for(red_rows, "the panel"))
        view.click(28, mark - PLACE_ABOVE_MARK)
        edited = self.folder / "edited.txt"
        wait_for(lambda: edited.exists() and edited.read_text(), "the editor")
        self.assertEqual(edited.read_text(), "+6 a.glsl\n")
        view.key("Return")
        wait_for(lambda: not red_rows(), "the panel to go")

    def test_enter_on_a_finite_pixel(self):
        view = self.open_text(KINDS)
        self.point_at(view, 200, 200)
        view.key("m")
        view.key("Return")
        view.wait_for_words(r"^tidemark: error: no origin was found: drawn again, the pixel is finite$")


if __name__ == "__main__":
    main()
