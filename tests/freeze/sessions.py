"""Programs that run until they are told to end: the language server, and `serve` with one viewer."""
from __future__ import annotations

import json
import queue
import shutil
import threading

from commands import HERE
from contents import sha
from items import Item, Seen
from normal import Normal
from sides import TIME_LIMIT, Side
from support.websocket import Viewer, ask

SCENE = "knobs.glsl"
REQUESTS = [("hover", 8, 12), ("hover", 2, 17), ("definition", 10, 14), ("completion", 7, 12), ("signatureHelp", 10, 20),
            ("references", 6, 6), ("documentHighlight", 6, 6), ("prepareRename", 6, 6)]
WHOLE_FILE = ["documentSymbol", "documentColor", "foldingRange", "semanticTokens/full", "documentLink", "formatting", "codeLens"]


class Editor:
    """Sends one message at a time and waits for its answer; keeps the diagnostics of each file."""

    def __init__(self, side: Side, folder) -> None:
        import subprocess
        self.process = side.start(["lsp"], folder, stdin=subprocess.PIPE)
        self.number = 0
        self.incoming: queue.Queue = queue.Queue()
        threading.Thread(target=self.read, daemon=True).start()

    def read(self) -> None:
        stream = self.process.stdout
        while header := stream.readline():
            length = int(header.split(b":")[1])
            stream.readline()
            self.incoming.put(json.loads(stream.read(length)))
        self.incoming.put(None)

    def send(self, **message) -> None:
        text = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(text), text))
        self.process.stdin.flush()

    def wait(self, wanted) -> dict:
        while True:
            message = self.incoming.get(timeout=TIME_LIMIT)
            if message is None or wanted(message):
                return message or {"ended": True}

    def request(self, method: str, params) -> dict:
        self.number += 1
        self.send(id=self.number, method=method, params=params)
        return self.wait(lambda message: message.get("id") == self.number)

    def diagnostics(self, uri: str, version_text: dict) -> dict:
        """Sends a notification about a document and returns the diagnostics that follow."""
        self.send(**version_text)
        return self.wait(lambda message: message.get("method") == "textDocument/publishDiagnostics"
                         and message["params"]["uri"] == uri)["params"]


def look_at_lsp(side: Side, wording: bool) -> Seen:
    folder = side.fresh_folder("lsp")
    shutil.copytree(HERE / "scenes", folder, dirs_exist_ok=True)
    normal = Normal(folder, wording)
    editor = Editor(side, folder)
    seen: Seen = {}
    try:
        seen["initialize"] = normal.json(editor.request("initialize", {"capabilities": {}}))
        editor.send(method="initialized", params={})
        for name in (SCENE, "broken.glsl", "foam.glsl", "desktop.glsl"):
            uri, text = (folder / name).as_uri(), (folder / name).read_text()
            document = {"uri": uri, "languageId": "glsl", "version": 1, "text": text}
            seen[f"diagnostics of {name}"] = normal.json(editor.diagnostics(
                uri, {"method": "textDocument/didOpen", "params": {"textDocument": document}}))
        document = {"uri": (folder / SCENE).as_uri()}
        for method, line, character in REQUESTS:
            answer = editor.request("textDocument/" + method, {
                "textDocument": document, "position": {"line": line, "character": character},
                "context": {"includeDeclaration": True}})
            seen[f"{method} at {line}:{character}"] = normal.json(answer)
        for method in WHOLE_FILE:
            seen[method] = normal.json(editor.request("textDocument/" + method, {
                "textDocument": document, "options": {"tabSize": 4, "insertSpaces": True}}))
        seen["nothing"] = normal.json(editor.request("textDocument/nothing", {}))
        seen["shutdown"] = normal.json(editor.request("shutdown", {}))
        editor.send(method="exit")
        editor.process.stdin.close()
        seen["exit code"] = [str(editor.process.wait(TIME_LIMIT))]
        seen["standard error"] = normal.text(editor.process.stderr.read())
    finally:
        editor.process.kill()
        editor.process.wait()
    return seen


def look_at_serve(side: Side, wording: bool) -> Seen:
    """Compares the page, the answers to requests without a token, the first texts and the first picture, and how it ends."""
    folder = side.fresh_folder("serve")
    shutil.copytree(HERE / "scenes", folder, dirs_exist_ok=True)
    (folder / "token.txt").write_text("0123456789abcdef0123456789abcdef\n")
    normal = Normal(folder, wording)
    seen: Seen = {}
    process = side.start(["serve", "sum.glsl", "--size", "64x36", "--port", "0", "--token-file", "token.txt", "--once"], folder)
    try:
        address = process.stdout.readline().decode().strip()
        seen["address"] = normal.text(address.encode())
        if address:
            path = "/" + address.partition("//")[2].partition("/")[2]
            for name, asked, method in (("page", path, "GET"), ("no token", "/", "GET"), ("nothing", "/nothing", "GET"),
                                        ("post", path, "POST")):
                status, body = ask(address, asked, method=method)
                seen[f"{name}: status"] = [str(status)]
                seen[f"{name}: answer"] = normal.text(body)
            viewer = Viewer(address)
            seen["viewer: status"] = [str(viewer.status)]
            head, picture = viewer.picture()
            seen["viewer: keys of the picture's head"] = sorted(head)
            seen["viewer: picture"] = [f"{len(picture)} bytes", f"sha256 {sha(picture)}"]
            viewer.close()  # the last viewer: --once ends the program
        seen["exit code"] = [str(process.wait(TIME_LIMIT))]
        seen["standard output"] = normal.text(process.stdout.read())
        seen["standard error"] = normal.text(process.stderr.read())
    finally:
        process.kill()
        process.wait()
    return seen


def items(wording: bool):
    yield Item("commands", "lsp", lambda side: look_at_lsp(side, wording))
    yield Item("commands", "serve session", lambda side: look_at_serve(side, wording))
