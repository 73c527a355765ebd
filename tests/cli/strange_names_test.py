"""Names and texts that are no words: signs of patterns, controls of terminals, bytes that are no UTF-8, names as long
as they may be."""
import json
import os
import pty
import re
import shutil
import subprocess
import unittest

from support import png
from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, main

PLAIN = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.25, 0.5, 0.75, 1.0); }\n"
SMALL = ("--size", "16x16")
# A colour, a window title, the one-character form of CSI, a direction of writing, bytes that are not UTF-8.
STEER = b"\x1b[31m\x1b]0;owned\x07\xc2\x9b31m\xe2\x80\xae\xff\r\x08\x7f"


def steers(text: bytes) -> list[str]:
    """What a terminal would obey."""
    found = re.findall(rb"[\x00-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\x8e\x8f\xa8-\xae]|\xe2\x81[\xa6-\xa9]", text)
    try:
        text.decode()
    except UnicodeDecodeError as error:
        found.append(str(error))
    return found


class Patterns(ProgramTest):
    def test_default_names_are_not_patterns(self):
        for stem in ("shot#1", "50%", "%04d", "%s%n", "{}", "sky_{}", "a b", "$(touch x)", "#", "a'b\"c", "x.mp4"):
            with self.subTest(stem):
                self.write(f"{stem}.glsl", PLAIN)
                self.assertEqual(self.succeed("capture", f"{stem}.glsl", *SMALL).stderr, f"wrote {stem}.png\n")
                self.succeed("capture", f"{stem}.glsl", *SMALL, "--frames", "0-1")
                self.assertEqual(self.files(), {f"{stem}.glsl", f"{stem}.png", f"{stem}.0000.png", f"{stem}.0001.png"})
                for name in self.files():
                    (self.folder / name).unlink()

    def test_folders_with_such_names(self):
        self.write("50% #{}/image.glsl", PLAIN)
        for scene in ("50% #{}", "50% #{}/", "./50% #{}"):
            with self.subTest(scene):
                self.assertEqual(self.succeed("capture", scene, *SMALL).stderr, "wrote 50% #{}.png\n")
        done = subprocess.run([PROGRAM, "capture", ".", *SMALL], cwd=self.folder / "50% #{}", env=environment(),
                              stderr=subprocess.PIPE, text=True, timeout=TIME_LIMIT, check=True)
        self.assertEqual(done.stderr, "wrote 50% #{}.png\n")

    def test_names_that_begin_with_a_dash(self):
        self.write("-x.glsl", PLAIN.replace("0.25", "sqrt(-1.0 - p.x)"))
        done = self.succeed("capture", "./-x.glsl", *SMALL)
        self.assertIn("wrote -x.png", done.stderr)
        self.assertIn("check --trace ./-x.glsl", done.stderr)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_videos_with_names_special_to_ffmpeg(self):
        self.write("a.glsl", PLAIN)
        for name in ("-y.mp4", "concat:a.mp4", "pipe:1.webm", "http:x.gif", "%d.mp4", "a b'c.mp4"):
            with self.subTest(name):
                done = self.succeed("capture", "a.glsl", *SMALL, "--fps", "50", "--frames", "0-1", f"--output={name}")
                self.assertEqual(done.stderr, f"wrote {name}: 2 frames\n")
                self.assertEqual(self.files(), {"a.glsl", name})
                (self.folder / name).unlink()


class Length(ProgramTest):
    def test_long_names(self):
        for length in (200, 245, 250):
            stem = "n" * length
            with self.subTest(length=length):
                self.write(f"{stem}.glsl", PLAIN)
                self.assertEqual(self.succeed("capture", f"{stem}.glsl", *SMALL).stderr, f"wrote {stem}.png\n")
                self.assertEqual(png.read(self.folder / f"{stem}.png").width, 16)
                self.succeed("capture", f"{stem}.glsl", *SMALL, "--frames", "0-1", "--tile", "8")
                self.assertEqual(len(self.files()), 4)
                for name in self.files():
                    (self.folder / name).unlink()

    def test_long_folder(self):
        self.write(f"{'n' * 255}/image.glsl", PLAIN)
        self.assertEqual(self.succeed("capture", "n" * 255, *SMALL).stderr, f"wrote {'n' * 251}.png\n")


class Terminal(ProgramTest):
    """Whatever a scene says, on either output, through a pipe too."""

    def write_bytes(self, name: bytes, text: bytes) -> str:
        path = os.fsencode(self.folder) + b"/" + name
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(text)
        return os.fsdecode(name)

    def expect_tame(self, *arguments: str, codes: tuple[int, ...]) -> bytes:
        done = subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, env=environment(), timeout=TIME_LIMIT)
        self.assertEqual(steers(done.stdout), [], done.stdout)
        self.assertIn(done.returncode, codes, done.stdout)
        return done.stdout

    def test_texts_of_scenes(self):
        knob = b"#iUniform float k%s = 0.5 in { 0.0, 1.0 }\n" % STEER
        for name, text in {
                "directive": b"#iChannel0 \"" + STEER.replace(b"\r", b"") + b"\"\n" + PLAIN.encode(),
                "unknown": b"#iUniform " + STEER + b" k = 1\n" + PLAIN.encode(),
                "knob": knob + PLAIN.encode(),
                "error": b"#error " + STEER + b"\n" + PLAIN.encode(),
                "include": b"#include \"" + STEER + b"\"\n" + PLAIN.encode(),
                "token": PLAIN.encode() + b"float " + STEER + b";\n",
                "comment": b"// " + STEER + b"\n" + PLAIN.encode().replace(b"0.25", b"sqrt(-1.0 - p.x)"),
        }.items():
            scene = self.write_bytes(name.encode() + b".glsl", text)
            for command in (["capture", scene, *SMALL], ["inspect", scene], ["inspect", scene, "--device", "none"],
                            ["check", scene, "--probe", "times"], ["check", "--portable", scene],
                            ["check", "--trace", scene, *SMALL], ["export", scene], ["inspect", scene, "--json"],
                            ["capture", scene, *SMALL, "--set", "nothing=1"]):
                with self.subTest(name, command=command):
                    self.expect_tame(*command, codes=(0, 1, 2, 3))

    def test_names_of_files(self):
        scene = self.write_bytes(b"n" + STEER + b".glsl", PLAIN.replace("0.25", "sqrt(-1.0 - p.x)").encode())
        for command in (["capture", scene, *SMALL], ["capture", scene, *SMALL, "--json"], ["inspect", scene],
                        ["inspect", scene, "--json"], ["inspect", scene, "--device", "none", "--json"],
                        ["check", scene, "--probe", "times"], ["check", scene, "--probe", "times", "--json"],
                        ["check", "--portable", scene], ["check", "--portable", scene, "--json"],
                        ["check", "--trace", scene, *SMALL], ["check", "--trace", scene, *SMALL, "--json"],
                        ["export", scene, "-o", scene + ".json", "--json"], ["export", scene],
                        ["study", scene, "--vary", "k=1,2"]):
            with self.subTest(command=command):
                out = self.expect_tame(*command, codes=(0, 1, 2, 3))
                if "--json" in command:
                    json.loads(out[out.index(b"{\n"):out.rindex(b"\n}") + 3])
        picture = scene[:-5] + ".png"
        out = self.expect_tame("compare", picture, picture, "--json", codes=(0,))
        self.assertEqual(json.loads(out)["failures"], [])
        self.expect_tame("compare", picture, "none" + picture, codes=(3,))

    def test_titles_of_projects(self):
        title = STEER.decode("latin-1")
        project = {"Shader": {"info": {"name": title}, "renderpass": [
            {"name": title, "type": title, "code": "void mainImage(", "inputs": [{"id": 1, "src": title, "ctype": title,
                                                                                  "channel": 0, "sampler": {}}],
             "outputs": [{"id": 37, "channel": 0}]}]}}
        self.write("x.json", json.dumps(project))
        for command in (["capture", "x.json"], ["inspect", "x.json"], ["import", "x.json"], ["check", "x.json"]):
            with self.subTest(command=command):
                self.expect_tame(*command, codes=(0, 1, 2, 3))

    def test_printed_commands_quote_file_names(self):
        """A shell gives the program the very name back."""
        name = "n\x1b[31m'\\\n\x7f"
        self.write(f"{name}.glsl", PLAIN.replace("0.25", "sqrt(-1.0 - p.x)"))
        done = self.succeed("capture", f"{name}.glsl", *SMALL)
        command = done.stderr.split("find the origin with: ")[1].splitlines()[0].replace("tidemark ", f"{PROGRAM} ", 1)
        traced = subprocess.run(["bash", "-c", command], cwd=self.folder, env=environment(), stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, timeout=TIME_LIMIT)
        self.assertEqual(traced.returncode, 1, traced.stdout)

    def test_source_is_exact_in_a_pipe_and_escaped_on_a_terminal(self):
        scene = self.write_bytes(b"a.glsl", b"// \x1b[31m\xff\n" + PLAIN.encode())
        self.assertIn(b"// \x1b[31m\xff\n", self.succeed("inspect", scene, "--source").stdout)
        leader, follower = pty.openpty()
        self.addCleanup(os.close, leader)
        with subprocess.Popen([PROGRAM, "inspect", scene, "--source"], cwd=self.folder, env=environment(),
                              stdout=follower, stderr=follower) as running:
            os.close(follower)
            shown = b""
            try:
                while block := os.read(leader, 65536):
                    shown += block
            except OSError:
                pass # the other end is closed
            self.assertEqual(running.wait(TIME_LIMIT), 0)
        self.assertIn(rb"// \x1b[31m\xff", shown)


if __name__ == "__main__":
    main()
