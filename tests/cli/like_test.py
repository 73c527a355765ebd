"""`capture --like PICTURE`: the moment that a picture shows, drawn again to the same bytes."""
import struct
import zlib

from support import png
from support.program import ProgramTest, main

COUNT = '#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0) * 0.9 + iTime * 0.01; }\n'
SCENE = """#iChannel0 "count.glsl"
#iUniform float height = 0.5 in { 0.0, 2.0 }
#define TURNS 3
uniform mat4 iCamera;
uniform float iBeat;
void mainImage(out vec4 c, in vec2 p) {
    vec2 uv = p / iResolution.xy;
    c = vec4(fract(height * uv.x + float(TURNS) * uv.y), fract(iCamera[3].x + iCamera[3].y * uv.x),
             texelFetch(iChannel0, ivec2(p), 0).r + distance(uv, iMouse.xy / iResolution.xy), 1.0);
    c.r = fract(c.r + iBeat * 0.07 + iDate.w * 0.1);
}
"""
ASKED = ["--size", "48x32", "--fps", "30", "--frame", "12", "--set", "height=1.25", "--define", "TURNS=5", "--mouse", "24,16",
         "--camera", "70,10,4,0.5,0.25,-1", "--date", "2025-03-04T05:06:07", "--bpm", "90"]


class Like(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("count.glsl", COUNT)
        self.write("a.glsl", SCENE)

    def bytes_of(self, *arguments: str) -> str:
        self.succeed("capture", *arguments)
        return png.read(self.folder / arguments[arguments.index("-o") + 1]).sha256()

    def test_the_same_bytes(self):
        first = self.bytes_of("a.glsl", *ASKED, "-o", "first.png")
        done = self.succeed("capture", "--like", "first.png", "-o", "again.png")
        self.assertNotIn("the picture may differ from", done.stderr)
        self.assertEqual(png.read(self.folder / "again.png").sha256(), first)
        self.assertEqual(self.bytes_of("--like", "again.png", "-o", "third.png"), first)
        for changed in (["--set", "height=0.5"], ["--define", "TURNS=4"], ["--frame", "11"], ["--mouse", "1,1"],
                        ["--camera", "70,10,4"], ["--date", "2025-03-04T05:06:09"], ["--fps", "15"], ["--bpm", "100"]):
            other = self.bytes_of("--like", "first.png", *changed, "-o", "other.png")
            self.assertNotEqual(other, first, changed)
            at = ASKED.index(changed[0])
            asked = ASKED[:at] + changed + ASKED[at + 2:]
            self.assertEqual(self.bytes_of("a.glsl", *asked, "-o", "asked.png"), other, changed)

    def test_at_another_size_the_mouse_is_at_the_same_place(self):
        self.succeed("capture", "a.glsl", *ASKED, "-o", "first.png")
        large = self.bytes_of("--like", "first.png", "--size", "96x64", "-o", "large.png")
        asked = [{"48x32": "96x64", "24,16": "48,32"}.get(word, word) for word in ASKED]
        self.assertEqual(self.bytes_of("a.glsl", *asked, "-o", "asked.png"), large)

    def test_all_formats_with_metadata(self):
        first = self.bytes_of("a.glsl", *ASKED, "-o", "first.png")
        for ending in ("jpg", "tif", "exr"):
            self.succeed("capture", "a.glsl", *ASKED, "-o", f"first.{ending}")
            self.assertEqual(self.bytes_of("--like", f"first.{ending}", "-o", "again.png"), first, ending)

    def test_a_recording(self):
        self.write("take.txt", "2 press left 10 5\n3 move 20 9\n4 set height=2\n6 set height=1.5\n8 wheel 2\n9 release left\n")
        first = self.bytes_of("a.glsl", "--size", "48x32", "--input", "take.txt", "--frame", "7", "-o", "first.png")
        self.assertEqual(self.bytes_of("--like", "first.png", "-o", "again.png"), first)

    def test_changed_scene_is_reported(self):
        self.succeed("capture", "a.glsl", *ASKED, "-o", "first.png")
        self.write("a.glsl", SCENE.replace("* 0.1);", "* 0.2);"))
        done = self.succeed("capture", "--like", "first.png", "-o", "again.png")
        self.assertIn(" first.png: another text of the scene\n", done.stderr)

    def test_scene_on_the_command_line_wins(self):
        self.succeed("capture", "a.glsl", *ASKED, "-o", "first.png")
        self.write("b/b.glsl", SCENE.replace('#iChannel0 "count.glsl"', '#iChannel0 "noise"'))
        done = self.succeed("capture", "b/b.glsl", "--like", "first.png", "-o", "b.png")
        self.assertIn(" first.png: another text of the scene, other inputs\n", done.stderr)
        asked = self.bytes_of("b/b.glsl", *ASKED, "-o", "asked.png")
        self.assertEqual(png.read(self.folder / "b.png").sha256(), asked)

    def test_paths_outside_need_allow_outside(self):
        picture = self.folder / "in" / "first.png"
        self.write("in/a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n")
        self.write("in/white.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n")
        self.succeed("capture", "in/white.glsl", "--size", "48x32", "-o", "white.png")
        first = self.bytes_of("in/a.glsl", "--size", "48x32", "--channel", "0=white.png", "-o", str(picture))
        done = self.succeed("capture", "--like", str(picture), "-o", "again.png")
        self.assertIn(f"--like {picture}: ignored --channel 0=white.png: ", done.stderr)
        self.assertNotEqual(png.read(self.folder / "again.png").sha256(), first)
        self.assertEqual(self.bytes_of("--like", str(picture), "--allow-outside", "-o", "again.png"), first)

    def test_a_huge_size_in_the_metadata_is_refused(self):
        self.succeed("capture", "a.glsl", *ASKED, "-o", "first.png")
        file = (self.folder / "first.png").read_bytes()
        wanted = file.replace(b"[48,32]", b"[1000000,1000000]")
        self.assertNotEqual(wanted, file)
        signature, written = wanted[:8], b""
        for kind, data in png.chunks(file):
            data = data.replace(b"[48,32]", b"[1000000,1000000]")
            written += struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        self.write("forged.png", signature + written)
        self.expect_error(["capture", "--like", "forged.png"], 2, "--like forged.png", "1000000x1000000", "32767 pixels", "--size")
        self.succeed("capture", "--like", "forged.png", "--size", "48x32")

    def test_errors(self):
        self.expect_failure(["capture"], 2, "tidemark: error: capture: SCENE is required")
        self.succeed("capture", "a.glsl", *ASKED, "-o", "first.png")
        self.expect_failure(["capture", "--like", "no.png"], 2, "tidemark: error: --like no.png: cannot read 'no.png': no such file")
        self.write("plain.png", png.encode(1, 1, 3, [b"abc"]))
        self.expect_error(["capture", "--like", "plain.png"], 2, "--like plain.png", "no record", "`tidemark capture`")
        (self.folder / "a.glsl").rename(self.folder / "c.glsl")
        self.expect_error(["capture", "--like", "first.png"], 2, "--like first.png", "'a.glsl'")
        self.succeed("capture", "c.glsl", "--like", "first.png")


if __name__ == "__main__":
    main()
