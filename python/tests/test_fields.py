"""Fields of substances of a run, read: run with the program in ACINUS."""
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import acinus

SCENE = """{
  "time": {"end": "20 min", "step": "5 min"},
  "cell_types": {"a": {"exchange": [{"substance": "oxygen", "uptake": "5 1/s"}]}},
  "cells": {"source": "clump", "count": 13, "model": "cbm"},
  "substances": [{"name": "oxygen", "unit": "mmHg", "diffusion": "2000 um^2/s", "initial": 38,
                  "boundary": {"kind": "fixed", "value": 38}}],
  "substance_grid": {"spacing": "8 um", "box": [["-80 um", "-90 um", "-100 um"], ["80 um", "100 um", "120 um"]]},
  "motility": {"random": false},
  "output": {"every": "10 min"}
}"""


class Fields(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        scene = os.path.join(cls.folder.name, "scene.json")
        with open(scene, "w", encoding="utf-8") as file:
            file.write(SCENE)
        out = os.path.join(cls.folder.name, "scene.run")
        subprocess.run([os.environ["ACINUS"], "run", scene, "--out", out, "--quiet"], check=True)
        cls.run_ = acinus.Run(out)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_grid(self):
        field = self.run_.field("oxygen")
        self.assertEqual(field.value.shape, (28, 24, 20))
        np.testing.assert_allclose(field.origin, [-80, -90, -100])
        np.testing.assert_allclose(field.spacing, [8, 190 / 24, 220 / 28])
        self.assertEqual((field.unit, field.time), ("mmHg", 1200))
        np.testing.assert_allclose(field.centers(2)[[0, -1]], [-100 + 110 / 28, 120 - 110 / 28])

    def test_concentrations_of_cells(self):
        field, cells = self.run_.field("oxygen"), self.run_.cells(frame=-1)
        middle = np.argmin(np.linalg.norm([cells["center_x"], cells["center_y"], cells["center_z"]], axis=0))
        at = [np.argmin(abs(field.centers(axis) - np.asarray(cells["center_" + name])[middle])) for axis, name in enumerate("xyz")]
        self.assertAlmostEqual(np.asarray(cells["concentration_oxygen"])[middle] / field.value[at[2], at[1], at[0]], 1, delta=0.1)
        self.assertLess(field.value.min(), 30)
        self.assertLess(field.value.max(), 38)
        uptake = np.asarray(cells["exchange_oxygen"])
        self.assertTrue((uptake < 0).all())
        self.assertEqual(self.run_.unit("cells/exchange_oxygen"), "mmHg um^3/s")
        # At rest the faces give what cells take up.
        summary = self.run_.summary["substances"]["oxygen"]
        self.assertAlmostEqual(summary["through_faces_um3"] / -summary["secreted_um3"], 1, delta=0.05)
        self.assertAlmostEqual(summary["amount_um3"], float(field.value.mean()) * 160 * 190 * 220, delta=1e-6 * summary["amount_um3"])

    def test_frames(self):
        self.assertEqual([self.run_.field("oxygen", k).time for k in (0, 1, -1)], [0, 600, 1200])
        np.testing.assert_array_equal(self.run_.field("oxygen", 0).value, 38)
        with self.assertRaises(acinus.NoSuchItem):
            self.run_.field("oxygen", 3)
        with self.assertRaises(acinus.NoSuchItem):
            self.run_.field("glucose")


    def test_vtk_reads_them(self):
        try:
            from vtkmodules.util.numpy_support import vtk_to_numpy
            from vtkmodules.vtkIOHDF import vtkHDFReader
        except ImportError:
            self.skipTest("needs python3-vtk9")
        reader = vtkHDFReader()
        reader.SetFileName(os.path.join(self.run_.folder, "fields", "frame_000002.vtkhdf"))
        reader.Update()
        image, field = reader.GetOutput(), self.run_.field("oxygen")
        self.assertEqual(image.GetDimensions(), (20, 24, 28))
        np.testing.assert_allclose(image.GetOrigin(), field.origin + 0.5 * field.spacing)
        np.testing.assert_array_equal(vtk_to_numpy(image.GetPointData().GetArray("oxygen")), field.value.ravel())


if __name__ == "__main__":
    sys.exit(unittest.main())
