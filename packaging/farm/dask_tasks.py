#!/usr/bin/env python3
"""Runs each line of a file as a shell command on a Dask cluster.

dask_tasks.py TASKS SCHEDULER-ADDRESS

TASKS is a file with one command per line, such as the tasks.txt of `nook plan`. SCHEDULER-ADDRESS is the address of the Dask
scheduler, such as tcp://10.0.0.1:8786. A command that fails is not run again. If a worker dies, its command runs on another worker.
Start each worker with `--resources bake=N`; it then runs N commands at the same time. The script prints each command that
fails, with its output. Its exit code is 1 if a command failed, and 0 otherwise."""
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
            print(f"{done} of {len(lines)} commands done, {failed} failed, about {left_s:.0f} s left", file=sys.stderr, flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
