"""The program acinus, called from Python."""
import os
import shutil
import subprocess

from acinus.errors import NotFound

ADVICE = "install the Debian package, or set ACINUS to the path of the program (docs/start/install.md)"


def find_program():
    """Path of the program: $ACINUS, or acinus in PATH. Raises NotFound."""
    given = os.environ.get("ACINUS")
    path = shutil.which(given or "acinus")
    if path is None:
        raise NotFound(f"ACINUS={given}: there is no such program: {ADVICE}" if given else f"there is no program acinus in PATH: {ADVICE}")
    return path


def call_program(*words, **how):
    """Calls `acinus WORD ...`, as subprocess.run does with the arguments `how`.

    acinus.call_program("run", "two_cells", "--until", "1 min", check=True)
    """
    return subprocess.run([find_program(), *map(str, words)], **how)
