"""The scenes look as they did when a person last looked. README.md: how to change a golden picture."""
import math
import unittest

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
SCENES = {"water_surface": VIEWS, "pseudo3d_water": VIEWS, "stylized_waves": TWO_CAMERAS}

# The same driver repeats every byte. Another one rounds sines and powers differently: a crest may then lie a
# step further, so a few pixels may be quite different as long as the picture is the same.
LEAST_PSNR = 40.0        # dB
LARGE_DIFFERENCE = 16    # of 255, in any channel of a pixel
MOST_LARGE_SHARE = 0.01  # of the pixels


def difference(left: png.Picture, right: png.Picture) -> list[bytes]:
    return [bytes(abs(a - b) for a, b in zip(r, s)) for r, s in zip(left.rows, right.rows)]


def psnr(rows: list[bytes]) -> float:
    total = sum(d * d for row in rows for d in row)
    if total == 0:
        return math.inf
    return 10 * math.log10(255 * 255 * sum(len(row) for row in rows) / total)


def large_share(rows: list[bytes]) -> float:
    pixels = [max(row[i:i + 3]) for row in rows for i in range(0, len(row), 3)]
    return sum(d > LARGE_DIFFERENCE for d in pixels) / len(pixels)


class Golden(ProgramTest):
    def keep(self, name: str, rows: list[bytes]) -> None:
        """Pixels alone: the program's own file says where this checkout lies."""
        FAILED.mkdir(parents=True, exist_ok=True)
        (FAILED / f"{name}.png").write_bytes(png.encode(len(rows[0]) // 3, len(rows), 3, rows))

    def check(self, scene: str, view: str) -> None:
        actual_file = self.folder / "actual.png"
        self.succeed("capture", str(ROOT / "shaders" / f"{scene}.glsl"), "--size", "160x90", *SCENES[scene][view],
                     "-o", str(actual_file))
        actual = png.read(actual_file)
        golden_file = GOLDEN / scene / f"{view}.png"
        if not golden_file.exists():
            self.keep(f"{scene}-{view}-actual", actual.rows)
            self.fail(f"{golden_file} does not exist; look at {FAILED}/{scene}-{view}-actual.png")
        golden = png.read(golden_file)
        self.assertEqual((actual.width, actual.height, actual.channels),
                         (golden.width, golden.height, golden.channels))
        rows = difference(actual, golden)
        if psnr(rows) >= LEAST_PSNR and large_share(rows) <= MOST_LARGE_SHARE:
            return
        self.keep(f"{scene}-{view}-actual", actual.rows)
        self.keep(f"{scene}-{view}-difference", [bytes(min(255, 8 * d) for d in row) for row in rows])
        self.fail(f"{scene} {view}: PSNR {psnr(rows):.1f} dB, {100 * large_share(rows):.2f} % of the pixels differ by "
                  f"more than {LARGE_DIFFERENCE}; look at {FAILED}/{scene}-{view}-*.png")

    def test_every_picture_has_a_view(self):
        kept = {str(path.relative_to(GOLDEN)) for path in GOLDEN.glob("*/*.png")}
        self.assertEqual(kept, {f"{scene}/{view}.png" for scene, views in SCENES.items() for view in views})


def add_tests() -> None:
    for scene, views in SCENES.items():
        for view in views:
            setattr(Golden, f"test_{scene}_{view}", lambda self, s=scene, v=view: self.check(s, v))


class Judgement(unittest.TestCase):
    """The comparison itself: it lets a rounding pass and nothing that one sees."""

    def test_equal_is_infinite(self):
        self.assertEqual(psnr([bytes(30)]), math.inf)

    def test_one_step_everywhere_is_48_decibels(self):
        self.assertAlmostEqual(psnr([b"\1" * 30] * 4), 20 * math.log10(255))

    def test_a_moved_picture_fails(self):
        picture = png.read(GOLDEN / "water_surface" / "t2_mouse.png")
        moved = png.Picture(picture.width, picture.height, 3, 8, picture.rows[1:] + picture.rows[:1])
        self.assertLess(psnr(difference(picture, moved)), LEAST_PSNR)

    def test_few_wrong_pixels_are_counted(self):
        self.assertAlmostEqual(large_share([b"\xff\0\0" * 2 + bytes(294)]), 0.02)


add_tests()

if __name__ == "__main__":
    main()
