#!/usr/bin/python3
"""Draws one frame of a run as a picture, without a screen.

    render.py RUN_FOLDER --frame last --out picture.png --color pressure --clip y

Deformable cells are drawn as smooth surfaces, centre-based cells as spheres of their radius,
vessels and walls in translucent red. --clip removes the half nearer to the camera and closes the
cut cells. The projection is parallel: the scale bar holds everywhere in the picture. Needs the Debian packages python3-vtk9 and python3-h5py, and xvfb where there is no
screen. Reads run.vtkhdf itself, not through VTK's readers: Debian 12's shows all frames at once.
"""
import argparse
import sys

sys.dont_write_bytecode = True  # no __pycache__ in the source tree
from display import ensure_display
from labels import INK, STRIP, VESSEL_COLOR, add_background, add_bar, add_labels, add_scale_bar, add_values
from painter import Painter
from run_frame import CBM, DCM, NUCLEUS, VESSEL, Frame, UserError

# Direction from the picture's centre to the camera, and what is up.
CAMERA = {"iso": ((1.0, -1.35, 0.85), (0, 0, 1)), "top": ((0, 0, 1), (0, 1, 0)),
          "side": ((0, -1, 0), (0, 0, 1))}


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", help="run folder, or the run.vtkhdf itself")
    parser.add_argument("--frame", default="last",
                        help="number from 0, negative from the end, or last")
    parser.add_argument("--out", required=True, help="PNG file")
    parser.add_argument("--color", default=None,
                        help="kind, cell, a field, e.g. pressure (default), or a column of /cells, e.g. concentration_oxygen")
    parser.add_argument("--range", nargs=2, type=float, metavar=("LOW", "HIGH"),
                        help="of the colours, as labelled")
    parser.add_argument("--clip", choices="xyz", help="cut through the middle, across this axis")
    parser.add_argument("--only", nargs="+", type=int, default=[], metavar="ID",
                        help="draw these cells only")
    parser.add_argument("--camera", choices=CAMERA, default="iso")
    parser.add_argument("--zoom", type=float, default=1.0, help="1 (default): everything fits")
    parser.add_argument("--font", type=float, default=1.0, help="factor of the size of the letters")
    parser.add_argument("--width", type=float, metavar="UM",
                        help="of the picture, um, in place of --zoom: pictures of equal scale")
    parser.add_argument("--center", choices=("all", "cells"), default="all",
                        help="what is in the middle of the picture (default: all)")
    parser.add_argument("--size", default="1600x1200", help="WIDTHxHEIGHT in pixels")
    parser.add_argument("--show", nargs="+", default=[], metavar="NAME[=TEXT]",
                        help="write the values of these observables below the cells")
    parser.add_argument("--no-labels", action="store_true", help="without colour bar, scale bar and time")
    return parser.parse_args()


def make_poly(points, triangles):
    import numpy as np
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    poly, vtk_points, cells = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=np.float32), deep=True))
    offsets = np.arange(0, 3 * len(triangles) + 1, 3, dtype=np.int64)
    corners = np.ascontiguousarray(triangles, dtype=np.int64).ravel()
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_to_vtkIdTypeArray(corners, deep=True))
    poly.SetPoints(vtk_points)
    poly.SetPolys(cells)
    return poly


def with_normals(poly):
    import vtk
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(poly)
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.ComputePointNormalsOn()
    normals.Update()
    return normals.GetOutput()


def chosen(frame, only):
    """Which rows are of the cells `only`; all if that is empty."""
    import numpy as np
    return np.isin(frame.cell_id, only) if only else np.ones(len(frame.cell_id), bool)


def bodies(frame, only):
    """(surface, frame row, its frame points) of every cell, one by one, nuclei after their cells; of
    the cells `only` if that is not empty."""
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    kind, ids = frame.kind[:frame.n_triangle], frame.cell_id[:frame.n_triangle]
    rows = np.flatnonzero(np.isin(kind, (DCM, NUCLEUS)) & chosen(frame, only)[:frame.n_triangle])
    body = 2 * ids.astype(np.int64) + (kind == NUCLEUS)
    rows = rows[np.argsort(body[rows], kind="stable")]
    for group in np.split(rows, np.flatnonzero(np.diff(body[rows])) + 1) if len(rows) else []:
        points, local = np.unique(frame.triangle[group], return_inverse=True)
        yield with_normals(make_poly(frame.point[points], local.reshape(-1, 3))), group[0], points
    if frame.n_sphere == 0:
        return
    ball = vtk.vtkSphereSource()
    ball.SetRadius(1)
    resolution = 48 if frame.n_sphere < 500 else 24 if frame.n_sphere < 5000 else 12
    ball.SetThetaResolution(resolution)
    ball.SetPhiResolution(resolution)
    ball.Update()
    unit = vtk_to_numpy(ball.GetOutput().GetPoints().GetData())
    faces = vtk_to_numpy(ball.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
    n_node = len(frame.point) - frame.n_sphere
    radius = frame.cell_data.get("radius")
    if radius is None:
        raise UserError("the run has spheres but no field radius")
    for s in range(frame.n_sphere):
        row = frame.n_triangle + s
        if frame.kind[row] == CBM and chosen(frame, only)[row]:
            poly = make_poly(unit * radius[row] + frame.point[n_node + s], faces)
            poly.GetPointData().SetNormals(ball.GetOutput().GetPointData().GetNormals())
            yield poly, row, np.array(n_node + s)


def cut(poly, plane):
    """The part of a closed surface on the plane's normal side, and the lid that closes the cut."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    import numpy as np
    points = vtk_to_numpy(poly.GetPoints().GetData())
    side = (points - np.array(plane.GetOrigin())) @ np.array(plane.GetNormal())
    if side.min() >= 0:
        return poly, None
    if side.max() <= 0:
        return None, None
    clip = vtk.vtkClipPolyData()
    clip.SetInputData(poly)
    clip.SetClipFunction(plane)
    clip.Update()
    cutter = vtk.vtkCutter()
    cutter.SetInputData(poly)
    cutter.SetCutFunction(plane)
    stripper = vtk.vtkStripper()  # joins the segments of the cut into loops
    stripper.SetInputConnection(cutter.GetOutputPort())
    stripper.JoinContiguousSegmentsOn()
    stripper.Update()
    loops = vtk.vtkPolyData()
    loops.SetPoints(stripper.GetOutput().GetPoints())
    loops.SetPolys(stripper.GetOutput().GetLines())
    fill = vtk.vtkTriangleFilter()  # a loop may be concave: ear clipping
    fill.SetInputData(loops)
    fill.Update()
    return clip.GetOutput(), fill.GetOutput()


def joined(polys):
    import vtk
    append = vtk.vtkAppendPolyData()
    for poly in polys:
        append.AddInputData(poly)
    append.Update()
    return append.GetOutput()


def add_actor(renderer, poly, opacity=1.0, color=None, flat=False):
    import vtk
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(poly)
    if color is None:
        mapper.SetColorModeToDirectScalars()
    else:
        mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    if color is not None:
        look.SetColor(*color)
    look.SetOpacity(opacity)
    look.SetInterpolationToPhong()
    look.SetAmbient(0.30 if flat else 0.12)
    look.SetDiffuse(0.70 if flat else 0.88)
    look.SetSpecular(0.0 if flat else 0.22)
    look.SetSpecularPower(28)
    renderer.AddActor(actor)


def add_outline(renderer, polys):
    """The rim of each cut cell, so that neighbours of one colour stay apart."""
    import vtk
    rims = []
    for poly in polys:
        edges = vtk.vtkFeatureEdges()
        edges.SetInputData(poly)
        edges.BoundaryEdgesOn()
        edges.FeatureEdgesOff()
        edges.NonManifoldEdgesOff()
        edges.ManifoldEdgesOff()
        edges.ColoringOff()
        edges.Update()
        rims.append(edges.GetOutput())
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(joined(rims))
    mapper.ScalarVisibilityOff()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*INK)
    actor.GetProperty().SetLineWidth(2)
    actor.GetProperty().LightingOff()
    renderer.AddActor(actor)


def clip_plane(frame, axis, camera):
    """Through the middle of the cells; the half toward the camera goes."""
    import numpy as np
    import vtk
    i = "xyz".index(axis)
    points = frame.point[frame.own_points()]
    if len(points) == 0:
        raise UserError("--clip: the frame has no cells")
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    normal = np.zeros(3)
    normal[i] = -1.0 if CAMERA[camera][0][i] >= 0 else 1.0
    plane = vtk.vtkPlane()
    plane.SetOrigin(*middle.astype(float))
    plane.SetNormal(*normal)
    return plane


def lifted(cap, plane, i):
    """Spheres overlap, and so do their cuts: each lies a hair above the one before."""
    import vtk
    move, normal = vtk.vtkTransform(), plane.GetNormal()
    move.Translate(*(-0.002 * (i % 50) * n for n in normal))
    result = vtk.vtkTransformPolyDataFilter()
    result.SetTransform(move)
    result.SetInputData(cap)
    result.Update()
    return result.GetOutput()


def add_bodies(renderer, frame, painter, plane, only):
    surfaces, caps = [], []
    for poly, row, points in bodies(frame, only):
        painter.paint(poly, row, points)
        cap = None
        if plane is not None:
            poly, cap = cut(poly, plane)
        if poly is not None and poly.GetNumberOfCells():
            surfaces.append(poly)
        if cap is not None and cap.GetNumberOfCells():
            if painter.table is None or painter.per_cell is not None:
                painter.paint(cap, row, None)
            caps.append(lifted(cap, plane, len(caps)))
    if surfaces:
        add_actor(renderer, joined(surfaces))
    if caps:
        add_actor(renderer, joined(caps), flat=True)
        add_outline(renderer, caps)


def add_vessels(renderer, frame, plane):
    import vtk
    triangles = frame.triangle[frame.kind[:frame.n_triangle] == VESSEL]
    if len(triangles) == 0:
        return
    poly = with_normals(make_poly(frame.point, triangles))
    if plane is not None:
        clip = vtk.vtkClipPolyData()
        clip.SetInputData(poly)
        clip.SetClipFunction(plane)
        clip.Update()
        poly = clip.GetOutput()
    add_actor(renderer, poly, opacity=0.45, color=VESSEL_COLOR)


def shade_corners(renderer, frame):
    """Ambient occlusion: less light where cells meet, so that shapes read without hard shadows."""
    import vtk
    if len(frame.point) == 0:
        return
    size = float((frame.point.max(axis=0) - frame.point.min(axis=0)).max())
    steps, occlusion = vtk.vtkRenderStepsPass(), vtk.vtkSSAOPass()
    occlusion.SetRadius(0.08 * max(size, 1e-3))
    occlusion.SetBias(0.002 * max(size, 1e-3))
    occlusion.SetKernelSize(96)
    occlusion.BlurOn()
    occlusion.SetDelegatePass(steps)
    renderer.SetPass(occlusion)


def reach(renderer):
    """How far the bodies reach to either side, and up or down: 1 is the rim of the window, as it is placed now."""
    across, up = 1e-9, 1e-9
    for b in (actor.GetBounds() for actor in renderer.GetActors()):
        for i in range(8):
            renderer.SetWorldPoint(b[i & 1], b[2 + (i >> 1 & 1)], b[4 + (i >> 2)], 1)
            renderer.WorldToView()
            across, up = max(across, abs(renderer.GetViewPoint()[0])), max(up, abs(renderer.GetViewPoint()[1]))
    return across, up


def place_camera(renderer, frame, arguments, strip):
    """All bodies within what a strip at the right leaves of the window."""
    direction, up = CAMERA[arguments.camera]
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(*direction)
    camera.SetViewUp(*up)
    camera.ParallelProjectionOn()
    renderer.ResetCamera()
    if arguments.center == "cells":
        points = frame.point[frame.own_points()]
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        camera.SetPosition(*(float(m + p - f) for m, p, f in zip(middle, camera.GetPosition(), camera.GetFocalPoint())))
        camera.SetFocalPoint(*middle.astype(float))
    across, up = reach(renderer)
    fit = min(0.95 * (1 - strip) / across, 0.86 / up)
    camera.Zoom(min(fit * arguments.zoom, (1 - strip) / across) if strip > 0 else fit * arguments.zoom)
    if arguments.width:
        width_px, height_px = renderer.GetRenderWindow().GetSize()
        camera.SetParallelScale(0.5 * arguments.width * height_px / width_px)
    camera.SetWindowCenter(strip, 0)
    renderer.ResetCameraClippingRange()


def draw(arguments):
    import vtk
    try:
        width, height = (int(n) for n in arguments.size.lower().split("x"))
    except ValueError:
        raise UserError(f"--size {arguments.size}: must be WIDTHxHEIGHT, e.g. 1600x1200") from None
    frame = Frame(arguments.run, arguments.frame)
    color = arguments.color or ("pressure" if "pressure" in frame.cell_data else "kind")
    painter = Painter(frame, color, arguments.range)
    if arguments.only and not chosen(frame, arguments.only).any():
        raise UserError("--only: the frame has none of these cells")
    plane = clip_plane(frame, arguments.clip, arguments.camera) if arguments.clip else None
    renderer = vtk.vtkRenderer()
    add_background(renderer)
    add_bodies(renderer, frame, painter, plane, arguments.only)
    add_vessels(renderer, frame, plane)
    shade_corners(renderer, frame)
    lights = vtk.vtkLightKit()
    lights.SetKeyLightIntensity(0.95)
    lights.SetKeyToFillRatio(2.2)
    lights.AddLightsToRenderer(renderer)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    window.SetSize(2 * width, 2 * height)  # averaged later: smooth edges on any driver
    window.AddRenderer(renderer)
    renderer.SetUseDepthPeeling(1)
    renderer.SetMaximumNumberOfPeels(8)
    renderer.SetOcclusionRatio(0.01)
    has_bar = painter.table is not None and not arguments.no_labels
    strip = STRIP if has_bar else 0
    letter = int(arguments.font * 2 * max(height, 0.6 * width) / 27)  # pixels of the window
    place_camera(renderer, frame, arguments, strip)
    if not arguments.no_labels:
        add_labels(renderer, frame, painter, letter)
        add_scale_bar(renderer, strip, letter)
    if arguments.show:
        add_values(renderer, frame, arguments.show, letter)
    if has_bar:
        add_bar(window, painter, letter)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    half = vtk.vtkImageShrink3D()
    half.SetInputConnection(grab.GetOutputPort())
    half.SetShrinkFactors(2, 2, 1)
    half.MeanOn()
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(half.GetOutputPort())
    writer.SetFileName(arguments.out)
    writer.Write()
    if writer.GetErrorCode():
        raise UserError(f"{arguments.out}: cannot be written")


def main():
    arguments = read_arguments()
    try:
        ensure_display(__file__)
        draw(arguments)
    except UserError as error:
        print(f"render.py: {error}", file=sys.stderr)
        return 2
    except ImportError as error:
        print(f"render.py: {error}. Install python3-vtk9 and python3-h5py.", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
