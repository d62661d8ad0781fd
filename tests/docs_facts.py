"""What a page may name: files, scenes, tests and labels of the tree; commands, options and keys of the program."""

import fnmatch
import json
import os
import re
import subprocess

PAST = ("CHANGELOG.md",)
SKIPPED = re.compile(r"^(build[^/]*|out|(.*/)?node_modules|\.git|(.*/)?__pycache__|(.*/)?[^/]*\.(run|study))$")
SOURCE_ENDINGS = (".hpp", ".cpp", ".py")
ENDINGS = "hpp|cpp|py|md|json|sh|txt|cmake|svg|png|vtk|vtkhdf|xmf|h5|csv|log|journal|lock|bib|slurm"
FILE_NAME = re.compile(rf"[\w.-]+\.({ENDINGS})")
LITERAL = re.compile(r'"((?:\\.|[^"\\\n])*)"')


def read(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read()


class Facts:
    """What there is to name."""

    def __init__(self, root, program="", bench=""):
        self.root, self.files, self.folders = root, set(), set()
        for folder, folders, names in os.walk(root):
            place = os.path.relpath(folder, root).replace(os.sep, "/")
            place = "" if place == "." else place + "/"
            folders[:] = [name for name in folders if not SKIPPED.match(place + name)]
            self.files |= {place + name for name in names}
            self.folders |= {place + name for name in folders}
        self.names = {os.path.basename(path) for path in self.files}
        self.pages = sorted(path for path in self.files if path.endswith(".md") and path not in PAST)
        top = "|".join(re.escape(f) for f in sorted(self.folders) if "/" not in f)
        self.top_path = re.compile(rf"(?<![\w./<>~*-])(?:{top})/[\w./*<>{{}}$-]*" if top else r"(?!)")
        sources = [read(os.path.join(root, p)) for p in sorted(self.files) if p.endswith(SOURCE_ENDINGS)]
        self.literals = "\n".join("\n".join(LITERAL.findall(text)) for text in sources)
        code = sources + [read(os.path.join(root, p)) for p in sorted(self.files) if p.endswith((".txt", ".json"))]
        self.words = {word for text in code for word in re.findall(r"\w+", text)}
        session = [p for p in self.files if p.startswith("runs/session/") and p.endswith(".cpp")]
        self.summary = {word for p in session for word in LITERAL.findall(read(os.path.join(root, p)))}
        self.scenes, self.studies = self.stems("runs/scenes"), self.stems("runs/studies")
        self.find_tests()
        scripts = [p for p in self.files if p.endswith((".py", ".sh"))]
        self.script_options = {o for p in scripts for o in re.findall(r"--[a-z][a-z-]+", read(os.path.join(root, p)))}
        presets = os.path.join(root, "CMakePresets.json")
        self.presets = set()
        if os.path.exists(presets):
            self.presets = {p["name"] for p in json.loads(read(presets))["configurePresets"]}
        starter = read(os.path.join(root, "acinus.sh")) if "acinus.sh" in self.files else ""
        self.starter = set(re.findall(r"^  (\w+)\)", starter, re.M))
        self.program, self.commands, self.keys = program, {}, set()
        if program:
            self.ask(program)
        self.bench_options = options_of(call(bench, "--help")) if bench else {}
        self.benches = set(call(program, "bench").split()) if program and bench else set()

    def stems(self, folder):
        return {os.path.basename(p)[:-5] for p in self.files if re.fullmatch(re.escape(folder) + r"/\w+\.json", p)}

    def find_tests(self):
        """Names and labels of ctest, as the build files list them."""
        self.tests, self.labels = set(), set()
        for path in sorted(self.files):
            if not path.startswith("tests/") or not path.endswith("CMakeLists.txt"):
                continue
            text = read(os.path.join(self.root, path))
            for variable, values in re.findall(r"foreach\((\w+)\s+([^)]*)\)", text):
                use = "${" + variable + "}"
                text += "".join("\n" + text.replace(use, value) for value in values.split()) if use in text else ""
            names = re.findall(r"(?:acinus_test\(|add_test\(NAME\s+)([\w$]+)", text)
            self.tests |= {name for name in names if "$" not in name}
            for labels in re.findall(r'LABELS\s+"?([\w;]+)', text):
                self.labels |= set(labels.split(";"))

    def ask(self, program):
        """Commands, options and keys from the program itself."""
        self.ask_commands(program)
        self.schema = {kind: json.loads(call(program, "schema", *more)) for kind, more in
                       (("scene", ()), ("study", ("--study",)))}
        short = [line.split()[0] for more in ((), ("study",)) for line in call(program, "explain", *more).splitlines()]
        self.full_keys = set(walk_schema(self.schema["scene"], ()))
        for path in [name.split(".") for name in short] + [[w for w in key if w != "*"] for key in self.full_keys]:
            self.keys |= {".".join(path[k:]) for k in range(len(path))}
        self.blocks = {w for key in self.keys for w in key.split(".")[:-1]}

    def ask_commands(self, program, *above):
        """Names are those of all words: "run", "mesh", "mesh vessels"."""
        text = call(program, *above, "--help")
        if above:
            self.commands[" ".join(above)] = options_of(text)
        for name in re.findall(r"^  (\w+)  ", text.partition("Subcommands:")[2], re.M):
            if name == "bench":
                self.commands[name] = {}
            else:
                self.ask_commands(program, *above, name)

    def is_written(self, name):
        """Whether a source names this file, as a whole or as another file's name with an ending."""
        parts = [(name[:k], name[k:]) for k in range(1, len(name)) if name[k] == "."]
        return name in self.literals or any(
            FILE_NAME.fullmatch(a) and a in self.literals and b in self.literals for a, b in parts)

    def has_path(self, path):
        path = path.rstrip("/.")
        if "*" in path:
            return any(fnmatch.fnmatch(known, path) for known in self.files | self.folders)
        return (path in self.files or path in self.folders or
                any(path + ending in self.files for ending in SOURCE_ENDINGS))

    def is_key(self, word):
        """Whether a dotted word names a scene key: short, in full with names or numbers in it, or its end."""
        if word in self.keys:
            return True
        parts = ["*" if re.fullmatch(r"<\w+>|\*|[0-9]+", part) else part for part in word.split(".")]
        return any(len(key) >= len(parts) and all(k in (p, "*") for k, p in zip(key, parts)) for key in self.full_keys)


def call(*words):
    return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True).stdout


def options_of(text):
    """Option -> whether a value follows it."""
    found = re.findall(r"^\s+(?:-\w,)?(--[\w-]+)(?:\{\w+\})?(?: (\S+))?", text, re.M)
    return {option: bool(value) and value not in ("Excludes:", "Needs:") for option, value in found}


def walk_schema(node, path):
    """The paths of all keys; "*" stands for a name or a number."""
    for choice in node.get("anyOf", ()):
        yield from walk_schema(choice, path)
    for name, inner in node.get("properties", {}).items():
        if name != "$schema":
            yield path + (name,)
        yield from walk_schema(inner, path + (name,))
    inner = node.get("items", node.get("additionalProperties"))
    if isinstance(inner, dict):
        yield from walk_schema(inner, path + ("*",))
