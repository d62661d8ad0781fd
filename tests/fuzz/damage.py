"""Changed scenes, changed files beside scenes and damaged run folders, met through the program.

usage: damage.py PROGRAM [--scenes N] [--files N] [--folders N] [--seed S] [--keep DIR]

scenes   shipped scenes with keys removed, doubled, renamed or given other values, or with bytes changed: `check`, and where that
         accepts one, `run` for a few steps.
files    the network, the law and the mesh of a scene with bytes changed: `check`.
folders  a stopped run of a hybrid scene in which a file was damaged, cut, emptied, removed or exchanged: `run --resume`. A run
         that goes on without a warning must end in the state of a run whose folder was left alone.
No process may crash, end with exit code 1, run longer than ten seconds of CPU time or use more than 2 GB. Meant for a program built
with sanitizers (build-asan/acinus). What goes wrong is kept in DIR (default: damage). Prints counts, exit code 1 if anything did.
"""

import argparse
import collections
import json
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES, DATA = os.path.join(HERE, "..", "..", "runs", "scenes"), os.path.join(HERE, "..", "data", "files")
sys.path.insert(0, os.path.join(HERE, "..", "runs"))
import run_files

LONGEST, LARGEST = 10, 2 << 30  # s of CPU, bytes
HARD = ["1e999", "-1", "0", "1e-320", "18446744073709551616", "-0.0", '"1e95 J/m^2"', "null", "[]", "{}", '""', "true",
        "2147483648", '"nan"', '"-3 um"', '"1e300 um"', '"0 um"', '"1e-30 s"', '"auto"', "1e10", '"none"', '[1, 2, 3]']


class Trial:
    """One call of the program: how it ended, what it said, what it used."""

    def __init__(self, program, words, folder):
        with tempfile.TemporaryFile() as output:
            process = subprocess.Popen([program, *words], cwd=folder, stdout=output, stderr=output,
                                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (3 * LONGEST, 3 * LONGEST)))
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            output.seek(0)
            self.text = output.read().decode(errors="replace")
        self.code, self.cpu, self.memory = process.returncode, used.ru_utime + used.ru_stime, 1024 * used.ru_maxrss

    def fault(self, allowed):
        if "Sanitizer" in self.text or "runtime error:" in self.text:
            return "a sanitizer's report"
        if self.code not in allowed:
            return f"exit code {self.code}"
        if self.cpu > LONGEST:
            return f"{self.cpu:.0f} s of CPU"
        if self.memory > LARGEST:
            return f"{self.memory >> 20} MB"
        return None


def change_bytes(data, rng):
    """As disks, editors and transfers do: bits turned over, bytes lost, doubled or cut off."""
    data = bytearray(data)
    for _ in range(rng.randint(1, 3)):
        at, n = rng.randrange(len(data) + 1), rng.choice([1, 1, 4, 16, 512])
        way = rng.randrange(5)
        if way == 0 and at < len(data):
            data[at] ^= 1 << rng.randrange(8)
        elif way == 1:
            del data[at:at + n]
        elif way == 2:
            data[at:at] = data[at:at + n]
        elif way == 3:
            data[at:at + n] = bytes(rng.randrange(256) for _ in range(min(n, len(data) - at)))
        elif way == 4 and rng.random() < 0.3:
            del data[at:]
    return bytes(data)


def change_numbers(text, rng):
    """Puts values that are hard to bear in the place of numbers."""
    digits = [k for k, c in enumerate(text) if c.isdigit()]
    for _ in range(rng.randint(1, 3)):
        if not digits:
            break
        at = rng.choice(digits)
        end = at
        while end < len(text) and text[end] in "0123456789.eE+-":
            end += 1
        text = text[:at] + rng.choice(HARD).strip('"') + text[end:]
        digits = [k for k, c in enumerate(text) if c.isdigit()]
    return text


def nodes_of(value, path=()):
    yield path
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in items:
        yield from nodes_of(part, (*path, key))


def change_scene(text, resolved, rng):
    """The text as it is shipped in its bytes and numbers, the scene with every default in its keys and values."""
    if rng.random() < 0.2:
        return change_bytes(text.encode(), rng)
    if rng.random() < 0.2:
        return change_numbers(text, rng).encode()
    scene = json.loads(resolved)
    for _ in range(rng.randint(1, 4)):
        paths = [p for p in nodes_of(scene) if p]
        if not paths:
            break
        *way, key = rng.choice(paths)
        place = scene
        for step in way:
            place = place[step]
        change = rng.randrange(6)
        if change == 0:
            del place[key]
        elif change == 1 and isinstance(place, dict):
            place[key + "x"] = place.pop(key)
        elif change == 2 and isinstance(place, list):
            place.insert(key, place[key])
        elif change == 3 and isinstance(place[key], str) and " " in place[key]:
            number, unit = place[key].split(" ", 1)
            place[key] = rng.choice([f"-{number} {unit}", f"{number}e6 {unit}", f"{number}e-6 {unit}", number, f"{number} kg"])
        elif change == 4 and isinstance(place[key], (int, float)):
            place[key] = rng.choice([-place[key], 1e6 * place[key], 1e-6 * place[key], place[key] + 1])
        else:
            place[key] = json.loads(rng.choice([h for h in HARD if h != "1e999"]))
    return json.dumps(scene).encode()


class Campaign:
    def __init__(self, program, keep, seed):
        self.program, self.keep, self.rng = program, keep, random.Random(seed)
        self.count, self.faults = collections.Counter(), 0

    def blame(self, kind, number, fault, folder, text):
        self.faults += 1
        place = os.path.join(self.keep, f"{kind}_{number}")
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(folder, place)
        with open(os.path.join(place, "said.txt"), "w") as file:
            file.write(text)
        print(f"{kind} {number}: {fault}", flush=True)

    def call(self, kind, number, folder, words, allowed):
        trial = Trial(self.program, words, folder)
        fault = trial.fault(allowed)
        if fault:
            self.blame(kind, number, fault, folder, trial.text)
        self.count[f"{kind}: {words[0]} ended with {trial.code}"] += 1
        return trial

    def scene(self, number, texts):
        text, resolved = self.rng.choice(texts)
        with tempfile.TemporaryDirectory(prefix="acinus_damage_") as folder:
            shutil.copy(os.path.join(SCENES, "capillaries.vtk"), folder)
            with open(os.path.join(folder, "scene.json"), "wb") as file:
                file.write(change_scene(text, resolved, self.rng))
            checked = self.call("scene", number, folder, ["check", "scene.json", "--max-walltime", "8 s"], (0, 2, 75))
            if checked.code == 0:
                self.call("scene", number, folder,
                          ["run", "scene.json", "--out", "r", "--threads", "1", "--quiet", "--max-walltime", "0.5 s"],
                          (0, 2, 3, 75))

    def file(self, number, base):
        with tempfile.TemporaryDirectory(prefix="acinus_damage_") as folder:
            name = self.rng.choice(sorted(n for n in os.listdir(base) if not n.endswith(".scene")))
            shutil.copy(os.path.join(base, name + ".scene"), os.path.join(folder, "scene.json"))
            with open(os.path.join(base, name), "rb") as file:
                data = file.read()
            text = self.rng.random() < 0.5
            with open(os.path.join(folder, name), "wb") as file:
                file.write(change_numbers(data.decode("latin-1"), self.rng).encode("latin-1") if text else change_bytes(data, self.rng))
            self.call("file", number, folder, ["check", "scene.json", "--max-walltime", "8 s"], (0, 2, 4, 75))

    def folder(self, number, stopped, whole):
        with tempfile.TemporaryDirectory(prefix="acinus_damage_") as folder:
            run = os.path.join(folder, "r")
            shutil.copytree(stopped, run)
            damage = damage_folder(run, self.rng)
            trial = self.call("folder", number, folder, [*RUN, "--resume"], (0, 2, 4))
            if trial.code != 0:
                return
            with open(os.path.join(run, "summary.json")) as file:
                summary = json.load(file)
            try:
                frames = run_files.read_frames(os.path.join(run, "run.vtkhdf"))
            except (OSError, KeyError, ValueError) as error:
                frames = None
                self.blame("folder", number, f"{damage}: the run file cannot be read: {error}", folder, trial.text)
            told = bool(summary.get("warnings"))
            self.count["folder: resumed " + ("with a warning" if told else "and nothing was lost")] += 1
            if summary["state_hash"] != whole["state"]:
                self.blame("folder", number, f"{damage}: another state", folder, trial.text)
            elif frames != whole["frames"] and not told:
                self.blame("folder", number, f"{damage}: other frames, no warning", folder, trial.text)


def damage_folder(run, rng):
    """One kind of damage to one file; says which."""
    name = rng.choice([n for n in os.listdir(run) if n != "run.lock"] + 3 * ["run.vtkhdf", "checkpoint.h5"])
    path = os.path.join(run, name)
    with open(path, "rb") as file:
        data = bytearray(file.read())
    way = rng.choice(["bit", "bit", "bit", "block", "cut", "empty", "removed", "zeros", "appended"])
    at = rng.randrange(max(len(data), 1))
    if way == "removed":
        os.remove(path)
        return f"{name} removed"
    if way == "bit" and data:
        data[at] ^= 1 << rng.randrange(8)
    elif way == "block":
        data[at:at + 4096] = bytes(rng.randrange(256) for _ in range(len(data[at:at + 4096])))
    elif way == "cut":
        del data[at:]
    elif way == "empty":
        data.clear()
    elif way == "zeros":
        data[at:at + 4096] = bytes(len(data[at:at + 4096]))
    elif way == "appended":
        data += bytes(rng.randrange(256) for _ in range(100))
    with open(path, "wb") as file:
        file.write(data)
    return f"{name}: {way} at {at}"


RUN = ["run", "two_cells", "--set", "cell_types.hepatocyte.dcm.nodes=42", "--set", "output.every=10 min", "--threads", "1",
       "--quiet", "--out", "r"]


def call(program, words, folder="."):
    done = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{words}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def read_scenes(program):
    """Shipped scenes as they are and with every default."""
    texts = []
    for name in sorted(os.listdir(SCENES)):
        if name.endswith(".json"):
            path = os.path.join(SCENES, name)
            with open(path) as file:
                texts.append((file.read(), call(program, ["check", path, "--resolved"])))
    return texts


def make_files(program, base):
    """Files that scenes name, each with a scene that names it."""
    pair = """{ "name": "pair", "time": { "end": "1 min" }, "cell_types": { "a": { "radius": "6 um", "cbm": %s } },
  "cells": { "model": "cbm", "source": "list", "list": [ { "position": ["0 um", "0 um", "0 um"] } ] }%s }"""
    scenes = {}
    with open(os.path.join(base, "tree.swc"), "w") as file:
        file.write("# id type x y z radius parent\n")
        file.writelines(f"{k} 2 {20 * k} {k % 3} 40 {4 + k % 2}.5 {k - 1 if k > 1 else -1}\n" for k in range(1, 12))
    for name in ("capillaries.vtk", "tree.swc"):
        scenes[name] = pair % ("{}", ', "vessels": { "file": "%s" }' % name)
    scenes["aggregate.vtk"] = pair % (
        "{}", ', "static_meshes": [ { "file": "aggregate.vtk", "shift": ["9 cm", "0 um", "0 um"] } ]')
    for name in [n for n in scenes if n.endswith(".vtk")]:
        shutil.copy(os.path.join(DATA, name), base)
    call(os.path.join(os.path.dirname(program), "tests", "fuzz_replay"), ["--seeds", "law", base])
    scenes["law.json"] = pair % ('{ "stiffness_correction": "law.json" }', "")
    for name, text in scenes.items():
        scene = os.path.join(base, name + ".scene")
        with open(scene, "w") as file:
            file.write(text)
        call(program, ["check", scene])


def make_run(program, base):
    """A run stopped half way; what the whole one ends with."""
    for folder in ("whole", "stopped"):
        os.mkdir(os.path.join(base, folder))
    call(program, [*RUN, "--until", "1 h"], os.path.join(base, "stopped"))
    call(program, [*RUN, "--until", "1 h"], os.path.join(base, "whole"))
    call(program, [*RUN, "--resume"], os.path.join(base, "whole"))
    run = os.path.join(base, "whole", "r")
    with open(os.path.join(run, "summary.json")) as file:
        state = json.load(file)["state_hash"]
    return os.path.join(base, "stopped", "r"), {"state": state,
                                                "frames": run_files.read_frames(os.path.join(run, "run.vtkhdf"))}


def main():
    words = argparse.ArgumentParser(usage=__doc__)
    words.add_argument("program", type=os.path.abspath)
    for kind in ("scenes", "files", "folders"):
        words.add_argument(f"--{kind}", type=int, default=0)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--keep", default="damage")
    given = words.parse_args()
    campaign = Campaign(given.program, given.keep, given.seed)
    with tempfile.TemporaryDirectory(prefix="acinus_damage_") as base:
        if given.scenes:
            texts = read_scenes(given.program)
            for k in range(given.scenes):
                campaign.scene(k, texts)
        if given.files:
            files = os.path.join(base, "files")
            os.mkdir(files)
            make_files(given.program, files)
            for k in range(given.files):
                campaign.file(k, files)
        if given.folders:
            stopped, whole = make_run(given.program, base)
            for k in range(given.folders):
                campaign.folder(k, stopped, whole)
    for what, n in sorted(campaign.count.items()):
        print(f"{n:6d}  {what}")
    print(f"{campaign.faults} faults")
    sys.exit(1 if campaign.faults else 0)


main()
