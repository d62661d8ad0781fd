"""Makes the pages of measurements from the result files beside this script.

usage: pages.py [--check]

Every NAME.md.in becomes docs/developers/NAME.md. With --check nothing is written; exit code 1 if a page is stale.
A template is Markdown with three directives (README.md has an example):

    {{value COMMAND | CASE | CELL}}            one text, within a line

    {{table                                    a row for each case
    FIRST HEADING | HEADING | ...
    cells | CELL | ...
    COMMAND | CASE [| text for the first column]
    }}

    {{cheapest                                 cheapest settings of scenes of `acinus bench work-precision`
    TITLE | QUADRATURE or * | text for the first column
    }}

COMMAND and CASE may hold *. A CELL is text with figures in braces, as in "{gain:.2f} ({gain_least} to {gain_most})"; a figure may be
scaled, {pressure_error*100}, and takes a format of Python, by default three digits. A cell of a table stays empty where its row lacks a figure.
All cells of a row come from one run: the newest that has the figures of the first cell, or of the first cell it can fill.
"""

import csv
import fnmatch
import glob
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
PAGES = os.path.join(HERE, "..", "..", "docs", "developers")
COLUMNS = ["command", "case", "figure", "value", "unit", "commit", "machine", "instruction set", "threads", "date"]
REPEATS = re.compile(r" --(seeds|first) \S+")  # options that say how often, not what
FIGURE = re.compile(r"\{(\w+)(?:([*/])([\d.e+-]+))?(?::([^}]*))?\}")
DIRECTIVE = re.compile(r"\{\{(value|table|cheapest)\b(.*?)\n?\}\}(?!\})", re.S)
USUAL = "linearly-implicit, "
LIMITS = (0.05, 0.02, 0.01)


class Fault(Exception):
    """Message for the developer."""


def read_rows(folder):
    """All rows of the result files of a folder, oldest first."""
    rows = []
    for path in sorted(glob.glob(os.path.join(folder, "*.csv"))):
        with open(path, encoding="utf-8", newline="") as file:
            reader = csv.DictReader(file, strict=True)
            if reader.fieldnames != COLUMNS:
                raise Fault(f"{path}:1: the columns are not {','.join(COLUMNS)}")
            for row in reader:
                where = f"{path}:{reader.line_num}"
                if None in row or None in row.values():
                    raise Fault(f"{where}: a line has {len(COLUMNS)} fields")
                if not re.fullmatch(r"\d{4}-\d\d-\d\d", row["date"]):
                    raise Fault(f"{where}: date \"{row['date']}\" is not like 2026-11-28")
                try:
                    row["value"] = float(row["value"])
                except ValueError:
                    raise Fault(f"{where}: value \"{row['value']}\" is not a number") from None
                rows.append(row)
    return sorted(rows, key=lambda row: row["date"])


def group_runs(rows):
    """(command, case) -> [{figure: value}] with one entry a run, oldest first."""
    table = {}
    for row in rows:
        runs = table.setdefault((REPEATS.sub("", row["command"]), row["case"]), {})
        runs.setdefault((row["date"], row["commit"], row["machine"]), {})[row["figure"]] = row["value"]
    return {key: list(runs.values()) for key, runs in table.items()}


def choose(runs, *cells):
    """Figures of the newest run that fills the first cell, else the second and so on; empty if none does."""
    for cell in cells:
        for figures in reversed(runs):
            if fill(cell, figures) is not None:
                return figures
    return {}


def find(table, command, case):
    found = [(key, runs) for key, runs in table.items()
             if fnmatch.fnmatchcase(key[0], command) and fnmatch.fnmatchcase(key[1], case)]
    if not found:
        raise Fault(f"no result file has the case \"{case}\" of \"{command}\"")
    return found


def number(value, how):
    """Three digits without an exponent where a reader does not need one."""
    if how:
        return format(value, how)
    return f"{value:,.0f}" if abs(value) >= 1000 else f"{value:.3g}"


def fill(cell, figures):
    """Text of a cell, None if a figure is missing."""
    missing = [name for name, *_ in FIGURE.findall(cell) if name not in figures]
    if missing:
        return None

    def one(match):
        name, sign, by, how = match.groups()
        scale = float(by) if by else 1
        return number(figures[name] * scale if sign != "/" else figures[name] / scale, how)

    return FIGURE.sub(one, cell)


def fields(line):
    return [field.strip() for field in line.split(" | ")]


def lines_of(body):
    return [line for line in body.strip().splitlines() if line.strip()]


def write_table(head, rows):
    lines = [head, ["---"] * len(head)] + rows
    return "\n".join("|" + "|".join(line) + "|" if line[0] == "---" else "| " + " | ".join(line) + " |" for line in lines)


def make_value(table, body):
    command, case, cell = fields(body)
    found = find(table, command, case)
    if len(found) > 1:
        raise Fault(f"\"{case}\" of \"{command}\" stands for {len(found)} cases; a value needs one")
    runs = found[0][1]
    text = fill(cell, choose(runs, cell))
    if text is None:
        raise Fault(f"\"{case}\" of \"{command}\" lacks a figure of \"{cell}\"; its newest run has {', '.join(runs[-1])}")
    return text


def make_table(table, body):
    head, cells, *selections = [fields(line) for line in lines_of(body)]
    if cells[0] != "cells" or len(cells) != len(head):
        raise Fault(f"the second line of a table is \"cells | CELL ...\" with {len(head) - 1} cells: {' | '.join(cells)}")
    rows = []
    for command, case, *text in selections:
        for key, runs in find(table, command, case):
            figures = choose(runs, *cells[1:])
            rows.append([text[0] if text else key[1]] + [fill(cell, figures) or "" for cell in cells[1:]])
    for k, cell in enumerate(cells[1:], 1):
        if not any(row[k] for row in rows):
            raise Fault(f"no row of the table has the figures of \"{cell}\"")
    for row in rows:
        if not any(row[1:]):
            raise Fault(f"the row \"{row[0]}\" has none of the figures of its table")
    return write_table(head, rows)


def settings_of(table, title, quadrature):
    """(setting, error, CPU seconds) of all settings of a scene that completed, on 162 nodes."""
    found = []
    for (_, case), runs in table.items():
        figures = choose(runs, "{cpu_s}")
        scene, _, rest = case.partition(": ")
        study, _, setting = rest.partition(": ")
        mesh = "" if quadrature == "*" else f", 162 nodes, {quadrature}, "
        if scene == title and mesh in setting and not figures.get("failed", 1) and "mesh" not in study and "ten minutes" not in study:
            error = figures.get("strain_error", figures["pressure_error"])
            found.append((setting.replace(mesh, ", ") if mesh else setting, error, figures["cpu_s"]))
    if not found:
        raise Fault(f"no result file has settings of \"{title}\" with {quadrature}")
    return found


def make_cheapest(table, body):
    rows = []
    for line in lines_of(body):
        title, quadrature, text = fields(line)
        found = settings_of(table, title, quadrature)
        row = [text]
        for limit in LIMITS:
            good = [f for f in found if f[1] <= limit]
            setting, error, cpu = min(good, key=lambda f: f[2]) if good else ("none", None, None)
            row.append(f"{setting.removeprefix(USUAL)}: {cpu:.2g} s" if good else setting)
        default = [f for f in found if f[0] == USUAL + "dt 60 s, CG 0.003"]
        row.append(f"{100 * default[0][1]:.2g} %, {default[0][2]:.2g} s" if default else "")
        rows.append(row)
    return write_table(["scene"] + [f"within {100 * limit:g} %" for limit in LIMITS] + ["dt 60 s, CG 0.003"], rows)


MAKERS = {"value": make_value, "table": make_table, "cheapest": make_cheapest}


def make_page(table, template):
    return DIRECTIVE.sub(lambda match: MAKERS[match[1]](table, match[2]), template)


def make_pages(folder=HERE):
    """Page name -> text."""
    table, pages = group_runs(read_rows(folder)), {}
    for path in sorted(glob.glob(os.path.join(folder, "*.md.in"))):
        name = os.path.basename(path).removesuffix(".in")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        try:
            pages[name] = make_page(table, text)
        except (Fault, ValueError) as fault:
            raise Fault(f"{path}: {fault}") from None
    return pages


def find_stale(pages, folder=PAGES):
    stale = []
    for name, text in pages.items():
        try:
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                old = file.read()
        except FileNotFoundError:
            old = None
        if old != text:
            stale.append(name)
    return stale


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    try:
        pages = make_pages()
    except Fault as fault:
        sys.exit(f"{fault}")
    stale = find_stale(pages)
    if sys.argv[1:]:
        sys.exit("".join(f"docs/developers/{name} is stale: run bench/results/pages.py\n" for name in stale) or 0)
    for name in stale:
        with open(os.path.join(PAGES, name), "w", encoding="utf-8") as file:
            file.write(pages[name])
        print(f"docs/developers/{name}")


if __name__ == "__main__":
    main()
