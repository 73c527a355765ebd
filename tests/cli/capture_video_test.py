"""`capture -o x.mp4|.mkv|.webm|.mov|.gif|.webp`: the frames as a video, whole or not at all."""
import array
import contextlib
import functools
import json
import os
import shutil
import signal
import subprocess
import sys
import time

from support.program import PROGRAM, SKIPPED, ProgramTest, environment, main

os.environ.pop("GLIBC_TUNABLES", None)  # of the presets: with memory in pages of 2 MiB x265 3.5 loses timestamps

# A ramp over the picture, and the number of the frame in blue.
SCENE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, float(iFrame) / 20.0, 0.3); }\n"
SIZE = ("--size", "64x36")


class Video(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)

    def facts(self, name: str) -> dict:
        done = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", name],
                              cwd=self.folder, stdout=subprocess.PIPE, check=True)
        return {stream["codec_type"]: stream for stream in json.loads(done.stdout)["streams"]}

    def decoded(self, name: str, *what: str) -> bytes:
        return subprocess.run(["ffmpeg", "-v", "error", "-i", name, *what, "-"], cwd=self.folder,
                              stdout=subprocess.PIPE, check=True).stdout

    def expect_frames(self, name: str, width: int, height: int, first: int, count: int, tolerance: int) -> None:
        frames = self.decoded(name, "-fps_mode", "passthrough", "-pix_fmt", "rgb24", "-f", "rawvideo")
        self.assertEqual(len(frames), width * height * 3 * count)
        for number in range(count):
            for x, y in ((2, 2), (width - 3, 2), (2, height - 3), (width // 2, height // 2)):
                at = ((number * height + y) * width + x) * 3
                wanted = ((x + 0.5) / width, 1 - (y + 0.5) / height, (first + number) / 20)
                for got, want in zip(frames[at:at + 3], wanted):
                    self.assertLessEqual(abs(got - 255 * want), tolerance, (name, number, x, y))

    def test_shows_the_frames_at_their_rate(self):
        for name, codec, tolerance in (("a.mp4", "h264", 6), ("a.webm", "vp9", 8), ("a.mov", "prores", 3), ("a.gif", "gif", 36)):
            done = self.succeed("capture", "a.glsl", *SIZE, "--fps", "25", "--frames", "3-12", "-o", name)
            self.assertTrue(done.stderr.endswith(f"wrote {name}: 10 frames\n"))
            video = self.facts(name)["video"]
            self.assertEqual((video["codec_name"], video["width"], video["height"], video["r_frame_rate"],
                              video["nb_read_frames"]), (codec, 64, 36, "25/1", "10"))
            self.expect_frames(name, 64, 36, 3, 10, tolerance)
        self.assertEqual(self.files(), {"a.glsl", "a.mp4", "a.webm", "a.mov", "a.gif"})
        for name in ("a.mp4", "a.webm", "a.gif"):
            self.expect_same_file_again(name)

    def expect_same_file_again(self, name: str) -> None:
        """The same ten frames make the same bytes; test_segments_of_codecs shows it of other codecs."""
        self.succeed("capture", "a.glsl", *SIZE, "--fps", "25", "--frames", "3-12", "-o", "again-" + name)
        self.assertEqual((self.folder / name).read_bytes(), (self.folder / ("again-" + name)).read_bytes())

    @staticmethod
    @functools.cache
    def lacks(codec: str) -> bool:
        listed = subprocess.run(["ffmpeg", "-v", "error", "-hide_banner", "-encoders"], stdout=subprocess.PIPE, text=True, check=True)
        return not any(f" {name} " in listed.stdout for name in {"hevc": ["libx265"], "av1": ["libsvtav1", "libaom-av1"]}[codec])

    def test_codecs(self):
        for codec, names in (("hevc", ("a.mp4", "a.mkv")), ("av1", ("a.mp4", "a.mkv", "a.webm"))):
            if self.lacks(codec):
                done = self.run_program("capture", "a.glsl", *SIZE, "--frame", "0", "--codec", codec, "-o", "a.mp4")
                self.assertEqual(done.returncode, 4)
                self.assertIn(f"--codec {codec}: this ffmpeg lacks the encoder ", done.stderr)
                continue
            for name in names:
                # The first is too small for SVT-AV1; x265 4.1 (Debian 13) crashes on pictures narrower than 64.
                size = (64, 36) if name != "a.mp4" else (33, 17) if codec == "av1" else (65, 17)
                self.succeed("capture", "a.glsl", "--size", f"{size[0]}x{size[1]}", "--fps", "25", "--frames", "3-12",
                             "--codec", codec, "-o", name)
                video = self.facts(name)["video"]
                self.assertEqual((video["codec_name"], video["width"], video["height"], video["r_frame_rate"],
                                  video["nb_read_frames"]), (codec, *size, "25/1", "10"), name)
                self.assertEqual([video[key] for key in ("color_primaries", "color_transfer", "color_space", "color_range")],
                                 ["bt709", "iec61966-2-1", "bt709", "tv"], name)
                self.assertIn(video["pix_fmt"], ("yuv420p10le", "yuv444p10le"))
                self.expect_frames(name, *size, 3, 10, 12)
        self.succeed("capture", "a.glsl", *SIZE, "--fps", "25", "--frames", "3-12", "-o", "a.mkv")
        self.assertEqual(self.facts("a.mkv")["video"]["codec_name"], "h264")
        self.expect_frames("a.mkv", 64, 36, 3, 10, 6)

    def test_ten_bit_video_has_more_than_256_levels(self):
        """A grey ramp of 1,024 steps: each within a code or two of its own, where 8 bits have 220 in all."""
        self.write("ramp.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(floor(p.x) / 1023.0), 1.0); }\n")
        for name, codec in (("a.mp4", "hevc"), ("a.mp4", "av1"), ("a.mov", "prores")):
            if codec != "prores" and self.lacks(codec):
                continue
            self.succeed("capture", "ramp.glsl", "--size", "1024x64", "--frames", "0-2", "--codec", codec, "--state-every", "2",
                         "-o", name)
            luma = self.decoded(name, "-frames:v", "3", "-pix_fmt", "yuv444p10le", "-f", "rawvideo")
            for frame in range(3):
                row = array.array("H", luma[frame * 3 * 2 * 1024 * 64:][:2 * 1024])
                self.assertGreater(len(set(row)), 700, name)
                for x, code in enumerate(row):
                    self.assertLessEqual(abs(code - (64 + 876 * x / 1023)), 3, (name, frame, x))

    def test_segments_of_codecs(self):
        """However many there are, each frame is there once, at its time, and the joined file can be made again."""
        for name, codec in (("a.mp4", "hevc"), ("a.webm", "av1"), ("a.mov", "prores")):
            if codec != "prores" and self.lacks(codec):
                continue
            for copy in ("one", "two"):
                self.succeed("capture", "a.glsl", *SIZE, "--fps", "24", "--frames", "0-9", "--codec", codec,
                             "--state-every", "4", "-o", copy + name)
            self.assertEqual(*((self.folder / (copy + name)).read_bytes() for copy in ("one", "two")))
            self.expect_frames("one" + name, 64, 36, 0, 10, 12)
            packets = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "frame=pts_time", "-of", "csv=p=0", "one" + name],
                                     cwd=self.folder, stdout=subprocess.PIPE, text=True, check=True).stdout
            times = [float(line.strip(",")) for line in packets.split()]
            self.assertEqual(len(times), 10)
            for number, seconds in enumerate(times):
                self.assertLessEqual(abs(seconds - number / 24), 0.0011, name)  # a .webm counts milliseconds

    def test_webp_keeps_every_byte(self):
        """ffmpeg writes animated ones and does not read them."""
        self.succeed("capture", "a.glsl", *SIZE, "--fps", "25", "--frames", "3-12", "-o", "a.webp")
        file = (self.folder / "a.webp").read_bytes()
        self.assertEqual((file[:4], file[8:16], file.count(b"ANMF")), (b"RIFF", b"WEBPVP8X", 10))
        self.expect_same_file_again("a.webp")
        self.succeed("capture", "a.glsl", *SIZE, "--frame", "3", "-o", "one.webp")
        self.succeed("capture", "a.glsl", *SIZE, "--frame", "3", "-o", "one.png")
        self.assertIn("RMSE 0,", self.succeed("compare", "one.webp", "one.png").stdout.decode())

    def test_rates_of_television_are_exact(self):
        for typed, exact in (("24000/1001", "24000/1001"), ("23.976", "24000/1001"), ("29.97", "30000/1001"),
                             ("59.94", "60000/1001"), ("25/2", "25/2")):
            for name in ("a.mp4", "a.mov") if typed != exact or typed == "25/2" else ("a.mp4",):
                self.succeed("capture", "a.glsl", *SIZE, "--fps", typed, "--frames", "0-7", "--state-every", "4", "-o", name)
                self.assertEqual(self.facts(name)["video"]["r_frame_rate"], exact, typed)
        self.succeed("capture", "a.glsl", *SIZE, "--fps", "59.94", "--frames", "0-18x2", "-o", "a.mp4")
        self.assertEqual(self.facts("a.mp4")["video"]["r_frame_rate"], "30000/1001")

    def test_padded_to_even_sides(self):
        self.succeed("capture", "a.glsl", "--size", "33x17", "--frame", "0", "-o", "one.mov")
        done = self.succeed("capture", "a.glsl", "--size", "33x17", "--frame", "0", "--pad", "even", "-o", "even.mov")
        self.assertNotIn("warning", done.stderr)
        odd, even = (self.decoded(name, "-pix_fmt", "rgb24", "-f", "rawvideo") for name in ("one.mov", "even.mov"))
        self.assertEqual((len(odd), len(even)), (33 * 17 * 3, 34 * 18 * 3))
        for x, y in ((0, 0), (33, 0), (33, 17), (0, 17), (16, 8)):  # from the top left; the rest repeats its neighbour
            at, of = 3 * (y * 34 + x), 3 * (min(y, 16) * 33 + min(x, 32))
            for got, wanted in zip(even[at:at + 3], odd[of:of + 3]):
                self.assertLessEqual(abs(got - wanted), 3, (x, y))
        done = self.succeed("capture", "a.glsl", "--size", "33x17", "--frame", "0", "--pad", "even", "-o", "even.mp4")
        self.assertEqual(done.stderr, "wrote even.mp4: 1 frame\n")
        self.assertEqual(self.facts("even.mp4")["video"]["pix_fmt"], "yuv420p")

    def test_odd_sizes(self):
        for name in ("odd.mp4", "odd.webm", "odd.gif"):  # a .mov of this size is in test_padded_to_even_sides
            done = self.succeed("capture", "a.glsl", "--size", "33x17", "--fps", "10", "--frames", "0-2", "-o", name)
            self.assertEqual("many players refuse; give --pad even or --crop 0,0,32,16" in done.stderr, name == "odd.mp4")
            video = self.facts(name)["video"]
            self.assertEqual((video["width"], video["height"]), (33, 17))

    def test_full_disk(self):
        # A disk of 16 KiB of our own, gone with the shell.
        shell = ("unshare", "--user", "--map-root-user", "--mount", "sh", "-c")
        disk = "mount -t tmpfs -o size=16k none disk"
        (self.folder / "disk").mkdir()
        if subprocess.run([*shell, disk], cwd=self.folder, stderr=subprocess.DEVNULL).returncode:
            self.skipTest("this system lets nobody mount a disk of their own")
        self.write("loud.glsl", "void mainImage(out vec4 c, in vec2 p) "
                                "{ c = vec4(fract(sin(dot(p, vec2(91.7, 3.1)) + iTime) * 4311.3)); }\n")
        for name in ("a.mp4", "a.webm", "a.gif"):
            line = (f'{disk} && "$0" capture loud.glsl --size 128x72 --fps 25 --frames 0-9 -o disk/{name}; '
                    'echo $?; ls -A disk')
            done = subprocess.run([*shell, line, PROGRAM], cwd=self.folder, env=environment(), text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertEqual(done.stdout, "4\n", (name, done.stderr))
            self.assertRegex(done.stderr, f"error: cannot write 'disk/{name}': ffmpeg says: .*No space left on device")

    def test_sound_pass_goes_with_it_from_the_first_frame_on(self):
        self.write("s/image.glsl", SCENE)
        # A tone in the second second only.
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) {"
                                   "return t < 1.0 ? vec2(0.0) : vec2(0.5 * sin(6.283185307 * 441.0 * t)); }")
        for name in ("s.mp4", "s.webm", "s.mov"):
            self.succeed("capture", "s", *SIZE, "--fps", "10", "--frames", "5-14", "-o", name)
            samples = array.array("h", self.decoded(name, "-ac", "1", "-ar", "44100", "-f", "s16le"))
            self.assertLess(abs(len(samples) - 44100), 3000)
            quiet, loud = samples[4410:20000], samples[25000:40000]
            self.assertLess(max(quiet), 400)
            self.assertGreater(max(loud), 14000)
            rising = sum(a < 0 <= b for a, b in zip(loud, loud[1:]))
            self.assertLessEqual(abs(rising - 150), 1)  # 15,000 samples of 441 Hz

    def test_evenly_spaced_frames_set_the_frame_rate(self):
        self.write("s/image.glsl", SCENE)
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) {"
                                   "return t < 1.0 ? vec2(0.0) : vec2(0.5 * sin(6.283185307 * 441.0 * t)); }")
        for name in ("s.mp4", "s.webm"):
            done = self.succeed("capture", "s", *SIZE, "--fps", "20", "--frames", "0-38x2", "-o", name)
            self.assertEqual(done.stderr.splitlines()[-1], f"wrote {name}: 20 frames, 10 a second")
            video = self.facts(name)["video"]
            self.assertEqual((video["r_frame_rate"], video["nb_read_frames"]), ("10/1", "20"))
            samples = array.array("h", self.decoded(name, "-ac", "1", "-ar", "44100", "-f", "s16le"))
            self.assertLess(abs(len(samples) - 2 * 44100), 3000)
            self.assertLess(max(samples[4410:40000]), 400)
            self.assertGreater(max(samples[48000:80000]), 14000)
        self.succeed("capture", "a.glsl", *SIZE, "--fps", "60", "--frames", "0-15x3", "-o", "fast.gif")
        self.assertEqual(self.facts("fast.gif")["video"]["r_frame_rate"], "20/1")

    def test_unevenly_spaced_frames_last_until_the_next_frame(self):
        self.write("s/image.glsl", SCENE)
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) {"
                                   "return t < 1.0 ? vec2(0.0) : vec2(0.5 * sin(6.283185307 * 441.0 * t)); }")
        # Ticks of two frames of the scene: frame 0 for two, 4 for one, 6 for five, 16 for two, 20 for one.
        done = self.succeed("capture", "s", *SIZE, "--fps", "10", "--frames", "0,4,6,16,20", "-o", "s.mp4")
        self.assertRegex(done.stderr, r"\A.* \(5 frames per second\) .*\nSound: the Sound pass, 44\.1 kHz stereo\n"
                                      r"wrote s\.mp4: 5 frames, 5 a second\n\Z")
        video = self.facts("s.mp4")["video"]
        self.assertEqual((video["r_frame_rate"], video["nb_read_frames"]), ("5/1", "11"))
        frames = self.decoded("s.mp4", "-fps_mode", "passthrough", "-pix_fmt", "rgb24", "-f", "rawvideo")
        shown = [frames[at + 2] / 255 * 20 for at in range(3 * (18 * 64 + 32), len(frames), 64 * 36 * 3)]
        for got, want in zip(shown, [0, 0, 4, 6, 6, 6, 6, 6, 16, 16, 20], strict=True):
            self.assertLessEqual(abs(got - want), 0.6)
        samples = array.array("h", self.decoded("s.mp4", "-ac", "1", "-ar", "44100", "-f", "s16le"))
        self.assertLess(abs(len(samples) - 2.2 * 44100), 3000)
        self.assertLess(max(samples[4410:40000]), 400)
        self.assertGreater(max(samples[48000:90000]), 14000)
        # In segments, and joined, it is the same.
        self.succeed("capture", "s", *SIZE, "--fps", "10", "--frames", "0,4,6,16,20", "--state-every", "2", "-o", "t.mp4")
        self.assertEqual(self.facts("t.mp4")["video"]["nb_read_frames"], "11")

    def test_frames_in_descending_order_warn_and_have_no_sound(self):
        self.write("s/image.glsl", SCENE)
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) { return vec2(sin(t)); }")
        one_by_one = "its frames are not in ascending order; they are shown one after another"
        for frames, why, rate in (("2,2", one_by_one, 10), ("0,3,2", one_by_one, 10),
                                  ("9-0", "its frames are in descending order", 10), ("8-0x2", "its frames are in descending "
                                                                                               "order", 5)):
            done = self.succeed("capture", "s", *SIZE, "--fps", "10", "--frames", frames, "-o", "s.mp4")
            self.assertEqual(done.stderr.splitlines()[0], f"the video does not follow the scene's time: {why}; it shows {rate} "
                                                          f"frames per second; "
                                                          "it is silent")
            facts = self.facts("s.mp4")
            self.assertEqual((set(facts), facts["video"]["r_frame_rate"]), ({"video"}, f"{rate}/1"))

    def test_sound_ends_at_the_largest_sample_number(self):
        self.write("s/image.glsl", SCENE)
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) { return vec2(sin(t)); }")
        self.succeed("capture", "s", *SIZE, "--fps", "1", "--frames", "47990-47991", "-o", "last.mp4")
        self.assertEqual(set(self.facts("last.mp4")), {"video", "audio"})
        done = self.succeed("capture", "s", *SIZE, "--fps", "1", "--frames", "47999-48000", "-o", "late.mp4")
        self.assertRegex(done.stderr, "the video is silent: .* 48000 s, ")
        self.assertEqual(set(self.facts("late.mp4")), {"video"})

    def test_broken_sound_pass_leaves_a_silent_video(self):
        self.write("s/image.glsl", SCENE)
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float t) { return nothing; }")
        done = self.succeed("capture", "s", *SIZE, "--frame", "0", "-o", "s.mp4")
        self.assertEqual(done.stderr.splitlines()[-1], "wrote s.mp4: 1 frame")
        self.assertRegex(done.stderr, r"\Athe video is silent: tidemark: error: 's' does not compile\n"
                                      r"s/sound\.glsl:1(:44)?: error: ")
        self.assertEqual(set(self.facts("s.mp4")), {"video"})

    def test_errors(self):
        def refused(words: str, code: int = 2, env=None, *options: str) -> None:
            self.expect_error(["capture", "a.glsl", *SIZE, *options], code, words, env=env)

        refused("'a.mp4': there is no program 'ffmpeg'", 4, environment(PATH=str(self.folder)), "-o", "a.mp4",
                "--frame", "0")
        refused("--fps 60: a GIF has at most 50 frames per second", 2, None, "-o", "a.gif")
        refused("--depth: ", 2, None, "-o",
                "a.mp4", "--depth", "16")
        refused("--codec hevc: give an .mp4, an .mkv or a .webm", 2, None, "-o", "a.gif", "--codec", "hevc")
        refused("--codec av1: give an .mp4, an .mkv or a .webm", 2, None, "-o", "a.png", "--codec", "av1")
        refused("--codec hevc: a .webm holds vp9, av1", 2, None, "-o", "a.webm", "--codec", "hevc")
        refused("-o : ", 2, None, "-o", "")
        refused("'a.glsl/b': Not a directory", 4, None, "-o", "a.glsl/b/a.webm", "--frame", "0")
        for name in ("a.mp4", "a.webp"):
            refused(f"-o {name}: give the length of the video, as in --duration 5, ", 2, None, "-o", name)
        refused("--pad: is for videos only", 2, None, "-o", "a.png", "--pad", "even")

    def has_written(self) -> bool:
        for path in self.folder.iterdir():
            with contextlib.suppress(FileNotFoundError):  # some are only tried
                if path.name != "a.glsl" and path.stat().st_size > 0:
                    return True
        return False

    def test_interrupted_leaves_nothing(self):
        program = subprocess.Popen([PROGRAM, "capture", "a.glsl", *SIZE, "--frames", "0-1000000",
                                    "--state-every", "1000000", "-o", "a.mp4"],
                                   cwd=self.folder, stderr=subprocess.PIPE, env=environment())
        # ffmpeg writes: before that, while the driver compiles, Ctrl-C ends without a word.
        while not self.has_written():
            time.sleep(0.02)
        program.send_signal(signal.SIGINT)
        words = program.communicate(timeout=60)[1].decode()
        self.assertEqual(program.returncode, 130)
        self.assertRegex(words, r"interrupted after \d+ of 1000001 frames; no video was written\n\Z")
        self.assertNotIn("wrote", words)
        self.assertEqual(self.files(), {"a.glsl"})


if __name__ == "__main__":
    if not shutil.which("ffmpeg") or not shutil.which("ffprobe"):
        print("skipped: ffmpeg is not installed")
        sys.exit(SKIPPED)
    main()
