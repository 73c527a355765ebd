"""The comparison can fail: programs that change one thing in what another program does are found, and an honest one is not.

PYTHONPATH=tests python3 tests/freeze/compare_test.py; TIDEMARK=PROGRAM for another program.
"""
import pathlib
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

from support.program import PROGRAM, has_context

COMPARE = pathlib.Path(__file__).resolve().parent / "compare"
# A program that runs the real one and then changes what it printed and wrote, as FAULT says.
WRAPPER = '''#!{python}
import pathlib, subprocess, sys
sys.dont_write_bytecode = True
sys.path.insert(0, {tests!r})
words = sys.argv[1:]
done = subprocess.run([{program!r}, *words], capture_output=True)
out, err, code = done.stdout, done.stderr, done.returncode
{fault}
sys.stdout.buffer.write(out)
sys.stderr.buffer.write(err)
sys.exit(code)
'''
ONE_SAMPLE_OF_A_PNG = '''
from support import png
for path in pathlib.Path(".").glob("*.png"):
    picture = png.read(path)
    rows = [bytearray(row) for row in picture.rows]
    rows[3][5] ^= 1
    path.write_bytes(png.encode(picture.width, picture.height, picture.channels, [bytes(row) for row in rows]))
'''
ONE_SAMPLE_OF_AN_EXR = '''
if "--layers" in words:
    words = [word.replace("layers_", "other_") for word in words] + ["--fps", "7"]
    subprocess.run([{program!r}, *words], capture_output=True)
    for path in pathlib.Path(".").glob("other_*.exr"):
        path.rename(path.name.replace("other_", "layers_"))
'''


class Compare(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tidemark-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def program(self, fault: str) -> pathlib.Path:
        path = self.folder / "program"
        fault = fault.replace("{program!r}", repr(PROGRAM))
        path.write_text(WRAPPER.format(python=sys.executable, tests=str(COMPARE.parent.parent), program=PROGRAM, fault=fault))
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path

    def compare(self, fault: str, *options: str) -> tuple[int, str]:
        done = subprocess.run([COMPARE, PROGRAM, self.program(fault), "--jobs", "1", *options], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    def expect_same(self, fault: str, *options: str) -> None:
        code, said = self.compare(fault, *options)
        self.assertEqual(code, 0, said)
        self.assertIn("same", said.splitlines())

    def expect_difference(self, fault: str, options: list[str], *words: str) -> None:
        code, said = self.compare(fault, *options)
        self.assertEqual(code, 1, said)
        for word in words:
            self.assertIn(word, said)

    def test_identical_programs_are_the_same(self) -> None:
        self.expect_same("", "--match", "trace")
        self.expect_same("", "--only", "pages", "--match", "ripples")

    def test_changed_sample_of_a_picture(self) -> None:
        self.expect_difference(ONE_SAMPLE_OF_A_PNG, ["--only", "pictures", "--match", "examples/ripples"], "frame_0.png", "sha256")

    def test_changed_pass_of_a_scene(self) -> None:
        self.expect_difference(ONE_SAMPLE_OF_AN_EXR, ["--only", "pictures", "--match", "time_is_frame_over_fps"], "frame 30, Image", "sha256")

    def test_changed_word(self) -> None:
        fault = 'err = err.replace(b"wrote", b"made")'
        options = ["--only", "commands", "--match", "compare"]
        self.expect_difference(fault, options, "- wrote a.png", "+ made a.png")
        self.expect_same(fault, *options, "--wording")

    def test_changed_number_or_place_despite_rewording(self) -> None:
        options = ["--only", "commands", "--match", "compare", "--wording"]
        self.expect_difference('out = out.replace(b"32x18", b"33x18").replace(b"PSNR ", b"PSNR 1")', options, "standard output")
        self.expect_difference('err = err.replace(b".glsl:9", b".glsl:8"); out = out.replace(b".glsl:9", b".glsl:8")',
                               ["--only", "commands", "--match", "check and cure", "--wording"], "foam.glsl:8")

    def test_changed_exit_code(self) -> None:
        self.expect_difference("code = 2 if code == 1 else code", ["--only", "commands", "--match", "compare"], "exit code")

    def test_missing_key_of_json(self) -> None:
        for options in ([], ["--wording"]):
            self.expect_difference("""out = out.replace(b'"psnr', b'"peak')""",
                                   ["--only", "commands", "--match", "compare", *options], "peak")

    def test_missing_file(self) -> None:
        self.expect_difference('pathlib.Path("d.png").unlink(missing_ok=True)', ["--only", "commands", "--match", "compare"],
                               "file d.png: only the old program has it")

    def test_changed_byte_of_a_page(self) -> None:
        self.expect_difference('for path in pathlib.Path(".").glob("page.html"): path.write_bytes(path.read_bytes() + b" ")',
                               ["--only", "pages", "--match", "ripples"], "page.html")

    def test_usage(self) -> None:
        self.assertEqual(subprocess.run([COMPARE, PROGRAM, "nothing"], capture_output=True).returncode, 2)
        self.assertEqual(self.compare("", "--match", "no such item")[0], 2)


if __name__ == "__main__":
    if not has_context():
        print("skipped: no OpenGL context")
        sys.exit(77)
    unittest.main()
