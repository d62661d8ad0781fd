"""Infers the force of the leading cells of a lesion twenty times, and once more with ten kills.

usage: leader_force.py PROGRAM [--out DIR] [--repetitions N] [--jobs N]

A wedge of a lobule of 60 spheres closes its lesion. Each repetition has a curve of its own: one run with the known
force and a seed that no inference uses, and noise. The reference is a dense scan of the force with 20 seeds a value:
the share of (run, noise) within the last tolerance of the same distance, times the prior. Its limit without a
tolerance is the exact posterior. Exit code 1 if the interval from 5 to 95 % holds the force in fewer than 17 of 20
repetitions, if it is on average more than 1.2 times as wide as either of these, or if kills change the posterior. With --out the work is resumed: repetitions that are in results.csv are not repeated.
"""

import argparse
import csv
import json
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np

FORCE, LOW, HIGH = 0.45, 0.05, 2.0  # nN
HOURS, NOISE, OBSERVABLE = [12, 24], 0.02, "lesion_area_flooded"
SCENE = {
    "model": "cbm", "time.end": "24 h", "output.every": "12 h", "start_up.growth_time": "2 h",
    "lobule.height": "48 um", "lobule.cells": 60,
    "cell_types.hepatocyte.cbm.ecm_friction": "1e8 N s/m^3", "friction.cbm_cbm": "5e10 N s/m^3",
}
INFERENCE = {"particles": 50, "populations": 3, "quantile": 0.4}
SCANNED, SEEDS, DRAWS = 31, 20, 400  # forces, runs of each, noises of each run


def write_json(path, value):
    with open(path, "w") as file:
        json.dump(value, file, indent=1)


def call(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\nexit code {done.returncode}\n{done.stdout}")


def study(program, folder, name, jobs, forces, seeds):
    """Runs all forces with all seeds; returns their curves as [force, seed, time]."""
    kept = os.path.join(folder, name + ".csv")
    if not os.path.exists(kept):
        file, out = os.path.join(folder, name + ".json"), os.path.join(folder, name + ".study")
        variants = {f"f{k}": {"set": {"motility.leader_force": f"{f:.9g} nN"}} for k, f in enumerate(forces)}
        write_json(file, {"name": name, "scene": "regeneration", "set": SCENE, "seeds": seeds, "variants": variants,
                          "observables": [OBSERVABLE]})
        call([program, "study", file, "--out", out, "--jobs", str(jobs), "--quiet"])
        shutil.copy(os.path.join(out, "table.csv"), kept)
        shutil.rmtree(out)
    curves = np.full((len(forces), len(seeds), len(HOURS)), np.nan)
    with open(kept) as file:
        for row in csv.DictReader(file):
            hours = float(row["time_s"]) / 3600
            if row["observable"] == OBSERVABLE and hours in HOURS:
                at = int(row["variant"].removeprefix("f")), seeds.index(int(row["seed"])), HOURS.index(hours)
                curves[at] = float(row["value"])
    if np.isnan(curves).any():
        sys.exit(f"{kept}: values are missing")
    return curves


def write_target(path, curve):
    with open(path, "w") as file:
        file.write("time_h,observable,value,sd\n")
        for hour, value in zip(HOURS, curve):
            file.write(f"{hour},{OBSERVABLE},{value:.9g},{NOISE}\n")


def interval(values, weights):
    """Values at 5 and 95 % of the weights, which lie in the middle of their shares."""
    order = np.argsort(values)
    share = np.cumsum(weights[order]) - weights[order] / 2
    return np.interp([0.05, 0.95], share / weights.sum(), values[order])


def read_posterior(out):
    with open(os.path.join(out, "posterior.csv")) as file:
        rows = list(csv.reader(file))[1:]
    with open(os.path.join(out, "populations.csv")) as file:
        populations = list(csv.DictReader(file))
    low, high = interval(np.log([float(r[3]) for r in rows]), np.array([float(r[1]) for r in rows]))
    return low, high, float(populations[-1]["tolerance"]), sum(int(p["simulations"]) for p in populations)


def reference(forces, scan, curve, tolerance):
    """Widths of ln force: from the share within the tolerance, and from the likelihood."""
    noise = np.random.default_rng(3).normal(0, 1, (DRAWS, 1, 1, len(HOURS)))
    apart = (scan - curve) / NOISE
    near = np.sqrt(((apart + noise) ** 2).mean(axis=-1)) <= tolerance
    widths = []
    for weight in (near.mean(axis=(0, 2)), np.exp(-0.5 * (apart ** 2).sum(axis=-1)).mean(axis=1)):
        fine = np.linspace(math.log(LOW), math.log(HIGH), 2001)  # linear between the scanned forces
        low, high = interval(fine, np.interp(fine, np.log(forces), weight))
        widths.append(high - low)
    return widths


def write_inference(folder, number):
    path = os.path.join(folder, f"force{number}.json")
    write_json(path, {"scene": "regeneration", "set": SCENE, "seed": number, "target": f"target{number}.csv",
                      "parameters": [{"key": "motility.leader_force", "prior": "log_uniform", "low": f"{LOW} nN",
                                      "high": f"{HIGH} nN"}], **INFERENCE})
    return path


def kill_often(command, kills):
    """Kills an inference at random moments until it ends by itself; returns the number of kills."""
    moments, hits = random.Random(7), 0
    while True:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            code = process.wait(moments.uniform(1, 8) if hits < kills else None)
            if code != 0:
                sys.exit(f"exit code {code} after {hits} kills")
            return hits
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            hits += 1


def read_file(path):
    with open(path, "rb") as file:
        return file.read()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--out")
    parser.add_argument("--repetitions", type=int, default=20)
    parser.add_argument("--jobs", type=int, default=1)
    a = parser.parse_args()
    program, folder = os.path.abspath(a.program), a.out or tempfile.mkdtemp()
    os.makedirs(folder, exist_ok=True)
    forces = np.geomspace(LOW, HIGH, SCANNED)
    scan = study(program, folder, "scan", a.jobs, forces, list(range(1, SEEDS + 1)))
    made = study(program, folder, "made", a.jobs, [FORCE], list(range(1001, 1021)))[0]
    results = os.path.join(folder, "results.csv")
    done = {}
    if os.path.exists(results):
        with open(results) as file:
            done = {int(row["repetition"]): row for row in csv.DictReader(file)}
    for number in range(1, a.repetitions + 1):
        if number in done:
            continue
        started = time.time()
        curve = made[number - 1] + np.random.default_rng(number).normal(0, NOISE, len(HOURS))
        write_target(os.path.join(folder, f"target{number}.csv"), curve)
        out = os.path.join(folder, f"force{number}.infer")
        command = [program, "infer", write_inference(folder, number), "--out", out, "--jobs", str(a.jobs), "--quiet"]
        call(command)
        same = ""
        if number == 1:
            kills = kill_often([*command[:4], out + "2", *command[5:]], 10)
            files = [read_file(os.path.join(o, f)) for o in (out, out + "2") for f in ("posterior.csv", "simulations.csv")]
            same = f"{'same' if files[:2] == files[2:] else 'other'} after {kills} kills"
            shutil.rmtree(out + "2")
        low, high, tolerance, simulations = read_posterior(out)
        near, exact = reference(forces, scan, curve, tolerance)
        row = {"repetition": number, "low_nN": f"{math.exp(low):.4f}", "high_nN": f"{math.exp(high):.4f}",
               "width": f"{high - low:.4f}", "reference": f"{near:.4f}", "exact": f"{exact:.4f}",
               "tolerance": f"{tolerance:.3f}", "simulations": simulations, "seconds": f"{time.time() - started:.0f}",
               "kills": same}
        with open(results, "a") as file:
            writer = csv.DictWriter(file, row)
            if not done:
                writer.writeheader()
            writer.writerow(row)
        done[number] = {k: str(v) for k, v in row.items()}
        print(", ".join(f"{k} {v}" for k, v in row.items()), flush=True)
        shutil.rmtree(out)
    rows = list(done.values())
    inside = sum(float(r["low_nN"]) <= FORCE <= float(r["high_nN"]) for r in rows)
    width, near, exact = (np.mean([float(r[k]) for r in rows]) for k in ("width", "reference", "exact"))
    print(f"{FORCE} nN inside the interval in {inside} of {len(rows)}; width of ln force {width:.3f}, "
          f"reference {near:.3f}, exact {exact:.3f}")
    killed = all(r["kills"] in ("", "same after 10 kills") for r in rows)
    if not a.out:
        shutil.rmtree(folder)
    return 0 if inside >= 0.85 * len(rows) and width <= 1.2 * min(near, exact) and killed else 1


if __name__ == "__main__":
    sys.exit(main())
