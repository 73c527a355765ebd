"""Runs the groups of commands.txt, and the help of every command and topic."""
from __future__ import annotations

import pathlib
import re
import shlex
import shutil

from contents import snapshot, written
from items import Item, Seen
from normal import Normal
from sides import ROOT, Side

HERE = pathlib.Path(__file__).resolve().parent
MARKS = "~%?"


def groups() -> dict[str, list[str]]:
    """Returns the lines of commands.txt by the name of their group. An empty line inside a group runs the bare program."""
    found: dict[str, list[str]] = {}
    for line in (HERE / "commands.txt").read_text().splitlines():
        if line.startswith("["):
            found[line.strip("[]")] = lines = []
        elif found and not line.startswith("#"):
            lines.append(line)
    for lines in found.values():
        while lines and not lines[-1]:
            lines.pop()
    return found


def look_at(side: Side, group: str, lines: list[str], wording: bool) -> Seen:
    folder = side.fresh_folder("commands " + group)
    shutil.copytree(HERE / "scenes", folder, dirs_exist_ok=True)
    seen: Seen = {}
    number = 0
    for line in lines:
        if line.startswith("use "):
            shutil.copytree(ROOT / line[4:], folder / line[4:], ignore=shutil.ignore_patterns("*.jpg", "*.study.png"))
            continue
        if line.startswith("make "):
            (folder / line[5:]).mkdir()
            continue
        number += 1
        mark = line[0] if line[:1] in tuple(MARKS) else ""
        words = shlex.split(line.removeprefix(mark))
        normal = Normal(folder, wording, mark)
        before = snapshot(folder)
        done = side.run(words, folder)
        label = f"{number} `tidemark {' '.join(words)}`"
        seen[f"{label}: exit code"] = [done.code]
        seen[f"{label}: standard output"] = normal.output(done.stdout)
        seen[f"{label}: standard error"] = normal.output(done.stderr)
        seen |= {f"{label}: {name}": content for name, content in written(folder, before, normal).items()}
    shutil.rmtree(folder)
    return seen


def heads_of_options(text: str) -> list[str]:
    """Returns the options, commands and positionals of a --help text, without what is said about them."""
    return [re.split(r"\s{2,}", line.strip())[0] for line in text.splitlines() if re.match(r"  \S", line)]


def look_at_help(side: Side, wording: bool) -> Seen:
    """Compares `COMMAND --help` of every command, and `help TOPIC` of every topic. `wording`: of topics only that they print."""
    folder = side.fresh_folder("help")
    normal = Normal(folder)
    seen: Seen = {}

    def run(*words: str):
        done = side.run(list(words), folder)
        label = f"`tidemark {' '.join(words)}`"
        seen[f"{label}: exit code"] = [done.code]
        text = done.stdout.decode()
        if words[-1] == "--help" and wording:
            seen[f"{label}: options"] = heads_of_options(text)
        elif not wording:
            seen[f"{label}: standard output"] = normal.text(done.stdout)
            seen[f"{label}: standard error"] = normal.text(done.stderr)
        return text

    listed = run("--help").partition("Subcommands:\n")[2].partition("\n\n")[0]
    for command in re.findall(r"^  (\w+)", listed, re.MULTILINE):
        run(command, "--help")
        if command == "bake":
            run("bake", "noise", "--help")
    topics = run("help").splitlines()[1:]
    for topic in [] if wording else topics:
        if topic.strip():
            run("help", topic.strip())
    return seen


def items(wording: bool):
    yield Item("commands", "help", lambda side: look_at_help(side, wording))
    for group, lines in groups().items():
        if wording and group in ("manual", "completion"):  # their text is that of --help and of the pages
            lines = [line for line in lines if not re.match(r"help|completion( (bash|zsh|fish))?$", line)]
        yield Item("commands", group, lambda side, group=group, lines=lines: look_at(side, group, lines, wording))
