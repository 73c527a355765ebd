"""The Sound pass and the sound of inputs, played in the window: in step with iTime through pause, restart, seek and reload. The
device is ALSA's own that writes into a file; the sound tells its time."""
import array
import contextlib
import pathlib
import re
import shutil
import subprocess
import time
import unittest
import wave

from support.live import View, main, wait_for
from support.osc import Client
from support.overlay import OverlayTest, SPEED_BEGIN, SPEED_END

SIZE = ("--size", "200x100")
IMAGE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p.x < 40.0 ? fract(iTime) : 0.5); }\n"  # show_controls() looks right
MUTE = (215, 134)  # in the controls of a scene without knobs
SPAN = 100.0  # seconds that full scale stands for
RATE = 44100


def sound(right: float) -> str:
    """Left: the time. Right: a mark."""
    return f"vec2 mainSound(int samp, float t) {{ return vec2(t / {SPAN}, {right}); }}\n"


class SoundTest(OverlayTest):
    def set_device(self, device: bool = True) -> dict[str, str]:
        """Variables of a window whose sound is written into a file."""
        self.heard = self.folder / "heard.raw"
        self.write("alsa.conf", f"pcm.quiet {{ type null }}\npcm.default {{ type file file {self.heard} format raw "
                                "slave.pcm quiet }\n" if device else "")
        return {"ALSA_CONFIG_PATH": str(self.folder / "alsa.conf")}

    def raw(self) -> array.array:
        raw = array.array("h")
        data = self.heard.read_bytes() if self.heard.exists() else b""
        raw.frombytes(data[:len(data) // 4 * 4])
        return raw

    def samples(self) -> tuple[list[float], list[float]]:
        """Times, and marks."""
        raw = self.raw()
        return [x / 32767 * SPAN for x in raw[0::2]], [x / 32767 for x in raw[1::2]]

    def wait_for_samples(self, count: int) -> None:
        wait_for(lambda: len(self.samples()[0]) > count, f"{count} samples")

    def wait_for_silence(self) -> int:
        """Waits until nothing is heard for a second, and gives the number of samples heard until then."""
        heard = -1
        def silent() -> bool:
            nonlocal heard
            before, heard = heard, len(self.samples()[0])
            if heard != before:
                time.sleep(1)
            return heard == before
        wait_for(silent, "silence")
        return heard

    def expect_silence_when_paused(self, view: View) -> None:
        view.pause()
        paused_at = float(view.title().split("paused at ")[1].split()[0])
        self.wait_for_silence()
        times, _ = self.samples()
        self.assertLess(abs(times[-1] - paused_at), 0.6)  # a quarter of a second is handed over ahead


class Sound(SoundTest):
    def start(self, device: bool = True) -> View:
        self.write("s/image.glsl", IMAGE)
        self.write("s/sound.glsl", sound(0.25))
        return self.view("s", *SIZE, **self.set_device(device))

    def test_is_synchronised_with_iTime(self):
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
        self.expect_silence_when_paused(view)

    def test_restart_and_steps_are_followed(self):
        view = self.start()
        self.wait_for_samples(RATE)
        view.key("Home")
        def restarted() -> bool:
            times = self.samples()[0]
            return any(b < a - 0.3 and b < 0.5 for a, b in zip(times, times[1:]))
        wait_for(restarted, "the sound to start again")

    def test_a_saved_sound_plays_and_a_broken_one_is_reported(self):
        view = self.start()
        self.wait_for_samples(1000)
        self.write("s/sound.glsl", sound(-0.5))
        wait_for(lambda: abs((self.samples()[1] or [0])[-1] + 0.5) < 1e-3, "the new sound")
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) { return nothing; }\n")
        view.wait_for_words(r"^no sound: 's' does not compile\n"
                            r"s/sound\.glsl:1(:44)?: error: ")
        view.wait_for_title(r" (fps|still)\Z")  # the picture goes on

    def test_a_missing_device_is_reported_in_one_line(self):
        view = self.start(device=False)
        view.wait_for_words(r"\Ano sound: no audio device found "
                            r"\(ALSA says: .+\)\n\Z")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)

    def test_scene_without_sound_loads_no_library(self):
        self.write("a.glsl", IMAGE)
        view = self.view("a.glsl", *SIZE)
        maps = pathlib.Path(f"/proc/{view.program.pid}/maps").read_text()
        self.assertNotIn("libasound", maps)


def clock(seconds: float, mark: float) -> array.array:
    """Left: the time. Right: a mark. As `sound` above has it."""
    right = round(mark * 32767)
    return array.array("h", [sample for n in range(round(seconds * RATE))
                             for sample in (round(n / RATE / SPAN * 32767), right)])


class Inputs(SoundTest):
    def start(self, *options: str, seconds: float = 30, device: bool = True, size: str = SIZE[1], **variables: str) -> View:
        """A scene with music that tells its time."""
        self.music = clock(seconds, 0.25)
        self.write_wav("song.wav", self.music)
        self.write("a.glsl", '#iChannel0 "song.wav"\n' + IMAGE)
        return self.open("a.glsl", "--size", size, *options, **self.set_device(device), **variables)

    def write_wav(self, name: str, samples: array.array) -> None:
        (self.folder / name).parent.mkdir(exist_ok=True)
        with contextlib.closing(wave.open(str(self.folder / name), "wb")) as file:
            file.setnchannels(2)
            file.setsampwidth(2)
            file.setframerate(RATE)
            file.writeframes(samples.tobytes())

    def test_music_plays_every_sample_in_time_with_iTime(self):
        view = self.start()
        self.wait_for_samples(2 * RATE)
        times, _ = self.samples()
        self.assertLess(times[0], 3)
        heard, whole = self.raw().tobytes(), self.music.tobytes()
        exact = sum(heard[at:at + 4410] in whole for at in range(0, len(heard) - 4410, 4410))
        self.assertGreater(exact, 0.9 * (len(heard) // 4410 - 1))  # but for jumps where the machine was too busy
        self.expect_silence_when_paused(view)

    def test_music_loops_with_its_texture(self):
        self.start(seconds=1)
        self.wait_for_samples(3 * RATE)
        times, marks = self.samples()
        self.assertLess(max(times), 1.01)
        self.assertAlmostEqual(min(marks), 0.25, places=3)  # no gap
        rounds = sum(b < a - 0.9 for a, b in zip(times, times[1:]))
        self.assertGreaterEqual(rounds, 2)

    def test_a_seek_is_followed(self):
        view = self.start("--osc", "0")
        port = int(view.wait_for_words(r"^OSC: listening at \S+:(\d+)$")[1])
        self.wait_for_samples(RATE // 2)
        client = Client(port)
        self.addCleanup(client.socket.close)
        client.send("/time", 20.0)
        wait_for(lambda: self.samples()[0][-1] > 20, "the sound at 20 s")
        times, _ = self.samples()
        self.assertFalse([t for t in times if 15 < t < 19.9])
        jump = next(b for a, b in zip(times, times[1:]) if b > a + 5)
        self.assertLess(jump, 21)
        view.key("Home")
        wait_for(lambda: self.samples()[0][-1] < 10, "the sound to start again")

    def test_other_speeds_are_silent(self):
        view = self.start(size="640x360")
        self.wait_for_samples(RATE // 2)
        view.show_controls()
        view.drag_bar(SPEED_BEGIN + 50, SPEED_END)
        before = self.wait_for_silence()
        view.key("v")
        self.wait_for_samples(before)

    def test_volume_and_mute(self):
        view = self.start()
        self.wait_for_samples(RATE // 2)
        for _ in range(6):
            view.key("Down")
        wait_for(lambda: abs(self.samples()[1][-1] - 0.1) < 1e-3, "the volume 40 %")
        steps = self.samples()[1]
        self.assertLess(max(abs(b - a) for a, b in zip(steps, steps[1:])), 0.01)  # without a click
        view.key("u")
        before = self.wait_for_silence()
        view.key("u")
        self.wait_for_samples(before + 1000)
        self.assertAlmostEqual(self.samples()[1][-1], 0.1, places=3)
        view.key("Up")
        wait_for(lambda: abs(self.samples()[1][-1] - 0.125) < 1e-3, "the volume 50 %")
        # The next window has it, too.
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        state = {"XDG_STATE_HOME": view.state.name}
        self.heard.unlink()
        again = self.start(**state)
        again.wait_for_words(r"^restored: .*volume 50 %")
        self.wait_for_samples(RATE // 2)
        self.assertAlmostEqual(self.samples()[1][-1], 0.125, places=3)

    def test_mute_in_the_controls(self):
        view = self.start(size="640x360")
        self.wait_for_samples(RATE // 2)
        view.show_controls()
        view.click(MUTE[0], MUTE[1])
        count = self.wait_for_silence()
        view.click(MUTE[0], MUTE[1])
        self.wait_for_samples(count)

    def test_mixed_with_the_sound_pass(self):
        self.write("s/image.glsl", '#iChannel0 "song.wav"\n' + IMAGE)
        self.write("s/sound.glsl", sound(0.25))
        self.write_wav("s/song.wav", clock(30, 0.25))
        self.view("s", *SIZE, **self.set_device())
        wait_for(lambda: abs((self.samples()[1] or [0])[-1] - 0.5) < 1e-3, "both")
        # The pass breaks: the music goes on.
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) { return nothing; }\n")
        wait_for(lambda: abs(self.samples()[1][-1] - 0.25) < 1e-3, "the music alone")

    def test_a_changed_file_and_a_removed_input(self):
        self.start()
        self.wait_for_samples(RATE // 2)
        self.write_wav("song.wav", clock(30, -0.5))
        wait_for(lambda: abs(self.samples()[1][-1] + 0.5) < 1e-3, "the new song")
        self.write("a.glsl", IMAGE)
        self.wait_for_silence()

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_the_audio_of_a_video_plays(self):
        self.write_wav("clip.wav", clock(2, 0.25))
        for name, words in (("clip.mp4", ("-i", "clip.wav", "-c:a", "alac")), ("mute.mp4", ())):
            subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i", "testsrc=size=32x18:rate=25:duration=2", *words,
                            "-pix_fmt", "yuv420p", name],
                           cwd=self.folder, check=True)
        self.write("a.glsl", '#iChannel0 "clip.mp4"\n' + IMAGE)
        view = self.view("a.glsl", *SIZE, **self.set_device())
        self.wait_for_samples(3 * RATE)
        times, marks = self.samples()
        self.assertLess(max(times), 2.01)
        self.assertAlmostEqual(min(marks), 0.25, places=3)
        self.assertTrue(any(b < a - 1.9 for a, b in zip(times, times[1:])))  # it goes round
        view.close()
        self.write("a.glsl", '#iChannel0 "mute.mp4"\n' + IMAGE)
        view = self.view("a.glsl", *SIZE, **self.set_device(False))
        time.sleep(1)
        self.assertEqual(view.stderr(), "")
        self.assertNotIn("libasound", pathlib.Path(f"/proc/{view.program.pid}/maps").read_text())

    def test_a_missing_device_is_reported_in_one_line(self):
        view = self.start(device=False)
        view.wait_for_words(r"\Ano sound: no audio device found \(ALSA says: .+\)\n\Z")
        self.write_wav("song.wav", clock(30, -0.5))  # a reload says it no second time
        view.wait_for_words(r"^reloaded in")
        time.sleep(1)
        self.assertEqual(len(re.findall("no sound", view.stderr())), 1)

    def test_damaged_file(self):
        view = self.start()
        (self.folder / "song.wav").write_bytes(self.music.tobytes()[:1000])
        view.wait_for_words(r"^no sound of iChannel0 song\.wav: cannot read 'song\.wav': ")
        view.wait_for_title(r" (fps|still)\Z")  # the picture goes on


if __name__ == "__main__":
    main()
