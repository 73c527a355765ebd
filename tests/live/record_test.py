"""What a person does in the window, recorded and replayed: in the window and by capture."""
import signal

from support import png, probe
from support.live import LiveTest, main

SIZE = ("--size", "200x100")
VALUES = probe.vector("iMouse", "xyzw") | {"camera": "iCamera[3].x", "toggled":
                                           "texelFetch(iChannel1, ivec2(65, 2), 0).r"}
SCENE = probe.shader(VALUES, 'uniform mat4 iCamera;\n#iChannel1 "keyboard"')


class Record(LiveTest):
    def test_capture_replays_what_was_recorded(self):
        self.write("a.glsl", SCENE)
        view = self.view("a.glsl", *SIZE, "--record", "take.txt")
        view.save_key = "ctrl+s"
        view.key("ctrl+space")
        view.wait_for_title(" - paused at ")
        view.key("ctrl+Home")
        view.wait_for_title(r" - paused at 0\.000 s$")
        view.key("a")
        view.drag((100, 50), (60, 70))
        wanted = view.wait_until_told(VALUES, lambda told: told["iMouse.x"] == 60 and told["iMouse.z"] == -100)
        self.assertEqual(wanted["toggled"], 1)
        view.key("Escape")
        self.assertEqual(view.wait_for_end(), 0)

        lines = (self.folder / "take.txt").read_text().splitlines()
        self.assertTrue(any("press left 100 50" in line for line in lines), lines)
        last = int(lines[-1].split()[0])
        done = self.succeed("capture", "a.glsl", *SIZE, "--input", "take.txt", "--frame", str(last + 1), "-o", "-")
        self.assertEqual(probe.read(png.from_raw(200, 100, done.stdout), VALUES), wanted)

    def test_window_replays_a_recording(self):
        self.write("a.glsl", SCENE)
        self.write("take.txt", "0 press left 10 20\n1 move 30 40\n2 release left\n2 keydown 65\n")
        view = self.view("a.glsl", *SIZE, "--input", "take.txt")
        view.save_key = "ctrl+s"
        view.wait_until_told(VALUES, lambda told: told["iMouse.x"] == 30 and told["iMouse.w"] == -20 and
                             told["iMouse.z"] == -10 and told["toggled"] == 1)

    def test_interrupted_window_keeps_what_was_recorded(self):
        self.write("a.glsl", SCENE)
        for stop in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(stop=stop.name):
                view = self.view("a.glsl", *SIZE, "--record", f"{stop.name}.txt")
                view.key("ctrl+space") # a paused window sleeps until something happens
                view.wait_for_title(" - paused at ")
                view.drag((100, 50), (60, 70))
                view.key("ctrl+Right")
                view.program.send_signal(stop)
                self.assertEqual(view.wait_for_end(), 130)
                self.assertRegex((self.folder / f"{stop.name}.txt").read_text(), r"(?m)^\d+ press left 100 50$")

    def test_recording_that_cannot_be_written_is_an_error_at_the_start(self):
        self.write("a.glsl", "not GLSL")
        self.expect_failure(["view", "a.glsl", "--record", "no/such/take.txt"], 4,
                            "tidemark: error: cannot write 'no/such/take.txt': No such file or directory")


if __name__ == "__main__":
    main()
