"""Lenses in the window: the pictures are those of `capture --lens`, and the window answers while they are drawn."""
import re
import time

from support import march, png
from support.live import main, wait_for
from support.overlay import MARGIN, PADDING, PANEL_WIDTH, OverlayTest, OverlayView, row_centre
from support.program import is_sanitized
from support.slow import rounds_that_take, slow_shader

SIZE = "640x200"
FREE = 300  # columns at the left that no panel covers
NEWEST = bytes((255, 234, 70))  # of the points of a front
REFUSED = bytes((255, 115, 102))

HALVING = "#iUniform float shade = 200.0 in { 100.0, 300.0 }\n" + march.HALVING.replace("200.0", "shade")
NO_MARCH = """void mainImage(out vec4 color, in vec2 place) {
    color = vec4(place / iResolution.xy, 0.5, 1.0);
}
"""
COUNTS = """#iChannel0 "self"
void mainImage(out vec4 color, in vec2 place) {
    float before = texelFetch(iChannel0, ivec2(place), 0).x;
    float seen = before + 1.0;
    color = vec4(seen, 0.0, 0.0, 1.0);
}
"""


class Lens(OverlayTest):
    def open_text(self, text: str, *options: str, first_title: str = " (fps|still)") -> OverlayView:
        self.write("a.glsl", text)
        return self.open("a.glsl", "--size", SIZE, *options, first_title=first_title)

    def free(self, rows: list[bytes]) -> list[bytes]:
        return [row[:3 * FREE] for row in rows]

    def captured(self, lens: str) -> list[bytes]:
        """The map that `capture` draws, without its legend, as far as no panel covers it in the window."""
        self.succeed("capture", "a.glsl", "--size", SIZE, "--time", "0", "--lens", lens, "-o", "lens.png")
        rows = png.read(self.folder / "lens.png").rows
        return self.free([bytes(row[:3 * 640]) for row in rows[:199]])

    def wait_for_lens(self, view: OverlayView, lens: str) -> None:
        wanted = self.captured(lens)
        wait_for(lambda: view.running() and self.free(view.picture()) == wanted, f"the picture of {lens}: {view.stderr()}")

    def test_l_goes_through_the_lenses_of_capture_and_back_to_the_picture(self):
        view = self.open_text(HALVING.replace("LIMIT", "12"))
        plain = view.picture()
        for lens in ("cost", "steps", "error", "rounding"):
            view.key("l")
            view.wait_for_words(f"^lens {lens}: ")
            self.wait_for_lens(view, lens)
        view.key("shift+l")
        self.wait_for_lens(view, "error")
        view.key("l")
        view.key("l")
        view.wait_for_words("^lens proof: ")
        view.key("l")
        view.wait_for_words("^lens clocks: ")
        view.key("l")
        view.wait_for_words("^lens off$")
        wait_for(lambda: view.picture() == plain, "the picture as it was")

    def test_the_steps_of_a_march_are_those_of_its_formula(self):
        view = self.open_text(HALVING.replace("LIMIT", "12"))
        view.key("l")
        view.key("l")
        self.wait_for_lens(view, "steps")
        row = view.picture()[0]
        columns = [row[3 * x:3 * x + 3] for x in range(16)]
        self.assertEqual(columns[:8], columns[8:])
        self.assertEqual(columns[5:8], [b"\xff\xff\xff"] * 3)  # they need 13 to 15
        greens = [colour[1] for colour in columns[:5]]
        self.assertEqual(greens, sorted(set(greens)))  # 8 to 12, brighter and brighter
        view.key("c")
        view.wait_for_words(r"^copied: tidemark capture a\.glsl .* --lens steps$")

    def test_a_reload_keeps_the_lens(self):
        view = self.open_text(HALVING.replace("LIMIT", "12"))
        view.key("l")
        view.key("l")
        self.wait_for_lens(view, "steps")
        self.write("a.glsl", HALVING.replace("LIMIT", "99"))
        self.wait_for_lens(view, "steps")
        self.write("a.glsl", NO_MARCH)
        view.wait_for_words("^lens steps: no marching loop was found in Image")
        wait_for(lambda: any(REFUSED in row for row in view.picture()), "the reason in the window")
        self.write("a.glsl", HALVING.replace("LIMIT", "12"))
        self.wait_for_lens(view, "steps")

    def test_a_lens_that_the_scene_has_not_is_skipped(self):
        view = self.open_text(NO_MARCH)
        view.key("l")
        self.wait_for_lens(view, "cost")
        view.key("l")
        view.wait_for_words("^lens steps: no marching loop was found in Image")
        view.wait_for_words("^lens error: ")
        self.wait_for_lens(view, "error")

    def test_feedback_is_counted_in_the_frame_on_show(self):
        view = self.open_text(COUNTS)
        view.key("l")
        view.wait_for_words("^lens cost: ")
        wait_for(lambda: len(set(self.free(view.picture()))) == 1 and len(set(view.picture()[0][:3 * FREE:3])) == 1
                 and view.picture()[0][1] > 0, "one number for all pixels")
        self.assertNotIn("lens cost: the instrumented", view.stderr())

    def test_the_list_in_the_controls(self):
        self.write("a.glsl", HALVING.replace("LIMIT", "12"))
        view = self.open("a.glsl", "--size", "640x480")
        view.show_controls()
        view.click_row(4, 0.3)  # after the buttons, the knob, "Passes and inputs" and "Views"
        time.sleep(0.3)
        view.click_row(5, 0.2)
        time.sleep(0.3)
        view.click(MARGIN + PADDING + 20, row_centre(5) + 19 + 2 * 17)  # "steps", below "off" and "cost"
        view.wait_for_words("^lens steps: ")
        view.click_row(6, 0.2)
        self.screen.xdotool("type", "9")
        view.key("Return")
        view.wait_for_words("^lens steps:9: ")

    def test_the_hot_lines_open_in_the_editor(self):
        script = self.write("edit.sh", "#!/bin/sh\necho \"$@\" > edited.txt\n")
        script.chmod(0o755)
        self.write("a.glsl", HALVING.replace("LIMIT", "99"))
        view = self.open("a.glsl", "--size", "640x480", VISUAL=f"{script}")
        view.show_controls()
        before = view.picture()
        view.click_row(5, 0.3)
        view.wait_for_change(before)
        edited = self.folder / "edited.txt"

        def click() -> str:
            view.click(MARGIN + PADDING + 80, row_centre(6) - 3)
            return edited.read_text() if edited.exists() else ""

        listed = self.succeed("inspect", "a.glsl", "--hot-lines", "--budget", "0").stdout.decode()
        hottest = re.search(r"%  a\.glsl:(\d+): ", listed)[1]
        self.assertEqual(wait_for(click, "the editor"), f"+{hottest} a.glsl\n")

    def test_a_front_is_drawn_while_a_knob_is_turned(self):
        self.write("a.glsl", HALVING.replace("LIMIT", "99"))
        view = self.open("a.glsl", "--size", "640x480")
        view.show_controls()
        view.drag_row(1, 0.2, 0.4)
        wait_for(lambda: any(NEWEST in row[3 * PANEL_WIDTH:] for row in view.picture()), "a point")
        view.point(500, 400)  # the panel is shown beside the knobs while the pointer is over them
        wait_for(lambda: not any(NEWEST in row for row in view.picture()), "the panel to go")

    def test_the_status_line_opens_and_closes(self):
        view = self.open_text(NO_MARCH)
        before = view.picture()
        view.key("i")
        view.wait_for_change(before)
        changed = [y for y, (old, new) in enumerate(zip(before, view.picture())) if old != new]
        self.assertGreater(min(changed), 130)
        view.key("i")
        wait_for(lambda: view.picture() == before, "the picture without it")

    def longest_answer(self, view: OverlayView) -> float:
        """Seconds that the help takes to come, at most."""
        waits = []
        for _ in range(10):
            count = view.stderr().count("full screen; help")
            begun = time.monotonic()
            view.key("h")
            wait_for(lambda: view.stderr().count("full screen; help") > count, "the help")
            waits.append(time.monotonic() - begun)
            view.key("h")
            time.sleep(0.1)
        return max(waits)

    def test_keys_are_answered_while_a_slow_lens_is_drawn(self):
        """A frame takes 3 s in float and more in double; no key waits for one."""
        values = {"size": "iResolution.x"}
        rounds = rounds_that_take(3, self, lambda count: slow_shader(count, values), "--size", SIZE)
        view = self.open_text(slow_shader(rounds, values), "--paused", "--plain", first_title=" - paused at ")
        while not re.search("^lens error: ", view.stderr(), re.MULTILINE):
            view.key("l")
            time.sleep(0.1)
        self.assertLess(self.longest_answer(view), 10 if is_sanitized() else 3)

    def test_keys_are_answered_while_rays_are_proved(self):
        """All of them take minutes."""
        view = self.open_text(HALVING.replace("LIMIT", "12"))
        view.key("shift+l")
        view.wait_for_words("^lens clocks: ")
        view.key("shift+l")
        view.wait_for_words("^lens proof: ")
        self.assertLess(self.longest_answer(view), 10 if is_sanitized() else 3)


if __name__ == "__main__":
    main()
