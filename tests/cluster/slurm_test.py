"""A real Slurm, and the job script of the page on capturing: what an array of tasks makes on two nodes, one of which is
killed, is what one machine makes, byte for byte. How much faster two nodes are is printed, and decides nothing."""
import os
import pathlib
import re
import shutil
import statistics
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from cluster.slurm import CannotStart, Slurm, why_not
from support.program import PROGRAM, ROOT, SKIPPED, ProgramTest, has_context

PAGE = ROOT / "runner/cli/manual/capture.md"
RUNS = int(os.environ.get("TIDEMARK_CLUSTER_RUNS", "3"))
SCENE = """void mainImage(out vec4 c, in vec2 p) {
    float x = 0.0;
    for (int i = 0; i < 20; ++i) x += sin(p.x * float(i) * 0.01 + iTime + p.y * 0.02);
    c = vec4(p / iResolution.xy, 0.5 + 0.1 * x, 1.0);
}
"""
IMAGE = """#iChannel0 "Buffer A"
void mainImage(out vec4 c, in vec2 p) { c = fract(texelFetch(iChannel0, ivec2(p), 0)); }
"""
BUFFER = """#iChannel0 "Buffer A"
void mainImage(out vec4 c, in vec2 p) {
    if (iFrame % 3 == 1 && int(p.x) % 5 == 2) discard;
    c = texelFetch(iChannel0, ivec2(p), 0) * 1.01 + vec4(p * 0.001, 1.0, iTime) * 0.01;
}
"""


def job_script() -> str:
    """That of the page, word for word."""
    return re.search(r"```bash\n(#!/bin/bash\n#SBATCH.*?)```", PAGE.read_text(), re.DOTALL).group(1)


class Cluster(ProgramTest):
    def setUp(self):
        super().setUp()
        self.folder.chmod(0o755)
        self.write("wave.glsl", SCENE)
        self.write("fb/image.glsl", IMAGE)
        self.write("fb/buffer_a.glsl", BUFFER)
        (self.folder / "slurm").mkdir()
        self.slurm = self.enterContext(Slurm(self.folder / "slurm"))

    def contents(self, name: str) -> dict[str, bytes]:
        return {path.name: path.read_bytes() for path in (self.folder / name).iterdir() if path.name != "shards.json"}

    def submit(self, script: str, *options: str) -> str:
        (self.folder / "frames").mkdir(exist_ok=True)
        path = f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"
        # These nodes have no GPU.
        return self.slurm.submit(self.write("job.sh", script), "--gres=none", *options, folder=self.folder, path=path)

    def frames_made(self) -> int:
        return len(list((self.folder / "frames").glob("????.png")))

    def kill_a_node(self, job: str) -> None:
        """node1, in the middle of its task; the tasks of a node that is gone are run again, elsewhere."""
        while not (self.frames_made() >= 200 and "node1" in {node for state, node in self.slurm.tasks(job).values()}):
            self.assertTrue(self.slurm.tasks(job), "the job ended before its node was killed")
            time.sleep(0.05)
        lost = [task for task, (state, node) in self.slurm.tasks(job).items() if node == "node1"]
        made = self.frames_made()
        self.slurm.stop("node1")
        print(f"node1 killed with {made} frames made, and in it task {', '.join(lost)}", flush=True)
        self.again(job, lost)

    def again(self, job: str, lost: list[str]) -> None:
        """What was lost waits to be run again; at once, not in two minutes."""
        end = time.monotonic() + 120
        while self.slurm.state_of("node1").startswith(("ALLOCATED", "IDLE", "MIXED")) or any(
                self.slurm.tasks(job).get(task, ("PENDING", ""))[1] == "node1" for task in lost):
            self.assertLess(time.monotonic(), end, self.slurm.state_of("node1"))
            time.sleep(0.2)
        print(f"node1 is {self.slurm.state_of('node1')}; {self.slurm.tasks(job)}", flush=True)
        for task in lost:
            self.slurm.scontrol("update", f"JobId={job}_{task}", "StartTime=now")

    def expect_one_machines(self, script: str) -> None:
        command = re.search(r"^tidemark (capture .*?) --shard slurm --resume$", script, re.MULTILINE).group(1)
        (self.folder / "one").mkdir()
        words = [word.strip("'") for word in command.replace("frames/", "one/").split()]
        self.succeed(*words)
        said = self.succeed("gather", "frames", "--sample", "3").stderr.splitlines()
        self.assertRegex(said[0], r"\A1000 frames: all complete, with one fingerprint, drawn by ")
        self.assertEqual(self.contents("frames"), self.contents("one"))

    def logs(self) -> str:
        return "".join(path.read_text() for path in sorted(self.folder.glob("slurm-*.out")))

    def test_a_node_is_killed(self):
        job = self.submit(job_script())
        self.kill_a_node(job)
        self.slurm.wait_for_job(job)
        self.assertRegex(self.logs(), r"kept \d+ of 125 frames")
        self.expect_one_machines(job_script())

    def test_a_node_that_draws_feedback_is_killed(self):
        script = job_script().replace("wave.glsl", "fb").replace("--shard", "--state-every 50 --shard")
        job = self.submit(script)
        self.kill_a_node(job)
        self.slurm.wait_for_job(job)
        self.assertRegex(self.logs(), r"kept \d+ of 125 frames")
        self.expect_one_machines(script)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_a_video(self):
        """Encoded by the tasks; one machine's is encoded on one core, too, for libx264 goes by their number."""
        video = "capture wave.glsl --frames 0-199 --size 128x72 --state-every 20 -o {}/a.mp4"
        script = re.sub(r"^tidemark capture .*? --shard", f"tidemark {video.format('frames')} --shard", job_script(),
                        flags=re.MULTILINE)
        self.slurm.wait_for_job(self.submit(script))
        self.assertEqual(self.succeed("gather", "frames").stderr.splitlines()[-1], "wrote frames/a.mp4: 200 frames")
        (self.folder / "one").mkdir()
        core = min(os.sched_getaffinity(0))
        self.succeed(*video.format("one").split(), preexec_fn=lambda: os.sched_setaffinity(0, {core}))
        self.assertEqual(self.contents("frames"), self.contents("one"))

    def seconds(self, *options: str) -> float:
        """Of an array of two, from `sbatch` to its end."""
        for path in (self.folder / "frames").glob("*"):
            path.unlink()
        start = time.monotonic()
        job = self.submit(job_script(), "--array=0-1", *options)
        self.slurm.wait_for_job(job)
        seconds = time.monotonic() - start
        self.assertEqual(self.frames_made(), 1000)
        return seconds

    def test_two_nodes_are_faster(self):
        ratios = []
        for _ in range(RUNS):
            one, two = self.seconds("--nodelist=node1"), self.seconds()
            ratios.append(one / two)
            print(f"1,000 frames in two tasks: one node {one:.1f} s, two nodes {two:.1f} s, {one / two:.2f} times", flush=True)
        print(f"two nodes of one core against one: {statistics.median(ratios):.2f} times "
              f"({min(ratios):.2f} to {max(ratios):.2f} in {RUNS} runs); {os.getloadavg()[0]:.1f} processes wanted "
              f"{os.cpu_count()} cores", flush=True)


def cannot_start() -> str | None:
    """Tried once, so that nobody has to read it out of a failed test."""
    with tempfile.TemporaryDirectory(prefix="tidemark-slurm-") as folder:
        try:
            with Slurm(pathlib.Path(folder)):
                return None
        except CannotStart as reason:
            return str(reason)


if __name__ == "__main__":
    reason = why_not() or (None if has_context() else "no OpenGL context") or cannot_start()
    if reason:
        print(f"skipped: {reason}")
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)
