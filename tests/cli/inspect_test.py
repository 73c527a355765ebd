"""`inspect`: what a scene needs, what was left out, and where it can be drawn."""
import contextlib
import functools
import json
import os
import subprocess
import wave

from support import png
from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, has_mesa_22, main

SCENE = """#include "lib.glsl"
#iChannel1 "noise"
#iUniform float height = 0.5 in { 0.0, 2.0 }
#iUniform color3 tint = color3(1.0, 0.5, 0.0)
void mainImage(out vec4 c, in vec2 p) { c = vec4(height * texture(iChannel1, p).r + fract(iTime)); }
"""
LIB = "float unused() { return 1.0; }\n"


class Scene(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("sea.glsl", SCENE)
        self.write("lib.glsl", LIB)

    def test_json(self):
        done = self.succeed("inspect", "sea.glsl", "--json", "--set", "height=1.25")
        self.assertEqual(done.stderr, "")
        facts = json.loads(done.stdout)
        self.assertEqual(list(facts), ["tidemark", "scene", "driver", "renderer", "files", "uniforms", "passes",
                                       "sounds", "knobs", "definitions", "precision", "left_out"])
        self.assertEqual(facts["scene"], "sea.glsl")
        self.assertEqual(facts["files"], ["sea.glsl", "lib.glsl"])
        self.assertEqual(sorted(facts["uniforms"]), ["height", "iChannel1", "iTime"])
        sizes = facts["passes"][0].pop("program")
        self.assertEqual(list(sizes), ["plain", "specialised", "long_sequence", "constant_knobs"])
        self.assertEqual(facts["passes"], [{
            "name": "Image", "channels": {"iChannel1": "noise"},
            "code_removed": {"lines": 1, "out_of_loops": 0}, "marches": []}])
        self.assertEqual(facts["knobs"], [
            {"name": "height", "type": "float", "value": [1.25], "low": [0], "high": [2]},
            {"name": "tint", "type": "color3", "value": [1, 0.5, 0]}])
        self.assertEqual(facts["left_out"], [
            "uniforms: iResolution, iTimeDelta, iFrameRate, iFrame, iMouse, iDate, iSampleRate, iChannelTime, "
            "iChannelResolution, iCamera, iOrbit, iOrbitPan, iTimeLow, iBeat, iMouseButton, iViewMatrix",
            "knobs: tint", "channels: iChannel0, iChannel2, iChannel3"])

    def test_unread_uniforms_are_left_out(self):
        self.write("own.glsl", "uniform vec4 iOrbit;\nuniform mat4 iCamera;\nvoid mainImage(out vec4 c, in vec2 p) "
                   "{ c = iOrbit + iCamera[3] + iMouseButton; }\n")
        facts = json.loads(self.succeed("inspect", "own.glsl", "--json").stdout)
        self.assertEqual(sorted(facts["uniforms"]), ["iCamera", "iMouseButton", "iOrbit"])
        left_out = facts["left_out"][0].removeprefix("uniforms: ").split(", ")
        self.assertEqual([name for name in left_out if name in ("iCamera", "iOrbit", "iOrbitPan", "iMouseButton", "iViewMatrix")],
                         ["iOrbitPan", "iViewMatrix"])

    def test_text(self):
        lines = self.succeed("inspect", "sea.glsl").stdout.decode().splitlines()
        self.assertEqual(lines[0], "sea.glsl")
        self.assertRegex(lines[1], r"\A  driver    .+, OpenGL 4\.")
        if "program bytes" in lines[5]:  # the driver's to tell
            lines.pop(5)
        self.assertEqual(lines[3:], [
            "  iChannel1 noise", "  code removed: 1 lines", "  knob      float height = 0.5 in { 0, 2 }",
            "  knob      color3 tint = vec3(1, 0.5, 0)",
            "  left out  uniforms: iResolution, iTimeDelta, iFrameRate, iFrame, iMouse, iDate, iSampleRate, "
            "iChannelTime, iChannelResolution, iCamera, iOrbit, iOrbitPan, iTimeLow, iBeat, iMouseButton, iViewMatrix",
            "  left out  knobs: tint", "  left out  channels: iChannel0, iChannel2, iChannel3"])

    def test_a_scene_without_channels_gets_no_noise(self):
        self.write("plain.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        facts = json.loads(self.succeed("inspect", "plain.glsl", "--json").stdout)
        del facts["passes"][0]["program"]
        self.assertEqual((facts["uniforms"], facts["passes"]), ([], [{
            "name": "Image", "channels": {},
            "code_removed": {"lines": 0, "out_of_loops": 0,
                             "none_because": "there is nothing to leave out"}, "marches": []}]))
        self.assertEqual(facts["left_out"][-1], "noise texture")

    def test_without_a_driver(self):
        # No library of the driver's is so much as opened.
        done = self.succeed("inspect", "sea.glsl", "--json", "--device", "none", "--set", "height=1.25",
                            env=environment(LD_DEBUG="files"))
        self.assertNotRegex(done.stderr, "libLLVM|libGLX_mesa|libEGL_mesa|_dri.so|tidemark_pictures")
        facts = json.loads(done.stdout)
        self.assertEqual(list(facts), ["tidemark", "scene", "files", "passes", "sounds", "knobs", "definitions"])
        self.assertEqual(facts["sounds"], [])
        self.assertEqual(facts["files"], ["sea.glsl", "lib.glsl"])
        self.assertEqual(facts["passes"], [{"name": "Image", "channels": {"iChannel1": "noise"}}])
        self.assertEqual(facts["knobs"], json.loads(self.succeed("inspect", "sea.glsl", "--json", "--set",
                                                                 "height=1.25").stdout)["knobs"])
        self.assertEqual(self.succeed("inspect", "sea.glsl", "--device", "none").stdout.decode().splitlines(), [
            "sea.glsl", "  file      sea.glsl", "  file      lib.glsl", "  pass      Image", "  iChannel1 noise",
            "  knob      float height = 0.5 in { 0, 2 }", "  knob      color3 tint = vec3(1, 0.5, 0)"])

    def test_length_rate_and_channels_of_sounds(self):
        with contextlib.closing(wave.open(str(self.folder / "song.wav"), "wb")) as file:
            file.setnchannels(1)
            file.setsampwidth(2)
            file.setframerate(48000)
            file.writeframes(bytes(2 * 12000))
        self.write("s/image.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        self.write("s/buffer_a.glsl", '#iChannel2 "../song.wav"\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n')
        for options in ((), ("--device", "none")):
            facts = json.loads(self.succeed("inspect", "s", "--allow-outside", "--json", *options).stdout)
            self.assertEqual(facts["sounds"], [{"channel": "Buffer A iChannel2 song.wav", "file": "song.wav",
                                                "seconds": 0.25, "rate": 48000, "channels": 1}])
            self.assertIn("  sound     Buffer A iChannel2 song.wav: 0.250 s, 48 kHz mono\n",
                          self.succeed("inspect", "s", "--allow-outside", *options).stdout.decode())

    def test_names_all_six_files_of_a_cube(self):
        for face in ("px", "nx", "py", "ny", "pz", "nz"):
            self.write(f"sky_{face}.png", png.encode(2, 2, 3, [bytes(6)] * 2))
        self.write("sky.glsl", '#iChannel0 "sky_{}.png"\n#iChannel0::Type "CubeMap"\n'
                               "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, vec3(p, 1.0)); }\n")
        files = "sky_px.png, sky_nx.png, sky_py.png, sky_ny.png, sky_pz.png, sky_nz.png"
        for options in ((), ("--device", "none")):
            facts = json.loads(self.succeed("inspect", "sky.glsl", "--json", *options).stdout)
            self.assertEqual(facts["passes"][0]["channels"], {"iChannel0": files})
            self.assertIn(f"  iChannel0 {files}\n", self.succeed("inspect", "sky.glsl", *options).stdout.decode())

    def test_lists_definitions_with_their_values(self):
        (self.folder / "project").mkdir()
        self.write("project/common.glsl", "#define PI 3.14\nconst int STEPS = \t 64; // many\n#define SQUARE(x) ((x)*(x))\n")
        self.write("project/image.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(PI); }\n")
        facts = json.loads(self.succeed("inspect", "project", "--json", "--define", "PI=3").stdout)
        self.assertEqual(facts["definitions"], {"PI": "3", "STEPS": "64"})
        self.assertIn("  define    STEPS = 64", self.succeed("inspect", "project").stdout.decode().splitlines())

    def test_unanalysable_code_is_kept(self):
        self.write("odd.glsl", "#ifdef GL_ARB_gpu_shader5\n#endif\nfloat unused;\n"
                               "#if GL_ARB_gpu_shader5\nfloat doubtful;\n#endif\n"
                               "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        self.assertIn("  code removed: none, because odd.glsl:5:1: error: cannot tell whether this line is compiled",
                      self.succeed("inspect", "odd.glsl").stdout.decode().splitlines())

    def test_source_of_a_long_sequence(self):
        self.write("loop.glsl", "float heavy() { return 1.0; }\n"
                                "void mainImage(out vec4 c, in vec2 p) {\n"
                                "    c = vec4(0.0);\n"
                                "    for (int i = 0; i < 9; ++i)\n"
                                "        c += sin(iTime) * float(i);\n"
                                "}\n")
        self.assertIn("  code removed: 1 lines; in a long sequence also 1 expressions moved out of loops", self.succeed("inspect", "loop.glsl").stdout.decode().splitlines())
        plain = self.succeed("inspect", "loop.glsl", "--source").stdout.decode()
        self.assertIn("float heavy()", plain)
        text = self.succeed("inspect", "loop.glsl", "--source", "--specialised").stdout.decode()
        self.assertNotIn("heavy", text)
        self.assertEqual(text.count("sin"), 1)
        self.assertEqual(text.count("\n"), plain.count("\n"))
        self.expect_failure(["inspect", "loop.glsl", "--specialised"], 2, "tidemark: error: --specialised requires --source")

    def sizes(self, scene):
        facts = json.loads(self.succeed("inspect", scene, "--json").stdout)
        if facts["passes"][0]["program"]["plain"]["bytes"] is None:
            self.skipTest("this driver has no form of its own")
        return facts["passes"][0]["program"]

    def test_counts_of_the_drivers_program(self):
        # Every driver removes a function that is not called; a loop over a knob's value it must keep.
        self.write("knob.glsl", "#iUniform int waves = 0 in { 0, 9 }\n"
                                "void mainImage(out vec4 c, in vec2 p) {\n"
                                "    c = vec4(p * 0.01, 0.0, 1.0);\n"
                                "    if (waves > 0)\n"
                                "        for (int i = 0; i < waves; ++i)\n"
                                "            c += sin(c.yzwx * float(i)) + cos(c.zwxy * float(i));\n"
                                "}\n")
        sizes = self.sizes("knob.glsl")
        self.assertLess(sizes["constant_knobs"]["bytes"], sizes["plain"]["bytes"])
        self.assertLessEqual(sizes["long_sequence"]["bytes"], sizes["plain"]["bytes"])
        self.assertLessEqual(sizes["specialised"]["bytes"], sizes["plain"]["bytes"])
        self.assertEqual(sizes, self.sizes("knob.glsl"), "what was compiled before is no matter")
        self.assertIn("  program bytes: {}; without optimisation {}, in a long sequence {}, with constant knobs {}".format(
            *(sizes[how]["bytes"] for how in ("specialised", "plain", "long_sequence", "constant_knobs"))),
            self.succeed("inspect", "knob.glsl").stdout.decode().splitlines())

    def test_each_pass_has_its_own_program(self):
        self.write("p/image.glsl", '#iChannel0 "buffer_a.glsl"\n'
                   "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n")
        self.write("p/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = sin(p.xyxy) * cos(iTime); }\n")
        self.write("p/buffer_b.glsl", "void mainImage(out vec4 c, in vec2 p) { this is not GLSL }\n")  # not drawn
        self.sizes("p")
        passes = json.loads(self.succeed("inspect", "p", "--json").stdout)["passes"]
        self.assertEqual([one["name"] for one in passes], ["Buffer A", "Image"])
        self.assertNotEqual(*(one["program"]["plain"]["bytes"] for one in passes))

    def test_writes_no_file(self):
        temporary = self.folder / "temporary"
        temporary.mkdir()
        before = self.files()
        self.succeed("inspect", "sea.glsl", env=environment(TMPDIR=str(temporary)))
        self.assertEqual((self.files(), list(temporary.iterdir())), (before, []))

    def test_standard_output_that_is_full(self):
        with open("/dev/full", "wb") as full:
            done = self.run_program("inspect", "sea.glsl", "--json", stdout=full)
        self.assertEqual(done.stderr, "tidemark: error: cannot write to standard output: No space left on device\n")
        self.assertEqual(done.returncode, 4)


class Savings(ProgramTest):
    """What was left out is put back, measured, and changes nothing."""

    def savings(self, scene, *things):
        done = self.succeed("inspect", scene, "--with", ",".join(things), "--size", "16x9", "--budget", "30", "--json")
        report = json.loads(done.stdout)
        return {row["with"]: row for row in report["savings"]}, report["libraries"]

    def test_code(self):
        self.write("a.glsl", "float unused() { return 1.0; }\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(p, 0, 1); }\n")
        rows, _ = self.savings("a.glsl", "code")
        self.assertTrue(rows["code"]["left_out"])
        self.assertTrue(rows["code"]["same_pixels"])

    def project(self):
        self.write("p/image.glsl", '#iChannel0 "buffer_b.glsl"\n'
                   "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0) + fract(iTime); }\n")
        self.write("p/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, iTime, 1); }\n")
        self.write("p/buffer_b.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.25); }\n")

    def test_each_item_adds_work_and_changes_no_pixel(self):
        self.project()
        rows, _ = self.savings("p", "passes", "unchanged", "frames", "uniforms", "mipmaps", "second-textures")
        size = 16 * 9 * 16  # of a buffer
        for thing, key, without, with_it in (("passes", "draws", 1, 2), ("unchanged", "draws", 1, 2),
                                                ("frames", "draws", 1, 11)):
            self.assertEqual((rows[thing]["without"][key], rows[thing]["with_it"][key]), (without, with_it), thing)
        more = {thing: row["with_it"]["texture_bytes"] - row["without"]["texture_bytes"] for thing, row in rows.items()}
        self.assertEqual(more, {"passes": size, "unchanged": 0, "frames": 0, "uniforms": 0, "second-textures": size,
                                "mipmaps": 16 * (8 * 4 + 4 * 2 + 2 + 1)})
        self.assertGreater(rows["uniforms"]["with_it"]["uniforms"], rows["uniforms"]["without"]["uniforms"])
        for row in rows.values():
            self.assertTrue(row["same_pixels"])
            for time in (row["start"], row["frame"]):
                self.assertGreater(time["wall_ms"]["without"], 0)
                self.assertLessEqual(time["wall_ms"]["low"], time["wall_ms"]["high"])

    def test_alpha(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = fract(p.xyxy * vec4(0.37, 0.61, 0.83, 0.29)); }\n")
        rows, _ = self.savings("a.glsl", "alpha")
        row = rows["alpha"]
        self.assertEqual((list(row), row["left_out"], row["same_pixels"]),
                         (["with", "left_out", "file", "without", "with_it", "same_pixels"], True, True))
        self.assertEqual(row["without"]["draws"], row["with_it"]["draws"])
        # As large as what capture writes, but for what says what the picture is and its samples stand for.
        self.succeed("capture", "a.glsl", "--size", "16x9", "--frame", "61", "-o", "a.png")
        file = (self.folder / "a.png").read_bytes()
        facts = [12 + len(data) for kind, data in png.chunks(file)
                 if kind in (b"sRGB", b"gAMA", b"cHRM") or kind == b"tEXt" and data.startswith(b"tidemark:")]
        self.assertEqual((png.decode(file).channels, len(file) - sum(facts)), (3, row["without"]["file_bytes"]))
        self.assertGreater(row["with_it"]["file_bytes"], row["without"]["file_bytes"])
        self.assertGreater(row["file"]["cpu_ms"]["without"], 0)
        text = self.succeed("inspect", "a.glsl", "--with", "alpha", "--size", "16x9", "--budget", "30").stdout.decode()
        self.assertRegex(text, r"alpha +encoding a PNG: [\d.]+ [+-][\d.]+ \[.+\], \d+ -> \d+ bytes; its colours are the same\n")

    def test_alpha_other_than_1_is_not_left_out(self):
        self.project()
        self.write("p/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, 0, 0.5); }\n")
        done = self.succeed("inspect", "p", "--pass", "Buffer A", "--with", "alpha", "--size", "16x9", "--budget", "30",
                            "--json")
        self.assertFalse(json.loads(done.stdout)["savings"][0]["left_out"])

    def test_needed_items_are_not_left_out(self):
        self.write("self.glsl", '#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) '
                                "{ c = texelFetch(iChannel0, ivec2(p), 0) + 0.125; }\n")
        rows, _ = self.savings("self.glsl", "frames", "passes")
        self.assertEqual([row["left_out"] for row in rows.values()], [False, False])

    def test_all_measures_each_item_their_sum_and_the_libraries(self):
        self.project()
        rows, libraries = self.savings("p", "all")
        self.assertEqual(list(rows)[-1], "all")
        self.assertEqual(rows["all"]["with_it"]["draws"], 33)
        self.assertTrue(rows["all"]["same_pixels"])
        self.assertEqual([(library["name"], library["left_out"]) for library in libraries],
                         [("OpenImageIO", True), ("libsndfile", True)])
        self.assertGreater(libraries[0]["wall_ms"], 0)

    def test_prints_a_table(self):
        self.project()
        text = self.succeed("inspect", "p", "--with", "passes", "--size", "16x9", "--budget", "30").stdout.decode()
        self.assertRegex(text, r"passes +[\d.]+ [+-][\d.]+ \[.+\] .+ 1 -> 2 .+ the same\n")

    def test_budget_limits_the_time_and_cut_items_are_named(self):
        self.write("heavy.glsl", "float unused() { return 1.0; }\nvoid mainImage(out vec4 c, in vec2 p) {\n    c = vec4(0.0);\n"
                                 "    for (int i = 0; i < 20000; ++i) c += sin(c + p.x * float(i));\n}\n")
        done = self.run_program("inspect", "heavy.glsl", "--with", "all", "--size", "64x64", "--budget", "0.01", "--json")
        self.assertEqual(done.returncode, 5, done.stderr)
        rows = json.loads(done.stdout)["savings"]
        self.assertTrue(all(row["cut"].startswith("--budget is spent: ") for row in rows), rows)
        text = self.run_program("inspect", "heavy.glsl", "--with", "code", "--size", "64x64", "--budget", "0.01").stdout.decode()
        self.assertRegex(text, r"\ncode +not measured: --budget is spent: [\d.e-]+ s are left, and starting takes [\d.e-]+ s\n")

    def test_unknown_item(self):
        done = self.run_program("inspect", "p", "--with", "wings")
        self.assertEqual(done.returncode, 2)
        self.assertIn("second-textures", done.stderr)


@functools.cache
def listed_devices() -> list[dict]:
    """Listed once: it starts every driver."""
    done = subprocess.run([PROGRAM, "inspect", "--devices", "--json"], stdout=subprocess.PIPE, env=environment(),
                          timeout=TIME_LIMIT, check=True)
    return json.loads(done.stdout)["devices"]


class Devices(ProgramTest):
    def test_lists_devices_that_capture_accepts(self):
        devices = listed_devices()
        names = [device["name"] for device in devices]
        self.assertEqual((names[0], names[-4:]), ("surfaceless", ["display", "mesa:llvmpipe", "mesa:softpipe", "mesa:zink"]))
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        for device in devices:
            with self.subTest(device=device["name"]):
                done = self.run_program("capture", "a.glsl", "--size", "4x4", "-o", "-", "--device", device["name"])
                self.assertEqual(done.returncode, 77 if "unusable" in device else 0)

    def test_other_versions_of_a_driver_are_listed(self):
        """softpipe has no OpenGL 4.5; the list says which versions it has."""
        devices = {d["name"]: d for d in listed_devices()}
        self.assertRegex(devices["mesa:llvmpipe"]["es_version"], r"^OpenGL ES 3\.[12] ")
        self.assertRegex(devices["mesa:softpipe"]["unusable"],
                         r"no OpenGL 4\.5 core \(\w+\), only OpenGL 3\.3 .*; it has OpenGL ES 3\.1 .*: `check --portable` and `capture --es`")
        self.assertRegex(self.succeed("inspect", "--devices", "--device", "mesa:llvmpipe").stdout.decode(), ", OpenGL ES 3")

    def test_without_a_driver_the_reason_is_printed(self):
        """Chromium needs none of these drivers; it is listed where it is installed."""
        chromium = self.write("bin/chromium", "#!/bin/false\n")
        chromium.chmod(0o755)
        for path, browsers in (("/nowhere", []), (str(chromium.parent), ["chromium"])):
            done = self.succeed("inspect", "--devices", env=environment(__EGL_VENDOR_LIBRARY_FILENAMES="/dev/null", PATH=path))
            lines = done.stdout.decode().splitlines()
            drivers = ["surfaceless", "display", "mesa:llvmpipe", "mesa:softpipe", "mesa:zink"]
            self.assertEqual([line.split()[0] for line in lines], drivers + browsers)
            for line in lines[:len(drivers)]:
                self.assertRegex(line, r"^\S+ +unusable: no driver offers it \(EGL_BAD_PARAMETER\)$")
            for line in lines[len(drivers):]:
                self.assertRegex(line, "`compare --devices` only; also chromium:swiftshader, chromium:egl$")

    def test_zink_needs_a_vulkan_driver(self):
        """Mesa 25's zink would wait for ever without one."""
        done = self.succeed("inspect", "--devices", "--device", "mesa:zink",
                            env=environment(VK_DRIVER_FILES="/dev/null", VK_ICD_FILENAMES="/dev/null"))
        self.assertEqual(done.stdout.decode(), "mesa:zink      unusable: there is no Vulkan driver\n")

    def test_selects_one_device_by_name(self):
        done = self.succeed("inspect", "--devices", "--device", "mesa:llvmpipe")
        self.assertRegex(done.stdout.decode(), r"^mesa:llvmpipe  software, llvmpipe .*\n$")
        self.expect_error(["inspect", "--devices", "--device", "nothing"], 2, "--device nothing")


class SelfTest(ProgramTest):
    def test_each_device_gets_its_verdicts(self):
        """The first device of each driver; `./dev soak` takes all of them, which is a minute of CPU time a device."""
        listed = [device for device in listed_devices()
                  if "unusable" not in device and not device["name"].startswith("mesa:")]
        chosen = {device["renderer"]: device["name"] for device in reversed(listed)}
        if os.environ.get("TIDEMARK_SCENES") == "all":
            chosen = {device["name"]: device["name"] for device in listed}
        devices = []
        for name in chosen.values():
            done = self.succeed("inspect", "--devices", "--self-test", "--json", "--device", name,
                                env=environment(TIDEMARK_CACHE="off"))  # keeps no weights
            devices += json.loads(done.stdout)["devices"]
        self.assertEqual([device["name"] for device in devices], list(chosen.values()))
        self.assertTrue(devices)
        for device in devices:
            verdicts = {check["check"]: check for check in device["checks"]}
            for name in ("read-back", "read-ahead", "bytes", "arithmetic", "repeatability", "tiles", "doubles", "conformance"):
                self.assertEqual(verdicts[name]["verdict"], "pass", verdicts[name])
            if "llvmpipe" in device["renderer"]:
                if has_mesa_22():
                    self.assertEqual(verdicts["loops"]["verdict"], "warn")
                    self.assertIn("65535 of 1000000 iterations", verdicts["loops"]["says"])
                else:
                    self.assertEqual(verdicts["loops"]["verdict"], "pass")

    def test_software_driver_is_not_a_gpu(self):
        devices = listed_devices()
        if any(device["kind"] == "hardware" for device in devices):
            self.skipTest("a graphics card is here")
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        done = self.run_program("capture", "a.glsl", "--require-gpu", "-o", "a.png")
        self.assertEqual(done.returncode, 77)
        self.assertIn("no graphics card can draw: ", done.stderr)


if __name__ == "__main__":
    main()
