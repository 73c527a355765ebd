"""From a change in an editor to its picture in the preview of `tidemark lsp`: the time between sending `didChange` and having
all of the picture at a client of the preview, less compiling and the first draw by the program's own clock."""
import argparse
import pathlib
import re
import statistics
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))

from serve import interval  # beside this file
from support.lsp_client import Client
from support.websocket import Viewer

# A still picture, so that each picture is the answer to one change.
SCENE = """\
float scene(vec3 p) { return length(p) - BASE; }
void mainImage(out vec4 c, in vec2 p) {
    vec2 uv = p / iResolution.xy - 0.5;
    float t = 0.0;
    for (int i = 0; i < 60; ++i)
        t += scene(vec3(uv, -2.0) + t * vec3(0.0, 0.0, 1.0));
    c = vec4(fract(t * NUMBER));
}
"""
TIMES = re.compile(r"reloaded in (\d+) ms: notice \d+, load [\d.]+, compile (\d+), first draw (\d+)")


def text(number: int) -> str:
    return SCENE.replace("BASE", "0.3").replace("NUMBER", f"{1 + 0.001 * number:.3f}")


def measure(count: int) -> list[tuple[float, int, int]]:
    """For each change the time in all, and what compiling and the first draw took of it, in milliseconds."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder, "a.glsl").resolve()
        scene.write_text(text(0))
        client = Client()
        client.open(scene)
        preview = client.request("workspace/executeCommand", {"command": "tidemark.openPreview", "arguments": [scene.as_uri()]})["result"]
        viewer = Viewer(preview["url"], token=preview["token"])
        last = viewer.picture()[0]["number"]
        for i in range(1, count + 1):
            time.sleep(1)  # diagnostics of the change before are done
            begin = time.perf_counter()
            client.change(scene, text(i), i + 1)
            number = viewer.picture()[0]["number"]
            took = (time.perf_counter() - begin) * 1000
            assert number == last + 1, "a picture of another change"
            last = number
            log = client.wait(lambda m: m.get("method") == "window/logMessage" and TIMES.search(m["params"]["message"]))
            _, compiled, drawn = map(int, TIMES.search(log["params"]["message"]).groups())
            rows.append((took, compiled, drawn))
        viewer.close()
        client.close()
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=50)
    rows = measure(parser.parse_args().count)
    rest = [took - compiled - drawn for took, compiled, drawn in rows]
    print(f"change to picture {interval([row[0] for row in rows])} ms, compiling {statistics.median(row[1] for row in rows):.0f}, "
          f"first draw {statistics.median(row[2] for row in rows):.0f}; the rest {interval(rest)}, "
          f"at most {max(rest):.0f}, 95 % under {sorted(rest)[int(0.95 * len(rest))]:.0f}")


if __name__ == "__main__":
    main()
