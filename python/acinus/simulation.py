"""Simulations driven from Python: the module that `./acinus.sh python` builds (docs/howto/python.md)."""
import json
import math
import os
import re
import warnings

import numpy as np

from acinus.errors import AcinusError, BadInput, NoSuchItem
from acinus.field import Field
from acinus.law import Law
from acinus.run import Run
from acinus.tables import make_table, sort_by_id

SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0, "d": 86400.0}
SAME_TIME = 1e-6  # s, round-off of times
UNITS = {"center_x": "um", "center_y": "um", "center_z": "um", "radius": "um", "volume": "um^3", "area": "um^2", "contact_area": "um^2",
         "pressure": "kPa", "cytosol_pressure": "kPa", "contact_force": "nN", "normal_force": "nN", "migration_force": "nN"}


def _native():
    try:
        from acinus import _native as native
    except ImportError as error:
        raise AcinusError(f"this package was installed without the simulator, which only reads runs ({error}). In "
                          "the source folder `./acinus.sh python` builds it and says what to put into PYTHONPATH.") from error
    return native


def _changes(changes):
    """{"time.end": "2 h", "cells.count": 8} as the program's --set has them."""
    return [f"{key}={value if isinstance(value, str) else json.dumps(value)}" for key, value in (changes or {}).items()]


def seconds(time):
    """A time in s, or a text like "2 h". Raises BadInput."""
    advice = f"a time is a finite number of s, or a text like \"2 h\" ({', '.join(SECONDS)})"
    number, factor = time, 1.0
    if isinstance(time, str):
        parts = re.fullmatch(r"\s*(\S*\d\.?)\s*([a-z]+)\s*", time)
        if parts is None or parts[2] not in SECONDS:
            raise BadInput(f'"{time}": {advice}')
        number, factor = parts[1], SECONDS[parts[2]]
    try:
        value = factor * float(number)
    except (TypeError, ValueError):
        value = math.nan
    if not math.isfinite(value):
        raise BadInput(f"{time!r}: {advice}")
    return value


class Simulation:
    """A scene that is stepped, looked at and changed from Python.

        sim = acinus.Simulation("lobule_hybrid", {"start_up.growth_time": "30 min"})
        sim.run(until="1 h")
        sim.run_for("10 min")
        sim.cells()["pressure"]

    Lengths um, times s, forces nN, stresses kPa. Not for several threads at once.
    """

    def __init__(self, scene, set=None, threads=1):
        """scene: a file or the name of a shipped scene; set: key -> value. Raises BadInput, FileError."""
        self._sim = _native().Simulation(os.fspath(scene), _changes(set), threads)

    def __repr__(self):
        return f"<simulation of {self._sim.name}: {self._sim.n_cell} cells at t = {self.time:g} s>"

    def run(self, until=None):
        """Steps to a time since t = 0, through start-up.

        until: s, or a text like "2 h"; None: the end of the scene. The state has the same bits as in `acinus run` at the end of the
        scene and at times of frames. Raises BadInput for a time that is past, and CannotContinue if a step cannot be accepted; the
        state is then the last good one. Ctrl-C ends it after a whole step.
        """
        end = self.end if until is None else seconds(until)
        if self._sim.is_running and end < self.time - SAME_TIME:
            raise BadInput(f"until t = {end:g} s: the simulation is at t = {self.time:g} s already. "
                           "run_for(duration) steps on from there.")
        self._sim.run_until(end)

    def run_for(self, duration):
        """Steps on by a duration (s, or a text like "10 min") from now, also beyond the end of the scene.

        A start-up that is not over runs first and does not count: the duration then begins at t = 0. Otherwise as run().
        """
        length = seconds(duration)
        if length < 0:
            raise BadInput(f"run_for({duration!r}): a duration is not negative")
        self.run(until=(self.time if self._sim.is_running else 0.0) + length)

    def step(self):
        """One accepted step with what happens after it; returns its length, s."""
        self._sim.step()
        return self._sim.last_step

    time = property(lambda self: self._sim.time, doc="s since t = 0; negative during start-up")
    end = property(lambda self: self._sim.end, doc="s, of the scene")
    steps = property(lambda self: self._sim.steps, doc="accepted so far, start-up included")
    state_hash = property(lambda self: f"{self._sim.hash:016x}", doc="as in summary.json: equal bits give equal hashes")
    scene = property(lambda self: json.loads(self._sim.scene_text), doc="the scene with every default filled in")
    cell_types = property(lambda self: self._sim.type_names, doc="names, by number")

    def __len__(self):
        """Number of cells."""
        return self._sim.n_cell

    def cells(self):
        """One row per cell, sorted by id, as run.cells(frame) has them; takes an assembly of all forces."""
        units = dict(UNITS)
        for name, unit, _ in self._sim.fields()[2]:
            units |= {f"concentration_{name}": unit, f"exchange_{name}": "um^3/s" if unit == "1" else f"{unit} um^3/s"}
        return make_table(sort_by_id(self._sim.cells()), units)

    def field(self, name):
        """Concentration of a substance now, as run.field(name) has it: value (nz, ny, nx), origin, spacing, unit, time. A copy."""
        origin, spacing, fields = self._sim.fields()
        for found, unit, value in fields:
            if found == name:
                return Field(name, unit, self.time, value, np.array(origin), np.array(spacing))
        raise NoSuchItem(f"{self._sim.name}: has no field {name}, but {', '.join(f[0] for f in fields) or 'no substances'}")

    def nodes(self, cell):
        """(n, 3) um, a view of a deformable cell's surface without a copy: read-only. It shows the moment it was taken in
        also after the simulation went on."""
        return self._item(self._sim.nodes, cell)

    def triangles(self, cell):
        """(t, 3) corners as rows of nodes(cell)."""
        return self._item(self._sim.triangles, cell)

    def spheres(self):
        """ids (n,) and centres (n, 3) um of the spheres; a copy."""
        ids = np.asarray(self._sim.sphere_ids, dtype=np.int64)
        return ids, self.sphere_rows().reshape(-1, 3)[:len(ids)]

    def sphere_rows(self):
        """(rows, 8, 3) um without a copy: sphere k is [k // 8, k % 8]."""
        return self._sim.sphere_rows()

    def move(self, cell, points):
        """Puts the nodes of a deformable cell, or the centre of a sphere, elsewhere: (n, 3) um."""
        self._item(self._sim.move, cell, np.atleast_2d(np.asarray(points, dtype=float)))

    def pull(self, cell, force):
        """A constant load on a cell, (3,) nN; zero ends it."""
        self._item(self._sim.pull, cell, [float(f) for f in force])

    def _item(self, call, cell, *arguments):
        try:
            return call(int(cell), *arguments)
        except AcinusError as error:
            raise (NoSuchItem(str(error)) if str(error).startswith("there is no") else error) from None


def simulate(scene, out, set=None, threads=1, overwrite=False, resume=False):
    """`acinus run`: simulates a scene into a run folder. Returns the acinus.Run; status tells how it ended."""
    _native().run(os.fspath(scene), os.fspath(out), _changes(set), threads, overwrite, resume)
    return Run(out)


def calibrate(scene, out, set=None, cells=0, relaxation=True, threads=1):
    """`acinus calibrate`: the law that makes spheres resist compression like deformable cells. Takes minutes; returns acinus.Law."""
    code = _native().calibrate(os.fspath(scene), os.fspath(out), _changes(set), cells, relaxation, threads)
    if code == 75:
        raise KeyboardInterrupt
    if code != 0:
        raise AcinusError(f"{out}: calibration ended with exit code {code}")
    return Law(out)


def compare(*runs):
    """`acinus compare`: how runs differ from the first one, one row per run and quantity.

    runs: run folders or acinus.Run. change is that of the value, relative to the reference, with its sign. rms is the difference over
    time, of positions and cell_ quantities over cells. difference is the rms, or the size of the change where there is no rms; it is
    relative unless absolute is True. A row whose not_measured is not empty is no ground for a verdict: it says why, for example that a
    run failed or was stopped before its end. Such things are warned of too.
    """
    folders = [r.folder if isinstance(r, Run) else os.fspath(r) for r in runs]
    rows, notes = _native().compare(folders)
    for note in notes:
        warnings.warn(note, stacklevel=2)
    kinds = {"run": object, "quantity": object, "unit": object, "reference": float, "value": float, "difference": float, "absolute": bool,
             "not_measured": object, "change": float, "rms": float}
    columns = {name: np.array([row[k] for row in rows], dtype=kind) for k, (name, kind) in enumerate(kinds.items())}
    return make_table(columns, {})
