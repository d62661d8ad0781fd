"""Kills a study at random moments and starts it again, until it is done.

usage: study_kills.py PROGRAM [KILLS] [SEED]

Runs a small lobule study undisturbed with one job and with two, then killed KILLS times by SIGKILL and KILLS
times by SIGTERM (2 jobs). table.csv and table.h5 must be the same bytes every time; prints what happened, exit
code 1 if they are not.
"""

import os
import random
import signal
import subprocess
import sys
import tempfile
import time

STUDY = """{
  "name": "kills",
  "scene": "lobule_hybrid",
  "set": {
    "time.end": "16 h", "output.every": "30 min", "cell_types.hepatocyte.dcm.nodes": 42,
    "lobule.radius": "150 um", "lobule.lesion_radius": "70 um", "lobule.height": "24 um", "lobule.cells": 16,
    "start_up.growth_time": "2 h", "start_up.max_duration": "30 min",
    "zoom": [ { "kind": "axis_distance", "min_distance": "0 um", "max_distance": "110 um" } ]
  },
  "seeds": [1, 2],
  "variants": {
    "hybrid": {},
    "pulled": { "start": "hybrid", "set": { "motility.leader_force": "0.6 nN" } },
    "spheres": { "set": { "cells.model": "cbm", "zoom": [] } }
  }
}
"""


def start(program, file, out, jobs):
    command = [program, "study", file, "--out", out, "--jobs", str(jobs), "--checkpoint-every", "1 s"]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def finish(program, file, out, jobs):
    process = start(program, file, out, jobs)
    text = process.communicate()[0]
    if process.returncode != 0:
        sys.exit(f"{out}: exit code {process.returncode}\n{text}")


def read(out):
    tables = []
    for name in ("table.csv", "table.h5"):
        with open(os.path.join(out, name), "rb") as file:
            tables.append(file.read())
    return tables


def kill_often(program, file, out, kills, how, longest, moments):
    """Kills the study `kills` times; each attempt is given up to `longest` seconds before."""
    hits = 0
    while hits < kills:
        process = start(program, file, out, 2)
        try:
            process.wait(moments.uniform(0.05, longest))
        except subprocess.TimeoutExpired:
            process.send_signal(how)
            process.wait()
            hits += 1
            continue
        # It was done before its moment came: begin anew, the kills that count are those that hit.
        if process.returncode != 0:
            sys.exit(f"{out}: exit code {process.returncode}\n{process.stdout.read()}")
        return hits
    return hits


def main():
    program = os.path.abspath(sys.argv[1])
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 10
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    moments = random.Random(seed)
    same = True
    with tempfile.TemporaryDirectory(prefix="acinus_kills_") as folder:
        file = os.path.join(folder, "kills.json")
        with open(file, "w", encoding="utf-8") as out:
            out.write(STUDY)
        began = time.monotonic()
        finish(program, file, os.path.join(folder, "one"), 1)
        took = time.monotonic() - began
        finish(program, file, os.path.join(folder, "two"), 2)
        reference = read(os.path.join(folder, "one"))
        print(f"undisturbed, 1 job: {took:.0f} s, table.csv {len(reference[0])} bytes")
        same = same and read(os.path.join(folder, "two")) == reference
        print(f"2 jobs: {'the same table' if same else 'ANOTHER TABLE'}")
        for how in (signal.SIGKILL, signal.SIGTERM):
            hits, rounds = 0, 0
            while hits < kills:
                out = os.path.join(folder, f"{how.name}_{rounds}")
                hits += kill_often(program, file, out, kills - hits, how, took / 4, moments)
                rounds += 1
                finish(program, file, out, 2)
                equal = read(out) == reference
                same = same and equal
                print(f"{how.name}: {hits} kills so far, {'the same table' if equal else 'ANOTHER TABLE'}")
    sys.exit(0 if same else 1)


main()
