"""What each command prints, word for word: tests/transcripts/COMMAND.txt holds command lines and their output.

A file holds comments (#) and command lines ($, run by sh in a folder with the scenes of tests/freeze/scenes). After a
line stand its standard output (|), its standard error (!) and its exit code, unless that is 0. After "$~" the numbers
of the output are hidden, because they depend on the machine. With --write the files are written anew; --write NAME
writes that one.
"""
import contextlib
import difflib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "freeze")]
from normal import Normal  # noqa: E402
from support import option_table  # noqa: E402
from support.program import BUSY, PROGRAM, ROOT, TIME_LIMIT, environment, main  # noqa: E402

TRANSCRIPTS = ROOT / "tests" / "transcripts"
REWRITE = "PYTHONPATH=tests python3 tests/cli/transcripts_test.py --write"
# Output that depends on the machine and that Normal does not hide.
MACHINE = (
    (BUSY, ""),
    (re.compile(r"(\d\.\d s): \w+ \d+ %.*"), r"\1"),  # the shares of probes
    (re.compile(r"\bMesa [\d.]+[-+~\w]*"), "Mesa VERSION"),
    (re.compile(r"(llvmpipe) \([^)]*\)( on \S+,)?"), r"\1"),
)
# A number that does not belong to a name or a place.
NUMBER = re.compile(r"(?<![\w.:-])-?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?(?![\w:])")


def run(line: str, folder: pathlib.Path, hidden: str) -> list[str]:
    """Runs a command line and returns the lines of a transcript: the line, what it printed, its exit code."""
    path = f"{folder.parent / 'bin'}:{os.environ['PATH']}"
    process = subprocess.Popen(["sh", "-c", line], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, start_new_session=True,
                               env=environment(PATH=path, LC_ALL="C.UTF-8", TZ="UTC"))
    try:
        stdout, stderr = process.communicate(timeout=TIME_LIMIT)
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
    normal = Normal(folder)
    shown = [f"${hidden} {line}"]
    for sign, data in (("|", stdout), ("!", stderr)):
        text = data.decode()
        for pattern, replacement in MACHINE:
            text = pattern.sub(replacement, text)
        text = normal.steady(text)
        if hidden:
            text = re.sub(r"(?<=\S)  +", "  ", NUMBER.sub("#", text))
        lines = text.split("\n")
        shown += [f"{sign} {printed}".rstrip() for printed in (lines if lines[-1] else lines[:-1])]
    return shown + ([f"exit {process.returncode}"] if process.returncode else [])


def commands() -> set[str]:
    return {command.split()[0] for command in option_table.commands()}


def written_anew(transcript: str) -> str:
    """Runs the command lines of a transcript in an empty folder and returns it with what they print now."""
    shown = []
    with tempfile.TemporaryDirectory(prefix="tidemark-test-") as base:
        folder = pathlib.Path(base) / "folder"
        shutil.copytree(ROOT / "tests" / "freeze" / "scenes", folder)
        (folder.parent / "bin").mkdir()
        (folder.parent / "bin" / "tidemark").symlink_to(pathlib.Path(PROGRAM).resolve())
        for line in transcript.splitlines():
            if command := re.match(r"\$(~?) (.*)", line):
                shown += ["", *run(command[2], folder, command[1])]
            elif line.startswith("#"):
                shown += [line]
    return "\n".join(shown) + "\n"


class Transcripts(unittest.TestCase):
    def setUp(self) -> None:
        listed = subprocess.run([PROGRAM, "inspect", "--devices"], capture_output=True, env=environment(), check=True)
        if b"llvmpipe" not in listed.stdout:
            self.skipTest("the transcripts were drawn by llvmpipe")

    def test_commands_print_what_their_transcripts_show(self) -> None:
        for path in sorted(TRANSCRIPTS.glob("*.txt")):
            if path.stem in ("view", "serve", "tidemark") and not {"view", "serve"} <= commands():
                continue  # a build without a window
            with self.subTest(path.stem):
                before = path.read_text()
                now = written_anew(before)
                self.assertGreater(before.count("\n$"), 1)
                if now != before:
                    name = str(path.relative_to(ROOT))
                    diff = difflib.unified_diff(before.splitlines(), now.splitlines(), name, "now", lineterm="", n=2)
                    self.fail("\n".join(["the command prints something else:", *diff,
                                         f"if that is intended: {REWRITE} {path.stem}"]))

    def test_every_command_has_a_transcript(self) -> None:
        self.assertLessEqual(commands(), {path.stem for path in TRANSCRIPTS.glob("*.txt")})


if __name__ == "__main__":
    if sys.argv[1:2] == ["--write"]:
        for transcript in [TRANSCRIPTS / f"{name}.txt" for name in sys.argv[2:]] or sorted(TRANSCRIPTS.glob("*.txt")):
            transcript.write_text(written_anew(transcript.read_text()))
    else:
        main()
