"""The same frames in a browser: headless Chromium, WebGL 2, a page of ours that draws and reads back."""
import json
import pathlib
import re
import shutil
import subprocess

from measure import run, spread

PAGE = pathlib.Path(__file__).with_name("peer.html")
BROWSERS = ("chromium", "chromium-browser", "google-chrome")


KNOB = re.compile(r"^uniform (\w+) (\w+) = \w+\((.*)\);", re.MULTILINE)


def for_the_web(shader):
    """The text that a desktop driver compiles, in WebGL's words: the page sets the knobs' values."""
    text = re.sub(r"\A#version.*", "#version 300 es\nprecision highp float;\nprecision highp int;", shader)
    text = re.sub(r"^#extension.*", "", text, flags=re.MULTILINE)
    knobs = [{"type": kind, "name": name, "value": [float(number) for number in values.split(",")]}
             for kind, name, values in KNOB.findall(text)]
    return KNOB.sub(r"uniform \1 \2;", text), knobs


def page_for(folder, shader, size, frames):
    text, knobs = for_the_web(pathlib.Path(shader).read_text())
    task = {"shader": text, "knobs": knobs, "width": size[0], "height": size[1], "frames": frames}
    path = pathlib.Path(folder) / f"peer_{frames}.html"
    path.write_text(PAGE.read_text().replace("= TASK;", f"= {json.dumps(task)};"))
    return path.as_uri()


def command(browser, url):
    return [browser, "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle",
            "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--virtual-time-budget=1000000", "--dump-dom", url]


def answer(browser, url):
    """What the page wrote of its own clock."""
    text = subprocess.run(command(browser, url), capture_output=True, text=True, check=True).stdout
    found = re.search(r"<pre>(.*?)</pre>", text, re.DOTALL)
    return json.loads(found.group(1).replace("&quot;", '"')) if found else {"error": "the page gave no answer"}


def in_a_browser(folder, shader, ours, size, frames, rounds):
    """Whole processes in turn: the browser with its page, and the capture of as many frames without a file."""
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if not browser:
        return {"left out": "no Chromium here"}
    url = page_for(folder, shader, size, frames)
    told = answer(browser, url)
    if "error" in told:
        return {"left out": told["error"]}
    pairs = [(run(command(browser, url)), run(ours)) for _ in range(rounds)]
    row = {"renderer": told["renderer"], "frames": frames}
    for figure in ("wall", "cpu"):
        row[figure] = {"browser": spread([a[figure] for a, _ in pairs]), "ours": spread([b[figure] for _, b in pairs]),
                       "ratio": spread([a[figure] / b[figure] for a, b in pairs])}
    return row
