"""Ends of runs: every signal, output that goes nowhere, terminals without control sequences.

usage: ends_test.py PROGRAM
"""

import os
import pty
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))
SCENE = """{
  "time": {"end": "%s", "step": "30 s"},
  "cell_types": {"a": {"dcm": {"nodes": 42}}},
  "cells": {"source": "list", "list": [{"position": ["0 um", "0 um", "0 um"], "model": "dcm"}, {"position": ["23.5 um", "0 um", "0 um"], "model": "cbm"}]},
  "output": {"every": "%s"}
}"""

# What docs/howto/stopping.md says, signal by signal.
STOP = ("HUP", "INT", "QUIT", "USR1", "USR2", "ALRM", "TERM", "XCPU", "VTALRM", "PROF", "STKFLT", "POLL", "PWR", "RTMIN", "RTMAX")
IGNORED = ("PIPE", "XFSZ", "CHLD", "CONT", "URG", "WINCH")
CRASH = ("ILL", "TRAP", "ABRT", "BUS", "FPE", "SEGV", "SYS")
HELD = ("STOP", "TSTP", "TTIN", "TTOU")  # until SIGCONT
OBEYED_ALTHOUGH_IGNORED = ("INT", "QUIT")


def number(name):
    return 16 if name == "STKFLT" else getattr(signal, "SIG" + name)


class Ends(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="acinus_ends_")
        self.addCleanup(self.folder.cleanup)
        self.write("long.json", SCENE % ("400 days", "1 day"))
        self.write("short.json", SCENE % ("2 min", "1 min"))
        self.write("bad.json", SCENE % ("2 um", "1 min"))

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def start(self, *words, ignore=(), **more):
        def prepare():
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            for name in ignore:
                signal.signal(number(name), signal.SIG_IGN)
        more = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "stdin": subprocess.DEVNULL} | more
        process = subprocess.Popen([PROGRAM, *words], cwd=self.folder.name, preexec_fn=prepare, restore_signals=False, **more)
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.kill()
        process.wait()
        for stream in (process.stdout, process.stderr):
            if stream:
                stream.close()

    def running(self, out, ignore=()):
        """A run that is past its first step."""
        process = self.start("run", "long.json", "--out", out, "--threads", "1", "--progress", "json", ignore=ignore)
        for line in process.stdout:
            if b'"running"' in line:
                return process
        self.fail("the run ended before its first step")

    def shell(self, line, **environment):
        """Exit code, stdout and stderr of a line of bash; `acinus` is the program."""
        text = f'acinus() {{ "{PROGRAM}" "$@"; }}\n{line}'
        done = subprocess.run(["bash", "-c", text], cwd=self.folder.name, stdin=subprocess.DEVNULL, capture_output=True, timeout=120, check=False,
                              env=os.environ | environment)
        return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")

    def expect_stop(self, name, process, out):
        process.send_signal(number(name))
        text = process.communicate(timeout=60)[0].decode()
        self.assertEqual(process.returncode, 75, f"SIG{name}: {text[-300:]}")
        self.assertTrue(os.path.exists(self.path(out, "checkpoint.h5")), f"SIG{name}")
        with open(self.path(out, "summary.json"), encoding="utf-8") as file:
            self.assertIn(f"stopped by signal {int(number(name))}", file.read())

    def expect_to_go_on(self, name, process):
        """It prints on after the signal."""
        process.send_signal(number(name))
        for _ in range(2):
            self.assertIn(b'"running"', process.stdout.readline(), f"SIG{name}")
        self.assertIsNone(process.poll(), f"SIG{name}")

    def test_every_signal_has_its_row(self):
        # 9 is SIGKILL; 32 and 33 belong to the C library.
        rows = {int(number(name)) for name in STOP + IGNORED + CRASH + HELD} | {9}
        between = set(range(signal.SIGRTMIN, signal.SIGRTMAX + 1))
        self.assertEqual(rows | between, set(range(1, 32)) | between)

    def test_stop_signals_leave_a_checkpoint(self):
        for name in STOP:
            self.expect_stop(name, self.running(name), name)

    def test_some_signals_end_nothing(self):
        process = self.running("on")
        for name in IGNORED:
            self.expect_to_go_on(name, process)
        self.expect_stop("TERM", process, "on")

    def test_crashes_keep_their_end(self):
        for name in CRASH:
            process = self.running(name)
            process.send_signal(number(name))
            self.assertEqual(process.wait(timeout=60), -number(name), f"SIG{name}")

    def test_held_runs_go_on_and_stop(self):
        process = self.running("held")
        for name in HELD:
            process.send_signal(number(name))
            process.send_signal(signal.SIGCONT)
        self.expect_stop("HUP", process, "held")

    def test_what_was_ignored_at_the_start_stays_ignored(self):
        names = [name for name in STOP if name not in OBEYED_ALTHOUGH_IGNORED]
        process = self.running("nohup", ignore=names)
        for name in names:
            process.send_signal(number(name))
        self.expect_to_go_on("HUP", process)
        self.expect_stop("INT", process, "nohup")
        # A shell without job control ignores these two for what it starts in the background.
        for name in OBEYED_ALTHOUGH_IGNORED:
            self.expect_stop(name, self.running("of_" + name, ignore=(name,)), "of_" + name)

    def test_before_the_first_step_there_is_nothing_to_save(self):
        for name in ("HUP", "TERM", "XCPU", "RTMIN"):
            process = self.start("run", "lobule_hybrid", "--set", "lobule.height=3e5 um", "--threads", "1", "--out", "early")
            self.wait_for_signals(process)
            process.send_signal(number(name))
            text = process.communicate(timeout=60)[0].decode()
            self.assertEqual(process.returncode, 75, text)
            self.assertIn("while a run was prepared", text)
            self.assertFalse(os.path.exists(self.path("early")))

    @staticmethod
    def wait_for_signals(process):
        """Until the process catches SIGHUP."""
        for _ in range(1000):
            with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
                caught = int(next(line for line in file if line.startswith("SigCgt")).split()[1], 16)
            if caught & 1:
                return
            time.sleep(0.01)

    @staticmethod
    def is_running(file):
        if not os.path.exists(file):
            return False
        with open(file, "rb") as progress:
            return b'"running"' in progress.read()

    def test_a_study_stops_on_every_kind_of_end(self):
        self.write("two.json", '{"name": "two", "scene": "long.json", "seeds": [1], "variants": {"a": {}, "b": {}}, "observables": ["cells"]}')
        for name in ("HUP", "XCPU", "PWR"):
            process = self.start("study", "two.json", "--jobs", "2", "--out", name)
            running = self.path(name, "runs")
            for _ in range(3000):
                files = [self.path(running, v, "seed_1", "progress.txt") for v in "ab"]
                if all(self.is_running(file) for file in files):
                    break
                time.sleep(0.01)
            process.send_signal(number(name))
            text = process.communicate(timeout=60)[0].decode()
            self.assertEqual(process.returncode, 75, text)
            for variant in "ab":
                self.assertTrue(os.path.exists(self.path(running, variant, "seed_1", "checkpoint.h5")), text)

    def test_output_that_cannot_be_written_is_told(self):
        commands = ("list", "check two_cells", "check two_cells --resolved", "explain", "explain cell.radius", "schema", "--help", "run --help",
                    "--version", "new two_cells $RANDOM", "study example --dry-run")
        for words in commands:
            for where, why in (("> /dev/full", "No space left on device"), (">&-", "it is closed")):
                code, _, error = self.shell(f"acinus {words} {where}")
                self.assertEqual(code, 4, f"{words} {where}: {error}")
                self.assertIn("standard output: " + why, error, words)
                self.assertEqual(len(error.splitlines()), 1, error)

    def test_errors_keep_their_code_wherever_they_are_printed(self):
        for where in ("> /dev/full", ">&-", "2> /dev/full", "2>&-", "> /dev/full 2>&1", ">&- 2>&-", "<&- >&- 2>&-"):
            self.assertEqual(self.shell(f"acinus check bad.json {where}")[0], 2, where)
            self.assertEqual(self.shell(f"acinus no_such_command {where}")[0], 2, where)
            self.assertEqual(self.shell(f"acinus check missing.json {where}")[0], 4, where)

    def test_a_reader_that_goes_ends_short_commands_in_silence(self):
        for words in ("list", "explain", "schema", "check two_cells --resolved", "--help", "explain --markdown"):
            code, _, error = self.shell(f"acinus {words} | true; exit ${{PIPESTATUS[0]}}")
            self.assertEqual((code, error), (0, ""), words)
            code, out, error = self.shell(f"acinus {words} | head -1; exit ${{PIPESTATUS[0]}}")
            self.assertEqual((code, error), (0, ""), words)
            self.assertEqual(len(out.splitlines()), 1, words)

    def test_a_run_goes_on_when_its_reader_goes(self):
        code, out, error = self.shell('acinus run short.json --out r --threads 1 --progress json | head -1; exit ${PIPESTATUS[0]}')
        self.assertEqual((code, error), (0, ""), out)
        with open(self.path("r", "summary.json"), encoding="utf-8") as file:
            self.assertIn('"completed"', file.read())
        code, _, error = self.shell('acinus run long.json --out w --threads 1 --max-walltime 1s | true; exit ${PIPESTATUS[0]}')
        self.assertEqual((code, error), (75, ""))
        self.assertTrue(os.path.exists(self.path("w", "checkpoint.h5")))

    def test_a_run_ends_whole_although_it_cannot_print(self):
        for name, where in (("full", "> /dev/full"), ("closed", ">&-"), ("all", "<&- >&- 2>&-")):
            code, _, error = self.shell(f"acinus run short.json --out {name} --threads 1 {where}")
            self.assertEqual(code, 4, error)
            code, out, error = self.shell(f"acinus compare {name} {name} --tolerance positions=0")
            self.assertEqual(code, 0, error)  # its files hold nothing that was printed
        self.assertEqual(self.shell("acinus run short.json --out quiet --quiet --threads 1 >&-")[0], 0)
        for name in ("full", "closed", "all", "quiet"):
            with open(self.path(name, "summary.json"), encoding="utf-8") as file:
                self.assertIn('"completed"', file.read())

    def on_terminal(self, kind, *words):
        """What the program prints on a terminal."""
        main, other = pty.openpty()
        environment = {k: v for k, v in os.environ.items() if k != "TERM"} | ({} if kind is None else {"TERM": kind})
        process = self.start(*words, stdout=other, stderr=other, env=environment)
        os.close(other)
        text = b""
        try:
            while piece := os.read(main, 65536):
                text += piece
        except OSError:  # the other end was closed
            pass
        os.close(main)
        process.wait()
        return text.replace(b"\r\n", b"\n")

    def test_terminals_without_control_sequences_get_plain_lines(self):
        run = ("run", "long.json", "--threads", "1", "--max-walltime", "1s", "--overwrite", "--out", "t")
        self.write("one.json", '{"name": "one", "scene": "short.json", "seeds": [1], "variants": {"a": {}}, "observables": ["cells"]}')
        study = ("study", "one.json", "--jobs", "1", "--out")
        for k, kind in enumerate(("dumb", "", None)):
            for words in (run, (*study, f"s{k}")):
                text = self.on_terminal(kind, *words)
                self.assertTrue(text)
                self.assertNotIn(b"\x1b", text, kind)
                self.assertNotIn(b"\r", text, kind)
        for words in (run, (*study, "s")):
            self.assertIn(b"\r\x1b[K", self.on_terminal("xterm", *words))


if __name__ == "__main__":
    unittest.main()
