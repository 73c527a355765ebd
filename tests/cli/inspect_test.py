"""`inspect`: what a scene needs, what was left out, and where it can be drawn."""
import json

from support.program import ProgramTest, environment, main

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
                                       "knobs", "precision", "left_out"])
        self.assertEqual(facts["scene"], "sea.glsl")
        self.assertEqual(facts["files"], ["sea.glsl", "lib.glsl"])
        self.assertEqual(sorted(facts["uniforms"]), ["height", "iChannel1", "iTime"])
        self.assertEqual(facts["passes"], [{"name": "Image", "channels": {"iChannel1": "noise"}}])
        self.assertEqual(facts["knobs"], [
            {"name": "height", "type": "float", "value": [1.25], "low": [0], "high": [2]},
            {"name": "tint", "type": "color3", "value": [1, 0.5, 0]}])
        self.assertEqual(facts["left_out"], [
            "uniforms: iResolution, iTimeDelta, iFrameRate, iFrame, iMouse, iDate, iSampleRate, iChannelTime, "
            "iChannelResolution, iCamera",
            "knobs: tint", "channels: iChannel0, iChannel2, iChannel3"])

    def test_text(self):
        lines = self.succeed("inspect", "sea.glsl").stdout.decode().splitlines()
        self.assertEqual(lines[0], "sea.glsl")
        self.assertRegex(lines[1], r"\A  driver    .+, OpenGL 4\.")
        self.assertEqual(lines[3:], [
            "  iChannel1 noise", "  knob      float height = 0.5 in { 0, 2 }",
            "  knob      color3 tint = vec3(1, 0.5, 0)",
            "  left out  uniforms: iResolution, iTimeDelta, iFrameRate, iFrame, iMouse, iDate, iSampleRate, "
            "iChannelTime, iChannelResolution, iCamera",
            "  left out  knobs: tint", "  left out  channels: iChannel0, iChannel2, iChannel3"])

    def test_a_scene_that_reads_no_noise_gets_none(self):
        self.write("plain.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        facts = json.loads(self.succeed("inspect", "plain.glsl", "--json").stdout)
        self.assertEqual((facts["uniforms"], facts["passes"]), ([], [{"name": "Image", "channels": {}}]))
        self.assertEqual(facts["left_out"][-1], "noise texture")

    def test_writes_no_file(self):
        before = self.files()
        self.succeed("inspect", "sea.glsl")
        self.assertEqual(self.files(), before)

    def test_standard_output_that_is_full(self):
        with open("/dev/full", "wb") as full:
            done = self.run_program("inspect", "sea.glsl", "--json", stdout=full)
        self.assertEqual(done.stderr, "tidemark: error: cannot write to standard output: No space left on device\n")
        self.assertEqual(done.returncode, 4)


class Devices(ProgramTest):
    def test_lists_what_capture_takes(self):
        devices = json.loads(self.succeed("inspect", "--devices", "--json").stdout)["devices"]
        self.assertEqual((devices[0]["name"], devices[-1]["name"]), ("surfaceless", "display"))
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        for device in devices:
            with self.subTest(device=device["name"]):
                done = self.run_program("capture", "a.glsl", "--size", "4x4", "-o", "-", "--device", device["name"])
                self.assertEqual(done.returncode, 77 if "unusable" in device else 0)

    def test_without_a_driver_the_list_says_why(self):
        done = self.succeed("inspect", "--devices", env=environment(__EGL_VENDOR_LIBRARY_FILENAMES="/dev/null"))
        self.assertEqual(done.stdout.decode(), "surfaceless  unusable: no driver offers it (EGL_BAD_PARAMETER)\n"
                                               "display      unusable: no driver offers it (EGL_BAD_PARAMETER)\n")


if __name__ == "__main__":
    main()
