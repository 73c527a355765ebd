"""`export --html`: the page in headless Chromium draws what `capture` draws, and does what the window does."""
import base64
import datetime
import json
import re
import shutil
import struct
import subprocess
import sys

from support import browser, png
from support.program import ROOT, SKIPPED, ProgramTest, main

SCENES = ROOT / "shaders"
CASES = ROOT / "tests" / "cases" / "conformance"
# Settings that a page's address does not hold: input, options and other clocks.
NOT_ASKED = ("mouse", "keys", "resize", "reset", "date", "fps")
# Frames of a conformance scene with all that happens before each, drawn by the page's own renderer, mouse and keyboard;
# the samples of Image, from the bottom left, as it left them.
DRAW_FRAMES = """((figure, size, frames) => {
    const {renderer, mouse, keyboard, camera, scene: {knobs}} = figure, {gl} = renderer;
    Object.assign(renderer.image.target, {format: gl.RGBA32F, size: null}); // what bytes would clamp
    renderer.resize(...size);
    renderer.restart();
    return frames.map(asked => {
        if (asked.reset)
            renderer.restart();
        if (asked.resize)
            renderer.resize(...asked.resize);
        for (const [what, ...at] of asked.mouse ?? [])
            mouse[what](...at);
        for (const [what, code] of asked.keys ?? [])
            keyboard[what](code);
        const {frame = 0, fps: rate = 60, date} = asked, time = frame / rate;
        renderer.draw({frame, time, delta: 1 / rate, rate, date, mouse, keyboard, camera, knobs});
        mouse.frameDrawn();
        keyboard.frameDrawn();
        const samples = new Float32Array(4 * renderer.size[0] * renderer.size[1]);
        gl.bindFramebuffer(gl.READ_FRAMEBUFFER, renderer.image.target.latest.faces[0]);
        gl.readPixels(0, 0, ...renderer.size, gl.RGBA, gl.FLOAT, samples);
        return [renderer.size[0], [...samples]];
    });
})(%s, %s, %s)"""
STATE = "document.querySelector('.tidemark').dataset.state"
FIGURE = "document.querySelector('.tidemark').tidemark"
PICTURE = "document.querySelector('.tidemark canvas').toDataURL('image/png').split(',')[1]"


def float_of(number):
    return struct.unpack("f", struct.pack("f", number))[0]


def date_of(frame):
    """Its iDate."""
    date = datetime.datetime.fromisoformat(frame.get("date", "2024-01-01T12:00:00"))
    return [date.year, date.month - 1, date.day, (date - datetime.datetime(date.year, date.month, date.day)).total_seconds()]


class Page(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def export(self, *words):
        self.succeed("export", *words, "--html", "page.html")

    def open(self, moment, state="running", remark=""):
        self.browser.open(f"file://{self.folder}/page.html#{moment}")
        self.browser.wait_for(f"{STATE} && {STATE} !== 'loading'")
        self.assertEqual((self.browser.evaluate(STATE), self.message() if state == "running" else ""), (state, remark))

    def message(self):
        return self.browser.evaluate("document.querySelector('.tidemark-message').textContent")

    def shown(self):
        """RGB rows of the canvas, from the top."""
        picture = png.decode(base64.b64decode(self.browser.evaluate(PICTURE)))
        if picture.channels == 3:
            return picture.rows
        return [bytes(value for i, value in enumerate(row) if i % 4 != 3) for row in picture.rows]

    def captured(self, scene, *words):
        self.succeed("capture", scene, *words, "-o", "ours.png")
        return png.read(self.folder / "ours.png").rows

    def assert_same(self, scene, moment, *words, most=0.0):
        """`most`: the share of pixels that may differ."""
        self.open(f"{moment}&paused")
        ours, theirs = self.captured(scene, *words), self.shown()
        self.assertEqual((len(ours), len(ours[0])), (len(theirs), len(theirs[0])))
        pixels = [(a[i:i + 3], b[i:i + 3]) for a, b in zip(ours, theirs) for i in range(0, len(a), 3)]
        differing = [pair for pair in pixels if pair[0] != pair[1]]
        self.assertLessEqual(len(differing), most * len(pixels), differing[:4])


class Pictures(Page):
    def test_waters_equal_capture(self):
        for scene in sorted(SCENES.glob("*.glsl")):
            with self.subTest(scene=scene.name):
                self.export(str(scene))
                # At grazing angles the translator's rounding decides where a march ends.
                most = 0.005 if scene.stem == "procedural_ocean" else 0
                self.assert_same(str(scene), "time=1.5&size=160x90", "--time", "1.5", "--size", "160x90", most=most)

    def test_conformance_cases_equal_capture(self):
        asked = 0
        for case in sorted(CASES.iterdir()):
            if not case.is_dir():
                continue
            expected = json.loads((case / "expected.json").read_text())
            frames = [f for f in expected.get("frames", []) if not any(word in f for word in NOT_ASKED)]
            if "channels" in expected or not frames or len(frames) < len(expected["frames"]):
                continue
            scene = next((str(case / n) for n in ("scene.glsl", "project.json") if (case / n).exists()), str(case))
            width, height = expected["size"]
            with self.subTest(case=case.name):
                self.export(scene)
                number = str(frames[-1].get("frame", 0))
                self.assert_same(scene, f"frame={number}&size={width}x{height}", "--frame", number, "--size",
                                 f"{width}x{height}")
                asked += 1
        self.assertGreater(asked, 40)

    def test_other_conformance_cases_equal_capture(self):
        """Every other conformance scene with frames, but for two: the page plays an input of sound in real time, and
        `--channel` is none of its options."""
        asked = 0
        for case in sorted(CASES.iterdir()):
            expected = json.loads((case / "expected.json").read_text()) if case.is_dir() else {}
            frames = expected.get("frames", [])
            if case.name == "music_plays_again" or not any(word in f for f in frames for word in NOT_ASKED):
                continue
            scene = next((str(case / n) for n in ("scene.glsl", "project.json") if (case / n).exists()), str(case))
            with self.subTest(case=case.name):
                self.export(scene)
                self.open("paused")
                drawn = self.browser.evaluate(DRAW_FRAMES % (FIGURE, json.dumps(expected["size"]),
                                                             json.dumps([{**f, "date": date_of(f)} for f in frames])))
                for frame, (width, samples) in zip(frames, drawn):
                    self.assert_samples(frame, width, samples, expected.get("target", "bytes"))
                asked += 1
        self.assertGreater(asked, 12)

    def assert_samples(self, frame, width, samples, target):
        if target == "bytes":
            samples = [int(255 * min(max(sample, 0), 1) + 0.5) for sample in samples]
        wanted = [(x, y, colour) for x, y, colour in frame.get("pixels", [])]
        if "everywhere" in frame:
            wanted += [(i % width, i // width, frame["everywhere"]) for i in range(len(samples) // 4)]
        self.assertTrue(wanted)
        for x, y, colour in wanted:
            got = samples[4 * (y * width + x):][:len(colour)]
            for sample, value in zip(got, colour):
                self.assertLessEqual(abs(sample - float_of(value)), frame.get("tolerance", 0), (frame, x, y, got))

    def test_inputs_from_files_equal_capture(self):
        """What the browser decodes, and 16 bits, which only we do."""
        if not shutil.which("ffmpeg"):
            self.skipTest("ffmpeg is not installed")
        for name, source, *how in (("photo.jpg", "testsrc2=size=64x48", "-frames:v", "1"),
                                   ("wide.png", "testsrc2=size=64x48", "-frames:v", "1", "-pix_fmt", "rgb48be"),
                                   ("film.webm", "testsrc=size=64x48:rate=30:duration=3", "-c:v", "libvpx-vp9", "-lossless", "1")):
            with self.subTest(name=name):
                subprocess.run(["ffmpeg", "-loglevel", "error", "-f", "lavfi", "-i", source, *how, name], cwd=self.folder, check=True)
                self.write("file.glsl", f'#iChannel0 "{name}"\n#iChannel0::MinFilter "LinearMipMapLinear"\n'
                           "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p / iResolution.xy); }\n")
                self.export("file.glsl")
                self.assert_same("file.glsl", "time=1.2&size=32x24", "--time", "1.2", "--size", "32x24")


MOUSE = "void mainImage(out vec4 c, in vec2 p) { vec4 m = iMouse; c = vec4(m.x / 64.0, m.y / 36.0, m.z > 0.0, m.w > 0.0); }\n"
COUNTER = """#iChannel0 "self"
void mainImage(out vec4 c, in vec2 p) {
    c = fract(texelFetch(iChannel0, ivec2(p), 0) * 1.25 + vec4(0.1, p.x / 64.0, p.y / 36.0, 1.0));
}
"""


class Behaviour(Page):
    def pixel(self, x=0, y=0):
        """From the bottom left."""
        row = self.shown()[-1 - y]
        return tuple(row[3 * x:3 * x + 3])

    def wait_for_pixel(self, wanted):
        script = f"""(() => {{ const gl = {FIGURE}.renderer.gl, pixel = new Uint8Array(4);
            gl.bindFramebuffer(gl.FRAMEBUFFER, null);
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
            return String(pixel.subarray(0, 3)) === '{",".join(map(str, wanted))}'; }})()"""
        self.browser.wait_for(script)

    def place(self, x, y):
        """Of a part of the canvas, in the window."""
        box = self.browser.evaluate("(({left, top, width, height}) => [left, top, width, height])"
                                    "(document.querySelector('canvas').getBoundingClientRect())")
        return box[0] + x * box[2], box[1] + (1 - y) * box[3]

    def test_feedback_of_many_frames(self):
        self.write("counter.glsl", COUNTER)
        self.export("counter.glsl")
        self.assert_same("counter.glsl", "frame=100&size=64x36", "--frame", "100", "--size", "64x36")

    def test_a_stated_size_sets_the_aspect_ratio(self):
        for size in ((90, 200), (200, 90), (300, 100), (640, 360)):
            with self.subTest(size=size):
                self.write("a.glsl", "#iSize %dx%d\n" % size + COUNTER)
                self.export("a.glsl")
                self.open("paused")
                width, height = json.loads(self.browser.evaluate(
                    "(box => JSON.stringify([box.width, box.height]))(document.querySelector('canvas').getBoundingClientRect())"))
                self.assertAlmostEqual(width / height, size[0] / size[1], delta=0.01)
        self.open("paused&size=50x50")
        self.assertEqual((len(self.shown()[0]) // 3, len(self.shown())), (50, 50))

    def test_a_drag_sets_iMouse(self):
        self.write("mouse.glsl", MOUSE)
        self.export("mouse.glsl")
        self.open("size=64x36&paused")
        self.wait_for_pixel((0, 0, 0))
        self.browser.mouse("mousePressed", *self.place(0.25, 0.5), button="left", buttons=1, clickCount=1)
        self.wait_for_pixel((round(255 * 16 / 64), round(255 * 18 / 36), 255))
        self.browser.mouse("mouseMoved", *self.place(0.501, 0.751), button="left", buttons=1)
        self.wait_for_pixel((round(255 * 32 / 64), round(255 * 27 / 36), 255))
        self.browser.mouse("mouseReleased", *self.place(0.501, 0.751), button="left", buttons=0)
        self.wait_for_pixel((round(255 * 32 / 64), round(255 * 27 / 36), 0))

    def test_the_mouse_of_another_hosts_text_follows_the_pointer(self):
        self.write("mouse.glsl", "uniform vec2 u_mouse;\nuniform vec2 u_resolution;\n"
                   "void main() { gl_FragColor = vec4(u_mouse / u_resolution, 0.0, 1.0); }\n")
        self.export("mouse.glsl")
        self.open("size=64x36&paused")
        self.wait_for_pixel((0, 0, 0))
        self.browser.mouse("mouseMoved", *self.place(0.501, 0.751))
        self.wait_for_pixel((round(255 * 32 / 64), round(255 * 27 / 36), 0))
        self.write("mouse.glsl", MOUSE)  # of ShaderToy: only with a button
        self.export("mouse.glsl")
        self.open("size=64x36&paused")
        self.browser.mouse("mouseMoved", *self.place(0.501, 0.751))
        self.assertEqual(self.browser.evaluate(f"{FIGURE}.mouse.position"), [0, 0])
        self.browser.mouse("mousePressed", *self.place(0.25, 0.5), button="left", buttons=1, clickCount=1)
        self.wait_for_pixel((round(255 * 16 / 64), round(255 * 18 / 36), 255))

    def test_a_drag_rotates_the_camera(self):
        self.write("orbit.glsl", "uniform mat4 iCamera;\nvoid mainImage(out vec4 c, in vec2 p) "
                   "{ c = vec4(0.5 + 0.5 * normalize(iCamera[3].xyz), 1.0); }\n")
        self.export("orbit.glsl")
        self.assert_same("orbit.glsl", "frame=0&size=64x36", "--size", "64x36")
        before = self.pixel()
        self.browser.mouse("mousePressed", *self.place(0.5, 0.5), button="left", buttons=1, clickCount=1)
        self.browser.mouse("mouseMoved", *self.place(0.9, 0.5), button="left", buttons=1)
        camera = self.browser.wait_for(f"{FIGURE}.needsFrame ? null : (({{azimuth, elevation, distance}}) => "
                                       f"[azimuth, elevation, distance].join())({FIGURE}.camera)")
        self.assertNotEqual(self.pixel(), before)
        self.captured("orbit.glsl", "--size", "64x36", "--camera", camera)
        self.assertEqual(self.pixel(), png.read(self.folder / "ours.png").pixel(0, 0))
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", key="r", code="KeyR", windowsVirtualKeyCode=82)
        self.wait_for_pixel(before)

    def test_beats(self):
        self.write("beat.glsl", "uniform float iBeat;\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(fract(iBeat), iBeat / 8.0, 0.0, 1.0); }\n")
        self.export("beat.glsl")
        self.assert_same("beat.glsl", "time=1.3&size=8x4", "--time", "1.3", "--size", "8x4")
        self.export("beat.glsl", "--bpm", "90")
        self.assert_same("beat.glsl", "time=1.3&size=8x4", "--time", "1.3", "--size", "8x4", "--bpm", "90")

    def test_a_drag_moves_a_scene_with_its_own_camera(self):
        self.write("own.glsl", "uniform vec4 iOrbit;\nuniform vec3 iOrbitPan;\nvoid mainImage(out vec4 c, in vec2 p) "
                   "{ c = vec4(0.5 + 0.1 * (p.x < 32.0 ? iOrbit.xyz : iOrbitPan), 1.0); }\n")
        self.export("own.glsl")
        self.assert_same("own.glsl", "frame=0&size=64x36", "--size", "64x36")
        before = self.shown()
        for button, buttons in (("left", 1), ("middle", 4)):
            self.browser.mouse("mousePressed", *self.place(0.5, 0.5), button=button, buttons=buttons, clickCount=1)
            self.browser.mouse("mouseMoved", *self.place(0.9, 0.2), button=button, buttons=buttons)
            self.browser.mouse("mouseReleased", *self.place(0.9, 0.2), button=button, buttons=0)
        camera = self.browser.wait_for(f"{FIGURE}.needsFrame ? null : (({{azimuth, elevation, distance, target}}) => "
                                       f"[azimuth, elevation, distance, ...target].join())({FIGURE}.camera)")
        self.assertNotEqual(self.shown(), before)
        self.assertEqual(self.captured("own.glsl", "--size", "64x36", "--camera", camera), self.shown())

    def test_a_key(self):
        self.write("keys.glsl", "#iChannel0 \"keyboard\"\nvoid mainImage(out vec4 c, in vec2 p) "
                   "{ c = vec4(texelFetch(iChannel0, ivec2(65, 0), 0).r, texelFetch(iChannel0, ivec2(65, 2), 0).r, 0, 1); }\n")
        self.export("keys.glsl")
        self.open("size=64x36&paused")
        self.browser.evaluate("document.querySelector('canvas').focus()")
        key = {"key": "a", "code": "KeyA", "windowsVirtualKeyCode": 65}
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", **key)
        self.wait_for_pixel((255, 255, 0))
        self.browser.call("Input.dispatchKeyEvent", type="keyUp", **key)
        self.wait_for_pixel((0, 255, 0))

    def test_knobs(self):
        self.write("knobs.glsl", "#iUniform float height = 0.2 in { 0.0, 1.0 } step 0.2\n"
                   "#iUniform int on = 0 in { 0, 1 } step 1\n#iUniform color3 deep = color3(0.0, 0.0, 0.4)\n"
                   "void mainImage(out vec4 c, in vec2 p) { c = vec4(height, on, deep.b, 1.0); }\n")
        self.export("knobs.glsl", "--set", "height=0.4")
        self.open("size=64x36&paused")
        self.wait_for_pixel((102, 0, 102))
        turn = "(knob => { %s; knob.dispatchEvent(new Event('input')); knob.dispatchEvent(new Event('change')); })" \
               "(document.querySelector('[aria-label=%s]'))"
        for change, name, wanted in (("knob.value = 0.6", "height", (153, 0, 102)), ("knob.checked = true", "on", (153, 255, 102)),
                                     ("knob.value = '#0000ff'", "deep", (153, 255, 255))):
            self.browser.evaluate(turn % (change, name))
            self.wait_for_pixel(wanted)

    def test_own_uniforms_have_their_defaults(self):
        self.write("own.glsl", "uniform float amount;\nuniform vec3 tint = vec3(0.5, 1, 0.25);\n"
                               "void mainImage(out vec4 c, in vec2 p) { c = vec4(amount + tint, 1.0); }\n")
        self.export("own.glsl", "--set", "amount=0.25")
        self.open("size=64x36&paused")
        self.assertEqual(self.shown()[0][:3], bytes((191, 255, 128)))

    def test_pause_and_time(self):
        self.write("time.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(iTime / 100.0, 0, 0, 1); }\n")
        self.export("time.glsl")
        self.open("size=64x36")
        self.browser.wait_for(f"{FIGURE}.clock.frame > 5")
        self.browser.evaluate("document.querySelector('[title=Pause]').click()")
        self.browser.wait_for(f"!{FIGURE}.needsFrame && document.querySelector('[title=Play]') !== null")
        frame = self.browser.evaluate(f"{FIGURE}.clock.frame")
        # Frames of the browser go by, none of the scene.
        self.browser.evaluate("new Promise(done => { let n = 0; const next = () => ++n < 9 ? requestAnimationFrame(next) : done(); next(); })")
        self.assertEqual(self.browser.evaluate(f"{FIGURE}.clock.frame"), frame)
        self.browser.evaluate("(bar => { bar.value = 8; bar.dispatchEvent(new Event('input')); })(document.querySelector('.tidemark-time'))")
        self.wait_for_pixel((round(255 * 0.08), 0, 0))

    def test_the_sound_pass(self):
        for name in ("sound_packing", "sound_knows_sizes_without_a_sample", "sound_reads_what_is_there_without_frames"):
            case = CASES / name
            self.export(str(case))
            self.open("paused")
            for first, left, right in json.loads((case / "expected.json").read_text())["sound"]:
                row = first - first % 512
                got = self.browser.evaluate(f"(f => {{ const s = f.player.pass.draw({row}, {{mouse: f.mouse, camera: f.camera,"
                                            f" time: 0, date: [0, 0, 0, 0], knobs: []}}); const i = 2 * ({first} - {row});"
                                            f" return [s[i], s[i + 1]]; }})({FIGURE})")
                self.assertEqual(got, [left, right], (name, first))

    def test_the_sound_plays_without_gaps(self):
        self.write("tone/image.glsl", MOUSE)
        self.write("tone/sound.glsl", "vec2 mainSound(int samp, float time) { return vec2(fract(time), 0.0); }\n")
        self.export("tone")
        self.open("size=64x36")
        self.browser.evaluate("""window.heard = []; const start = AudioBufferSourceNode.prototype.start;
            AudioBufferSourceNode.prototype.start = function(at, offset) {
                heard.push({at, offset, length: this.buffer.duration, first: this.buffer.getChannelData(0)[0]});
                return start.call(this, at, offset);
            }; 0""")
        x, y, width, height = self.browser.evaluate("(({left, top, width, height}) => [left, top, width, height])"
                                                    "(document.querySelector('[title=\"Sound on\"]').getBoundingClientRect())")
        for kind, buttons in (("mousePressed", 1), ("mouseReleased", 0)):
            self.browser.mouse(kind, x + width / 2, y + height / 2, button="left", buttons=buttons, clickCount=1)
        heard = self.browser.wait_for("heard.length >= 3 && heard.slice(0, 3)")
        for one, next_one in zip(heard[1:], heard[2:]):
            self.assertAlmostEqual(one["at"] - one["offset"] + one["length"], next_one["at"] - next_one["offset"], 4)
            self.assertAlmostEqual((one["first"] + one["length"]) % 1, next_one["first"], 3)

    def test_errors_have_the_authors_line(self):
        self.write("lib.glsl", "float one() { return 1.0; }\n")
        self.write("wrong.glsl", "#include \"lib.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) {\n    c = vec4(two());\n}\n")
        self.export("wrong.glsl")
        self.open("size=64x36", state="failed")
        self.assertEqual(self.message().split("\n")[:2], ["Image does not compile in this browser:",
                                                          "wrong.glsl:3: error: 'two' : no matching overloaded function found"])

    def test_draws_without_broken_inputs(self):
        self.write("s/image.glsl", '#iChannel0 "song.wav"\n'
                   "void mainImage(out vec4 c, in vec2 p) { c = vec4(0, 1, texelFetch(iChannel0, ivec2(0, 1), 0).r, 1); }\n")
        self.write("s/song.wav", "no sound")
        self.write("s/sound.glsl", "vec2 mainSound(int samp, float time) { return vec2(none); }\n")
        self.export("s")
        self.open("size=64x36&time=0&paused", remark="this browser cannot play the scene's sound file\n"
                  "Sound does not compile in this browser:\ns/sound.glsl:1: error: 'none' : undeclared identifier")
        self.wait_for_pixel((0, 255, 127))

    def test_a_moment_beyond_all_frame_numbers_does_not_hang(self):
        self.write("late.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(iTime > 1e6 ? 1.0 : 0.0, 0.5, 0.0, 1.0); }\n")
        self.export("late.glsl")
        self.open("size=64x36&time=1e15&paused")
        self.wait_for_pixel((255, 128, 0))

    def test_makes_no_network_requests(self):
        self.write("noise.glsl", "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p / 64.0); }\n")
        self.export("noise.glsl")
        self.open("size=64x36&paused")
        asked = [address for address in self.browser.requests if not address.startswith(("blob:", "data:"))]
        self.assertEqual(asked, [f"file://{self.folder}/page.html"])
        page = (self.folder / "page.html").read_text()
        self.assertIn("default-src 'none'", page)
        self.assertFalse(re.findall(r"https?:|(?:src|href)=\"|@import", page))

    def test_two_fragments_on_one_page(self):
        self.write("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1, 0, 0, 1); } // </script>\n")
        self.write("b.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0, 1, 0, 1); }\n")
        parts = [self.succeed("export", scene, "--html", "-", "--embed").stdout.decode() for scene in ("a.glsl", "b.glsl")]
        self.assertNotIn("<html", parts[0])
        self.write("page.html", "<!doctype html><title>mine</title>" + "<p>text</p>".join(parts))
        self.browser.open(f"file://{self.folder}/page.html")
        script = "JSON.stringify([...document.querySelectorAll('.tidemark')].map(div => { if (div.dataset.state !== 'running' || " \
                 "div.tidemark.clock.frame < 1) return null; const gl = div.tidemark.renderer.gl, p = new Uint8Array(4); " \
                 "gl.bindFramebuffer(gl.FRAMEBUFFER, null); gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, p); return [...p]; }))"
        self.browser.wait_for(f"{script} === '[[255,0,0,255],[0,255,0,255]]'")


class Messages(ProgramTest):
    def test_option_errors_of_the_command(self):
        self.write("a.glsl", MOUSE)
        for words, message in ((["--embed"], "--embed needs --html FILE"), (["--media", "."], "--media needs --html FILE"),
                               (["--bpm", "90"], "--bpm needs --html FILE"),
                               (["--html", "-", "--json"], "--json and --html - both write to standard output: give one of them")):
            self.expect_failure(["export", "a.glsl", *words], 2, f"tidemark: error: {message}")
        self.assertEqual(self.succeed("export", "a.glsl", "--html", "a.html").stderr, "wrote a.html\n")
        self.assertTrue((self.folder / "a.html").read_text().startswith("<!doctype html>"))

    def test_missing_texture(self):
        self.write("a.glsl", "#iChannel0 \"none.png\"\nvoid mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p); }\n")
        done = self.run_program("export", "a.glsl", "--html", "a.html")
        self.assertEqual(done.returncode, 3)
        self.assertIn("a.glsl:1", done.stderr)
        self.assertFalse((self.folder / "a.html").exists())


if __name__ == "__main__":
    if not browser.program():
        print("skipped: chromium is not installed")
        sys.exit(SKIPPED)
    main()
