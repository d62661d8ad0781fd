"""Runs of the tissue simulator acinus, read and started from Python.

    import acinus
    run = acinus.Run("lobule_hybrid.run")
    frame = run[-1]                    # the last frame: frame.points, frame.triangles, frame.spheres
    run.cells(frame=-1)["pressure"]    # kPa
    run.observables()                  # what the experiment measures, over time

    acinus.call_program("run", "two_cells")   # the program, from PATH or $ACINUS
    sim = acinus.Simulation("two_cells")  # steps a scene; needs what `./acinus.sh python` builds
    sim.run(until="10 min")

Reading needs h5py and numpy; with pandas tables are DataFrames.
"""
from acinus.errors import AcinusError, BadInput, CannotContinue, Damaged, FileError, NoSuchItem, NotFound
from acinus.frame import DEFORMABLE, NUCLEUS, SPHERE, VESSEL, Frame, Spheres
from acinus.law import Law
from acinus.lineage import Lineage
from acinus.program import call_program, find_program
from acinus.run import Run
from acinus.simulation import Simulation, calibrate, compare, simulate
from acinus.study import Study
from acinus.tables import Table

__all__ = ["AcinusError", "BadInput", "CannotContinue", "DEFORMABLE", "Damaged", "FileError", "Frame", "Law", "Lineage", "NUCLEUS",
           "NoSuchItem", "NotFound", "Run", "SPHERE", "Simulation", "Spheres", "Study", "Table", "VESSEL", "calibrate", "call_program",
           "compare", "find_program", "simulate"]
