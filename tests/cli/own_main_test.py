"""Scenes with a `void main()` of their own: the picture of their twin with mainImage, errors on the author's lines."""
import json

from support import png
from support.program import ProgramTest, main

BODY = "vec4({0} / {1}.xy, fract({2}), 1.0) * vec4(vec3(0.5 + 0.5 * sin({2} + 0.1 * {3}.x)), 1.0)"
MAIN_IMAGE = "void mainImage(out vec4 c, in vec2 p) { c = %s; }\n" % BODY.format("p", "iResolution", "iTime", "iMouse")
GLSLSANDBOX = """#ifdef GL_ES
precision mediump float;
#endif
uniform float time;
uniform vec2 resolution;
uniform vec2 mouse;
void main(void) {
    vec2 pixels = mouse * resolution;
    gl_FragColor = %s;
}
""" % BODY.format("gl_FragCoord.xy", "resolution", "time", "pixels")
GLSLVIEWER = """#version 300 es
precision highp float;
uniform float u_time;
uniform vec2 u_resolution;
uniform vec2 u_mouse;
out vec4 color;
void main() { color = %s; }
""" % BODY.format("gl_FragCoord.xy", "u_resolution", "u_time", "u_mouse")


class OwnMain(ProgramTest):
    def pixels(self, text: str):
        self.write("scene.glsl", text)
        self.succeed("capture", "scene.glsl", "--size", "32x16", "--time", "1.25", "--mouse", "8,4", "-o", "x.png")
        return png.read(self.folder / "x.png").rows

    def test_each_dialect_draws_what_its_twin_draws(self):
        twin = self.pixels(MAIN_IMAGE)
        self.assertNotEqual(twin, self.pixels(MAIN_IMAGE.replace("iMouse.x", "iMouse.y")))
        for text in (GLSLSANDBOX, GLSLVIEWER):
            with self.subTest(text.splitlines()[0]):
                self.assertEqual(self.pixels(text), twin)

    def test_a_project_of_the_site_is_given_the_sites_uniforms_alone(self):
        code = "uniform float time;\nuniform vec2 resolution, mouse;\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(time, resolution.x / 64.0, 1.0, 1.0); }\n"
        own_main = "uniform float time;\nvoid main() { gl_FragColor = vec4(time, 0.5, 1.0, 1.0); }\n"
        project = lambda text: json.dumps({"Shader": {"ver": "0.1", "info": {"id": "abcdef", "name": "t"}, "renderpass": [
            {"inputs": [], "outputs": [{"id": "4dfGRr", "channel": 0}], "code": text, "name": "Image", "type": "image"}]}})
        for name, text, red, green in (("site.json", project(code), 0, 0), ("file.glsl", code, 255, 128),
                                       ("main.json", project(own_main), 255, 128)):
            with self.subTest(name):
                self.write(name, text)
                self.succeed("capture", name, "--size", "32x16", "--time", "1.25", "-o", "x.png")
                self.assertEqual(png.read(self.folder / "x.png").pixel(3, 3)[:3], (red, green, 255))

    def test_inspect_names_the_uniforms_of_other_hosts(self):
        self.write("sandbox.glsl", GLSLSANDBOX)
        self.assertIn("            time: another host's name for iTime\n",
                      self.succeed("inspect", "sandbox.glsl").stdout.decode())
        names = json.loads(self.succeed("inspect", "sandbox.glsl", "--json").stdout)["other_hosts_names"]
        self.assertEqual((names["time"], names["resolution"]), ("iTime", "iResolution"))

    def test_an_error_has_the_authors_line(self):
        for text in (GLSLSANDBOX, GLSLVIEWER):
            line = text.splitlines().index(next(l for l in text.splitlines() if "olor = " in l)) + 1
            self.write("wrong.glsl", text.replace("olor = ", "olor = missing * "))
            done = self.run_program("capture", "wrong.glsl", "--size", "8x8", "-o", "x.png")
            self.assertEqual(done.returncode, 3)
            self.assertIn(f"wrong.glsl:{line}:", done.stderr)


class Declarations(ProgramTest):
    """What texts for other hosts declare: uniforms of their own, the last frame, varyings, glslViewer's buffers."""

    def draw(self, text: str, *more: str):
        self.write("scene.glsl", text)
        done = self.succeed("capture", "scene.glsl", "--size", "32x16", "-o", "x.png", *more)
        return done.stderr, png.read(self.folder / "x.png")

    def test_a_uniform_that_nothing_sets_is_a_knob(self):
        text = "uniform vec2 u_resolution;\nuniform float amount; // 0 2\nuniform vec3 tint = vec3(0.5, 1, 0.25);\n" \
               "uniform bool flip;\nuniform float unread;\n" \
               "void main() { gl_FragColor = vec4(amount * tint + (flip ? 0.25 : 0.0), 1.0); }\n"
        told, picture = self.draw(text)
        self.assertEqual(picture.pixel(3, 3), (0, 0, 0))
        self.assertEqual([line.split(": ")[0] for line in told.splitlines() if "nothing sets" in line],
                         ["scene.glsl:2:15", "scene.glsl:4:14"])
        told, picture = self.draw(text, "--set", "amount=1", "--set", "flip=0")
        self.assertEqual((picture.pixel(3, 3), "nothing sets" in told), ((128, 255, 64), False))
        told, picture = self.draw(text, "--set", "amount=1", "--set", "tint=0,0,1", "--set", "flip=1")
        self.assertEqual(picture.pixel(3, 3), (64, 64, 255))
        self.assertIn("range 0 to 2", self.draw(text, "--set", "amount=3")[0])
        knobs = json.loads(self.succeed("inspect", "scene.glsl", "--json").stdout)["knobs"]
        self.assertEqual([knob["name"] for knob in knobs], ["amount", "tint", "flip"])

    def test_a_slider_of_fragmentarium_has_range_and_default(self):
        _, picture = self.draw("uniform float level; slider[0.0,0.5,1.0]\nvoid main() { gl_FragColor = vec4(level); }\n")
        self.assertEqual(picture.pixel(0, 0), (128, 128, 128))

    def test_backbuffer_is_the_last_frame_in_bytes(self):
        text = "uniform sampler2D backbuffer;\nuniform vec2 resolution;\nvoid main() {\n" \
               "    vec4 old = texture2D(backbuffer, gl_FragCoord.xy / resolution);\n" \
               "    gl_FragColor = vec4(old.r + 32.0 / 255.0, old.g > 1.0 ? 1.0 : 0.0, old.g + 2.0, 1.0);\n}\n"
        self.assertEqual(self.draw(text, "--frame", "2")[1].pixel(5, 5), (96, 0, 255))

    def test_a_varying_of_texture_coordinates_is_written(self):
        told, picture = self.draw("varying vec2 v_texcoord;\nvoid main() { gl_FragColor = vec4(v_texcoord, 0.0, 1.0); }\n")
        self.assertEqual((picture.pixel(15, 7), "nothing writes" in told), ((124, 120, 0), False))
        told, picture = self.draw("in vec3 normal;\nout vec4 o;\nvoid main() { o = vec4(normal + 1.0, 1.0); }\n")
        self.assertRegex(told, r"scene.glsl:1:9: warning: nothing writes 'normal'")

    def test_glslviewers_buffers_are_passes(self):
        text = "uniform vec2 u_resolution;\nuniform sampler2D u_buffer0;\nuniform sampler2D u_buffer1;\nvoid main() {\n" \
               "    vec2 at = gl_FragCoord.xy / u_resolution;\n#ifdef BUFFER_0\n    gl_FragColor = vec4(0.25, 0.0, 0.0, 1.0);\n" \
               "#elif defined(BUFFER_1)\n    gl_FragColor = texture2D(u_buffer0, at) * 2.0;\n#else\n" \
               "    gl_FragColor = vec4(texture2D(u_buffer0, at).r, texture2D(u_buffer1, at).r, at.x, 1.0);\n#endif\n}\n"
        told, picture = self.draw(text)
        self.assertEqual((picture.pixel(15, 7), "nothing" in told), ((64, 128, 124), False))

    def test_what_nothing_fills_is_said_with_its_line(self):
        for first, words in (("uniform sampler2D photo;", "scene.glsl:1:19: warning: nothing fills the sampler 'photo'"),
                             ("uniform mat3 photo;", "scene.glsl:1:14: warning: nothing sets the uniform 'photo'"),
                             ("layout(std140) uniform buf { float photo; };", "scene.glsl:1:24: warning: nothing fills the uniform block 'buf'")):
            with self.subTest(first):
                use = {"sampler2D": "texture(photo, vec2(0.5))", "mat3": "vec4(photo[0], 1.0)", "std140": "vec4(photo)"}
                value = next(code for word, code in use.items() if word in first)
                told, _ = self.draw(f"{first}\nout vec4 o;\nvoid main() {{ o = {value}; }}\n")
                self.assertIn(words, told)

    def test_isf_is_named(self):
        told, _ = self.draw('/*{ "ISFVSN": "2", "INPUTS": [ { "NAME": "level", "TYPE": "float" } ] }*/\n'
                            "uniform float level = 0.5;\nvoid main() { gl_FragColor = vec4(level); }\n")
        self.assertIn("scene.glsl:1: warning: this text is written for ISF", told)


if __name__ == "__main__":
    main()
