#!/usr/bin/env python3
"""Runs the lines of a file of commands as tasks of a Dask cluster.

dask_tasks.py TASKS SCHEDULER-ADDRESS

Each line runs in a shell on a worker, once: a line that fails is not tried again, but a line whose worker dies goes to another
one. Start workers with `--resources bake=N`, for N lines at once. Prints a line for each failure, and ends with exit code 1 if
there is one."""
import subprocess
import sys
import time

import distributed


def run(line):
    ended = subprocess.run(["bash", "-c", line], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                           stderr=subprocess.STDOUT, errors="replace", check=False)
    return ended.returncode, ended.stdout


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as file:
        lines = file.read().splitlines()
    started = time.monotonic()
    failed = 0
    with distributed.Client(sys.argv[2]) as client:
        tasks = client.map(run, lines, pure=False, resources={"bake": 1})
        line_of = {task.key: line for task, line in zip(tasks, lines)}
        for done, task in enumerate(distributed.as_completed(tasks), 1):
            # If several workers die while they run the same line, Dask reports the task as failed.
            code, output = task.result() if task.status == "finished" else (1, str(task.exception()) + "\n")
            if code != 0:
                failed += 1
                print(f"exit code {code}: {line_of[task.key]}\n{output}", end="", flush=True)
            left_s = (time.monotonic() - started) / done * (len(lines) - done)
            print(f"{done} of {len(lines)} done, {failed} failed, about {left_s:.0f} s left", file=sys.stderr, flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
