"""Runs what pages show: every command, in an empty folder for each page; what it prints must be what the page prints.

usage: run_pages.py ROOT ACINUS [--rewrite] PAGE...          PAGE: docs/start/tutorial.md

Blocks are indented by four spaces. A block that begins with "$ " is a session: commands and what they print; a line "..."
stands for any lines left out. A block that begins with the name of a program has commands without output; they end with exit
code 0. Commands in a sentence are run too, but for names of commands and forms with words to replace (`acinus run NAME`).
Every other block is a file, Python, or is not run. Comments in the lines above a block say so:

    <!-- file: NAME -->                  the block is the content of NAME and equals docs/examples/tutorial/NAME
    <!-- write: NAME -->                 the block is the content of NAME, which only this page has
    <!-- python -->                      the block runs in Debian's Python with the package of python/
    <!-- fails with CODE -->             the last command of the block ends with this exit code
    <!-- exits: CODE CODE ... -->        exit codes of all commands of the block
    <!-- prepare: COMMAND -->            runs before the block; makes files that the reader is supposed to have
    <!-- shortened: TEXT => TEXT -->     replaced in the commands of the block, to take less time
    <!-- background: OPTIONS -->         the block's command goes on until the page ends; the options are added to it, with a
                                         free port for PORT. The port 8642 of other commands of the page becomes this one
    <!-- not run: REASON -->             to read only; the reasons are listed at the end
    <!-- picture: NAME -->               above an image: the commands made NAME, the image is a copy of it

The folder has links to docs/, runs/ and python/ of ROOT, build/acinus, and a stand-in for acinus.sh that runs the program.
Numbers may differ by 5 % (rounding differs between processors), those of time and speed by any amount. With --rewrite the
page gets the lines that were printed, the files of the examples and the pictures. Exit code 1: something differs; 77: a
package for the pictures is missing.
"""
import difflib
import os
import re
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

from page_blocks import COMMAND, SPAN, blocks_of, check_blocks, commands_of, is_complete
from page_lines import align, check_align, is_near

# Lines of progress.
PROGRESS = re.compile(r"(running|start-up: \w+)  ")
STAND_IN = """#!/usr/bin/env bash
# Hands its arguments to the program, as acinus.sh does once the program is built.
case ${1:-help} in help) exec "%s/acinus.sh" help ;; esac
exec acinus "$@"
"""
SETTINGS = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
            "PYTHONDONTWRITEBYTECODE": "1"}


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return str(s.getsockname()[1])


class Page:
    """A page that is run in a folder of its own."""

    def __init__(self, root, program, path, rewrite):
        self.root, self.path, self.rewrite, self.faults = os.path.abspath(root), path, rewrite, []
        self.not_run, self.n_run, self.processes, self.port = [], 0, [], free_port()
        with open(os.path.join(root, path), encoding="utf-8") as file:
            self.lines = file.read().split("\n")
        self.folder = tempfile.mkdtemp(prefix="acinus_page_")
        self.work = os.path.join(self.folder, "work")
        for name in ("bin", "work", "work/build"):
            os.mkdir(os.path.join(self.folder, name))
        for name in ("bin/acinus", "work/build/acinus"):
            os.symlink(os.path.abspath(program), os.path.join(self.folder, name))
        os.symlink("/usr/bin/python3", os.path.join(self.folder, "bin/python3"))  # Debian's, with the packages that the pages name
        for name in ("docs", "runs", "python"):  # the page says: in the top folder of the repository
            os.symlink(os.path.join(self.root, name), os.path.join(self.work, name))
        starter = os.path.join(self.work, "acinus.sh")
        with open(starter, "w", encoding="utf-8") as file:
            file.write(STAND_IN % self.root)
        os.chmod(starter, 0o755)
        with open(os.path.join(self.folder, ".curlrc"), "w", encoding="utf-8") as file:
            file.write("fail\n")  # an error of the service is an exit code
        self.environment = dict(os.environ, PATH=os.path.join(self.folder, "bin") + os.pathsep + os.environ["PATH"], CURL_HOME=self.folder,
                                PYTHONPATH=os.path.join(self.root, "python"), **SETTINGS)

    def fault(self, number, text):
        self.faults.append(f"{self.path}:{number + 1}: {text}")

    def run(self):
        """Runs all blocks; the lines of the page as they ought to be."""
        result, done, blocks = [], 0, list(blocks_of(self.lines))
        for first, end, comments in blocks:
            result += self.lines[done:first]
            block, done = self.lines[first:end], end
            result += self.run_block(first, block, comments)
        if blocks and self.n_run == 0:
            self.fault(0, "no command was run")
        for process in self.processes:
            process.terminate()
            if process.wait(60) not in (0, -signal.SIGTERM):
                self.fault(0, f"a command in the background ended with exit code {process.returncode}")
        return result + self.lines[done:]

    def run_block(self, first, block, comments):
        said = dict(comments)
        for kind, argument in comments:
            if kind == "prepare":
                self.call(first, argument, 0)
        if "not run" in said:
            self.not_run.append(f"{self.path}:{first + 1}: {said['not run'] or 'an example to read'}: {block[0].strip()}")
        elif "file" in said:
            return self.write_file(first, block, said["file"])
        elif "write" in said:
            with open(os.path.join(self.work, said["write"]), "w", encoding="utf-8") as file:
                file.write("\n".join(line[4:] for line in block) + "\n")
        elif "picture" in said:
            self.take_picture(first, block[0], said["picture"])
        elif "python" in said:
            self.call(first, "/usr/bin/python3 -c " + shlex.quote("\n".join(line[4:] for line in block)), 0)
        elif "spans" in said:
            for span in filter(is_complete, SPAN.findall(block[0])):
                self.call(first, span, 0)
        elif block[0].startswith("    $ "):
            return self.run_session(first, block, int(said.get("fails with", 0)))
        elif COMMAND.match(block[0][4:]):
            self.run_commands(first, block, said)
        else:
            self.fault(first, "a block without $ needs a comment above it: file, write, python or not run")
        return block

    def run_commands(self, first, block, said):
        """Runs a block of commands without output."""
        old, _, new = said.get("shortened", "").partition(" => ")
        found = [(k, text.replace("8642", self.port)) for k, text in commands_of(block)]
        codes = [int(code) for code in said.get("exits", "").split()] or [0] * (len(found) - 1) + [int(said.get("fails with", 0))]
        if old and not any(old in text for _, text in found):
            self.fault(first, f"nothing to shorten: {old}")
        if len(codes) != len(found):
            self.fault(first, f"{len(codes)} exit codes for {len(found)} commands")
        for (k, text), code in zip(found, codes):
            text = text.replace(old, new) if old else text
            if "background" in said:
                self.start(first + k, text.partition("#")[0] + said["background"].replace("PORT", self.port))
            else:
                self.call(first + k, text, code)

    def start(self, number, command):
        """Starts a command that goes on; returns when it has printed its first line."""
        print(f"$ {command} &", flush=True)
        self.n_run += 1
        process = subprocess.Popen(["bash", "-c", "exec " + command], cwd=self.work, env=self.environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
        self.processes.append(process)
        if not process.stdout.readline():
            self.fault(number, f"ended: {command}")

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
        """Lines that a command prints; a program that is not installed is listed, not run."""
        name = command.split()[0]
        if not name.startswith((".", "/")) and COMMAND.match(name) and "=" not in name and not shutil.which(name, path=self.environment["PATH"]):
            self.not_run.append(f"{self.path}:{number + 1}: {name} is not installed: {command}")
            return []
        print(f"$ {command}", flush=True)
        self.n_run += 1
        begin = time.monotonic()
        done = subprocess.run(["bash", "-c", command], cwd=self.work, env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        if time.monotonic() - begin > 5:
            print(f"  {time.monotonic() - begin:.0f} s", flush=True)
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


WRONG = [  # parts of a page, with what is to be said about each; None: nothing
    ("    $ acinus hello\n    hello", None),
    ("    $ acinus took 3 in 2 s\n    took 3.1 in 9 s", None),
    ("<!-- fails with 3 -->\n\n    $ exit 3", None),
    ("<!-- not run: it deletes -->\n\n    $ rm x", None),
    ("    acinus hello   # with a comment\n    acinus 'two\n    lines'", None),
    ("<!-- exits: 0 3 -->\n    acinus hello\n    acinus; exit 3", None),
    ("<!-- shortened: 4; false => 3 -->\n    acinus 4; false", None),
    ("<!-- prepare: echo 1 > made -->\n    acinus; cat made", None),
    ("<!-- write: b.json -->\n    { }\n\nText.\n\n    acinus; cat b.json", None),
    ("<!-- python -->\n    print(1)", None),
    ("Text with `acinus list` and `acinus run`.", None),
    ("    acinus hello; false", "exit code 1, not 0"),
    ("<!-- exits: 0 3 -->\n    acinus hello\n    acinus", "exit code 0, not 3"),
    ("<!-- exits: 0 3 -->\n    acinus hello", "2 exit codes for 1"),
    ("<!-- shortened: 5 => 3 -->\n    acinus 4", "nothing to shorten"),
    ("<!-- python -->\n    1 / 0", "ZeroDivisionError"),
    ("<!-- prepare: false -->\n    acinus", "exit code 1, not 0"),
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
    check_align()
    check_blocks()
    check_pages()
    faults, not_run, n_run, rewrite = [], [], 0, "--rewrite" in sys.argv
    for path in words[2:]:
        page = Page(words[0], words[1], path, rewrite)
        if any("<!-- picture:" in line for line in page.lines) and not can_draw():
            print("python3-h5py, python3-matplotlib, python3-vtk9 or xvfb is missing: skipped")
            sys.exit(77)
        lines = page.run()
        faults += page.faults
        not_run += page.not_run
        n_run += page.n_run
        if rewrite:
            with open(os.path.join(words[0], path), "w", encoding="utf-8") as file:
                file.write("\n".join(lines))
        shutil.rmtree(page.folder)
    print("\n".join(["not run:"] * bool(not_run) + ["  " + line for line in not_run] + faults + [f"{n_run} commands, {len(faults)} faults"]))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
