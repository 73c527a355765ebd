"""`import` and `export`: ShaderToy's JSON as a folder of files and back; what a scene may read."""
import json

from support.program import ROOT, ProgramTest, main

PROJECTS = ROOT / "tests" / "cases" / "projects"
SHADER = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n"


def in_order(text: bytes | str):
    """The JSON with the order of its members."""
    return json.loads(text, object_pairs_hook=list)


class RoundTrip(ProgramTest):
    def test_every_form_of_project_survives(self):
        for project in sorted(PROJECTS.glob("*.json")):
            with self.subTest(project=project.name):
                folder = project.stem
                self.succeed("import", str(project), "-o", folder)
                back = self.succeed("export", folder)
                self.assertEqual(in_order(back.stdout), in_order(project.read_bytes()))
                self.assertEqual(back.stderr, "")
                self.assertEqual(self.succeed("export", f"{folder}/scene.json").stdout, back.stdout)

    def test_code_stays_byte_for_byte(self):
        code = "\ufeff// é 🌊 \"quoted\" \\ \r\n\tvoid mainImage(out vec4 c, in vec2 p) {}\r\r\n\n// \x01\x7f no end"
        self.write("x.json", json.dumps([{"type": "image", "code": code}]))
        self.succeed("import", "x.json")
        self.assertEqual((self.folder / "x/image.glsl").read_bytes(), code.encode())
        self.assertEqual(json.loads(self.succeed("export", "x").stdout), [{"type": "image", "code": code}])

    def test_an_edit_survives(self):
        self.write("x.json", json.dumps([{"type": "image", "code": SHADER, "id": "1"}]))
        self.succeed("import", "x.json")
        self.write("x/image.glsl", SHADER + "// mine\n")
        done = self.succeed("export", "x", "-o", "y.json", "--json")
        self.assertEqual(done.stderr, "wrote y.json\n")
        self.assertEqual(json.loads(done.stdout)["file"], "y.json")
        self.assertEqual(json.loads((self.folder / "y.json").read_text()),
                         [{"type": "image", "code": SHADER + "// mine\n", "id": "1"}])


class Import(ProgramTest):
    def setUp(self):
        super().setUp()
        self.project = [{"type": "image", "code": SHADER}, {"type": "common", "code": "int c;\n"}]
        self.write("x.json", json.dumps(self.project))

    def test_names_the_folder_by_the_file(self):
        done = self.succeed("import", "x.json", "--json")
        self.assertEqual(done.stderr, "wrote x: image.glsl, common.glsl, scene.json\n")
        report = json.loads(done.stdout)
        self.assertEqual((report["folder"], report["files"]), ("x", ["image.glsl", "common.glsl", "scene.json"]))

    def test_second_import_removes_files_of_removed_passes(self):
        self.succeed("import", "x.json")
        self.write("x.json", json.dumps(self.project[:1]))
        self.succeed("import", "x.json")
        self.assertFalse((self.folder / "x/common.glsl").exists())

    def test_never_overwrites_foreign_files(self):
        words = ("tidemark: error: 'x/{}' was not written by import, or was changed since: give another folder with -o, or "
                 "--force to overwrite")
        self.write("x/notes.txt", "mine")
        self.expect_failure(["import", "x.json"], 4, words.format("notes.txt"))
        self.succeed("import", "x.json", "--force")
        self.assertEqual((self.folder / "x/notes.txt").read_text(), "mine")
        (self.folder / "x/notes.txt").unlink()
        self.succeed("import", "x.json")
        self.write("x/common.glsl", "int mine;\n")
        self.expect_failure(["import", "x.json"], 4, words.format("common.glsl"))
        self.assertEqual((self.folder / "x/common.glsl").read_text(), "int mine;\n")

    def test_refuses_other_json(self):
        self.expect_failure(["import", "none.json"], 3, "tidemark: error: cannot read 'none.json': no such file")
        self.write("a.json", "{\n  nothing\n")
        self.expect_failure_like(["import", "a.json"], 3, r"a\.json:2:4: error: this is not JSON: .*")
        self.write("b.json", '{"Error": "Shader not found"}')
        self.expect_error(["import", "b.json"], 3, "b.json: error:", "Shader not found")
        self.expect_failure(["import"], 2, "tidemark: error: import: FILE is required")

    def test_into_a_file(self):
        self.write("y", "")
        self.expect_failure_like(["import", "x.json", "-o", "y"], 4, "tidemark: error: cannot make the folder 'y': .*")


class Export(ProgramTest):
    def test_single_file_becomes_a_project(self):
        self.write("a.glsl", "#iUniform float speed = 2.0\n" + SHADER)
        project = json.loads(self.succeed("export", "a.glsl", "--set", "speed=3").stdout)
        passes = project["Shader"]["renderpass"]
        self.assertEqual([p["type"] for p in passes], ["image", "common"])
        self.assertEqual(passes[1]["code"], "const float speed = 3.0;")
        self.assertEqual(project["Shader"]["info"]["name"], "a")

    def test_embedded_page_is_ascii(self):
        """The page around it says in which encoding it is read, or nothing at all."""
        self.write("wäve.glsl", "// é 🌊\n" + SHADER)
        self.succeed("export", "wäve.glsl", "--html", "figure.html", "--embed")
        self.assertTrue((self.folder / "figure.html").read_bytes().isascii())

    def test_a_page_has_the_hosts_uniforms_and_the_tempo(self):
        self.write("beat.glsl", "uniform float iBeat;\n" + SHADER)
        self.succeed("export", "beat.glsl", "--html", "beat.html", "--bpm", "90")
        page = (self.folder / "beat.html").read_text()
        self.assertIn('"numbers":{"fps":60.0,"bpm":90.0}', page)
        self.assertIn('names: ["iBeat"], others: [], follows: "clock",', page)
        self.assertIn("moment.time * moment.bpm / 60", page)
        self.assertNotIn("{{uniforms}}", page)
        self.succeed("export", "beat.glsl", "--html", "beat.html")
        self.assertIn('"bpm":120.0', (self.folder / "beat.html").read_text())
        self.expect_failure(["export", "beat.glsl", "--bpm", "90"], 2, "tidemark: error: --bpm needs --html FILE")

    def test_usage(self):
        self.write("x.json", "[]")
        self.expect_failure(["export", "x.json"], 2, "tidemark: error: 'x.json' is already ShaderToy's JSON")
        self.expect_error(["export", "a.glsl", "--json"], 2, "--json")
        self.expect_failure(["export", "none.glsl"], 3, "tidemark: error: cannot read 'none.glsl': no such file")


class PathsOutside(ProgramTest):
    def test_need_allow_outside(self):
        self.write("s/a.glsl", '#include "../b.glsl"\n' + SHADER)
        self.write("b.glsl", "int b;\n")
        self.expect_error(["export", "s/a.glsl"], 3, "s/a.glsl:1: error:", "'b.glsl'", "lies outside", "'s'")
        self.succeed("export", "s/a.glsl", "--allow-outside")


if __name__ == "__main__":
    main(needs_context=False)
