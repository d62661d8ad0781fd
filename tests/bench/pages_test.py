"""Pages of measurements: rules of bench/results/pages.py on small result files, then the pages of the tree, which must not be stale.

usage: pages_test.py
"""

import os
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(ROOT, "bench", "results"))
import pages  # noqa: E402

HEADER = ",".join(pages.COLUMNS) + "\n"


def row(figure, value, date="2026-11-01", command="acinus bench a --threads 1", case="one"):
    return f'{command},"{case}",{figure},{value},,abc,chip,avx2,1,{date}\n'


class Rules(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        with open(os.path.join(self.folder.name, name), "w", encoding="utf-8") as file:
            file.write(text)

    def make(self, template):
        self.write("p.md.in", template)
        return pages.make_pages(self.folder.name)["p.md"]

    def check_fault(self, template, *parts):
        with self.assertRaises(pages.Fault) as caught:
            self.make(template)
        for part in parts:
            self.assertIn(part, str(caught.exception))

    def test_figures_of_a_row_come_from_one_run(self):
        self.write("a.csv", HEADER + row("cpu_s", 1, "2026-11-03"))
        self.write("b.csv", HEADER + row("cpu_s", 2, "2026-11-02") + row("steps", 7, "2026-11-02"))
        self.assertEqual(self.make("{{value acinus bench a* | one | {cpu_s} s}}"), "1 s")
        self.assertEqual(self.make("{{value acinus bench a* | one | {cpu_s} s, {steps}}}"), "2 s, 7")
        self.write("c.csv", HEADER + row("steps", 8, "2026-11-01", case="two"))
        self.assertEqual(self.make("{{table\ncase | cpu | steps\ncells | {cpu_s} | {steps}\n*a* | *\n}}").splitlines()[2:],
                         ["| two |  | 8 |", "| one | 1 |  |"])

    def test_last_row_of_a_day_counts(self):
        self.write("a.csv", HEADER + row("cpu_s", 1) + row("cpu_s", 2))
        self.assertEqual(self.make("{{value acinus bench a* | one | {cpu_s}}}"), "2")

    def test_number_of_scenes_does_not_tell_measurements_apart(self):
        old = row("clean", 3, command="acinus bench stress --threads 1 --seeds 3")
        new = row("clean", 9, "2026-11-02", "acinus bench stress --threads 1 --seeds 9 --first 4")
        life = row("clean", 5, "2026-11-03", "acinus bench stress --threads 1 --seeds 9 --life")
        self.write("a.csv", HEADER + old + new + life)
        self.assertEqual(self.make("{{value acinus bench stress --threads 1 | one | {clean}}}"), "9")

    def test_figures_are_scaled_and_formatted(self):
        self.write("a.csv", HEADER + row("e", 0.012345) + row("n", 19721) + row("t", 90))
        self.assertEqual(self.make("{{value *a* | one | {e*100} % {e*100:+.1f} {n} {t/60}}}"), "1.23 % +1.2 19,721 1.5")

    def test_table_has_a_row_for_each_case_and_empty_cells_for_missing_figures(self):
        self.write("a.csv", HEADER + row("x", 1, case="a, b") + row("y", 2, case="a, b") + row("x", 3, case="c"))
        self.assertEqual(self.make("{{table\ncase | x | y\ncells | {x} | {y:.1f}\n*a* | a* | first\n*a* | c\n}}\nend"),
                         "| case | x | y |\n|---|---|---|\n| first | 1 | 2.0 |\n| c | 3 |  |\nend")

    def test_cheapest_setting_leaves_out_failed_and_coarse_ones(self):
        def setting(name, cpu, error, failed=0):
            case = f"scene: error of time stepping: {name}"
            return row("cpu_s", cpu, case=case) + row("failed", failed, case=case) + row("pressure_error", error, case=case)
        self.write("a.csv", HEADER + setting("linearly-implicit, 162 nodes, nodes, dt 60 s, CG 0.003", 2, .004) +
                   setting("linearly-implicit, 162 nodes, nodes, dt 300 s, CG 0.003", 1, .03) +
                   setting("linearly-implicit, 162 nodes, 3-point, dt 300 s, CG 0.003", .5, .001) +
                   setting("newton, 162 nodes, nodes, dt 300 s, CG 0.003", .1, .001, 1))
        self.assertIn("| s | dt 300 s, CG 0.003: 1 s | dt 60 s, CG 0.003: 2 s | dt 60 s, CG 0.003: 2 s | 0.4 %, 2 s |",
                      self.make("{{cheapest\nscene | nodes | s\n}}"))

    def test_faults_of_templates_name_what_is_missing(self):
        self.write("a.csv", HEADER + row("x", 1) + row("x", 1, case="two"))
        self.check_fault("{{value *a* | none | {x}}}", "p.md.in", 'the case "none"')
        self.check_fault("{{value *a* | one | {z}}}", "lacks a figure", "newest run has x")
        self.check_fault("{{value *a* | * | {x}}}", "stands for 2 cases")
        self.check_fault("{{table\ncase | x\ncells | {z}\n*a* | one\n}}", 'the figures of "{z}"')
        self.check_fault("{{table\ncase | x\n*a* | one\n}}", "the second line of a table")
        self.check_fault("{{cheapest\nscene | nodes | s\n}}", 'settings of "scene"')

    def test_faults_of_result_files_name_file_and_line(self):
        for text, part in (("time,force\n", "a.csv:1: the columns are not"), (HEADER + "a,b\n", "a.csv:2: a line has 10 fields"),
                           (HEADER + row("x", "many"), 'a.csv:2: value "many"'), (HEADER + row("x", 1, "yesterday"), 'a.csv:2: date "yesterday"'),
                           ("", "a.csv:1: the columns are not")):
            self.write("a.csv", text)
            self.check_fault("", part)

    def test_a_changed_figure_makes_a_page_stale(self):
        self.write("a.csv", HEADER + row("x", 1))
        text = self.make("{{value *a* | one | {x}}}")
        self.assertEqual(pages.find_stale({"p.md": text}, self.folder.name), ["p.md"])
        self.write("p.md", text)
        self.assertEqual(pages.find_stale({"p.md": text}, self.folder.name), [])
        self.write("a.csv", HEADER + row("x", 2))
        self.assertEqual(pages.find_stale(pages.make_pages(self.folder.name), self.folder.name), ["p.md"])


class Tree(unittest.TestCase):
    def test_pages_are_made_from_the_result_files(self):
        made = pages.make_pages()
        self.assertEqual(sorted(made), ["benchmarks.md", "stress.md", "work_precision.md"])
        self.assertEqual(pages.find_stale(made), [], "run bench/results/pages.py")

    def test_pages_are_short(self):
        for name, text in pages.make_pages().items():
            prose = " ".join(line for line in text.splitlines() if not line.startswith("|"))
            self.assertLessEqual(len(prose.split()), 900, name)


if __name__ == "__main__":
    unittest.main()
