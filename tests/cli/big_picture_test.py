"""Pictures that are drawn in tiles: beyond the driver's limit, the same bytes, in bounded memory, whole or not at
all."""
import json
import os
import resource
import signal
import subprocess
import time

from support import png
from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, main, not_sanitized

# Each pixel says where it is; the blue ones by a derivative over two pixels.
PLACES = """void mainImage(out vec4 c, in vec2 p) {
    vec2 at = floor(gl_FragCoord.xy);
    c = vec4(mod(at, 256.0) / 255.0, (floor(at.x / 256.0) + dFdx(p.x) - 1.0) / 255.0, 1.0);
}
"""
SLOW = """void mainImage(out vec4 c, in vec2 p) {
    float s = fract(p.x * 0.317 + p.y * 0.713);
    for (int i = 0; i < 3000; ++i) s = fract(sin(s) * 4311.3);
    c = vec4(s);
}
"""


class BigPicture(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("places.glsl", PLACES)

    def report(self, *options: str) -> dict:
        return json.loads(self.succeed("capture", *options, "--json").stdout)


class Sizes(BigPicture):
    def test_a_side_beyond_the_drivers_limit(self):
        report = self.report("places.glsl", "--size", "40000x3", "-o", "wide.png")
        self.assertEqual(report["size"], [40000, 3])
        self.assertEqual(report["tiles"], {"size": [1024, 256], "count": 40})
        picture = png.read(self.folder / "wide.png")
        self.assertEqual((picture.width, picture.height, picture.channels), (40000, 3, 3))
        for y in range(3):
            for x in (0, 1, 1023, 1024, 16383, 16384, 32767, 39999):
                self.assertEqual(picture.pixel(x, y), (x % 256, y, x // 256))
        self.assertEqual(report["frames"][0]["sha256"], picture.sha256())

    def test_tall_pictures_start_at_the_top(self):
        self.succeed("capture", "places.glsl", "--size", "2x20000", "-o", "tall.png")
        picture = png.read(self.folder / "tall.png")
        self.assertEqual([picture.pixel(1, y)[1] for y in range(20000)], [y % 256 for y in range(20000)])

    def test_untiled_capture_reports_no_tiles(self):
        self.assertNotIn("tiles", self.report("places.glsl", "--size", "8x8"))

    def test_every_format_has_the_bytes_of_the_whole_picture(self):
        for name in ("a.png", "a.tif", "a.exr", "a.jpg", "a.hdr"):
            with self.subTest(name):
                whole = self.report("places.glsl", "--size", "75x41", "-o", name)
                file = (self.folder / name).read_bytes()
                tiled = self.report("places.glsl", "--size", "75x41", "-o", name, "--tile", "16")
                self.assertEqual(tiled["tiles"], {"size": [16, 16], "count": 15})
                self.assertEqual(tiled["frames"][0]["sha256"], whole["frames"][0]["sha256"])
                self.assertEqual((self.folder / name).read_bytes(), file)

    def test_raw_frames_and_sequences(self):
        options = ["capture", "places.glsl", "--size", "21x10", "--frames", "0-2"]
        whole = self.succeed(*options, "-o", "-").stdout
        self.assertEqual(len(whole), 21 * 10 * 3 * 3)
        self.assertEqual(self.succeed(*options, "-o", "-", "--tile", "8").stdout, whole)
        done = self.succeed(*options, "-o", "f%d.png", "--tile", "8")
        self.assertEqual(done.stderr.splitlines()[-1], "wrote 3 frames, f0.png to f2.png")
        self.assertEqual(self.files(), {"places.glsl", "f0.png", "f1.png", "f2.png"})

    def test_buffers_stay_whole(self):
        self.write("scene/image.glsl", '#iChannel0 "buffer_a.glsl"\n'
                   "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p.yx / iResolution.yx); }\n")
        self.write("scene/buffer_a.glsl", '#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) {\n'
                   "    c = texelFetch(iChannel0, ivec2(p.yx) % ivec2(40, 30), 0) * 0.9"
                   " + fract(vec4(p * 0.37, iTime, 1.0)) * 0.1;\n}\n")
        options = ["scene", "--size", "40x30", "--frame", "7", "-o", "a.png"]
        self.assertEqual(self.report(*options, "--tile", "6")["frames"][0]["sha256"],
                         self.report(*options)["frames"][0]["sha256"])
        self.expect_failure_like(["capture", "scene", "--size", "100000x8"], 2,
                                 r"tidemark: error: --size 100000x8: .* \d+ pixels on a side; Buffer A .*")


class Refusals(BigPicture):
    def test_size_beyond_the_formats_limit(self):
        self.expect_failure(["capture", "places.glsl", "--size", "70000x8", "-o", "a.jpg"], 2,
                            "tidemark: error: --size 70000x8: a .jpg has at most 65500 pixels on a side")
        self.expect_failure(["capture", "places.glsl", "--size", "8x1000001"], 2,
                            "tidemark: error: --size 8x1000001: a .png has at most 1000000 pixels on a side")
        self.expect_failure(["capture", "places.glsl", "--size", "9000000x1", "-o", "-"], 2,
                            "tidemark: error: --size 9000000x1: a side has at most 8388608 pixels")

    def test_invalid_tile_sizes(self):
        self.expect_failure_like(["capture", "places.glsl", "--tile", "7"], 2,
                                 r"tidemark: error: --tile 7: .* from 2 to \d+")
        self.expect_error(["capture", "places.glsl", "--tile", "8", "-o", "a.mp4"], 2, "--tile")

    def test_a_full_disk_leaves_nothing(self):
        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))
        self.write("noise.glsl", SLOW.replace("3000", "2"))
        for name in ("a.png", "a.tif", "a.exr", "a.jpg", "a.hdr"):
            with self.subTest(name):
                self.expect_failure_like(["capture", "noise.glsl", "--size", "300x300", "--tile", "64", "-o", name],
                                         4, rf"(\d+/25 tiles.*\n)*tidemark: error: cannot write '{name}': File too large", preexec_fn=small_files,
                                         env=environment(MESA_SHADER_CACHE_DISABLE="true"))

    def test_a_frame_that_takes_too_long_leaves_nothing(self):
        self.write("slow.glsl", SLOW)
        self.expect_failure_like(["capture", "slow.glsl", "--size", "20000x20000", "--timeout", "0.7"], 5,
                                 r"(\d+/1\d{3} tiles.*\n)*tidemark: error: stopped drawing frame 0 after 0\.\d+ s "
                                 r"\(--timeout\)")

    def test_ctrl_c_leaves_nothing(self):
        self.write("slow.glsl", SLOW)
        running = subprocess.Popen([PROGRAM, "capture", "slow.glsl", "--size", "20000x20000"], cwd=self.folder,
                                   env=environment(), stderr=subprocess.PIPE, text=True)
        self.addCleanup(running.stderr.close)
        self.addCleanup(running.kill)
        deadline = time.monotonic() + TIME_LIMIT
        while len(self.files()) < 3:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)
        running.send_signal(signal.SIGINT)
        _, stderr = running.communicate(timeout=TIME_LIMIT)
        self.assertEqual(running.returncode, 130)
        self.assertEqual(stderr.splitlines()[-1], "interrupted after 0 of 1 frame")
        self.assertEqual(self.files(), {"places.glsl", "slow.glsl"})


@not_sanitized
class Memory(BigPicture):
    def peak(self, *options: str) -> int:
        """KiB."""
        running = subprocess.Popen([PROGRAM, "capture", *options], cwd=self.folder, env=environment(),
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(running.pid, 0)
        running.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(running.returncode, 0)
        return usage.ru_maxrss

    def test_memory_does_not_grow_with_height(self):
        low = self.peak("places.glsl", "--size", "1024x1024", "--tile", "256", "-o", "a.png")
        high = self.peak("places.glsl", "--size", "1024x8192", "--tile", "256", "-o", "a.png")
        self.assertLess(high - low, 8 << 10)  # the picture alone: 32 MiB

    def test_memory_does_not_grow_with_frames(self):
        few = self.peak("places.glsl", "--size", "32x32", "--frames", "0-49", "-o", "-")
        many = self.peak("places.glsl", "--size", "32x32", "--frames", "0-1999", "-o", "-")
        self.assertLess(many - few, 4 << 10)


if __name__ == "__main__":
    main()
