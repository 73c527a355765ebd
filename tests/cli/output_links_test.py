"""Where outputs go when a scene's folder is a stranger's: behind no link that was not named, over no file that the
command reads, into a device and never in its place."""
import json
import os
import pathlib
import shutil
import stat
import subprocess
import tempfile
import threading
import unittest

from support import png
from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, main

PLAIN = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.25, 0.5, 0.75, 1.0); }\n"
KNOB = """#iUniform float level = 0.5 in { 0.0, 1.0 }
void mainImage(out vec4 c, in vec2 p) { c = vec4(level, fract(p.x * 0.37), 0.0, 1.0); }
"""
BROKEN = "void mainImage(out vec4 c, in vec2 p) { c = vec4(sqrt(-1.0 - p.x)); }\n"
CUBE = "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(d, 1.0); }\n"
SOUND = "vec2 mainSound(int s, float t) { return vec2(sin(6.2831 * 440.0 * t)); }\n"
SMALL = ("--size", "16x16")
STUDY = ("--vary", "level=0.2,0.4", "--reference", "level=0.5", "--size", "16x16", "--views", "0", "--budget", "0.1")


def beginning(path: str, target, link: str | None = None) -> str:
    return f"tidemark: error: cannot write '{path}': {repr(link) if link else 'it'} is a link to '{target}'"


class Links(ProgramTest):
    """The victim's file lies in another folder; it must be there as it was after every test."""

    def setUp(self):
        super().setUp()
        self.elsewhere = pathlib.Path(tempfile.mkdtemp(prefix="tidemark-elsewhere-"))
        self.addCleanup(shutil.rmtree, self.elsewhere)
        self.victim = self.elsewhere / "victim"
        self.victim.write_text("before")
        self.write("a.glsl", PLAIN)
        self.write("knob.glsl", KNOB)
        self.write("broken.glsl", BROKEN)

    def tearDown(self):
        self.assertEqual({p.name for p in self.elsewhere.iterdir()}, {"victim"})
        self.assertEqual(self.victim.read_text(), "before")

    def link(self, name: str, target=None) -> None:
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / name).symlink_to(target or self.victim)

    def refuse(self, arguments: list[str], path: str, link: str | None = None, target=None) -> None:
        """Ends with exit code 4 and names the link; what lies behind it is as it was."""
        done = self.run_program(*arguments)
        self.assertTrue(done.stderr.splitlines()[-1].startswith(beginning(path, target or self.victim, link)), done.stderr)
        self.assertEqual(done.returncode, 4)
        self.assertEqual([name for name in self.files() if ".part-" in name], [])

    def test_picture_of_a_scene(self):
        self.link("a.png")
        self.refuse(["capture", "a.glsl", *SMALL], "a.png")
        self.refuse(["capture", "a.glsl", *SMALL, "--tile", "8"], "a.png")
        (self.folder / "a.png").unlink()
        self.link("a.png", "nowhere")
        self.refuse(["capture", "a.glsl", *SMALL], "a.png", target="nowhere")

    def test_sequences(self):
        self.link("a.0001.png")
        self.refuse(["capture", "a.glsl", *SMALL, "--frames", "0-2"], "a.0001.png")
        self.link("out/f1.png")
        self.refuse(["capture", "a.glsl", *SMALL, "--frames", "0-2", "-o", "out/f%d.png"], "out/f1.png")
        self.link("dir1", self.elsewhere)
        self.refuse(["capture", "a.glsl", *SMALL, "--frame", "1", "-o", "dir%d/f.png"], "dir1/f.png", "dir1", self.elsewhere)

    def test_six_faces(self):
        self.write("cube/cube_a.glsl", CUBE)
        self.write("cube/image.glsl", PLAIN)
        self.link("sky_ny.png")
        self.refuse(["capture", "cube", "--pass", "Cube A", "-o", "sky_{}.png"], "sky_ny.png")

    def test_a_link_named_on_the_command_line_is_followed(self):
        self.link("own.png", "target.png")
        self.succeed("capture", "a.glsl", *SMALL, "-o", "own.png")
        self.assertTrue((self.folder / "own.png").is_symlink())
        self.assertEqual(png.read(self.folder / "target.png").width, 16)
        self.link("disk", self.folder / "far")
        (self.folder / "far").mkdir()
        self.succeed("capture", "a.glsl", *SMALL, "-o", "disk/b.png")
        self.succeed("study", "knob.glsl", *STUDY, "-o", "disk")
        self.assertTrue((self.folder / "far" / "report.html").exists())

    def test_study(self):
        self.link("knob-study", self.elsewhere)
        path = "knob-study/study.json"
        done = self.run_program("study", "knob.glsl", *STUDY)
        self.assertEqual(done.returncode, 4)
        self.assertIn("'knob-study'", done.stderr)
        (self.folder / "knob-study").unlink()
        names = ["points.csv", "study.json", "report.html", "maps/reference.png"]
        for name in names:
            with self.subTest(name):
                self.link(f"knob-study/{name}")
                self.refuse(["study", "knob.glsl", *STUDY], f"knob-study/{name}")
                shutil.rmtree(self.folder / "knob-study")
        self.link("knob-study/maps", self.elsewhere)
        done = self.run_program("study", "knob.glsl", *STUDY)
        self.assertEqual(done.returncode, 4)
        self.assertIn("'knob-study/maps'", done.stderr)

    def test_check(self):
        self.link("shots/times.png")
        self.refuse(["check", "broken.glsl", "--probe", "times", "-o", "shots"], "shots/times.png")

    def test_import(self):
        project = {"ver": "0.1", "info": {"id": "x", "name": "x"},
                   "renderpass": [{"name": "Image", "type": "image", "code": PLAIN, "inputs": [],
                                   "outputs": [{"id": 37, "channel": 0}]}]}
        self.write("x.json", json.dumps(project))
        self.link("x", self.elsewhere)
        done = self.run_program("import", "x.json")
        self.assertEqual(done.returncode, 4)
        self.assertIn(f"cannot write 'x': it is a link to '{self.elsewhere}'", done.stderr)
        (self.folder / "x").unlink()
        for name in ("image.glsl", "scene.json", ".tidemark-import"):
            with self.subTest(name):
                self.link(f"x/{name}")
                self.refuse(["import", "x.json", "--force"], f"x/{name}")
                shutil.rmtree(self.folder / "x")

    def test_bake(self):
        self.link("noise.png")
        self.refuse(["bake", "noise"], "noise.png")

    def test_temporary_names_are_not_followed(self):
        """Nor is the name of a file under construction, which anybody may guess."""
        for process in range(os.getpid(), os.getpid() + 400):
            for i in range(1, 4):
                self.link(f".b.part-{process}-{i}.png")
        self.succeed("capture", "a.glsl", *SMALL, "-o", "b.png")
        self.assertEqual(png.read(self.folder / "b.png").width, 16)


class ReadAndWritten(ProgramTest):
    def refuse(self, arguments: list[str], path: str) -> None:
        before = {name: (self.folder / name).read_bytes() for name in self.files()}
        done = self.run_program(*arguments)
        self.assertIn(f"tidemark: error: cannot write '{path}': this command reads that file", done.stderr.splitlines()[-1])
        self.assertEqual(done.returncode, 4)
        self.assertEqual({name: (self.folder / name).read_bytes() for name in self.files()}, before)

    def picture(self, name: str) -> None:
        self.write("plain.glsl", PLAIN)
        self.succeed("capture", "plain.glsl", *SMALL, "-o", name)

    def test_picture_read_by_the_scene(self):
        self.picture("a.png")
        self.picture("tex7.png")
        for channel in ("a.png", "./a.png"):
            self.write("a.glsl", f'#iChannel0 "{channel}"\n#iChannel1 "tex7.png"\n' + PLAIN)
            self.refuse(["capture", "a.glsl", *SMALL], "a.png")
            self.refuse(["capture", "a.glsl", *SMALL, "-o", "a.png"], "a.png")
        self.refuse(["capture", "a.glsl", *SMALL, "--frames", "0-9", "-o", "tex%d.png"], "tex7.png")
        (self.folder / "link.png").symlink_to("a.png")
        self.refuse(["capture", "a.glsl", *SMALL, "-o", "link.png"], "link.png")
        self.refuse(["capture", "plain.glsl", *SMALL, "--channel", "0=a.png", "-o", "a.png"], "a.png")
        self.succeed("capture", "a.glsl", *SMALL, "-o", "b.png")

    def test_a_mask_in_an_include(self):
        self.picture("a.png")
        self.write("part.glsl", '#iChannel0 "a.png"\n')
        self.write("a.glsl", '#include "part.glsl"\n' + PLAIN)
        self.refuse(["capture", "a.glsl", *SMALL], "a.png")

    def test_scene_and_project(self):
        self.write("a.glsl", PLAIN)
        self.refuse(["export", "a.glsl", "-o", "a.glsl"], "a.glsl")
        self.write("x.json", json.dumps({"Shader": {"info": {"name": "x"}, "renderpass": [
            {"name": "Image", "type": "image", "code": PLAIN, "inputs": [], "outputs": [{"id": 37, "channel": 0}]}]}}))
        self.succeed("import", "x.json")
        self.refuse(["export", "x", "-o", "x/scene.json"], "x/scene.json")
        self.refuse(["export", "x", "-o", "x/image.glsl"], "x/image.glsl")
        self.succeed("export", "x", "-o", "x/whole.json")
        self.succeed("export", "x", "-o", "x/whole.json")

    def test_import_of_a_project_in_its_own_folder(self):
        self.write("x/scene.json", json.dumps({"Shader": {"info": {"name": "x"}, "renderpass": [
            {"name": "Image", "type": "image", "code": PLAIN, "inputs": [], "outputs": [{"id": 37, "channel": 0}]}]}}))
        self.refuse(["import", "x/scene.json", "-o", "x", "--force"], "x/scene.json")

    def test_compare(self):
        self.picture("a.png")
        self.picture("b.png")
        self.refuse(["compare", "a.png", "b.png", "-o", "a.png"], "a.png")
        self.refuse(["compare", "a.png", "b.png", "-o", "./b.png"], "./b.png")

    def test_study(self):
        self.write("folder/image.glsl", KNOB)
        self.write("folder/study.json", json.dumps({"series": [{"name": "s", "vary": {"level": [0.2, 0.4]}}]}))
        self.refuse(["study", "folder", "-o", "folder"], "folder/study.json")

    def test_sound(self):
        self.write("s/image.glsl", PLAIN)
        self.write("s/sound.glsl", SOUND)
        self.succeed("capture", "s", "--duration", "0.1", "-o", "a.wav")
        self.write("s/image.glsl", '#iChannel0 "a.wav"\n' + PLAIN)
        shutil.copy(self.folder / "a.wav", self.folder / "s/a.wav")
        self.refuse(["capture", "s", "--duration", "0.1", "-o", "s/a.wav"], "s/a.wav")


class Streams(ProgramTest):
    """A device or a pipe takes what a file would hold, and stays what it is."""

    def setUp(self):
        super().setUp()
        self.write("a.glsl", PLAIN)

    def through_pipe(self, name: str, *options: str) -> bytes:
        os.mkfifo(self.folder / name)
        taken = []
        reader = threading.Thread(target=lambda: taken.append((self.folder / name).read_bytes()))
        reader.start()
        self.succeed("capture", "a.glsl", *SMALL, "-o", name, *options)
        reader.join()
        self.assertTrue(stat.S_ISFIFO((self.folder / name).stat().st_mode))
        return taken[0]

    def test_pipes(self):
        self.succeed("capture", "a.glsl", *SMALL, "-o", "file.png", "--tile", "8")
        for name, options in (("whole.png", ()), ("tiles.png", ("--tile", "8"))):
            with self.subTest(name):
                self.write("piped.png", self.through_pipe(name, *options))
                self.assertEqual(png.read(self.folder / "piped.png").rows, png.read(self.folder / "file.png").rows)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_video_into_a_pipe(self):
        film = self.through_pipe("film.mp4", "--frames", "0-3")
        self.assertEqual(film[4:8], b"ftyp")

    def test_pipe_without_a_reader(self):
        os.mkfifo(self.folder / "p.png")
        done = self.run_program("capture", "a.glsl", *SMALL, "-o", "p.png")
        self.assertRegex(done.stderr, r"\Atidemark: error: cannot write 'p\.png': .* 10 s\n\Z")
        self.assertEqual(done.returncode, 4)

    def test_devices(self):
        for name in ("n.png", "n.exr", "n.mp4", "n.webm", "n.gif"):
            with self.subTest(name):
                if not name.endswith((".png", ".exr")) and not shutil.which("ffmpeg"):
                    continue
                (self.folder / name).symlink_to("/dev/null")
                self.succeed("capture", "a.glsl", *SMALL, "--fps", "50", "--frame", "0", "-o", name)
                self.assertTrue((self.folder / name).is_symlink())
        self.succeed("capture", "a.glsl", *SMALL, "-o", "n.png", "--tile", "8")
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/null").st_mode))
        (self.folder / "full.png").symlink_to("/dev/full")
        self.expect_error(["capture", "a.glsl", *SMALL, "-o", "full.png", "--tile", "8"], 4,
                          "'full.png'", "No space left on device")

    def test_standard_output_by_its_names(self):
        wanted = self.succeed("export", "a.glsl").stdout
        for name in ("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):
            with self.subTest(name):
                self.assertEqual(self.succeed("export", "a.glsl", "-o", name).stdout, wanted)
                with (self.folder / "all.txt").open("wb") as file:
                    file.write(b"before\n")
                    file.flush()
                    self.succeed("export", "a.glsl", "-o", name, stdout=file)
                self.assertEqual((self.folder / "all.txt").read_bytes(), b"before\n" + wanted)
        (self.folder / "o.png").symlink_to("/dev/stdout")
        picture = self.succeed("capture", "a.glsl", *SMALL, "-o", "o.png").stdout
        self.assertTrue(picture.startswith(b"\x89PNG"))


if __name__ == "__main__":
    main()
