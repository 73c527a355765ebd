"""tidemark lsp: completion, signatures, references, rename, corrections, folding and semantic tokens, by a scripted editor."""
import contextlib
import json
import os
import pathlib
import time

from support import png
from support.lsp_client import Client
from support.program import TIME_LIMIT, ProgramTest, main

SHAPES = """\
// Shapes.

/* How far a place is
   from a ball. */
float ball(vec3 at, float radius) { return length(at) - radius; }
struct Hit {
    float distance;
    vec3 normals[2];
};
"""
SCENE = """\
#include "shapes.glsl"
#iUniform float size = 0.5 in { 0.0, 2.0 }
#define TWICE(x) (2.0 * (x))
const vec3 SUN = vec3(0.0, 1.0, 0.0);
#if 0
float never = 1.0;
#endif
float shade(vec2 at) {
    float sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        float sum2 = ball(vec3(at, float(i)), size);
        sum += sum2;
    }
    return sum;
}
void mainImage(out vec4 color, in vec2 at) {
    Hit hit;
    vec3 sum = SUN * shade(at / iResolution.xy) * TWICE(size);
    color = vec4(sum, 1.0);
}
"""


class Features(ProgramTest):
    def setUp(self) -> None:
        super().setUp()
        self.folder = self.folder.resolve()
        self.shapes = self.write("shapes.glsl", SHAPES)
        self.scene = self.write("scene.glsl", SCENE)
        self.client = Client()
        self.addCleanup(self.client.end)
        self.client.open(self.scene)
        self.version = 1

    def ask(self, method: str, text: str, path: pathlib.Path | None = None, **more) -> dict:
        """At the `|` of a text, which is shown without it."""
        path = path or self.scene
        before, _, after = text.partition("|")
        self.version += 1
        self.client.change(path, before + after, self.version)
        return self.client.at(method, path, before.count("\n"), len(before.rpartition("\n")[2]), **more)

    def labels(self, text: str) -> list[str]:
        result = self.ask("completion", text)["result"]
        return [each["label"] for each in result["items"]] if result else []

    def at(self, place: str, text: str = SCENE) -> str:
        """The text with a `|` before a place in it."""
        self.assertEqual(text.count(place), 1, place)
        return text.replace(place, "|" + place)

    def edited(self, changes: dict, path: pathlib.Path, text: str) -> str:
        lines = text.splitlines(keepends=True)
        for edit in sorted(changes.get(path.as_uri(), []), key=lambda edit: -edit["range"]["start"]["line"] * 1000
                           - edit["range"]["start"]["character"]):
            start, end = edit["range"]["start"], edit["range"]["end"]
            self.assertEqual(start["line"], end["line"])
            line = lines[start["line"]]
            lines[start["line"]] = line[:start["character"]] + edit["newText"] + line[end["character"]:]
        return "".join(lines)


class Completion(Features):
    def test_names_of_scene_host_and_language(self) -> None:
        result = self.ask("completion", self.at("return sum;"))["result"]
        items = {each["label"]: each for each in result["items"]}
        for name in ("sum", "at", "shade", "ball", "Hit", "SUN", "TWICE", "size", "iTime", "smoothstep", "vec3", "return"):
            self.assertIn(name, items)
        self.assertNotIn("sum2", items, "it has gone out of scope")
        self.assertNotIn("hit", items, "a local of another function")
        self.assertEqual(items["sum"]["detail"], "float sum")
        self.assertEqual(items["ball"]["detail"], "float ball(vec3 at, float radius)")
        self.assertIn("from a ball.", items["ball"]["documentation"]["value"])
        self.assertEqual(items["iTime"]["documentation"]["value"], "seconds since the start")
        resolved = self.client.request("completionItem/resolve", {"label": "sqrt", "kind": 3})["result"]
        self.assertIn("Undefined of a negative number.", resolved["documentation"]["value"])

    def test_members_and_swizzles(self) -> None:
        def after(expression: str) -> list[str]:
            return self.labels(SCENE.replace("    color = vec4(sum, 1.0);", f"    color = vec4({expression}.|);"))
        self.assertEqual(after("hit"), ["distance", "normals"])
        self.assertEqual(after("hit.normals"), ["length()"])
        for expression in ("sum", "hit.normals[0]", "SUN", "iResolution", "normalize(sum * 2.0)", "(sum + 1.0)",
                           "mix(sum, SUN, 0.5)", "mat3(1.0)[1]"):
            with self.subTest(expression):
                found = after(expression)
                self.assertEqual(set("xyzrgb") - set(found), set())
                self.assertIn("xz", found)
                self.assertNotIn("w", found)
        self.assertIn("w", after("texture(iChannel0, at)"))
        self.assertNotIn("z", after("sum.xy"))
        self.assertEqual(after("nothing"), [])
        self.assertEqual(self.labels(SCENE.replace("    color = vec4(sum, 1.0);", "    color = vec4(1.|);")), [])

    def test_directives_with_their_values(self) -> None:
        image = self.write("noise picture.png", b"")
        self.write("folder/inner.glsl", "float inner;\n")
        for line, wanted, unwanted in (
                ("#|", ["iChannel0", "iUniform", "iSize", "include", "define"], []),
                ("#iU|", ["iUniform"], []),
                ("#iUniform |", ["float", "color3", "ivec2"], ["mat3"]),
                ("#iUniform float a = 1.0 |", ["in", "step"], []),
                ("#iSize |", ["800x450"], []),
                ("#iChannel0 \"|", ["noise", "keyboard", image.name, "folder/"], []),
                ("#iChannel0::|", ["MinFilter", "WrapMode", "Type"], []),
                ("#iChannel0::WrapMode \"|", ["Repeat", "Clamp", "Mirror"], ["Nearest"]),
                ("#include \"|", ["shapes.glsl", "folder/"], ["scene.glsl", image.name]),
                ("#include \"folder/|", ["folder/inner.glsl"], ["shapes.glsl"]),
                ("#include \"/|", [], ["etc/"])):
            with self.subTest(line):
                found = self.labels(line + "\n" + SCENE)
                self.assertEqual(set(wanted) - set(found), set())
                self.assertEqual(set(unwanted) & set(found), set())
        self.assertTrue(any(each.startswith("tidemark/") for each in self.labels("#include <|\n" + SCENE)))
        edit = self.ask("completion", "#include \"sha|\n" + SCENE)["result"]["items"][0]["textEdit"]
        self.assertEqual((edit["range"]["start"]["character"], edit["range"]["end"]["character"]), (10, 13))

    def test_no_completion_in_comments(self) -> None:
        self.assertEqual(self.labels("// a|\n" + SCENE), [])
        self.assertEqual(self.labels("/* a|\n */" + SCENE), [])

    def test_completion_in_an_unfinished_text(self) -> None:
        self.assertIn("sum", self.labels("void mainImage(out vec4 c, in vec2 p) { float sum = 1.0; c = vec4(su|"))
        self.assertEqual(self.labels("void mainImage(out vec4 c, in vec2 p) { c = vec4(p.|")[:2], ["x", "y"])


class Signatures(Features):
    def test_signatures_of_own_and_built_in_functions(self) -> None:
        help_ = self.ask("signatureHelp", SCENE.replace("ball(vec3(at, float(i)), size)", "ball(vec3(at, 1.0), |"))["result"]
        self.assertEqual([each["label"] for each in help_["signatures"]], ["float ball(vec3 at, float radius)"])
        self.assertEqual(help_["activeParameter"], 1)
        self.assertEqual([each["label"] for each in help_["signatures"][0]["parameters"]], ["vec3 at", "float radius"])
        help_ = self.ask("signatureHelp", SCENE.replace("return sum;", "return pow(sum, |"))["result"]
        self.assertIn("float pow(float, float)", [each["label"] for each in help_["signatures"]])
        self.assertIn("Undefined", help_["signatures"][0]["documentation"]["value"])
        self.assertEqual(help_["activeParameter"], 1)
        self.assertIsNone(self.ask("signatureHelp", self.at("return sum;"))["result"])


class Names(Features):
    def places(self, result: list[dict]) -> list[tuple[str, int, int]]:
        return [(pathlib.PurePath(each["uri"]).name, each["range"]["start"]["line"], each["range"]["start"]["character"])
                for each in result]

    def test_references(self) -> None:
        found = self.ask("references", self.at("ball(vec3"), context={"includeDeclaration": True})["result"]
        self.assertEqual(self.places(found), [("scene.glsl", 10, 21), ("shapes.glsl", 4, 6)])
        found = self.ask("references", self.at("ball(vec3"), context={"includeDeclaration": False})["result"]
        self.assertEqual(self.places(found), [("scene.glsl", 10, 21)])
        found = self.ask("references", self.at("sum += sum2"))["result"]
        self.assertEqual(self.places(found), [("scene.glsl", line, column) for line, column in ((8, 10), (11, 8), (13, 11))])
        found = self.ask("documentHighlight", self.at("sum, 1.0"))["result"]
        self.assertEqual([each["range"]["start"]["line"] for each in found], [17, 18])
        self.assertEqual(self.ask("references", "|" + SCENE)["result"], [])

    def rename(self, place: str, name: str, text: str = SCENE) -> dict:
        return self.ask("rename", self.at(place, text), newName=name)

    def assert_draws_the_same(self, changes: dict) -> None:
        self.succeed("capture", "scene.glsl", "--size", "32x18", "-o", "before.png")
        self.write("scene.glsl", self.edited(changes, self.scene, SCENE))
        self.write("shapes.glsl", self.edited(changes, self.shapes, SHAPES))
        self.succeed("capture", "scene.glsl", "--size", "32x18", "-o", "after.png")
        self.assertEqual(png.read(self.folder / "before.png").rows, png.read(self.folder / "after.png").rows)

    def test_a_renamed_local_leaves_its_namesakes(self) -> None:
        changes = self.rename("sum += sum2", "total")["result"]["changes"]
        text = self.edited(changes, self.scene, SCENE)
        self.assertEqual(text, SCENE.replace("float sum =", "float total =").replace("sum += sum2", "total += sum2")
                         .replace("return sum;", "return total;"))
        self.assert_draws_the_same(changes)

    def test_a_renamed_parameter(self) -> None:
        changes = self.rename("at) {\n    float", "place")["result"]["changes"]
        self.assertEqual(self.edited(changes, self.scene, SCENE), SCENE.replace("shade(vec2 at)", "shade(vec2 place)")
                         .replace("vec3(at, float", "vec3(place, float"))
        self.assert_draws_the_same(changes)

    def test_a_function_of_an_include(self) -> None:
        changes = self.rename("ball(vec3", "globe")["result"]["changes"]
        self.assertEqual(set(changes), {self.scene.as_uri(), self.shapes.as_uri()})
        self.assert_draws_the_same(changes)

    def test_a_global_and_a_structure(self) -> None:
        for place, name in (("SUN * shade", "LIGHT"), ("Hit hit", "Touch"), ("size);\n        sum", "radius_of_all")):
            with self.subTest(name):
                self.write("scene.glsl", SCENE)
                self.write("shapes.glsl", SHAPES)
                self.assert_draws_the_same(self.rename(place, name)["result"]["changes"])

    def test_a_name_with_another_meaning_in_another_pass(self) -> None:
        text = "float level() { return LEVEL; }\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(level()); }\n"
        image = self.write("s/image.glsl", '#iChannel0 "buffer_a.glsl"\n' + text.replace("LEVEL", "texelFetch(iChannel0, ivec2(0), 0).x"))
        self.write("s/buffer_a.glsl", text.replace("LEVEL", "1.0"))
        self.client.open(image)
        changes = self.client.at("rename", image, 1, 7, newName="height")["result"]["changes"]
        self.assertEqual(set(changes), {image.as_uri()})
        self.write("s/common.glsl", "float level();\nfloat common_level() { return level(); }\n")
        self.client.notify("workspace/didChangeWatchedFiles", {"changes": []})
        changes = self.client.at("rename", image, 1, 7, newName="height")["result"]["changes"]
        self.assertEqual({pathlib.PurePath(each).name for each in changes}, {"image.glsl", "buffer_a.glsl", "common.glsl"})

    def test_invalid_renames_are_refused(self) -> None:
        self.write("uses.glsl", SCENE.replace("#define TWICE(x) (2.0 * (x))", "#define TWICE(x) (2.0 * (x) * sum)"))
        for place, name, text, why in (
                ("TWICE(size)", "x2", SCENE, "'TWICE' is a macro"), ("distance;", "far", None, "'distance' is a member"),
                ("iResolution", "size2", "uniform vec3 iResolution;\n" + SCENE.replace("at / iResolution.xy", "at"),
                 "'iResolution' is given by GLSL or the host"),
                ("mainImage", "drawAll", SCENE, "the host calls 'mainImage'"), ("sum += sum2", "sum2", SCENE, "has that name already"),
                ("sum += sum2", "vec3", SCENE, "reserved by GLSL"), ("SUN * shade", "ball", SCENE, "has that name already"),
                ("sum += sum2", "total", SCENE.replace("2.0 * (x)", "2.0 * (x) * sum"), "the macro 'TWICE' uses the name 'sum'"),
                ("shade(vec2", "tint", SCENE.replace("(2.0 * (x))", "(2.0 * a##x)"), "the macro 'TWICE' joins names with ##")):
            with self.subTest(place=place, name=name):
                path = self.scene if text else self.shapes
                if not text:
                    self.client.open(self.shapes)
                error = self.ask("rename", self.at(place, text or SHAPES), path, newName=name).get("error")
                self.assertIn(why, error["message"] if error else "renamed")


class Corrections(Features):
    def test_suggests_the_nearest_name(self) -> None:
        for wrong, right, text in (("baall(vec3", "ball", SCENE.replace("ball(vec3", "baall(vec3")),
                                   ("smm;", "sum", SCENE.replace("return sum;", "return smm;")),
                                   ("#iUnifrom", "#iUniform", SCENE.replace("#iUniform", "#iUnifrom"))):
            with self.subTest(wrong):
                self.version += 1
                self.client.change(self.scene, text, self.version)
                found = self.client.diagnostics(self.scene, lambda found: any(wrong.strip("(vec3;") in each["message"] for each in found))
                actions = self.client.request("textDocument/codeAction", {
                    "textDocument": {"uri": self.scene.as_uri()}, "range": found[0]["range"],
                    "context": {"diagnostics": found}})["result"]
                self.assertEqual(actions[0]["title"], f"Change to '{right}'")
                self.assertEqual(self.edited(actions[0]["edit"]["changes"], self.scene, text), SCENE)

    def test_no_suggestion_without_a_near_name(self) -> None:
        actions = self.client.request("textDocument/codeAction", {
            "textDocument": {"uri": self.scene.as_uri()}, "range": {"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 0}},
            "context": {"diagnostics": [{"message": "`qqqqqqqq' undeclared", "range": {
                "start": {"line": 9, "character": 6}, "end": {"line": 9, "character": 8}}}]}})["result"]
        self.assertEqual(actions, [])


FAULTY = """\
#include "roots.glsl"
void mainImage(out vec4 color, in vec2 at) {
    vec2 uv = at / iResolution.xy;
    float sum;
    if (uv.y > 0.5)
        sum = uv.y;
    color = vec4(root(uv.x - 0.25), sum, 0.0, 1.0);
}
"""
ROOTS = "// Straße\nfloat root(float x) { return /* é */ sqrt(x); }\n"


class Fixes(ProgramTest):
    """Measured in the background, by `check --fix`."""

    def setUp(self) -> None:
        super().setUp()
        self.folder = self.folder.resolve()
        self.scene = self.write("scene.glsl", "void mainImage(out vec4 color, in vec2 at) { color = vec4(1.0); }\n")
        self.roots = self.write("roots.glsl", ROOTS)

    def client(self, **capabilities) -> Client:
        client = Client("--measure", "900", capabilities=capabilities)  # else a busy machine cuts it
        self.addCleanup(client.end)
        return client

    def actions(self, client: Client, path: pathlib.Path, line: int) -> list[dict]:
        at = {"line": line, "character": 0}
        return client.request("textDocument/codeAction", {"textDocument": {"uri": path.as_uri()}, "range": {"start": at, "end": at},
                                                          "context": {"diagnostics": []}})["result"]

    def hints(self, client: Client, path: pathlib.Path, words: str) -> list[dict]:
        """The next ones with these words that are of a fix."""
        found = client.diagnostics(path, lambda found: any(self.is_fix(each) and words in each["message"] for each in found))
        return [each for each in found if self.is_fix(each)]

    @staticmethod
    def is_fix(diagnostic: dict) -> bool:
        return "\n  fix: " in diagnostic["message"]

    def edited(self, text: str, edits: list[dict]) -> str:
        lines = text.splitlines(keepends=True)
        for edit in sorted(edits, key=lambda edit: (edit["range"]["start"]["line"], edit["range"]["start"]["character"]), reverse=True):
            start, end = edit["range"]["start"], edit["range"]["end"]
            self.assertEqual(start["line"], end["line"])
            line = lines[start["line"]]
            lines[start["line"]] = line[:start["character"]] + edit["newText"] + line[end["character"]:]
        return "".join(lines)

    def test_fixes_of_an_unsaved_text_are_those_of_check(self) -> None:
        client = self.client()
        client.open(self.scene, FAULTY)
        client.open(self.roots)
        hint, = self.hints(client, self.roots, "sqrt")
        self.assertEqual((hint["severity"], hint["range"]["start"]["line"]), (4, 1))
        self.assertRegex(hint["message"], r"^`sqrt\(x\)`: .*\n  fix: .*\n(.*\n)*  elsewhere: ")
        root, = self.actions(client, self.roots, 1)
        self.assertEqual(self.edited(ROOTS, root["edit"]["changes"][self.roots.as_uri()]), ROOTS.replace("sqrt(x)", "sqrt(max(x, 0.0))"))
        self.assertEqual(self.actions(client, self.roots, 0), [])
        self.hints(client, self.scene, "sum")
        one, both = self.actions(client, self.scene, 3)
        self.assertEqual(self.edited(FAULTY, one["edit"]["changes"][self.scene.as_uri()]), FAULTY.replace("sum;", "sum = 0.0;", 1))
        self.assertEqual(both["title"], "Apply all 2 measured fixes")
        self.assertEqual(set(both["edit"]["changes"]), {self.scene.as_uri(), self.roots.as_uri()})
        # The same that the command offers of the text on disk.
        self.scene.write_text(FAULTY)
        done = self.run_program("check", "--fix", "scene.glsl", "--json", "--budget", "900")
        self.assertEqual({"Fix: " + each["cure"] for each in json.loads(done.stdout)["cures"]}, {root["title"], one["title"]})

    def test_a_changed_text_has_no_fix(self) -> None:
        client = self.client(workspace={"workspaceEdit": {"documentChanges": True}})
        client.open(self.scene, FAULTY, version=7)
        self.hints(client, self.scene, "sum")
        one, = [each for each in self.actions(client, self.scene, 3) if each["title"].startswith("Fix: ")]
        change, = one["edit"]["documentChanges"]
        self.assertEqual(change["textDocument"], {"uri": self.scene.as_uri(), "version": 7})
        fixed = self.edited(FAULTY, change["edits"])
        client.change(self.scene, FAULTY.replace("0.5", "0.25"), 8)
        self.assertEqual(self.actions(client, self.scene, 3), [])
        client.diagnostics(self.scene, lambda found: not any(self.is_fix(each) for each in found))
        client.kept.clear()
        client.change(self.scene, fixed, 9)
        client.open(self.roots)
        self.hints(client, self.roots, "sqrt")  # measured anew
        self.assertEqual(self.actions(client, self.scene, 3), [])
        self.assertEqual(len(self.actions(client, self.roots, 1)), 1)

    def test_an_include_that_changed_on_disk_has_no_fix(self) -> None:
        client = self.client()
        client.open(self.scene, FAULTY)
        self.hints(client, self.scene, "sum")
        self.assertNotEqual(self.actions(client, self.scene, 3), [])
        self.roots.write_text(ROOTS.replace("Straße", "changed"))
        self.assertEqual(self.actions(client, self.scene, 3), [])

    def test_the_error_in_float(self) -> None:
        """Around 1e8 a float counts in steps of 8."""
        client = self.client()
        client.open(self.scene, "void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(mod(1e8 + p.x, 128.0)) / 100.0, 1.0); }\n")
        measured = client.wait(lambda m: m.get("method") == "$/tidemark/measured")["params"]
        self.assertEqual(measured["scene"], str(self.scene))
        self.assertAlmostEqual(measured["worst"], 0.035, delta=1e-6)  # pixels are at 0.5, 1.5 …
        self.assertAlmostEqual(measured["rmse"], 0.01 * (sum((i + 0.5) ** 2 for i in range(4)) / 4) ** 0.5, delta=1e-6)
        client.change(self.scene, "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }\n", 2)
        self.assertEqual(client.wait(lambda m: m.get("method") == "$/tidemark/measured")["params"], {"scene": str(self.scene)})
        measured = client.wait(lambda m: m.get("method") == "$/tidemark/measured")["params"]
        self.assertEqual((measured["rmse"], measured["worst"]), (0, 0))

    def test_a_change_ends_a_measurement(self) -> None:
        def measuring() -> list[int]:
            """The children of a lower priority."""
            own = client.process.pid
            children = [int(each) for each in pathlib.Path(f"/proc/{own}/task/{own}/children").read_text().split()]
            with contextlib.suppress(ProcessLookupError):
                return [each for each in children if os.getpriority(os.PRIO_PROCESS, each) > os.getpriority(os.PRIO_PROCESS, own)]
            return []

        client = self.client()
        client.open(self.scene, FAULTY)
        until = time.monotonic() + TIME_LIMIT
        while not (begun := measuring()):
            self.assertLess(time.monotonic(), until)
            time.sleep(0.02)
        client.change(self.scene, FAULTY.replace("uv.y", "wrong"), 2)
        client.diagnostics(self.scene, lambda found: any("wrong" in each["message"] for each in found))
        self.assertFalse(pathlib.Path(f"/proc/{begun[0]}").exists())
        self.assertEqual([m for m in client.kept if "fix: " in json.dumps(m)], [])


class Display(Features):
    def test_folding(self) -> None:
        found = self.client.about("foldingRange", self.scene)["result"]
        lines = {(each["startLine"], each["endLine"]) for each in found}
        self.assertLessEqual({(4, 5), (7, 13), (9, 11), (15, 18)}, lines)
        self.client.open(self.shapes)
        found = self.client.about("foldingRange", self.shapes)["result"]
        self.assertIn({"startLine": 2, "endLine": 3, "kind": "comment"}, found)

    def test_semantic_tokens(self) -> None:
        legend = self.client.capabilities["semanticTokensProvider"]["legend"]
        data = self.client.about("semanticTokens/full", self.scene)["result"]["data"]
        lines, found, line, column = SCENE.splitlines(), {}, 0, 0
        for i in range(0, len(data), 5):
            line, column = line + data[i], data[i + 1] + (column if data[i] == 0 else 0)
            word = lines[line][column:column + data[i + 2]]
            kinds = [name for bit, name in enumerate(legend["tokenModifiers"]) if data[i + 4] >> bit & 1]
            found.setdefault((line, word), (legend["tokenTypes"][data[i + 3]], *kinds))
        for place, kind in (((7, "shade"), ("function", "declaration")), ((7, "at"), ("parameter", "declaration")),
                            ((10, "ball"), ("function",)), ((10, "size"), ("variable", "readonly")), ((11, "sum2"), ("variable",)),
                            ((16, "Hit"), ("struct",)), ((17, "TWICE"), ("macro",)), ((17, "SUN"), ("variable", "readonly")),
                            ((17, "iResolution"), ("variable", "readonly", "defaultLibrary")), ((17, "xy"), ("property",)),
                            ((17, "vec3"), ("type", "defaultLibrary")), ((5, "never"), ("comment",)),
                            ((2, "x"), ("parameter",))):
            self.assertEqual(found.get(place), kind, place)


class Hostile(Features):
    def test_malformed_texts_are_answered_quickly(self) -> None:
        many = "void f() {" + "{ int x; }" * 20000 + "x; x.y(" + "(" * 20000 + "x" + ")." * 20000
        for text in (many, "struct S {" * 5000, "#define A(" * 5000, "for (" * 5000, "if (a) " * 5000 + ";", "float " * 5000,
                     "a ? b : " * 5000, "}" * 5000, "[" * 5000, "\0\xff" * 100):
            self.version += 1
            self.client.change(self.scene, text, self.version)
            end = {"line": text.count("\n"), "character": len(text)}
            for method, more in (("completion", {}), ("signatureHelp", {}), ("references", {}), ("rename", {"newName": "y"}),
                                 ("semanticTokens/full", {}), ("foldingRange", {}), ("documentHighlight", {})):
                with self.subTest(text=text[:20], method=method):
                    answer = self.client.at(method, self.scene, end["line"], end["character"], **more)
                    self.assertTrue("result" in answer or "error" in answer)


if __name__ == "__main__":
    main(needs_context=False)
