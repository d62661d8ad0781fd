#!/usr/bin/python3
"""Makes the pictures of the documentation anew, from runs that it finds below a folder or makes there.

    pictures.py --runs DIR --program build/acinus                  all whose runs are short or there
    pictures.py --runs DIR --program build/acinus --only overview gallery
    pictures.py --runs DIR --program build/acinus --long           long runs too: hours

Pictures of the regeneration need the finished study: acinus study regeneration --out DIR/regeneration.study.
The pictures of the tutorial are made by its own commands: tests/docs/run_pages.py --rewrite.
Needs what render.py needs, and the Debian packages python3-matplotlib and python3-pil.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # no __pycache__ in the source tree
from display import ensure_display
from film import draw
from labels import VESSEL_COLOR
from picture_runs import Runs
from picture_sheet import Sheet
from run_frame import Frame, UserError, read_times

IMAGES = pathlib.Path(__file__).resolve().parents[1] / "images"
FROM_ABOVE = ["--color", "kind", "--clip", "z", "--camera", "top"]
SECTION = ["--clip", "y", "--camera", "side"]


def study_run(runs, name, seed):
    """The folder of a run of the regeneration study."""
    folder = runs.folder / "regeneration.study" / "runs" / name / f"seed_{seed}"
    if not (folder / "run.vtkhdf").exists():
        raise UserError(f"{folder} is missing: acinus study regeneration --out {runs.folder / 'regeneration.study'}")
    return str(folder)


def frame_at(run, seconds):
    times = read_times(run)
    return min(range(len(times)), key=lambda k: abs(times[k] - seconds))


def extent(run, frame="last"):
    """The largest edge, um, of the box about the cells."""
    shown = Frame(run, str(frame))
    points = shown.point[shown.own_points()]
    return float((points.max(axis=0) - points.min(axis=0)).max())


def draw_single(out, run, options, size, frame="last"):
    """A picture with the labels of render.py."""
    draw(run, frame, out, ["--size", size, *options])


def overview(runs):
    sheet = Sheet(1600, 540)
    run, day = runs.get("spheroid_adhesive"), study_run(runs, "dcm_III_1nN", 1)
    um = 1.12 * extent(run)
    sheet.picture(run, "last", ["--color", "cytosol_pressure", "--range", "10", "32", *SECTION], 20, 0, 540, 540, um)
    sheet.bar("cytosol\npressure\nPa", 10, 32, 580, 110, 300)
    sheet.scale(um, 540, 560, 515)
    for k, days in enumerate((0, 2, 4)):
        left = 690 + 300 * k
        sheet.text(left + 150, 45, f"day {days}", 17, bold=True, align="center")
        sheet.picture(day, frame_at(day, 86400 * days), FROM_ABOVE, left, 45, 300, 420, 270)
    sheet.legend(["deformable", "vessel"], 710, 490)
    sheet.scale(270, 300, 1580, 515)
    sheet.save(IMAGES / "overview.png")


def moving_zoom(runs):
    run = runs.get("lobule_moving_zoom")
    sheet = Sheet(1300, 560)
    for k, (name, frame) in enumerate((("start", 0), ("day 4", "last"))):
        sheet.text(325 + 650 * k, 24, name, 17, bold=True, align="center")
        sheet.picture(run, frame, FROM_ABOVE, 20 + 650 * k, 45, 610, 450, 400)
    sheet.legend(["deformable", "sphere", "vessel"], 30, 490)
    sheet.scale(400, 610, 1280, 540)
    sheet.save(IMAGES / "lobule_moving_zoom.png")
    film = pathlib.Path(__file__).with_name("film.py")
    subprocess.run([sys.executable, str(film), run, "--out", str(IMAGES / "moving_zoom.webp"), "--seconds", "8", "--", "--color", "kind",
                    "--clip", "z", "--width", "385", "--size", "640x480"], check=True)


def monolayers(runs):
    run = {k: runs.get(f"monolayer_type{k}") for k in (1, 2, 3)}
    um = 1.1 * max(extent(r) for r in run.values())
    for k in (1, 2, 3):
        draw_single(IMAGES / f"monolayer_type{k}.png", run[k], ["--camera", "top", "--color", "cytosol_pressure", "--range", "0", "24",
                                                                "--width", f"{1.5 * um:g}"], "1000x750")


def spheroids(runs):
    for name, file in (("spheroid_200", "spheroid_200_cut"), ("spheroid_adhesive_200", "spheroid_adhesive_cut")):
        draw_single(IMAGES / f"{file}.png", runs.get(name), ["--color", "cytosol_pressure", "--range", "0", "32", *SECTION], "1000x750")


def spheroid_1000(runs):
    run = runs.get("spheroid_adhesive_1000")
    um = 1.3 * extent(run)
    sheet = Sheet(1400, 620)
    sheet.text(310, 24, "whole: volume", 17, bold=True, align="center")
    sheet.picture(run, "last", ["--color", "volume", "--range", "7000", "15000"], 20, 45, 580, 560, um)
    sheet.bar("volume\nµm³", 7000, 15000, 615, 180, 260)
    sheet.text(1040, 24, "cut open: one colour a cell", 17, bold=True, align="center")
    sheet.picture(run, "last", ["--color", "cell", "--clip", "y"], 750, 45, 580, 560, um)
    sheet.scale(um, 580, 1370, 600)
    sheet.save(IMAGES / "spheroid_adhesive_1000.png")


def patch_capsule(runs):
    draw_single(IMAGES / "patch_capsule.png", runs.get("patch_capsule"), ["--color", "pressure", "--range", "0", "200",
                                                                         *SECTION], "900x700")


def single_cell(runs):
    pipette, gap = runs.get("aspiration"), runs.get("narrow_gap")
    shown = [(pipette, 150, "pipette, 150 s", "cells"), (pipette, 275, "pipette, 275 s", "cells"), (gap, 480, "hole, 8 min", "all"),
             (gap, 1200, "hole, 20 min", "all")]
    sheet = Sheet(1600, 480)
    for k, (run, seconds, name, middle) in enumerate(shown):
        sheet.text(200 + 400 * k, 24, name, 17, bold=True, align="center")
        sheet.picture(run, frame_at(run, seconds), ["--color", "kind", "--center", middle, *SECTION], 10 + 400 * k, 45, 380, 390, 60)
    sheet.legend(["deformable", "wall"], 30, 440)
    sheet.scale(60, 380, 1580, 465)
    sheet.save(IMAGES / "single_cell.png")


def pull_off_tension(runs):
    run = runs.get("pull_off_2562")
    sheet = Sheet(1280, 540)
    before = read_times(run)[-1] - 20  # the run ends when they have parted
    for k, (name, seconds) in enumerate((("at rest", 140), ("just before the cells part", before))):
        sheet.text(280 + 560 * k, 24, name, 17, bold=True, align="center")
        sheet.picture(run, frame_at(run, seconds), ["--color", "tension", "--range", "-0.03", "0.03", "--only", "0"],
                      20 + 560 * k, 45, 520, 450, 32)
    sheet.bar("tension\nnN/µm", -0.03, 0.03, 1160, 150, 260)
    sheet.scale(32, 520, 1100, 520)
    sheet.save(IMAGES / "pull_off_tension.png")


def regeneration_frames(runs):
    rows = [("dcm_I", "deformable\nModel I"), ("dcm_III", "deformable\nModel III, 0.3 nN"), ("dcm_III_1nN", "deformable\nModel III, 1 nN"),
            ("cbm_III", "plain spheres\nModel III, 0.3 nN"), ("cal_e_III", "calibrated spheres\nModel III, 0.3 nN")]
    days = (0, 1, 2, 3, 4, 6, 10)
    sheet = Sheet(160 + 280 * len(days), 50 + 270 * len(rows) + 90)
    for k, day in enumerate(days):
        sheet.text(160 + 280 * k + 140, 24, f"day {day}", 18, bold=True, align="center")
    for i, (name, label) in enumerate(rows):
        run, top = study_run(runs, name, 1), 50 + 270 * i
        sheet.text(10, top + 130, label, 15)
        for k, day in enumerate(days):
            if day * 86400 > read_times(run)[-1] + 3600:
                continue
            frame, left = frame_at(run, 86400 * day), 160 + 280 * k
            sheet.picture(run, frame, FROM_ABOVE, left, top, 270, 262, 295)
            shown = Frame(run, str(frame))
            for line, (word, area) in enumerate((("nearest", "lesion_area_relative"), ("flooded", "lesion_area_flooded"))):
                sheet.text(left + 5, top + 215 + 18 * line, f"{word} {shown.value_of(area):.2f}", 14)
    sheet.legend(["deformable", "sphere", "vessel"], 20, sheet.height - 70)
    sheet.scale(295, 270, sheet.width - 20, sheet.height - 20)
    sheet.save(IMAGES / "regeneration_frames.png")


CYTOSOL = ["--color", "cytosol_pressure", "--range"]
def call(runs, *words):
    done = subprocess.run([runs.program, *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise UserError(f"acinus {' '.join(words)}: exit code {done.returncode}: {done.stderr.strip()[-500:]}")


def imported(runs):
    """A slice of a label image, and the tissue that is imported from it."""
    import numpy as np
    from PIL import Image
    from painter import cell_color
    run = runs.get("lobule_start")
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        call(runs, "voxelise", run, "--voxel", "0.7 um", "--blur", "0.3 um", "--noise", "0.3", "--quiet", "--out",
             str(place / "labels.tif"))
        call(runs, "import", str(place / "labels.tif"), "--vessel-label", "86", "--quiet", "--out", str(place / "tissue"))
        call(runs, "run", str(place / "tissue" / "scene.json"), "--until", "1 s", "--threads", "1", "--quiet", "--out", str(place / "tissue.run"))
        with Image.open(place / "labels.tif") as image:
            image.seek(image.n_frames // 2)
            labels = np.array(image)
        colors = np.array([(1, 1, 1)] + [cell_color(k) for k in range(85)] + [VESSEL_COLOR])
        sheet = Sheet(1100, 590)
        um, width = 0.7 * labels.shape[1], 440
        axes = sheet.axes(20, 45, width, round(width * labels.shape[0] / labels.shape[1]))
        axes.imshow(colors[np.minimum(labels, 86)], interpolation="nearest", origin="lower")
        axes.axis("off")
        sheet.text(260, 24, "slice of the label image", 17, bold=True, align="center")
        sheet.text(800, 24, "imported tissue", 17, bold=True, align="center")
        sheet.picture(str(place / "tissue.run"), 0, ["--color", "cell"], 500, 45, 580, 490, 1.4 * um)
    sheet.legend(["vessel"], 20, 560)
    sheet.scale(um, width, 460, 570)
    sheet.scale(1.4 * um, 580, 1080, 570)
    sheet.save(IMAGES / "import.png")


def report(runs):
    """The page of the default run, as a browser shows it."""
    from PIL import Image
    run, picture = runs.get("lobule_hybrid"), IMAGES / "report.png"
    with tempfile.TemporaryDirectory() as folder:
        call(runs, "report", run, "--quiet", "--out", str(pathlib.Path(folder) / "page.html"), "--png", str(picture))
    with Image.open(picture) as image:
        image = image.convert("RGB").crop((0, 0, image.width, image.width * 9 // 10)).resize((1000, 900), Image.LANCZOS)
    image.save(picture, optimize=True)


# Scene -> options of render.py for its picture in the gallery.
GALLERY = {
    "adhering_pair": [*CYTOSOL, "0", "5", *SECTION],
    "aspiration": ["--color", "kind", "--center", "cells", "--width", "64", *SECTION],
    "clump13": [*CYTOSOL, "2", "6", "--clip", "y", "--zoom", "1.15"],
    "lobule_cbm": ["--color", "kind", "--camera", "top", "--zoom", "0.95"],
    "lobule_hybrid": ["--color", "kind", "--camera", "top", "--zoom", "0.95"],
    "monolayer_type2": [*CYTOSOL, "2", "10", "--camera", "top"],
    "narrow_gap_nucleus": ["--color", "kind", "--frame", "30", "--zoom", "0.85", *SECTION],
    "openvt_monolayer": ["--color", "radius", "--camera", "top"],
    "optical_stretcher": ["--color", "tension", "--range", "0", "0.004", "--camera", "side", "--frame", "20"],
    "patch_box": ["--color", "kind", "--zoom", "0.75", *SECTION],
    "plates": [*CYTOSOL, "0", "40", *SECTION],
    "pull_off": ["--color", "tension", "--range", "0", "0.03", "--camera", "side", "--frame", "120"],
    "regeneration": ["--color", "kind", "--camera", "top", "--clip", "z", "--zoom", "0.95"],
    "spheroid": [*CYTOSOL, "0", "8", "--zoom", "1.25"],
    "spheroid_adhesive": [*CYTOSOL, "10", "32", "--clip", "y", "--zoom", "1.3"],
    "spheroid_cbm": ["--color", "pressure", "--range", "0", "6", "--clip", "y", "--zoom", "1.3"],
    "tear": [*CYTOSOL, "0", "10", "--camera", "side"],
    "vessel_file": ["--color", "kind", "--camera", "top", "--zoom", "0.8"],
}


def gallery(runs):
    """Small pictures; prints what the runs cost, for the page."""
    (IMAGES / "gallery").mkdir(exist_ok=True)
    for name, options in GALLERY.items():
        draw(runs.get(name), "last", IMAGES / "gallery" / f"{name}.png", ["--size", "400x300", "--font", "1.25", *options])
        print("%-20s %6.1f s of CPU, %d deformable cells, %d spheres" % (name, *runs.cost(name)), flush=True)


PICTURES = {f.__name__: f for f in (overview, moving_zoom, monolayers, spheroids, spheroid_1000, patch_capsule, single_cell,
                                    pull_off_tension, regeneration_frames, imported, report, gallery)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", required=True, help="folder of the runs")
    parser.add_argument("--program", default=shutil.which("acinus") or "build/acinus", help="acinus")
    parser.add_argument("--only", nargs="+", choices=PICTURES, default=list(PICTURES), help="make these only")
    parser.add_argument("--long", action="store_true", help="make runs that take minutes to hours too")
    arguments = parser.parse_args()
    ensure_display(__file__)
    runs, left_out = Runs(arguments.runs, os.path.abspath(arguments.program), arguments.long), 0
    for name in arguments.only:
        try:
            PICTURES[name](runs)
            print(f"{name}: drawn", flush=True)
        except UserError as error:
            print(f"{name}: not drawn: {error}", file=sys.stderr, flush=True)
            left_out += 1
    return 2 if left_out else 0


if __name__ == "__main__":
    sys.exit(main())
