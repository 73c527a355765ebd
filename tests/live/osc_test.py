"""`view --osc`: knobs and time from the network, recorded and replayed."""
import shutil
import subprocess

from support import osc, png, probe
from support.live import LiveTest, main
from support.program import environment

SIZE = ("--size", "200x100")
VALUES = {"height": "height", "count": "float(count)"} | probe.vector("tint", "xyz")
KNOBS = ("#iUniform float height = 0.5 in { 0.0, 2.0 }\n#iUniform int count = 2 in { 0, 9 }\n"
         "#iUniform color3 tint = color3(0.25, 0.5, 0.75)\n")
SCENE = probe.shader(VALUES, KNOBS)


class Osc(LiveTest):
    def osc_view(self, scene, *options):
        """The window, and a client of the port that it chose."""
        view = self.view(scene, *SIZE, "--osc", "0", *options)
        client = osc.Client(int(view.wait_for_words(r"^OSC: listening at 127\.0\.0\.1:(\d+)$")[1]))
        self.addCleanup(client.close)
        return view, client

    def test_knobs(self):
        self.write("a.glsl", SCENE)
        view, client = self.osc_view("a.glsl")
        client.send("/knob/height", 1.25)
        client.send("/knob/count", 6.8)  # a fader that knows no whole numbers
        client.send("/knob/tint", 0.5, 0.25, 1.0)
        view.wait_until_told(VALUES, lambda told: list(told.values()) == [1.25, 7, 0.5, 0.25, 1])
        client.send_packet(osc.bundle(osc.message("/knob/tint/r", 0.0), osc.bundle(osc.message("/knob/tint/z", 0.75)),
                                      osc.message("/knob/height", 2), osc.message("/knob/count", "default")))
        view.wait_until_told(VALUES, lambda told: list(told.values()) == [2, 2, 0, 0.25, 0.75])

    def test_messages_after_a_flood_arrive(self):
        self.write("a.glsl", SCENE)
        view, client = self.osc_view("a.glsl")
        for i in range(5000):
            client.send("/knob/height", i / 5000)

        def arrived(told):
            client.send("/knob/height", 1.25)  # UDP loses packets of a flood, the last one too
            return told["height"] == 1.25

        view.wait_until_told(VALUES, arrived)

    def test_oscsend(self):
        """As people send it."""
        if not shutil.which("oscsend"):
            self.skipTest("liblo-tools is not installed")
        self.write("a.glsl", SCENE)
        view = self.view("a.glsl", *SIZE, "--osc", "localhost:0")
        port = view.wait_for_words(r"^OSC: listening at \S+:(\d+)$")[1]
        subprocess.run(["oscsend", "osc.udp://127.0.0.1:" + port, "/knob/height", "f", "0.125"], check=True)
        view.wait_until_told(VALUES, lambda told: told["height"] == 0.125)

    def test_time(self):
        self.write("a.glsl", probe.shader({"time": "iTime"}))
        view, client = self.osc_view("a.glsl")
        client.send("/play", 0)
        view.wait_for_title(" - paused at ")
        client.send("/time", 2.5)
        view.wait_for_title(r" - paused at 2\.500 s$")
        self.assertEqual(view.told({"time": "iTime"}), {"time": 2.5})
        client.send("/play", True)
        view.wait_for_title(r" fps$")
        client.send("/play")  # it does already
        client.send("/play", False)
        view.wait_for_title(" - paused at ")

    def test_errors_are_reported_once(self):
        self.write("a.glsl", SCENE)
        view, client = self.osc_view("a.glsl")
        for _ in range(3):
            client.send("/knob/hieght", 1.0)
            client.send("/knob/tint/w", 1.0)
            client.send("/knob/height", "much")
            client.send("/fader/1", 1.0)
            client.send("/time", -1.0)
            client.send_packet(b"")
            client.send_packet(b"not OSC")
            client.send_packet(osc.message("/knob/height", 1.0)[:-3])
            client.send_packet(osc.bundle(osc.message("/knob/height", 1.5))[:-1])
        client.send("/knob/height", 0.75)
        view.wait_until_told(VALUES, lambda told: told["height"] == 0.75)
        said = [line for line in view.stderr().splitlines() if "OSC: listening" not in line and "sav" not in line]
        self.assertEqual(said, [
            "OSC: the scene has no knob 'hieght': did you mean 'height'?",
            "OSC: tint (color3) has no component 'w'",
            "OSC: 'much' is not a value for height (float): give a number",
            "OSC: unknown address '/fader/1': send /knob/NAME, /time or /play",
            "OSC: /time takes one number of seconds, 0 or more",
            "OSC: ignored: a packet that is not OSC",
        ])

    def test_recorded_run_replays_to_the_same_bytes(self):
        self.write("a.glsl", probe.shader(VALUES | {"time": "iTime"}, KNOBS))
        view, client = self.osc_view("a.glsl", "--record", "take.txt")
        for step in range(20):
            client.send("/knob/height", step / 7)
            client.send("/knob/tint/g", step / 20)
        client.send("/time", 3.0)
        view.wait_until_told(VALUES | {"time": "iTime"}, lambda told: told["time"] >= 3)
        client.send("/knob/height", 0.1)
        view.wait_until_told(VALUES, lambda told: abs(told["height"] - 0.1) < 1e-6)
        client.send("/play", 0)
        view.wait_for_title(" - paused at ")
        picture = view.save()
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        self.assertRegex((self.folder / "take.txt").read_text(), r"(?m)^\d+ set height=0\.1$")
        frame = int(picture.stem.split("-")[1])
        for frames in (str(frame), f"{frame - 3}-{frame}"):
            self.succeed("capture", "a.glsl", *SIZE, "--input", "take.txt", "--frames", frames, "-o", "b-%05d.png")
            self.assertEqual(png.read(self.folder / f"b-{frame:05}.png").rows, png.read(picture).rows)

    def test_a_taken_port_is_an_error(self):
        self.write("a.glsl", SCENE)
        view, client = self.osc_view("a.glsl")
        port = client.socket.getpeername()[1]
        taken = self.run_program("view", "a.glsl", "--osc", str(port), env=environment(DISPLAY=self.screen.display))
        self.assertEqual((taken.returncode, taken.stderr.splitlines()[-1]),
                         (3, f"tidemark: error: cannot listen for OSC at 127.0.0.1:{port}: Address already in use"))
        for wrong in ("", "x", "70000", ":9000", "9000x"):
            done = self.run_program("view", "a.glsl", f"--osc={wrong}", env=environment(DISPLAY=self.screen.display))
            self.assertEqual(done.returncode, 2, done.stderr)


if __name__ == "__main__":
    main()
