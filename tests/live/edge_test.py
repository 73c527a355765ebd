"""The window and texts that crash the driver, eat the memory or keep it for good: the last good picture goes on."""
import pathlib

from support.live import LiveTest, main, wait_for
from support.program import let_it_crash

GOOD = "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(iTime), 0.0, 0.0, 1.0); }\n"
MAIN = "void mainImage(out vec4 c, in vec2 p) { %s }\n"
CRASH = MAIN % ("float x = p.x; c = vec4(" + " + ".join(f"x * {i}.0" for i in range(20000)) + ");")
EATS = ("#define A0 x\n" + "".join(f"#define A{i} A{i - 1} + A{i - 1}\n" for i in range(1, 41))
        + MAIN % "float x = p.x; c = vec4(A40);")


def running_below(process: int) -> list[int]:
    found = []
    for file in pathlib.Path(f"/proc/{process}/task").glob("*/children"):
        for child in map(int, file.read_text().split()):
            found += [child, *running_below(child)]
    return found


def gone(process: int) -> bool:
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


class Edge(LiveTest):
    def start(self, text: str = GOOD, **options):
        self.write("wave.glsl", text)
        return self.view("wave.glsl", "--size", "64x64", "--memory", "700M", **options)

    def expect_refused_and_mended(self, view, text: str, words: str) -> None:
        self.write("wave.glsl", text)
        view.wait_for_words(words)
        view.wait_for_title(words)
        self.write("wave.glsl", GOOD.replace("0.0, 0.0", "0.5, 0.5"))
        view.wait_for_words("compiles again")
        view.wait_for_title(" fps$")

    def test_driver_crash_and_exceeded_memory_are_shown_as_errors(self):
        view = self.start()
        self.expect_refused_and_mended(view, CRASH, r"the driver crashed \(SIG[A-Z]+\) compiling Image of 'wave\.glsl'")
        self.expect_refused_and_mended(view, MAIN % "const int x = (-2147483647 - 1) / -1; c = vec4(x);",
                                       r"the driver crashed \(SIGFPE\) compiling Image of 'wave\.glsl'")
        self.expect_refused_and_mended(view, EATS, r"compiling Image of 'wave\.glsl' takes more than 700 MiB of memory")

    def test_sound_that_exceeds_the_memory_is_an_error(self):
        self.write("folder/image.glsl", GOOD)
        self.write("folder/sound.glsl", "vec2 mainSound(int s, float t) { return vec2(0); }\n")
        view = self.view("folder", "--size", "64x64", "--memory", "700M")
        self.write("folder/sound.glsl", EATS.replace(MAIN.split("(")[0], "vec2 mainSound").replace(
            "(out vec4 c, in vec2 p)", "(int s, float t)").replace("p.x", "t").replace("c = vec4(A40);", "return vec2(A40);"))
        view.wait_for_words(r"compiling Sound of 'folder' takes more than 700 MiB of memory")
        view.wait_for_title(r"takes more than 700 MiB")

    def test_a_save_ends_the_trial_compilation(self):
        view = self.start()
        self.write("wave.glsl", "".join(f"float f{i}(float x) {{ return x + {i}.0; }}\n" for i in range(9000))
                   + MAIN % "c = vec4(f8999(p.x));")
        view.wait_for_title("compiling")
        self.write("wave.glsl", GOOD)
        view.wait_for_title(" fps$")
        wait_for(lambda: len(running_below(view.program.pid)) == 1, "the end of the try")

    def test_helpers_end_with_the_window(self):
        view = self.start()
        below = running_below(view.program.pid)
        self.assertEqual(len(below), 1)
        view.program.kill()
        view.program.wait()
        wait_for(lambda: all(map(gone, below)), "the end of its helpers")


if __name__ == "__main__":
    let_it_crash()
    main()
