"""Scenes with a `void main()` of their own: the picture of their twin with mainImage, errors on the author's lines."""
import json
import re

from support import png
from support.program import ROOT, ProgramTest, main

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

    def test_each_dialect_draws_the_shadertoy_picture(self):
        twin = self.pixels(MAIN_IMAGE)
        self.assertNotEqual(twin, self.pixels(MAIN_IMAGE.replace("iMouse.x", "iMouse.y")))
        for text in (GLSLSANDBOX, GLSLVIEWER):
            with self.subTest(text.splitlines()[0]):
                self.assertEqual(self.pixels(text), twin)

    def test_a_shadertoy_project_gets_only_shadertoys_uniforms(self):
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

    def test_an_unset_uniform_becomes_a_knob(self):
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

    def test_unset_uniforms_are_constants_in_an_exported_project(self):
        self.write("k.glsl", "uniform float amount; // 0 2\nuniform bool flip;\n"
                             "void mainImage(out vec4 c, in vec2 p) { c = vec4(flip ? amount : 0.0); }\n")
        self.assertEqual(self.succeed("check", "--portable", "k.glsl").stdout, b"nothing found\n")
        self.succeed("export", "k.glsl", "--set", "amount=0.5", "--set", "flip=1", "-o", "k.json")
        self.succeed("check", "--portable", "k.json")
        self.succeed("capture", "k.json", "--size", "4x4", "-o", "k.png")
        self.assertEqual(png.read(self.folder / "k.png").pixel(0, 0), (128, 128, 128))

    def test_a_declared_iGlobalTime_is_iTime(self):
        told, picture = self.draw("uniform float iGlobalTime;\n"
                                  "void mainImage(out vec4 c, in vec2 p) { c = vec4(iGlobalTime); }\n", "--time", "0.25")
        self.assertEqual((picture.pixel(0, 0), "nothing sets" in told), ((64, 64, 64), False))

    def test_a_slider_of_fragmentarium_has_range_and_default(self):
        _, picture = self.draw("uniform float level; slider[0.0,0.5,1.0]\nvoid main() { gl_FragColor = vec4(level); }\n")
        self.assertEqual(picture.pixel(0, 0), (128, 128, 128))

    BACKBUFFER = "uniform sampler2D backbuffer;\nuniform vec2 resolution;\nvoid main() {\n" \
                 "    vec4 old = texture2D(backbuffer, gl_FragCoord.xy / resolution);\n" \
                 "    gl_FragColor = vec4(old.r + 32.0 / 255.0, old.g > 1.0 ? 1.0 : 0.0, old.g + 2.0, 1.0);\n}\n"
    BONZOMATIC = "#version 410 core\nuniform float fGlobalTime;\nuniform float fFrameTime;\nuniform vec2 v2Resolution;\n" \
                 "uniform sampler2D texPreviousFrame;\nlayout(location = 0) out vec4 out_color;\nvoid main(void) {\n" \
                 "    float old = texture(texPreviousFrame, gl_FragCoord.xy / v2Resolution).b;\n" \
                 "    out_color = vec4(fGlobalTime, fFrameTime * 30.0, old + 32.0 / 255.0, 1.0);\n}\n"

    def test_backbuffer_is_the_previous_frame_in_bytes(self):
        for name in ("backbuffer", "prevFrame"):
            self.assertEqual(self.draw(self.BACKBUFFER.replace("backbuffer", name), "--frame", "2")[1].pixel(5, 5), (96, 0, 255))

    def test_bonzomatics_uniforms_are_set(self):
        told, picture = self.draw(self.BONZOMATIC, "--frame", "2")
        self.assertEqual((picture.pixel(5, 5), told), ((8, 128, 96), "wrote x.png\n"))

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

    def test_uniforms_and_samplers_without_a_value_are_warned_about(self):
        for first, words in (("uniform sampler2D photo;", "scene.glsl:1:19: warning: nothing fills the sampler 'photo'"),
                             ("uniform mat3 photo;", "scene.glsl:1:14: warning: nothing sets the uniform 'photo'"),
                             ("layout(std140) uniform buf { float photo[2]; };", "scene.glsl:1:24: warning: nothing fills the uniform block 'buf'")):
            with self.subTest(first):
                use = {"sampler2D": "texture(photo, vec2(0.5))", "mat3": "vec4(photo[0], 1.0)", "std140": "vec4(photo[0])"}
                value = next(code for word, code in use.items() if word in first)
                told, _ = self.draw(f"{first}\nout vec4 o;\nvoid main() {{ o = {value}; }}\n")
                self.assertIn(words, told)

    def test_a_uniform_block_of_kde_is_read(self):
        told, picture = self.draw("#version 450\nlayout(location = 0) in vec2 qt_TexCoord0;\nlayout(location = 0) out vec4 color;\n"
                                  "layout(std140, binding = 0) uniform buf {\n    mat4 qt_Matrix;\n    float qt_Opacity;\n"
                                  "    float iTime;\n    vec3 iResolution;\n    float level; // 0 1\n} ubuf;\n"
                                  "void main() { color = vec4(qt_TexCoord0.x, ubuf.iTime, ubuf.level, ubuf.iResolution.y / 64.0); }\n",
                                  "--time", "0.25", "--set", "level=0.5")
        self.assertEqual((picture.pixel(15, 7)[:3], told), ((124, 64, 128), "wrote x.png\n"))
        told, _ = self.draw("uniform buf { float gain; };\nvoid main() { gl_FragColor = vec4(gain); }\n")
        self.assertIn("scene.glsl:1:21: warning: nothing sets the uniform 'gain'", told)

    def test_the_block_of_kodelifes_vertex_shader_is_filled(self):
        told, picture = self.draw("#version 150\nuniform float time;\nuniform vec2 resolution;\nin VertexData\n{\n"
                                  "    vec4 v_position;\n    vec3 v_normal;\n    vec2 v_texcoord;\n} inData;\nout vec4 fragColor;\n"
                                  "void main(void)\n{\n    fragColor = vec4(inData.v_texcoord, 0.5 + 0.5 * inData.v_position.x, 1.0);\n}\n")
        self.assertEqual((picture.pixel(15, 7), told), ((124, 120, 124), "wrote x.png\n"))

    def test_directives_of_fragmentarium_are_left_out(self):
        told, picture = self.draw("#group Mandelbrot\nuniform float level; slider[0.0,0.5,1.0]\n"
                                  "void main() { gl_FragColor = vec4(level); }\n#preset Default\nlevel = 0.2\n#endpreset\n")
        self.assertEqual(picture.pixel(0, 0), (128, 128, 128))
        self.assertIn("scene.glsl:1: warning: this text is written for Fragmentarium", told)
        self.assertNotIn("tidemark help", told)
        told, picture = self.draw("void main() { gl_FragColor = vec4(0.25); }\n#vertex\nvarying vec2 coord;\nuniform float Zoom; slider[0,1,2]\n"
                                  "void main() { coord = Zoom * gl_Vertex.xy; }\n#endvertex\n#info Nothing\n#infoSomebody's text\n#TexParameter photo\n")
        self.assertEqual((picture.pixel(0, 0), told.count("warning"), "tidemark help fragmentarium" in told), ((64, 64, 64), 1, True))

    def test_widgets_of_fragmentarium_are_knobs(self):
        declared = "uniform vec2 at; slider[(-1,-2),(0.25,0.5),(1,2)] NotLockable\nuniform int many; slider[1,2,9]\n" \
                   "uniform vec3 tint; color[1.0,0.5,0.0]\nuniform vec4 glow; color[0,0.25,2,1,0.5,0.75]\n" \
                   "uniform bool on;checkbox[true] Locked\nuniform float unread; slider[0,1,2] Locked\n"
        told, picture = self.draw(declared + "void main() { gl_FragColor = vec4(at.y * glow.r, tint.g * glow.a * float(many), "
                                  "on ? glow.b : 0.0, 1.0); }\n")
        self.assertEqual((picture.pixel(0, 0), "warning" in told), ((128, 64, 191), False))
        knobs = {knob["name"]: knob for knob in json.loads(self.succeed("inspect", "scene.glsl", "--json").stdout)["knobs"]}
        self.assertEqual(sorted(knobs), ["at", "glow", "many", "on", "tint"])
        self.assertEqual((knobs["at"]["low"], knobs["at"]["high"], knobs["tint"]["type"]), ([-1, -2], [1, 2], "color3"))
        told, _ = self.draw("uniform sampler2D photo; file[wood.jpg]\nvoid main() { gl_FragColor = texture2D(photo, vec2(0.5)); }\n")
        self.assertIn('scene.glsl:1:19: warning: nothing fills the sampler \'photo\': reads give black. Write iChannel0 for it, and name '
                      'the picture with #iChannel0 "wood.jpg"', told)

    def test_includes_of_fragmentarium_are_replaced_by_lines_of_the_manual(self):
        page = (ROOT / "runner" / "cli" / "manual" / "scenes.md").read_text().split("## Fragmentarium\n")[1]
        march, flat = re.findall(r"^```glsl\n(.*?)^```$", page.split("\n## ")[0], re.MULTILINE | re.DOTALL)
        sphere = "uniform float Radius; slider[0,1,4]\nfloat DE(vec3 p) { orbitTrap = min(orbitTrap, vec4(p, 1.0)); return length(p) - Radius; }\n"
        stripes = "uniform float Zoom; slider[0,1,4]\nvec3 color(vec2 p) { return vec3(p * Zoom, 0.0); }\n"
        for include, lines, rest in (("DE-Raytracer.frag", march, sphere), ("Progressive2D.frag", flat, stripes)):
            with self.subTest(include):
                self.write("scene.glsl", f'#include "{include}"\n#group Thing\n{rest}')
                self.expect_error(["capture", "scene.glsl", "-o", "x.png"], 3,
                             "scene.glsl:1: error: cannot read", "tidemark help fragmentarium")
                told, picture = self.draw(f"{lines}#group Thing\n{rest}")
                self.assertNotEqual(picture.pixel(16, 8), (0, 0, 0))
                self.assertEqual(picture.pixel(0, 15)[2], 0)
                self.assertNotIn("tidemark help", told)
        self.write("scene.glsl", "#group Thing\n" + stripes)
        self.assertIn("tidemark help fragmentarium", self.run_program("capture", "scene.glsl", "-o", "x.png").stderr)
        self.assertIn("DE-Raytracer.frag", self.succeed("help", "fragmentarium").stdout.decode())
        self.write("scene.glsl", '#include "MathUtils.frag"\n')
        self.expect_error(["capture", "scene.glsl", "-o", "x.png"], 3, "scene.glsl:1:", "Examples/Include")

    def test_errors_have_the_authors_names(self):
        for text, name in (("float input(float x) { return x; }\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(input(p)); }\n", "input(vec2)"),
                           ("out vec4 o;\nvoid main() { o = vec4(1.0); gl_FragColor = o; }\n", "gl_FragColor"),
                           ("void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p, 1, 1, 1); }\n", "texture(sampler2D")):
            for options in ([], ["--precision", "double"]):
                with self.subTest(name=name, options=options):
                    self.write("wrong.glsl", text)
                    for words in (["capture", "wrong.glsl", "-o", "x.png", *options], ["inspect", "wrong.glsl", *options]):
                        done = self.run_program(*words)
                        told = done.stderr + done.stdout.decode()
                        self.assertNotEqual(done.returncode, 0)
                        self.assertNotRegex(told, r"\bst_|tidemark_")
                        self.assertIn(name.split("(")[0], told)

    def test_isf_is_named(self):
        told, _ = self.draw('/*{ "ISFVSN": "2", "INPUTS": [ { "NAME": "level", "TYPE": "float" } ] }*/\n'
                            "uniform float level = 0.5;\nvoid main() { gl_FragColor = vec4(level); }\n")
        self.assertIn("scene.glsl:1: warning: this text is written for ISF", told)


if __name__ == "__main__":
    main()
