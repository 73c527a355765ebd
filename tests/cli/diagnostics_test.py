"""--diagnostics: one place for all commands that compile; forms for programs; the patterns of the documents."""
import json
import pathlib
import re
import shutil
import subprocess
import unittest

from support.program import ROOT, ProgramTest, environment, main

PAGE = ROOT / "runner" / "cli" / "manual" / "editors.md"

BROKEN = """\
#define STEPS 2
void mainImage(out vec4 c, in vec2 p) {
    /* \u00e9\U0001F30A */ float d = thrice(p.x);
    c = vec4(d) + nowhere;
}
"""
GOOD = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p.x / iResolution.x); }\n"
NAN = """\
void mainImage(out vec4 c, in vec2 p) {
    float edge = p.x > 16.0 ? 0.5 : 0.0;
    c = vec4(1.0 / (edge * iResolution.x));
}
"""
WANTED = {(3, "scene"), (4, "scene")}


def fenced(kind: str) -> str:
    """The block of that kind in the page."""
    return re.search(rf"^```{kind}\n(.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL)[1]


class Forms(ProgramTest):
    def setUp(self) -> None:
        super().setUp()
        self.write("broken.glsl", BROKEN)

    def json_lines(self, *arguments: str, code: int = 3) -> list[dict]:
        done = self.run_program(*arguments, "--diagnostics", "json")
        self.assertEqual(done.returncode, code, done.stderr)
        return [json.loads(line) for line in done.stderr.splitlines()]

    def sarif(self, *arguments: str, code: int) -> dict:
        done = self.run_program(*arguments, "--diagnostics", "sarif")
        self.assertEqual(done.returncode, code, done.stderr)
        log = json.loads(done.stderr)
        self.check_sarif(log)
        return log["runs"][0]

    def check_sarif(self, log: dict) -> None:
        """What SARIF 2.1.0 asks of the parts that we write."""
        self.assertEqual(log["version"], "2.1.0")
        self.assertRegex(log["$schema"], r"^https://.*sarif.*2\.1\.0.*\.json$")
        self.assertEqual(len(log["runs"]), 1)
        run = log["runs"][0]
        self.assertLessEqual(set(run), {"tool", "columnKind", "results"})
        self.assertIn(run["columnKind"], ("utf16CodeUnits", "unicodeCodePoints"))
        rules = run["tool"]["driver"]["rules"]
        self.assertTrue(run["tool"]["driver"]["name"])
        self.assertEqual(len({rule["id"] for rule in rules}), len(rules))
        for rule in rules:
            self.assertTrue(rule["shortDescription"]["text"])
        for result in run["results"]:
            self.assertEqual(rules[result["ruleIndex"]]["id"], result["ruleId"])
            self.assertIn(result["level"], ("none", "note", "warning", "error"))
            self.assertTrue(result["message"]["text"])
            for location in result.get("locations", []):
                physical = location["physicalLocation"]
                self.assertRegex(physical["artifactLocation"]["uri"], r"^[A-Za-z0-9._~/%:-]+$")
                region = physical.get("region", {"startLine": 1})
                self.assertGreaterEqual(region["startLine"], 1)
                self.assertGreater(region.get("endColumn", 99999), region.get("startColumn", 1))

    def test_gcc_has_all_parts_in_every_line(self) -> None:
        done = self.run_program("capture", "broken.glsl", "--diagnostics", "gcc")
        self.assertEqual(done.returncode, 3)
        lines = done.stderr.splitlines()
        self.assertEqual(lines[0], "broken.glsl:3:28: error: no function with name 'thrice'")
        for line in lines:
            self.assertRegex(line, r"^broken\.glsl:\d+:\d+: (error|warning|note): ")

    def test_gcc_places_an_error_without_a_line_on_line_1(self) -> None:
        (self.folder / "empty").mkdir()
        self.write("two/image.glsl", GOOD)
        self.write("two/buffer_a.glsl", GOOD)
        done = self.run_program("inspect", "two", "--device", "none", "--diagnostics", "gcc")
        self.assertIn("two/buffer_a.glsl:1:1: warning: no other pass reads 'Buffer A'", done.stderr)
        done = self.run_program("inspect", "empty", "--device", "none", "--diagnostics", "gcc")
        self.assertRegex(done.stderr, r"^empty:1:1: error: 'empty' has no image.glsl")

    def test_unreadable_files_have_a_place(self) -> None:
        why = "cannot read 'none.glsl': no such file"
        self.expect_failure(["capture", "none.glsl", "--diagnostics", "gcc"], 3, f"none.glsl:1:1: error: {why}")
        found = self.json_lines("capture", "none.glsl")
        self.assertEqual([(each["file"], each["line"], each["message"]) for each in found], [("none.glsl", 0, why)])
        result, = self.sarif("capture", "none.glsl", code=3)["results"]
        place = result["locations"][0]["physicalLocation"]
        self.assertEqual((place["artifactLocation"]["uri"], place["region"]["startLine"]), ("none.glsl", 1))
        self.write("good.glsl", GOOD)
        self.expect_failure(["capture", "good.glsl", "--size", "nothing", "--diagnostics", "gcc"], 2,
                            self.run_program("capture", "good.glsl", "--size", "nothing").stderr[:-1])

    def test_json_gives_places_with_ends(self) -> None:
        first = self.json_lines("capture", "broken.glsl")[0]
        column = BROKEN.splitlines()[2].encode().index(b"thrice") + 1
        self.assertEqual(first, {"file": "broken.glsl", "line": 3, "column": column, "end_column": column + 6,
                                 "severity": "error", "rule": "scene", "message": "no function with name 'thrice'"})

    def test_further_errors_are_counted(self) -> None:
        found = self.json_lines("capture", "broken.glsl")
        self.assertEqual([each["line"] for each in found if each["severity"] == "error"], [3, 4])
        self.assertTrue(any("follow" in each["message"] for each in found if each["severity"] == "note"), found)

    def test_every_command_that_compiles_takes_the_option(self) -> None:
        for command in ("capture", "check", "study", "inspect", "trace"):
            with self.subTest(command):
                more = {"trace": ("--pixel", "1,1"), "study": ("--vary", "STEPS=1,2")}.get(command, ())
                found = self.json_lines(command, "broken.glsl", *more)
                self.assertEqual({(each["line"], each["rule"]) for each in found if each["severity"] == "error"}, WANTED)
        for command in ("export", "view"):
            self.assertIn(b"--diagnostics", self.succeed(command, "--help").stdout)

    def test_successful_runs_give_no_diagnostics(self) -> None:
        self.write("good.glsl", GOOD)
        self.assertEqual(self.json_lines("capture", "good.glsl", "-o", "a.png", "--size", "16x9", code=0), [])
        self.assertEqual(self.sarif("capture", "good.glsl", "-o", "b.png", "--size", "16x9", code=0)["results"], [])

    def test_sarif_counts_columns_in_utf16(self) -> None:
        result = self.sarif("capture", "broken.glsl", code=3)["results"][0]
        line = BROKEN.splitlines()[2]
        before = len(line[:line.index("thrice")].encode("utf-16-le")) // 2
        location = result["locations"][0]["physicalLocation"]
        self.assertEqual(location["artifactLocation"]["uri"], "broken.glsl")
        self.assertEqual(location["region"], {"startLine": 3, "startColumn": before + 1, "endColumn": before + 7})

    def test_sarif_escapes_names(self) -> None:
        self.write("a b/w\u00e4ves.glsl", BROKEN)
        result = self.sarif("capture", "a b/w\u00e4ves.glsl", code=3)["results"][0]
        self.assertEqual(result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "a%20b/w%C3%A4ves.glsl")

    def test_sarif_of_a_probe_has_the_place_of_the_origin(self) -> None:
        self.write("nan.glsl", NAN)
        run = self.sarif("check", "nan.glsl", "--probe", "times", "--budget", "900", code=1)
        result = run["results"][0]
        self.assertEqual((result["ruleId"], result["level"]), ("times", "error"))
        self.assertEqual(result["locations"][0]["physicalLocation"]["region"]["startLine"], 3)

    def test_a_trace_is_a_finding(self) -> None:
        self.write("nan.glsl", NAN)
        found = self.json_lines("check", "--trace", "nan.glsl", code=1)
        self.assertEqual([(each["rule"], each["line"]) for each in found], [("trace", 3)])

    def test_portable_findings_are_diagnostics(self) -> None:
        self.write("old.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(fma(1.0, 2.0, p.x)); }\n")
        run = self.sarif("check", "--portable", "old.glsl", code=1)
        self.assertEqual({result["ruleId"] for result in run["results"]}, {"portable"})
        self.assertEqual(self.run_program("check", "--portable", "old.glsl", "--diagnostics", "gcc").stdout, b"")

    def test_an_exceeded_limit_is_a_sarif_result(self) -> None:
        self.write("slow.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.0); for (int i = 0; i < 60000; ++i) "
                   "c += sin(float(i) + p.x * c.y + iTime); }\n")  # long enough for its memory to be looked at
        run = self.sarif("capture", "slow.glsl", "--memory", "1M", code=5)
        self.assertEqual([result["ruleId"] for result in run["results"]], ["limits"])

    def test_unknown_form_is_refused(self) -> None:
        self.expect_error(["capture", "broken.glsl", "--diagnostics", "xml"], 2, "--diagnostics", "'xml'")


class Patterns(ProgramTest):
    """Of the documents, on what the program prints."""

    def setUp(self) -> None:
        super().setUp()
        self.write("broken.glsl", BROKEN)
        self.printed = self.run_program("capture", "broken.glsl", "--diagnostics", "gcc").stderr

    def check_places(self, found: list[tuple]) -> None:
        self.assertEqual([each for each in found if each[3] == "error"],
                         [("broken.glsl", 3, 28, "error"), ("broken.glsl", 4, 19, "error")])

    def test_problem_matcher_of_vs_code(self) -> None:
        pattern = json.loads(fenced("json"))["tasks"][0]["problemMatcher"]["pattern"]
        matches = [re.search(pattern["regexp"], line) for line in self.printed.splitlines()]
        self.assertTrue(all(matches))
        names = ("file", "line", "column", "severity")
        self.check_places([(m[pattern["file"]], int(m[pattern["line"]]), int(m[pattern["column"]]),
                            m[pattern["severity"]]) for m in matches])
        self.assertEqual(set(pattern), {*names, "regexp", "message"})

    @unittest.skipUnless(shutil.which("vim"), "there is no vim")
    def test_errorformat_of_vim(self) -> None:
        self.write("printed.txt", self.printed)
        self.write("script.vim", fenced("vim") + "cgetfile printed.txt\n"
                   "call writefile(map(filter(getqflist(), 'v:val.valid'), 'bufname(v:val.bufnr) . \"|\" . v:val.lnum . \"|\" . "
                   "v:val.col . \"|\" . v:val.type'), 'found.txt')\nqa!\n")
        subprocess.run(["vim", "-u", "NONE", "-es", "-S", "script.vim"], cwd=self.folder, env=environment(), timeout=60,
                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        rows = [row.split("|") for row in (self.folder / "found.txt").read_text().splitlines()]
        kinds = {"e": "error", "w": "warning", "n": "note"}
        self.check_places([(row[0], int(row[1]), int(row[2]), kinds[row[3].lower()]) for row in rows])

    def test_regexp_of_emacs(self) -> None:
        """By Python's re, which reads this one alike but for the backslashes of its groups."""
        written = re.search(r'"(\^.*?)" 1 2 3', fenced("elisp"))[1]
        pattern = re.compile(re.sub(r"\\\\([()|])", r"\1", written))
        matches = [pattern.match(line) for line in self.printed.splitlines()]
        self.assertTrue(all(matches))
        self.check_places([(m[1], int(m[2]), int(m[3]), "error" if not m[4] and not m[5] else "other") for m in matches])


if __name__ == "__main__":
    main()
