"""`capture --sheet`: so many moments of a scene in one picture."""
import json
import signal
import subprocess
import time

from support import exr, png
from support.program import PROGRAM, ProgramTest, environment, main

SIZE = ("--size", "16x12")
GAP = 8
GREY = (32, 32, 32)
# The number of the frame in red, where in the cell one is in green and blue.
SCENE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(float(iFrame) / 255.0, p / iResolution.xy, 1.0); }\n"


class Sheet(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)

    def sheet(self, *options: str, scene: str = "a.glsl") -> png.Picture:
        self.succeed("capture", scene, *SIZE, "-o", "sheet.png", *options)
        return png.read(self.folder / "sheet.png")

    def cell(self, sheet: png.Picture, column: int, row: int) -> list[bytes]:
        """Its rows from the top."""
        left, top = column * (16 + GAP), row * (12 + GAP)
        step = sheet.channels * sheet.depth // 8
        return [line[left * step:(left + 16) * step] for line in sheet.rows[top:top + 12]]

    def expect_frames(self, sheet: png.Picture, columns: int, rows: int, frames: list[int], scene: str = "a.glsl") -> None:
        """From the top left, row by row, each cell is that frame captured alone; between them is grey."""
        self.assertEqual((sheet.width, sheet.height), (columns * 16 + (columns - 1) * GAP, rows * 12 + (rows - 1) * GAP))
        for number, frame in enumerate(frames):
            self.succeed("capture", scene, *SIZE, "--frame", str(frame), "-o", "one.png")
            alone = png.read(self.folder / "one.png")
            self.assertEqual(self.cell(sheet, number % columns, number // columns), alone.rows, (number, frame))
        for y in range(sheet.height):
            for x in range(sheet.width):
                if x % (16 + GAP) >= 16 or (sheet.height - 1 - y) % (12 + GAP) >= 12:
                    self.assertEqual(sheet.pixel(x, y), GREY, (x, y))
        self.assertEqual(sheet.text["tidemark:Frames"], ",".join(map(str, frames)))

    def test_evenly_spaced_frames_of_a_range(self):
        sheet = self.sheet("--sheet", "3x2", "--frames", "10-20", "--fps", "10")
        self.expect_frames(sheet, 3, 2, [10, 12, 14, 16, 18, 20])
        self.assertEqual((sheet.text["tidemark:Sheet"], sheet.text["tidemark:Times"]), ("3x2", "1,1.2,1.4,1.6,1.8,2"))
        self.assertEqual(sheet.text.keys() & {"tidemark:Moment", "tidemark:Frame", "tidemark:Fingerprint"}, set())

    def test_sheet_of_listed_frames(self):
        self.expect_frames(self.sheet("--sheet", "2x2", "--frames", "7,3,200,3"), 2, 2, [7, 3, 200, 3])

    def test_sheet_of_a_duration(self):
        self.expect_frames(self.sheet("--sheet", "4x1", "--duration", "2", "--fps", "10"), 4, 1, [0, 5, 10, 15])
        self.expect_frames(self.sheet("--sheet", "2x1", "--fps", "20"), 2, 1, [0, 100])

    def test_feedback_scene_is_stepped_through(self):
        self.write("s/image.glsl", '#iChannel0 "Buffer A"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n')
        self.write("s/buffer_a.glsl", '#iChannel0 "Buffer A"\nvoid mainImage(out vec4 c, in vec2 p) '
                                      "{ c = texelFetch(iChannel0, ivec2(p), 0) + 1.0 / 255.0; }\n")
        sheet = self.sheet("--sheet", "2x2", "--frames", "0-30", scene="s")
        self.expect_frames(sheet, 2, 2, [0, 10, 20, 30], scene="s")
        self.assertEqual(sheet.pixel(16 + GAP, 0), (31, 31, 31))

    def test_other_files_and_numbers(self):
        self.succeed("capture", "a.glsl", *SIZE, "--sheet", "2x1", "--frames", "0-9", "--depth", "float", "-o", "sheet.exr")
        part, = exr.read(self.folder / "sheet.exr")
        self.assertEqual(part.size, (40, 12))
        self.succeed("capture", "a.glsl", *SIZE, "--frame", "9", "--depth", "float", "-o", "one.exr")
        alone, = exr.read(self.folder / "one.exr")
        for y in range(12):
            row = slice(y * 40 + 24, y * 40 + 40)
            self.assertEqual(part.values("G")[row], alone.values("G")[y * 16:y * 16 + 16])
        sheet = self.sheet("--sheet", "2x1", "--frames", "0-9", "--alpha", "keep")
        self.assertEqual(sheet.pixel(20, 3), (*GREY, 255))
        self.succeed("capture", "a.glsl", *SIZE, "--sheet", "2x1", "--samples", "4", "-o", "s.jpg")

    def test_report(self):
        done = self.succeed("capture", "a.glsl", *SIZE, "--sheet", "2x1", "--frames", "0-9", "-o", "s.png", "--json")
        report = json.loads(done.stdout)
        self.assertEqual(report["sheet"], [2, 1])
        self.assertEqual([(frame["frame"], frame["file"]) for frame in report["frames"]], [(0, "s.png"), (9, "s.png")])
        done = self.succeed("capture", "a.glsl", *SIZE, "--sheet", "2x1", "--frames", "0-9", "-o", "s.png")
        self.assertEqual(done.stderr, "wrote s.png: 2 moments, frames 0 to 9\n")
        self.expect_error(["capture", "--like", "s.png", "-o", "t.png"], 2,
                          "--like s.png", "no record", "`tidemark capture`")

    def test_interrupted_leaves_nothing(self):
        self.write("s/image.glsl", '#iChannel0 "Buffer A"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n')
        self.write("s/buffer_a.glsl", '#iChannel0 "Buffer A"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0) + 1.0; }\n')
        before = self.files()
        program = subprocess.Popen([PROGRAM, "capture", "s", *SIZE, "--sheet", "2x1", "--frames", "0,10000000", "-o", "s.png"],
                                   cwd=self.folder, stderr=subprocess.PIPE, env=environment())
        time.sleep(1)  # or whenever: what is left is the same
        program.send_signal(signal.SIGINT)
        words = program.communicate(timeout=60)[1].decode()
        self.assertEqual(program.returncode, 130)
        self.assertNotIn("wrote", words)
        self.assertEqual(self.files(), before)

    def test_refused(self):
        def refused(words: str, *options: str) -> None:
            self.expect_error(["capture", "a.glsl", *options], 2, f"--sheet{words}")

        for text in ("5", "5x", "0x4", "5x4x3", "-1x2", "99999x99999"):
            refused(f" {text}: give columns and rows", f"--sheet={text}")
        refused(": --frame and --time name one moment: give --frames or --duration", "--sheet", "2x2", "--frame", "3")
        refused(": 2x2 cells need 4 frames, but --frames names 3", "--sheet", "2x2", "--frames", "0-2")
        refused(": give either --frames or --duration", "--sheet", "2x2", "--frames", "0-9", "--duration", "3")
        refused(": 0.05 s at 60 frames per second cannot give 4 moments", "--sheet", "2x2", "--duration", "0.05")
        for name in ("a.mp4", "-", "a_{}.png"):
            refused(": the sheet is one picture", "--sheet", "2x2", "-o", name)
        refused(": the sheet would have 19232x2168 pixels: give a smaller --size, or fewer cells", "--sheet", "5x2", "--size", "3840x1080")


if __name__ == "__main__":
    main()
