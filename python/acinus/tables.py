"""Tables of columns: a pandas.DataFrame where pandas is installed, else a small table with the same access to columns."""
import numpy as np

from acinus.errors import NoSuchItem

try:
    import pandas
except ImportError:
    pandas = None

COMPONENTS = {3: ("x", "y", "z"), 6: ("xx", "xy", "xz", "yy", "yz", "zz")}


class Table:
    """Columns of equal length.

    `table["pressure"]` is a column (numpy array), `table[["id", "pressure"]]` a table of some columns, and
    `table[mask]` a table of some rows. `attrs["units"]` says the unit of each column.
    """

    def __init__(self, columns, attrs=None):
        self._columns = dict(columns)
        self.attrs = dict(attrs or {})

    @property
    def columns(self):
        """Names of the columns."""
        return list(self._columns)

    def __len__(self):
        return len(next(iter(self._columns.values()), ()))

    def __contains__(self, name):
        return name in self._columns

    def __iter__(self):
        return iter(self._columns)

    def __getitem__(self, key):
        if isinstance(key, str):
            if key not in self._columns:
                raise NoSuchItem(f'no column "{key}"; there are {", ".join(self._columns)}')
            return self._columns[key]
        if isinstance(key, list) and all(isinstance(k, str) for k in key):
            return Table({k: self[k] for k in key}, self.attrs)
        return Table({name: values[key] for name, values in self._columns.items()}, self.attrs)

    def __repr__(self):
        return f"<table of {len(self)} rows: {', '.join(self._columns)}>"


def sort_by_id(columns):
    """Columns with their rows sorted by the column `id`, within each frame where there is a column `frame`.

    columns: name -> array of n rows
    """
    order = np.lexsort([columns[name] for name in ("id", "frame") if name in columns])
    return {name: np.asarray(values)[order] for name, values in columns.items()}


def make_table(columns, units):
    """A table of one-dimensional columns; vectors (n, 3) and stresses (n, 6) become columns of their own, named
    `center_x` and so on.

    columns: name -> array of n rows;  units: name -> text
    """
    flat, unit = {}, {}
    for name, values in columns.items():
        values = np.asarray(values)
        if values.ndim == 1:
            flat[name], unit[name] = values, units.get(name, "1")
            continue
        for k, component in enumerate(COMPONENTS.get(values.shape[1], range(values.shape[1]))):
            flat[f"{name}_{component}"] = values[:, k]
            unit[f"{name}_{component}"] = units.get(name, "1")
    if pandas is None:
        return Table(flat, {"units": unit})
    frame = pandas.DataFrame(flat)
    frame.attrs["units"] = unit
    return frame
