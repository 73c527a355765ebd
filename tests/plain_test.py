#!/usr/bin/env python3
"""Comments and the names of tests read as plain English: few have the shapes that readers found to be riddles.

`plain_test.py list [PATH…]` prints the lines that match; without arguments it is a test with bounds on their number.
"""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).parent.parent
SOURCES = (".cpp", ".hpp", ".js", ".py", ".mjs")

# Comments that have no subject ("What the driver has compiled"), that have a person for one where a thing acts
# ("nobody reads it"), and words of place for words of time ("behind the last frame").
RIDDLE = re.compile(
    r"^(What|Who|Whoever|Whose|Whom|Of|Where)\b"
    r"|\b([Nn]obody|[Ss]omebody|[Ww]hoever|[Pp]eople|[Bb]ehind|[Ii]n front of)\b"
    r"|\b(is|are) no\b(?! (more|longer|less|larger|greater|smaller))"
)
BOUND = 150

# Names of tests without a subject ("what_is_wrong_is_said"), with a person for one, with verbs that programs do not do
# (they report, require, detect), and names that end in a word for something that they do not name.
NAME_RIDDLE = re.compile(
    r"^(what|those|they|it|nor|and|so|there|others)_"
    r"|_(it|them|one|ones|others|both|so|what|who|there|anew|as_it_(is|was))$"
    r"|(^|_)(nobodys?|somebody|anybody|whoever|whatever|whom?|people|person|behind|in_front|(give|gives|given)_up|"
    r"asks?|asked|wants?|wanted|knows?|tells?|told(?!_apart)|said|hears?|heard|speaks?|spoken|minds?)(_|$)"
    r"|(^|_)(is|are)_no(ne)?(_|$)"
)
NAME = re.compile(r"^ +(?:async )?def test_(\w+)|^ *TEST(?:_F|_P)?\(\w+, (\w+)\)", re.MULTILINE)
COMMENT = re.compile(r"^\s*(?://+|#)\s?(.*)$|\s(?://+)\s(.*)$")


def riddles(paths):
    """(file, line number, text) of each comment line that matches."""
    for path in paths:
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if path.suffix in (".cpp", ".hpp") and line.lstrip().startswith("#"):
                continue
            match = COMMENT.search(line)
            text = match and (match.group(1) or match.group(2) or "")
            if text and RIDDLE.search(text):
                yield path, number, text


def riddle_names(paths):
    """(file, line number, name) of each test whose name matches."""
    for path in paths:
        text = path.read_text()
        for match in NAME.finditer(text):
            name = match.group(1) or match.group(2)
            if NAME_RIDDLE.search(re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()):
                yield path, text.count("\n", 0, match.start()) + 1, name


def sources(folders):
    for folder in folders:
        folder = pathlib.Path(folder)
        yield from [folder] if folder.is_file() else sorted(p for p in folder.rglob("*") if p.suffix in SOURCES)


class PlainEnglish(unittest.TestCase):
    def test_few_comments_are_riddles(self):
        found = list(riddles(sources([ROOT / "runner"])))
        lines = "\n".join(f"{path.relative_to(ROOT)}:{number}: {text}" for path, number, text in found)
        self.assertLess(len(found), BOUND, f"comments to write anew (tests/README.md):\n{lines}")

    def test_no_name_of_a_test_is_a_riddle(self):
        tests = list(sources([ROOT / "tests"]))
        self.assertGreater(sum(len(NAME.findall(path.read_text())) for path in tests), 3000)
        lines = [f"{path.relative_to(ROOT)}:{number}: {name}" for path, number, name in riddle_names(tests)]
        if lines:
            self.fail("tests to rename: a name states the subject and the expected result\n" + "\n".join(lines))


if __name__ == "__main__":
    if sys.argv[1:2] == ["list"]:
        found = [*riddles(sources(sys.argv[2:] or [ROOT / "runner"])), *riddle_names(sources(sys.argv[2:] or [ROOT / "tests"]))]
        for path, number, text in found:
            print(f"{path}:{number}: {text}")
    else:
        unittest.main()
