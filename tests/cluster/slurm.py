"""A Slurm of one machine's own, in a folder of its own: munged, a controller, and nodes of one core each.

Each node is a slurmd in its own namespace of processes and of host names, bound to one core: what is killed with it is
what a machine takes with it that loses its power. Needs root, as slurmd does."""
from __future__ import annotations

import contextlib
import os
import pathlib
import re
import secrets
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "unshare", "taskset")
START_SECONDS = 60
# A requeued job waits two minutes, in case that its node is yet to be cleaned up.
JOB_SECONDS = 900


class CannotStart(Exception):
    """In words for people."""


def why_not() -> str | None:
    """Why there can be no Slurm here."""
    missing = [name for name in PROGRAMS if not shutil.which(name)]
    if missing:
        return f"{', '.join(missing)} not installed: ./dev setup cluster"
    if os.geteuid() != 0:
        return "slurmd must be root: run ./dev test --cluster as root"
    if len(cores()) < 2:
        return "two nodes need two cores"
    return None


def cores() -> list[int]:
    return sorted(os.sched_getaffinity(0))


def free_ports(count: int) -> list[int]:
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def kill_namespace(process: subprocess.Popen) -> None:
    """All of them at once, with a signal that nobody can answer: the first process of `unshare`'s namespace."""
    children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
    with contextlib.suppress(OSError):
        for child in children.read_text().split():
            os.kill(int(child), signal.SIGKILL)
        return
    process.kill()  # the rest goes with it


class Slurm:
    """`with Slurm(folder) as slurm`; the folder is readable for everybody."""

    def __init__(self, folder: pathlib.Path, nodes: int = 2):
        self.folder = folder
        self.names = [f"node{i + 1}" for i in range(nodes)]
        self.running: dict[str, subprocess.Popen] = {}
        self.env = dict(os.environ, SLURM_CONF=str(folder / "slurm.conf"))

    def __enter__(self) -> Slurm:
        try:
            self.configure()
            self.start_munge()
            self.start("slurmctld", ["slurmctld", "-D", "-f", str(self.folder / "slurm.conf")])
            self.wait_for("the controller", lambda: self.scontrol("ping").returncode == 0, "slurmctld")
            for name in self.names:
                self.start_node(name)
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_) -> None:
        for name in reversed(list(self.running)):
            self.stop(name)

    def configure(self) -> None:
        self.folder.chmod(0o755)
        ports = free_ports(1 + len(self.names))
        host = socket.gethostname()
        lines = ["ClusterName=tidemark", f"SlurmctldHost={host}(127.0.0.1)", f"SlurmctldPort={ports[0]}",
                 "SlurmUser=root", "AuthType=auth/munge", f"AuthInfo=socket={self.folder}/munge.socket",
                 f"StateSaveLocation={self.folder}/state", f"SlurmdSpoolDir={self.folder}/spool-%n",
                 f"SlurmctldPidFile={self.folder}/slurmctld.pid", f"SlurmdPidFile={self.folder}/slurmd-%n.pid",
                 "ProctrackType=proctrack/linuxproc", "TaskPlugin=task/none", "JobAcctGatherType=jobacct_gather/none",
                 "AccountingStorageType=accounting_storage/none", "MpiDefault=none", "SwitchType=switch/none",
                 "SelectType=select/cons_tres", "SelectTypeParameters=CR_CPU", "SchedulerType=sched/backfill",
                 "SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,bf_interval=1",
                 # A node that is silent for ten seconds is down; one that comes back is taken.
                 "SlurmdTimeout=10", "ReturnToService=2", "SlurmdParameters=config_overrides", "MailProg=/bin/true"]
        lines += [f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1 RealMemory=1000 State=UNKNOWN"
                  for name, port in zip(self.names, ports[1:])]
        lines += [f"PartitionName=all Nodes={','.join(self.names)} Default=YES MaxTime=INFINITE State=UP"]
        (self.folder / "slurm.conf").write_text("\n".join(lines) + "\n")
        for name in ("state", *(f"spool-{n}" for n in self.names)):
            (self.folder / name).mkdir()

    def start_munge(self) -> None:
        key = self.folder / "munge.key"
        key.touch(mode=0o400)
        key.write_bytes(secrets.token_bytes(128))
        place = {name: f"--{name}-file={self.folder}/munge.{name}" for name in ("pid", "log", "seed")}
        self.start("munged", ["munged", "--foreground", "--force", f"--socket={self.folder}/munge.socket",
                              f"--key-file={key}", *place.values()])
        self.wait_for("munged", (self.folder / "munge.socket").exists, "munged")

    def start_node(self, name: str) -> None:
        core = cores()[self.names.index(name) % len(cores())]
        # Its hostname stands in what a capture has under construction: two machines have two.
        inside = f'hostname {name} && exec slurmd -D -N {name} -f "$SLURM_CONF"'
        self.start(name, ["taskset", "-c", str(core), "unshare", "--pid", "--uts", "--mount-proc", "--fork",
                          "--kill-child", "sh", "-c", inside])
        self.wait_for(name, lambda: self.state_of(name) == "IDLE", name)

    def start(self, name: str, command: list[str]) -> None:
        with open(self.folder / f"{name}.out", "ab") as log:
            self.running[name] = subprocess.Popen(command, env=self.env, stdin=subprocess.DEVNULL, stdout=log,
                                                  stderr=subprocess.STDOUT, start_new_session=True)

    def stop(self, name: str) -> None:
        process = self.running.pop(name)
        if name in self.names:
            kill_namespace(process)
        else:
            process.terminate()
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def wait_for(self, what: str, ready, name: str) -> None:
        end = time.monotonic() + START_SECONDS
        while not ready():
            if self.running[name].poll() is not None or time.monotonic() > end:
                words = (self.folder / f"{name}.out").read_text(errors="replace").strip().splitlines()
                raise CannotStart(f"{what} does not start: " + (" / ".join(words[-3:]) or "it says nothing"))
            time.sleep(0.1)

    def run(self, *command: str, **options) -> subprocess.CompletedProcess:
        return subprocess.run(command, env=self.env, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, timeout=START_SECONDS, **options)

    def scontrol(self, *arguments: str) -> subprocess.CompletedProcess:
        return self.run("scontrol", *arguments)

    def state_of(self, node: str) -> str:
        """`IDLE`, `ALLOCATED`, `DOWN*`."""
        found = re.search(r"\bState=(\S+)", self.scontrol("show", "node", node).stdout)
        return found.group(1) if found else ""

    def submit(self, script: pathlib.Path, *options: str, folder: pathlib.Path, path: str) -> str:
        """The number of the job; `path` is what its programs are found by."""
        done = subprocess.run(["sbatch", "--parsable", *options, str(script)], cwd=folder, stdin=subprocess.DEVNULL,
                              env=dict(self.env, PATH=path), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              timeout=START_SECONDS)
        if done.returncode != 0:
            raise AssertionError(f"sbatch: {done.stderr}")
        return done.stdout.strip()

    def tasks(self, job: str) -> dict[str, tuple[str, str]]:
        """State and node of each task that is not over."""
        listed = self.run("squeue", "--noheader", "--array", "--jobs", job, "--format=%K %T %N")
        rows = (line.split() for line in listed.stdout.splitlines())
        return {row[0]: (row[1], row[2] if len(row) > 2 else "") for row in rows if row and row[1] != "COMPLETED"}

    def wait_for_job(self, job: str) -> None:
        end = time.monotonic() + JOB_SECONDS
        while tasks := self.tasks(job):
            if time.monotonic() > end:
                raise AssertionError(f"job {job} does not end: {tasks}\n{self.scontrol('show', 'job', job).stdout}")
            time.sleep(0.1)
