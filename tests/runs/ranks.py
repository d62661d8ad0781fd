"""One scene on any number of processes: the same state, the same run file.

usage: ranks.py PROGRAM same CASE... [--all]     every start of a case ends like that of one process
       ranks.py PROGRAM resume                   a checkpoint of three processes goes on with five and with one
       ranks.py PROGRAM kill [MOMENTS]           one process of three is killed: the others end, resume goes on
       ranks.py PROGRAM errors                   bad starts end with the right code and one message
"""

import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import run_files

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, "..", "..", "runs", "scenes")
GOLDEN = os.path.join(HERE, "..", "golden")

CASES = {
    "clump13": [os.path.join(SCENES, "clump13.json"), "--until", "20 min", "--set", "output.contacts=true"],
    "cells": [os.path.join(SCENES, "spheroid.json"), "--until-cells", "10"],
    "spheres": [os.path.join(SCENES, "spheroid_cbm.json"), "--until-cells", "300"],
    "hybrid": [os.path.join(SCENES, "lobule_hybrid.json"), "--set", "start_up.growth_time=2 h", "--set",
               "output.contacts=true", "--until", "10 min"],
    "substances": [os.path.join(GOLDEN, "substances.json"), "--until", "1 h"],
    "membranes": [os.path.join(GOLDEN, "membranes.json"), "--until", "1 h"],
    "signals": [os.path.join(GOLDEN, "signals.json"), "--until", "1 h"],
    "life": [os.path.join(GOLDEN, "hybrid_life.json")],
    "zoom": [os.path.join(GOLDEN, "moving_zoom.json")],
    "maugis_hybrid": [os.path.join(GOLDEN, "maugis_hybrid.json"), "--until", "15 min", "--set", "output.contacts=true"],
    "nucleus": [os.path.join(SCENES, "narrow_gap_nucleus.json"), "--until", "5 min"],
    "patch": [os.path.join(SCENES, "patch_box.json"), "--until", "10 min"],
    "newton": [os.path.join(SCENES, "clump13.json"), "--until", "2 min", "--set", "time.integrator=newton"],
    # Slow: the sizes of docs/developers/scaling_model.md.
    "lobule_hybrid": [os.path.join(SCENES, "lobule_hybrid.json"), "--until", "2 h"],
    "spheroid64": [os.path.join(SCENES, "spheroid.json"), "--until-cells", "64"],
    # Steps with late cells.
    "late_cells": [os.path.join(SCENES, "spheroid.json"), "--until-cells", "230", "--set", "time.tolerance=0.12 um"],
    "spheroid_cbm2000": [os.path.join(SCENES, "spheroid_cbm.json"), "--until-cells", "2000"],
    "regeneration": [os.path.join(SCENES, "regeneration.json"), "--set", "start_up.growth_time=2 h", "--set",
                     "cell_types.hepatocyte.dcm.nodes=42", "--until", "6 h"],
}
FEW = [(2, 1, "balanced"), (3, 2, "random")]
ALL = [(n, t, s) for t, s in ((1, "balanced"), (2, "random"), (2, "balanced"), (1, "random")) for n in (2, 3, 4, 5, 8)]

# Open MPI says first that it is started as root and on too few processors.
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--mca", "btl_vader_single_copy_mechanism", "none"]
# Its own memory at the end is no leak of ours.
ENVIRONMENT = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0", "OMPI_MCA_rmaps_base_oversubscribe": "1"}


def command(program, ranks, arguments):
    start = [*MPIRUN, "-n", str(ranks)] if ranks > 1 else []
    return [*start, program, "run", *arguments]


def call(program, ranks, arguments, code=0, timeout=3600):
    done = subprocess.run(command(program, ranks, arguments), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, env=ENVIRONMENT, timeout=timeout)
    if done.returncode != code:
        sys.exit(f"{ranks} processes, {' '.join(arguments)}: exit code {done.returncode}, not {code}\n{done.stdout}")
    return done.stdout


def summary(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        return json.load(file)


# Who ran it is no result; a resumed run also tells of its resumption, and its frames are compared as a reader sees
# them.
BUT = re.compile(rf"{run_files.OF_THE_PROCESS.pattern}|provenance/(ranks|threads)(@.*)?|.*wall_s_at(@.*)?")
BUT_RESUMED = re.compile(rf"{BUT.pattern}|events[/@].*|state/file/events(@.*)?|VTKHDF/.*")


def read(folder, resumed):
    found = run_files.read_run(folder, BUT_RESUMED if resumed else BUT)
    if resumed:
        found["run.vtkhdf"].update(run_files.read_frames(os.path.join(folder, "run.vtkhdf")))
    return found


def compare(one, many, what, resumed=False):
    if summary(one)["state_hash"] != summary(many)["state_hash"]:
        sys.exit(f"{what}: state {summary(many)['state_hash']}, on one process {summary(one)['state_hash']}")
    differences = run_files.differences(read(one, resumed), read(many, resumed))
    if differences:
        sys.exit(f"{what}: files differ in {', '.join(differences[:10])}")


def check_same(program, cases, starts):
    for case in cases:
        with tempfile.TemporaryDirectory() as folder:
            one = os.path.join(folder, "one")
            call(program, 1, [*CASES[case], "--out", one, "--threads", "1", "--quiet"])
            for ranks, threads, sharing in starts:
                many = os.path.join(folder, "many")
                call(program, ranks, [*CASES[case], "--out", many, "--threads", str(threads), "--sharing", sharing,
                                      "--quiet", "--overwrite"])
                start = f"{case} on {ranks} processes of {threads} threads, {sharing}"
                compare(one, many, start)
                print(f"{start}: the same", flush=True)
            print(f"{case}: {summary(one)['state_hash']} on {len(starts)} starts", flush=True)


def check_resume(program):
    alone = [*CASES["hybrid"], "--threads", "1", "--quiet"]
    case = [*alone, "--sharing", "random"]
    with tempfile.TemporaryDirectory() as folder:
        whole = os.path.join(folder, "whole")
        call(program, 1, [*alone, "--out", whole])
        part = os.path.join(folder, "part")
        # A file STOP in the folder ends the run after its next step.
        running = subprocess.Popen(command(program, 3, [*case, "--out", part]), env=ENVIRONMENT,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT)
        while not os.path.exists(os.path.join(part, "start.h5")):
            time.sleep(0.02)
            if running.poll() is not None:
                sys.exit("the run ended before it could be stopped")
        open(os.path.join(part, "STOP"), "w").close()
        if running.wait(timeout=300) != 75:
            sys.exit(f"exit code {running.returncode} after STOP, not 75")
        for ranks in (5, 1):
            again = os.path.join(folder, f"again{ranks}")
            shutil.copytree(part, again)
            call(program, ranks, [*(case if ranks > 1 else alone), "--out", again, "--resume"])
            compare(whole, again, f"stopped on 3 processes, resumed on {ranks}", resumed=True)
    print("stopped on 3 processes, resumed on 5 and on 1: as never stopped")


def children(pid):
    found = []
    for name in os.listdir("/proc"):
        if not name.isdigit():
            continue
        try:
            with open(f"/proc/{name}/stat") as file:
                fields = file.read().rsplit(")", 1)[1].split()
            if int(fields[1]) == pid:
                found.append(int(name))
        except OSError:
            pass
    return found


def is_alive(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            return file.read().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def check_kills(program, moments):
    draw = random.Random(1)
    case = [*CASES["hybrid"], "--set", "output.every=1 min", "--threads", "1", "--quiet", "--checkpoint-every", "0.2s"]
    with tempfile.TemporaryDirectory() as folder:
        whole = os.path.join(folder, "whole")
        begun = time.time()
        call(program, 3, [*case, "--out", whole])
        length = time.time() - begun
        slowest, resumed = 0, 0
        for moment in range(moments):
            part = os.path.join(folder, "part")
            shutil.rmtree(part, ignore_errors=True)
            running = subprocess.Popen(command(program, 3, [*case, "--out", part]), env=ENVIRONMENT,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT)
            time.sleep(draw.uniform(0.3, length))
            ranks = children(running.pid)
            if ranks:
                os.kill(draw.choice(ranks), signal.SIGKILL)
            begun = time.time()
            running.wait(timeout=60)
            while any(is_alive(rank) for rank in ranks):
                if time.time() - begun > 30:
                    sys.exit(f"moment {moment}: processes {ranks} live on 30 s after the kill")
                time.sleep(0.01)
            slowest = max(slowest, time.time() - begun)
            if not os.path.exists(os.path.join(part, "checkpoint.h5")):
                continue
            call(program, draw.choice((1, 2, 3)), [*case, "--out", part, "--resume"])
            compare(whole, part, f"killed at moment {moment} and resumed", resumed=True)
            resumed += 1
    print(f"{moments} kills: the others ended within {slowest:.1f} s; {resumed} runs resumed like one never killed")


def check_errors(program):
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "run")

        def expect(ranks, arguments, code, pattern, start=None):
            done = subprocess.run((start or [*MPIRUN, "-n", str(ranks)]) + [program, *arguments], cwd=folder,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=ENVIRONMENT,
                                  timeout=120)
            said = len(re.findall(pattern, done.stdout))
            if done.returncode != code or said != 1:
                sys.exit(f"{arguments}: exit code {done.returncode}, not {code}; said {said} times:\n{done.stdout}")

        expect(2, ["run", "no_such_scene", "--out", out], 4, "no_such_scene: ")
        expect(2, ["run"], 2, "SCENE is required")
        expect(2, ["list"], 2, "start it without mpirun")
        os.mkdir(os.path.join(folder, "here"))
        open(os.path.join(folder, "here", "run.vtkhdf"), "w").close()
        expect(2, ["run", "two_cells", "--out", os.path.join(folder, "here")], 2, "holds the results of an earlier run")
        expect(2, ["run", "clump13", "--out", out, "--max-memory", "0.1MB"], 2, "of memory in every process where")
        # As if started by a launcher that this MPI does not know: PMI of MPICH, srun without --mpi.
        for name in ("PMI_SIZE", "SLURM_STEP_NUM_TASKS"):
            expect(1, ["run", "two_cells", "--out", out], 3, "one of 4 processes that were started together",
                   ["env", f"{name}=4"])
        scene = os.path.join(folder, "scene.json")
        shutil.copy(os.path.join(SCENES, "two_cells.json"), scene)
        expect(2, ["run", scene, "--out", out], 2, "process 1 of 2 has another scene",
               [*MPIRUN, "-n", "1", program, "run", scene, "--set", "seed=2", "--out", out, ":", "-n", "1"])
        call(program, 2, [scene, "--until", "1 min", "--out", out, "--threads", "1"])
        text = call(program, 2, [scene, "--until", "1 min", "--out", out, "--overwrite", "--threads", "1"])
        if "too few cells to share" not in text or "2 processes of 1 thread" not in text:
            sys.exit(f"nothing is said of too few cells and of threads:\n{text}")
        text = call(program, 2, [scene, "--until", "1 min", "--out", out, "--overwrite", "--threads", "64"])
        if "processors are taken more than once: 128 threads" not in text:
            sys.exit(f"nothing is said of crowded processors:\n{text}")
    print("bad starts: each with its code and one message")


def main():
    program, what, *rest = sys.argv[1:]
    program = os.path.abspath(program)
    if shutil.which("mpirun") is None:
        print("no mpirun: skipped")
        sys.exit(77)
    if what == "same":
        check_same(program, [c for c in rest if c != "--all"], ALL if "--all" in rest else FEW)
    elif what == "resume":
        check_resume(program)
    elif what == "kill":
        check_kills(program, int(rest[0]) if rest else 20)
    else:
        check_errors(program)


if __name__ == "__main__":
    main()
