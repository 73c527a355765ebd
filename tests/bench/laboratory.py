"""`check` and `study` as whole processes, beside the bare captures of what they draw."""
import json
import pathlib

from measure import run

STUDIED = "pseudo3d_water"
SIZE = (160, 90)


def checks(program, shaders):
    """How many captures of one frame a check is worth."""
    rows = []
    for scene in sorted(pathlib.Path(shaders).glob("*.glsl")):
        capture = run([program, "capture", str(scene), "-o", "-"])
        check = run([program, "check", str(scene), "--budget", "300", "--json"], codes=(0, 1))
        rows.append({"scene": scene.stem, "check": check, "capture": capture, "ratio": check["cpu"] / capture["cpu"]})
    return rows


def bare_captures(program, scene, study):
    """The frames that a study timed, setting by setting and view by view, drawn and read back and no more."""
    width, height = study["size"]
    for point in study["points"]:
        settings = [word for name, value in point["settings"].items() for word in ("--define", f"{name}={value}")]
        for view in study["views"]:
            frames = int(point["views"][view["name"]]["wall_ms"]["runs"])
            first = round(view["time"] * 60)
            mouse = f"{view['mouse'][0] * width:g},{view['mouse'][1] * height:g}"
            yield [program, "capture", scene, *settings, "--size", f"{width}x{height}", "--mouse", mouse,
                   "--frames", f"{first}-{first + frames - 1}", "-o", "-"]


def timed(command):
    """Once to warm the driver's cache, which keeps the code of every setting, and once that counts."""
    run(command)
    return run(command)


def study(program, shaders, folder, budget=10):
    """What a study adds to drawing: references in double, errors, their shares, a report. What it saves: a process for
    each setting and view."""
    scene = str(pathlib.Path(shaders) / f"{STUDIED}.glsl")
    out = pathlib.Path(folder) / "study"
    whole = timed([program, "study", scene, "--size", f"{SIZE[0]}x{SIZE[1]}", "--budget", str(budget), "-o", str(out)])
    report = json.loads((out / "study.json").read_text())
    captures = [timed(command) for command in bare_captures(program, scene, report)]
    bare = {figure: sum(capture[figure] for capture in captures) for figure in ("wall", "cpu")}
    times = [view["cpu_ms"] for point in report["points"] for view in point["views"].values()]
    return {"scene": STUDIED, "settings": len(report["points"]), "frames": int(sum(time["runs"] for time in times)),
            "frames_cpu": sum(time["median"] * time["runs"] for time in times) / 1e3, "study": whole, "bare": bare,
            "ratio": {figure: whole[figure] / bare[figure] for figure in bare}}
