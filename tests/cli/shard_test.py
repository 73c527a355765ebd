"""`capture --shard` and `gather`: what several processes make is what one would have made."""
import array
import json
import shutil
import subprocess
import unittest

from support.program import PROGRAM, ProgramTest, environment, main

SCENE = """#iUniform float speed = 0.5
void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, fract(iTime * speed), 1.0); }
"""
SEQUENCE = ("capture", "a.glsl", "--size", "32x18", "--fps", "25", "--frames", "0-9", "-o")
DRIVEN = r"10 frames: all complete, with one fingerprint, drawn by .*"


class Shards(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)
        for name in ("out", "whole"):
            (self.folder / name).mkdir()

    def contents(self, folder: str) -> dict[str, bytes]:
        return {path.name: path.read_bytes() for path in (self.folder / folder).iterdir()
                if path.name != "shards.json"}

    def shard(self, which: str, *more: str, **options) -> str:
        return self.succeed(*SEQUENCE, "out/f_%04d.png", "--shard", which, *more, **options).stderr

    def test_concurrent_shards_make_the_sequence(self):
        started = [subprocess.Popen([PROGRAM, *SEQUENCE, "out/f_%04d.png", "--shard", f"{k}/3"], cwd=self.folder,
                                    env=environment(), stderr=subprocess.DEVNULL) for k in (1, 2, 3)]
        self.assertEqual([process.wait() for process in started], [0, 0, 0])
        self.succeed(*SEQUENCE, "whole/f_%04d.png")
        self.assertEqual(self.contents("out"), self.contents("whole"))
        lines = self.succeed("gather", "out").stderr.splitlines()
        self.assertRegex(lines[0], DRIVEN)
        self.assertEqual([line[:9] for line in lines[1:]], ["3 of them"])

    def test_partial_files_of_another_machine_are_removed(self):
        """A shard leaves it alone; when all frames are there nobody is at work any more."""
        left = {"out/.f_0003.part-0123abcd-7-1.png", "out/.f_0003.png.part-0123abcd-7-2.state"}
        for name in left:
            self.write(name, "half")
        for k in (1, 2):
            self.shard(f"{k}/2", "--resume")
        self.assertLessEqual(left, self.files())
        self.succeed("gather", "out")
        self.assertFalse(left & self.files())

    def test_reports_missing_frames(self):
        self.shard("1/3")
        self.shard("3/3")
        self.expect_error(["gather", "out"], 1, "3 of 10 frames: missing", "out/f_0001.png", "2/3")
        self.shard("2/3")
        (self.folder / "out/f_0004.png").write_bytes(b"x")
        self.expect_error(["gather", "out"], 1, "1 of 10 frames: incomplete", "out/f_0004.png", "2/3")
        self.assertIn("kept 2 of 3 frames", self.shard("2/3", "--resume"))
        self.succeed("gather", "out")
        self.write("a.glsl", SCENE.replace("speed), 1.0", "speed), 0.5"))
        self.expect_error(["gather", "out"], 1, "10 of 10 frames: drawn", "out/f_0000.png", "1/3")

    def test_a_frame_with_foreign_pixels_is_refused(self):
        """The metadata of one frame around the pixels of another."""
        for k in (1, 2):
            self.shard(f"{k}/2")
        first, last = ((self.folder / f"out/f_{i:04}.png").read_bytes() for i in (0, 9))
        data = first.index(b"IDAT") - 4, last.index(b"IDAT") - 4
        (self.folder / "out/f_0009.png").write_bytes(last[:data[1]] + first[data[0]:])
        self.expect_failure_like(["gather", "out"], 1,
                                 r"10 frames: .*\nout/f_0009.png .* 0\.\d+")
        self.assertRegex(self.succeed("gather", "out", "--sample", "0").stderr, rf"\A{DRIVEN}\n\Z")

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_a_video_of_shards_equals_the_video(self):
        for k in (1, 2):
            self.shard(f"{k}/2")
        for name in ("a.mp4", "a.webm", "a.gif"):
            self.assertTrue(self.succeed("gather", "out", "-o", name).stderr.endswith(f"wrote {name}: 10 frames\n"))
            self.succeed(*SEQUENCE, f"whole/{name}")
            self.assertEqual((self.folder / name).read_bytes(), (self.folder / "whole" / name).read_bytes())

    FILM = ("--state-every", "3", "-o")

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_segments_of_a_video(self):
        self.write("s/image.glsl", SCENE)
        self.write("s/sound.glsl", "vec2 mainSound(int s, float t) { return vec2(sin(6283.0 * t), sin(4000.0 * t)) * 0.3; }\n")
        for name in ("a.mp4", "a.webm", "a.gif", "a.mov"):
            run = ("capture", "s", *SEQUENCE[2:-1], *self.FILM)
            for k in (3, 1):
                said = self.succeed(*run, f"out/{name}", "--shard", f"{k}/3").stderr.splitlines()
                self.assertEqual(said[-1], f"wrote {'3' if k == 3 else '4'} frames of out/{name} as segments; `tidemark "
                                           f"gather` joins them")
            extension = ".mov" if name == "a.mov" else ".mp4"
            self.expect_error(["gather", "out"], 1, "1 of 4 segments: missing",
                              f"out/{name}.segment-0001{extension} (shard 2/3)")
            self.succeed(*run, f"out/{name}", "--shard", "2/3")
            middle = self.folder / f"out/{name}.segment-0001{extension}"
            whole = middle.read_bytes()
            middle.write_bytes(whole[:-100])
            self.expect_error(["gather", "out"], 1, "1 of 4 segments: incomplete",
                              f"out/{name}.segment-0001{extension} (shard 2/3)")
            self.assertIn("kept 0 of 3 frames", self.succeed(*run, f"out/{name}", "--shard", "2/3", "--resume").stderr)
            self.assertEqual(middle.read_bytes(), whole)
            self.assertIn("kept 3 of 3 frames", self.succeed(*run, f"out/{name}", "--shard", "2/3", "--resume").stderr)
            lines = self.succeed("gather", "out").stderr.splitlines()
            heard = [] if name == "a.gif" else [line for line in lines if line.startswith("Sound: the Sound pass, ")]
            self.assertEqual((lines[0][:9], lines[1:]), ("10 frames", [*heard, f"wrote out/{name}: 10 frames"]))
            self.assertEqual(len(heard), name != "a.gif")
            self.succeed(*run, f"whole/{name}")
            self.assertEqual(self.contents("out"), self.contents("whole"))
            for folder in ("out", "whole"):
                for path in (self.folder / folder).iterdir():
                    path.unlink()

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_a_link_in_place_of_the_video_is_not_followed(self):
        """The name stands in shards.json, and the folder may be a stranger's."""
        self.write("mine.txt", "mine")
        for k in (1, 2):
            self.succeed("capture", "a.glsl", "--size", "64x36", "--frames", "0-9", "--state-every", "5",
                         "--shard", f"{k}/2", "-o", "out/x.mp4")
        (self.folder / "out" / "x.mp4").symlink_to(self.folder / "mine.txt")
        done = self.run_program("gather", "out")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("x.mp4", done.stderr)
        self.assertEqual((self.folder / "mine.txt").read_text(), "mine")

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_segments_of_a_video_with_feedback(self):
        self.write_feedback()
        run = ("capture", "fb", *SEQUENCE[2:-1], *self.FILM)
        self.succeed(*run, "whole/a.mp4")
        for k in (1, 2, 3):
            self.succeed(*run, "out/a.mp4", "--shard", f"{k}/3")
        self.succeed("gather", "out")
        self.assertEqual(self.contents("out"), self.contents("whole"))
        again = self.run_program("gather", "out")
        self.assertEqual(again.returncode, 1)
        self.assertIn("out/a.mp4 exists", again.stderr)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_segments_refused(self):
        run = (*SEQUENCE[:-1], "-o", "out/a.mp4", "--shard")
        self.succeed(*run, "1/2")
        self.assertRegex(self.succeed(*run, "2/2").stderr, "nothing to draw: .* --state-every ")
        self.expect_failure_like(["gather", "out", "-o", "b.mp4"], 2, r".*\ntidemark: error: -o b.mp4: the shards made segments "
                                 "of 'out/a.mp4' and are joined to that video: remove -o")

    def luma(self, name: str) -> array.array:
        return array.array("H", subprocess.run(["ffmpeg", "-v", "error", "-i", name, "-pix_fmt", "gray12le", "-f", "rawvideo", "-"],
                                               cwd=self.folder, stdout=subprocess.PIPE, check=True).stdout)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_ten_bits_and_alpha_survive_in_a_video_of_shards(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / 97.0, sin(iTime * 31.0), 0.7 + p.x / 999.0); }\n")
        frames = ("capture", "a.glsl", "--size", "64x20", "--frames", "0-5,9", "--fps", "25")
        for folder, name, options in (("plain", "%d.png", ("--depth", "16")),
                                      ("straight", "%d.png", ("--depth", "16", "--alpha", "keep")),
                                      ("multiplied", "%d.tif", ("--depth", "16", "--alpha", "premultiplied"))):
            (self.folder / folder).mkdir()
            for k in (1, 2):
                self.succeed(*frames, *options, "-o", f"{folder}/{name}", "--shard", f"{k}/2")
            self.succeed("gather", folder, "-o", f"{folder}.mov")
            alpha = () if folder == "plain" else options[2:]
            self.succeed(*frames, *alpha, "-o", "whole.mov")
            theirs, ours = (self.luma(name) for name in (f"{folder}.mov", "whole.mov"))
            self.assertEqual(len(theirs), 64 * 20 * 10)  # frame 5 is shown for four ticks
            # Multiplied colours are rounded to 16 bits in the file, before they are to 10.
            self.assertLessEqual(max(abs(a - b) for a, b in zip(theirs, ours)), 16 if folder == "multiplied" else 0, folder)
        self.expect_failure_like(["gather", "plain", "--sample", "0", "-o", "a.mp4", "--codec", "vp9"], 2,
                                 ".*\ntidemark: error: --codec vp9: a .mp4 holds h264, hevc, av1")
        if " libx265 " in subprocess.run(["ffmpeg", "-v", "error", "-encoders"], stdout=subprocess.PIPE, text=True, check=True).stdout:
            self.succeed("gather", "plain", "-o", "a.mp4", "--codec", "hevc")
            self.succeed(*frames, "--codec", "hevc", "-o", "b.mp4")
            self.assertEqual(*((self.folder / name).read_bytes() for name in ("a.mp4", "b.mp4")))
        self.expect_failure_like(["gather", "straight", "--sample", "0", "-o", "a2.mp4"], 2,
                                 ".*\ntidemark: error: -o a2.mp4: .* alpha .*")

    def write_feedback(self) -> None:
        self.write("fb/image.glsl", '#iChannel0 "Buffer A"\n'
                                    "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n")
        self.write("fb/buffer_a.glsl", '#iChannel0 "Buffer A"\nvoid mainImage(out vec4 c, in vec2 p) '
                                       "{ c = texelFetch(iChannel0, ivec2(p), 0) + vec4(p, 1, 1) * 0.001; }\n")

    def test_feedback_continues_from_the_previous_shard(self):
        self.write_feedback()
        run = ("capture", "fb", *SEQUENCE[2:])
        self.succeed(*run, "whole/f_%04d.png")
        for order in ((1, 2), (2, 1)):
            said = [self.succeed(*run, "out/f_%04d.png", "--state-every", "100", "--shard", f"{k}/2").stderr
                    for k in order]
            self.assertEqual("state before frame 5" in said[1], order == (1, 2))
            self.assertIn("wrote 5 frames, out/f_0005.png to out/f_0009.png", "".join(said))
            self.succeed("gather", "out")
            self.assertEqual(self.contents("out"), self.contents("whole"))
            for path in (self.folder / "out").iterdir():
                path.unlink()

    def test_slurm(self):
        task = {"SLURM_ARRAY_TASK_COUNT": "2", "SLURM_ARRAY_TASK_MIN": "4", "SLURM_ARRAY_TASK_STEP": "2"}
        for number in ("4", "6"):
            self.shard("slurm", env=environment(SLURM_ARRAY_TASK_ID=number, **task))
        self.succeed("gather", "out")
        refused = ["capture", "a.glsl", "--frames", "0-9", "-o", "out/f_%04d.png", "--shard"]
        self.expect_error([*refused, "slurm"], 2, "--shard slurm", "SLURM_ARRAY_TASK_ID", "`sbatch --array`",
                          env=environment(SLURM_ARRAY_TASK_ID=None))
        self.expect_error([*refused, "slurm"], 2, "--shard slurm", "task 5", "array of 2", "starts at 4",
                          env=environment(SLURM_ARRAY_TASK_ID="5", **task))
        for text in ("0/2", "3/2", "1", "a/b", "1/2/3"):
            self.expect_failure([*refused, text], 2, f"tidemark: error: --shard {text}: give K/N with K from 1 to N, as in "
                                                     f"2/8, or slurm")

    def test_refused(self):
        self.shard("1/2")
        self.expect_error([*SEQUENCE, "out/f_%04d.png", "--shard", "1/3"], 2,
                          "--shard", "'out/shards.json'", "another capture")
        self.expect_error([*SEQUENCE, "-", "--shard", "1/2"], 2, "--shard", "`tidemark gather`")
        self.expect_failure(["gather", "whole"], 3, "tidemark: error: cannot read 'whole/shards.json': no such file")
        for note in ("", "[]", '{"capture": ["x"], "shards": 0}', '{"capture": [1], "shards": 2}'):
            self.write("whole/shards.json", note)
            self.expect_failure(["gather", "whole"], 3, "tidemark: error: 'whole/shards.json' was not written by `capture "
                                                        "--shard`")
        note = json.loads((self.folder / "out/shards.json").read_text())
        asks = dict(note, capture=[*note["capture"], "--help"])
        self.write("whole/shards.json", json.dumps(asks))
        self.expect_error(["gather", "whole"], 3, "'whole/shards.json'", "--help", "not allowed")
        self.write("whole/shards.json", json.dumps(note))
        self.expect_error(["gather", "whole"], 2, "'whole/shards.json'", "'out/f_%04d.png'")


if __name__ == "__main__":
    main()
