"""The scenes look as they did when a person last looked. README.md: how to change a golden picture."""
import pathlib
import shutil

from support import png
from support.program import ROOT, ProgramTest, main

GOLDEN = ROOT / "tests" / "golden"
FAILED = ROOT / "build" / "golden-failed"

VIEWS = {
    "t2": ["--time", "2"],
    "t40": ["--time", "40"],
    "t2_mouse": ["--time", "2", "--mouse", "120,36"],
    "t40_mouse": ["--time", "40", "--mouse", "60,35"],
}
TWO_CAMERAS = {
    "t2": ["--time", "2"],
    "t40": ["--time", "40"],
    "t2_top": ["--time", "2", "--define", "TOP_VIEW=1"],
    "t40_top": ["--time", "40", "--define", "TOP_VIEW=1"],
}
SCENES = {
    "water_surface": VIEWS,
    "pseudo3d_water": VIEWS,
    "procedural_ocean": VIEWS,
    "gerstner_waves": VIEWS,
    "stylized_waves": TWO_CAMERAS,
}

# The same driver repeats every byte. Another one rounds sines and powers differently: a crest may then lie a
# step further, so a few pixels may be quite different as long as the picture is the same.
# At least 40 dB, and at most 1 % of the pixels with a channel that differs by more than 16 of 255.
LIMITS = ["--min-psnr", "40", "--tolerance", str(16.5 / 255), "--max-differing", "1"]


class Comparison(ProgramTest):
    def compare(self, golden: pathlib.Path, actual: pathlib.Path, *options: str):
        return self.run_program("compare", str(golden), str(actual), *LIMITS, *options)


class Golden(Comparison):
    def check(self, scene: str, view: str) -> None:
        actual, difference = self.folder / "actual.png", self.folder / "difference.png"
        self.succeed("capture", str(ROOT / "shaders" / f"{scene}.glsl"), "--size", "160x90",
                     *SCENES[scene][view], "-o", str(actual))
        golden = GOLDEN / scene / f"{view}.png"
        compared = self.compare(golden, actual, "-o", str(difference))
        if compared.returncode == 0:
            return
        FAILED.mkdir(parents=True, exist_ok=True)
        for picture in (actual, difference):
            if picture.exists():
                shutil.copy(picture, FAILED / f"{scene}-{view}-{picture.name}")
        self.fail(f"{scene} {view}: {compared.stderr}look at {FAILED}/{scene}-{view}-*.png")

    def test_every_picture_has_a_view(self):
        kept = {str(path.relative_to(GOLDEN)) for path in GOLDEN.glob("*/*.png")}
        self.assertEqual(kept, {f"{scene}/{view}.png" for scene, views in SCENES.items() for view in views})


def add_tests() -> None:
    for scene, views in SCENES.items():
        for view in views:
            setattr(Golden, f"test_{scene}_{view}", lambda self, s=scene, v=view: self.check(s, v))


class Judgement(Comparison):
    """The comparison itself: it lets a rounding pass and nothing that one sees."""

    def judged(self, change) -> int:
        picture = png.read(GOLDEN / "water_surface" / "t2_mouse.png")
        rows = change([bytearray(row) for row in picture.rows])
        changed = self.write("changed.png", png.encode(picture.width, picture.height, 3, [bytes(row) for row in rows]))
        return self.compare(GOLDEN / "water_surface" / "t2_mouse.png", changed).returncode

    def test_a_rounding_passes(self):
        self.assertEqual(self.judged(lambda rows: [[min(255, v + 1) for v in row] for row in rows]), 0)

    def test_a_moved_picture_fails(self):
        self.assertEqual(self.judged(lambda rows: rows[1:] + rows[:1]), 1)

    def test_two_percent_of_the_pixels_wrong_fail(self):
        def spoil(rows):
            for row in rows[::10]:
                row[0:3 * 160:15] = bytes(32)
            return rows
        self.assertEqual(self.judged(spoil), 1)


add_tests()

if __name__ == "__main__":
    main()
