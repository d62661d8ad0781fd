"""python3 -m acinus COMMAND: runs and laws as files of other programs, cells of other programs as scenes."""
import argparse
import sys

import acinus
from acinus import physicell
from acinus.film import CAMERAS, ENDINGS, write_film
from acinus.simularium import MOST_FRAMES, write_simularium


def make_film(a):
    run, numbers = acinus.Run(a.run), None
    if a.frames is not None:
        try:
            first, last, *every = map(int, a.frames.split(":"))
            n = len(run)
            numbers = range(first % n, last % n + 1, *every)
        except (ValueError, ZeroDivisionError):
            raise acinus.BadInput(f'--frames "{a.frames}": write FIRST:LAST or FIRST:LAST:EVERY, e.g. 0:-1:2') from None
    try:
        width, height = map(int, a.size.split("x"))
        if not (64 <= width <= 8192 and 64 <= height <= 8192):
            raise ValueError
    except ValueError:
        raise acinus.BadInput(f'--size "{a.size}": write WIDTHxHEIGHT, each from 64 to 8192, e.g. 800x600') from None
    return write_film(run, a.out, numbers, a.color, a.range, a.camera, a.clip, (width, height), a.seconds)


def main(words=None):
    parser = argparse.ArgumentParser(prog="python3 -m acinus", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("simularium", help="a run for the Simularium viewer")
    one.add_argument("run")
    one.add_argument("file", help="ends in .simularium")
    one.add_argument("--frames", type=int, default=MOST_FRAMES, help=f"at most (default: {MOST_FRAMES})")
    one.add_argument("--meshes", action="store_true", help="also write the surface of every deformable cell and frame, as OBJ")
    one = commands.add_parser("film", help="a run as an animated picture or a folder of pictures")
    one.add_argument("run")
    one.add_argument("out", help=f"ends in {', '.join(ENDINGS)}; without an ending: a folder of PNG pictures")
    one.add_argument("--frames", metavar="FIRST:LAST[:EVERY]", help="numbers of frames (default: all from t = 0 on)")
    one.add_argument("--color", default="kind", help="kind (default), type, cell or a field, e.g. pressure")
    one.add_argument("--range", nargs=2, type=float, metavar=("LOW", "HIGH"), help="of the colours (default: of all frames)")
    one.add_argument("--camera", choices=CAMERAS, default="iso")
    one.add_argument("--clip", choices="xyz", help="cut through the middle, across this axis")
    one.add_argument("--size", default="800x600", help="WIDTHxHEIGHT in pixels")
    one.add_argument("--seconds", type=float, default=8, help="length of the film (default: 8)")
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
            print(write_simularium(acinus.Run(a.run), a.file, a.frames, a.meshes))
        elif a.command == "film":
            print(make_film(a))
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
