"""A month of a small lobule with growth, death and sleep, run through and with up to ten stops: the same bits.

usage: month.py PROGRAM [WALL]

WALL: seconds after which each of the ten parts stops itself (default: a twelfth of the run that goes through). Runs
the scene tests/data/month.json with deformable cells near the lesion and spheres elsewhere. Prints cells, births,
deaths, overlap, the largest memory in the first third and in the whole month, and both states; exit code 1 if they
differ, a run fails, or memory grew by a tenth more than the largest number of deformable cells did.
"""

import json
import os
import subprocess
import sys
import tempfile

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "month.json")
STOPPED = 75


def run(program, out, *more):
    command = [program, "run", SCENE, "--out", out, "--threads", "1", "--quiet", *more]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode not in (0, STOPPED):
        sys.exit(f"{' '.join(command)}\nexit code {done.returncode}\n{done.stdout}")
    with open(os.path.join(out, "summary.json")) as file:
        return done.returncode, json.load(file)


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        _, third = run(program, os.path.join(folder, "third"), "--until", "240 h")
        _, through = run(program, os.path.join(folder, "through"))
        wall = sys.argv[2] if len(sys.argv) > 2 else f"{through['wall_s'] / 12:.1f}"
        stopped = os.path.join(folder, "stopped")
        code, after = run(program, stopped, "--max-walltime", f"{wall} s")
        stops = []
        while code == STOPPED:
            stops.append(round(after["simulated_s"] / 3600, 1))
            limit = ["--max-walltime", f"{wall} s"] if len(stops) < 10 else []
            code, after = run(program, stopped, "--resume", *limit)
        cells = through["cells"]
        print(f"{cells['start']} cells, {cells['end']} at the end, {cells['divisions']} divisions, "
              f"{cells['deaths']} deaths; overlap at most {through['max_penetration_um']:.2f} um")
        memory = [s["peak_rss_bytes"] / 1e6 for s in (third, through)]
        most = [max(s["measures"]["cells_dcm"]) for s in (third, through)]
        print(f"memory {memory[0]:.1f} MB in the first third with up to {most[0]:.0f} deformable cells, "
              f"{memory[1]:.1f} MB in the month with up to {most[1]:.0f}")
        print(f"stopped at {stops} h: {after['state_hash']}, run through: {through['state_hash']}")
        if after["state_hash"] != through["state_hash"] or len(stops) < 5:
            sys.exit("the stopped run ends otherwise, or stopped too seldom to say")
        if memory[1] / most[1] > 1.1 * memory[0] / most[0]:
            sys.exit("memory grows")


main()
