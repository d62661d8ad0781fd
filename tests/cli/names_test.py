"""Names of files with spaces, quotes and bytes that are not UTF-8; commands that are printed to be copied.

usage: names_test.py PROGRAM
"""

import os
import re
import resource
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))
SCENE = """{
  "time": {"end": "4 min", "step": "30 s"},
  "cell_types": {"a": {"dcm": {"nodes": 42}}},
  "cells": {"source": "list", "list": [{"position": ["0 um", "0 um", "0 um"], "model": "dcm"}, {"position": ["23.5 um", "0 um", "0 um"], "model": "cbm"}]},
  "output": {"every": "1 min"}
}"""
ODD = (b"a b", b"it's", b'say "so"', b"$HOME & `ls`", b"back\\slash", b"line\nend", b"tab\there", b"Sch\xe4del", b"\xff\xfe", b"na\xc3\xafve *", b"100%{}")


def label_image():
    """Two cuboids of one label each, as NRRD."""
    size = (24, 16, 12)
    voxels = bytearray(size[0] * size[1] * size[2])
    for label, first in ((1, 3), (2, 13)):
        for z in range(3, 9):
            for y in range(4, 12):
                for x in range(first, first + 8):
                    voxels[x + size[0] * (y + size[1] * z)] = label
    head = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 24 16 12\nspacings: 1 1 1\nencoding: raw\n\n"
    return head.encode() + bytes(voxels)


class Names(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="acinus_names_")
        self.addCleanup(folder.cleanup)
        self.folder = os.fsencode(folder.name)
        self.write(b"scene.json", SCENE.encode())

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)

    def read(self, *names):
        with open(self.path(*names), "rb") as file:
            return file.read()

    def call(self, *words, limit=None):
        """Exit code and what was printed."""
        def prepare():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120,
                              check=False, preexec_fn=prepare if limit else None)
        return done.returncode, done.stdout

    def done(self, *words):
        code, text = self.call(*words)
        self.assertEqual(code, 0, text)
        return text

    def ask_to_stop(self, out):
        """Makes a run there stop after its first step."""
        os.makedirs(self.path(out))
        self.write(os.path.join(out, b"STOP"), b"")

    def copied(self, text, pattern):
        """The command in what was printed, run by a shell."""
        found = re.search(pattern.encode(), text)
        self.assertTrue(found, text)
        line = re.sub(rb"^\S*acinus(?= )", b'"$0"', found.group(1))
        done = subprocess.run(["bash", "-c", line, PROGRAM], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 0, line + done.stderr)
        return done.stdout

    def test_runs_take_every_name(self):
        for name in ODD:
            os.mkdir(self.path(name))
            scene = os.path.join(name, b"s " + name + b".json")
            self.write(scene, SCENE.encode())
            self.done("check", scene)
            self.done("check", scene, "--resolved")
            out = os.path.join(name, b"run")
            self.ask_to_stop(out)
            code, text = self.call("run", scene, "--threads", "1", "--out", out, "--set", "time.end=2 min", "--set", "output.every=30 s")
            self.assertEqual(code, 75, text)
            text = self.copied(text, r"continue with: (acinus run [^\n]*)")
            self.copied(text, r"page for the browser: (acinus report .*)")
            self.done("compare", out, out, "--tolerance", "positions=0", "--out", os.path.join(name, b"c.json"))
            for file in (b"run/summary.json", b"c.json", b"c_cells.svg"):
                self.read(name, file).decode()  # is UTF-8

    def test_runs_stopped_early_go_on_to_the_same_end(self):
        self.ask_to_stop(b"r")
        code, text = self.call("run", "scene.json", "--threads", "1", "--out", "r", "--until", "2 min")
        self.assertEqual(code, 75, text)
        self.copied(text, r"continue with: (acinus run [^\n]*)")
        self.assertIn(b'"simulated_s": 120.0', self.read(b"r", b"summary.json"))

    def test_copies_of_scenes_can_be_run_by_the_line_that_is_printed(self):
        for name in ODD:
            text = self.done("new", "two_cells", name)
            self.copied(text.replace(b"acinus run", b"acinus check"), r"run it with: (acinus check [^\n]*)")

    def test_imports_take_every_name(self):
        for k, name in enumerate(ODD):
            self.write(name + b".nrrd", label_image())
            text = self.done("import", name + b".nrrd", "--voxel", "1 um", "--threads", "1", "--quiet", "--out", b"quiet%d" % k)
            self.assertEqual(text, b"")
            text = self.done("import", name + b".nrrd", "--voxel", "1 um", "--threads", "1", "--out", name)
            self.copied(text.replace(b"acinus run", b"acinus check"), r"run it with: (acinus check [^\n]*)")
            self.read(name, b"scene.json").decode()

    def test_what_fails_leaves_no_half_made_folder(self):
        self.write(b"labels.nrrd", label_image())
        for limit in (1, 1000, 8000):
            code, text = self.call("import", "labels.nrrd", "--voxel", "1 um", "--threads", "1", "--out", "tissue", limit=limit)
            self.assertEqual(code, 4, text)
            self.assertFalse(os.path.exists(self.path(b"tissue")), limit)
        self.done("import", "labels.nrrd", "--voxel", "1 um", "--threads", "1", "--out", "tissue")
        code, text = self.call("new", "two_cells", "copy", limit=10)
        self.assertEqual(code, 4, text)
        self.assertFalse(os.path.exists(self.path(b"copy")))

    def test_text_of_scenes_that_is_not_utf8_is_refused_before_anything_is_made(self):
        self.write(b"latin.json", SCENE.replace('"time"', '"description": "Sch\xe4del", "time"').encode("latin-1"))
        for words in (("latin.json",), ("scene.json", "--set", b"description=Sch\xe4del"), ("scene.json", "--set", b"d\xe4=1")):
            for command in ("check", "run"):
                code, text = self.call(command, *words)
                self.assertEqual(code, 2, text)
                self.assertIn(b"UTF-8", text)
        self.assertEqual(sorted(os.listdir(self.folder)), [b"latin.json", b"scene.json"])

    def test_missing_files_of_every_name_are_told(self):
        for name in ODD:
            for words in (("check", name), ("run", name), ("compare", name, name), ("report", name), ("study", name), ("new", name, "x"), ("explain", name)):
                code, text = self.call(*words)
                self.assertIn(code, (2, 4), text)
                self.assertNotIn(b"internal", text)
        self.assertEqual(os.listdir(self.folder), [b"scene.json"])


if __name__ == "__main__":
    unittest.main()
