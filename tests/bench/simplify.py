"""Whether `simplify` gains and keeps its word on shaders that it has never seen.

    simplify.py PROGRAM FOLDER [--count N] [--seed S] [--budget S] [--keep FILE]

FOLDER holds shaders (.glsl, .frag, ShaderToy's .json), of which N are drawn at random. Each is simplified in a copy of
its own; then both texts are captured at twenty moments that the search did not use, and every picture must keep the
allowed FLIP. Prints one line for each shader and the sums. Scenes that do not load are skipped.
"""
import argparse
import json
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

from random_projects import random_projects

MOST_FLIP = 0.01
MOMENTS = 20


def run(command, folder, limit):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=limit, check=False)


def captured(program, scene, moment, name, folder):
    done = run([program, "capture", scene, "--size", "160x90", "--time", f"{moment:.4f}", "-o", name], folder, 120)
    return done.returncode == 0


def worst_flip(program, own, cut, moments, folder):
    """The largest FLIP between the two scenes, and its moment; None if a picture cannot be drawn."""
    worst = (0.0, 0.0)
    for moment in moments:
        if not captured(program, own, moment, "own.png", folder) or not captured(program, cut, moment, "cut.png", folder):
            return None
        done = run([program, "compare", "own.png", "cut.png", "--json"], folder, 60)
        worst = max(worst, (json.loads(done.stdout)["frames"][0]["flip"], moment))
    return worst


def contents(scene):
    """The bytes of a scene's file, or of all files of its folder."""
    return [file.read_bytes() for file in sorted(scene.rglob("*")) if file.is_file()] if scene.is_dir() \
        else scene.read_bytes()


def simplified(program, source, budget, lot):
    """What became of one shader: a dictionary, or None if it does not load."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shutil.copy(source, folder / source.name)
        scene = source.name
        if source.suffix == ".json":
            if run([program, "import", scene, "-o", "own"], folder, 60).returncode != 0:
                return None
            scene = "own"
        if not captured(program, scene, 1, "own.png", folder):
            return None
        before = folder / ("before" if source.suffix == ".json" else "before" + source.suffix)
        (shutil.copytree if (folder / scene).is_dir() else shutil.copy)(folder / scene, before)
        start = time.perf_counter()
        done = run([program, "simplify", scene, "--json", "--write", "--max-error", f"flip={MOST_FLIP}",
                    "--budget", str(budget)], folder, 20 * budget + 300)
        row = {"shader": source.name, "seconds": time.perf_counter() - start, "code": done.returncode}
        if done.returncode != 0:
            return row | {"said": done.stderr.strip()[-200:]}
        gain = re.search(r"chosen: .*?: ([\d.]+) x", done.stderr)
        row["gain"] = float(gain[1]) if gain else 1.0
        if gain:
            row["written"] = contents(folder / before.name) != contents(folder / scene)
            moments = sorted(lot.uniform(0, 120) for _ in range(MOMENTS))
            row["worst"] = worst_flip(program, before.name, scene, moments, folder)
        return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--budget", type=float, default=60)
    parser.add_argument("--keep", type=pathlib.Path, help="writes the rows as JSON")
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    lot = random.Random(options.seed)
    rows = []
    for source in random_projects(options.folder, lot):
        if len(rows) == options.count:
            break
        row = simplified(program, source, options.budget, lot)
        if row is None:
            continue
        rows.append(row)
        print(json.dumps(row), flush=True)
    gains = sorted(row["gain"] for row in rows if row.get("gain", 1) > 1)
    wrong = [row for row in rows if "worst" in row and (row["worst"] is None or row["worst"][0] > MOST_FLIP)]
    wrong += [row for row in rows if not row.get("written", True)]  # the twenty pictures would be of one text
    late = [row for row in rows if row["seconds"] > 1.5 * options.budget]
    print(f"{len(rows)} shaders: {len(gains)} gain ({', '.join(f'{gain:.2f}' for gain in gains)} x), {len(wrong)} wrong at "
          f"one of {MOMENTS} unseen moments, {len(late)} over 1.5 times the budget, "
          f"{sum(row['code'] != 0 for row in rows)} refused")
    if options.keep:
        options.keep.write_text(json.dumps(rows, indent=1) + "\n")
    return 1 if wrong or late else 0


if __name__ == "__main__":
    sys.exit(main())
