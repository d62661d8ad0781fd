"""Runs docs/view/render.py on the sample run and looks whether the picture shows something. Exit code 77: cannot draw here."""
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
for frame, options in (("0", []), ("last", ["--clip", "y", "--camera", "side"]), ("3", ["--color", "kind"]),
                       ("2", ["--camera", "top"])):
    out = os.path.join(sample, f"frame_{frame}.png")
    subprocess.run([sys.executable, script, os.path.join(sample, "fast"), "--frame", frame, "--out", out, "--size",
                    "400x300", *options], check=True)
    reader = vtkPNGReader()
    reader.SetFileName(out)
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    assert reader.GetOutput().GetDimensions()[:2] == (400, 300)
    spread = pixels.astype(float).std()
    print(f"frame {frame}: standard deviation of the pixels {spread:.1f}")
    assert spread > 5, f"frame {frame} looks empty"
bad = subprocess.run([sys.executable, script, os.path.join(sample, "fast"), "--frame", "99", "--out", "x.png"],
                     stderr=subprocess.PIPE, text=True)
assert bad.returncode == 2 and "frame" in bad.stderr, bad.stderr
