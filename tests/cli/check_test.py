"""`tidemark check SCENE`: what probes find in scenes with one fault each, and in sound ones."""
import json
import os
import re
import shlex
import struct

from support.program import ROOT, ProgramTest, main

SOUND = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.5 + 0.5 * sin(iTime), 1.0); }\n"

FAULTS = {
    "times": "void mainImage(out vec4 c, in vec2 p) { c = vec4(sqrt(1.0 - iTime)); }\n",
    "mouse": "void mainImage(out vec4 c, in vec2 p) { c = vec4(log(1.0 + iMouse.x)); }\n",
    "mouse, dragged": "void mainImage(out vec4 c, in vec2 p) {\n" # apart from the place of the press, once it is not new
                      "    c = vec4(log(iMouse.z > 0.0 && iMouse.w < 0.0 ? 2.0 - distance(iMouse.xy, abs(iMouse.zw)) : 1.0));\n"
                      "}\n",
    "mouse, released": "void mainImage(out vec4 c, in vec2 p) {\n"
                       "    c = vec4(log(iMouse.z < 0.0 && iMouse.x > 0.0 ? 2.0 - distance(iMouse.xy, abs(iMouse.zw)) : 1.0));\n}\n",
    "sizes": "void mainImage(out vec4 c, in vec2 p) { c = vec4((p.y - 0.5) / (iResolution.y - 1.0)); }\n",
    "inputs": "void mainImage(out vec4 c, in vec2 p) {\n"
              "    vec4 t = textureLod(iChannel0, vec2(0.5), 8.0);\n    c = t / t.r;\n}\n",
    "inputs, white": "void mainImage(out vec4 c, in vec2 p) {\n"
                     "    c = vec4(1.0 / (1.0 - texture(iChannel0, p / iResolution.xy).r));\n}\n",
    "inputs, texel": "void mainImage(out vec4 c, in vec2 p) {\n"
                     "    c = texture(iChannel0, p) / (iChannelResolution[0].x - 1.0);\n}\n",
    "knobs": "#iUniform float depth = 1.0 in { 0.0, 2.0 }\n"
             "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0 / depth); }\n",
    "tiles": "#undef gl_FragCoord\n" # by which the host says where a tile lies
             "void mainImage(out vec4 c, in vec2 p) { c = vec4(gl_FragCoord.xy / iResolution.xy, 0.0, 1.0); }\n",
    "camera": "void mainImage(out vec4 c, in vec2 p) {\n"
              "    float side = iMouse.y > 90.0 ? -1.0 : 1.0;\n"
              "    c = vec4(0.5 + 0.5 * side * sin(0.1 * p.y + 0.01 * iMouse.y));\n}\n",
    "time_discontinuity": "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(0.1 * mod(iTime, 7.3)) + 0.01 * sin(p.x)); }\n",
    "horizon": "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5 + 0.5 * sin(4000.0 * iTime + p.x)); }\n",
    "overstep": "float field(vec3 p) { return p.y - 2.0 * sin(8.0 * p.x); }\n"
                 "void mainHit(out vec4 hit, in vec2 fragCoord) {\n"
                 "    vec3 at = vec3(fragCoord.x / 10.0, 3.0, 0.0);\n"
                 "    float t = 0.0, f = field(at), flags = 0.0;\n"
                 "    for (int i = 0; i < 40 && abs(f) > 1e-3; ++i) {\n"
                 "        t += f;\n        f = field(at + t * normalize(vec3(1.0, -1.0, 0.0)));\n"
                 "        if (f < 0.0) flags = 2.0;\n    }\n"
                 "    hit = vec4(t, 40.0, f, flags);\n}\n"
                 "void mainImage(out vec4 c, in vec2 p) { mainHit(c, p); }\n",
    "budget": "void mainHit(out vec4 hit, in vec2 fragCoord) { hit = vec4(1.0, 8.0, 0.5, 1.0); }\n"
              "void mainImage(out vec4 c, in vec2 p) { mainHit(c, p); }\n",
}


# A sphere, in steps of 0.4 at least.
MARCH = ("float map(vec3 p) { return length(p) - 1.0; }\n"
         "void mainImage(out vec4 c, in vec2 p) {\n"
         "    vec3 ro = vec3(0.0, 0.0, -3.0), rd = normalize(vec3(2.0 * p / iResolution.xy - 1.0, 2.0));\n"
         "    float t = 0.0;\n"
         "    for (int i = 0; i < 99; ++i) { float d = map(ro + t * rd); if (d < 1e-3 || t > 9.0) break; t += max(d, 0.4); }\n"
         "    c = vec4(0.1 * t);\n}\n")


# Faults that need another input or a late time are warnings; those that no viewer meets are notes.
MILDER = {"mouse": "warn", "inputs": "warn", "inputs, white": "warn", "inputs, texel": "warn", "camera": "warn",
          "time_discontinuity": "warn", "horizon": "warn", "sizes": "note"}


class Check(ProgramTest):
    def verdicts(self, scene, *options: str) -> dict[str, dict]:
        if "--budget" not in options:  # else a busy machine cuts probes
            options += ("--budget", "900")
        result = self.run_program("check", str(scene), "--json", *options)
        self.assertIn(result.returncode, (0, 1, 5), result.stderr)
        entries = {entry["probe"]: entry for entry in json.loads(result.stdout)["probes"]}
        verdicts = {entry["verdict"] for entry in entries.values()}
        self.assertEqual(result.returncode, 1 if "fail" in verdicts else 5 if "cut" in verdicts else 0)
        return entries

    def test_a_sound_scene_passes_everything_that_applies(self):
        for probe, entry in self.verdicts(self.write("sound.glsl", SOUND)).items():
            self.assertIn(entry["verdict"], ("pass", "n/a"), probe + ": " + entry["found"])

    def test_each_fault_is_found_by_its_probe(self):
        for fault, text in FAULTS.items():
            with self.subTest(fault):
                probe = fault.split(",")[0]
                entry = self.verdicts(self.write(f"{probe}.glsl", text), "--probe", probe)[probe]
                self.assertEqual(entry["verdict"], MILDER.get(fault, "fail"), entry["found"])

    def test_the_first_hits_of_a_march_are_proved(self):
        for step, verdict, wrong in (("max(d, 0.4)", "fail", r"[1-9][\d.]*"), ("d", "pass", "0")):
            with self.subTest(step):
                scene = self.write("march.glsl", MARCH.replace("max(d, 0.4)", step))
                entry = self.verdicts(scene, "--probe", "first_hit")["first_hit"]
                self.assertEqual(entry["verdict"], verdict, entry["found"])
                self.assertRegex(entry["found"], rf"^{wrong} % of the decided rays step over their first hit by more than 1 % of the distance, .*; (9\d(\.\d)?|100) % of 288 rays are decided")
        said = self.succeed("inspect", str(scene)).stdout.decode()
        self.assertRegex(said, r"(?m)^  march     \S*march.glsl:5: steps by the distance \(sphere tracing\)")

    def test_the_longest_safe_step_is_proved(self):
        for field, verdict, scale in (("length(p) - 1.0", "pass", 1), ("1.6 * (length(p) - 1.0)", "note", 1 / 1.6)):
            with self.subTest(field):
                scene = self.write("march.glsl", MARCH.replace("max(d, 0.4)", "d").replace("length(p) - 1.0", field))
                entry = self.verdicts(scene, "--probe", "step_scale")["step_scale"]
                self.assertEqual(entry["verdict"], verdict, entry["found"])
                said = re.match(r"steps of ([\d.]+) x the distance are safe on \d+ rays that hit, [\d.]+ x on 95 % of them; (?:a step of ([\d.]+) x "
                                r"from .* passes the hit, .*; )?the march's own steps are 1 x in the median", entry["found"])
                self.assertTrue(said, entry["found"])
                self.assertLessEqual(float(said[1]), scale * 1.01)
                self.assertGreater(float(said[1]), 0.85 * scale)
                if verdict == "pass":  # that steps of 1 x reach the hit is no finding
                    self.assertIsNone(said[2])
                else:
                    self.assertAlmostEqual(float(said[2]), scale, delta=0.06 * scale)

    def test_the_slope_is_proved_between_rays(self):
        for field, falls in (("length(p) - 1.0", 1.0), ("1.6 * (length(p) - 1.0)", 1.6)):
            with self.subTest(field):
                scene = self.write("march.glsl", MARCH.replace("max(d, 0.4)", "d").replace("length(p) - 1.0", field))
                entry = self.verdicts(scene, "--probe", "step_scale")["step_scale"]
                said = re.search(r"the slope is bounded on ([\d.]+) % of the way to the surface: the distance falls by at most ([\d.]+) per unit",
                                 entry["found"])
                self.assertTrue(said, entry["found"])
                self.assertGreater(float(said[1]), 99)
                self.assertGreater(float(said[2]), 0.99 * falls)
                self.assertLess(float(said[2]), 1.3 * falls)

    def test_proves_that_rays_stay_within_their_iterations(self):
        march = MARCH.replace("max(d, 0.4)", "d")
        entry = self.verdicts(self.write("march.glsl", march), "--probe", "turns")["turns"]
        self.assertEqual(entry["verdict"], "pass", entry["found"])
        said = re.match(r"0 % of 288 rays run out of the loop's 99 iterations before they hit; the others need at most (\d+); ([\d.]+) % of \d+ rays are proved not to run out, "
                        r"of \d+ rays at ([\d.]+) % of all times from 0 to 10 s$", entry["found"])
        self.assertTrue(said, entry["found"])
        self.assertLess(int(said[1]), 99)
        self.assertGreater(float(said[2]), 90)
        self.assertGreater(float(said[3]), 90)
        entry = self.verdicts(self.write("march.glsl", march.replace("i < 99", "i < 4")), "--probe", "turns")["turns"]
        self.assertEqual(entry["verdict"], "warn", entry["found"])
        self.assertRegex(entry["found"], r"^[1-9][\d.]* % of 288 rays run out of the loop's 4 iterations before they hit, as pixel \d+,\d+ at .* s: "
                         r"\S*march.glsl:5 tests the distance: take more steps; ")

    def test_the_far_plane_is_the_definition_that_limits_the_march(self):
        text = "#define REACH 9.0\n" + MARCH.replace("t > 9.0", "t > REACH").replace("max(d, 0.4)", "d")
        entry = self.verdicts(self.write("march.glsl", text), "--probe", "far")["far"]
        self.assertEqual(entry["verdict"], "pass", entry["found"])
        self.assertRegex(entry["found"], "^0 % of the rays hit something else nearer than the far plane")
        whole = "const int OTHER = 9;\n" + MARCH.replace("max(d, 0.4)", "d")  # cannot move by a thousandth
        for several in ("#define OTHER 9.0\n" + text, whole):
            entry = self.verdicts(self.write("march.glsl", several), "--probe", "far")["far"]
            self.assertEqual(entry["verdict"], "n/a")

    def test_absence_of_nan_is_proved(self):
        bump = "#iUniform float bump = 0.5 in { 0.0, 1.0 }\n"
        for text, verdict, found in (
                (bump + SOUND.replace("0.5 + 0.5 * sin(iTime)", "sqrt(bump + sin(iTime) + 1.001)"), "pass", "^no operation can leave its domain"),
                (bump + SOUND.replace("0.5 + 0.5 * sin(iTime)", "sqrt(bump + sin(iTime))"), "n/a",
                 r"^NaN cannot be excluded: \S*proof.glsl:2: sqrt of \[-1, 2\]$"),
                (SOUND.replace("p / iResolution.xy", "texture(iChannel0, p).xy / length(p - 32.0)"), "n/a", "a division by")):
            entry = self.verdicts(self.write("proof.glsl", text), "--probe", "no_nan")["no_nan"]
            self.assertEqual(entry["verdict"], verdict, entry["found"])
            self.assertRegex(entry["found"], found)

    def test_rays_are_recorded_without_main_hit(self):
        """The march's own faults, and the probes that answer of a sound one."""
        for step, turns, probe, verdict, found in (
                ("max(d, 0.4)", 99, "overstep", "note", r"[1-9][\d.]* % of the rays take a sample below the surface"),
                ("d", 4, "budget", "warn", r"[1-9][\d.]* % of the rays run out of steps")):
            with self.subTest(probe):
                text = MARCH.replace("max(d, 0.4)", step).replace("i < 99", f"i < {turns}")
                entry = self.verdicts(self.write("march.glsl", text), "--probe", probe)[probe]
                self.assertEqual(entry["verdict"], verdict, entry["found"])
                self.assertRegex(entry["found"], "^" + found)
        self.write("march.check.json", '{ "largest_slope": 1 }')
        for field, verdict in (("length(p) - 1.0", "pass"), ("1.3 * (length(p) - 1.0)", "fail")):
            scene = self.write("march.glsl", MARCH.replace("max(d, 0.4)", "0.5 * d").replace("length(p) - 1.0", field))
            entry = self.verdicts(scene, "--probe", "gradient")["gradient"]
            self.assertEqual(entry["verdict"], verdict, entry["found"])
            self.assertRegex(entry["found"], r"^the distance falls by up to (1|0\.99\d*|1\.3|1\.29\d*) per unit between two samples")
        knobs = "#iUniform float far_distance = 9.0 in { 5.0, 20.0 }\n#iUniform vec3 camera_position = vec3(0.0, 0.0, -3.0)\n"
        sound = knobs + (MARCH.replace("max(d, 0.4)", "d").replace("t > 9.0", "t > far_distance")
                         .replace("ro = vec3(0.0, 0.0, -3.0)", "ro = camera_position"))
        probes = ("overstep", "budget", "lipschitz_sweep", "far", "rays", "epsilon", "places", "gradient")
        options = [option for probe in probes for option in ("--probe", probe)]
        for probe, entry in self.verdicts(self.write("sound.glsl", sound), *options).items():
            self.assertIn(entry["verdict"], ("pass", "note"), f"{probe}: {entry['found']}")

    def test_the_field_of_the_text_is_followed_along_its_rays(self):
        ball = MARCH.replace("max(d, 0.4)", "d").replace("t > 9.0", "t > 9e6")
        # Repeated every thousandth: 1e3 units out a float has no digits for that.
        fine = ball.replace("length(p) - 1.0", "0.02 + 0.01 * abs(fract(1000.0 * p.z) - 0.5)")
        for text, verdict, found in ((ball, "pass", "^float and double agree to 1e6 units along the rays$"),
                                     (fine, "note", r"^float and double agree to 100+ units along the rays; at 100+ units \S+ % of the "),
                                     (ball.replace("i < 99", "i < 99 && t < 9.0"), "n/a", "further out no ray is marched$")):
            entry = self.verdicts(self.write("far.glsl", text), "--probe", "places")["places"]
            self.assertEqual(entry["verdict"], verdict, entry["found"])
            self.assertRegex(entry["found"], found)
        for step, field, verdict in (("1e-3", "length(p) - 1.0", "pass"), ("1e-7", "length(p) - 1.0", "note"),
                                     ("1e-3", "length(p) - 1.0 + 0.001 * fract(43758.5 * sin(91.7 * p.z))", "n/a")):
            scene = self.write("slope.glsl", f"#define normal_eps {step}\n" + ball.replace("length(p) - 1.0", field).replace("9e6", "9.0"))
            entry = self.verdicts(scene, "--probe", "normals")["normals"]
            self.assertEqual(entry["verdict"], verdict, entry["found"])

    def test_reports_drifting_main_hit(self):
        hit = ("#ifdef TIDEMARK_HIT\nvoid mainHit(out vec4 hit, in vec2 p) {\n"
               "    vec4 c;\n    mainImage(c, p);\n    float t = 10.0 * c.x;\n"
               "    hit = vec4(t > 9.0 ? -1.0 : OFF * t, 9.0, 0.0, 0.0);\n}\n#endif\n")
        for off, verdict in (("1.0", "pass"), ("1.2", "warn")):
            with self.subTest(off):
                scene = self.write("hit.glsl", MARCH.replace("max(d, 0.4)", "d") + hit.replace("OFF", off))
                entry = self.verdicts(scene, "--probe", "drift")["drift"]
                self.assertEqual(entry["verdict"], verdict, entry["found"])
                self.assertRegex(entry["found"], r"^mainHit and the march of mainImage differ in \d+ of \d+ rays")

    def test_drift_passes_on_shipped_waters(self):
        for name in ("gerstner_waves", "stylized_waves", "water_surface"):
            with self.subTest(name):
                entry = self.verdicts(ROOT / f"shaders/{name}.glsl", "--probe", "drift")["drift"]
                self.assertEqual(entry["verdict"], "pass", entry["found"])

    def test_a_failure_can_be_reproduced_and_is_shown(self):
        scene, folder = self.write("faulty.glsl", FAULTS["times"]), self.folder / "pictures"
        entry = self.verdicts(scene, "--probe", "times", "-o", str(folder))["times"]
        self.assertTrue((folder / "times.png").exists())
        self.assertEqual(entry["picture"], str(folder / "times.png"))
        command = shlex.split(entry["reproduction"])
        self.assertEqual(command[:3], ["tidemark", "capture", str(scene)])
        self.succeed(*command[1:-1], str(self.folder / "again.exr"))

    def test_a_drag_can_be_reproduced(self):
        for fault, mouse in (("dragged", "63,35,1,1,down"), ("released", "63,35,1,1")):
            scene = self.write("drag.glsl", FAULTS["mouse, " + fault])
            entry = self.verdicts(scene, "--probe", "mouse")["mouse"]
            self.assertIn(f"--mouse {mouse} ", entry["reproduction"])
            self.assertIn("(log of a number that is not above 0)", entry["traced"])
            traced = self.run_program("check", "--trace", *shlex.split(entry["reproduction"])[2:-2])
            self.assertEqual(traced.returncode, 1, traced.stderr)
            self.assertIn(b"gave NaN", traced.stdout)

    def test_non_finite_pixels_are_traced_to_their_line(self):
        scene = self.write("waves.glsl", "float wave(float t) { return sqrt(0.5 - t); }\n" + FAULTS["times"].replace(
            "sqrt(1.0 - iTime)", "wave(iTime)"))
        entry = self.verdicts(scene, "--probe", "times")["times"]
        first = entry["trace"]["first"]
        self.assertEqual((first["line"], first["operation"]), (1, "sqrt(0.5 - t)"))
        self.assertEqual(first["calls"][-1]["line"], 2)
        text = self.run_program("check", str(scene), "--probe", "times").stdout.decode()
        self.assertIn(f"{scene}:1:30: `return sqrt(0.5 - t)` gave NaN: 0.5 - t = -0.5 (sqrt of a negative", text)

    def test_the_trace_uses_the_situation_of_the_failure(self):
        entry = self.verdicts(self.write("deep.glsl", FAULTS["knobs"]), "--probe", "knobs")["knobs"]
        self.assertEqual(entry["trace"]["first"]["operands"], [{"text": "depth", "value": "0"}])

    def test_nan_inputs_may_give_nan_pixels(self):
        scene = self.write("mirror.glsl", "void mainImage(out vec4 c, in vec2 p) {\n"
                                          "    vec2 uv = p / iResolution.xy;\n    c = uv.x < 0.5 ? texture(iChannel0, uv)"
                                          " : vec4(uv, 0.0, 1.0);\n}\n")
        entry = self.verdicts(scene, "--probe", "inputs")["inputs"]
        self.assertEqual(entry["verdict"], "pass")
        self.assertIn("NaN in iChannel0 spreads to 50 % of the pixels", entry["found"])

    def test_inputs_of_buffers_are_checked(self):
        folder = self.folder / "project"
        folder.mkdir()
        (folder / "image.glsl").write_text('#iChannel0 "buffer_a.glsl"\n'
                                           "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n")
        buffer = ('#iChannel1 "noise"\nvoid mainImage(out vec4 c, in vec2 p) {\n'
                  "    c = vec4(%s texture(iChannel1, p / iResolution.xy).r);\n}\n")
        (folder / "buffer_a.glsl").write_text(buffer % "0.5 *")
        entry = self.verdicts(folder, "--probe", "inputs")["inputs"]
        self.assertEqual(entry["found"], "no NaN or infinity in 5 situations; "
                                         "NaN in iChannel1 of Buffer A spreads to 100 % of the pixels")
        (folder / "buffer_a.glsl").write_text(buffer % "1.0 /")
        entry = self.verdicts(folder, "--probe", "inputs")["inputs"]
        self.assertEqual(entry["verdict"], "warn")
        command = shlex.split(entry["reproduction"])
        self.assertEqual(command[-6:-2], ["--channel", "Buffer A:1=none", "--pass", "Buffer A"])
        self.assertEqual(entry["trace"]["first"]["line"], 3)
        traced = self.run_program("check", "--trace", *command[2:-2])
        self.assertEqual(traced.returncode, 1)
        self.assertIn(b"gave +Inf", traced.stdout)

    def test_a_late_frame_with_feedback_is_traced_without_all_earlier_frames(self):
        scene = self.write("late.glsl", '#iChannel0 "self"\n'
                                        "void mainImage(out vec4 c, in vec2 p) {\n"
                                        "    c = texelFetch(iChannel0, ivec2(p), 0) * 0.5 + log(2e4 - iTime);\n}\n")
        entry = self.verdicts(scene, "--probe", "times", "--budget", "20")["times"]
        self.assertEqual(entry["trace"]["first"]["line"], 3, entry["traced"])

    def test_the_budget_ends_an_endless_probe(self):
        scene = self.write("slow.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(0.0);\n"
                                        "    for (int i = 0; i < 60000; ++i)\n"
                                        "        for (int k = 0; k < 60000; ++k) c += sin(c + p.x);\n}\n")
        entries = self.verdicts(scene, "--budget", "1")
        self.assertEqual(entries["times"]["found"], "not finished: --budget is used up")
        self.assertEqual(entries["mouse"]["found"], "not run: --budget is used up")
        self.assertEqual(entries["times"]["verdict"], "cut")

    def test_an_endless_probe_leaves_time_for_the_trace(self):
        scene = self.write("slow.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(sqrt(0.5 - iTime));\n"
                                        "    if (iMouse.x > 0.0)\n        for (int i = 0; i < 60000; ++i)\n"
                                        "            for (int k = 0; k < 60000; ++k) c += sin(c + p.x);\n}\n")
        entries = self.verdicts(scene, "--budget", "5")
        self.assertTrue(any(entry["found"] == "not finished: --budget is used up" for entry in entries.values()))
        self.assertEqual(entries["times"]["trace"]["first"]["line"], 2, entries["times"]["traced"])

    def test_a_sine_of_a_large_argument_is_named_with_its_line(self):
        scene = self.write("hash.glsl", "float hash(vec2 p) {\n"
                                        "    return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453);\n}\n"
                                        "void mainImage(out vec4 c, in vec2 p) { c = vec4(hash(floor(p / 8.0))); }\n")
        entry = self.verdicts(scene, "--probe", "hashes")["hashes"]
        self.assertEqual(entry["verdict"], "note")
        self.assertIn("hash.glsl:1 hash", entry["found"])

    def test_a_visible_domain_error_is_named(self):
        scene = self.write("tone.glsl", "void mainImage(out vec4 c, in vec2 p) {\n"
                                        "    float x = p.x / iResolution.x - 0.5;\n"
                                        "    float root = sqrt(x);\n    if (x < 0.0) root = 0.0;\n"
                                        "    c = vec4(root, pow(x, 0.45), smoothstep(0.5, 0.5, x), 1.0);\n}\n")
        entry = self.verdicts(scene, "--probe", "undefined")["undefined"]
        self.assertEqual(entry["verdict"], "warn")
        self.assertIn(f"pow of a negative number (-0.4921875, first at pixel 0,0) at {scene}:5: 50 % of the pixels",
                      entry["found"])
        self.assertNotIn("sqrt", entry["found"])  # its value is thrown away

    def test_a_visible_zero_by_zero_is_named(self):
        scene = self.write("glow.glsl", "void mainImage(out vec4 c, in vec2 p) {\n"
                                        "    float side = floor(2.0 * p.x / iResolution.x);\n"
                                        "    vec2 even = vec2(side), far = 1.0 / even;\n"
                                        "    even.y /= side;\n    c = vec4(max(even, 0.0), min(far.x, 1.0), 1.0);\n}\n")
        entry = self.verdicts(scene, "--probe", "undefined")["undefined"]
        self.assertEqual(entry["verdict"], "warn", entry["found"])
        self.assertEqual(entry["found"].count("quotient"), 1, "1 / 0 is an infinity, which is defined")
        self.assertIn(f"quotient of 0 and 0 (0, first at pixel 0,0) at {scene}:4: 50 % of the pixels", entry["found"])

    def test_a_texel_out_of_range_in_depth_is_named_with_its_depth(self):
        (self.folder / "v.bin").write_bytes(b"BIN\0" + struct.pack("<IIIBBH", 4, 4, 4, 1, 0, 0) + bytes(64))
        scene = self.write("v.glsl", '#iChannel0 "v.bin"\nvoid mainImage(out vec4 c, in vec2 p) {\n'
                                     "    c = texelFetch(iChannel0, ivec3(1, 2, int(p.x) / 10), 0);\n}\n")
        self.assertIn("texel 5 outside of 0 to 3", self.verdicts(scene, "--probe", "bounds")["bounds"]["found"])

    def test_the_argument_farthest_outside_is_reported_with_either_sign(self):
        scene = self.write("far.glsl", "void mainImage(out vec4 c, in vec2 p) {\n"
                                       "    c = vec4(asin(p.x < 9.0 ? -1.001 : 5.0), pow(-p.x, 0.5), 0.0, 1.0);\n}\n")
        found = self.verdicts(scene, "--probe", "undefined")["undefined"]["found"]
        self.assertIn("asin outside of [-1, 1] (5, ", found)
        self.assertRegex(found, r"pow of a negative number \(-\d\d")

    def test_each_function_has_its_domain(self):
        calls = ("pow(x, 2.5)", "sqrt(x)", "inversesqrt(x)", "log(x)", "log2(x)", "asin(3.0 + x)", "acos(x - 3.0)",
                 "acosh(x)", "atanh(3.0 + x)", "atan(floor(0.1 * z), floor(0.1 * z))", "mod(1.0, floor(0.1 * x) + 1.0)",
                 "normalize(vec2(floor(0.1 * x) + 1.0)).x", "(z + iTime) / (vec2(x, 1.0) + iTime).x", "smoothstep(x, x, 0.5)",
                 "pow(vec3(x), vec3(0.45)).y", "mod(vec2(1.0), floor(0.1 * x) + 1.0).y")
        for first in range(0, len(calls), 4):  # each in rows of its own
            rows = "".join(f"    if (int(p.y) % 4 == {row}) c = vec4({call});\n" for row, call in enumerate(calls[first:first + 4]))
            scene = self.write("call.glsl", "void mainImage(out vec4 c, in vec2 p) {\n"
                                            f"    float x = -iTime, z = 0.01 * iTime;\n{rows}}}\n")
            entry = self.verdicts(scene, "--probe", "undefined")["undefined"]
            self.assertEqual(entry["verdict"], "warn", entry["found"])
            for row, call in enumerate(calls[first:first + 4]):
                with self.subTest(call):
                    self.assertRegex(entry["found"], rf"{(call.split('(')[0] or 'quotient')} .*? at {scene}:{3 + row}:")

    def test_a_hash_of_sines_is_another_picture_on_another_gpu(self):
        scene = self.write("hash.glsl", "void mainImage(out vec4 c, in vec2 p) {\n"
                                        "    c = vec4(fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453));\n}\n")
        entry = self.verdicts(scene, "--probe", "sine")["sine"]
        self.assertEqual(entry["verdict"], "warn", entry["found"])
        self.assertRegex(entry["found"], r"a sine like NVIDIA's: \d+\.\d dB, 1 % of the pixels by 0\.\d+ or more")
        smooth = self.write("smooth.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(sin(0.1 * p.x)); }\n")
        self.assertEqual(self.verdicts(smooth, "--probe", "sine")["sine"]["verdict"], "pass")

    def test_reports_dependence_on_the_last_bit(self):
        for text, manner in (("fract(p.x * 62500.3 + 0.37)", "fused multiply-add"),
                             ("fract(0.3 * p.x + (1e6 + iTime) - (1e6 - iTime))", "sums added in reverse order"),
                             ("fract(1e6 * sqrt(p.x))", "quotients, roots, powers and logarithms a unit off"),
                             ("fract(iTime * 1e5 + p.x)", "iTime, iResolution and iMouse a unit in the last place")):
            with self.subTest(manner):
                verdict = "note" if manner.startswith(("sums", "iTime")) else "warn"  # no device computes so
                scene = self.write("bits.glsl", f"void mainImage(out vec4 c, in vec2 p) {{ c = vec4({text}); }}\n")
                entry = self.verdicts(scene, "--probe", "rounding")["rounding"]
                self.assertEqual(entry["verdict"], verdict, entry["found"])
                self.assertRegex(entry["found"], "^the picture changes visibly with " + manner)
                self.assertRegex(entry["found"], manner + r"[^,]*: \d+\.\d dB, 1 % of the pixels by 0\.\d+ or more")

    def test_a_single_product_or_sum_passes(self):
        scene = self.write("bits.glsl", "void mainImage(out vec4 c, in vec2 p) {\n"
                                        "    float x = fract(p.x * 15625.3);\n    c = vec4(fract(x + 1e6));\n}\n")
        entry = self.verdicts(scene, "--probe", "rounding")["rounding"]
        self.assertEqual(entry["verdict"], "pass", entry["found"])

    def test_non_finite_pixels_are_left_out_of_the_psnr(self):
        scene = self.write("edge.glsl", "void mainImage(out vec4 c, in vec2 p) {\n"
                                        "    float a = 1.1 + 0.01 * p.x;\n    c = vec4(sqrt(a * a - a * a) / 2.0);\n}\n")
        found = self.verdicts(scene, "--probe", "rounding")["rounding"]["found"]
        self.assertRegex(found, r"fused multiply-add: 0 pixels with NaN or infinity become \d+, \d+\.\d dB over the rest")

    def test_a_variable_without_a_value_is_named(self):
        scene = self.write("sum.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    float sum;\n"
                                       "    for (int i = 0; i < 3; ++i)\n        sum += 0.1;\n    c = vec4(sum);\n}\n")
        entry = self.verdicts(scene, "--probe", "unassigned")["unassigned"]
        self.assertEqual(entry["verdict"], "warn")
        self.assertEqual(entry["found"],
                         "read without a value (0 on ShaderToy's site and here, undefined elsewhere): "
                         f"sum ({scene}:4, on some path); all paths through the functions that run were checked, whatever the conditions")

    def test_an_unassigned_sum_is_told_apart_from_a_namesake_elsewhere(self):
        scene = self.write("sums.glsl", "float other() {\n    float sum = 2.0;\n    sum = sum * 2.0;\n    return sum; }\n"
                                        "void mainImage(out vec4 c, in vec2 p) {\n    float sum;\n"
                                        "    for (int i = 0; i < 3; ++i)\n        sum += 0.1;\n    c = vec4(sum * other());\n}\n")
        entry = self.verdicts(scene, "--probe", "unassigned")["unassigned"]
        self.assertEqual(entry["verdict"], "warn", entry["found"])
        self.assertIn(f"sum ({scene}:8, on some path)", entry["found"])

    def test_structs_branches_outs_and_returns_without_a_value_are_named(self):
        scene = self.write("ways.glsl", "struct I { float d; }; struct S { I i; vec3 n; };\n"
                                        "S surface() { S s; s.i.d = 1.0;\n    return s; }\n"
                                        "float march(float x, out bool hit) {\n"
                                        "    for (int i = 0; i < 4; ++i) if (x > 2.0) hit = true;\n"
                                        "    return x; }\n"
                                        "float side(float x) { if (x > 1.0) return 2.0; }\n"
                                        "void mainImage(out vec4 c, in vec2 p) {\n    bool hit; float branch;\n"
                                        "    if (p.x > 2.0) branch = 1.0;\n"
                                        "    c = vec4(surface().n.x, march(p.x, hit), side(p.y),\n"
                                        "        branch); }\n")
        entry = self.verdicts(scene, "--probe", "unassigned")["unassigned"]
        self.assertEqual(entry["verdict"], "warn")
        for said in (f"s ({scene}:3, on some path)", f"branch ({scene}:12, on some path)",
                     f"hit ({scene}:4, an `out` that some path does not write)",
                     f"side ({scene}:7, on some path without a `return`)"):
            self.assertIn(said, entry["found"])

    def test_variables_assigned_on_every_path_pass(self):
        scene = self.write("ways.glsl", "float side(float x, out float y) { y = x; if (x > 1.0) return 2.0; return y; }\n"
                                        "void mainImage(out vec4 c, in vec2 p) {\n    float a, b; vec2 v;\n"
                                        "    v.x = p.x; v.y = 1.0; if (p.x > 2.0) a = 1.0; else a = 2.0;\n"
                                        "    c = vec4(a, side(p.x, b), v); c.x += b; }\n")
        entry = self.verdicts(scene, "--probe", "unassigned")["unassigned"]
        self.assertEqual((entry["verdict"], entry["found"]),
                         ("pass", "nothing is read without a value: all paths through the functions that run were checked, whatever the conditions"))

    def test_a_derivative_in_divergent_control_flow_is_named(self):
        scene = self.write("edge.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(0.0);\n"
                                        "    if (p.x > p.y)\n        c += fwidth(p.x * p.y);\n}\n")
        entry = self.verdicts(scene, "--probe", "divergence")["divergence"]
        self.assertEqual(entry["verdict"], "warn")
        self.assertIn(f"fwidth ({scene}:4, neighbours may branch at {scene}:3)", entry["found"])

    def test_reports_derivative_after_an_early_return(self):
        scene = self.write("edge.glsl", "float soft(float x) { return fwidth(x); }\n"
                                        "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(0.0);\n"
                                        "    if (p.x > p.y)\n        return;\n    c += fwidth(p.x * p.y) + soft(p.y * p.y);\n}\n")
        entry = self.verdicts(scene, "--probe", "divergence")["divergence"]
        self.assertEqual(entry["verdict"], "warn")
        self.assertIn(f"fwidth ({scene}:1, called after the return at {scene}:5), "
                      f"fwidth ({scene}:6, after the return at {scene}:5)", entry["found"])

    def test_mediump_is_probed_in_texts_with_that_precision(self):
        text = "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract((p.x + 2048.0) * 0.5)); }\n"
        entry = self.verdicts(self.write("high.glsl", text), "--probe", "mediump")["mediump"]
        self.assertEqual(entry["verdict"], "n/a")
        scene = self.write("medium.glsl", "precision mediump float;\n" + text)
        entry = self.verdicts(scene, "--probe", "mediump")["mediump"]
        self.assertEqual(entry["verdict"], "warn", entry["found"])
        self.assertIn("sums and products in half floats", entry["found"])

    def test_promises_are_checked_and_probes_skipped(self):
        scene = self.write("late.glsl", FAULTS["horizon"])
        self.write("late.check.json", '{"time_horizon": 1, "skip": {"camera": "it has none"}}')
        entries = self.verdicts(scene)
        self.assertEqual(entries["horizon"]["verdict"], "pass")
        self.assertEqual(entries["camera"]["found"], "skipped by the scene: it has none")

    def test_a_probe_named_on_the_command_line_runs_although_skipped(self):
        scene = self.write("turn.glsl", FAULTS["camera"])
        self.write("turn.check.json", '{"skip": {"camera": "it has none"}}')
        self.assertEqual(self.verdicts(scene, "--probe", "camera")["camera"]["verdict"], "warn")

    def test_shipped_scenes_keep_their_promises(self):
        """`./dev soak` takes all of them, which is a minute and a half of CPU time, this test the fastest."""
        names = "*.glsl" if os.environ.get("TIDEMARK_SCENES") == "all" else "pseudo3d_water.glsl"
        for scene in sorted((ROOT / "shaders").glob(names)):
            with self.subTest(scene.name):
                for probe, entry in self.verdicts(scene).items():
                    self.assertNotIn(entry["verdict"], ("fail", "cut"), probe + ": " + entry["found"])

    def test_a_wrong_promise_is_an_error(self):
        scene = self.write("late.glsl", SOUND)
        for promise, wrong in (('{"time_horizont": 1}', "'time_horizont' is not a known promise"),
                               ('{"time_horizon": "long"}', "'time_horizon' takes a number of 0 or more"),
                               ('{"ranges": {"k": 1}}', "'ranges' takes {\"knob\": [low, high]}"),
                               ('{"ranges": {"k": [5, 1]}}', "'ranges' takes {\"knob\": [low, high]}"),
                               ('{"when": {"N=1": {"time_horizont": 1}}}',
                                "'time_horizont' is not a known promise"),
                               ('{"when": {"N": {}}}', "'when' takes {\"NAME=VALUE\": {promises}}")):
            with self.subTest(promise):
                file = self.write("late.check.json", promise)
                result = self.run_program("check", str(scene))
                self.assertEqual(result.returncode, 3)
                self.assertIn(f"{file}: {wrong}", result.stderr)

    def test_the_documented_march_has_its_known_faults(self):
        faulty = {"time_discontinuity": "warn", "overstep": "fail", "horizon": "fail", "budget": "fail"}
        probes = [word for probe in (*faulty, "hashes") for word in ("--probe", probe)]
        entries = self.verdicts(ROOT / "shaders" / "water_surface.glsl", "--define", "DOCUMENT=1", *probes)
        for probe, verdict in faulty.items():
            self.assertEqual(entries[probe]["verdict"], verdict, entries[probe]["found"])
        self.assertIn("62.83 s", entries["time_discontinuity"]["found"])
        self.assertEqual(entries["hashes"]["verdict"], "note")

    def test_an_unknown_probe_lists_the_probes(self):
        result = self.run_program("check", str(self.write("sound.glsl", SOUND)), "--probe", "luck")
        self.assertEqual(result.returncode, 2)
        self.assertIn("--probe luck: no such probe; there are times, ", result.stderr)

    def test_list_needs_no_scene(self):
        self.assertIn(b"overstep", self.succeed("check", "--list").stdout)


if __name__ == "__main__":
    main()
