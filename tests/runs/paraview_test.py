"""Draws a hybrid run in ParaView without a screen: every sphere, deformable cell and vessel is there.

usage: paraview_test.py ACINUS DRAW.py

Exit code 77 without pvpython or xvfb-run.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python"))
import acinus


def main():
    program, draw = (os.path.abspath(p) for p in sys.argv[1:3])
    if not shutil.which("pvpython") or not shutil.which("xvfb-run"):
        print("no pvpython or no xvfb-run: not tested")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        run = folder + "/hybrid.run"
        subprocess.run([program, "run", "lobule_hybrid", "--set", "start_up.growth_time=30 min", "--until", "10 min", "--threads", "1", "--quiet", "--out", run], check=True)
        frame = acinus.Run(run)[-1]
        for color in ([], ["--color", "pressure"]):
            png = folder + "/tissue.png"
            said = subprocess.run(["xvfb-run", "-a", "pvpython", draw, run, "--png", png, "--size", "600x400", *color], check=True, capture_output=True, text=True, timeout=200).stdout
            faces = {kind: int(n) for n, kind in re.findall(r"(\d+) faces of ([a-z ]+)", said)}
            assert faces["deformable cells"] == 320 * len(frame.deformable), said
            assert faces["spheres"] % len(frame.spheres.radius) == 0 and faces["spheres"] > 0, said
            assert faces["vessels and walls"] > 0, said
            assert os.path.getsize(png) > 10000, "the picture is empty"
            os.remove(png)
    return 0


if __name__ == "__main__":
    sys.exit(main())
