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

# The renderer that made the pictures. It rounds sines and powers in its own way, and differently on another processor:
# a crest may then lie a step further, so a few pixels may be quite different as long as the picture is the same.
# At least 40 dB, and at most 1 % of the pixels with a channel that differs by more than 16 of 255.
RENDERER = "llvmpipe"
STEP = str(16.5 / 255)
LIMITS = ["--min-psnr", "40", "--tolerance", STEP, "--max-differing", "1"]
# For any other renderer FLIP is limited: it models what a person sees who flips between two pictures. The largest that an
# NVIDIA H100 had is 0.033.
# A picture that is moved by a row has 0.05 to 0.20, one that is darker by a twentieth 0.16 or more. FLIP is a mean:
# pixels that are quite different are counted apart.
LIMITS_ELSEWHERE = ["--max-flip", "0.04", "--tolerance", STEP, "--max-differing", "2"]


def limits_of(driver: str) -> list[str]:
    """`driver`: as the metadata of a picture has it."""
    return LIMITS if driver.startswith(RENDERER) else LIMITS_ELSEWHERE


class Comparison(ProgramTest):
    def compare(self, golden: pathlib.Path, actual: pathlib.Path, limits: list[str], *options: str):
        return self.run_program("compare", str(golden), str(actual), *limits, *options)


class Golden(Comparison):
    def check(self, scene: str, view: str) -> None:
        actual, difference = self.folder / "actual.png", self.folder / "difference.png"
        self.succeed("capture", str(ROOT / "shaders" / f"{scene}.glsl"), "--size", "160x90",
                     *SCENES[scene][view], "-o", str(actual))
        golden = GOLDEN / scene / f"{view}.png"
        driver = png.read(actual).text["tidemark:Driver"]
        compared = self.compare(golden, actual, limits_of(driver), "-o", str(difference))
        if compared.returncode == 0:
            return
        FAILED.mkdir(parents=True, exist_ok=True)
        for picture in (actual, difference):
            if picture.exists():
                shutil.copy(picture, FAILED / f"{scene}-{view}-{picture.name}")
        self.fail(f"{scene} {view} on {driver}: {compared.stderr}look at {FAILED}/{scene}-{view}-*.png")

    def test_every_picture_has_a_view(self):
        kept = {str(path.relative_to(GOLDEN)) for path in GOLDEN.glob("*/*.png")}
        self.assertEqual(kept, {f"{scene}/{view}.png" for scene, views in SCENES.items() for view in views})


def add_tests() -> None:
    for scene, views in SCENES.items():
        for view in views:
            setattr(Golden, f"test_{scene}_{view}", lambda self, s=scene, v=view: self.check(s, v))


class Threshold(Comparison):
    """The comparison itself: it lets a rounding pass and nothing that one sees."""

    LIMITS = LIMITS

    def judged(self, change, golden: pathlib.Path = GOLDEN / "water_surface" / "t2_mouse.png") -> int:
        picture = png.read(golden)
        rows = change([bytearray(row) for row in picture.rows])
        changed = self.write("changed.png", png.encode(picture.width, picture.height, 3, [bytes(row) for row in rows]))
        return self.compare(golden, changed, self.LIMITS).returncode

    @staticmethod
    def spoil(every: int):
        """A pixel in `every`."""
        def change(rows):
            for y, row in enumerate(rows):
                for x in range(y * 7 % every, 160, every):
                    row[3 * x:3 * x + 3] = bytes(3 * [(row[3 * x] + 128) % 256])
            return rows
        return change

    def test_a_rounding_passes(self):
        """Up or down, as another driver rounds."""
        self.assertEqual(self.judged(lambda rows: [[max(0, min(255, v + (x * 31 + y * 17) % 3 - 1)) for x, v in enumerate(row)]
                                                   for y, row in enumerate(rows)]), 0)

    def test_a_moved_picture_fails(self):
        for golden in GOLDEN.glob("*/t2.png"):
            self.assertEqual(self.judged(lambda rows: rows[1:] + rows[:1], golden), 1, golden)

    def test_a_darker_picture_fails(self):
        for golden in GOLDEN.glob("*/t2.png"):
            self.assertEqual(self.judged(lambda rows: [[v * 19 // 20 for v in row] for row in rows], golden), 1, golden)

    def test_some_percent_of_wrong_pixels_fail(self):
        self.assertEqual(self.judged(self.spoil(25)), 1)


class ThresholdOfOtherRenderers(Threshold):
    LIMITS = LIMITS_ELSEWHERE

    def test_the_renderer_selects_the_threshold(self):
        self.assertEqual(limits_of("llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6"), LIMITS)
        self.assertEqual(limits_of("NVIDIA H200/PCIe/SSE2, OpenGL 4.6.0 NVIDIA 570.86"), LIMITS_ELSEWHERE)

    def test_a_few_displaced_pixels_pass(self):
        """As many as another way of rounding moves: 0.6 %, quite different ones."""
        self.assertEqual(self.judged(self.spoil(160)), 0)


add_tests()

if __name__ == "__main__":
    main()
