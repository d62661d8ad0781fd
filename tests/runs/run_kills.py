"""Kills runs at random moments and resumes them, until they are done.

usage: run_kills.py PROGRAM [KILLS] [SEED]

A spheroid grows from one cell to 24 while the process is killed again and again: half of the moments lie in its
first second, the others anywhere in the time that a whole run takes; four of five by SIGKILL, the rest by SIGTERM. A
run that has no checkpoint yet is started anew, as its message says. In the end frames, series and the checkpoint must
be those of a run that was never disturbed. Prints what happened, exit code 1 if that does not hold.
"""

import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

import run_files

WORDS = ["run", "spheroid", "--until-cells", "24", "--set", "cell_types.tumour.dcm.nodes=42", "--threads", "1", "--quiet",
         "--checkpoint-every", "0.3 s", "--out", "r"]
# A resumed run tells of its resumption; frames are compared as a reader sees them.
BUT = re.compile(rf"{run_files.OF_THE_PROCESS.pattern}|events[/@].*|state/file/events(@.*)?|state/life_totals/wall_s_at(@.*)?|"
                 r"VTKHDF/.*")


def read(folder):
    found = run_files.read_run(os.path.join(folder, "r"), BUT)
    found["run.vtkhdf"].update(run_files.read_frames(os.path.join(folder, "r", "run.vtkhdf")))
    return found


def start(program, folder, how):
    return subprocess.Popen([program, *WORDS, *how], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                            text=True)


def attempt(program, folder, how, seconds, order):
    """Ends the process after `seconds`; its exit code and what it says."""
    process = start(program, folder, how)
    try:
        process.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        process.send_signal(order)
    text = process.communicate()[1]
    return process.returncode, text


def kill_until_done(program, folder, longest, moments, count):
    """Returns what went wrong."""
    how = []
    while True:
        seconds = moments.uniform(0, 1 if moments.random() < 0.5 else longest)
        order = signal.SIGKILL if moments.random() < 0.8 else signal.SIGTERM
        code, text = attempt(program, folder, how, seconds, order)
        if code == 0:
            return []
        if code == 2 and "holds no checkpoint" in text:
            how = ["--overwrite"] if "--overwrite" in text else []
            count["anew"] += 1
            continue
        if code not in (-signal.SIGKILL, -signal.SIGTERM, 75):
            return [f"exit code {code}: {text.strip()}"]
        count["killed" if code < 0 else "stopped"] += 1
        how = ["--resume"]


def main():
    program = os.path.abspath(sys.argv[1])
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    moments = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    faults, runs = [], 0
    count = {"killed": 0, "stopped": 0, "anew": 0}
    with tempfile.TemporaryDirectory(prefix="acinus_kills_") as base:
        whole = os.path.join(base, "whole")
        os.mkdir(whole)
        begin = time.monotonic()
        process = start(program, whole, [])
        if process.wait() != 0:
            sys.exit(process.communicate()[1])
        longest = time.monotonic() - begin
        reference = read(whole)
        while count["killed"] + count["stopped"] < kills and not faults:
            folder = os.path.join(base, str(runs))
            os.mkdir(folder)
            faults = kill_until_done(program, folder, longest, moments, count)
            if not faults:
                faults = run_files.differences(reference, read(folder))
            runs += 1
    for fault in faults:
        print(f"run {runs}: {fault}")
    print(f"{runs} runs to their end: killed {count['killed']} times, stopped {count['stopped']} times, started anew "
          f"{count['anew']} times; {'NOT ' if faults else ''}the content of an undisturbed run")
    sys.exit(1 if faults else 0)


main()
