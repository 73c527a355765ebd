"""Scenes that are not scenes: one clear line (or the author's own lines), exit code 3, nothing written."""
import os

from support.program import ProgramTest, environment, main

GOOD = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n"
READS_CHANNEL = "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p); }\n"


class BadScene(ProgramTest):
    """What every command that takes a scene says about one that does not load."""

    def expect_refusal(self, scene: str, *named: str) -> None:
        for command in (["capture", "-o", "-"], ["inspect"], ["inspect", "--json"]):  # `view` waits for a better one
            with self.subTest(command=command):
                self.expect_error([*command, scene], 3, *named)

    def test_missing(self):
        self.expect_refusal("none.glsl", "'none.glsl'", "no such file")

    def test_directory(self):
        (self.folder / "folder.glsl").mkdir()
        self.expect_refusal("folder.glsl", "'folder.glsl'", "image.glsl", "buffer_a.glsl", "buffer_d.glsl")

    def test_neither_file_nor_directory(self):
        os.mkfifo(self.folder / "pipe.glsl")
        self.expect_refusal("pipe.glsl", "'pipe.glsl'", "not a regular file")

    def test_below_a_file(self):
        self.write("a.glsl", GOOD)
        self.expect_failure_like(["capture", "a.glsl/b.glsl"], 3,
                                 "tidemark: error: cannot read 'a.glsl/b.glsl': [Nn]o.*")

    def test_binary_junk(self):
        self.write("junk.glsl", bytes(range(256)) * 40)
        self.expect_refusal("junk.glsl", "'junk.glsl'", "binary file")

    def test_binary_file_without_zero_bytes(self):
        self.write("junk.glsl", bytes(range(128, 256)) * 40)
        self.expect_refusal("junk.glsl", "'junk.glsl'", "mainImage")

    def test_empty(self):
        self.write("empty.glsl", "")
        self.expect_refusal("empty.glsl", "'empty.glsl'", "is empty", "mainImage")

    def test_file_with_only_comments(self):
        self.write("blank.glsl", "// mainImage\n/* mainImage */\n")
        self.expect_refusal("blank.glsl", "'blank.glsl'", "is empty", "mainImage")

    def test_no_main_image(self):
        self.write("helpers.glsl", "float twice(float x) { return 2.0 * x; }\n")
        self.expect_refusal("helpers.glsl",
                            "'helpers.glsl'", "mainImage")

    def test_include_missing_names_the_chain(self):
        self.write("a.glsl", f'\n#include "lib/b.glsl"\n{GOOD}')
        self.write("lib/b.glsl", 'float b;\n\n#include "c.glsl"\n')
        self.expect_refusal("a.glsl", "lib/b.glsl:3: error: cannot read 'lib/c.glsl': no such file\n"
                                      "a.glsl:2: note: included from here")

    def test_include_cycle_names_the_chain(self):
        self.write("a.glsl", f'#include "lib/b.glsl"\n{GOOD}')
        self.write("lib/b.glsl", '\n#include "../a.glsl"\n')
        self.expect_refusal("a.glsl", "lib/b.glsl:2: error: '../a.glsl' includes itself\n"
                                      "a.glsl:1: note: included from here")

    def test_include_of_itself(self):
        self.write("a.glsl", f'{GOOD}#include "a.glsl"\n')
        self.expect_refusal("a.glsl", "a.glsl:2: error: 'a.glsl' includes itself")

    def test_malformed_directive(self):
        self.write("a.glsl", f"\n#iUniform flaot speed = 1.0\n{GOOD}")
        self.expect_refusal("a.glsl", "a.glsl:2:11: error: expected a type (float, vec2, vec3, vec4, color3, int, "
                                      "ivec2, ivec3 or ivec4) but found 'flaot'")

    def test_channel_number_out_of_range(self):
        self.write("a.glsl", f'#iChannel10 "noise"\n{GOOD}')
        self.expect_refusal("a.glsl", "a.glsl:1: error: #iChannel10: the channels are iChannel0 to iChannel9")

    def test_url_as_a_picture(self):
        self.write("a.glsl", f'#iChannel0 "https://example.org/a.png"\n{READS_CHANNEL}')
        self.expect_refusal("a.glsl", "a.glsl:1: error:", "'https://example.org/a.png'")


class DoesNotCompile(ProgramTest):
    """The words behind `file:line: error:` are the driver's."""

    def expect_refusal(self, scene: str, pattern: str) -> None:
        for command in (["capture", "-o", "-"], ["inspect"]):
            with self.subTest(command=command):
                self.expect_failure_like([*command, scene], 3, pattern)

    def test_error_has_the_authors_line(self):
        self.write("a.glsl", "\n\nvoid mainImage(out vec4 c, in vec2 p) {\n    c = nothing;\n}\n")
        self.expect_refusal("a.glsl", r"tidemark: error: 'a\.glsl' does not compile\na\.glsl:4(:9)?: error: [^\n]*"
                                      r"(\n[^\n]+)*")

    def test_error_in_an_included_file_has_that_files_line(self):
        self.write("a.glsl", '\n#include "lib/b.glsl"\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(g()); }\n')
        self.write("lib/b.glsl", "float f() { return 1.0; }\nfloat g() { return nothing; }\n")
        self.expect_refusal("a.glsl", r"tidemark: error: 'a\.glsl' does not compile\nlib/b\.glsl:2(:20)?: error: .*"
                                      r"(\n[^\n]+)*")

    def test_error_after_an_include_has_its_own_line(self):
        self.write("a.glsl", '#include "b.glsl"\nvoid mainImage(out vec4 c, in vec2 p) { c = nothing; }\n')
        self.write("b.glsl", "float f() {\n    return 1.0;\n}")
        self.expect_refusal("a.glsl", r"tidemark: error: 'a\.glsl' does not compile\na\.glsl:2(:45)?: error: .*"
                                      r"(\n[^\n]+)*")

    def test_directives_move_no_line(self):
        self.write("a.glsl", "#iUniform float a = 1.0 in {\n 0.0,\n 2.0 }\n"
                             "void mainImage(out vec4 c, in vec2 p) { c = nothing; }\n")
        self.expect_refusal("a.glsl", r"tidemark: error: 'a\.glsl' does not compile\na\.glsl:4(:\d+)?: error: .*"
                                      r"(\n[^\n]+)*")

    def test_carriage_returns_move_no_line(self):
        self.write("a.glsl", "\r\n\r\nvoid mainImage(out vec4 c, in vec2 p) {\r\n c = nothing;\r\n}\r\n")
        self.expect_refusal("a.glsl", r"tidemark: error: 'a\.glsl' does not compile\na\.glsl:4(:\d+)?: error: .*"
                                      r"(\n[^\n]+)*")

    def test_main_image_with_another_signature(self):
        self.write("a.glsl", "vec4 mainImage(vec2 p) { return vec4(p, 0.0, 1.0); }\n")
        self.expect_refusal("a.glsl", r"tidemark: error: 'a\.glsl' does not compile\na\.glsl:1:6: error: mainImage takes two parameters: "
                                      r"\(out vec4 fragColor, in vec2 fragCoord\)")


class BadPicture(ProgramTest):
    def capture_of(self, name: str, stderr: str) -> None:
        self.write("a.glsl", f'\n#iChannel0 "{name}"\n{READS_CHANNEL}')
        for command in ("capture", "inspect"):
            with self.subTest(command=command):
                self.expect_failure([command, "a.glsl"], 3, stderr)

    def test_missing(self):
        self.capture_of("none.png", "a.glsl:2: error: cannot read 'none.png': no such file")

    def test_missing_but_for_its_spelling(self):
        self.write("sub/wood.png", "")
        for name in ("sub/Wood.PNG", "sub\\wood.png"):
            with self.subTest(name):
                self.write("a.glsl", f'\n#iChannel0 "{name}"\n{READS_CHANNEL}')
                self.expect_error(["capture", "a.glsl"], 3, "a.glsl:2: error: cannot read", "did you mean '", "wood.png'?")

    def test_directory(self):
        (self.folder / "folder.png").mkdir()
        self.capture_of("folder.png", "a.glsl:2: error: cannot read 'folder.png': it is a directory")

    def test_text(self):
        self.write("text.png", "hello\n")
        self.capture_of("text.png", "a.glsl:2: error: cannot read 'text.png': "
                                    "it is not a PNG, JPEG, TIFF, EXR, HDR, BMP, WebP, PNM or TGA picture")

    def test_empty(self):
        self.write("empty.png", "")
        self.capture_of("empty.png", "a.glsl:2: error: cannot read 'empty.png': the file is empty")

    def test_truncated_file(self):
        self.succeed("bake", "noise", "-o", "noise.png")
        whole = (self.folder / "noise.png").read_bytes()
        self.write("half.png", whole[:len(whole) // 2])
        self.write("a.glsl", f'\n#iChannel0 "half.png"\n{READS_CHANNEL}')
        self.expect_failure_like(["capture", "a.glsl"], 3, "a.glsl:2: error: cannot read 'half.png': .+")

    def test_broken_picture_of_an_option_names_the_option(self):
        self.write("a.glsl", READS_CHANNEL)
        self.expect_failure(["capture", "a.glsl", "--channel", "0=none.png"], 3,
                            "tidemark: error: cannot read 'none.png': no such file")

    def test_missing_file_of_an_unread_channel_is_allowed(self):
        self.write("a.glsl", f'#iChannel0 "none.png"\n{GOOD}')
        self.succeed("capture", "a.glsl", "--size", "4x4")


class NoContext(ProgramTest):
    WORDS = ("tidemark: error: no OpenGL 4.5 context without a window: surfaceless: no driver offers it "
             "(EGL_BAD_PARAMETER); display: no driver offers it (EGL_BAD_PARAMETER). Install a driver (Debian's "
             "libgl1-mesa-dri draws on the CPU; a graphics card needs its vendor's EGL driver); "
             "`tidemark inspect --devices` lists what there is")

    def test_error_names_tried_devices_and_remedy(self):
        self.write("a.glsl", GOOD)
        without_driver = environment(__EGL_VENDOR_LIBRARY_FILENAMES="/dev/null")
        for command in ("capture", "inspect"):
            with self.subTest(command=command):
                self.expect_failure([command, "a.glsl"], 77, self.WORDS, env=without_driver)

    def test_load_errors_are_reported_before_device_errors(self):
        self.expect_failure(["capture", "none.glsl"], 3, "tidemark: error: cannot read 'none.glsl': no such file",
                            env=environment(__EGL_VENDOR_LIBRARY_FILENAMES="/dev/null"))

    def test_unknown_device(self):
        self.write("a.glsl", GOOD)
        self.expect_failure_like(["capture", "a.glsl", "--device", "gpu"], 2,
                                 "tidemark: error: unknown device 'gpu'; there are auto, surfaceless, .*display, mesa:.*")


if __name__ == "__main__":
    main()
