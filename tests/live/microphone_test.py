"""`view --microphone`: what is heard is what inputs without a sound file hold. The device is ALSA's, and plays a file."""
import array

from support import probe
from support.live import LiveTest, main
from support.program import environment

SIZE = ("--size", "200x100")
LOUD = 16384  # a half: a wave of 192, and all of its spectrum at the low end
VALUES = {"wave": "round(255.0 * texelFetch(iChannel0, ivec2(100, 1), 0).r)",
          "low": "round(255.0 * texelFetch(iChannel0, ivec2(0, 0), 0).r)",
          "high": "round(255.0 * texelFetch(iChannel0, ivec2(400, 0), 0).r)"}
SCENE = probe.shader(VALUES, '#iChannel0 "microphone"')
DEVICES = """pcm.nothing {{ type null }}
pcm.voice {{ type file slave.pcm nothing file /dev/null infile "{file}" format raw }}
pcm.default pcm.voice
"""


class Microphone(LiveTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)
        (self.folder / "voice.raw").write_bytes(array.array("h", [LOUD]).tobytes() * 10_000_000)
        self.write("devices.conf", DEVICES.format(file=self.folder / "voice.raw"))
        self.devices = {"ALSA_CONFIG_PATH": str(self.folder / "devices.conf")}

    def test_spectrum_and_wave(self):
        for device in ("voice", "default"):
            view = self.view("a.glsl", *SIZE, "--microphone", device, **self.devices)
            told = view.wait_until_told(VALUES, lambda told: told["wave"] == 192)
            self.assertEqual((told["low"], told["high"]), (255, 0))
            view.close()

    def test_opened_only_with_the_option(self):
        view = self.view("a.glsl", *SIZE, **self.devices)
        told = view.told(VALUES)
        self.assertNotEqual(told["wave"], 192)
        with open(f"/proc/{view.program.pid}/maps", encoding="utf-8") as maps:
            self.assertNotRegex(maps.read(), "libasound|liblo|librtmidi")

    def test_missing_microphone_is_an_error(self):
        done = self.run_program("view", "a.glsl", "--microphone", "none",
                                env=environment(DISPLAY=self.screen.display, **self.devices))
        self.assertEqual((done.returncode, done.stderr.splitlines()[-1]),
                         (3, "tidemark: error: cannot listen to the microphone 'none': No such file or directory"))


if __name__ == "__main__":
    main()
