"""`tidemark check` of marches whose truth is known: what is right raises no alarm, and advice fits the fault."""
import json

from support.program import ProgramTest, main

EYE = ("void mainImage(out vec4 c, in vec2 p) {\n"
       "    vec2 uv = (2.0 * p - iResolution.xy) / iResolution.y;\n")
# A ball and a sky: rays that miss the ball use up the loop.
SKY = EYE + """    vec3 ro = vec3(0.0, 0.0, -3.0), rd = normalize(vec3(uv, 1.5));
    float t = 0.0;
    bool met = false;
    for (int i = 0; i < TURNS; ++i) {
        float d = SCALE * (length(ro + t * rd) - 1.0);
        if (abs(d) < 1e-3) { met = true; break; }
        t += d;
    }
    c = met ? vec4(0.8 - 0.1 * t) : vec4(0.4, 0.6, 0.9, 1.0);
}
"""
# Hills, sampled in steps of 0.05 and more, down to the sample below them.
HILLS = """float hill(vec2 p) { return 0.4 * sin(p.x) * sin(1.3 * p.y) + 0.1 * sin(3.0 * p.y); }
""" + EYE + """    vec3 ro = vec3(0.0, 3.0, -4.0), rd = normalize(vec3(uv.x, uv.y - 0.9, 1.6));
    float dt = 0.05, found = -1.0, above = 3.0, t = 0.02;
    for (; t < 20.0; t += dt) {
        vec3 q = ro + t * rd;
        float h = hill(q.xz);
        if (q.y < h) { found = BACK; break; }
        dt = GROW;
        above = q.y - h;
    }
    c = vec4(found < 0.0 ? 0.0 : COLOUR);
}
"""
# A shape whose distance is a sum, of whatever sign.
PLAIN = EYE + """    vec3 ro = vec3(0.4, 1.2, -3.0), rd = normalize(vec3(uv.x, uv.y - 0.4, 1.5));
    float t = 0.0;
    for (int i = 0; i < 300; ++i) {
        vec3 q = ro + t * rd;
        float d = FIELD;
        if (d < 1e-3 || t > 20.0) break;
        t += 0.5 * d;
    }
    c = vec4(exp(-0.1 * t));
}
"""
RUN_OUT = ("turns", "budget", "grazing")


def filled(text: str, **values) -> str:
    for name, value in values.items():
        text = text.replace(name, str(value))
    return text


class CheckMarch(ProgramTest):
    def entries(self, text: str, *probes: str) -> dict[str, dict]:
        options = [word for probe in probes for word in ("--probe", probe)]
        result = self.run_program("check", str(self.write("march.glsl", text)), "--json", "--budget", "900", *options)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return {entry["probe"]: entry for entry in json.loads(result.stdout)["probes"]}

    def test_sky_rays_that_use_all_iterations_pass(self):
        for probe, entry in self.entries(filled(SKY, TURNS=64, SCALE="1.0"), *RUN_OUT).items():
            self.assertEqual(entry["verdict"], "pass", entry["found"])
            self.assertRegex(entry["found"], "^0 % of .* before they hit")
            self.assertRegex(entry["found"], r"8\d(\.\d)? % run out where more \w+ change nothing")

    def test_rays_out_of_iterations_are_reported_once(self):
        entries = self.entries(filled(SKY, TURNS=9, SCALE="1.0"), *RUN_OUT)
        self.assertEqual(entries["turns"]["verdict"], "warn", entries["turns"]["found"])
        self.assertIn("tests the distance: take more steps", entries["turns"]["found"])
        for probe in RUN_OUT[1:]:
            self.assertEqual(entries[probe]["verdict"], "n/a")
            self.assertTrue(entries[probe]["found"].endswith(": see turns"), entries[probe]["found"])
        self.assertEqual(self.entries(filled(SKY, TURNS=9, SCALE="1.0"), "budget")["budget"]["verdict"], "warn")

    def test_rays_out_of_iterations_name_the_line_of_the_march(self):
        text = filled(SKY, TURNS=9, SCALE="1.0")
        scene = self.write("march.glsl", text)
        result = self.run_program("check", str(scene), "--json", "--budget", "900", "--probe", "budget")
        line = 1 + text[:text.index("1e-3")].count("\n")
        self.assertEqual([finding["places"] for finding in json.loads(result.stdout)["findings"]],
                         [[{"file": str(scene), "line": line}]])

    def test_a_march_with_an_exit_far_from_surfaces_passes(self):
        text = EYE + """    vec3 ro = vec3(0.0, 0.0, -4.0), rd = normalize(vec3(uv, 1.5));
    float t = 0.0;
    c = vec4(0.0);
    for (int i = 0; i < 100; ++i) {
        float d = length(ro + t * rd) - 0.5;
        if (d > 10.0) return;
        if (d <= 0.01) break;
        t += d * 0.9;
    }
    c = vec4(exp(-0.1 * t));
}
"""
        for probe, entry in self.entries(text, "first_hit", "turns").items():
            self.assertEqual(entry["verdict"], "pass", entry["found"])

    def test_too_long_steps_get_a_smaller_factor(self):
        # They go to and fro through the surface, or past the ball and out of the scene.
        found = self.entries(filled(SKY, TURNS=64, SCALE="2.2").replace(") - 1.0)", ") - 2.0)"), "turns")
        self.assertEqual(found["turns"]["verdict"], "warn", found["turns"]["found"])
        self.assertIn("tests the distance: take shorter steps", found["turns"]["found"])
        leaps = filled(PLAIN, FIELD="4.0 * (length(q) - 1.0)").replace("0.5 * d", "d")
        found = self.entries(leaps, "first_hit")["first_hit"]
        self.assertEqual(found["verdict"], "fail", found["found"])
        self.assertTrue(found["found"].endswith("tests the distance: take shorter steps"), found["found"])
        few = filled(PLAIN, FIELD="length(q) - 1.0").replace("300", "6")
        found = self.entries(few, "first_hit")["first_hit"]
        self.assertTrue(found["found"].endswith("tests the distance: take more steps"), found["found"])

    def test_the_refinement_after_the_loop_is_part_of_the_march(self):
        for back in ("t - 0.5 * dt", "t + above", "t - dt + dt * above / (above + h - q.y)"):
            for grow in ("0.05", "0.02 * t"):
                entry = self.entries(filled(HILLS, BACK=back, GROW=grow, COLOUR="exp(-0.1 * found)"), "first_hit")["first_hit"]
                self.assertRegex(entry["found"], r"^0 % of the decided rays step over their first hit by more than 1 % of the distance")
        for colour, verdict in ("fract(4.0 * found)", "fail"), ("exp(-0.1 * found)", "note"):
            entry = self.entries(filled(HILLS, BACK="t", GROW="0.02 * t", COLOUR=colour), "first_hit")["first_hit"]
            self.assertEqual(entry["verdict"], verdict, entry["found"])
            self.assertIn("look for the hit between the last two samples, or take shorter steps", entry["found"])
        self.assertTrue(entry["found"].endswith("; with steps of a quarter the picture looks the same"), entry["found"])

    def test_a_march_that_does_not_end_at_a_surface_passes(self):
        # A bound of clouds, from which another loop goes on; and a glow that every step adds to.
        clouds = filled(PLAIN, FIELD="4.0 * (length(q) - 1.0)").replace("0.5 * d", "d").replace("    c = vec4(exp(-0.1 * t));", """
    float dense = 0.0, at = t - 2.0;
    for (int i = 0; i < 60; ++i) {
        vec3 q = ro + at * rd;
        dense += 0.02 * clamp(1.0 - length(q), 0.0, 1.0);
        at += 0.1;
    }
    c = vec4(dense);""")
        glow = filled(PLAIN, FIELD="4.0 * (length(q) - 1.0)").replace("t += 0.5 * d;", "t += d; c += 0.01 / (1.0 + d * d);") \
                                                             .replace("c = vec4(exp(-0.1 * t))", "c.a = 1.0")
        for text, why in (clouds, "another loop goes on from the march's end"), (glow, "the loop also adds up what it meets"):
            entry = self.entries(text, "first_hit")["first_hit"]
            self.assertEqual(entry["verdict"], "note", entry["found"])
            self.assertIn(why, entry["found"])

    def test_rays_out_of_iterations_name_the_limit(self):
        scene = self.write("march.glsl", filled(SKY, TURNS=9, SCALE="1.0"))
        for probe in "turns", "budget":
            result = self.run_program("check", str(scene), "--budget", "900", "--probe", probe)
            self.assertIn("Rays run out of iterations before they hit anything: the loop ends after 9 iterations; with up to 36 they hit",
                          result.stdout.decode())
        result = self.run_program("check", str(scene), "--budget", "900", "--fix", "--write")
        self.assertIn("iterations instead of 9", result.stdout.decode())
        self.assertRegex(scene.read_text(), "i < (18|36|72)")

    def test_a_field_of_sums_alone_is_marched(self):
        for field in ("abs(q.x) + abs(q.y) + abs(q.z) - 1.0", "q.y", "abs(q.y) - 0.1"):
            entries = self.entries(filled(PLAIN, FIELD=field), "first_hit", "overstep")
            for probe, entry in entries.items():
                self.assertEqual(entry["verdict"], "pass", f"{probe}: {entry['found']}")
            self.assertIn("; 100 % of 288 rays are decided", entries["first_hit"]["found"])

    def test_useless_bounds_are_left_out(self):
        # The last term is 0, but its bounds over an area do not know it.
        loose = filled(PLAIN, FIELD="length(q) - 1.0 + 40.0 * ((q.x + 1.0) * (q.y + 2.0) - q.x * q.y - 2.0 * q.x - q.y - 2.0)")
        found = self.entries(loose, "step_scale")["step_scale"]["found"]
        self.assertNotIn("falls by", found)
        self.assertNotIn("passes the hit", found)
        self.assertRegex(self.entries(filled(PLAIN, FIELD="length(q) - 1.0"), "step_scale")["step_scale"]["found"],
                         r"; between the rays the slope is bounded on 100 % of the way to the surface: (on 95 % of it )?"
                         r"the distance falls by at most (1|0\.9\d*|1\.[0-4]\d*) per unit$")

    def test_a_main_hit_keeps_the_answers_about_the_march(self):
        text = filled(SKY, TURNS=64, SCALE="1.0").replace("abs(d)", "d")
        without = self.entries(text)
        whole = ("void mainHit(out vec4 hit, in vec2 p) {\n    vec4 c;\n    mainImage(c, p);\n"
                 "    hit = vec4(c.b > 0.85 ? -1.0 : (0.8 - c.r) * 10.0, 9.0, 0.0, 0.0);\n}\n")
        for hit, more in ((whole, {"drift"}), ("float mainHit(vec3 p) { return p.x; }\n", set())):
            entries = self.entries(text + hit)
            answered = {probe for probe, entry in entries.items() if entry["verdict"] != "n/a"}
            self.assertEqual(answered, {probe for probe, entry in without.items() if entry["verdict"] != "n/a"} | more)
        self.assertEqual(entries["overstep"]["verdict"], "warn")
        self.assertIn("; mainHit does not compile, so the march of mainImage is recorded: ", entries["overstep"]["found"])


if __name__ == "__main__":
    main()
