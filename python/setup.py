"""The version is that of the program, said once: in CMakeLists.txt."""
import pathlib
import re

from setuptools import setup

cmake = pathlib.Path(__file__).resolve().parent.parent / "CMakeLists.txt"
setup(version=re.search(r"project\(acinus VERSION ([\d.]+)", cmake.read_text()).group(1))
