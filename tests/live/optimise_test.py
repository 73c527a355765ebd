"""A scene that moves and that nobody touches goes on by a quicker program; whoever saves it is back at the text."""
import time

from support import png, probe
from support.live import LiveTest, View, main, wait_for

SIZE = ("--size", "200x100", "--fps", "10")
SETTLED = r"^background optimisation: frames take \d+ % less time, same bytes$"

# Rotates by iTime in each step, which is most of its cost, and has a function that is never called.
MARCH = """
float unused(float x) { return UNUSED; }
float field(vec3 p) {
    for (int i = 1; i < 5; ++i) {
        float a = float(i) + p.z;
        p.xy *= mat2(cos(iTime), sin(iTime), -sin(iTime), cos(iTime))
            * exp(0.1 * sin(iTime)) * pow(2.0 + cos(iTime), 0.01) * pow(2.0 + sin(iTime), 0.01);
        p.yz *= mat2(cos(0.7 * iTime), sin(0.7 * iTime), -sin(0.7 * iTime), cos(0.7 * iTime))
            * exp2(-0.1 * cos(iTime)) * pow(2.0 - cos(iTime), 0.01) * pow(2.0 - sin(iTime), 0.01);
    }
    return length(max(abs(p) - 0.6, 0.0)) - 0.1;
}
float march(vec2 at) {
    vec3 ray = normalize(vec3((2.0 * at - iResolution.xy) / iResolution.y, -2.0));
    float t = 0.0;
    for (int i = 0; i < 64; ++i)
        t += 0.5 * field(vec3(0.0, 0.0, 4.0) + t * ray);
    return t;
}
"""


def marching(colour: str = "vec3(fract(march(at)), 0.5, 0.0)", unused: str = "x") -> str:
    return f"{MARCH.replace('UNUSED', unused)}void mainImage(out vec4 c, in vec2 at) {{ c = vec4({colour}, 1.0); }}\n"


class Optimise(LiveTest):
    def settled(self, view: View, times: int = 1) -> None:
        wait_for(lambda: view.running() and view.stderr().count("background optimisation: ") == times, f"{times} times settled",
                 patience=240)  # it rests for twenty times what compiling took
        self.assertRegex(view.stderr(), f"(?m){SETTLED}")

    def at_three_tenths(self, view: View) -> tuple[list[bytes], bytes]:
        """The screen and the picture saved at that second of iTime; the scene runs before and after."""
        view.restart_paused()
        for tenth in (1, 2, 3):
            view.key("Right")
            view.wait_for_title(rf" - paused at 0\.{tenth}00 s$")
        saved = png.read(view.save())
        place = view.place()
        rows = self.screen.rows(place["X"], place["Y"], place["WIDTH"], place["HEIGHT"])
        view.key("space")
        view.wait_for_title(" fps$")
        return rows, saved.rows

    def test_controls_restore_the_plain_program(self):
        """The quicker program has decided what the knob decides."""
        self.write("a.glsl", "#iUniform float level = 0.0 in { 0.0, 1.0 }\n" + marching().replace(
            "c = vec4(vec3", "if (level > 0.5) c = vec4(1.0); else c = vec4(vec3"))
        view = self.view("a.glsl", "--size", "200x200", "--fps", "10")
        self.settled(view)
        view.key("Tab")
        white = bytes((255, 255, 255)) # of the letters on its buttons: the scene has none
        place = view.place()
        wait_for(lambda: any(white in row for row in self.screen.rows(place["X"], place["Y"], 200, 60)), "the controls")
        view.drag((25, 112), (92, 112))
        wait_for(lambda: png.read(view.save()).pixel(190, 190)[:3] == (255, 255, 255), "what the knob asks for")

    def test_pixels_are_unchanged_and_a_resize_keeps_the_program(self):
        self.write("a.glsl", marching("vec3(fract(march(at)), iResolution.xy / 1000.0)"))
        view = self.view("a.glsl", *SIZE)
        before = self.at_three_tenths(view)
        self.assertNotIn("background optimisation", view.stderr())
        self.settled(view)
        after = self.at_three_tenths(view)
        self.assertGreater(len(set(before[0])), 1)
        self.assertTrue(after == before)
        self.screen.xdotool("windowsize", str(view.window), "240", "120")
        told = (round(0.240 * 255), round(0.120 * 255))
        wait_for(lambda: png.read(view.save()).pixel(230, 50)[1:] == told, "a picture of the other size")
        self.assertEqual(view.stderr().count("background optimisation: "), 1)

    def test_buffers_time_and_mouse_are_kept(self):
        told = {"count": "texelFetch(iChannel0, ivec2(0), 0).r", "iFrame": "float(iFrame)", "iTime": "iTime",
                "iMouse.x": "iMouse.x"}
        self.write("s/buffer_a.glsl", f"#iChannel0 \"self\"\n{MARCH.replace('UNUSED', 'x')}"
                   "void mainImage(out vec4 c, in vec2 at) {\n"
                   "    c = texelFetch(iChannel0, ivec2(0), 0) + vec4(1.0, fract(march(at)), 0.0, 0.0); }\n")
        self.write("s/image.glsl", probe.shader(told, '#iChannel0 "buffer_a.glsl"\n'))
        view = self.view("s", *SIZE)
        view.drag((100, 50), (60, 70))
        before = view.wait_until_told(told, lambda told: told["iMouse.x"] == 60)
        self.settled(view)
        after = view.told(told)
        self.assertGreater(after["iTime"], before["iTime"] + 1)
        self.assertGreater(after["count"], before["count"])
        for each in (before, after):
            self.assertEqual(each["count"], each["iFrame"] + 1)
        self.assertEqual(after["iMouse.x"], 60)

    def test_errors_of_a_save_are_those_of_the_whole_text(self):
        self.write("a.glsl", marching())
        view = self.view("a.glsl", *SIZE)
        self.settled(view)
        self.write("a.glsl", marching(unused="nothing"))
        view.wait_for_title(r"\Aa\.glsl:2(:\d+)?: error: .*nothing")
        view.wait_for_words(r"^a\.glsl:2(:\d+)?: error: .*nothing")
        self.write("a.glsl", marching("vec3(0.0, march(at) > 0.0 ? 0.4 : 0.2, 0.0)"))
        view.wait_for_words(r"^a\.glsl: compiles again$")
        wait_for(lambda: png.read(view.save()).pixel(100, 50) == (0, round(0.4 * 255), 0), "the new picture")
        self.settled(view, times=2)

    def test_input_postpones_optimisation(self):
        self.write("a.glsl", marching())
        start = time.monotonic()
        view = self.view("a.glsl", *SIZE)
        self.settled(view)
        usual = time.monotonic() - start
        view.close()
        view = self.view("a.glsl", *SIZE)
        self.addCleanup(view.button, 1, False)
        view.button(1, True)
        busy_until = time.monotonic() + 1.5 * usual
        while time.monotonic() < busy_until:
            view.point(50 + int(20 * time.monotonic()) % 100, 50)
            time.sleep(0.1)
        self.assertNotIn("background optimisation", view.stderr())
        view.button(1, False)
        self.settled(view)


class Programs(LiveTest):
    """How many programs are compiled, by what is kept of them."""

    def test_scenes_without_a_gain_or_with_plain_have_one_program(self):
        scenes = {"simple": "vec3(fract(iTime), 0.5, 0.0)", "plain": "vec3(fract(march(at)), 0.5, 0.0)",
                  "march": "vec3(fract(march(at)), 0.5, 0.0)"}
        caches = {name: self.folder / "cache" / name for name in scenes}
        for name, colour in scenes.items():
            self.write(f"{name}.glsl", marching(colour))
            view = self.view(f"{name}.glsl", *SIZE, *(["--plain"] if name == "plain" else []),
                             XDG_CACHE_HOME=str(caches[name]))
        view.wait_for_words(SETTLED)  # the others had the longer time
        programs = {name: len(list(cache.glob("tidemark/programs/*"))) for name, cache in caches.items()}
        if not any(programs.values()):
            self.skipTest("this driver hands out no programs")
        self.assertEqual((programs["simple"], programs["plain"]), (1, 1))
        self.assertGreater(programs["march"], 1)


if __name__ == "__main__":
    main()
