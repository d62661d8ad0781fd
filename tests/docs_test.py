"""Fails where a Markdown page names something that does not exist.

usage: docs_test.py ROOT [BUILD ACINUS [ACINUS_BENCH]]

Looked up: links and their anchors, files and folders, names of code on pages about it, shipped scenes and studies, presets of
CMake and, with a build folder and its programs, ctest names and labels, commands, their options, benchmarks and scene keys.
CHANGELOG.md tells the past and may name what is gone. Prints file:line and what is wrong; exit code 1 if anything is.
"""

import fnmatch
import json
import os
import re
import shlex
import subprocess
import sys

SKIPPED = re.compile(r"^(build[^/]*|out|(.*/)?node_modules|\.git|(.*/)?__pycache__|(.*/)?[^/]*\.(run|study))$")
SOURCE_ENDINGS = (".hpp", ".cpp", ".py")
FILE_NAME = re.compile(r"[\w.-]+\.(hpp|cpp|py|md|json|sh|txt|cmake|svg|png|vtk|vtkhdf|xmf|h5|csv|log|journal|lock|bib|slurm)")
FOLDER = re.compile(r"(?:[\w.-]+/)+")
SPAN = re.compile(r"(`+)(.+?)\1")
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
PLACEHOLDER = re.compile(r"[A-Z][A-Z_.=]*$|.*[<>{}$]")
IDENTIFIER = re.compile(r"[A-Z][a-z]\w*|[a-z]\w*_\w*[a-z]|k[A-Z]\w+")
ABOUT_CODE = re.compile(r".+/README\.md|docs/developers/(add_\w+|architecture)\.md")
DOTTED = re.compile(r"[a-z_]+(?:\.(?:[a-z_]+|<\w+>|\*|[0-9]+))+")
JSON_TOKEN = re.compile(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', re.S)


def read(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read()


def call(*words):
    return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True).stdout


def options_of(text):
    """Option -> whether a value follows it."""
    found = re.findall(r"^\s+(?:-\w,)?(--[\w-]+)(?:\{\w+\})?(?: (\S+))?", text, re.M)
    return {option: bool(value) and value not in ("Excludes:", "Needs:") for option, value in found}


def walk_schema(node, path=()):
    """The paths of all keys; "*" stands for a name or a number."""
    for choice in node.get("anyOf", ()):
        yield from walk_schema(choice, path)
    for name, inner in node.get("properties", {}).items():
        yield path + (name,)
        yield from walk_schema(inner, path + (name,))
    inner = node.get("items", node.get("additionalProperties"))
    if isinstance(inner, dict):
        yield path + ("*",)
        yield from walk_schema(inner, path + ("*",))


def walk_example(value, path=()):
    """The paths of all keys of an example."""
    for name, inner in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield path + (str(name),)
        yield from walk_example(inner, path + (str(name),))


class Facts:
    """What there is to name: files, scenes, tests and labels of the tree; commands, options and keys of the program."""

    def __init__(self, root, build="", program="", bench=""):
        self.root, self.files, self.folders, self.program = root, set(), set(), program
        for folder, folders, names in os.walk(root):
            place = os.path.relpath(folder, root).replace(os.sep, "/")
            place = "" if place == "." else place + "/"
            folders[:] = [name for name in folders if not SKIPPED.match(place + name)]
            self.files |= {place + name for name in names}
            self.folders |= {place + name for name in folders}
        text = {p: read(os.path.join(root, p)) for p in self.files if p.endswith(SOURCE_ENDINGS + (".txt", ".json", ".sh"))}
        self.names = {os.path.basename(path) for path in self.files}
        self.pages = sorted(path for path in self.files if path.endswith(".md") and path != "CHANGELOG.md")
        top = "|".join(re.escape(f) for f in sorted(self.folders) if "/" not in f)
        self.top_path = re.compile(rf"(?<![\w./<>~*-])(?:{top})/[\w./*<>{{}}$-]*")
        self.literals = "\n".join(line for p in text if p.endswith(SOURCE_ENDINGS) for line in re.findall(r'"((?:\\.|[^"\\\n])*)"', text[p]))
        self.words = set(re.findall(r"\w+", "\n".join(text.values())))
        self.kinds = {kind: {os.path.basename(p)[:-5] for p in self.files if re.fullmatch(rf"runs/{folder}/\w+\.json", p)}
                      for kind, folder in (("scene", "scenes"), ("study", "studies"))}
        self.script_options = {o for p in text if p.endswith((".py", ".sh")) for o in re.findall(r"--[a-z][a-z-]+", text[p])}
        self.presets = {p["name"] for p in json.loads(text.get("CMakePresets.json", '{"configurePresets": []}'))["configurePresets"]}
        self.starter = set(re.findall(r"^  (\w+)\)", text.get("acinus.sh", ""), re.M))
        self.module = set(re.findall(r'add_parser\("([a-z-]+)"', text.get("python/acinus/__main__.py", "")))
        session = "\n".join(text[p] for p in text if p.startswith("runs/session/") and p.endswith(".cpp"))
        self.summary = set(re.findall(r'"(\w+)"', session))
        self.commands, self.keys, self.benches = {}, set(), set()
        if program:
            tests = json.loads(call("ctest", "--test-dir", build, "--show-only=json-v1"))["tests"]
            self.kinds["test"] = {test["name"] for test in tests}
            self.kinds["label"] = {label for test in tests for p in test.get("properties", ()) if p["name"] == "LABELS" for label in p["value"]}
            self.ask_commands(program)
            for more in ((), ("--study",), ("--inference",)):
                self.keys |= set(walk_schema(json.loads(call(program, "schema", *more))))
            paths = {tuple(line.split()[0].split(".")) for more in ((), ("study",), ("inference",)) for line in call(program, "explain", *more).splitlines()}
            paths |= {tuple(word for word in key if word != "*") for key in self.keys}
            self.ends = {path[k:] for path in paths for k in range(len(path))}
            self.blocks = {word for path in paths for word in path[:-1]}
        if bench:
            self.commands["bench"] = options_of(call(bench, "--help"))
            self.benches = set(call(program, "bench").split())

    def ask_commands(self, program, *above):
        """Names are those of all words: "run", "mesh", "mesh vessels"."""
        text = call(program, *above, "--help")
        if above:
            self.commands[" ".join(above)] = options_of(text)
        for name in re.findall(r"^  (\w+)  ", text.partition("Subcommands:")[2], re.M):
            if name != "bench":
                self.ask_commands(program, *above, name)

    def has_path(self, path):
        path = path.rstrip("/.")
        if "*" in path:
            return any(fnmatch.fnmatch(known, path) for known in self.files | self.folders)
        return path in self.files | self.folders or any(path + ending in self.files for ending in SOURCE_ENDINGS)

    def is_written(self, name):
        """Whether a source names this file, as a whole or as another file's name with an ending."""
        parts = [(name[:k], name[k:]) for k in range(1, len(name)) if name[k] == "."]
        return name in self.literals or any(FILE_NAME.fullmatch(a) and a in self.literals and b in self.literals for a, b in parts)

    def is_key(self, parts):
        """Whether words name a scene key: its end as `explain` writes it, or its start in full, with names or numbers in it."""
        parts = ["*" if re.fullmatch(r"<\w+>|\*|[0-9]+", part) else part for part in parts]
        return tuple(parts) in self.ends or any(
            len(key) >= len(parts) and all(k in (p, "*") for k, p in zip(key, parts)) for key in self.keys)


def slug(heading):
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def split_page(text):
    """(line number, text, is code) of every line; lines that end in a backslash are joined in code."""
    fenced, was_code, before, pending = False, False, "", None
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
            before = line
            continue
        code = fenced or (line.startswith("    ") and (was_code or before.strip() == ""))
        if code and pending:
            number, line = pending[0], pending[1] + " " + line.strip()
        pending = (number, line.rstrip()[:-1]) if code and line.rstrip().endswith("\\") else None
        if not pending:
            yield number, line, code
        was_code, before = code or (was_code and line.strip() == ""), line


def anchors_of(text):
    names = [slug(line.lstrip("#")) for _, line, code in split_page(text) if not code and re.match(r"#{1,6} ", line)]
    return {name if names[:k].count(name) == 0 else f"{name}-{names[:k].count(name)}" for k, name in enumerate(names)}


class Page:
    """One page; findings are texts."""

    def __init__(self, facts, path, text=None):
        self.facts, self.path, self.text = facts, path, text or read(os.path.join(facts.root, path))
        # Options of other programs are those that the page's own commands give them.
        foreign = [re.split(r"(?:^|\s)(?:\S*/)?acinus(?:\.sh|-bench)?(?:\s|$)", line)[0] for _, line, code in split_page(self.text) if code]
        self.options = set(re.findall(r"--[a-z][a-z-]+", "\n".join(foreign))).union(facts.script_options, *facts.commands.values())

    def near(self, path):
        return os.path.normpath(os.path.join(os.path.dirname(self.path), path)).replace(os.sep, "/")

    def exists(self, path):
        return self.facts.has_path(path) or self.facts.has_path(self.near(path))

    def check(self):
        for number, line, code in split_page(self.text):
            found = [f"{path}: no such file" for path in self.facts.top_path.findall(re.sub(r"\]\([^)]*\)", "]", line))
                     if not re.search(r"[<>{}$]", path) and not self.exists(path)]
            if code:
                found += self.check_commands(line.split(" #")[0])
            else:
                found += list(self.check_links(line)) + list(self.check_prose(line))
                found += [f for _, span in SPAN.findall(line) for f in self.check_span(span)]
            yield from ((number, message) for message in found)
        if self.facts.program:
            yield from self.check_examples()

    def check_links(self, line):
        for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
            if re.match(r"[a-z]+:", target):
                continue
            file, _, anchor = target.partition("#")
            path = self.near(file) if file else self.path
            if path not in self.facts.files | self.facts.folders:
                yield f"link to {target}: no such file"
            elif anchor and anchor not in anchors_of(read(os.path.join(self.facts.root, path))):
                yield f"link to {target}: no such heading there"

    def check_prose(self, line):
        if line.startswith("|"):  # tables of folders
            for folder in re.findall(r"(?:^\| ?|, )([a-z_]+/)(?=,| ?\|)", line):
                yield from self.check_folder(folder)
        for kind, known in self.facts.kinds.items():
            for word in re.findall(rf"\b{kind}s? `([a-z][a-z0-9_]*)`", line):
                if word not in known:
                    yield f"{word}: no such {kind}"

    def check_folder(self, folder):
        known = self.exists(folder) or SKIPPED.match(folder.split("/")[0]) or folder.rstrip("/") in self.facts.literals
        if not known:
            yield f"{folder}: no such folder"

    def check_span(self, span):
        facts, word = self.facts, re.split(r"[ =:]", span)[0]
        if FILE_NAME.fullmatch(span):
            if span not in facts.names and f"<!-- write: {span} -->" not in self.text and not facts.is_written(span):
                yield f"{span}: no such file, and no source writes one"
        elif FOLDER.fullmatch(span) and not facts.top_path.match(span):
            yield from self.check_folder(span)
        elif "/" in span and span.endswith(SOURCE_ENDINGS) and not re.search(r"[<>*\s]", span):
            if not self.exists(span):
                yield f"{span}: no such file"
        elif span.startswith("--") and facts.benches:
            yield from (f"{o}: no program has this option" for o in re.findall(r"(?:^| )(--[a-z-]+)", span) if o not in self.options)
            yield from self.check_settings(span.split())
        elif os.path.basename(word) in ("acinus", "acinus.sh", "acinus-bench", "ctest", "cmake"):
            yield from self.check_commands(span)
        elif IDENTIFIER.fullmatch(span) and ABOUT_CODE.fullmatch(self.path):
            if span not in facts.words and span not in facts.names:
                yield f"{span}: no source has this name"
        elif facts.program and DOTTED.fullmatch(word):
            parts = word.removesuffix(".*").split(".")
            if parts[0] in facts.blocks and not set(parts) <= facts.summary and not facts.is_key(parts):
                yield f"{word}: no such scene key"

    def check_settings(self, words):
        for option, value in zip(words, words[1:]):
            key = value.split("=")[0]
            if option == "--set" and "=" in value and not PLACEHOLDER.match(key) and not self.facts.is_key(key.split(".")):
                yield f"--set {key}: no such scene key"

    def check_commands(self, line):
        for command in re.split(r"&&|;|\|(?!\w)", line):
            try:
                words = shlex.split(command)
            except ValueError:
                words = command.split()
            for k, word in enumerate(words):
                name, rest = os.path.basename(word), words[k + 1:]
                if name == "ctest" or (name == "acinus.sh" and rest[:1] == ["test"]):
                    yield from self.check_ctest(rest)
                elif name == "cmake":
                    yield from (f"preset {p}: not in CMakePresets.json" for o, p in zip(rest, rest[1:])
                                if o == "--preset" and p not in self.facts.presets)
                elif name == "acinus-bench" and self.facts.benches:
                    yield from self.check_arguments("bench", rest)
                elif name == "acinus" and words[:k][-1:] == ["-m"]:
                    yield from (f"python3 -m acinus {w}: no such command" for w in rest[:1] if w not in self.facts.module)
                elif name in ("acinus", "acinus.sh") and self.facts.program:
                    yield from self.check_acinus(rest, name == "acinus.sh")
                else:
                    continue
                break

    def check_ctest(self, words):
        for option, value in zip(words, words[1:]):
            for options, kind in ((("-L", "-LE"), "label"), (("-R",), "test")):
                if option in options and kind in self.facts.kinds and not any(re.search(value, name) for name in self.facts.kinds[kind]):
                    yield f"ctest {option} {value}: no such {kind}"

    def check_acinus(self, words, is_script):
        if not words or PLACEHOLDER.match(words[0]) or words[0] in ("--help", "--version"):
            return
        for n in (2, 1):
            if " ".join(words[:n]) in self.facts.commands:
                yield from self.check_arguments(" ".join(words[:n]), words[n:])
                return
        if words[0] != "bench" and not (is_script and words[0] in self.facts.starter):
            yield f"acinus {words[0]}: no such command"

    def check_arguments(self, command, words):
        facts, options, positional, value_of = self.facts, self.facts.commands[command], [], ""
        for word in words:
            name = word.split("=")[0]
            if value_of:
                if value_of == "--scene":
                    yield from self.check_shipped(word, "scene")
                value_of = ""
            elif word.startswith("--"):
                if name not in options:
                    yield f"acinus {command} {name}: no such option"
                value_of = name if options.get(name) and "=" not in word else ""
            else:
                positional.append(word)
        yield from self.check_settings(words)
        if not positional or PLACEHOLDER.match(positional[0]):
            return
        if command == "bench" and positional[0] not in facts.benches:
            yield f"acinus bench {positional[0]}: no such benchmark"
        makes_scene = command == "new" and "--from-physicell-rules" in words  # then the word is a folder
        if command in ("run", "check", "new", "calibrate", "study") and not makes_scene:
            yield from self.check_shipped(positional[0], "study" if command == "study" else "scene")
        if command == "explain" and positional[0] not in ("study", "inference") and not facts.is_key(positional[0].split(".")):
            yield f"acinus explain {positional[0]}: no such key"

    def check_shipped(self, name, kind):
        if re.fullmatch(r"\w+", name) and not PLACEHOLDER.match(name) and name not in self.facts.kinds[kind]:
            yield f"{name}: no such {kind} ships"

    def check_examples(self):
        """Blocks of code that are scenes, studies or inferences."""
        block, start = [], 0
        for number, line, code in list(split_page(self.text)) + [(0, "", False)]:
            if code:
                start = start if block else number
                block.append(line)
                continue
            try:
                value = json.loads(JSON_TOKEN.sub(lambda m: m.group(1) or "", "\n".join(block)))
            except ValueError:
                value = None
            block = []
            if isinstance(value, dict) and {"scene", "cells", "cell_types", "extends"} & set(value):
                for key in walk_example(value):
                    fits = {k[len(key) - 1] for k in self.facts.keys
                            if len(k) >= len(key) and all(a in (b, "*") for a, b in zip(k, key[:-1]))}
                    if fits and not {key[-1], "*"} & fits:
                        yield start, f"example /{'/'.join(key)}: no such key"


def check_tree(facts):
    return [f"{path}:{line}: {message}" for path in facts.pages for line, message in Page(facts, path).check()]


WRONG = [  # lines, with a part of what is to be said about each
    ("[a](docs/b.md)", "no such file"),
    ("[a](README.md#no-words)", "no such heading"),
    ("`core/lost.hpp`", "no such file"),
    ("`no" "where.hpp`", "no source writes one"),  # in two pieces: this source must not write one
    ("the scene `nowhere`", "no such scene"),
    ("the test `nowhere_test`", "no such test"),
    ("`acinus walk`", "no such command"),
    ("`acinus run two_cells --loud`", "no such option"),
    ("`acinus run two_cells --set time.ned=1`", "no such scene key"),
    ("`time.ned`", "no such scene key"),
    ("`ctest -L nowhere`", "no such label"),
    ('\n    { "time": { "ned": "1 h" }, "cells": {} }\n', "/time/ned: no such key"),
]


def test_rules(facts):
    """A page that breaks rules one a line must be told so; returns what went wrong."""
    lines = [w for w in WRONG if facts.program or "acinus" not in w[0] and "time" not in w[0] and "test" not in w[0]]
    found = [message for _, message in Page(facts, "planted.md", "\n".join(line for line, _ in lines)).check()]
    return [f"self-test: not found: {line.strip()}" for line, said in lines if not any(said in f for f in found)]


def main():
    if not 2 <= len(sys.argv) <= 5 or not os.path.isdir(sys.argv[1]):
        sys.exit(__doc__)
    facts = Facts(*sys.argv[1:])
    findings = test_rules(facts) + check_tree(facts)
    print("\n".join(findings + [f"{len(facts.pages)} pages read, {len(findings)} findings"]))
    # A wrong folder must not pass for a clean one.
    if findings or not facts.pages:
        sys.exit(1)


main()
