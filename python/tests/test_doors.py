"""Files for and from other programs.

usage: ACINUS=build/acinus PYTHONPATH=python python3 python/tests/test_doors.py
"""
import contextlib
import csv
import io
import json
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

import numpy as np

import acinus
from acinus import physicell
from acinus.__main__ import main as command
from acinus.simularium import write_simularium

PROGRAM = os.environ["ACINUS"]


def write_physicell(folder, cells, number=3):
    """As PhysiCell 1.14 writes a frame: XML with labels, cells in a MATLAB file of version 4."""
    labels = [("ID", 1), ("position", 3), ("total_volume", 1), ("cell_type", 1), ("pressure", 1)]
    table = np.zeros((7, len(cells)))
    for column, (x, y, z, volume, kind) in zip(table.T, cells):
        column[:] = [0, x, y, z, volume, kind, 0.5]
    table[0] = np.arange(len(cells))
    index, text = 0, ""
    for name, size in labels:
        text += f'<label index="{index}" size="{size}" units="none">{name}</label>'
        index += size
    name = f"output{number:08d}"
    (folder / f"{name}.xml").write_text(
        f'<MultiCellDS version="2"><metadata><current_time units="min">90.0</current_time></metadata><cellular_information><cell_populations>'
        f'<cell_population type="individual"><custom><simplified_data type="matlab" source="PhysiCell" data_version="2"><cell_types>'
        f'<type ID="0" type="0">tumor cell</type><type ID="1" type="1">stroma</type></cell_types><labels>{text}</labels><filename>{name}_cells.mat</filename>'
        f"</simplified_data></custom></cell_population></cell_populations></cellular_information></MultiCellDS>")
    (folder / f"{name}_cells.mat").write_bytes(struct.pack("<5i", 0, *table.shape, 0, 6) + b"cells\0" + table.T.tobytes())
    return folder / f"{name}.xml"


class FromPhysiCell(unittest.TestCase):
    def setUp(self):
        self.keep = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.keep.name)
        self.addCleanup(self.keep.cleanup)

    def test_cells_become_a_scene_that_runs(self):
        write_physicell(self.folder, [(0, 0, 0, 2494, 0)], 1)
        write_physicell(self.folder, [(0, 0, 0, 2494, 0), (18, 0, 0, 2494, 0), (0, 17, 3, 4000, 1)])
        cells = physicell.read_cells(self.folder)  # the last frame
        self.assertEqual(cells["time"], 5400)
        self.assertEqual(cells["type"], ["tumor cell", "tumor cell", "stroma"])
        np.testing.assert_allclose(cells["position"][2], [0, 17, 3])
        np.testing.assert_allclose(cells["radius"][0], (3 * 2494 / (4 * np.pi)) ** (1 / 3))
        scene = physicell.write_scene(cells, str(self.folder / "start.json"))
        for model in ("cbm", "dcm"):
            run = str(self.folder / model)
            subprocess.run([PROGRAM, "run", scene, "--set", f"model={model}", "--until", "1 min", "--threads", "1", "--quiet", "--out", run], check=True)
            start = acinus.Run(run).cells(frame=0)
            np.testing.assert_allclose(np.sort(np.asarray(start["center_x"])), [0, 0, 18], atol=0.2)
            np.testing.assert_allclose(np.sort(np.asarray(start["volume"])), [2494, 2494, 4000], rtol=0.02)

    def test_damage_is_told(self):
        file = write_physicell(self.folder, [(0, 0, 0, 2494, 0)])
        mat = self.folder / "output00000003_cells.mat"
        whole = mat.read_bytes()
        for broken in (b"", whole[:30], whole[:-8], b"\xff" * len(whole)):
            mat.write_bytes(broken)
            self.assertRaises(acinus.Damaged, physicell.read_cells, file)
        file.write_text("<MultiCellDS>")
        self.assertRaises(acinus.Damaged, physicell.read_cells, file)
        file.write_text("<MultiCellDS/>")
        self.assertRaises(acinus.Damaged, physicell.read_cells, file)
        self.assertRaises(acinus.NotFound, physicell.read_cells, self.folder / "none.xml")
        os.remove(file)
        self.assertRaises(acinus.NotFound, physicell.read_cells, self.folder)


class ToOthers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory()
        cls.folder = cls.keep.name
        cls.run_folder = cls.folder + "/pair.run"
        subprocess.run([PROGRAM, "run", "two_cells", "--set", "time.end=30 min", "--set", 'cells.list.1.model="cbm"', "--threads", "1", "--quiet",
                        "--out", cls.run_folder], check=True)
        law = {"a0_kPa": 0.15, "a1_kPa": 5000.0, "power": 4.0, "overlap_range": [0.08, 0.18],
               "table": [{"overlap": 0.08, "modulus_kPa": 0.1}, {"overlap": 0.18, "modulus_kPa": 5.0}],
               "cbm": {"adhesion_nN_per_um": 0.05, "poisson": 0.47, "radius_um": 12.0, "young_kPa": 0.45}}
        cls.law = cls.folder + "/law.json"
        pathlib.Path(cls.law).write_text(json.dumps(law))

    @classmethod
    def tearDownClass(cls):
        cls.keep.cleanup()

    def test_simularium(self):
        run = acinus.Run(self.run_folder)
        j = json.loads(pathlib.Path(write_simularium(run, self.folder + "/pair.simularium", 3)).read_text())
        info, spatial = j["trajectoryInfo"], j["spatialData"]
        self.assertEqual((info["version"], info["totalSteps"], spatial["bundleSize"]), (3, 3, 3))
        self.assertEqual(sorted(t["name"] for t in info["typeMapping"].values()), ["hepatocyte#deformable", "hepatocyte#sphere"])
        for frame, k in zip(spatial["bundleData"], (0, 2, 3)):
            self.assertEqual(frame["time"], run.times[k])
            rows = np.array(frame["data"]).reshape(-1, 11)
            self.assertEqual(len(rows), 2)
            self.assertTrue(np.all(rows[:, 0] == 1000) and np.all(rows[:, 10] == 0))
            np.testing.assert_allclose(np.sort(rows[:, 3]), np.sort(np.asarray(run.cells(frame=k)["center_x"])), rtol=1e-5)
            np.testing.assert_allclose(rows[:, 9], 12, rtol=0.02)
        self.assertRaises(acinus.BadInput, write_simularium, run, self.folder + "/pair.json")

    def test_law(self):
        table = physicell.law_table(acinus.Law(self.law))
        np.testing.assert_allclose(table["distance"][0], 24)
        self.assertEqual(table["force"][0], 0)
        # By hand at the end of the range: E = 5 kPa, E* = E / (2 (1 - 0.47^2)), R* = 6 um, depth 0.18 * 24 um.
        np.testing.assert_allclose(table["force"][-1], 4 / 3 * 5.0 / (2 * (1 - 0.47**2)) * 6**0.5 * (0.18 * 24) ** 1.5)
        file = physicell.write_law(acinus.Law(self.law), self.folder + "/law.csv", drag=2.0)
        lines = pathlib.Path(file).read_text().splitlines()
        self.assertIn(f"{table['strength'] / 2:.6g} um/min", lines[1])
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        np.testing.assert_allclose([float(r["force_nN"]) for r in rows], table["force"], rtol=1e-5, atol=1e-12)

    def test_commands(self):
        quiet, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(quiet), contextlib.redirect_stderr(errors):
            self.assertEqual(command(["simularium", self.run_folder, self.folder + "/a.simularium"]), 0)
            self.assertEqual(command(["physicell-law", self.law, self.folder + "/a.csv"]), 0)
            self.assertEqual(command(["simularium", self.folder + "/none", self.folder + "/a.simularium"]), 2)
            self.assertEqual(command(["physicell-cells", self.folder, self.folder + "/a.json"]), 2)
        self.assertIn("no output of PhysiCell", errors.getvalue())


if __name__ == "__main__":
    unittest.main()
