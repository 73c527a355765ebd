"""An editor of a few lines: starts `tidemark lsp`, sends messages and waits for those it wants."""
from __future__ import annotations

import json
import pathlib
import queue
import subprocess
import threading

from support.program import PROGRAM, TIME_LIMIT, environment


def frame(text: bytes) -> bytes:
    return b"Content-Length: %d\r\n\r\n%s" % (len(text), text)


class Client:
    """Of one process. Answers and notifications come in through a thread, so that no wait is for a time."""

    def __init__(self, *arguments: str, capabilities: dict | None = None,
                 variables: dict | None = None) -> None:
        self.process = subprocess.Popen([PROGRAM, "lsp", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, env=environment(**(variables or {})))
        self.incoming: queue.Queue = queue.Queue()
        self.kept: list[dict] = []
        self.number = 0
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()
        self.capabilities = self.request("initialize", {"capabilities": capabilities or {}})["result"]["capabilities"]
        self.notify("initialized", {})

    def read(self) -> None:
        stream = self.process.stdout
        while header := stream.readline():
            length = int(header.split(b":")[1])
            stream.readline()
            self.incoming.put(json.loads(stream.read(length)))
        self.incoming.put(None)

    def send_bytes(self, data: bytes) -> None:
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message: dict) -> None:
        self.send_bytes(frame(json.dumps({"jsonrpc": "2.0", **message}).encode()))

    def notify(self, method: str, params: dict) -> None:
        self.send({"method": method, "params": params})

    def wait(self, wanted) -> dict:
        """The first message, from now or kept before, that is `wanted`; the others are kept."""
        for i, message in enumerate(self.kept):
            if wanted(message):
                return self.kept.pop(i)
        while True:
            message = self.incoming.get(timeout=TIME_LIMIT)
            if message is None:
                raise AssertionError("the server ended: " + self.process.stderr.read().decode())
            if wanted(message):
                return message
            self.kept.append(message)

    def request(self, method: str, params: dict) -> dict:
        self.number += 1
        number = self.number
        self.send({"id": number, "method": method, "params": params})
        return self.wait(lambda message: message.get("id") == number)

    def diagnostics(self, path: pathlib.Path, wanted=lambda found: True) -> list[dict]:
        """The next list for that file that is `wanted`."""
        uri = path.as_uri()
        return self.wait(lambda m: m.get("method") == "textDocument/publishDiagnostics" and m["params"]["uri"] == uri
                         and wanted(m["params"]["diagnostics"]))["params"]["diagnostics"]

    def open(self, path: pathlib.Path, text: str | None = None, version: int = 1) -> None:
        self.notify("textDocument/didOpen", {"textDocument": {
            "uri": path.as_uri(), "languageId": "glsl", "version": version,
            "text": path.read_text() if text is None else text}})

    def change(self, path: pathlib.Path, text: str, version: int) -> None:
        self.notify("textDocument/didChange", {"textDocument": {"uri": path.as_uri(), "version": version},
                                               "contentChanges": [{"text": text}]})

    def at(self, method: str, path: pathlib.Path, line: int, character: int, **more) -> dict:
        return self.request("textDocument/" + method, {"textDocument": {"uri": path.as_uri()},
                                                       "position": {"line": line, "character": character}, **more})

    def about(self, method: str, path: pathlib.Path) -> dict:
        return self.request("textDocument/" + method, {"textDocument": {"uri": path.as_uri()}})

    def close(self) -> int:
        """The code that the server ends with."""
        if self.process.poll() is None:
            self.request("shutdown", {})
            self.notify("exit", {})
        return self.end()

    def end(self) -> int:
        """Whatever the server is at. A client may be ended twice."""
        self.process.stdin.close()
        code = self.process.wait(timeout=TIME_LIMIT)
        self.reader.join()
        self.process.stdout.close()
        self.process.stderr.close()
        return code
