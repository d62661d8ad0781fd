"""To and from PhysiCell (http://physicell.org): its cells as a scene, a calibrated law as its repulsion."""
import json
import os
import re
import struct
import xml.etree.ElementTree as xml

import numpy as np

from acinus.errors import BadInput, Damaged, NotFound

NEIGHBOURS = 12  # of a sphere in dense tissue, over which the law takes its mean


def _newest(folder):
    frames = sorted(name for name in os.listdir(folder) if re.fullmatch(r"output\d+\.xml", name))
    named = [name for name in ("final.xml",) if os.path.exists(os.path.join(folder, name))]
    if not frames and not named:
        raise NotFound(f"{folder}: holds no output of PhysiCell (output00000000.xml ...). Name the folder that its <save> says.")
    return os.path.join(folder, (named or frames)[-1])


def _read_matrix(file):
    """The one matrix of a MATLAB file, version 4, as PhysiCell writes it. Raises Damaged."""
    with open(file, "rb") as data:
        head = data.read(20)
        if len(head) < 20:
            raise Damaged(f"{file}: is cut short")
        kind, rows, columns, imaginary, name = struct.unpack("<5i", head)
        dtype = {0: "<f8", 10: "<f4"}.get(kind)
        if dtype is None or imaginary or rows < 0 or columns < 0 or not 0 <= name < 1000:
            raise Damaged(f"{file}: is no matrix of a MATLAB file of version 4, as PhysiCell writes its cells")
        data.read(name)
        values = np.fromfile(data, dtype=dtype, count=rows * columns)
    if len(values) != rows * columns:
        raise Damaged(f"{file}: is cut short")
    return values.reshape(columns, rows).T


def read_cells(path):
    """The cells of a PhysiCell output: dict of id, position (n, 3) um, radius um, type (names), and time s.

    path: a file output*.xml, or a folder, of which the last frame is taken. Raises NotFound, Damaged.
    """
    path = os.fspath(path)
    file = _newest(path) if os.path.isdir(path) else path
    try:
        root = xml.parse(file).getroot()
    except FileNotFoundError:
        raise NotFound(f"{file}: there is no such file") from None
    except xml.ParseError as error:
        raise Damaged(f"{file}: is no XML ({error})") from error
    part = next((p for p in root.iter("simplified_data") if p.find("labels") is not None and p.get("source", "PhysiCell") == "PhysiCell"), None)
    if part is None or part.find("filename") is None:
        raise Damaged(f"{file}: names no table of cells (simplified_data with labels and filename)")
    rows = {label.text.strip(): (int(label.get("index")), int(label.get("size"))) for label in part.find("labels")}
    missing = [name for name in ("ID", "position", "total_volume", "cell_type") if name not in rows]
    if missing:
        raise Damaged(f'{file}: its table of cells has no "{missing[0]}"')
    table = _read_matrix(os.path.join(os.path.dirname(file), part.find("filename").text.strip()))
    if max(index + size for index, size in rows.values()) > len(table):
        raise Damaged(f"{file}: its table of cells has fewer rows than its labels say")
    names = {int(t.get("type", t.get("ID", "0"))): t.text.strip() for t in root.iter("type") if t.text}
    time = root.find("./metadata/current_time")

    def take(name):
        return table[rows[name][0]]

    at = rows["position"][0]
    radius = np.cbrt(3 * take("total_volume") / (4 * np.pi))
    if not np.all(np.isfinite(table[at:at + 3])) or not np.all(radius > 0):
        raise Damaged(f"{file}: a cell has no position or no volume")
    return {"id": take("ID").astype(int), "position": table[at:at + 3].T.copy(), "radius": radius,
            "type": [names.get(int(k), f"type_{int(k)}") for k in take("cell_type")],
            "time": 60 * float(time.text) if time is not None else 0.0}


def _type_name(name):
    """A name that a scene can have."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", name).strip("_") or "cell"


def write_scene(cells, file, model="cbm"):
    """Writes cells as read_cells() gives them as a scene to start from; everything else in it has its default.

    A type gets the median radius of its cells, each cell its own. Raises BadInput if there is none.
    """
    if len(cells["id"]) == 0:
        raise BadInput("there are no cells")
    kinds = [_type_name(t) for t in cells["type"]]
    types = {kind: {"radius": f"{np.median(cells['radius'][[k == kind for k in kinds]]):.6g} um"} for kind in sorted(set(kinds))}
    listed = [{"position": [f"{x:.9g} um" for x in place], "type": kind, "radius": f"{radius:.9g} um"}
              for place, kind, radius in zip(cells["position"], kinds, cells["radius"])]
    scene = {"name": os.path.splitext(os.path.basename(file))[0], "description": f"{len(listed)} cells of a PhysiCell run at {cells['time'] / 3600:.6g} h",
             "model": model, "time": {"end": "1 h"}, "cell_types": types, "cells": {"source": "list", "list": listed}}
    with open(file, "w", encoding="utf-8") as out:
        json.dump(scene, out, indent=1)
        out.write("\n")
    return file


def law_table(law, points=60):
    """The force of two equal spheres by their distance, each with twelve neighbours as near: a dict of arrays
    distance (um), overlap (relative), modulus (kPa), force (nN), physicell (nN).

    The force is that of Hertz with the modulus of the law, which is what pushes; adhesion is left out. `physicell` is what
    PhysiCell's (1 - distance / sum of radii)^2 makes of it, strength by least squares over the range of the law.
    """
    sphere = law.json["cbm"]
    radius, poisson = sphere["radius_um"], sphere["poisson"]
    overlap = np.linspace(0, law.overlap_range[1], points)
    modulus = law.modulus(overlap)
    stiffness = modulus / (2 * (1 - poisson ** 2))  # of two alike
    force = 4 / 3 * stiffness * np.sqrt(radius / 2) * (2 * radius * overlap) ** 1.5
    shape = overlap ** 2
    strength = float(shape @ force / (shape @ shape))
    return {"distance": 2 * radius * (1 - overlap), "overlap": overlap, "modulus": modulus, "force": force, "physicell": strength * shape, "strength": strength}


def write_law(law, file, drag=None):
    """Writes law_table() as CSV, with what PhysiCell's repulsion comes to in lines that begin with #.

    drag: force over velocity of a cell (nN min/um); with it the strength is also given in um/min, as its configuration has it.
    """
    table = law_table(law)
    miss = np.sqrt(np.mean((table["physicell"] - table["force"]) ** 2) / np.mean(table["force"] ** 2))
    with open(file, "w", encoding="utf-8") as out:
        out.write(f"# two spheres of radius {law.json['cbm']['radius_um']:g} um, each among {NEIGHBOURS} as near, from {law.file}\n")
        out.write(f"# cell_cell_repulsion_strength: {table['strength']:.6g} nN" + (f" = {table['strength'] / drag:.6g} um/min" if drag else " over the drag of a cell, in nN min/um") + "\n")
        out.write(f"# its form, (1 - distance / sum of radii)^2, misses the law by {100 * miss:.0f} % of the force; the table is the law\n")
        out.write("distance_um,relative_overlap,modulus_kPa,force_nN,physicell_force_nN\n")
        for row in zip(*(table[name] for name in ("distance", "overlap", "modulus", "force", "physicell"))):
            out.write(",".join(f"{v:.6g}" for v in row) + "\n")
    return file
