"""Several scenes in one window: thumbnails, keys, files that are dropped; a video and a copy of the picture."""
import json
import os
import subprocess

from support import png, probe
from support.live import main, wait_for
from support.overlay import OverlayTest

GALLERY = " scenes - tidemark$"


def flat(colour: str) -> str:
    return f"void mainImage(out vec4 c, in vec2 p) {{ c = vec4({colour}, 1.0); }}\n"


RED, GREEN, BLUE = (bytes(255 if i == k else 0 for i in range(3)) for k in range(3))


class Gallery(OverlayTest):
    def setUp(self):
        super().setUp()
        for name, colour in (("a", "1.0, 0.0, 0.0"), ("b", "0.0, 1.0, 0.0"), ("d", "0.0, 0.0, 1.0")):
            self.write(f"scenes/{name}.glsl", flat(colour))
        self.write("scenes/c.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(wrong, 1.0); }\n")
        self.write("scenes/part.glsl", "float part(float x) { return x; }\n")
        self.write("scenes/a.presets.json", json.dumps({"tidemark_presets": 1, "presets": []}))
        self.write("scenes/folder/image.glsl", flat("1.0, 1.0, 0.0"))

    def gallery(self, *scenes: str, size: str = "640x360"):
        return self.open(scenes[0], *scenes[1:], "--size", size, first_title=GALLERY)

    def seen(self, view) -> set[bytes]:
        """The plain colours in the window."""
        return {row[i:i + 3] for row in view.picture()[::4] for i in range(0, len(row), 12)}

    def shows(self, view, colour: bytes) -> None:
        wait_for(lambda: view.running() and self.seen(view) == {colour}, "the scene alone")

    def test_thumbnails_and_keys(self):
        view = self.gallery("scenes")
        self.assertEqual(view.title(), "5 scenes - tidemark")
        wait_for(lambda: view.running() and {RED, GREEN, BLUE, RED[:1] + GREEN[1:2] + b"\0"} <= self.seen(view),
                 "all thumbnails")
        view.key("Right")
        view.key("Return")
        view.wait_for_title("^b - tidemark - ")
        self.shows(view, GREEN)
        view.key("Prior")
        view.wait_for_title("^a - tidemark - ")
        self.shows(view, RED)
        view.key("Prior")  # the last one is before the first
        view.wait_for_title("^folder - tidemark - ")
        view.key("Prior")
        view.wait_for_title("^d - tidemark - ")
        view.key("Prior")
        view.wait_for_title("waiting: .*c.glsl:1:")
        view.key("Next")
        view.wait_for_title("^d - tidemark - ")
        view.key("BackSpace")
        view.wait_for_title(GALLERY)
        view.point(100, 100)  # the first one
        view.button(1, True)
        view.button(1, False)
        view.wait_for_title("^a - tidemark - ")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)

    def test_several_files_and_a_small_window(self):
        view = self.gallery("scenes/d.glsl", "scenes/a.glsl", size="320x180")
        wait_for(lambda: view.running() and BLUE in self.seen(view), "the first thumbnail")
        view.key("Down")
        wait_for(lambda: view.running() and RED in self.seen(view), "the second thumbnail")
        view.key("Return")
        view.wait_for_title("^a - tidemark - ")
        view.screen.xdotool("key", "Escape", "Escape")
        self.assertEqual(view.wait_for_end(), 0)

    def test_keys_of_a_single_scene_are_ignored(self):
        view = self.open("scenes/a.glsl", "--size", "300x100")
        for key in ("BackSpace", "Next"):
            view.key(key)
        view.key("space")
        view.wait_for_title("^a - tidemark - paused at ")

    def test_scenes_that_are_dropped(self):
        view = self.open("scenes/a.glsl", "--size", "300x100")
        self.screen.drop(view.window, self.folder / "scenes/b.glsl")
        view.wait_for_title("^b - tidemark - ")
        self.shows(view, GREEN)
        view.key("Prior")
        view.wait_for_title("^a - tidemark - ")
        self.screen.drop(view.window, self.folder / "scenes")
        view.wait_for_title(GALLERY)

    def test_a_picture_that_is_dropped_is_an_input(self):
        self.write("p/x.glsl", '#iChannel0 "noise"\nvoid mainImage(out vec4 c, in vec2 p) { c = '
                   "vec4(texture(iChannel1, p / iResolution.xy).rgb + 0.0 * texture(iChannel0, p).rgb, 1.0); }\n")
        self.succeed("capture", "scenes/d.glsl", "--size", "2x2", "-o", "other/blue.png")
        view = self.open("p/x.glsl", "--size", "300x100")
        self.screen.drop(view.window, self.folder / "other/blue.png")
        view.wait_for_words("^iChannel1 reads .*/other/blue.png$")
        self.shows(view, BLUE)
        view.key("c")
        view.wait_for_words("^copied: tidemark capture .* --channel '?1=.*/other/blue.png")

    def test_a_damaged_thumbnail_is_ignored(self):
        self.write("scenes/c.glsl", "void mainImage(out vec4 c, in vec2 p) { float x = 0.0; for (int i = 0; i < 2000000000; ++i) "
                   "x += sin(x + p.x); c = vec4(x); }\n")
        view = self.gallery("scenes")
        wait_for(lambda: view.running() and {RED, GREEN, BLUE} <= self.seen(view), "the other thumbnails")


class Video(OverlayTest):
    def test_records_the_shown_pictures(self):
        values = {"time": "iTime"}
        self.write("a.glsl", probe.shader(values))
        view = self.open("a.glsl", "--size", "64x16", "--fps", "10")
        for name in ("a.mp4", "a-2.mp4"):
            view.key("ctrl+r")
            view.wait_for_words(f"^recording {name}; Ctrl\\+R ends it$")
            begun = view.told(values)["time"]
            view.wait_until_told(values, lambda told: told["time"] > begun + 1.5)
            view.key("ctrl+r")
            told = view.wait_for_words(rf"^recorded {name}: ([0-9.]+) s, 64x16, without sound(?:; \d+ frames were left out.*)?$")
            self.assertGreater(float(told[1]), 1.4)
            shown = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                    "stream=nb_read_frames,r_frame_rate", "-of", "json", self.folder / name],
                                   stdout=subprocess.PIPE, check=True)
            stream, = json.loads(shown.stdout)["streams"]
            self.assertEqual(stream["r_frame_rate"], "10/1")
            self.assertAlmostEqual(int(stream["nb_read_frames"]) / 10, float(told[1]), delta=0.06)
        self.assertEqual([file for file in os.listdir(self.folder) if "part" in file], [])

    def test_closing_completes_the_video(self):
        self.write("a.glsl", flat("1.0, 0.0, 0.0"))
        view = self.open("a.glsl", "--size", "64x16", "--fps", "10")
        view.key("ctrl+r")
        view.wait_for_words("^recording a.mp4; ")
        view.quit()
        self.assertEqual(view.wait_for_end(), 0)
        self.assertRegex(view.stderr(), r"(?m)^recorded a\.mp4: ")
        self.assertTrue((self.folder / "a.mp4").exists())


class Copy(OverlayTest):
    def test_the_picture_goes_to_the_clipboard_program(self):
        self.write("a.glsl", flat("0.0, 1.0, 0.0"))
        tool = self.write("bin/xclip", '#!/bin/sh\necho "$@" > words\ncat > copied.png\n')
        tool.chmod(0o755)
        view = self.open("a.glsl", "--size", "64x16", PATH=f"{tool.parent}:{os.environ['PATH']}")
        view.key("ctrl+shift+c")
        view.wait_for_words("^copied the picture, 64x16$")
        self.assertEqual((self.folder / "words").read_text(), "-selection clipboard -t image/png -i\n")
        picture = png.read(self.folder / "copied.png")
        self.assertEqual((picture.width, picture.height, tuple(picture.pixel(3, 3))[:3]), (64, 16, (0, 255, 0)))

    def test_without_a_clipboard_program_the_picture_is_saved(self):
        self.write("a.glsl", flat("0.0, 1.0, 0.0"))
        view = self.open("a.glsl", "--size", "64x16", PATH=str(self.folder))
        view.key("ctrl+shift+c")
        view.wait_for_words("^'xclip' is not installed, which copies pictures; the picture is saved as a file$")
        name = view.wait_for_words(r"^saving (a-\d+\.png)$")[1]
        wait_for((self.folder / name).exists, "the file")


if __name__ == "__main__":
    main()
