"""Captures that are cut short and gone on with: the scenes, and how the two results are compared."""
from __future__ import annotations

from support.program import ProgramTest

SCENE = """#iUniform float speed = 0.5
void mainImage(out vec4 c, in vec2 p) {
    float x = 0.0;
    for (int i = 0; i < 400; ++i) x += sin(p.x * float(i) + iTime * speed);
    c = vec4(p / iResolution.xy, fract(x), 1.0);
}
"""
SEQUENCE = ("capture", "a.glsl", "--size", "64x36", "--frames", "0-19", "-o", "out/f_%04d.png")


class Resume(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", SCENE)
        (self.folder / "out").mkdir()

    def write_feedback(self) -> None:
        """`fb`: Buffer A adds to itself and keeps pixels that it discards."""
        self.write("fb/image.glsl", '#iChannel0 "Buffer A"\n'
                                    "void mainImage(out vec4 c, in vec2 p) { c = fract(texelFetch(iChannel0, ivec2(p), 0)); }\n")
        self.write("fb/buffer_a.glsl", '#iChannel0 "Buffer A"\nvoid mainImage(out vec4 c, in vec2 p) {\n'
                                       "  if (iFrame % 3 == 1 && int(p.x) % 5 == 2) discard;\n"
                                       "  c = texelFetch(iChannel0, ivec2(p), 0) * 1.01 + vec4(p.x, p.y, 1.0, iTime) * 0.001;\n}\n")

    def contents(self, folder: str = "out") -> dict[str, bytes]:
        """Hidden files too."""
        return {path.name: path.read_bytes() for path in (self.folder / folder).iterdir()}

    def whole(self, *arguments: str) -> dict[str, bytes]:
        """What a capture makes that nobody cuts short; the folder is empty again."""
        self.succeed(*arguments)
        files = self.contents()
        for name in files:
            (self.folder / "out" / name).unlink()
        return files

    def resume(self, *arguments: str, **options) -> list[str]:
        return self.succeed(*arguments, "--resume", **options).stderr.splitlines()
