"""`view --webcam`: what is seen is what webcam inputs hold. A video stands for the device."""
import json
import os
import shutil
import signal
import subprocess
import sys

from support import probe
from support.live import LiveTest, main
from support.program import PROGRAM, SKIPPED, TIME_LIMIT, environment

SIZE = ("--size", "200x100")


def texel(place: str) -> str:
    """Of the red of a place, as a byte."""
    return f"round(255.0 * texture(iChannel0, {place}).r)"


VALUES = {"top": texel("vec2(0.5, 0.9)"), "bottom": texel("vec2(0.5, 0.1)"), "left": texel("vec2(0.01, 0.9)"),
          "width": "iChannelResolution[0].x", "height": "iChannelResolution[0].y"}
# 4:1, of which the middle third is seen: black ends are not.
PICTURE = ("color=c=0xc80000:s=320x160:r=10:d=1[top];color=c=0x280000:s=320x160:r=10:d=1[bottom];"
           "[top][bottom]vstack,pad=1280:320:480:0:black")
SEEN = {"top": 200, "bottom": 40, "left": 0, "width": 640, "height": 480}


class Webcam(LiveTest):
    def setUp(self):
        super().setUp()
        self.write("a.glsl", probe.shader(VALUES, '#iChannel0 "webcam"'))
        subprocess.run(["ffmpeg", "-v", "error", "-filter_complex", PICTURE, "-c:v", "ffv1", "-pix_fmt", "bgr0",
                        self.folder / "camera.mkv"], check=True)

    def test_frames_of_the_webcam_are_drawn(self):
        view = self.view("a.glsl", *SIZE, "--webcam", "camera.mkv")
        view.wait_until_told(VALUES, lambda told: told == SEEN)

    def test_the_webcam_of_a_project(self):
        image = {"code": probe.shader(VALUES), "type": "image", "name": "Image", "outputs": [],
                 "inputs": [{"channel": 0, "ctype": "webcam", "id": 31, "sampler": {"vflip": "true"}}]}
        self.write("a.json", json.dumps({"Shader": {"info": {"name": "a"}, "renderpass": [image]}}))
        view = self.view("a.json", *SIZE, "--webcam", "camera.mkv")
        view.wait_until_told(VALUES, lambda told: told == SEEN)

    def test_without_a_webcam_the_placeholder_of_capture_is_drawn(self):
        view = self.view("a.glsl", *SIZE, "--record", "take.txt")
        told = view.told(VALUES)
        self.assertNotEqual(told["top"], SEEN["top"])
        self.assertEqual((told["width"], told["height"]), (640, 480))

    def test_a_recording_warns_that_the_webcam_is_not_recorded(self):
        view = self.view("a.glsl", *SIZE, "--webcam", "camera.mkv", "--record", "take.txt")
        view.wait_for_words("^the webcam is not recorded: a replay has a placeholder picture$")

    def test_a_pipe_without_a_writer_can_be_interrupted(self):
        os.mkfifo(self.folder / "camera")
        with subprocess.Popen([PROGRAM, "view", "a.glsl", *SIZE, "--webcam", "camera"], cwd=self.folder,
                              stderr=subprocess.DEVNULL, env=environment(DISPLAY=self.screen.display)) as program:
            with self.assertRaises(subprocess.TimeoutExpired):
                program.wait(1.5)  # it waits for a writer
            program.send_signal(signal.SIGINT)
            self.assertEqual(program.wait(TIME_LIMIT), 130)

    def test_missing_webcam_is_an_error(self):
        for name, why in (("/dev/video9", "No such file or directory"), ("a.glsl", "Invalid data found")):
            done = self.run_program("view", "a.glsl", "--webcam", name, env=environment(DISPLAY=self.screen.display))
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertRegex(done.stderr, f"tidemark: error: cannot read the webcam or video '{name}': .*{why}")


if __name__ == "__main__":
    if not shutil.which("ffmpeg"):
        print("skipped: ffmpeg is not installed")
        sys.exit(SKIPPED)
    main()
