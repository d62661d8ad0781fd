"""Films of runs.

usage: ACINUS=build/acinus PYTHONPATH=python python3 python/tests/test_film.py
"""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
from PIL import Image

import acinus
from acinus import film
from acinus.__main__ import main as command

#: A deformable cell and a sphere side by side, which fall apart.
SCENE = {
    "name": "pair", "time": {"end": "2 min", "step": "60 s"}, "output": {"every": "1 min"}, "motility": {"random": False},
    "cell_types": {"cell": {"radius": "8 um", "adhesion": "0 J/m^2", "dcm": {"nodes": 162}}},
    "cells": {"source": "list", "list": [{"position": ["-10 um", "0 um", "0 um"], "model": "dcm"},
                                         {"position": ["10 um", "0 um", "0 um"], "model": "cbm"}]}}


class Film(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.folder.name)
        (cls.root / "scene.json").write_text(json.dumps(SCENE))
        cls.path = str(cls.root / "pair.run")
        subprocess.run([os.environ["ACINUS"], "run", cls.root / "scene.json", "--out", cls.path, "--quiet", "--threads", "1"], check=True)
        cls.run_ = acinus.Run(cls.path)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def view(self, camera="top", clip=None, size=(400, 300)):
        return film._View(self.run_, [0, 1, 2], camera, clip, size)

    def test_both_models_have_their_size_and_place(self):
        view = self.view()
        picture = film.draw_frame(self.run_[0], view, "kind")
        drawn = (picture != film._BACKGROUND).any(-1)
        columns = np.flatnonzero(drawn.any(0))
        self.assertAlmostEqual(len(columns) / view.scale, 32, delta=0.6)  # two diameters; a mesh lies within its sphere
        area = drawn.sum() / view.scale**2
        self.assertAlmostEqual(area / (2 * np.pi * 64), 1, delta=0.02)
        left, right = (drawn[:, s].sum() for s in (slice(0, 200), slice(200, 400)))
        self.assertAlmostEqual(left / right, 1, delta=0.03)
        # Deformable left in a warm colour, sphere right in a cold one.
        warm, cold = (picture[:, s][drawn[:, s]].astype(float).mean(0) for s in (slice(0, 200), slice(200, 400)))
        self.assertGreater(warm[0], warm[2])
        self.assertGreater(cold[2], cold[0])

    def test_a_cut_is_flat_and_as_wide_as_the_cell(self):
        for clip, camera in (("z", "top"), ("y", "side")):
            picture = film.draw_frame(self.run_[0], self.view(camera, clip), "kind")
            drawn = (picture != film._BACKGROUND).any(-1)
            for side, color in ((slice(0, 200), film._KIND_COLORS[0]), (slice(200, 400), film._KIND_COLORS[1])):
                flat = (picture[:, side] == (0.85 * color).astype(np.uint8)).all(-1)
                self.assertGreater(flat.sum() / drawn[:, side].sum(), 0.97, (clip, color))

    def test_what_is_nearer_hides_what_is_behind(self):
        axes = film.CAMERAS
        film.CAMERAS["front"] = ((1, 0, 0), (0, 0, 1))
        try:
            picture = film.draw_frame(self.run_[0], self.view("front"), "kind")
        finally:
            del axes["front"]
        drawn = picture[(picture != film._BACKGROUND).any(-1)].astype(float)
        self.assertTrue((drawn[:, 2] >= drawn[:, 0]).mean() > 0.97, "the sphere stands in front of the cell")

    def test_files(self):
        for name in ("film.webp", "film.gif", "film.png"):
            self.assertEqual(command(["film", self.path, str(self.root / name), "--size", "200x150", "--seconds", "1.2"]), 0)
            with Image.open(self.root / name) as picture:
                self.assertEqual((picture.n_frames, picture.size), (3, (200, 150)))
        out = self.root / "pictures"
        self.assertEqual(command(["film", self.path, str(out), "--frames", "0:-1:2", "--color", "pressure", "--size", "200x150"]), 0)
        self.assertEqual(sorted(os.listdir(out)), ["frame_000000.png", "frame_000001.png"])

    def test_errors_say_what_is_allowed(self):
        cases = [(["film.mp4"], r"\.webp"), (["a.webp", "--color", "warmth"], "pressure"), (["a.webp", "--size", "9"], "800x600"),
                 (["a.webp", "--frames", "x"], "FIRST:LAST"), (["a.webp", "--frames", "0:2:0"], "FIRST:LAST")]
        for words, part in cases:
            done = subprocess.run([os.sys.executable, "-m", "acinus", "film", self.path, *words], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, words)
            self.assertRegex(done.stderr, part)


if __name__ == "__main__":
    unittest.main()
