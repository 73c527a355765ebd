"""Kept views: a moment is kept by a key or the panel, and a click or a key goes back to it; the file that they are in."""
import json

from support import png, probe
from support.live import main, wait_for
from support.overlay import PAUSE, OverlayTest

COUNT = '#iChannel0 "self"\nvoid mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0) + 1.0; }\n'
KNOB = "#iUniform float height = 0.5 in { 0.0, 2.0 } step 0.1"
VALUES = {"height": "height", "turns": "float(TURNS)", "mouse": "iMouse.x", "time": "iTime",
          "count": "texelFetch(iChannel0, ivec2(0), 0).r"}
SCENE = probe.shader(VALUES, f'#iChannel0 "count.glsl"\n{KNOB}\n#define TURNS 3')
# Rows of the panel: the buttons, the knob, the headers, and below the last one the button; then the views.
HEIGHT, DEFINITIONS, _PICTURES, VIEWS, KEEP = range(1, 6)
FIRST, SECOND = 0, 1
GO, NAME, FORGET = 0.1, 0.5, 0.97  # places in a view's upper row


class KeptViews(OverlayTest):
    def test_a_click_restores_a_view(self):
        self.write("count.glsl", COUNT)
        view = self.open_controls(SCENE)
        view.click_bar(PAUSE)
        view.wait_for_title(" - paused at ")
        view.drag(view.at(400, 150), view.at(420, 170))
        view.drag_row(HEIGHT, 0.3, 0.9)
        view.type_time("2")
        view.wait_until_told(VALUES, lambda told: told["height"] == 2 and told["time"] == 2)
        view.key("k")
        view.wait_for_words(r"^kept view 1: 2\.000 s, height = 2$")
        view.drag(view.at(400, 150), view.at(450, 170))
        view.drag_row(HEIGHT, 0.3, 0.01)
        view.type_time("4")
        view.wait_until_told(VALUES, lambda told: told["height"] == 0 and told["time"] == 4)
        view.click_row(VIEWS, 0.5)
        view.click_row(KEEP, 0.2)
        view.wait_for_words(r"^kept view 2: 4\.000 s, height = 0$")
        view.click_view(KEEP, FIRST, GO)
        told = view.wait_until_told(VALUES, lambda told: told["height"] == 2 and told["time"] == 2)
        self.assertEqual((told["mouse"], told["count"]), (420, 121))
        view.click_view(KEEP, SECOND, GO)
        told = view.wait_until_told(VALUES, lambda told: told["height"] == 0 and told["time"] == 4)
        self.assertEqual((told["mouse"], told["count"]), (450, 241))

    def test_definitions_are_compiled_first(self):
        self.write("count.glsl", COUNT)
        view = self.open_controls(SCENE, "--define", "TURNS=5")
        view.click_bar(PAUSE)
        view.type_time("2")
        view.wait_until_told(VALUES, lambda told: told["time"] == 2 and told["turns"] == 5)
        view.key("k")
        view.wait_for_words(r"^kept view 1: 2\.000 s$")
        view.type_time("4")
        view.wait_until_told(VALUES, lambda told: told["time"] == 4)
        view.click_row(DEFINITIONS, 0.5)
        view.click_row(DEFINITIONS + 1, 0.85)  # reset
        view.wait_until_told(VALUES, lambda told: told["turns"] == 3)
        view.click_row(DEFINITIONS, 0.5)
        view.click_row(VIEWS, 0.5)
        view.click_view(KEEP, FIRST, GO)
        told = view.wait_until_told(VALUES, lambda told: told["turns"] == 5 and told["time"] == 2)
        self.assertEqual(told["count"], 121)

    def test_a_view_is_deleted(self):
        self.write("count.glsl", COUNT)
        view = self.open_controls(SCENE, size="640x480")  # without a scroll bar
        view.click_bar(PAUSE)
        for seconds in ("2", "4"):
            view.type_time(seconds)
            view.wait_until_told(VALUES, lambda told: told["time"] == float(seconds))
            view.key("k")
            view.wait_for_words(rf"^kept view \d: {seconds}\.000 s$")
        view.click_row(VIEWS, 0.5)
        view.click_view(KEEP, FIRST, FORGET)
        view.type_time("1")
        view.wait_until_told(VALUES, lambda told: told["time"] == 1)
        view.click_view(KEEP, FIRST, GO)
        view.wait_until_told(VALUES, lambda told: told["time"] == 4)


MORPHED = {"height": "height", "camera": "iCamera[3].x", "time": "iTime", "turns": "float(TURNS)"}
MOVES = probe.shader(MORPHED, KNOB.replace(" step 0.1", "") + "\n#define TURNS 3\nuniform mat4 iCamera;")


class Presets(OverlayTest):
    """The file beside the scene, the keys, names, and the way from one view to another."""

    def setUp(self):
        super().setUp()
        self.file = self.folder / "a.presets.json"

    def start(self, *options: str, **arguments):
        if not (self.folder / "a.glsl").exists():
            self.write("a.glsl", MOVES)
        return self.open("a.glsl", "--size", "640x360", *options, **arguments)

    def presets(self) -> list[dict]:
        return json.loads(self.file.read_text())["presets"]

    def keep(self, view, **wanted: float) -> None:
        view.wait_until_told(MORPHED, lambda told: all(abs(told[name] - value) < 1e-3 for name, value in wanted.items()))
        count = len(self.presets()) if self.file.exists() else 0
        view.key("k")
        wait_for(lambda: self.file.exists() and len(self.presets()) == count + 1, "the view in the file")

    def test_presets_are_stored_beside_the_scene_and_selected_by_keys(self):
        view = self.start("--paused", "--set", "height=2", first_title=" - paused at ")
        self.keep(view, height=2)
        view.quit()
        view.wait_for_end()
        kept, = self.presets()
        self.assertEqual((kept["name"], kept["set"], kept["time"]), ("view 1", {"height": "2"}, 0))
        self.assertTrue(kept["thumbnail"].startswith("data:image/png;base64,"))
        self.write("a.presets.json", json.dumps({"tidemark_presets": 1, "note": "ours", "presets": [
            kept | {"tags": ["dawn"]}, {"name": "low", "set": {"height": 0.25}, "define": {"TURNS": "7"}, "camera": "90,0,10",
                                        "time": 1.5}]}))
        view = self.start("--paused", first_title=" - paused at ")
        view.wait_for_words(r"^2 views in a\.presets\.json: Alt\+1 to Alt\+9 go to them$")
        view.key("alt+2")
        view.wait_until_told(MORPHED, lambda told: told["height"] == 0.25 and told["turns"] == 7 and told["time"] == 1.5
                             and abs(told["camera"] - 10) < 1e-3)
        view.key("alt+1")
        view.wait_until_told(MORPHED, lambda told: told["height"] == 2 and told["turns"] == 3 and told["time"] == 0)
        self.keep(view, height=2)
        whole = json.loads(self.file.read_text())
        self.assertEqual((whole["note"], whole["presets"][0]["tags"], whole["presets"][1]["name"]), ("ours", ["dawn"], "low"))

    def test_invalid_preset_files_are_left_alone(self):
        for text in ('{"presets": 3}', "not JSON", '{"tidemark_presets": 2, "presets": []}'):
            with self.subTest(text=text):
                self.write("a.presets.json", text)
                view = self.start("--paused", first_title=" - paused at ", XDG_STATE_HOME=str(self.folder / "state"))
                view.wait_for_words("^warning: 'a.presets.json' is not a file of presets: .*; views are kept on this machine only$")
                view.key("k")
                view.wait_for_words("^kept view ")
                view.quit()
                view.wait_for_end()
                self.assertEqual(self.file.read_text(), text)
        self.file.unlink()  # now the views of these windows go into the file
        view = self.start("--paused", first_title=" - paused at ", XDG_STATE_HOME=str(self.folder / "state"))
        wait_for(lambda: self.file.exists() and self.presets(), "the file")

    def test_two_windows_add_to_one_file(self):
        first = self.start("--paused", first_title=" - paused at ")
        self.keep(first, height=0.5)
        whole = json.loads(self.file.read_text())
        self.file.write_text(json.dumps(whole | {"presets": whole["presets"] + [{"name": "other"}]}))
        self.keep(first, height=0.5)
        self.assertEqual([preset["name"] for preset in self.presets()], ["view 1", "view 2", "other"])

    def test_a_view_is_renamed_in_the_panel(self):
        view = self.open_controls(SCENE.replace('#iChannel0 "count.glsl"\n', "").replace(VALUES["count"], "0.0"))
        view.key("k")
        wait_for(self.file.exists, "the file")
        view.click_row(VIEWS, 0.5)
        view.click_view(KEEP, FIRST, NAME)
        view.key("ctrl+a")
        view.screen.xdotool("type", "dawn")
        view.key("Return")
        wait_for(lambda: self.presets()[0]["name"] == "dawn", "the new name")

    def test_a_morph_passes_between(self):
        self.write("a.presets.json", json.dumps({"tidemark_presets": 1, "presets": [
            {"name": "low", "set": {"height": "0"}, "camera": "350,0,10"},
            {"name": "high", "set": {"height": "2"}, "define": {"TURNS": "7"}, "camera": "10,0,10", "time": 99}]}))
        view = self.start("--paused", first_title=" - paused at ", XDG_STATE_HOME=str(self.folder / "state"))
        view.key("alt+1")
        first = view.wait_until_told(MORPHED, lambda told: told["height"] == 0)
        view.quit()
        view.wait_for_end()
        state, = (self.folder / "state/tidemark").iterdir()
        state.write_text(json.dumps(json.loads(state.read_text()) | {"morph": 4}))
        view = self.start(first_title=" - paused at ", XDG_STATE_HOME=str(self.folder / "state"))
        view.key("alt+2")
        between = view.wait_until_told(MORPHED, lambda told: 0.2 < told["height"] < 1.8)
        self.assertLess(abs(between["camera"]), 1.74)  # the short way, by 0
        last = view.wait_until_told(MORPHED, lambda told: told["height"] == 2 and told["turns"] == 7)
        self.assertLess(last["time"], 1)
        self.assertAlmostEqual(last["camera"], -first["camera"], 3)
        view.key("ctrl+z")
        view.wait_until_told(MORPHED, lambda told: told["height"] == 0 and abs(told["camera"] - first["camera"]) < 1e-3)

    def test_capture_and_export_take_presets(self):
        self.write("a.glsl", MOVES)
        self.write("a.presets.json", json.dumps({"tidemark_presets": 1, "presets": [
            {"name": "low", "set": {"height": "0.25"}, "define": {"TURNS": "7"}, "camera": "90,0,10", "time": 1.5}]}))
        told = lambda *options: (self.succeed("capture", "a.glsl", "-o", "x.png", *options),
                                 probe.read(png.read(self.folder / "x.png"), MORPHED))[1]
        whole = told("--preset", "low")
        self.assertAlmostEqual(whole.pop("camera"), 10, 3)
        self.assertEqual(whole, {"height": 0.25, "turns": 7, "time": 1.5})
        self.assertEqual(told("--preset", "1"), told("--preset", "low"))
        mine = told("--preset", "low", "--set", "height=1", "--time", "3")
        self.assertEqual((mine["height"], mine["turns"], mine["time"]), (1, 7, 3))
        done = self.run_program("capture", "a.glsl", "--preset", "hihg", "-o", "x.png")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'a.presets.json' has no preset 'hihg', but 'low'", done.stderr)
        self.succeed("check", "a.glsl", "--preset", "low", "--probe", "no_nan", "--budget", "20")
        done = self.run_program("capture", "--preset", "low", "-o", "x.png")
        self.assertEqual(done.returncode, 2)
        self.assertIn("name the scene, as in `tidemark capture SCENE --preset low`", done.stderr)
        self.write("b.glsl", MOVES)
        done = self.run_program("check", "b.glsl", "--preset", "low")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'b.presets.json' holds no presets: press K in the scene's window to keep one", done.stderr)


if __name__ == "__main__":
    main()
