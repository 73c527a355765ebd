"""The window: what it shows, its keys, its size, its end."""
import tempfile

from support import png, probe
from support.live import LiveTest, View, main, wait_for

CLOCK = {"iTime": "iTime", "iTimeDelta": "iTimeDelta", "iFrame": "float(iFrame)"}
SIZE = probe.vector("iResolution", "xyz")
PATTERN = """void mainImage(out vec4 c, in vec2 p) {
    c = vec4(p.x / 255.0, fract(sin(dot(p, vec2(91.7, 3.1))) * 4311.3), fract(iTime * 0.3 + float(iFrame) * 0.21), 0.5);
}
"""


class Picture(LiveTest):
    def test_title_names_the_scene(self):
        self.write("wave.glsl", PATTERN)
        view = self.view("wave.glsl", "--size", "200x100")
        self.assertRegex(view.title(), r"\Awave - tidemark - \d+ fps\Z")
        view.pause()
        self.assertRegex(view.title(), r"\Awave - tidemark - paused at \d+\.\d{3} s\Z")
        self.assertEqual(view.stderr(), "")

    def test_screen_saved_picture_and_capture_are_equal(self):
        self.write("wave.glsl", PATTERN)
        view = self.view("wave.glsl", "--size", "200x100")
        view.restart_paused()
        saved = png.read(view.save())
        self.assertEqual((saved.width, saved.height), (200, 100))
        self.assertEqual(saved.text["tidemark:Scene"], "wave.glsl")
        self.assertEqual((saved.text["tidemark:Frame"], saved.text["tidemark:iTime"]), ("0", "0"))
        self.succeed("capture", "wave.glsl", "--size", "200x100", "--frame", "0", "-o", "headless.png")
        self.assertEqual(png.read(self.folder / "headless.png").sha256(), saved.sha256())
        place = view.place()
        wait_for(lambda: self.screen.rows(place["X"], place["Y"], 200, 100) == saved.rows, "the picture on the screen")

    def test_opengl_es_shows_the_same(self):
        """The overlay draws with OpenGL ES, too: the help covers a part of the picture."""
        self.write("wave.glsl", PATTERN)
        self.write("next.glsl", '#iChannel0 "wave.glsl"\nvoid mainImage(out vec4 c, in vec2 p) {'
                                " c = texelFetch(iChannel0, ivec2(p), 0).bgra; }\n")
        view = self.view("next.glsl", "--size", "200x100", "--es")
        view.restart_paused()
        saved = png.read(view.save())
        self.succeed("capture", "next.glsl", "--size", "200x100", "--frame", "0", "-o", "headless.png")
        self.assertEqual(png.read(self.folder / "headless.png").sha256(), saved.sha256())
        place = view.place()
        shown = lambda: self.screen.rows(place["X"], place["Y"], 200, 100)
        wait_for(lambda: shown() == saved.rows, "the picture on the screen")
        self.assertNotIn("error", view.stderr())
        view.key("F1")
        wait_for(lambda: shown() != saved.rows, "the help over the picture")

    def test_a_later_frame_equals_capture(self):
        self.write("wave.glsl", PATTERN.replace("iTime * 0.3 + ", ""))
        view = self.view("wave.glsl", "--size", "200x100", "--fps", "10")
        view.restart_paused()
        for step in range(1, 4):
            view.key("Right")
            view.wait_for_title(rf" - paused at 0\.{step}00 s$")
        path = view.save()
        self.assertEqual(path.name, "wave-00003.png")
        self.assertEqual(png.read(path).text["tidemark:Frame"], "3")
        self.succeed("capture", "wave.glsl", "--size", "200x100", "--frame", "3", "--fps", "10", "-o", "headless.png")
        self.assertEqual(png.read(self.folder / "headless.png").sha256(), png.read(path).sha256())

    def test_a_scene_in_double_precision(self):
        self.write("wave.glsl", PATTERN.replace("iTime * 0.3", "1e9 + p.x * 0.37"))
        view = self.view("wave.glsl", "--size", "64x32", "--precision", "double")
        view.restart_paused()
        saved = png.read(view.save()).sha256()
        pictures = []
        for precision in ("single", "double"):
            self.succeed("capture", "wave.glsl", "--size", "64x32", "--precision", precision, "-o", "headless.png")
            pictures.append(png.read(self.folder / "headless.png").sha256())
        self.assertNotEqual(pictures[0], pictures[1])
        self.assertEqual(saved, pictures[1])

    def test_default_size(self):
        self.write("size.glsl", probe.shader(SIZE))
        self.assertEqual(list(self.view("size.glsl").told(SIZE).values()), [640, 360, 1])

    def test_a_file_states_its_size(self):
        text = probe.shader(SIZE, "#iSize 300x120")
        self.write("said.glsl", text)
        view = self.view("said.glsl")
        self.assertEqual(list(view.told(SIZE).values()), [300, 120, 1])
        self.screen.xdotool("windowsize", str(view.window), "200", "100")
        view.wait_until_told(SIZE, lambda told: list(told.values()) == [200, 100, 1])
        self.write("said.glsl", text.replace("300x120", "310x130") + "// saved\n")
        view.wait_for_words("reloaded in")
        self.assertEqual(list(view.told(SIZE).values()), [200, 100, 1])
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        view = self.view("said.glsl")
        self.assertEqual(list(view.told(SIZE).values()), [310, 130, 1])
        view.close()
        self.assertEqual(list(self.view("said.glsl", "--size", "90x40").told(SIZE).values()), [90, 40, 1])

    def test_resize_changes_iResolution(self):
        self.write("size.glsl", probe.shader(SIZE))
        view = self.view("size.glsl", "--size", "200x100")
        self.assertEqual(list(view.told(SIZE).values()), [200, 100, 1])
        for width, height in ((320, 77), (150, 300)):
            self.screen.xdotool("windowsize", str(view.window), str(width), str(height))
            view.wait_until_told(SIZE, lambda told: list(told.values()) == [width, height, 1])
            saved = png.read(view.save())
            self.assertEqual((saved.width, saved.height), (width, height))


class Keys(LiveTest):
    def start(self, *options: str):
        self.write("clock.glsl", probe.shader(CLOCK))
        return self.view("clock.glsl", "--size", "200x100", *options)

    def test_space_pauses_and_resumes(self):
        view = self.start()
        view.pause()
        first = view.told(CLOCK)
        self.assertEqual(view.told(CLOCK), first)
        view.key("space")
        view.wait_for_title(" fps$")
        view.wait_until_told(CLOCK, lambda told: told["iTime"] > first["iTime"] and told["iFrame"] > first["iFrame"])

    def test_left_and_right_step_by_a_frame_and_pause(self):
        view = self.start("--fps", "8")
        view.key("Right")
        view.wait_for_title(" - paused at ")
        start = view.told(CLOCK)
        for key, frames in (("Right", 1), ("Right", 2), ("Left", 1), ("Left", 0)):
            view.key(key)
            wanted = {"iTime": start["iTime"] + frames / 8, "iFrame": start["iFrame"] + frames}
            told = view.wait_until_told(CLOCK, lambda told: told["iFrame"] == wanted["iFrame"])
            self.assertAlmostEqual(told["iTime"], wanted["iTime"], places=5)

    def test_home_restarts(self):
        view = self.start()
        view.wait_until_told(CLOCK, lambda told: told["iTime"] > 0.5)
        view.restart_paused()
        told = view.told(CLOCK)
        self.assertEqual((told["iTime"], told["iFrame"]), (0, 0))
        view.key("Left")  # there is nothing before the first frame
        self.assertEqual(view.told(CLOCK)["iTime"], 0)

    def test_s_names_the_saved_file(self):
        view = self.start()
        view.restart_paused()
        path = view.save()
        self.assertEqual(path.name, "clock-00000.png")
        view.wait_for_words(r"\Asaving clock-00000\.png\n\Z")

    def test_s_reports_an_unwritable_folder_and_continues(self):
        self.write("clock.glsl", probe.shader(CLOCK))
        gone = self.folder / "gone"
        gone.mkdir()
        view = View(self.screen, gone, str(self.folder / "clock.glsl"), "--size", "200x100")
        self.addCleanup(view.close)
        view.restart_paused()
        gone.rmdir()
        view.key("s")
        view.wait_for_words(r"^saving clock-00000\.png$")
        view.quit()
        view.wait_for_end()
        self.assertIn("tidemark: error: cannot write 'clock-00000.png': No such file or directory", view.stderr())

    def test_s_replaces_no_picture(self):
        view = self.start()
        view.restart_paused()
        (self.folder / "clock-00000.png").write_text("another program's")
        view.key("s")
        view.wait_for_words(r"^saving clock-00000-2\.png$")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        self.assertEqual(png.read(self.folder / "clock-00000-2.png").width, 200)
        self.assertEqual((self.folder / "clock-00000.png").read_text(), "another program's")

    def test_a_scene_from_standard_input(self):
        text = probe.shader({"time": "iTime"})
        with tempfile.TemporaryFile() as scene:
            scene.write(text.encode())
            scene.seek(0)
            view = View(self.screen, self.folder, "-", "--size", "200x100", text=scene)
            self.addCleanup(view.close)
            view.wait_for_title(r"^- - tidemark - |^stdin - tidemark - ")
            for _ in range(2):
                view.key("s")
            pictures = lambda: sorted(self.folder.glob("stdin-*.png"))
            wait_for(lambda: len(pictures()) == 2, "two pictures")
            view.key("k")
            view.wait_for_words("^kept view 1: ")
            view.quit()
            self.assertEqual(view.wait_for_end(), 0)
            self.assertEqual(self.files(), {picture.name for picture in pictures()})

    def test_h_prints_the_keys(self):
        view = self.start()
        view.key("h")
        for words in ("drag ", "wheel, ", "space; left, right ", "Home; V ", "S  ", "Tab; ", "H, F1 ", "Esc "):
            view.wait_for_words(words)

    def test_f_toggles_full_screen(self):
        view = self.start()
        view.key("f")
        view.wait_until_told(CLOCK, lambda told: view.place()["WIDTH"] == 1280 and view.place()["HEIGHT"] == 800)
        wait_for(lambda: png.read(view.save()).width == 1280, "the picture to fill the screen")
        view.key("f")
        wait_for(lambda: png.read(view.save()).width == 200, "the window to be as before")

    def test_escape_closes_the_window(self):
        view = self.start()
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        self.assertEqual(view.stderr(), "")

    def test_the_close_button_closes_the_window(self):
        view = self.start()
        self.screen.ask_to_close(view.window)
        self.assertEqual(view.wait_for_end(), 0)

    def test_escape_right_after_s_leaves_a_whole_picture(self):
        view = self.start()
        view.restart_paused()
        self.screen.xdotool("key", "s", "Escape", "Escape")
        self.assertEqual(view.wait_for_end(), 0)
        self.assertEqual(png.read(self.folder / "clock-00000.png").width, 200)


if __name__ == "__main__":
    main()
