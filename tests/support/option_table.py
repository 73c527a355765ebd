"""The tables of options in the pages, made from what --help prints. Run it to write them anew."""
from __future__ import annotations

import functools
import pathlib
import re
import subprocess

from support.program import BAKE, PROGRAM, ROOT, environment

MANUAL = ROOT / "runner" / "cli" / "manual"
PAGES = [*(MANUAL / f"{page}.md" for page in ("options", "check_and_study", "tune", "simplify")),
         ROOT / "shaders" / "README.md"]
# `<!-- options: check study -->`: those of these commands, less the rows that an earlier page has.
BLOCK = re.compile(r"(<!-- options: ([a-z_ ,]+) -->\n)(.*?)(<!-- end of options -->\n)", re.DOTALL)
BAKE_NAME = "tidemark_bake"  # the program of shaders/bake, which has no commands
WIDTH = 30  # of the column of names in CLI11's help, in bytes


@functools.cache
def printed_help(command: str) -> str:
    words = [BAKE] if command == BAKE_NAME else [PROGRAM, *command.split()]
    return subprocess.run([*words, "--help"], check=True, capture_output=True, text=True,
                          env=environment()).stdout


def commands(command: str = "") -> list[str]:
    """Every command that does something, `bake noise` and its like included."""
    listed = printed_help(command).partition("\nSubcommands:\n")[2].partition("\n\n")[0]
    names = re.findall(r"^  (\S+)", listed, re.MULTILINE)
    return [inner for name in names for inner in commands(f"{command} {name}".strip())] or [command]


def commands_and_bake() -> list[str]:
    return [*commands(), BAKE_NAME]


@functools.cache
def options_of(command: str) -> list[tuple[str, str]]:
    """(`--size WxH=640x360`, what it means), as help lists them."""
    lines = printed_help(command).splitlines()
    found = []
    for line, following in zip(lines, [*lines[1:], ""]):
        if not line.startswith("  -") or line.startswith("  -h,"):
            continue
        if following.startswith(" " * WIDTH):
            head, meaning = line, following
        else:
            head, meaning = line.encode()[:WIDTH].decode(), line.encode()[WIDTH:].decode()
        found.append((re.sub(r" (Needs|Excludes): .*| \.\.\.$", "", head.strip()), meaning.strip()))
    return found


def names_of(head: str) -> list[str]:
    return head.split(" ")[0].split(",")


def table(users: list[str], known: set[tuple[str, str]]) -> str:
    """Adds its rows to `known`, and leaves out what is there."""
    options = {command: options_of(command) for command in commands_and_bake()}
    rows = {option for command in users for option in options[command]} - known
    known.update(rows)
    lines = ["| option | of | meaning |", "|---|---|---|"]
    for head, meaning in sorted(rows, key=lambda row: (row[0].lstrip("-").lower(), row)):
        of = ", ".join(command for command in options if (head, meaning) in options[command])
        cells = (f"`{head}`", of, meaning)
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def written_anew() -> dict[pathlib.Path, str]:
    """Each page as it should be."""
    known: set[tuple[str, str]] = set()
    return {page: BLOCK.sub(lambda block: block[1] + table(block[2].split(", "), known) + block[4], page.read_text())
            for page in PAGES}


if __name__ == "__main__":
    for page, text in written_anew().items():
        page.write_text(text)
