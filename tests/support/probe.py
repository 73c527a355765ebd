"""A shader that tells numbers: each value's 32 bits stand in two pixels of the lowest row, 16 in each."""
from __future__ import annotations

import struct

from support import png


def shader(values: dict[str, str], before: str = "") -> str:
    """`values`: a name for the test and a GLSL float expression each. `before` goes first: directives."""
    cases = "\n".join(f"    if (i == {i}) return {expression};" for i, expression in enumerate(values.values()))
    return f"""{before}
float told(int i) {{
{cases}
    return 0.0;
}}
void mainImage(out vec4 color, in vec2 at) {{
    int x = int(at.x);
    uint bits = floatBitsToUint(told(x / 2)) >> (16 * (x & 1));
    color = vec4(float(bits & 255u) / 255.0, float((bits >> 8) & 255u) / 255.0, 0.0, 1.0);
}}
"""


def read(picture: png.Picture, values: dict[str, str]) -> dict[str, float]:
    assert picture.width >= 2 * len(values)
    told = {}
    for i, name in enumerate(values):
        octets = bytes(picture.pixel(2 * i, 0)[:2] + picture.pixel(2 * i + 1, 0)[:2])
        (told[name],) = struct.unpack("<f", octets)
    return told


def vector(name: str, components: str) -> dict[str, str]:
    """`vector("iMouse", "xyzw")`: one value for each component."""
    return {f"{name}.{c}": f"{name}.{c}" for c in components}
