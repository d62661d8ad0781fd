"""Runs what a page shows: every block of commands in an empty folder; what they print must be what the page prints.

usage: run_pages.py ROOT ACINUS [--rewrite] PAGE...          PAGE: docs/start/tutorial.md

Blocks are indented by four spaces. A block that begins with "$ " is a session: commands and what they print; a line "..."
stands for any lines left out. Every other block is a file or is not run, as a comment in the line above it says:

    <!-- file: NAME -->                  the block is the content of NAME and equals docs/examples/tutorial/NAME
    <!-- fails with CODE -->             the session's last command ends with this exit code
    <!-- not run -->                     to read only
    <!-- picture: NAME -->               above an image: the commands made NAME, the image is a copy of it

Numbers may differ by 5 % (rounding differs between processors), those of time and speed by any amount. With --rewrite the
page gets the lines that were printed, the files of the examples and the pictures. Exit code 1: something differs; 77: a
package for the pictures is missing.
"""
import difflib
import os
import re
import shutil
import subprocess
import sys
import tempfile

COMMENT = re.compile(r"<!-- (file|fails with|not run|picture):? ?(\S*) -->$")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
# Lines of progress, and what depends on the machine within a line.
PROGRESS = re.compile(r"(running|start-up: \w+)  ")
TIMED = [re.compile(p) for p in (r"\bin [\d.]+ (?:s|min|h)\b", r"^ *cpu .*", r"about [\d.]+ \w+ left", r"[\d.]+x real time")]
TOLERANCE = 0.05


def skeleton(line):
    return " ".join(NUMBER.sub("#", line).split())


def numbers(line):
    for pattern in TIMED:
        line = pattern.sub("", line)
    return [float(n) for n in NUMBER.findall(line)]


def is_near(a, b):
    """Whether two lines of one skeleton have the same numbers; small ones by the last digit that is printed."""
    x, y = numbers(a), numbers(b)
    return len(x) == len(y) and all(abs(p - q) <= TOLERANCE * max(abs(p), abs(q)) for p, q in zip(x, y))


def find_line(line, printed, start):
    """Index of the line in what was printed, from `start`; the same skeleton, else None."""
    return next((k for k in range(start, len(printed)) if skeleton(printed[k]) == skeleton(line)), None)


def align(shown, printed):
    """(shown line, printed line or None) for every line of the page; a last entry (None, line) for one that it lacks."""
    at, free = 0, False
    for line in shown:
        if line == "...":
            free = True
            yield line, line
            continue
        k = find_line(line, printed, at) if free else at if at < len(printed) and skeleton(printed[at]) == skeleton(line) else None
        yield line, None if k is None else printed[k]
        at, free = at if k is None else k + 1, free and k is None
    if not free and at < len(printed):
        yield None, printed[at]


def blocks_of(lines):
    """(first line, line after the last, kind, argument) of the blocks and pictures of a page; kinds are those of the comments."""
    k = 0
    while k < len(lines):
        above = COMMENT.match(lines[k - 1].strip()) if k and lines[k] and lines[k - 1].strip() else None
        above = above or (COMMENT.match(lines[k - 2].strip()) if k > 1 and not lines[k - 1].strip() else None)
        if lines[k].startswith("    ") and (k == 0 or not lines[k - 1].strip() or above):
            end = k
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            while not lines[end - 1].strip():
                end -= 1
            yield k, end, above[1] if above else "session", above[2] if above else ""
            k = end
        else:
            if above and above[1] == "picture":
                yield k, k + 1, "picture", above[2]
            k += 1


class Page:
    """A page that is run in a folder of its own."""

    def __init__(self, root, program, path, rewrite):
        self.root, self.path, self.rewrite, self.faults = root, path, rewrite, []
        with open(os.path.join(root, path), encoding="utf-8") as file:
            self.lines = file.read().split("\n")
        self.folder = tempfile.mkdtemp(prefix="acinus_page_")
        os.mkdir(os.path.join(self.folder, "bin"))
        os.symlink(os.path.abspath(program), os.path.join(self.folder, "bin", "acinus"))
        self.work = os.path.join(self.folder, "work")
        os.mkdir(self.work)
        for name in ("docs", "runs"):  # the page says: in the top folder of the repository
            os.symlink(os.path.join(os.path.abspath(root), name), os.path.join(self.work, name))

    def fault(self, number, text):
        self.faults.append(f"{self.path}:{number + 1}: {text}")

    def run(self):
        """Runs all blocks; the lines of the page as they ought to be."""
        result, done, n_session = [], 0, 0
        for first, end, kind, argument in list(blocks_of(self.lines)):
            result += self.lines[done:first]
            block, done = self.lines[first:end], end
            if kind == "file":
                block = self.write_file(first, block, argument)
            elif kind == "picture":
                self.take_picture(first, block[0], argument)
            elif kind != "not run" and not block[0].startswith("    $ "):
                self.fault(first, "a block without $ needs a comment above it: file or not run")
            elif kind != "not run":
                n_session += 1
                block = self.run_session(first, block, int(argument or 0))
            result += block
        if n_session == 0:
            self.fault(0, "no block of commands")
        return result + self.lines[done:]

    def write_file(self, number, block, name):
        path = os.path.join(self.root, "docs/examples/tutorial", name)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(os.path.join(self.work, name), "w", encoding="utf-8") as file:
            file.write(text)
        example = ["    " + line if line else "" for line in text.rstrip("\n").split("\n")]
        if example != [line.rstrip() for line in block] and not self.rewrite:
            self.fault(number, f"the block is not {path}")
        return example

    def take_picture(self, number, line, name):
        source, link = os.path.join(self.work, name), re.search(r"!\[[^\]]+\]\((\S+)\)", line)
        if not link:
            self.fault(number, "no image with a description")
        elif not os.path.exists(source) or os.path.getsize(source) < 2000:
            self.fault(number, f"no command made {name}, or it is empty")
        elif self.rewrite:
            shutil.copyfile(source, os.path.join(self.root, os.path.dirname(self.path), link[1]))

    def run_session(self, number, block, code):
        """The block with what its commands print now."""
        starts = [k for k, line in enumerate(block) if line.startswith("    $ ")] + [len(block)]
        result = []
        for start, end in zip(starts, starts[1:]):
            last = end == len(block)
            printed = self.call(number + start, block[start][6:], code if last else 0)
            result.append(block[start])
            result += self.compare(number + start, [line[4:] for line in block[start + 1:end]], printed)
        return result

    def call(self, number, command, code):
        environment = dict(os.environ, PATH=os.path.join(self.folder, "bin") + os.pathsep + os.environ["PATH"])
        print(f"$ {command}", flush=True)
        done = subprocess.run(["bash", "-c", command], cwd=self.work, env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        if done.returncode != code:
            self.fault(number, f"exit code {done.returncode}, not {code}: {command}\n{done.stdout[-1500:]}")
        return [line.rstrip() for line in done.stdout.splitlines() if not PROGRESS.match(line) and line.strip()]

    def compare(self, number, shown, printed):
        """Lines to show. Those of --rewrite are printed lines, the most similar one where none has the skeleton."""
        if self.rewrite and "..." not in shown:
            return ["    " + line for line in printed] if shown else []
        if not shown:
            return []
        result = []
        for line, found in align([line for line in shown if line.strip()], printed):
            if line is None:
                self.fault(number, f"printed, but not on the page: {found}")
                continue
            if found is None and self.rewrite:
                found = next(iter(difflib.get_close_matches(line, printed, 1, 0.6)), None)
            if found is None:
                self.fault(number, "not printed: " + line + "\nprinted:\n  " + "\n  ".join(printed))
            elif not self.rewrite and not is_near(line, found):
                self.fault(number, f"shown:   {line}\nprinted: {found}")
            result.append("    " + (found or line))
        return result


def can_draw():
    """Whether Debian's Python has what the pictures need."""
    return subprocess.run(["/usr/bin/python3", "-c", "import h5py, matplotlib, vtkmodules.vtkCommonCore"],
                          stderr=subprocess.DEVNULL).returncode == 0 and (os.environ.get("DISPLAY") or shutil.which("xvfb-run"))


def check_rules():
    """A page that is wrong must be found wrong."""
    printed = ["first 10 um", "completed 4 h in 2.5 s", "last 3"]
    for shown, good in ((printed, True), (["first 10.2 um", "completed 4 h in 9 s", "last 3"], True), (["first 11 um", "..."], False),
                        (["first 10 um"], False), (["first 10 um", "..."], True), (["...", "last 3"], True), (["second 10 um", "..."], False),
                        (["...", "first 10 um"], False), (["first 10 um", "last 3"], False), (["...", "completed 5 h in 2.5 s", "..."], False)):
        pairs = list(align(shown, printed))
        assert all(a is not None and b is not None and is_near(a, b) for a, b in pairs) == good, (shown, pairs)
    lines = ["text", "", "<!-- file: a.json -->", "", "    {", "", "    }", "", "<!-- picture: a.png -->", "![a](b.png)", "", "    $ b"]
    assert list(blocks_of(lines)) == [(4, 7, "file", "a.json"), (9, 10, "picture", "a.png"), (11, 12, "session", "")], list(blocks_of(lines))


WRONG = [  # parts of a page, with what is to be said about each; None: nothing
    ("    $ acinus hello\n    hello", None),
    ("    $ acinus took 3 in 2 s\n    took 3.1 in 9 s", None),
    ("<!-- fails with 3 -->\n\n    $ exit 3", None),
    ("<!-- not run -->\n\n    $ rm x", None),
    ("<!-- file: a.json -->\n\n    {}", None),
    ("    $ acinus took 3\n    took 4", "shown:"),
    ("    $ acinus hello\n    good bye", "not printed: good bye"),
    ("    $ acinus hello; acinus more\n    hello", "not on the page: more"),
    ("    $ exit 3", "exit code 3, not 0"),
    ("<!-- fails with 3 -->\n\n    $ true", "exit code 0, not 3"),
    ("    { }", "needs a comment"),
    ("<!-- file: a.json -->\n\n    { }", "the block is not"),
    ("<!-- picture: a.png -->\n![a](b.png)", "no command made a.png"),
]


def check_pages():
    """Every fault planted into a page is found, and nothing else."""
    for part, said in WRONG:
        with tempfile.TemporaryDirectory() as root:
            os.makedirs(os.path.join(root, "docs/examples/tutorial"))
            with open(os.path.join(root, "docs/examples/tutorial/a.json"), "w", encoding="utf-8") as file:
                file.write("{}\n")
            with open(os.path.join(root, "page.md"), "w", encoding="utf-8") as file:
                file.write("# Page\n\n    $ true\n\nText.\n\n" + part + "\n")
            page = Page(root, "/bin/echo", "page.md", False)
            lines = page.run()
            shutil.rmtree(page.folder)
            assert lines == page.lines or said or "3.1" in part, (lines, page.lines)
            assert (said is None and not page.faults) or (said and any(said in fault for fault in page.faults)), (part, page.faults)


def main():
    words = [word for word in sys.argv[1:] if word != "--rewrite"]
    if len(words) < 3:
        sys.exit(__doc__)
    check_rules()
    check_pages()
    if not can_draw():
        print("python3-h5py, python3-matplotlib, python3-vtk9 or xvfb is missing: skipped")
        sys.exit(77)
    faults, rewrite = [], "--rewrite" in sys.argv
    for path in words[2:]:
        page = Page(words[0], words[1], path, rewrite)
        lines = page.run()
        faults += page.faults
        if rewrite:
            with open(os.path.join(words[0], path), "w", encoding="utf-8") as file:
                file.write("\n".join(lines))
        shutil.rmtree(page.folder)
    print("\n".join(faults + [f"{len(faults)} faults"]))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
