"""Compares the stages of a step that docs/developers/architecture.md lists with the calls in coupling/step/step.cpp."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
LISTED = re.compile(r"^    [| ]+ (?:\d  )?([a-z]+(?:_[a-z]+)*)  ", re.MULTILINE)


def body_of(function, source):
    """The lines between the braces of a function's definition, the first one of that name."""
    found = re.search(r"^[\w:&<> ]+ " + function + r"\((?:[^;{]|\n)*?\) \{\n(.*?)^\}", source, re.MULTILINE | re.DOTALL)
    if not found:
        sys.exit(f"step.cpp defines no {function}")
    return found.group(1)


def calls_in(function, source):
    """Names of the functions that a function calls, line by line."""
    return re.findall(r"^  (?:return |const [\w&: ]+ = )?([a-z_]+)\(", body_of(function, source), re.MULTILINE)


def stages_called(source):
    calls = calls_in("attempt_step", source)
    at = calls.index("assemble") + 1
    return calls[:at] + calls_in("assemble", source) + calls[at:]


def stages_listed(page):
    part = page[page.index("attempt_step:"):]
    return LISTED.findall(part[part.index("\n") + 1:part.index("reject:")])


class StepList(unittest.TestCase):
    def setUp(self):
        self.source = (ROOT / "coupling/step/step.cpp").read_text()
        self.page = (ROOT / "docs/developers/architecture.md").read_text()

    def test_page_lists_the_calls(self):
        self.assertEqual(len(stages_called(self.source)), 9)  # the point, the system of it, and seven stages
        self.assertEqual(stages_listed(self.page), stages_called(self.source))

    def test_other_orders_are_found(self):
        swapped = self.page.replace("refresh_references", "x").replace("refresh_contacts", "refresh_references").replace(" x ", " refresh_contacts ")
        self.assertNotEqual(stages_listed(swapped), stages_called(self.source))


if __name__ == "__main__":
    unittest.main()
