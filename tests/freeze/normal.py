"""Turns what a program printed or wrote into lines that can be compared: no times, dates, paths, versions.

`Normal` has three questions to answer for a text: which folder to hide, whether prose counts (`wording`), and how much of it
depends on time (`mark`, the first character of a line in commands.txt).
"""
from __future__ import annotations

import dataclasses
import datetime
import json
import pathlib
import re

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?"
# Keys of JSON whose values are measured. Everything below such a key is hidden.
MEASURED_KEY = re.compile(r"(^|_)(milliseconds|seconds|ms|bytes_a_second|frames_a_second|speed_?up|peak_memory)$|^ms_|^tidemark$|^version$")
# Keys of a study whose values follow from times.
TIMED_KEY = re.compile(r"^(on_front|hollow|drifted|drift|verdict|verdicts|remarks|cheapest|budget|rounds|clock|causes|runs|device|machine)$")
MEASURED = [
    (re.compile(r"^.*\bstill .+ after \d+ s;.*\n?", re.MULTILINE), ""),  # progress, which only a busy machine shows
    (re.compile(rf"{NUMBER} -> {NUMBER} ?(ms|s)\b"), r"# -> # \1"),
    (re.compile(rf"{NUMBER}( ?)(ms|µs|us|ns|KiB|MiB|GiB|fps|frames a second)\b( \[[^\]]*\])?"), r"#\1\2"),
    (re.compile(rf"(\d (?:fail|warn|pass|n/a|cut)\b); {NUMBER} s(: .*)?$", re.MULTILINE), r"\1; # s"),
    (re.compile(rf"\b(took|takes|after|in|within) {NUMBER} (s|seconds)\b"), r"\1 # \2"),
    (re.compile(r"\b([Tt]idemark) \d+\.\d+\.\d+[-+.\w]*"), r"\1 VERSION"),
    (re.compile(r"127\.0\.0\.1:\d+"), "HOST"),
    (re.compile(r"token=[\w-]+"), "token=TOKEN"),
    (re.compile(r"\.part-[\w-]+"), ".part-ID"),
    (re.compile(r"\bversion=[0-9a-f]{8,}"), "version=ID"),  # of the fingerprint in a picture's metadata: another for each build
]
# The words of a text that are not prose: places and numbers, options, code in backticks, names with _ or an inner capital, files.
NOT_PROSE = re.compile(
    r"[\w./-]+:\d+(?::\d+)?|--[a-z][\w-]*|`[^`\n]+`|\b[a-z]+[A-Z]\w*|\b\w+_\w+|[\w/-]+\.(?:glsl|json|png|exr|wav|html|txt|mp4|tif)\b"
    rf"|{NUMBER}")


def days_around_now() -> str:
    today = datetime.datetime.now(datetime.timezone.utc).date()
    days = [today + datetime.timedelta(days=n) for n in (-1, 0, 1)]
    return "|".join(re.escape(day.strftime(form)) for day in days for form in ("%Y-%m-%d", "%Y:%m:%d"))


@dataclasses.dataclass
class Normal:
    """`mark`: "" compares everything, "~" hides numbers in text, "%" and "?" hide text; "?" also hides values of JSON."""
    folder: pathlib.Path
    wording: bool = False
    mark: str = ""

    def __post_init__(self) -> None:
        self.date = re.compile(rf"\b(?:{days_around_now()})(?:[T ]\d\d:\d\d(?::\d\d(?:\.\d+)?)?)?(?:Z|[+-]\d\d:?\d\d)?")

    def steady(self, text: str) -> str:
        """Returns the text without paths, dates and measured numbers."""
        text = text.replace("\r\n", "\n")
        for path in sorted({str(self.folder), str(self.folder.resolve())}, key=len, reverse=True):
            text = text.replace(path, "FOLDER")
        text = text.replace(str(self.folder.parent.parent), "SIDE")
        text = self.date.sub("DATE", text)
        for pattern, replacement in MEASURED:
            text = pattern.sub(replacement, text)
        return text

    def text(self, data: bytes, prose: bool = True) -> list[str]:
        """Returns the lines of a text. `prose`: the text holds sentences, which `wording` ignores."""
        text = self.steady(data.decode("utf-8", "backslashreplace"))
        if not text:
            return []
        if self.mark in ("%", "?"):
            return ["some text"]
        if self.mark == "~":
            text = re.sub(r"[ \t]+", " ", re.sub(NUMBER, "#", text))
        if self.wording and prose:
            return sorted(NOT_PROSE.findall(text))
        return text.split("\n")

    def output(self, data: bytes) -> list[str]:
        """Returns the lines of standard output or standard error: JSON as `path = value`, anything else as text."""
        found = parsed(data)
        return self.text(data) if found is None else self.json(found)

    def json(self, value) -> list[str]:
        if self.mark == "?":
            return sorted(set(shape(value, "")))
        return list(self.leaves(value, ""))

    def leaves(self, value, path: str):
        """Yields `path = value` for each value that is not made of others."""
        if isinstance(value, dict) and value:
            for key, inner in value.items():
                at = f"{path}.{self.steady(key)}" if path else self.steady(key)
                if MEASURED_KEY.search(key) or (self.mark == "%" and TIMED_KEY.search(key)):
                    yield f"{at} = #"
                else:
                    yield from self.leaves(inner, at)
        elif isinstance(value, list) and value:
            for number, inner in enumerate(value):
                yield from self.leaves(inner, f"{path}[{number}]")
        else:
            yield f"{path} = {self.leaf(value)}"

    def leaf(self, value) -> str:
        if not isinstance(value, str):
            return json.dumps(value)
        text = self.steady(value)
        if self.wording and " " in text:
            return "prose: " + " ".join(sorted(NOT_PROSE.findall(text)))
        return json.dumps(text, ensure_ascii=False)


def parsed(data: bytes):
    """Returns the JSON that a text is, whole or line by line; None if it is none."""
    stripped = data.strip()
    if not stripped.startswith((b"{", b"[")):
        return None
    try:
        return json.loads(stripped)
    except ValueError:
        pass
    try:
        return [json.loads(line) for line in stripped.splitlines() if line.strip()]
    except ValueError:
        # A report may be followed by a line of text on the same stream.
        try:
            value, end = json.JSONDecoder().raw_decode(stripped.decode())
            return [value, stripped.decode()[end:]]
        except ValueError:
            return None


def shape(value, path: str):
    """Yields the paths of keys. Items of a list share a path; those that are no objects have none."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield f"{path}.{key}"
            yield from shape(inner, f"{path}.{key}")
    elif isinstance(value, list):
        for inner in value:
            yield from shape(inner, path + "[]")
