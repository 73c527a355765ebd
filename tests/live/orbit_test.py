"""The waters under the host's camera in the window: a drag turns them, wheel and middle drag move, R goes back."""
import re
import shlex

from support import png
from support.live import LiveTest, main, wait_for
from support.program import ROOT

WATERS = ("water_surface", "pseudo3d_water", "procedural_ocean", "gerstner_waves", "stylized_waves")
SIZE = ("--size", "160x90")
MIDDLE, ASIDE = (80, 45), (100, 30)


class Orbit(LiveTest):
    def start(self, water: str, *options: str):
        view = self.view(str(ROOT / "shaders" / f"{water}.glsl"), *SIZE, *options)
        view.restart_paused()
        return view

    def captured(self, command: str) -> str:
        self.succeed(*shlex.split(command)[1:], "-o", "again.png")
        return png.read(self.folder / "again.png").sha256()

    def shown(self, view) -> str:
        return png.read(view.save()).sha256()

    def wait_until_shown(self, view, wanted: str, what: str) -> None:
        wait_for(lambda: self.shown(view) == wanted, what)

    def wait_until_changed(self, view, before: str, what: str) -> str:
        return wait_for(lambda: (now := self.shown(view)) != before and now, what)

    def wait_for_command(self, view, pattern: str) -> str:
        """That captures what is shown, once it says what is wanted."""
        def copied() -> str | None:
            view.key("c")
            commands = re.findall(r"^copied: (tidemark capture .*)$", view.stderr(), re.MULTILINE)
            return next((command for command in commands[-1:] if re.search(pattern, command)), None)
        return wait_for(copied, f"a command with {pattern}")

    def check(self, water: str) -> None:
        view = self.start(water)
        first = self.shown(view)
        scene = shlex.quote(str(ROOT / "shaders" / f"{water}.glsl"))
        self.assertEqual(self.captured(f"tidemark capture {scene} --size 160x90"), first)

        view.point(*MIDDLE)
        view.button(1, True)
        self.wait_for_command(view, "--mouse 80,45,80,45,down|--mouse 80,45,down")
        self.assertEqual(self.shown(view), first, "a press alone makes the picture jump")
        view.point(*ASIDE)
        turned = self.wait_until_changed(view, first, "a turned picture")
        command = self.wait_for_command(view, "--mouse 100,60,80,45,down")
        turned = self.shown(view)
        self.assertEqual(self.captured(command), turned)
        view.button(1, False)
        self.wait_for_command(view, "--mouse 100,60,80,45( |$)")
        self.assertEqual(self.shown(view), turned, "letting go makes the picture jump")
        view.key("r")
        self.wait_until_shown(view, first, "the first picture after R")

        self.screen.xdotool("click", "4")
        near = self.wait_until_changed(view, first, "a nearer picture")
        view.drag(MIDDLE, ASIDE, number=2)
        self.wait_until_changed(view, near, "a panned picture")
        view.key("r")
        self.wait_until_shown(view, first, "the first picture after wheel, pan and R")
        view.close()

    def test_a_knob_selects_the_documented_mouse(self):
        view = self.start("gerstner_waves", "--set", "document_mouse=1")
        view.drag(MIDDLE, ASIDE)
        command = self.wait_for_command(view, "--mouse 100,60,80,45( |$)")
        scene = shlex.quote(str(ROOT / "shaders" / "gerstner_waves.glsl"))
        self.wait_until_shown(view, self.captured(f"tidemark capture {scene} --size 160x90 --mouse 100,60"),
                              "the view of iMouse")
        self.assertEqual(self.captured(command), self.shown(view))


def add_tests() -> None:
    for water in WATERS:
        setattr(Orbit, f"test_{water}", lambda self, name=water: self.check(name))


add_tests()

if __name__ == "__main__":
    main()
