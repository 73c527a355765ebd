"""One version everywhere, and what `./dev release` refuses before it runs anything."""
import gzip
import pathlib
import re
import shutil
import subprocess
import unittest

from support.program import PROGRAM, ROOT, ProgramTest, main

DOCUMENTS = pathlib.Path(PROGRAM).resolve().parent / "runner/install/documents"
HEADINGS = re.findall(r"^## (\S+) \((\S+)\)$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)


class Version(ProgramTest):
    def test_program_and_changelog_agree(self) -> None:
        self.assertEqual(self.succeed("--version").stdout.decode(), f"tidemark {HEADINGS[0][0]}\n")

    @unittest.skipUnless((DOCUMENTS / "changelog.gz").is_file(), "there is no build folder")
    def test_debian_changelog_has_every_entry(self) -> None:
        debian = gzip.decompress((DOCUMENTS / "changelog.gz").read_bytes()).decode()
        self.assertEqual(re.findall(r"^tidemark \((\S+)\) stable; urgency=medium$", debian, re.MULTILINE),
                         [version for version, _ in HEADINGS])
        items = re.findall(r"^[* ] (.*)$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
        self.assertEqual([line[4:] for line in debian.splitlines() if line.startswith("  ")], items)

    @unittest.skipUnless((DOCUMENTS / "changelog.gz").is_file() and shutil.which("dpkg-parsechangelog"), "no dpkg-dev")
    def test_dpkg_parses_the_debian_changelog(self) -> None:
        self.write("changelog", gzip.decompress((DOCUMENTS / "changelog.gz").read_bytes()))
        read = subprocess.run(["dpkg-parsechangelog", "-l", "changelog", "--show-field", "Version"], cwd=self.folder,
                              capture_output=True, text=True, check=True)
        self.assertEqual((read.stdout, read.stderr), (HEADINGS[0][0] + "\n", ""))


@unittest.skipUnless(shutil.which("git"), "there is no git")
class Release(ProgramTest):
    """In a repository with `dev` and a changelog, and nothing to build: whatever is not refused fails in CMake."""

    def setUp(self) -> None:
        super().setUp()
        shutil.copy(ROOT / "dev", self.folder)
        self.write("packages.txt", "")
        self.write("CHANGELOG.md", "# Changes\n\n## 1.2.0 (2026-11-22)\n\n* New.\n\n## 1.1.0 (2026-01-01)\n\n* Old.\n")
        self.git("init", "--quiet")
        self.commit()

    def git(self, *words: str) -> None:
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", *words], cwd=self.folder, check=True)

    def commit(self) -> None:
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", "a")

    def release(self, *words: str) -> str:
        done = subprocess.run(["./dev", "release", *words], cwd=self.folder, capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        return done.stderr

    def test_unready_releases_are_refused(self) -> None:
        self.assertEqual(self.release(), "./dev: give the version that CHANGELOG.md begins with: ./dev release 1.2.0\n")
        self.assertEqual(self.release("1.1.0"),
                         "./dev: CHANGELOG.md begins with 1.2.0, not with 1.1.0: say there what is new\n")
        self.write("new.txt", "")
        self.assertEqual(self.release("1.2.0"),
                         "./dev: there is what is not committed: commit it, or put it away\n")
        self.commit()
        self.git("tag", "v1.2.0")
        self.assertEqual(self.release("1.2.0"), "./dev: there is a tag v1.2.0: that version is out\n")

    def test_a_ready_release_runs_the_checks(self) -> None:
        self.write("clang-format", "#!/bin/sh\necho formatted >&2; exit 1\n").chmod(0o755)
        self.write("a.cpp", "")
        self.commit()
        done = subprocess.run(["./dev", "release", "1.2.0"], cwd=self.folder, capture_output=True, text=True,
                              env={"PATH": f"{self.folder}:/usr/bin:/bin"})
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr, "formatted\n")


if __name__ == "__main__":
    main(needs_context=False)
