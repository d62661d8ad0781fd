"""Fails on an include or a definition that breaks the floor table, and on files that outgrew their limits.

usage: layers_test.py ROOT

The rules are first tried on a temporary tree that breaks each of them once; then ROOT is checked.
Prints file:line and the rule broken; exit code 1 if there is any.
"""

import os
import re
import sys
import tempfile

# A folder includes only folders on floors below its own, and itself.
FLOORS = {"cli": 9, "bench": 9, "python": 9, "service": 8, "runs": 7, "calibration": 6, "coupling": 5, "dcm": 4, "cbm": 4, "contact": 3,
          "imaging": 3, "solve": 2, "io": 2, "substances": 2, "geometry": 1, "core": 0}
# The rooms of a folder, lowest first; "" are the files directly in it. A room includes only those before it.
ROOMS = {
    "core": ("", "numbers", "parallel", "units"),
    "geometry": ("", "readers", "implicit"),
    "dcm": ("", "terms", "contact", "shape", "loads"),
    "coupling": ("generate", "vessels", "apparatus", "interface", "world", "substances", "migration", "step", "measure", "subworld", "sleep", "zoom", "life", ""),
    "runs": ("scene", "assemble", "experiments", "images", "physicell", "session", "calibrate", "compare", "study", "infer", "openvt", ""),
    "service": ("page", "report", "serve"),
    "bench": ("output", "step", "tissue", "stress", "work_precision", "kernels", ""),
}
MIRRORS = ("tests",)  # may include every floor; no floor includes them
JSON_FOLDERS = ("bench", "cli", "service", "runs", "calibration") + MIRRORS
JSON_FILES = ("imaging/json_statements.cpp", "imaging/zarr_json.cpp")  # other programs describe their images so
JSON_NAMES = ("imaging/zarr_json.hpp",)  # forward declarations only
MAX_LINES = 400
MAX_TEST_LINES = 500
MAX_README_LINES = 40
SOURCES = (".hpp", ".cpp")
COUNTED = SOURCES + (".py", ".sh", ".cmake", "CMakeLists.txt")
# The two models and the hybrid world name what plays the same part in each alike: dcm::State, cbm::State, coupling::State.
MODELS = ("dcm", "cbm", "coupling")
TYPE = re.compile(r"^\s*(?:struct|class|enum class)\s+(?:alignas\(\w+\)\s+)?(\w+)\b(?:\s+final)?\s*(?::[^:].*)?(?:\{.*)?$")
DECLARED = re.compile(r"^\s*(?:struct|class|enum class)\s+(\w+)\s*;")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
FUNCTION = re.compile(r"^(?!(?:using|namespace|struct|class|enum|typedef|inline|static|constexpr|return)\b)[A-Za-z_][\w:<>,&*\s]*[\s&*](\w+)\(")
SKIPPED = re.compile(r"^(out|\.git|__pycache__|node_modules|.*\.run)$")
BUILD = re.compile(r"^build")  # at the top only: rooms may be named so


def check_include(path, bracket, target, beside):
    """The rule that this include of the file `path` breaks, or None.

    beside: whether `target` names a file in the folder of `path` (the compiler would take it).
    """
    folder = path.split("/")[0]
    top = target.split("/")[0]
    names_only = target == "nlohmann/json_fwd.hpp"
    if top == "nlohmann" and path not in JSON_FILES and not (path in JSON_NAMES and names_only) and folder not in MIRRORS and (folder not in JSON_FOLDERS or not (path.endswith(".cpp") or names_only)):
        return "nlohmann-json belongs in .cpp files of calibration/ and the floors above it only"
    if top in (".", "..") or (bracket == '"' and beside and top not in FLOORS):
        return "include paths start at the root of the repository"
    if top in MIRRORS and folder in FLOORS:
        return f"{folder}/ must not include {top}/"
    if folder in ROOMS and top == folder:
        return check_rooms(folder, path, target)
    if folder not in FLOORS or top not in FLOORS or top == folder:
        return None
    if FLOORS[top] == FLOORS[folder]:
        return f"{folder}/ and {top}/ stand on the same floor and must not know each other"
    if FLOORS[top] > FLOORS[folder]:
        return f"{folder}/ (floor {FLOORS[folder]}) must not climb to {top}/ (floor {FLOORS[top]})"
    return None


def room_of(path):
    """"life" of coupling/life/x.hpp, "" of coupling/x.hpp."""
    parts = path.split("/")
    return parts[1] if len(parts) > 2 else ""


def check_rooms(folder, path, target):
    """The rule that an include within a folder with rooms breaks, or None."""
    own, other = room_of(path), room_of(target)
    for room in (own, other):
        if room not in ROOMS[folder]:
            return f"{folder}/{room}/ is no room of {folder}/: add it to ROOMS in this test, where it belongs"
    if ROOMS[folder].index(other) > ROOMS[folder].index(own):
        return f"{folder}/{own}/ must not climb to {folder}/{other}"
    return None


def find_rings(edges):
    """Units that need each other in a ring, however long, as sorted lists. edges: unit -> set of units.

    Tarjan's strongly connected components.
    """
    number, lowest, stack, rings = {}, {}, [], []

    def visit(unit):
        number[unit] = lowest[unit] = len(number)
        stack.append(unit)
        for other in sorted(edges.get(unit, ())):
            if other not in number:
                visit(other)
                lowest[unit] = min(lowest[unit], lowest[other])
            elif other in stack:
                lowest[unit] = min(lowest[unit], number[other])
        if lowest[unit] == number[unit]:
            ring = stack[stack.index(unit):]
            del stack[stack.index(unit):]
            if len(ring) > 1:
                rings.append(sorted(ring))

    for unit in sorted(edges):
        if unit not in number:
            visit(unit)
    return rings


def unit_of(path):
    """A unit is a header with its source."""
    return path.rsplit(".", 1)[0]


def list_edges(includes, declared, types):
    """Units that a unit includes, or defines a type of that it declares. unit -> set of units.

    includes: path -> paths; declared: path -> names of types declared without being defined; types: (path, line, name).
    """
    defined, edges = {}, {}
    for path, _, name in types:
        defined.setdefault(name, set()).add(path)
    for path in includes:
        own, others = unit_of(path), set(includes[path])
        for name in declared[path]:
            others |= {other for other in defined.get(name, ())
                       if len(defined[name]) == 1 or other.split("/")[0] == path.split("/")[0]}
        edges.setdefault(own, set()).update({unit_of(other) for other in others} - {own})
    return edges


def list_includes(root, path):
    """What a source includes from the tree, as paths from its root."""
    with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
        found = (INCLUDE.match(line) for line in file)
        return {match.group(2) for match in found if match and match.group(2).split("/")[0] in FLOORS}


def list_declared(root, path):
    """Names of types that a source declares without defining them there."""
    with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
        found = (DECLARED.match(line) for line in file)
        return {match.group(1) for match in found if match}


def list_types(root, path):
    """(line, name) of the types a source defines."""
    with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
        for number, line in enumerate(file, 1):
            found = TYPE.match(line.split("//")[0].rstrip())
            if found:
                yield number, found.group(1)


def list_functions(root, path):
    """(line, name) of the functions that a header declares, or that a source defines for others."""
    hidden = False
    with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
        for number, line in enumerate(file, 1):
            line = line.rstrip()
            if line == "namespace {" or line == "}  // namespace":
                hidden = line == "namespace {"
            found = FUNCTION.match(line)
            if found and not hidden and (path.endswith(".hpp") or not line.endswith(";")):
                yield number, found.group(1)


def find_climbing_calls(root, includes):
    """Functions that a header declares and that only units above it define: calls that climb when linked."""
    definers = {}
    for path in includes:
        if path.endswith(".cpp"):
            for _, name in list_functions(root, path):
                definers.setdefault(name, set()).add(path)
    for path in sorted(includes):
        if not path.endswith(".hpp"):
            continue
        for line, name in list_functions(root, path):
            known = {source for source in definers.get(name, ()) if path in includes[source] | includes.get(unit_of(source) + ".hpp", set())}
            if known and all(stands_above(source, path) for source in known):
                yield f"{path}:{line}: {name} is defined above, in {', '.join(sorted(known))}"


def stands_above(path, other):
    """True if a file stands on a higher floor than another, or in a higher room of the same one."""
    folder, below = path.split("/")[0], other.split("/")[0]
    if folder != below:
        return FLOORS[folder] > FLOORS[below]
    rooms = ROOMS.get(folder, ())
    return room_of(path) in rooms and room_of(other) in rooms and rooms.index(room_of(path)) > rooms.index(room_of(other))


def find_namesakes(types):
    """Types that have the name of one before. types: (path, line, name) in the order of paths."""
    first, models = {}, {}
    for path, line, name in types:
        folder = path.split("/")[0]
        if folder in MODELS and folder not in models.setdefault(name, set()):
            models[name].add(folder)
            if name not in first or first[name].split("/")[0] in MODELS:
                first.setdefault(name, f"{path}:{line}")
                continue
        if name in first:
            yield f"{path}:{line}: {name} is the name of a type in {first[name]}, too"
        first.setdefault(name, f"{path}:{line}")


def check_file(root, path):
    """All findings of one file as (line, message)."""
    with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
        lines = file.read().splitlines()
    if path.endswith("/README.md") and not path.startswith("docs/"):
        if len(lines) > MAX_README_LINES:
            message = f"{len(lines)} lines: a folder's README has at most {MAX_README_LINES}"
            yield MAX_README_LINES + 1, message
    most = MAX_TEST_LINES if path.split("/")[0] in MIRRORS + ("docs",) else MAX_LINES
    if path.endswith(COUNTED) and len(lines) > most:
        yield most + 1, f"{len(lines)} lines: split a file above {most}"
    if path.endswith(SOURCES):
        for number, line in enumerate(lines, 1):
            found = INCLUDE.match(line)
            if found:
                bracket, target = found.groups()
                neighbour = os.path.join(root, os.path.dirname(path), target)
                broken = check_include(path, bracket, target, os.path.isfile(neighbour))
                if broken:
                    yield number, f'includes "{target}": {broken}'


def check_tree(root):
    """All findings below root as "path:line: message", and the number of sources read."""
    findings, n_source, includes, declared, types = [], 0, {}, {}, []
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(name for name in folders
                            if not SKIPPED.match(name) and not (folder == root and BUILD.match(name)))
        for name in sorted(names):
            path = os.path.relpath(os.path.join(folder, name), root).replace(os.sep, "/")
            if path.endswith(COUNTED + (".md",)):
                n_source += path.endswith(SOURCES)
                findings += [f"{path}:{line}: {text}" for line, text in check_file(root, path)]
            if path.endswith(SOURCES) and path.split("/")[0] in FLOORS:
                includes[path] = list_includes(root, path)
                declared[path] = list_declared(root, path)
            if path.endswith(SOURCES) and path.split("/")[0] in FLOORS:
                types += [(path, line, name) for line, name in list_types(root, path)]
    for ring in find_rings(list_edges(includes, declared, types)):
        first = ring[0] + (".hpp" if ring[0] + ".hpp" in includes else ".cpp")
        findings.append(f"{first}:1: units need each other: {', '.join(ring)}")
    findings += find_namesakes(types)
    findings += find_climbing_calls(root, includes)
    return findings, n_source


def test_rules():
    """Each violation must be found at its line, and nothing else; returns what went wrong."""
    allowed = {
        "geometry/a.hpp": '#include "core/vec.hpp"\n#include <Eigen/Core>\n',
        "dcm/a.cpp": '#include "dcm/a.hpp"\n#include "core/vec.hpp"\n// #include "cbm/a.hpp"\n',
        "cbm/a.cpp": '#include "cbm/a.hpp"\n#include "core/vec.hpp"\n',
        "coupling/a.cpp": '#include "dcm/a.hpp"\n#include "cbm/a.hpp"\n#include "coupling/life/a.hpp"\n',
        "coupling/life/a.hpp": '#include "coupling/world/a.hpp"\n#include "coupling/life/b.hpp"\n',
        "cli/a.cpp": '#include "runs/scene/a.hpp"\n#include "service/serve/a.hpp"\n',
        "runs/version.cpp": '#include "acinus_version.hpp"\n',
        "calibration/a.cpp": '#include "coupling/a.hpp"\n#include <nlohmann/json.hpp>\n',
        "runs/a.cpp": '#include "calibration/a.hpp"\n  #  include <nlohmann/json.hpp>\n',
        "tests/a.cpp": '#include "runs/a.hpp"\n#include "tests/support.hpp"\n',
        "bench/a.cpp": '#include "dcm/a.hpp"\n#include "cbm/a.hpp"\n',
        "core/ring_b.hpp": '#include "core/ring_c.hpp"\n',
        "core/ring_c.cpp": '#include "core/ring_a.hpp"\n',
        "solve/forward_b.hpp": '#include "solve/forward_a.hpp"\nstruct Wide {\n};\n',
        "build/a.cpp": '#include "../runs/a.hpp"\n',
        "runs/assemble/a.hpp": '#include "runs/scene/a.hpp"\nstruct A;\nenum class B { kA };\n',
        "runs/session/it.cpp": '#include "runs/scene/it.hpp"\nnamespace {\nvoid own() {\n}\n}  // namespace\nvoid check_it(int x) {\n}\n',
        "runs/scene/it.cpp": '#include "runs/scene/it.hpp"\nbool own() {\n}\n',
        "dcm/state.hpp": "struct State {\n};\n",
        "cbm/state.hpp": "struct State {  // of spheres\n};\nclass Model : public Base {\n",
        "core/long.cpp": "\n" * MAX_LINES,
        "core/README.md": "\n" * MAX_README_LINES,
        "README.md": "\n" * (MAX_README_LINES + 60),
    }
    broken = {  # file: (content, line of the violation)
        "solve/b.hpp": ('#include "io/a.hpp"\n', 1),
        "service/b.hpp": ('#include "cli/a.hpp"\n', 1),
        "core/b.hpp": ('\n#include "dcm/a.hpp"\n', 2),
        "core/c.hpp": ('#include <vector>\n#  include <cbm/a.hpp>\n', 2),
        "dcm/b.cpp": ('#include "cbm/a.hpp"\n', 1),
        "cbm/b.cpp": ('#include "dcm/a.hpp"\n', 1),
        "dcm/c.cpp": ('#include "coupling/a.hpp"\n', 1),
        "coupling/b.cpp": ('#include "runs/a.hpp"\n', 1),
        "coupling/c.cpp": ('#include "calibration/a.hpp"\n', 1),
        "calibration/b.cpp": ('#include "runs/a.hpp"\n', 1),
        "core/d.cpp": ('#include "tests/support.hpp"\n', 1),
        "core/e.cpp": ('#include <nlohmann/json.hpp>\n', 1),
        "runs/b.hpp": ('#include <nlohmann/json.hpp>\n', 1),
        "geometry/f.cpp": ('#include "a.hpp"\n', 1),
        "runs/c.cpp": ('#include "../core/vec.hpp"\n', 1),
        "coupling/step/a.cpp": ('#include "coupling/life/a.hpp"\n', 1),
        "coupling/world/b.hpp": ('#include "coupling/simulation.hpp"\n', 1),
        "runs/scene/b.cpp": ('#include <a>\n#include "runs/session/a.hpp"\n', 2),
        "runs/cellar/a.cpp": ('#include "runs/scene/a.hpp"\n', 1),
        "core/ring_a.hpp": ('#include "core/ring_b.hpp"\n', 1),  # by way of a source
        "solve/forward_a.hpp": ("struct Wide;\n", 1),  # by way of a declaration
        "runs/scene/it.hpp": ("bool own();\nvoid check_it(\n    int x);\n", 2),  # by way of the linker
        "runs/d.cpp": ('#include "bench/a.hpp"\n', 1),
        "runs/study/e.cpp": ("struct A {};\nenum class B : char { kA };\n", 2),
        "dcm/store.hpp": ("\nclass State final {\n", 2),
        "dcm/long.cpp": ("\n" * (MAX_LINES + 1), MAX_LINES + 1),
        "dcm/README.md": ("\n" * (MAX_README_LINES + 1), MAX_README_LINES + 1),
    }
    with tempfile.TemporaryDirectory() as root:
        contents = {**allowed, **{path: content for path, (content, _) in broken.items()}}
        for path, content in contents.items():
            full = os.path.join(root, path)
            os.makedirs(os.path.dirname(full), exist_ok=True)
            with open(full, "w", encoding="utf-8") as file:
                file.write(content)
        findings, _ = check_tree(root)
    found = {":".join(finding.split(":")[:2]) for finding in findings}
    expected = {f"{path}:{line}" for path, (_, line) in broken.items()}
    wrong = [f"self-test: not found: {place}" for place in sorted(expected - found)]
    wrong += [f"self-test: found without cause: {place}" for place in sorted(found - expected)]
    return wrong, len(broken)


def main():
    if len(sys.argv) != 2 or not os.path.isdir(sys.argv[1]):
        sys.exit(__doc__)
    wrong, n_rule = test_rules()
    findings, n_source = check_tree(sys.argv[1])
    for finding in wrong + findings:
        print(finding)
    print(f"{n_rule} planted violations tried, {n_source} sources read, {len(findings)} findings")
    # A wrong folder must not pass for a clean one.
    if wrong or findings or n_source == 0:
        sys.exit(1)


main()
