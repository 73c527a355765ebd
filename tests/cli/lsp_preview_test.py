"""tidemark lsp: previews in browsers and windows that draw the unsaved texts of the editor, by a scripted editor."""
import os
import pathlib
import shutil
import signal
import subprocess
import unittest
import urllib.parse

from support import png
from support.lsp_client import Client
from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, main
from support.websocket import Viewer, ask

SCENE = """\
#iUniform float blue = 0.25 in { 0.0, 1.0 }
#include "level.glsl"
void mainImage(out vec4 c, in vec2 p) { c = vec4(RED, level(), blue, 1.0); }
"""
LEVEL = "#define RED 0.0\nfloat level() { return 0.0; }\n"


def descendants(process: int) -> list[str]:
    """The command lines of the children of a process."""
    children = pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()
    return [pathlib.Path(f"/proc/{child}/cmdline").read_text() for child in children]


class Preview(ProgramTest):
    def setUp(self) -> None:
        super().setUp()
        self.folder = self.folder.resolve()
        self.level = self.write("level.glsl", LEVEL)
        self.scene = self.write("a scene.glsl", SCENE)

    def client(self, *arguments: str) -> Client:
        client = Client(*arguments)
        self.addCleanup(client.end)
        return client

    def command(self, client: Client, name: str, path: pathlib.Path | None = None, *more) -> dict:
        return client.request("workspace/executeCommand", {"command": f"tidemark.{name}",
                                                           "arguments": [(path or self.scene).as_uri(), *more]})

    def open(self, client: Client, path: pathlib.Path | None = None, *more) -> dict:
        return self.command(client, "openPreview", path, *more)["result"]

    def viewer(self, preview: dict) -> Viewer:
        viewer = Viewer(preview["url"], token=preview["token"])
        self.addCleanup(viewer.close)
        self.assertEqual(viewer.status, 101)
        return viewer

    def colour(self, file: bytes) -> list[int]:
        self.write("seen/seen.jpg", file)
        self.write("seen/seen.glsl", '#iChannel0 "seen.jpg"\nvoid mainImage(out vec4 c, in vec2 p)'
                                     " { c = texelFetch(iChannel0, ivec2(p), 0); }\n")
        self.succeed("capture", "seen/seen.glsl", "--size", "8x8", "-o", "seen/seen.png")
        return list(png.read(self.folder / "seen/seen.png").rows[4][:3])

    def seen_until(self, viewer: Viewer, wanted) -> None:
        """Waits for a picture whose colour is `wanted`."""
        while True:
            if wanted(*self.colour(viewer.picture()[1])):
                return


class Texts(Preview):
    def test_unsaved_scene_and_include_are_drawn(self) -> None:
        client = self.client()
        client.open(self.scene)
        client.open(self.level, LEVEL.replace("return 0.0", "return 1.0"))
        viewer = self.viewer(self.open(client))
        self.seen_until(viewer, lambda r, g, b: g > 240 and r < 15)
        client.change(self.level, LEVEL.replace("RED 0.0", "RED 1.0"), 2)
        self.seen_until(viewer, lambda r, g, b: r > 240 and g < 15)
        client.change(self.scene, SCENE.replace("RED,", "0.5 * RED,"), 2)
        self.seen_until(viewer, lambda r, g, b: 100 < r < 150)
        client.notify("textDocument/didClose", {"textDocument": {"uri": self.level.as_uri()}})
        self.seen_until(viewer, lambda r, g, b: r < 15 and g < 15)
        self.assertEqual((self.scene.read_text(), self.level.read_text()), (SCENE, LEVEL))
        self.assertEqual(sorted(os.listdir(self.folder)), ["a scene.glsl", "level.glsl", "seen"])
        self.assertEqual(client.close(), 0)

    def test_unsaved_passes_of_a_folder_are_drawn(self) -> None:
        buffer_a = self.write("s/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.0); }\n")
        image = self.write("s/image.glsl", '#iChannel0 "buffer_a.glsl"\nvoid mainImage(out vec4 c, in vec2 p) '
                           "{ c = texelFetch(iChannel0, ivec2(p), 0); }\n")
        client = self.client()
        client.open(image)
        viewer = self.viewer(self.open(client, image))
        self.seen_until(viewer, lambda r, g, b: r < 15)
        client.open(buffer_a, buffer_a.read_text().replace("0.0", "1.0"))
        self.seen_until(viewer, lambda r, g, b: r > 240)

    def test_the_title_has_the_measured_error_of_the_text(self) -> None:
        client = self.client("--measure", "900")
        client.open(self.scene)
        viewer = self.viewer(self.open(client))
        viewer.picture()
        viewer.text("title", lambda title: title.endswith(", error 0 of 255, worst 0"))
        client.change(self.scene, SCENE.replace("(), blue", "(), mod(1e8 + p.x, 128.0) / 100.0"), 2)
        viewer.text("title", lambda title: "error" not in title)
        viewer.text("title", lambda title: title.endswith(", error 3.4 of 255, worst 8.9"))
        self.command(client, "closePreview")
        later = self.viewer(self.open(client))
        later.picture()
        later.text("title", lambda title: title.endswith(", error 3.4 of 255, worst 8.9"))

    def test_an_error_keeps_the_picture_and_is_shown_in_both_places(self) -> None:
        client = self.client()
        client.open(self.scene)
        viewer = self.viewer(self.open(client))
        head, _ = viewer.picture()
        client.change(self.scene, SCENE.replace("level()", "nowhere()"), 2)
        errors = viewer.text("state", lambda state: state["errors"])["errors"]
        self.assertIn("nowhere", errors[0]["text"])
        self.assertIn("nowhere()", errors[0]["line"], "the line of the unsaved text")
        found = client.diagnostics(self.scene, lambda found: any(each["severity"] == 1 for each in found))
        self.assertIn("nowhere", found[0]["message"])
        self.assertEqual(viewer.pictures, [])
        client.change(self.scene, SCENE.replace("level()", "1.0"), 3)
        self.seen_until(viewer, lambda r, g, b: g > 240)
        viewer.text("state", lambda state: not state["errors"])
        self.assertEqual(head["number"], 1)

    def test_knobs_and_time_stay(self) -> None:
        client = self.client()
        client.open(self.scene)
        viewer = self.viewer(self.open(client))
        viewer.picture()
        viewer.send("pause")
        viewer.send("seek", seconds=2.5)
        viewer.send("turn", name="blue", value=[1.0])
        self.seen_until(viewer, lambda r, g, b: b > 240)
        client.change(self.scene, SCENE.replace("RED,", "iTime / 2.5 + RED,"), 2)
        self.seen_until(viewer, lambda r, g, b: r > 240 and b > 240)
        viewer.text("state", lambda state: state["knobs"] and state["knobs"][0]["value"] == [1.0] and state["time"]["paused"])

    def test_a_scene_that_loads_only_after_an_edit(self) -> None:
        client = self.client()
        client.open(self.scene, SCENE.replace("level.glsl", "missing.glsl"))
        viewer = self.viewer(self.open(client))
        viewer.text("state", lambda state: state["errors"])
        client.change(self.scene, SCENE.replace("RED", "1.0"), 2)
        self.seen_until(viewer, lambda r, g, b: r > 240)

    def test_a_text_that_crashes_the_driver_is_compiled_in_another_process(self) -> None:
        """The driver divides by zero at compile time."""
        crash = ("const int A = -1;\nvoid mainImage(out vec4 c, in vec2 p) {\n    float values[4];\n"
                 "    values[0] = float((-2147483647 - 1) / A);\n    c = vec4(values[0] < 0.0 ? 1.0 : 0.0);\n}\n")
        client = self.client()
        client.open(self.scene)
        viewer = self.viewer(self.open(client))
        viewer.picture()
        client.change(self.scene, crash, 2)
        errors = viewer.text("state", lambda state: state["errors"])["errors"]
        self.assertIn("the driver crashed", errors[0]["text"])
        client.change(self.scene, SCENE.replace("RED", "1.0"), 3)
        self.seen_until(viewer, lambda r, g, b: r > 240)


class Life(Preview):
    def test_a_scene_has_one_preview(self) -> None:
        client = self.client()
        client.open(self.scene)
        first = self.open(client)
        self.assertEqual(first["url"], f"http://127.0.0.1:{first['port']}/#token={first['token']}")
        self.assertEqual(self.open(client, self.level), first, "an include belongs to the scene")
        self.assertEqual([each.split("\0")[1] for each in descendants(client.process.pid) if "serve" in each], ["serve"])
        self.assertIsNone(self.command(client, "closePreview")["result"])
        self.assertEqual([each for each in descendants(client.process.pid) if "serve" in each], [])
        self.assertNotEqual(self.open(client)["token"], first["token"])

    def test_preview_ends_with_the_server(self) -> None:
        for end in ("shutdown", "closed input", "killed"):
            with self.subTest(end):
                client = self.client()
                client.open(self.scene)
                viewer = self.viewer(self.open(client))
                viewer.picture()
                if end == "shutdown":
                    self.assertEqual(client.close(), 0)
                elif end == "killed":
                    client.process.send_signal(signal.SIGKILL)
                    client.process.wait(timeout=TIME_LIMIT)
                else:
                    client.process.stdin.close()
                    self.assertEqual(client.process.wait(timeout=TIME_LIMIT), 1)
                viewer.end()  # the connection is closed

    def test_without_arguments_the_scene_that_was_edited_last(self) -> None:
        client = self.client()
        command = {"command": "tidemark.openPreview"}
        self.assertIn("error", client.request("workspace/executeCommand", command))
        client.open(self.write("other.glsl", SCENE))
        client.open(self.scene)
        self.assertEqual(client.request("workspace/executeCommand", command)["result"], self.open(client))

    def test_two_requests_before_the_preview_is_ready(self) -> None:
        client = self.client()
        client.open(self.scene)
        params = {"command": "tidemark.openPreview", "arguments": [self.scene.as_uri()]}
        for number in (71, 72):
            client.send({"id": number, "method": "workspace/executeCommand", "params": params})
        results = [client.wait(lambda m, n=number: m.get("id") == n)["result"] for number in (72, 71)]
        self.assertEqual(results[0], results[1])

    def test_a_preview_that_ends_is_reported_and_reopened(self) -> None:
        client = self.client()
        client.open(self.scene)
        first = self.open(client)
        children = pathlib.Path(f"/proc/{client.process.pid}/task/{client.process.pid}/children").read_text().split()
        for child in children:
            os.kill(int(child), signal.SIGKILL)
        shown = client.wait(lambda m: m.get("method") == "window/showMessage")["params"]
        self.assertEqual((shown["type"], shown["message"]), (1, "the preview of a scene.glsl has ended"))
        self.assertNotEqual(self.open(client)["token"], first["token"])

    def test_invalid_commands_are_refused(self) -> None:
        client = self.client()
        other = self.write("lonely/lonely.glsl", "float x;\n")
        for params, why in (({"command": "tidemark.fly", "arguments": []}, "no command 'tidemark.fly'"),
                            ({"command": "tidemark.openPreview", "arguments": ["untitled:1"]}, "save it first"),
                            ({"command": "tidemark.openPreview", "arguments": []}, ""), ({"command": 7}, ""), ([], ""),
                            ({"command": "tidemark.openPreview", "arguments": 7}, ""),
                            ({"command": "tidemark.openPreview", "arguments": [self.scene.as_uri(), {"ancestor": [7]}]}, ""),
                            ({"command": "tidemark.openPreview", "arguments": [other.as_uri()]}, "is no scene"),
                            ({"command": "tidemark.openPreview", "arguments": [self.scene.as_uri(), {"ancestor": "https:"}]},
                             "'https:' cannot frame the page")):
            with self.subTest(params=params):
                self.assertIn(why, client.request("workspace/executeCommand", params)["error"]["message"])
        self.assertEqual(client.close(), 0)


class Frames(Preview):
    def header(self, preview: dict) -> str:
        """The page's Content-Security-Policy."""
        at = urllib.parse.urlsplit(preview["url"])
        done = subprocess.run(["curl", "-si", f"http://{at.netloc}/"], capture_output=True, text=True, timeout=TIME_LIMIT, check=True)
        return next(line for line in done.stdout.splitlines() if line.startswith("Content-Security-Policy"))

    @unittest.skipUnless(shutil.which("curl"), "there is no curl")
    def test_named_pages_may_embed_the_preview(self) -> None:
        client = self.client()
        client.open(self.scene)
        closed = self.open(client)
        self.assertIn("frame-ancestors 'none';", self.header(closed))
        framed = self.open(client, None, {"ancestor": "vscode-webview:"})
        self.assertIn("frame-ancestors vscode-webview:;", self.header(framed))
        self.assertEqual(self.open(client), framed, "more than is asked for")
        both = self.open(client, None, {"ancestor": ["https://*.vscode-cdn.net", "http://localhost:8000"]})
        self.assertIn("frame-ancestors https://*.vscode-cdn.net http://localhost:8000 vscode-webview:;", self.header(both))

    def test_a_named_forwarded_address(self) -> None:
        client = self.client()
        client.open(self.scene)
        first = self.open(client)
        origin = "https://name-8080.example.dev"
        again = self.open(client, None, {"origin": origin})
        self.assertEqual(again["port"], first["port"], "a forwarded address stays valid")
        viewer = Viewer(again["url"], token=again["token"], Host="name-8080.example.dev", Origin=origin)
        self.addCleanup(viewer.close)
        self.assertEqual(viewer.status, 101)
        self.assertEqual(self.open(client), again)

    def test_the_page_needs_no_token_but_pictures_do(self) -> None:
        client = self.client()
        client.open(self.scene)
        preview = self.open(client)
        status, page = ask(preview["url"], "/")
        self.assertEqual(status, 200)
        self.assertNotIn(preview["token"].encode(), page)
        self.assertEqual(ask(preview["url"], "/?token=" + "a" * 22)[0], 403)
        stranger = Viewer(preview["url"], token="")
        stranger.close()
        self.assertEqual(stranger.status, 403)


@unittest.skipUnless(shutil.which("xvfb-run"), "there is no Xvfb")
class Window(Preview):
    def test_a_window_draws_the_unsaved_text(self) -> None:
        self.write("drive.py", """\
import os, pathlib, sys
from support.lsp_client import Client
scene = pathlib.Path(sys.argv[1])
client = Client(variables={"DISPLAY": os.environ["DISPLAY"]})
client.open(scene, sys.argv[2])
print(client.request("workspace/executeCommand", {"command": "tidemark.openWindow", "arguments": [scene.as_uri()]})["result"])
log = lambda words: client.wait(lambda m: m.get("method") == "window/logMessage" and words in m["params"]["message"])
log("undeclared")
client.change(scene, scene.read_text(), 2)
log("compiles")
client.change(scene, scene.read_text() + "// more\\n", 3)
log("reloaded in")
print(client.close())
""")
        done = subprocess.run(["xvfb-run", "-a", "python3", "drive.py", str(self.scene), SCENE.replace("RED", "wrong")],
                              cwd=self.folder, env={**environment(), "PYTHONPATH": os.environ["PYTHONPATH"]},
                              capture_output=True, text=True, timeout=TIME_LIMIT, check=False)
        self.assertEqual(done.stdout.split(), ["None", "0"], done.stderr)


NEOVIM = """
local start = vim.lsp.start_client({ name = "tidemark", cmd = { arg_program, "lsp", "--stdio" }, root_dir = vim.fn.getcwd() })
vim.lsp.buf_attach_client(0, start)
local function when_there(file, act)
  if vim.fn.filereadable(file) == 1 then act() else vim.defer_fn(function() when_there(file, act) end, 20) end
end
local function open()
  vim.lsp.buf_request(0, "workspace/executeCommand",
                      { command = "tidemark.openPreview", arguments = { vim.uri_from_bufnr(0) } },
                      function(_, result) io.stdout:write(result.url .. "\\n") io.stdout:flush() end)
end
vim.wait(60000, function() return vim.lsp.get_client_by_id(start) and vim.lsp.get_client_by_id(start).initialized end)
open()
when_there("edit", function()
  local lines = vim.api.nvim_buf_get_lines(0, 0, -1, false)
  lines[3] = lines[3]:gsub("RED", "1.0")
  vim.api.nvim_buf_set_lines(0, 0, -1, false, lines)
end)
when_there("end", function() vim.cmd("qall!") end)
"""


# Types an error, and corrects it when the window has shown it.
NEOVIM_WINDOW = """
local start = vim.lsp.start_client({ name = "tidemark", cmd = { arg_program, "lsp" }, root_dir = vim.fn.getcwd() })
vim.lsp.buf_attach_client(0, start)
vim.wait(60000, function() return vim.lsp.get_client_by_id(start) and vim.lsp.get_client_by_id(start).initialized end)
local function put(from, to)
  vim.schedule(function()
    local lines = vim.api.nvim_buf_get_lines(0, 0, -1, false)
    lines[3] = lines[3]:gsub(from, to)
    vim.api.nvim_buf_set_lines(0, 0, -1, false, lines)
  end)
end
local wrong = false
vim.lsp.handlers["window/logMessage"] = function(_, result)
  if not wrong and result.message:find("undeclared") then
    wrong = true
    put("nowhere", "RED")
  elseif wrong and result.message:find("compiles") then
    io.stdout:write("the error was shown, then the corrected text")
    vim.schedule(function() vim.cmd("qall!") end)
  end
end
vim.lsp.buf_request(0, "workspace/executeCommand",
                    { command = "tidemark.openWindow", arguments = { vim.uri_from_bufnr(0) } }, function() end)
put("RED", "nowhere")
"""


@unittest.skipUnless(shutil.which("nvim"), "there is no Neovim")
class Neovim(Preview):
    def test_text_typed_in_neovim_is_drawn(self) -> None:
        self.write("start.lua", f"local arg_program = {PROGRAM!r}\n{NEOVIM}")
        editor = subprocess.Popen(["nvim", "--clean", "--headless", str(self.scene), "-c", "luafile start.lua"], cwd=self.folder,
                                  env=environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            url = editor.stdout.readline().strip()
            viewer = self.viewer({"url": url, "token": url.partition("#token=")[2]})
            self.seen_until(viewer, lambda r, g, b: r < 15)
            self.write("edit", "")
            self.seen_until(viewer, lambda r, g, b: r > 240)
            self.assertEqual(self.scene.read_text(), SCENE)
            self.write("end", "")
            editor.wait(timeout=TIME_LIMIT)
            viewer.end()  # the preview has ended with the editor
        finally:
            editor.kill()
            editor.communicate()


    @unittest.skipUnless(shutil.which("xvfb-run"), "there is no Xvfb")
    def test_text_typed_in_neovim_is_drawn_in_a_window(self) -> None:
        self.write("start.lua", f"local arg_program = {PROGRAM!r}\n{NEOVIM_WINDOW}")
        done = subprocess.run(["xvfb-run", "-a", "nvim", "--clean", "--headless", str(self.scene), "-c", "luafile start.lua"],
                              cwd=self.folder, env=environment(), capture_output=True, text=True, timeout=TIME_LIMIT, check=False)
        self.assertIn("the error was shown, then the corrected text", done.stdout + done.stderr)


if __name__ == "__main__":
    main()
