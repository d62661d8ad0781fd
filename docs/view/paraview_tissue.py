"""Draws a run in ParaView as the pictures of this project do: cells, spheres with their radius, vessels.

From a shell, without a screen too (Debian: paraview, python3-paraview):

    pvpython docs/view/paraview_tissue.py lobule_hybrid.run --png lobule.png

In ParaView: open run.xmf with "XDMF Reader" (5.11 or older) or run.vtkhdf (5.12 or newer), Apply, choose it in the
pipeline, then Macros > Import new macro ... > this file. The macro adds to what is there; Apply is not needed.
"""
import os
import sys

DEFORMABLE, SPHERE, VESSEL, NUCLEUS = 0, 1, 2, 3  # CellData/kind
COLOUR = {DEFORMABLE: (0.93, 0.62, 0.36), SPHERE: (0.36, 0.58, 0.82), VESSEL: (0.80, 0.32, 0.30), NUCLEUS: (0.62, 0.36, 0.55)}
OPACITY = {VESSEL: 0.35}
NAME = {DEFORMABLE: "deformable cells", SPHERE: "spheres", VESSEL: "vessels and walls", NUCLEUS: "nuclei"}


def part(source, kind):
    """The cells of one kind as a source of its own."""
    from paraview import simple

    threshold = simple.Threshold(registrationName=NAME[kind], Input=source)
    threshold.Scalars = ["CELLS", "kind"]
    threshold.ThresholdMethod = "Between"
    threshold.LowerThreshold = threshold.UpperThreshold = kind
    return threshold


def balls(spheres):
    """Spheres stand in the file as points with a radius."""
    from paraview import simple

    points = simple.CellCenters(Input=spheres)
    points.VertexCells = 1
    glyph = simple.Glyph(registrationName=NAME[SPHERE] + ", drawn", Input=points, GlyphType="Sphere")
    glyph.GlyphType.ThetaResolution = glyph.GlyphType.PhiResolution = 24
    glyph.ScaleArray = ["POINTS", "radius"]
    glyph.ScaleFactor = 2.0  # ParaView's sphere has the diameter 1
    glyph.GlyphMode = "All Points"
    return glyph


def draw(source, view, colour_by=None):
    """Shows a run in a view. colour_by: a field of cells ("pressure"); None: by model. Returns what is shown, by kind."""
    from paraview import simple

    simple.Hide(source, view)
    shown = {}
    for kind in NAME:
        of_kind = part(source, kind)
        of_kind.UpdatePipeline(view.ViewTime)
        if of_kind.GetDataInformation().GetNumberOfCells() == 0:
            simple.Delete(of_kind)
            continue
        drawn = balls(of_kind) if kind == SPHERE else of_kind
        display = simple.Show(drawn, view)
        display.Representation = "Surface"
        display.DiffuseColor = display.AmbientColor = COLOUR[kind]
        display.Opacity = OPACITY.get(kind, 1.0)
        display.Interpolation = "Gouraud"
        simple.ColorBy(display, None)
        if colour_by and kind in (DEFORMABLE, SPHERE):
            simple.ColorBy(display, ("POINTS" if kind == SPHERE else "CELLS", colour_by))
            display.RescaleTransferFunctionToDataRange(True, False)
        shown[kind] = drawn
    return shown


def open_run(folder):
    """The reader of a run folder that this ParaView can use."""
    from paraview import simple

    if simple.GetParaViewVersion() >= (5, 12):
        return simple.OpenDataFile(os.path.join(folder, "run.vtkhdf"))
    return simple.XDMFReader(FileNames=[os.path.join(folder, "run.xmf")])


def main(words):
    import argparse

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", help="run folder")
    parser.add_argument("--png", required=True)
    parser.add_argument("--time", type=float, help="s; the last frame by default")
    parser.add_argument("--color", help="a field of cells, such as pressure")
    parser.add_argument("--size", default="1200x900")
    a = parser.parse_args(words)
    from paraview import simple

    width, height = (int(n) for n in a.size.split("x"))
    view = simple.CreateRenderView()
    view.ViewSize = [width, height]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    reader = open_run(a.run)
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues) if hasattr(reader.TimestepValues, "__iter__") else [reader.TimestepValues]
    view.ViewTime = min(times, key=lambda t: abs(t - a.time)) if a.time is not None else times[-1]
    shown = draw(reader, view, a.color)
    simple.ResetCamera(view)
    view.CameraPosition, view.CameraViewUp = [p + d for p, d in zip(view.CameraFocalPoint, (0.5, -0.8, 0.9))], [0, 0, 1]
    simple.ResetCamera(view)
    simple.SaveScreenshot(a.png, view, ImageResolution=[width, height])
    print(", ".join(f"{s.GetDataInformation().GetNumberOfCells()} faces of {NAME[k]}" for k, s in shown.items()))


if __name__ == "__main__" and len(sys.argv) > 1:
    main(sys.argv[1:])
elif __name__ in ("__main__", "__vtkconsole__"):  # chosen among the macros
    from paraview import simple

    if simple.GetActiveSource() is None:
        print("Open a run and choose it in the pipeline first.")
    else:
        draw(simple.GetActiveSource(), simple.GetActiveViewOrCreate("RenderView"))
        simple.Render()
