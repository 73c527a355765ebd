"""OSC 1.0 as a client of our own sends it: messages, bundles, packets over UDP."""
import socket
import struct


def text(word: str) -> bytes:
    """Ended by a zero and filled up to whole words of four bytes."""
    raw = word.encode() + b"\0"
    return raw + b"\0" * (-len(raw) % 4)


def message(address: str, *arguments: "float | int | str | bool") -> bytes:
    types, data = ",", b""
    for argument in arguments:
        if isinstance(argument, bool):
            types += "T" if argument else "F"
        elif isinstance(argument, int):
            types, data = types + "i", data + struct.pack(">i", argument)
        elif isinstance(argument, float):
            types, data = types + "f", data + struct.pack(">f", argument)
        else:
            types, data = types + "s", data + text(argument)
    return text(address) + text(types) + data


def bundle(*packets: bytes) -> bytes:
    """For at once."""
    return text("#bundle") + struct.pack(">Q", 1) + b"".join(struct.pack(">I", len(p)) + p for p in packets)


class Client:
    def __init__(self, port: int) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.connect(("127.0.0.1", port))

    def send(self, address: str, *arguments: "float | int | str | bool") -> None:
        self.socket.send(message(address, *arguments))

    def send_packet(self, packet: bytes) -> None:
        self.socket.send(packet)

    def close(self) -> None:
        self.socket.close()
