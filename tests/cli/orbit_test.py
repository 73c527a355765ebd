"""The waters seen by the host's camera: `--camera` turns them, and without it all is as the mouse has it. gl_render draws them
from the limits of the option."""
import json

from support.program import ROOT, ProgramTest, main

WATERS = ("water_surface", "pseudo3d_water", "procedural_ocean", "gerstner_waves", "stylized_waves")
FIRST = "30,20,10"
TURNED = "80,40,7,1,0.5,-1"


class Orbit(ProgramTest):
    def pixels(self, water: str, *options: str) -> str:
        done = self.succeed("capture", str(ROOT / "shaders" / f"{water}.glsl"), "--size", "80x45", "--time", "2", *options,
                            "-o", "a.png", "--json")
        (frame,) = json.loads(done.stdout)["frames"]
        self.assertEqual(frame["not_finite"], 0, (water, options))
        return frame["sha256"]

    def check(self, water: str) -> None:
        first = self.pixels(water)
        mouse = ("--mouse", "60,18")
        self.assertEqual(self.pixels(water, "--camera", FIRST), first)
        self.assertEqual(self.pixels(water, "--camera", "390,20,10"), first)
        self.assertEqual(self.pixels(water, "--camera", FIRST, *mouse), first, "the mouse is the camera's")
        turned = self.pixels(water, "--camera", TURNED)
        self.assertNotEqual(turned, first)
        self.assertEqual(self.pixels(water, "--camera", TURNED, *mouse), turned)
        alone = self.pixels(water, *mouse)
        self.assertNotIn(alone, (first, turned), "--mouse alone is the document's")
        document = ("--set", "document_mouse=1", "--camera", TURNED)
        self.assertEqual(self.pixels(water, *document), first)
        self.assertEqual(self.pixels(water, *document, *mouse), alone)


def add_tests() -> None:
    for water in WATERS:
        setattr(Orbit, f"test_{water}", lambda self, name=water: self.check(name))


add_tests()

if __name__ == "__main__":
    main()
