"""One moment of a run."""
from dataclasses import dataclass, field

import numpy as np

from acinus.errors import NoSuchItem
from acinus.hdf5 import read_rows

#: Values of Frame.kind.
DEFORMABLE, SPHERE, VESSEL, NUCLEUS = 0, 1, 2, 3


@dataclass(frozen=True)
class Spheres:
    """The spheres of a frame, n of them."""

    id: np.ndarray  #: (n,) ids of the cells
    center: np.ndarray  #: (n, 3) um
    radius: np.ndarray  #: (n,) um


@dataclass(frozen=True)
class Frame:
    """Geometry and fields of one moment: n points, t triangles, s spheres.

    Grid cells are all triangles, then one per sphere. Lengths um, forces nN, stresses kPa.
    """

    index: int  #: number of the frame, from 0
    time: float  #: s since the start; negative in a start-up
    points: np.ndarray  #: (n, 3) um: nodes of cells, of vessels, then centres of spheres
    triangles: np.ndarray  #: (t, 3) rows of points
    kind: np.ndarray  #: (t + s,) DEFORMABLE, SPHERE, VESSEL or NUCLEUS
    cell_id: np.ndarray  #: (t + s,) id of the cell; -1: none
    cell_data: dict = field(repr=False)  #: name -> (t + s,) values of the cell on each grid cell
    point_data: dict = field(repr=False)  #: name -> (n,) or (n, 3)

    @property
    def spheres(self):
        """Ids, centres and radii of the spheres."""
        t = len(self.triangles)
        n = len(self.kind) - t
        return Spheres(self.cell_id[t:], self.points[len(self.points) - n:], self.cell_data["radius"][t:])

    @property
    def deformable(self):
        """Ids of the deformable cells, rising."""
        return np.unique(self.cell_id[:len(self.triangles)][self.kind[:len(self.triangles)] == DEFORMABLE])

    def mesh(self, cell_id, kind=DEFORMABLE):
        """Points (m, 3) in um and triangles (k, 3) of one cell; kind NUCLEUS: of its nucleus; of VESSEL with cell_id -1.

        Raises NoSuchItem.
        """
        t = len(self.triangles)
        own = (self.cell_id[:t] == cell_id) & (self.kind[:t] == kind)
        if not own.any():
            raise NoSuchItem(f"frame {self.index} has no surface of cell {cell_id}; deformable are "
                             f"{list(map(int, self.deformable[:20]))}{' ...' if len(self.deformable) > 20 else ''}")
        rows, local = np.unique(self.triangles[own], return_inverse=True)
        return self.points[rows], local.reshape(-1, 3)


def read_frame(file, k):
    """Frame k of an open run file."""
    grid, steps = file["VTKHDF"], file["VTKHDF/Steps"]
    part = int(steps["PartOffsets"][k])
    n_point, n_cell = int(grid["NumberOfPoints"][part]), int(grid["NumberOfCells"][part])
    n_triangle = (int(grid["NumberOfConnectivityIds"][part]) - n_cell) // 2
    first = int(steps["PointOffsets"][k])
    corner = int(steps["ConnectivityIdOffsets"][k, 0])

    def fields(group, n):
        offsets = steps[group + "Offsets"]
        return {name: read_rows(values, int(offsets[name][k]), int(offsets[name][k]) + n)
                for name, values in grid[group].items()}

    cell_data = fields("CellData", n_cell)
    return Frame(k, float(steps["Values"][k]), read_rows(grid["Points"], first, first + n_point),
                 read_rows(grid["Connectivity"], corner, corner + 3 * n_triangle).reshape(-1, 3),
                 cell_data.pop("kind"), cell_data.pop("cell_id"), cell_data, fields("PointData", n_point))
