"""`capture --input`: recorded events by frame."""
from support import png, probe
from support.program import ProgramTest, main

SIZE = ("--size", "64x8")
MOUSE = probe.vector("iMouse", "xyzw")
TAKE = "# a drag\n2 press left 10 20\n3 move 12 5.5\n5 release left\n"


class Input(ProgramTest):
    def told(self, *options: str) -> list[float]:
        done = self.succeed("capture", "a.glsl", *SIZE, "--input", "take.txt", "-o", "-", *options)
        return list(probe.read(png.from_raw(64, 8, done.stdout[-64 * 8 * 3:]), MOUSE).values())

    def setUp(self):
        super().setUp()
        self.write("a.glsl", probe.shader(MOUSE))
        self.write("take.txt", TAKE)

    def test_each_frame_applies_all_earlier_events(self):
        for frame, wanted in ((1, [0, 0, 0, 0]), (2, [10, 20, 10, 20]), (3, [12, 5, 10, -20]),
                              (4, [12, 5, 10, -20]), (5, [12, 5, -10, -20])):
            self.assertEqual(self.told("--frame", str(frame)), wanted)
            self.assertEqual(self.told("--frames", f"0-{frame}"), wanted)

    def test_time_advances_by_frames(self):
        self.assertEqual(self.told("--time", "0.35", "--fps", "10"), [12, 5, 10, -20])

    def test_feedback_frames_receive_every_event(self):
        self.write("s/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) {"
                                      "c = texelFetch(iChannel0, ivec2(p), 0) + step(0.5, iMouse.w); }")
        self.write("s/image.glsl", probe.shader({"clicks": "texelFetch(iChannel0, ivec2(0), 0).x"}))
        self.write("s/scene.json", """{"renderpass": [
            {"type": "image", "name": "Image", "inputs": [{"ctype": "buffer", "id": "257", "channel": 0}],
             "outputs": [{"id": "37", "channel": 0}]},
            {"type": "buffer", "name": "Buffer A", "inputs": [{"ctype": "buffer", "id": "257", "channel": 0}],
             "outputs": [{"id": "257", "channel": 0}]}]}""")
        self.write("clicks.txt", "".join(f"{frame} press left 1 1\n{frame} release left\n" for frame in (1, 4, 6)))
        done = self.succeed("capture", "s", *SIZE, "--input", "clicks.txt", "-o", "-", "--frame", "9")
        told = probe.read(png.from_raw(64, 8, done.stdout), {"clicks": ""})
        self.assertEqual(told["clicks"], 3)

    def test_buttons_and_view_of_the_extension(self):
        values = probe.vector("iMouseButton", "xyzw") | {f"view{i}{j}": f"iViewMatrix[{i}][{j}]"
                                                         for i, j in ((0, 0), (2, 0), (3, 0), (3, 2))}
        self.write("a.glsl", probe.shader(values, "#iFirstPersonControls"))
        self.write("take.txt", "1 press left 10 4\n2 press right 10 4\n3 release left\n3 wheel 2\n4 release right\n"
                               "4 press left 10 4\n5 move 18 4\n")
        at = {}
        for frame in range(6):
            done = self.succeed("capture", "a.glsl", *SIZE, "--input", "take.txt", "-o", "-", "--frame", str(frame))
            at[frame] = list(probe.read(png.from_raw(64, 8, done.stdout), values).values())
        for frame, buttons in enumerate(([0, 0], [1, 0], [1, 1], [0, 1], [1, 0], [1, 0])):
            self.assertEqual(at[frame][:4], [*buttons, 0, 0])
        for got, identity in zip(at[2][4:], (1, 0, 0, 0)):
            self.assertAlmostEqual(got, identity, places=5)
        self.assertLess(at[3][7], -0.5)  # the wheel went ahead, along -z
        # A drag once across the height turns by half a circle: it now looks back from the other side.
        self.assertAlmostEqual(at[5][4], -1, places=5)
        self.assertLess(at[5][7], 2 * at[3][7])

    def test_errors(self):
        self.write("bad.txt", "0 move 1 2\n1 mvoe 1 2\n")
        self.expect_error(["capture", "a.glsl", "--input", "bad.txt"], 3, "bad.txt:2: error:", "'mvoe'")
        self.write("knob.txt", "0 move 1 2\n1 set height=tall\n")
        self.expect_error(["capture", "a.glsl", "--input", "knob.txt"], 3, "knob.txt:2: error:", "'tall'")
        self.expect_failure(["capture", "a.glsl", "--input", "none.txt"], 3,
                            "tidemark: error: cannot read 'none.txt': no such file")


if __name__ == "__main__":
    main()
