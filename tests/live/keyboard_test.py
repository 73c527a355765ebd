"""The keyboard in the window: ShaderToy's keyboard channel, and `#iKeyboard` of the VS Code extension."""
from support import probe
from support.live import LiveTest, main

SIZE = ("--size", "200x100")


class Keyboard(LiveTest):
    def test_i_keyboard(self):
        self.follow_the_key_a({"down": "float(isKeyDown(Key_A))", "toggled": "float(isKeyToggled(Key_A))"},
                              "#iKeyboard")

    def test_keyboard_channel(self):
        self.follow_the_key_a({"down": "texelFetch(iChannel1, ivec2(65, 0), 0).r",
                               "toggled": "texelFetch(iChannel1, ivec2(65, 2), 0).r"}, '#iChannel1 "keyboard"')

    def follow_the_key_a(self, values: dict[str, str], directive: str) -> None:
        self.write("keys.glsl", probe.shader(values, directive))
        view = self.view("keys.glsl", *SIZE)
        view.save_key = "ctrl+s"  # a bare key is the scene's

        def expect(down: float, toggled: float) -> None:
            view.wait_until_told(values, lambda told: list(told.values()) == [down, toggled])

        expect(0, 0)
        self.screen.xdotool("keydown", "a")
        expect(1, 1)
        self.screen.xdotool("keyup", "a")
        expect(0, 1)
        self.screen.xdotool("keydown", "a")
        expect(1, 0)
        self.screen.xdotool("keyup", "a")
        expect(0, 0)


if __name__ == "__main__":
    main()
