"""Fails where the gallery leaves out a shipped scene, names one twice, or has pictures that no row shows.

usage: gallery_test.py ROOT
"""
import pathlib
import re
import sys


def findings(page, scenes, pictures):
    named, shown = re.findall(r"`([a-z][a-z0-9_]*)`", page), re.findall(r"\.\./images/gallery/(\w+)\.png", page)
    yield from (f"scene {name}: not in the gallery" for name in sorted(scenes - set(named)))
    yield from (f"scene {name}: {named.count(name)} times in the gallery" for name in sorted(scenes) if named.count(name) > 1)
    yield from (f"picture {name}: made, but not shown" for name in sorted(pictures - set(shown)))
    yield from (f"picture {name}: shown, but not made" for name in sorted(set(shown) - pictures))
    yield from (f"picture {name}: the row names no such scene" for name in shown if f"gallery/{name}.png) | `{name}`:" not in page)


def main():
    root = pathlib.Path(sys.argv[1])
    row = "| ![x](../images/gallery/a.png) | `a`: x |\n"
    for page, scenes, pictures, n in ((row, {"a"}, {"a"}, 0), (row, {"a", "b"}, {"a"}, 1), (row + "`a`", {"a"}, {"a"}, 1),
                                      (row, {"a"}, {"a", "b"}, 1), (row, {"a"}, set(), 1), (row.replace("`a`", "`b`"), {"b"}, {"a"}, 1)):
        assert len(list(findings(page, scenes, pictures))) == n, (page, scenes, pictures)
    scenes = {path.stem for path in (root / "runs/scenes").glob("*.json")}
    pictures = {path.stem for path in (root / "docs/images/gallery").glob("*.png")}
    found = list(findings((root / "docs/start/gallery.md").read_text(encoding="utf-8"), scenes, pictures))
    print("\n".join(found + [f"{len(scenes)} scenes, {len(pictures)} pictures, {len(found)} findings"]))
    return 1 if found or not scenes else 0


if __name__ == "__main__":
    sys.exit(main())
