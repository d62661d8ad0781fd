"""What run folders hold, to compare runs that must be the same."""

import os
import re

import h5py

FILES = ["run.vtkhdf", "checkpoint.h5"]
# Of the process, not of the cells: when it ran, how often it was resumed, and for how long.
OF_THE_PROCESS = re.compile(r"provenance/(start|end|command_line)|state/attempts/.*|.*(wall|cpu)_s(@.*)?|@digest")


def read(path, but=OF_THE_PROCESS):
    """Every dataset and attribute of an HDF5 file by its name, as bytes or text."""
    found = {}

    def keep(name, item):
        for key, value in item.attrs.items():
            found[f"{name}@{key}"] = str(value)
        if isinstance(item, h5py.Dataset):
            value = item[()]
            found[name] = value.tobytes() if hasattr(value, "tobytes") else value

    with h5py.File(path, "r") as file:
        file.visititems(keep)
        for key, value in file.attrs.items():
            found[f"@{key}"] = str(value)
    return {name: value for name, value in found.items() if not but.fullmatch(name)}


def read_run(folder, but=OF_THE_PROCESS):
    return {name: read(os.path.join(folder, name), but) for name in FILES}


def differences(one, other):
    """Names of what differs between two results of read_run."""
    return [
        f"{name}:{key}" for name in FILES for key in sorted({*one[name], *other[name]})
        if one[name].get(key) != other[name].get(key)
    ]


def read_frames(path):
    """What a reader of VTKHDF sees in every frame. Frames may share what did not change, and a resumed run writes it
    once more: files differ then, frames do not."""
    found = {}
    with h5py.File(path, "r") as file:
        vtk = file["VTKHDF"]
        steps = vtk["Steps"]
        for k, time in enumerate(steps["Values"][()]):
            part = int(steps["PartOffsets"][k])

            def rows(name, offset, count):
                first = int(steps[offset][k].flat[0]) if steps[offset].ndim > 1 else int(steps[offset][k])
                found[f"frame {k}: {name}"] = vtk[name][first:first + int(vtk[count][part])].tobytes()

            found[f"frame {k}: time"] = float(time)
            rows("Points", "PointOffsets", "NumberOfPoints")
            rows("Types", "CellOffsets", "NumberOfCells")
            rows("Connectivity", "ConnectivityIdOffsets", "NumberOfConnectivityIds")
            for name in vtk["CellData"]:
                rows(f"CellData/{name}", f"CellDataOffsets/{name}", "NumberOfCells")
            for name in vtk["PointData"]:
                rows(f"PointData/{name}", f"PointDataOffsets/{name}", "NumberOfPoints")
    return found
