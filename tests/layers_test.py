"""Every #include "module/…" in runner/ is an arrow that the tables of modules and of their rooms have."""
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
    "ir": ["base"],
    "gl": ["base"],
    "image": ["base"],
    "sound": ["base"],
    "bake": ["base", "image"],
    "platform": ["base"],
    "live": ["base", "text", "scene", "platform"],
    "lsp": ["base", "text", "scene", "glsl"],
    "render": ["base", "text", "scene", "glsl", "gl", "image", "sound"],
    "report": ["base"],
    "web": ["base", "text", "scene", "glsl", "image", "report"],
    "serve": ["base", "text", "scene", "image", "platform", "live", "web"],
    "lab": ["base", "text", "scene", "glsl", "ir", "gl", "image", "render", "report"],
    "cli": ["base", "text", "scene", "glsl", "gl", "image", "sound", "bake", "platform", "live", "lsp", "render", "web", "serve", "report", "lab"],
    "install": [],
    "main.cpp": ["cli"],
}

# The rooms of the larger modules: what each may include of its own module, beside itself. "" is what lies in
# the module's own folder.
ROOMS = {
    # The plug-in is a library of its own: image/files knows the table of functions that it hands over.
    "image": {"": [], "files": ["", "plugin"], "made": ["", "files"], "compare": [""], "plugin": ["", "files"]},
    "ir": {"": ["plugin"], "plugin": []},
    "live": {"": ["plugin"], "plugin": [""], "inputs": [""]},
    "glsl": {"": ["syntax", "flow", "double"], "syntax": [], "flow": ["syntax"], "double": ["syntax"], "specialise": ["syntax"],
             "analysis": ["syntax", "flow"], "instrument": ["syntax", "flow", "analysis"],
             "cure": ["syntax", "flow", "analysis"], "cut": ["syntax", "flow", "cure", "specialise"]},
    "lab": {"": [], "march": [""], "study": ["", "march"], "tune": ["", "march", "study"], "simplify": ["", "march", "study", "tune", "trace", "check"], "trace": [], "pixel": ["march"],
            "check": ["", "march", "trace"], "fix": ["", "march", "trace", "check"], "device": ["", "check", "study"]},
    # What runs in a browser, and includes nothing.
    "web": {"": [], "host": []},
    "report": {"": [], "page": []},
    "serve": {"": ["plugin"], "plugin": [""], "page": []},
    "cli": {"": [], "capture": [""], "view": [""], "serve": ["", "view"], "inspect": [""], "check": [""], "bake": [""], "help": [""], "lsp": [""], "new": [""]},
}

# Modules whose files (a .cpp and its .hpp count as one) never lead back to where they started.
WITHOUT_CIRCLES = ["base", "text", "scene", "ir", "gl", "sound", "platform", "report", "serve", "lsp"]

INCLUDE = re.compile(r'^\s*#\s*include\s+"([a-z_]+)/(?:([a-z_]+)/)?', re.MULTILINE)


def place_of(path):
    """The module and the room ("": none) that a source lies in."""
    parts = path.relative_to(RUNNER).parts
    return parts[0], parts[1] if len(parts) == 3 else ""


class Layers(unittest.TestCase):
    def test_includes_follow_the_table(self):
        sources = [p for p in RUNNER.rglob("*") if p.suffix in (".cpp", ".hpp")]
        self.assertGreater(len(sources), 50)
        for source in sources:
            module, room = place_of(source)
            for included, its_room in INCLUDE.findall(source.read_text()):
                with self.subTest(source=str(source.relative_to(RUNNER)), includes=f"{included}/{its_room}"):
                    self.assertIn(included, ALLOWED[module] + [module])
                    if included == module and module in ROOMS:
                        self.assertIn(its_room, ROOMS[module][room] + [room])

    def test_files_follow_each_other_without_a_circle(self):
        for module in WITHOUT_CIRCLES:
            arrows = {}
            for source in (RUNNER / module).rglob("*.[ch]pp"):
                included = re.findall(rf'#\s*include\s+"({module}/[^"]+)\.hpp"', source.read_text())
                name = str(source.relative_to(RUNNER).with_suffix(""))
                arrows.setdefault(name, set()).update(set(included) - {name})
            # A file that includes none of those left is at the bottom: what cannot be taken away is a circle.
            while bottom := {name for name in arrows if not arrows[name] & arrows.keys()}:
                for name in bottom:
                    del arrows[name]
            with self.subTest(module=module):
                self.assertEqual(sorted(arrows), [])

    def test_a_name_in_a_namespace_is_one_type(self):
        """Two of one name link without a word, and one has the other's destructor."""
        places = {}
        for header in RUNNER.rglob("*.hpp"):
            text = header.read_text()
            space = re.search(r"^namespace ([\w:]+) \{", text, re.MULTILINE)
            for name in re.findall(r"^(?:struct|class|enum class|enum) (\w+)[^;{]*\{", text, re.MULTILINE):
                places.setdefault((space and space[1], name), set()).add(str(header.relative_to(RUNNER)))
        self.assertGreater(len(places), 200)
        self.assertEqual({name: files for name, files in places.items() if len(files) > 1}, {})

    def test_kinds_of_input_are_asked_for_by_traits_or_visited(self):
        """A kind that is asked for by its name is a place that a new kind is forgotten at."""
        kinds = re.search(r"using ChannelInput =\s*std::variant<([^>]+)>;",
                          (RUNNER / "scene/channel_input.hpp").read_text())[1].replace("\n", " ").split(",")
        asked = re.compile(rf"(get_if|holds_alternative|get)<(scene::)?({'|'.join(kind.strip() for kind in kinds)})>\(")
        # What a BoundChannel reads is another variant.
        bound = re.compile(r"std::get_if<scene::PassOutput>\(&channel\.source\)")
        for source in RUNNER.rglob("*.[ch]pp"):
            with self.subTest(source=str(source.relative_to(RUNNER))):
                self.assertIsNone(asked.search(bound.sub("", source.read_text())))

    def test_every_module_is_in_the_table(self):
        modules = {p.name for p in RUNNER.iterdir() if p.is_dir()}
        self.assertEqual(modules, set(ALLOWED) - {"main.cpp"})

    def test_every_room_is_in_the_table(self):
        for module in set(ALLOWED) - {"main.cpp"}:
            rooms = {p.name for p in (RUNNER / module).iterdir() if p.is_dir()}
            with self.subTest(module=module):
                self.assertEqual(rooms, set(ROOMS.get(module, {"": []})) - {""})

    def test_files_stay_small(self):
        for source in RUNNER.rglob("*.cpp"):
            with self.subTest(source=str(source.relative_to(RUNNER))):
                self.assertLessEqual(len(source.read_text().splitlines()), 600)


if __name__ == "__main__":
    unittest.main()
