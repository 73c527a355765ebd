"""What is compared is an item: a name, and a function that runs one side and returns what it saw."""
from __future__ import annotations

import dataclasses
import difflib
import typing

from sides import TIMED_OUT, Side

Seen = dict  # of a label, as "2 check foam.glsl: stdout", to lines
LONGEST_DIFFERENCE = 24  # lines shown of one label


@dataclasses.dataclass
class Item:
    group: str  # pictures, commands or pages
    name: str
    look: typing.Callable[[Side], Seen]


@dataclasses.dataclass
class Verdict:
    item: Item
    differences: list[str]
    notes: list[str]
    looked_at: int


def clipped(old: str, new: str) -> tuple[str, str]:
    """Returns both lines, cut around the first place where they differ."""
    if max(len(old), len(new)) <= 200:
        return old, new
    at = next((i for i, (a, b) in enumerate(zip(old, new)) if a != b), min(len(old), len(new)))
    start = max(0, at - 60)
    return tuple(("…" if start else "") + line[start:at + 100] + ("…" if at + 100 < len(line) else "") for line in (old, new))


def shown(old: list[str], new: list[str]) -> list[str]:
    """Returns the lines that differ, each with the sign of its side."""
    lines: list[str] = []
    matcher = difflib.SequenceMatcher(None, old, new, autojunk=False) if len(old) * len(new) < 4_000_000 else None
    blocks = matcher.get_opcodes() if matcher else [("replace", 0, len(old), 0, len(new))]
    for what, a, b, c, d in blocks:
        if what == "equal":
            continue
        pairs = [clipped(x, y) for x, y in zip(old[a:b], new[c:d])]
        lines += [f"- {x}" for x, _ in pairs] + [f"- {x[:200]}" for x in old[a + len(pairs):b]]
        lines += [f"+ {y}" for _, y in pairs] + [f"+ {y[:200]}" for y in new[c + len(pairs):d]]
    more = len(lines) - LONGEST_DIFFERENCE
    return lines[:LONGEST_DIFFERENCE] + ([f"… {more} more lines"] if more > 0 else [])


def judge(item: Item, old: Side, new: Side) -> Verdict:
    """Runs both sides. Where they differ the old one runs once more: what it does not repeat itself is a note, no difference."""
    before, after = item.look(old), item.look(new)
    labels = list(dict.fromkeys([*before, *after]))
    different = [label for label in labels if before.get(label) != after.get(label)]
    differences, notes = [], []
    again = item.look(old) if different else before
    for label in different:
        if before.get(label) != again.get(label):
            notes.append(f"{label}: not compared, two runs of the old program differ")
            continue
        a, b = before.get(label), after.get(label)
        if a is None or b is None:
            differences.append(f"{label}: only the {'new' if a is None else 'old'} program has it")
        else:
            differences += [f"{label}:", *("    " + line for line in shown(a, b))]
    for label in labels:
        if before.get(label) == [TIMED_OUT] == after.get(label):
            notes.append(f"{label}: not compared, both programs ran out of time")
    return Verdict(item, differences, notes, len(labels))
