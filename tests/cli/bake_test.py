"""`bake`: the noise that scenes read, judged by its bytes."""
from support import png
from support.program import ProgramTest, main


class Noise(ProgramTest):
    def test_channels_are_shifted_copies(self):
        done = self.succeed("bake", "noise")
        self.assertEqual(done.stderr, "wrote noise.png\n")
        self.assertEqual(done.stdout, b"")
        noise = png.read(self.folder / "noise.png")
        self.assertEqual((noise.width, noise.height, noise.channels, noise.depth), (256, 256, 4, 8))
        red, green, blue, alpha = ([row[c::4] for row in noise.rows] for c in range(4))

        def shifted(plane: list[bytes]) -> list[bytes]:
            """S(x, y) = plane(x + 37, y + 17), rows as in the file, wrapped."""
            return [(row + row)[37:37 + 256] for row in (plane + plane)[17:17 + 256]]

        self.assertTrue(red == shifted(green))
        self.assertTrue(blue == shifted(alpha))
        self.assertTrue(green != alpha)

    def test_bytes_are_even(self):
        self.succeed("bake", "noise")
        noise = png.read(self.folder / "noise.png")
        for channel in (1, 3):
            values = b"".join(row[channel::4] for row in noise.rows)
            # 65536 draws of 256 values: the mean has a standard deviation of 0.29, a count one of 16.
            self.assertLess(abs(sum(values) / len(values) - 127.5), 1.5)
            counts = [values.count(v) for v in range(256)]
            self.assertTrue(min(counts) > 176 and max(counts) < 336, counts)

    def test_seed_changes_the_bytes(self):
        for name, seed in [("a.png", "1"), ("b.png", "1"), ("c.png", "2")]:
            self.succeed("bake", "noise", "-o", name, "--seed", seed)
        a, b, c = ((self.folder / name).read_bytes() for name in ("a.png", "b.png", "c.png"))
        self.assertEqual(a, b)
        self.assertNotEqual(a, c)

    def test_errors(self):
        self.expect_error(["bake", "noise", "-o", "noise.txt"], 2, "'noise.txt'")
        self.expect_error(["bake", "noise", "-o", "none/noise.png"], 4, "'none/noise.png'", "No such file or directory")


class Usage(ProgramTest):
    def test_missing_and_unknown_arguments(self):
        self.expect_failure(["bake"], 2, "tidemark: error: bake: give noise")
        self.expect_failure(["bake", "island"], 2, "tidemark: error: bake: unknown 'island': give noise")
        self.expect_failure(["bake", "bread"], 2, "tidemark: error: bake: unknown 'bread': give noise")
        self.expect_failure(["bake", "noise", "more"], 2, "tidemark: error: unexpected argument 'more'")


if __name__ == "__main__":
    main(needs_context=False)
