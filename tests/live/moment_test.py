"""A moment in the window: copied as a command, saved with its picture, drawn again by `capture --like`."""
import re
import shlex

from support import png, probe
from support.live import main
from support.overlay import PAUSE, OverlayTest

COUNT = ('#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) {\n'
         "    c = texelFetch(iChannel0, ivec2(p), 0) * 0.99 + iTime * 0.01 + iTimeDelta;\n}\n")
KNOB = "#iUniform float height = 0.5 in { 0.0, 2.0 } step 0.1"
VALUES = {"height": "height", "turns": "float(TURNS)", "mouse": "iMouse.x", "camera": "iCamera[3].x", "time": "iTime",
          "frame": "float(iFrame)", "count": "texelFetch(iChannel0, ivec2(0), 0).r"}
SCENE = probe.shader(VALUES, f'#iChannel0 "count.glsl"\n{KNOB}\n#define TURNS 3\nuniform mat4 iCamera;')
HEIGHT = 1
SIZES = (("640x360", 1), ("500x300", 2))


class Moments(OverlayTest):
    def open_there(self, size: str, scale: int):
        """At a moment of its own: a knob, the camera and the mouse were moved, time was stepped to 3 s."""
        self.write("count.glsl", COUNT)
        view = self.open_controls(SCENE, "--define", "TURNS=5", size=size, scale=scale)
        view.click_bar(PAUSE)
        view.wait_for_title(" - paused at ")
        view.drag_row(HEIGHT, 0.3, 0.5)
        view.wait_until_told(VALUES, lambda told: told["height"] != 0.5)
        view.drag(view.at(450, 150), view.at(420, 170))
        view.drag(view.at(450, 150), view.at(480, 130), 2)
        view.type_time("3")
        view.wait_until_told(VALUES, lambda told: told["time"] == 3)
        return view

    def test_a_saved_picture_is_drawn_again(self):
        for size, scale in SIZES:
            with self.subTest(size=size, scale=scale):
                view = self.open_there(size, scale)
                told = view.told(VALUES)
                self.assertTrue(told["height"] != 0.5 and told["turns"] == 5 and told["mouse"] > 0 and told["frame"] == 180)
                file = view.save()
                saved = png.read(file)
                view.close()
                self.assertTrue(file.name.startswith("a-00180"))
                file.rename(self.folder / "saved.png")
                done = self.succeed("capture", "--like", "saved.png", "-o", "again.png")
                self.assertNotIn("the picture may differ from", done.stderr)
                self.assertEqual(png.read(self.folder / "again.png").sha256(), saved.sha256())

    def test_the_command_is_copied(self):
        view = self.open_there("640x360", 1)
        saved = png.read(view.save())
        view.key("c")
        command = view.wait_for_words("^copied: (tidemark capture a.glsl .*)$").group(1)
        for word in ("--define TURNS=5", "--time 3", "--size 640x360", "--mouse ", "--camera ", "--set height="):
            self.assertIn(word, command)
        camera = re.search(r"--camera ([^ ]*)", command).group(1)
        self.assertEqual(len(camera.split(",")), 6)
        for number in camera.split(","):
            self.assertEqual(float(number), float(f"{float(number):.6g}"), "six digits are enough")
        self.succeed(*shlex.split(command)[1:], "-o", "again.png")
        self.assertEqual(probe.read(png.read(self.folder / "again.png"), VALUES), probe.read(saved, VALUES))

    def test_the_command_omits_a_camera_that_the_scene_does_not_read(self):
        mouse = {"x": "iMouse.x"}
        self.write("flat.glsl", probe.shader(mouse))
        view = self.open("flat.glsl", "--size", "640x360")
        view.drag((450, 150), (420, 170))
        view.drag((450, 150), (480, 130), 2)
        view.wait_until_told(mouse, lambda told: told["x"] == 420) # the command is that of the frame that is shown
        view.key("c")
        command = view.wait_for_words("^copied: (tidemark capture flat.glsl .*)$").group(1)
        self.assertIn("--mouse ", command)
        self.assertNotIn("--camera", command)

    def test_with_a_recording(self):
        self.write("count.glsl", COUNT)
        self.write("a.glsl", SCENE)
        view = self.open("a.glsl", "--size", "640x360", "--record", "take.txt")
        view.drag((450, 150), (420, 170))
        view.drag((450, 150), (480, 130), 2)
        view.wait_until_told(VALUES, lambda told: told["mouse"] == 420)
        picture = view.save()
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        self.succeed("capture", "--like", picture.name, "-o", "again.png")
        self.assertEqual(png.read(self.folder / "again.png").sha256(), png.read(picture).sha256())


if __name__ == "__main__":
    main()
