"""python3 -m acinus COMMAND: runs and laws as files of other programs, cells of other programs as scenes."""
import argparse
import sys

import acinus
from acinus import physicell
from acinus.simularium import MOST_FRAMES, write_simularium


def main(words=None):
    parser = argparse.ArgumentParser(prog="python3 -m acinus", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("simularium", help="a run for the Simularium viewer")
    one.add_argument("run")
    one.add_argument("file", help="ends in .simularium")
    one.add_argument("--frames", type=int, default=MOST_FRAMES, help=f"at most (default: {MOST_FRAMES})")
    one = commands.add_parser("physicell-law", help="a calibrated law as a table, and as PhysiCell's repulsion")
    one.add_argument("law", help="as `acinus calibrate` writes it")
    one.add_argument("file", help="CSV")
    one.add_argument("--drag", type=float, help="force over velocity of a cell, nN min/um")
    one = commands.add_parser("physicell-cells", help="the cells of a PhysiCell output as a scene")
    one.add_argument("output", help="folder, or one output*.xml")
    one.add_argument("scene", help="JSON file to write")
    one.add_argument("--model", choices=("cbm", "dcm"), default="cbm", help="spheres (default) or deformable cells")
    one = commands.add_parser("program", help="the program itself, from PATH or $ACINUS: python3 -m acinus program run two_cells")
    one.add_argument("words", nargs=argparse.REMAINDER)
    a = parser.parse_args(words)
    try:
        if a.command == "program":
            return acinus.call_program(*a.words).returncode
        if a.command == "simularium":
            print(write_simularium(acinus.Run(a.run), a.file, a.frames))
        elif a.command == "physicell-law":
            print(physicell.write_law(acinus.Law(a.law), a.file, a.drag))
        else:
            cells = physicell.read_cells(a.output)
            for note in cells["notes"]:
                print(f"acinus: note: {note}", file=sys.stderr)
            print(physicell.write_scene(cells, a.scene, a.model))
    except (acinus.AcinusError, OSError) as error:
        print(f"acinus: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
