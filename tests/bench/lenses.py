"""Whether lenses are right on a folder of shaders that nobody prepared: one row each, and sums.

    python3 tests/bench/lenses.py FOLDER [--count 60] [--seed 1] [--what all,bytes,steps,error,value,tiles] [--program PATH]
        [--timed PATH] [-o rows.json]

all: each lens draws or refuses with a reason. steps: against a copy with a counter in its loop. error: against two captures. value:
against `trace` in random pixels of a random assignment. tiles: rank correlation of `cost` and of `clocks` with CPU time, per tile of
32x32 pixels.
"""
import argparse
import json
import pathlib
import random
import re
import statistics
import subprocess
import tempfile

from hot_lines import closing, load, without_comments
from random_projects import random_projects

SIZE, WIDTH, HEIGHT = "64x36", 64, 36
LENSES = ("cost", "steps", "error", "rounding", "proof", "clocks")
ASSIGNMENT = re.compile(r"^\s*(?:(?:float|vec[234])\s+)?([A-Za-z_]\w*)\s*[-+*/]?=[^=]")
MAIN = re.compile(r"\bvoid\s+mainImage\s*\(\s*(?:out|inout)\s+(?:\w+\s+)?vec4\s+(\w+)\s*,\s*(?:in\s+)?(?:\w+\s+)?vec2\s+(\w+)\s*\)")


def ranks(values):
    order = sorted(range(len(values)), key=values.__getitem__)
    result = [0.0] * len(values)
    at = 0
    while at < len(order):
        end = at
        while end + 1 < len(order) and values[order[end + 1]] == values[order[at]]:
            end += 1
        for i in range(at, end + 1):
            result[order[i]] = (at + end) / 2
        at = end + 1
    return result


def correlation(a, b):
    a, b = ranks(a), ranks(b)
    mean_a, mean_b = statistics.mean(a), statistics.mean(b)
    above = sum((x - mean_a) * (y - mean_b) for x, y in zip(a, b))
    below = (sum((x - mean_a) ** 2 for x in a) * sum((y - mean_b) ** 2 for y in b)) ** 0.5
    return above / below if below else 0.0


class Project:
    def __init__(self, path, folder, options):
        self.path, self.folder, self.options = path, folder, options
        self.whole, self.passes = load(path)
        self.image = next((each for each in self.passes if each.get("type") == "image"), self.passes[0])
        self.scene = folder / f"{path.stem}.json"
        self.scene.write_text(json.dumps(self.whole))

    def run(self, *arguments, limit=300):
        try:
            return subprocess.run([self.options.program, *map(str, arguments)], capture_output=True, text=True, timeout=limit, cwd=self.folder)
        except subprocess.TimeoutExpired:
            return None

    def lens(self, name, scene=None, size=SIZE, seconds=1):
        """The report of the lens, or why there is none."""
        done = self.run("capture", scene or self.scene, "--size", size, "--time", seconds, "--lens", name, "-o", "lens.png", "--json")
        if done is None:
            return None, "time"
        if done.returncode != 0:
            lines = [line for line in done.stderr.splitlines() if "error" in line]
            return None, f"{done.returncode}: {(lines or [done.stderr])[-1][:160]}"
        return json.loads(done.stdout)["frames"][0]["lens"], ""

    def steps(self):
        """Pixels whose steps equal those of a copy that counts the first entry of the loop; None: no single march."""
        report, _ = self.lens("steps")
        place = report and re.search(r"iterations of the march at (\S+):(\d+)$", report["title"])
        if not place:
            return None
        code = without_comments(self.image["code"])
        begin = sum(len(line) + 1 for line in code.split("\n")[:int(place[2]) - 1])
        loops = [match for match in re.finditer(r"\b(for|while)\s*\(", code) if match.start() <= begin + 200]
        for loop in reversed(loops):
            head = closing(code, loop.end() - 1)
            body = head + len(code[head:]) - len(code[head:].lstrip())
            if code[body] != "{":
                continue
            end = closing(code, body)
            if not loop.start() <= begin + len(code[begin:]) - len(code[begin:].lstrip()) < end:
                continue
            main = MAIN.search(code)
            if not main:
                return None
            text = (code[:loop.start()] + "{ ++entries_; " + code[loop.start():body + 1] + " if (entries_ == 1) ++count_; " +
                    code[body + 1:end] + " }" + code[end:])
            text = "int entries_ = 0; int count_ = 0;\n" + re.sub(r"\bmainImage\b", "ownImage", text)
            text += "\nvoid mainImage(out vec4 c, in vec2 p) { vec4 own = vec4(0.0); ownImage(own, p); c = vec4(float(count_), 0.0, 0.0, 1.0) + 1e-30 * own.x; }\n"
            before, self.image["code"] = self.image["code"], text
            copy = self.folder / f"{self.path.stem}_steps.json"
            copy.write_text(json.dumps(self.whole))
            self.image["code"] = before
            counted, why = self.lens("value:" + str(text.count("\n")) + ":c.x", copy)
            if not counted:
                return {"equal": 0, "of": 0, "why": why}
            pairs = [(a, b) for a, b in zip(report["values"], counted["values"]) if a is not None]
            return {"equal": sum(a == b for a, b in pairs), "of": len(pairs)}
        return None

    def error(self):
        report, why = self.lens("error")
        if not report:
            return {"why": why}
        for precision in ("single", "double"):
            done = self.run("capture", self.scene, "--size", SIZE, "--time", 1, "--precision", precision, "--depth", "16", "-o",
                            f"{precision}.png")
            if done is None or done.returncode != 0:
                return {"why": precision}
        done = self.run("compare", "double.png", "single.png", "--json")  # colours as shown, 0 to 1, as the lens takes them
        largest = json.loads(done.stdout)["frames"][0].get("largest")
        return {"lens": report["max"] and report["max"] / 255, "compared": largest, "nan": report["nan"]}

    def value(self, chance, pixels):
        """Values of the lens and of `trace` in random pixels of a random assignment that the pixels reach."""
        lines = without_comments(self.image["code"]).split("\n")
        found = [(i + 1, match[1]) for i, line in enumerate(lines) if (match := ASSIGNMENT.match(line))]
        chance.shuffle(found)
        refused = []
        for line, name in found[:4]:
            report, why = self.lens(f"value:{line}:{name}")
            if not report:
                refused.append({"line": line, "text": lines[line - 1].strip(), "why": why})
                continue
            size = len(report["values"]) // (WIDTH * HEIGHT)
            rows = []
            for _ in range(4 * pixels):
                x, y = chance.randrange(WIDTH), chance.randrange(HEIGHT)
                shown = report["values"][size * (y * WIDTH + x):size * (y * WIDTH + x + 1)]
                if shown[0] is None or len(rows) >= pixels:
                    continue
                row = self.traced(line, name, (x, y), shown)
                if row:
                    rows.append(row)
            if rows:
                return {"line": line, "name": name, "pixels": rows, "refused": refused}
        return {"pixels": [], "refused": refused}

    def traced(self, line, name, pixel, shown):
        """The last value that `trace` has, beside that of the lens. None: `trace` has none of that size, as of a statement of several lines,
        whose parts it shows at their own lines."""
        done = self.run("trace", self.scene, "--size", SIZE, "--time", 1, "--pixel", f"{pixel[0]},{pixel[1]}", "--line", line, "--json")
        if done is None or done.returncode != 0:
            return None
        report = json.loads(done.stdout)
        values = [value for call in report["calls"] for value in call["values"]
                  if value["name"] == name and min(value["rows"], 3) == len(shown)]
        if not values:
            return None
        last = values[-1]
        same = all(isinstance(b, str) if a is None else not isinstance(b, str) and abs(a - b) <= 1e-3 * max(1e-3, abs(b))
                   for a, b in zip(shown, last["float"]))
        notes = [words for words, true in (("few right digits", last["digits"] < 3), ("unstable", last["unstable"]),
                                           ("textures at base level", report["colour"]["textures_at_base_level"]),
                                           ("not as drawn", not report["colour"]["as_drawn"]), (report["end"], report["end"] != "complete"))
                 if true]
        return {"pixel": pixel, "lens": shown, "trace": last["float"], "same": same, "trace says": notes}

    def timed_tiles(self, size):
        done = subprocess.run([self.options.timed, "--size", size, "--time", "1", "--rounds", "7", "--tiles", "32", str(self.scene)],
                              capture_output=True, text=True, timeout=600)
        return json.loads(done.stdout.splitlines()[0]).get("tiles") if done.stdout else None

    def tiles(self):
        """again: correlation of two timings, the most that a count can reach. grouped: of the cost if 4x2 pixels take as long as the
        most expensive of them, as on llvmpipe with 256 bits."""
        size = "320x160"
        first, second = self.timed_tiles(size), self.timed_tiles(size)
        report, why = self.lens("cost", size=size)
        clocks, _ = self.lens("clocks", size=size)
        if not first or not second or not report:
            return {"why": why or "not drawn again"}
        values, costs, grouped, cycles = report["values"], [], [], []
        for y in range(5):
            for x in range(10):
                rows = [values[320 * (32 * y + j) + 32 * x:320 * (32 * y + j) + 32 * x + 32] for j in range(32)]
                costs.append(sum(map(sum, rows)))
                if clocks:
                    cycles.append(sum(sum(clocks["values"][320 * (32 * y + j) + 32 * x:320 * (32 * y + j) + 32 * x + 32]) for j in range(32)))
                grouped.append(sum(8 * max(rows[j][i:i + 4] + rows[j + 1][i:i + 4]) for j in range(0, 32, 2) for i in range(0, 32, 4)))
        times = [(a + b) / 2 for a, b in zip(first, second)]
        return {"correlation": correlation(costs, times), "clocks": correlation(cycles, times) if cycles else None,
                "grouped": correlation(grouped, times), "again": correlation(first, second),
                "spread": max(times) / max(1e-6, min(times)), "ms": sum(times), "weights": report.get("weights")}


def main():
    root = pathlib.Path(__file__).resolve().parent.parent.parent / "build" / "release"
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pixels", type=int, default=5)
    parser.add_argument("--what", default="all,steps,error,value,tiles")
    parser.add_argument("--program", default=str(root / "tidemark"))
    parser.add_argument("--timed", default=str(root / "tidemark_timed"))
    parser.add_argument("-o", "--output")
    options = parser.parse_args()
    files = random_projects(options.folder, options.seed)
    chance, what, rows = random.Random(options.seed), options.what.split(","), []
    with tempfile.TemporaryDirectory() as folder:
        for path in files[:options.count]:
            try:
                project = Project(path, pathlib.Path(folder), options)
                row = {"project": path.name}
                if "all" in what:
                    row["lenses"] = {name: project.lens(name)[1] or "drew" for name in LENSES}
                for each in ("steps", "error", "tiles"):
                    if each in what:
                        row[each] = getattr(project, each)()
                if "value" in what:
                    row["value"] = project.value(chance, options.pixels)
            except (KeyError, ValueError, IndexError, subprocess.TimeoutExpired) as error:
                row = {"project": path.name, "failed": f"{type(error).__name__}: {error}"}
            rows.append(row)
            print(json.dumps(row)[:600], flush=True)
            if options.output:
                pathlib.Path(options.output).write_text(json.dumps(rows, indent=1))
    summarise(rows)


def summarise(rows):
    for name in LENSES:
        words = [row["lenses"][name] for row in rows if "lenses" in row]
        if words:
            print(f"{name}: drew {words.count('drew')} of {len(words)}; refused {sum(word.startswith('3:') for word in words)}; "
                  f"otherwise {[word for word in words if word != 'drew' and not word.startswith('3:')]}")
    steps = [row["steps"] for row in rows if row.get("steps")]
    print(f"steps: {sum(each['equal'] == each['of'] > 0 for each in steps)} of {len(steps)} copies equal in all pixels")
    errors = [row["error"] for row in rows if row.get("error") and "lens" in row["error"]]
    same = [each for each in errors if each["lens"] is not None and each["compared"] is not None
            and abs(each["lens"] - each["compared"]) <= 2 / 65535 + 1e-3 * each["compared"]]
    print(f"error: {len(same)} of {len(errors)} equal")
    values = [row["value"] for row in rows if row.get("value")]
    pixels = [pixel for each in values for pixel in each["pixels"]]
    print(f"value: {sum(pixel['same'] for pixel in pixels)} of {len(pixels)} pixels of {sum(bool(each['pixels']) for each in values)} projects; "
          f"otherwise {[pixel['trace says'] for pixel in pixels if not pixel['same']]}; refused {[each['refused'] for each in values if each['refused']]}")
    tiles = [row["tiles"] for row in rows if row.get("tiles") and "correlation" in row["tiles"]]
    wide = [each for each in tiles if each["spread"] > 2 and each["ms"] > 10 and each["again"] > 0.9]
    if wide:
        print(f"tiles: {len(wide)} of {len(tiles)} differ by more than 2, take over 10 ms and have repeatable times:")
        for name in ("correlation", "grouped", "clocks", "again"):
            known = [each[name] for each in wide if each[name] is not None]
            print(f"  {name}: median {statistics.median(known):.3f}, least {min(known):.3f}" if known else f"  {name}: refused")


if __name__ == "__main__":
    main()
