"""tidemark serve in headless Chromium: a person at the page sees what is drawn and steers it."""
import sys

from support import browser
from support.program import SKIPPED, ProgramTest, main
from support.websocket import Service

SCENE = """\
#iUniform float blue = 0.25 in { 0.0, 1.0 }
#define GREEN 1.0
void mainImage(out vec4 c, in vec2 p) {
    vec2 uv = p / iResolution.xy;
    c = vec4(iMouse.z > 0.0 ? iMouse.x / iResolution.x : 0.5, GREEN * 0.5, blue, 1.0);
}
"""
MOVING = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5 + 0.5 * sin(iTime), p / iResolution.xy, 1.0); }\n"
FIGURE = "document.querySelector('.tidemark').tidemark"
STATE = "document.querySelector('.tidemark').dataset.state"
CANVAS = "document.querySelector('canvas')"
MIDDLE = f"[...{CANVAS}.getContext('2d').getImageData(32, 18, 1, 1).data].slice(0, 3)"


class Page(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def open(self, text=SCENE, *options):
        self.write("a.glsl", text)
        self.service = Service(self.folder, "a.glsl", "--size", "64x36", "--quality", "95", *options)
        self.addCleanup(self.service.close)
        self.browser.open(self.service.address)
        self.browser.wait_for(f"{FIGURE}.number > 0")

    def wait_for_colour(self, *wanted):
        """Of the pixel in the middle, as near as JPEG has it; none: whatever."""
        near = " && ".join(f"Math.abs(rgb[{i}] - {value}) < 8" for i, value in enumerate(wanted) if value is not None)
        self.browser.wait_for(f"(rgb => {near})({MIDDLE})")

    def mouse(self, kind, x, y, **more):
        """At pixels of the picture from its bottom left."""
        left, top, width, height = self.browser.evaluate(
            f"(({{left, top, width, height}}) => [left, top, width, height])({CANVAS}.getBoundingClientRect())")
        self.browser.mouse(kind, left + x / 64 * width, top + height - y / 36 * height, **more)

    def key(self, key, code):
        for kind in ("keyDown", "keyUp"):
            self.browser.call("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code)

    def press_button(self, name):
        self.browser.evaluate(f"[...document.querySelectorAll('button')].find(b => b.textContent === '{name}' || b.title === '{name}').click()")


class Steering(Page):
    def test_mouse_knobs_and_definitions(self):
        self.open()
        self.wait_for_colour(128, 128, 64)
        self.mouse("mousePressed", 48.5, 20.5, button="left", buttons=1, clickCount=1)
        self.wait_for_colour(191, 128, 64)
        self.mouse("mouseMoved", 16.5, 20.5, button="left", buttons=1)
        self.wait_for_colour(64, 128, 64)
        self.mouse("mouseReleased", 16.5, 20.5, button="left", clickCount=1)
        self.wait_for_colour(128, 128, 64)
        self.browser.evaluate("(field => { field.value = 1; field.dispatchEvent(new Event('input')); })"
                              "(document.querySelector('input[aria-label=blue]'))")
        self.wait_for_colour(128, 128, 255)
        self.browser.wait_for("[...document.querySelectorAll('button')].some(b => b.textContent === 'Reset')")
        self.press_button("Reset")
        self.wait_for_colour(128, 128, 64)
        self.browser.evaluate("(field => { field.value = 0; field.dispatchEvent(new Event('change')); })"
                              "(document.querySelector('input[aria-label=GREEN]'))")
        self.wait_for_colour(128, 0, 64)

    def test_time(self):
        self.open(MOVING)
        self.browser.evaluate(f"{CANVAS}.focus()")
        self.key(" ", 32)
        self.browser.wait_for(f"{FIGURE}.state.time.paused")
        self.assertRegex(self.browser.wait_for("document.title.includes('paused') && document.title"), r"^a - tidemark - paused at ")
        self.browser.evaluate("(bar => { bar.value = 7.5; bar.dispatchEvent(new Event('input')); })(document.querySelector('input[aria-label=Time]'))")
        self.browser.wait_for(f"{FIGURE}.head.seconds === 7.5")
        self.press_button("Restart")
        self.browser.wait_for(f"{FIGURE}.head.seconds === 0")
        self.press_button("Play")
        self.browser.wait_for(f"{FIGURE}.head.seconds > 0.2")
        words = "[...document.querySelectorAll('button')].filter(b => /^[AB]$/.test(b.textContent)).map(b => [b.title, b.ariaLabel])"
        self.assertEqual(self.browser.evaluate(words), [[f"Set the {end} of a time loop here"] * 2 for end in ("start", "end")])
        self.press_button("B")
        self.browser.wait_for(f"{FIGURE}.state.time.to > 0.2")
        self.browser.evaluate(f"{FIGURE}.link.send('loop', {{from: 0.01, to: 0.05}})")
        self.browser.wait_for(f"{FIGURE}.state.time.from === 0.01 && {FIGURE}.head.seconds < 0.2")
        self.browser.evaluate("[...document.querySelectorAll('button')].find(b => b.textContent === 'A 0.01 s').click()")
        self.browser.wait_for(f"{FIGURE}.state.time.from === null")

    def test_the_copied_command(self):
        self.open()
        self.press_button("Copy command")
        words = self.browser.wait_for("!document.querySelector('.tidemark-message').hidden && "
                                      "document.querySelector('.tidemark-message').textContent")
        self.assertTrue(words.startswith("tidemark capture a.glsl"), words)


class Looking(Page):
    def test_errors_are_over_the_picture(self):
        self.open()
        self.write("a.glsl", SCENE.replace("GREEN * 0.5", "nowhere"))
        text = self.browser.wait_for("!document.querySelector('.tidemark-errors').hidden && "
                                     "document.querySelector('.tidemark-errors').textContent")
        self.assertRegex(text, r"^a\.glsl:5:\d+: error: .*nowhere")
        self.write("a.glsl", SCENE.replace("GREEN * 0.5", "1.0"))
        self.wait_for_colour(128, 255, 64)
        self.browser.wait_for("document.querySelector('.tidemark-errors').hidden")

    def test_one_who_watches_is_told_so(self):
        self.write("a.glsl", SCENE)
        service = Service(self.folder, "a.glsl", "--size", "64x36")
        self.addCleanup(service.close)
        first = service.viewer()
        first.picture()
        self.browser.open(service.address)
        self.browser.wait_for(f"{FIGURE}.number > 0 && document.querySelector('fieldset').disabled")
        self.browser.wait_for("document.querySelector('.tidemark-status').textContent.includes('watching, 1 other viewer')")
        self.press_button("Take control")
        self.browser.wait_for("!document.querySelector('fieldset').disabled")
        self.assertFalse(first.text("steering", lambda steering: not steering["you"])["you"])
        first.close()
        self.browser.wait_for(f"{FIGURE}.steering.viewers === 1")

    def test_the_end(self):
        self.open()
        self.service.close()
        self.browser.wait_for(f"{STATE} === 'ended'")
        self.assertEqual(self.browser.evaluate("document.querySelector('.tidemark-message').textContent"),
                         "The connection was lost. Reload the page once the program runs again.")

    def test_makes_no_other_requests(self):
        self.open()
        address = self.service.address.partition("?")[0]
        self.assertEqual([asked for asked in self.browser.requests if not asked.startswith((address, "data:"))], [])

    def test_breaks_no_rule_of_its_own(self):
        """The address of its icon included, which a browser with a window loads."""
        self.open()
        refused = self.browser.evaluate("""new Promise(done => {
            document.addEventListener("securitypolicyviolation", () => done(true));
            const icon = new Image();
            icon.onload = icon.onerror = () => setTimeout(() => done(false), 100);
            icon.src = document.querySelector("link[rel=icon]").href;
        })""")
        self.assertEqual((refused, self.browser.complaints), (False, []))

    def test_fits_the_window(self):
        """Nothing is wider than the page, and the picture is as it was drawn."""
        self.open()
        for width in (360, 1000):
            self.browser.screenshot(width, 800)
            self.assertTrue(self.browser.evaluate("document.documentElement.scrollWidth <= document.documentElement.clientWidth"), width)
            wide, high = self.browser.evaluate(f"(r => [r.width, r.height])({CANVAS}.getBoundingClientRect())")
            self.assertAlmostEqual(wide / high, 64 / 36, places=1)


if __name__ == "__main__":
    if not browser.program():
        print("skipped: chromium is not installed")
        sys.exit(SKIPPED)
    main()
