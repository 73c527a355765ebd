"""`tidemark check --portable`: what ShaderToy's own compiler, GLSL ES 3.00 in a browser, would refuse."""
import json

from support.program import ROOT, ProgramTest, environment, main

# One statement each. A browser's compiler takes none of the first and all of the second.
REFUSED = ("c += 1;", "c.x = pow(p.x, 2);", "c.x = max(p.x, 0);", "c.x = clamp(p.x, 0, 1);", "if (p.x > 1) c.x = 1.0;",
           "int i = 3; c = vec4(i * 2.0);", "uint k = 5;", "c.x = mod(3, 2.0);", "c.x = p.x > 2.0 ? 1 : 0.0;",
           "float a[2] = float[2](1.0, 2.0); c = vec4((p.x > 2.0 ? a : a)[0]);", "c = vec4((p.x > 2.0 ? float[2](1.0, 2.0) : float[2](3.0, 4.0))[1]);",
           "struct S { float x; }; S s = S(1.0); S t = p.x > 2.0 ? s : S(2.0); c = vec4(t.x);",
           "c = vec4(saturate(2.0));", "c = vec4(iMouse.x & 1);", "c = unknown;", "float f = 1;")
TAKEN = ("c = vec4(p / iResolution.xy, 0, 1);", "int i = 3; c = vec4(float(i) * 2.0);", "uint k = 5u; c = vec4(k);",
         "c = texture(iChannel0, p);", "c = vec4(1) * 2.0;", "for (int i = 0; i < 3; i++) c += vec4(i);",
         "mat2 m = mat2(1, 0, 0, 1); c.xy = m * p;", "float a[3] = float[3](1.0, 2.0, 3.0); c = vec4(a[int(p.x) % 3]);",
         "c = iDate + iMouse; c.x += iChannelTime[0] + iChannelResolution[1].x + iSampleRate + float(iFrame);",
         "vec2 a[2] = vec2[2](p, p.yx); c = vec4((p.x > 2.0 ? a[0] : a[1])[0]);",
         "c = vec4(dFdx(p), fwidth(p));")


# Whole texts, with the line that is named: 0 if a browser's compiler takes the text.
MAIN = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, 0.0, 1.0); }\n"
TEXTS = (("uniform float iTime;\n" + MAIN, 1), ("uniform vec3 iResolution;\n" + MAIN, 1), ("uniform sampler2D iChannel0;\n" + MAIN, 1),
         ("out vec4 second;\n" + MAIN, 1), ("layout(location = 1) out vec4 second;\n" + MAIN, 1),
         ("\nvoid mainImage(inout vec4 c, in vec2 p) { c = vec4(p, 0.0, 1.0); }\n", 2),
         ("void mainImage(out vec4 c, const in vec2 p) { c = vec4(p, 0.0, 1.0); }\n", 1),
         ("float one__two() { return 1.0; }\n" + MAIN, 1), ("\nfloat webgl_one() { return 1.0; }\n" + MAIN, 2),
         ("float _webgl_one = 1.0;\n" + MAIN, 1),
         (MAIN.replace("c = ", "st_assert(p.x > 0.0); st_assert(true, 1); c = "), 0), ("float f(float iTime) { return iTime; }\n" + MAIN, 0))


class Portable(ProgramTest):
    def shader(self, statement):
        return self.write("a.glsl", f"void mainImage(out vec4 c, in vec2 p) {{\n  c = vec4(0);\n  {statement}\n}}\n")

    def test_code_refused_by_the_site_is_reported(self):
        for statement in REFUSED:
            with self.subTest(statement):
                done = self.run_program("check", "--portable", str(self.shader(statement)))
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stdout.decode(), r"\A\S*a\.glsl:3:")

    def test_code_accepted_by_the_site_passes(self):
        for statement in TAKEN:
            with self.subTest(statement):
                done = self.succeed("check", "--portable", str(self.shader(statement)))
                self.assertEqual(done.stdout, b"nothing found\n")

    def test_texts_that_only_a_browser_refuses(self):
        for text, line in TEXTS:
            with self.subTest(text):
                done = self.run_program("check", "--portable", str(self.write("a.glsl", text)))
                self.assertEqual(done.returncode, 1 if line else 0, done.stdout)
                self.assertRegex(done.stdout.decode(), rf"\A\S*a\.glsl:{line}:" if line else r"\Anothing found\n\Z")

    def test_a_driver_that_has_opengl_es_alone(self):
        """softpipe has no OpenGL 4.5."""
        for device in ("auto", "mesa:softpipe"):
            with self.subTest(device=device):
                done = self.run_program("check", "--portable", "--json", "--device", device, str(self.shader("c += 1;")))
                facts = json.loads(done.stdout)
                self.assertEqual((done.returncode, facts["compiled"], facts["findings"][0]["line"]), (1, True, 3))
                self.assertTrue(facts["compiler"].startswith("OpenGL ES 3."), facts["compiler"])

    def test_shipped_scenes_are_portable(self):
        for scene in sorted((ROOT / "shaders").rglob("*.glsl")):
            if "void mainImage" in scene.read_text():
                with self.subTest(scene.name):
                    self.assertEqual(self.succeed("check", "--portable", str(scene)).stdout, b"nothing found\n")

    def test_a_place_is_reported_once(self):
        folder = self.folder / "project"
        folder.mkdir()
        self.write("project/common.glsl", "float f() {\n  return pow(2.0, 2);\n}\n")
        for name in ("image", "buffer_a"):
            self.write(f"project/{name}.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(f()); }\n")
        facts = json.loads(self.run_program("check", "--portable", "--json", str(folder)).stdout)
        self.assertEqual((facts["portable"], facts["compiled"]), (False, True))
        first = facts["findings"][0]
        self.assertEqual((first["file"], first["line"]), (str(folder / "common.glsl"), 2))
        self.assertEqual(len([f for f in facts["findings"] if "no matching function" in f["message"]]), 1)

    def test_a_byte_order_mark(self):
        scene = self.write("a.glsl", "\ufeffvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        done = self.run_program("check", "--portable", str(scene))
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"a.glsl:1:1: warning: the file begins with a byte order mark (U+FEFF)", done.stdout)

    def test_the_text_is_checked_without_a_driver(self):
        done = self.run_program("check", "--portable", str(self.shader("double d = 1.0lf;")),
                                env=environment(__EGL_VENDOR_LIBRARY_FILENAMES="/dev/null"))
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"a.glsl:3:", done.stdout)
        self.assertIn("checked the texts only", done.stderr)

    def test_extensions_of_this_host_are_reported(self):
        scene = self.write("a.glsl", "uniform mat4 iCamera;\nvoid mainImage(out vec4 c, in vec2 p) { c = iCamera[0]; }\n")
        done = self.run_program("check", "--portable", str(scene))
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"a.glsl:1:14: warning: iCamera: the site has no such uniform", done.stdout)
        self.assertIn("uses iCamera", self.succeed("export", str(scene)).stderr)


if __name__ == "__main__":
    main()
