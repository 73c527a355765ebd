"""`tidemark check` of what changes with time and the mouse: rounding, cuts and jumps, and what only looks like them."""
import json

from support.program import ProgramTest, main

PIXEL = "void mainImage(out vec4 c, in vec2 p) {\n    vec2 uv = p / iResolution.xy;\n    %s\n}\n"


class CheckMotion(ProgramTest):
    def entry(self, line: str, probe: str) -> dict:
        scene = self.write("scene.glsl", PIXEL % line)
        result = self.run_program("check", str(scene), "--json", "--budget", "900", "--probe", probe)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return json.loads(result.stdout)["probes"][0]

    def test_rounding_of_the_clock_is_not_a_finding(self):
        # Both sides multiply by a power of two and take the fraction, which is exact.
        entry = self.entry("c = vec4(fract(32.0 * iTime));", "horizon")
        self.assertEqual(entry["verdict"], "pass", entry["found"])
        self.assertRegex(entry["found"], r"^float and double agree up to 1e6 s; at 100000 s iTime itself moves in steps of 0.0078 s, "
                                         r"which change 1 % of the pixels by 0\.\d+ or more$")
        entry = self.entry("c = vec4(0.5 + 0.5 * sin(4000.0 * iTime + p.x));", "horizon")
        self.assertEqual(entry["verdict"], "warn", entry["found"])
        self.assertRegex(entry["found"], r"^at the same iTime, float and double agree up to 10* s; at 10+ s 1 % of the pixels")
        entry = self.entry("c = vec4(uv, 0.5 + 0.5 * sin(0.01 * iTime), 1.0);", "horizon")
        self.assertEqual((entry["verdict"], entry["found"]), ("pass", "float and double agree up to 1e6 s"))

    def test_different_random_details_are_only_a_note(self):
        entry = self.entry("float x = fract(0.37 * uv.x + 0.61 * uv.y); for (int i = 0; i < 60; i++) x = 3.99 * x * (1.0 - x);"
                           " c = vec4(x);", "horizon")
        self.assertEqual(entry["verdict"], "note", entry["found"])
        self.assertRegex(entry["found"], "^float and double differ already at 1 s")
        entry = self.entry("c = vec4(fract((floor(p.x) + 5.0e6) * 1.7));", "horizon")  # steps of a half remain
        self.assertEqual(entry["verdict"], "warn", entry["found"])

    def test_an_infinite_pixel_among_bright_pixels_is_a_note(self):
        for line, verdict in (("c = vec4(0.2 / length(uv - 0.5));", "note"), ("c = vec4(0.002 / length(uv - 0.5));", "fail")):
            entry = self.entry(line, "sizes")
            self.assertEqual(entry["verdict"], verdict, entry["found"])
            self.assertRegex(entry["found"], r"^\+Inf in 1 of")

    def test_uneven_movement_by_the_mouse_is_not_a_jump(self):
        noise = "fract(sin(dot(floor(%s), vec2(12.9, 78.2))) * 43758.5)"
        for line in ("c = vec4(uv.x < iMouse.x / iResolution.x ? 1.0 : 0.0);",        # a divided picture
                     "c = vec4(floor(iMouse.y / 20.0) / 9.0, uv, 1.0);",              # nine settings
                     "c = vec4(iMouse.y > 90.0 ? uv.x : 1.0 - uv.x);",                # two settings
                     f"c = vec4({noise % '0.3 * (p + iMouse.xy * vec2(0.21, 0.5))'});",  # cells that come and go
                     "c = vec4(0.5 + 0.009 * step(90.0, iMouse.y) + 0.0001 * iMouse.y);"):  # 40 dB
            entry = self.entry(line, "camera")
            self.assertIn(entry["verdict"], ("pass", "n/a"), f"{line}: {entry['found']}")
        for line in ("float a = 0.3 * (iMouse.y + 30.0 * smoothstep(88.0, 92.0, iMouse.y)); c = vec4(step(0.5, fract(0.11 * (p.y + a))));",
                     f"c = vec4({noise % '0.02 * p + 0.012 * iMouse.xy'});"):
            entry = self.entry(line, "camera")  # a turn a little quicker than others, and a coarse pattern
            self.assertIn(entry["verdict"], ("pass", "n/a"), f"{line}: {entry['found']}")
        flip = "float a = 0.02 * iMouse.y; c = vec4(0.5 + 0.5 * sin(9.0 * uv.x + (iMouse.y > 90.0 ? 3.0 - a : a)));"
        entry = self.entry(flip, "camera")
        self.assertEqual(entry["verdict"], "warn", entry["found"])
        self.assertRegex(entry["found"], r"^the picture jumps where the mouse goes from y = 90 to 91 of 180: PSNR [\d.]+ dB, while 90 % of such "
                                         r"steps have [\d.]+ dB or more$")

    def test_flickering_and_blinking_are_not_restarts(self):
        for line, verdict in (
                ("c = vec4(fract(sin(floor(24.0 * iTime) * 12.9) * 43758.5));", "pass"),               # 24 pictures a second
                ("c = vec4(mod(iTime, 2.0) < 1.0 ? 1.0 : 0.0, uv, 1.0);", "pass"),                     # a lamp that blinks
                ("c = vec4(mod(iTime, 8.0) < 4.0 ? 1.0 : 0.0, 0.1 * fract(uv + iTime / 37.0), 1.0);", "note"),  # and all else moves
                ("c = vec4(0.5 + 0.009 * step(7.0, iTime) + 0.0001 * iTime);", "pass"),                 # 40 dB
                ("c = vec4(0.5 + 0.5 * sin(9.0 * uv.x + 3.0 * mod(iTime, 7.0)));", "warn")):           # the clock restarts
            entry = self.entry(line, "time_discontinuity")
            self.assertEqual(entry["verdict"], verdict, f"{line}: {entry['found']}")

    def test_a_restarting_clock_is_named_with_its_line(self):
        scene = self.write("lap.glsl", "float lap() {\n    return mod(iTime, 7.0);\n}\nconst float k = 7.0;\n"
                                       + PIXEL % "c = vec4(0.5 + 0.5 * sin(9.0 * uv.x + 3.0 * lap()));")
        result = self.run_program("check", str(scene), "--json", "--budget", "900", "--probe", "time_discontinuity")
        finding, = json.loads(result.stdout)["findings"]
        self.assertEqual(finding["places"], [{"file": str(scene), "line": 2}])


if __name__ == "__main__":
    main()
