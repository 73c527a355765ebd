"""The pages say what is: options, probes and directives, commands and what they print, links, names of files."""
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import unittest

from support import option_table
from support.program import PROGRAM, ROOT, TIME_LIMIT, ProgramTest, driver, environment, has_context, main

MANUAL = ROOT / "runner" / "cli" / "manual"
PAGES = sorted([path for path in ROOT.rglob("README.md") if "build" not in path.relative_to(ROOT).parts] +
               list(MANUAL.glob("*.md")))
LONGEST, LONGEST_FIRST = 250, 150  # lines of a page; of README.md itself

# The page that explains each kind of thing.
COMMANDS = MANUAL / "commands.md"
OPTIONS = MANUAL / "options.md"
PROBES = MANUAL / "probes.md"
DIRECTIVES = MANUAL / "scenes.md"
ROOMS = ROOT / "runner" / "README.md"
HELP_PAGES = [*sorted(MANUAL.glob("*.md")), ROOT / "shaders" / "README.md"]

# Commands of the pages that are not run: they open a window, or take what no test machine can give.
NOT_RUN = (
    r"tidemark (view )?\S+\.glsl( |$)",  # a window
    r"tidemark view ",
    r"tidemark import .*my-fetch",  # a person's own program
    r"tidemark serve ",  # until it is told to end
    r"ssh ",  # another machine
)
# Commands whose words are times, which differ from run to run.
NOT_COMPARED = (r"tidemark (study|tune|simplify) ",)
# Options that make a command of a page small, where it has none of its own.
SMALL = {
    "capture": ("--size", "64x36"),
    "study": ("--size", "32x18", "--budget", "1"),
    "tune": ("--size", "32x18", "--budget", "20"),
    "simplify": ("--size", "32x18", "--budget", "20"),
}
PATIENT = ("--budget", "900")  # a busy machine cuts no probe
HASTY = ("--budget", "1")  # inspect --hot-lines measures until its budget is spent
SHORTER = ((r"\b0-299\b", "0-2"), (r"\b30000x20000\b", "300x200"))
# The probes of water_surface.glsl that the page shows, and some others. All of them, which `./dev soak` runs, take
# half a minute of CPU time.
WATER_PROBES = ("overstep", "lipschitz_sweep", "time_discontinuity", "hashes", "sizes", "turns", "unassigned", "counters", "tiles")


def relative(path: pathlib.Path) -> str:
    return str(path.relative_to(ROOT))


class Fence:
    """A block of a page between ``` and ```."""

    def __init__(self, page: pathlib.Path, match: re.Match) -> None:
        self.page, self.kind, self.text = page, match[1], match[2]
        self.before = page.read_text()[:match.start()].rstrip().splitlines()[-1]

    def file(self) -> str | None:
        """The name of a file that the line before it shows: "This is `foam.glsl`:"."""
        named = re.findall(r"`([\w.]+\.(?:glsl|txt))`", self.before)
        return named[0] if named and self.kind in ("glsl", "") else None

    def commands(self) -> list[tuple[str, list[str]]]:
        """Each command with the lines it prints, as a `console` block shows both and a `sh` block the first."""
        if self.kind == "sh":
            return [(line, []) for line in self.text.splitlines() if line]
        shown: list[tuple[str, list[str]]] = []
        for line in self.text.splitlines() if self.kind == "console" else []:
            if line.startswith("$ "):
                shown.append((line[2:], []))
            else:
                shown[-1][1].append(line)
        return shown


def fences() -> list[Fence]:
    """README.md's first."""
    pages = sorted(PAGES, key=lambda page: len(page.parts))
    return [Fence(page, match) for page in pages
            for match in re.finditer(r"^```(\w*)\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)]


def without_numbers(line: str) -> str:
    return re.sub(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?", "0", line).strip()


class Commands(ProgramTest):
    """Every command that stands in a page, in one folder, in the order of the pages."""

    def setUp(self) -> None:
        super().setUp()
        for name in ("shaders", "textures"):
            shutil.copytree(ROOT / name, self.folder / name)
        self.shorten(self.folder / "shaders" / "water_surface")
        for fence in fences():
            if name := fence.file():
                self.write(name, fence.text)
        self.write("sandbox.glsl", "uniform float amount; // 0 2\nvoid main() { gl_FragColor = vec4(amount); }\n")
        self.write("my_shader.presets.json", '{"tidemark_presets": 1, "presets": [{"name": "dawn", "time": 1}]}')
        self.write("my_shader.glsl", "#define MAX_STEPS 64\nvoid mainImage(out vec4 c, in vec2 p) {\n    float sum = 0.0;\n"
                   "    for (int i = 1; i <= MAX_STEPS; ++i)\n        sum += sin(float(i) * p.x) / float(i * i);\n"
                   "    c = vec4(vec3(sum), 1.0);\n}\n")
        project = {"info": {"id": "XxXxXx"}, "renderpass": [{"type": "image", "code": "void mainImage() {}"}]}
        self.write("project.json", json.dumps(project))
        self.write("all.json", json.dumps({"shaders": [project, project]}))

    def shorten(self, scene: pathlib.Path) -> None:
        """Leaves some of the scene's probes, and of its study two views and two values of one series: each value is a
        program to compile."""
        promises_file, study_file = scene.with_suffix(".check.json"), scene.with_suffix(".study.json")
        study = json.loads(study_file.read_text())
        listed = ProgramTest.run_program(self, "check", "--list").stdout.decode()
        skipped = {line.split()[0]: "see WATER_PROBES" for line in listed.splitlines() if line.split()[0] not in WATER_PROBES}
        promises_file.write_text(promises_file.read_text().replace("{", f'{{ "skip": {json.dumps(skipped)},', 1))
        study["views"] = study["views"][:2]
        study["series"] = study["series"][:1]
        for series in study["series"]:
            series["vary"] = {name: [values[0], values[-1]] for name, values in series["vary"].items()}
        study_file.write_text(json.dumps(study))

    @staticmethod
    def small(command: str) -> list[str]:
        for pattern, less in SHORTER:
            command = re.sub(pattern, less, command)
        words = shlex.split(command, comments=True)[1:]
        if words[0] == "check" and not {"--budget", "--trace"} & set(words):
            words += PATIENT
        if "--hot-lines" in words and "--budget" not in words:
            words += HASTY
        wanted = SMALL.get(words[0], ())
        return words + ([] if "--size" in words else list(wanted[:2])) + list(wanted[2:])

    def test_commands_of_pages_print_the_shown_output(self) -> None:
        shown = [(fence, command, printed) for fence in fences() for command, printed in fence.commands()]
        self.assertGreater(len(shown), 20)
        software = "llvmpipe" in driver()
        for fence, command, printed in shown:
            if any(re.match(pattern, command) for pattern in NOT_RUN):
                continue
            with self.subTest(page=relative(fence.page), command=command):
                self.assertTrue(command.startswith("tidemark "), "mark it in another kind of block")
                wanted = re.search(r"# exit (\d+)", command)
                done = self.run_program(*self.small(command), stderr=subprocess.STDOUT)
                said = done.stdout.decode()
                self.assertEqual(done.returncode, int(wanted[1]) if wanted else 0, said)
                if software and not any(re.match(pattern, command) for pattern in NOT_COMPARED):
                    self.compare(printed, said)

    def compare(self, page: list[str], said: str) -> None:
        """Each line of the page is a line of the program's, in this order; `…` stands for anything. Numbers may
        differ, and what is in a line with several of them depends on the driver: the pages are llvmpipe's."""
        rest = [without_numbers(line) for line in said.splitlines()]
        for line in page:
            if line == "…":
                continue
            start, _, cut = without_numbers(line).partition("…")
            matching = [i for i, there in enumerate(rest)
                        if (there.startswith(start) if line.endswith("…") else there == start)]
            self.assertTrue(matching, f"nothing printed is like {line!r} in:\n{said}")
            rest = rest[matching[0] + 1:]

    def run_program(self, *arguments: str, **options) -> subprocess.CompletedProcess:
        """Without the weights that a self test has kept: pages show those of the table."""
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              env=environment(TIDEMARK_CACHE="off"), timeout=TIME_LIMIT, **options)


class Explained(unittest.TestCase):
    def rows(self, page: pathlib.Path) -> str:
        """The first cells of a page's tables."""
        return "\n".join(re.findall(r"^\| (.*?) \|", page.read_text(), re.MULTILINE))

    def needs_the_window(self) -> None:
        if "view" not in option_table.commands():
            self.skipTest("this build has no window, the pages have its options")

    def test_option_tables_equal_the_help(self) -> None:
        self.needs_the_window()
        for page, text in option_table.written_anew().items():
            with self.subTest(page=relative(page)):
                self.assertEqual(page.read_text(), text, "PYTHONPATH=tests python3 tests/support/option_table.py writes it anew")

    def test_every_option_is_in_a_table(self) -> None:
        tables = "\n".join(block[3] for page in option_table.PAGES
                           for block in option_table.BLOCK.finditer(page.read_text()))
        for command in option_table.commands_and_bake():
            for head, _ in option_table.options_of(command):
                for name in option_table.names_of(head):
                    with self.subTest(command=command):
                        self.assertRegex(tables, rf"\| `([-\w]+,)?{re.escape(name)}[ ,`=]")

    def test_options_named_by_pages_exist(self) -> None:
        self.needs_the_window()
        there = {name for command in option_table.commands_and_bake() for head, _ in option_table.options_of(command)
                 for name in option_table.names_of(head)} | {"--help", "--version"}
        foreign = {"--long", "--cluster", "--rounds", "--preset", "--build", "--install", "--prefix", "--array",
                   "--parts", "--beside", "--variant"}  # of ./dev, CMake, Slurm, verify, debootstrap
        for page in PAGES:
            for quoted in re.findall(r"`[^`\n]*`", page.read_text()):
                if "gtest" in quoted:
                    continue
                for name in re.findall(r"(?<![\w-])--[a-z][a-z-]*", quoted):
                    with self.subTest(page=relative(page)):
                        self.assertIn(name, there | foreign)

    def test_every_probe_has_its_row(self) -> None:
        listed = subprocess.run([PROGRAM, "check", "--list"], check=True, capture_output=True, text=True).stdout
        probes = [line.split()[0] for line in listed.splitlines()]
        rows = re.findall(r"^\| `(\w+)`(?: \([wn]\))? \|.*\| (proved|measured|sampled|modelled|the text) \|$",
                          PROBES.read_text(), re.MULTILINE)
        self.assertEqual(sorted(name for name, _ in rows), sorted(probes))

    def test_every_directive_has_its_row(self) -> None:
        source = (ROOT / "runner" / "scene" / "directives.cpp").read_text()
        known = re.search(r"bool DirectiveReader::at_directive\(\) const \{.*?\n\}", source, re.DOTALL)[0]
        directives = set(re.findall(r'"(\w+)"', known)) | {"include"}
        self.assertGreater(len(directives), 5)
        for directive in directives:
            with self.subTest(directive=directive):
                self.assertRegex(self.rows(DIRECTIVES), rf"`#{directive}\d?\b")

    def test_every_section_is_a_topic_of_help(self) -> None:
        def printed(*topic: str) -> str:
            return subprocess.run([PROGRAM, "help", *topic], check=True, capture_output=True, text=True).stdout

        topics = [line.strip() for line in printed().splitlines()[1:] if line]
        self.assertEqual(len(topics), len(set(topics)))
        for page in HELP_PAGES:
            text = page.read_text()
            for heading in re.findall(r"^##? (.*)$", re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL),
                                      re.MULTILINE):
                with self.subTest(page=relative(page), heading=heading):
                    topic = re.sub(r"[^\w -]", "", heading).lower().replace(" ", "-")
                    self.assertIn(topic, topics)
                    last = topic, heading
            with self.subTest(page=relative(page)):  # unit_cli formats every section
                self.assertTrue(printed(last[0]).startswith(last[1] + "\n"))
        self.assertRegex(printed("keys"), r"\n  S +save a picture \(`SCENE-FRAME.png` in the current folder, numbered if it exists\)\n")

    def test_every_exit_code_has_its_row(self) -> None:
        footer = option_table.printed_help("").partition("Exit codes: ")[2]
        codes = re.findall(r"(?:^|, )(\d+) ", footer.replace("\n", " "))
        table = COMMANDS.read_text().partition("\n## Exit codes\n")[2].partition("\n## ")[0]
        self.assertEqual(re.findall(r"^\| (\d+) \|", table, re.MULTILINE), codes)

    def test_every_key_has_its_row(self) -> None:
        source = (ROOT / "runner" / "window" / "window_keys.cpp").read_text()
        rows = re.findall(r'^    \{"(.*)",\s+"(.*)"\},$', source.partition("k_rows[]")[2], re.MULTILINE)
        table = COMMANDS.read_text().partition("\n## Keys\n")[2].partition("\n## ")[0].replace("`", "")
        self.assertGreater(len(rows), 5)
        self.assertEqual(rows, re.findall(r"^\| (.*?) \| (.*) \|$", table, re.MULTILINE)[1:])

    def test_help_searches_all_sections(self) -> None:
        done = subprocess.run([PROGRAM, "help", "NaN"], check=True, capture_output=True, text=True)
        topics = re.findall(r"^  (\S+)$", done.stdout, re.MULTILINE)
        self.assertIn("find-a-nan", topics)
        for topic in topics:
            subprocess.run([PROGRAM, "help", topic], check=True, capture_output=True)

    def test_unknown_topic(self) -> None:
        done = subprocess.run([PROGRAM, "help", "keyz"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr),
                         (2, "", "tidemark: error: no topic 'keyz': did you mean 'keys'?\n"))

    def test_every_stage_of_the_pipeline_names_an_existing_file(self) -> None:
        table = ROOMS.read_text().partition("\n## Pipeline\n")[2].partition("\n## ")[0]
        rows = re.findall(r"^\| (`.*?`) \| (`.*?`) \|", table, re.MULTILINE)
        self.assertGreater(len(rows), 4)
        for types, files in rows:
            text = "".join((ROOT / "runner" / file).read_text() for file in re.findall(r"`([^`]+)`", files))
            for name in re.findall(r"(\w+)`", types):
                with self.subTest(type=name):
                    self.assertRegex(text, rf"\b(struct|class|using) {name}\b")

    def test_every_room_is_in_the_table(self) -> None:
        rooms = {path.name for path in (ROOT / "runner").glob("*/") if path.is_dir()}
        table = ROOMS.read_text().partition("\n## Rooms\n")[2].partition("\n## ")[0]
        cells = re.findall(r"^\| (?:&nbsp;)*(`[^|]*`) \|", table, re.MULTILINE)
        self.assertEqual({name for cell in cells for name in re.findall(r"\w+", cell)}, rooms)


class Names(unittest.TestCase):
    """What is named exists."""

    # Names of files that the repository does not have: examples, outputs of commands, files of users.
    EXAMPLES = re.compile(r"(^|/)(my_|a\.|b\.|x\.|waves?\.|later\.|old\.|NAME|SCENE|PROBE|PASS)|_SUBJECT|[%{}*…]|^(out|build|seen|failures)/")

    def test_links_resolve(self) -> None:
        for page in PAGES:
            text = page.read_text()
            links = re.findall(r"\]\(([^)#\s]*)(?:#([\w-]+))?\)", text) + [(at, "") for at in re.findall(r'src="([^"]+)"', text)]
            for target, heading in links:
                with self.subTest(page=relative(page), link=f"{target}#{heading}"):
                    if target.startswith("http"):
                        continue
                    path = (page.parent / target).resolve() if target else page
                    self.assertTrue(path.exists())
                    if heading:
                        titles = re.findall(r"^#+ (.*)$", path.read_text(), re.MULTILINE)
                        self.assertIn(heading, {re.sub(r"[^\w -]", "", title).lower().replace(" ", "-") for title in titles})

    def test_pages_are_short(self) -> None:
        for page in PAGES:
            with self.subTest(page=relative(page)):
                longest = LONGEST_FIRST if page == ROOT / "README.md" else LONGEST
                self.assertLessEqual(len(page.read_text().splitlines()), longest)

    def test_files_in_comments_exist(self) -> None:
        """A comment of runner/ or tests/ that names a source names one that is there."""
        sources = [path for folder in ("runner", "tests") for path in (ROOT / folder).rglob("*")
                   if path.suffix in (".cpp", ".hpp", ".py", ".txt")]
        self.assertGreater(len(sources), 300)
        for source in sources:
            mark = "#" if source.suffix in (".py", ".txt") else "//"
            for number, line in enumerate(source.read_text().splitlines(), 1):
                _, found, comment = line.partition(mark)
                if found:
                    self.expect_files(source, number, comment)

    def test_files_in_pages_exist(self) -> None:
        for page in PAGES:
            for number, line in enumerate(page.read_text().splitlines(), 1):
                for quoted in re.findall(r"`([^`]+)`", line):
                    self.expect_files(page, number, quoted)

    def expect_files(self, source: pathlib.Path, number: int, text: str) -> None:
        for name in re.findall(r"(?<![\w/.*…%{}-])(?:[\w-]+/)*[\w-]+\.(?:cpp|hpp|py|md)\b", text):
            if self.EXAMPLES.search(name):
                continue
            with self.subTest(place=f"{relative(source)}:{number}", name=name):
                self.assertTrue(self.exists(source, name))

    def exists(self, source: pathlib.Path, name: str) -> bool:
        """Named from the root, from runner/ or tests/, from its own folder, or, without a folder, anywhere."""
        if any((base / name).exists() for base in (ROOT, ROOT / "runner", ROOT / "tests", source.parent)):
            return True
        return "/" not in name and name in ALL_NAMES


ALL_NAMES = {path.name for folder in ("runner", "tests", "shaders") for path in (ROOT / folder).rglob("*")}

if __name__ == "__main__":
    if not has_context():
        del Commands
    main(needs_context=False)
