"""Requests and folders of strangers against a service: it lives on, answers others, and gives nothing away.

usage: service_hostile.py ACINUS [SUBMITS]

SUBMITS (default 40): submissions that are stopped at a random moment within 50 ms. Prints the time of each test.
"""

import concurrent.futures
import contextlib
import fcntl
import http.client
import json
import os
import random
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import threading
import time

from service_client import Service, in_base64

SHORT = {"time.end": "1 s"}
PATIENCE = 1.0  # s that others may wait at most; much less on a machine with nothing else to do


def memory(process, what="VmRSS"):
    """MB"""
    with open(f"/proc/{process.pid}/status") as file:
        return next(int(line.split()[1]) for line in file if line.startswith(what)) / 1000


def ask(service, method, path, body=None, headers=None, token=None):
    status, headers, text = service.ask(method, path, body, headers, token)
    return status, text.decode(errors="replace")


def raw(service, data, seconds=20):
    """The bytes that come back; what is not taken in time is an error."""
    with socket.create_connection(("127.0.0.1", service.port), timeout=seconds) as link:
        link.sendall(data)
        answer = b""
        with contextlib.suppress(ConnectionError):
            while piece := link.recv(65536):
                answer += piece
        return answer


def head(service, *lines, method="POST", path="/runs", token=True):
    own = [f"Host: 127.0.0.1:{service.port}"] + ([f"Authorization: Bearer {service.token}"] if token else [])
    return "\r\n".join([f"{method} {path} HTTP/1.1", *own, *lines, "", ""]).encode()


class Meanwhile:
    """Longest wait of others, in s, while a block goes on."""

    def __init__(self, service):
        self.service, self.longest, self.over = service, 0, threading.Event()

    def look(self):
        while not self.over.is_set():
            begin = time.monotonic()
            assert ask(self.service, "GET", "/login", token="")[0] == 200
            self.longest = max(self.longest, time.monotonic() - begin)
            time.sleep(0.02)

    def __enter__(self):
        self.thread = threading.Thread(target=self.look)
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.over.set()
        self.thread.join()


def test_json_without_end(service):
    for n in (101, 30000, 100000):
        nested = "[" * n + "]" * n
        for path, body in (("/runs", '{"scene":{"a":%s}}'), ("/runs", '{"scene":"two_cells","set":{"a":%s}}'), ("/runs", "%s"), ("/login", '{"token":%s}'),
                           ("/Evaluate", '{"name":"example/cells","input":[[24.0]],"config":{"set":{"a":%s}}}'), ("/ModelInfo", '{"name":%s}')):
            status, _ = ask(service, "POST", path, body % nested)
            assert status in (400, 401, 413), (path, status)
    many = {f"k{k}": 1 for k in range(20000)}
    for body in ({"scene": many}, {"scene": "two_cells", "set": many}, {"scene": "two_cells", "files": {k: "" for k in many}}):
        with Meanwhile(service) as others:
            assert ask(service, "POST", "/runs", body)[0] == 400
        assert others.longest < PATIENCE, others.longest


def test_files_that_harm(service):
    mesh = lambda name, text: {"scene": {"extends": "two_cells", "cells": {"source": "meshes", "file": name}}, "files": {name: in_base64(text)}}
    triangles = b"".join(b"3 %d %d %d\n" % (k, k + 1, k + 101) for k in range(8000))
    grid = b"# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 10000 float\n" + b"".join(b"%d %d 0\n" % (k // 100, k % 100) for k in range(10000))
    for body in (mesh("x.ply", b"ply\nformat ascii 1.0\nelement vertex 9000000000000000000\nend_header\n"),
                 mesh("x.vtk", grid + b"POLYGONS 8000 32000\n" + triangles), mesh("x.obj", b"v 1e308 0 0\nv 0 1e308 0\nv 0 0 1e308\nf 1 2 3\n"),
                 {"scene": {"extends": "lobule_hybrid", "start_up": {"enabled": True, "from": "."}}, "files": {"start.h5": in_base64(os.urandom(5000))}},
                 {"scene": {"extends": "lobule_hybrid", "start_up": {"enabled": True, "from": "."}}, "files": {"start.h5": in_base64(b"\x89HDF\r\n\x1a\n" + bytes(3000))}},
                 {"scene": "two_cells", "set": {"static_meshes": [{"name": "a", "file": "/dev/zero"}]}}):
        with Meanwhile(service) as others:
            status, text = ask(service, "POST", "/runs", body)
        assert status in (201, 400), (list(body.get("files", body)), status, text[:300])
        assert others.longest < PATIENCE, others.longest
    for key, value in (("vessels.file", "/etc/passwd"), ("static_meshes", [{"name": "a", "file": "/dev/zero"}]), ("start_up.from", "/tmp"), ("start_up", {"from": "x"})):
        status, text = ask(service, "POST", "/Evaluate", {"name": "example/cells", "input": [[24.0]], "config": {"set": {key: value}}})
        assert status == 400 and "no files" in text, text
    crowd = {"source": "fill", "count": 1_000_000, "low": ["0 um", "0 um", "0 um"], "high": ["2 mm", "2 mm", "2 mm"]}
    for changes in ({"cells": crowd}, {"output.every": "1e-9 s"}, {"cells.list": 300_000 * [{"position": ["0 um", "0 um", "0 um"]}]}):
        with Meanwhile(service) as others:
            status, text = ask(service, "POST", "/Evaluate", {"name": "example/cells", "input": [[24.0]], "config": {"set": changes}})
        assert status in (400, 413), text
        assert others.longest < PATIENCE, others.longest


def test_before_the_token(service):
    before = memory(service.process)
    status, _ = ask(service, "POST", "/login", b"[" * 100_000, token="")
    assert status == 413, status
    links = [socket.create_connection(("127.0.0.1", service.port), timeout=20) for _ in range(2000)]
    for link in links:
        with contextlib.suppress(ConnectionError):
            link.sendall(b"GET / HTTP/1.1\r\nHost: x")
    assert ask(service, "GET", "/runs")[0] == 200, "a flood of strangers keeps others out"
    for link in links:
        link.close()
    big, links = b" " * (1 << 20), []
    for _ in range(200):
        link = socket.create_connection(("127.0.0.1", service.port), timeout=5)
        links.append(link)
        with contextlib.suppress(OSError):
            link.sendall(head(service, "Content-Length: 15900000", path="/login", token=False))
            link.sendall(big)
    peak = memory(service.process, "VmHWM")
    for link in links:
        link.close()
    assert peak < 150, f"{before:.0f} MB became {peak:.0f} MB"
    end = time.monotonic() + 10
    while (after := memory(service.process)) > before + 30:
        assert time.monotonic() < end, f"{before:.0f} MB became {peak:.0f} MB, of which {after:.0f} MB stay"
        time.sleep(0.1)
    print(f"2000 connections and 200 bodies of strangers: {before:.0f} MB before, {peak:.0f} MB at most, {after:.0f} MB after")


def test_bodies_of_many(service):
    """Those who have the token share a bound, too."""
    body = json.dumps({"scene": "two_cells", "x": "y" * 7_000_000}).encode()
    with concurrent.futures.ThreadPoolExecutor(30) as pool:
        answers = list(pool.map(lambda _: ask(service, "POST", "/runs", body)[0], range(30)))
    assert set(answers) <= {400, 503}, answers
    peak = memory(service.process, "VmHWM")
    assert peak < 250, f"{peak:.0f} MB"


def test_heads_with_two_meanings(service):
    smuggled = head(service, method="GET", path="/scenes")
    for lines in (["Transfer-Encoding: identity"], ["Transfer-Encoding: gzip"], ["Transfer-Encoding: chunked, identity"], ["Transfer-Encoding: chunked", "Content-Length: 3"],
                  [f"Host: 127.0.0.1:{service.port}", "Content-Length: 0"], ["Origin: http://example.org", f"Origin: http://127.0.0.1:{service.port}", "Content-Length: 0"],
                  ["Content-Length: 0", "Content-Length: 5"], ["Authorization: Bearer x", "Content-Length: 0"]):
        answer = raw(service, head(service, *lines) + smuggled)
        assert answer.startswith(b"HTTP/1.1 400") and answer.count(b"HTTP/1.1 ") == 1, (lines, answer[:200])
    chunked = head(service, "Transfer-Encoding: chunked", "Connection: close") + b"2\r\n[]\r\n0\r\n\r\n"
    assert raw(service, chunked).startswith(b"HTTP/1.1 400") and b"JSON object" in raw(service, chunked)


def test_a_cookie_is_not_the_token(service):
    ids = set()
    for _ in range(3):
        _, headers, _ = service.ask("POST", "/login", {"token": service.token}, token="")
        name, session = headers["Set-Cookie"].split(";")[0].split("=")
        assert name == f"acinus_session_{service.port}" and service.token not in headers["Set-Cookie"]
        ids.add(session)
        assert ask(service, "GET", "/runs", headers={"Cookie": f"a=b; {name}={session}"}, token="")[0] == 200
    assert len(ids) == 3
    for cookie in (f"{name}={service.token}", f"{name}=", f"{name}=" + "0" * 32, f"x{name}={session}"):
        assert ask(service, "GET", "/runs", headers={"Cookie": cookie}, token="")[0] == 401, cookie
    own, foreign = {"Cookie": f"{name}={session}"}, f"http://127.0.0.1:{service.port + 1}"
    for headers in ({}, {"Origin": foreign}, {"Origin": "null"}, {"Sec-Fetch-Site": "cross-site"}, {"Sec-Fetch-Site": "same-site"}):
        assert ask(service, "POST", "/runs", {}, headers={**own, **headers}, token="")[0] == 403, headers


def test_licences(service):
    _, _, script = service.ask("GET", "/page/service.js")
    assert b"/page/licences.txt" in script
    _, _, text = service.ask("GET", "/page/licences.txt")
    assert b"uPlot" in text and b"MIT" in text


def test_links_and_pipes_in_run_folders(service, folder):
    run = service.submit("two_cells", set=SHORT)["id"]
    service.wait(run)
    place, secret = f"{service.data}/runs/{run}", folder + "/secret"
    with open(secret, "w") as file:
        file.write("secret")
    for name in ("run.log", "summary.json", "run.xmf", "output.txt"):
        os.remove(f"{place}/{name}")
    os.symlink(secret, place + "/run.log")
    os.symlink(secret, place + "/summary.json")
    os.mkfifo(place + "/output.txt")
    for name in ("run.log", "summary.json", "output.txt", "run.xmf"):
        assert ask(service, "GET", f"/runs/{run}/files/{name}")[0] == 404, name
    names = {file["name"] for file in service.json("GET", f"/runs/{run}/files")}
    assert names.isdisjoint({"run.log", "summary.json", "output.txt"}), names
    _, text = ask(service, "GET", f"/runs/{run}/report")
    assert "secret" not in text.replace(secret, "")


def test_supervision_goes_on(acinus, folder):
    with Service(acinus, folder + "/look", "--jobs", "1", "--max-run-disk", "2MB") as service:
        run = service.submit("lobule_dcm")["id"]
        with open(f"{service.data}/runs/{run}/progress.txt", "a") as file:
            for line in ('{"wall_s": 1, "phase": 3}', '{"wall_s": "x"}', '{"wall_s": 1, "dcm": 1e300, "cells": []}', "[" * 5000, '{"wall_s": 1, "time_s": null}'):
                file.write(line + "\n")
        with open(f"{service.data}/runs/{run}/filler", "wb") as file:
            file.write(bytes(4_000_000))
        ended = service.wait(run, ("stopped", "failed"), 60)
        assert "max-run-disk" in ended["cause"], ended


def test_disk_counts_what_is_sent(acinus, folder):
    with Service(acinus, folder + "/disk", "--jobs", "1", "--max-disk", "3MB") as service:
        blob, accepted = in_base64(os.urandom(900_000)), 0
        while ask(service, "POST", "/runs", {"scene": "two_cells", "files": {"x.bin": blob}})[0] == 201:
            accepted += 1
            assert accepted < 6, "--max-disk does not count what is sent along"
        assert service.json("GET", "/runs")["disk_bytes"] > 2e6


def test_long_lists(service):
    long = {"description": "x" * 50000}
    ids = [service.submit("two_cells", set={**SHORT, **long})["id"] for _ in range(3)]
    _, text = ask(service, "GET", "/runs")
    assert len(text) < 50000, len(text)
    assert max(len(change) for change in service.json("GET", f"/runs/{ids[0]}")["set"]) > 40000
    for run in ids:
        service.wait(run)


def test_resume_after_a_torn_summary(acinus, folder):
    with Service(acinus, folder + "/torn", "--jobs", "1", "--checkpoint-every", "0.2 s") as service:
        run = service.submit("lobule_hybrid", set={"start_up.growth_time": "30 min", "time.end": "10 min", "output.every": "5 min"})["id"]
        end = time.monotonic() + 60
        while not os.path.exists(f"{service.data}/runs/{run}/checkpoint.h5"):
            assert time.monotonic() < end
            time.sleep(0.02)
        service.end()
        with open(f"{service.data}/runs/{run}/summary.json", "w") as file:
            file.write('{"scene": ')
        service.start()
        assert service.wait(run)["time_s"] == 600


def test_data_folders_of_others(acinus, folder):
    def start(data):
        return subprocess.run([acinus, "serve", "--data", data, "--port", "0"], capture_output=True, text=True, timeout=30)

    loose = folder + "/loose"
    os.makedirs(loose)
    os.chmod(loose, 0o777)
    said = start(loose)
    assert said.returncode == 2 and "others may write" in said.stderr, said
    planted = folder + "/planted"
    os.makedirs(planted, 0o700)
    with open(planted + "/token", "w") as file:
        file.write("a" * 16 + "\n")
    for mode in (0o666, 0o644, 0o620):
        os.chmod(planted + "/token", mode)
        said = start(planted)
        assert said.returncode == 2 and "no secret" in said.stderr, said
    os.rename(planted + "/token", folder + "/elsewhere")
    os.chmod(folder + "/elsewhere", 0o600)
    os.symlink(folder + "/elsewhere", planted + "/token")
    assert start(planted).returncode == 2
    open_to_readers = folder + "/readable"
    os.makedirs(open_to_readers, 0o755)
    with Service(acinus, open_to_readers) as service:
        run = service.submit("two_cells", set=SHORT)["id"]
        service.wait(run)
        assert stat.S_IMODE(os.stat(open_to_readers).st_mode) == 0o700
        for name in ("token", "service.lock", f"runs/{run}/job.json", f"runs/{run}/run.lock", f"runs/{run}/run.vtkhdf"):
            assert os.stat(f"{open_to_readers}/{name}").st_mode & 0o077 == 0, name


def as_another(account, what):
    """Result of a function, called by a process of another account."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(read)
        os.setgroups([])
        os.setresgid(account, account, account)
        os.setresuid(account, account, account)
        try:
            said = what()
        except BaseException as error:
            said = repr(error)
        os.write(write, json.dumps(said).encode())
        os._exit(0)
    os.close(write)
    with os.fdopen(read) as file:
        said = file.read()
    os.waitpid(child, 0)
    return json.loads(said)


def try_lock(path):
    """True if this process can take a lock of a file, by reading it or by writing."""
    for mode in (os.O_RDONLY, os.O_RDWR, os.O_WRONLY):
        with contextlib.suppress(OSError):
            descriptor = os.open(path, mode)
            for how in (fcntl.LOCK_EX, fcntl.LOCK_SH):
                fcntl.flock(descriptor, how | fcntl.LOCK_NB)
                return True
    return False


def test_another_account(acinus, folder):
    if os.geteuid() != 0:
        print("test_another_account: skipped, it takes an administrator's account")
        return
    nobody = 65534
    os.chmod(folder, 0o755)  # the way to the data is open to all
    with Service(acinus, folder + "/mine", "--jobs", "1") as service:
        done = service.submit("two_cells", set=SHORT)["id"]
        service.wait(done)
        running = service.submit("two_cells", set={"time.end": "300 days"})["id"]
        paths = [os.path.join(place, name) for place, folders, files in os.walk(service.data) for name in ["", *folders, *files]]
        assert any(path.endswith("token") for path in paths) and any(path.endswith("run.lock") for path in paths)

        def spy():
            harm = []
            for path in paths:
                for mode in (os.R_OK, os.W_OK):
                    if os.access(path, mode):
                        harm.append(f"opens {path}")
                if os.path.isfile(path) and try_lock(path):
                    harm.append(f"locks {path}")
            for number in (signal.SIGTERM, signal.SIGKILL):
                with contextlib.suppress(PermissionError):
                    os.kill(service.process.pid, number)
                    harm.append("ends the service")
            for method, path in (("GET", "/runs"), ("GET", f"/runs/{done}/files/run.vtkhdf"), ("POST", f"/runs/{running}/stop"), ("DELETE", f"/runs/{done}")):
                if ask(service, method, path, token="")[0] != 401:
                    harm.append(f"{method} {path} is answered")
            return harm

        assert as_another(nobody, spy) == []
        service.json("POST", f"/runs/{running}/stop", expect=202)
        service.wait(running, ("stopped",), 60)
    # Results in an open folder may be read; whoever reads them keeps nobody from going on.
    run = [acinus, "run", "two_cells", "--out", folder + "/shared", "--quiet", "--until", "10 s"]
    subprocess.run(run, check=True, capture_output=True)
    assert as_another(nobody, lambda: os.access(folder + "/shared/run.vtkhdf", os.R_OK))
    assert not as_another(nobody, lambda: try_lock(folder + "/shared/run.lock"))
    subprocess.run([*run[:-1], "20 s", "--resume"], check=True, capture_output=True)


def test_a_stop_at_any_moment(acinus, folder, submits):
    moments = random.Random(1)
    with Service(acinus, folder + "/stop", "--jobs", "2") as service:
        for _ in range(submits):
            run = service.submit("two_cells", set={"time.end": "1 day"})["id"]
            time.sleep(moments.uniform(0, 0.05))
            service.json("POST", f"/runs/{run}/stop", expect=202)
        end = time.monotonic() + 120
        while (count := service.json("GET", "/runs")["count"]).get("stopped", 0) < submits:
            assert service.process.poll() is None and time.monotonic() < end, count
            time.sleep(0.05)
        assert count == {"stopped": submits}, count
        assert not service.json("GET", "/runs")["runs"][0]["cause"]
        assert service.end() == 0
        with open(service.errors) as file:
            assert "ending" not in file.read()


def main():
    acinus, submits = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 40
    with tempfile.TemporaryDirectory() as folder:
        with Service(acinus, folder + "/data", "--jobs", "1") as service:
            for test in (test_json_without_end, test_files_that_harm, test_before_the_token, test_bodies_of_many, test_heads_with_two_meanings, test_a_cookie_is_not_the_token,
                         test_licences, test_long_lists, lambda s: test_links_and_pipes_in_run_folders(s, folder)):
                begin = time.monotonic()
                test(service)
                assert service.process.poll() is None, f"{test.__name__} ended the service"
                print(f"{test.__name__}: {time.monotonic() - begin:.1f} s", flush=True)
        for test in (test_supervision_goes_on, test_disk_counts_what_is_sent, test_resume_after_a_torn_summary, test_data_folders_of_others,
                     test_another_account, lambda a, f: test_a_stop_at_any_moment(a, f, submits)):
            begin = time.monotonic()
            test(acinus, folder)
            print(f"{test.__name__}: {time.monotonic() - begin:.1f} s", flush=True)


if __name__ == "__main__":
    main()
