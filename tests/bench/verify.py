"""Tests and measures one device in at most eight minutes: verify.py [FOLDER]. Writes FOLDER/verify.json and the page
FOLDER/index.html: what failed, what was measured, on which device. Exit code 1: a part failed.

It is `verify` of the bundle (runner/install/bundle), and runs in the sources, too, after `./dev build release benchmarks`. Each
part is a process of its own: one that fails, crashes or hangs does not stop the others."""
from __future__ import annotations

import argparse
import dataclasses
import datetime
import json
import os
import pathlib
import platform
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import device  # noqa: E402, which finds the program and the scenes
import golden_test  # noqa: E402
import verify_numbers as numbers  # noqa: E402
import verify_page  # noqa: E402
from support import exr  # noqa: E402

SECONDS = 480
RESERVE = 10  # for the page
SOFTWARE = ("llvmpipe", "softpipe", "SwiftShader")
# By whether the CPU draws.
BENCH_SIZES = {True: ((640, 360),), False: ((1280, 720), (1920, 1080))}
BENCH_SCENES = {True: ("water_surface",), False: ("gerstner_waves", "pseudo3d_water", "water_surface")}
STUDY_SIZES = {True: "160x90", False: "640x360"}
STUDIED = ("stylized_waves", "pseudo3d_water")  # those with the fewest settings
NVIDIA = "like NVIDIA's"


class Findings:
    """What a part found, in FOLDER/parts/NAME.json after each addition, so that a part which is ended keeps its results."""

    def __init__(self, out: pathlib.Path, name: str, seconds: float = SECONDS) -> None:
        self.out = out
        self.end = time.monotonic() + seconds
        self.file = out / "parts" / f"{name}.json"
        self.late: list[str] = []
        self.found: dict = {"said": [], "notes": [], "problems": [], "tables": [], "figures": []}

    def add(self, kind: str, what) -> None:
        self.found[kind].append(what)
        self.file.write_text(json.dumps(self.found))

    def share(self, steps: int) -> float:
        """Seconds for the next of so many steps."""
        return max(1.0, (self.end - time.monotonic() - 1) / steps)

    def say(self, text: str) -> None:
        self.add("said", text)

    def note(self, text: str) -> None:
        self.add("notes", text)

    def fail(self, text: str) -> None:
        self.add("problems", text)

    def figure(self, **figure) -> None:
        self.add("figures", figure)

    def table(self, head: list[str], rows: list[list]) -> None:
        self.add("tables", {"head": head, "rows": rows})


def attempt(findings: Findings, what: str, work: Callable):
    """The result of a step, or None after its failure was noted. A step that is not done in time is no failure: the machine may
    be slow or busy."""
    try:
        return work()
    except subprocess.TimeoutExpired as error:
        findings.late.append(what)
        findings.note(f"{what}: not done after {error.timeout:.0f} s")
    except (RuntimeError, OSError, ValueError, KeyError, subprocess.SubprocessError, SystemExit, AssertionError) as error:
        findings.fail(f"{what}: {str(error).strip()}")
    return None


# The parts.

def self_test(findings: Findings) -> None:
    answer = json.loads(device.program("inspect", "--devices", "--self-test", "--json", *device.DEVICE, codes=(0, 1), limit=900).stdout)
    judge_self_test(answer, findings)


def judge_self_test(answer: dict, findings: Findings) -> None:
    if not any("checks" in each for each in answer["devices"]):
        findings.fail("no device can be used")
    for each in answer["devices"]:
        name = f"{each['name']} ({each.get('renderer', 'unusable')})"
        findings.figure(**each)
        if "checks" not in each:
            findings.say(f"{name}: {each.get('unusable', 'not tested')}")
            continue
        for check in each["checks"]:
            if check["verdict"] != "pass":
                (findings.fail if check["verdict"] == "fail" else findings.note)(f"{name}: {check['check']}: {check['says']}")
        findings.say(f"{name}: {sum(check['verdict'] == 'pass' for check in each['checks'])} of {len(each['checks'])} checks pass")
        findings.table([name, "", ""], [[check["check"], check["verdict"], check["says"]] for check in each["checks"]])


def conformance(findings: Findings) -> None:
    """The self test has drawn the projects."""
    try:
        tested = json.loads((findings.out / "parts" / "self_test.json").read_text())["figures"]
    except (OSError, ValueError):
        tested = []
    judge_conformance(tested, findings)


def judge_conformance(tested: list[dict], findings: Findings) -> None:
    verdicts = [(each["name"], check) for each in tested for check in each.get("checks", []) if check["check"] == "conformance"]
    if not verdicts:
        findings.fail("the self test did not get as far as the projects")
    for name, check in verdicts:
        (findings.say if check["verdict"] == "pass" else findings.fail)(f"{name}: {check['says']}")


def golden(findings: Findings) -> None:
    """Judged by FLIP on every device, so that two devices can be compared."""
    rows = []
    for scene, views in golden_test.SCENES.items():
        for view in views:
            row = attempt(findings, f"{scene} {view}", lambda s=scene, v=view: device.golden_view(findings.out, s, v, "LIMITS_ELSEWHERE"))
            if row:
                rows.append(row)
                findings.figure(**row)
                if not row["passes"]:
                    findings.fail(f"{scene} {view}: {'; '.join(map(str, row['failures']))}")
    frames = [(row, row["frames"][0]) for row in rows]
    if frames:
        worst, frame = max(frames, key=lambda pair: pair[1]["flip"])
        findings.say(f"{sum(row['passes'] for row in rows)} of {len(rows)} views within the limits; "
                     f"the largest FLIP is {frame['flip']:.4f}, of {worst['scene']} {worst['view']}")
    findings.table(["view", "FLIP", "PSNR, dB", "pixels off by more than 16 of 255, %", ""],
                   [[f"{row['scene']} {row['view']}", f"{frame['flip']:.4f}", "same" if frame["equal"] else f"{frame['psnr']:.1f}",
                     f"{frame['differing']:.2f}", "pass" if row["passes"] else "fail"] for row, frame in frames])


def drawn_samples(folder: pathlib.Path, name: str, text: str) -> exr.Part:
    (folder / f"{name}.glsl").write_text(text)
    picture = folder / f"{name}.exr"
    size = f"{numbers.SIDE}x{numbers.SIDE}"
    device.program("capture", folder / f"{name}.glsl", "--size", size, "--depth", "float", "-o", picture, limit=30)
    return exr.read(picture)[0]


def from_below(part: exr.Part, channel: str) -> list[float]:
    """The samples in the order of their numbers: a shader counts rows from the bottom, a file from the top."""
    values = part.values(channel)
    return [value for row in range(numbers.SIDE - 1, -1, -1) for value in values[row * numbers.SIDE:(row + 1) * numbers.SIDE]]


def sines(findings: Findings) -> None:
    rows = []
    for reach in numbers.RANGES:
        part = drawn_samples(findings.out / "parts", f"sine_{reach:g}", numbers.sine_shader(reach))
        figures = numbers.sine_figures(reach, part.values("R"), part.values("G"))
        findings.figure(**figures)
        models = figures["models"]
        rows.append([f"{reach:g}", f"{figures['error']:.2g}", *(f"{each['error']:.2g}" for each in models.values()),
                     f"{models[NVIDIA]['same_bits_percent']:.1f}"])
        text = f"up to |x| = {reach:g}: off by {figures['error']:.2g}, models by {max(e['error'] for e in models.values()):.2g} at most"
        if figures["covered"]:
            findings.say(text)
        else:
            findings.note(text + ": `check` imitates no sine as inexact as this device's")
    findings.table(["|x| up to", "this device's error", *(f"model: {name}" for name in numbers.SINE_MODELS), "bits of NVIDIA's model, %"], rows)


def roundings(findings: Findings) -> None:
    planes: list[list[float]] = []
    for number, text in enumerate(numbers.ROUNDING_SHADERS):
        part = drawn_samples(findings.out / "parts", f"rounding_{number}", text)
        planes += [from_below(part, channel) for channel in "RGB"]
    figures = numbers.rounding_figures(planes)
    findings.figure(**figures)
    judge_roundings(figures, findings)


def judge_roundings(figures: dict, findings: Findings) -> None:
    for name, percent in figures["exact"].items():
        if percent < 100:
            findings.fail(f"{name}: {100 - percent:.2g} % of the results are not rounded as IEEE 754 asks, which GLSL requires")
    sums = figures["a * b + c"]
    findings.say(f"a * b + c: rounded once in {sums['rounded_once_percent']:.1f} %, twice in {sums['rounded_twice_percent']:.1f} % of the samples")
    if sums["neither_percent"] > 0:
        findings.note(f"a * b + c: {sums['neither_percent']:.2g} % are neither of both; `check` imitates these two alone")
    outside = [f"{name} {each['largest']:.1f}" for name, each in figures["units"].items() if each["largest"] > numbers.MODELLED_UNITS]
    if outside:
        findings.note(f"units in the last place: {', '.join(outside)}; `check` moves results by one unit")
    findings.table(["operation", "largest error in units of the last place", "within check's model, %"],
                   [[name, f"{each['largest']:.2f}", f"{each['covered_percent']:.1f}"] for name, each in figures["units"].items()])


def speed(findings: Findings) -> None:
    if device.DEVICE:
        findings.note("not measured: the bare program beside which frames are timed draws on the default device only")
        return
    rows, slow = [], draws_on_cpu()
    scenes = [device.one_line(findings.out / "parts"), *(device.ROOT / "shaders" / f"{name}.glsl" for name in BENCH_SCENES[slow])]
    for size in BENCH_SIZES[slow]:
        for scene in scenes:
            words = f"{scene.stem} {size[0]}x{size[1]}"
            row = attempt(findings, words, lambda s=scene, z=size: device.speed_of(findings.out / "parts", s, z, 1))
            if row:
                findings.figure(**row)
                whole = row[str(row["frames"])]
                rows.append([words, f"{row['ours_ms']:.2f}", f"{row['floor_ms']:.2f}", *(
                    f"{whole[what]['ratio']['median']:.2f}" for what in ("wall", "cpu", "memory"))])
                findings.say(f"{words}: {row['ours_ms']:.2f} ms a frame, the bare program {row['floor_ms']:.2f}")
    findings.table(["scene", "ms a frame, ours", "the bare program", "whole run: wall", "CPU", "memory, times the bare program's"], rows)


def checks(findings: Findings) -> None:
    rows = []
    for number, scene in enumerate(device.SCENES):
        seconds = findings.share(len(device.SCENES) - number)
        done = attempt(findings, scene.stem, lambda s=scene, t=seconds: device.check_of(s, min(20, 0.7 * t), (0, 1, 5), t))
        if done:
            findings.figure(**done)
            rows += judge_check(done, findings)
    findings.table(["scene", "probe", "", "found"], rows)


def judge_check(done: dict, findings: Findings) -> list[list]:
    """The rows of the table: what did not pass, and the two probes that imitate other devices."""
    probes = done["check"]["probes"]
    count = {verdict: sum(each["verdict"] == verdict for each in probes) for verdict in ("pass", "warn", "fail", "cut")}
    findings.say(f"{done['scene']}: " + ", ".join(f"{many} {verdict}" for verdict, many in count.items() if many) +
                 f" ({done['seconds']:.0f} s)")
    for each in probes:
        if each["verdict"] == "fail":
            findings.fail(f"{done['scene']}: {each['probe']}: {each['found']}")
    if count["cut"]:
        findings.note(f"{done['scene']}: {count['cut']} probes were cut off by the time limit")
    return [[done["scene"], each["probe"], each["verdict"], each["found"]] for each in probes
            if each["verdict"] not in ("pass", "n/a") or each["probe"] in ("sine", "rounding")]


def studies(findings: Findings) -> None:
    size = STUDY_SIZES[draws_on_cpu()]
    for number, name in enumerate(STUDIED):
        seconds = findings.share(len(STUDIED) - number)
        done = attempt(findings, name, lambda n=name, t=seconds: device.study_of(findings.out / "parts", n, size, 10, t))
        if done:
            judge_study(done, findings)


def judge_study(done: dict, findings: Findings) -> None:
    study = done["study"]
    findings.figure(scene=done["scene"], study=study)
    failures = [point for point in study["points"] if "failure" in point]
    findings.say(f"{done['scene']}, {len(study['points'])} settings: {'; '.join(study['verdict'][:2])}")
    for point in failures:
        findings.fail(f"{done['scene']}: {point['label']}: {point['failure']}")
    if not study.get("complete", True):
        findings.note(f"{done['scene']}: the time limit ended the study before all settings were timed")
    findings.table([done["scene"]], [[sentence] for sentence in study["verdict"]])


@dataclasses.dataclass
class Part:
    title: str
    work: Callable[[Findings], None]
    limit: float  # seconds


PARTS = {
    "self_test": Part("Self test", self_test, 150),
    "conformance": Part("ShaderToy's rules", conformance, 10),
    "golden": Part("Golden pictures", golden, 90),
    "sines": Part("Sines beside the models of check", sines, 25),
    "roundings": Part("Roundings beside the models of check", roundings, 25),
    "speed": Part("Speed beside a bare program", speed, 90),
    "checks": Part("Check of the five waters", checks, 150),
    "studies": Part("Study of two waters", studies, 240),
}


# Facts of the machine.

def renderer() -> str:
    """The driver that draws, as a picture's metadata has it."""
    facts = json.loads(device.program("inspect", device.SCENES[0], "--json", *device.DEVICE, limit=60).stdout)
    return f"{facts['renderer']}, OpenGL {facts['driver']}"


def draws_on_cpu() -> bool:
    return any(name in renderer() for name in SOFTWARE)


def machine() -> dict:
    with open("/proc/cpuinfo") as lines:
        model = next((line.split(":", 1)[1].strip() for line in lines if "model name" in line), platform.machine())
    try:
        system = platform.freedesktop_os_release()["PRETTY_NAME"]
    except (OSError, KeyError):
        system = platform.platform()
    return {"processor": model, "cores": len(os.sched_getaffinity(0)), "system": system, "kernel": platform.release(), "glibc": os.confstr("CS_GNU_LIBC_VERSION").split()[-1]}


def facts_of_device() -> dict:
    facts = {"chosen": device.DEVICE[1] if device.DEVICE else "auto"}
    for name, ask in (("renderer", renderer), ("tidemark", lambda: device.program("--version").stdout.split()[1]),
                      ("listed", lambda: device.program("inspect", "--devices", limit=60).stdout.splitlines())):
        try:
            facts[name] = ask()
        except (RuntimeError, OSError, ValueError, KeyError, subprocess.SubprocessError) as error:
            facts[name] = f"unknown: {error}"
    return facts


# Running the parts.

def run_part(name: str, out: pathlib.Path, limit: float) -> dict:
    """Runs a part as a process group of its own, which is ended with all that it started."""
    begun = time.monotonic()
    command = [sys.executable, *sys.orig_argv[1:sys.orig_argv.index(sys.argv[0])], sys.argv[0], str(out),
               "--part", name, "--seconds", f"{limit:.1f}", *device.DEVICE]
    process = subprocess.Popen(command, start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    late = ""
    try:
        _, words = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        late = f"ended after {limit:.0f} s, before it was done"
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    if late:
        process.communicate()
    try:
        found = json.loads((out / "parts" / f"{name}.json").read_text())
    except (OSError, ValueError):
        found = {"said": [], "notes": [], "problems": [], "tables": [], "figures": []}
    if late or process.returncode != 0:
        found["problems"].append(late or f"ended with {process.returncode}: {' '.join(words.strip().splitlines()[-1:])}")
    verdict = "fail" if found["problems"] else "note" if found["notes"] else "pass"
    return {"part": name, "title": PARTS[name].title, "verdict": verdict, "seconds": time.monotonic() - begun, **found}


def not_run(name: str) -> dict:
    return {"part": name, "title": PARTS[name].title, "verdict": "fail", "seconds": 0.0, "said": [], "notes": [],
            "problems": ["not run: the time was over"], "tables": [], "figures": []}


def run_all(names: list[str], out: pathlib.Path, seconds: float) -> dict:
    begun = time.monotonic()
    report: dict = {"started": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
                    "machine": machine(), "device": facts_of_device(), "parts": []}
    for name in names:
        left = seconds - RESERVE - (time.monotonic() - begun)
        part = run_part(name, out, min(PARTS[name].limit, left)) if left > 2 else not_run(name)
        report["parts"].append(part)
        print(f"{part['verdict']}  {part['title']} ({part['seconds']:.0f} s)", flush=True)
        for text in (*part["problems"], *part["notes"]):
            print(f"      {text}", flush=True)
    report["failed"] = [part["part"] for part in report["parts"] if part["verdict"] == "fail"]
    report["seconds"] = time.monotonic() - begun
    return report


def main() -> int:
    parser = argparse.ArgumentParser(prog="verify", description="Tests and measures one device.")
    parser.add_argument("folder", type=pathlib.Path, nargs="?", default=pathlib.Path("tidemark-verify"), help="folder for the results [tidemark-verify]")
    parser.add_argument("--device", metavar="NAME", help="a name that `tidemark inspect --devices` lists [the one that the program chooses]")
    parser.add_argument("--parts", default=",".join(PARTS), help=f"of {','.join(PARTS)} [all]")
    parser.add_argument("--seconds", type=float, default=SECONDS, help=f"time limit of the whole [{SECONDS}]")
    parser.add_argument("--beside", type=pathlib.Path, metavar="FILE", help="verify.json of another device, shown beside this one's")
    parser.add_argument("--part", choices=PARTS, help=argparse.SUPPRESS)
    options = parser.parse_args()
    names = options.parts.split(",")
    if unknown := [name for name in names if name not in PARTS]:
        parser.error(f"there is no part {', '.join(unknown)}")
    device.DEVICE[:] = ["--device", options.device] if options.device else []
    if options.part:
        part, findings = PARTS[options.part], Findings(options.folder, options.part, options.seconds)
        attempt(findings, part.title, lambda: part.work(findings))
        if findings.late and not findings.found["figures"]:
            findings.fail("no step was done in time: a machine that is slow or busy needs more `--seconds`")
        return 0
    for folder in ("parts", "pictures"):
        shutil.rmtree(options.folder / folder, ignore_errors=True)
        (options.folder / folder).mkdir(parents=True)
    beside = json.loads(options.beside.read_text()) if options.beside else None
    report = run_all(names, options.folder.resolve(), options.seconds)
    (options.folder / "verify.json").write_text(json.dumps(report, indent=1) + "\n")
    (options.folder / "index.html").write_text(verify_page.page(report, golden_test.GOLDEN, options.folder / "pictures", beside))
    print(f"{'failed: ' + ', '.join(report['failed']) if report['failed'] else 'all parts passed'}; {report['seconds']:.0f} s; {options.folder / 'index.html'}")
    return 1 if report["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())
