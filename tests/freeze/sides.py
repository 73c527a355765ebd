"""The two programs: a private copy of each, the folders it works in, and the environment it gets.

Both sides have folders of the same name length (`old`, `new`), so that a path takes the same room in a table or a wrapped line.
"""
from __future__ import annotations

import dataclasses
import os
import pathlib
import shutil
import signal
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
TIME_LIMIT = 120  # seconds for one command
TIMED_OUT = "timed out"


@dataclasses.dataclass
class Done:
    code: str  # the exit code, or TIMED_OUT
    stdout: bytes
    stderr: bytes


class Side:
    """One program. Its caches start empty; Mesa's cache of compiled shaders, which is keyed by their text, is shared."""

    def __init__(self, name: str, binary: pathlib.Path, base: pathlib.Path) -> None:
        self.name = name
        self.folder = base / name
        for part in ("cache", "state", "home", "tmp", "work"):
            (self.folder / part).mkdir(parents=True)
        self.binary = self.copy_of(binary.resolve())
        self.environment = dict(
            os.environ, DISPLAY="", WAYLAND_DISPLAY="", HOME=str(self.folder / "home"), TMPDIR=str(self.folder / "tmp"),
            XDG_CACHE_HOME=str(self.folder / "cache"), XDG_STATE_HOME=str(self.folder / "state"),
            MESA_SHADER_CACHE_DIR=str(base / "mesa"), LC_ALL="C.UTF-8", TZ="UTC")
        self.environment.pop("TIDEMARK_CACHE", None)

    def copy_of(self, binary: pathlib.Path) -> pathlib.Path:
        """Copies the program with the plug-ins beside it, so that a build during the run changes nothing.

        Returns the program where it is if there are no plug-ins beside it.
        """
        plugins = list(binary.parent.glob("tidemark_*.so"))
        if not plugins:
            return binary
        target = self.folder / "bin"
        target.mkdir()
        for file in [binary, *plugins]:
            shutil.copy2(file, target / file.name)
        return target / binary.name

    def fresh_folder(self, item: str) -> pathlib.Path:
        """Returns an empty folder for an item; an earlier one of that name is removed."""
        folder = self.folder / "work" / "".join(c if c.isalnum() or c in "-_." else "_" for c in item)
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        return folder

    def start(self, arguments: list[str], folder: pathlib.Path, **options) -> subprocess.Popen:
        return subprocess.Popen([str(self.binary), *arguments], cwd=folder, env=self.environment, start_new_session=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)

    def run(self, arguments: list[str], folder: pathlib.Path, stdin: bytes = b"") -> Done:
        process = self.start(arguments, folder, stdin=subprocess.PIPE)
        try:
            stdout, stderr = process.communicate(stdin, TIME_LIMIT)
            return Done(str(process.returncode), stdout, stderr)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return Done(TIMED_OUT, b"", b"")
