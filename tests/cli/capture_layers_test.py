"""`capture --layers`: every pass in one .exr, each a part under its name."""
import json
import struct

from support import exr
from support.program import ProgramTest, main

SIZE = ("--size", "40x24")
IMAGE = """#iChannel0 "Buffer A"
void mainImage(out vec4 c, in vec2 p) { c = vec4(texelFetch(iChannel0, ivec2(p), 0).rgb / 4.0, 0.25); }
"""
# Reads itself: its frame N needs the one before. Numbers that a half does not hold.
BUFFER_A = """#iChannel0 "Buffer A"
void mainImage(out vec4 c, in vec2 p) {
    c = texelFetch(iChannel0, ivec2(p), 0) + vec4(p / 37.0, 1.0e6 / 3.0, -0.5);
}
"""
# No pass reads it.
BUFFER_B = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p.y, iTime, 1.0 / 0.0, 1.0); }\n"
CUBE_A = "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(d * 2.0, p.x / 1024.0); }\n"


class Layers(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("s/image.glsl", IMAGE)
        self.write("s/buffer_a.glsl", BUFFER_A)
        self.write("s/buffer_b.glsl", BUFFER_B)

    def capture(self, name: str, *options: str) -> list[exr.Part]:
        self.succeed("capture", "s", *SIZE, "-o", name, *options)
        return exr.read(self.folder / name)

    def expect_same(self, layer: exr.Part, alone: exr.Part) -> None:
        """The same bits; an alpha that is 1 all over is not in the file of one pass."""
        self.assertEqual(layer.size, alone.size, layer.name)
        for name, kind in layer.channels:
            if name in alone.samples:
                self.assertEqual(kind, dict(alone.channels)[name])
                self.assertEqual(layer.samples[name], alone.samples[name], (layer.name, name))
            else:
                self.assertEqual((name, set(layer.values(name))), ("A", {1.0}))

    def test_each_layer_equals_the_pass_captured_alone(self):
        layers = self.capture("all.exr", "--layers", "--frame", "3")
        self.assertEqual([layer.name for layer in layers], ["Image", "Buffer A", "Buffer B"])
        self.assertEqual([sorted(layer.samples) for layer in layers], [list("BGR"), list("ABGR"), list("ABGR")])
        for layer in layers:
            alone, = self.capture("one.exr", "--frame", "3", "--pass", layer.name)
            self.expect_same(layer, alone)
        self.assertEqual([layer.attributes["colorInteropID"] for layer in layers],
                         [b"srgb_rec709_display", b"data", b"data"])
        # Not only equal, but what the text says: four steps of a third of a million.
        self.assertEqual(layers[1].values("B")[0], struct.unpack("<f", struct.pack("<f", 4.0e6 / 3.0))[0])
        self.assertEqual(set(layers[2].values("B")), {float("inf")})

    def test_depth_applies_to_all_layers(self):
        layers = self.capture("all.exr", "--layers", "--depth", "half")
        self.assertEqual({kind for layer in layers for _, kind in layer.channels}, {1})
        for layer in layers:
            alone, = self.capture("one.exr", "--depth", "half", "--pass", layer.name)
            self.expect_same(layer, alone)

    def test_cube_pass_has_a_layer_per_face(self):
        self.write("s/cube_a.glsl", CUBE_A)
        layers = self.capture("all.exr", "--layers")
        faces = ["px", "nx", "py", "ny", "pz", "nz"]
        self.assertEqual([layer.name for layer in layers],
                         ["Image", "Buffer A", "Buffer B", *(f"Cube A {face}" for face in faces)])
        self.assertEqual({layer.attributes["displayWindow"] for layer in layers}, {struct.pack("<4i", 0, 0, 39, 23)})
        self.succeed("capture", "s", *SIZE, "-o", "sky_{}.exr", "--pass", "Cube A")
        for layer, face in zip(layers[3:], faces):
            alone, = exr.read(self.folder / f"sky_{face}.exr")
            self.assertEqual((layer.size, layer.channels), ((1024, 1024), alone.channels))
            self.assertTrue(layer.blocks == alone.blocks, face)

    def test_samples_of_layers_equal_those_of_image(self):
        layers = self.capture("all.exr", "--layers", "--samples", "4", "--frame", "1")
        image, = self.capture("one.exr", "--samples", "4", "--frame", "1")
        buffer, = self.capture("two.exr", "--frame", "1", "--pass", "Buffer A")
        self.expect_same(layers[0], image)
        self.expect_same(layers[1], buffer)

    def test_resume_keeps_frames_with_the_same_layers(self):
        sequence = ["capture", "s", *SIZE, "--frames", "0-2", "-o", "%d.exr", "--resume"]
        self.succeed(*sequence, "--layers")
        kept = [(self.folder / f"{frame}.exr").read_bytes() for frame in range(3)]
        self.assertIn("kept 3 of 3", self.succeed(*sequence, "--layers").stderr)
        (self.folder / "1.exr").unlink()
        self.assertIn("kept 2 of 3", self.succeed(*sequence, "--layers").stderr)
        self.assertEqual([(self.folder / f"{frame}.exr").read_bytes() for frame in range(3)], kept)
        self.assertIn("kept 0 of 3", self.succeed(*sequence).stderr)

    def test_report_and_reading_it_again(self):
        done = self.succeed("capture", "s", *SIZE, "--layers", "-o", "all.exr", "--json")
        self.assertEqual(json.loads(done.stdout)["layers"], ["Image", "Buffer A", "Buffer B"])
        self.capture("image.exr")
        self.assertIn("RMSE 0,", self.succeed("compare", "all.exr", "image.exr").stdout.decode())
        self.succeed("capture", "--like", "all.exr", "-o", "like.exr")
        self.assertEqual((self.folder / "like.exr").read_bytes(), (self.folder / "image.exr").read_bytes())

    def test_scene_with_one_pass_has_one_layer(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }\n")
        self.succeed("capture", "a.glsl", *SIZE, "--layers", "-o", "a.exr")
        part, = exr.read(self.folder / "a.exr")
        self.assertEqual((part.name, set(part.values("R"))), ("Image", {0.5}))

    def test_refused(self):
        def refused(words: str, *options: str) -> None:
            self.expect_error(["capture", "s", "--layers", *options], 2, "--layers:", words)

        for name in ("a.png", "a.tif", "a.mp4", "-"):
            refused(".exr", "-o", name)
        refused("{}", "-o", "a_{}.exr")
        refused("--pass", "-o", "a.exr", "--pass", "Buffer A")
        refused("--tile", "-o", "a.exr", "--tile", "64")
        refused("--shutter", "-o", "a.exr", "--shutter", "0.5")
        refused("16384", "-o", "a.exr", "--size", "16385x4")


if __name__ == "__main__":
    main()
