"""`tidemark check` as a person meets it: what is printed and when, how it ends, which options it takes."""
import json
import re
import signal
import subprocess

from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, main

SOUND = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.5 + 0.5 * sin(iTime), 1.0); }\n"
BROKEN = "void mainImage(out vec4 c, in vec2 p) { c = vec4(sqrt(p.x - 30.0)); }\n"
# Endless after a click.
SLOW = ("void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(0.0);\n    if (iMouse.x > 0.0)\n"
        "        for (int i = 0; i < 60000; ++i)\n"
        "            for (int k = 0; k < 60000; ++k) c += sin(c + p.x);\n}\n")
# A fault in one frame only, which the frames before and after it do not show.
FEEDBACK = ('#iChannel0 "self"\n'
            "void mainImage(out vec4 c, in vec2 p) {\n"
            "    c = 0.9 * texelFetch(iChannel0, ivec2(p), 0) + 0.1;\n    %s\n}\n")


class CheckTest(ProgramTest):
    def check(self, text: str, *options: str) -> subprocess.CompletedProcess:
        return self.run_program("check", str(self.write("scene.glsl", text)), *options)

    def entry(self, text: str, probe: str, *options: str) -> dict:
        result = self.check(text, "--probe", probe, "--json", *options)
        return json.loads(result.stdout)["probes"][0]


class Report(CheckTest):
    def test_a_sound_scene_prints_two_lines(self):
        lines = self.check(SOUND).stdout.decode().splitlines()
        self.assertEqual(len(lines), 2, lines)
        self.assertRegex(lines[0], r"^pass  \d+ probes found nothing$")
        self.assertRegex(lines[1], r"^nothing found; \d+\.\d s; --all shows each probe$")

    def test_all_shows_each_probe_and_each_reason_once(self):
        lines = self.check(SOUND, "--all").stdout.decode().splitlines()
        hits = [line for line in lines if line.endswith("  no mainHit, and the march is not recorded: no ray-marching loop found in Image")]
        self.assertEqual(len(hits), 1, lines)
        self.assertRegex(hits[0], r"^n/a   overstep, budget, .*rays")
        for line in lines:
            if line.startswith("pass"):
                self.assertRegex(line, r"^pass  (?:[a-z_ ]{10}|[a-z_]{11,18})  \S")
        self.assertRegex(lines[-1], r"^nothing found; \d+\.\d s: [a-z_]+ \d+ %, ")

    def test_a_failure_says_what_where_and_what_to_do(self):
        result = self.check(BROKEN, "--budget", "900")
        scene = self.folder / "scene.glsl"
        lines = result.stdout.decode().splitlines()
        self.assertEqual(result.returncode, 1)
        self.assertEqual(lines[:3], ["fail  Some pixels are NaN or infinite: sqrt of a negative number",
                                     f"      {scene}:1, found by times, undefined",
                                     f"      Try: tidemark check --fix {scene}"])
        self.assertRegex(lines[-1], r"^1 failure; \d+\.\d s; --all shows each probe$")
        self.assertEqual(len(lines), 5, lines)

    def test_one_cause_is_one_finding(self):
        """A hash of a large sine: three probes find it, and the most serious decides."""
        text = ("float hash(vec2 p) {\n    return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453);\n}\n"
                "void mainImage(out vec4 c, in vec2 p) { c = vec4(hash(0.3 * p)); }\n")
        probes = [word for name in ("hashes", "sine", "rounding") for word in ("--probe", name)]
        report = json.loads(self.check(text, "--json", *probes).stdout)
        finding, = report["findings"]
        self.assertEqual([entry["verdict"] for entry in report["probes"]], ["note", "warn", "warn"])
        self.assertEqual((finding["level"], sorted(finding["probes"])), ("warn", ["hashes", "rounding", "sine"]))
        self.assertEqual(finding["message"], "GPUs draw different pictures: sin() of a large number")
        self.assertEqual([place["line"] for place in finding["places"]], [1])
        self.assertIn("check --fix --hashes", finding["try"])

    def test_causes_at_different_lines_are_separate(self):
        text = ("void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(1.0);\n    if (iTime > 50.0)\n"
                "        c.x = log(-iTime);\n    if (iMouse.x > 9.0)\n        c.y = sqrt(-iMouse.x);\n}\n")
        report = json.loads(self.check(text, "--json", "--probe", "times", "--probe", "mouse").stdout)
        self.assertEqual([[place["line"] for place in finding["places"]] for finding in report["findings"]], [[4], [6]])

    def test_notes_are_shown_on_demand(self):
        late = "void mainImage(out vec4 c, in vec2 p) { c = vec4(sqrt(iTime + 1.0)); }\n"  # NaN before 0 s only
        result = self.check(late, "--budget", "900")
        self.assertEqual(result.returncode, 0)
        self.assertNotIn(b"NaN", result.stdout)
        self.assertRegex(result.stdout.decode(), r"(?m)^1 note; \d+\.\d s; --all shows the notes and each probe$")
        self.assertRegex(self.check(late, "--all", "--budget", "900").stdout.decode(),
                         r"(?m)^note  Some pixels are NaN or infinite at -5 s: sqrt of a negative number$")

    def test_a_fault_after_the_promised_time_is_a_warning(self):
        entry = self.entry("void mainImage(out vec4 c, in vec2 p) { c = vec4(sqrt(2e4 - iTime)); }\n", "times")
        self.assertEqual(entry["verdict"], "warn")
        self.write("scene.check.json", '{"time_horizon": 1e6}')
        entry = self.entry("void mainImage(out vec4 c, in vec2 p) { c = vec4(sqrt(2e4 - iTime)); }\n", "times")
        self.assertEqual(entry["verdict"], "fail")

    def test_time_shares_include_the_start(self):
        sum_of_it = self.check(SOUND, "--probe", "sizes").stdout.decode().splitlines()[-1]
        self.assertRegex(sum_of_it, r"^nothing found; \d+\.\d s(: sizes \d+ %)?$")
        self.assertNotIn(" 100 %", sum_of_it)  # the program starts, the driver does

    def test_a_misspelt_guard_is_reported_and_other_probes_run(self):
        result = self.check("#ifdef TIDEMARK_HITS\nvoid mainHit(out vec4 hit, in vec2 p) { hit = vec4(1.0); }\n#endif\n" + SOUND, "--all")
        lines = result.stdout.decode().splitlines()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(any(line.startswith(f"warn  overstep    mainHit does not compile: {self.folder / 'scene.glsl'}:1: error: "
                                            "`#ifdef TIDEMARK_HITS`") and "TIDEMARK_HIT?" in line for line in lines), lines)
        self.assertTrue(any(line.startswith("pass  horizon") for line in lines), lines)
        self.assertTrue(any(line.endswith("mainHit does not compile: see overstep") for line in lines), lines)

    def test_a_broken_main_hit_is_reported_and_other_probes_run(self):
        result = self.check("#ifdef TIDEMARK_HIT\nvoid mainHit(out vec4 hit, in vec2 p) { hit = nothing; }\n#endif\n" + SOUND, "--all")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("scene.glsl:2", result.stdout.decode())
        self.assertIn("pass  horizon", result.stdout.decode())

    def test_a_fault_is_counted_in_pixels(self):
        self.assertRegex(self.entry(BROKEN, "times")["found"],
                         r"^NaN in 1080 of 2304 pixels of Image, first at pixel 0,0; in 12 of 12 situations$")

    def test_a_fault_of_every_picture_is_not_blamed_on_the_mouse(self):
        entry = self.entry(BROKEN.replace("30.0", "4.0"), "camera")
        self.assertEqual((entry["verdict"], entry["found"]), ("n/a", "NaN or infinity without the mouse, too: see times"))

    def test_pictures_and_commands_only_for_findings(self):
        self.write("scene.check.json", '{"time_horizon": 1}')
        fast = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5 + 0.5 * sin(4000.0 * iTime + p.x)); }\n"
        entry = self.entry(fast, "horizon", "-o", "pictures")
        self.assertEqual(entry["verdict"], "pass")
        self.assertNotIn("picture", entry)
        self.assertNotIn("reproduction", entry)
        self.assertEqual([file.name for file in (self.folder / "pictures").iterdir()], ["index.html"])

    def interrupted(self, text: str, *options: str) -> tuple[int, str]:
        """Interrupts a check after 4 s; returns its exit code and what it printed."""
        self.write("slow.glsl", text)
        running = subprocess.Popen([PROGRAM, "check", "slow.glsl", *options], cwd=self.folder,
                                   env=environment(), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(running.kill)
        self.addCleanup(running.stdout.close)
        with self.assertRaises(subprocess.TimeoutExpired):
            running.wait(4)
        running.send_signal(signal.SIGTERM if options else signal.SIGINT)
        printed, _ = running.communicate(timeout=TIME_LIMIT)
        return running.returncode, printed

    def test_control_c_prints_the_findings_and_exits_130(self):
        text = SLOW.replace("    if (", "    if (p.x < 30.0) c = sqrt(vec4(p.x - 30.0));\n    if (")
        code, printed = self.interrupted(text)
        self.assertEqual(code, 130)
        self.assertRegex(printed, r"\Afail  .*\n      slow\.glsl:3, found by times\n")
        self.assertRegex(printed, r"(?m)^cut   .*, mediump  not run: interrupted$")
        code, printed = self.interrupted(text, "--json")
        self.assertEqual(code, 130)
        verdicts = {probe["probe"]: probe["verdict"] for probe in json.loads(printed)["probes"]}
        self.assertEqual((verdicts["times"], verdicts["mediump"]), ("fail", "cut"))

    def test_control_c_before_anything_is_found(self):
        code, printed = self.interrupted(SLOW.replace("iMouse.x > 0.0", "iTime >= 0.0"))
        self.assertEqual(code, 130)
        self.assertRegex(printed, r"\Acut   times, .*  not run: interrupted\n")

    def test_unfinished_probe_exits_5(self):
        result = self.check(SLOW, "--budget", "2")
        self.assertEqual(result.returncode, 5)
        text = result.stdout.decode()
        self.assertRegex(text, r"(?m)^cut   mouse       not finished: --budget is used up$")
        self.assertRegex(text, r"(?m)^cut   sizes, inputs, .*  not run: --budget is used up$")
        self.assertEqual(self.check(BROKEN + SLOW.replace("mainImage", "other"), "--budget", "30", "--probe", "times",
                                    ).returncode, 1)

    def test_options_that_would_change_nothing_are_refused(self):
        for options in (("--time", "5"), ("--fps", "0"), ("--size", "4x4"), ("--pixel", "1,1"), ("--hidden",),
                        ("--timeout", "1"), ("--frames", "0-3"), ("--mouse", "1,1"), ("--camera", "1,2,3"),
                        ("--time", "5", "--portable")):
            with self.subTest(options):
                result = self.check(SOUND, *options)
                self.assertEqual(result.returncode, 2)
                self.assertIn(f"{options[0]} requires --trace", result.stderr)

    def test_options_of_trace_are_grouped_in_the_help(self):
        text = self.succeed("check", "--help").stdout.decode()
        tracing = text.split("With --trace")[1].split("\n\n")[0]
        for option in ("--size", "--time", "--mouse", "--pixel", "--hidden"):
            self.assertIn(option, tracing)
        self.assertNotIn("--precision", text)


class Frames(CheckTest):
    def test_every_frame_of_a_feedback_scene_is_checked(self):
        for frame in (1, 7, 59, 250):
            text = FEEDBACK % f"if (iFrame == {frame}) c = log(c - 2.0 - iTime);"
            with self.subTest(frame):
                entry = self.entry(text, "frames")
                self.assertEqual(entry["verdict"], "fail")
                self.assertTrue(entry["found"].startswith(f"from frame {frame} on: NaN in 2304 of 2304 pixels of"),
                                entry["found"])
                self.assertEqual((entry["trace"]["frame"], entry["trace"]["first"]["operation"]),
                                 (frame, "log(c - 2.0 - iTime)"))
                self.assertIn(f"--frame {frame} ", entry["reproduction"])

    def test_unbounded_growth_is_found(self):
        entry = self.entry(FEEDBACK % "c = c * 3.0 + 1.0;", "frames")
        self.assertEqual(entry["verdict"], "fail")
        self.assertRegex(entry["found"], r"^from frame \d+ on: \+Inf in 2304 of 2304 pixels of \S+")
        self.assertEqual(entry["trace"]["first"]["line"], 4)

    def test_finite_scene_passes(self):
        entry = self.entry(FEEDBACK % "", "frames")
        self.assertEqual((entry["verdict"], entry["found"]), ("pass", "no NaN or infinity in the first 600 frames"))
        self.assertEqual(self.entry(SOUND, "frames")["verdict"], "n/a")


class Jumps(CheckTest):
    CUT = "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(0.37 * floor(iTime / 8.0) + 0.01 * iTime)); }\n"

    def test_a_single_cut_is_a_note(self):
        entry = self.entry(self.CUT, "time_discontinuity")
        self.assertEqual(entry["verdict"], "note", entry["found"])
        self.assertRegex(entry["found"], r"^the picture jumps at 8 s \(PSNR \d+\.\d dB between neighbouring instants, "
                                         r'\d+\.\d dB elsewhere\); if the cut is intended, add "skip" to its ')

    def test_a_cut_fails_beyond_smoothest_jump(self):
        self.write("scene.check.json", '{"smoothest_jump": 10}')
        self.assertEqual(self.entry(self.CUT, "time_discontinuity")["verdict"], "fail")

    def test_a_restarting_clock_is_a_finding(self):
        entry = self.entry("void mainImage(out vec4 c, in vec2 p) {\n"
                           "    c = vec4(fract(0.1 * mod(iTime, 7.3)) + 0.01 * sin(p.x));\n}\n", "time_discontinuity", "-o", "pictures")
        self.assertEqual(entry["verdict"], "warn")
        self.assertTrue((self.folder / "pictures/time_discontinuity.png").exists())
        self.assertIn("back to the picture of 0 s", entry["found"])


class Hashes(CheckTest):
    def test_a_hash_shared_by_passes_is_named_once(self):
        self.write("project/common.glsl", "float hash(vec2 p) {\n"
                                          "    return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453);\n}\n")
        self.write("project/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(hash(p)); }\n")
        self.write("project/image.glsl", '#iChannel0 "buffer_a.glsl"\nvoid mainImage(out vec4 c, in vec2 p) {\n'
                                         "    c = texelFetch(iChannel0, ivec2(p), 0) * hash(p);\n}\n")
        result = self.run_program("check", "project", "--probe", "hashes", "--json")
        found = json.loads(result.stdout)["probes"][0]["found"]
        self.assertEqual(len(re.findall(r"common\.glsl:1 hash", found)), 1, found)


if __name__ == "__main__":
    main()
