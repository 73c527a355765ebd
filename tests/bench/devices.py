"""What two devices draw differently in a folder of projects, and how much of it is explained: one row each, and sums.

    python3 tests/bench/devices.py FOLDER ROWS.json [--devices surfaceless,chromium] [--size 160x90] [--time 2] [--count N] [--program PATH]

ROWS.json is written after each project; those that it has are not drawn again. No text of a project is kept.
"""
import argparse
import collections
import json
import pathlib
import statistics
import subprocess
import time

VERDICTS = ("same", "within one level", "explained", "unexplained", "one side only", "neither", "no answer")
DIFFERENT = ("explained", "unexplained")


def row_of(path, options):
    begin = time.monotonic()
    command = [options.program, "compare", "--devices", options.devices, "--size", options.size, "--time", options.time, "--json", str(path)]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=options.limit)
        row = json.loads(run.stdout)["scenes"][0]
    except (subprocess.TimeoutExpired, ValueError) as error:
        row = {"verdict": "no answer", "why": str(error)[:200]}
    row["scene"] = path.name
    row["seconds"] = round(time.monotonic() - begin, 1)
    return row


def table_of(rows):
    lines = []
    counts = collections.Counter(row["verdict"] for row in rows)
    for verdict in VERDICTS:
        if counts[verdict]:
            lines.append(f"{counts[verdict]:4} {verdict}")
    causes = collections.Counter()
    for row in rows:
        if row["verdict"] == "explained":
            causes[" + ".join(sorted({cause["cause"] for cause in row["causes"]}))] += 1
    lines += [f"{count:4} explained by {cause}" for cause, count in causes.most_common()]
    met = sum(any(cause["reproduced"] for cause in row["causes"]) for row in rows if row["verdict"] == "explained")
    times = [row["seconds"] for row in rows if row["verdict"] in DIFFERENT]
    if times:
        lines.append(f"{met} of {counts['explained']} explanations draw what the other device draws")
        lines.append(f"seconds of a project that differs: median {statistics.median(times):.0f}, largest {max(times):.0f}")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("rows", type=pathlib.Path)
    parser.add_argument("--devices", default="surfaceless,chromium")
    parser.add_argument("--size", default="160x90")
    parser.add_argument("--time", default="2")
    parser.add_argument("--count", type=int)
    parser.add_argument("--limit", type=float, default=400)
    parser.add_argument("--program", default="build/release/tidemark")
    options = parser.parse_args()
    rows = json.loads(options.rows.read_text()) if options.rows.exists() else []
    known = {row["scene"] for row in rows}
    for path in sorted(options.folder.glob("*.json"))[:options.count]:
        if path.name not in known:
            rows.append(row_of(path, options))
            options.rows.write_text(json.dumps(rows, indent=1))
    print(table_of(rows))


if __name__ == "__main__":
    main()
