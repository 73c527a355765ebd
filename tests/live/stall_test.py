"""A frame that holds the window for seconds: what people do meanwhile, and how they are rid of it."""
from support import probe
from support.live import LiveTest, View, main, wait_for
from support.slow import rounds_that_take, slow_shader

SIZE = ("--size", "200x100")
VALUES = {"mark": "MARK"}
HELD_SECONDS = 4


def marked(mark: int) -> str:
    return probe.shader(VALUES, f"#define MARK {mark}.0\n")


def slow(mark: int, rounds: int) -> str:
    return slow_shader(rounds, VALUES, f"#define MARK {mark}.0\n")


class Stall(LiveTest):
    measured = 0

    def rounds(self) -> int:
        if not Stall.measured:
            Stall.measured = rounds_that_take(HELD_SECONDS, self, lambda rounds: slow(0, rounds), *SIZE)
        return Stall.measured

    def hold(self, view: View, mark: int, rounds: int) -> None:
        self.write("a.glsl", slow(mark, rounds))
        reloads = view.stderr().count("reloaded in")
        view.wait_for_words(r"(reloaded in .*\n[^$]*){%d}" % (reloads + 1))

    def quit(self, view: View) -> None:
        """An Esc right behind the one that gave up is taken for the same."""
        wait_for(lambda: view.program.poll() is not None or view.key("Escape"), "the end of the program")
        self.assertEqual(view.wait_for_end(), 0)

    def start(self) -> View:
        self.write("a.glsl", marked(1))
        view = self.view("a.glsl", *SIZE)
        view.wait_until_told(VALUES, lambda told: told["mark"] == 1)
        return view

    def test_escape_cancels_the_frames_and_then_quits(self):
        rounds = self.rounds()
        view = self.start()
        self.hold(view, 2, rounds)
        self.screen.xdotool("key", "Escape", "Escape", "Escape")
        view.wait_for_words(r"^a\.glsl: frame cancelled, (a frame takes \d+\.\d s|after \d+\.\d s, \d+ % drawn): press "
                            r"space to continue, - to draw smaller, or save a file of it; Esc twice closes the window$")
        view.wait_for_title(r"\Aa - tidemark - cancelled, space continues\Z")
        self.write("a.glsl", marked(3))
        view.wait_until_told(VALUES, lambda told: told["mark"] == 3)
        view.wait_for_title(r"\Aa - tidemark - (\d+ fps|still)\Z")
        self.hold(view, 4, rounds)
        view.key("Escape")
        view.wait_for_title(r" - cancelled, ")
        view.key("space")
        view.wait_for_title(r"\A(?!.*cancelled)")
        view.key("Escape")
        view.wait_for_words(r"(frame cancelled, (.|\n)*){3}")
        view.wait_for_title(r" - cancelled, ")
        self.quit(view)

    def test_a_fixed_text_loads_at_once_and_other_keys_work(self):
        rounds = self.rounds()
        view = self.start()
        self.hold(view, 2, rounds)
        view.key("h")
        self.write("a.glsl", marked(3))
        view.wait_until_told(VALUES, lambda told: told["mark"] == 3)
        self.assertIn("full screen", view.stderr())

    def test_escape_and_a_fixed_text_during_one_stall(self):
        rounds = self.rounds()
        view = self.start()
        self.hold(view, 2, rounds)
        view.key("Escape")
        self.write("a.glsl", marked(3))
        view.wait_until_told(VALUES, lambda told: told["mark"] == 3)
        self.quit(view)

    def test_the_close_button_closes_the_window(self):
        rounds = self.rounds()
        view = self.start()
        self.hold(view, 2, rounds)
        self.screen.ask_to_close(view.window)
        self.assertEqual(view.wait_for_end(), 0)


if __name__ == "__main__":
    main()
