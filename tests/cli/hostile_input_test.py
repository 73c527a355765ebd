"""Scenes and files that mean harm, or nothing: one line each, a documented exit code, no signal, no hang."""
import json
import os
import struct

from support.program import ProgramTest, environment, main

GOOD = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / 8.0, 0.0, 1.0); }\n"
READS_CHANNEL = "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p); }\n"
DOCUMENTED = {0, 1, 2, 3, 4, 5, 77}


class Names(ProgramTest):
    """What a scene calls a file and no file is called."""

    def refused(self, directive: str, why: str) -> None:
        self.write("a.glsl", f"\n{directive}\n{GOOD}")
        for command in (["capture", "-o", "-"], ["inspect"], ["inspect", "--device", "none"], ["check", "--portable"],
                        ["export", "-o", "-"]):
            with self.subTest(command=command, directive=directive):
                self.expect_error([*command, "a.glsl"], 3, "a.glsl:2: error: ", why)

    def test_empty_include_name(self):
        self.refused('#include ""', '#include "" names no file')
        self.write("sub/b.glsl", '#include ""\n')
        self.write("a.glsl", '#include "sub/b.glsl"\n' + GOOD)
        self.expect_failure(["inspect", "a.glsl"], 3, 'sub/b.glsl:1: error: #include "" names no file\n'
                                                      "a.glsl:1: note: included from here")

    def test_include_of_a_folder(self):
        self.refused('#include "."', "cannot read '.': it is a directory")
        self.refused('#include "./"', "cannot read '.': it is a directory")
        outside = ("lies outside the scene's folder '.': move it there, into a folder 'textures' or 'lib' beside it, "
                   "or give --allow-outside")
        self.refused('#include ".."', f"'..' {outside}")
        self.refused('#include "/"', f"'/' {outside}")

    def test_too_long_names(self):
        name = "a" * 256
        self.refused(f'#include "{name}"', f"cannot read '{name}': File name too long")
        self.refused(f'#iChannel0 "{name}.png"', f"cannot read '{name}.png': File name too long")

    def test_circular_links(self):
        os.symlink("y.glsl", self.folder / "x.glsl")
        os.symlink("x.glsl", self.folder / "y.glsl")
        self.refused('#include "x.glsl"', "'x.glsl': Too many levels of symbolic links")
        os.symlink("round", self.folder / "round")
        self.refused('#iChannel0 "round/a.png"', "'round/a.png': Too many levels of symbolic links")
        self.expect_error(["capture", "x.glsl"], 3, "'x.glsl'", "symbolic links")

    def test_a_dangling_link_names_its_target(self):
        os.symlink("none.glsl", self.folder / "x.glsl")
        self.refused('#include "x.glsl"', "'x.glsl': it is a link to 'none.glsl'")
        self.expect_error(["capture", "x.glsl"], 3, "'x.glsl'", "is a link", "'none.glsl'")

    def test_names_with_invalid_utf8(self):
        self.write("a.glsl", b'#include "\xff\xfe"\n' + GOOD.encode())
        for command in ("capture", "inspect"):
            done = self.run_bytes(command, "a.glsl")
            self.assertEqual(done.returncode, 3)
            self.assertIn(b"a.glsl:1: error: cannot read '", done.stderr)

    def run_bytes(self, *arguments):
        import subprocess
        from support.program import PROGRAM
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, env=environment(), check=False, timeout=300)


class TooLarge(ProgramTest):
    """Refused by their size: a terabyte that is not there would take minutes to read."""

    def sparse(self, name: str) -> str:
        with open(self.folder / name, "wb") as file:
            file.truncate(1 << 40)
        return name

    def test_texts(self):
        for name in ("a.glsl", "a.json"):
            self.expect_failure(["capture", self.sparse(name)], 3,
                                f"tidemark: error: cannot read '{name}': it is larger than 16 MiB")
        self.expect_failure(["import", self.sparse("b.json")], 3,
                            "tidemark: error: cannot read 'b.json': it is larger than 16 MiB")

    def test_media(self):
        for name, place in (("a.png", "p"), ("a.wav", "p"), ("a.bin", "vec3(p, 0.0)")):
            self.sparse(name)
            self.write("a.glsl", f'#iChannel0 "{name}"\nvoid mainImage(out vec4 c, in vec2 p) '
                                 f"{{ c = texture(iChannel0, {place}); }}\n")
            with self.subTest(name=name):
                done = self.run_program("capture", "a.glsl", "--size", "4x4", "-o", "out.png")
                self.assertRegex(done.stderr, rf"cannot read '{name}': it is (larger than \d+ MiB|not a ShaderToy volume)")
                self.assertEqual(done.returncode, 3)


class OtherFiles(ProgramTest):
    """A scene reads what lies in its folder and nothing else."""

    def project(self, code: object, inputs: list | None = None) -> str:
        return json.dumps({"Shader": {"renderpass": [
            {"inputs": inputs or [], "outputs": [{"id": 37, "channel": 0}], "code": code, "name": "Image",
             "type": "image"}]}})

    def test_code_of_a_project_is_a_string(self):
        self.write("image.glsl", GOOD)
        self.write("other.glsl", GOOD)
        for name in ("image.glsl", "other.glsl", "../other.glsl"):
            self.write("a.json", self.project({"file": name}))
            for command in (["capture", "-o", "-"], ["inspect"], ["import", "-o", "folder"]):
                with self.subTest(name=name, command=command):
                    self.expect_error([*command, "a.json"], 3, "a.json: error:", "'Image'", f"'{name}'", "scene.json")
        for code in (5, None, [], {}, {"file": 5}, {"file": ["a"]}, True):
            self.write("a.json", self.project(code))
            with self.subTest(code=code):
                done = self.run_program("capture", "a.json", "--size", "4x4")
                self.assertRegex(done.stderr, r"\Aa\.json: error: (the pass 'Image' has no code|the code of .*)\n\Z")
                self.assertEqual(done.returncode, 3)

    def test_files_of_a_project_folder(self):
        self.write("secret.glsl", GOOD)
        for name in ("../secret.glsl", str(self.folder / "secret.glsl")):
            self.write("scene/scene.json", self.project({"file": name}))
            with self.subTest(name=name):
                done = self.run_program("capture", "scene", "--size", "4x4")
                self.assertIn("lies outside the scene's folder", done.stderr)
                self.assertEqual(done.returncode, 3)

    def test_inputs_of_a_project(self):
        self.succeed("bake", "noise", "-o", "secret.png")
        outside = str(self.folder / "secret.png")
        (self.folder / "scene").mkdir()
        for key in ("src", "filepath"):
            for name in ("../secret.png", outside, f"file://{outside}", "x/../../secret.png", "../secret.png\0.png",
                         "/media/../../secret.png"):
                self.write("scene/a.json", self.project(
                    READS_CHANNEL, [{"id": 1, key: name, "ctype": "texture", "channel": 0}]))
                with self.subTest(key=key, name=name):
                    done = self.run_program("inspect", "scene/a.json", "--device", "none", "--json")
                    if done.returncode == 0:  # looked up by name among the site's media, and not found
                        self.assertIn("replaces it", done.stderr)
                    else:
                        self.assertEqual(done.returncode, 3)
                        self.assertRegex(done.stderr, "lies outside the scene's folder|there is a zero byte in its")

    def test_companion_files_linked_out_of_the_folder_are_refused(self):
        self.write("elsewhere.json", "{}")
        self.write("scene/a.glsl", GOOD)
        for kind, command in (("study", ["study"]), ("check", ["check", "--budget", "1"])):
            os.symlink("../elsewhere.json", self.folder / f"scene/a.{kind}.json")
            done = self.run_program(*command, "scene/a.glsl")
            self.assertIn(f"'scene/a.{kind}.json' lies outside the scene's folder 'scene'", done.stderr)
            self.assertEqual(done.returncode, 3)


class Cache(ProgramTest):
    """Programs are kept from run to run where that is safe, and nobody hears of it where it is not."""

    def capture_in(self, **variables: str | None) -> None:
        self.write("a.glsl", GOOD)
        done = self.succeed("capture", "a.glsl", "--size", "4x4", env=environment(**variables))
        said = [line for line in done.stderr.splitlines() if not line.endswith("---disabling.")]  # the driver's own
        self.assertEqual(said, ["wrote a.png"])

    def test_unusable_cache_folders_are_ignored(self):
        self.write("file", "")
        (self.folder / "read-only").mkdir(mode=0o555)
        os.symlink("round", self.folder / "round")
        os.mkfifo(self.folder / "pipe")
        for place in ("none", "file", "read-only", "round", "pipe", "a" * 300):
            path = str(self.folder / place)
            for variables in ({"HOME": path, "XDG_CACHE_HOME": None}, {"XDG_CACHE_HOME": path},
                              {"HOME": place, "XDG_CACHE_HOME": None}, {"HOME": path, "XDG_CACHE_HOME": place}):
                with self.subTest(**variables):
                    self.capture_in(**variables)

    def test_foreign_files_in_place_of_the_cache_are_left_alone(self):
        programs = self.folder / "cache/tidemark/programs"
        self.capture_in(XDG_CACHE_HOME=str(self.folder / "cache"))
        if not programs.exists():
            self.skipTest("this driver has no form of its own for a program")
        entry, = programs.iterdir()
        self.assertEqual(programs.stat().st_mode & 0o777, 0o700)
        letter = self.write("letter", "somebody's")
        for plant in (lambda: os.mkfifo(entry), lambda: os.symlink(letter, entry), entry.mkdir):
            entry.unlink()
            plant()
            self.capture_in(XDG_CACHE_HOME=str(self.folder / "cache"))
            self.assertEqual(letter.read_text(), "somebody's")
            if entry.is_dir():
                entry.rmdir()
                entry.touch()


if __name__ == "__main__":
    main()
