"""`cmake --install` into a folder of any name: the program runs from there, with its plug-ins and its library."""
import gzip
import pathlib
import shutil
import subprocess
import unittest

from support import option_table, package_contents
from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, has_context, main

BUILD = pathlib.Path(PROGRAM).resolve().parent
SMALL = ("--size", "32x18")
OF_LIBRARY = """#include <tidemark/noise.glsl>
void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(value_noise(p / 8.0, ivec2(0))), 1.0); }
"""


@unittest.skipUnless((BUILD / "cmake_install.cmake").is_file() and shutil.which("cmake"), "there is no build folder")
class Installed(ProgramTest):
    def setUp(self) -> None:
        super().setUp()
        self.prefix = self.folder / "a prefix"
        subprocess.run(["cmake", "--install", BUILD, "--prefix", self.prefix], check=True, timeout=TIME_LIMIT,
                       stdout=subprocess.DEVNULL)

    def installed(self, *arguments: str) -> subprocess.CompletedProcess:
        return subprocess.run([self.prefix / "bin/tidemark", *arguments], cwd=self.folder, env=environment(),
                              capture_output=True, text=True, timeout=TIME_LIMIT)

    def made(self, *arguments: str) -> str:
        """What the installed program wrote, which is named last, byte for byte as the one in the build folder writes it."""
        done = self.installed(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        name = arguments[-1]
        self.succeed(*arguments[:-1], "build-" + name)
        self.assertEqual((self.folder / name).read_bytes(), (self.folder / ("build-" + name)).read_bytes())
        return done.stderr

    def test_a_missing_library_is_reported(self) -> None:
        shutil.move(self.prefix / "share", self.folder / "elsewhere")
        self.write("mine.glsl", OF_LIBRARY)
        for more in ([], ["--allow-outside"]):
            done = self.installed("inspect", "mine.glsl", "--device", "none", *more)
            self.assertEqual(done.returncode, 3)
            self.assertRegex(done.stderr, r"^mine\.glsl:1: error: cannot read '.*/noise\.glsl': tidemark's shader library was "
                                          r"found neither in '.*/bin/shaders/lib' nor in '.*/share/tidemark/shaders/lib'")

    def test_runs(self) -> None:
        self.assertEqual(self.installed("--version").stdout, self.succeed("--version").stdout.decode())

    @unittest.skipUnless(shutil.which("ninja") and shutil.which("dpkg-query"), "no ninja, or no Debian")
    def test_copyright_names_all_compiled_in_libraries(self) -> None:
        text = (self.prefix / "share/doc/tidemark/copyright").read_text()
        self.assertEqual(package_contents.unnamed(text, BUILD), [])
        self.assertEqual(package_contents.unnamed(text.replace("libcli11-dev", "a library"), BUILD), ["libcli11-dev"])
        self.assertEqual(package_contents.unnamed(text.replace("License: BSL-1.0\n Boost", "Boost"), BUILD), ["the words of BSL-1.0"])

    @unittest.skipUnless(shutil.which("desktop-file-validate"), "desktop-file-utils is not installed")
    def test_its_desktop_entry_is_valid_and_names_its_icon(self) -> None:
        entry = self.prefix / "share/applications/tidemark.desktop"
        if not entry.is_file():
            self.skipTest("a build without a window")
        done = subprocess.run(["desktop-file-validate", entry], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        self.assertIn("Icon=tidemark\n", entry.read_text())
        self.assertTrue((self.prefix / "share/icons/hicolor/128x128/apps/tidemark.png").is_file())

    def test_has_a_manual_page_for_every_command_and_its_options(self) -> None:
        for command in option_table.commands():
            with self.subTest(command):
                page = self.prefix / f"share/man/man1/tidemark-{command.split()[0]}.1.gz"
                roff = gzip.decompress(page.read_bytes()).decode().replace("\\-", "-")
                for head, _ in option_table.options_of(command):
                    self.assertIn(f"\\fB{head.split(' ')[0]}\\fR", roff)
                for heading in ("NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "SEE ALSO"):
                    self.assertIn(f"\n.SH {heading}\n", roff)
        capture = gzip.decompress((self.prefix / "share/man/man1/tidemark-capture.1.gz").read_bytes()).decode().replace("\\-", "-")
        self.assertIn(".TP\n`capture SCENE`\ndraws frames without a display;", capture)
        self.assertIn("\ntidemark capture my_shader.glsl -o frame.png --time 2.5 ", capture.partition(".SH EXAMPLES\n")[2])
        self.assertIn(b".SH COMMANDS", gzip.decompress((self.prefix / "share/man/man1/tidemark.1.gz").read_bytes()))

    @unittest.skipUnless(has_context(), "no OpenGL context")
    def test_draws_with_library_and_plug_ins(self) -> None:
        self.write("mine.glsl", OF_LIBRARY)
        self.made("capture", "mine.glsl", *SMALL, "-o", "mine.exr")
        scene = str(self.prefix / "share/tidemark/shaders/stylized_waves.glsl")  # reads a texture
        self.assertNotIn("warning", self.made("capture", scene, *SMALL, "-o", "waves.png"))

    @unittest.skipUnless(has_context(), "no OpenGL context")
    def test_library_includes_stay_in_its_folder(self) -> None:
        self.write("scenes/out.glsl", OF_LIBRARY.replace("noise.glsl", "../water_surface.glsl"))
        done = self.installed("capture", "scenes/out.glsl", *SMALL)
        self.assertEqual(done.returncode, 3)
        self.assertIn("out.glsl:1: error: ", done.stderr)
        self.assertIn("lies outside the scene's folder", done.stderr)


if __name__ == "__main__":
    main(needs_context=False)
