#!/usr/bin/python3
"""Draws several runs at several times into one picture: a row for each run, a column for each time.

    sheet.py a.run b.run --days 0 1 2 4 --out sheet.png -- --color kind --clip z --camera top --size 420x320

The frame nearest to a time is drawn; a run that ends before it leaves the place empty. Options after -- go to
render.py, which draws the frames; with --color pressure give a --range. Needs the packages of render.py, and
python3-pil.
"""
import argparse
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True  # no __pycache__ in the source tree
from film import draw
from run_frame import UserError, read_times


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", help="run folders")
    parser.add_argument("--days", nargs="+", type=float, required=True, help="times of the columns, in days")
    parser.add_argument("--out", required=True, help="PNG file")
    own, render = sys.argv[1:], []
    if "--" in own:
        own, render = own[:own.index("--")], own[own.index("--") + 1:]
    return parser.parse_args(own), render


def find_frame(times, moment):
    """Number of the frame nearest to a moment; None if the run ends more than half an interval before."""
    nearest = min(range(len(times)), key=lambda k: abs(times[k] - moment))
    interval = (times[-1] - times[0]) / max(1, len(times) - 1)
    return nearest if abs(times[nearest] - moment) <= 0.5 * interval + 1e-6 * abs(moment) else None


def make_sheet(arguments, options):
    try:
        from PIL import Image
    except ImportError:
        raise UserError("needs the Debian package python3-pil") from None
    pictures = {}
    with tempfile.TemporaryDirectory() as folder:
        for row, run in enumerate(arguments.runs):
            times = read_times(run)
            for column, day in enumerate(arguments.days):
                frame = find_frame(times, 86400 * day)
                if frame is None:
                    continue
                file = pathlib.Path(folder) / f"{row}_{column}.png"
                draw(run, frame, file, options)
                with Image.open(file) as picture:
                    pictures[row, column] = picture.convert("RGB")
    if not pictures:
        raise UserError("no run has a frame at any of these times")
    width, height = next(iter(pictures.values())).size
    sheet = Image.new("RGB", (width * len(arguments.days), height * len(arguments.runs)), "white")
    for (row, column), picture in pictures.items():
        sheet.paste(picture, (width * column, height * row))
    sheet.save(arguments.out)


def main():
    arguments, options = read_arguments()
    try:
        make_sheet(arguments, options)
    except (UserError, OSError) as error:
        print(f"sheet.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
