"""Shaders that a machine takes long for, however fast it is."""
from __future__ import annotations

import json
from typing import Callable

from support import probe
from support.program import ProgramTest


def slow_function(rounds: int, lines: int = 30, name: str = "slow") -> str:
    """llvmpipe leaves its loops after 65,536 rounds, so that each of them takes its time, in every pixel."""
    return (f"float {name}(float s) {{\n    for (int i = 0; i < {rounds}; ++i) {{\n"
            + "        s = fract(sin(s + iTime) * 4371.0);\n" * lines + "    }\n    return s;\n}\n")


def slow_shader(rounds: int, values: dict[str, str], before: str = "") -> str:
    """One that tells these values, by `probe`."""
    text = probe.shader(values, before + slow_function(rounds))
    assert "0.0, 1.0);\n}" in text
    return text.replace("0.0, 1.0);\n}", "slow(at.x + at.y), 1.0);\n}")


def rounds_that_take(seconds: float, test: ProgramTest, shader: Callable[[int], str], *size: str) -> int:
    """So many that this machine, as busy as it is, takes that long for a frame."""
    rounds = 2
    while True:
        test.write("measure.glsl", shader(rounds))
        done = test.succeed("capture", "measure.glsl", *size, "--frames", "0-1", "-o", "measure.####.png", "--json")
        took = json.loads(done.stdout)["frames"][1]["milliseconds"] / 1000  # the first is compiled, too
        if took > 0.3:
            return int(rounds * seconds / took)
        rounds *= 4
