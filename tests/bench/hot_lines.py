"""Whether a line's share of `inspect --hot-lines` is its share of the time: its operations are done twice, or left out.

    python3 tests/bench/hot_lines.py FOLDER [--count 20] [--seed 1] [--least 0.1] [--how twice|out] [--budget 20]
        [--program PATH] [--timed PATH] [-o rows.json]

For each line above the least share a copy of the project is made. `twice`: the line's operations are done a second time, with other
operands, and added to its value times a 0 that no compiler knows, so that the picture keeps its bytes; a second copy has the other
operands without the operations, and is taken off. `out`: the line gets the sum of its operands instead. Calls of the author's
functions are not repeated, but operations in their arguments are. The share that the program measured is held against the change of
the CPU time (tests/bench/timed.cpp), drawn in turn, medians. The copies are counted again: a copy that does a part of the line twice,
without calls of the author's functions for example, is held against that part of the share. `out` is held against the share itself. A
copy whose count changes by less than half of the line's counted share does not show the line, and is left out. Frames of a few milliseconds are drawn larger. With --budget 0 the
shares are counted; lines that the program could not measure are left out otherwise.
"""
import argparse
import json
import pathlib
import re
import statistics
import subprocess
import tempfile

from random_projects import random_projects

FLOATS = "float vec2 vec3 vec4 mat2 mat3 mat4".split()
TYPES = set("float vec2 vec3 vec4 int ivec2 ivec3 ivec4 uint uvec2 uvec3 uvec4 bool bvec2 bvec3 bvec4 mat2 mat3 mat4".split())
WORDS = set("true false if else for while do return break continue const in out inout highp mediump lowp".split())
NUMBER = re.compile(r"(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?[uUfF]*")
NAME = re.compile(r"[A-Za-z_]\w*")
FUNCTION = re.compile(r"\b(\w+)\s+(\w+)\s*\(([^()]*)\)\s*\{")


def helpers():
    """`keep_`: a float that needs all components. `shift_`: the value plus the 0 that no compiler knows."""
    text = ["float keep_(float v) { return v; }", "float shift_(float v) { return v + iMouse.w; }"]
    for size in (2, 3, 4):
        parts = " + ".join("v." + "xyzw"[i] for i in range(size))
        text.append(f"float keep_(vec{size} v) {{ return {parts}; }} vec{size} shift_(vec{size} v) {{ return v + iMouse.w; }}")
        text.append(f"float keep_(ivec{size} v) {{ return float(v.x); }} ivec{size} shift_(ivec{size} v) {{ return v + int(iMouse.w); }}")
        columns = " + ".join(f"keep_(v[{i}])" for i in range(size))
        text.append(f"float keep_(mat{size} v) {{ return {columns}; }} mat{size} shift_(mat{size} v) {{ return v; }}")
    for kind in ("int", "uint", "bool"):
        text.append(f"float keep_({kind} v) {{ return float(v); }}")
    text.append("int shift_(int v) { return v + int(iMouse.w); } uint shift_(uint v) { return v; } bool shift_(bool v) { return v; }")
    return " ".join(text)


def without_comments(text):
    """The same lines, with blanks instead of comments."""
    return re.sub(r"//[^\n]*|/\*.*?\*/", lambda m: re.sub(r"[^\n]", " ", m.group(0)), text, flags=re.S)


def closing(text, at):
    """The place after the bracket that closes the one at `at`."""
    depth = 0
    for i in range(at, len(text)):
        depth += text[i] in "([{"
        depth -= text[i] in ")]}"
        if depth == 0:
            return i + 1
    return len(text)


def arguments_of(text):
    """The arguments of a call, from the text between its brackets."""
    parts, depth, begin = [], 0, 0
    for i, letter in enumerate(text):
        depth += letter in "([{"
        depth -= letter in ")]}"
        if letter == "," and depth == 0:
            parts.append(text[begin:i])
            begin = i + 1
    return [part.strip() for part in parts + [text[begin:]] if part.strip()]


def saving(text, functions, count):
    """The expression; the value of each call of the author's functions is kept in a variable, outer calls first."""
    found = next((m for m in re.finditer(r"\b(\w+)\s*\(", text) if m.group(1) in functions), None)
    if not found:
        return text
    after = closing(text, found.end() - 1)
    name = f"saved{count[0]}_"
    count[0] += 1
    inside = saving(text[found.end():after - 1], functions, count)
    return f"{text[:found.start()]}({name} = {found.group(1)}({inside})){saving(text[after:], functions, count)}"


class Expression:
    """The operands of an expression, as they are and shifted, and the expression with each shifted."""

    def __init__(self, text, functions, macros):
        self.leaves, self.shifts, self.saved, self.good = [], [], [], True
        self.shifted = self._read(text, functions, macros)
        self.plain = saving(text, functions, [0])

    def _read(self, text, functions, macros):
        result, i = [], 0
        while i < len(text):
            name = NAME.match(text, i)
            number = NUMBER.match(text, i)
            if number and not name:
                result.append(number.group(0))
                i = number.end()
                continue
            if not name:
                result.append(text[i])
                i += 1
                if result[-1] == ".":  # a member of a bracketed expression
                    member = NAME.match(text, i)
                    if member:
                        result.append(member.group(0))
                        i = member.end()
                continue
            word, end = name.group(0), name.end()
            rest = re.match(r"\s*\(", text[end:])
            if rest:
                after = closing(text, end + rest.end() - 1)
                inside = text[end + rest.end():after - 1]
                if word in functions:
                    self.leaves.append(text[i:after])
                    self.good &= functions[word] in FLOATS
                    name = f"saved{len(self.saved)}_"
                    self.saved.append(functions[word])
                    shift = f"shift_({name})"
                    self.shifts.append(shift)
                    own = [self._read(each, functions, macros) for each in arguments_of(inside) if not re.fullmatch(r"[\w.\s]+", each)]
                    kept = " + ".join(f"keep_({each})" for each in own)
                    result.append(f"({shift}" + (f" + {functions[word]}({kept}))" if own else ")"))
                elif word in macros:
                    self.good = False
                elif word.startswith("tex") and word not in functions:
                    sampler, comma, others = inside.partition(",")
                    result.append(f"{word}({sampler}{comma}{self._read(others, functions, macros)})")
                else:
                    result.append(f"{word}({self._read(inside, functions, macros)})")
                i = after
                continue
            if word in WORDS:
                result.append(word)
                i = end
                continue
            while True:  # a[i].b.c
                more = re.match(r"\s*(\.\s*[A-Za-z_]\w*|\[)", text[end:])
                if not more:
                    break
                end = closing(text, end + more.end() - 1) if more.group(1) == "[" else end + more.end()
            leaf = text[i:end]
            self.leaves.append(leaf)
            self.shifts.append(f"shift_({leaf})")
            result.append(self.shifts[-1])
            i = end
        return "".join(result)


def type_of_name(text, target):
    name, _, members = target.partition(".")
    types = {kind for kind in re.findall(rf"\b({'|'.join(TYPES)})\s+(?:[^;(){{}}]*,\s*)?{re.escape(name)}\b", text)}
    if len(types) != 1 or "." in members or "[" in target:
        return None
    kind = types.pop()
    if not members:
        return kind
    return "float" if len(members) == 1 else f"vec{len(members)}" if re.fullmatch(r"[xyzwrgbastpq]{2,4}", members) else None


STATEMENT = re.compile(r"(?:\b(float|vec[234]|mat[234])\s+(\w+)\s*=|\b(return)\b|((?:\b[A-Za-z_]\w*)(?:\.\w+)?)\s*([-+*/]?=)(?!=))\s*")


OPERATION = re.compile(r"[-+*/%<>?!&|^(]")


def changed_line(code, line, how):
    """The text with its line changed, and whether all of the line's operations are; None: it has no statement that can be."""
    clean = without_comments(code)
    functions = {name: kind for kind, name, _ in FUNCTION.findall(clean) if kind in TYPES or kind == "void"}
    macros = set(re.findall(r"#\s*define\s+(\w+)\(", clean))
    lines = clean.split("\n")
    if line > len(lines) or lines[line - 1].lstrip().startswith("#"):
        return None, False
    begin = sum(len(each) + 1 for each in lines[:line - 1])
    end = begin + len(lines[line - 1])
    edits, saved, at, declares, after = [], [], begin, None, begin
    rest, whole = begin, True
    while True:
        found = STATEMENT.search(clean, at, end)
        if not found:
            break
        at = found.end()
        before = clean[begin:found.start()].rstrip()
        more = declares and found.group(5) == "=" and clean[after:found.start()].strip() == ","  # the second of `float c = 1., s = 2.`
        if before and before[-1] not in ";{})" and not before.endswith("else") and not more:
            continue
        stop, depth = at, 0
        while stop < len(clean) and not (depth == 0 and clean[stop] in ";,)"):
            depth += clean[stop] in "([{"
            depth -= clean[stop] in ")]}"
            stop += 1
        if stop >= len(clean) or clean[stop] == ")":
            continue
        if found.group(3):
            kinds = [kind for kind, place in ((m.group(1), m.start()) for m in FUNCTION.finditer(clean)) if place < at]
            kind = kinds[-1] if kinds else None
        else:
            kind = declares if more else found.group(1) or type_of_name(clean, found.group(4))
        declares, after = (declares if more else found.group(1)), stop
        value = clean[at:stop]
        expression = Expression(value, functions, macros)
        if kind not in FLOATS or not expression.good or not expression.leaves:
            continue
        if how == "twice":
            instead = f"({expression.plain}) + {kind}(iMouse.w * keep_({kind}({expression.shifted})))"
        elif how == "shifted":
            kept = " + ".join(f"keep_({shift})" for shift in dict.fromkeys(expression.shifts))
            instead = f"({expression.plain}) + {kind}(iMouse.w * ({kept}))"
        else:
            instead = f"{kind}({' + '.join(f'keep_({leaf})' for leaf in expression.leaves)})"
        if how != "out":
            instead = re.sub(r"\bsaved(\d+)_", lambda m: f"saved{len(saved) + int(m.group(1))}_", instead)
            saved.extend(expression.saved)
        edits.append((at, stop, instead))
        whole = whole and not OPERATION.search(clean, rest, at) and not expression.saved
        at = rest = stop
    if not edits:
        return None, False
    whole = whole and not OPERATION.search(clean, min(rest, end), end)
    for start, stop, instead in reversed(edits):
        clean = clean[:start] + instead + clean[stop:]
    kept = " ".join(f"{kind} saved{i}_;" for i, kind in enumerate(saved))
    return helpers() + kept + "\n" + clean, whole


LEAST_MS = 10  # of a frame, lest the driver's own work counts
SIZES = ("320x180", "640x360", "1280x720")


def load(path):
    """The project as JSON, and its list of passes."""
    if path.suffix == ".json":
        whole = json.loads(path.read_text(errors="replace"))
        inner = whole[0] if isinstance(whole, list) else whole.get("Shader", whole)
        return whole, inner["renderpass"]
    whole = {"ver": "0.1", "info": {"name": path.stem}, "renderpass": [
        {"code": path.read_text(errors="replace"), "type": "image", "name": "Image", "inputs": [], "outputs": []}]}
    return whole, whole["renderpass"]


class Bench:
    def __init__(self, options):
        self.options = options
        self.size = SIZES[0]

    def hot(self, scene, budget=0):
        done = subprocess.run([self.options.program, "inspect", scene, "--hot-lines", "--json", "--size", self.size, "--budget", str(budget)],
                              capture_output=True, text=True, timeout=300)
        return json.loads(done.stdout) if done.returncode == 0 else None

    def choose_size(self, scene):
        for self.size in SIZES:
            times = self.times([scene], 3)
            if not times or times[0].get("ms", LEAST_MS) >= LEAST_MS:
                break

    def times(self, scenes, rounds):
        done = subprocess.run([self.options.timed, "--size", self.size, "--rounds", str(rounds), *scenes],
                              capture_output=True, text=True, timeout=900)
        return [json.loads(line) for line in done.stdout.splitlines()]

    def project(self, path, folder):
        """One row for each line above the least share."""
        whole, passes = load(path)
        plain = folder / path.name.replace(".glsl", ".json")
        plain.write_text(json.dumps(whole))
        self.choose_size(str(plain))
        hot = self.hot(str(plain), self.options.budget)
        if not hot:
            return []
        rows, copies = [], []
        for line in hot["lines"]:
            if line["share"] < self.options.least:
                continue
            row = {"project": path.name, "line": line["line"], "text": line["text"], "share": line["share"], "basis": line["basis"],
                   "counted": line["counted"], "interval": line["interval"], "weights": hot["weights"]}
            if self.options.budget and line["basis"] != "measured":
                rows.append(row)
                continue
            for place in passes:
                text = place["code"]
                if line["text"] and [each.strip() for each in text.split("\n")][line["line"] - 1:line["line"]] == [line["text"]]:
                    pair = []
                    for how in ("twice", "shifted") if self.options.how == "twice" else ("out",):
                        place["code"], row["whole"] = changed_line(text, line["line"], how)
                        if place["code"]:
                            pair.append(str(folder / f"{plain.stem}_{len(copies)}_{how}.json"))
                            pathlib.Path(pair[-1]).write_text(json.dumps(whole))
                    place["code"] = text
                    recounts = [self.hot(copy) for copy in pair]
                    if recounts and all(recounts):
                        base = recounts[1] if len(pair) == 2 else hot
                        row["recounted"] = (recounts[0]["operations"] - base["operations"]) / hot["operations"]
                        part = 1 if row["whole"] else min(1, row["recounted"] / line["counted"])
                        row["predicted"] = line["share"] * part if len(pair) == 2 else -line["share"]
                        if (row["recounted"] if len(pair) == 2 else -row["recounted"]) >= line["counted"] / 2:
                            copies.append((row, pair))
                    break
            rows.append(row)
        if copies:
            times = iter(self.times([str(plain)] + [copy for _, pair in copies for copy in pair], self.options.rounds))
            first = next(times)
            for row, pair in copies:
                timed = [next(times) for _ in pair]
                if all("times" in each for each in [first] + timed):
                    base = timed[1]["times"] if len(pair) == 2 else first["times"]
                    row["measured"] = statistics.median((b - a) / c for a, b, c in zip(base, timed[0]["times"], first["times"]))
                    row["ms"] = first["ms"]
        return rows


def factor(row):
    a, b = row["predicted"], row["measured"]
    return max(a / b, b / a) if a * b > 0 else float("inf")


def main():
    root = pathlib.Path(__file__).resolve().parent.parent.parent / "build" / "release"
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--least", type=float, default=0.1)
    parser.add_argument("--how", choices=("twice", "out"), default="twice")
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--budget", type=float, default=20)
    parser.add_argument("--program", default=str(root / "tidemark"))
    parser.add_argument("--timed", default=str(root / "tidemark_timed"))
    parser.add_argument("-o", "--output")
    options = parser.parse_args()
    bench, rows, used = Bench(options), [], 0
    with tempfile.TemporaryDirectory() as folder:
        for path in random_projects(options.folder, options.seed):
            if used >= options.count:
                break
            try:
                found = bench.project(path, pathlib.Path(folder))
            except (subprocess.TimeoutExpired, KeyError, ValueError) as error:
                print(f"{path.name}: {type(error).__name__}", flush=True)
                continue
            rows += found
            used += any("measured" in row for row in found)
            for row in found:
                if "predicted" in row and "measured" not in row:
                    print(f"{row['project']}:{row['line']}: share {row['share']:.3f}, predicted {row['predicted']:+.3f}, not timed: "
                          f"{row['text'][:70]}", flush=True)
                elif "measured" not in row:
                    print(f"{row['project']}:{row['line']}: share {row['share']:.3f} {row['basis']}, not changed: {row['text'][:70]}",
                          flush=True)
                else:
                    print(f"{row['project']}:{row['line']}: share {row['share']:.3f}, counted {row['counted']:.3f}, predicted {row['predicted']:+.3f}, timed "
                          f"{row['measured']:+.3f}, factor {factor(row):.2f}, {row['ms']:.0f} ms: {row['text'][:70]}", flush=True)
    measured = [row for row in rows if "measured" in row]
    near = [row for row in measured if factor(row) <= 1.5]
    print(f"{len(measured)} of {len(rows)} lines of {used} projects measured; within a factor of 1.5: {len(near)}"
          f" ({100 * len(near) / max(1, len(measured)):.0f} %)")
    if options.output:
        pathlib.Path(options.output).write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
