"""`completion`: scripts that shells take and that complete commands, options, what a scene names, and files."""
import os
import pathlib
import pty
import shutil
import subprocess
import unittest

from support.program import PROGRAM, ProgramTest, environment, main

# The program by its name, as a shell finds it.
WITH_PROGRAM = environment(PATH=f"{pathlib.Path(PROGRAM).resolve().parent}:{os.environ['PATH']}")
SCENE = """#define STEPS 4
#iUniform float height = 0.5 in { 0.0, 2.0 }
#iUniform float hue = 0.5
void mainImage(out vec4 c, in vec2 p) { c = vec4(height * hue); }
"""


class Completion(ProgramTest):
    def setUp(self):
        super().setUp()
        self.script = self.write("completion.bash", self.succeed("completion").stdout)

    def completed(self, *words: str) -> set[str]:
        """What bash offers for the last of the words."""
        line = ('source completion.bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _tidemark; '
                'printf "%s\\n" "${COMPREPLY[@]}"')
        done = subprocess.run(["bash", "-uc", line, "bash", "tidemark", *words], cwd=self.folder,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=WITH_PROGRAM)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return set(done.stdout.split())

    def test_is_valid_bash(self):
        done = subprocess.run(["bash", "-n", self.script], stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_commands(self):
        self.assertEqual(self.completed("cap"), {"capture"})
        listed = self.succeed("--help").stdout.decode().partition("Subcommands:\n")[2].partition("\n\n")[0]
        commands = {line.split()[0] for line in listed.splitlines()}
        self.assertLessEqual({"capture", "bake"}, commands)
        self.assertEqual(self.completed(""), commands | {"--help", "-h", "--version", "completion.bash"})

    def test_options_of_a_command(self):
        self.assertEqual(self.completed("capture", "--fra"), {"--frame", "--frames"})
        self.assertEqual(self.completed("view", "--fra"), set())
        self.assertEqual(self.completed("inspect", "--dev"), {"--device", "--devices"})
        self.assertEqual(self.completed("bake", "n"), {"noise"})
        self.assertEqual(self.completed("bake", "--s"), set())
        self.assertEqual(self.completed("bake", "noise", "--s"), {"--seed"})
        self.assertEqual(self.completed("capture", "a.glsl", "--fra"), {"--frame", "--frames"})

    def test_unknown_shell(self):
        self.expect_error(["completion", "csh"], 2, "SHELL", "'csh'")

    def test_knobs_and_definitions_of_the_scene(self):
        self.write("wave.glsl", SCENE)
        self.assertEqual(self.completed("capture", "wave.glsl", "--set", "h"), {"height=", "hue="})
        self.assertEqual(self.completed("study", "wave.glsl", "--define", "S"), {"STEPS="})
        self.assertEqual(self.completed("capture", "none.glsl", "--set", "h"), set())
        self.write("broken.glsl", "#include \"none.glsl\"")
        self.assertEqual(self.completed("capture", "broken.glsl", "--set", "h"), set())

    def test_values(self):
        self.assertEqual(self.completed("check", "--probe", "no_"), {"no_nan"})
        self.assertEqual(self.completed("capture", "--precision", "d"), {"double"})
        self.assertEqual(self.completed("inspect", "--device", "au"), {"auto"})
        self.assertLessEqual({"auto", "surfaceless", "display", "mesa:llvmpipe"}, self.completed("capture", "--device", ""))

    def test_a_scene_without_a_command_is_viewed(self):
        self.write("wave.glsl", SCENE)
        self.assertEqual(self.completed("wave.glsl", "--set", "h"), {"height=", "hue="})
        self.assertEqual(self.completed("wave.glsl", "--se"), {"--set"})

    def test_topics(self):
        self.assertEqual(self.completed("help", "record"), {"record-and-replay"})

    def test_completion_on_an_interactive_line(self):
        """In a terminal: what readline makes of a word, its backslashes and blanks, too."""
        self.write("wave.glsl", SCENE)
        self.write("my waves.glsl", SCENE)
        for typed, becomes in (("capture wave.glsl --set heig", "capture wave.glsl --set height="),
                               ("inspect --device aut", "inspect --device auto "),
                               ("capture my", "capture my\\ waves.glsl ")):
            with self.subTest(typed):
                self.assertEqual(self.typed(typed), becomes)

    def typed(self, words: str) -> str:
        """The line behind `tidemark` after a Tab, as bash has it in its history."""
        shell, terminal = pty.openpty()
        process = subprocess.Popen(["bash", "--norc", "--noprofile", "-i"], cwd=self.folder, stdin=terminal, stdout=terminal,
                                   stderr=terminal, env=WITH_PROGRAM | {"PS1": "ready> ", "TERM": "dumb"}, start_new_session=True)
        os.close(terminal)
        # With `:` before it the line does nothing; then the history says what it was.
        os.write(shell, b"source completion.bash; bind 'set enable-bracketed-paste off'\r")
        os.write(shell, f"tidemark {words}\t\x01: \x05;\r".encode())
        os.write(shell, b"fc -ln -1 > line.txt; exit\r")
        try:
            while os.read(shell, 4096):
                pass
        except OSError:  # it has ended
            pass
        os.close(shell)
        process.wait(timeout=60)
        line = (self.folder / "line.txt").read_text().strip()
        return line.removeprefix(": tidemark ").removesuffix(";")

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish(self):
        self.write("wave.glsl", SCENE)
        line = ('tidemark completion fish | source; complete -C "tidemark capt"; '
                'complete -C "tidemark capture wave.glsl --set hu"')
        done = subprocess.run(["fish", "--no-config", "-c", line], cwd=self.folder, capture_output=True, text=True,
                              env=WITH_PROGRAM)
        self.assertEqual((done.stdout.split(), done.stderr), (["capture", "hue="], ""))

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh(self):
        line = ("autoload -Uz compinit; compinit -u -d dump; source <(tidemark completion zsh); print $_comps[tidemark]; "
                "compadd() { while [[ $1 != -- ]]; do shift; done; print -- ${@[2,-1]}; }; _files() {}; "
                "words=(tidemark check --probe no_); CURRENT=4; _tidemark")
        done = subprocess.run(["zsh", "-fc", line], cwd=self.folder, capture_output=True, text=True, env=WITH_PROGRAM)
        self.assertEqual((done.stdout.split(), done.stderr), (["_tidemark", "no_nan"], ""))

    def test_files(self):
        self.write("wave.glsl", "")
        self.assertEqual(self.completed("capture", "wav"), {"wave.glsl"})
        self.assertEqual(self.completed("wav"), {"wave.glsl"})


if __name__ == "__main__":
    main(needs_context=False)
