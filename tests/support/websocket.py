"""A WebSocket client over a plain socket (RFC 6455), as rude as a test wants it; and `tidemark serve` with such viewers."""
from __future__ import annotations

import base64
import json
import os
import re
import socket
import struct
import subprocess
import urllib.parse

from support.program import PROGRAM, environment

PATIENCE = 120.0  # nothing here is timed
TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


class Closed(Exception):
    """The server has closed the connection, with that code and reason."""

    def __init__(self, code: int = 1006, reason: str = "") -> None:
        super().__init__(f"closed with {code} {reason}")
        self.code, self.reason = code, reason


def ask(address: str, path: str, headers: dict[str, str] | None = None, method: str = "GET") -> tuple[int, bytes]:
    """The status of the answer, and what it brings."""
    connection, status, received = request(address, path, headers, method)
    with connection:
        while more := connection.recv(65536):
            received += more
    return status, received


def request(address: str, path: str, headers: dict[str, str] | None, method: str) -> tuple[socket.socket, int, bytes]:
    """The connection, the status of the answer, and what came behind its header so far."""
    at = urllib.parse.urlsplit(address)
    connection = socket.create_connection((at.hostname, at.port), PATIENCE)
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # as browsers do
    lines = [f"{method} {path} HTTP/1.1"] + [f"{name}: {value}" for name, value in {"Host": at.netloc, **(headers or {})}.items()]
    connection.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
    received = b""
    while b"\r\n\r\n" not in received:
        more = connection.recv(65536)
        if not more:
            return connection, 0, received
        received += more
    head, _, rest = received.partition(b"\r\n\r\n")
    return connection, int(head.split()[1]), rest


class Viewer:
    """Of an address as `serve` prints it. `status` is 101 where the server let it in."""

    def __init__(self, address: str, token: str | None = None, **headers: str) -> None:
        at = urllib.parse.urlsplit(address)
        query = at.query if token is None else f"token={token}"
        key = base64.b64encode(os.urandom(16)).decode()
        asked = {"Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Key": key, "Sec-WebSocket-Version": "13", **headers}
        self.connection, self.status, self.received = request(address, f"/socket?{query}", asked, "GET")
        self.texts: list[dict] = []
        self.pictures: list[tuple[dict, bytes]] = []

    def close(self) -> None:
        self.connection.close()

    def send_frame(self, kind: int, data: bytes) -> None:
        mask = os.urandom(4)
        size = len(data)
        length = bytes([0x80 | size]) if size < 126 else struct.pack(">BH", 0xFE, size) if size < 65536 else struct.pack(">BQ", 0xFF, size)
        masked = bytes(byte ^ mask[i % 4] for i, byte in enumerate(data))
        self.connection.sendall(bytes([0x80 | kind]) + length + mask + masked)

    def send(self, wanted: str, **values) -> None:
        self.send_frame(TEXT, json.dumps({"do": wanted, **values}).encode())

    def _take(self, count: int) -> bytes:
        while len(self.received) < count:
            more = self.connection.recv(1 << 20)
            if not more:
                raise Closed()
            self.received += more
        taken, self.received = self.received[:count], self.received[count:]
        return taken

    def receive(self) -> None:
        """One more message, into `texts` or `pictures`."""
        first, second = self._take(2)
        size = second & 127
        if size >= 126:
            size = int.from_bytes(self._take(2 if size == 126 else 8), "big")
        data = self._take(size)
        kind = first & 15
        if kind == CLOSE:
            raise Closed(int.from_bytes(data[:2], "big"), data[2:].decode())
        if kind == PING:
            self.send_frame(PONG, data)
        elif kind == TEXT:
            self.texts.append(json.loads(data))
        elif kind == BINARY:
            length = int.from_bytes(data[:4], "little")
            self.pictures.append((json.loads(data[4:4 + length]), data[4 + length:]))

    def text(self, name: str, wanted=lambda value: True):
        """The value of the first message of that name that is `wanted`; texts before it are dropped, pictures seen and kept."""
        while True:
            while self.texts:
                message = self.texts.pop(0)
                if name in message and wanted(message[name]):
                    return message[name]
            known = len(self.pictures)
            self.receive()
            if len(self.pictures) > known:
                self.send("seen", number=self.pictures[-1][0]["number"])

    def picture(self, seen: bool = True) -> tuple[dict, bytes]:
        """The head and the file of the next picture. `seen`: the server is told that it was."""
        while not self.pictures:
            self.receive()
        head, file = self.pictures.pop(0)
        if seen:
            self.send("seen", number=head["number"])
        return head, file

    def end(self) -> Closed:
        """How the server closes the connection."""
        try:
            while True:
                self.receive()
        except Closed as closed:
            return closed
        except ConnectionError:
            return Closed()


class Service:
    """A `tidemark serve` under way."""

    def __init__(self, folder, *arguments: str, **variables: str) -> None:
        self.process = subprocess.Popen([PROGRAM, "serve", *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        text=True, env=environment(**variables))
        self.address = self.process.stdout.readline().strip()
        if not re.fullmatch(r"http://\S+/\?token=[\w-]+", self.address):
            raise AssertionError(f"no address but '{self.address}': {self.process.communicate()[1]}")

    def viewer(self, **arguments) -> Viewer:
        return Viewer(self.address, **arguments)

    def end(self) -> tuple[int, str]:
        """Waits for it: its exit code, and what it said."""
        self.process.wait(timeout=PATIENCE)
        said = self.process.stderr.read()
        return self.process.returncode, said

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.terminate()
            self.process.wait(timeout=PATIENCE)
        self.process.stdout.close()
        self.process.stderr.close()
