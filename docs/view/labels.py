"""Letters on a picture: time, names of the kinds of bodies, values, colour bar, scale bar; used by render.py."""
from painter import KIND_COLOR
from run_frame import CBM, DCM, NUCLEUS, VESSEL

KIND_NAME = {DCM: "deformable cell", CBM: "sphere", NUCLEUS: "nucleus"}
VESSEL_COLOR = (0.80, 0.10, 0.12)
INK = (0.13, 0.15, 0.19)
STRIP = 0.16  # of the width, for the colour bar


def style_text(text, size, bold=False):
    text.SetColor(*INK)
    text.SetFontFamilyToArial()
    text.SetFontSize(size)
    text.ShadowOff()
    text.ItalicOff()
    text.SetBold(bold)


def add_background(renderer):
    renderer.SetBackground(1.0, 1.0, 1.0)


def add_bar(window, painter, letter):
    """The colour bar on a strip of its own at the right, so that it covers no cell."""
    import textwrap
    import vtk
    strip = vtk.vtkRenderer()
    strip.SetViewport(1 - STRIP, 0, 1, 1)
    add_background(strip)
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(painter.table)
    name = textwrap.fill(painter.name.replace("_", " "), 14)
    bar.SetTitle(f"{name}\n[{painter.unit}]\n ")
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%-#.3g")
    bar.UnconstrainedFontSizeOn()
    style_text(bar.GetTitleTextProperty(), int(0.8 * letter))
    style_text(bar.GetLabelTextProperty(), int(0.7 * letter))
    bar.SetPosition(0.27, 0.28)
    bar.SetWidth(0.46)
    bar.SetHeight(0.48)
    strip.AddActor2D(bar)
    window.AddRenderer(strip)


def add_values(renderer, frame, wanted, letter):
    """The observables asked for, one line each, at the lower left, above the names of the kinds."""
    import vtk
    lines = []
    for name, _, text in (entry.partition("=") for entry in wanted):
        lines.append(f"{text or name.replace('_', ' ')} {frame.value_of(name):.2f}")
    values = vtk.vtkTextActor()
    values.SetInput("\n".join(lines))
    style_text(values.GetTextProperty(), letter, bold=True)
    values.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    values.SetPosition(0.03, 0.18)
    renderer.AddActor2D(values)


def add_labels(renderer, frame, painter, letter):
    import vtk
    label = vtk.vtkTextActor()
    seconds = frame.time
    text = f"t = {seconds:.3g} s" if abs(seconds) < 600 else f"t = {seconds / 3600:.1f} h"
    label.SetInput(text if abs(seconds) < 5 * 86400 else f"t = {seconds / 86400:.1f} d")
    style_text(label.GetTextProperty(), letter, bold=True)
    label.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    label.SetPosition(0.03, 0.93)
    renderer.AddActor2D(label)
    if painter.name == "kind":
        import numpy as np
        entries = [(KIND_NAME[k], KIND_COLOR[k]) for k in (DCM, NUCLEUS, CBM) if np.any(frame.kind == k)]
        entries += [("vessel or wall", VESSEL_COLOR)] if np.any(frame.kind == VESSEL) else []
        for i, (name, color) in enumerate(reversed(entries)):
            entry = vtk.vtkTextActor()
            entry.SetInput(name)
            style_text(entry.GetTextProperty(), int(0.8 * letter), bold=True)
            entry.GetTextProperty().SetColor(*(0.85 * c for c in color))
            entry.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
            entry.SetPosition(0.03, 0.03 + 1.15 * letter * i / renderer.GetSize()[1])
            renderer.AddActor2D(entry)


def scale_length(width):
    """Length of a scale bar, um: 1, 2 or 5 times a power of ten, at most a fifth of the width."""
    import math
    power = 10.0 ** math.floor(math.log10(0.2 * width))
    return max(m * power for m in (0.5, 1, 2, 5) if m * power <= 0.2 * width)


def add_scale_bar(renderer, strip, letter):
    """At the lower right, left of the strip of the colour bar."""
    import vtk
    width_px, height_px = renderer.GetRenderWindow().GetSize()
    width = 2 * renderer.GetActiveCamera().GetParallelScale() * width_px / height_px
    length = scale_length(width)
    right = 1 - strip - 0.03
    ends, line = vtk.vtkPoints(), vtk.vtkLineSource()
    for x in (right - length / width, right):
        ends.InsertNextPoint(x, 0.04, 0)
    line.SetPoints(ends)
    place = vtk.vtkCoordinate()
    place.SetCoordinateSystemToNormalizedViewport()
    mapper, bar, text = vtk.vtkPolyDataMapper2D(), vtk.vtkActor2D(), vtk.vtkTextActor()
    mapper.SetInputConnection(line.GetOutputPort())
    mapper.SetTransformCoordinate(place)
    bar.SetMapper(mapper)
    bar.GetProperty().SetColor(*INK)
    bar.GetProperty().SetLineWidth(max(2, height_px // 120))
    renderer.AddActor2D(bar)
    text.SetInput(f"{length:g} \u00b5m")
    style_text(text.GetTextProperty(), int(0.8 * letter), bold=True)
    text.GetTextProperty().SetJustificationToCentered()
    text.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    text.SetPosition(right - 0.5 * length / width, 0.055)
    renderer.AddActor2D(text)
