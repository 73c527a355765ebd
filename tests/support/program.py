"""Runs the program under test and says what it did. The program is $TIDEMARK, else the release build."""
from __future__ import annotations

import contextlib
import functools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAM = os.environ.get("TIDEMARK", str(ROOT / "build" / "release" / "tidemark"))
BAKE = os.environ.get("TIDEMARK_BAKE", str(pathlib.Path(PROGRAM).parent / "tidemark_bake"))  # that of shaders/bake
STATE = tempfile.TemporaryDirectory(prefix="tidemark-state-")  # what windows remember: nothing of the person's own
SKIPPED = 77  # CTest's SKIP_RETURN_CODE

# Long enough for a sanitized program on a busy machine; a test that runs into it hangs.
TIME_LIMIT = 300

# Lines that a command prints when it takes long, which a busy machine decides.
BUSY = re.compile(r"^(\d+/\d+ .*, (at most )?\d+ s left|still .* after \d+ s; .*|times of .* the machine was busy)\n",
                  re.MULTILINE)


def environment(**changes: str | None) -> dict[str, str]:
    """The environment of a script with no display. A change to None removes the variable."""
    variables = dict(os.environ, DISPLAY="", WAYLAND_DISPLAY="", XDG_STATE_HOME=STATE.name)
    for name, value in changes.items():
        if value is None:
            variables.pop(name, None)
        else:
            variables[name] = value
    return variables


def let_it_crash() -> None:
    """A sanitized program that crashes ends by the signal, like any other, instead of a report."""
    for options in ("ASAN_OPTIONS", "TSAN_OPTIONS"):
        os.environ[options] = ":".join(filter(None, [
            os.environ.get(options), "handle_segv=0:handle_sigbus=0:handle_sigfpe=0:handle_sigill=0:handle_abort=0"]))


def is_sanitized() -> bool:
    binary = pathlib.Path(PROGRAM)
    code = binary.read_bytes() if binary.is_file() else b""
    return b"__asan_init" in code or b"__tsan_init" in code


def not_sanitized(test):
    """For tests of how much memory the program takes, or does with: a sanitizer needs some terabytes of addresses itself."""
    return unittest.skipIf(is_sanitized(), "the program is sanitized")(test)


@functools.cache
def driver() -> str:
    """What the program draws with: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6". It tries one
    device, where `inspect --devices` tries all."""
    scene = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n"
    facts = subprocess.run([PROGRAM, "inspect", "-"], input=scene, stdout=subprocess.PIPE, text=True, env=environment(),
                           timeout=TIME_LIMIT, check=True)
    return re.search(r"(?m)^  driver +(.*)$", facts.stdout)[1]


def has_mesa_22() -> bool:
    """Mesa 22.3 (Debian 12) crashes on some texts that 25.0 (Debian 13) compiles, and cuts loops off at 65,535 turns."""
    return "Mesa 22." in driver()


def has_context() -> bool:
    """Whether this machine has an OpenGL context without a window: draws one pixel. Only where that fails all devices are
    tried, which takes ten times as long. A yes holds for ten minutes, in a file of the build folder: each test asks."""
    drew = pathlib.Path(PROGRAM).with_name("CMakeFiles") / "drew_a_pixel"
    with contextlib.suppress(OSError):
        made = drew.stat().st_mtime
        if made > max(time.time() - 600, pathlib.Path(PROGRAM).stat().st_mtime):
            return True
    with tempfile.TemporaryDirectory(prefix="tidemark-context-") as folder:
        scene = pathlib.Path(folder) / "pixel.glsl"
        scene.write_text("void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        drawn = subprocess.run([PROGRAM, "capture", scene, "--size", "1x1", "-o", scene.with_suffix(".png")],
                               stderr=subprocess.DEVNULL, env=environment(), timeout=TIME_LIMIT)
    if drawn.returncode == 0:
        with contextlib.suppress(OSError):
            drew.touch()
        return True
    listed = subprocess.run([PROGRAM, "inspect", "--devices", "--json"], stdout=subprocess.PIPE,
                            env=environment(), timeout=TIME_LIMIT, check=True)
    return any("unusable" not in device for device in json.loads(listed.stdout)["devices"])


def main(needs_context: bool = True) -> None:
    """unittest.main for a file that CTest runs: says "skipped" where the machine cannot do it."""
    if needs_context and not has_context():
        print("skipped: no OpenGL context")
        sys.exit(SKIPPED)
    unittest.main()


class ProgramTest(unittest.TestCase):
    """Each test gets an empty folder, in which the program runs."""

    maxDiff = None

    def setUp(self) -> None:
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tidemark-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def write(self, name: str, content: str | bytes) -> pathlib.Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    def files(self) -> set[str]:
        """Everything in the folder, hidden temporary files included."""
        return {str(p.relative_to(self.folder)) for p in self.folder.rglob("*") if not p.is_dir()}

    def run_program(self, *arguments: str, program: str = PROGRAM, env: dict[str, str] | None = None, **options
                    ) -> subprocess.CompletedProcess:
        """stdout is bytes, stderr text, without the lines that a busy machine adds."""
        options.setdefault("stdout", subprocess.PIPE)
        done = subprocess.run([program, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, env=env or environment(), timeout=TIME_LIMIT, **options)
        done.stderr = BUSY.sub("", done.stderr.decode())
        return done

    def succeed(self, *arguments: str, **options) -> subprocess.CompletedProcess:
        done = self.run_program(*arguments, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def expect_failure(self, arguments: list[str], code: int, stderr: str, **options) -> None:
        """Fails with these very words, with nothing on standard output and no file made."""
        before = self.files()
        done = self.run_program(*arguments, **options)
        self.assertEqual(done.stderr, stderr + "\n")
        self.assertEqual(done.returncode, code)
        self.assertFalse(done.stdout)
        self.assertEqual(self.files(), before)

    def expect_error(self, arguments: list[str], code: int, *named: str, **options) -> None:
        """Fails with one error that names all this: options, files, places, values. Its wording is for tests/transcripts.
        Nothing is printed on standard output, and no file made."""
        before = self.files()
        done = self.run_program(*arguments, **options)
        for each in named:
            self.assertIn(each, done.stderr)
        self.assertRegex(done.stderr, r"\A.+\n(.+: note: .+\n)*\Z")
        self.assertEqual(done.returncode, code)
        self.assertFalse(done.stdout)
        self.assertEqual(self.files(), before)

    def expect_failure_like(self, arguments: list[str], code: int, pattern: str, **options) -> None:
        """As expect_failure, where the driver or the machine chooses some of the words."""
        before = self.files()
        done = self.run_program(*arguments, **options)
        self.assertRegex(done.stderr, rf"\A{pattern}\n\Z")
        self.assertEqual(done.returncode, code)
        self.assertFalse(done.stdout)
        self.assertEqual(self.files(), before)
