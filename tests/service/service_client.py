"""A service of this program, and what a test asks of it."""

import base64
import contextlib
import http.client
import json
import os
import re
import signal
import subprocess
import time


class Service:
    """Starts `acinus serve` on a free port; ends it with the block."""

    def __init__(self, acinus, data, *flags):
        self.command = [acinus, "serve", "--data", data, "--port", "0", *flags]
        self.data, self.process = data, None
        self.errors = data.rstrip("/") + ".stderr"
        self.start()

    def start(self):
        with open(self.errors, "a") as errors:
            self.process = subprocess.Popen(self.command, stdout=subprocess.PIPE, stderr=errors, text=True)
        for line in self.process.stdout:
            if found := re.match(r"open http://([^/:]+):(\d+)/", line):
                self.port = int(found[2])
            if line.endswith("with a checkpoint\n"):
                break
        else:
            raise AssertionError("the service does not start")
        token = os.path.join(self.data, "token")
        self.token = open(token).read().strip() if os.path.exists(token) else ""

    def ask(self, method, path, body=None, headers=None, token=None):
        """(status, headers, body as bytes)"""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=600)
        with contextlib.closing(connection):
            token = self.token if token is None else token
            sent = {**({"Authorization": "Bearer " + token} if token else {}), **(headers or {})}
            data = json.dumps(body) if isinstance(body, (dict, list)) else body
            connection.request(method, path, body=data, headers=sent)
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()

    def json(self, method, path, body=None, expect=200):
        status, _, text = self.ask(method, path, body)
        assert status == expect, f"{method} {path}: {status} {text[:400]!r}"
        return json.loads(text) if text else None

    def submit(self, scene, expect=201, **more):
        return self.json("POST", "/runs", {"scene": scene, **more}, expect)

    def wait(self, run, states=("completed",), seconds=120):
        end = time.monotonic() + seconds
        while (now := self.json("GET", f"/runs/{run}"))["state"] not in states:
            assert time.monotonic() < end, f"not {states} within {seconds} s: {now}"
            assert now["state"] != "failed" or "failed" in states, now
            time.sleep(0.05)
        return now

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        self.process.stdout.close()

    def end(self, seconds=90):
        self.process.send_signal(signal.SIGTERM)
        self.process.wait(seconds)
        self.process.stdout.close()
        return self.process.returncode

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.end()


def in_base64(data):
    return base64.b64encode(data).decode()
