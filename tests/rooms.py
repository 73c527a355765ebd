#!/usr/bin/env python3
"""Draws the map of the rooms of runner/ from the #include lines: `python3 tests/rooms.py > runner/rooms.svg`."""
import collections
import pathlib
import re
import sys

RUNNER = pathlib.Path(__file__).parent.parent / "runner"
INCLUDE = re.compile(r'^\s*#\s*include\s+"([a-z_]+)/', re.MULTILINE)
WIDTH, HEIGHT, GAP, STEP = 116, 46, 24, 84  # of a box, between two boxes, from row to row
MARGIN = 12
# Column and row of each box, from the top left, so that no arrow crosses a box.
PLACES = {
    "cli": (1, 0), "web": (0, 1), "window": (1, 1), "editor": (2, 1), "host": (0.5, 2), "lab": (0.5, 3), "proof": (0, 4),
    "render": (1, 4), "media": (1, 5), "shader": (2, 5), "scene": (2, 6), "base": (0.6, 7),
}


def survey():
    """Lines of C++ of each room, and the number of includes by (room, included room)."""
    lines, arrows = collections.Counter(), collections.Counter()
    for source in sorted(RUNNER.glob("*/**/*.[ch]pp")):
        room, text = source.relative_to(RUNNER).parts[0], source.read_text()
        lines[room] += text.count("\n")
        arrows.update((room, other) for other in INCLUDE.findall(text) if other != room)
    return lines, arrows


def without_shortcuts(arrows):
    """The arrows that no longer path replaces."""
    below = collections.defaultdict(set)
    for room, other in arrows:
        below[room].add(other)

    def reaches(room, other):
        return any(each == other or reaches(each, other) for each in below[room])

    return sorted((room, other) for room, other in arrows
                  if not any(each != other and reaches(each, other) for each in below[room]))


def svg():
    lines, arrows = survey()
    columns, rows = max(x for x, _ in PLACES.values()), max(y for _, y in PLACES.values())
    width, height = columns * (WIDTH + GAP) + WIDTH + 2 * MARGIN, rows * STEP + HEIGHT + 2 * MARGIN
    centre = {room: (MARGIN + WIDTH / 2 + PLACES[room][0] * (WIDTH + GAP), MARGIN + HEIGHT / 2 + PLACES[room][1] * STEP)
              for room in lines}
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
             'font-family="sans-serif" font-size="13" text-anchor="middle">',
             '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
             '<path d="M0 0 8 4 0 8z" fill="#567"/></marker></defs>',
             f'<rect width="{width}" height="{height}" fill="#fff"/>']
    for room, other in without_shortcuts(arrows):
        (x, y), (to_x, to_y) = centre[room], centre[other]
        parts.append(f'<line x1="{x:g}" y1="{y + HEIGHT / 2:g}" x2="{to_x:g}" y2="{to_y - HEIGHT / 2:g}" stroke="#567" '
                     'stroke-width="1.3" marker-end="url(#tip)"/>')
    for room, (x, y) in sorted(centre.items()):
        parts.append(f'<rect x="{x - WIDTH / 2:g}" y="{y - HEIGHT / 2:g}" width="{WIDTH}" height="{HEIGHT}" rx="6" '
                     'fill="#e8f0f6" stroke="#567"/>'
                     f'<text x="{x:g}" y="{y - 2:g}" font-weight="bold">{room}</text>'
                     f'<text x="{x:g}" y="{y + 15:g}" fill="#456" font-size="11">{lines[room] / 1000:.0f} k lines</text>')
    return "\n".join([*parts, "</svg>", ""])


if __name__ == "__main__":
    sys.stdout.write(svg())
