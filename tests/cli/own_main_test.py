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


if __name__ == "__main__":
    main()
