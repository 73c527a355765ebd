"""`view --midi`: controllers of a device are learned, turn knobs, and are remembered. The device is a pipe."""
import os

from support import png, probe
from support.live import main
from support.overlay import MARGIN, PADDING, PANEL_WIDTH, OverlayTest, row_centre
from support.program import environment

SIZE = ("--size", "640x360")
VALUES = {"height": "height"} | probe.vector("tint", "xyz")
SCENE = probe.shader(VALUES, "#iUniform float height = 0.5 in { 0.0, 2.0 }\n"
                             "#iUniform color3 tint = color3(0.25, 0.5, 0.75)\n")
HEIGHT, TINT = 1, 2
MENU_ROW = 17  # points


class Midi(OverlayTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)
        os.mkfifo(self.folder / "device")
        self.device = os.open(self.folder / "device", os.O_RDWR)
        self.addCleanup(os.close, self.device)
        self.state = str(self.folder / "state")

    def midi_view(self, *options):
        return self.open("a.glsl", *SIZE, "--midi", "./device", *options, XDG_STATE_HOME=self.state)

    def move(self, *data: int) -> None:
        os.write(self.device, bytes([0xB0, *data]))

    def learn(self, view, row: int, entry: int = 0) -> None:
        """By an entry of the menu of the name at the end of a row."""
        x, y = MARGIN + PADDING + 0.65 * (PANEL_WIDTH - 2 * PADDING), row_centre(row)
        before = view.picture()
        view.point(*view.at(x, y))
        view.button(3, True)
        view.button(3, False)
        view.wait_for_change(before)
        menu = view.picture()
        view.click(x + 30, y + PADDING + MENU_ROW * entry + MENU_ROW // 2)
        view.wait_for_change(menu)

    def leave(self, view) -> None:
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)

    def learned(self, *options):
        view = self.midi_view(*options)
        view.show_controls()
        self.move(7, 100)
        view.wait_for_words(r"^MIDI: controller 7 controls nothing: right-click a knob's name in the "
                            r"controls \(Tab\), then move the controller$")
        self.learn(view, HEIGHT)
        self.move(7, 127)
        view.wait_for_words("^MIDI: controller 7 controls height$")
        view.wait_until_told(VALUES, lambda told: told["height"] == 2)
        self.learn(view, TINT, entry=1)
        self.move(8, 0)
        view.wait_until_told(VALUES, lambda told: list(told.values()) == [2, 0.25, 0, 0.75])
        return view

    def test_assignments_are_learned_and_stored(self):
        view = self.learned()
        self.move(7, 0, 8, 127)
        view.wait_until_told(VALUES, lambda told: list(told.values()) == [0, 0.25, 1, 0.75])
        self.leave(view)
        self.leave(self.open("a.glsl", XDG_STATE_HOME=self.state))  # one without a device keeps it
        view = self.midi_view()
        self.move(7, 127)
        view.wait_until_told(VALUES, lambda told: list(told.values()) == [2, 0.25, 1, 0.75])
        view.wait_for_title("fps|still")
        self.learn(view, HEIGHT, entry=1)  # forget
        self.move(7, 0)
        view.wait_for_words("^MIDI: controller 7 controls nothing")
        self.assertEqual(view.told(VALUES)["height"], 2)

    def test_recorded_run_replays_to_the_same_bytes(self):
        self.leave(self.learned())
        view = self.midi_view("--record", "take.txt")
        for value in range(0, 128, 8):
            self.move(7, value, 8, 127 - value)
        view.wait_until_told(VALUES, lambda told: abs(told["height"] - 2 * 120 / 127) < 1e-6)
        view.pause()
        picture = view.save()
        self.leave(view)
        frame = int(picture.stem.split("-")[1])
        self.succeed("capture", "a.glsl", *SIZE, "--input", "take.txt", "--frame", str(frame), "-o", "b.png")
        self.assertEqual(png.read(self.folder / "b.png").rows, png.read(picture).rows)

    def test_a_file_of_bytes_is_a_device_that_ends(self):
        (self.folder / "bytes").write_bytes(bytes([0xB0, 3, 1]))
        view = self.open("a.glsl", *SIZE, "--midi", "./bytes")
        view.wait_for_words("^MIDI: controller 3 controls nothing")
        view.save()

    def test_missing_device_is_an_error(self):
        for name, words in (("./missing", "cannot listen to MIDI from './missing': No such file or directory"),
                            ("no such port", "cannot listen to MIDI: ")):
            done = self.run_program("view", "a.glsl", "--midi", name, env=environment(DISPLAY=self.screen.display))
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("tidemark: error: " + words, done.stderr)


if __name__ == "__main__":
    main()
