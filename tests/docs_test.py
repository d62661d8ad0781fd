"""Fails where a Markdown page names something that does not exist.

usage: docs_test.py ROOT [ACINUS [ACINUS_BENCH]]

Looked up: links and their anchors, files and folders, names of code on pages about it, shipped scenes and studies, ctest
names and labels, presets of CMake and, with the programs, commands, their options, benchmarks and scene keys. CHANGELOG.md
tells the past and may name what is gone. The rules are first tried on a temporary tree that breaks each of them once
(docs_planted.py); then ROOT is looked at. Prints file:line and what is wrong; exit code 1 if anything is.
"""

import json
import os
import re
import shlex
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is written into the source tree
from docs_facts import FILE_NAME, SKIPPED, SOURCE_ENDINGS, Facts, read
from docs_planted import FAKE_PROGRAM, TREE, WRONG

FOLDER = re.compile(r"(?:[\w.-]+/)+")
SPAN = re.compile(r"(`+)(.+?)\1")
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
PLACEHOLDER = re.compile(r"[A-Z][A-Z_.=]*$|.*[<>{}$]")
OURS = re.compile(r"(?:^|\s)(?:\S*/)?acinus(?:\.sh|-bench)?(?:\s|$)")
IDENTIFIER = re.compile(r"[A-Z][a-z]\w*|[a-z]\w*_\w*[a-z]|k[A-Z]\w+")
ABOUT_CODE = re.compile(r".+/README\.md|docs/howto/.*|docs/architecture\.md")
DOTTED = re.compile(r"\.?[a-z_]+(?:\.(?:[a-z_]+|<\w+>|\*|[0-9]+))+|\.[a-z_]+")
JSON_TOKEN = re.compile(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', re.S)


def check_example(value, schemas, path):
    """Keys of a JSON example that its schema does not have."""
    schemas = [inner for schema in schemas for inner in [schema] + schema.get("anyOf", [])]
    if isinstance(value, list):
        for item in value:
            yield from check_example(item, [s["items"] for s in schemas if isinstance(s.get("items"), dict)], path)
    if not isinstance(value, dict):
        return
    for name, inner in value.items():
        below = [s["properties"][name] for s in schemas if name in s.get("properties", {})]
        below += [s["additionalProperties"] for s in schemas if isinstance(s.get("additionalProperties"), dict)]
        if not below and any(s.get("additionalProperties") is False for s in schemas):
            yield f"/{'/'.join(path + (name,))}: no such key"
        yield from check_example(inner, below, path + (name,))


def slug(heading):
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def split_page(text):
    """(line number, text, is code) of every line; lines that end in a backslash are joined in code."""
    fenced, was_code, before = False, False, ""
    pending = None
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
    seen, anchors = {}, set()
    for _, line, code in split_page(text):
        if not code and re.match(r"#{1,6} ", line):
            name = slug(line.lstrip("#"))
            anchors.add(name if name not in seen else f"{name}-{seen[name]}")
            seen[name] = seen.get(name, 0) + 1
    return anchors


class Page:
    """One page; findings are (line, message)."""

    def __init__(self, facts, path):
        self.facts, self.path, self.text = facts, path, read(os.path.join(facts.root, path))
        self.folder = os.path.dirname(path)
        # Options of other programs are those that the page's own commands give them.
        foreign = [OURS.split(line)[0] for _, line, code in split_page(self.text) if code]
        self.foreign_options = set(re.findall(r"--[a-z][a-z-]+", "\n".join(foreign)))

    def near(self, path):
        return os.path.normpath(os.path.join(self.folder, path)).replace(os.sep, "/")

    def check(self):
        last_key = ""
        for number, line, code in split_page(self.text):
            found = list(self.check_paths(line))
            if code:
                found += self.check_commands(line.split(" #")[0])
            else:
                found += list(self.check_links(line)) + list(self.check_prose(line))
                last_key = ""
                for _, span in SPAN.findall(line):
                    found += list(self.check_span(span, last_key))
                    if self.facts.program and DOTTED.fullmatch(span) and not span.startswith("."):
                        last_key = span
            yield from ((number, message) for message in found)
        if self.facts.program:
            yield from self.check_examples()

    def check_links(self, line):
        for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
            if re.match(r"[a-z]+:", target):
                continue
            file, _, anchor = target.partition("#")
            path = self.near(file) if file else self.path
            if path not in self.facts.files and path not in self.facts.folders:
                yield f"link to {target}: no such file"
            elif anchor and anchor not in anchors_of(read(os.path.join(self.facts.root, path))):
                yield f"link to {target}: no such heading there"

    def check_paths(self, line):
        for path in self.facts.top_path.findall(re.sub(r"\]\([^)]*\)", "]", line)):
            if not re.search(r"[<>{}$]", path) and not self.facts.has_path(path):
                if not self.facts.has_path(self.near(path)):
                    yield f"{path}: no such file"

    def check_prose(self, line):
        facts = self.facts
        if line.startswith("|"):  # tables of folders
            for folder in re.findall(r"(?:^\| ?|, )([a-z_]+/)(?=,| ?\|)", line):
                yield from self.check_folder(folder)
        for kind, known in (("scene", facts.scenes), ("study", facts.studies), ("test", facts.tests),
                            ("label", facts.labels), ("key", facts.keys | facts.summary if facts.keys else ())):
            for word in re.findall(rf"\b{kind}s? `([a-z][a-z0-9_]*)`", line):
                if word not in known and known:
                    yield f"{word}: no such {kind}"

    def check_folder(self, folder):
        known = self.facts.has_path(self.near(folder)) or self.facts.has_path(folder)
        if not known and not SKIPPED.match(folder.split("/")[0]) and folder.rstrip("/") not in self.facts.literals:
            yield f"{folder}: no such folder"

    def check_span(self, span, last_key):
        facts, word = self.facts, re.split(r"[ =:]", span)[0]
        if FILE_NAME.fullmatch(span) and span not in facts.names and not facts.is_written(span):
            yield f"{span}: no such file, and no source writes one"
        elif FOLDER.fullmatch(span) and not facts.top_path.match(span):
            yield from self.check_folder(span)
        elif "/" in span and span.endswith(SOURCE_ENDINGS) and not re.search(r"[<>*\s]", span):
            if not facts.has_path(span) and not facts.has_path(self.near(span)):
                yield f"{span}: no such file"
        elif span.startswith("--") and facts.benches:
            known = self.foreign_options.union(facts.script_options, facts.bench_options, *facts.commands.values())
            options = re.findall(r"(?:^| )(--[a-z-]+)", span)
            yield from (f"{o}: no program has this option" for o in options if o not in known)
            yield from self.check_settings(span.split())
        elif os.path.basename(word) in ("acinus", "acinus.sh", "acinus-bench", "ctest", "cmake"):
            yield from self.check_commands(span)
        elif IDENTIFIER.fullmatch(span) and ABOUT_CODE.fullmatch(self.path):
            if span not in facts.words and span not in facts.names:
                yield f"{span}: no source has this name"
        elif facts.program and DOTTED.fullmatch(word) and not FILE_NAME.fullmatch(word):
            yield from self.check_key(word, last_key)

    def check_key(self, word, last_key):
        facts = self.facts
        if word.startswith("."):
            word = last_key.rpartition(".")[0] + word
        if word.split(".")[0] not in facts.blocks or set(word.split(".")) <= facts.summary:
            return
        if not facts.is_key(word.removesuffix(".*")):
            yield f"{word}: no such scene key"

    def check_settings(self, words):
        for option, value in zip(words, words[1:]):
            key = value.split("=")[0]
            if option == "--set" and "=" in value and not PLACEHOLDER.match(key) and not self.facts.is_key(key):
                yield f"--set {key}: no such scene key"

    def check_commands(self, line):
        for command in re.split(r"&&|;|\|(?!\w)", line):
            try:
                words = shlex.split(command)
            except ValueError:
                words = command.split()
            for k, word in enumerate(words):
                name = os.path.basename(word)
                if name == "ctest" or (name == "acinus.sh" and words[k + 1:k + 2] == ["test"]):
                    yield from self.check_ctest(words[k + 1:])
                elif name == "cmake":
                    yield from (f"preset {p}: not in CMakePresets.json" for o, p in zip(words[k:], words[k + 1:])
                                if o == "--preset" and p not in self.facts.presets)
                elif name == "acinus-bench" and self.facts.bench_options:
                    yield from self.check_arguments("bench", words[k + 1:])
                elif name == "acinus" and words[:k][-1:] == ["-m"]:
                    yield from self.check_module(words[k + 1:])
                elif name in ("acinus", "acinus.sh") and self.facts.program:
                    yield from self.check_acinus(words[k + 1:], name == "acinus.sh")
                else:
                    continue
                break

    def check_ctest(self, words):
        for option, value in zip(words, words[1:]):
            if option in ("-L", "-LE") and not any(re.search(value, label) for label in self.facts.labels):
                yield f"ctest {option} {value}: no test has such a label"
            if option == "-R" and not any(re.search(value, name) for name in self.facts.tests):
                yield f"ctest -R {value}: no such test"

    def check_module(self, words):
        """python3 -m acinus"""
        file = os.path.join(self.facts.root, "python", "acinus", "__main__.py")
        known = re.findall(r'add_parser\("([a-z-]+)"', read(file)) if os.path.exists(file) else []
        if words and words[0] not in known:
            yield f"python3 -m acinus {words[0]}: no such command"

    def check_acinus(self, words, is_script):
        if not words or PLACEHOLDER.match(words[0]) or words[0] in ("--help", "--version"):
            return
        if " ".join(words[:2]) in self.facts.commands:
            yield from self.check_arguments(" ".join(words[:2]), words[2:])
        elif words[0] in self.facts.commands:
            yield from self.check_arguments(words[0], words[1:])
        elif not (is_script and words[0] in self.facts.starter):
            yield f"acinus {words[0]}: no such command"

    def check_arguments(self, command, words):
        facts = self.facts
        if command == "bench" and not facts.benches:
            return  # built without
        options = facts.bench_options if command == "bench" else facts.commands[command]
        positional, value_of = [], ""
        for word in words:
            if value_of:
                if value_of == "--scene":
                    yield from self.check_scene(word, facts.scenes, "scene")
                value_of = ""
            elif word.startswith("--"):
                name = word.split("=")[0]
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
        if command in ("run", "check", "new", "calibrate"):
            yield from self.check_scene(positional[0], facts.scenes, "scene")
        if command == "study":
            yield from self.check_scene(positional[0], facts.studies, "study")
        if command == "explain" and positional[0] != "study" and not facts.is_key(positional[0]):
            yield f"acinus explain {positional[0]}: no such key"

    def check_scene(self, name, known, kind):
        if re.fullmatch(r"\w+", name) and not PLACEHOLDER.match(name) and name not in known:
            yield f"{name}: no such {kind} ships"

    def check_examples(self):
        """Blocks of code that are scenes or studies."""
        block, start = [], 0
        for number, line, code in list(split_page(self.text)) + [(0, "", False)]:
            if code:
                start = start if block else number
                block.append(line)
                continue
            text = JSON_TOKEN.sub(lambda m: m.group(1) or "", "\n".join(block)).strip()
            block = []
            if not text.startswith("{"):
                continue
            try:
                value = json.loads(text)
            except ValueError:
                continue
            kind = "study" if "scene" in value else "scene" if {"cells", "cell_types", "extends"} & set(value) else ""
            if kind:
                yield from ((start, f"example {f}") for f in check_example(value, [self.facts.schema[kind]], ()))


def check_tree(facts):
    return [f"{path}:{line}: {message}" for path in facts.pages for line, message in Page(facts, path).check()]


def test_rules():
    """What is right must pass, each violation must be found; returns what went wrong."""
    place = {"no source has": "docs/howto/"}  # a page about code
    pages = [f"{place.get(said, '')}wrong_{k:02}.md" for k, (_, said) in enumerate(WRONG)]
    files = TREE | {page: f"# Top\n\n{line}\n" for page, (line, _) in zip(pages, WRONG)}
    with tempfile.TemporaryDirectory() as root:
        for path, content in files.items():
            os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                file.write(content)
        program = os.path.join(root, "program")
        with open(program, "w", encoding="utf-8") as file:
            file.write(FAKE_PROGRAM.format(python=sys.executable))
        os.chmod(program, 0o755)
        findings = check_tree(Facts(root, program, program))
    wrong = [f"self-test: found without cause: {f}" for f in findings if "wrong_" not in f]
    for page, (line, said) in zip(pages, WRONG):
        found = [f for f in findings if f.startswith(f"{page}:")]
        if not any(said in f for f in found):
            wrong.append(f"self-test: not found: {line.strip()}")
        wrong += [f"self-test: found besides: {f}" for f in found if said not in f]
    return wrong


def main():
    if not 2 <= len(sys.argv) <= 4 or not os.path.isdir(sys.argv[1]):
        sys.exit(__doc__)
    wrong = test_rules()
    facts = Facts(*sys.argv[1:])
    findings = check_tree(facts)
    for finding in wrong + findings:
        print(finding)
    print(f"{len(WRONG)} planted violations tried, {len(facts.pages)} pages read, {len(findings)} findings" +
          ("" if facts.program else "; no program given: commands, options and keys not looked at"))
    # A wrong folder must not pass for a clean one.
    if wrong or findings or not facts.pages:
        sys.exit(1)


if __name__ == "__main__":
    main()
