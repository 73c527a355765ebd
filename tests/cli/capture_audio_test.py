"""`capture --audio`: channels that read sound files or videos are heard in videos and .wav files, in time with iTime. The files are
made here sample by sample, and decoded by ffmpeg."""
import array
import contextlib
import json
import random
import shutil
import subprocess
import sys
import wave

from support.program import SKIPPED, ProgramTest, main

IMAGE = '#iChannel0 "{}"\nvoid mainImage(out vec4 c, in vec2 p) {{ c = texture(iChannel0, p / iResolution.xy); }}\n'
TONE = "vec2 mainSound(int samp, float t) { return vec2(0.25); }\n"
SIZE = ("--size", "32x18", "--fps", "30")
RATE = 44100
FULL = 32768


def noise(count: int, seed: int, most: int = 12000) -> array.array:
    """Samples of both sides that no shift repeats, smooth enough for every codec."""
    source = random.Random(seed)
    sides = []
    for _ in range(2):
        level, side = 0.0, []
        for _ in range(count):
            level = 0.9 * level + 0.1 * source.uniform(-most, most)
            side.append(round(3 * level))
        sides.append(side)
    return array.array("h", [sample for both in zip(*sides) for sample in both])


def looped(samples: array.array, first: int, count: int, loop: int | None = None) -> array.array:
    """Both sides of `count` samples from `first` on; after `loop` samples it starts again."""
    loop = loop or len(samples) // 2
    padded = samples[:2 * loop] + array.array("h", bytes(max(0, 4 * loop - 2 * len(samples))))
    return array.array("h", [padded[2 * (n % loop) + side] for n in range(first, first + count) for side in (0, 1)])


def shift_of(heard: array.array, wanted: array.array, most: int, about: int = 0) -> int:
    """By how many samples the left side of `heard` is late, found by correlation: `about` so many, and `most` from that."""
    left, right = heard[::2], wanted[::2]
    margin = most + abs(about)
    window = range(margin, min(len(left), len(right)) - margin, 11)
    def likeness(shift: int) -> float:
        return sum(left[n + shift] * right[n] for n in window)
    return max(range(about - most, about + most + 1), key=likeness)


class Audio(ProgramTest):
    def write_wav(self, name: str, samples: array.array, rate: int = RATE, channels: int = 2) -> None:
        (self.folder / name).parent.mkdir(exist_ok=True)
        with contextlib.closing(wave.open(str(self.folder / name), "wb")) as file:
            file.setnchannels(channels)
            file.setsampwidth(2)
            file.setframerate(rate)
            file.writeframes(samples.tobytes())

    def ffmpeg(self, *arguments: str) -> bytes:
        return subprocess.run(["ffmpeg", "-v", "error", "-y", *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                              check=True).stdout

    def heard(self, name: str, rate: int = RATE) -> array.array:
        """Both sides of a file's track from its beginning on, as a player has them."""
        return array.array("h", self.ffmpeg("-i", name, "-map", "0:a", "-af", f"aresample={rate}:async=1:first_pts=0",
                                            "-ac", "2", "-f", "s16le", "-"))

    def streams(self, name: str) -> dict:
        done = subprocess.run(["ffprobe", "-v", "error", "-show_streams", "-of", "json", name], cwd=self.folder,
                              stdout=subprocess.PIPE, check=True)
        return {stream["codec_type"]: stream for stream in json.loads(done.stdout)["streams"]}

    def capture(self, scene: str, name: str, *options: str) -> str:
        """Returns what is printed."""
        return self.succeed("capture", scene, *SIZE, *options, "-o", name).stderr

    def expect_likeness(self, name: str, wanted: array.array, most: int) -> None:
        """For codecs that lose something: the same sound, at most so many samples from the time of its picture."""
        heard = self.heard(name)
        starts = {kind: float(stream["start_time"]) for kind, stream in self.streams(name).items()}
        picture = round((starts["video"] - min(starts.values())) * RATE)  # players begin with what begins first
        shift = shift_of(heard, wanted, 450, picture)
        self.assertLessEqual(abs(shift - picture), most, name)
        first, last = 4096, min(len(heard), len(wanted)) - 8192
        moved = heard[first + 2 * shift:last + 2 * shift]
        error = sum((a - b) ** 2 for a, b in zip(moved, wanted[first:last]))
        self.assertLess(error, 0.2 * sum(b ** 2 for b in wanted[first:last]), name)

    def test_music_is_in_the_video_sample_by_sample(self):
        music = noise(RATE * 3, 1)
        self.write_wav("song.wav", music)
        self.write("a.glsl", IMAGE.format("song.wav"))
        said = self.capture("a.glsl", "a.mov", "--duration", "2")
        self.assertEqual(said, "Sound: iChannel0 song.wav, 44.1 kHz stereo\nwrote a.mov: 60 frames\n")
        self.assertEqual(self.heard("a.mov"), looped(music, 0, 2 * RATE))
        # From the middle on, beyond the end, and in frames: sound starts at iTime 0 and goes round as its texture does.
        self.capture("a.glsl", "b.mov", "--from", "2", "--to", "4.5")
        self.assertEqual(self.heard("b.mov"), looped(music, 2 * RATE, 5 * RATE // 2))
        self.capture("a.glsl", "c.mov", "--frames", "270-299")
        self.assertEqual(self.heard("c.mov"), looped(music, 9 * RATE, RATE))

    def test_codecs_keep_the_time(self):
        music = noise(RATE * 3, 2)
        self.write_wav("song.wav", music)
        self.write("a.glsl", IMAGE.format("song.wav"))
        # Matroska counts milliseconds, and ffmpeg puts the delay of Opus, 7 ms, into its times.
        for name, late in (("a.mp4", 0), ("a.mkv", RATE // 1000), ("a.webm", RATE * 8 // 1000)):
            said = self.capture("a.glsl", name, "--from", "1", "--duration", "3")
            self.assertIn(f"Sound: iChannel0 song.wav, {48 if name == 'a.webm' else 44.1:g} kHz stereo\n", said)
            self.expect_likeness(name, looped(music, RATE, 3 * RATE), late)
            streams = self.streams(name).values()
            starts = [float(stream["start_time"]) for stream in streams]
            lengths = [float(stream.get("duration") or self.length_of(stream)) for stream in streams]
            self.assertLess(abs(starts[0] - starts[1]), 1 / 30, name)
            self.assertLess(abs(lengths[0] - lengths[1]), 1 / 30, name)

    def length_of(self, stream: dict) -> float:
        hours, minutes, seconds = stream["tags"]["DURATION"].split(":")
        return 3600 * int(hours) + 60 * int(minutes) + float(seconds)

    def test_other_rates_and_one_channel(self):
        """One rate is kept; with the Sound pass all is at its rate."""
        mono = noise(12000, 3)[::2]
        self.write_wav("song.wav", mono, 24000, 1)
        self.write("a.glsl", IMAGE.format("song.wav"))
        said = self.capture("a.glsl", "a.mov", "--duration", "1")
        self.assertIn("Sound: iChannel0 song.wav, 24 kHz stereo\n", said)
        both = array.array("h", [sample for sample in mono for _ in range(2)])
        self.assertEqual(self.heard("a.mov", 24000), looped(both, 0, 24000))
        self.write("s/image.glsl", IMAGE.format("song.wav"))
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) { return vec2(0.0); }\n")
        self.write_wav("s/song.wav", mono, 24000, 1)
        said = self.capture("s", "s.mov", "--duration", "1")
        self.assertIn("Sound: iChannel0 song.wav and the Sound pass, 44.1 kHz stereo\n", said)
        wanted = array.array("h", self.ffmpeg("-i", "a.mov", "-map", "0:a", "-ar", str(RATE), "-f", "s16le", "-"))
        heard = self.heard("s.mov")
        self.assertEqual(len(heard), 2 * RATE)
        self.assertEqual(shift_of(heard, wanted, 20), 0)
        error = sum((a - b) ** 2 for a, b in zip(heard[2000:40000], wanted[2000:40000]))
        self.assertLess(error, 0.001 * sum(a ** 2 for a in wanted[2000:40000]))

    def make_clip(self, name: str, samples: array.array, late: float = 0) -> None:
        """A video of a second with that sound, without loss, which begins later than the picture, or earlier."""
        self.write_wav("clip.wav", samples)
        self.ffmpeg("-itsoffset", str(max(0, -late)), "-f", "lavfi", "-i", "testsrc=size=32x18:rate=25:duration=1",
                    "-itsoffset", str(max(0, late)), "-i", "clip.wav", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-c:a", "alac", name)

    def test_a_video_loops_with_its_picture(self):
        """Its sound is shorter than the picture, then longer."""
        for name, samples in (("short.mp4", noise(RATE // 2, 4)), ("long.mp4", noise(2 * RATE, 5))):
            self.make_clip(name, samples)
            self.write("a.glsl", IMAGE.format(name))
            said = self.capture("a.glsl", "a.mov", "--from", "0.5", "--duration", "2")
            self.assertIn(f"Sound: iChannel0 {name}, 44.1 kHz stereo\n", said)
            self.assertEqual(self.heard("a.mov"), looped(samples, RATE // 2, 2 * RATE, RATE), name)

    def test_sound_starting_before_or_after_the_picture(self):
        samples = noise(RATE, 6)
        for late, name in ((0.25, "late.mp4"), (-0.25, "early.mp4")):
            self.make_clip(name, samples, late)
            self.write("a.glsl", IMAGE.format(name))
            self.capture("a.glsl", "a.mov", "--duration", "0.7")
            shift = round(late * RATE)
            wanted = array.array("h", bytes(4 * max(0, shift))) + samples[2 * max(0, -shift):]
            heard = self.heard("a.mov")
            self.assertEqual(len(heard), round(1.4 * RATE))
            late_by = shift_of(heard, wanted[:len(heard)], 60)
            self.assertLessEqual(abs(late_by), 45, name)  # a millisecond

    def test_mixed_with_the_sound_pass(self):
        music = noise(RATE, 7)
        self.write("s/image.glsl", IMAGE.format("song.wav"))
        self.write_wav("s/song.wav", music)
        self.write("s/sound.glsl", TONE)
        self.capture("s", "s.mov", "--duration", "1")
        tone = round(0.25 * 32767)
        for got, sample in zip(self.heard("s.mov"), music):
            if abs(sample + tone) < 0.75 * FULL:
                self.assertLessEqual(abs(got - sample - tone), 1)
            else:
                self.assertLess(abs(got), FULL - 1)
        said = self.capture("s", "pass.mov", "--duration", "1", "--audio", "sound")
        self.assertIn("Sound: the Sound pass, 44.1 kHz stereo\n", said)
        self.assertTrue(all(abs(sample - tone) <= 1 for sample in self.heard("pass.mov")))
        said = self.capture("s", "inputs.mov", "--duration", "1", "--audio", "inputs")
        self.assertIn("Sound: iChannel0 song.wav, 44.1 kHz stereo\n", said)
        self.assertEqual(self.heard("inputs.mov"), music)
        said = self.capture("s", "none.mov", "--duration", "1", "--audio", "none")
        self.assertEqual(said, "wrote none.mov: 30 frames\n")
        self.assertEqual(set(self.streams("none.mov")), {"video"})

    def test_loud_sounds_are_clipped_softly(self):
        loud = array.array("h", [30000] * (2 * RATE))
        for name in ("one.wav", "two.wav"):
            self.write_wav(name, loud)
        self.write("a.glsl", '#iChannel1 "two.wav"\n' + IMAGE.format("one.wav"))
        said = self.capture("a.glsl", "a.wav", "--duration", "1")
        self.assertEqual(said, "Sound: iChannel0 one.wav and iChannel1 two.wav, 44.1 kHz stereo\nwrote a.wav\n")
        samples = self.heard("a.wav")
        self.assertEqual(len(samples), 2 * RATE)
        self.assertTrue(all(32000 < sample < FULL for sample in samples))
        self.write("b.glsl", '#iChannel1 "one.wav"\n' + IMAGE.format("one.wav"))  # one file is heard once
        self.capture("b.glsl", "b.wav", "--duration", "1")
        self.assertEqual(self.heard("b.wav"), loud)

    def test_wav_of_inputs_alone(self):
        music = noise(RATE, 8)
        self.write_wav("song.wav", music)
        self.write("a.glsl", IMAGE.format("song.wav"))
        self.capture("a.glsl", "a.wav", "--from", "0.5", "--duration", "2")
        self.assertEqual(self.heard("a.wav"), looped(music, RATE // 2, 2 * RATE))

    def test_resumed_and_sharded(self):
        music = noise(RATE, 9)
        self.write_wav("song.wav", music)
        self.write("a.glsl", IMAGE.format("song.wav"))
        options = ("--frames", "0-29", "--state-every", "10")
        self.capture("a.glsl", "whole.mov", *options)
        self.capture("a.glsl", "whole.mov", *options, "--resume")
        self.assertEqual(self.heard("whole.mov"), music)
        (self.folder / "out").mkdir()
        for shard in ("1/2", "2/2"):
            self.capture("a.glsl", "out/x.mov", *options, "--shard", shard)
        done = self.succeed("gather", "out")
        self.assertIn("Sound: iChannel0 song.wav, 44.1 kHz stereo\n", done.stderr)
        self.assertEqual(self.heard("out/x.mov"), music)

    def test_unsupported_combinations_are_refused(self):
        self.write_wav("song.wav", noise(1000, 10))
        self.write("a.glsl", IMAGE.format("song.wav"))
        self.write("still.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        self.write("s/image.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        self.write("s/sound.glsl", TONE)
        for scene, name, audio, words in (
                ("a.glsl", "a.png", "both", "--audio both: is for videos and .wav files only"),
                ("a.glsl", "a.gif", "inputs", "--audio inputs: a .gif has no sound"),
                ("a.glsl", "a.wav", "none", "--audio none: a .wav is sound alone"),
                ("a.glsl", "a.mp4", "sound", "--audio sound: the scene has no Sound pass"),
                ("s", "a.mp4", "inputs", "--audio inputs: no channel of the scene reads a sound or a video"),
                ("a.glsl", "a.mp4", "loud", "not 'loud'"),
                ("still.glsl", "a.wav", None, "'still.glsl' has no sound: it has no Sound pass, and no channel ")):
            with self.subTest(words=words):
                time = ("--duration", "1") if name != "a.png" else ()
                self.expect_error(["capture", scene, *SIZE, *time, "-o", name, *(("--audio", audio) if audio else ())], 2, words)
        said = self.capture("still.glsl", "still.mp4", "--duration", "0.5")
        self.assertEqual(said, "wrote still.mp4: 15 frames\n")

    def test_a_video_without_an_audio_track(self):
        self.ffmpeg("-f", "lavfi", "-i", "testsrc=size=32x18:rate=25:duration=1", "-pix_fmt", "yuv420p", "mute.mp4")
        self.write("a.glsl", IMAGE.format("mute.mp4"))
        self.assertEqual(self.capture("a.glsl", "a.mp4", "--duration", "0.5"), "wrote a.mp4: 15 frames\n")
        self.assertEqual(set(self.streams("a.mp4")), {"video"})
        said = self.capture("a.glsl", "b.mp4", "--duration", "0.5", "--audio", "inputs")
        self.assertEqual(said, "the video is silent: no input has a sound\nwrote b.mp4: 15 frames\n")
        self.expect_error(["capture", "a.glsl", "-o", "a.wav"], 2, "'a.glsl' has no sound: its videos have no audio track")


if __name__ == "__main__":
    if not shutil.which("ffmpeg") or not shutil.which("ffprobe"):
        print("skipped: ffmpeg is not installed")
        sys.exit(SKIPPED)
    main()
