"""A screen of our own (Xvfb), the program's window on it, and a person in front of it (xdotool)."""
from __future__ import annotations

import ctypes
import os
import pathlib
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from typing import Any, Callable, TypeVar

from support import png, probe
from support.program import PROGRAM, SKIPPED, ProgramTest, environment, is_sanitized

T = TypeVar("T")

# Nothing here is timed: this is how long a slow machine may take before we call it broken.
PATIENCE = 300.0 if is_sanitized() else 180.0


def main() -> None:
    for tool in ("Xvfb", "xdotool"):
        if not shutil.which(tool):
            print(f"skipped: {tool} is not installed")
            sys.exit(SKIPPED)
    unittest.main()


OPEN_VIEWS: list[View] = []


def wait_for(condition: Callable[[], T], what: str, patience: float = PATIENCE) -> T:
    """What the condition gives once that is true. Where it waits in vain, it says what the windows show."""
    deadline = time.monotonic() + patience
    while True:
        if found := condition():
            return found
        if time.monotonic() > deadline:
            shown = [f"{view.scene} has the title {view.title()!r} and said:\n{view.stderr()}" for view in OPEN_VIEWS]
            raise AssertionError("\n".join([f"waited {patience:.0f} s in vain for {what}", *shown]))
        time.sleep(0.02)


# A window may be gone when it is asked for its name; Xlib would end this process.
IGNORE_ERRORS = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(lambda _display, _error: 0)


SCREEN_SIZE = "1280 800\n"  # of a screen, as xdotool says it


class Screen:
    """An X server that shows nothing to anybody. Its frame buffer is a file in XWD format."""

    def __init__(self) -> None:
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tidemark-screen-"))
        reader, writer = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", SCREEN_SIZE.strip().replace(" ", "x") + "x24", "-nolisten", "tcp", "-noreset", "-fbdir",
             str(self.folder)], pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as answer:
            self.display = f":{answer.readline().strip()}"
        if self.display == ":":
            raise AssertionError("Xvfb does not start")
        self.processes: dict[bool, subprocess.Popen] = {}
        self.x11, self.connection = self.open_display()
        self.x11.XGetWindowProperty.argtypes = [
            ctypes.c_void_p, ctypes.c_ulong, ctypes.c_ulong, ctypes.c_long, ctypes.c_long, ctypes.c_int, ctypes.c_ulong,
            *[ctypes.c_void_p] * 5]
        self.x11.XFree.argtypes = [ctypes.c_void_p]

    def close(self) -> None:
        if self.connection and self.server.poll() is None:  # Xlib would end this process
            self.x11.XCloseDisplay(self.connection)
        for process in self.processes.values():
            process.communicate()  # it ends with its input
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def variables(self) -> dict[str, str]:
        """Of a program whose windows are to be here."""
        return {"DISPLAY": self.display}

    def xdotool(self, *arguments: str) -> str:
        """What xdotool says; nothing where it fails (a window that is not there yet). Processes serve many calls, as a new one
        takes ten times as long as a key. One ends where a command fails; the next call starts another."""
        searches = arguments[0] == "search"  # a process of its own: where it finds a window, keys would be sent to that
        process = self.processes.get(searches)
        if not process or process.poll() is not None:
            process = self.processes[searches] = subprocess.Popen(
                ["xdotool", "-"], env=environment(DISPLAY=self.display), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL, text=True, bufsize=1)
        said = []
        try:
            process.stdin.write(" ".join(map(shlex.quote, arguments)) + "\ngetdisplaygeometry\n")
            while (line := process.stdout.readline()) != SCREEN_SIZE:
                if not line:
                    raise BrokenPipeError
                said.append(line)
        except BrokenPipeError:
            process.communicate()
            return ""
        return "".join(said).strip()

    def title(self, window: int) -> str:
        """The name of a window; empty if it is not there. It is read without a process, because tests wait for names."""
        for name in (b"_NET_WM_NAME", b"WM_NAME"):
            kind, size, count, rest = ctypes.c_ulong(), ctypes.c_int(), ctypes.c_ulong(), ctypes.c_ulong()
            data = ctypes.c_void_p()
            failed = self.x11.XGetWindowProperty(
                self.connection, window, self.x11.XInternAtom(self.connection, name, 0), 0, 4096, 0, 0, ctypes.byref(kind),
                ctypes.byref(size), ctypes.byref(count), ctypes.byref(rest), ctypes.byref(data))
            if failed or not data.value:
                continue
            text = ctypes.string_at(data.value, count.value)
            self.x11.XFree(data)
            if text:
                return text.decode(errors="replace").strip()
        return ""

    def place(self, window: int) -> dict[str, int]:
        """X, Y, WIDTH and HEIGHT of a window on the screen."""
        root, child = ctypes.c_ulong(), ctypes.c_ulong()
        x, y = ctypes.c_int(), ctypes.c_int()
        width, height, border, depth = (ctypes.c_uint() for _ in range(4))
        self.x11.XGetGeometry(self.connection, ctypes.c_ulong(window), *map(ctypes.byref, (root, x, y, width, height, border,
                                                                                          depth)))
        self.x11.XTranslateCoordinates(self.connection, ctypes.c_ulong(window), root, 0, 0,
                                       *map(ctypes.byref, (x, y, child)))
        return {"X": x.value, "Y": y.value, "WIDTH": width.value, "HEIGHT": height.value}

    def rows(self, left: int, top: int, width: int, height: int) -> list[bytes]:
        """RGB of a part of the screen, from the top row down."""
        with open(self.folder / "Xvfb_screen0", "rb") as file:
            header = struct.unpack(">25I", file.read(100))
            header_size, bits, stride, colours = header[0], header[11], header[12], header[19]
            assert bits == 32
            file.seek(header_size + 12 * colours + top * stride)
            read = file.read(height * stride)
        rows = []
        for y in range(height):
            start = y * stride + left * 4
            bgrx = read[start:start + width * 4]
            row = bytearray(3 * width)
            row[0::3], row[1::3], row[2::3] = bgrx[2::4], bgrx[1::4], bgrx[0::4]
            rows.append(bytes(row))
        return rows

    def open_display(self) -> tuple[ctypes.CDLL, ctypes.c_void_p]:
        x11 = ctypes.CDLL("libX11.so.6")
        x11.XOpenDisplay.argtypes = [ctypes.c_char_p]
        x11.XSetErrorHandler.argtypes = [ctypes.c_void_p]
        x11.XSetErrorHandler(IGNORE_ERRORS)
        x11.XOpenDisplay.restype = ctypes.c_void_p
        x11.XInternAtom.restype = x11.XDefaultRootWindow.restype = ctypes.c_ulong
        return x11, ctypes.c_void_p(x11.XOpenDisplay(self.display.encode()))

    def set_density(self, dots_per_inch: int) -> None:
        """For the windows that are opened from now on: 96 is ordinary. Programs read it where xrdb writes it."""
        resource_manager, string = 23, 31 # predefined atoms
        x11, display = self.open_display()
        text = f"Xft.dpi: {dots_per_inch}\n".encode()
        x11.XChangeProperty(display, ctypes.c_ulong(x11.XDefaultRootWindow(display)), ctypes.c_ulong(resource_manager),
                            ctypes.c_ulong(string), 8, 0, text, len(text))
        x11.XCloseDisplay(display)

    def drop(self, window: int, *files: pathlib.Path) -> None:
        """Drops files on a window, as a file manager does: the source's part of XDND, version 5."""
        x11, display = self.open_display()
        atom = lambda name: x11.XInternAtom(display, name, 0)
        x11.XCreateSimpleWindow.restype = ctypes.c_ulong
        source = x11.XCreateSimpleWindow(display, ctypes.c_ulong(x11.XDefaultRootWindow(display)), 0, 0, 1, 1, 0, 0, 0)
        selection, uris = atom(b"XdndSelection"), atom(b"text/uri-list")
        x11.XSetSelectionOwner(display, ctypes.c_ulong(selection), ctypes.c_ulong(source), ctypes.c_ulong(0))
        text = "".join(f"{file.as_uri()}\r\n" for file in files).encode()
        copy = atom(b"XdndActionCopy")
        for name, data in ((b"XdndEnter", (source, 5 << 24, uris)), (b"XdndPosition", (source, 0, 0, 0, copy)),
                           (b"XdndDrop", (source, 0, 0))):
            self.send(x11, display, window, atom(name), data)

        class Request(ctypes.Structure):
            _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                        ("display", ctypes.c_void_p), ("owner", ctypes.c_ulong), ("requestor", ctypes.c_ulong),
                        ("selection", ctypes.c_ulong), ("target", ctypes.c_ulong), ("property", ctypes.c_ulong),
                        ("time", ctypes.c_ulong), ("padding", ctypes.c_long * 24)]

        class Notify(ctypes.Structure):
            _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                        ("display", ctypes.c_void_p), ("requestor", ctypes.c_ulong), ("selection", ctypes.c_ulong),
                        ("target", ctypes.c_ulong), ("property", ctypes.c_ulong), ("time", ctypes.c_ulong),
                        ("padding", ctypes.c_long * 24)]

        request, selection_request, selection_notify = Request(), 30, 31
        wait_for(lambda: x11.XCheckTypedEvent(display, selection_request, ctypes.byref(request)), "the request for the files")
        x11.XChangeProperty(display, ctypes.c_ulong(request.requestor), ctypes.c_ulong(request.property), ctypes.c_ulong(uris),
                            8, 0, text, len(text))
        answer = Notify(type=selection_notify, requestor=request.requestor, selection=request.selection,
                        target=request.target, property=request.property, time=request.time)
        x11.XSendEvent(display, ctypes.c_ulong(request.requestor), 0, ctypes.c_long(0), ctypes.byref(answer))
        x11.XSync(display, 0)
        x11.XCloseDisplay(display)

    @staticmethod
    def send(x11: ctypes.CDLL, display: ctypes.c_void_p, window: int, kind: int, data: tuple[int, ...]) -> None:
        """Sends a ClientMessage of 32-bit numbers to a window."""
        class ClientMessage(ctypes.Structure):
            _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                        ("display", ctypes.c_void_p), ("window", ctypes.c_ulong), ("message_type", ctypes.c_ulong),
                        ("format", ctypes.c_int), ("data", ctypes.c_long * 5), ("padding", ctypes.c_long * 24)]

        event = ClientMessage(type=33, window=window, message_type=kind, format=32)
        event.data[:len(data)] = data
        x11.XSendEvent(display, ctypes.c_ulong(window), 0, ctypes.c_long(0), ctypes.byref(event))
        x11.XSync(display, 0)

    def ask_to_close(self, window: int) -> None:
        """As the button in a title bar does: WM_DELETE_WINDOW. xdotool has no word for that."""
        x11, display = self.open_display()
        atom = lambda name: x11.XInternAtom(display, name, 0)
        self.send(x11, display, window, atom(b"WM_PROTOCOLS"), (atom(b"WM_DELETE_WINDOW"),))
        x11.XCloseDisplay(display)


class View:
    """A running `tidemark view`."""

    save_key = "s"
    window = 0  # none yet

    def __init__(self, screen: Screen, folder: pathlib.Path, scene: str, *options: str,
                 first_title: str | None = " (fps|still)(, .*)?$", text: Any = subprocess.DEVNULL,
                 **variables: str) -> None:
        """Waits for the window and its title, unless that is None. `text`: the file that is standard input."""
        self.screen, self.folder, self.scene = screen, folder, pathlib.Path(scene)
        self.words = tempfile.NamedTemporaryFile(prefix="tidemark-words-")
        self.state = tempfile.TemporaryDirectory(prefix="tidemark-state-")  # each window starts anew
        variables.setdefault("XDG_STATE_HOME", self.state.name)
        variables.setdefault("TIDEMARK_MESSAGES", "off")  # tests compare pictures
        self.program = subprocess.Popen([PROGRAM, "view", scene, *options], cwd=folder, stdin=text,
                                        env=environment(**screen.variables(), **variables), stderr=self.words)
        OPEN_VIEWS.append(self)
        if first_title is not None:
            self.wait_for_window(first_title)

    def wait_for_window(self, first_title: str) -> None:
        # Its own: the window of a view that was killed is there for a moment yet.
        self.window = int(wait_for(lambda: self.running() and self.screen.xdotool(
            "search", "--all", "--onlyvisible", "--pid", str(self.program.pid), "--class", "tidemark"), "the window"))
        wait_for(lambda: self.running() and re.search(first_title, self.title()), "the first frame")
        self.point(5, 5)  # keys go to the window under the pointer

    def close(self) -> None:
        if self in OPEN_VIEWS:
            OPEN_VIEWS.remove(self)
        self.program.kill()
        self.program.wait()
        self.words.close()
        self.state.cleanup()

    def running(self) -> bool:
        if self.program.poll() is not None:
            raise AssertionError(f"the program ended with {self.program.returncode}: {self.stderr()}")
        return True

    def stderr(self) -> str:
        return pathlib.Path(self.words.name).read_text()

    def wait_for_words(self, pattern: str) -> re.Match:
        return wait_for(lambda: self.running() and re.search(pattern, self.stderr(), re.MULTILINE), pattern)

    def wait_for_end(self) -> int:
        wait_for(lambda: self.program.poll() is not None, "the end of the program")
        return self.program.returncode

    def title(self) -> str:
        return self.screen.title(self.window)

    def wait_for_title(self, pattern: str) -> re.Match:
        return wait_for(lambda: self.running() and re.search(pattern, self.title()), f"the title {pattern}")

    def place(self) -> dict[str, int]:
        """X, Y, WIDTH and HEIGHT of the window on the screen."""
        return self.screen.place(self.window)

    # What a person does

    def key(self, name: str) -> None:
        self.screen.xdotool("key", name)

    def quit(self) -> None:
        self.key("ctrl+q")

    def point(self, x: int, y: int) -> None:
        """Moves the pointer to a pixel, counted from the top left."""
        self.screen.xdotool("mousemove", "--window", str(self.window), str(x), str(y))

    def button(self, number: int, down: bool) -> None:
        self.screen.xdotool("mousedown" if down else "mouseup", str(number))

    def drag(self, start: tuple[int, int], end: tuple[int, int], number: int = 1) -> None:
        self.point(*start)
        self.button(number, True)
        self.point(*end)
        self.button(number, False)

    def pause(self) -> None:
        self.key("space")
        self.wait_for_title(r" - paused at ")

    def restart_paused(self) -> None:
        self.pause()
        self.key("Home")
        self.wait_for_title(r" - paused at 0\.000 s$")

    # What a person sees

    def save(self) -> pathlib.Path:
        """The file that the key for it makes. Pictures saved before are removed."""
        pattern = f"{self.scene.stem}-*.png"
        for old in self.folder.glob(pattern):
            old.unlink()
        self.key(self.save_key)
        return wait_for(lambda: self.running() and next(self.folder.glob(pattern), None), "the saved picture")

    def told(self, values: dict[str, str]) -> dict[str, float]:
        return probe.read(png.read(self.save()), values)

    def wait_until_told(self, values: dict[str, str], wanted: Callable[[dict[str, float]], bool]
                        ) -> dict[str, float]:
        """The values of a frame in which they are as wanted."""
        last: dict[str, float] = {}

        def asked() -> bool:
            nonlocal last
            last = self.told(values)
            return wanted(last)

        try:
            wait_for(asked, "the shader to tell what is wanted")
        except AssertionError as error:
            raise AssertionError(f"{error}; it tells {last}; stderr: {self.stderr()}") from None
        return last


class LiveTest(ProgramTest):
    """A test class with a screen; each test has a folder, and the views it opens are closed."""

    screen: Screen

    @classmethod
    def setUpClass(cls) -> None:
        cls.screen = Screen()
        cls.addClassCleanup(cls.screen.close)

    def view(self, scene: str, *options: str, **variables: str) -> View:
        opened = View(self.screen, self.folder, scene, *options, **variables)
        self.addCleanup(opened.close)
        return opened
