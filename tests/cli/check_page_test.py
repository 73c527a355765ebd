"""The page of `tidemark check -o` in headless Chromium: what a person who opens it sees."""
import re
import shlex
import sys

from support import browser, png
from support.program import SKIPPED, ProgramTest, main

BROKEN = ("void mainImage(out vec4 c, in vec2 p) {\n    // <script>alert(1)</script>\n"
          "    c = vec4(sqrt(p.x - 30.0) + 0.0 * float(0 < 1));\n}\n")


class Page(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def open(self, *options, code=1, width=1200):
        self.write("broken & co/waves.glsl", BROKEN)
        done = self.run_program("check", "broken & co/waves.glsl", "-o", "seen", *options)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn("wrote seen/index.html\n", done.stderr)
        self.resize(width)
        self.browser.open(f"file://{self.folder}/seen/index.html")
        return done.stdout.decode()

    def resize(self, width):
        self.browser.call("Emulation.setDeviceMetricsOverride", width=width, height=1000, deviceScaleFactor=1, mobile=False)

    def texts(self, selector):
        return self.browser.evaluate(f"[...document.querySelectorAll('{selector}')].map(e => e.textContent)")

    def test_a_failure_shows_sentence_picture_origin_and_command(self):
        printed = self.open("--probe", "times", "--probe", "sizes", "--probe", "hashes")
        self.assertEqual(self.texts("h1"), ["waves"])
        self.assertEqual(self.texts("h2"), ["Failures", "Passed", "Not applicable"])
        self.assertEqual(self.texts(".counts a"), ["1 fail", "1 pass", "1 n/a"])
        fix, command = self.texts(".command code")
        self.assertIn("tidemark check --fix 'broken & co/waves.glsl'", fix)
        self.assertEqual(self.texts(".fail h3"), ["Some pixels are NaN or infinite: sqrt of a negative number"])
        self.assertEqual(self.texts(".fail h4"), ["times fail"])
        place, sentence = self.texts(".fail p")[:2]
        self.assertRegex(place, r"waves\.glsl:3$")
        self.assertRegex(sentence, r"^NaN in 1080 of 2304 pixels of Image")
        self.assertIn(sentence, printed)
        self.assertRegex(self.texts(".fail pre")[0], r"waves\.glsl:3:\d+: .*sqrt of a negative number")
        self.assertIn(command, printed)
        self.succeed(*shlex.split(command)[1:-1], "again.png")
        self.assertEqual(len(png.read(self.folder / "again.png").rows), 36)
        self.assertEqual(self.browser.evaluate("[...document.images].map(i => i.naturalWidth)"), [64])

    def test_makes_no_requests_and_escapes_texts(self):
        self.open("--probe", "times")
        asked = [address for address in self.browser.requests if not address.startswith("data:")]
        self.assertEqual([re.sub("%20", " ", address) for address in asked], [f"file://{self.folder}/seen/index.html"])
        self.assertEqual(self.browser.complaints, [])
        self.assertEqual(self.browser.evaluate("document.scripts.length"), 1)

    def test_a_command_is_copied(self):
        self.open("--probe", "times")
        self.browser.evaluate("navigator.clipboard.writeText = async text => { window.copied = text; }")
        self.browser.evaluate("document.querySelector('.command button').click()")
        self.browser.wait_for("document.querySelector('.command button').textContent === 'Copied'")
        self.assertEqual(self.browser.evaluate("window.copied"), self.texts(".command code")[0])

    def test_page_fits_the_window(self):
        self.open("--probe", "times", "--probe", "frames", width=360)
        for width in (360, 2000):
            self.resize(width)
            self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), width)

    def test_reports_cut_probes(self):
        self.write("broken & co/waves.glsl", BROKEN)
        done = self.run_program("check", "broken & co/waves.glsl", "-o", "seen", "--budget", "1e-9", "--probe", "times")
        self.assertEqual(done.returncode, 5)
        self.assertIn("Cut off by --budget", (self.folder / "seen/index.html").read_text())

    def test_reports_unwritable_folder_before_any_probe(self):
        self.write("file", "")
        self.write("a.glsl", BROKEN)
        done = self.run_program("check", "a.glsl", "-o", "file/seen")
        self.assertEqual((done.returncode, done.stdout), (4, b""))


if __name__ == "__main__":
    if not browser.program():
        print("skipped: chromium is not installed")
        sys.exit(SKIPPED)
    main()
