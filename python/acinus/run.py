"""A run folder, read."""
import os

import numpy as np

from acinus.errors import Damaged, NoSuchItem, NotFound
from acinus.field import read_field
from acinus.frame import read_frame
from acinus.hdf5 import open_run_file, read_rows, text_of, texts_of, unit_of
from acinus.json_text import parse_json, read_json
from acinus.lineage import make_lineage
from acinus.tables import make_table, sort_by_id

FILE, SUMMARY = "run.vtkhdf", "summary.json"


class Run:
    """A run folder or a run.vtkhdf. Also of a run that goes on: what is asked for is read when it is asked for.

    `len(run)` is the number of frames, `run[k]` one of them (negative from the end, slices give lists), `for frame in run` all.
    Tables are pandas.DataFrames where pandas is installed (acinus.tables). Lengths um, times s, forces nN, stresses kPa.
    """

    def __init__(self, path):
        """Raises NotFound, Damaged."""
        path = os.fspath(path)
        if not os.path.exists(path):
            raise NotFound(f"{path}: there is no such file. Give a run folder, or a {FILE} itself.")
        self.file = os.path.join(path, FILE) if os.path.isdir(path) else path
        self.folder = os.path.dirname(os.path.abspath(self.file))
        if os.path.isdir(path) and not os.path.exists(self.file):
            inside = ", ".join(sorted(os.listdir(path))[:8]) or "nothing"
            raise NotFound(f"{path}: has no {FILE} (but {inside}). Give a folder that `acinus run` has written.")
        with open_run_file(self.file):
            pass

    def __repr__(self):
        return f"<run {self.file}: {len(self)} frames, {self.status}>"

    # ---- frames ---------------------------------------------------------------------------

    def __len__(self):
        with open_run_file(self.file) as file:
            return _count_frames(file)

    def __getitem__(self, k):
        with open_run_file(self.file) as file:
            n = _count_frames(file)
            if isinstance(k, slice):
                return [read_frame(file, i) for i in range(*k.indices(n))]
            return read_frame(file, _frame_number(k, n))

    def __iter__(self):
        k = 0
        while k < len(self):  # may grow meanwhile
            yield self[k]
            k += 1

    @property
    def times(self):
        """(frames,) s."""
        with open_run_file(self.file) as file:
            return read_rows(file["VTKHDF/Steps/Values"], 0, _count_frames(file))

    def field(self, name, frame=-1):
        """Concentration of a substance at a frame.

        Raises NoSuchItem.
        """
        return read_field(self.folder, name, frame)

    # ---- tables ---------------------------------------------------------------------------

    def cells(self, frame=None):
        """One row per cell and frame, or the rows of one frame, with its number and time in columns `frame` and `time`.

        Rows are sorted by frame and id.
        """
        columns, units = self._ragged("cells", frame)
        return make_table(sort_by_id(columns), units)

    def interface(self, frame=None):
        """One row per pair of a deformable cell and a sphere and frame, or those of one frame."""
        return make_table(*self._ragged("interface", frame))

    def contacts(self, frame=None):
        """One row per pair of cells in contact, or cell and part of the boundary, and frame, or those of one frame.

        Raises NoSuchItem where the scene does not ask for them with output.contacts.
        """
        with open_run_file(self.file) as file:
            n = int(file["contacts/frame_offset"][_count_frames(file)]) if "contacts" in file else 0
        if n == 0 and not self.scene.get("output", {}).get("contacts"):  # a resumed run may have them all the same
            raise NoSuchItem(f"{self.file}: has no contacts. Run the scene with --set output.contacts=true.")
        return make_table(*self._ragged("contacts", frame))

    def history(self, cell_id):
        """The rows of /cells of one cell."""
        table = self.cells()
        own = table["id"] == cell_id
        if not own.any():
            raise NoSuchItem(f"{self.file}: no frame has a cell {cell_id}")
        return table[own]

    def series(self):
        """One row per accepted step."""
        return self._samples("series")

    def observables(self):
        """One row per frame from t = 0 on: what the experiment of the scene measures."""
        return self._samples("observables")

    def events(self):
        """One row per event: time, code, message, and the cells concerned as a tuple of ids."""
        rows = self._events()
        cells = np.empty(len(rows), dtype=object)
        cells[:] = [row[3] for row in rows]
        return make_table({"time": np.array([row[0] for row in rows], dtype=float),
                           "code": np.array([row[1] for row in rows], dtype=object),
                           "message": np.array([row[2] for row in rows], dtype=object), "cells": cells},
                          {"time": "s", "code": "text", "message": "text"})

    def lineage(self):
        """The family tree of all cells that were in a frame or an event."""
        with open_run_file(self.file) as file:
            n = int(file["cells/frame_offset"][_count_frames(file)])
            ids, parents = (read_rows(file["cells/" + name], 0, n) for name in ("id", "parent"))
        return make_lineage([(time, code, cells) for time, code, _, cells in self._events()], ids, parents)

    def unit(self, dataset):
        """Unit of a dataset by its path, e.g. "cells/pressure" or "VTKHDF/PointData/force"."""
        with open_run_file(self.file) as file:
            if dataset not in file:
                raise NoSuchItem(f"{self.file}: has no dataset {dataset}")
            return unit_of(file[dataset])

    # ---- what it is -----------------------------------------------------------------------

    @property
    def provenance(self):
        """How it was made: name -> text."""
        with open_run_file(self.file) as file:
            return {name: text_of(value) for name, value in file["provenance"].items()}

    @property
    def scene(self):
        """The scene with every default filled in."""
        return parse_json(self.provenance.get("scene", ""), f"{self.file}: its scene", "Copy the file again.")

    @property
    def summary(self):
        """summary.json; it is there when a run has ended.

        Raises NotFound, Damaged.
        """
        path = os.path.join(self.folder, SUMMARY)
        try:
            return read_json(path, "`acinus run SCENE --resume` writes it again.")
        except FileNotFoundError:
            raise NotFound(f"{path}: is not there: the run goes on or was killed. `acinus run SCENE --resume` ends it.") from None

    @property
    def status(self):
        """completed, stopped or failed; "running" where nothing says so yet, so also after a kill."""
        return self.provenance.get("status", "running")

    # ---- reading --------------------------------------------------------------------------

    def _ragged(self, group, frame):
        """Columns and units of a table with any number of rows a frame."""
        with open_run_file(self.file) as file:
            n = _count_frames(file)
            offset = read_rows(file[group + "/frame_offset"], 0, n + 1)
            time = read_rows(file["VTKHDF/Steps/Values"], 0, n)
            frames = range(n) if frame is None else range(_frame_number(frame, n), _frame_number(frame, n) + 1)
            first, last = (int(offset[frames.start]), int(offset[frames.stop])) if n else (0, 0)
            number = np.repeat(np.arange(frames.start, frames.stop), np.diff(offset[frames.start:frames.stop + 1]))
            columns, units = {"frame": number, "time": time[number]}, {"frame": "1", "time": "s"}
            for name, values in file[group].items():
                if name != "frame_offset":
                    columns[name], units[name] = read_rows(values, first, last), unit_of(values)
        return columns, units

    def _samples(self, group):
        with open_run_file(self.file) as file:
            if group not in file or "columns" not in file[group].attrs:
                return make_table({}, {})
            n = int(file[group].attrs["n_row"])
            names = text_of(file[group].attrs["columns"]).split("\n")
            columns = {name: read_rows(file[f"{group}/{name}"], 0, n) for name in names}
            return make_table(columns, {name: unit_of(file[f"{group}/{name}"]) for name in names})

    def _events(self):
        with open_run_file(self.file) as file:
            events = file["events"]
            n = int(events.attrs["n_row"])
            offset = read_rows(events["cell_offset"], 0, n + 1)
            cell = read_rows(events["cell_id"], 0, int(offset[-1]))
            columns = [read_rows(events["time"], 0, n), texts_of(read_rows(events["code"], 0, n)),
                       texts_of(read_rows(events["message"], 0, n))]
        return [(float(t), code, message, tuple(int(c) for c in cell[offset[i]:offset[i + 1]]))
                for i, (t, code, message) in enumerate(zip(*columns))]


def _count_frames(file):
    return int(file["VTKHDF/Steps"].attrs["NSteps"])


def _frame_number(k, n):
    number = int(k) + (n if int(k) < 0 else 0)
    if not 0 <= number < n:
        raise NoSuchItem(f"no frame {k}; the run has {n} so far" if n else "the run has no frame yet")
    return number
