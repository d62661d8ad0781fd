"""Several processes want the same run folder at the same moment.

usage: shared_folder.py PROGRAM [ROUNDS] [SEED]

In each round two, four or eight processes start at once, at random moments of 50 ms: all with `run` in an empty folder, all with
`--resume` in that of a stopped run, or all with `--overwrite` in that of a finished one. One must be done with exit code
0, the others must end with 2 and name the one that holds the folder; what the run then holds must equal what a run
alone leaves, but for times of day, seconds spent and the words of the command. Prints what happened, exit code 1 if that does not hold.
"""

import os
import random
import re
import subprocess
import sys
import tempfile
import time

import run_files

WORDS = ["run", "two_cells", "--threads", "1", "--quiet", "--out", "r"]
# Long enough that all have asked before one is done.
WHOLE = ["--set", "time.end=90 h"]
HALF = ["--set", "time.end=90 h", "--until", "30 h"]


def finish(program, folder, words):
    done = subprocess.run([program, *WORDS, *words], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{words}: exit code {done.returncode}\n{done.stderr}")


def contend(program, folder, words, count, moments):
    """Starts `count` processes; their exit codes and what they say."""
    processes = []
    for _ in range(count):
        processes.append(
            subprocess.Popen([program, *WORDS, *words], cwd=folder, stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, text=True))
        time.sleep(moments.uniform(0, 0.05 / count))
    return [(p.pid, p.communicate()[1], p.returncode) for p in processes]


def judge(outcomes, differing):
    """What is wrong with one round; empty if nothing."""
    faults = []
    winners = [pid for pid, _, code in outcomes if code == 0]
    if len(winners) != 1:
        faults.append(f"{len(winners)} of {len(outcomes)} processes were done")
    for pid, text, code in outcomes:
        if pid in winners:
            continue
        holder = re.search(r"process (\d+) on \S+ since .* is writing in this folder", text)
        if code != 2 or not holder or int(holder.group(1)) not in winners:
            faults.append(f"exit code {code}: {text.strip()}")
    if differing:
        faults.append("another content: " + ", ".join(differing))
    return faults


def main():
    program = os.path.abspath(sys.argv[1])
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    moments = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    failed, refused = 0, 0
    with tempfile.TemporaryDirectory(prefix="acinus_folder_") as base:
        alone = os.path.join(base, "alone")
        os.mkdir(alone)
        finish(program, alone, WHOLE)
        reference = {"whole": run_files.read_run(os.path.join(alone, "r"))}
        # A resumed run tells of its resumption, so its reference is one that was stopped at the same time.
        stopped = os.path.join(base, "stopped")
        os.mkdir(stopped)
        finish(program, stopped, HALF)
        finish(program, stopped, [*WHOLE, "--resume"])
        reference["resumed"] = run_files.read_run(os.path.join(stopped, "r"))
        for k in range(rounds):
            count, way = (2, 4, 8)[k % 3], ("new", "--resume", "--overwrite")[k // 3 % 3]
            folder = os.path.join(base, str(k))
            os.mkdir(folder)
            if way != "new":
                finish(program, folder, HALF if way == "--resume" else [*WHOLE, "--set", "seed=7"])
            words = WHOLE if way == "new" else [*WHOLE, way]
            outcomes = contend(program, folder, words, count, moments)
            differing = run_files.differences(reference["resumed" if way == "--resume" else "whole"],
                                              run_files.read_run(os.path.join(folder, "r")))
            faults = judge(outcomes, differing)
            refused += sum(code == 2 for _, _, code in outcomes)
            failed += bool(faults)
            for fault in faults:
                print(f"round {k}, {count} processes, {way}: {fault}")
    print(f"{rounds} rounds: {rounds - failed} with one process done and the same content as alone; {refused} refused")
    sys.exit(1 if failed else 0)


main()
