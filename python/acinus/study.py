"""The folder of a study, read."""
import csv
import os

import numpy as np

from acinus.errors import Damaged, NoSuchItem, NotFound
from acinus.json_text import read_json
from acinus.run import Run
from acinus.tables import make_table

NUMBERS = {"seed": int, "time_s": float, "value": float, "simulated_s": float, "wall_s": float, "cpu_s": float}


class Study:
    """What `acinus study` leaves: one table, the state of the runs, verdicts and the runs themselves."""

    def __init__(self, path):
        """Raises NotFound."""
        self.folder = os.fspath(path)
        if not os.path.exists(os.path.join(self.folder, "table.csv")):
            raise NotFound(f"{self.folder}: has no table.csv. Give the folder that `acinus study` has written.")

    def table(self):
        """run, variant, seed, time_s, observable, value, unit; one row per value."""
        return self._csv("table.csv")

    def runs(self):
        """State, cost and last state of every run."""
        return self._csv("runs.csv")

    def verdicts(self):
        """A list of claims: what was expected, what came out, and whether it holds."""
        path = os.path.join(self.folder, "verdicts.json")
        try:
            return read_json(path, "The same `acinus study` command writes it again.", list)
        except FileNotFoundError:
            return []

    def run(self, variant, seed):
        """The Run of a variant and seed."""
        folder = os.path.join(self.folder, "runs", str(variant), f"seed_{seed}")
        if not os.path.isdir(folder):
            known = sorted(os.listdir(os.path.join(self.folder, "runs")))
            raise NoSuchItem(f"{folder}: there is no such run; variants are {', '.join(known)}")
        return Run(folder)

    def _csv(self, name):
        path = os.path.join(self.folder, name)
        try:
            with open(path, encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
        except FileNotFoundError:
            raise NotFound(f"{path}: is not there. The same `acinus study` command writes it.") from None
        except (csv.Error, UnicodeDecodeError) as error:
            raise Damaged(f"{path}: is no table ({error}). The same `acinus study` command writes it again.") from error
        columns = {}
        for key in rows[0] if rows else ():
            convert = NUMBERS.get(key, str)
            try:
                values = [convert(row[key]) if row[key] not in (None, "") or convert is str else np.nan for row in rows]
            except ValueError as error:
                raise Damaged(f"{path}: column {key}: {error}. The same `acinus study` command writes it again.") from error
            columns[key] = np.array(values, dtype=object if convert is str else None)
        return make_table(columns, {"time_s": "s", "simulated_s": "s", "wall_s": "s", "cpu_s": "s"})
