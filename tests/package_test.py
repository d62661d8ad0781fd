"""The Debian package holds what a user needs and runs without the sources.

usage: package_test.py BUILD; exit code 77 where cpack or dpkg-dev are not installed

Makes the package of a finished build in a folder of its own, unpacks it at another place than /usr, and runs the program and the Python reader from
there. Where mounting is allowed, the folder of the sources is hidden meanwhile.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
NEEDED = ["usr/bin/acinus", "usr/share/acinus/scenes/lobule_hybrid.json", "usr/share/acinus/laws/hepatocyte_5e-6.json", "usr/share/doc/acinus/copyright", "usr/share/man/man1/acinus.1.gz",
          "usr/share/doc/acinus/examples/tutorial/clump.json", "usr/lib/python3/dist-packages/acinus/run.py",
          "usr/lib/cmake/acinus/acinus-config.cmake", "usr/include/acinus/coupling/simulation.hpp"]

# Debian packages of what acinus-config.cmake looks for.
DEVELOPMENT = {"Eigen3": "libeigen3-dev", "MPI": "libopenmpi-dev", "fmt": "libfmt-dev", "nlohmann_json": "nlohmann-json3-dev", "ZLIB": "zlib1g-dev",
               "pugixml": "libpugixml-dev", "PkgConfig": "pkgconf", "HDF5": "libhdf5-dev", "BLOSC": "libblosc-dev", "ZSTD": "libzstd-dev",
               "TIFF": "libtiff-dev", "XXHASH": "libxxhash-dev"}


def call(*words, **how):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, **how)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def field(package, name):
    return call("dpkg-deb", "-f", package, name).strip()


def hide_sources():
    """Words before a command that hide the folder of the sources from it; none where that is not allowed."""
    hide = ["unshare", "--mount", "sh", "-c", f'mount -t tmpfs none "{ROOT}" && exec "$@"', "sh"]
    allowed = shutil.which("unshare") and subprocess.run([*hide, "true"], capture_output=True).returncode == 0
    return hide if allowed else []


def check_content(package):
    cmake = (ROOT / "CMakeLists.txt").read_text()
    assert field(package, "Version") in cmake
    depends = field(package, "Depends")
    for library in ("libc6", "libhdf5", "libopenmpi", "libtiff"):  # found by dpkg-shlibdeps
        assert library in depends, depends
    assert "python3-h5py" in field(package, "Recommends")
    config = (ROOT / "cmake" / "acinus-config.cmake").read_text()
    found = re.findall(r"^(?:find_dependency|pkg_check_modules)\((\w+)", config, re.MULTILINE)
    suggested = field(package, "Suggests").split(", ")
    missing = [name for name in found if DEVELOPMENT[name] not in suggested]
    assert found and not missing, f"programs with the library need {missing}, which the package does not suggest"
    files = {line.split(None, 5)[5].removeprefix("./") for line in call("dpkg-deb", "-c", package).splitlines()}
    for kind in ("scenes", "studies", "laws"):
        shipped = {p.relative_to(ROOT / "runs").as_posix() for p in (ROOT / "runs" / kind).rglob("*") if p.is_file()}
        missing = {p for p in shipped if f"usr/share/acinus/{p}" not in files}
        assert not missing, missing
    missing = [name for name in NEEDED if name not in files]
    assert not missing, missing
    assert not any("__pycache__" in name for name in files)


def run_unpacked(package, folder):
    root, work = folder / "root", folder / "work"
    work.mkdir()
    call("dpkg-deb", "-x", package, root)
    program = root / "usr/bin/acinus"
    python = {**os.environ, "PYTHONPATH": str(root / "usr/lib/python3/dist-packages"), "ACINUS": str(program), "PYTHONDONTWRITEBYTECODE": "1"}
    hidden = hide_sources()

    def acinus(*words):
        return call(*hidden, program, *words, cwd=work)

    if shutil.which("man"):
        page = subprocess.run(["man", "--warnings", "-l", root / "usr/share/man/man1/acinus.1.gz"], capture_output=True, text=True,
                              env={**os.environ, "MANWIDTH": "100"})
        assert page.returncode == 0 and not page.stderr and "acinus infer" in page.stdout, page.stderr
    assert "lobule_hybrid" in acinus("list")
    acinus("new", "lobule_hybrid", "mine")
    acinus("run", "mine/lobule_hybrid.json", "--until", "1 s", "--out", "job.run", "--quiet")
    acinus("new", "two_cells", "pair")
    (work / "own.json").write_text(json.dumps({"extends": "pair/two_cells.json", "time": {"end": "10 s"}}))
    acinus("run", "own.json", "--out", "own.run", "--quiet")
    acinus("report", "own.run")
    page = (work / "own.html").read_text()
    assert "<script" in page and len(page) > 100000, "the page of the report is not in the program"
    read = "import acinus; r = acinus.Run('own.run'); print(r.status, len(r.cells(frame=-1)['id']))"
    assert call(*hidden, "/usr/bin/python3", "-c", read, cwd=work, env=python).split() == ["completed", "2"]
    assert "two_cells" in call(*hidden, "/usr/bin/python3", "-m", "acinus", "program", "list", cwd=work, env=python)
    return bool(hidden)


def main():
    build = pathlib.Path(sys.argv[1])
    if not all(shutil.which(tool) for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps", "file")):
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        call("cpack", "-G", "DEB", "-B", folder / "package", cwd=build)
        package, = (folder / "package").glob("acinus_*.deb")
        check_content(package)
        hidden = run_unpacked(package, folder)
        print(f"{package.name}: {package.stat().st_size / 1e6:.1f} MB, runs unpacked{', with the sources hidden' if hidden else ''}")


main()
