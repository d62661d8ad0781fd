"""Simulations driven from Python are those of the command line, bit for bit.

usage: ACINUS=build/acinus PYTHONPATH=build-python/python python3 python/tests/test_simulation.py
"""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import acinus

PROGRAM = os.environ["ACINUS"]


def state_hash_of_program(scene, changes, folder):
    words = [PROGRAM, "run", scene, "--threads", "1", "--quiet", "--out", folder]
    for key, value in changes.items():
        words += ["--set", f"{key}={value}"]
    subprocess.run(words, check=True)
    return json.loads((pathlib.Path(folder) / "summary.json").read_text())["state_hash"]


class SameBits(unittest.TestCase):
    def check_scene(self, scene, changes):
        with tempfile.TemporaryDirectory() as folder:
            expected = state_hash_of_program(scene, changes, folder + "/run")
            sim = acinus.Simulation(scene, changes)
            sim.run()
            self.assertEqual(sim.state_hash, expected)
            self.assertEqual(sim.time, sim.end)

    def test_hybrid(self):
        self.check_scene("lobule_hybrid", {"start_up.growth_time": "30 min", "time.end": "20 min", "output.every": "10 min"})

    def test_growing_cells(self):
        self.check_scene("spheroid", {"time.end": "30 h"})

    def test_looking_changes_nothing(self):
        a, b = (acinus.Simulation("two_cells", {"time.end": "10 min"}) for _ in range(2))
        a.run()
        held = []
        while b.time < b.end - 1e-6:
            b.step()
            b.cells()
            held.append(b.nodes(0))
        self.assertEqual(a.state_hash, b.state_hash)
        self.assertEqual(a.steps, b.steps)
        self.assertGreater(np.abs(held[0] - held[-1]).max(), 0)  # each shows its own moment


class Stepping(unittest.TestCase):
    def make(self):
        return acinus.Simulation("two_cells", {"time.end": "4 min", "time.step": "30 s", "output.every": "1 min"})

    def test_run_goes_to_a_time_and_run_for_goes_on_by_a_duration(self):
        until, by = self.make(), self.make()
        until.run(until="1 min")
        until.run("3 min")
        by.run_for("1 min")
        self.assertAlmostEqual(by.time, 60, places=6)
        by.run_for(120)
        self.assertAlmostEqual(by.time, 180, places=6)
        self.assertEqual(until.state_hash, by.state_hash)
        by.run()
        self.assertEqual(by.time, by.end)
        by.run_for("30 s")  # beyond the end of the scene
        self.assertAlmostEqual(by.time, 270, places=6)

    def test_no_time_to_go_changes_nothing(self):
        sim = self.make()
        sim.run(until=60)
        before = (sim.state_hash, sim.steps)
        sim.run(until=sim.time)
        sim.run_for(0)
        self.assertEqual((sim.state_hash, sim.steps), before)

    def test_the_past_is_refused(self):
        sim = self.make()
        sim.run(until="2 min")
        for until in ("1 min", 0, -5):
            with self.assertRaisesRegex(acinus.BadInput, r"at t = 120 s already.*run_for"):
                sim.run(until=until)
        with self.assertRaisesRegex(acinus.BadInput, "not negative"):
            sim.run_for("-1 min")
        sim.run_for("10 min")
        with self.assertRaises(acinus.BadInput):
            sim.run()  # the end of the scene is past
        self.assertAlmostEqual(sim.time, 720, places=6)

    def test_a_start_up_does_not_count(self):
        sim = acinus.Simulation("two_cells", {"time.end": "10 min", "start_up.enabled": True, "start_up.growth_time": "5 min",
                                              "start_up.max_duration": "5 min"})
        self.assertLess(sim.time, 0)
        sim.run_for("1 min")
        self.assertAlmostEqual(sim.time, 60, places=6)

    def test_times(self):
        from acinus.simulation import seconds
        for time, s in (("2 h", 7200), ("2h", 7200), (" 1.5 min ", 90), ("1e2 s", 100), ("3. s", 3), (7, 7), (np.float32(0.5), 0.5),
                        ("1 d", 86400)):
            self.assertEqual(seconds(time), s, time)
        for time in ("2", "h", "", "2 parsecs", "two h", "1 2 h", "nan s", "1e999 s", float("nan"), float("inf"), [1], None, "1,5 h"):
            with self.assertRaisesRegex(acinus.BadInput, "a time is a finite number of s, or a text like", msg=str(time)):
                seconds(time)


class Substances(unittest.TestCase):
    def test_fields_and_cells_are_those_of_a_run(self):
        changes = {"time.end": "10 min", "substance_grid.spacing": "10 um"}
        with tempfile.TemporaryDirectory() as folder:
            run = acinus.simulate("chemotaxis_dish", folder + "/run", changes)
            sim = acinus.Simulation("chemotaxis_dish", changes)
            sim.run()
            self.assertEqual(sim.state_hash, run.summary["state_hash"])
            [name] = [s["name"] for s in sim.scene["substances"]]
            here, there = sim.field(name), run.field(name)
            np.testing.assert_array_equal(here.value, there.value)
            np.testing.assert_allclose(here.origin, there.origin, atol=1e-9)
            np.testing.assert_array_equal(here.spacing, there.spacing)
            self.assertEqual((here.unit, here.time), (there.unit, there.time))
            cells = sim.cells()
            for column in ("concentration_" + name, "exchange_" + name):
                np.testing.assert_array_equal(cells[column], run.cells(frame=-1)[column])
                self.assertEqual(cells.attrs["units"][column], run.unit("cells/" + column))
            before = here.value.copy()
            sim.run_for("5 min")
            np.testing.assert_array_equal(here.value, before)  # a copy
            with self.assertRaisesRegex(acinus.NoSuchItem, name):
                sim.field("glucose")

    def test_a_scene_without_substances_has_no_fields(self):
        with self.assertRaisesRegex(acinus.NoSuchItem, "no substances"):
            acinus.Simulation("two_cells").field("oxygen")


class Looking(unittest.TestCase):
    def setUp(self):
        self.sim = acinus.Simulation("lobule_hybrid", {"start_up.growth_time": "30 min", "time.end": "10 min"})

    def test_arrays_are_those_of_the_state(self):
        cells = self.sim.cells()
        np.testing.assert_array_equal(cells["id"], np.sort(cells["id"]))
        ids, centres = self.sim.spheres()
        self.assertEqual(len(self.sim), len(cells["id"]))
        sphere = np.asarray(cells["kind"]) == acinus.SPHERE
        order = {c: k for k, c in enumerate(ids)}
        rows = [order[c] for c in np.asarray(cells["id"])[sphere]]
        np.testing.assert_array_equal(centres[rows, 0], np.asarray(cells["center_x"])[sphere])
        cell = int(np.asarray(cells["id"])[~sphere][0])
        nodes, triangles = self.sim.nodes(cell), self.sim.triangles(cell)
        volume = np.linalg.det(nodes[triangles]).sum() / 6
        row = list(cells["id"]).index(cell)
        self.assertAlmostEqual(volume / np.asarray(cells["volume"])[row], 1, places=12)
        self.assertFalse(nodes.flags.writeable)
        self.assertFalse(nodes.flags.owndata)

    def test_views_outlive_steps_and_the_simulation(self):
        cells = self.sim.cells()
        cell = int(np.asarray(cells["id"])[np.asarray(cells["kind"]) == acinus.DEFORMABLE][0])
        nodes = self.sim.nodes(cell)
        before = nodes.copy()
        self.sim.step()
        np.testing.assert_array_equal(nodes, before)
        self.assertGreater(np.abs(self.sim.nodes(cell) - before).max(), 0)
        del self.sim
        np.testing.assert_array_equal(nodes, before)


class Changing(unittest.TestCase):
    def test_a_moved_cell_is_where_it_was_put(self):
        sim = acinus.Simulation("two_cells", {"time.end": "10 min"})
        nodes = sim.nodes(1)
        sim.move(1, nodes + [300, 0, 0])
        np.testing.assert_allclose(sim.nodes(1), nodes + [300, 0, 0], rtol=0, atol=1e-12)
        sim.run()
        self.assertEqual(sim.cells()["contacts"][0], 0)

    def test_a_pulled_cell_moves_along(self):
        sim = acinus.Simulation("two_cells", {"time.end": "10 min"})
        start = np.asarray(sim.cells()["center_y"])[0]
        sim.pull(0, [0, 5, 0])
        sim.run()
        self.assertGreater(np.asarray(sim.cells()["center_y"])[0], start + 0.05)


class Programs(unittest.TestCase):
    def test_run_and_compare(self):
        with tempfile.TemporaryDirectory() as folder:
            runs = [acinus.simulate("two_cells", f"{folder}/{k}.run", {"time.end": "10 min", "output.every": "5 min", "seed": k}) for k in (1, 2)]
            self.assertEqual(runs[0].status, "completed")
            table = acinus.compare(*runs)
            self.assertIn("pressure", list(table["quantity"]))
            self.assertEqual(set(table["not_measured"]), {""})
            shorter = acinus.simulate("two_cells", f"{folder}/shorter.run", {"time.end": "5 min", "output.every": "5 min", "seed": 1})
            with self.assertWarnsRegex(UserWarning, "ends at 0.1667 h, but the last frame that all runs have is at 0.08333 h"):
                table = acinus.compare(runs[0], shorter)
            self.assertNotIn("", set(table["not_measured"]))
            with self.assertRaises(acinus.BadInput):
                acinus.simulate("two_cells", runs[0].folder)  # holds results

    def test_errors_say_what_to_do(self):
        with self.assertRaises(acinus.FileError) as caught:
            acinus.Simulation("two_cels")
        self.assertIn("two_cells", str(caught.exception))
        with self.assertRaises(acinus.BadInput) as caught:
            acinus.Simulation("two_cells", {"time.end": "10 um"})
        self.assertIn("time", str(caught.exception))
        sim = acinus.Simulation("two_cells")
        for call in (lambda: sim.nodes(99), lambda: sim.pull(99, [0, 0, 0])):
            with self.assertRaises(acinus.NoSuchItem):
                call()
        with self.assertRaises(acinus.BadInput):
            sim.move(0, np.zeros((3, 3)))
        with self.assertRaises(acinus.BadInput):
            sim.move(0, np.full(sim.nodes(0).shape, np.nan))
        with self.assertRaises(acinus.AcinusError):
            sim.run("2 parsecs")


if __name__ == "__main__":
    unittest.main()
