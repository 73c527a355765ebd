"""The program as a whole: help, version, commands and options that do not exist."""
from support.program import ProgramTest, environment, main

COMMANDS = ["view", "capture", "inspect", "import", "export", "bake", "completion", "help"]
SHADER = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n"


class Help(ProgramTest):
    def test_no_arguments_is_help(self):
        self.assertEqual(self.succeed().stdout, self.succeed("--help").stdout)

    def test_names_every_command_and_every_exit_code(self):
        text = self.succeed("--help").stdout.decode()
        for command in COMMANDS:
            self.assertRegex(text, rf"\n  {command} +[A-Z]")
        for code in ("0 ok", "1 a check failed", "2 usage", "3 scene does not load or compile",
                     "4 output cannot be written", "5 timed out", "77 no OpenGL context", "130 interrupted"):
            self.assertIn(code, text)

    def test_help_of_every_command(self):
        for command in [[c] for c in COMMANDS] + [["bake", "noise"]]:
            with self.subTest(command=command):
                done = self.succeed(*command, "--help")
                self.assertIn(f"Usage: tidemark {' '.join(command)}", done.stdout.decode())
                self.assertEqual(done.stderr, "")
                self.assertEqual(self.succeed(*command, "-h").stdout, done.stdout)

    def test_defaults_equal_the_table(self):
        text = self.succeed("capture", "--help").stdout.decode()
        self.assertIn("--size WxH=640x360", text)
        self.assertIn("--fps F=60", text)

    def test_version(self):
        done = self.succeed("--version")
        self.assertRegex(done.stdout.decode(), r"\Atidemark \d+\.\d+\.\d+\n\Z")
        self.assertEqual(done.stderr, "")

    def test_needs_neither_display_nor_driver(self):
        self.succeed("--help", env=environment(__EGL_VENDOR_LIBRARY_FILENAMES="/dev/null"))


class Unknown(ProgramTest):
    def test_misspelled_command_suggests_the_nearest(self):
        self.expect_failure(["caputre", "a.glsl"], 2,
                            "tidemark: error: unknown command 'caputre': did you mean 'capture'?")
        self.expect_failure(["vew"], 2, "tidemark: error: unknown command 'vew': did you mean 'view'?")

    def test_word_unlike_any_command_or_file_is_refused(self):
        self.expect_error(["frobnicate"], 2, "'frobnicate'", "neither", "`tidemark --help`")

    def test_scene_with_a_name_like_a_command_is_viewed(self):
        self.write("vew", "float x;\n")
        self.expect_error(["vew"], 3, "'vew'", "mainImage")

    def test_misspelled_option_suggests_the_nearest(self):
        for command, option, near in [("capture", "--sise", "--size"), ("capture", "--frmae", "--frame"),
                                      ("view", "--define-", "--define"), ("inspect", "--jsn", "--json")]:
            with self.subTest(command=command):
                self.expect_failure([command, "a.glsl", option], 2,
                                    f"tidemark: error: unknown option {option}: did you mean {near}?")
        self.expect_failure(["bake", "noise", "--sed=3"], 2,
                            "tidemark: error: unknown option --sed: did you mean --seed?")

    def test_option_unlike_any_other_refers_to_the_help(self):
        self.expect_failure(["--frobnicate"], 2,
                            "tidemark: error: unknown option --frobnicate: `tidemark --help` lists the options")
        for command in ("view", "capture", "inspect"):
            with self.subTest(command=command):
                self.expect_failure([command, "a.glsl", "--frobnicate=3"], 2,
                                    "tidemark: error: unknown option --frobnicate: "
                                    f"`tidemark {command} --help` lists the options")
        self.expect_failure(["bake", "noise", "--frobnicate"], 2,
                            "tidemark: error: unknown option --frobnicate: "
                            "`tidemark bake noise --help` lists the options")
        self.expect_failure(["bake", "--frobnicate"], 2,
                            "tidemark: error: unknown option --frobnicate: "
                            "`tidemark bake --help` lists the options")

    def test_argument_too_many(self):
        for command in ("serve", "capture", "inspect"):
            with self.subTest(command=command):
                self.expect_failure([command, "a.glsl", "b.glsl"], 2,
                                    "tidemark: error: unexpected argument 'b.glsl'")
        self.expect_failure(["completion", "bash", "zsh"], 2, "tidemark: error: unexpected argument 'zsh'")

    def test_scene_missing(self):
        for command in ("view", "capture"):
            with self.subTest(command=command):
                self.expect_failure([command], 2, f"tidemark: error: {command}: SCENE is required")
        self.expect_failure(["inspect"], 2, "tidemark: error: inspect: give a SCENE, or --devices")

    def test_scene_after_a_repeatable_option(self):
        (self.folder / "a.glsl").write_text("#define N 1\n#iUniform float k = 1.0 in { 0.0, 2.0 }\n" + SHADER)
        for words in (["export", "--set", "k=2", "a.glsl", "-o", "-"],
                      ["inspect", "--device", "none", "--set", "k=2", "--define", "N=2", "a.glsl"],
                      ["capture", "--set", "k=2", "--channel", "0=none", "a.glsl", "--size", "2x2"],
                      ["inspect", "--with", "channels,mipmaps", "--budget", "30", "--size", "2x2", "a.glsl"],
                      ["check", "--probe", "hashes", "--probe", "unassigned", "a.glsl"]):
            with self.subTest(words=words):
                self.succeed(*words)

    def test_value_missing(self):
        for words, wrong in ((["capture", "a.glsl", "--time"], "--time: give a value, T"),
                             (["bake", "noise", "--seed", "x"], "--seed: give a whole number from 0, not 'x'"),
                             (["capture", "a.glsl", "--timeout", "soon"],
                              "--timeout: give a number of seconds, not 'soon'")):
            self.expect_failure(words, 2, f"tidemark: error: {wrong}")
        self.expect_failure(["capture", "a.glsl", "--size"], 2, "tidemark: error: --size: give a value, WxH")


if __name__ == "__main__":
    main(needs_context=False)
