"""`tidemark check --fix`: planted faults are mended, measured and written; what is sound stays as it is."""
import json
import signal
import subprocess

from support.program import PROGRAM, ProgramTest, environment, main

BODY = "void mainImage(out vec4 c, in vec2 p) {\n    vec2 uv = p / iResolution.xy, d = floor(uv * 4.0) - 2.0;\n    %s\n}\n"
BUDGET = ("--budget", "900")  # else a busy machine cuts it

# A fault in a line, and the line that mends it.
PLANTED = {
    "c = vec4(sqrt(uv.x - 0.5));": "c = vec4(sqrt(max(uv.x - 0.5, 0.0)));",
    "c = vec4(pow(uv.x - 0.5, 2.0));": "c = vec4(pow(abs(uv.x - 0.5), 2.0));",
    "c = vec4(0.1 / d.x);": "c = vec4(0.1 / (d.x + (1.0 - abs(sign(d.x))) * 1e-18));",
    "c = vec4(normalize(d), 0.5, 1.0);": "c = vec4((dot(d, d) > 0.0 ? normalize(d) : d), 0.5, 1.0);",
    "c = vec4(0.5 + atan(d.y, d.x) / 6.3);":
        "c = vec4(0.5 + atan(d.y, (d.x + (1.0 - abs(sign(d.x))) * 1e-30)) / 6.3);",
    "float s; s += uv.x; c = vec4(s);": "float s = 0.0; s += uv.x; c = vec4(s);",
    "float s[2]; s[0] = uv.x; c = vec4(s[0] + s[1]);":
        "float s[2] = float[2](0.0, 0.0); s[0] = uv.x; c = vec4(s[0] + s[1]);",
}
# A ball in a round room: every ray ends somewhere.
MARCH = """float map(vec3 p) { return min(length(p) - 1.0, %s); }
void mainImage(out vec4 c, in vec2 f) {
    vec3 ro = vec3(0.0, 0.5, 4.0), rd = normalize(vec3((2.0 * f - iResolution.xy) / iResolution.y, -1.5));
    float t = 0.0, d = 0.0;
    for (int i = 0; i < %d; i++) {
        d = map(ro + rd * t);
        if (d < 0.001) break;
        t += d;
    }
    c = vec4(vec3(exp(-0.1 * t)), 1.0);
}
"""
ROOM, BUMPY_ROOM = "7.0 - length(p)", "7.0 + 0.4 * sin(5.0 * p.x) * sin(5.0 * p.z) - length(p)"
MENDED_BY = ["--probe", "times", "--probe", "unassigned", "--probe", "undefined"]


class CheckFix(ProgramTest):
    def fix(self, scene: str, *options: str, code: int | None = 0) -> dict:
        """`code` None: other probes may find something that has no fix."""
        done = self.run_program("check", "--fix", scene, "--json", *BUDGET, *options)
        self.assertIn(done.returncode, (0, 1) if code is None else (code,), done.stderr)
        return json.loads(done.stdout)

    def test_planted_faults_are_fixed_and_check_is_clean_after(self):
        for number, (fault, mended) in enumerate(PLANTED.items()):
            with self.subTest(fault):
                name = f"planted{number}.glsl"
                scene = self.write(name, BODY % fault)
                cure, = self.fix(name, "--write", code=None)["cures"]
                self.assertEqual(scene.read_text(), BODY % mended)
                self.assertLess(cure["fault"]["after"], cure["fault"]["before"])
                self.assertIn(f"\n+    {mended}\n", cure["difference"])
                probes = json.loads(self.succeed("check", name, "--json", *BUDGET, *MENDED_BY).stdout)["probes"]
                self.assertEqual({each["verdict"] for each in probes}, {"pass"})

    def test_compile_errors_are_those_of_check(self):
        self.write("wrong.glsl", BODY % "c = vec4(nowhere);")
        for form in ([], ["--diagnostics", "gcc"], ["--diagnostics", "sarif"]):
            with self.subTest(form):
                plain = self.run_program("check", "wrong.glsl", *form)
                self.assertEqual(plain.returncode, 3)
                self.assertIn("nowhere", plain.stderr)
                self.expect_failure(["check", "--fix", "wrong.glsl", *form], 3, plain.stderr[:-1])

    def test_rays_that_run_out_of_steps_get_more(self):
        scene = self.write("march.glsl", MARCH % (ROOM, 9))
        cure, = self.fix("march.glsl", "--write", code=None)["cures"]
        self.assertIn(scene.read_text(), [MARCH % (ROOM, turns) for turns in (18, 36, 72)])
        self.assertEqual(cure["fault"]["of"], "percent of the rays that run out of steps")
        self.assertLessEqual(cure["fault"]["after"], 0.5)
        self.assertGreater(cure["fault"]["before"], 1)

    def test_steps_proved_too_long_are_shortened(self):
        scene = self.write("march.glsl", MARCH % (BUMPY_ROOM, 200))
        cure, = self.fix("march.glsl", "--write")["cures"]
        self.assertRegex(cure["cure"], r"^steps of 0\.\d+ of the distance, and \d+ iterations instead of 200$")
        self.assertRegex(scene.read_text(), r"t \+= 0\.\d+ \* \(d\);")
        self.assertGreater(cure["fault"]["before"], 1)
        self.assertLessEqual(cure["fault"]["after"], 0.5)
        probe, = json.loads(self.succeed("check", "march.glsl", "--json", *BUDGET, "--probe", "first_hit").stdout)["probes"]
        self.assertEqual(probe["verdict"], "pass")

    def test_sine_hashes_become_bit_hashes_on_request(self):
        text = """float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }
float line(float n) { return fract(43758.5453 * sin(n)); }
vec2 two(vec3 p) { return fract(sin(vec2(dot(p, vec3(127.1, 311.7, 7.0)), dot(p, vec3(269.5, 183.3, 9.0)))) * 43758.5); }
void mainImage(out vec4 c, in vec2 p) {
    vec2 i = floor(p / 8.0);
    c = vec4(hash(i), line(i.x), two(i.xyx));
}
"""
        scene = self.write("noise.glsl", text)
        done = self.run_program("check", "--fix", "noise.glsl", *BUDGET)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(b"not fixed: --hashes replaces them, which gives another picture", done.stdout)
        cure, = self.fix("noise.glsl", "--hashes", "--write", code=None)["cures"]
        self.assertEqual(cure["fault"], {"of": "hashes of large sines", "before": 3, "after": 0})
        self.assertIn("another picture", cure["cure"])
        written = scene.read_text()
        for call in ("return hash_of_bits(vec4(p, 0.0, 0.0)); }", "return hash_of_bits(vec4(n, 0.0, 0.0, 0.0)); }",
                     "return vec2(hash_of_bits(vec4(p, 0.0)), hash_of_bits(vec4(p, 1.0))); }"):
            self.assertIn(call, written)
        probe, = json.loads(self.succeed("check", "noise.glsl", "--json", *BUDGET, "--probe", "hashes").stdout)["probes"]
        self.assertEqual(probe["verdict"], "pass")

    def test_hashed_bits_are_spread_evenly(self):
        """Every channel of 128 x 128 cells: 16 bins, chi-squared below its 99.99 % quantile, and each axis uncorrelated."""
        self.write("noise.glsl", """float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }
void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(hash(floor(p) - 64.0)), 1.0); }
""")
        self.fix("noise.glsl", "--hashes", "--write")
        raw = self.succeed("capture", "noise.glsl", "--size", "128x128", "-o", "-").stdout
        values = [raw[i] for i in range(0, len(raw), len(raw) // (128 * 128))]
        self.assertEqual(len(values), 128 * 128)
        bins = [sum(value // 16 == k for value in values) for k in range(16)]
        expected = [sum(round(255 * n / 4096) // 16 == k for n in range(4097)) / 4097 * len(values) for k in range(16)]
        self.assertLess(sum((a - b) ** 2 / b for a, b in zip(bins, expected)), 45)
        mean = sum(values) / len(values)
        variance = sum((value - mean) ** 2 for value in values)
        for step in (1, 128):
            pairs = sum((a - mean) * (b - mean) for a, b in zip(values, values[step:]))
            self.assertLess(abs(pairs / variance), 4 / 128)

    def test_a_file_of_another_encoding_keeps_its_bytes(self):
        """Latin-1 in a comment, lines that end in CR alone or in CR and LF, the mode of the file."""
        fault, mended = "c = vec4(sqrt(uv.x - 0.5));", "c = vec4(sqrt(max(uv.x - 0.5, 0.0)));"
        for end in (b"\n", b"\r", b"\r\n"):
            with self.subTest(end):
                text = (b"// h\xf6he \xb5\n" + BODY.encode()).replace(b"\n", end)
                scene = self.folder / "a.glsl"
                scene.write_bytes(text % fault.encode())
                scene.chmod(0o640)
                self.fix("a.glsl", "--write")
                self.assertEqual(scene.read_bytes(), text % mended.encode())
                self.assertEqual(scene.stat().st_mode & 0o777, 0o640)

    def test_a_read_only_file_stays(self):
        scene = self.write("a.glsl", BODY % "c = vec4(sqrt(uv.x - 0.5));")
        scene.chmod(0o444)
        before = scene.read_text()
        done = self.run_program("check", "--fix", "a.glsl", "--write", *BUDGET)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("cannot write 'a.glsl': it is read-only", done.stderr)
        self.assertEqual((scene.read_text(), scene.stat().st_mode & 0o777), (before, 0o444))

    def test_without_write_the_file_stays(self):
        scene = self.write("a.glsl", BODY % "c = vec4(sqrt(uv.x - 0.5));")
        before = scene.read_text()
        said = self.succeed("check", "--fix", "a.glsl", *BUDGET).stdout.decode()
        self.assertIn("  elsewhere: unchanged in all ", said)
        self.assertIn("--- a.glsl\n+++ a.glsl\n@@ -3 +3 @@\n-    c = vec4(sqrt(uv.x - 0.5));\n", said)
        self.assertEqual(scene.read_text(), before)

    def test_page_has_every_fix_and_remaining_finding(self):
        self.write("a.glsl", BODY % "float a[65]; c = vec4(sqrt(uv.x - 0.5), a[0], 0.0, 1.0);")
        self.fix("a.glsl", "-o", "page", code=1)
        page = (self.folder / "page" / "index.html").read_text()
        self.assertIn("1 fix, each measured on top of those before it; 1 finding is not fixed", page)
        self.assertIn("+    float a[65]; c = vec4(sqrt(max(uv.x - 0.5, 0.0)), a[0]", page)
        self.assertIn("pixels that are not finite: ", page)
        self.assertIn("no fix is known", page)
        self.assertNotIn("<script src", page)

    def test_a_sound_scene_has_nothing_to_fix(self):
        self.write("a.glsl", BODY % "c = vec4(uv, 0.5, 1.0);")
        self.assertEqual(self.succeed("check", "--fix", "a.glsl", *BUDGET).stdout, b"nothing to fix\n")

    def test_include_is_fixed_in_its_own_file(self):
        root = self.write("root.glsl", "float root(float x) {\n    return sqrt(\n        x - 0.3);\n}\n")
        scene = self.write("a.glsl", '#include "root.glsl"\n' + BODY % "c = vec4(root(uv.x));")
        before = scene.read_text()
        self.fix("a.glsl", "--write")
        self.assertEqual(root.read_text(), "float root(float x) {\n    return sqrt(\n        max(x - 0.3, 0.0));\n}\n")
        self.assertEqual(scene.read_text(), before)

    def test_windows_line_ends_are_kept(self):
        scene = self.write("a.glsl", (BODY % "c = vec4(sqrt(uv.x - 0.5));").replace("\n", "\r\n"))
        self.fix("a.glsl", "--write")
        self.assertEqual(scene.read_bytes(), (BODY % "c = vec4(sqrt(max(uv.x - 0.5, 0.0)));").replace("\n", "\r\n").encode())

    def test_two_faults_of_a_line_are_fixed_one_after_the_other(self):
        scene = self.write("a.glsl", BODY % "c = vec4(sqrt(uv.x - 0.5), log(uv.x / d.y), 0.0, 1.0);")
        self.assertEqual(len(self.fix("a.glsl", "--write")["cures"]), 3)
        self.assertEqual(scene.read_text(), BODY % (
            "c = vec4(sqrt(max(uv.x - 0.5, 0.0)), "
            "log(max(uv.x / (d.y + (1.0 - abs(sign(d.y))) * 1e-18), 1e-30)), 0.0, 1.0);"))

    def test_two_faults_of_one_pixel_are_fixed_at_once(self):
        """Either cure alone leaves the pixels as they are: not finite for the other reason."""
        text = """void mainImage(out vec4 c, in vec2 p) {
    float far = floor(abs(p.x - 8.5) / 4.0);
    float a = floor(p.x) / far;
    float b = 0.1 / far;
    c = vec4(fract(0.01 * a), fract(b), 0.5, 1.0);
}
"""
        scene = self.write("both.glsl", text)
        self.assertEqual(len(self.fix("both.glsl", "--write")["cures"]), 1)
        self.assertEqual(scene.read_text().count("1e-18"), 2)
        self.succeed("check", "both.glsl", *BUDGET, "--probe", "times", "--probe", "sizes")

    def test_overflow_that_doubles_can_represent_is_not_fixed(self):
        """Where floats overflow a guard would show another picture."""
        self.write("a.glsl", BODY % "c = vec4(exp(200.0 * uv.x) / exp(200.0 * uv.x));")
        found = self.fix("a.glsl", code=1)
        self.assertEqual(found["cures"], [])
        self.assertIn("no known fix helps", found["remain"][0]["why"])

    def test_a_project_is_imported_beside_itself(self):
        self.write("p/a.glsl", BODY % "c = vec4(sqrt(uv.x - 0.5));")
        self.succeed("export", "p/a.glsl", "-o", "p/b.json")
        before = (self.folder / "p/b.json").read_text()
        self.assertIn(b"p/b/image.glsl", self.succeed("check", "--fix", "p/b.json", *BUDGET).stdout)
        self.succeed("check", "--fix", "--write", "p/b.json", *BUDGET)  # the folder is as it was written
        self.assertIn("max(", (self.folder / "p/b/image.glsl").read_text())
        self.assertEqual((self.folder / "p/b.json").read_text(), before)
        self.assertEqual(self.succeed("check", "--fix", "p/b", *BUDGET).stdout, b"nothing to fix\n")
        for command in (["check", "--fix"], ["simplify"], ["tune", "--vary", "k=1,2"]):
            self.expect_failure_like([*command, "p/b.json"], 4,
                                     "tidemark: error: 'p/b/image.glsl' was not written by import, or was changed since.*")

    def test_interrupt_stops_at_once(self):
        """There are more faults to come when the first is told."""
        self.write("a.glsl", BODY % "\n".join(f"c += sqrt(uv.x - 0.{i});" for i in range(1, 10)))
        with subprocess.Popen([PROGRAM, "check", "--fix", "a.glsl", *BUDGET], cwd=self.folder,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=environment()) as program:
            program.stdout.readline()
            program.send_signal(signal.SIGINT)
            program.communicate()
        self.assertEqual(program.returncode, 130)


if __name__ == "__main__":
    main()
