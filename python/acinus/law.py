"""A law of the stiffness of spheres, as `acinus calibrate` writes it."""
import os

import numpy as np

from acinus.errors import Damaged, NotFound
from acinus.json_text import read_json

NEEDED = ("a0_kPa", "a1_kPa", "power", "overlap_range")


class Law:
    """The modulus of a sphere by its relative overlap with its neighbours.   [VanLiedekerke2020, Eq. (22)]"""

    def __init__(self, path):
        """path: the JSON file, or the folder it stands in. Raises NotFound, Damaged."""
        path = os.fspath(path)
        self.file = os.path.join(path, "law.json") if os.path.isdir(path) else path
        try:
            self.json = read_json(self.file, "Calibrate again.")
        except FileNotFoundError:
            raise NotFound(f"{self.file}: there is no such law. `acinus calibrate --out law.json` makes one.") from None
        missing = [key for key in NEEDED if key not in self.json]
        if missing:
            raise Damaged(f'{self.file}: has no "{missing[0]}". `acinus calibrate` writes whole law files.')

    @property
    def overlap_range(self):
        """Relative overlaps (low, high) of the fit."""
        return tuple(self.json["overlap_range"])

    @property
    def table(self):
        """Arrays (overlap, modulus in kPa) of the table; empty for a law that is a formula."""
        rows = [(row["overlap"], row["modulus_kPa"]) for row in self.json.get("table", [])]
        return tuple(np.array(rows, dtype=float).reshape(-1, 2).T)

    def formula(self, overlap):
        """a0 + a1 d^power, kPa: the fit of Eq. (22)."""
        return self.json["a0_kPa"] + self.json["a1_kPa"] * np.asarray(overlap, dtype=float) ** self.json["power"]

    def modulus(self, overlap):
        """Modulus of a sphere at this mean relative overlap, kPa: the table where there is one, else the formula;
        NaN beyond the range of the fit, where the law is not known."""
        d = np.asarray(overlap, dtype=float)
        knot, value = self.table
        found = np.interp(d, knot, value) if len(knot) else self.formula(d)
        return np.where((d >= 0) & (d <= self.overlap_range[1]), found, np.nan)

    def __repr__(self):
        return f"<law {self.file}: {self.json['a0_kPa']:.4g} + {self.json['a1_kPa']:.4g} d^{self.json['power']:g} kPa>"
