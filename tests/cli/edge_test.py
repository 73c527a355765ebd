"""A driver at the edge: texts that crash it, eat the memory or never end; a signal and a kill on the way."""
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import time

from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, has_mesa_22, let_it_crash, main

MAIN = "void mainImage(out vec4 c, in vec2 p) { %s }\n"
PLAIN = MAIN % "c = vec4(p.x / 640.0, 0.0, 0.0, 1.0);"
ENDLESS = MAIN % ("float s = 0.0; for (int i = 0; i < 2000000000; ++i) for (int j = 0; j < 2000000000; ++j) "
                  "s += fract(sin(p.x + float(i ^ j))); c = vec4(s);")
MEMORY = "700M"


def sum_of(terms: int) -> str:
    """Deep enough for the driver's recursions to leave their stack."""
    return MAIN % ("float x = p.x; c = vec4(" + " + ".join(f"x * {i}.0" for i in range(terms)) + ");")


def doubling_macros(count: int) -> str:
    lines = ["#define A0 x"] + [f"#define A{i} A{i - 1} + A{i - 1}" for i in range(1, count + 1)]
    return "\n".join(lines) + "\n" + MAIN % f"float x = p.x; c = vec4(A{count});"


def doubling_functions(count: int) -> str:
    lines = ["float f0(float x) { return sin(x) + x; }"]
    lines += [f"float f{i}(float x) {{ return f{i - 1}(x) + f{i - 1}(x + 1.0); }}" for i in range(1, count + 1)]
    return "\n".join(lines) + "\n" + MAIN % f"c = vec4(f{count}(p.x));"


MEMORY_EATERS = {
    "macros": doubling_macros(40),
    "functions": doubling_functions(25),
    "local": MAIN % "float a[100000000]; a[int(p.x)] = 1.0; c = vec4(a[int(p.y)]);",
    "global": "float a[2147483647];\n" + MAIN % "a[int(p.x)] = 1.0; c = vec4(a[int(p.y)]);",
    "two": "vec4 a[1000][1000][100];\n" + MAIN % "a[int(p.x)][3][1] = p.xyxy; c = a[int(p.y)][3][1];",
    "structures": "struct A { float x[1000]; }; struct B { A a[1000]; }; struct C { B b[100]; };\n"
                  + MAIN % "C s; s.b[0].a[int(p.x)].x[0] = 1.0; c = vec4(s.b[0].a[int(p.y)].x[3]);",
}


def gone(process: int) -> bool:
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def children(process: int) -> list[int]:
    """Of that process, and of them, as far down as they go."""
    found = []
    for file in pathlib.Path(f"/proc/{process}/task").glob("*/children"):
        for child in map(int, file.read_text().split()):
            found += [child, *children(child)]
    return found


class Crash(ProgramTest):
    def setUp(self):
        super().setUp()
        if not has_mesa_22():
            self.skipTest("this driver compiles the sum")

    def test_is_reported_with_the_driver_call(self):
        self.write("sum.glsl", sum_of(20000))
        for command in (["capture", "sum.glsl"], ["inspect", "sum.glsl"]):
            self.expect_failure_like(
                command, 3,
                r"tidemark: error: the driver crashed \(SIG[A-Z]+\) compiling Image of 'sum\.glsl'")

    def test_message_names_the_pass(self):
        self.write("folder/image.glsl", '#iChannel0 "buffer_a.glsl"\n' + MAIN % "c = texelFetch(iChannel0, ivec2(p), 0);")
        self.write("folder/buffer_a.glsl", sum_of(20000))
        done = self.run_program("capture", "folder")
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr, r"\Atidemark: error: the driver crashed \(SIG[A-Z]+\) compiling Buffer A of 'folder'\n\Z")


class Memory(ProgramTest):
    def test_exceeded_memory_ends_the_command(self):
        for name, text in MEMORY_EATERS.items():
            with self.subTest(name):
                self.write(f"{name}.glsl", text)
                self.expect_failure_like(
                    ["capture", f"{name}.glsl", "--size", "16x16", "--memory", MEMORY], 5,
                    rf"tidemark: error: (compiling Image|preparing the first frame|drawing a frame) of "
                    rf"'{name}\.glsl' takes more than 700 MiB of memory \(--memory\)( \(in frame 0\))?")

    def test_limits_every_command_that_draws(self):
        self.write("macros.glsl", "#iUniform float k = 1.0 in { 0.0, 2.0 }\n" + doubling_macros(40))
        for command in (["inspect", "macros.glsl"], ["study", "macros.glsl", "--vary", "k=1,2"]):
            with self.subTest(command[0]):
                done = self.run_program(*command, "--memory", MEMORY)
                self.assertEqual(done.returncode, 5, done.stderr)
                self.assertRegex(done.stderr, r"takes more than 700 MiB of memory \(--memory\)\n\Z")

    def test_compare_goes_on_with_the_next_scene(self):
        """A device may take three quarters of the limit, and the scene after it is drawn."""
        self.write("macros.glsl", doubling_macros(40))
        self.write("plain.glsl", PLAIN)
        done = self.run_program("compare", "--devices", "surfaceless,mesa:llvmpipe", "macros.glsl", "plain.glsl",
                                "--size", "16x16", "--memory", MEMORY, "--json")
        self.assertEqual(done.returncode, 1, done.stderr)
        macros, plain = json.loads(done.stdout)["scenes"]
        self.assertEqual((macros["verdict"], plain["verdict"]), ("neither", "same"))
        self.assertEqual(macros["problems"]["surfaceless"], "it takes more than 525 MiB of memory")

    def test_sufficient_memory_prints_no_message(self):
        self.write("plain.glsl", PLAIN)
        done = self.succeed("capture", "plain.glsl", "--memory", "50%")
        self.assertEqual(done.stderr, "wrote plain.png\n")

    def test_invalid_sizes(self):
        self.write("plain.glsl", PLAIN)
        self.expect_error(["capture", "plain.glsl", "--memory", "much"], 2, "--memory much")


class Timeout(ProgramTest):
    def test_while_compiling(self):
        self.write("switch.glsl", MAIN % ("c = vec4(0.0); switch (int(p.x)) { "
                                          + "".join(f"case {i}: c.x = {i}.0; break; " for i in range(30000)) + "}"))
        for command in ("capture", "inspect"):
            with self.subTest(command):
                self.expect_failure_like([command, "switch.glsl", "--timeout", "1"], 5,
                                         r"tidemark: error: (stopped compiling after 1(\.\d+)? s|compiling Image of "
                                         r"'switch\.glsl' takes more than 1 s) \(--timeout\)")

    def test_during_an_endless_first_draw(self):
        self.write("endless.glsl", ENDLESS)
        self.expect_failure_like(["capture", "endless.glsl", "--timeout", "2"], 5,
                                 r"tidemark: error: stopped drawing frame 0 after 2(\.\d+)? s \(--timeout\)")

    def test_covers_the_frames_before_the_captured_frame(self):
        self.write("feedback.glsl", '#iChannel0 "self"\n' + MAIN % "c = texelFetch(iChannel0, ivec2(p), 0) + 0.001;")
        self.expect_failure_like(["capture", "feedback.glsl", "--size", "8x8", "--frame", "100000000", "--timeout", "4"], 5,
                                 r"(\d+/100000000 frames stepped, .* a second, \d+ s left\n)*"
                                 r"tidemark: error: stopped drawing frame [1-9]\d* after 4(\.\d+)? s \(--timeout\)")


class LastFrames(ProgramTest):
    """The largest numbers there are: nothing goes round, nothing is stepped that need not be."""

    def test_a_scene_without_feedback_jumps(self):
        self.write("last.glsl", MAIN % "c = vec4(iFrame == 100000000 ? 1.0 : 0.0);")
        for option in (["--frame", "100000000"], ["--frames", "100000000"], ["--frames", "99999999-100000000"],
                       ["--time", "1e30"]):
            with self.subTest(option):
                self.succeed("capture", "last.glsl", "--size", "4x4", "-o", "o%09d.png" if "-" in option[1][1:] else "o.png",
                             *option)
        self.assertEqual(self.files(), {"last.glsl", "o.png", "o099999999.png", "o100000000.png"})

    def test_traced(self):
        self.write("last.glsl", MAIN % "c = vec4(iFrame == 100000000 ? sqrt(-1.0 - p.x) : 0.0);")
        done = self.run_program("check", "--trace", "last.glsl", "--size", "4x4", "--frame", "100000000")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(b"frame 100000000", done.stdout)


class DriverStart(ProgramTest):
    """A library of another vendor's, found by libEGL, that crashes or hangs where it is asked to start."""

    def vendor(self, statement: str) -> dict[str, str]:
        if not shutil.which("cc"):
            self.skipTest("needs a C compiler")
        self.write("vendor.c", "#include <stdlib.h>\n#include <unistd.h>\n"
                               f"int __egl_Main(void) {{ {statement} return 0; }}\n")
        subprocess.run(["cc", "-shared", "-fPIC", "vendor.c", "-o", "vendor.so"], cwd=self.folder, check=True)
        self.write("vendor.json", json.dumps({"file_format_version": "1.0.0",
                                              "ICD": {"library_path": str(self.folder / "vendor.so")}}))
        return environment(__EGL_VENDOR_LIBRARY_FILENAMES=str(self.folder / "vendor.json"))

    def test_a_crash_is_reported(self):
        env = self.vendor("abort();")
        self.write("plain.glsl", PLAIN)
        self.expect_failure_like(["capture", "plain.glsl"], 77,
                                 r"tidemark: error: the driver crashed \(SIGABRT\) starting OpenGL.*", env=env)
        self.expect_failure_like(["inspect", "--devices"], 77,
                                 r"tidemark: error: listing OpenGL's devices: the driver crashed \(SIGABRT\) starting "
                                 r"OpenGL.*", env=env)

    def test_a_hanging_driver_is_stopped(self):
        env = self.vendor("for (;;) pause();")
        self.write("plain.glsl", PLAIN)
        self.expect_failure_like(["inspect", "plain.glsl", "--timeout", "1"], 5,
                                 r"tidemark: error: starting OpenGL.* takes more than 1 s \(--timeout\)", env=env)


class FullDisk(ProgramTest):
    """Of the driver's own cache, whose files it maps into memory."""

    def mount(self, size: str) -> pathlib.Path:
        folder = self.folder / "cache"
        folder.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)],
                          stderr=subprocess.DEVNULL).returncode:
            self.skipTest("needs the right to mount")
        self.addCleanup(subprocess.run, ["umount", "-l", str(folder)])
        return folder

    def capture(self, **variables: str) -> None:
        done = self.succeed("capture", "plain.glsl", "-o", "o.png", env=environment(**variables))
        self.assertEqual(done.stderr, "wrote o.png\n")
        (self.folder / "o.png").unlink()

    def test_does_not_stop_the_driver(self):
        self.write("plain.glsl", PLAIN)
        folder = str(self.mount("8k"))
        self.capture(MESA_SHADER_CACHE_DIR=folder)
        self.capture(XDG_CACHE_HOME=folder)
        self.capture(HOME=folder, XDG_CACHE_HOME=None)
        self.assertEqual(self.succeed("inspect", "plain.glsl", env=environment(TMPDIR=folder)).stderr, "")

    def test_the_disk_cache_is_used_with_enough_space(self):
        self.write("plain.glsl", PLAIN)
        folder = self.mount("16m")
        self.capture(MESA_SHADER_CACHE_DIR=str(folder))
        self.assertTrue([name for name in self.files() if name.startswith("cache/mesa_shader_cache")])

    def test_missing_home_folder(self):
        self.write("plain.glsl", PLAIN)
        self.capture(HOME=None, XDG_CACHE_HOME=None)
        self.capture(HOME="/nowhere", XDG_CACHE_HOME=None)
        self.capture(HOME="/proc", XDG_CACHE_HOME=None)

    def test_a_limit_of_the_size_of_files(self):
        self.write("plain.glsl", PLAIN)
        self.mount("16m")
        for size in (4096, 1 << 20, 3 << 20):
            with self.subTest(size):
                self.succeed("capture", "plain.glsl", "-o", "-", "--size", "8x8",
                             env=environment(MESA_SHADER_CACHE_DIR=str(self.folder / "cache")),
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))


class Supervised(ProgramTest):
    """A command and the process that watches it."""

    def start(self, *arguments: str) -> subprocess.Popen:
        running = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, env=environment(),
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(running.stderr.close)
        self.addCleanup(running.kill)
        return running

    def wait_for(self, condition):
        deadline = time.monotonic() + TIME_LIMIT
        while not (found := condition()):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        return found

    def start_endless(self) -> tuple[subprocess.Popen, list[int]]:
        """A frame that takes for ever, and the processes that draw it."""
        self.write("endless.glsl", ENDLESS)
        running = self.start("capture", "endless.glsl")
        below = self.wait_for(lambda: children(running.pid))
        return running, below

    def test_no_child_outlives_a_kill(self):
        running, below = self.start_endless()
        running.kill()
        running.wait(timeout=TIME_LIMIT)
        self.wait_for(lambda: all(gone(child) for child in below))

    def test_second_ctrl_c_ends_at_once(self):
        running, below = self.start_endless()
        def stopped():  # the first may come before anybody listens
            running.send_signal(signal.SIGINT)
            time.sleep(0.1)
            return running.poll() is not None
        self.wait_for(stopped)
        self.assertIn(running.returncode, (130, -signal.SIGINT))
        self.wait_for(lambda: all(gone(child) for child in below))

    def test_ctrl_c_at_a_terminal_counts_once(self):
        """The whole foreground group gets it: the frame in hand is finished all the same."""
        self.write("plain.glsl", PLAIN)
        running = subprocess.Popen([PROGRAM, "capture", "plain.glsl", "--size", "64x64", "--frames", "0-9999999"],
                                   cwd=self.folder, env=environment(), stderr=subprocess.PIPE, text=True,
                                   start_new_session=True)
        self.addCleanup(running.stderr.close)
        self.addCleanup(running.kill)
        self.wait_for(lambda: (self.folder / "plain.0002.png").exists())
        os.killpg(running.pid, signal.SIGINT)
        _, stderr = running.communicate(timeout=TIME_LIMIT)
        self.assertEqual(running.returncode, 130)
        self.assertRegex(stderr, r"interrupted after (\d+) of 10000000 frames; \1 frames are complete; .*\n\Z")

    def test_signals_end_the_command(self):
        running, below = self.start_endless()
        running.send_signal(signal.SIGQUIT)
        running.wait(timeout=TIME_LIMIT)
        self.assertEqual(running.returncode, -signal.SIGQUIT)
        self.wait_for(lambda: all(gone(child) for child in below))



if __name__ == "__main__":
    let_it_crash()
    main()
