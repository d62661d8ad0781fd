"""Import of a label image that is larger than the memory it may take, in every format that is read block by block.

usage: large_image.py PROGRAM [SIDE [CELLS [PITCH [FORMAT ...]]]]

Writes an image of SIDE^3 voxels of 32 bits with CELLS^3 balls, cut flat where they touch, in a corner, and imports it. The largest memory of the
program must stay below LIMIT of the bytes of the labels, and each cell must have the voxels that were written. Prints time and memory; exit code 1
beyond a limit.
"""

import csv
import json
import os
import shutil
import struct
import sys
import tempfile
import time
import zlib

import h5py
import numpy as np

LIMIT = 0.4
MARGIN = 8  # voxels before the first cell
CHUNK = 64  # voxels


class Balls:
    """Label image, made slice by slice."""

    def __init__(self, side, cells, pitch):
        self.side, self.cells = side, cells
        x = np.arange(side) - MARGIN
        self.site = np.where((x >= 0) & (x < cells * pitch), x // pitch, -1)
        self.offset = x % pitch - (pitch - 1) / 2
        self.reach = (0.54 * pitch) ** 2

    def slice(self, z):
        """Labels [y][x] of a slice."""
        out = np.zeros((self.side, self.side), "<u4")
        if self.site[z] < 0:
            return out
        square = self.offset**2
        inside = square[:, None] + square[None, :] < self.reach - square[z]
        inside &= (self.site[:, None] >= 0) & (self.site[None, :] >= 0)
        label = 1 + self.site[None, :] + self.cells * (self.site[:, None] + self.cells * self.site[z])
        out[inside] = label[inside]
        return out

    def slab(self, z):
        """Labels of the slices of one layer of chunks."""
        return np.stack([self.slice(k) for k in range(z, min(z + CHUNK, self.side))])


def write_nrrd(path, image):
    with open(path, "wb") as f:
        f.write(b"NRRD0004\ntype: uint32\ndimension: 3\nsizes: %d %d %d\nspacings: 1 1 1\nunits: \"um\" \"um\" \"um\"\n"
                b"endian: little\nencoding: raw\n\n" % (3 * (image.side,)))
        for z in range(image.side):
            f.write(image.slice(z).tobytes())


def write_tiff(path, image):
    """BigTIFF without compression, a strip a page."""
    n = image.side
    text = b"ImageJ=1.53t\nimages=%d\nslices=%d\nunit=micron\nspacing=1\n\0" % (n, n)
    with open(path, "wb") as f:
        f.write(struct.pack("<2sHHHQ", b"II", 43, 8, 0, 16 + len(text)) + text)
        for z in range(n):
            one = struct.pack("<II", 1, 1)
            tags = [(256, 4, 1, n), (257, 4, 1, n), (258, 3, 1, 32), (259, 3, 1, 1), (262, 3, 1, 1)]
            count = 11 if z else 12
            data = f.tell() + 8 + 20 * count + 8
            tags += [] if z else [(270, 2, len(text), 16)]
            tags += [(273, 16, 1, data), (277, 3, 1, 1), (278, 4, 1, n), (279, 16, 1, 4 * n * n),
                     (282, 5, 1, int.from_bytes(one, "little")), (283, 5, 1, int.from_bytes(one, "little"))]
            f.write(struct.pack("<Q", count))
            for tag in tags:
                f.write(struct.pack("<HHQQ", *tag))
            f.write(struct.pack("<Q", data + 4 * n * n if z + 1 < n else 0))
            f.write(image.slice(z).tobytes())


def write_zarr(path, image):
    n = image.side
    os.makedirs(path + "/0")
    axes = [{"name": a, "type": "space", "unit": "micrometer"} for a in "zyx"]
    scale = [{"type": "scale", "scale": [1, 1, 1]}]
    with open(path + "/.zgroup", "w") as f:
        json.dump({"zarr_format": 2}, f)
    with open(path + "/.zattrs", "w") as f:
        json.dump({"multiscales": [{"version": "0.4", "axes": axes, "datasets": [{"path": "0", "coordinateTransformations": scale}]}],
                   "image-label": {"version": "0.4"}}, f)
    with open(path + "/0/.zarray", "w") as f:
        json.dump({"zarr_format": 2, "shape": 3 * [n], "chunks": 3 * [CHUNK], "dtype": "<u4", "compressor": {"id": "zlib", "level": 1},
                   "fill_value": 0, "order": "C", "filters": None, "dimension_separator": "."}, f)
    for z in range(0, n, CHUNK):
        slab = image.slab(z)
        for y in range(0, n, CHUNK):
            for x in range(0, n, CHUNK):
                whole = np.zeros(3 * (CHUNK,), "<u4")
                part = slab[:, y:y + CHUNK, x:x + CHUNK]
                if not part.any():
                    continue
                whole[tuple(slice(s) for s in part.shape)] = part
                with open(path + f"/0/{z // CHUNK}.{y // CHUNK}.{x // CHUNK}", "wb") as f:
                    f.write(zlib.compress(whole.tobytes(), 1))


def write_hdf5(path, image):
    n = image.side
    with h5py.File(path, "w") as f:
        d = f.create_dataset("labels", (n, n, n), "<u4", chunks=3 * (CHUNK,), compression="gzip", compression_opts=1)
        d.attrs["element_size_um"] = [1.0, 1.0, 1.0]
        for z in range(0, n, CHUNK):
            slab = image.slab(z)
            if slab.any():
                d[z:z + len(slab)] = slab


def count_voxels(image):
    count = np.zeros(image.cells**3 + 1, np.int64)
    for z in range(image.side):
        if image.site[z] >= 0:
            count += np.bincount(image.slice(z).ravel(), minlength=len(count))
    return {k: int(n) for k, n in enumerate(count) if k > 0}


def write_apart(write, path, image):
    """Calls write in a process of its own: the memory of this one would count as that of the program it starts."""
    child = os.fork()
    if child == 0:
        write(path, image)
        os._exit(0)
    _, status = os.waitpid(child, 0)
    assert status == 0, path


def write_counts(path, image):
    with open(path, "w") as f:
        json.dump(count_voxels(image), f)


def import_image(program, path, out):
    """Largest memory, bytes, and wall time, s, of an import."""
    begin = time.monotonic()
    child = os.posix_spawn(program, [program, "import", path, "--out", out, "--model", "cbm", "--quiet"], os.environ)
    _, status, used = os.wait4(child, 0)
    assert os.waitstatus_to_exitcode(status) == 0, path
    return 1024 * used.ru_maxrss, time.monotonic() - begin


FORMATS = {"nrrd": write_nrrd, "tif": write_tiff, "zarr": write_zarr, "h5": write_hdf5}


def main():
    program = sys.argv[1]
    side, cells, pitch = (int(v) for v in (sys.argv[2:5] + ["400", "3", "30"][len(sys.argv[2:5]):]))
    image = Balls(side, cells, pitch)
    labels = 4 * side**3
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        write_apart(write_counts, folder + "/counts.json", image)
        with open(folder + "/counts.json") as f:
            wanted = {int(k): n for k, n in json.load(f).items()}
        for ending in sys.argv[5:] or FORMATS:
            path, out = f"{folder}/labels.{ending}", f"{folder}/{ending}"
            write_apart(FORMATS[ending], path, image)
            memory, seconds = import_image(program, path, out)
            with open(out + "/cells.csv") as f:
                found = {int(row["label"]): int(row["voxels"]) for row in csv.DictReader(f)}
            right = found == wanted and memory < LIMIT * labels
            failed |= not right
            print(f"{ending}: {side}^3 voxels, {1e-6 * labels:.0f} MB of labels, {len(found)} of {len(wanted)} cells: "
                  f"{1e-6 * memory:.0f} MB, {seconds:.1f} s{'' if right else ': WRONG'}", flush=True)
            shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)
    sys.exit(1 if failed else 0)


main()
