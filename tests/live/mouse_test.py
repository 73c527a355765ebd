"""The mouse in the window: iMouse, and the orbit camera of scenes that declare iCamera."""
from support import png, probe
from support.live import LiveTest, main
from support.probe import vector

MOUSE = vector("iMouse", "xyzw")
MATRIX = {f"{column}{row}": f"iCamera[{column}][{row}]" for column in range(4) for row in range(4)}
DECLARATION = "uniform mat4 iCamera;"
SIZE = ("--size", "200x100")


class Mouse(LiveTest):
    def test_drag_moves_iMouse_by_shadertoys_rules(self):
        self.write("mouse.glsl", probe.shader(MOUSE))
        view = self.view("mouse.glsl", *SIZE)

        def expect(*wanted: float) -> None:
            view.wait_until_told(MOUSE, lambda told: list(told.values()) == list(wanted))

        view.point(80, 30)
        expect(0, 0, 0, 0)  # moving without a button is nothing
        view.point(50, 40)
        view.button(1, True)
        expect(50, 60, 50, -60)  # from the bottom; the click is over after one frame
        view.point(120, 90)
        expect(120, 10, 50, -60)
        view.button(1, False)
        expect(120, 10, -50, -60)
        view.point(10, 10)
        expect(120, 10, -50, -60)

    def test_click_is_positive_in_its_first_frame(self):
        self.write("mouse.glsl", probe.shader(MOUSE))
        view = self.view("mouse.glsl", *SIZE)
        view.restart_paused()
        view.point(50, 40)
        view.button(1, True)  # paused: one frame is drawn for it and stays on show
        view.wait_until_told(MOUSE, lambda told: list(told.values()) == [50, 60, 50, 60])
        view.button(1, False)
        view.wait_until_told(MOUSE, lambda told: list(told.values()) == [50, 60, -50, -60])

    def test_other_buttons_do_not_change_iMouse(self):
        self.write("mouse.glsl", probe.shader(MOUSE))
        view = self.view("mouse.glsl", *SIZE)
        view.drag((50, 40), (60, 50), number=3)
        view.drag((50, 40), (60, 50), number=2)
        view.drag((20, 30), (21, 31))
        view.wait_until_told(MOUSE, lambda told: list(told.values()) == [21, 69, -20, -70])


class OtherHosts(LiveTest):
    """With a `main` of its own a text expects the mouse that other hosts have: the pointer, without a button."""

    OWN = "uniform vec2 u_mouse;\nout vec4 told_color;\n" + probe.shader(
        {"x": "u_mouse.x", "y": "u_mouse.y"}).replace("void mainImage(out vec4 color, in vec2 at) {",
                                                     "void main() {\n    vec4 color; vec2 at = gl_FragCoord.xy;").rstrip()[:-1] \
        + "    told_color = color;\n}\n"
    TOLD = {"x": "u_mouse.x", "y": "u_mouse.y"}

    def test_the_mouse_follows_the_pointer(self):
        self.write("own.glsl", self.OWN)
        view = self.view("own.glsl", *SIZE)
        view.point(80, 30)
        view.wait_until_told(self.TOLD, lambda told: list(told.values()) == [80, 70])
        view.drag((50, 40), (60, 50))
        view.wait_until_told(self.TOLD, lambda told: list(told.values()) == [60, 50])
        view.point(20, 90)
        view.wait_until_told(self.TOLD, lambda told: list(told.values()) == [20, 10])

    def test_a_recording_contains_pointer_moves(self):
        self.write("own.glsl", self.OWN)
        view = self.view("own.glsl", *SIZE, "--record", "take.txt")
        view.point(80, 30)
        view.wait_until_told(self.TOLD, lambda told: list(told.values()) == [80, 70])
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        script = (self.folder / "take.txt").read_text()
        self.assertRegex(script, r"(?m)^\d+ point 80 70$")
        last = script.splitlines()[-1].split()[0]
        self.succeed("capture", "own.glsl", *SIZE, "--input", "take.txt", "--frame", str(int(last) + 1), "-o", "x.png")
        self.assertEqual(list(probe.read(png.read(self.folder / "x.png"), self.TOLD).values()), [80, 70])


class Camera(LiveTest):
    def start(self):
        self.write("camera.glsl", probe.shader(MATRIX, DECLARATION))
        return self.view("camera.glsl", *SIZE, "--camera", "0,0,5")

    def captured(self, camera: str) -> dict[str, float]:
        done = self.succeed("capture", "camera.glsl", *SIZE, "-o", "-", "--camera", camera)
        return probe.read(png.from_raw(200, 100, done.stdout), MATRIX)

    def expect_camera(self, view, camera: str) -> None:
        wanted = self.captured(camera)
        view.wait_until_told(MATRIX, lambda told: all(abs(told[k] - wanted[k]) < 1e-4 for k in wanted))

    def test_drag_across_the_height_rotates_by_half_a_circle(self):
        view = self.start()
        self.assertEqual(view.told(MATRIX), self.captured("0,0,5"))
        view.drag((100, 50), (50, 50))
        self.expect_camera(view, "90,0,5")
        view.drag((100, 50), (100, 75))
        self.expect_camera(view, "90,45,5")
        for _ in range(3):  # the pole is not passed
            view.drag((100, 5), (100, 95))
        self.expect_camera(view, "90,89.9,5")
        view.key("r")
        self.expect_camera(view, "0,0,5")

    def test_wheel_zooms(self):
        view = self.start()
        view.point(100, 50)
        self.screen.xdotool("click", "4")
        self.expect_camera(view, "0,0,4.5")
        self.screen.xdotool("click", "5")
        self.screen.xdotool("click", "5")
        self.expect_camera(view, f"0,0,{5 / 0.9}")
        view.key("r")
        self.expect_camera(view, "0,0,5")

    def test_middle_drag_moves_the_target_with_the_pointer(self):
        view = self.start()
        view.drag((100, 50), (120, 90), number=2)
        # At the target's distance of 5 the window is 5 high: 20 pixels are 1 to the left, 40 are 2 up.
        view.wait_until_told(MATRIX, lambda told: abs(told["30"] + 1) < 1e-4 and abs(told["31"] - 2) < 1e-4 and
                             abs(told["32"] - 5) < 1e-4)
        view.key("r")
        self.expect_camera(view, "0,0,5")

    def test_works_while_paused(self):
        view = self.start()
        view.restart_paused()
        view.drag((100, 50), (50, 50))
        self.expect_camera(view, "90,0,5")


if __name__ == "__main__":
    main()
