"""`tidemark check --probe search` and `--probe bounds`: faults that no everyday situation shows, looked for."""
import json
import shlex

from support.program import ProgramTest, main

IMAGE = "void mainImage(out vec4 c, in vec2 p) {\n    vec2 uv = p / iResolution.xy;\n    %s\n}\n"

# The option that the reproduction must name, as (option, low, high); none: any.
FAULTS = {
    "a long window": ("c = vec4(sqrt(abs(iTime - 30.0) / 20.0 - 1.0));", ("--time", 10, 50)),
    "a short window": ("c = vec4(pow(abs(iTime - 5.0) / 3.0 - 1.0, 0.5), uv, 1.0);", ("--time", 2, 8)),
    "a window without numbers": ("c = vec4(log(0.995 + sin(0.071 * iTime + 2.0)));", ("--time", 0, 1e5)),
    "a late window": ("c = vec4(acos(1.002 - 0.00001 * abs(iTime - 4321.0)));", ("--time", 4121, 4521)),
    "behind a condition": ("float k = 0.3;\n    if (iTime > 37.0 && iTime < 39.5) k = -uv.x;\n    c = vec4(sqrt(k));",
                           ("--time", 37, 39.5)),
    "conditions that are computed": ("float k = 0.3, s = 0.5 * iTime;\n    if (s > 211.3) { if (s < 212.0) k = -1.0; }\n"
                                     "    c = vec4(sqrt(k));", ("--time", 422.6, 424)),
    "one frame in a hundred": ("c = vec4(iFrame % 97 == 41 ? 0.0 / (0.0 * uv.x) : uv.x);", ("--time", 0, 1e6)),
    "few pixels": ("vec2 d = p - vec2(413.5, 207.5);\n    c = vec4(sqrt(dot(d, d) - 2.25));", ("--size", 640, 640)),
    "few pixels that move": ("vec2 d = p - vec2(100.5 + 5.0 * iTime, 99.5);\n    c = vec4(log(dot(d, d) - 1.2));",
                             ("--size", 640, 640)),
    "inside a knob's range": ("c = vec4(sqrt(abs(level - 0.62) - 0.03));", None),
    "under the mouse": ("c = vec4(sqrt(length(iMouse.xy / iResolution.xy - vec2(0.71, 0.33)) - 0.06));",
                        ("--mouse", 0, 640)),
}

SOUND = {
    "time": "c = vec4(sqrt(abs(iTime - 30.0) / 20.0), uv, 1.0);",
    "guards": "float k = length(uv - 0.5);\n    c = vec4(log(k + 1.0), acos(clamp(1.1 * k, -1.0, 1.0)), pow(k, 1.5), sqrt(max(k - 0.2, 0.0)));",
    "conditions": "float k = iTime > 37.0 ? uv.x : 1.0;\n    if (iTime < 40.0 && level > 0.5) k *= 2.0;\n    c = vec4(sqrt(k));",
    "indices": "float a[4] = float[4](0.1, 0.2, 0.3, 0.4);\n    c = vec4(a[int(uv.x * 4.0)], a[int(p.y) & 3], 1 << (int(p.x) % 8), 7 / (1 + int(p.y)));",
}

BOUNDS = {
    "index": ("float a[4] = float[4](0.1, 0.2, 0.3, 0.4);\n    c = vec4(a[int(uv.x * 5.0)]);",
              r":4: `a\[int\(uv.x \* 5.0\)\]`: index 4 outside of 0 to 3, at pixel 530,10 at 1 s"),
    "index below": ("vec3 v = vec3(uv, 1.0);\n    int i = int(uv.x * 3.0) - 1;\n    v[i] += 0.5;\n    c = v.xyzz;",
                    r":5: `v\[i\]`: index -1 outside of 0 to 2, at pixel 10,10 at 1 s"),
    "shift": ("int s = int(p.x);\n    c = vec4(float((1 << s) & 255) / 255.0);",
              r":4: `1 << s`: a shift by 50, outside of 0 to 31, at pixel 50,10 at 1 s"),
    "quotient": ("int d = int(p.x) - 20;\n    c = vec4(float(1000 / d) * 0.001);",
                 r":4: `1000 / d`: an integer divided by 0, at pixel 20,\d+ at \S+ s"),
    "quotient of one column": ("int d = int(p.x) - 413;\n    c = vec4(float(1000 % d) * 0.001);",
                               r":4: `1000 % d`: an integer divided by 0, at pixel 413,\d+ at \S+ s"),
    "quotient of a structure": ("struct S { int n; } s;\n    s.n = int(p.y);\n    c = vec4(float(6 / s.n));",
                                r":5: `6 / s.n`: an integer divided by 0, at pixel \d+,0 at \S+ s"),
    "texel": ("c = texelFetch(iChannel0, ivec2(p) + ivec2(1000, 0), 0);",
              r":3: `texelFetch\(iChannel0, ivec2\(p\) \+ ivec2\(1000, 0\), 0\)`: texel 1010 outside of 0 to \d+, "
              r"which is 0 on the site and here, at pixel 10,10 at 1 s"),
    "level": ("c = texelFetch(iChannel0, ivec2(p), -1 - int(uv.x));", r": level -1, at pixel 10,10 at 1 s"),
    "conversion": ("c = vec4(float(int(4e9 * uv.x)));", r":3: `4e9 \* uv.x` is 2190625000, outside of the range of int, at pixel 350,10 at 1 s"),
    "conversion of less than nothing": ("uvec2 n = uvec2(p - 20.0);\n    c = vec4(n, 0.0, 1.0);",
                                        r":3: `p - 20.0` is -9.5, outside of the range of uint, at pixel 10,10 at 1 s"),
    "late": ("float a[4] = float[4](0.1, 0.2, 0.3, 0.4);\n    c = vec4(a[int(0.01 * iTime)]);",
             r"index \d+ outside of 0 to 3, at pixel 10,10 at \S+ s"),
}


class Search(ProgramTest):
    def entry(self, text: str, probe: str) -> dict:
        knob = "#iUniform float level = 0.1 in { 0.0, 1.0 }\n" if "level" in text else ""
        result = self.run_program("check", str(self.write("scene.glsl", knob + IMAGE % text)), "--probe", probe, "--json")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return json.loads(result.stdout)["probes"][0]

    def test_rare_faults_are_found(self):
        for name, (text, where) in FAULTS.items():
            with self.subTest(name):
                entry = self.entry(text, "search")
                self.assertEqual(entry["verdict"], "fail", entry["found"])
                self.assertIsNotNone(entry["trace"], entry["traced"])
                if where:
                    words = shlex.split(entry["reproduction"])
                    value = float(words[words.index(where[0]) + 1].split("x")[0].split(",")[0])
                    self.assertTrue(where[1] <= value <= where[2], entry["reproduction"])

    def test_finite_scenes_pass_and_list_the_sampled_inputs(self):
        for name, text in SOUND.items():
            for probe in ("search", "bounds"):
                with self.subTest(name, probe=probe):
                    entry = self.entry(text, probe)
                    self.assertEqual(entry["verdict"], "pass", entry["found"])
                    self.assertIn("sampled: ", entry["found"])
        self.assertRegex(self.entry(SOUND["conditions"], "search")["found"],
                         r"^no NaN or infinity; sampled: \d+ situations, \d+ moments in [\d.e-]+ to [\d.e+]+ s, "
                         r"\d+ settings of knobs, in 32x18 pixels of 640x360(; \d+ steps towards \d+ edges?, \d+ reached)?"
                         r"(; \d+ places? pixel by pixel)?; \d whole pictures? of 640x360")

    def test_a_buffer_that_breaks_is_found(self):
        self.write("p/image.glsl", '#iChannel0 "buffer_a.glsl"\n'
                                   "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n")
        self.write("p/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) {\n"
                                      "    c = vec4(sqrt(abs(iTime - 62.5) - 1.5)) + p.x;\n}\n")
        result = self.run_program("check", "p", "--probe", "search", "--json")
        entry = json.loads(result.stdout)["probes"][0]
        self.assertEqual((result.returncode, entry["verdict"]), (1, "fail"), entry["found"])
        self.assertIn("pixels of Buffer A, first", entry["found"])
        self.assertEqual(entry["trace"]["first"]["line"], 2)

    def test_the_search_is_repeatable(self):
        found = [self.entry(FAULTS["behind a condition"][0], "search")["reproduction"] for _ in range(2)]
        self.assertEqual(found[0], found[1])

    def test_bounds_are_named_with_operand_pixel_and_moment(self):
        for name, (text, words) in BOUNDS.items():
            with self.subTest(name):
                entry = self.entry(text, "bounds")
                self.assertEqual(entry["verdict"], "note" if name in ("texel", "level") else "warn", entry["found"])
                self.assertRegex(entry["found"], words)

    def test_the_search_extends_the_probe_undefined(self):
        entry = self.entry("float k = sqrt(abs(iTime - 30.0) - 4.0);\n    c = vec4(k > 0.0 ? k : 0.5);", "undefined")
        self.assertEqual(entry["verdict"], "warn", entry["found"])
        self.assertIn("sqrt of a negative number", entry["found"])


if __name__ == "__main__":
    main()
