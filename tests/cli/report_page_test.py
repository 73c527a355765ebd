"""The page of `tidemark study` in headless Chromium, as a person explores it: by pointer, by keys, without scripts."""
import json
import sys

from support import browser
from support.program import SKIPPED, ProgramTest, main

SCENE = """#define STEPS 4
void mainImage(out vec4 c, in vec2 p) {
    float x = p.x / iResolution.x, sum = 0.0;
    for (int i = 0; i < STEPS; ++i)
        sum += exp(x * (float(i) + 0.5) / float(STEPS)) / float(STEPS);
    c = vec4(0.5 * sum);
}
"""
VALUES = (1, 2, 8, 32)
QUICK = ("--size", "32x18", "--budget", "2")
WIDTH = "document.documentElement.scrollWidth"
CARD = "[...document.querySelectorAll('.card')].filter(card => card.checkVisibility()).map(card => card.querySelector('h3').textContent)"


class Page(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        super().setUp()
        self.write("sums/waves.glsl", SCENE)
        self.succeed("study", "sums/waves.glsl", "--vary", "STEPS=" + ",".join(map(str, VALUES)), *QUICK, "-o", "report")
        self.resize(1200)
        self.open()

    def open(self):
        self.browser.open(f"file://{self.folder}/report/report.html")

    def resize(self, width, dark=False):
        self.browser.call("Emulation.setDeviceMetricsOverride", width=width, height=4000, deviceScaleFactor=1, mobile=False)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.browser.call("Emulation.setEmulatedMedia", features=[scheme])

    def seen(self, script):
        return self.browser.evaluate(script)

    def middle(self, selector):
        """Of the first such element that is seen, in the window, which holds the whole page."""
        return self.seen(f"(() => {{ const e = [...document.querySelectorAll('{selector}')].find(e => e.checkVisibility());"
                         " const box = e.getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2]; })()")

    def mark(self, point):
        return self.middle(f".mark[data-point=\"{point}\"] .shape")

    def key(self, key, code):
        for kind in ("keyDown", "keyUp"):
            self.browser.call("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=code)

    def left(self):
        """The points that no limit excludes, by their marks in the diagram that is seen."""
        return self.seen("[...document.querySelectorAll('.diagram.wide .mark:not(.out)')].map(m => Number(m.dataset.point))")


class Exploring(Page):
    def test_has_the_scenes_name_and_makes_no_requests(self):
        self.assertEqual(self.seen("document.title"), "waves: error against run time")
        self.assertEqual(self.seen("document.querySelector('h1').textContent"), "waves")
        asked = [address for address in self.browser.requests if not address.startswith("data:")]
        self.assertEqual(asked, [f"file://{self.folder}/report/report.html"])
        self.assertEqual(self.browser.complaints, [])
        self.assertTrue(self.seen("[...document.images].length > 9 && [...document.images].every(i => i.naturalWidth === 32)"))

    def test_hovering_shows_a_card_and_a_click_pins_the_card(self):
        self.assertEqual(self.seen(CARD), ["defaults"])
        self.browser.mouse("mouseMoved", *self.mark(3))
        self.browser.wait_for(f"{CARD}.join() === 'STEPS = 8'")
        facts = self.seen("[...document.querySelectorAll('.card.shown dt')].map(e => e.textContent)")
        self.assertEqual(facts, ["STEPS", "RMSE of the picture", "ms [95 %]", "PSNR", "FLIP"])
        self.assertEqual(self.seen("[...document.querySelectorAll('.card.shown figcaption')].map(e => e.textContent)"), ["picture", "FLIP"])
        self.browser.mouse("mouseMoved", 5, 5)
        self.browser.wait_for(f"{CARD}.join() === 'defaults'")
        x, y = self.mark(4)
        self.browser.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
        self.browser.mouse("mouseReleased", x, y, button="left", buttons=0, clickCount=1)
        self.browser.mouse("mouseMoved", 5, 5)
        self.browser.wait_for(f"{CARD}.join() === 'STEPS = 32'")

    def test_keys_reach_every_mark(self):
        self.seen("document.querySelector('.diagram.wide .mark').focus()")
        names = []
        for _ in range(3):
            names += self.seen(CARD)
            self.key("Tab", 9)
        self.assertEqual(names, ["defaults", "STEPS = 1", "STEPS = 2"])

    def test_a_number_field_filters_the_points(self):
        points = json.loads((self.folder / "report/study.json").read_text())["points"]
        limit = points[3]["all"]["picture"]["rmse"] * 1.01
        self.assertEqual(self.left(), [0, 1, 2, 3, 4])
        self.seen(f"(f => {{ f.value = {limit}; f.dispatchEvent(new Event('input')); }})(document.getElementById('most-error'))")
        self.assertEqual(self.left(), [3, 4])
        self.assertRegex(self.seen("document.querySelector('.limits output').textContent"),
                         r"^2 of 5 settings are left; the fastest: STEPS = \d+; the most exact: STEPS = 32\.$")
        self.assertEqual(self.seen("document.querySelectorAll('tr.out').length"), 2 * 3)  # in both tables
        self.seen("document.querySelector('.limits button').click()")
        self.browser.wait_for("document.querySelectorAll('.out').length === 0")

    def test_a_limit_line_moves_by_mouse_and_keys(self):
        x, y = self.middle(".diagram.wide [data-limit=error] rect")
        below = (self.mark(2)[1] + self.mark(3)[1]) / 2
        self.browser.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
        self.browser.mouse("mouseMoved", x, below, button="left", buttons=1)
        self.browser.mouse("mouseReleased", x, below, button="left", buttons=0)
        self.assertEqual(self.left(), [3, 4])
        value = float(self.seen("document.getElementById('most-error').value"))
        self.key("ArrowUp", 38)
        self.assertAlmostEqual(float(self.seen("document.getElementById('most-error').value")) / value, 1.05, 1)

    def test_series_are_turned_off(self):
        button = "[...document.querySelectorAll('.legend button')].find(b => b.textContent === 'STEPS')"
        self.seen(f"{button}.click()")
        self.assertEqual(self.seen("[...document.querySelectorAll('.diagram.wide .mark')].filter(m => m.checkVisibility()).length"), 1)
        self.assertEqual(self.seen(f"{button}.getAttribute('aria-pressed')"), "false")
        self.seen(f"{button}.click()")
        self.assertEqual(self.left(), [0, 1, 2, 3, 4])

    def test_two_pictures_and_their_divider(self):
        chosen = "[...document.querySelectorAll('.choices select')].map(s => s.selectedOptions[0].textContent)"
        self.assertEqual(self.seen(chosen), ["reference", "defaults: picture"])
        x, y = self.middle(".slider")
        box = self.seen("(({left, width}) => [left, width])(document.querySelector('.slider').getBoundingClientRect())")
        self.browser.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
        self.browser.mouse("mouseMoved", box[0] + box[1] / 4, y, button="left", buttons=1)
        self.browser.mouse("mouseReleased", box[0] + box[1] / 4, y, button="left", buttons=0)
        clip = "getComputedStyle(document.querySelectorAll('.slider img')[1]).clipPath"
        self.assertEqual(self.seen(clip), "inset(0px 0px 0px 25%)")
        self.seen("document.querySelector('.card.shown .choose button').click()")
        self.assertEqual(self.seen(chosen), ["defaults: picture", "defaults: picture"])


class Widths(Page):
    def test_page_fits_the_window(self):
        for width in (360, 768, 2000):
            for dark in (False, True):
                with self.subTest(width=width, dark=dark):
                    self.resize(width, dark)
                    self.open()
                    self.assertLessEqual(self.seen(WIDTH), width)
                    shown = "narrow" if width == 360 else "wide"
                    self.assertEqual(self.seen("[...document.querySelectorAll('.diagram')].filter(d => d.checkVisibility())"
                                               ".map(d => d.classList[1])"), [shown])
                    self.assertEqual(self.seen("getComputedStyle(document.body).backgroundColor"),
                                     "rgb(23, 25, 28)" if dark else "rgb(252, 252, 250)")

    def test_labels_do_not_overlap(self):
        for width in (360, 1200):
            self.resize(width)
            self.open()
            boxes = self.seen("""[...document.querySelectorAll('.diagram .label, .diagram .shape')].filter(e => e.checkVisibility())
                .map(e => (({left, top, right, bottom}) => [left, top, right, bottom])(e.getBoundingClientRect()))""")
            labels = self.seen("[...document.querySelectorAll('.label')].filter(e => e.checkVisibility()).length")
            self.assertGreaterEqual(labels, 4)
            for i, (left, top, right, bottom) in enumerate(boxes[:labels]):
                for other in boxes[i + 1:]:
                    apart = right <= other[0] or other[2] <= left or bottom <= other[1] or other[3] <= top
                    self.assertTrue(apart, (width, i, boxes[i], other))


class WithoutScripts(Page):
    def open(self):
        self.browser.call("Emulation.setScriptExecutionDisabled", value=True)
        self.addCleanup(self.browser.call, "Emulation.setScriptExecutionDisabled", value=False)
        super().open()

    def test_shows_diagram_table_and_cards(self):
        self.assertEqual(self.seen("document.querySelectorAll('.diagram.wide .mark').length"), 5)
        self.assertEqual(self.seen("document.querySelector('.diagram.wide .mark title').textContent.split(':')[0]"), "defaults")
        self.assertFalse(self.seen("document.querySelector('.limits').checkVisibility()"))
        self.assertTrue(self.seen("document.querySelector('.reference img').checkVisibility()"))
        self.assertEqual(self.seen(CARD), [])
        x, y = self.mark(2)
        self.browser.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
        self.browser.mouse("mouseReleased", x, y, button="left", buttons=0, clickCount=1)
        self.browser.wait_for(f"{CARD}.join() === 'STEPS = 2'")


if __name__ == "__main__":
    if not browser.program():
        print("skipped: chromium is not installed")
        sys.exit(SKIPPED)
    main()
