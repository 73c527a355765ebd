"""Loads, rewrites and compiles (glslang, no driver) every project of a folder.

    python3 tests/peer/load_projects.py FOLDER [--program PROGRAM] [--jobs 2] [--json OUT]

FOLDER holds projects as ShaderToy's API gives them. Exit code 1 if the program crashed over one, or took more than
five seconds of the CPU."""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import re
import select
import subprocess
import sys

SECONDS = 5
HANGS = 60  # nobody waits longer


class Worker:
    """One process for many projects; after a crash or a hang another."""

    def __init__(self, program: str):
        self.program = program
        self.process = None

    def ask(self, path: pathlib.Path) -> dict:
        if self.process is None:
            self.process = subprocess.Popen([self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.process.stdin.write(f"{path}\n")
        self.process.stdin.flush()
        ready, _, _ = select.select([self.process.stdout], [], [], HANGS)
        line = self.process.stdout.readline() if ready else ""
        if line:
            return json.loads(line)
        self.end()
        return {"project": str(path), "stage": "crash" if ready else "hang", "message": "", "passes": 0, "promoted": 0,
                "milliseconds": [0, 0, 0 if ready else HANGS * 1000]}

    def end(self) -> None:
        if self.process:
            self.process.kill()
            self.process.communicate()
            self.process = None


def look_at(program: str, paths: list[pathlib.Path]) -> list[dict]:
    worker = Worker(program)
    found = [worker.ask(path) for path in paths]
    worker.end()
    return found


def reason(message: str) -> str:
    """A message without what is this project's alone."""
    message = re.sub(r"ERROR: \d+:\d+: |^[^:]*: (?=ERROR|specialised)|^.*\.json'?(:\d+)*:? ", "", message)
    return re.sub(r"'[^']*'", "'…'", re.sub(r"\d+", "N", message)).strip()[:90]


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--program", default="build/release/tidemark_load_projects")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    paths = sorted(options.folder.glob("*.json"))
    if not paths:
        sys.exit(f"there are no projects in {options.folder}")
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        parts = pool.map(look_at, [options.program] * options.jobs, [paths[i::options.jobs] for i in range(options.jobs)])
        results = [result for part in parts for result in part]
    if options.json:
        options.json.write_text("".join(json.dumps(result) + "\n" for result in results))

    times = sorted((sum(result["milliseconds"]), result["project"]) for result in results)
    stages = collections.Counter(result["stage"] or "whole" for result in results)
    print(", ".join(f"{count} {stage}" for stage, count in stages.most_common()))
    passes, promoted = (sum(result[key] for result in results) for key in ("passes", "promoted"))
    print(f"{passes} passes, {promoted} of them in double, too")
    print(f"{times[len(times) // 2][0]:.1f} ms in the median, at most:")
    for time, project in times[-3:]:
        print(f"  {time:.0f} ms  {project}")
    for stage in "load", "compile":
        reasons = collections.Counter(reason(result["message"]) for result in results if result["stage"] == stage)
        for text, count in reasons.most_common(25):
            print(f"{count:6} {stage}: {text}")
    bad = [result["project"] for result in results if result["stage"] in ("crash", "hang")]
    bad += [project for time, project in times if time > SECONDS * 1000 and project not in bad]
    for project in bad:
        print(f"BAD {project}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
