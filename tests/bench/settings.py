"""What `tune` and `study` answer for a folder of shaders that nobody prepared: one row each, and how many answers there are.

    python3 tests/bench/settings.py FOLDER [--count 40] [--seed 1] [--budget 45] [--study] [--program PATH] [-o rows.json]

A chosen setting is measured again by a study of its own: its CPU time against that of the unchanged scene, interleaved,
and its error at five moments that `tune` did not draw, against the reference that `tune` named (or the scene as it is).
"""
import argparse
import json
import pathlib
import re
import shutil
import statistics
import subprocess
import tempfile
import time

from random_projects import random_projects

UNSEEN = (0.4, 2.3, 5.7, 8.1, 17.9)
LIMIT = 10 ** (-40 / 20)  # psnr=40dB
MARCH = re.compile(r"\b(\w+)\s*\+=\s*[^;]*;")
LOOP = re.compile(r"\b(?:for|while)\s*\(")


def is_marcher(text):
    """A loop that calls a function of the text at a place along a ray, and advances along it by what it returned."""
    functions = set(re.findall(r"\b(?:float|vec2|vec3|vec4)\s+(\w+)\s*\([^)]*\)\s*\{", text))
    for loop in LOOP.finditer(text):
        body = text[loop.end():loop.end() + 700]
        answers = {name for name, function in re.findall(r"(\w+)\s*=\s*(?:[\w.]+\s*\*\s*)?(\w+)\s*\(", body) if function in functions}
        for step in MARCH.finditer(body):
            name, words = re.escape(step.group(1)), set(re.findall(r"\w+", step.group(0)))
            along = rf"\+\s*(?:\w+\s*\*\s*{name}\b|{name}\s*\*\s*\w+)|(?:{'|'.join(map(re.escape, functions)) or '-'})\s*\(\s*{name}\b"
            if words & answers and re.search(along, body):
                return True
    return False


def drawn(folder, count, seed):
    chosen = [path for path in random_projects(folder, seed) if is_marcher(path.read_text(errors="replace").replace("\\n", "\n"))]
    return chosen[:count]


def run(program, *arguments, limit=240):
    start = time.monotonic()
    try:
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, limit
    return done, time.monotonic() - start


def last_line(done):
    lines = [line for line in done.stderr.splitlines() if line.startswith("tidemark: error:")]
    return (lines or done.stderr.splitlines() or [""])[-1][:200]


def answer_of(done):
    if done is None:
        return "time out", ""
    if done.returncode == 0:
        found = json.loads(done.stdout)
        if found["chosen"]:
            return "chosen", ", ".join(f"{name} = {value}" for name, value in found["chosen"].items())
        why = next((line for line in found["sentences"] if line.startswith(("no measured", "cannot tell"))), "")
        return ("undecided" if why.startswith("cannot tell") else "nothing better"), why
    return f"no result ({done.returncode})", last_line(done)


def settings_in(method):
    """The reference's settings, from the sentence that names them."""
    named = re.match(r"the scene itself with (.*?), (?:in single|promoted)", method)
    return dict(re.findall(r"([\w.:\-]+) = ([^,\s]+)", named.group(1))) if named else {}


def again(program, scene, found, folder):
    """The chosen setting measured anew: time ratio and the errors at unseen moments."""
    reference = settings_in(found["study"]["references"]["picture"]["method"])
    as_it_is = not reference
    plan = {"views": [{"name": f"t={at}", "time": at} for at in UNSEEN],
            "series": [{"name": "chosen", "set": found["chosen"]}], "reference": reference or found["chosen"]}
    file = folder / "again.json"
    file.write_text(json.dumps(plan))
    done, _ = run(program, "study", scene, "--study", file, "--json", "--budget", 20, "-o", folder / "again")
    if done is None or done.returncode != 0:
        return {"again": last_line(done) if done else "time out"}
    study = json.loads(done.stdout)
    own, chosen = study["points"][0], study["points"][1]
    row = {"ratio": own["all"]["cpu_ms"]["median"] / chosen["all"]["cpu_ms"]["median"]}
    if as_it_is:  # the reference is the chosen setting, so the unchanged scene's error is the distance between the two
        chosen = own
    row["errors"] = [view["picture"]["rmse"] for view in chosen["views"].values()]
    return row


def tuned(program, path, budget):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scene = folder / path.name
        shutil.copy(path, scene)
        done, seconds = run(program, "tune", scene, "--max-error", "psnr=40dB", "--budget", budget, "--json", "-o", folder / "report")
        answer, why = answer_of(done)
        row = {"scene": path.name, "answer": answer, "why": why, "seconds": round(seconds, 1)}
        if answer == "chosen":
            edited = scene.with_suffix("") if scene.suffix == ".json" else scene
            row |= again(program, edited, json.loads(done.stdout), folder)
        return row


def studied(program, path, budget):
    with tempfile.TemporaryDirectory() as name:
        done, seconds = run(program, "study", path, "--budget", budget, "--size", "160x90", "--json", "-o", pathlib.Path(name) / "report")
        if done is None or done.returncode != 0:
            return {"scene": path.name, "answer": "none", "why": last_line(done) if done else "time out", "seconds": round(seconds, 1)}
        verdict = json.loads(done.stdout)["verdict"]
        useful = [line for line in verdict if line.startswith(("cheapest setting", "at equal error", "no tested setting", "no setting of this study"))
                  or "changes nothing here" in line]
        return {"scene": path.name, "answer": "verdict" if useful else "none", "why": (useful or verdict or [""])[0], "seconds": round(seconds, 1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder")
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--budget", type=float, default=45)
    parser.add_argument("--study", action="store_true", help="asks study for its own choice of knobs instead of tune")
    parser.add_argument("--program", default="build/release/tidemark")
    parser.add_argument("-o", "--output")
    options = parser.parse_args()
    ask = studied if options.study else tuned
    rows = []
    for path in drawn(options.folder, options.count, options.seed):
        rows.append(ask(options.program, path, options.budget))
        print(json.dumps(rows[-1]), flush=True)
        if options.output:
            pathlib.Path(options.output).write_text(json.dumps(rows, indent=1) + "\n")
    counts = {answer: sum(row["answer"] == answer for row in rows) for answer in sorted({row["answer"] for row in rows})}
    slower = [row["scene"] for row in rows if row.get("ratio", 1) < 0.99]
    outside = [row["scene"] for row in rows if any(error is None or error > LIMIT for error in row.get("errors", []))]
    print(f"{len(rows)} scenes: {counts}; median {statistics.median(row['seconds'] for row in rows):.1f} s; "
          f"slower when timed again: {slower}; outside the error at unseen moments: {outside}")


if __name__ == "__main__":
    main()
