"""The rest of the window's overlay: help, definitions, pictures of passes; and that none of it is there unasked."""
from support import probe
from support.live import main, wait_for
from support.overlay import OverlayTest

TOLD = {"steps": "float(STEPS)", "gain": "GAIN", "level": "level", "time": "iTime"}
SCENE = probe.shader(TOLD, "#iUniform float level = 0.5 in { 0.0, 1.0 }\n#define STEPS 8\nconst float GAIN = 0.5;\n"
                           "#define TWICE (2 * STEPS)\n")
HEADER, STEPS, GAIN = 2, 3, 4
SIZES = (("640x360", 1), ("900x600", 1), ("500x300", 2), ("400x250", 2))
RED, GREEN = bytes((255, 0, 0)), bytes((0, 255, 0))


class Overlay(OverlayTest):
    def test_definitions_are_fields(self):
        for size, scale in SIZES:
            with self.subTest(size=size, scale=scale):
                view = self.open_controls(SCENE, size=size, scale=scale)
                view.click_row(HEADER, 0.3)
                view.drag_row(STEPS, 0.1, 0.3)
                told = view.wait_until_told(TOLD, lambda told: told["steps"] > 8)
                self.assertEqual(told["steps"], round(told["steps"]))
                view.click_row(STEPS, 0.82)  # its own reset
                view.wait_until_told(TOLD, lambda told: told["steps"] == 8)
                self.assertEqual((self.folder / "a.glsl").read_text(), SCENE)
                view.close()

    def test_a_definition_is_typed(self):
        view = self.open_controls(SCENE, "--set", "level=0.75")
        view.click_row(HEADER, 0.3)
        self.screen.xdotool("keydown", "ctrl")
        view.click_row(GAIN, 0.2)
        self.screen.xdotool("keyup", "ctrl")
        self.screen.xdotool("type", "3")
        view.key("Return")
        told = view.wait_until_told(TOLD, lambda told: told["gain"] == 3)
        self.assertEqual(told["level"], 0.75)
        self.assertGreater(told["time"], 0)

    def test_a_changed_definition_may_be_removed_from_the_file(self):
        view = self.open_controls(SCENE)
        view.click_row(HEADER, 0.3)
        view.drag_row(STEPS, 0.1, 0.3)
        view.wait_until_told(TOLD, lambda told: told["steps"] > 8)
        self.write("a.glsl", SCENE.replace("#define STEPS 8\n", "").replace("STEPS", "7"))
        view.wait_for_words("^a\\.glsl: warning: the scene has no #define or const 'STEPS': ")
        view.wait_until_told(TOLD, lambda told: told["steps"] == 7)

    def test_a_number_key_shows_a_pass(self):
        self.write("red.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0, 0.0, 0.0, 0.0); }\n")
        for size, scale in SIZES:
            with self.subTest(size=size, scale=scale):
                view = self.open_controls('#iUniform float level = 0.5 in { 0.0, 1.0 }\n#iChannel0 "red.glsl"\nvoid mainImage(out vec4 c, in vec2 p) '
                                          "{ c = texture(iChannel0, vec2(0.5)).grba + vec4(0.0, 0.0, 0.0, 1.0); }\n",
                                          size=size, scale=scale)
                place = view.place()

                def shows(colour: bytes) -> bool:
                    at = 3 * (place["WIDTH"] - 20)
                    return view.picture()[place["HEIGHT"] // 2][at:at + 3] == colour

                wait_for(lambda: shows(GREEN), "the scene")
                view.key("1")
                wait_for(lambda: shows(RED), "its buffer")
                view.key("0")
                wait_for(lambda: shows(GREEN), "the scene again")
                view.click_row(2, 0.3)  # the header of the pictures
                wait_for(lambda: any(row[at:at + 3] == RED for row in view.picture() for at in range(0, len(row), 3)),
                         "the buffer's small picture")
                view.close()

    def test_help_opens_and_closes(self):
        scene = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.0, 1.0, 0.0, 1.0); }\n"
        keyboard = '#iChannel0 "keyboard"\nvoid mainImage(out vec4 c, in vec2 p) ' \
                   "{ c = vec4(0.0, 1.0, texelFetch(iChannel0, ivec2(0), 0).r, 1.0); }\n"
        for text, key, (size, scale) in zip((scene, scene, keyboard, keyboard), ("h", "F1", "F1", "ctrl+h"), SIZES):
            with self.subTest(key=key, size=size, scale=scale):
                self.write("a.glsl", text)
                view = self.open("a.glsl", "--size", size, scale=scale)
                plain = view.picture()
                view.key(key)
                view.wait_for_change(plain)
                view.key(key)
                wait_for(lambda: view.picture() == plain, "the picture without the help")
                view.close()

    def test_opengl_es_shows_the_same_help(self):
        """Its text is a texture without mipmaps on the unit of a channel that has some. Mesa prints errors of OpenGL."""
        self.write("red.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0, 0.0, 0.0, 1.0); }\n")
        self.write("a.glsl", '#iChannel0 "red.glsl"\n#iChannel0::MinFilter "NearestMipMapNearest"\n'
                             "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p / iResolution.xy); }\n")
        helps = []
        for options in ((), ("--es",)):
            view = self.open("a.glsl", "--size", "640x360", *options, MESA_DEBUG="1")
            plain = view.picture()
            view.key("F1")
            view.wait_for_change(plain)
            helps.append(b"".join(view.picture()))
            self.assertNotIn("User error", view.stderr())
            view.close()
        self.assertLessEqual(max(abs(a - b) for a, b in zip(*helps)), 1)

    def test_a_scene_that_reads_the_keyboard_receives_tab(self):
        self.write("a.glsl", '#iChannel0 "keyboard"\nvoid mainImage(out vec4 c, in vec2 p) '
                             "{ c = vec4(texelFetch(iChannel0, ivec2(9, 2), 0).r); }\n")
        view = self.open("a.glsl", "--size", "200x100")
        view.key("Tab")
        wait_for(lambda: set(b"".join(view.picture())) == {255}, "the scene to see Tab")
        self.assertNotIn("tidemark_overlay", view.loaded())
        view.key("ctrl+Tab")
        wait_for(lambda: "tidemark_overlay" in view.loaded(), "the controls")


if __name__ == "__main__":
    main()
