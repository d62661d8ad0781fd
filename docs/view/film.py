#!/usr/bin/python3
"""Draws the frames of a run one after the other into an animated picture (WebP).

    film.py RUN_FOLDER --out film.webp --frames 0:last:4 --seconds 8 -- --color kind --clip z --size 640x480

What stands after -- goes to render.py, which draws the frames; with --color pressure give a --range, or every
frame has its own. Needs what render.py needs, and the Debian package python3-pil.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # no __pycache__ in the source tree
from run_frame import UserError, count_frames

RENDER = pathlib.Path(__file__).with_name("render.py")


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", help="run folder, or the run.vtkhdf itself")
    parser.add_argument("--out", required=True, help="WebP file")
    parser.add_argument("--frames", default="0:last:1", help="FIRST:LAST:EVERY (default: all)")
    parser.add_argument("--seconds", type=float, default=8.0, help="how long it takes (default: 8)")
    parser.add_argument("--quality", type=int, default=70, help="of the pictures, 1 to 100 (default: 70)")
    own, render = sys.argv[1:], []
    if "--" in own:
        own, render = own[:own.index("--")], own[own.index("--") + 1:]
    return parser.parse_args(own), render


def choose_frames(text, n):
    """The frame numbers of FIRST:LAST:EVERY in a run of n frames."""
    parts = text.split(":")
    try:
        first, last, every = [n - 1 if part == "last" else int(part) for part in parts]
    except ValueError:
        raise UserError(f'--frames "{text}": write FIRST:LAST:EVERY, e.g. 0:last:2') from None
    if not (0 <= first <= last < n and every > 0):
        raise UserError(f'--frames "{text}": the run has frames 0 to {n - 1}, and EVERY is at least 1')
    return range(first, last + 1, every)


def draw(run, frame, out, options):
    done = subprocess.run([sys.executable, str(RENDER), run, "--frame", str(frame), "--out", str(out)] + options,
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise UserError(f"frame {frame}: {done.stderr.strip()}")


def make_film(arguments, options):
    try:
        from PIL import Image
    except ImportError:
        raise UserError("needs the Debian package python3-pil") from None
    frames = choose_frames(arguments.frames, count_frames(arguments.run))
    with tempfile.TemporaryDirectory() as folder:
        pictures = []
        for k in frames:
            path = pathlib.Path(folder) / f"{k}.png"
            draw(arguments.run, k, path, options)
            pictures.append(Image.open(path).convert("RGB"))
        pictures[0].save(arguments.out, save_all=True, append_images=pictures[1:], loop=0,
                         duration=round(1000 * arguments.seconds / len(pictures)), quality=arguments.quality,
                         method=6)
    print(f"{arguments.out}: {len(pictures)} frames, {pathlib.Path(arguments.out).stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    try:
        make_film(*read_arguments())
    except UserError as error:
        sys.exit(f"film.py: {error}")
