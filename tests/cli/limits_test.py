"""A system that gives few threads, little memory, few or small files: one line and a documented exit code."""
import os
import resource

from support.program import PROGRAM, ProgramTest, environment, main, not_sanitized

SCENE = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / 8.0, sin(iTime), 1.0); }\n"
MEBIBYTE = 1 << 20
DOCUMENTED = {0, 3, 4, 5, 77}
DRIVERS_WORDS = ("libEGL ", "LLVM ERROR: ", "Allocation failed")
os.environ.pop("GLIBC_TUNABLES", None)  # of the presets: memory in pages of 2 MiB does not fit into the smallest limits
NOBODY = 61234  # a user of no other process: limits of processes count them all, and root has none


@not_sanitized
class Limits(ProgramTest):
    def run_under(self, limit: int, value: int, *arguments: str, user: int | None = None):
        def prepare() -> None:
            resource.setrlimit(limit, (value, value))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            if user is not None:
                os.setgroups([])
                os.setgid(user)
                os.setuid(user)
        return self.run_program(*arguments, preexec_fn=prepare,
                                env=environment(HOME=str(self.folder), XDG_CACHE_HOME=str(self.folder / "cache")))

    def sweep(self, limit: int, values: list[int], *arguments: str, user: int | None = None) -> set[int]:
        """The exit codes. Whatever the loader, the driver and we do not get, it is said in a line."""
        self.write("a.glsl", SCENE)
        codes = set()
        for value in values:
            with self.subTest(limit=limit, value=value, arguments=arguments):
                done = self.run_under(limit, value, *arguments, user=user)
                if "error while loading shared libraries" in done.stderr:  # we were never there
                    continue
                codes.add(done.returncode)
                self.assertIn(done.returncode, DOCUMENTED, done.stderr)
                if done.returncode != 0:
                    lines = [line for line in done.stderr.splitlines() if line and not line.startswith(DRIVERS_WORDS)]
                    self.assertEqual(len(lines), 1, done.stderr)
                    self.assertRegex(lines[0], r"\A[a-z.]+: error: ")
                self.assertFalse([name for name in self.files() if ".part-" in name])
        return codes

    CAPTURES = (["capture", "a.glsl", "--size", "8x8"],
                ["capture", "a.glsl", "--size", "8x8", "--frames", "0-5", "-o", "a.%04d.png"],
                ["capture", "a.glsl", "--size", "8x8", "-o", "a.exr"])

    def test_a_too_small_stack_is_an_error(self):
        small = lambda most: lambda: resource.setrlimit(resource.RLIMIT_STACK, (65536, most))
        self.expect_error(["inspect", "--devices"], 4, "1 MiB", "8 MiB", "8192", preexec_fn=small(65536))
        self.succeed("--version", preexec_fn=small(resource.RLIM_INFINITY))

    def test_threads(self):
        user = None
        if os.geteuid() == 0:
            user = NOBODY
            os.chmod(self.folder, 0o777)
            if self.run_under(resource.RLIMIT_NPROC, 100, "--version", user=user).returncode != 0:
                self.skipTest(f"other users cannot run {PROGRAM}")
        for capture in self.CAPTURES:
            # llvmpipe waits for ever where only some of its threads could be made (once in some hundred starts).
            codes = self.sweep(resource.RLIMIT_NPROC, [0, 1, 3, 5, 6, 7, 8, 9, 12, 1000], *capture, "--timeout", "30",
                               user=user)
            self.assertEqual(codes - {5}, {0, 4})

    def test_memory_limit_of_the_command(self):
        self.assertIn(4, self.sweep(resource.RLIMIT_DATA, [n * MEBIBYTE for n in (1, 4, 8, 24, 48, 200)],
                                    *self.CAPTURES[0]))

    def test_address_space(self):
        self.sweep(resource.RLIMIT_AS, [n * MEBIBYTE for n in (30, 60, 120, 200, 420, 2000)], *self.CAPTURES[0])
        self.write("big.json", '{"renderpass": "' + "x" * (15 << 20) + '"}')
        codes = self.sweep(resource.RLIMIT_AS, [n * MEBIBYTE for n in (30, 40, 50, 60, 300)], "inspect", "big.json",
                           "--device", "none")
        self.assertEqual(codes, {3, 4})

    def test_files(self):
        self.sweep(resource.RLIMIT_NOFILE, [3, 4, 5, 6, 8, 12, 20], *self.CAPTURES[0])
        self.assertEqual(self.sweep(resource.RLIMIT_FSIZE, [0, 1, 50, 100], *self.CAPTURES[0]), {4})

    def test_stack(self):
        self.sweep(resource.RLIMIT_STACK, [n * 1024 for n in (128, 256, 1024)], *self.CAPTURES[0])


if __name__ == "__main__":
    main()
