"""Sines and roundings of a device beside those that `tidemark check` imitates (runner/shader/variation.hpp): plain functions
over samples that a shader computed. The samples' inputs are exact, so that Python knows them bit for bit."""
from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence

SIDE = 128  # a picture of SIDE x SIDE samples
INVERSE_TURN, TURN = 0.15915494, 6.2831855  # nearest floats: k_inverse_turn below
GRID = 4194304.0  # of NVIDIA's results: 2^22
RANGES = (1e2, 1e4, 1e6)

HEAD = """uint bits(uint x) { x ^= x >> 16; x *= 0x7feb352du; x ^= x >> 15; x *= 0x846ca68bu; x ^= x >> 16; return x; }
float from_1_to_2(uint i) { return uintBitsToFloat((bits(i) & 0x007fffffu) | 0x3f800000u); }
"""


def shader(statements: str) -> str:
    """`statements` may use i, the sample's number, and the floats a, b from 1 to 2 and c from -4 to -2, and set `to.rgb`."""
    return (HEAD + "void mainImage(out vec4 to, in vec2 place) {\n"
            f"    uint i = uint(place.y) * {SIDE}u + uint(place.x);\n"
            "    float a = from_1_to_2(3u * i), b = from_1_to_2(3u * i + 1u), c = -2.0 * from_1_to_2(3u * i + 2u);\n"
            f"    to = vec4(0.0, 0.0, 0.0, 1.0);\n    {statements}\n}}\n")


def sine_shader(reach: float) -> str:
    return shader(f"float x = (a - 1.5) * {2 * reach:.1f}; to.rg = vec2(x, sin(x));")


ROUNDING_SHADERS = (shader("to.rgb = vec3(a + c, a * b, a * b + c);"),
                    shader("to.rgb = vec3(a / b, sqrt(a), inversesqrt(a));"),
                    shader("to.rgb = vec3(exp(a), log(b), pow(a, b));"))


def f32(x: float) -> float:
    return struct.unpack("f", struct.pack("f", x))[0]


def bits(x: int) -> int:
    x ^= x >> 16
    x = x * 0x7feb352d & 0xffffffff
    x ^= x >> 15
    x = x * 0x846ca68b & 0xffffffff
    return x ^ x >> 16


def from_1_to_2(i: int) -> float:
    return struct.unpack("f", struct.pack("I", bits(i) & 0x007fffff | 0x3f800000))[0]


def inputs(count: int = SIDE * SIDE) -> list[tuple[float, float, float]]:
    """a, b and c of each sample."""
    return [(from_1_to_2(3 * i), from_1_to_2(3 * i + 1), -2.0 * from_1_to_2(3 * i + 2)) for i in range(count)]


def unit(x: float) -> float:
    """The unit in the last place of a float at x."""
    return math.ldexp(1.0, max(math.frexp(x)[1], -125) - 24)


def like_nvidia(x: float) -> float:
    """Mode like_nvidia of vary_sines, with an exact sine inside."""
    turns = f32(x * f32(INVERSE_TURN))
    sine = f32(math.sin(f32(f32(TURN) * f32(turns - math.floor(turns)))))
    return math.floor(f32(sine * GRID) + 0.5) / GRID


SINE_MODELS: dict[str, Callable[[float], float]] = {
    "a unit larger": lambda x: f32(math.sin(x)) + math.copysign(unit(math.sin(x)), math.sin(x)),
    "a unit smaller": lambda x: f32(math.sin(x)) - math.copysign(unit(math.sin(x)), math.sin(x)),
    "like NVIDIA's": like_nvidia,
}


def largest(values) -> float:
    """NaN, if there is one, is the largest."""
    worst = 0.0
    for value in values:
        if not value <= worst:
            worst = value
    return worst


def sine_figures(reach: float, xs: Sequence[float], sines: Sequence[float]) -> dict:
    """The device's error beside that of each model, over the same arguments."""
    truth = [math.sin(x) for x in xs]
    models = {}
    for name, model in SINE_MODELS.items():
        drawn = [model(x) for x in xs]
        models[name] = {"error": largest(abs(m - t) for m, t in zip(drawn, truth)),
                        "same_bits_percent": 100 * sum(m == s for m, s in zip(drawn, sines)) / len(xs)}
    error = largest(abs(s - t) for s, t in zip(sines, truth))
    return {"up_to": reach, "samples": len(xs), "error": error, "models": models,
            "correctly_rounded_percent": 100 * sum(f32(t) == s for t, s in zip(truth, sines)) / len(xs),
            "covered": error <= max(model["error"] for model in models.values())}


EXACT = {"a + c": lambda a, b, c: a + c, "a * b": lambda a, b, c: a * b}
INEXACT = {"a / b": lambda a, b, c: a / b, "sqrt(a)": lambda a, b, c: math.sqrt(a), "inversesqrt(a)": lambda a, b, c: 1 / math.sqrt(a),
           "exp(a)": lambda a, b, c: math.exp(a), "log(b)": lambda a, b, c: math.log(b), "pow(a, b)": lambda a, b, c: math.pow(a, b)}
MODELLED_UNITS = 1.5  # a correctly rounded result, half a unit off, moved by one unit


def rounding_figures(planes: Sequence[Sequence[float]]) -> dict:
    """`planes`: the results of ROUNDING_SHADERS, channel by channel."""
    samples = inputs(len(planes[0]))
    figures: dict = {"samples": len(samples), "exact": {}, "units": {}}
    for (name, function), got in zip(EXACT.items(), planes[:2]):
        figures["exact"][name] = 100 * sum(f32(function(*s)) == g for s, g in zip(samples, got)) / len(samples)
    twice = [f32(f32(a * b) + c) for a, b, c in samples]
    once = [f32(a * b + c) for a, b, c in samples]  # the product is exact in double
    figures["a * b + c"] = {
        "rounded_twice_percent": 100 * sum(t == g for t, g in zip(twice, planes[2])) / len(samples),
        "rounded_once_percent": 100 * sum(o == g for o, g in zip(once, planes[2])) / len(samples),
        "neither_percent": 100 * sum(g not in (t, o) for t, o, g in zip(twice, once, planes[2])) / len(samples)}
    for (name, function), got in zip(INEXACT.items(), planes[3:]):
        truth = [function(*s) for s in samples]
        off = [abs(g - t) / unit(t) for t, g in zip(truth, got)]
        figures["units"][name] = {"largest": largest(off), "covered_percent": 100 * sum(o <= MODELLED_UNITS for o in off) / len(off)}
    return figures
