"""Runs as trajectories for the Simularium viewer (https://simularium.allencell.org/viewer)."""
import json
import os

import numpy as np

from acinus.errors import BadInput
from acinus.frame import DEFORMABLE

MOST_FRAMES = 200
COLOURS = {"sphere": "#5b86c4", "deformable": "#d07458"}


MOST_MESHES = 5000


def _write_mesh(surface, cell, center, radius, path):
    """Surface of a cell as OBJ, about its centre and in its radius: the viewer scales it by the radius of the agent."""
    points, triangles = surface.mesh(cell)
    with open(path, "w", encoding="ascii") as out:
        out.writelines("v {:.6g} {:.6g} {:.6g}\n".format(*p) for p in (points - center) / radius)
        out.writelines("f {} {} {}\n".format(*t) for t in triangles + 1)


def _agents(run, frame, types, mesh_of=None):
    """Rows of one frame: kind of picture (1000), id, type, place, rotation, radius, no further points.

    types: (name, model, file of the mesh or None) -> number. mesh_of: stem of the files of meshes; None = spheres only.
    """
    cells = run.cells(frame=frame)
    n = len(cells["id"])
    rows = np.zeros((n, 11))
    rows[:, 0] = 1000
    rows[:, 1] = np.asarray(cells["id"])
    for k, axis in enumerate("xyz"):
        rows[:, 3 + k] = np.asarray(cells["center_" + axis])
    rows[:, 9] = np.cbrt(3 * np.asarray(cells["volume"], dtype=float) / (4 * np.pi))
    names = sorted(run.scene["cell_types"])  # further ones: cells in lysis
    surface = run[frame] if mesh_of else None
    for row, kind, of in zip(rows, np.asarray(cells["kind"]), np.asarray(cells["type"])):
        model, file = "deformable" if kind == DEFORMABLE else "sphere", None
        name = names[int(of)] if int(of) < len(names) else "lysis"
        if surface and kind == DEFORMABLE:
            cell = int(row[1])
            file = f"{mesh_of}_cell{cell}_frame{frame}.obj"
            model += f" {cell} frame {frame}"
            _write_mesh(surface, cell, row[3:6], row[9], file)
        row[2] = types.setdefault((name, model, file), len(types))
    return rows


def _picture(model, file):
    """Geometry of a type; the viewer looks for a file of this name among those that it loads."""
    geometry = {"displayType": "SPHERE", "color": COLOURS[model.split()[0]]}
    return {**geometry, "displayType": "OBJ", "url": os.path.basename(file)} if file else geometry


def write_simularium(run, file, most_frames=MOST_FRAMES, meshes=False):
    """Writes a run as JSON that the viewer opens: every cell a sphere of its volume, deformable ones with another colour.

    run: acinus.Run; file: ends in .simularium; most_frames: of a longer run so many are taken, first and last among them;
    meshes: of every deformable cell and frame also the surface, as OBJ beside the file. Raises BadInput for another
    ending, a run without a frame, or more than 5000 meshes.
    """
    file = os.fspath(file)
    if not file.endswith(".simularium"):
        raise BadInput(f"{file}: the viewer opens files that end in .simularium")
    if len(run) == 0:
        raise BadInput(f"{run.folder}: has no frame yet")
    chosen = np.unique(np.linspace(0, len(run) - 1, min(len(run), most_frames)).round().astype(int))
    if meshes:
        number = sum(int(np.sum(np.asarray(run.cells(frame=int(k))["kind"]) == DEFORMABLE)) for k in chosen)
        if number > MOST_MESHES:
            raise BadInput(f"{file}: {number} surfaces in {len(chosen)} frames, one file each; at most {MOST_MESHES} are written. "
                           "Take fewer frames (--frames).")
    types, frames, reach = {}, [], 1.0
    for number, k in enumerate(chosen):
        rows = _agents(run, int(k), types, file.removesuffix(".simularium") if meshes else None)
        if len(rows):
            reach = max(reach, float(np.max(np.abs(rows[:, 3:6]) + rows[:, 9:10])))
        frames.append({"frameNumber": number, "time": float(run.times[k]), "data": [float(f"{v:.7g}") for v in rows.ravel()]})
    step = float(run.times[chosen[1]] - run.times[chosen[0]]) if len(chosen) > 1 else 1.0
    trajectory = {
        "trajectoryInfo": {
            "version": 3,
            "trajectoryTitle": run.scene.get("name", ""),
            "timeUnits": {"magnitude": 1.0, "name": "s"},
            "timeStepSize": step,
            "totalSteps": len(frames),
            "spatialUnits": {"magnitude": 1.0, "name": "um"},
            "size": dict.fromkeys("xyz", 2 * reach),
            "cameraDefault": {"position": {"x": 0.0, "y": 0.0, "z": 3 * reach}, "lookAtPosition": dict.fromkeys("xyz", 0.0),
                              "upVector": {"x": 0.0, "y": 1.0, "z": 0.0}, "fovDegrees": 50.0},
            "typeMapping": {str(n): {"name": f"{of}#{model}", "geometry": _picture(model, mesh)} for (of, model, mesh), n in types.items()},
        },
        "spatialData": {"version": 1, "msgType": 1, "bundleStart": 0, "bundleSize": len(frames), "bundleData": frames},
        "plotData": {"version": 1, "data": []},
    }
    with open(file, "w", encoding="utf-8") as out:
        json.dump(trajectory, out)
    return file
