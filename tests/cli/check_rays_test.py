"""`tidemark check SCENE` of scenes with mainHit, and of cameras: a sound ray marcher, and one fault at a time."""
import json

from support.program import ROOT, ProgramTest, main

MARCHER = """
%(knobs)s
vec3 eye, look;
float field(vec3 p) { return %(field)s; }
float march_field(float t) { return field(eye + t * look); }
void aim(vec2 p) {
    vec2 turned = %(turned)s;
    float pitch = 2.0 * (turned.y - 0.5);
    vec3 d = normalize(vec3((p - 0.5 * iResolution.xy) / iResolution.y, 1.0));
    look = vec3(d.x, d.y * cos(pitch) + d.z * sin(pitch), d.z * cos(pitch) - d.y * sin(pitch));
    eye = %(eye)s;
}
void mainHit(out vec4 hit, in vec2 fragCoord) {
    aim(fragCoord);
    float t = 0.0, f = march_field(0.0), n = 1.0, flags = f < 0.0 ? 4.0 : 0.0;
    for (; n < %(steps)s && f > %(epsilon)s && t < far_distance; ++n) {
        t += %(step)s;
        f = march_field(t);
    }
    bool met = !(f > %(epsilon)s);
    hit = vec4(met ? t : -1.0, n, f, !met && t < far_distance ? flags + 1.0 : flags);
}
void mainImage(out vec4 c, in vec2 p) {
    mainHit(c, p);
    c = vec4(c.x < 0.0 ? 0.0 : exp(-0.05 * c.x));
}
"""
SOUND = {
    "knobs": "#iUniform vec3 camera_position = vec3(0.0, 2.0, 0.0) in { -10.0, 10.0 }\n"
             "#iUniform float far_distance = 40.0 in { 10.0, 80.0 }\n"
             "#iUniform float normal_epsilon = 0.001 in { 0.0005, 0.01 }",
    "field": "p.y - 0.2 * sin(p.x) * sin(p.z + iTime)",
    "turned": "(iMouse.x == 0.0 && iMouse.y == 0.0 ? vec2(0.5, 0.3) : iMouse.xy / iResolution.xy)",
    "eye": "camera_position", "steps": "600.0", "epsilon": "1e-3", "step": "0.8 * f",
}
# The probe, and what of the sound marcher is otherwise.
FAULTS = {
    "mouse_edge": {"turned": "(iMouse.x == 0.0 ? vec2(0.5, 0.1) : iMouse.xy / iResolution.xy)"},
    "grazing": {"steps": "24.0"},
    "far": {"step": "far_distance / 50.0", "field": "abs(cos(60.0 * (p.x + p.z)))", "epsilon": "0.05"},
    "epsilon": {"field": "p.y + 1000.0", "knobs": SOUND["knobs"].replace("40.0", "9000.0").replace("80.0", "9000.0"), "epsilon": "1e-9"},
    "rays": {"field": "p.y - 0.2 * sin(2.0 * p.x) * sin(p.z + 4000.0 * iTime)"},
    "places": {"step": "0.8 * f * sqrt(min(1.0, 2.0 - 0.0001 * camera_position.y))"},
    "self_intersection": {"knobs": SOUND["knobs"] + "\n#iUniform float wave_steepness = 0.4 in { 0.0, 2.0 }\n"
                       "float height(float x) {\n"
                       "    float rest = x;\n"
                       "    for (int i = 0; i < 12; ++i)\n"
                       "        rest -= (rest + wave_steepness * cos(rest) - x) / (1.0 - wave_steepness * sin(rest));\n"
                       "    return wave_steepness * sin(rest);\n}\n",
              "field": "0.4 * (p.y - height(p.x))"},
    "octaves": {"knobs": SOUND["knobs"] + "\n#iUniform int octaves = 3 in { 1, 30 }\n"
                         "float sum(vec3 p) {\n    float s = 0.0;\n"
                         "    for (int i = 0; i < octaves; ++i, p *= 2.0)\n        s += 0.05 * sin(p.x) * sin(p.z);\n"
                         "    return s;\n}\n",
                "field": "p.y - sum(p)", "step": "0.3 * f"},
    "normals": {"knobs": SOUND["knobs"].replace("0.0005", "0.000001")},
}


def marcher(change: dict) -> str:
    return MARCHER % (SOUND | change)


class CheckRays(ProgramTest):
    def verdicts(self, text: str, *options: str) -> dict[str, dict]:
        result = self.run_program("check", str(self.write("marcher.glsl", text)), "--json", *options)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return {entry["probe"]: entry for entry in json.loads(result.stdout)["probes"]}

    def test_a_sound_marcher_passes_everything_that_applies(self):
        self.write("marcher.check.json", '{"time_horizon": 1e3, "space_horizon": 100}')
        entries = self.verdicts(marcher({}))
        for probe, entry in entries.items():
            self.assertIn(entry["verdict"], ("pass", "n/a"), probe + ": " + entry["found"])
        for probe in (FAULTS.keys() | {"gradient"}) - {"self_intersection", "octaves"}:
            self.assertEqual(entries[probe]["verdict"], "pass", probe + ": " + entries[probe]["found"])

    def test_sound_waves_pass_self_intersection_and_octaves(self):
        waves = FAULTS["self_intersection"] | {"knobs": FAULTS["self_intersection"]["knobs"].replace(
            "rest -=", "rest -= min(1.0, 0.9 / wave_steepness) * 0.0 +").replace(
            "float height(float x) {", "float height(float x) {\n    float wave_steepness = min(wave_steepness, 0.9);")}
        self.assertEqual(self.verdicts(marcher(waves), "--probe", "self_intersection")["self_intersection"]["verdict"], "pass")
        octaves = FAULTS["octaves"] | {"knobs": FAULTS["octaves"]["knobs"].replace("{ 1, 30 }", "{ 1, 6 }")}
        self.assertEqual(self.verdicts(marcher(octaves), "--probe", "octaves")["octaves"]["verdict"], "pass")

    def test_each_fault_is_found_by_its_probe(self):
        for probe, change in FAULTS.items():
            with self.subTest(probe):
                entry = self.verdicts(marcher(change), "--probe", probe)[probe]
                self.assertEqual(entry["verdict"], "warn" if probe in ("mouse_edge", "rays") else "fail", entry["found"])
                self.assertIn("tidemark capture", entry["reproduction"])

    def test_a_zero_finite_difference_step_fails(self):
        knobs = SOUND["knobs"].replace("{ 0.0005,", "{ 0.0,")
        entry = self.verdicts(marcher({"knobs": knobs}), "--probe", "normals")["normals"]
        self.assertEqual(entry["verdict"], "fail", entry["found"])
        self.assertIn("every slope over the scene's own step 0 is NaN or infinite", entry["found"])

    def test_a_camera_pole_without_a_direction_gives_nan(self):
        text = ("void mainImage(out vec4 c, in vec2 p) {\n"
                "    float pitch = iMouse.y / 90.0 - 1.0;\n"
                "    c = vec4(normalize(vec3(pitch * p.x, 0.0, pitch)), 1.0);\n}\n")
        entry = self.verdicts(text, "--probe", "camera")["camera"]
        self.assertEqual(entry["verdict"], "fail")
        self.assertIn("NaN or infinity in the picture with the mouse at y = 90 of 180", entry["found"])

    def test_an_orbit_camera_is_moved(self):
        text = marcher({"eye": "iCamera[3].xyz"}).replace("vec3 eye,", "uniform mat4 iCamera;\nvec3 eye,", 1)
        text = text.replace(SOUND["knobs"], "#iUniform float far_distance = 40.0 in { 10.0, 80.0 }")
        entry = self.verdicts(text.replace("0.8 * f", "f * sqrt(9.9 - iCamera[3].y)"), "--probe", "places")
        self.assertEqual(entry["places"]["verdict"], "fail")
        self.assertIn("--camera 30,89.9,10", entry["places"]["reproduction"])

    def test_the_documents_march_has_its_known_faults(self):
        scene = str(ROOT / "shaders" / "water_surface.glsl")
        for probe, found, *options in (("grazing", "% of the rays run out of steps", "DOCUMENT=1"),
                                       ("rays", "float and double agree up to 100000 s", "DOCUMENT=1"),
                                       ("epsilon", "below the rounding", "DOCUMENT=1", "HIT_DISTANCE=0.0000001")):
            defines = [word for option in options for word in ("--define", option)]
            result = self.run_program("check", scene, *defines, "--probe", probe)
            self.assertEqual(result.returncode, 1, probe)
            self.assertIn(found, result.stdout.decode())

    def test_a_slope_beyond_the_stated_bound_is_found(self):
        # Along rays that fall by 1 in 2 the slope reaches its largest, the square root of 5.
        steep = marcher({"field": "p.y - 0.5 * sin(4.0 * p.z)", "step": "0.4 * f"})
        entry = self.verdicts(steep, "--probe", "gradient")["gradient"]
        self.assertEqual(entry["verdict"], "pass")
        self.assertIn("reaches 2.24, where the scene states no bound", entry["found"])
        self.write("marcher.check.json", '{"largest_slope": 2.237}')
        self.assertEqual(self.verdicts(steep, "--probe", "gradient")["gradient"]["verdict"], "pass")
        self.write("marcher.check.json", '{"largest_slope": 2.2}')
        entry = self.verdicts(steep, "--probe", "gradient")["gradient"]
        self.assertEqual(entry["verdict"], "fail")
        self.assertRegex(entry["found"], r"reaches 2\.24, where the scene states at most 2\.2, "
                                         r"at \d+ s, pixel [\d.]+,[\d.]+, distance [\d.]+: steps that rely on")
        self.assertIn("tidemark capture", entry["reproduction"])

    def test_promised_ranges_are_respected(self):
        self.write("marcher.check.json", '{"ranges": {"octaves": [1, 6]}}')
        self.assertEqual(self.verdicts(marcher(FAULTS["octaves"]), "--probe", "octaves")["octaves"]["verdict"], "pass")
        self.write("marcher.check.json", '{"ranges": {"octaves": 6}}')
        result = self.run_program("check", str(self.write("marcher.glsl", marcher({}))))
        self.assertIn("'ranges' takes {\"knob\": [low, high]}", result.stderr)


if __name__ == "__main__":
    main()
