"""The options of `capture` that say what a frame sees: their effect, told by the shader itself, and their
errors."""
import struct

from support import png, probe
from support.program import ROOT, ProgramTest, environment, main

GOOD = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n"
CLOCK = {"iTime": "iTime", "iTimeDelta": "iTimeDelta", "iFrame": "float(iFrame)", "iFrameRate": "iFrameRate"}


def rounded(number: float) -> float:
    """To the nearest 32-bit float, as the shader gets it."""
    return struct.unpack("<f", struct.pack("<f", number))[0]


class Told(ProgramTest):
    """Asks a shader what it sees."""

    # Frames on standard output: without the picture codec a capture takes a fifth of the time.

    def told(self, values: dict[str, str], *options: str, before: str = "", size: tuple[int, int] = (64, 2)
             ) -> dict[str, float]:
        self.write("told.glsl", probe.shader(values, before))
        done = self.succeed("capture", "told.glsl", "--size", "%dx%d" % size, "-o", "-", *options)
        return probe.read(png.from_raw(*size, done.stdout), values)

    def refused(self, option: str, words: str, scene: str = GOOD) -> None:
        self.write("a.glsl", scene)
        with self.subTest(option=option):
            self.expect_error(["capture", "a.glsl", "-o", "-", *option.split(" ")], 2, words)


class Clock(Told):
    def test_default_is_frame_0_at_60_fps(self):
        self.assertEqual(self.told(CLOCK),
                         {"iTime": 0, "iTimeDelta": rounded(1 / 60), "iFrame": 0, "iFrameRate": 60})

    def test_frame(self):
        self.assertEqual(self.told(CLOCK, "--frame", "1000003", "--fps", "30"),
                         {"iTime": rounded(1000003 / 30), "iTimeDelta": rounded(1 / 30), "iFrame": 1000003,
                          "iFrameRate": 30})

    def test_time(self):
        told = self.told(CLOCK, "--time", "2.51", "--fps", "10")
        self.assertEqual(told, {"iTime": rounded(2.51), "iTimeDelta": rounded(0.1), "iFrame": 25,
                                "iFrameRate": 10})

    def test_time_below_zero(self):
        told = self.told(CLOCK, "--time=-1.5")
        self.assertEqual((told["iTime"], told["iFrame"]), (-1.5, 0))

    def test_errors(self):
        self.refused("--frame x", "--frame: give a whole number, not 'x'")
        self.refused("--frame 1.5", "--frame: give a whole number, not '1.5'")
        self.refused("--frame 99999999999", "--frame: give a whole number, not '99999999999'")
        self.refused("--frame -1", "--frame -1: frames count from 0 to 100000000")
        self.refused("--frame 2147483647", "--frame 2147483647: frames count from 0 to 100000000")
        self.refused("--fps x", "--fps: give a number or a fraction as in 24000/1001, not 'x'")
        self.refused("--fps 0", "--fps 0: give a number above 0")
        self.refused("--fps -24", "--fps -24: give a number above 0")
        self.refused("--fps inf", "--fps inf: give a number above 0")
        self.refused("--time soon", "--time: give a number, not 'soon'")
        self.refused("--time nan", "--time: give a number, not 'nan'")
        self.refused("--frame 1 --time 2", "--frame excludes --time")
        self.refused("--frames 1-3 --time 2", "--frames excludes --time")
        for wrong in ("x", "-1", "1-", "1-2x0", "1-2x", "1,", "1;2", "1.5", "0-99999999999"):
            self.refused(f"--frames {wrong}", f"--frames {wrong}: give frames from 0 to 100000000 as in 7, 0-29, 0-120x10 or "
                                              "0-9,20-29")


class Beat(Told):
    def beat(self, *options: str, before: str = "uniform float iBeat;\n") -> float:
        return self.told({"iBeat": "iBeat"}, *options, before=before)["iBeat"]

    def test_default_is_120_bpm(self):
        self.assertEqual(self.beat("--time", "1.25"), 2.5)
        self.assertEqual(self.beat("--frame", "45", "--fps", "30"), 3)

    def test_bpm(self):
        self.assertEqual(self.beat("--time", "1.25", "--bpm", "90"), 1.875)
        self.assertEqual(self.beat("--time", "3600", "--bpm", "174.5"), 10470)

    def test_advances_within_a_sequence(self):
        self.write("told.glsl", probe.shader({"iBeat": "iBeat"}, "uniform float iBeat;\n"))
        done = self.succeed("capture", "told.glsl", "--size", "64x2", "-o", "-", "--frames", "0-8x4", "--fps", "4", "--bpm", "90")
        told = [probe.read(png.from_raw(64, 2, done.stdout[i * 384:(i + 1) * 384]), {"iBeat": "iBeat"})["iBeat"] for i in range(3)]
        self.assertEqual(told, [0, 1.5, 3])

    def test_knob_named_ibeat_is_refused(self):
        self.write("a.glsl", "#iUniform float iBeat = 1.0\n" + GOOD)
        self.expect_error(["capture", "a.glsl", "-o", "-"], 3, "a.glsl:1: error:", "'iBeat'", "the host provides")

    def test_errors(self):
        self.refused("--bpm fast", "--bpm: give a number, not 'fast'")
        self.refused("--bpm 0", "--bpm 0: give a number above 0")
        self.refused("--bpm -120", "--bpm -120: give a number above 0")


class Size(Told):
    RESOLUTION = probe.vector("iResolution", "xyz")

    def test_default(self):
        self.write("a.glsl", GOOD)
        self.succeed("capture", "a.glsl")
        picture = png.read(self.folder / "a.png")
        self.assertEqual((picture.width, picture.height), (640, 360))

    def test_reaches_the_shader(self):
        told = self.told(self.RESOLUTION, size=(31, 17))
        self.assertEqual(list(told.values()), [31, 17, 1])

    def test_size_of_one_pixel(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, 0.2, 0.0); }\n")
        self.succeed("capture", "a.glsl", "--size", "1x1")
        self.assertEqual(png.read(self.folder / "a.png").pixel(0, 0), (128, 128, 51))

    def test_errors(self):
        for wrong in ("0x5", "5x0", "-5x5", "5", "5x", "x5", "5x5x5", "5X5", "axb", "1e3x5",
                      "99999999999x5"):
            self.refused(f"--size={wrong}", f"--size {wrong}: give WIDTHxHEIGHT")

    def test_beyond_the_drivers_limit(self):
        self.write("a.glsl", GOOD)
        self.expect_failure_like(["capture", "a.glsl", "--size", "1000000x6", "--frame", "0", "-o", "a.mp4"], 2,
                                 r"tidemark: error: --size 1000000x6: this driver draws at most \d+ pixels on a "
                                 "side")


class Mouse(Told):
    MOUSE = probe.vector("iMouse", "xyzw")

    def mouse(self, *options: str) -> list[float]:
        return list(self.told(self.MOUSE, *options).values())

    def test_never_touched(self):
        self.assertEqual(self.mouse(), [0, 0, 0, 0])

    def test_after_a_click_z_and_w_are_negative(self):
        self.assertEqual(self.mouse("--mouse", "10,20"), [10, 20, -10, -20])

    def test_in_the_frame_of_the_press_z_and_w_are_positive(self):
        self.assertEqual(self.mouse("--mouse", "10,20,down"), [10, 20, 10, 20])

    def test_a_drag_ends_where_the_button_is_released(self):
        self.assertEqual(self.mouse("--mouse", "10,20,3,4"), [10, 20, -3, -4])

    def test_during_a_drag_only_w_is_negative(self):
        self.assertEqual(self.mouse("--mouse", "10,20,3,4,down"), [10, 20, 3, -4])

    def test_pixels_are_whole(self):
        self.assertEqual(self.mouse("--mouse", "10.9,0.5"), [10, 0, -10, 0])

    def test_errors(self):
        for wrong in ("x", "1", "1,", "1,2,up", "1,2,", "1;2", "nan,1", "1,inf"):
            self.refused(f"--mouse {wrong}", f"--mouse {wrong}: give x,y")


class Date(Told):
    DATE = probe.vector("iDate", "xyzw")

    def test_is_fixed_unless_given(self):
        self.assertEqual(list(self.told(self.DATE).values()), [2024, 0, 1, 43200])

    def test_advances_with_the_time(self):
        self.assertEqual(list(self.told(self.DATE, "--frame", "90", "--fps", "30").values()), [2024, 0, 1, 43203])
        self.assertEqual(list(self.told(self.DATE, "--time", "2.5", "--date", "2023-12-31T23:59:58").values()),
                         [2024, 0, 1, 0.5])
        self.assertEqual(list(self.told(self.DATE, "--time", "86400", "--date", "2024-02-28T12:00:00").values()),
                         [2024, 1, 29, 43200])

    def test_advances_within_a_sequence(self):
        self.write("told.glsl", probe.shader(self.DATE))
        done = self.succeed("capture", "told.glsl", "--size", "64x2", "-o", "-", "--frames", "0-8x4", "--fps", "4",
                            "--date", "2024-12-31T23:59:59")
        told = [list(probe.read(png.from_raw(64, 2, done.stdout[i * 384:(i + 1) * 384]), self.DATE).values())
                for i in range(3)]
        self.assertEqual(told, [[2024, 11, 31, 86399], [2025, 0, 1, 0], [2025, 0, 1, 1]])

    def test_date_applies_to_a_replayed_recording(self):
        self.write("take.txt", "0 press left 1 1\n")
        told = self.told(self.DATE, "--input", "take.txt", "--frame", "30", "--date", "2024-01-01")
        self.assertEqual(list(told.values()), [2024, 0, 1, 0.5])

    def test_counts_months_from_0_and_has_parts_of_a_second(self):
        self.assertEqual(list(self.told(self.DATE, "--date", "2023-12-31T23:59:58.5").values()),
                         [2023, 11, 31, 86398.5])

    def test_a_day_alone_begins_at_midnight(self):
        self.assertEqual(list(self.told(self.DATE, "--date", "2024-02-29").values()), [2024, 1, 29, 0])

    def test_errors(self):
        for wrong in ("2024", "2024-13-01", "2023-02-29", "2024-01-01T24:00:00", "2024-01-01T10:60:00", "today",
                      "2024-01-01T10"):
            self.refused(f"--date {wrong}",
                         f"--date {wrong}: give a date as in 2024-12-31 or 2024-12-31T23:59:58.5")


class Camera(Told):
    COLUMNS = {f"{c}{r}": f"iCamera[{c}][{r}]" for c in range(4) for r in range(4)}

    def test_matrix_is_camera_to_world(self):
        told = list(self.told(self.COLUMNS, "--camera", "90,0,5", before="uniform mat4 iCamera;").values())
        # To the east of the target, looking back along -x: right is -z, up is y, backwards is x.
        for got, wanted in zip(told, [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 5, 0, 0, 1], strict=True):
            self.assertAlmostEqual(got, wanted, places=6)

    def test_errors(self):
        for wrong in ("x", "1,2", "1,2,3,4", "1,2,0", "1,2,-3", "1,,2", "nan,0,1"):
            self.refused(f"--camera {wrong}", f"--camera {wrong}: give azimuth,elevation,distance")


class Knobs(Told):
    DIRECTIVES = ("#iUniform float height = 0.5 in { 0.0, 1.0 }\n#iUniform color3 tint = color3(0.1, 0.2, 0.3)\n"
                  "#iUniform ivec2 cells = ivec2(3, 4)\n")
    VALUES = {"height": "height", "r": "tint.r", "g": "tint.g", "b": "tint.b", "x": "float(cells.x)",
              "y": "float(cells.y)"}

    def knobs(self, *options: str) -> list[float]:
        return list(self.told(self.VALUES, *options, before=self.DIRECTIVES).values())

    def test_defaults_of_the_scene(self):
        self.assertEqual(self.knobs(), [0.5, rounded(0.1), rounded(0.2), rounded(0.3), 3, 4])

    def test_set(self):
        self.assertEqual(self.knobs("--set", "height=0.25", "--set", "tint=#ff0033", "--set", "cells=7,-9"),
                         [0.25, 1, 0, rounded(0x33 / 255), 7, -9])

    def test_one_number_sets_all_components_and_the_last_setting_wins(self):
        self.assertEqual(self.knobs("--set", "tint=0.5", "--set", "cells=ivec2(1, 2)", "--set", "height=2",
                                    "--set", "height=3"),
                         [3, 0.5, 0.5, 0.5, 1, 2])

    def test_errors(self):
        for setting, words in [
            ("hieght=1", "the scene has no knob 'hieght': did you mean 'height'?"),
            ("depth=1", "the scene has no knob 'depth': it has height, tint, cells"),
            ("height", "--set height: give it as NAME=VALUE"),
            ("=1", "--set =1: give it as NAME=VALUE"),
            ("height=tall", "'tall' is not a value for height (float): give a number"),
            ("height=1,2", "'1,2' is not a value for height (float): give a number"),
            ("height=nan", "'nan' is not a value for height (float): give a number"),
            ("tint=#12345", "'#12345' is not a value for tint (color3): give 3 numbers, as in 1,2,3 or #rrggbb"),
            ("cells=1.5,2", "'1.5,2' is not a value for cells (ivec2): give 2 whole numbers, as in 1,2"),
        ]:
            self.refused(f"--set {setting}", words, self.DIRECTIVES + GOOD)

    def test_scene_without_knobs(self):
        self.refused("--set height=1", "the scene has no knob 'height': it declares none with #iUniform")


class Defines(Told):
    BEFORE = "#define STEPS 4\n#define SMOOTH\nconst float reach = 1.5, depth = 2.0;\n"
    VALUES = {"steps": "float(STEPS)", "reach": "reach", "depth": "depth"}

    def test_replace_macros_and_constants(self):
        told = self.told(self.VALUES, "--define", "STEPS=(1 + 8)", "--define", "depth=-3.0", before=self.BEFORE)
        self.assertEqual(list(told.values()), [9, 1.5, -3])

    def test_move_no_line(self):
        self.write("a.glsl", "#define STEPS 4\nvoid mainImage(out vec4 c, in vec2 p) { c = nothing; }\n")
        self.expect_failure_like(["capture", "a.glsl", "-o", "-", "--define", "STEPS=77"], 3,
                                 r"tidemark: error: 'a\.glsl' does not compile\na\.glsl:2(:45)?: error: .*(\n[^\n]+)*")

    def test_errors(self):
        for setting, words in [
            ("STEP=1", "the scene has no #define or const 'STEP': did you mean 'STEPS'?"),
            ("COLOUR=1", "the scene has no #define or const 'COLOUR': it has STEPS, SMOOTH, reach, depth"),
            ("STEPS", "--define STEPS: give it as NAME=VALUE"),
            ("STEPS=1\n2", "--define STEPS: the value must be one line"),
        ]:
            self.refused(f"--define {setting}", words, self.BEFORE + GOOD)

    def test_scene_without_definitions(self):
        self.refused("--define STEPS=1", "the scene has no #define or const 'STEPS': it defines none")


class Channels(Told):
    SIZE = {"width": "iChannelResolution[0].x", "height": "iChannelResolution[0].y",
            "depth": "iChannelResolution[0].z", "red": "texelFetch(iChannel0, ivec2(0), 0).r"}

    def test_channel_without_a_directive_reads_noise(self):
        self.assertEqual(list(self.told(self.SIZE).values())[:3], [256, 256, 1])

    def test_picture(self):
        self.write("three.png", png.encode(3, 2, 3, [bytes(9), bytes([255]) + bytes(8)]))
        self.assertEqual(list(self.told(self.SIZE, "--channel", "0=three.png").values()), [3, 2, 1, 1])

    def test_instead_of_the_scenes_own(self):
        self.write("three.png", png.encode(3, 2, 3, [bytes(9)] * 2))
        told = self.told(self.SIZE, "--channel", "0=three.png", before='#iChannel0 "missing.png"')
        self.assertEqual(list(told.values()), [3, 2, 1, 0])

    def test_none_is_black(self):
        self.assertEqual(list(self.told(self.SIZE, "--channel", "0=none").values()), [0, 0, 0, 0])

    def test_errors(self):
        for wrong in ("10=noise", "-1=noise", "x=noise", "00=noise", "0="):
            self.refused(f"--channel {wrong}",
                         f"--channel {wrong}: give it as N=FILE, N=noise or N=none, N from 0 to 9")
        self.refused("--channel noise", "--channel noise: give it as 0=noise")
        for place in ("0", "9", "Image:1"):
            self.refused(f"--channel {place}",
                         f"--channel {place}: give it as {place}=FILE, {place}=noise or {place}=none")
        self.refused("--channel 10", "--channel 10: give it as N=FILE, N=noise or N=none, N from 0 to 9")



class Specialised(ProgramTest):
    """A long sequence is drawn by another program, in the same bytes."""
    SCENE = ("#iUniform float foam = 0.0 in { 0.0, 1.0 }\n"
             "void mainImage(out vec4 c, in vec2 p) {\n"
             "    c = vec4(0.0);\n"
             "    for (int i = 0; i < 9; ++i)\n"
             "        c += fract(pow(abs(sin(iTime)), 1.7) * p.xyxy / float(i + 3));\n"
             "    if (foam > 0.0)\n"
             "        c += unused();\n"
             "}\n")
    SEQUENCE = ("--size", "160x90", "--frames", "0-99", "-o", "-")

    def drawn(self, *options: str) -> bytes:
        return self.succeed("capture", "a.glsl", *self.SEQUENCE, *options).stdout

    def test_bytes(self):
        self.write("a.glsl", "float unused() { return 1.0; }\n" + self.SCENE)
        frames = self.drawn()
        self.assertEqual(len(frames), 100 * 160 * 90 * 3)
        self.assertEqual(frames, self.drawn("--plain"))
        self.assertNotEqual(frames[:160 * 90 * 3], frames[-160 * 90 * 3:])

    def test_trial_draws_with_the_mouse_of_the_sequence(self):
        self.write("a.glsl", "#iUniform float power = 4.0 in { 1.0, 9.0 }\n" # as a constant: a few products
                             "void mainImage(out vec4 c, in vec2 p) {\n"
                             "    float waves = pow(fract(p.x * 0.37 + 0.1), power);\n"
                             "    c = vec4(iMouse.x > 1.0 ? fract(1e6 * waves) : 0.0);\n}\n")
        self.write("hand.txt", "0 press left 3 2\n")
        trial = ["capture", "a.glsl", "--size", "16x4", "-o", "a.png", "--allow-difference", "0"]
        self.assertEqual(self.succeed(*trial).stderr, "wrote a.png\n")
        self.assertIn("not specialised: it would differ from the plain program by ",
                      self.succeed(*trial, "--input", "hand.txt").stderr)

    def test_plain_compiles_uncalled_functions(self):
        self.write("a.glsl", "float unused() { return 1.0; }\nfloat broken() { return undeclared; }\n" + self.SCENE)
        self.drawn()
        done = self.run_program("capture", "a.glsl", *self.SEQUENCE, "--plain")
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr, r"\na\.glsl:2(:25)?: error: ")

    def test_errors(self):
        self.write("a.glsl", GOOD)
        for option, words in (("--plain --allow-difference 1", "--plain excludes --allow-difference"),
                              ("--allow-difference some", "--allow-difference: give a number, not 'some'")):
            with self.subTest(option=option):
                self.expect_failure(["capture", "a.glsl", *option.split(" ")], 2, f"tidemark: error: {words}")


class OpenGLES(ProgramTest):
    """`--es`: scenes have the same bytes as with OpenGL 4.5, without calls that OpenGL ES lacks. gl_contexts draws every
    conformance scene with OpenGL ES and compares it with the pixels of the convention."""

    CASES = ("common_cube_and_buffer_start_at_zero", "mipmaps_of_a_buffer_that_reads_itself/project.json",
             "volume_has_its_first_bytes_at_the_origin/scene.glsl", "uniforms_of_the_extension/scene.glsl")

    def drawn(self, *words: str, **variables: str) -> bytes:
        """With OpenGL ES. Mesa names each wrong call when MESA_DEBUG is set."""
        done = self.succeed("capture", *words, "--es", "-o", "-", env=environment(MESA_DEBUG="1", **variables))
        self.assertNotIn("User error", done.stderr)
        return done.stdout

    def test_draws_what_opengl_draws(self):
        for case in self.CASES:
            words = (str(ROOT / "tests" / "cases" / "conformance" / case), "--size", "4x4", "--frame", "3")
            with self.subTest(case=case):
                self.assertEqual(self.drawn(*words), self.succeed("capture", *words, "-o", "-").stdout)

    def test_tiles_and_sequences(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, sin(iTime), 1.0); }\n")
        for words in ("--size 70x50 --tile 32", "--frames 0-4 --size 8x8", "--frames 3,5 --size 9x7 --shutter 0.5 --samples 4"):
            with self.subTest(words=words):
                drawn = self.succeed("capture", "a.glsl", *words.split(), "-o", "-").stdout
                self.assertEqual(self.drawn("a.glsl", *words.split()), drawn)
                self.assertEqual(self.drawn("a.glsl", *words.split(), TIDEMARK_READ_BACK="ahead"), drawn)

    def test_features_missing_from_opengl_es(self):
        self.write("a.glsl", GOOD)
        self.expect_error(["capture", "a.glsl", "-o", "-", "--es", "--precision", "double"], 2, "OpenGL ES has no double precision")


if __name__ == "__main__":
    main()
