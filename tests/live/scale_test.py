"""The render scale of the window: what the scene is told, what is on the screen, what is saved and remembered."""
from support import png, probe
from support.live import LiveTest, main, wait_for

SIZE = probe.vector("iResolution", "xy")
MOUSE = probe.vector("iMouse", "xyzw")
SIZES = ((256, 128), (640, 360))
STRIPES = "void mainImage(out vec4 c, in vec2 p) { c = vec4(mod(floor(p.x), 2.0), step(p.x * 2.0, iResolution.x), 0.25, 1); }\n"
LAST = {"1/8": 3, "1/4": 2, "1/2": 1, "1": 0, "2": -1}


def option(size: tuple[int, int]) -> str:
    return f"{size[0]}x{size[1]}"


class Scale(LiveTest):
    def on_screen(self, view, row: int) -> bytes:
        place = view.place()
        return self.screen.rows(place["X"], place["Y"] + row, place["WIDTH"], 1)[0]

    def test_iResolution_is_the_drawn_size(self):
        self.write("size.glsl", probe.shader(SIZE))
        for size in SIZES:
            for name, halvings in LAST.items():
                with self.subTest(size=size, scale=name):
                    view = self.view("size.glsl", "--size", option(size), "--scale", name)
                    drawn = tuple(int(length / 2 ** halvings) for length in size)
                    saved = png.read(view.save())
                    self.assertEqual((saved.width, saved.height), drawn)
                    if min(drawn) >= 32:
                        self.assertEqual(tuple(probe.read(saved, SIZE).values()), drawn)
                    self.assertEqual(view.place()["WIDTH"], size[0])
                    view.wait_for_title(f", scale {name}$" if name != "1" else r"(still|fps)$")
                    view.close()

    def test_keys_halve_and_double_within_the_limits(self):
        self.write("size.glsl", STRIPES)
        view = self.view("size.glsl", "--size", "320x160")
        for key, names in (("minus", ("1/2", "1/4", "1/8", "1/8")), ("equal", ("1/4", "1/2", None, "2", "2"))):
            for name in names:
                view.key(key)
                view.wait_for_title(f", scale {name}$" if name else " - still$")
        self.assertEqual(png.read(view.save()).width, 640)

    def test_the_picture_is_filtered_over_the_window(self):
        self.write("stripes.glsl", STRIPES)
        for size in SIZES:
            with self.subTest(size=size):
                view = self.view("stripes.glsl", "--size", option(size), "--scale", "2")
                # Two columns of the picture, 0 and 255, are one of the window.
                wait_for(lambda: all(abs(red - 127.5) < 2 for red in self.on_screen(view, 5)[0::3]), "the mean")
                for _ in range(3):
                    view.key("minus")
                view.wait_for_title(", scale 1/4$")
                # Green is 255 in the left half; the edge is as wide as a drawn pixel, which is four of the window's.
                wait_for(lambda: self.has_smooth_edge(view, size[0] // 2), "a smooth edge")
                view.close()

    def has_smooth_edge(self, view, middle: int) -> bool:
        greens = [*self.on_screen(view, 5)[1::3]][middle - 6:middle + 6]
        falls = greens == sorted(greens, reverse=True) and (greens[0], greens[-1]) == (255, 0)
        return falls and sum(0 < green < 255 for green in greens) >= 3

    def test_iMouse_is_in_drawn_pixels(self):
        self.write("mouse.glsl", probe.shader(MOUSE))
        for size in SIZES:
            with self.subTest(size=size):
                view = self.view("mouse.glsl", "--size", option(size), "--scale", "1/2")
                height = size[1]
                view.drag((50, height - 40), (120, height - 90))
                view.wait_until_told(MOUSE, lambda told: list(told.values()) == [60, 45, -25, -20])
                view.key("equal")
                view.wait_until_told(MOUSE, lambda told: list(told.values()) == [120, 90, -50, -40])
                view.key("equal")
                view.wait_until_told(MOUSE, lambda told: list(told.values()) == [240, 180, -100, -80])
                view.close()

    def test_saved_pictures_are_drawn_again(self):
        self.write("mouse.glsl", probe.shader(MOUSE | SIZE | {"time": "iTime"}))
        view = self.view("mouse.glsl", "--size", "500x260", "--scale", "1/2")
        view.drag((50, 40), (120, 90))
        view.wait_until_told(MOUSE, lambda told: told["iMouse.x"] == 60 and told["iMouse.z"] < 0)
        saved = view.save()
        self.succeed("capture", "--like", saved.name, "-o", "again.png")
        self.assertEqual(png.read(self.folder / "again.png").rows, png.read(saved).rows)

    def test_a_recording_is_replayed_at_the_size_drawn(self):
        self.write("mouse.glsl", probe.shader(MOUSE | SIZE))
        view = self.view("mouse.glsl", "--size", "500x260", "--scale", "1/2", "--record", "take.txt")
        view.key("equal")
        view.wait_for_words("^the scale cannot change while recording or replaying: ")
        view.drag((50, 40), (120, 90))
        view.wait_until_told(MOUSE, lambda told: told["iMouse.x"] == 60 and told["iMouse.z"] < 0)
        saved = view.save()
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        frame = saved.stem.split("-")[1]
        self.succeed("capture", "mouse.glsl", "--size", "250x130", "--input", "take.txt", "--frame", str(int(frame)),
                     "-o", "again.png")
        self.assertEqual(png.read(self.folder / "again.png").rows, png.read(saved).rows)

    def test_the_scale_is_stored_for_the_next_window(self):
        self.write("size.glsl", probe.shader(SIZE))
        state = {"XDG_STATE_HOME": str(self.folder / "state")}
        view = self.view("size.glsl", "--size", "400x200", **state)
        view.key("minus")
        view.wait_for_title(", scale 1/2$")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        view = self.view("size.glsl", **state)
        view.wait_for_words(r"^restored: .*scale 1/2; --fresh starts anew$")
        view.wait_until_told(SIZE, lambda told: list(told.values()) == [200, 100])
        view.close()
        view = self.view("size.glsl", "--scale", "2", **state)
        view.wait_until_told(SIZE, lambda told: list(told.values()) == [800, 400])

    def test_adaptive_falls_and_rises_to_hold_a_rate(self):
        """Whatever the machine: a millisecond is too short for the one, a second is long for the other."""
        self.write("slow.glsl", "void mainImage(out vec4 c, in vec2 p) { float x = iTime; for (int i = 0; i < 300; ++i) "
                                "x = sin(x + p.x); c = vec4(x); }\n")
        view = self.view("slow.glsl", "--size", "640x360", "--adaptive", "1000", "--plain")
        view.wait_for_words("^adaptive scale is on: it aims at 1000 fps$")
        view.wait_for_title(", scale 1/[248]$")
        view.key("a")
        view.wait_for_words("^adaptive scale is off: the scale stays at 1/[248]$")
        view.close()
        self.write("quick.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(iTime)); }\n")
        view = self.view("quick.glsl", "--size", "64x32", "--adaptive", "1", "--scale", "1/8", "--plain")
        view.wait_for_title(", scale 2$")
        view.key("minus")  # what somebody chooses stays
        view.wait_for_words("^adaptive scale is off: the scale stays at 2$")
        view.wait_for_title(" fps$")

    def test_invalid_scale_lists_the_valid_values(self):
        self.write("size.glsl", STRIPES)
        self.expect_failure(["view", "size.glsl", "--scale", "3"], 2,
                            "tidemark: error: --scale: give 1/8 or 1/4 or 1/2 or 1 or 2, not '3'")


if __name__ == "__main__":
    main()
