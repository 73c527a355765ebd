"""What a person does in the window, recorded and replayed: in the window and by capture."""
import signal

from support import png, probe
from support.live import LiveTest, Screen, View, main, wait_for

SIZE = ("--size", "200x100")
VALUES = probe.vector("iMouse", "xyzw") | {"camera": "iCamera[3].x", "toggled":
                                           "texelFetch(iChannel1, ivec2(65, 2), 0).r"}
SCENE = probe.shader(VALUES, 'uniform mat4 iCamera;\n#iChannel1 "keyboard"')


class Record(LiveTest):
    def test_capture_replays_a_recording(self):
        self.write("a.glsl", SCENE)
        view = self.view("a.glsl", *SIZE, "--record", "take.txt")
        view.save_key = "ctrl+s"
        view.key("ctrl+space")
        view.wait_for_title(" - paused at ")
        view.key("ctrl+Home")
        view.wait_for_title(r" - paused at 0\.0\d\d s$")  # the release of Ctrl is a frame of its own
        view.key("a")
        view.drag((100, 50), (60, 70))
        # Each save's Ctrl is a frame; the frame of the press, whose w is positive, is not the last.
        wanted = view.wait_until_told(VALUES, lambda told: (told["iMouse.x"], told["iMouse.z"]) == (60, -100) and
                                      told["iMouse.w"] < 0)
        self.assertEqual(wanted["toggled"], 1)
        self.screen.xdotool("key", "Escape", "Escape")
        self.assertEqual(view.wait_for_end(), 0)

        lines = (self.folder / "take.txt").read_text().splitlines()
        self.assertTrue(any("press left 100 50" in line for line in lines), lines)
        last = int(lines[-1].split()[0])
        done = self.succeed("capture", "a.glsl", *SIZE, "--input", "take.txt", "--frame", str(last + 1), "-o", "-")
        self.assertEqual(probe.read(png.from_raw(200, 100, done.stdout), VALUES), wanted)

    def test_saved_picture_equals_the_captured_frame(self):
        """However slowly the window draws: time goes by frames."""
        values = VALUES | {"time": "iTime", "delta": "iTimeDelta", "rate": "iFrameRate", "date": "iDate.w"}
        self.write("a.glsl", probe.shader(values, 'uniform mat4 iCamera;\n#iChannel1 "keyboard"'))
        view = self.view("a.glsl", *SIZE, "--fps", "7", "--record", "take.txt")
        view.save_key = "ctrl+s"
        view.key("a")
        view.drag((100, 50), (60, 70))
        saved = [view.save()]
        saved[0] = saved[0].rename(self.folder / saved[0].name.replace("a-", "first-"))
        view.key("ctrl+r")
        view.point(70, 70)
        saved.append(view.save())
        self.screen.xdotool("key", "Escape", "Escape")
        self.assertEqual(view.wait_for_end(), 0)
        for picture in saved:
            frame = int(picture.stem.split("-")[1])
            done = self.succeed("capture", "a.glsl", *SIZE, "--fps", "7", "--input", "take.txt", "--frame",
                                str(frame), "-o", "-")
            window, replayed = png.read(picture), png.from_raw(200, 100, done.stdout)
            self.assertEqual(probe.read(window, values), probe.read(replayed, values))
            self.assertAlmostEqual(probe.read(window, values)["time"], frame / 7, 5)
            self.assertEqual(window.rows, replayed.rows)

    def test_keys_of_the_window_are_not_recorded(self):
        for name, scene, keys, wanted in (
                ("plain", probe.shader({"time": "iTime"}), ["h", "r", "space", "s", "Right", "a"], ["camera reset"]),
                ("keyboard", SCENE, ["ctrl+h", "ctrl+shift+r", "r"],
                 ["keydown 17", "keyup 17", "keydown 17", "camera reset", "keyup 17", "keydown 82", "keyup 82"])):
            with self.subTest(name):
                self.write(f"{name}.glsl", scene)
                view = self.view(f"{name}.glsl", *SIZE, "--record", f"{name}.txt")
                for key in keys:
                    view.key(key)
                self.screen.xdotool("key", "Escape", "Escape", "Escape")  # the first one closes the help
                self.assertEqual(view.wait_for_end(), 0)
                lines = (self.folder / f"{name}.txt").read_text().splitlines()
                self.assertEqual([line.split(" ", 1)[1] for line in lines], wanted)

    def test_camera_reset_is_replayed(self):
        self.write("a.glsl", SCENE)
        self.write("take.txt", "0 wheel 3\n5 camera reset\n")
        told = []
        for frame in (4, 5):
            done = self.succeed("capture", "a.glsl", *SIZE, "--input", "take.txt", "--frame", str(frame), "-o", "-")
            told.append(probe.read(png.from_raw(200, 100, done.stdout), VALUES)["camera"])
        still = probe.read(png.from_raw(200, 100, self.succeed("capture", "a.glsl", *SIZE, "-o", "-").stdout), VALUES)
        self.assertNotEqual(told[0], told[1])
        self.assertEqual(told[1], still["camera"])

    def test_a_restart_discards_later_events(self):
        self.write("a.glsl", SCENE)
        view = self.view("a.glsl", *SIZE, "--record", "take.txt")
        view.save_key = "ctrl+s"
        view.drag((100, 50), (60, 70))
        view.wait_until_told(VALUES, lambda told: told["iMouse.x"] == 60)
        view.key("ctrl+space")
        view.wait_for_title(" - paused at ")
        view.key("ctrl+Home")
        view.wait_until_told(VALUES, lambda told: told["iMouse.x"] == 0)
        self.screen.xdotool("key", "Escape", "Escape")
        self.assertEqual(view.wait_for_end(), 0)
        self.assertNotIn("press", (self.folder / "take.txt").read_text())

    def test_window_replays_a_recording(self):
        self.write("a.glsl", SCENE)
        self.write("take.txt", "0 press left 10 20\n1 move 30 40\n2 release left\n2 keydown 65\n")
        view = self.view("a.glsl", *SIZE, "--input", "take.txt")
        view.save_key = "ctrl+s"
        view.wait_until_told(VALUES, lambda told: told["iMouse.x"] == 30 and told["iMouse.w"] == -20 and
                             told["iMouse.z"] == -10 and told["toggled"] == 1)

    def test_interrupt_keeps_the_recording(self):
        self.write("a.glsl", SCENE)
        for stop in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(stop=stop.name):
                view = self.view("a.glsl", *SIZE, "--record", f"{stop.name}.txt")
                view.key("ctrl+space") # a paused window sleeps until something happens
                view.wait_for_title(" - paused at ")
                paused = view.title()
                view.drag((100, 50), (60, 70))
                view.key("ctrl+Right")
                wait_for(lambda: view.title() != paused, "the step after the drag")
                view.program.send_signal(stop)
                self.assertEqual(view.wait_for_end(), 130)
                self.assertRegex((self.folder / f"{stop.name}.txt").read_text(), r"(?m)^\d+ press left 100 50$")

    def drag_once(self, view: View, paused: bool) -> None:
        view.save_key = "ctrl+s"
        if paused: # it sleeps until something happens
            view.key("ctrl+space")
            view.wait_for_title(" - paused at ")
        view.drag((100, 50), (60, 70))
        view.wait_until_told(VALUES, lambda told: told["iMouse.x"] == 60)

    def test_loss_of_the_display_keeps_the_recording(self):
        self.write("a.glsl", SCENE)
        for paused in (False, True):
            with self.subTest(paused=paused):
                screen = Screen()
                self.addCleanup(screen.close)
                view = View(screen, self.folder, "a.glsl", *SIZE, "--record", f"{paused}.txt")
                self.addCleanup(view.close)
                self.drag_once(view, paused)
                screen.server.kill()
                self.assertEqual(view.wait_for_end(), 77)
                self.assertTrue(view.stderr().endswith("tidemark: error: the connection to the display is lost\n"), view.stderr())
                self.assertRegex((self.folder / f"{paused}.txt").read_text(), r"(?m)^\d+ press left 100 50$")

    def test_destruction_of_the_window_keeps_the_recording(self):
        self.write("a.glsl", SCENE)
        for paused in (False, True):
            with self.subTest(paused=paused):
                view = self.view("a.glsl", *SIZE, "--record", f"{paused}.txt")
                self.drag_once(view, paused)
                view.screen.xdotool("windowclose", str(view.window))
                self.assertEqual(view.wait_for_end(), 77)
                self.assertTrue(view.stderr().endswith("tidemark: error: another program has destroyed the window\n"), view.stderr())
                self.assertRegex((self.folder / f"{paused}.txt").read_text(), r"(?m)^\d+ press left 100 50$")

    def test_recording_over_a_file_of_the_scene(self):
        for text in (SCENE, "not yet a scene"):
            with self.subTest(text):
                scene = self.write("a.glsl", text)
                done = self.run_program("view", "a.glsl", "--record", "a.glsl")
                self.assertEqual(done.stderr, "tidemark: error: cannot write 'a.glsl': this command reads that file; give "
                                              "another name with -o\n")
                self.assertEqual(done.returncode, 4)
                self.assertEqual(scene.read_text(), text)

    def test_saved_picture_does_not_follow_a_link(self):
        self.write("a.glsl", SCENE)
        self.write("victim", "before")
        for frame in range(3000):
            (self.folder / f"a-{frame:05}.png").symlink_to("victim")
        view = self.view("a.glsl", *SIZE)
        view.key("ctrl+s")
        name = view.wait_for_words(r"saving (a-\d{5}-2\.png)")[1] # a link has the frame's own name
        self.screen.xdotool("key", "Escape", "Escape")
        view.wait_for_end()
        self.assertEqual(png.read(self.folder / name).width, int(SIZE[1].split("x")[0]))
        self.assertEqual((self.folder / "victim").read_text(), "before")

    def test_unwritable_recording_is_an_error_at_the_start(self):
        self.write("a.glsl", "not GLSL")
        self.expect_failure(["view", "a.glsl", "--record", "no/such/take.txt"], 4,
                            "tidemark: error: cannot write 'no/such/take.txt': No such file or directory")


if __name__ == "__main__":
    main()
