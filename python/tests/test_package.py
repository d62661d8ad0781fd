"""The package builds and installs without a network.

usage: python3 python/tests/test_package.py; exit code 77 where pip, setuptools or wheel are not installed
"""
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def pip(*arguments):
    done = subprocess.run([sys.executable, "-m", "pip", "--no-cache-dir", *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stdout + done.stderr)


class Package(unittest.TestCase):
    def test_wheel_holds_the_version_of_the_program_and_imports(self):
        version = re.search(r"project\(acinus VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)  # a copy: building leaves files beside the sources
            shutil.copytree(ROOT / "python", root / "python", ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
            shutil.copy(ROOT / "CMakeLists.txt", root)
            offline = ("--no-index", "--no-deps", "--no-build-isolation")
            pip("wheel", *offline, "--wheel-dir", root / "wheels", root / "python")
            wheel, = (root / "wheels").iterdir()
            self.assertTrue(wheel.name.startswith(f"acinus-{version}-"), wheel.name)
            pip("install", *offline, "--target", root / "site", wheel)
            self.assertTrue((root / "site" / "acinus" / "py.typed").exists())
            said = subprocess.run([sys.executable, "-c", "import acinus; print(acinus.__file__)"], capture_output=True,
                                  text=True, env={"PYTHONPATH": str(root / "site")}, cwd=root, check=True).stdout
            self.assertIn(str(root / "site"), said)
            # It calls a program from PATH or $ACINUS, and says what is missing where there is none.
            program = root / "program"
            program.write_text("#!/bin/sh\necho called: $*\nexit 3\n")
            program.chmod(0o755)
            call = [sys.executable, "-m", "acinus", "program", "run", "two_cells", "--until", "1 s"]
            there = subprocess.run(call, capture_output=True, text=True, cwd=root,
                                   env={"PYTHONPATH": str(root / "site"), "ACINUS": str(program)})
            self.assertEqual((there.returncode, there.stdout), (3, "called: run two_cells --until 1 s\n"))
            missing = subprocess.run(call, capture_output=True, text=True, cwd=root, env={"PYTHONPATH": str(root / "site"), "PATH": ""})
            self.assertEqual(missing.returncode, 2)
            self.assertIn("there is no program acinus in PATH", missing.stderr)


if __name__ == "__main__":
    if any(importlib.util.find_spec(name) is None for name in ("pip", "setuptools", "wheel")):
        sys.exit(77)
    unittest.main()
