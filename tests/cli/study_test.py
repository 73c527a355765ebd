"""`study`: error against run time, judged by shaders whose error is known; the report, as files and in a browser."""
import csv
import html.parser
import json
import re
import signal
import subprocess
import time

from support import png
from support.program import PROGRAM, ROOT, ProgramTest, environment, main

# The midpoint rule on exp(x): its error is known to a few per cent, exp(x) - its value = h^2/24 (e^x)'..., and falls
# by 4 when the steps double. Both pictures are smooth, so that floats are far away.
SUM = """
#define STEPS 4
void mainImage(out vec4 c, in vec2 p) {
    float sum = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        sum += exp(-3.0 * (float(i) + 0.5) / float(STEPS));
    }
    c = vec4(vec3(sum / float(STEPS) * p.x / iResolution.x), 1.0);
}
"""

# A plane at z = 5 and a camera at 0 that looks along z; t is known. Steps of half the distance: after N steps the
# distance is 5 * 0.5^N, unless it is smaller than NEAR.
PLANE = """
#define N 8
#define NEAR 1e-9
float evaluations = 0.0;
float march() {
    float t = 0.0;
    for (int i = 0; i < N; ++i) {
        float d = 5.0 - t;
        evaluations += 1.0;
        if (d < NEAR) return t;
        t += 0.5 * d;
    }
    return t;
}
void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(march() / 10.0), 1.0); }
#ifdef TIDEMARK_HIT
void mainHit(out vec4 hit, in vec2 p) {
    if (p.x < 2.0) { hit = vec4(-1.0, 0.0, 0.0, 0.0); return; }
    float t = march();
    hit = vec4(t, evaluations, 5.0 - t, evaluations == float(N) ? 1.0 : 0.0);
}
#endif
"""

SMALL = ["--size", "16x9"]
QUICK = [*SMALL, "--budget", "2"]


class Study(ProgramTest):
    def study(self, *arguments: str, code: int = 0, budget: str = "2") -> dict:
        done = self.run_program("study", *arguments, "--json", *SMALL, "--budget", budget, "-o", "report")
        self.assertEqual(done.returncode, code, done.stderr)
        self.words = done.stderr
        return json.loads(done.stdout)

    def points(self, study: dict) -> dict[str, dict]:
        return {point["label"]: point for point in study["points"]}


class Pictures(Study):
    def test_a_second_order_rule_converges_at_second_order(self):
        self.write("sum.glsl", SUM)
        points = self.points(self.study("sum.glsl", "--vary", "STEPS=4,8,16,32"))
        errors = [points[f"STEPS = {n}"]["all"]["picture"]["rmse"] for n in (4, 8, 16, 32)]
        for coarse, fine in zip(errors, errors[1:]):
            self.assertAlmostEqual(coarse / fine, 4, delta=0.15)
        # The error of the midpoint rule is h^2/24 (f'(1) - f'(0)) + O(h^4); the RMS of p.x / 16 over x is 0.5765.
        expected = (1 / 16) ** 2 / 24 * 3 * (1 - 2.718281828 ** -3) * 0.5765
        self.assertAlmostEqual(errors[2] / expected, 1, delta=0.02)
        self.assertEqual(points["defaults"]["all"]["picture"]["rmse"], errors[0])

    def test_the_reference_names_itself_and_its_error(self):
        self.write("sum.glsl", SUM)
        study = self.study("sum.glsl", "--vary", "STEPS=4,8")
        reference = study["references"]["picture"]
        self.assertRegex(reference["method"], r"STEPS = (32|64|128|256|512)\b")
        self.assertRegex(reference["self_check"], r"STEPS = 8 to STEPS = \d+: the last change was \S+, 0\.25 of the one before; all further ones add up to \S+")
        strict = self.points(study)["STEPS = 8"]["all"]["picture"]["rmse"]
        self.assertLess(reference["uncertainty"], 0.11 * strict)
        self.assertFalse(self.points(study)["STEPS = 4"]["hollow"])

    def test_points_near_a_named_reference_are_hollow(self):
        self.write("sum.glsl", SUM)
        study = self.study("sum.glsl", "--vary", "STEPS=4,16", "--reference", "STEPS=16")
        points = self.points(study)
        self.assertLess(points["STEPS = 16"]["all"]["picture"]["rmse"], 1e-7)  # its rounding
        self.assertTrue(points["STEPS = 16"]["hollow"])
        self.assertIn("STEPS = 16", study["references"]["picture"]["method"])

    def test_any_kind_of_knob(self):
        self.write("a.glsl", "#iUniform float gain = 1.0\n#define A 1.0\nconst float B = 1.0;\n"
                             "void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(0.1 * gain * A * B), 1); }\n")
        for knob in ("gain", "A", "B"):
            points = self.points(self.study("a.glsl", "--vary", f"{knob}=3.0,2.0", "--reference", f"{knob}=2.0"))
            self.assertAlmostEqual(points[f"{knob} = 3.0"]["all"]["picture"]["rmse"], 0.1, places=6)

    def test_times_are_counted(self):
        self.write("sum.glsl", SUM)
        study = self.study("sum.glsl", "--vary", "STEPS=4,8", "--views", "0;1.5@.5,.5", budget="1000")
        for point in study["points"]:
            self.assertEqual(list(point["views"]), ["t=0", "t=1.5@.5,.5"])
            times = point["all"]["wall_ms"]
            self.assertEqual(times["runs"], 30)
            self.assertLessEqual(times["smallest"], times["median"])
            self.assertLessEqual(times["ci95_low"], times["ci95_high"])
        self.assertEqual(study["timing"]["warm_up_rounds"], 10)
        clock = "wall clock around glFinish"
        if "llvmpipe" in study["machine"]["renderer"]:  # its timer sees some of the work only
            self.assertRegex(study["timing"]["clock"], clock + r" \(the driver's GPU timer shows .* of it and is not used\)")

    def test_a_failing_point_does_not_end_the_study(self):
        self.write("sum.glsl", SUM)
        points = self.points(self.study("sum.glsl", "--vary", "STEPS=nonsense,4,8"))
        self.assertRegex(points["STEPS = nonsense"]["failure"], r"sum\.glsl:\d+: error: .*nonsense")
        self.assertIn("all", points["STEPS = 8"])

    def test_non_finite_pixels_are_counted(self):
        self.write("nan.glsl", "#define BAD 0\nvoid mainImage(out vec4 c, in vec2 p) {"
                               " c = vec4(BAD == 1 && p.x < 1. ? sqrt(-p.x) : .5); }\n")
        points = self.points(self.study("nan.glsl", "--vary", "BAD=1,0", "--reference", "BAD=0"))
        bad = points["BAD = 1"]["all"]["picture"]
        self.assertEqual((bad["non_finite_pixels"], bad["rmse"]), (2 * 9, None))  # two views
        self.assertEqual(points["BAD = 0"]["all"]["picture"]["non_finite_pixels"], 0)

    def test_feedback_is_stepped_from_the_start(self):
        self.write("f.glsl", '#iChannel0 "self"\n#define ADD 0.0\nvoid mainImage(out vec4 c, in vec2 p) {'
                             " c = texelFetch(iChannel0, ivec2(p), 0) + 0.01 + ADD; }\n")
        points = self.points(self.study("f.glsl", "--vary", "ADD=0.01,0.0", "--reference", "ADD=0.0", "--views", "0.5"))
        # Frame 30 is the 31st: 31 times 0.01 more.
        self.assertAlmostEqual(points["ADD = 0.01"]["all"]["picture"]["rmse"], 0.31, places=4)


class Hits(Study):
    def test_errors_work_and_causes_of_a_geometric_series(self):
        self.write("plane.glsl", PLANE)
        study = self.study("plane.glsl", "--vary", "N=2,4,8", "--reference", "N=40")
        points = self.points(study)
        for n in (2, 4, 8):
            hits = points[f"N = {n}"]["all"]["hits"]
            self.assertAlmostEqual(hits["rms_t"] / (5 * 0.5 ** n), 1, places=4)
            self.assertAlmostEqual(hits["evaluations_per_pixel"], n * 14 / 16, places=4)
            self.assertAlmostEqual(hits["exhausted_percent"], 100 * 14 / 16, places=4)
        wrong = [points[f"N = {n}"]["all"]["hits"]["wrong_0.1_percent"] for n in (2, 4, 8)]
        self.assertEqual(wrong, [87.5, 87.5, 0])
        self.assertEqual(points["N = 4"]["all"]["causes"]["exhaustion"], 2 * 14 * 9)
        self.assertEqual(study["error"], "RMS error of the hit distance")

    def test_points_in_double(self):
        self.write("plane.glsl", PLANE.replace("1e-9", "1e-12"))
        single = self.points(self.study("plane.glsl", "--vary", "N=8,16,32", "--reference", "N=64"))
        study = self.study("plane.glsl", "--vary", "N=8,16,32", "--reference", "N=64", "--precision", "double")
        self.assertEqual(study["precision"], "double")
        self.assertIn("promoted to double", study["references"]["picture"]["method"])
        self.assertIn("read back as floats, precise to 3e-07", study["references"]["hits"]["self_check"])
        double = self.points(study)
        self.assertNotIn("rounding", [share["source"] for share in double["N = 8"]["shares"]])
        for n in (8, 16):  # what the steps leave is larger than a rounding of either
            self.assertAlmostEqual(double[f"N = {n}"]["all"]["hits"]["rms_t"] / (5 * 0.5 ** n), 1, places=2)
        self.assertTrue(double["N = 32"]["hollow"])
        self.assertAlmostEqual(single["N = 8"]["all"]["hits"]["rms_t"], double["N = 8"]["all"]["hits"]["rms_t"],
                               places=6)

    def test_a_point_that_cannot_be_promoted_ends_with_its_place(self):
        self.write("deep.glsl", SUM.replace("c = vec4", "gl_FragDepth = 0.5; c = vec4"))
        done = self.run_program("study", "deep.glsl", "--vary", "STEPS=4,8", "--precision", "double", *QUICK)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("deep.glsl:", done.stderr)

    def test_error_is_split_into_causes(self):
        self.write("plane.glsl", PLANE)
        self.write("plane.study.json", json.dumps({
            "views": [{"name": "only", "time": 0}],
            "series": [{"name": "steps", "vary": {"N": [2, 40]}},
                       {"name": "near", "set": {"N": 40}, "vary": {"NEAR": ["0.5", "0.1"]}}],
            "reference": {"N": 60},
            "sources": [{"name": "budget", "set": {"N": 40}}, {"name": "epsilon", "set": {"NEAR": "1e-9"}}]}))
        points = self.points(self.study("plane.glsl"))
        shares = {label: {s["source"]: s["rms_t"] for s in point["shares"]} for label, point in points.items()}
        self.assertAlmostEqual(shares["N = 2"]["budget"], 1.25, places=4)
        self.assertAlmostEqual(shares["N = 2"]["epsilon"], 0, places=4)
        self.assertAlmostEqual(shares["N = 40, NEAR = 0.5"]["budget"], 0, places=4)
        self.assertAlmostEqual(shares["N = 40, NEAR = 0.5"]["epsilon"], 5 / 16, places=4)
        self.assertAlmostEqual(shares["N = 40, NEAR = 0.5"]["algorithm"], 0, places=4)


class Report(Study):
    def test_files(self):
        self.write("plane.glsl", PLANE)
        study = self.study("plane.glsl", "--vary", "N=2,4", "--reference", "N=40")
        names = {name.removeprefix("report/") for name in self.files()}
        wanted = {"points.csv", "study.json", "report.html", "maps/reference.png",
                  "maps/01-picture.png", "maps/01-flip.png", "maps/01-causes.png"}
        self.assertLessEqual(wanted, names)
        self.assertEqual(json.loads((self.folder / "report/study.json").read_text()), study)
        rows = list(csv.DictReader((self.folder / "report/points.csv").read_text().splitlines()))
        self.assertEqual(len(rows), 3 * 3)  # three points; two views and all
        self.assertEqual({row["view"] for row in rows}, {"t=1", "t=10", "all"})
        self.assertEqual(float(rows[-1]["rms_t"]), self.points(study)["N = 4"]["all"]["hits"]["rms_t"])
        orange = png.read(self.folder / "report/maps/01-causes.png").pixel(8, 4)
        self.assertEqual(orange, (229, 158, 0))  # exhaustion

    def test_page_is_well_formed_and_makes_no_requests(self):
        self.write("sum.glsl", SUM)
        self.study("sum.glsl", "--vary", "STEPS=4,8")
        text = (self.folder / "report/report.html").read_text()
        self.assertFalse(re.findall(r"(?:src|href)\s*=\s*\"(?!data:|#point-)[^\"]+\"|url\(|@import|https?:", text))
        open_tags: list[str] = []
        test = self

        class Checker(html.parser.HTMLParser):
            VOID = {"meta", "img", "input", "br"}

            def handle_starttag(self, tag, attributes):
                if tag not in self.VOID:
                    open_tags.append(tag)

            def handle_endtag(self, tag):
                test.assertEqual(open_tags.pop(), tag)

        Checker().feed(text)
        self.assertEqual(open_tags, [])
        self.assertIn("STEPS = 8", text)


class Baseline(Study):
    def test_itself_is_not_worse_and_a_coarser_scene_is(self):
        self.write("sum.glsl", SUM)
        self.study("sum.glsl", "--vary", "STEPS=8,16")
        (self.folder / "report/study.json").rename(self.folder / "old.json")
        self.write("sum.glsl", SUM.replace("+ 0.5)", "+ 0.2)"))
        self.study("sum.glsl", "--vary", "STEPS=8,16", "--reference", "STEPS=4096", "--baseline", "old.json", code=1)
        self.assertRegex(self.words, r"STEPS = 16: less exact: RMSE of the picture \S+ -> \S+")

    def test_errors(self):
        self.write("sum.glsl", SUM)
        self.write("old.json", "{}")
        done = self.run_program("study", "sum.glsl", "--vary", "STEPS=4,8", "--baseline", "none.json", *QUICK)
        self.assertEqual((done.returncode, done.stderr), (3, "tidemark: error: cannot read 'none.json': no such file\n"))


class Interrupted(Study):
    def test_partial_results_are_written_and_marked(self):
        self.write("slow.glsl", SUM.replace("STEPS 4", "STEPS 20000"))
        program = subprocess.Popen([PROGRAM, "study", "slow.glsl", "--vary", "STEPS=4,8,20000", "--reference", "STEPS=8",
                                    "--size", "64x36", "--budget", "1000", "-o", "report"], cwd=self.folder,
                                   stderr=subprocess.PIPE, text=True, env=environment())
        for line in program.stderr:
            if "rounds timed" in line:
                break
        time.sleep(0.2)
        program.send_signal(signal.SIGINT)
        program.stderr.read()
        program.stderr.close()
        self.assertEqual(program.wait(60), 130)
        study = json.loads((self.folder / "report/study.json").read_text())
        self.assertFalse(study["complete"])
        self.assertIn("incomplete: the study was interrupted", study["verdict"])
        self.assertIn("rmse", self.points(study)["STEPS = 8"]["all"]["picture"])
        self.assertIn("incomplete", (self.folder / "report/report.html").read_text())


    def test_interrupt_before_the_reference_exits_130(self):
        self.write("slow.glsl", SUM.replace("STEPS 4", "STEPS 20000"))
        program = subprocess.Popen([PROGRAM, "study", "slow.glsl", "--vary", "STEPS=4,8,20000", "--size", "640x360",
                                    "-o", "report"], cwd=self.folder, stderr=subprocess.PIPE, text=True, env=environment())
        while program.poll() is None and not (self.folder / "report").exists():
            time.sleep(0.01)
        program.send_signal(signal.SIGINT)
        words = program.stderr.read()
        program.stderr.close()
        self.assertEqual(program.wait(60), 130, words)
        self.assertIn("interrupted before there was a reference", words)


class Kept(Study):
    """What a finished study has written stays until another is whole."""

    def setUp(self):
        super().setUp()
        self.write("sum.glsl", SUM)
        self.study("sum.glsl", "--vary", "STEPS=4,8")
        self.before = self.contents()

    def contents(self) -> dict[str, bytes]:
        return {name: (self.folder / name).read_bytes() for name in self.files() if name.startswith("report/")}

    def test_a_failing_study_replaces_nothing(self):
        self.write("broken.glsl", "#define STEPS 1\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(nothing); }\n")
        for arguments, code in (("sum.glsl --vary STOPS=4,8", 2), ("sum.glsl --vary STEPS=4,8 --reference STOPS=1", 2),
                                ("broken.glsl --vary STEPS=4,8", 3), ("none.glsl --vary STEPS=4,8", 3),
                                ("sum.glsl --vary STEPS=4,8 --device none", 2), ("sum.glsl --vary STEPS=4,8 --set x=1", 2),
                                ("sum.glsl --vary STEPS=4,8 --baseline none.json", 3),
                                ("sum.glsl --vary STEPS=4,8 --budget 0", 2)):
            with self.subTest(arguments=arguments):
                done = self.run_program("study", *arguments.split(), "-o", "report")
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertEqual(self.contents(), self.before)

    def test_a_full_disk_replaces_nothing(self):
        # A disk of our own that has room for one report and not for two, gone with the shell.
        shell = ("unshare", "--user", "--map-root-user", "--mount", "sh", "-c")
        size = sum((len(data) + 4095) // 4096 for data in self.before.values()) * 4 + 40
        disk = f"mount -t tmpfs -o size={size}k none disk"
        (self.folder / "disk").mkdir()
        if subprocess.run([*shell, disk], cwd=self.folder, stderr=subprocess.DEVNULL).returncode:
            self.skipTest("this system lets nobody mount a disk of their own")
        line = (f'{disk} && cp -r report disk && (cd disk/report && sha256sum study.json points.csv) && '
                '"$0" study sum.glsl --vary STEPS=4,8,16 --size 16x9 --budget 1 -o disk/report; echo $?; '
                '(cd disk/report && sha256sum study.json points.csv)')
        done = subprocess.run([*shell, line, PROGRAM], cwd=self.folder, env=environment(), text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        lines = done.stdout.splitlines()
        self.assertEqual(lines[2], "4", done.stderr)
        self.assertEqual(lines[:2], lines[3:])

    def test_an_interrupted_study_is_written_beside_the_old_study(self):
        self.write("slow.glsl", SUM.replace("STEPS 4", "STEPS 20000"))
        for _ in range(2):
            program = subprocess.Popen([PROGRAM, "study", "slow.glsl", "--vary", "STEPS=4,8,20000", "--reference", "STEPS=8",
                                        "--size", "64x36", "--budget", "1000", "-o", "report/"], cwd=self.folder,
                                       stderr=subprocess.PIPE, text=True, env=environment())
            for line in program.stderr:
                if "rounds timed" in line:
                    break
            time.sleep(0.2)
            program.send_signal(signal.SIGINT)
            words = program.stderr.read()
            program.stderr.close()
            self.assertEqual(program.wait(60), 130)
            self.assertEqual(self.contents(), self.before)
            self.assertIn("wrote report-interrupted/report.html\n", words)
            study = json.loads((self.folder / "report-interrupted/study.json").read_text())
            self.assertFalse(study["complete"])

    def test_an_invalid_baseline_is_an_error(self):
        for text in ('{"schema": 5, "points": []}', '{"schema": "tidemark study 1"}', "[1]",
                     '{"schema": "tidemark study 1", "points": [{"all": 1, "label": 7}], "views": 3}'):
            self.write("old.json", text)
            done = self.run_program("study", "sum.glsl", "--vary", "STEPS=4,8", "--baseline", "old.json", *QUICK, "-o", "r")
            self.assertEqual(done.returncode, 3, (text, done.stderr))
            self.assertIn("--baseline 'old.json': ", done.stderr)


class Names(Study):
    """What a study file calls things ends in files that other programs read."""

    HOSTILE = ["$(touch RAN)", "`touch RAN`", "'; system('touch RAN'); '", '"; system("touch RAN"); "', "@touch",
               "=cmd|' /C calc'!A0", "+1+1", "-1+1", "@SUM(1)", "</script><script>alert(1)</script>", "a,b", "<b>&amp;",
               "x\nEOD\nsystem('touch RAN')\n!touch RAN\n", "x\ty\x1b]0;z\x07", "{/Symbol a}^2_3", "%s %d \\"]

    def test_are_escaped_in_every_output(self):
        self.write("sum.glsl", SUM)
        self.write("sum.study.json", json.dumps({
            "about": "</p><script>alert(2)</script>\n`touch RAN`",
            "views": [{"name": name, "time": i} for i, name in enumerate(self.HOSTILE[:4])],
            "series": [{"name": name, "trust": "heuristic",
                        "vary": {"STEPS": [2 ** (i % 4 + 1), f"({i} + 2) /* `touch RAN` \" $(touch RAN) */"]}}
                       for i, name in enumerate(self.HOSTILE)],
            "reference": {"STEPS": 4096}, "omissions": self.HOSTILE}))
        study = self.study("sum.glsl")
        report = self.folder / "report"
        self.assertEqual({point["series"] for point in study["points"]} - set(self.HOSTILE), {"defaults"})

        self.assertFalse([name for name in self.files() if "RAN" in name])

        with open(report / "points.csv", newline="") as file:
            rows = list(csv.reader(file))
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        self.assertEqual(len(rows), 1 + 5 * len(study["points"]))
        for cell in (cell for row in rows[1:] for cell in row):
            self.assertFalse([c for c in cell if ord(c) < 32], cell)
            if cell[:1] in ("=", "+", "-", "@"):
                float(cell)

        page = (report / "report.html").read_text()
        self.assertEqual(page.count("<script"), 3)  # the page's own
        self.assertNotIn("alert(1)</script>", page)
        self.assertFalse([c for c in page if ord(c) < 32 and c != "\n"])

    def test_knobs_named_like_a_column(self):
        self.write("a.glsl", SUM.replace("STEPS", "label"))
        self.study("a.glsl", "--vary", "label=4,8")
        rows = list(csv.DictReader((self.folder / "report/points.csv").read_text().splitlines()))
        self.assertEqual({row["set label"] for row in rows}, {"4", "8"})
        self.assertEqual({row["label"] for row in rows}, {"defaults", "label = 4", "label = 8"})


class BadInput(Study):
    def refuse(self, arguments: str, code: int, words: str) -> None:
        with self.subTest(arguments=arguments):
            done = self.run_program("study", *arguments.split(), *QUICK, "-o", "report")
            self.assertEqual(done.stderr.splitlines()[-1], f"tidemark: error: {words}")
            self.assertEqual(done.returncode, code)

    def test_lines(self):
        self.write("sum.glsl", SUM + "#iUniform float gain = 1.0\n")
        self.write("plain.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p.x); }\n")
        self.refuse("plain.glsl", 2, "found no number in this scene that trades time for exactness: name one with --vary "
                                     "NAME=a,b,c, from the coarsest to the strictest")
        self.refuse("sum.glsl --vary STEP=1,2", 2,
                    "the scene has no #iUniform, #define or const 'STEP': did you mean 'STEPS'?")
        self.refuse("sum.glsl --vary STEPS=1,,2", 2, "--vary STEPS=1,,2: give NAME=a,b,c, none of them empty")
        self.refuse("sum.glsl --vary STEPS", 2, "--vary STEPS: give NAME=a,b,c, none of them empty")
        self.refuse("sum.glsl --vary gain=1,two", 2, "'two' is not a value for gain (float): give a number")
        self.refuse("sum.glsl --vary STEPS=1,2 --reference STEPS", 2,
                    "--reference STEPS: give NAME=V or NAME=V,NAME=V")
        self.refuse("sum.glsl --vary STEPS=1,2 --reference STOPS=3", 2,
                    "the scene has no #iUniform, #define or const 'STOPS': did you mean 'STEPS'?")
        self.refuse("sum.glsl --vary STEPS=1,2 --views 1@1.5,0", 2,
                    "view 't=1@1.5,0': the mouse at 1.5, 0 is outside the picture; give fractions of its width and height, 0 to 1")
        self.refuse("sum.glsl --vary STEPS=1,2 --views soon", 2,
                    "--views soon: give times and places of the mouse, as in 0;10@0.75,0.4, or a .json file")
        self.refuse("none.glsl --vary STEPS=1,2", 3, "cannot read 'none.glsl': no such file")
        self.write("bad.study.json", '{\n"serie": []}')
        done = self.run_program("study", "sum.glsl", "--study", "bad.study.json")
        self.assertEqual((done.returncode, done.stderr),
                         (3, 'bad.study.json:2: error: /serie: did you mean "series"?\n'))

    def test_an_unwritable_folder_is_reported_before_the_work(self):
        self.write("sum.glsl", SUM)
        self.write("file", "")
        start = time.monotonic()
        done = self.run_program("study", "sum.glsl", "--vary", "STEPS=4,8", "-o", "file/report")
        self.assertEqual(done.returncode, 4)
        self.assertEqual(done.stderr, "tidemark: error: cannot make the folder 'file/report': Not a directory\n")
        self.assertLess(time.monotonic() - start, 30)

    def test_a_scene_that_does_not_compile(self):
        self.write("broken.glsl", "#define A 1\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(nothing); }\n")
        done = self.run_program("study", "broken.glsl", "--vary", "A=1,2", "-o", "report", *QUICK)
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr, r"broken\.glsl:2(:50)?: error: ")


if __name__ == "__main__":
    main()
