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



def pixels_of(out):
    """[row][column][colour]"""
    reader = vtkPNGReader()
    reader.SetFileName(out)
    reader.Update()
    assert reader.GetOutput().GetDimensions()[:2] == (320, 240)
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(240, 320, -1)


for frame, options in (("0", []), ("last", ["--clip", "y", "--camera", "side"]),
                       ("3", ["--color", "kind"]), ("2", ["--camera", "top", "--color", "force"])):
    out = os.path.join(sample, f"frame_{frame}.png")
    done = draw(frame, out, *options)
    assert done.returncode == 0, done.stderr
    spread = pixels_of(out).astype(float).std()
    print(f"frame {frame}: standard deviation of the pixels {spread:.1f}")
    assert spread > 5, f"frame {frame} looks empty"

# However near the camera comes, no cell stands where the colour bar is.
strips, pictures = [], []
for zoom in ("0.5", "3"):
    out = os.path.join(sample, "zoomed.png")
    done = draw("2", out, "--camera", "side", "--zoom", zoom)
    assert done.returncode == 0, done.stderr
    pictures.append(pixels_of(out))
    strips.append(pictures[-1][:, int(0.85 * 320):])
assert (pictures[0] != pictures[1]).any() and strips[0].std() > 5
assert (strips[0] == strips[1]).all(), "the cells reach into the colour bar"

# The scale bar is as long as it says: 20 of 100 um are a fifth of the width.
sys.dont_write_bytecode = True  # no __pycache__ in the source tree
sys.path.insert(0, os.path.dirname(script))
from labels import scale_length  # noqa: E402
assert [scale_length(width) for width in (100, 99, 49, 26, 5, 0.003)] == [20, 10, 5, 5, 1, 0.0005]
out = os.path.join(sample, "scaled.png")
for camera in ("iso", "top"):
    done = draw("0", out, "--color", "kind", "--camera", camera, "--width", "100")
    assert done.returncode == 0, done.stderr
    row = pixels_of(out)[round(0.04 * 240), int(0.7 * 320):]
    assert abs((row.max(axis=1) < 230).sum() - 64) <= 2, row.max(axis=1)

# Zero is white in a range that is not symmetric, and values as far from it are as strong.
from painter import color_table  # noqa: E402
uneven, even = color_table(-1, 3), color_table(-3, 3)
for value in (-1, -0.5, 0, 1, 2.9):
    assert max(abs(a - b) for a, b in zip(uneven.GetColor(value), even.GetColor(value))) < 1e-3  # a byte is 4e-3
assert min(uneven.GetColor(0)) > 0.9 and tuple(uneven.GetRange()) == (-1, 3)

for frame, options, part in (("99", [], "no frame 99"), ("x", [], "must be a number"),
                             ("0", ["--color", "none"], "has no such field")):
    done = draw(frame, os.path.join(sample, "never.png"), *options)
    assert done.returncode == 2 and part in done.stderr, done.stderr
