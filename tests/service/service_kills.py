"""Kills a service, or a run it started, at random moments: no run is lost, none is made twice.

usage: service_kills.py ACINUS [KILLS] [SEED]

Runs are submitted while it happens. In the end all that were accepted are completed, with the state that a run of
their own reaches, and none that was completed was touched again. Prints what happened; exit code 1 if it does not hold.
"""

import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time

from service_client import Service

SEEDS = (1, 2, 3)
CHANGES = {"start_up.growth_time": "30 min", "time.end": "10 min", "output.every": "2 min"}


def reference(acinus, folder, seed):
    run = f"{folder}/reference_{seed}.run"
    sets = [word for key, value in {**CHANGES, "seed": seed}.items() for word in ("--set", f"{key}={value}")]
    subprocess.run([acinus, "run", "lobule_hybrid", *sets, "--threads", "1", "--quiet", "--out", run], check=True)
    with open(run + "/summary.json") as file:
        return json.load(file)["state_hash"]


def children_of(process):
    with open(f"/proc/{process}/task/{process}/children") as file:
        return [int(word) for word in file.read().split()]


def summary_file(service, run):
    return f"{service.data}/runs/{run}/summary.json"


def completed(service, done, wrong):
    """Notes what is completed now; what was so before must not have been written again."""
    for run in service.json("GET", "/runs")["runs"]:
        if run["state"] != "completed":
            if run["id"] in done:
                wrong.append(f"{run['id']} was completed and is {run['state']} now")
            continue
        written = os.stat(summary_file(service, run["id"])).st_mtime_ns
        if done.setdefault(run["id"], written) != written:
            wrong.append(f"{run['id']} was made twice")


def main():
    acinus, kills = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 40
    moments = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    accepted, done, wrong, servers, runs = {}, {}, [], 0, 0
    with tempfile.TemporaryDirectory() as folder:
        state = {seed: reference(acinus, folder, seed) for seed in SEEDS}
        service = Service(acinus, folder + "/data", "--jobs", "2", "--checkpoint-every", "0.3 s")
        for k in range(kills):
            if k % 3 == 0:
                seed = moments.choice(SEEDS)
                accepted[service.submit("lobule_hybrid", set={**CHANGES, "seed": seed})["id"]] = seed
            time.sleep(moments.uniform(0, 1.5))
            completed(service, done, wrong)
            running = children_of(service.process.pid)
            if running and moments.random() < 0.5:
                os.kill(moments.choice(running), signal.SIGKILL)
                runs += 1
            else:
                service.kill()
                service.start()
                servers += 1
        end = time.monotonic() + 300
        while service.json("GET", "/runs")["count"].get("completed", 0) < len(accepted) and time.monotonic() < end:
            time.sleep(0.2)
        completed(service, done, wrong)
        listed = {run["id"]: run for run in service.json("GET", "/runs")["runs"]}
        for run, seed in accepted.items():
            if run not in listed:
                wrong.append(f"{run} is lost")
            elif listed[run]["state"] != "completed":
                wrong.append(f"{run} is {listed[run]['state']}: {listed[run]['cause']}")
            else:
                with open(summary_file(service, run)) as file:
                    if json.load(file)["state_hash"] != state[seed]:
                        wrong.append(f"{run} ended in another state than a run of its own")
        wrong += [f"{run} was never asked for" for run in listed if run not in accepted]
        service.end()
    print(f"{servers} services and {runs} runs killed, {len(accepted)} runs accepted, {len(done)} completed")
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
