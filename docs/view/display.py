"""A screen to draw on; used by render.py and pictures.py."""
import os
import shutil
import sys

from run_frame import UserError


def ensure_display(script):
    """VTK of Debian 12 draws only through X: without a screen, start the script again on a virtual one."""
    if os.environ.get("DISPLAY") or os.environ.get("ACINUS_RENDER_CHILD"):
        return
    if shutil.which("xvfb-run") is None:
        raise UserError("no screen and no xvfb-run: install the package xvfb")
    os.environ["ACINUS_RENDER_CHILD"] = "1"
    screen = ["xvfb-run", "-a", "-s", "-screen 0 640x480x24"]
    os.execvp(screen[0], screen + [sys.executable, os.path.abspath(script)] + sys.argv[1:])
