"""The rooms of runner/: every #include is an arrow of the table, headers have no circles, files are few and not long."""
import pathlib
import re
import unittest

import rooms

RUNNER = pathlib.Path(__file__).parent.parent / "runner"

# The rooms that each room may include besides itself. runner/README.md draws the same table.
ALLOWED = {
    "base": [],
    "scene": ["base"],
    "media": ["base"],
    "shader": ["base", "scene"],
    "proof": ["base"],
    "render": ["base", "scene", "shader", "media"],
    "lab": ["base", "scene", "shader", "media", "proof", "render"],
    "host": ["base", "scene", "shader", "media", "render", "lab"],
    "window": ["base", "scene", "shader", "media", "render", "lab", "host"],
    "web": ["base", "scene", "shader", "media", "lab", "host"],
    "editor": ["base", "scene", "shader"],
    "cli": ["base", "scene", "shader", "media", "render", "lab", "host", "window", "web", "editor"],
    "install": [],
    "main.cpp": ["cli"],
}

# Folders inside of a room: plug-ins, which are libraries of their own, and files that are not C++.
FOLDERS = {
    "media": {"plugin"}, "proof": {"plugin"}, "window": {"plugin"}, "web": {"plugin", "host", "viewer"}, "lab": {"page"}, "shader": {"swiftshader"},
    "cli": {"manual", "scenes"}, "editor": {"vscode"}, "install": {"bundle"},
}

MOST_FILES, MOST_LINES = 450, 600  # of C++ in runner/, and of each file

INCLUDE = re.compile(r'^\s*#\s*include\s+"([a-z_]+)/', re.MULTILINE)


class Layers(unittest.TestCase):
    def test_includes_follow_the_table(self):
        sources = [p for p in RUNNER.rglob("*") if p.suffix in (".cpp", ".hpp")]
        self.assertGreater(len(sources), 50)
        for source in sources:
            room = source.relative_to(RUNNER).parts[0]
            for included in INCLUDE.findall(source.read_text()):
                with self.subTest(source=str(source.relative_to(RUNNER)), includes=included):
                    self.assertIn(included, ALLOWED.get(room, []) + [room])

    def test_headers_have_no_circular_includes(self):
        for room in ALLOWED:
            arrows = {}
            for source in (RUNNER / room).rglob("*.hpp"):
                included = re.findall(rf'#\s*include\s+"({room}/[^"]+)\.hpp"', source.read_text())
                arrows[str(source.relative_to(RUNNER).with_suffix(""))] = set(included)
            # A file that includes none of those left is at the bottom: what cannot be taken away is a circle.
            while bottom := {name for name in arrows if not arrows[name] & arrows.keys()}:
                for name in bottom:
                    del arrows[name]
            with self.subTest(room=room):
                self.assertEqual(sorted(arrows), [])

    def test_type_names_are_unique_in_their_namespace(self):
        """Two of one name link without a word, and one has the other's destructor."""
        places = {}
        for header in RUNNER.rglob("*.hpp"):
            text = header.read_text()
            space = re.search(r"^namespace ([\w:]+) \{", text, re.MULTILINE)
            for name in re.findall(r"^(?:struct|class|enum class|enum) (\w+)[^;{]*\{", text, re.MULTILINE):
                places.setdefault((space and space[1], name), set()).add(str(header.relative_to(RUNNER)))
        self.assertGreater(len(places), 200)
        self.assertEqual({name: files for name, files in places.items() if len(files) > 1}, {})

    def test_kinds_of_input_are_distinguished_by_traits_or_visitors(self):
        """A kind that is asked for by its name is a place that a new kind is forgotten at."""
        kinds = re.search(r"using ChannelInput =\s*std::variant<([^>]+)>;",
                          (RUNNER / "scene/channel.hpp").read_text())[1].replace("\n", " ").split(",")
        asked = re.compile(rf"(get_if|holds_alternative|get)<(scene::)?({'|'.join(kind.strip() for kind in kinds)})>\(")
        # A BoundChannel has another variant.
        bound = re.compile(r"std::get_if<scene::PassOutput>\(&channel\.source\)")
        for source in RUNNER.rglob("*.[ch]pp"):
            with self.subTest(source=str(source.relative_to(RUNNER))):
                self.assertIsNone(asked.search(bound.sub("", source.read_text())))

    def test_every_room_is_in_the_table(self):
        self.assertEqual({p.name for p in RUNNER.iterdir() if p.is_dir()}, set(ALLOWED) - {"main.cpp"})
        for room in set(ALLOWED) - {"main.cpp"}:
            folders = {p.name for p in (RUNNER / room).iterdir() if p.is_dir()}
            with self.subTest(room=room):
                self.assertEqual(folders, FOLDERS.get(room, set()))

    def test_the_map_shows_the_current_includes(self):
        """Sizes aside, which change with each commit."""
        drawn = (RUNNER / "rooms.svg").read_text()
        sizes = re.compile(r"\d+ k lines")
        self.assertEqual(sizes.sub("", drawn), sizes.sub("", rooms.svg()), "python3 tests/rooms.py > runner/rooms.svg")

    def test_number_and_length_of_files_are_bounded(self):
        sources = list(RUNNER.rglob("*.[ch]pp"))
        self.assertLessEqual(len(sources), MOST_FILES)
        for source in sources:
            with self.subTest(source=str(source.relative_to(RUNNER))):
                self.assertLessEqual(len(source.read_text().splitlines()), MOST_LINES)


if __name__ == "__main__":
    unittest.main()
