"""Compares final states with those recorded in golden.json, bit for bit.

usage: golden.py PROGRAM CASE [--record]

Runs one case with 1 and with 2 threads. Prints the hash of the state (of a calibration: of its law) and what is
recorded; exit code 1 if they differ, 77 if nothing is recorded for this machine's instruction set. A change that
means to alter results records them again with --record, in a commit of its own that says why.
"""

import hashlib
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, "..", "..", "runs", "scenes")

# What is run and how far: some seconds each.
CASES = {
    "two_cells": ["two_cells.json"],
    "clump13": ["clump13.json", "--until", "1 h"],
    "lobule_hybrid": ["lobule_hybrid.json", "--set", "start_up.growth_time=2 h", "--until", "20 min"],
    "lobule_rest": ["lobule_rest.json", "--set", "start_up.growth_time=2 h", "--set",
                    "cell_types.hepatocyte.dcm.nodes=42", "--until", "70 min"],
    "vessel_file": ["vessel_file.json", "--until", "20 min"],
    "flexible_vessels": ["vessel_file.json", "--set", "vessels.flexible=true", "--set", "vessels.spacing=10 um", "--set",
                         "vessels.pressure=100 Pa", "--until", "20 min"],
    "vessel_surface": ["vessel_file.json", "--set", "vessels.contact=mesh", "--until", "20 min"],
    "spheroid": ["spheroid.json", "--until-cells", "24"],
    "spheroid_cbm": ["spheroid_cbm.json", "--until-cells", "500"],
    "monolayer_type2": ["monolayer_type2.json", "--until-cells", "20"],
    "patch_box": ["patch_box.json", "--until", "30 min"],
    "relaxation_capsule": ["relaxation_capsule.json", "--until", "5 min"],
    "regeneration": ["regeneration.json", "--set", "start_up.growth_time=2 h", "--set",
                     "cell_types.hepatocyte.dcm.nodes=42", "--until", "6 h"],
    "regeneration_cbm": ["regeneration.json", "--set", "model=cbm", "--until", "2 d"],
    "narrow_gap_nucleus": ["narrow_gap_nucleus.json", "--until", "20 min"],
    "optical_stretcher_flow": ["optical_stretcher_flow.json"],
    "pull_off_spring": ["pull_off_spring.json", "--until", "300 s"],
    "maugis_dugdale": ["adhering_pair.json", "--set", "contact.law=maugis-dugdale", "--until", "20 s"],
    "maugis_hybrid": [os.path.join(HERE, "maugis_hybrid.json")],
    "maugis_vessels": ["vessel_file.json", "--set", "contact.law=maugis-dugdale", "--set", "contact.quadrature=3-point", "--set",
                       "vessels.contact=mesh", "--until", "5 min"],
    "hybrid_life": [os.path.join(HERE, "hybrid_life.json")],
    "moving_zoom": [os.path.join(HERE, "moving_zoom.json")],
    "substances": [os.path.join(HERE, "substances.json")],
    "signals": [os.path.join(HERE, "signals.json")],
    "regeneration_morphogen": ["regeneration_morphogen.json", "--set", "model=cbm", "--until", "12 h"],
    "calibration": [os.path.join(HERE, "calibration.json")],
}


def call(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\nexit code {done.returncode}\n{done.stdout}")


def hash_of_law(path):
    """Of the numbers of a law; the file also says when, where and how fast it was made."""
    with open(path) as file:
        law = json.load(file)
    numbers = {key: law[key] for key in ("a0_kPa", "a1_kPa", "power", "table", "wall_recess") if key in law}
    return hashlib.sha256(json.dumps(numbers, sort_keys=True).encode()).hexdigest()[:16]


def result(program, case, threads, folder):
    """Hash and instruction set."""
    arguments = CASES[case]
    scene = arguments[0] if os.path.isabs(arguments[0]) else os.path.join(SCENES, arguments[0])
    if case == "calibration":
        law = os.path.join(folder, "law.json")
        call([program, "calibrate", scene, "--out", law, "--no-relaxation", "--threads", str(threads)])
        for root, _, files in os.walk(folder):
            if "summary.json" in files:
                with open(os.path.join(root, "summary.json")) as file:
                    return hash_of_law(law), json.load(file)["instruction_set"]
        sys.exit("the calibration left no run")
    out = os.path.join(folder, "run")
    call([program, "run", scene, *arguments[1:], "--out", out, "--threads", str(threads), "--quiet"])
    with open(os.path.join(out, "summary.json")) as file:
        summary = json.load(file)
    return summary["state_hash"], summary["instruction_set"]


def main():
    program, case, record = os.path.abspath(sys.argv[1]), sys.argv[2], "--record" in sys.argv
    table = os.path.join(HERE, "golden.json")
    with open(table) as file:
        recorded = json.load(file)
    found = {}
    for threads in (1, 2):
        with tempfile.TemporaryDirectory() as folder:
            found[threads], instruction_set = result(program, case, threads, folder)
    if found[1] != found[2]:
        sys.exit(f"{case}: {found[1]} with one thread, {found[2]} with two")
    expected = recorded.get(instruction_set, {}).get(case)
    print(f"{case} ({instruction_set}): {found[1]}, recorded: {expected}")
    if record:
        recorded.setdefault(instruction_set, {})[case] = found[1]
        with open(table, "w") as file:
            json.dump(recorded, file, indent=2, sort_keys=True)
            file.write("\n")
    elif expected is None:
        sys.exit(77)
    elif expected != found[1]:
        sys.exit(f"{case}: not the recorded state")


main()
