"""What `capture` writes: names, formats, metadata, --json, raw frames; and what it says when it cannot."""
import hashlib
import json
import resource
import signal
import struct
import subprocess

from support import png
from support.program import PROGRAM, ProgramTest, environment, main

# Every pixel and every frame is another one.
SHADER = """void mainImage(out vec4 c, in vec2 p) {
    c = vec4((p.x - 0.5) / 255.0, (p.y - 0.5) / 255.0, float(iFrame) / 255.0, 0.25);
}
"""
SIZE = ("--size", "7x5")


class CaptureTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("wave.glsl", SHADER)

    def capture(self, *options: str, **more):
        return self.succeed("capture", "wave.glsl", *SIZE, *options, **more)

    def picture(self, name: str) -> png.Picture:
        return png.read(self.folder / name)


class Names(CaptureTest):
    def test_default_is_the_scenes_name_in_this_folder(self):
        done = self.capture()
        self.assertEqual(done.stderr, "wrote wave.png\n")
        self.assertEqual(done.stdout, b"")
        self.assertEqual(self.files(), {"wave.glsl", "wave.png"})

    def test_default_of_several_frames(self):
        done = self.capture("--frames", "8-12x2")
        self.assertEqual(self.files(), {"wave.glsl", "wave.0008.png", "wave.0010.png", "wave.0012.png"})
        self.assertEqual(done.stderr.splitlines()[-1], "wrote 3 frames, wave.0008.png to wave.0012.png")

    def test_ranges_are_inclusive_and_may_run_backwards(self):
        done = self.capture("--frames", "3-1,7,10-14x3", "-o", "f%d.png")
        self.assertEqual(self.files() - {"wave.glsl"}, {f"f{i}.png" for i in (1, 2, 3, 7, 10, 13)})
        self.assertEqual(done.stderr.splitlines()[-1], "wrote 6 frames, f3.png to f13.png")

    def test_patterns(self):
        for pattern, name in [("a.%04d.png", "a.0003.png"), ("b%d.png", "b3.png"), ("c.###.png", "c.003.png"),
                              ("d#.png", "d#.png"), ("d##.png", "d03.png"), ("100%%.png", "100%.png"), ("e.PNG", "e.PNG")]:
            with self.subTest(pattern=pattern):
                done = self.capture("--frame", "3", "-o", pattern)
                self.assertEqual(done.stderr, f"wrote {name}\n")
                self.assertTrue((self.folder / name).exists())

    def test_repeated_frame_numbers_write_one_file(self):
        done = self.capture("--frames", "0-2,1-3,2", "-o", "f%d.png")
        self.assertEqual(self.files() - {"wave.glsl"}, {f"f{i}.png" for i in range(4)})
        self.assertEqual(done.stderr.splitlines()[-1], "wrote 4 frames, f0.png to f3.png")

    def test_a_file_that_exists_is_replaced(self):
        self.write("wave.png", "old")
        self.capture()
        self.assertEqual(self.picture("wave.png").width, 7)

    def test_a_short_capture_shows_no_progress(self):
        done = self.capture("--frames", "0-1", "-o", "f%d.png")
        self.assertEqual(done.stderr.splitlines(), ["wrote 2 frames, f0.png to f1.png"])

    def test_errors(self):
        formats = (".png, .jpg, .jpeg, .tif, .tiff, .exr or .hdr for pictures, in .mp4, .mkv, .webm, .mov, .gif or .webp for a video, or "
                   "in .wav for the sound alone")
        for options, words in [
            ("-o a.xyz", f"cannot tell the format of 'a.xyz': its name must end in {formats}"),
            ("-o a", f"cannot tell the format of 'a': its name must end in {formats}"),
            ("-o a.png --frames 0-1", "-o a.png: 2 frames need a frame number in the name, as in wave.%04d.png"),
            ("-o a%x.png", "-o a%x.png: write the frame number as %04d or ####"),
            ("-o a%d.%d.png", "-o a%d.%d.png: it has two frame numbers; one is enough"),
            ("-o - --json", "--json and -o - both write to standard output: give one of them"),
            ("-o - --depth 16", "--depth: is for picture files only; raw frames have 8 bits, the depth of a video follows from "
                                "--codec"),
            ("--depth 12", "--depth 12: give 8, 16, half or float"),
            ("-o a.exr --depth 16", "'a.exr' cannot hold 16-bit samples: .exr holds half, float"),
            ("-o a.jpg --depth float", "'a.jpg' cannot hold float samples: .jpg holds 8-bit"),
        ]:
            with self.subTest(options=options):
                self.expect_failure(["capture", "wave.glsl", *options.split()], 2, f"tidemark: error: {words}")


class Formats(CaptureTest):
    def test_png_holds_the_pixels(self):
        self.capture("--frame", "9")
        picture = self.picture("wave.png")
        self.assertEqual((picture.depth, picture.channels), (8, 3))
        for x in range(7):
            for y in range(5):
                self.assertEqual(picture.pixel(x, y), (x, y, 9))

    def test_png_of_16_bits_is_drawn_in_floats(self):
        self.capture("--depth", "16", "--frame", "3")
        picture = self.picture("wave.png")
        self.assertEqual(picture.depth, 16)
        self.assertEqual(picture.pixel(3, 1), (3 * 257, 257, 3 * 257))

    def test_metadata(self):
        self.capture("--frame", "90", "--fps", "60")
        text = self.picture("wave.png").text
        self.assertEqual(text["tidemark:Scene"], "wave.glsl")
        self.assertEqual(text["tidemark:Frame"], "90")
        self.assertEqual(text["tidemark:iTime"], "1.5")
        self.assertRegex(text["tidemark:Driver"], r"\A.+, OpenGL 4\..+\Z")
        version = self.succeed("--version").stdout.decode().strip()
        self.assertEqual(text["tidemark:Software"], version)

    def test_metadata_lists_the_drawing_settings(self):
        self.write("k.glsl", "#define LEVEL 1\n#iUniform float gain = 0.25 in { 0.0, 1.0 }\n#iUniform vec3 tint = vec3(1.0)\n"
                             "void mainImage(out vec4 c, in vec2 p) { c = vec4(gain * tint * float(LEVEL), 1.0); }\n")
        report = json.loads(self.succeed(
            "capture", "k.glsl", "--size", "20x10", "--mouse", "12,7,3,4", "--camera", "40,-5,7.5", "--set", "gain=0.5",
            "--set", "tint=0,1,0.5", "--define", "LEVEL=2", "--frame", "3", "--json").stdout)
        text = self.picture("k.png").text
        self.assertEqual({name: text["tidemark:" + name] for name in ("iMouse", "Camera", "Knobs", "Defines", "Size", "Pass")},
                         {"iMouse": "12,7,-3,-4", "Camera": "40,-5,7.5", "Knobs": "gain=0.5; tint=vec3(0, 1, 0.5)",
                          "Defines": "LEVEL=2", "Size": "20x10", "Pass": "Image"})
        frame, = report["frames"]
        self.assertEqual((frame["iMouse"], frame["camera"]), ([12, 7, -3, -4], "40,-5,7.5"))
        self.assertEqual([(knob["name"], knob["value"]) for knob in report["knobs"]],
                         [("gain", [0.5]), ("tint", [0, 1, 0.5])])
        self.assertEqual(report["defines"], ["LEVEL=2"])

    def test_metadata_of_a_recording_are_per_frame(self):
        self.write("c.glsl", "uniform mat4 iCamera;\nvoid mainImage(out vec4 c, in vec2 p) { c = iCamera[3]; }\n")
        self.write("r.txt", "1 press left 10 5\n2 move 15 5\n3 release left\n")
        self.succeed("capture", "c.glsl", "--size", "20x10", "--input", "r.txt", "--frames", "0-2", "-o", "c%d.png")
        texts = [self.picture(f"c{n}.png").text for n in range(3)]
        self.assertEqual([text["tidemark:iMouse"] for text in texts], ["0,0,0,0", "10,5,10,5", "15,5,10,-5"])
        self.assertEqual(texts[0]["tidemark:Camera"], "30,20,10")
        self.assertNotEqual(texts[2]["tidemark:Camera"], "30,20,10")

    def test_other_formats(self):
        for options, start in [("-o a.exr", b"\x76\x2f\x31\x01"), ("-o b.exr --depth float", b"\x76\x2f\x31\x01"),
                               ("-o c.exr --depth half", b"\x76\x2f\x31\x01"), ("-o d.jpg", b"\xff\xd8\xff"),
                               ("-o e.tif --depth 16", b"II*\0"), ("-o f.hdr", b"#?RADIANCE")]:
            with self.subTest(options=options):
                self.capture(*options.split())
                name = options.split()[1]
                self.assertTrue((self.folder / name).read_bytes().startswith(start))

    def test_exr_channel_types(self):
        # In the channel list of an EXR header the type follows the name: 1 is half, 2 is float.
        for options, kind in [("-o a.exr", 1), ("-o a.exr --depth float", 2)]:
            self.capture(*options.split())
            header = (self.folder / "a.exr").read_bytes()[:2000]
            at = header.index(b"chlist\0") + len(b"chlist\0") + 4
            self.assertEqual(header[at:at + 6], b"B\0" + bytes([kind, 0, 0, 0]))

    def test_a_buffer_keeps_its_floats(self):
        (self.folder / "state").mkdir()
        self.write("state/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1e6, 0.1, p); }\n")
        self.write("state/image.glsl", """#iChannel0 "buffer_a.glsl"
void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }
""")
        self.succeed("capture", "state", "--size", "2x1", "--pass", "Buffer A", "-o", "a.exr")
        self.write("reads.glsl", """#iChannel0 "a.exr"
void mainImage(out vec4 c, in vec2 p) { c = vec4(texture(iChannel0, vec2(0.25, 0.5)).rg == vec2(1e6, 0.1)); }
""")
        told = self.succeed("capture", "reads.glsl", "--size", "1x1", "-o", "-").stdout
        self.assertEqual(told, b"\xff\xff\xff")

    def test_float_picture_can_be_read_back_by_a_scene(self):
        self.write("bright.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1000.5, -2.0, p.x, 1.0); }\n")
        self.succeed("capture", "bright.glsl", *SIZE, "-o", "bright.exr", "--depth", "float")
        self.write("reads.glsl", """#iChannel0 "bright.exr"
            void mainImage(out vec4 c, in vec2 p) {
                vec3 t = texelFetch(iChannel0, ivec2(p), 0).rgb;
                c = vec4(t == vec3(1000.5, -2.0, p.x) ? 1.0 : 0.0);
            }
            """)
        self.succeed("capture", "reads.glsl", *SIZE)
        self.assertEqual(set(self.picture("reads.png").rows), {b"\xff" * 21})


class RawFrames(CaptureTest):
    def test_are_rgb_rows_from_the_top_without_a_header(self):
        done = self.capture("--frames", "4,2,2", "-o", "-")
        self.assertEqual(len(done.stdout), 3 * 7 * 5 * 3)
        self.assertEqual(self.files(), {"wave.glsl"})
        frames = [done.stdout[i * 105:(i + 1) * 105] for i in range(3)]
        self.capture("--frames", "2,4", "-o", "f%d.png")
        self.assertEqual(frames[0], b"".join(self.picture("f4.png").rows))
        self.assertEqual(frames[1], b"".join(self.picture("f2.png").rows))
        self.assertEqual(frames[2], frames[1])

    def test_single_frame_prints_no_message(self):
        self.assertEqual(self.capture("-o", "-").stderr, "")


class Json(CaptureTest):
    def test_object_is_complete_and_correct(self):
        done = self.capture("--frames", "0-4x2", "--fps", "30", "-o", "f%03d.png", "--json")
        report = json.loads(done.stdout)
        self.assertEqual(list(report), ["tidemark", "scene", "size", "driver", "renderer", "pass", "precision",
                                        "knobs", "defines", "prepare_milliseconds", "left_out", "frames"])
        self.assertEqual(report["scene"], "wave.glsl")
        self.assertEqual(report["size"], [7, 5])
        self.assertEqual(f"tidemark {report['tidemark']}\n".encode(), self.succeed("--version").stdout)
        self.assertEqual(report["left_out"], [
            "uniforms: iResolution, iTime, iTimeDelta, iFrameRate, iMouse, iDate, iSampleRate, iChannelTime, "
            "iChannelResolution, iCamera, iOrbit, iOrbitPan, iTimeLow, iBeat, iMouseButton, iViewMatrix",
            "channels: iChannel0, iChannel1, iChannel2, iChannel3", "noise texture"])
        self.assertEqual([f["frame"] for f in report["frames"]], [0, 2, 4])
        self.assertEqual([f["iTime"] for f in report["frames"]], [0, 2 / 30, 4 / 30])
        self.assertEqual([f["file"] for f in report["frames"]], ["f000.png", "f002.png", "f004.png"])
        for frame in report["frames"]:
            self.assertEqual(list(frame), ["frame", "iTime", "iMouse", "camera", "file", "sha256", "not_finite",
                                           "passes_drawn", "milliseconds"])
            self.assertEqual(frame["sha256"], self.picture(frame["file"]).sha256())
            self.assertGreater(frame["milliseconds"], 0)

    def test_frame_alone_equals_the_same_frame_of_a_sequence(self):
        self.write("wave.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(p.x * 0.37 + iTime * "
                                "7.3), iTimeDelta * 20.0, fract(float(iFrame) * 0.1), 1.0); }\n")
        sequence = json.loads(self.capture("--frames", "0-12", "-o", "s%d.png", "--json").stdout)["frames"]
        self.assertEqual(len({frame["sha256"] for frame in sequence}), 13)
        for frame in (0, 7, 12):
            alone = json.loads(self.capture("--frame", f"{frame}", "-o", "alone.png", "--json").stdout)["frames"]
            self.assertEqual(alone[0]["sha256"], sequence[frame]["sha256"])
            # The files are the same too, to the byte.
            self.assertEqual((self.folder / "alone.png").read_bytes(),
                             (self.folder / f"s{frame}.png").read_bytes())

    def test_discarded_pixels_keep_earlier_frames(self):
        self.write("wave.glsl", "void mainImage(out vec4 c, in vec2 p) {\n"
                                "    if (iFrame == 1 && p.x < 3.0)\n        discard;\n"
                                "    c = vec4(1.0, float(iFrame) * 0.5, 0.0, 1.0);\n}\n")
        sequence = json.loads(self.capture("--frames", "0-1", "-o", "s%d.png", "--json").stdout)["frames"]
        alone = json.loads(self.capture("--frame", "1", "-o", "alone.png", "--json").stdout)["frames"]
        self.assertEqual(alone[0]["sha256"], sequence[1]["sha256"])
        self.assertEqual(self.picture("alone.png").pixel(0, 0)[:3], (255, 0, 0))
        self.expect_error(["capture", "wave.glsl", *SIZE, "--tile", "2"], 2, "--tile", "Image")

    def test_hash_of_a_float_picture_covers_its_floats(self):
        self.write("wave.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p.x, -p.y, 1000.25, 0.0); }\n")
        report = json.loads(self.capture("-o", "a.exr", "--depth", "float", "--json").stdout)
        floats = [value for y in reversed(range(5)) for x in range(7) for value in (x + 0.5, -y - 0.5, 1000.25, 1.0)]
        self.assertEqual(report["frames"][0]["sha256"],
                         hashlib.sha256(struct.pack("<140f", *floats)).hexdigest())


class SixFaces(ProgramTest):
    """A cube as six files, which another scene reads as that cube."""
    CUBE = """void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) {
    c = vec4(0.5 + 0.5 * d, 1) * (p.x < 300.0 ? 0.5 : 1.0) + (float(iFrame) + floor(p.y / 512.0)) * 0.01;
}
"""
    LOOK = """void mainImage(out vec4 c, in vec2 p) {
    vec3 d = vec3(fract(p.x / 32.0) * 1.8 - 0.9, fract(p.y / 32.0) * 1.8 - 0.9, p.y < 32.0 ? 1 : -1);
    c = texture(iChannel0, p.x < 32.0 ? d : p.x < 64.0 ? d.zxy : d.yzx);
}
"""

    def test_are_read_back_as_that_cube(self):
        self.write("s/cube_a.glsl", self.CUBE)
        self.write("s/image.glsl", '#iChannel0 "cube_a"\n' + self.LOOK)
        self.write("files.glsl", '#iChannel0 "sky_{}.3.png"\n#iChannel0::Type "CubeMap"\n'
                                 '#iChannel0::WrapMode "Clamp"\n' + self.LOOK)
        done = self.succeed("capture", "s", "--pass", "Cube A", "--frame", "3", "-o", "sky_{}.%d.png")
        self.assertEqual(done.stderr, "wrote sky_{}.3.png\n")
        self.assertLessEqual({f"sky_{side}{axis}.3.png" for side in "pn" for axis in "xyz"}, self.files())
        size = ("--size", "96x64")
        self.succeed("capture", "s", *size, "--frame", "3", "-o", "pass.png")
        self.succeed("capture", "files.glsl", *size, "-o", "files.png")
        drawn, read = (png.read(self.folder / name).rgba_from_top() for name in ("pass.png", "files.png"))
        self.assertGreater(len(set(drawn)), 100)
        self.assertLessEqual(max(abs(a - b) for a, b in zip(drawn, read)), 1)

    def test_require_a_cube_pass(self):
        self.write("wave.glsl", SHADER)
        self.expect_error(["capture", "wave.glsl", *SIZE, "-o", "a{}.png"], 2, "-o a{}.png", "--pass", "Cube A")


class CannotWrite(CaptureTest):
    def test_is_reported_before_compiling(self):
        self.write("broken.glsl", "void mainImage(out vec4 c, in vec2 p) { c = none; }\nvec2 mainSound(float t) { none; }\n")
        for name in ("wave.glsl/a.png", "wave.glsl/%04d.exr", "wave.glsl/a.mp4", "wave.glsl/a.wav"):
            with self.subTest(name=name):
                done = self.run_program("capture", "broken.glsl", *SIZE, "--frame", "0", "-o", name)
                self.assertEqual(done.returncode, 4)
                self.assertRegex(done.stderr, r"\Atidemark: error: cannot .*'wave\.glsl.*: (Not a directory|File exists)\n\Z")
        self.assertEqual(self.files(), {"wave.glsl", "broken.glsl"})

    def test_folder_cannot_be_created(self):
        self.expect_error(["capture", "wave.glsl", *SIZE, "-o", "/proc/none/a.png"], 4, "'/proc/none", "No such file or directory")

    def test_file_in_place_of_the_folder(self):
        self.expect_failure(["capture", "wave.glsl", *SIZE, "-o", "wave.glsl/a.png"], 4,
                            "tidemark: error: cannot write 'wave.glsl/a.png': Not a directory")

    def test_folder_in_place_of_the_file(self):
        (self.folder / "a.png").mkdir()
        self.expect_failure(["capture", "wave.glsl", *SIZE, "-o", "a.png"], 4,
                            "tidemark: error: cannot write 'a.png': Is a directory")

    def test_full_disk(self):
        def small_files_only():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))

        self.write("loud.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(sin(dot(p, vec2(91.7, 3.1))) * 4311.3)); }\n")
        self.write("a.png", "what was there before")
        self.expect_failure(["capture", "loud.glsl", "--size", "64x64", "-o", "a.png"], 4,
                            "tidemark: error: cannot write 'a.png': File too large", preexec_fn=small_files_only)
        self.assertEqual((self.folder / "a.png").read_text(), "what was there before")

    def test_many_frames_give_one_error(self):
        done = self.run_program("capture", "wave.glsl", *SIZE, "--frames", "0-20", "-o", "wave.glsl/%d.png")
        self.assertEqual(done.returncode, 4)
        errors = [line for line in done.stderr.splitlines() if "error" in line]
        self.assertEqual(errors, ["tidemark: error: cannot write 'wave.glsl/0.png': Not a directory"])
        self.assertEqual(self.files(), {"wave.glsl"})

    def test_full_standard_output(self):
        for options in (["--json"], ["-o", "-"]):
            with self.subTest(options=options), open("/dev/full", "wb") as full:
                done = self.run_program("capture", "wave.glsl", *SIZE, *options, stdout=full)
                self.assertEqual(done.stderr,
                                 "tidemark: error: cannot write to standard output: No space left on device\n")
                self.assertEqual(done.returncode, 4)

    def test_closed_standard_output(self):
        for options in ("--json", "-o -"):
            with self.subTest(options=options):
                line = f'exec "$0" capture wave.glsl {" ".join(SIZE)} {options} >&-'
                done = subprocess.run(["bash", "-c", line, PROGRAM], cwd=self.folder, env=environment(),
                                      stderr=subprocess.PIPE, text=True)
                self.assertEqual(done.stderr,
                                 "tidemark: error: cannot write to standard output: Bad file descriptor\n")
                self.assertEqual(done.returncode, 4)

    def test_pipe_closed_by_its_reader(self):
        line = f'("$0" capture wave.glsl {" ".join(SIZE)} --frames 0-99999 -o - 2>err; echo $? >code) | head -c 105'
        done = subprocess.run(["bash", "-c", line, PROGRAM], cwd=self.folder, env=environment(),
                              stdout=subprocess.PIPE, timeout=120)
        self.assertEqual(len(done.stdout), 105, (self.folder / "err").read_text())
        self.assertEqual((self.folder / "code").read_text(), "4\n")
        self.assertEqual((self.folder / "err").read_text().splitlines()[-1],
                         "tidemark: error: cannot write to standard output: Broken pipe")

    def test_closed_standard_error_is_ignored(self):
        line = f'exec "$0" capture wave.glsl {" ".join(SIZE)} 2>&-'
        done = subprocess.run(["bash", "-c", line, PROGRAM], cwd=self.folder, env=environment())
        self.assertEqual(done.returncode, 0)
        self.assertEqual(self.picture("wave.png").width, 7)


class Repeatable(CaptureTest):
    def test_same_command_writes_the_same_bytes(self):
        self.capture("-o", "a.png")
        self.capture("-o", "b.png")
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())
        self.assertEqual(hashlib.sha256(self.picture("a.png").rgba_from_top()).hexdigest(),
                         self.picture("b.png").sha256())


if __name__ == "__main__":
    main()
