"""tidemark serve in headless Chromium: a person at the page sees what is drawn and steers it."""
import http.server
import sys
import threading

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
OTHER_HOST = "uniform vec2 u_mouse;\nuniform vec2 u_resolution;\nvoid main() { gl_FragColor = vec4(u_mouse / u_resolution, 0.0, 1.0); }\n"
ORBIT = ("uniform mat4 iCamera;  // at first 10 from the target, 30 degrees to the east and 20 up\n"
         "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5, abs(iCamera[3].x - 4.698) < 0.01 ? 0.5 : 1.0, 0.0, 1.0); }\n")
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


class Token(Page):
    def test_in_the_fragment(self):
        """As a forwarded address keeps it, escaped or not."""
        self.open()
        for between in ("/#token=", "/#token%3D", "/?id=7#token="):
            with self.subTest(between):
                self.browser.open(self.service.address.replace("/?token=", between))
                self.browser.wait_for(f"{FIGURE}.number > 0")
        self.browser.open(self.service.address.partition("?")[0])
        self.browser.wait_for("document.body.innerText.includes('Access denied: open the full address')")
        self.browser.open(self.service.address.partition("?")[0] + "#token=" + "0" * 22)
        self.browser.wait_for(f"{STATE} === 'ended'")


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

    def test_the_mouse_of_another_hosts_text_follows_the_pointer(self):
        self.open(OTHER_HOST)
        self.mouse("mouseMoved", 48.5, 9.5)
        self.wait_for_colour(191, 64, 0)
        self.mouse("mouseMoved", 16.5, 27.5)
        self.wait_for_colour(64, 191, 0)
        self.write("a.glsl", SCENE)  # of ShaderToy: only with a button
        self.wait_for_colour(128, 128, 64)
        self.browser.wait_for(f"{FIGURE}.state.everyMove === false")

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

    def test_reset_camera_is_hidden_without_a_camera(self):
        button = "[...document.querySelectorAll('button')].find(b => b.textContent === 'Reset camera')"
        self.open()
        self.browser.wait_for(f"{FIGURE}.state.knobs.length === 1 && {button}.hidden")
        self.write("a.glsl", ORBIT)
        self.browser.wait_for(f"!{button}.hidden")
        self.wait_for_colour(None, 127, None)
        self.mouse("mousePressed", 10.5, 20.5, button="left", buttons=1, clickCount=1)
        self.mouse("mouseMoved", 42.5, 20.5, button="left", buttons=1)
        self.mouse("mouseReleased", 42.5, 20.5, button="left", clickCount=1)
        self.wait_for_colour(128, 255, None)
        self.press_button("Reset camera")
        self.wait_for_colour(128, 127, None)

    def test_the_copied_command(self):
        self.open()
        self.press_button("Copy command")
        words = self.browser.wait_for("!document.querySelector('.tidemark-message').hidden && "
                                      "document.querySelector('.tidemark-message').textContent")
        self.assertTrue(words.startswith("tidemark capture a.glsl"), words)


class Watching(Page):
    def test_errors_are_over_the_picture(self):
        self.open()
        self.write("a.glsl", SCENE.replace("GREEN * 0.5", "nowhere"))
        text = self.browser.wait_for("!document.querySelector('.tidemark-errors').hidden && "
                                     "document.querySelector('.tidemark-errors').textContent")
        self.assertRegex(text, r"^a\.glsl:5:\d+: error: .*nowhere")
        self.write("a.glsl", SCENE.replace("GREEN * 0.5", "1.0"))
        self.wait_for_colour(128, 255, 64)
        self.browser.wait_for("document.querySelector('.tidemark-errors').hidden")

    def test_a_watching_viewer_has_no_control(self):
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

    def test_page_shows_the_end_of_the_service(self):
        self.open()
        self.service.close()
        self.browser.wait_for(f"{STATE} === 'ended'")
        self.assertEqual(self.browser.evaluate("document.querySelector('.tidemark-message').textContent"),
                         "The connection was lost. Reload the page once the program runs again.")

    def test_makes_no_other_requests(self):
        self.open()
        address = self.service.address.partition("?")[0]
        self.assertEqual([asked for asked in self.browser.requests if not asked.startswith((address, "data:"))], [])

    def test_violates_no_content_security_policy(self):
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


class Lenses(Page):
    """The picture's pixels in steps: column + 1 iterations, with a bar, statistics and the value under the pointer."""

    LOOPS = """void mainImage(out vec4 c, in vec2 p) {
    float sum = 0.0;
    for (int i = 0; i < int(p.x) + 1; ++i)
        sum += 0.001;
    c = vec4(sum, 0.5, 0.5, 1.0);
}
"""
    LEGEND = "document.querySelector('.tidemark-legend')"

    def choose(self, name):
        self.browser.evaluate("((list, name) => { list.value = name; list.dispatchEvent(new Event('change')); })"
                              f"(document.querySelector('select[aria-label=Lens]'), '{name}')")

    def fill(self, field, text):
        self.browser.evaluate("((field, text) => { field.value = text; field.dispatchEvent(new Event('change')); })"
                              f"(document.querySelector('input[aria-label=\"{field}\"]'), '{text}')")

    def test_a_lens_is_chosen_from_a_list(self):
        self.open(self.LOOPS)
        names = self.browser.evaluate("[...document.querySelector('select[aria-label=Lens]').options].map(o => o.textContent)")
        self.assertEqual(names, ["off", "cost", "steps", "error", "rounding", "proof", "clocks", "value", "branch"])
        self.assertTrue(self.browser.evaluate(f"{self.LEGEND}.hidden"))
        self.choose("value")
        self.fill("Line of the lens", "2")
        words = self.browser.wait_for(f"!{self.LEGEND}.hidden && {self.LEGEND}.innerText.includes('sum at') && {self.LEGEND}.innerText")
        self.assertIn("counted", words)
        self.choose("")
        self.browser.wait_for(f"{self.LEGEND}.hidden")
        self.wait_for_colour(8, 128, 128)

    def test_the_legend_shows_the_value_under_the_pointer(self):
        self.open(self.LOOPS)
        self.choose("steps")
        self.fill("Line of the lens", "3")
        words = self.browser.wait_for(f"{self.LEGEND}.innerText.includes('iterations') && {self.LEGEND}.innerText.includes('64') && {self.LEGEND}.innerText")
        for number in ("min", "median", "99", "max"):
            self.assertIn(number, words)
        self.browser.wait_for("document.querySelector('.tidemark-scale') !== null")
        for column in (10, 50):
            self.mouse("mouseMoved", column + 0.5, 20.5)
            self.browser.wait_for(f"/\\b{column + 1}\\b/.test(document.querySelector('.tidemark-value').textContent)")
        # The colours rise from dark blue to yellow.
        self.browser.wait_for(f"(([a], [b]) => b > a + 50)(...[2, 60].map(x => {CANVAS}.getContext('2d').getImageData(x, 18, 1, 1).data))")

    def test_a_lens_that_the_scene_has_not_is_refused_with_the_reason(self):
        self.open("void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }\n")
        self.choose("proof")
        self.browser.wait_for(f"{self.LEGEND}.innerText.includes('no marching loop')")


class Framed(Page):
    """What the page and the one around it, an editor's, say to each other."""

    def frame(self) -> None:
        """Shows the page in a frame; `said` are the messages of the page."""
        test = self

        class Around(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                self.send_response(200)
                self.end_headers()
                self.wfile.write(f"""<body style="margin:0"><iframe style="border:0;width:100%;height:700px" src="{test.service.address}"></iframe>
                    <script>said = []; onmessage = ({{data}}) => said.push(data);
                    ask = tidemark => document.querySelector("iframe").contentWindow.postMessage({{tidemark}}, "*")</script>""".encode())

            def log_message(self, *_):
                pass

        around = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Around)
        threading.Thread(target=around.serve_forever, daemon=True).start()
        self.addCleanup(around.server_close)
        self.addCleanup(around.shutdown)
        self.write("a.glsl", SCENE)
        origin = f"http://127.0.0.1:{around.server_port}"
        self.service = Service(self.folder, "a.glsl", "--size", "64x36", "--frame-ancestor", origin)
        self.addCleanup(self.service.close)
        self.browser.open(origin)

    def said(self, what: str) -> dict:
        return self.browser.wait_for(f"said.find(({{tidemark}}) => tidemark === '{what}')")

    def test_pictures_commands_and_pixels(self):
        self.frame()
        picture = self.said("picture")
        self.assertEqual((picture["size"], picture["bad"]), ([64, 36], 0))
        self.assertGreater(picture["draw"], 0)
        self.browser.evaluate("ask('command')")
        self.assertTrue(self.said("command")["text"].startswith("tidemark capture a.glsl"))
        self.browser.evaluate("ask('pick')")
        self.browser.evaluate("ask('command')")  # messages come in order: the answer shows that the page waits for a click
        self.browser.wait_for("said.filter(({tidemark}) => tidemark === 'command').length === 2")
        for kind in ("mousePressed", "mouseReleased"):
            self.browser.mouse(kind, 300, 100, button="left", buttons=int(kind == "mousePressed"), clickCount=1)
        pixel = self.said("pick")
        self.assertTrue(0 <= pixel["x"] < 64 and 0 <= pixel["y"] < 36, pixel)
        # The scene's mouse did not move: the command names none.
        self.browser.evaluate("ask('command')")
        self.browser.wait_for("said.filter(({tidemark}) => tidemark === 'command').length === 3")
        self.assertNotIn("--mouse", self.browser.evaluate("said.findLast(({tidemark}) => tidemark === 'command').text"))


if __name__ == "__main__":
    if not browser.program():
        print("skipped: chromium is not installed")
        sys.exit(SKIPPED)
    main()
