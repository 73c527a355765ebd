"""Pictures of ShaderToy projects against those of a browser, pixel by pixel.

    python3 tests/peer/site.py FOLDER [--size 128x72] [--frames 0,30] [--tidemark PROGRAM] [--json OUT]

FOLDER holds projects as ShaderToy's API gives them (ID.json). The browser is headless Chromium, whose ANGLE hands
the texts to the driver that tidemark draws with (--angle gl-egl: Mesa), through a plain page that shares no code
with tidemark (site.html). Both read the same generated media; music, video, webcam and microphone are taken out
for both. Exit code 1 if a project differs that both draw."""
import argparse
import collections
import http.server
import json
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import time
import zlib

PAGE = pathlib.Path(__file__).with_name("site.html")
LEFT_OUT = ("music", "musicstream", "mic", "video", "webcam")
GREY = ("85a6d686", "ad56fba9", "0c7bf5fe", "0a405623")  # one channel on the site, by asset
FLAGS = ("--headless", "--no-sandbox", "--disable-gpu-watchdog", "--disable-quic", "--no-first-run", "--ignore-gpu-blocklist",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--use-gl=angle")


# ---- Media that both read

def png(width, height, channels, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    colour = {1: 0, 4: 6}[channels]
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows), 1)) + chunk(b"IEND", b""))


def make_picture(folder, name, side, channels):
    pick = random.Random(name)
    rows = [pick.randbytes(side * channels) for _ in range(side)]
    (folder / f"{name}.png").write_bytes(png(side, side, channels, rows))
    (folder / f"{name}.raw").write_bytes(struct.pack("<III", side, side, channels) + b"".join(rows))


def make_medium(folder, kind, name):
    if kind == "volume":
        channels = 1 if name == "27012b4e" else 4
        head = struct.pack("<4sIIIBBH", b"BIN\0", 32, 32, 32, channels, 0, 0)
        (folder / f"{name}.bin").write_bytes(head + random.Random(name).randbytes(32 ** 3 * channels))
        return
    channels = 1 if name in GREY else 4
    for face in range(6 if kind == "cubemap" else 1):
        make_picture(folder, f"{name}_{face}" if face else name, 64, channels)


def prepared(path, media, made):
    """The project without the inputs that nobody can hold against another; its media are made on the way."""
    project = json.loads(path.read_bytes())
    project = project[0] if isinstance(project, list) else project
    project = project.get("Shader", project)
    project["renderpass"] = [entry for entry in project["renderpass"] if entry.get("type") != "sound"]
    for entry in project["renderpass"]:
        kind_of = lambda wanted: wanted.get("ctype") or wanted.get("type")
        entry["inputs"] = [wanted for wanted in entry.get("inputs", []) if kind_of(wanted) not in LEFT_OUT]
        for wanted in entry["inputs"]:
            source = wanted.get("src") or wanted.get("filepath") or ""
            key = (kind_of(wanted), source.rsplit("/", 1)[-1][:8])
            if key[0] in ("texture", "cubemap", "volume") and "previz" not in source and key not in made:
                made.add(key)
                make_medium(media, *key)
    return project


# ---- The browser

class Browser:
    """Serves one project after the other to the page, and takes its frames; a browser that stalls is begun anew."""

    def __init__(self, media, angle, patience):
        self.media, self.angle, self.patience = media, angle, patience
        self.task, self.answer = None, None
        self.ready = threading.Condition()
        browser = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def log_message(self, *_):
                pass

            def reply(self, body, kind="application/octet-stream", status=200):
                self.send_response(status)
                self.send_header("Content-Type", kind)
                self.send_header("Content-Length", str(len(body)))
                self.end_headers()
                self.wfile.write(body)

            def do_GET(self):
                if self.path == "/":
                    self.reply(PAGE.read_bytes(), "text/html")
                elif self.path == "/task":
                    self.reply(json.dumps(browser.next_task()).encode(), "application/json")
                elif self.path.startswith("/media/") and (file := browser.media / self.path.rsplit("/", 1)[-1]).is_file():
                    self.reply(file.read_bytes())
                else:
                    self.reply(b"", status=404)

            def do_POST(self):
                body = self.rfile.read(int(self.headers["Content-Length"]))
                browser.done(self.path.rsplit("/", 1)[-1], body)
                self.reply(b"")

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.process = None

    def next_task(self):
        with self.ready:
            while self.task is None:
                self.ready.wait()
            task, self.task = self.task, None
            return task

    def done(self, name, body):
        with self.ready:
            if name == self.name:
                self.answer = body
                self.ready.notify_all()

    def start(self):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
        if not program:
            sys.exit("site.py: no Chromium here")
        self.process = subprocess.Popen(
            [program, *FLAGS, f"--use-angle={self.angle}", "--enable-unsafe-swiftshader", "--remote-debugging-port=0",
             f"--user-data-dir={self.profile.name}", f"http://127.0.0.1:{self.server.server_port}/"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)

    def stop(self):
        if self.process:
            subprocess.run(["pkill", "-KILL", "-s", str(self.process.pid)])
            self.process.wait()
            self.process = None

    def draw(self, name, task):
        """The frames, RGBA8 from the bottom row on, or a sentence that says why not."""
        with self.ready:
            self.name, self.answer, self.task = name, None, {"name": name, **task}
            self.ready.notify_all()
        if not self.process:
            self.start()
        with self.ready:
            self.ready.wait_for(lambda: self.answer is not None, timeout=self.patience)
            answer, self.answer, self.task, self.name = self.answer, None, None, None
        if answer is None:
            self.stop()
            return f"took more than {self.patience} s"
        return answer.decode(errors="replace") if answer.startswith(b"error: ") else answer


# ---- Both, held against each other

def rgb_of(frame, width, height):
    """RGB from the top row on."""
    rows = [frame[y * width * 4:(y + 1) * width * 4] for y in reversed(range(height))]
    return b"".join(bytes(value for i, value in enumerate(row) if i % 4 != 3) for row in rows)


def capture(program, path, media, options):
    command = [program, "capture", str(path), "--media", str(media), "--size", options.size, "--frames", options.frames, "-o", "-"]
    try:
        ran = subprocess.run(command, capture_output=True, timeout=options.patience)
    except subprocess.TimeoutExpired:
        return f"took more than {options.patience} s"
    return ran.stdout if ran.returncode == 0 else ran.stderr.decode(errors="replace").strip()[:200]


def difference(ours, theirs, pixels):
    """Of each frame: how many pixels differ by more than 1 of 255 in a channel, and the largest difference."""
    told = []
    for at in range(0, len(ours), pixels * 3):
        a, b = ours[at:at + pixels * 3], theirs[at:at + pixels * 3]
        apart = [abs(x - y) for x, y in zip(a, b)] if a != b else [0]
        told.append((sum(max(apart[i:i + 3]) > 1 for i in range(0, len(apart), 3)), max(apart)))
    return told


def compare(path, browser, media, made, folder, options):
    width, height = map(int, options.size.split("x"))
    frames = [int(frame) for frame in options.frames.split(",")]
    project = prepared(path, media, made)
    copy = folder / path.name
    copy.write_text(json.dumps(project))
    theirs = browser.draw(path.stem, {"project": project, "width": width, "height": height, "frames": frames})
    ours = capture(options.tidemark, copy, media, options)
    if isinstance(theirs, str) or isinstance(ours, str):
        verdict = "neither draws" if isinstance(theirs, str) and isinstance(ours, str) else \
                  "browser does not" if isinstance(theirs, str) else "tidemark does not"
        return {"id": path.stem, "verdict": verdict, "why": theirs if isinstance(theirs, str) else ours}
    size = width * height * 4
    theirs = b"".join(rgb_of(theirs[i * size:(i + 1) * size], width, height) for i in range(len(frames)))
    apart = difference(ours, theirs, width * height)
    verdict = "equal" if ours == theirs else "within 1" if all(most <= 1 for _, most in apart) else "differs"
    return {"id": path.stem, "verdict": verdict, "frames": apart}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--size", default="128x72")
    parser.add_argument("--frames", default="0,30")
    parser.add_argument("--tidemark", default="build/release/tidemark")
    parser.add_argument("--angle", default="gl-egl", help="Chromium's back end: gl-egl, swiftshader")
    parser.add_argument("--patience", type=float, default=60, help="seconds for a project, each")
    parser.add_argument("--json", type=pathlib.Path, help="a line for each project, as it comes")
    options = parser.parse_args()
    counts, start = collections.Counter(), time.monotonic()
    with tempfile.TemporaryDirectory() as scratch:
        folder, media = pathlib.Path(scratch), pathlib.Path(scratch) / "media"
        media.mkdir()
        browser, made = Browser(media, options.angle, options.patience), set()
        try:
            for path in sorted(options.folder.glob("*.json")):
                row = compare(path, browser, media, made, folder, options)
                counts[row["verdict"]] += 1
                if row["verdict"] != "equal":
                    print(json.dumps(row), flush=True)
                if options.json:
                    with options.json.open("a") as out:
                        out.write(json.dumps(row) + "\n")
        finally:
            browser.stop()
    print(f"{dict(counts)} in {time.monotonic() - start:.0f} s")
    return 1 if counts["differs"] else 0


if __name__ == "__main__":
    sys.exit(main())
