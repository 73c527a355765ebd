"""tidemark lsp: each capability, by a scripted editor."""
import json
import pathlib
import re
import shutil
import subprocess
import unittest

from support.lsp_client import Client, frame
from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, main

GOOD = """\
// How bright it is.
#iUniform float bright = 0.5 in { 0.0, 2.0 }
#iUniform color3 tint = color3(1.0, 0.5, 0.0)
#include "shapes.glsl"
#define TURN 6.28

/// The colour at a place.
vec3 paint(vec2 p) {
    return tint * bright * disc(p) * sqrt(p.x / TURN);
}
void mainImage(out vec4 c, in vec2 p) {
    c = vec4(paint(p / iResolution.xy), 1.0);
}
"""
SHAPES = """\
// Shapes with soft edges.

// 1 inside of the unit disc.
float disc(vec2 p) { return smoothstep(1.0, 0.9, length(p)); }
const float EDGE = 0.1, WIDTH = 2.0;
struct Ray { vec3 from; vec3 to; };
"""
ERROR, WARNING, INFORMATION, HINT = 1, 2, 3, 4


def errors(found: list[dict]) -> list[dict]:
    return [each for each in found if each["severity"] == ERROR]


def span(found: dict) -> tuple:
    start, end = found["range"]["start"], found["range"]["end"]
    return start["line"], start["character"], end["line"], end["character"]


class Lsp(ProgramTest):
    def setUp(self) -> None:
        super().setUp()
        self.folder = self.folder.resolve()

    def test_a_projects_json_has_diagnostics_in_its_code(self):
        passes = [{"name": "Common", "type": "common", "code": "float half_of(float x) { return 0.5 * x; }\n", "inputs": [],
                   "outputs": []},
                  {"name": "Image", "type": "image", "inputs": [], "outputs": [{"id": "37", "channel": 0}],
                   "code": "// \"code\": é\r\nvoid mainImage(out vec4 c, vec2 p) {\r\n    c = vec4(half_of(q));\r\n}"}]
        text = json.dumps({"ver": "0.1", "info": {"id": "1", "name": "code"}, "renderpass": passes}, indent=1)
        scene = self.write("p.json", text)
        client = self.client()
        client.open(scene)
        found = client.diagnostics(scene, lambda found: found)
        self.assertEqual(len(found), 1)
        self.assertIn("q' undeclared", found[0]["message"])
        start, end = found[0]["range"]["start"], found[0]["range"]["end"]
        self.assertEqual(text.splitlines()[start["line"]][start["character"]:end["character"]],
                         "    c = vec4(half_of(q));")
        self.assertIsNone(client.request("textDocument/hover", {"textDocument": {"uri": scene.as_uri()},
                                                                "position": start})["result"])
        client.change(scene, text.replace("half_of(q)", "half_of(p.x)"), 2)
        client.diagnostics(scene, lambda found: not found)

    def client(self, *arguments: str, **options) -> Client:
        client = Client(*arguments, **options)
        self.addCleanup(client.end)
        return client

    def scene(self) -> tuple[Client, pathlib.Path, pathlib.Path]:
        shapes = self.write("shapes.glsl", SHAPES)
        scene = self.write("a scene.glsl", GOOD)
        client = self.client()
        client.open(scene)
        return client, scene, shapes


class Diagnostics(Lsp):
    def test_unsaved_edits_are_compiled(self) -> None:
        client, scene, _ = self.scene()
        self.assertEqual(errors(client.diagnostics(scene)), [])
        client.change(scene, GOOD.replace("disc(p)", "disk(p)"), 2)
        found = errors(client.diagnostics(scene, errors))
        self.assertEqual(len(found), 1)
        self.assertEqual(found[0]["message"], "no function with name 'disk'")
        column = GOOD.splitlines()[8].index("disc")
        self.assertEqual(span(found[0]), (8, column, 8, column + 4))
        client.change(scene, GOOD, 3)
        client.diagnostics(scene, lambda found: not errors(found))
        self.assertEqual(client.close(), 0)

    def test_scenes_with_their_own_main(self) -> None:
        client = self.client()
        glslsandbox = "uniform float time;\nvoid main() { gl_FragColor = vec4(sin(tiem)); }\n"
        glslviewer = "#version 330\nuniform float u_time;\nout vec4 color;\nvoid main() { color = vec4(sin(u_tiem)); }\n"
        for name, text, line in (("sandbox.glsl", glslsandbox, 1), ("viewer.frag", glslviewer, 3)):
            with self.subTest(name):
                scene = self.write(name, text)
                client.open(scene)
                self.assertEqual([span(each)[0] for each in errors(client.diagnostics(scene, errors))], [line])
                client.change(scene, text.replace("tiem", "time"), 2)
                client.diagnostics(scene, lambda found: not errors(found))

    def test_vertex_shaders_are_skipped(self) -> None:
        vertex = self.write("vertex.glsl", "void main() { gl_Position = vec4(nowhere); }\n")
        scene = self.write("scene.glsl", SHAPES + "void main() { gl_FragColor = vec4(disc(nowhere)); }\n")
        client = self.client()
        client.open(vertex)
        client.open(scene)  # looked at after the one before it
        client.diagnostics(scene, errors)
        told = [message["params"] for message in client.kept if message.get("method") == "textDocument/publishDiagnostics"]
        self.assertEqual([each for each in told if each["uri"] == vertex.as_uri() and each["diagnostics"]], [])

    def test_an_error_in_an_include_has_its_place(self) -> None:
        client, scene, shapes = self.scene()
        client.diagnostics(scene)
        client.open(shapes, SHAPES.replace("length(p)", "lenght(p)"))
        found = errors(client.diagnostics(shapes, errors))
        self.assertEqual([each["range"]["start"]["line"] for each in found], [3])
        client.change(shapes, SHAPES, 2)
        client.diagnostics(shapes, lambda found: not errors(found))

    def test_an_open_include_is_compiled_with_its_scene(self) -> None:
        shapes = self.write("shapes.glsl", SHAPES.replace("smoothstep(", "smoothstep(0.0, "))
        self.write("a.glsl", GOOD)
        client = self.client()
        client.open(shapes)
        self.assertTrue(errors(client.diagnostics(shapes)))

    def test_errors_of_all_passes_of_a_folder(self) -> None:
        self.write("s/common.glsl", "float one() { return 1.0; }\n")
        self.write("s/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(wrong_a); }\n")
        self.write("s/buffer_b.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(wrong_b); }\n")
        image = self.write("s/image.glsl", '#iChannel0 "buffer_a.glsl"\nvoid mainImage(out vec4 c, in vec2 p) '
                           "{ c = texture(iChannel0, p) * one(); }\n")
        client = self.client()
        client.open(image)
        for name in "ab":
            found = errors(client.diagnostics(self.folder / f"s/buffer_{name}.glsl", errors))
            self.assertEqual([each["message"] for each in found], [f"`wrong_{name}' undeclared"])

    def test_columns_in_utf16_and_where_offered_in_utf8(self) -> None:
        text = "void mainImage(out vec4 c, in vec2 p) {\n  /* \u00e9\U0001F30A */ c = wrong;\n}\n"
        scene = self.write("a.glsl", text)
        line = text.splitlines()[1]
        before = line[:line.index("wrong")]
        for offered, encoding, units in ((None, "utf-16", len(before.encode("utf-16-le")) // 2),
                                         (["utf-32", "utf-8"], "utf-8", len(before.encode()))):
            client = self.client(capabilities={"general": {"positionEncodings": offered}} if offered else {})
            self.assertEqual(client.capabilities["positionEncoding"], encoding)
            client.open(scene)
            found = errors(client.diagnostics(scene, errors))
            self.assertEqual(span(found[0]), (1, units, 1, units + 5))
            self.assertEqual(client.close(), 0)

    def test_hints_for_code_that_only_some_drivers_accept(self) -> None:
        scene = self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) {\n  float sum;\n  if (p.x > 9.0) sum = 1.0;\n"
                           "  c = vec4(sum) + fma(1.0, 2.0, 3.0);\n}\n")
        client = self.client()
        client.open(scene)
        hints = client.diagnostics(scene, bool)
        self.assertEqual({each["severity"] for each in hints}, {HINT})
        self.assertTrue(any("sum has no value, on some path" in each["message"] for each in hints), hints)
        self.assertTrue(any("fma" in each["message"] for each in hints), hints)

    def test_the_newest_text_is_compiled(self) -> None:
        client, scene, _ = self.scene()
        for version in range(2, 40):
            client.change(scene, GOOD.replace("disc(p)", f"wrong{version}(p)"), version)
        found = errors(client.diagnostics(scene, errors))
        self.assertIn("wrong39", found[0]["message"])

    def test_a_misspelt_entry_point_is_reported(self) -> None:
        scene = self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        client = self.client()
        client.open(scene)
        client.diagnostics(scene)
        client.change(scene, scene.read_text().replace("mainImage", "mainImagee"), 2)
        self.assertIn("mainImage", errors(client.diagnostics(scene, errors))[0]["message"])

    def test_error_in_uncalled_function_is_a_hint(self) -> None:
        """As capture has it, which leaves it out; the site compiles it."""
        scene = self.write("a.glsl", "float f() { return wrong; }\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n")
        self.succeed("capture", "a.glsl", "--size", "16x9")
        client = self.client()
        client.open(scene)
        found = client.diagnostics(scene, bool)
        self.assertEqual({each["severity"] for each in found}, {HINT})
        self.assertIn((0, 19, 0, 24), [span(each) for each in found])

    def test_closing_removes_diagnostics(self) -> None:
        scene = self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = wrong; }\n")
        client = self.client()
        client.open(scene)
        client.diagnostics(scene, errors)
        client.notify("textDocument/didClose", {"textDocument": {"uri": scene.as_uri()}})
        client.diagnostics(scene, lambda found: not found)

    def test_a_text_that_exceeds_the_memory_is_a_diagnostic(self) -> None:
        doubling = "".join(f"#define A{i} A{i - 1} A{i - 1}\n" for i in range(1, 40))
        scene = self.write("a.glsl", f"#define A0 +1.0\n{doubling}void mainImage(out vec4 c, in vec2 p) {{ c = vec4(A39); }}\n")
        client = self.client("--timeout", "2", "--memory", "1G")
        client.open(scene)
        self.assertRegex(errors(client.diagnostics(scene, errors))[0]["message"], r"takes (more than 2 s|too much memory)")
        client.change(scene, GOOD.replace('#include "shapes.glsl"', "").replace("disc(p)", "wrong"), 2)
        self.assertIn("wrong", errors(client.diagnostics(scene, errors))[0]["message"])


class Questions(Lsp):
    def at(self, client: Client, method: str, path: pathlib.Path, text: str, word: str, **more):
        for number, line in enumerate(text.splitlines()):
            if word in line:
                return client.at(method, path, number, line.index(word) + 1, **more)
        self.fail(word)

    def hover(self, word: str, text: str = GOOD) -> str:
        client, scene, _ = self.scene()
        client.change(scene, text, 2)
        result = self.at(client, "hover", scene, text, word)["result"]
        return result["contents"]["value"] if result else ""

    def test_hover_on_a_knob(self) -> None:
        self.assertEqual(self.hover("bright *"), "```glsl\nuniform float bright\n```\nKnob, initially 0.5, from 0 to 2.\n")

    def test_hover_on_a_builtin_function(self) -> None:
        text = self.hover("sqrt")
        self.assertIn("float sqrt(float)\n", text)
        self.assertIn("Undefined of a negative number.", text)

    def test_hover_on_a_declaration_of_an_include(self) -> None:
        self.assertEqual(self.hover("disc(p)"),
                         "```glsl\nfloat disc(vec2 p)\n```\n1 inside of the unit disc.\n\nFrom `shapes.glsl`.\n")

    def test_hover_on_an_include(self) -> None:
        self.assertIn("Shapes with soft edges.", self.hover("#include"))

    def test_hover_reads_no_file_outside_the_scenes_folder(self) -> None:
        self.write("outside.txt", "// the secret of another\n")
        (self.folder / "inner").mkdir()
        scene = self.write("inner/a.glsl", '#include "../outside.txt"\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n')
        client = self.client()
        client.open(scene)
        self.assertIsNone(self.at(client, "hover", scene, scene.read_text(), "outside")["result"])

    def test_hover_on_a_host_uniform_and_on_a_number(self) -> None:
        self.assertIn("uniform vec3 iResolution", self.hover("iResolution"))
        self.assertEqual(self.hover("{ 0.0, 2.0"), "")

    def test_hover_on_channels_and_older_names(self) -> None:
        text = ("uniform mat4 iCamera;\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                "    c = texture2D(iChannel1, p) * iCamera[0] * iGlobalTime;\n}\n")
        self.assertIn("Input 1 of the pass", self.hover("iChannel1", text))
        self.assertIn("An older name of `texture`.\n\n```glsl\n", self.hover("texture2D", text))
        self.assertIn("An older name of `iTime`.\n\n```glsl\nuniform float iTime\n", self.hover("iGlobalTime", text))
        self.assertIn("Given by this host: the orbit camera", self.hover("iCamera[0]", text))
        text = "uniform float iBeat;\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(fract(iBeat)); }\n"
        self.assertIn("Given by this host: beats since the start", self.hover("iBeat))", text))

    def test_definitions_across_files(self) -> None:
        client, scene, shapes = self.scene()
        for word, path, text, name in (("disc(p)", shapes, SHAPES, "disc("), ("paint(p /", scene, GOOD, "paint("),
                                       ("TURN)", scene, GOOD, "TURN"), ("bright *", scene, GOOD, "bright")):
            with self.subTest(word):
                found = self.at(client, "definition", scene, GOOD, word)["result"]
                self.assertEqual([each["uri"] for each in found], [path.as_uri()])
                line = next(n for n, each in enumerate(text.splitlines()) if name in each)
                if name == "bright":
                    line = 1
                self.assertEqual(found[0]["range"]["start"]["line"], line)
        found = self.at(client, "definition", scene, GOOD, "#include")["result"]
        self.assertEqual([each["uri"] for each in found], [shapes.as_uri()])

    def test_symbols(self) -> None:
        client, scene, shapes = self.scene()
        names = [each["name"] for each in client.about("documentSymbol", scene)["result"]]
        self.assertEqual(names, ["bright", "tint", "TURN", "paint", "mainImage"])
        names = [each["name"] for each in client.about("documentSymbol", shapes)["result"]]
        self.assertEqual(names, ["disc", "EDGE", "WIDTH", "Ray"])

    def test_colours(self) -> None:
        client, scene, _ = self.scene()
        found = client.about("documentColor", scene)["result"]
        self.assertEqual([each["color"] for each in found], [{"red": 1, "green": 0.5, "blue": 0, "alpha": 1}])
        begin = GOOD.splitlines()[2].index("color3(")
        self.assertEqual(span(found[0]), (2, begin, 2, begin + len("color3(1.0, 0.5, 0.0)")))
        shown = client.request("textDocument/colorPresentation", {
            "textDocument": {"uri": scene.as_uri()}, "range": found[0]["range"],
            "color": {"red": 0.25, "green": 0, "blue": 1, "alpha": 1}})["result"]
        self.assertEqual(shown[0]["label"], "color3(0.25, 0, 1)")
        self.assertEqual(shown[0]["textEdit"]["range"], found[0]["range"])

    def test_renaming_a_knob_keeps_the_picture(self) -> None:
        client, scene, shapes = self.scene()
        edits = self.at(client, "rename", scene, GOOD, "bright *", newName="glow")["result"]["changes"]
        self.assertEqual(set(edits), {scene.as_uri()})
        lines = GOOD.splitlines(keepends=True)
        for edit in sorted(edits[scene.as_uri()], key=lambda edit: span(edit), reverse=True):
            line, begin, _, end = span(edit)
            lines[line] = lines[line][:begin] + edit["newText"] + lines[line][end:]
        self.write("renamed.glsl", "".join(lines))
        self.assertNotIn("bright *", "".join(lines))
        for name in ("a scene", "renamed"):
            self.succeed("capture", f"{name}.glsl", "--size", "32x18", "-o", f"{name}.png")
        self.succeed("compare", "a scene.png", "renamed.png", "--max-difference", "0")

    def test_renames_outside_the_scene_are_refused(self) -> None:
        client, scene, _ = self.scene()
        for word, name, why in (("TURN)", "x", "'TURN' is a macro"), ("mainImage", "x", "the host calls 'mainImage'"),
                                ("sqrt", "x", "given by GLSL or the host"),
                                ("iResolution", "x", "given by GLSL or the host"), ("bright *", "paint", "has that name already"),
                                ("bright *", "disc", "has that name already"), ("bright *", "2x", "not a GLSL name"),
                                ("bright *", "vec3", "reserved by GLSL or the host"), ("bright *", "while", "reserved by GLSL "
                                        "or the host"),
                                ("bright *", "main", "reserved by GLSL or the host"), ("bright *", "mainImage", "reserved by "
                                        "GLSL or the host")):
            with self.subTest(name):
                self.assertIn(why, self.at(client, "rename", scene, GOOD, word, newName=name)["error"]["message"])
        self.assertIn("is a macro", self.at(client, "prepareRename", scene, GOOD, "TURN)")["error"]["message"])
        self.assertIsNone(self.at(client, "prepareRename", scene, GOOD, "{ 0.0, 2.0")["result"])

    def test_work_is_linear_in_the_open_documents(self) -> None:
        """By what the server reads: each scene's include is read once when its document is opened."""
        self.write("shared.glsl", "float shared(vec2 p) { return p.x; }\n")
        counts = []
        for count in (40, 80):
            client = self.client()
            scenes = [self.write(f"{i}.glsl", f'#include "shared.glsl"\nvoid mainImage(out vec4 c, in vec2 p) {{ c = vec4(shared(p) * {i}.0); }}\n')
                      for i in range(count)]
            for scene in scenes:
                client.open(scene)
            self.assertIn("shared(vec2 p)", self.at(client, "hover", scenes[0], scenes[0].read_text(), "shared(p)")["result"]["contents"]["value"])
            with open(f"/proc/{client.process.pid}/io", encoding="ascii") as file:
                counts.append(int(re.search(r"rchar: (\d+)", file.read())[1]))
            client.process.kill()
        self.assertLess(counts[1], 2.5 * counts[0], "twice as many documents")


class Protocol(Lsp):
    def test_damaged_messages_are_answered(self) -> None:
        client = self.client()
        for text, code in ((b"{", -32700), (b"\xff\xfe", -32700), (b"[]", -32600), (b"7", -32600), (b"[" * 100000, -32700),
                           (b'{"jsonrpc": "2.0", "id": 1}', -32600)):
            client.send_bytes(frame(text))
            self.assertEqual(client.wait(lambda m: "error" in m)["error"]["code"], code)
        self.assertEqual(client.request("textDocument/teapot", {})["error"]["code"], -32601)
        for params in ({}, [], 7, {"textDocument": 7}, {"textDocument": {"uri": 7}}):
            self.assertEqual(client.request("textDocument/hover", params)["error"]["code"], -32602)
        self.assertEqual(client.close(), 0)

    def test_unreadable_files(self) -> None:
        client = self.client()
        for uri in ("untitled:Untitled-1", "http://x/a.glsl", "file://elsewhere/a.glsl", "file:///%zz", "file:///a%00b",
                    (self.folder / "missing.glsl").as_uri()):
            client.notify("textDocument/didChange", {"textDocument": {"uri": uri}, "contentChanges": [{"text": ""}]})
            answer = client.request("textDocument/documentSymbol", {"textDocument": {"uri": uri}})
            self.assertEqual(answer["error"]["code"], -32602, uri)
        self.assertEqual(client.close(), 0)

    def test_position_after_the_end(self) -> None:
        client, scene, _ = self.scene()
        for line, character in ((10**6, 0), (0, 10**6), (2**40, 2**40)):
            self.assertIn("result", client.at("hover", scene, line, character))

    def test_options_added_by_clients_are_accepted(self) -> None:
        for words in (("--stdio",), ("--stdio", "--clientProcessId=1234"), ("--clientProcessId", "1234", "--stdio")):
            self.assertEqual(self.client(*words).close(), 0)

    def test_requests_before_initialize_and_exit_before_shutdown_are_errors(self) -> None:
        process = subprocess.Popen([PROGRAM, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment())
        out, _ = process.communicate(frame(b'{"jsonrpc":"2.0","id":1,"method":"textDocument/hover"}') +
                                     frame(b'{"jsonrpc":"2.0","method":"exit"}'), timeout=TIME_LIMIT)
        self.assertIn(b"-32002", out)
        self.assertEqual(process.returncode, 1)  # no shutdown came before

    def test_a_stream_without_a_header_ends_the_server(self) -> None:
        done = subprocess.run([PROGRAM, "lsp"], input=b"hello\r\n\r\n", capture_output=True, env=environment(),
                              timeout=TIME_LIMIT, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn(b"Content-Length: N", done.stderr)


NEOVIM = """
vim.api.nvim_create_autocmd("DiagnosticChanged", { callback = function()
  local found = vim.diagnostic.get(0, { severity = vim.diagnostic.severity.ERROR })
  if #found > 0 then
    for _, d in ipairs(found) do io.stdout:write(("%d:%d-%d %s\\n"):format(d.lnum, d.col, d.end_col, d.message)) end
    vim.cmd("qall!")
  end
end })
local client = vim.lsp.start_client({ name = "tidemark", cmd = { arg_program, "lsp" }, root_dir = vim.fn.getcwd() })
vim.lsp.buf_attach_client(0, client)
"""


@unittest.skipUnless(shutil.which("nvim"), "there is no Neovim")
class Neovim(Lsp):
    def test_neovim_shows_the_drivers_errors(self) -> None:
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) {\n  c = wrong;\n}\n")
        self.write("start.lua", f"local arg_program = {PROGRAM!r}\n{NEOVIM}")
        done = subprocess.run(["nvim", "--clean", "--headless", "a.glsl", "-c", "luafile start.lua"], cwd=self.folder,
                              env=environment(), capture_output=True, timeout=TIME_LIMIT, check=False)
        self.assertIn(b"1:6-11 `wrong' undeclared", done.stdout + done.stderr)


if __name__ == "__main__":
    main()
