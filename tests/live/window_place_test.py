"""Where the window opens and how it stands to others: what is typed, what is remembered, what no monitor shows."""
import ctypes
import shutil
import subprocess
import unittest

from support import probe
from support.live import LiveTest, Screen, main
from support.program import environment

SCENE = probe.shader(probe.vector("iResolution", "xy"))
SIZE = ("--size", "200x100")


def pretend_a_window_manager(screen: Screen) -> None:
    """Properties by which programs know that one is there, and what it understands."""
    window_type, atom_type = 33, 4  # predefined atoms
    x11, display = screen.open_display()
    x11.XCreateSimpleWindow.restype = ctypes.c_ulong
    root = ctypes.c_ulong(x11.XDefaultRootWindow(display))

    def atom(name: bytes) -> int:
        return x11.XInternAtom(display, name, 0)

    def put(window: ctypes.c_ulong, name: bytes, kind: int, *values: int) -> None:
        x11.XChangeProperty(display, window, ctypes.c_ulong(atom(name)), ctypes.c_ulong(kind), 32, 0,
                            (ctypes.c_long * len(values))(*values), len(values))

    manager = ctypes.c_ulong(x11.XCreateSimpleWindow(display, root, 0, 0, 1, 1, 0, ctypes.c_ulong(0), ctypes.c_ulong(0)))
    for window in (root, manager):
        put(window, b"_NET_SUPPORTING_WM_CHECK", window_type, manager.value)
    put(root, b"_NET_SUPPORTED", atom_type, atom(b"_NET_WM_STATE"), atom(b"_NET_WM_STATE_ABOVE"))
    x11.XSync(display, 0)  # the connection stays, and the window with it


class Place(LiveTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)

    def corner(self, view) -> tuple[int, int]:
        place = view.place()
        return place["X"], place["Y"]

    def test_window_opens_at_position_and_monitor(self):
        for options, corner in ((["--position", "300,120"], (300, 120)), (["--position", "-20,-10"], (-20, -10)),
                                (["--monitor", "1"], (540, 350)), (["--monitor", "1", "--position", "7,9"], (7, 9))):
            with self.subTest(options):
                view = self.view("a.glsl", *SIZE, *options)
                self.assertEqual(self.corner(view), corner)
                view.close()

    def test_options_override_the_stored_place(self):
        state = {"XDG_STATE_HOME": str(self.folder / "state")}
        view = self.view("a.glsl", *SIZE, "--position", "300,120", **state)
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        view = self.view("a.glsl", **state)
        self.assertEqual(self.corner(view), (300, 120))
        view.close()
        view = self.view("a.glsl", "--position", "50,60", **state)
        self.assertEqual(self.corner(view), (50, 60))

    def test_places_outside_all_monitors_are_refused(self):
        for options, words in (
                (["--position", "5000,10"], "--position 5000,10: no monitor shows that place: monitor 1 is 1280x800 at 0,0"),
                (["--monitor", "2"], "--monitor 2: there is no such monitor: monitor 1 is 1280x800 at 0,0"),
                (["--position", "5"], "--position 5: give X,Y of the window's upper left corner, as in 100,50"),
                (["--monitor", "0"], "--monitor: give a monitor's number from 1, not '0'")):
            with self.subTest(options):
                self.expect_failure(["view", "a.glsl", *options], 2, f"tidemark: error: {words}",
                                    env=environment(DISPLAY=self.screen.display))

    @unittest.skipUnless(shutil.which("xprop"), "xprop is not installed")
    def test_on_top(self):
        screen = Screen()
        self.addCleanup(screen.close)
        pretend_a_window_manager(screen)
        self.screen, shared = screen, self.screen
        self.addCleanup(setattr, self, "screen", shared)
        for options, above in (([], False), (["--on-top"], True)):
            with self.subTest(options):
                view = self.view("a.glsl", *SIZE, *options)
                told = subprocess.run(["xprop", "-id", str(view.window), "_NET_WM_STATE"], text=True, check=True,
                                      env=environment(DISPLAY=screen.display), stdout=subprocess.PIPE).stdout
                self.assertEqual("_NET_WM_STATE_ABOVE" in told, above, told)
                view.close()


if __name__ == "__main__":
    main()
