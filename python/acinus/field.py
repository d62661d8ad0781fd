"""Fields of substances of one frame."""
import os
from dataclasses import dataclass

import numpy as np

from acinus.errors import NoSuchItem
from acinus.hdf5 import open_run_file, text_of
from acinus.json_text import read_json

SERIES = "fields.vtkhdf.series"


@dataclass(frozen=True)
class Field:
    """Concentration of a substance in the voxels of its box."""

    name: str
    unit: str
    time: float  #: s since t = 0
    value: np.ndarray  #: (nz, ny, nx)
    origin: np.ndarray  #: (3,) um, corner of the box with the smallest coordinates
    spacing: np.ndarray  #: (3,) um along x, y, z

    def centers(self, axis):
        """(n,) um, coordinates of the centres of voxels along axis 0 (x), 1 (y) or 2 (z)."""
        return self.origin[axis] + (np.arange(self.value.shape[2 - axis]) + 0.5) * self.spacing[axis]


def list_fields(folder):
    """(path, time) of every frame of fields, none without substances."""
    path = os.path.join(folder, SERIES)
    if not os.path.exists(path):
        return []
    files = read_json(path, "`acinus run SCENE --resume` writes it again.")["files"]
    return [(os.path.join(folder, f["name"]), float(f["time"])) for f in files]


def read_field(folder, name, frame):
    """Field of a substance at a frame, counted from the first or, negative, from the last one."""
    frames = list_fields(folder)
    if not -len(frames) <= frame < len(frames):
        raise NoSuchItem(f"{folder}: no frame {frame} of fields; it has {len(frames)}")
    path, time = frames[frame]
    with open_run_file(path, "acinus/fields") as file:
        grid = file["VTKHDF"]
        if name not in grid["PointData"]:
            raise NoSuchItem(f"{path}: has no field {name}, but {', '.join(grid['PointData'])}")
        values, spacing = grid["PointData"][name], grid.attrs["Spacing"]
        return Field(name, text_of(values.attrs["unit"]), time, values[...], grid.attrs["Origin"] - 0.5 * spacing, spacing)
