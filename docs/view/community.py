#!/usr/bin/python3
"""Figure and numbers of docs/science/community_benchmarks.md.

    community.py measure OUR_CSV_DIR WORKSHOP_DIR    # docs/plots/community/sorting.csv anew, from CSV files in the workshop's format
    community.py draw                                # docs/images/community_benchmarks.svg from docs/plots/community

OUR_CSV_DIR has CASE_MODEL.csv of `acinus openvt` and `acinus permedcoe`; WORKSHOP_DIR is a clone of
https://github.com/jmosborne/OpenVt2026Workshop. Needs the Debian packages python3-scipy (measure) and python3-matplotlib (draw).
"""
import collections
import csv
import pathlib
import sys

sys.dont_write_bytecode = True  # no __pycache__ in the source tree
ROOT = pathlib.Path(__file__).resolve().parents[1]
NUMBERS, FIGURE = ROOT / "plots" / "community", ROOT / "images" / "community_benchmarks.svg"
CASES = ("sorting", "engulfment", "checkerboard")
#: Farthest neighbours, in cell diameters, among the edges of a Delaunay triangulation of the centres.
REACH = 1.5
#: Curves of the workshop: (name, case, file, simID or None for the only one).
THEIRS = [
    ("Artistoo", "sorting", "Artistoo_1/data/sort-new.csv", None),
    ("Artistoo", "engulfment", "Artistoo_1/data/engulf-new.csv", None),
    ("Artistoo", "checkerboard", "Artistoo_1/data/check-new.csv", None),
    ("CompuCell3D", "sorting", "CC3D_1/data/cellsorting_data.csv", "cc3d_sorting_seed23"),
    ("CompuCell3D", "engulfment", "CC3D_1/data/cellsorting_data.csv", "cc3d_engulfment_seed23"),
    ("CompuCell3D", "checkerboard", "CC3D_1/data/cellsorting_data.csv", "cc3d_mixing_seed23"),
    ("Chaste, Potts", "sorting", "Chaste_Example/data/Potts/Sorting/Checkerboard/CellsAcross_10/results_from_time_0/raw_data.csv", None),
    ("Chaste, Potts", "engulfment", "Chaste_Example/data/Potts/Engulfment/Block/CellsAcross_10/results_from_time_0/raw_data.csv", None),
    ("Chaste, Potts", "checkerboard", "Chaste_Example/data/Potts/Mixing/Block/CellsAcross_10/results_from_time_0/raw_data.csv", None),
    ("Chaste, vertices", "engulfment", "Chaste_Example/data/Vertex/Engulfment/Block/CellsAcross_10/results_from_time_0/raw_data.csv", None),
    ("Chaste, vertices", "checkerboard", "Chaste_Example/data/Vertex/Mixing/Block/CellsAcross_10/results_from_time_0/raw_data.csv", None),
    ("Morpheus", "sorting", "morpheus-ai/data/sorting_400.csv", None),
    ("Morpheus", "engulfment", "morpheus-ai/data/engulfment_400.csv", None),
    ("Morpheus", "checkerboard", "morpheus-ai/data/checkerboard_400.csv", None)]
OURS = (("acinus, spheres", "cbm"), ("acinus, deformable", "dcm"))


def read_frames(path, simulation=None):
    """time -> rows of (x, y, type)."""
    frames = collections.defaultdict(list)
    with open(path) as file:
        for row in csv.DictReader(file):
            if simulation is None or row["simID"].strip() == simulation:
                frames[float(row["time"])].append((float(row["x"]), float(row["y"]), int(row["cellType"])))
    return frames


def mixed_share(rows):
    """Share of neighbours of different types; neighbours: Delaunay, at most REACH apart."""
    import numpy as np
    from scipy.spatial import Delaunay
    cells = np.array(rows)
    corners = Delaunay(cells[:, :2]).simplices
    pairs = np.unique(np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), 1), axis=0)
    near = np.linalg.norm(cells[pairs[:, 0], :2] - cells[pairs[:, 1], :2], axis=1) <= REACH
    return float((cells[pairs[near, 0], 2] != cells[pairs[near, 1], 2]).mean())


def measure(ours, workshop):
    curves = [(name, case, pathlib.Path(ours) / f"{case}_{model}.csv", None) for name, model in OURS for case in CASES]
    curves += [(name, case, pathlib.Path(workshop) / path, simulation) for name, case, path, simulation in THEIRS]
    with open(NUMBERS / "sorting.csv", "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["program", "case", "time", "mixed_share"])
        for name, case, path, simulation in curves:
            if not path.exists():
                print(f"{path}: missing")
                continue
            frames = read_frames(path, simulation)
            times = sorted(frames)
            for k in range(0, len(times), max(1, (len(times) - 1) // 20)):
                out.writerow([name, case, f"{times[k]:.6g}", f"{mixed_share(frames[times[k]]):.3f}"])


def read_curves(name):
    """(program, case) -> list of (x, y)."""
    curves = collections.defaultdict(list)
    with open(NUMBERS / name) as file:
        rows = csv.reader(file)
        next(rows)
        for program, case, x, y in rows:
            curves[program, case].append((float(x), float(y)))
    return curves


def draw():
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "acinus", "font.size": 8, "axes.spines.top": False, "axes.spines.right": False})
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(2, 3, figsize=(9.5, 5.6), constrained_layout=True)
    style = {"acinus, spheres": ("#2a6fa8", 2.2), "acinus, deformable": ("#c9762b", 2.2), "measured": ("black", 0)}
    muted = ["#8a8a8a", "#6aa06a", "#a07ab0", "#c0a050", "#70a8b0", "#b07070", "#5a5a9a", "#9ab04a", "#d08ab0"]
    others = {}

    def line(axis, program, points):
        color, width = style.get(program) or (others.setdefault(program, muted[len(others) % len(muted)]), 1.1)
        x, y = zip(*points)
        return axis.plot(x, y, color=color, linewidth=width, label=program, marker="o" if width == 0 else None, markersize=3.5)

    sorting = read_curves("sorting.csv")
    for axis, case in zip(axes[0], CASES):
        for (program, of), points in sorting.items():
            if of == case:
                end = points[-1][0]
                line(axis, program, [(x / end, y) for x, y in points])
        axis.set(title=case, xlabel="time, share of the run", ylim=(0, None))
    axes[0][0].set_ylabel("neighbours of different types, share")
    growth = read_curves("permedcoe.csv")
    for axis, case, labels in zip(axes[1], ("pushing", "monolayer", "spheroid"), (
            ("min", "distance, um"), ("h", "diameter, um"), ("h", "cells"))):
        for (program, of), points in growth.items():
            if of == case:
                line(axis, program, points)
        axis.set(title=case, xlabel=f"time, {labels[0]}", ylabel=labels[1])
    axes[1][2].set_yscale("log")
    handles = {}
    for axis in axes.flat:
        for handle, label in zip(*axis.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=5, frameon=False, bbox_to_anchor=(0.5, -0.1))
    figure.savefig(FIGURE, metadata={"Date": None}, bbox_inches="tight")


if __name__ == "__main__":
    if len(sys.argv) == 4 and sys.argv[1] == "measure":
        measure(sys.argv[2], sys.argv[3])
    elif sys.argv[1:] == ["draw"]:
        draw()
    else:
        sys.exit(__doc__)
