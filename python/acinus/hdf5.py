"""How run files are opened; nothing else of the package knows HDF5."""
import contextlib
import os
import time

import h5py
import numpy as np

from acinus.errors import AcinusError, Damaged, NotFound

#: A run that goes on may be writing while we open: tried again so often, s apart.
ATTEMPTS, PAUSE = 5, 0.1
#: Compressed data is at most so many times smaller.
MOST_PACKED = 1100
#: Groups and datasets that are missing, of another kind or shape, or cannot be unpacked.
WHAT_DAMAGE_RAISES = (AttributeError, IndexError, KeyError, MemoryError, OSError, RuntimeError, TypeError, ValueError)


def _open(path):
    for attempt in range(ATTEMPTS):
        try:
            return h5py.File(path, "r")
        except OSError as error:
            if attempt + 1 == ATTEMPTS:
                raise Damaged(
                    f"{path}: cannot be opened as HDF5 ({error}). Is it cut short or not a run file? `acinus run SCENE "
                    "--resume` in its folder mends what a crash left; else copy the file again.") from error
            time.sleep(PAUSE)
    raise AssertionError  # not reached


@contextlib.contextmanager
def open_run_file(path, expected="acinus/run"):
    """The run file of that path, or one with another schema, for the time of a `with`; checks that it is one.

    Raises NotFound, Damaged.
    """
    if not os.path.exists(path):
        raise NotFound(f"{path}: there is no such file. Give a run folder, or a run.vtkhdf itself.")
    with _open(path) as file:
        schema = file.attrs.get("schema", b"")
        if text_of(schema) != expected:
            raise Damaged(f"{path}: is not a run file of acinus (schema \"{text_of(schema)}\", expected \"{expected}\"). "
                          "Give the run.vtkhdf of a run folder.")
        version = [int(v) for v in file.attrs.get("schema_version", [0])]
        if version[0] != 1:
            raise Damaged(f"{path}: has schema version {version[0]}, this package reads 1. Update the package.")
        try:
            yield file
        except AcinusError:
            raise
        except WHAT_DAMAGE_RAISES as error:
            raise Damaged(f"{path}: {type(error).__name__}: {error}. The file is damaged or incomplete; `acinus run SCENE "
                          "--resume` in its folder says which frames are left.") from error


def text_of(value):
    """A text of HDF5 as str."""
    if isinstance(value, h5py.Dataset):
        value = value[()]
    if isinstance(value, bytes):
        return value.decode("utf-8", "replace").rstrip("\0")
    return str(value)


def texts_of(values):
    """Rows of text as an array of str."""
    return np.array([text_of(v) for v in values], dtype=object)


def unit_of(dataset):
    """Its attribute `unit`; "1" for numbers without one."""
    return text_of(dataset.attrs.get("unit", b"1"))


def read_rows(dataset, first, last):
    """Rows first:last of a dataset.

    Raises Damaged where it has fewer.
    """
    if not 0 <= first <= last <= dataset.shape[0]:
        raise Damaged(f"{dataset.file.filename}: {dataset.name} has {dataset.shape[0]} rows, but rows {first} to {last} should "
                      "be there. The file is damaged or incomplete.")
    row = dataset.dtype.itemsize * int(np.prod(dataset.shape[1:], dtype=float))
    if (last - first) * row > MOST_PACKED * max(dataset.id.get_storage_size(), 1000):
        raise Damaged(f"{dataset.file.filename}: {dataset.name} claims more than is stored of it. The file is damaged.")
    return dataset[first:last]
