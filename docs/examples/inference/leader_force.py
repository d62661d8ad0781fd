"""Infers the force of the leader cells from a curve of the lesion's area, through a running service.

    acinus serve
    python3 leader_force.py http://acinus:TOKEN@127.0.0.1:8642

The curve is made by the same model with a known force, from seeds that the inference does not use, with noise on top:
what comes out can be judged. With emcee (Debian: python3-emcee) the posterior is sampled, with --scipy only its maximum
is searched. The service speaks UM-Bridge, so `umbridge.HTTPModel` does as well as the class below.
"""

import argparse
import base64
import concurrent.futures
import json
import math
import sys
import urllib.error
import urllib.parse
import urllib.request

import numpy as np

MODEL = "closing_force/lesion_area_relative"
DAYS = [0.5, 1, 1.5, 2, 2.5, 3]
CONFIG = {"variant": "cbm_e", "at": [f"{d} days" for d in DAYS], "set": {"time.end": "3 days", "output.every": "6 h"}}
SEEDS, SEEDS_OF_THE_CURVE = (1, 2, 3), (101, 102, 103)
LOW, HIGH = 0.1, 1.5  # nN, where the force is looked for


class Model:
    """One model of a service: calls are runs, or what an earlier run of the same scene found."""

    def __init__(self, url, name):
        parts = urllib.parse.urlsplit(url)
        self.url = f"{parts.scheme}://{parts.hostname}:{parts.port}"
        pair = f"{parts.username or 'acinus'}:{parts.password or ''}"
        self.headers = {"Authorization": "Basic " + base64.b64encode(pair.encode()).decode()}
        self.name = name

    def __call__(self, parameters, config):
        body = json.dumps({"name": self.name, "input": parameters, "config": config}).encode()
        try:
            with urllib.request.urlopen(urllib.request.Request(self.url + "/Evaluate", body, self.headers)) as answer:
                return json.load(answer)["output"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(f"{self.name}: {error.code} {error.read().decode(errors='replace')}") from error


class Curves:
    def __init__(self, url, jobs):
        self.model, self.pool, self.calls = Model(url, MODEL), concurrent.futures.ThreadPoolExecutor(jobs), 0

    def of(self, force, seeds):
        """[seed, day]: the area at a force (nN). Forces are rounded to 0.5 %, so that a sampler finds runs again."""
        force = round(math.exp(round(math.log(force) / 0.005) * 0.005), 6)
        self.calls += len(seeds)
        return np.array(list(self.pool.map(lambda seed: self.model([[force]], {**CONFIG, "seed": seed})[0], seeds)))


def log_likelihood(curves, force, curve, noise):
    """Of the mean over seeds; its own spread between seeds counts as error, too."""
    areas = curves.of(force, SEEDS)
    variance = noise ** 2 + areas.var(axis=0, ddof=1) * (1 / len(SEEDS) + 1 / len(SEEDS_OF_THE_CURVE))
    return -0.5 * np.sum((areas.mean(axis=0) - curve) ** 2 / variance + np.log(variance))


def search_grid(curves, curve, noise):
    """The most likely of nine forces, and the step between them in log force."""
    grid = np.geomspace(LOW, HIGH, 9)
    return grid[np.argmax([log_likelihood(curves, f, curve, noise) for f in grid])], math.log(grid[1] / grid[0])


def search_maximum(curves, curve, noise):
    from scipy.optimize import minimize_scalar

    best, step = search_grid(curves, curve, noise)
    found = minimize_scalar(lambda x: -log_likelihood(curves, math.exp(x), curve, noise), method="bounded",
                            bounds=(math.log(best) - step, math.log(best) + step), options={"maxiter": 12, "xatol": 0.01})
    return math.exp(found.x)


def sample_posterior(curves, curve, noise, steps):
    import emcee

    def log_posterior(x):  # flat in log force
        inside = math.log(LOW) < x[0] < math.log(HIGH)
        return log_likelihood(curves, math.exp(x[0]), curve, noise) if inside else -math.inf

    walkers = 8
    best, step = search_grid(curves, curve, noise)
    np.random.seed(1)
    start = math.log(best) + 0.5 * step * np.random.randn(walkers, 1)
    sampler = emcee.EnsembleSampler(walkers, 1, log_posterior)
    sampler.run_mcmc(start, steps)
    return np.exp(sampler.get_chain(discard=steps // 3, flat=True)[:, 0])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("url", help="as `acinus serve` prints it for UM-Bridge clients")
    parser.add_argument("--force", type=float, default=0.45, help="nN, of the curve (default: 0.45)")
    parser.add_argument("--noise", type=float, default=0.02, help="of the measured area (default: 0.02)")
    parser.add_argument("--steps", type=int, default=30, help="of each of 8 walkers (default: 30)")
    parser.add_argument("--jobs", type=int, default=3, help="evaluations asked for at a time (default: 3)")
    parser.add_argument("--scipy", action="store_true", help="only the most likely force")
    arguments = parser.parse_args()

    curves = Curves(arguments.url, arguments.jobs)
    rng = np.random.default_rng(7)
    curve = curves.of(arguments.force, SEEDS_OF_THE_CURVE).mean(axis=0) + rng.normal(0, arguments.noise, len(DAYS))
    print("days  " + "  ".join(f"{d:5.1f}" for d in DAYS))
    print("area  " + "  ".join(f"{a:5.3f}" for a in curve))
    if arguments.scipy:
        force = search_maximum(curves, curve, arguments.noise)
        print(f"most likely: {force:.3f} nN; the curve was made with {arguments.force:g} nN ({curves.calls} evaluations)")
        return 0 if abs(math.log(force / arguments.force)) < math.log(1.5) else 1
    forces = sample_posterior(curves, curve, arguments.noise, arguments.steps)
    low, middle, high = np.quantile(forces, [0.05, 0.5, 0.95])
    print(f"force: {middle:.3f} nN, 90 % between {low:.3f} and {high:.3f}; the curve was made with {arguments.force:g} nN ({curves.calls} evaluations)")
    return 0 if low <= arguments.force <= high else 1


if __name__ == "__main__":
    sys.exit(main())
