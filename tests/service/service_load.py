"""Many at once: a thousand who only watch, a thousand submissions, an evaluation that was made before.

usage: service_load.py ACINUS

Prints the memory of the service with and without its listeners, how long submissions and cached evaluations take.
Exit code 1 if listeners cost it more than 100 MB in all, a submission is lost, or the median of cached evaluations is
above 10 ms.
"""

import os
import resource
import select
import socket
import statistics
import sys
import tempfile
import time

from service_client import Service

LISTENERS, SUBMISSIONS = 1000, 1000


def memory(process):
    """MB, resident"""
    with open(f"/proc/{process.pid}/status") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS")) / 1000


def listen(service):
    link = socket.create_connection(("127.0.0.1", service.port))
    link.sendall(f"GET /events HTTP/1.1\r\nHost: 127.0.0.1:{service.port}\r\nAuthorization: Bearer {service.token}\r\n\r\n".encode())
    return link


def reported(links):
    """How many of them have been sent something since they were asked last."""
    ready, poll = 0, select.poll()
    for link in links:
        poll.register(link, select.POLLIN)
    names = {link.fileno(): link for link in links}
    for descriptor, _ in poll.poll(0):
        names[descriptor].recv(1 << 20)
        ready += 1
    return ready


def main():
    acinus, wrong = os.path.abspath(sys.argv[1]), []
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
    with tempfile.TemporaryDirectory() as folder, Service(acinus, folder + "/data", "--jobs", "1") as service:
        ask = {"name": "example/cells", "input": [[24.0]], "config": {"set": {"time.end": "2 days"}}}
        service.json("POST", "/Evaluate", ask)
        times = []
        for _ in range(200):
            begin = time.monotonic()
            service.json("POST", "/Evaluate", ask)
            times.append(1000 * (time.monotonic() - begin))
        print(f"cached evaluation: median {statistics.median(times):.1f} ms, longest {max(times):.1f} ms")
        if statistics.median(times) > 10:
            wrong.append("a cached evaluation takes more than 10 ms")
        before = memory(service.process)
        links = [listen(service) for _ in range(LISTENERS)]
        time.sleep(2)
        first = reported(links)
        with_them = memory(service.process)
        print(f"{LISTENERS} listeners: {first} received the state, {with_them:.0f} MB, {before:.0f} MB without them")
        if first < LISTENERS or with_them > 100:
            wrong.append("not all listeners received the state, or the service takes more than 100 MB")
        begin = time.monotonic()
        ids = {service.submit("two_cells", set={"time.end": "1 min", "seed": k})["id"] for k in range(SUBMISSIONS)}
        took = time.monotonic() - begin
        print(f"{SUBMISSIONS} submissions beside them: {took:.1f} s, {1000 * took / SUBMISSIONS:.1f} ms each, {memory(service.process):.0f} MB")
        if len(ids) != SUBMISSIONS:
            wrong.append("two submissions have one id")
        end = time.monotonic() + 900
        while service.json("GET", "/runs")["count"].get("completed", 0) < SUBMISSIONS and time.monotonic() < end:
            reported(links)
            time.sleep(0.5)
        count = service.json("GET", "/runs")["count"]
        print(f"after {time.monotonic() - begin:.0f} s: {count}, {memory(service.process):.0f} MB")
        if count != {"completed": SUBMISSIONS}:
            wrong.append("not all runs are completed")
        for link in links:
            link.close()
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
