#!/usr/bin/env python3
"""Makes the reference pages that the program itself prints: scene keys, observables, commands.

usage: make_pages.py PROGRAM [--check]

PROGRAM is a built acinus, with acinus-bench beside it. Without --check the pages beside this script are written. With it
nothing is written: the exit code is 1 if a page differs from what the program says.
"""

import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
COLUMN = 30  # of the descriptions in a help text

EXIT_CODES = {  # code -> meaning, commands that return it
    0: ("done", "all"),
    1: ("internal error: a fault of the program, please report it", "all"),
    2: ("the scene, a file given on the command line, or the command line is wrong", "all"),
    3: ("the simulation could not continue. The last good state is saved, the message says what to change. "
        "Of a study: some run failed", "`run`, `calibrate`, `compare --scene`, `study`, `infer`, `openvt`"),
    4: ("a file could not be read or written, or the disk is full", "all"),
    5: ("runs differ by more than a tolerance allows, or a quantity was not measured", "`compare`"),
    75: ("stopped by a signal or a limit. A run that had begun has written a checkpoint; the same command goes on "
         "(`run` and `openvt` with `--resume`)", "`run`, `calibrate`, `compare --scene`, `study`, `infer`, `openvt`; `check --max-walltime`"),
}

SIGNALS = [  # all of them, as tests/cli/ends_test.py sends them
    ("HUP, INT (Ctrl-C), QUIT, USR1, USR2, ALRM, TERM, XCPU, VTALRM, PROF, STKFLT, POLL (IO), PWR, real-time signals",
     "commands that simulate stop with a checkpoint, exit code 75; other commands end"),
    ("PIPE", "ignored: output that nobody reads is dropped"),
    ("XFSZ", "ignored: the write fails, exit code 4"),
    ("CHLD, CONT, URG, WINCH", "nothing"),
    ("STOP, TSTP, TTIN, TTOU", "the process halts until CONT"),
    ("ILL, TRAP, ABRT, BUS, FPE, SEGV, SYS, KILL", "the process ends at once; the last checkpoint stays"),
]

MORE = {  # command -> page
    "run": "../howto/restart.md", "explain": "scene_keys.md", "mesh": "../howto/images.md", "import": "../howto/images.md",
    "voxelise": "../howto/images.md", "calibrate": "../science/calibration.md", "compare": "../howto/compare.md",
    "report": "../howto/report.md", "study": "../howto/study.md", "infer": "../howto/inference.md", "serve": "../howto/service.md",
    "openvt": "../science/community_benchmarks.md", "permedcoe": "../science/community_benchmarks.md",
    "bench": "../developers/profiling.md",
}


def call(program, *words):
    return subprocess.run([program, *words], stdout=subprocess.PIPE, text=True, check=True).stdout


def entries_of(text, heading):
    """(left column, description lines) of a list in a help text."""
    part = re.search(rf"^{heading}:\n(.*?)(?:\n\n|\Z)", text, re.M | re.S)
    entries = []
    for line in part.group(1).splitlines() if part else ():
        if line.startswith(" " * COLUMN):
            entries[-1][1].append(line[COLUMN:])
        elif len(line) > COLUMN and line[COLUMN - 1] == " ":
            entries.append((line[:COLUMN].strip(), [line[COLUMN:]]))
        else:
            entries.append((line.strip(), []))
    # A left column wider than its place has its description in the next line; it may have a space at COLUMN.
    return [(left + " " + lines[0], lines[1:]) if len(lines) > 1 and not lines[1].startswith(" ") else (left, lines)
            for left, lines in entries]


def cell(text):
    return text.replace("|", "\\|").replace("<", "\\<").strip()


def describe(lines):
    """Description lines as one cell; indented ones are a list of names and meanings."""
    text = ""
    for line in lines:
        name, _, meaning = line.strip().partition("  ")
        text += f"<br>`{name}`: {cell(meaning)}" if line.startswith(" ") else " " + cell(line)
    return text.strip()


def row_of(left, lines):
    """Row of a table: option or argument, its value, its meaning with conditions."""
    name, _, rest = left.partition(" ")
    name = re.sub(r"\{.*\}$", "", name)
    conditions = []
    for word, said in (("Needs", "only with"), ("Excludes", "not with")):
        found = re.search(rf" ?\b{word}: ((?:--?[\w-]+|[A-Z]+)(?: --[\w-]+)*)", rest)
        if found:
            options = ", ".join(f"`{option}`" for option in sorted(found.group(1).split()))
            conditions.append(f"{said} {options}")
            rest = rest.replace(found.group(0), "")
    if re.search(r"\bREQUIRED\b", rest):
        conditions.insert(0, "required")
        rest = re.sub(r" ?\bREQUIRED\b", "", rest)
    bounds = re.search(r":\w+ in \[(\S+) - (\S+)\]", rest)
    if bounds:
        conditions.insert(0, f"{bounds.group(1)} to {bounds.group(2)}")
    value = re.sub(r":(?:\w+ in \[[^\]]*\]|\{[^}]*\}|[A-Z]+)", "", rest).replace("...", "").strip()
    choices = re.search(r":\{([^}]*)\}", rest)
    if choices and value in ("TEXT", "N", "MODEL"):
        value = choices.group(1).replace(",", "|")
    if "..." in rest:
        conditions.append("may be repeated")
    value = "" if value == "TEXT" and not name.startswith("-") else value
    text = describe(lines)
    if conditions and "may be repeated" in text:
        conditions = [c for c in conditions if c != "may be repeated"]
    shown = "`" + value.replace("|", "\\|") + "`" if value else ""
    more = f" ({'; '.join(conditions)})" if conditions else ""
    return f"| `{name}` | {shown} | {text}{more} |"


def section(program, words):
    text = call(program, *words, "--help")
    lines = [f"## acinus {' '.join(words)}", "", text.splitlines()[0][0].upper() + text.splitlines()[0][1:].rstrip(".") + "."]
    if words[0] in MORE and len(words) == 1:
        lines[-1] += f" More: [{MORE[words[0]].split('/')[-1].split('#')[0]}]({MORE[words[0]]})."
    example = re.search(r"^Example: (.*?)\s*\Z", text, re.M | re.S)
    usage = re.search(r"^Usage: (.*)$", text, re.M).group(1).replace(" [OPTIONS]", "").replace("[", "").replace("]", "")
    lines += ["", f"    {usage}", ""]
    for heading, title in (("Positionals", "argument"), ("Options", "option")):
        rows = [row_of(*entry) for entry in entries_of(text, heading) if "--help" not in entry[0]]
        if rows:
            lines += [f"| {title} | value | meaning |", "|---|---|---|", *rows, ""]
    if example:
        lines += ["For example", "", *(f"    {line.strip()}" for line in example.group(1).splitlines()), ""]
    inner = entries_of(text, "Subcommands")
    return lines + [line for name, _ in inner for line in section(program, (*words, name.split()[0]))]


def commands_page(program):
    text = call(program, "--help")
    codes = sorted(int(code) for code in re.findall(r"(?:^|[:,]\s)(\d+) [a-z]", text[text.index("Exit codes"):]))
    if codes != sorted(EXIT_CODES):
        sys.exit(f"make_pages.py knows the exit codes {sorted(EXIT_CODES)}, `acinus --help` names {codes}")
    names = [left.split()[0] for left, _ in entries_of(text, "Subcommands")]
    lines = ["# Commands", "",
             "Made by `docs/reference/make_pages.py` from the program's own help; a test compares this page with the program.", "",
             "`acinus.sh COMMAND ...` builds the program if needed and hands everything on to `acinus COMMAND ...`. "
             "`acinus COMMAND --help` prints what stands here, `acinus --version` the version. "
             "`WALL` is a wall time such as `90s`, `10min` or `23h30m`; `TIME` a simulated time such as `\"2 h\"`; "
             "`SIZE` such as `4GB`; `PATH=VALUE` a scene key with its value.", "",
             ", ".join(f"[{name}](#acinus-{name})" for name in names), "",
             "## Exit codes", "", "| code | meaning | commands |", "|---|---|---|"]
    lines += [f"| {code} | {meaning} | {who} |" for code, (meaning, who) in EXIT_CODES.items()]
    lines += ["", "## Signals", "", "| signal | effect |", "|---|---|", *(f"| {a} | {b} |" for a, b in SIGNALS), "",
              "Limits and batch systems: [stopping](../howto/stopping.md).", ""]
    for name in names:
        lines += section(program, (name,))
    return "\n".join(lines).rstrip() + "\n"


def main():
    program, *flags = sys.argv[1:] or sys.exit(__doc__)
    if flags not in ([], ["--check"]):
        sys.exit(__doc__)
    pages = {
        "scene_keys.md": call(program, "explain", "--markdown"),
        "observables.md": call(program, "explain", "--observables", "--markdown"),
        "commands.md": commands_page(program),
    }
    stale = [name for name, text in pages.items() if not (HERE / name).exists() or (HERE / name).read_text() != text]
    for name in stale:
        if flags:
            print(f"docs/reference/{name} is stale: python3 docs/reference/make_pages.py build/acinus")
        else:
            (HERE / name).write_text(pages[name])
            print(f"wrote docs/reference/{name}")
    sys.exit(1 if flags and stale else 0)


main()
