"""The reader against real runs.

usage: ACINUS=build/acinus python3 -m unittest discover python/tests
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import acinus
from acinus import tables

PROGRAM = os.environ.get("ACINUS", "acinus")
#: A deformable cell that divides beside a sphere that divides; both are watched by frames in between.
SCENE = {
    "name": "family", "seed": 3, "time": {"end": "40 min", "step": "60 s"}, "output": {"every": "5 min"},
    "motility": {"random": False}, "life": {"grid": "2 min"},
    "cell_types": {"cell": {"radius": "8 um", "dcm": {"nodes": 42},
                            "cycle": {"time": "30 min", "spread": 0, "mitosis": "5 min", "axis": "given", "direction": [1, 0, 0]}}},
    "cells": {"source": "list", "list": [{"position": ["0 um", "0 um", "0 um"], "model": "dcm"},
                                         {"position": ["0 um", "15.5 um", "0 um"], "model": "cbm"}]}}


def run_program(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return done.stdout


class Family(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.folder.name)
        (cls.root / "scene.json").write_text(json.dumps(SCENE))
        cls.path = cls.root / "family.run"
        run_program("run", cls.root / "scene.json", "--out", cls.path, "--quiet", "--threads", "1")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def copy(self, name):
        to = self.root / name
        shutil.rmtree(to, ignore_errors=True)
        shutil.copytree(self.path, to)
        return to


class Reading(Family):
    def test_frames(self):
        run = acinus.Run(self.path)
        self.assertEqual(len(run), 9)
        np.testing.assert_allclose(run.times, 300.0 * np.arange(9), atol=1e-6)
        first, last = run[0], run[-1]
        self.assertEqual((first.time, last.index), (0.0, 8))
        self.assertEqual((len(first.triangles), len(first.spheres.id)), (80, 1))
        self.assertEqual((len(last.deformable), len(last.spheres.id)), (2, 2))
        np.testing.assert_allclose(first.spheres.center, [[0, 15.5, 0]], atol=1e-4)
        np.testing.assert_allclose(first.spheres.radius, [8], rtol=1e-5)
        self.assertEqual([frame.index for frame in run], list(range(9)))
        self.assertEqual([frame.index for frame in run[2:5]], [2, 3, 4])

    def test_a_mesh_is_closed_and_has_the_volume_of_the_table(self):
        run = acinus.Run(self.path)
        for k in (0, 8):
            cells = run.cells(k)
            for row in np.flatnonzero(np.asarray(cells["kind"]) == acinus.DEFORMABLE):
                points, triangles = run[k].mesh(int(np.asarray(cells["id"])[row]))
                edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
                self.assertTrue((np.unique(edges, axis=0, return_counts=True)[1] == 2).all())
                volume = np.linalg.det(points[triangles].astype(float)).sum() / 6
                self.assertAlmostEqual(volume / np.asarray(cells["volume"])[row], 1, delta=1e-5)

    def test_tables(self):
        run = acinus.Run(self.path)
        cells = run.cells()
        self.assertEqual(len(cells), sum(len(run.cells(k)) for k in range(len(run))))
        self.assertEqual(cells.attrs["units"]["pressure"], "kPa")
        self.assertEqual(run.unit("cells/pressure"), "kPa")
        np.testing.assert_array_equal(np.unique(cells["frame"]), np.arange(9))
        np.testing.assert_array_equal(cells["frame"], np.sort(cells["frame"]))
        self.assertEqual(len(run.interface(0)), 1)
        self.assertIn("force_z", run.interface(0).columns)
        series = run.series()
        self.assertAlmostEqual(np.asarray(series["dt"]).sum(), 2400, delta=1e-6)
        self.assertEqual(np.asarray(run.observables()["cells"])[-1], 4)
        history = run.history(0)
        self.assertTrue((np.diff(np.asarray(history["radius"])) >= 0).all())

    def test_life(self):
        cells = acinus.Run(self.path).cells()
        volume = 4 / 3 * np.pi * np.asarray(cells["radius"]) ** 3
        for i in (0, 1):
            own = np.asarray(cells["id"]) == i
            self.assertEqual(set(np.asarray(cells["phase"])[own]), {1})
            rate = np.asarray(cells["growth_rate"])[own]
            np.testing.assert_allclose(np.diff(volume[own]) / 300, rate[:-1], rtol=1e-6)
            np.testing.assert_allclose(np.asarray(cells["cycle_progress"])[own], volume[own] / volume[own][0] - 1, atol=1e-9)
        frame = acinus.Run(self.path)[0]
        np.testing.assert_allclose(frame.cell_data["growth_rate"], 4 / 3 * np.pi * 8**3 / 1800, rtol=1e-6)
        self.assertTrue((frame.cell_data["phase"] == 1).all())

    def test_contacts(self):
        with self.assertRaisesRegex(acinus.NoSuchItem, "output.contacts=true"):
            acinus.Run(self.path).contacts()
        path = self.root / "contacts.run"
        run_program("run", self.root / "scene.json", "--out", path, "--quiet", "--threads", "1", "--set", "output.contacts=true")
        run = acinus.Run(path)
        contacts, cells = run.contacts(-1), run.cells(-1)
        self.assertEqual(contacts.attrs["units"]["area_a"], "um^2")
        self.assertEqual(set(np.asarray(contacts["partner"])), {0, 1})
        for row, i in enumerate(cells["id"]):
            first, second = np.asarray(contacts["a"]) == i, np.asarray(contacts["b"]) == i
            area = np.asarray(contacts["area_a"])[first].sum() + np.asarray(contacts["area_b"])[second].sum()
            self.assertAlmostEqual(area, np.asarray(cells["contact_area"])[row], delta=1e-9)
            normal = np.asarray(contacts["normal_force"])[first | second].sum()
            self.assertAlmostEqual(normal, np.asarray(cells["normal_force"])[row], delta=1e-12)

    def test_contacts_of_a_resumed_run(self):
        """They may be asked for when a run is resumed, and go on after frames that were cut."""
        path = self.root / "resumed.run"
        run_program("run", self.root / "scene.json", "--out", path, "--quiet", "--threads", "1", "--until", "20 min")
        run_program("run", self.root / "scene.json", "--out", path, "--quiet", "--threads", "1", "--resume",
                    "--set", "output.contacts=true")
        contacts = acinus.Run(path).contacts()
        self.assertEqual((min(contacts["frame"]), max(contacts["frame"])), (5, 8))

    def test_cells_are_sorted_by_id(self):
        run = acinus.Run(self.path)
        with h5py.File(run.file) as file:
            n = int(file["cells/frame_offset"][-2])
            stored = file["cells/id"][n:n + 4]
        last = run.cells(-1)
        self.assertNotEqual(list(stored), sorted(stored), "daughters of both models: not stored in order")
        for k in range(len(run)):
            ids = np.asarray(run.cells(k)["id"])
            self.assertTrue((np.diff(ids) > 0).all(), k)
        # Every row moved as a whole.
        frame = run[-1]
        kind = dict(zip(frame.cell_id.tolist(), frame.kind.tolist()))
        self.assertEqual([kind[i] for i in last["id"]], list(last["kind"]))
        center = dict(zip(frame.spheres.id.tolist(), frame.spheres.center))
        for row, i in enumerate(last["id"]):
            if i in center:
                at = [np.asarray(last["center_" + axis])[row] for axis in "xyz"]
                np.testing.assert_allclose(at, center[i], atol=1e-4)
        every = run.cells()
        own = np.asarray(every["frame"]) == 8
        np.testing.assert_array_equal(np.asarray(every["pressure"])[own], last["pressure"])

    def test_events_and_lineage(self):
        run = acinus.Run(self.path)
        events = run.events()
        divisions = np.flatnonzero(np.asarray(events["code"]) == "division")
        self.assertEqual(len(divisions), 2)
        tree = run.lineage()
        self.assertEqual(tree.founders, [0, 1])
        self.assertEqual(len(tree), 6)
        for mother in (0, 1):
            first, second = tree.daughters(mother)
            self.assertEqual(tree.parent(second), mother)
            self.assertEqual(tree.ancestors(first), [mother])
            self.assertEqual((tree.generation(mother), tree.generation(first)), (0, 1))
            self.assertEqual(tree.ended(mother), tree.born(first))
            self.assertIsNone(tree.ended(first))
            self.assertEqual(tree.offspring(mother), [first, second])
            self.assertEqual(tree.newick(mother, tree.born(first) + 7),
                             f"({first}:7,{second}:7){mother}:{tree.born(first):g};")

    def test_what_it_is(self):
        run = acinus.Run(self.path)
        self.assertEqual(run.status, "completed")
        self.assertEqual(run.scene["name"], "family")
        self.assertEqual(run.provenance["seed"], "3")
        self.assertEqual(run.summary["cells"]["end"], 4)
        self.assertEqual(acinus.Run(self.path / "run.vtkhdf").summary["cells"]["end"], 4)

    def test_without_pandas_columns_are_the_same(self):
        run = acinus.Run(self.path)
        with mock.patch.object(tables, "pandas", None):
            plain = run.cells(3)
        self.assertIsInstance(plain, acinus.Table)
        full = run.cells(3)
        self.assertEqual(list(plain.columns), list(full.columns))
        for name in plain.columns:
            np.testing.assert_array_equal(plain[name], np.asarray(full[name]))
        self.assertEqual(len(plain[plain["kind"] == acinus.SPHERE]), 1)
        self.assertEqual(plain[["id", "kind"]].columns, ["id", "kind"])
        with self.assertRaisesRegex(acinus.NoSuchItem, 'no column "weight"; there are frame, time'):
            plain["weight"]


class Faults(Family):
    def test_what_is_not_there(self):
        with self.assertRaisesRegex(acinus.NotFound, "there is no such file. Give a run folder"):
            acinus.Run(self.root / "nowhere")
        (self.root / "empty").mkdir()
        with self.assertRaisesRegex(acinus.NotFound, "has no run.vtkhdf \\(but nothing\\)"):
            acinus.Run(self.root / "empty")
        run = acinus.Run(self.path)
        for ask, what in ((lambda: run[9], "no frame 9; the run has 9"), (lambda: run.history(77), "no frame has a cell 77"),
                          (lambda: run[0].mesh(1), "has no surface of cell 1; deformable are \\[0\\]"),
                          (lambda: run.lineage().parent(99), "no cell 99"),
                          (lambda: run.unit("cells/weight"), "has no dataset cells/weight")):
            with self.assertRaisesRegex(acinus.NoSuchItem, what):
                ask()
        self.assertIsInstance(acinus.NoSuchItem("x"), (KeyError, IndexError))

    def test_what_is_no_run(self):
        with h5py.File(self.root / "other.h5", "w") as file:
            file.attrs["schema"] = "something/else"
        with self.assertRaisesRegex(acinus.Damaged, 'is not a run file of acinus \\(schema "something/else"'):
            acinus.Run(self.root / "other.h5")
        with mock.patch("acinus.hdf5.PAUSE", 0), self.assertRaisesRegex(acinus.Damaged, "cannot be opened as HDF5"):
            acinus.Run(self.root / "scene.json")

    def test_torn_files(self):
        whole = (self.path / "run.vtkhdf").read_bytes()
        torn = self.copy("torn.run")
        for share in (0, 0.01, 0.3, 0.9):
            (torn / "run.vtkhdf").write_bytes(whole[:int(share * len(whole))])
            with mock.patch("acinus.hdf5.PAUSE", 0), self.assertRaises(acinus.AcinusError, msg=str(share)):
                run = acinus.Run(torn)
                for frame in run:
                    frame.spheres
                run.cells()

    def test_changed_bytes_end_as_an_error_of_this_package_or_not_at_all(self):
        whole = (self.path / "run.vtkhdf").read_bytes()
        changed = self.copy("changed.run")
        random = np.random.default_rng(1)
        for at in random.integers(0, 8000, 60):  # where HDF5 keeps what points to everything else
            (changed / "run.vtkhdf").write_bytes(whole[:at] + bytes([whole[at] ^ 0x55]) + whole[at + 1:])
            try:
                with mock.patch("acinus.hdf5.PAUSE", 0):
                    run = acinus.Run(changed)
                    for frame in run:
                        frame.deformable
                    run.cells(), run.events(), run.series(), run.provenance
            except acinus.AcinusError:
                pass

    def test_a_run_without_summary(self):
        gone = self.copy("gone.run")
        (gone / "summary.json").unlink()
        with self.assertRaisesRegex(acinus.NotFound, "--resume"):
            acinus.Run(gone).summary
        for text in ("{", "[" * 200000, "[]", "3", "\0", '{"a": 1' + "0" * 6000 + "}"):
            (gone / "summary.json").write_text(text)
            with self.assertRaises(acinus.Damaged):
                acinus.Run(gone).summary
        (gone / "summary.json").write_bytes(b'{"a": "\xff"}')
        with self.assertRaises(acinus.Damaged):
            acinus.Run(gone).summary


class Growing(unittest.TestCase):
    def test_a_run_that_goes_on_is_read(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "grows.run"
            child = subprocess.Popen([PROGRAM, "run", "two_cells", "--out", str(path), "--threads", "1", "--quiet",
                                      "--set", "time.end=200 h", "--set", "output.every=1 min"],
                                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                counts, deadline = [], time.monotonic() + 60
                while len(set(counts)) < 12 and time.monotonic() < deadline:
                    try:
                        run = acinus.Run(path)
                    except acinus.NotFound:
                        continue
                    n = len(run)
                    counts.append(n)
                    if n > 0:
                        self.assertEqual(run.status, "running")
                        self.assertEqual(run[n - 1].index, n - 1)
                        self.assertEqual(len(run.cells(n - 1)), 2)
                self.assertGreaterEqual(len(set(counts)), 12)
                self.assertEqual(counts, sorted(counts))
            finally:
                child.terminate()
                child.wait()


class OtherFiles(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)

    def test_law(self):
        path = self.root / "law.json"
        law = {"a0_kPa": 0.1, "a1_kPa": 2.0, "power": 3, "overlap_range": [0.0, 0.2], "table": []}
        path.write_text(json.dumps(law))
        np.testing.assert_allclose(acinus.Law(path).modulus([0.1, 0.2]), [0.102, 0.116])
        self.assertTrue(np.isnan(acinus.Law(path).modulus(0.3)))
        law["table"] = [{"overlap": 0.05, "modulus_kPa": 1.0}, {"overlap": 0.15, "modulus_kPa": 3.0}]
        path.write_text(json.dumps(law))
        np.testing.assert_allclose(acinus.Law(self.root).modulus([0.0, 0.1, 0.18]), [1, 2, 3])
        del law["power"]
        path.write_text(json.dumps(law))
        with self.assertRaisesRegex(acinus.Damaged, 'has no "power"'):
            acinus.Law(path)
        for text in ("[" * 200000, '{"a":' * 100000, "[1]"):
            path.write_text(text)
            with self.assertRaises(acinus.Damaged):
                acinus.Law(path)
        with self.assertRaises(acinus.NotFound):
            acinus.Law(self.root / "none.json")

    def test_study(self):
        with self.assertRaisesRegex(acinus.NotFound, "has no table.csv"):
            acinus.Study(self.root)
        (self.root / "table.csv").write_text("run,variant,seed,time_s,observable,value,unit\na/seed_1,a,1,0,cells,2,1\n")
        (self.root / "runs.csv").write_text("run,variant,seed,state,simulated_s,wall_s,cpu_s,state_hash,cause\n"
                                            "a/seed_1,a,1,waits,,,,,\n")
        (self.root / "runs" / "a").mkdir(parents=True)
        study = acinus.Study(self.root)
        self.assertEqual(list(study.table()["value"]), [2.0])
        self.assertTrue(np.isnan(np.asarray(study.runs()["wall_s"], dtype=float)[0]))
        self.assertEqual(study.verdicts(), [])
        with self.assertRaisesRegex(acinus.NoSuchItem, "variants are a"):
            study.run("b", 1)
        for text in ("[" * 200000, "{}", "["):
            (self.root / "verdicts.json").write_text(text)
            with self.assertRaises(acinus.Damaged):
                study.verdicts()
        (self.root / "runs.csv").write_bytes(b"run,variant\n\xff,b\n")
        with self.assertRaises(acinus.Damaged):
            study.runs()


if __name__ == "__main__":
    unittest.main()
