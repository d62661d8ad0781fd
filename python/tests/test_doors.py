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
from unittest import mock

import numpy as np

import acinus
from acinus import physicell
from acinus.__main__ import main as command
from acinus.simularium import write_simularium

PROGRAM = os.environ["ACINUS"]


def write_physicell(folder, cells, number=3, rows=None, minutes=90.0, stamp="", head="", called=None):
    """As PhysiCell 1.14 writes a frame: XML with labels, cells in a MATLAB file of version 4. rows: further ones by name."""
    rows = rows or {}
    labels = [("ID", 1), ("position", 3), ("total_volume", 1), ("cell_type", 1), ("pressure", 1)] + [(row, 1) for row in rows]
    table = np.zeros((7 + len(rows), len(cells)))
    for column, (x, y, z, volume, kind) in zip(table.T, cells):
        column[:7] = [0, x, y, z, volume, kind, 0.5]
    for k, values in enumerate(rows.values()):
        table[7 + k] = values
    table[0] = np.arange(len(cells))
    index, text = 0, ""
    for name, size in labels:
        text += f'<label index="{index}" size="{size}" units="none">{name}</label>'
        index += size
    name = called or f"output{number:08d}"
    (folder / f"{name}.xml").write_text(
        f'<MultiCellDS version="2"><metadata><current_time units="min">{minutes}</current_time>{stamp and f"<created>{stamp}</created>"}</metadata>{head}<cellular_information><cell_populations>'
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
        write_physicell(self.folder, [(0, 0, 0, 2494, 0)], 1, minutes=30.0)
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

    def read(self, cells, **more):
        write_physicell(self.folder, cells, **more)
        return physicell.read_cells(self.folder)

    def test_dead_cells_are_left_out_and_counted(self):
        six = [(20 * k, 0, 0, 2494, 0) for k in range(6)]
        cells = self.read(six, rows={"cycle_model": [5, 100, 101, 5, 9999, 5], "current_phase": [4, 100, 103, 104, 9999, 14]})
        self.assertEqual(list(cells["id"]), [0, 4, 5])  # 9999 is a cycle of the user's own
        self.assertIn("3 of 6 cells are dead", cells["notes"][0])
        self.assertEqual(list(self.read(six, rows={"dead": [0, 0, 1, 0, 1, 0]})["id"]), [0, 1, 3, 5])
        self.assertIn("all are taken as living", self.read(six)["notes"][0])
        dead = self.read(six[:1], rows={"dead": [1]})
        with self.assertRaisesRegex(acinus.BadInput, "1 of 1 cells are dead"):
            physicell.write_scene(dead, str(self.folder / "none.json"))

    def test_cells_outside_the_domain_or_fixed_are_told(self):
        head = "<microenvironment><domain><mesh><bounding_box>-50 -50 -10 50 50 10</bounding_box></mesh></domain></microenvironment>"
        cells = self.read([(0, 0, 0, 2494, 0), (60, 0, 0, 2494, 0), (20, 0, 11, 2494, 0)], rows={"dead": [0, 0, 0], "is_movable": [0, 1, 1]}, head=head)
        self.assertEqual(list(cells["id"]), [0])
        self.assertEqual([note[:9] for note in cells["notes"]], ["2 living ", "1 cells d"])

    def test_frames_of_an_earlier_run_are_passed_over(self):
        one, two = [(0, 0, 0, 2494, 0)], [(0, 0, 0, 2494, 0), (30, 0, 0, 2494, 0)]
        for number, stamp in ((0, "2024-05-02T10:00:00Z"), (1, "2024-05-02T10:05:00Z"), (2, "2024-05-01T09:10:00Z"), (3, "2024-05-01T09:15:00Z")):
            write_physicell(self.folder, one if number < 2 else two, number, minutes=60.0 * number, stamp=stamp)
        cells = physicell.read_cells(self.folder)
        self.assertEqual((cells["time"], len(cells["id"])), (3600, 1))
        self.assertIn("output00000002.xml and what comes after it are left over", cells["notes"][0])
        write_physicell(self.folder, two, called="final", minutes=200.0, stamp="2024-05-01T09:16:00Z")
        cells = physicell.read_cells(self.folder)
        self.assertEqual(cells["time"], 3600)
        self.assertIn("final.xml is left over", cells["notes"][1])
        write_physicell(self.folder, two, called="final", minutes=70.0, stamp="2024-05-02T10:06:00Z")
        self.assertEqual(physicell.read_cells(self.folder)["time"], 4200)  # the end of this run

    def test_frames_without_stamps_go_by_the_times_of_files(self):
        for number, written in ((0, 2000), (1, 2010), (2, 1500)):
            os.utime(write_physicell(self.folder, [(0, 0, 0, 2494, 0)], number, minutes=60.0 * number), (written, written))
        self.assertEqual(physicell.read_cells(self.folder)["time"], 3600)
        os.utime(write_physicell(self.folder, [(0, 0, 0, 2494, 0)], called="final", minutes=600.0), (2020, 2020))
        with self.assertRaisesRegex(acinus.BadInput, "of two runs"):
            physicell.read_cells(self.folder)

    def test_units_are_followed_or_refused(self):
        file = write_physicell(self.folder, [(0, 0, 0, 2494, 0)])
        text = file.read_text()
        file.write_text(text.replace('units="min">90.0', 'units="hr">2'))
        self.assertEqual(physicell.read_cells(file)["time"], 7200)
        file.write_text(text.replace('size="3" units="none"', 'size="3" units="mm"'))
        self.assertRaisesRegex(acinus.BadInput, "position is in mm", physicell.read_cells, file)

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

    def test_simularium_meshes(self):
        run = acinus.Run(self.run_folder)
        j = json.loads(pathlib.Path(write_simularium(run, self.folder + "/mesh.simularium", 3, meshes=True)).read_text())
        types = j["trajectoryInfo"]["typeMapping"]
        self.assertEqual(len(types), 4)  # the sphere, and the deformable cell in each frame
        self.assertEqual(len({t["geometry"].get("url") for t in types.values()}), 4)
        for frame, k in zip(j["spatialData"]["bundleData"], (0, 2, 3)):
            for row in np.array(frame["data"]).reshape(-1, 11):
                picture = types[str(int(row[2]))]["geometry"]
                if picture["displayType"] == "SPHERE":
                    continue
                lines = [line.split() for line in pathlib.Path(self.folder, picture["url"]).read_text().splitlines()]
                points = row[3:6] + row[9] * np.array([line[1:] for line in lines if line[0] == "v"], dtype=float)
                triangles = np.array([line[1:] for line in lines if line[0] == "f"], dtype=int) - 1
                own_points, own_triangles = run[k].mesh(int(row[1]))
                np.testing.assert_allclose(points, own_points, atol=1e-4)
                np.testing.assert_array_equal(triangles, own_triangles)
        with mock.patch("acinus.simularium.MOST_MESHES", 2):
            with self.assertRaisesRegex(acinus.BadInput, "3 surfaces in 3 frames"):
                write_simularium(run, self.folder + "/mesh.simularium", 3, meshes=True)

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
