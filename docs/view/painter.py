"""From the values of a field to colours; used by render.py."""
from run_frame import CBM, DCM, NUCLEUS, VESSEL

KIND_COLOR = {DCM: (0.93, 0.62, 0.36), CBM: (0.36, 0.58, 0.82), NUCLEUS: (0.62, 0.36, 0.55)}
# Control points of the colour maps: one for values of one sign, one for both signs.
SEQUENTIAL = [(0.33, 0.33, 0.66), (0.22, 0.55, 0.74), (0.35, 0.74, 0.66), (0.75, 0.86, 0.45),
              (0.98, 0.79, 0.28)]
DIVERGING = [(0.13, 0.30, 0.62), (0.49, 0.68, 0.84), (0.95, 0.95, 0.93), (0.95, 0.63, 0.45),
             (0.70, 0.09, 0.17)]


def cell_color(cell_id):
    """A colour for a cell by its id: neighbours in number are far apart in hue."""
    import colorsys
    return colorsys.hsv_to_rgb((0.61803398875 * (int(cell_id) + 1)) % 1.0, 0.42, 0.92)


def color_table(low, high):
    """Colours of the values from low to high. Where zero lies between them it is white, and values
    as far from it are as strong: of the map of both signs only that part is used."""
    import vtk

    def table_of(points):
        table = vtk.vtkColorTransferFunction()
        table.SetColorSpaceToLab()
        for value, color in points:
            table.AddRGBPoint(value, *color)
        return table

    def spread(colors, first, last):
        return [(first + (last - first) * i / (len(colors) - 1), color)
                for i, color in enumerate(colors)]

    if not low < 0 < high:
        return table_of(spread(SEQUENTIAL, low, high))
    largest = max(-low, high)
    points = spread(DIVERGING, -largest, largest)
    whole = table_of(points)
    inside = [(value, color) for value, color in points if low < value < high]
    return table_of([(low, whole.GetColor(low)), *inside, (high, whole.GetColor(high))])


class Painter:
    """Turns field values into colours, the same for every body."""

    def __init__(self, frame, name, limits):
        import numpy as np
        self.frame, self.name, self.table = frame, name, None
        if name in ("kind", "cell"):
            return
        self.per_cell, self.per_point, self.unit = frame.colored_by(name)
        if self.per_cell is not None:
            shown = self.per_cell[frame.kind != VESSEL]
        else:
            shown = self.per_point[frame.own_points()]
        low, high = limits or (np.percentile(shown, (1, 99)) if len(shown) else (0, 1))
        if limits is None and low < 0 < high and min(-low, high) > 0.2 * max(-low, high):
            low, high = -max(-low, high), max(-low, high)
        if high - low <= 1e-9 * max(abs(low), abs(high), 1e-30):
            low, high = low - 0.5, high + 0.5
        self.table = color_table(low, high)

    def paint(self, poly, row, points):
        """Colours a body that comes from frame row `row`; `points` are its frame points."""
        import numpy as np
        from vtk.util.numpy_support import numpy_to_vtk
        n_cell, n_point = poly.GetNumberOfCells(), poly.GetNumberOfPoints()
        if self.table is None:
            color = (KIND_COLOR[int(self.frame.kind[row])] if self.name == "kind"
                     else cell_color(self.frame.cell_id[row]))
            rgb, target = np.tile(color, (n_cell, 1)), poly.GetCellData()
        elif self.per_cell is not None:
            color = self.table.GetColor(self.per_cell[row])
            rgb, target = np.tile(color, (n_cell, 1)), poly.GetCellData()
        else:
            values = self.per_point[points]
            values = np.broadcast_to(values, n_point) if values.ndim == 0 else values
            rgb, target = np.array([self.table.GetColor(v) for v in values]), poly.GetPointData()
        array = numpy_to_vtk((255 * rgb).astype(np.uint8), deep=True)
        array.SetName("color")
        target.SetScalars(array)
