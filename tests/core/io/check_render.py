"""Runs docs/view/render.py on the sample run: the pictures must show something.

usage: check_render.py RENDER SAMPLE_FOLDER      Exit code 77: cannot draw here.
"""
import os
import shutil
import subprocess
import sys

try:
    import h5py  # noqa: F401
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader
except ImportError:
    print("python3-vtk9 or python3-h5py is not installed: skipped")
    sys.exit(77)
if not os.environ.get("DISPLAY") and shutil.which("xvfb-run") is None:
    print("no display and no xvfb-run: skipped")
    sys.exit(77)

script, sample = sys.argv[1:3]

def draw(frame, out, *options):
    command = [sys.executable, script, os.path.join(sample, "fast"), "--frame", frame, "--out", out,
               "--size", "320x240", *options]
    return subprocess.run(command, stderr=subprocess.PIPE, text=True)


for frame, options in (("0", []), ("last", ["--clip", "y", "--camera", "side"]),
                       ("3", ["--color", "kind"]), ("2", ["--camera", "top", "--color", "force"])):
    out = os.path.join(sample, f"frame_{frame}.png")
    done = draw(frame, out, *options)
    assert done.returncode == 0, done.stderr
    reader = vtkPNGReader()
    reader.SetFileName(out)
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    assert reader.GetOutput().GetDimensions()[:2] == (320, 240)
    spread = pixels.astype(float).std()
    print(f"frame {frame}: standard deviation of the pixels {spread:.1f}")
    assert spread > 5, f"frame {frame} looks empty"

for frame, options, part in (("99", [], "no frame 99"), ("x", [], "must be a number"),
                             ("0", ["--color", "none"], "has no such field")):
    done = draw(frame, os.path.join(sample, "never.png"), *options)
    assert done.returncode == 2 and part in done.stderr, done.stderr
