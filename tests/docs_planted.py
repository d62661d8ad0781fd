"""A tree that breaks every rule of docs_test.py once, and pages in it that break none."""

FAKE_PROGRAM = r'''#!{python}
import sys
words = sys.argv[1:]
scene = {{"properties": {{"time": {{"properties": {{"end": {{}}}}, "additionalProperties": False}},
                         "walls": {{"items": {{"properties": {{"opens": {{}}}}}}}}, "cells": {{}}}},
         "additionalProperties": False}}
if words == ["bench"]:
    print("fast")
elif words[0] == "schema":
    import json
    print(json.dumps({{"properties": {{"scene": {{}}}}}} if "--study" in words else scene))
elif words[0] == "explain":
    print("study.sweep.key  none" if words[1:] == ["study"] else "time.end  1 h\nwall.opens  auto")
elif words == ["--help"]:
    print("Options:\n  --quiet  less\nSubcommands:\n  run    a scene\n  study  a study\n  mesh   surfaces\n  bench  measure")
elif words == ["mesh", "--help"]:
    print("Options:\n  -h,--help  help\nSubcommands:\n  wrap   a mesh")
else:
    print("Options:\n  -h,--help  help\n  --out DIR  folder\n  --set PATH=VALUE  change\n  --quiet    less")
'''

RIGHT = r"""# Top

[a](docs/a.md) [b](docs/a.md#some-words-twice-1) [c](#top) [d](https://x.y/z.md)

See `core/x.hpp`, core/x, `docs/*.md`, `core/`, `x.hpp`, `out.csv`, `plots/` and `runs/<name>/y.json`.
The scene `clump`, the study `grow`, the test `golden_b`, label `slow`, `--quiet`, key `end`, `cells.dead`.
`time.end`, `wall.opens`, `walls.opens`, `walls.0.opens`, `time.*`, `time.end=3 h`, `h5py.File`, `.end`.
`acinus run clump --set time.end=1 --out x.run`, `acinus bench fast`, `acinus mesh wrap x.stl --out y.stl`, `ctest -L slow`, `cmake --preset dev`.

    ./acinus.sh run clump --quiet && ./acinus.sh test -R golden_a  # --no-such is said here
    tool --foreign x | acinus study grow \
      --out y

So `--foreign` is known.

    { "time": { "end": "1 h" },  // no "ned"
      "cells": {} }
"""

WRONG = [  # one line each, with a part of what is to be said about it
    ("[a](docs/b.md)", "no such file"),
    ("[a](docs/a.md#no-words)", "no such heading"),
    ("[a](#no-top)", "no such heading"),
    ("`core/y.hpp`", "no such file"),
    ("see core/y for it", "no such file"),
    ("`docs/*.txt`", "no such file"),
    ("`y.hpp`", "no source writes one"),
    ("`gone/`", "no such folder"),
    ("`gone/y.cpp`", "no such file"),
    ("| gone/ | job |", "no such folder"),
    ("the scene `lump`", "no such scene"),
    ("the study `clump`", "no such study"),
    ("the test `golden_c`", "no such test"),
    ("label `fast`", "no such label"),
    ("the key `ned`", "no such key"),
    ("`GoneType`", "no source has"),
    ("`gone_function`", "no source has"),
    ("`--loud`", "no program has"),
    ("`time.ned`", "no such scene key"),
    ("`wall.shuts`", "no such scene key"),
    ("`walls.0.1.opens`", "no such scene key"),
    ("`acinus walk`", "no such command"),
    ("\n    python3 -m acinus walk\n", "no such command"),
    ("`acinus run lump`", "no such scene ships"),
    ("`acinus study clump`", "no such study ships"),
    ("`acinus run clump --loud`", "no such option"),
    ("`acinus mesh wrap x.stl --loud`", "no such option"),
    ("`acinus mesh --out y.stl`", "no such option"),
    ("`acinus run clump --set time.ned=1`", "no such scene key"),
    ("`acinus bench slow`", "no such benchmark"),
    ("`ctest -L fast`", "no test has"),
    ("`ctest -R golden_c`", "no such test"),
    ("`cmake --preset fast`", "preset fast"),
    ('\n    { "time": { "ned": "1 h" }, "cells": {} }\n', "/time/ned: no such key"),
    ("\n    tool x \\\n      | acinus walk\n", "no such command"),
]

TREE = {
    "core/x.hpp": 'const char* name = "out.csv"; auto folder = root + "/plots";\n',
    "docs/a.md": "# Some words\n\n## Some words twice\n\n## Some words twice\n",
    "runs/scenes/clump.json": "{}",
    "runs/studies/grow.json": "{}",
    "runs/session/summary.cpp": 'j["cells"] = {"dead", 1};\n',
    "CMakePresets.json": '{"configurePresets": [{"name": "dev"}]}',
    "tests/CMakeLists.txt": "foreach(case a b)\n  add_test(NAME golden_${case} COMMAND x)\nendforeach()\n"
                            "set_tests_properties(golden_a PROPERTIES LABELS slow)\n",
    "acinus.sh": "case $1 in\n  test) ;;\nesac\n",
    "CHANGELOG.md": "`core/gone.hpp`\n",
    "build/gone.md": "`core/gone.hpp`\n",
    "right.md": RIGHT,
    "docs/howto/right.md": "# Top\n\n`name`, `folder`, `add_test`\n",
}
