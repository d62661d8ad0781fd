"""Reads one frame of a run.vtkhdf with h5py; used by render.py and easy to use in scripts.

    frame = Frame("lobule.run", "last")
    frame.point, frame.triangle, frame.cell_data["pressure"], frame.unit["pressure"]
"""
import os

DCM, CBM, VESSEL, NUCLEUS = 0, 1, 2, 3


class UserError(Exception):
    """Something to tell the user without a traceback."""


def open_run(path):
    """The run.vtkhdf of a folder, or the file itself, as h5py opens it."""
    import h5py
    if os.path.isdir(path):
        path = os.path.join(path, "run.vtkhdf")
    try:
        return h5py.File(path, "r")
    except OSError as error:
        raise UserError(f"{path}: cannot be read: {error}") from None


def count_frames(path):
    with open_run(path) as file:
        return int(file["VTKHDF/Steps"].attrs["NSteps"])


def read_times(path):
    """Times of the frames, s."""
    with open_run(path) as file:
        return [float(t) for t in file["VTKHDF/Steps/Values"][:int(file["VTKHDF/Steps"].attrs["NSteps"])]]


class Frame:
    """One moment of a run: arrays of numpy."""

    def __init__(self, path, which):
        with open_run(path) as file:
            root = file["VTKHDF"]
            steps = root["Steps"]
            n_frame = int(steps.attrs["NSteps"])
            k = n_frame - 1 if which == "last" else parse_integer(which, "--frame")
            k += n_frame if k < 0 else 0
            if not 0 <= k < n_frame:
                raise UserError(f"{path}: has no frame {which}, only 0 to {n_frame - 1}")
            self.time = float(steps["Values"][k])
            part = int(steps["PartOffsets"][k])
            n_point, n_cell = int(root["NumberOfPoints"][part]), int(root["NumberOfCells"][part])
            n_id = int(root["NumberOfConnectivityIds"][part])
            self.n_triangle = (n_id - n_cell) // 2
            self.n_sphere = n_cell - self.n_triangle
            first = int(steps["PointOffsets"][k])
            self.point = root["Points"][first:first + n_point]
            first = int(steps["ConnectivityIdOffsets"][k, 0])
            self.triangle = root["Connectivity"][first:first + 3 * self.n_triangle].reshape(-1, 3)
            self.point_data = self.read(root, steps, "PointData", k, n_point)
            self.cell_data = self.read(root, steps, "CellData", k, n_cell)
            self.unit = {}
            for group in ("PointData", "CellData"):
                for name, values in root[group].items():
                    self.unit[name] = unit_of(values)
            self.table = self.read_table(file["cells"], k)
            self.observable = {name: float(values[k]) for name, values in file.get("observables", {}).items()
                               if name != "time" and k < len(values)}
        self.kind, self.cell_id = self.cell_data["kind"], self.cell_data["cell_id"]

    @staticmethod
    def read(root, steps, group, k, n):
        offsets = steps[group + "Offsets"]
        result = {}
        for name, values in root[group].items():
            first = int(offsets[name][k])
            result[name] = values[first:first + n]
        return result

    def read_table(self, cells, k):
        """Columns of /cells with one number per cell, by name; ids of the cells in "id"."""
        rows = slice(int(cells["frame_offset"][k]), int(cells["frame_offset"][k + 1]))
        table = {}
        for name, values in cells.items():
            if values.ndim != 1 or name == "frame_offset":
                continue
            table[name] = values[rows]
            self.unit.setdefault(name, unit_of(values))
        return table

    def colored_by(self, name):
        """Values per cell (rows: triangles, spheres) and per point; one of them is None.

        Fields of the frame, or columns of /cells such as concentrations. Vectors become their length, kPa become Pa.
        """
        for per_cell, data in ((True, self.cell_data), (False, self.point_data)):
            if name not in data:
                continue
            values = data[name].astype(float)
            if values.ndim == 2:
                values = (values ** 2).sum(axis=1) ** 0.5
            unit = self.unit[name]
            if unit == "kPa":
                values, unit = 1000 * values, "Pa"
            return (values, None, unit) if per_cell else (None, values, unit)
        if name in self.table:
            import numpy as np
            order = np.argsort(self.table["id"])
            at = np.searchsorted(self.table["id"], self.cell_id, sorter=order)
            found = order[np.minimum(at, len(order) - 1)]
            values = np.where(self.table["id"][found] == self.cell_id, self.table[name][found], np.nan)
            return values.astype(float), None, self.unit[name]
        known = sorted(set(self.cell_data) | set(self.point_data) | set(self.table) | {"kind", "cell"})
        raise UserError(f"--color {name}: the run has no such field, only {', '.join(known)}")

    def value_of(self, name):
        """The observable of that name at this frame."""
        if name not in self.observable:
            raise UserError(f"--show {name}: the run has no such observable, only "
                            f"{', '.join(sorted(self.observable)) or 'none'}")
        return self.observable[name]

    def own_points(self):
        """Indices of the points that belong to cells, not to vessels or walls."""
        import numpy as np
        used = np.unique(self.triangle[self.kind[:self.n_triangle] != VESSEL])
        n_node = len(self.point) - self.n_sphere
        spheres = n_node + np.flatnonzero(self.kind[self.n_triangle:] != VESSEL)
        return np.concatenate([used, spheres]).astype(int)


def unit_of(values):
    unit = values.attrs["unit"]
    return unit.decode() if isinstance(unit, bytes) else str(unit)


def parse_integer(text, option):
    try:
        return int(text)
    except ValueError:
        raise UserError(f'{option} {text}: must be a number or "last"') from None
