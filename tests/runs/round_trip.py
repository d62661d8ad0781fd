"""A tissue as a label image, and back: voxelised with blur and noise, imported, and compared with what it was.

usage: round_trip.py PROGRAM WHAT [FRAME [VOXEL_UM [BLUR_UM [NOISE [SMOOTHING]]]]]

WHAT is the folder of a run with deformable cells, or a scene, which is run to t = 0. Judged against the tissue itself, not against its image: volume of
every cell within 1 %, its centre within half a voxel, its surface within a voxel (root mean square), pairs of
neighbours found again in 95 %. Prints what was found; exit code 1 beyond a limit.
"""

import csv
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "python"))
import acinus  # noqa: E402

VOLUME, CENTER, SURFACE, NEIGHBOURS = 0.01, 0.5, 1.0, 0.95


def measure(points, triangles):
    """Volume and centroid of a closed surface."""
    origin = points.mean(axis=0)
    a, b, c = (points[triangles[:, k]] - origin for k in range(3))
    parts = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    return parts.sum(), origin + (parts[:, None] * (a + b + c) / 4).sum(axis=0) / parts.sum()


def distances(points, surface):
    """Of points from a triangle surface: nearest point of each triangle [Ericson2005], all pairs."""
    nodes, triangles = surface
    a, b, c = (nodes[triangles[:, k]] for k in range(3))
    p = points[:, None, :]
    ab, ac, n = b - a, c - a, np.cross(b - a, c - a)
    inside = np.ones((len(points), len(triangles)), bool)
    best = np.full((len(points), len(triangles)), np.inf)
    for u, v in ((a, b), (b, c), (c, a)):
        along = v - u
        t = np.clip(np.einsum("ptk,tk->pt", p - u, along) / np.einsum("tk,tk->t", along, along), 0, 1)
        best = np.minimum(best, np.linalg.norm(p - u - t[..., None] * along, axis=2))
        inside &= np.einsum("ptk,tk->pt", p - u, np.cross(n, along)) >= 0
    plane = np.abs(np.einsum("ptk,tk->pt", p - a, n)) / np.linalg.norm(n, axis=1)
    return np.where(inside, np.minimum(plane, best), best).min(axis=1)


def touching(meshes, reach):
    """Pairs of meshes with at least three nodes of one nearer than `reach` to the other."""
    boxes = {k: (p.min(axis=0) - reach, p.max(axis=0) + reach) for k, (p, _) in meshes.items()}
    pairs = set()
    names = sorted(meshes)
    for i, a in enumerate(names):
        for b in names[i + 1:]:
            low, high = np.maximum(boxes[a][0], boxes[b][0]), np.minimum(boxes[a][1], boxes[b][1])
            if (low > high).any():
                continue
            near = 0
            for one, other in ((a, b), (b, a)):
                points = meshes[one][0]
                candidates = points[((points >= low) & (points <= high)).all(axis=1)]
                if len(candidates):
                    near += int((distances(candidates, meshes[other]) < reach).sum())
            if near >= 3:
                pairs.add((a, b))
    return pairs


def call(program, *arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=3600)
    if done.returncode != 0:
        sys.exit(f"{' '.join(arguments)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def rows(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def main():
    program, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    number = int(sys.argv[3]) if len(sys.argv) > 3 else -1
    voxel, blur, noise, smoothing = (sys.argv[4:8] + ["1", "0.7", "0.3", "0.7"][len(sys.argv[4:8]):])
    size = float(voxel)
    with tempfile.TemporaryDirectory() as temporary:
        image, tissue, run = (os.path.join(temporary, name) for name in ("labels.tif", "tissue", "tissue.run"))
        if not os.path.isdir(folder):
            call(program, "run", folder, "--until", "1 s", "--out", os.path.join(temporary, "before.run"))
            folder = os.path.join(temporary, "before.run")
        before = acinus.Run(folder)
        number %= len(before)
        told = call(program, "voxelise", folder, "--frame", str(number), "--voxel", f"{voxel} um", "--blur", f"{blur} um",
                    "--noise", noise, "--out", image)
        vessels = re.search(r"vessels have label (\d+)", told)
        print(told + call(program, "import", image, "--out", tissue, "--smoothing", smoothing,
                          *(["--vessel-label", vessels[1]] if vessels else [])), end="")
        print(call(program, "run", os.path.join(tissue, "scene.json"), "--out", run, "--until", "1 s"), end="")
        labels = {int(r["label"]): r for r in rows(os.path.join(temporary, "labels.csv"))}
        cells = rows(os.path.join(tissue, "cells.csv"))
        old, new = before[number], acinus.Run(run)[0]
        error = {"volume": [], "centre": [], "surface": []}
        meshes_old, meshes_new = {}, {}
        for r in cells:
            label = labels[int(r["label"])]
            ours, theirs = new.mesh(int(r["cell"])), old.mesh(int(label["cell"]))
            corner = measure(*theirs)[1] - np.array([float(label[k]) for k in ("x_um", "y_um", "z_um")])
            ours = (ours[0] + corner, ours[1])
            meshes_old[int(r["label"])], meshes_new[int(r["label"])] = theirs, ours
            (v0, c0), (v1, c1) = measure(*theirs), measure(*ours)
            error["volume"].append(v1 / v0 - 1)
            error["centre"].append(np.linalg.norm(c1 - c0) / size)
            error["surface"].append(np.sqrt(np.mean(distances(ours[0], theirs) ** 2)) / size)
    # Touching: nearer than the reach of adhesion before; after, half a voxel farther.
    pairs_old, pairs_new = touching(meshes_old, 0.7), touching(meshes_new, 0.7 + 0.5 * size)
    found = len(pairs_old & pairs_new) / len(pairs_old)
    print(f"{len(cells)} of {len(labels)} cells came back")
    for name, unit, limit in (("volume", "", VOLUME), ("centre", " voxels", CENTER), ("surface", " voxels", SURFACE)):
        e = np.abs(error[name])
        print(f"{name}: median {np.median(e):.4f}, worst {e.max():.4f}{unit} (at most {limit})")
    print(f"volume in the mean {np.mean(error['volume']):+.4f}")
    print(f"neighbours: {len(pairs_old)} pairs, {len(pairs_new)} in the image, {found:.3f} found again "
          f"(at least {NEIGHBOURS}), {len(pairs_new - pairs_old)} new")
    worst = [np.abs(error[k]).max() for k in ("volume", "centre", "surface")]
    sys.exit(0 if len(cells) == len(labels) and worst[0] <= VOLUME and worst[1] <= CENTER and worst[2] <= SURFACE
             and found >= NEIGHBOURS else 1)


main()
