"""Whole processes, timed against each other."""
import os
import statistics
import subprocess
import sys
import time


def run(command, codes=(0,)):
    """Wall and CPU seconds and peak memory (MiB) of one process."""
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in codes:
        sys.exit(f"bench: {command} failed with {process.returncode}")
    return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "memory": usage.ru_maxrss / 1024}


def spread(values):
    return {"median": statistics.median(values), "low": min(values), "high": max(values)}


def against(name, ours, floor, rounds):
    """Interleaved: floor, ours, floor, ours … The first round warms caches and is dropped."""
    pairs = [(run(floor), run(ours)) for _ in range(rounds + 1)][1:]
    row = {"name": name}
    for figure in ("wall", "cpu", "memory"):
        row[figure] = {
            "floor": spread([a[figure] for a, _ in pairs]),
            "ours": spread([b[figure] for _, b in pairs]),
            "ratio": spread([b[figure] / a[figure] for a, b in pairs]),
        }
    return row
