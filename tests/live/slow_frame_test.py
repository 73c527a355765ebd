"""Frames of some seconds are drawn in parts: the window answers meanwhile, and what comes of it is `capture`'s picture."""
import re

from support import osc, png, probe
from support.live import LiveTest, View, main, wait_for
from support.slow import rounds_that_take, slow_function, slow_shader

SIZE = ("--size", "320x160")
FRAME_SECONDS = 3
SMALL = {"size": "iResolution.x"}
COUNTED = {"count": "texelFetch(iChannel0, ivec2(0), 0).r", "frame": "float(iFrame)"}
COUNT = '#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0) + 1.0; }\n'


class SlowFrame(LiveTest):
    rounds = 0

    def measured(self) -> int:
        if not SlowFrame.rounds:
            SlowFrame.rounds = rounds_that_take(FRAME_SECONDS, self, lambda rounds: slow_shader(rounds, SMALL), *SIZE)
        return SlowFrame.rounds

    def start(self, values: dict[str, str] = SMALL, *options: str) -> View:
        """With its first frame under way."""
        self.write("a.glsl", slow_shader(self.measured(), values))
        view = View(self.screen, self.folder, "a.glsl", *SIZE, "--plain", *options, first_title=" - drawing ")
        self.addCleanup(view.close)
        return view

    def wait_for_a_frame(self, view: View) -> None:
        """The next frame's clock begins anew."""
        shares = [0.0]

        def begins_anew(title: re.Match) -> bool:
            shares.append(float(title[1]))
            return shares[-1] < shares[-2]

        while not begins_anew(view.wait_for_title(r" drawing \d+\.\d s, (\d+) %")):
            pass

    def wait_for_the_paused_frame(self, view: View) -> None:
        view.wait_for_title(" - drawing ")
        view.wait_for_title(r" - paused at ")

    def expect_picture_of_capture(self, view: View) -> png.Picture:
        saved = view.save()
        self.succeed("capture", "--like", saved.name, "-o", "again.png")
        picture = png.read(saved)
        self.assertEqual(picture.rows, png.read(self.folder / "again.png").rows)
        return picture

    def test_keys_respond_while_the_first_frame_is_drawn(self):
        view = self.start()
        view.key("h")
        view.wait_for_words("full screen; help")
        view.key("minus")  # it begins anew, a quarter as large
        view.wait_for_title(r" - drawing .*, scale 1/2\Z")
        view.key("s")
        view.wait_for_words("^no frame is drawn yet: the first one is saved$")
        view.key("c")
        view.wait_for_words("^no frame is drawn yet$")
        view.key("space")
        self.wait_for_the_paused_frame(view)
        view.wait_for_words(r"^saving a-\d+\.png$")
        self.assertEqual(self.expect_picture_of_capture(view).width, 160)

    def test_the_title_shows_the_running_time(self):
        view = self.start()
        earlier = view.wait_for_title(r"\Aa - tidemark - drawing (\d+\.\d) s, \d+ %")
        later = view.wait_for_title(r"\Aa - tidemark - drawing (\d+\.\d) s, \d+ %, Esc cancels\Z")
        self.assertGreater(float(later[1]), float(earlier[1]))

    def test_escape_cancels_the_frame_and_keeps_the_window(self):
        view = self.start()
        view.wait_for_title(", Esc cancels")
        self.screen.xdotool("key", "Escape", "Escape", "Escape")
        view.wait_for_words(r"^a\.glsl: frame cancelled, after \d+\.\d s, \d+ % drawn: press space to continue, - to draw smaller, "
                            r"or save a file of it; Esc twice closes the window$")
        view.wait_for_title(r"\Aa - tidemark - cancelled, space continues\Z")
        view.key("minus")
        view.wait_for_title(r" - drawing .*, scale 1/2\Z")
        self.wait_for_a_frame(view)
        self.assertEqual(self.expect_picture_of_capture(view).width, 160)

    def test_marks_are_off_for_slow_frames(self):
        view = self.start()
        view.key("space")
        self.wait_for_the_paused_frame(view)
        view.key("n")
        view.wait_for_words("^marks are off while a frame takes more than a second$")

    def test_resizing_restarts_the_frame(self):
        view = self.start()
        self.screen.xdotool("windowsize", str(view.window), "200", "100")
        view.key("space")
        self.wait_for_the_paused_frame(view)
        self.assertEqual(self.expect_picture_of_capture(view).width, 200)
        self.assertEqual(view.told(SMALL), {"size": 200})

    def start_counting(self, *options: str) -> View:
        """A scene that counts its frames: in its buffer, and by the window."""
        self.write("s/buffer_a.glsl", COUNT)
        self.write("s/image.glsl", slow_shader(self.measured(), COUNTED, '#iChannel0 "buffer_a.glsl"\n'))
        view = View(self.screen, self.folder, "s", *SIZE, "--plain", *options, first_title=" - drawing ")
        self.addCleanup(view.close)
        return view

    def test_a_cancelled_frame_leaves_buffers_unchanged(self):
        view = self.start_counting()
        self.wait_for_a_frame(view)
        view.wait_for_title(", Esc cancels")
        view.key("Escape")
        view.wait_for_title(" - cancelled, ")
        self.assertEqual(view.told(COUNTED), {"count": 1, "frame": 0})
        view.key("space")
        self.wait_for_a_frame(view)
        self.assertEqual(view.told(COUNTED), {"count": 2, "frame": 1})

    def test_frames_before_a_seek_target_are_drawn_in_parts(self):
        view = self.start_counting("--osc", "0")
        client = osc.Client(int(view.wait_for_words(r"^OSC: listening at \S+:(\d+)$")[1]))
        self.addCleanup(client.close)
        self.wait_for_a_frame(view)
        client.send("/time", 1000.0)
        view.wait_for_title(r" - stepping to frame 59999, Esc cancels\Z")
        view.key("h")
        view.wait_for_words("full screen; help")
        view.key("Escape")
        self.wait_for_the_paused_frame(view)
        told = view.told(COUNTED)
        self.assertEqual(told["count"], told["frame"] + 1)

    def test_a_reload_waits_for_an_endless_loop(self):
        self.write("a.glsl", slow_function(65000, 300) + "void mainImage(out vec4 c, in vec2 p) {\n"
                             "    c = vec4(p.y > 80.0 ? slow(p.x) : 0.0);\n}\n")
        view = View(self.screen, self.folder, "a.glsl", *SIZE, "--plain", first_title=" - drawing ")
        self.addCleanup(view.close)
        view.wait_for_words(" on take more than 2 s: ")
        self.write("a.glsl", probe.shader(SMALL))
        earlier = float(view.wait_for_title(r" - drawing (\d+\.\d) s, ")[1])
        wait_for(lambda: float(view.wait_for_title(r" - drawing (\d+\.\d) s, ")[1]) > earlier + 5, "the clock to go on")
        view.key("Escape")
        view.wait_for_words("^the driver cannot be stopped: its current work ends by itself$")
        while view.program.poll() is None:
            view.key("Escape")
        self.assertEqual(view.wait_for_end(), 0)

    def test_endless_loop(self):
        """Or as good as never: not in the small picture that is tried out in another process first. It is come upon
        when the frame's clock is on show already."""
        self.write("a.glsl", slow_function(self.measured()) + slow_function(65000, 300, "endless")
                   + "void mainImage(out vec4 c, in vec2 p) {\n"
                     "    c = vec4(p.y > 80.0 ? endless(p.x) : slow(p.x));\n}\n")
        view = View(self.screen, self.folder, "a.glsl", *SIZE, "--plain", first_title=" - drawing ")
        self.addCleanup(view.close)
        view.wait_for_words(r"^a\.glsl: \d+x\d+ pixels of Image from \d+,\d+ on take more than 2 s: a very long or endless loop; Esc cancels the frame, - draws smaller$")
        view.wait_for_title(r" - drawing ([3-9]|\d\d+)\.\d s, ")
        view.key("Escape")
        view.wait_for_words("^the driver cannot be stopped: its current work ends by itself$")
        view.wait_for_title(r"\Aa - tidemark - cancelled, waiting for the driver: \d+ s\Z")
        while view.program.poll() is None:  # one right behind the first is taken for the same
            view.key("Escape")
        self.assertEqual(view.wait_for_end(), 0)


if __name__ == "__main__":
    main()
