"""The README's table of options is what --help says: nothing missing, nothing made up."""
import re

from support.program import ROOT, ProgramTest, main

COMMANDS = ("view", "capture")


class Readme(ProgramTest):
    def options_of(self, command: str) -> set[str]:
        text = self.succeed(command, "--help").stdout.decode()
        listed = re.findall(r"^  (-\S+)", text, re.MULTILINE)
        return {name for names in listed for name in names.split(",")} - {"-h", "--help"}

    def test_table_of_options(self):
        text = (ROOT / "README.md").read_text()
        table = text.split("Options, the same wherever they stand:")[1].split("\n\n")[1]
        written = {name for row in table.splitlines()[2:]
                   for name in re.findall(r"`(--?[a-z-]+)", row.split(" | ")[0])}
        there = set().union(*(self.options_of(command) for command in COMMANDS)) - {"--output"}  # `-o`
        self.assertEqual(written, there)


if __name__ == "__main__":
    main(needs_context=False)
