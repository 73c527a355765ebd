"""Random edits of a scene while its window shows it: whatever is done to the files, the last one is on show, and what
the window holds of the machine stays what it was: handles, threads, OpenGL objects. Memory is printed."""
import os
import random
import time

from support import footprint, probe
from support.live import LiveTest, View, main, wait_for
from support.program import is_sanitized

# $TIDEMARK_SOAK_EDITS asks for more.
EDITS = int(os.environ.get("TIDEMARK_SOAK_EDITS", "40"))
VALUES = {"mark": "MARK", "from the include": "included()"}
SIZE = ("--size", "200x100")
WARM = 20  # edits until everything that is loaded when it is first needed is there


class Soak(LiveTest):
    def setUp(self):
        super().setUp()
        self.random = random.Random(os.environ.get("TIDEMARK_SOAK_SEED", "1"))
        self.mark = 0

    def scene(self) -> str:
        self.mark += 1
        return probe.shader(VALUES, f'#include "lib/b.glsl"\n#define MARK {self.mark}.0\n'
                                    "#iUniform float level = 0.5 in { 0.0, 1.0 }\n")

    def include(self) -> str:
        return f"float included() {{ return {self.mark}.0; }}\n"

    def replace(self, name: str, text: str) -> None:
        self.write(f"{name}.new", text)
        os.replace(self.folder / f"{name}.new", self.folder / name)

    def damaged(self, text: str) -> str:
        at = self.random.randrange(len(text))
        return self.random.choice([text[:at], text[:at] + "§" + text[at:], text[:at] + text[at + 5:], "", "\0" + text,
                                   text.replace("MARK", "MARKS"), text.replace("included()", "included().xyz"),
                                   text.replace("lib/b", "lib/c"), text + "}", "#iUniform flaot x\n" + text])

    def edit(self) -> None:
        """One thing that happens to files."""
        name, text = self.random.choice([("s/a.glsl", self.scene()), ("s/lib/b.glsl", self.include())])
        path = self.folder / name
        way = self.random.randrange(9)
        if way == 0:
            path.unlink(missing_ok=True)
        elif way == 1 and path.exists():
            os.replace(path, f"{path}~")
        elif way == 2 and (self.folder / "s/lib").exists():
            os.replace(self.folder / "s/lib", self.folder / f"lib{self.mark}")
        elif way == 3 and (self.folder / "s").exists():
            os.replace(self.folder / "s", self.folder / f"s{self.mark}")
        elif way == 4:
            path.parent.mkdir(parents=True, exist_ok=True)
            with open(path, "wb", buffering=0) as file:  # in pieces
                for at in range(0, len(text), 40):
                    file.write(text[at:at + 40].encode())
                    time.sleep(self.random.random() * 0.01)
        elif way == 5:
            self.replace(name, self.damaged(text))
        else:
            self.write(name, self.damaged(text) if way < 8 else text)

    def restore(self) -> None:
        scene = self.scene()
        for name, text in self.random.sample([("s/a.glsl", scene), ("s/lib/b.glsl", self.include())], 2):
            self.random.choice([self.write, self.replace])(name, text)

    def expect_what_is_there(self, view: View) -> None:
        mark = float(self.mark)
        view.wait_until_told(VALUES, lambda told: list(told.values()) == [mark, mark])

    def held(self, view: View) -> tuple:
        """What must not grow. A scene that is not compiled yet holds more for a moment."""
        process = view.program.pid
        return footprint.handles(process), footprint.threads(process), footprint.objects(self.counts)

    def tell(self, view: View, edit: int) -> None:
        handles, threads, objects = self.held(view)
        print(f"after {edit} edits: {footprint.kibibytes(view.program.pid) / 1024:.1f} MiB, {len(handles)} handles, "
              f"{len(threads)} threads, " + ", ".join(f"{count} {kind}" for kind, count in objects.items()), flush=True)

    def test_random_saves_leak_nothing(self):
        self.restore()
        self.counts = self.folder / "counts"
        counted = not is_sanitized()
        view = self.view("s/a.glsl", *SIZE, "--set", "level=0.25",
                         **(footprint.variables(self.counts) if counted else {}))
        warm = None
        for edit in range(EDITS):
            self.edit()
            if self.random.randrange(3) == 0:
                time.sleep(self.random.random() * 0.3)  # else the next one comes at once
            if edit % 5 == 4:
                self.restore()
                self.expect_what_is_there(view)
                if counted and edit + 1 >= WARM and warm is None:
                    warm = self.held(view)
                if counted and (edit + 1 == WARM or (edit + 1) % 500 == 0):
                    self.tell(view, edit + 1)
        self.assertNotRegex(view.title(), "error")
        if warm is not None:
            self.tell(view, EDITS)
            wait_for(lambda: self.held(view) == warm, f"{warm} instead of {self.held(view)}")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)

    def test_random_saves_after_a_start_without_a_scene(self):
        view = View(self.screen, self.folder, "s/a.glsl", *SIZE, first_title=r"\Awaiting: ")
        self.addCleanup(view.close)
        for edit in range(EDITS // 4):
            self.edit()
        self.restore()
        view.wait_for_title(r" (fps|still)\Z")
        self.expect_what_is_there(view)


if __name__ == "__main__":
    main()
