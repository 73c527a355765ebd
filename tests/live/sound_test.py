"""The Sound pass, played in the window: in step with iTime through pause, restart and reload. The device is ALSA's
own that writes into a file; the sound tells its time."""
import array
import pathlib
import time

from support.live import LiveTest, View, main, wait_for

SIZE = ("--size", "200x100")
IMAGE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(iTime)); }\n"
SPAN = 100.0  # seconds that full scale stands for
RATE = 44100


def sound(right: float) -> str:
    """Left: the time. Right: a mark."""
    return f"vec2 mainSound(int samp, float t) {{ return vec2(t / {SPAN}, {right}); }}\n"


class Sound(LiveTest):
    def start(self, device: bool = True) -> View:
        self.write("s/image.glsl", IMAGE)
        self.write("s/sound.glsl", sound(0.25))
        self.heard = self.folder / "heard.raw"
        self.write("alsa.conf", f"pcm.quiet {{ type null }}\npcm.default {{ type file file {self.heard} format raw "
                                "slave.pcm quiet }\n" if device else "")
        return self.view("s", *SIZE, ALSA_CONFIG_PATH=str(self.folder / "alsa.conf"))

    def samples(self) -> tuple[list[float], list[float]]:
        """Times, and marks."""
        raw = array.array("h")
        data = self.heard.read_bytes() if self.heard.exists() else b""
        raw.frombytes(data[:len(data) // 4 * 4])
        return [x / 32767 * SPAN for x in raw[0::2]], [x / 32767 for x in raw[1::2]]

    def wait_for_samples(self, count: int) -> None:
        wait_for(lambda: len(self.samples()[0]) > count, f"{count} samples")

    def test_is_in_step_with_iTime(self):
        view = self.start()
        self.wait_for_samples(2 * RATE)
        times, marks = self.samples()
        self.assertLess(times[0], 1.5)
        for mark in marks[::1000]:
            self.assertAlmostEqual(mark, 0.25, places=3)
        # Sample by sample, but for a jump where the machine was too busy.
        steps = [b - a for a, b in zip(times[::441], times[441::441])]
        in_step = sum(abs(step - 0.01) < 0.007 for step in steps)
        self.assertGreater(in_step, 0.9 * len(steps))
        view.pause()
        paused_at = float(view.title().split("paused at ")[1].split()[0])
        time.sleep(0.3)
        times, _ = self.samples()
        self.assertLess(abs(times[-1] - paused_at), 0.6)  # a quarter of a second is handed over ahead
        time.sleep(0.3)
        self.assertEqual(len(self.samples()[0]), len(times))  # silent

    def test_restart_and_steps_are_followed(self):
        view = self.start()
        self.wait_for_samples(RATE)
        view.key("Home")
        def restarted() -> bool:
            times = self.samples()[0]
            return any(b < a - 0.3 and b < 0.5 for a, b in zip(times, times[1:]))
        wait_for(restarted, "the sound to start again")

    def test_a_saved_sound_is_heard_and_a_broken_one_is_said(self):
        view = self.start()
        self.wait_for_samples(1000)
        self.write("s/sound.glsl", sound(-0.5))
        wait_for(lambda: abs((self.samples()[1] or [0])[-1] + 0.5) < 1e-3, "the new sound")
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) { return nothing; }\n")
        view.wait_for_words(r"^no sound: tidemark: error: 's' does not compile\n"
                            r"s/sound\.glsl:1(:44)?: error: ")
        view.wait_for_title(r" (fps|still)\Z")  # the picture goes on

    def test_no_device_is_one_line(self):
        view = self.start(device=False)
        view.wait_for_words(r"\Ano sound: tidemark: error: no audio device found "
                            r"\(ALSA says: .+\)\n\Z")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)

    def test_scene_without_sound_loads_no_library(self):
        self.write("a.glsl", IMAGE)
        view = self.view("a.glsl", *SIZE)
        maps = pathlib.Path(f"/proc/{view.program.pid}/maps").read_text()
        self.assertNotIn("libasound", maps)


if __name__ == "__main__":
    main()
