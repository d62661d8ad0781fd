"""The notebooks run from top to bottom.

usage: PYTHONPATH=build-python/python python3 python/tests/test_notebooks.py [NAME ...]; exit code 77 where nbclient, ipykernel or matplotlib are not installed
"""
import importlib.util
import os
import pathlib
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parents[1] / "notebooks"


def main(names):
    if any(importlib.util.find_spec(name) is None for name in ("nbclient", "nbformat", "ipykernel", "matplotlib")):
        print("no nbclient, ipykernel or matplotlib: not tested")
        return 77
    import nbclient
    import nbformat
    os.environ.update(MPLBACKEND="Agg", PYDEVD_DISABLE_FILE_VALIDATION="1")
    for path in sorted(FOLDER.glob("*.ipynb")):
        if names and path.stem not in names:
            continue
        notebook = nbformat.read(path, as_version=4)
        with_output = [c for c in notebook.cells if c.cell_type == "code" and c.outputs]
        if with_output:
            raise AssertionError(f"{path}: is committed with outputs; clear them")
        with tempfile.TemporaryDirectory() as folder:
            nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
        print(f"{path.stem}: {len(notebook.cells)} cells")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
