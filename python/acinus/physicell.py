"""To and from PhysiCell (http://physicell.org): its cells as a scene, a calibrated law as its repulsion."""
import json
import os
import re
import struct
import xml.etree.ElementTree as xml

import numpy as np

from acinus.errors import BadInput, Damaged, NotFound

NEIGHBOURS = 12  # of a sphere in dense tissue, over which the law takes its mean


DEAD = range(100, 200)  # PhysiCell's numbers of death models and their phases; 104 is debris
MINUTES = {"min": 1, "sec": 1 / 60, "s": 1 / 60, "hr": 60, "hour": 60, "hours": 60, "h": 60, "day": 1440, "days": 1440}


class _Frame:
    """Time and stamp of a frame, read from the beginning of its XML."""

    def __init__(self, file):
        self.file = file
        self.name = os.path.basename(file)
        self.time = self.stamp = None  # minutes, text
        self.written = os.stat(file).st_mtime
        try:
            for _, element in xml.iterparse(file):
                if element.tag == "current_time":
                    self.time = _minutes(file, element)
                elif element.tag in ("created", "last_modified") and element.text:
                    self.stamp = max(self.stamp or "", element.text.strip())
                elif element.tag == "metadata":
                    break
        except xml.ParseError as error:
            raise Damaged(f"{file}: is no XML ({error})") from error

    def is_older_than(self, other):
        """Whether it was written before the other; files without a stamp by the time of the file, to a second."""
        if self.stamp and other.stamp:
            return self.stamp < other.stamp
        return self.written < other.written - 1


def _minutes(file, element):
    unit = element.get("units", "min")
    if unit not in MINUTES:
        raise BadInput(f"{file}: current_time is in {unit}, which is not known; {', '.join(MINUTES)} are")
    try:
        return MINUTES[unit] * float(element.text)
    except (TypeError, ValueError):
        raise Damaged(f"{file}: current_time is no number") from None


def _newest(folder):
    """The last frame of the run that was written last in a folder, and notes about what was passed over."""
    names = sorted((name for name in os.listdir(folder) if re.fullmatch(r"output\d+\.xml", name)), key=lambda name: (len(name), name))
    frames = [_Frame(os.path.join(folder, name)) for name in names]
    notes = []
    for k in range(1, len(frames)):
        before, frame = frames[k - 1], frames[k]
        early = frame.time is not None and before.time is not None and frame.time <= before.time
        if frame.is_older_than(before) or early:
            why = f"has the time {frame.time:g} min, not after the {before.time:g} of {before.name}" if early else f"was written before {before.name}"
            notes.append(f"{frame.name} and what comes after it are left over from an earlier run ({frame.name} {why}); {before.name} is taken")
            frames = frames[:k]
            break
    last = frames[-1] if frames else None
    file = os.path.join(folder, "final.xml")
    if not os.path.exists(file):
        if last is None:
            raise NotFound(f"{folder}: holds no output of PhysiCell (output00000000.xml ...). Name the folder that its <save> says.")
        return last.file, notes
    final = _Frame(file)
    if last is None:
        return file, notes
    if final.is_older_than(last) or (final.time is not None and last.time is not None and final.time < last.time):
        notes.append(f"final.xml is left over from an earlier run (time {final.time}, written before {last.name}); {last.name} is taken")
        return last.file, notes
    times = [f.time for f in frames if f.time is not None]
    longest = max((b - a for a, b in zip(times, times[1:])), default=None)
    if longest and final.time is not None and final.time > times[-1] + 1.5 * longest:
        raise BadInput(f"{folder}: final.xml is of {final.time:g} min, the last frame {last.name} of {times[-1]:g}: they are of two runs. Name the file to take.")
    return file, notes


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


def _root(file):
    try:
        return xml.parse(file).getroot()
    except FileNotFoundError:
        raise NotFound(f"{file}: there is no such file") from None
    except xml.ParseError as error:
        raise Damaged(f"{file}: is no XML ({error})") from error


def _read_table(file, root):
    """Rows of the cells by name, each as a matrix (size, n). Raises Damaged, BadInput."""
    part = next((p for p in root.iter("simplified_data") if p.find("labels") is not None and p.get("source", "PhysiCell") == "PhysiCell"), None)
    if part is None or part.find("filename") is None:
        raise Damaged(f"{file}: names no table of cells (simplified_data with labels and filename)")
    rows, units = {}, {}
    for label in part.find("labels"):
        name = label.text.strip()
        rows[name] = (int(label.get("index")), int(label.get("size")))
        units[name] = label.get("units", "none")
    missing = [name for name in ("ID", "position", "total_volume", "cell_type") if name not in rows]
    if missing:
        raise Damaged(f'{file}: its table of cells has no "{missing[0]}"')
    for name in ("position", "total_volume"):
        if units[name] not in ("none", "", "um") and "micron" not in units[name]:
            raise BadInput(f"{file}: {name} is in {units[name]}; microns are read")
    table = _read_matrix(os.path.join(os.path.dirname(file), part.find("filename").text.strip()))
    if max(index + size for index, size in rows.values()) > len(table):
        raise Damaged(f"{file}: its table of cells has fewer rows than its labels say")
    return {name: table[index:index + size] for name, (index, size) in rows.items()}


def _state(file, root, rows, notes):
    """Which cells take part: alive, and inside the domain. Adds notes about the others."""
    n = rows["ID"].shape[1]
    dead, said = np.zeros(n, bool), False
    for name in ("dead", "cycle_model", "current_phase"):
        if name in rows:
            said = True
            number = rows[name][0]
            dead |= number != 0 if name == "dead" else (number >= DEAD.start) & (number < DEAD.stop)
    if not said:
        notes.append(f"{file} says of no cell that it is dead (dead, cycle_model, current_phase): all are taken as living")
    if dead.any():
        notes.append(f"{int(dead.sum())} of {n} cells are dead or dying in PhysiCell and are left out")
    inside = np.ones(n, bool)
    box = next(root.iter("bounding_box"), None)
    if box is not None and box.text:
        bounds = np.array(box.text.split(), float)
        if len(bounds) == 6:
            at = rows["position"]
            inside = np.all((at >= bounds[:3, None]) & (at <= bounds[3:, None]), axis=0)
    if not inside.all():
        notes.append(f"{int((~inside & ~dead).sum())} living cells are outside the domain, where PhysiCell does not move them, and are left out")
    if "is_movable" in rows and (rows["is_movable"][0][~dead] == 0).any():
        notes.append(f"{int((rows['is_movable'][0][~dead] == 0).sum())} cells do not move in PhysiCell (is_movable is 0); here they do")
    return ~dead & inside


def read_cells(path):
    """The living cells of a PhysiCell output: dict of id, position (n, 3) um, radius um, type (names), time s, and notes.

    notes: texts about what was left out or not followed: dead cells, cells outside the domain, files of earlier runs.
    path: a file output*.xml, or a folder, of which the last frame is taken. Raises NotFound, Damaged, BadInput.
    """
    path = os.fspath(path)
    file, notes = _newest(path) if os.path.isdir(path) else (path, [])
    root = _root(file)
    rows = _read_table(file, root)
    names = {int(t.get("type", t.get("ID", "0"))): t.text.strip() for t in root.iter("type") if t.text}
    time = root.find("./metadata/current_time")
    radius = np.cbrt(3 * rows["total_volume"][0] / (4 * np.pi))
    keep = _state(file, root, rows, notes)
    if not np.all(np.isfinite(rows["position"][:, keep])) or not np.all(radius[keep] > 0):
        raise Damaged(f"{file}: a cell has no position or no volume")
    return {"id": rows["ID"][0][keep].astype(int), "position": rows["position"][:, keep].T.copy(), "radius": radius[keep],
            "type": [names.get(int(k), f"type_{int(k)}") for k in rows["cell_type"][0][keep]],
            "time": 60 * _minutes(file, time) if time is not None else 0.0, "notes": notes}


def _type_name(name):
    """A name that a scene can have."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", name).strip("_") or "cell"


def write_scene(cells, file, model="cbm"):
    """Writes cells as read_cells() gives them as a scene to start from; everything else in it has its default.

    A type gets the median radius of its cells, each cell its own. Raises BadInput if there is none.
    """
    if len(cells["id"]) == 0:
        raise BadInput("; ".join(["there are no cells", *cells.get("notes", [])]))
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
