"""The picture alone in a second window, and a picture that stays while time goes on."""
from support import png
from support.live import LiveTest, Screen, View, main, wait_for
from support.program import environment

PATTERN = """void mainImage(out vec4 c, in vec2 p) {
    c = vec4(fract(p.x / 97.0), fract(sin(dot(p, vec2(91.7, 3.1))) * 4311.3), fract(iTime * 0.31), 1.0);
}
"""
SIZES = ((300, 160), (520, 260))


class Output(LiveTest):
    def window(self, title: str) -> int:
        return int(wait_for(lambda: self.screen.xdotool("search", "--onlyvisible", "--name", title), title))

    def open(self, *options: str) -> View:
        """Paused at 0, in the lower right of the screen; nobody but us says where the other window goes."""
        view = self.view("a.glsl", "--position", "720,500", *options, first_title=None)
        view.output = self.window("^a - tidemark output$")
        view.window = self.window("^a - tidemark - ")
        view.point(5, 5)
        view.wait_for_title(" fps")
        view.restart_paused()
        return view

    def rows(self, view: View, window: int) -> list[bytes]:
        lines = self.screen.xdotool("getwindowgeometry", "--shell", str(window)).splitlines()
        place = {name: int(value) for name, _, value in (line.partition("=") for line in lines)}
        return self.screen.rows(place["X"], place["Y"], place["WIDTH"], place["HEIGHT"])

    def wait_for_picture(self, view: View, window: int, wanted: list[bytes]) -> None:
        wait_for(lambda: view.running() and self.rows(view, window) == wanted, "the picture in that window")

    def test_shows_the_picture_without_panels(self):
        self.write("a.glsl", PATTERN)
        for width, height in SIZES:
            with self.subTest(width=width):
                view = self.open("--size", f"{width}x{height}", "--output-window")
                picture = png.read(view.save()).rows
                self.wait_for_picture(view, view.output, picture)
                self.wait_for_picture(view, view.window, picture)
                view.key("h")  # the help lies over the picture
                wait_for(lambda: self.rows(view, view.window) != picture, "the help")
                self.wait_for_picture(view, view.output, picture)
                view.close()

    def test_keeps_the_aspect_ratio(self):
        self.write("a.glsl", PATTERN)
        view = self.open("--size", "300x160", "--output-window")
        picture = png.read(view.save()).rows
        self.screen.xdotool("windowsize", str(view.output), "400", "160")
        self.wait_for_picture(view, view.output, [bytes(150) + row + bytes(150) for row in picture])
        self.screen.xdotool("windowsize", str(view.output), "300", "200")
        black = [bytes(900)] * 20
        self.wait_for_picture(view, view.output, black + picture + black)

    def test_follows_the_scale(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(mod(floor(p.x), 2.0), fract(iTime), 0, 1); }")
        view = self.open("--size", "300x160", "--output-window")
        view.key("equal")
        wait_for(lambda: all(abs(red - 127.5) < 2 for red in self.rows(view, view.output)[9][0::3]), "the mean")

    def test_closing_keeps_the_main_window(self):
        self.write("a.glsl", PATTERN)
        view = self.open("--size", "300x160", "--output-window")
        self.screen.ask_to_close(view.output)
        wait_for(lambda: not self.screen.xdotool("search", "--onlyvisible", "--name", "tidemark output"), "its end")
        view.key("Right")
        view.wait_for_title(r" - paused at 0\.017 s$")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)

    def test_full_screen_on_a_monitor(self):
        self.screen = Screen()  # once a program has hidden the pointer, the server draws it for all that follow
        self.addCleanup(self.screen.close)
        self.write("a.glsl", PATTERN)
        view = self.view("a.glsl", "--size", "300x160", "--output-monitor", "1", first_title=None)
        view.window = self.window("^a - tidemark output$")
        wait_for(lambda: (view.place()["WIDTH"], view.place()["HEIGHT"]) == (1280, 800), "the whole screen")
        view.point(640, 400)
        # Pictures of 300x160 on 1280x800 are 682.7 high: 58 rows are black above, as many below.
        wait_for(lambda: [not any(row) for row in self.screen.rows(0, 0, 1280, 800)][50:66:14] == [True, False], "black")
        view.quit()  # keys are the first window's
        self.assertEqual(view.wait_for_end(), 0)

    def test_unknown_monitor(self):
        self.write("a.glsl", PATTERN)
        self.expect_failure(["view", "a.glsl", "--output-monitor", "2"], 2,
                            "tidemark: error: --output-monitor 2: there is no such monitor: monitor 1 is 1280x800 at 0,0",
                            env=environment(DISPLAY=self.screen.display))


class Freeze(LiveTest):
    def rows(self, view: View) -> list[bytes]:
        place = view.place()
        return self.screen.rows(place["X"], place["Y"], place["WIDTH"], place["HEIGHT"])

    def test_the_picture_freezes_and_time_advances(self):
        for width, height in SIZES:
            with self.subTest(width=width):
                self.write("a.glsl", PATTERN)
                view = self.view("a.glsl", "--size", f"{width}x{height}")
                view.key("z")
                view.wait_for_title(", frozen$")
                path = view.save()
                saved, frame = png.read(path), int(path.stem.split("-")[1])
                wait_for(lambda: self.rows(view) == saved.rows, "the frozen picture")
                self.succeed("capture", "--like", path.name, "-o", "like.png")
                self.assertEqual(png.read(self.folder / "like.png").rows, saved.rows)
                self.write("a.glsl", PATTERN.replace("97.0", "31.0"))  # it outlives a reload
                view.wait_for_words("^reloaded in ")
                self.assertEqual(self.rows(view), saved.rows)
                self.assertEqual(png.read(view.save()).rows, saved.rows)
                view.key("z")
                view.wait_for_title(" fps$")
                path = view.save()
                self.assertGreater(int(path.stem.split("-")[1]), frame)
                wait_for(lambda: self.rows(view) != saved.rows, "the next picture")
                view.close()

    def test_the_picture_stays_when_the_scale_changes(self):
        self.write("a.glsl", PATTERN)
        view = self.view("a.glsl", "--size", "300x160")
        view.key("z")
        view.wait_for_title(", frozen$")
        saved = png.read(view.save())
        view.key("minus")
        view.wait_for_title(", scale 1/2, frozen$")
        wait_for(lambda: self.rows(view) == saved.rows, "the frozen picture")


if __name__ == "__main__":
    main()
