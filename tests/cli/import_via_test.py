"""`import --via`: a project out of a saved page, a list, or what a person's own program prints."""
import json
import sys

from support.program import ProgramTest, main

CODE = "void mainImage(out vec4 c, in vec2 p) { c = p.x < 3.0 && p.y > 1.0 ? vec4(1.0) : vec4(0.0); }\n"
PROJECT = {"ver": "0.1", "info": {"id": "abCD12", "name": "A test"}, "renderpass": [{"type": "image", "code": CODE}]}
PAGE = f"<!DOCTYPE html>\n<html><head><script>var gRes = [{json.dumps(PROJECT)}];</script></head></html>\n"
ADDRESS = "https://www.shadertoy.com/view/abCD12"


class Via(ProgramTest):
    def program(self, text: str) -> str:
        """A program of a person's own."""
        path = self.write("fetch", f"#!{sys.executable}\nimport sys, time\n{text}\n")
        path.chmod(0o755)
        return "./fetch"

    def imported(self, *arguments: str, folder: str = "abCD12") -> None:
        done = self.succeed("import", *arguments)
        self.assertEqual(done.stderr, f"wrote {folder}: image.glsl, scene.json\n")
        self.assertEqual((self.folder / folder / "image.glsl").read_text(), CODE)


class ViaFile(Via):
    def test_project_in_a_page(self) -> None:
        self.write("page.html", PAGE)
        self.imported(ADDRESS, "--via", "page.html")
        self.imported("page.html", folder="page")

    def test_project_chosen_from_a_list(self) -> None:
        other = {"info": {"id": "other1"}, "renderpass": [{"type": "image", "code": "x"}]}
        self.write("all", json.dumps({"userName": "me", "shaders": [other, PROJECT]}))
        self.imported("abCD12", "--via", "all")
        self.assertNotIn("other1", (self.folder / "abCD12/scene.json").read_text())
        self.expect_failure(["import", "nobody", "--via", "all"], 3,
                            "all: error: this holds other1, abCD12, but not nobody")

    def test_page_without_a_project(self) -> None:
        self.write("page.html", "<html><script>load('abCD12');</script></html>")
        self.expect_error(["import", ADDRESS, "--via", "page.html"], 3, "page.html: error:")


class ViaCommand(Via):
    def fails(self, words: str, code: int = 3, *options: str) -> None:
        self.expect_error(["import", "abCD12", "--via", "./fetch", *options], code, words)

    def test_command_gets_the_id_as_last_argument_without_a_shell(self) -> None:
        self.program(f"assert sys.argv[1:] == ['-q', '$HOME;', 'abCD12'], sys.argv\nprint({json.dumps(PROJECT)!r})")
        self.imported(ADDRESS, "--via", "./fetch -q $HOME;")

    def test_command_in_path_may_print_a_page(self) -> None:
        self.program(f"print({PAGE!r})")
        self.imported("abCD12", "--via", f"{sys.executable} fetch")

    def test_command_with_blanks_in_its_name(self) -> None:
        self.program(f"print({json.dumps(PROJECT)!r})")
        (self.folder / "fetch").rename(self.folder / "my fetch")
        self.imported("abCD12", "--via", "./my fetch")

    def test_program_in_the_current_folder_needs_its_path(self) -> None:
        self.program("open('ran', 'w')")
        self.expect_failure_like(["import", "abCD12", "--via", "fetch"], 3,
                                 "tidemark: error: 'fetch abCD12': there is no program 'fetch' in PATH: .*")

    def test_failing_command_is_reported(self) -> None:
        self.program("sys.exit('first\\nno such shader')")
        self.fails("'./fetch abCD12': no such shader")
        self.program("sys.exit(3)")
        self.fails("'./fetch abCD12': it failed without a message")
        self.program("pass")
        self.fails("'./fetch abCD12' printed nothing")

    def test_endless_command_is_stopped(self) -> None:
        self.program("time.sleep(600)")
        self.fails("'./fetch abCD12': it took longer than --timeout 0.3 s", 5, "--timeout", "0.3")
        self.program("while True: print('x' * 99999)")
        self.fails("'./fetch abCD12': './fetch' prints more than 16 MiB")

    def test_missing_command_is_reported(self) -> None:
        self.expect_error(["import", "abCD12", "--via", "no-such-program"], 3,
                          "'no-such-program abCD12'", "'no-such-program'", "PATH", "--via")


class Usage(Via):
    def test_makes_no_network_request(self) -> None:
        self.expect_error(["import", ADDRESS], 2, f"'{ADDRESS}'", "--via", "FILE", "COMMAND")

    def test_refuses_other_addresses(self) -> None:
        self.expect_error(["import", "--via", "x.json", "--", "--help"], 2, "'--help'")


if __name__ == "__main__":
    main(needs_context=False)
