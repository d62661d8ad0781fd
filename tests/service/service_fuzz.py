"""Sends damaged requests to a service: it answers or closes, lives on, and touches nothing outside its folder.

usage: service_fuzz.py ACINUS [REQUESTS] [SEED]

For a program built with sanitizers. Requests are those of real clients with bytes changed, cut, doubled and spliced,
with the token and without; scenes, changes, paths, files and models of UM-Bridge among them. What stands beside the
data folder must be the same afterwards. Prints how they were answered; exit code 1 if it does not hold.
"""

import collections
import json
import os
import random
import socket
import sys
import tempfile

from service_client import Service, in_base64

SCENE = {"extends": "two_cells", "time": {"end": "1 s"}, "cells": {"count": 2}, "static_meshes": [{"file": "wall.obj"}]}
SPLICES = [b"../", b"/etc/passwd", b"..%2f", b"\0", b"\r\n", b"\r\n\r\n", b"{" * 300, b"[" * 300, b"9" * 400, b"1e999", b"-1", b"\xff\xfe", b"\"", b"\\u0000", b"null",
           b"Content-Length: 99999999999999999999\r\n", b"Transfer-Encoding: chunked\r\n", b"Expect: 100-continue\r\n", b"extends", b"start_up", b"file:///", b"*", b"%00"]


def seeds(service, run):
    """Whole requests, as bytes."""
    bodies = [("POST", "/runs", {"scene": "two_cells", "set": {"time.end": "1 s"}}), ("POST", "/runs", {"scene": SCENE, "files": {"wall.obj": in_base64(b"v 0 0 0\n" * 40)}}),
              ("POST", "/runs", {"scene": "vessel_file", "set": {"vessels.file": "capillaries.vtk", "time.end": "1 s"}}),
              ("POST", "/check", {"scene": "two_cells", "set": {"time.end": "1 s"}}), ("POST", "/preview", {"scene": SCENE, "files": {"wall.obj": in_base64(b"v 0 0 0\n" * 40)}}),
              ("GET", f"/compare/{run}/{run}", None), ("GET", "/schema", None),
              ("POST", "/Evaluate", {"name": "example/cells", "input": [[24.0]], "config": {"at": ["1 h"], "seed": 1, "set": {"time.end": "1 h"}}}),
              ("POST", "/ModelInfo", {"name": "example/cells"}), ("POST", "/InputSizes", {"name": "example/cells", "config": {}}), ("POST", "/login", {"token": "0" * 32}),
              ("POST", f"/runs/{run}/stop", None), ("POST", f"/runs/{run}/resume", None), ("GET", f"/runs/{run}", None), ("GET", f"/runs/{run}/files/summary.json", None),
              ("GET", f"/runs/{run}/series", None), ("GET", f"/runs/{run}/events", None), ("GET", "/runs", None), ("GET", "/", None), ("GET", "/page/service.js", None),
              ("DELETE", "/runs/20260101-000000-000000", None), ("HEAD", "/Info", None)]
    for method, path, body in bodies:
        text = json.dumps(body).encode() if body is not None else b""
        head = f"{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{service.port}\r\nAuthorization: Bearer {service.token}\r\nContent-Length: {len(text)}\r\n\r\n"
        yield head.encode() + text


def mutate(request, rng):
    data = bytearray(request)
    # Mostly behind the token, so that something is reached.
    begin = data.find(b"\r\n\r\n") if rng.random() < 0.5 else 0
    for _ in range(rng.choice([1, 1, 1, 2, 4, 16])):
        at = rng.randrange(max(0, min(begin, len(data) - 1)), len(data)) if data else 0
        how = rng.randrange(6)
        if how == 0 and data:
            data[at] = rng.randrange(256)
        elif how == 1:
            del data[at:at + rng.randrange(1, 20)]
        elif how == 2:
            data[at:at] = rng.choice(SPLICES)
        elif how == 3:
            data[at:at] = data[at:at + rng.randrange(1, 60)]
        elif how == 4:
            data[at:at + 1] = rng.choice(SPLICES)
        elif data:
            data[at] ^= 1 << rng.randrange(8)
    # A length that fits again: else most of them would only wait for more.
    end = data.find(b"\r\n\r\n")
    if end >= 0 and rng.random() < 0.8:
        lines = [line for line in bytes(data[:end]).split(b"\r\n") if not line.lower().startswith(b"content-length")]
        data = bytearray(b"\r\n".join(lines) + b"\r\nContent-Length: %d\r\n\r\n" % (len(data) - end - 4) + data[end + 4:])
    return bytes(data)


def send(service, data):
    """First line of the answer; "" if there was none."""
    with socket.create_connection(("127.0.0.1", service.port), timeout=30) as link:
        try:
            link.sendall(data)
            link.shutdown(socket.SHUT_WR)
            return link.recv(200).split(b"\r\n")[0].decode(errors="replace")
        except (ConnectionError, BrokenPipeError):
            return ""


def state_of(folder, but):
    found = {}
    for path, _, names in os.walk(folder):
        names = [n for n in names if n != "data.stderr"]
        if not path.startswith(but):
            found.update({os.path.join(path, n): os.stat(os.path.join(path, n)).st_mtime_ns for n in names})
    return found


def main():
    acinus, count = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 10000
    rng, answers, wrong = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1), collections.Counter(), []
    with tempfile.TemporaryDirectory() as folder:
        data = os.path.join(folder, "data")
        with open(os.path.join(folder, "beside.txt"), "w") as file:
            file.write("stays\n")
        os.chdir(folder)
        with Service(acinus, data, "--jobs", "1", "--max-walltime", "2 s", "--max-cells", "50", "--max-waiting", "40", "--max-body", "1MB") as service:
            errors = service.errors
            run = service.submit("two_cells", set={"time.end": "1 s"})["id"]
            service.wait(run)
            before, requests = state_of(folder, data), list(seeds(service, run))
            for k in range(count):
                request = rng.choice(requests)
                answer = send(service, mutate(request, rng))
                answers[answer.split(" ")[1] if answer.count(" ") else "none"] += 1
                if service.process.poll() is not None:
                    wrong.append(f"request {k} ended the service: {request[:200]!r}")
                    break
            if not wrong:
                assert service.json("GET", "/runs")["version"]
                if state_of(folder, data) != before:
                    wrong.append("files outside the data folder changed")
                if service.end() != 0:
                    wrong.append("the service does not end well")
        with open(errors) as file:
            reported = file.read()
        if "ERROR" in reported or "runtime error" in reported or "internal error" in reported:
            wrong.append(reported[-4000:])
    print(f"{count} requests: " + ", ".join(f"{n} x {status}" for status, n in sorted(answers.items())))
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
