"""`tidemark new`: each scene draws, passes every probe of `check`, and is never written over another."""
import json

from support import png
from support.program import ProgramTest, main

FOLDERS = {"--buffers": {"common.glsl", "buffer_a.glsl", "image.glsl"},
           "--sound": {"common.glsl", "sound.glsl", "image.glsl"}}
KINDS = ("", "--orbit", "--march", *FOLDERS)


class Written(ProgramTest):
    def make(self, kind: str, name: str = "waves") -> str:
        """The scene's path."""
        done = self.succeed("new", name, "--json", *([kind] if kind else []))
        report = json.loads(done.stdout)
        self.assertEqual(done.stderr.splitlines()[:-1], [f"wrote {file}" for file in report["files"]])
        self.assertEqual(done.stderr.splitlines()[-1], f"open it with: tidemark {report['scene']}")
        return report["scene"]

    def test_draws_and_has_a_picture(self) -> None:
        for kind in KINDS:
            with self.subTest(kind):
                scene = self.make(kind, "waves" + kind)
                self.succeed("capture", scene, "--size", "96x54", "--time", "2", "-o", "picture.png")
                rows = png.read(self.folder / "picture.png").rows
                self.assertGreater(len({row[i:i + 3] for row in rows for i in range(0, len(row), 3)}), 20)

    def test_passes_every_probe(self) -> None:
        for kind in KINDS:
            with self.subTest(kind):
                scene = self.make(kind, "checked" + kind)
                done = self.succeed("check", scene, "--json", "--budget", "900")
                verdicts = {probe["probe"]: probe["verdict"] for probe in json.loads(done.stdout)["probes"]}
                self.assertLessEqual(set(verdicts.values()), {"pass", "n/a"}, verdicts)

    def test_passes_the_portability_check(self) -> None:
        for kind in ("", "--march", *FOLDERS):
            with self.subTest(kind):
                self.succeed("check", "--portable", self.make(kind, "site" + kind))

    def test_sound_template_is_audible(self) -> None:
        self.make("--sound")
        self.succeed("capture", "waves", "-o", "tune.wav", "--duration", "2")
        samples = (self.folder / "tune.wav").read_bytes()[44:]
        self.assertGreater(max(samples[1::2]), 0)


class Named(ProgramTest):
    def test_a_file_with_its_ending_or_without(self) -> None:
        for name, file in (("a", "a.glsl"), ("b.glsl", "b.glsl"), ("c.frag", "c.frag"), ("v1.2", "v1.2.glsl")):
            self.succeed("new", name)
            self.assertTrue((self.folder / file).is_file(), file)

    def test_a_folder_of_passes(self) -> None:
        for kind, files in FOLDERS.items():
            self.succeed("new", kind[2:], kind)
            self.assertEqual({file.name for file in (self.folder / kind[2:]).iterdir()}, files)

    def test_a_folder_with_a_slash_at_its_end(self) -> None:
        self.succeed("new", "pond/", "--buffers")
        self.assertTrue((self.folder / "pond/image.glsl").is_file())
        self.expect_error(["new", "pond/"], 2, "'pond/'", "not a name")

    def test_existing_files_are_kept(self) -> None:
        self.write("a.glsl", "mine")
        self.write("b/mine.txt", "mine")
        (self.folder / "c.glsl").symlink_to("elsewhere.glsl")
        for name, arguments in (("a.glsl", ["a"]), ("b", ["b", "--buffers"]), ("c.glsl", ["c"])):
            self.expect_failure(["new", *arguments], 4,
                                f"tidemark: error: '{name}' already exists: give another name")

    def test_usage(self) -> None:
        self.expect_failure(["new"], 2, "tidemark: error: new: NAME is required")
        self.expect_error(["new", ""], 2, "''", "not a name")
        self.expect_error(["new", "a", "--orbit", "--sound"], 2, "--orbit", "--sound")
        self.expect_error(["new", "none/a"], 4, "'none/a.glsl'", "No such file or directory")


if __name__ == "__main__":
    main()
