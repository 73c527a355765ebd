"""`completion`: a script that bash takes and that completes commands, options and files."""
import subprocess

from support.program import ProgramTest, main


class Completion(ProgramTest):
    def setUp(self):
        super().setUp()
        self.script = self.write("completion.bash", self.succeed("completion").stdout)

    def completed(self, *words: str) -> set[str]:
        """What bash offers for the last of the words."""
        line = ('source completion.bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _tidemark; '
                'printf "%s\\n" "${COMPREPLY[@]}"')
        done = subprocess.run(["bash", "-uc", line, "bash", "tidemark", *words], cwd=self.folder,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
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
        self.assertEqual(self.completed("bake", "r"), {"ramps"})
        self.assertEqual(self.completed("bake", "--s"), set())
        self.assertEqual(self.completed("bake", "noise", "--s"), {"--seed"})
        self.assertEqual(self.completed("bake", "island", "--s"), {"--size", "--seed", "--sea", "--study"})
        self.assertEqual(self.completed("capture", "a.glsl", "--fra"), {"--frame", "--frames"})

    def test_files(self):
        self.write("wave.glsl", "")
        self.assertEqual(self.completed("capture", "wav"), {"wave.glsl"})
        self.assertEqual(self.completed("wav"), {"wave.glsl"})


if __name__ == "__main__":
    main(needs_context=False)
