"""Loads run.xmf and compares every frame with what the writer expected.

usage: check_xdmf.py FOLDER    with run.xmf, run.vtkhdf, expected.txt in FOLDER/fast and FOLDER/none
Uses VTK's own XDMF reader where there is one (ParaView's Python has it, Debian's python3-vtk9 does
not) and otherwise follows the XML with h5py. Exit code 77: neither is installed.
"""
import os
import sys
import xml.etree.ElementTree as ElementTree

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkDataSet
    from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
    HAVE_VTK = True
except ImportError:
    HAVE_VTK = False
    try:
        import h5py
    except ImportError:
        print("neither VTK with its XDMF reader nor h5py is installed: skipped")
        sys.exit(77)

VERTEX, POLY_VERTEX, TRIANGLE = 1, 2, 5


class Block:
    """One grid, the same for both ways of reading."""

    def __init__(self, cell_type, points, connectivity, point_data, cell_data):
        self.is_triangle = cell_type == TRIANGLE
        self.points, self.connectivity = points, connectivity
        self.point_data, self.cell_data = point_data, cell_data


class VtkRun:
    def __init__(self, path):
        self.reader = vtkXdmfReader()
        self.reader.SetFileName(path)
        self.reader.UpdateInformation()
        info, key = self.reader.GetOutputInformation(0), self.reader.GetExecutive().TIME_STEPS()
        self.times = [key.Get(info, i) for i in range(key.Length(info))]

    def blocks(self, k):
        self.reader.UpdateTimeStep(self.times[k])
        return [self.block(leaf) for leaf in self.leaves(self.reader.GetOutputDataObject(0))]

    def leaves(self, data):
        if data is None:
            return []
        if isinstance(data, vtkDataSet):
            return [data] if data.GetNumberOfCells() else []
        children = [data.GetBlock(i) for i in range(data.GetNumberOfBlocks())]
        return [leaf for child in children for leaf in self.leaves(child)]

    @staticmethod
    def block(leaf):
        def arrays(data):
            names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
            return {name: vtk_to_numpy(data.GetArray(name)) for name in names}
        cell_type = leaf.GetCellType(0)
        assert cell_type in (VERTEX, POLY_VERTEX, TRIANGLE), cell_type
        connectivity = vtk_to_numpy(leaf.GetCells().GetConnectivityArray())
        return Block(cell_type, vtk_to_numpy(leaf.GetPoints().GetData()), connectivity,
                     arrays(leaf.GetPointData()), arrays(leaf.GetCellData()))


class PlainRun:
    def __init__(self, path):
        self.folder = os.path.dirname(path)
        self.frames = ElementTree.parse(path).getroot().findall("Domain/Grid/Grid")
        self.times = [float(f.find("Time").get("Value")) for f in self.frames]

    def slab(self, item):
        selection, source = item.findall("DataItem")
        numbers = [int(x) for x in selection.text.split()]
        start, stride, count = (numbers[i * len(numbers) // 3:(i + 1) * len(numbers) // 3]
                                for i in range(3))
        assert set(stride) == {1} and [int(x) for x in item.get("Dimensions").split()] == count
        name, dataset = source.text.split(":")
        with h5py.File(os.path.join(self.folder, name), "r") as file:
            return file[dataset][tuple(slice(a, a + n) for a, n in zip(start, count))]

    def blocks(self, k):
        result = []
        for grid in self.frames[k].findall("Grid"):
            data = {"Node": {}, "Cell": {}}
            for attribute in grid.findall("Attribute"):
                values = self.slab(attribute.find("DataItem"))
                data[attribute.get("Center")][attribute.get("Name")] = values
            topology = grid.find("Topology")
            cell_type = TRIANGLE if topology.get("TopologyType") == "Triangle" else VERTEX
            result.append(Block(cell_type, self.slab(grid.find("Geometry/DataItem")),
                                self.slab(topology.find("DataItem")), data["Node"], data["Cell"]))
        return result


def check_frame(k, blocks, row):
    _, n_node, n_triangle, n_sphere, id_sum = row[:5]
    n_cell = [sum(len(b.cell_data["kind"]) for b in blocks if b.is_triangle == triangle)
              for triangle in (True, False)]
    assert n_cell == [n_triangle, n_sphere], f"frame {k}: {n_cell} cells"
    for b in blocks:
        assert b.points.shape == (n_node + n_sphere, 3), f"frame {k}: {b.points.shape} points"
        bounds = [f(b.points[:, i]) for i in range(3) for f in (min, max)]
        near = [abs(x - y) < 1e-5 * max(1, abs(y)) for x, y in zip(bounds, row[5:])]
        assert all(near), f"frame {k}: bounds {bounds}"
        assert (b.cell_data["kind"] == (0 if b.is_triangle else 1)).all(), f"frame {k}: wrong kind"
        first, pressure = 0 if b.is_triangle else n_triangle, b.cell_data["pressure"]
        assert list(pressure) == [1000 * k + first + i for i in range(len(pressure))], f"frame {k}"
        force = b.point_data["force"]
        assert force.shape == b.points.shape and force[-1, 2] == k + n_node + n_sphere - 1 + 0.5
        if b.is_triangle:
            assert b.connectivity.max() == n_node - 1 and len(b.connectivity) == 3 * n_triangle
        else:  # a vertex must point at its sphere's centre, not at a mesh node
            assert list(b.connectivity) == list(range(n_node, n_node + n_sphere)), f"frame {k}"
    found = sum(int(b.cell_data["cell_id"].sum()) for b in blocks)
    assert found == id_sum, f"frame {k}: cell ids sum to {found}, expected {id_sum}"


def check_folder(folder):
    with open(os.path.join(folder, "expected.txt")) as lines:
        rows = [[float(x) for x in line.split()] for line in lines]
    rows = [[r[0], *(int(x) for x in r[1:5]), *r[5:]] for r in rows]
    path = os.path.join(folder, "run.xmf")
    run = VtkRun(path) if HAVE_VTK else PlainRun(path)
    assert run.times == [r[0] for r in rows], f"times {run.times}"
    for k in [*range(len(rows)), 3, 0, 7]:  # a user drags the time slider back and forth
        check_frame(k, run.blocks(k), rows[k])
    print(f"{folder}: {len(rows)} frames right ({type(run).__name__})")


for name in ("fast", "none"):
    check_folder(os.path.join(sys.argv[1], name))
