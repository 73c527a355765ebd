#!/usr/bin/env python3
"""Comments read as plain English: few of them have the shapes that readers found to be riddles.

`plain_test.py list [PATH…]` prints the lines that match; without arguments it is a test with a bound on their number.
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


def sources(folders):
    for folder in folders:
        folder = pathlib.Path(folder)
        yield from [folder] if folder.is_file() else sorted(p for p in folder.rglob("*") if p.suffix in SOURCES)


class PlainEnglish(unittest.TestCase):
    def test_few_comments_are_riddles(self):
        found = list(riddles(sources([ROOT / "runner"])))
        lines = "\n".join(f"{path.relative_to(ROOT)}:{number}: {text}" for path, number, text in found)
        self.assertLess(len(found), BOUND, f"comments to write anew (tests/README.md):\n{lines}")


if __name__ == "__main__":
    if sys.argv[1:2] == ["list"]:
        for path, number, text in riddles(sources(sys.argv[2:] or [ROOT / "runner"])):
            print(f"{path}:{number}: {text}")
    else:
        unittest.main()
