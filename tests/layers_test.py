"""Every #include "module/…" in runner/ is an arrow that the table of layers has."""
import pathlib
import re
import unittest

RUNNER = pathlib.Path(__file__).parent.parent / "runner"

# What each module may include, beside itself. The README draws the same table.
ALLOWED = {
    "base": [],
    "text": ["base"],
    "scene": ["base", "text"],
    "glsl": ["base", "text", "scene"],
    "gl": ["base"],
    "image": ["base"],
    "sound": ["base"],
    "terrain": ["base", "image"],
    "platform": ["base"],
    "render": ["base", "text", "scene", "glsl", "gl", "image", "sound"],
    "lab": ["base", "text", "scene", "glsl", "gl", "image", "render"],
    "cli": ["base", "text", "scene", "glsl", "gl", "image", "sound", "terrain", "platform", "render", "lab"],
    "main.cpp": ["cli"],
}

INCLUDE = re.compile(r'^\s*#\s*include\s+"([a-z_]+)/', re.MULTILINE)


def module_of(path):
    return path.relative_to(RUNNER).parts[0]


class Layers(unittest.TestCase):
    def test_includes_follow_the_table(self):
        sources = [p for p in RUNNER.rglob("*") if p.suffix in (".cpp", ".hpp")]
        self.assertGreater(len(sources), 50)
        for source in sources:
            module = module_of(source)
            for included in INCLUDE.findall(source.read_text()):
                with self.subTest(source=str(source.relative_to(RUNNER)), includes=included):
                    self.assertIn(included, ALLOWED[module] + [module])

    def test_every_module_is_in_the_table(self):
        modules = {p.name for p in RUNNER.iterdir() if p.is_dir()}
        self.assertEqual(modules, set(ALLOWED) - {"main.cpp"})

    def test_files_stay_small(self):
        for source in RUNNER.rglob("*.cpp"):
            with self.subTest(source=str(source.relative_to(RUNNER))):
                self.assertLessEqual(len(source.read_text().splitlines()), 500)


if __name__ == "__main__":
    unittest.main()
