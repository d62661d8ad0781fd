"""The service over HTTP: runs, limits, who may ask, what a restart keeps, models of UM-Bridge.

usage: service_test.py ACINUS
"""

import http.client
import json
import os
import socket
import subprocess
import sys
import tempfile
import time

from service_client import Service, in_base64

SHORT = {"time.end": "20 min"}
HYBRID = {"start_up.growth_time": "30 min", "time.end": "10 min", "output.every": "5 min"}  # some seconds
TRIANGLES = b"""v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
"""


def summary_of(service, run):
    return service.json("GET", f"/runs/{run}/files/summary.json")


def test_a_run_from_submission_to_files(service, acinus):
    run = service.submit("two_cells", set=SHORT, name="mine")["id"]
    done = service.wait(run)
    assert done["name"] == "mine" and done["cells"] == {"dcm": 2, "cbm": 0} and done["time_s"] == 1200, done
    own = os.path.join(os.path.dirname(service.data), "own.run")
    subprocess.run([acinus, "run", "two_cells", "--set", "time.end=20 min", "--threads", "1", "--out", own, "--quiet"], check=True)
    with open(own + "/summary.json") as file:
        assert json.load(file)["state_hash"] == summary_of(service, run)["state_hash"]
    series = service.json("GET", f"/runs/{run}/series")
    assert any(len(s["value"]) > 1 and len(s["value"]) == len(s["time_s"]) for s in series.values()), series
    assert {f["name"] for f in service.json("GET", f"/runs/{run}/files")} >= {"run.vtkhdf", "summary.json", "scene.json", "checkpoint.h5"}
    status, headers, page = service.ask("GET", f"/runs/{run}/report")
    assert status == 200 and page.startswith(b"<!DOCTYPE html>") and b"<title>mine</title>" in page and "sandbox" in headers["Content-Security-Policy"]
    status, headers, data = service.ask("GET", f"/runs/{run}/files/run.vtkhdf")
    assert status == 200 and data.startswith(b"\x89HDF") and "attachment" in headers["Content-Disposition"]
    assert service.ask("HEAD", f"/runs/{run}/files/run.vtkhdf")[1]["Content-Length"] == str(len(data))
    service.ask("DELETE", f"/runs/{run}")
    service.json("GET", f"/runs/{run}", expect=404)
    assert not os.path.exists(f"{service.data}/runs/{run}")


def wait_for_progress(service, run):
    end = time.monotonic() + 60
    while not service.json("GET", f"/runs/{run}")["phase"]:
        assert time.monotonic() < end, "no progress is reported"
        time.sleep(0.02)


def test_stop_and_resume(service, _):
    run = service.submit("lobule_hybrid", set=HYBRID)["id"]
    wait_for_progress(service, run)
    service.json("POST", f"/runs/{run}/stop", expect=202)
    service.wait(run, ("stopped",))
    service.json("POST", f"/runs/{run}/stop", expect=400)
    service.json("POST", f"/runs/{run}/resume", expect=202)
    assert service.wait(run)["time_s"] == 600
    service.json("POST", f"/runs/{run}/resume", expect=400)


def test_events_tell_a_run(service, _):
    run = service.submit("two_cells", set=SHORT)["id"]
    connection = http.client.HTTPConnection("127.0.0.1", service.port, timeout=60)
    connection.request("GET", f"/runs/{run}/events", headers={"Authorization": "Bearer " + service.token})
    answer = connection.getresponse()
    assert answer.headers["Content-Type"] == "text/event-stream"
    states = []
    while not states or states[-1] != "completed":
        line = answer.readline().decode()
        if line.startswith("data: "):
            states.append(json.loads(line[6:])["state"])
    connection.close()


def test_own_scenes_and_files(service, _):
    own = {"extends": "two_cells", "name": "own", "time": {"end": "10 min"}}
    assert service.wait(service.submit(own)["id"])["name"] == "own"
    mesh = {"extends": "two_cells", "time": {"end": "1 min"}, "static_meshes": [{"name": "a", "file": "wall.obj"}]}
    fault = service.submit(mesh, expect=400)["error"]["message"]
    assert "static_meshes" in fault, fault
    # The file is found; what is wrong with the key is a matter of the scene.
    said = service.ask("POST", "/runs", {"scene": mesh, "files": {"wall.obj": in_base64(TRIANGLES)}})
    assert "cannot be opened" not in said[2].decode(), said


def test_bad_submissions(service, _):
    before = len(os.listdir(service.data + "/runs"))
    for body, reported in [
            (b"{", "JSON object"), (b"[]", "JSON object"), ({}, '"scene"'), ({"scene": 3}, '"scene"'), ({"scene": "two_cels"}, "two_cells"),
            ({"scene": "two_cells", "sett": {}}, "sett"), ({"scene": "two_cells", "set": {"time.ende": "1 h"}}, "time.end"),
            ({"scene": "two_cells", "set": {"time.end": "1 kg"}}, "time.end"), ({"scene": "../two_cells"}, "no shipped scene"),
            ({"scene": {"extends": "/etc/passwd"}}, "nothing absolute"), ({"scene": {"extends": "../scenes/two_cells.json"}}, "nothing absolute"),
            ({"scene": {"extends": "nothing.json"}}, "no shipped scene"),
            ({"scene": "vessel_file", "set": {"vessels.file": "/etc/passwd"}}, "nothing absolute"),
            ({"scene": "vessel_file", "set": {"vessels.file": "a/../../x.vtk"}}, "nothing absolute"),
            ({"scene": "two_cells", "set": {"start_up.from": "/tmp"}}, "nothing absolute"),
            ({"scene": "two_cells", "files": {"../x": ""}}, "no name of a file"), ({"scene": "two_cells", "files": {"x": "?"}}, "base64"),
            ({"scene": "two_cells", "files": {"two_cells.json": ""}}, "shipped scene"),
            ({"scene": "spheroid_cbm", "set": {"cells.count": 1000000, "domain.box": [["0 m", "0 m", "0 m"], ["1 m", "1 m", "1 m"]]}}, "")]:
        status, _, text = service.ask("POST", "/runs", body)
        assert status == 400 and reported in json.loads(text)["error"]["message"], f"{body}: {status} {text}"
    assert len(os.listdir(service.data + "/runs")) == before, "something refused was kept"
    assert service.ask("POST", "/runs", b"x" * 20_000_000)[0] == 413


def test_check_and_preview_keep_nothing(service, _):
    before = sorted(os.listdir(service.data + "/runs"))
    schema = service.json("GET", "/schema")
    assert schema["properties"]["time"]["properties"]["end"]["description"].endswith("Range: > 0 h"), schema["properties"]["time"]
    scene = service.json("POST", "/check", {"scene": "two_cells", "set": SHORT})
    assert float(scene["time"]["end"].split()[0]) == 1 / 3 and len(scene["cells"]["list"]) == 2, scene
    start = service.json("POST", "/preview", {"scene": "lobule_hybrid"})
    assert start["cells"] == {"dcm": 28, "cbm": 57} and start["vessel_length_um"] > 1000 and len(start["walls"]) > 3 and start["start_up"] and start["end_s"] == 43200, start["cells"]
    assert not any("(/" in note for note in start["notes"]), start["notes"]
    [frame] = start["frames"]["list"]
    assert frame["cells"] == 85 and frame["spheres"] == 57 and frame["time"] == 0 and start["frames"]["still"][0]["triangles"] > 100, frame
    assert "pressure" not in start["frames"]["columns"], "loads before the first step"
    mesh = {"extends": "two_cells", "static_meshes": [{"name": "a", "file": "wall.obj"}]}
    for path in ("/check", "/preview"):
        for body, reported in [(b"{", "JSON object"), ({"scene": "two_cels"}, "two_cells"), ({"scene": "two_cells", "set": {"time.end": "1 kg"}}, "/time/end"),
                               ({"scene": "two_cells", "set": {"cells.cout": 3}}, "/cells/cout"), ({"scene": "../two_cells"}, "no shipped scene"),
                               ({"scene": "vessel_file", "set": {"vessels.file": "/etc/passwd"}}, "nothing absolute"), ({"scene": mesh}, "static_meshes"),
                               ({"scene": "clump13", "set": {"cells.count": 100000}}, "than this service allows")]:
            status, _, text = service.ask("POST", path, body)
            assert status == 400 and reported in json.loads(text)["error"]["message"], f"{path} {body}: {status} {text}"
        status, headers, _ = service.ask("GET", path)
        assert status == 405 and headers["Allow"] == "POST"
        assert service.ask("POST", path, b"x" * 20_000_000)[0] == 413
    assert service.ask("POST", "/schema", {})[0] == 405
    assert sorted(os.listdir(service.data + "/runs")) == before, "something was kept"


def test_previews_are_limited(service, _):
    # Placed in time, but the picture of so many meshes is too large.
    large = {"scene": "clump13", "set": {"cells.count": 4500, "cell_types.hepatocyte.dcm.nodes": 642}}
    message = service.json("POST", "/preview", large, expect=400)["error"]["message"]
    assert "MB" in message or "memory" in message or "longer than" in message, message


def test_compare_two_runs(service, _):
    one, two = (service.submit("two_cells", set={"time.end": "20 min", "seed": seed}, name=f"seed {seed}")["id"] for seed in (1, 2))
    service.wait(one), service.wait(two)
    kept = sorted(os.listdir(f"{service.data}/runs/{one}"))
    status, headers, page = service.ask("GET", f"/compare/{one}/{two}")
    assert status == 200 and page.startswith(b"<!DOCTYPE html>") and "sandbox" in headers["Content-Security-Policy"]
    assert b"seed 1" in page and b"seed 2" in page and b'"comparison"' in page
    assert sorted(os.listdir(f"{service.data}/runs/{one}")) == kept, "the page was kept"
    assert service.ask("GET", f"/compare/{one}/{one}")[0] == 400
    for path in (f"/compare/{one}/20261125-120000-000000", f"/compare/../{one}", f"/compare/{one}/..%2f{two}", f"/compare/{one}", f"/compare/{one}/{two}/x"):
        assert service.ask("GET", path)[0] == 404, path
    assert service.ask("POST", f"/compare/{one}/{two}", {})[0] == 405
    slow = service.submit("lobule_dcm")["id"]
    assert "not ended" in service.json("GET", f"/compare/{one}/{slow}", expect=400)["error"]["message"]
    service.json("POST", f"/runs/{slow}/stop", expect=202)
    service.wait(slow, ("stopped", "failed"))


def test_who_may_ask(service, _):
    for path in ("/", "/runs", "/events", "/scenes", "/schema", "/check", "/preview", "/page/preview.js", "/compare/20261125-120000-000000/20261125-120000-000001", "/Info", "/page/service.js", "/nothing", "/runs/20261125-120000-000000/files/token"):
        assert service.ask("GET", path, token="")[0] == 401, path
        assert service.ask("GET", path, token="0" * 32)[0] == 401, path
    assert service.ask("POST", "/runs", {"scene": "two_cells"}, token="")[0] == 401
    for path in ("/Evaluate", "/check", "/preview"):
        assert service.ask("POST", path, {"scene": "two_cells"}, token="")[0] == 401, path
    assert service.ask("GET", "/login", token="")[0] == 200
    assert service.ask("POST", "/login", {"token": "no"}, token="")[0] == 401
    status, headers, _ = service.ask("POST", "/login", {"token": service.token}, token="")
    cookie = headers["Set-Cookie"].split(";")[0]
    assert status == 204 and "HttpOnly" in headers["Set-Cookie"] and "SameSite=Strict" in headers["Set-Cookie"]
    own = f"http://127.0.0.1:{service.port}"
    assert service.ask("GET", "/runs", token="", headers={"Cookie": cookie})[0] == 200
    for path in ("/runs", "/check", "/preview"):
        assert service.ask("POST", path, {}, token="", headers={"Cookie": cookie})[0] == 403, "a cookie alone changed something"
    assert service.ask("POST", "/runs", {}, token="", headers={"Cookie": cookie, "Origin": own})[0] == 400
    for headers in ({"Host": "example.org"}, {"Origin": "http://example.org"}, {"Origin": "null"}):
        assert service.ask("GET", "/runs", headers=headers)[0] == 403, headers
    basic = in_base64(f"acinus:{service.token}".encode())
    assert service.ask("GET", "/runs", token="", headers={"Authorization": "Basic " + basic})[0] == 200
    assert os.stat(service.data + "/token").st_mode & 0o077 == 0
    run = service.submit("two_cells", set=SHORT)["id"]
    for name in ("../job.json", "..%2f..%2ftoken", "job.json", "input", "/etc/passwd", "%2e%2e/token"):
        assert service.ask("GET", f"/runs/{run}/files/{name}")[0] == 404, name
    for path in ("/../token", "/runs/../../token", "/runs/" + "../" * 8 + "etc/passwd"):
        assert service.ask("GET", path)[0] == 404, path


def test_what_is_no_http(service, _):
    for words in (b"\x16\x03\x01\x02", b"GET / HTTP/9.9\r\n\r\n", b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n\r\n", b"POST /runs HTTP/1.1\r\nContent-Length: -1\r\n\r\n",
                  b"POST /runs HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n"):
        with socket.create_connection(("127.0.0.1", service.port), timeout=10) as link:
            link.sendall(words)
            link.shutdown(socket.SHUT_WR)
            while link.recv(65536):
                pass
    assert service.json("GET", "/runs")["version"]


def test_um_bridge(service, _):
    info = service.json("GET", "/Info")
    assert info["protocolVersion"] == 1.0
    name = "example/cells"
    assert name in info["models"]
    sizes = {"name": name, "config": {"at": ["1 day", "2 days"]}}
    assert service.json("POST", "/InputSizes", sizes) == {"inputSizes": [1]}
    assert service.json("POST", "/OutputSizes", sizes) == {"outputSizes": [2]}
    assert service.json("POST", "/ModelInfo", {"name": name})["support"] == {"Evaluate": True, "Gradient": False, "ApplyJacobian": False, "ApplyHessian": False}
    config = {"at": ["1 day", "2 days"], "set": {"time.end": "2 days"}, "seed": 5}
    ask = {"name": name, "input": [[24.0]], "config": config}
    first = service.json("POST", "/Evaluate", ask)
    assert len(first["output"]) == 1 and len(first["output"][0]) == 2 and first["output"][0][1] >= first["output"][0][0] >= 1, first
    begin = time.monotonic()
    assert service.json("POST", "/Evaluate", ask) == first
    cached = time.monotonic() - begin
    # The same run answers for another observable.
    assert service.json("POST", "/Evaluate", {**ask, "name": "example/radius_of_gyration_um"})["output"][0][0] >= 0
    assert len(os.listdir(service.data + "/results")) == 1
    for body, kind in [({"name": "nothing"}, "ModelNotFound"), ({}, "ModelNotFound"), ({**ask, "input": [[1, 2]]}, "InvalidInput"),
                       ({**ask, "input": [["a"]]}, "InvalidInput"), ({**ask, "input": [[-1.0]]}, "InvalidInput"),
                       ({**ask, "config": {"variant": "slw"}}, "InvalidInput"), ({**ask, "config": {"at": "1 kg"}}, "InvalidInput"),
                       ({**ask, "config": {"sed": 1}}, "InvalidInput"), ({**ask, "config": {"parameters": ["model"]}}, "InvalidInput")]:
        error = service.json("POST", "/Evaluate", body, expect=400)["error"]
        assert error["type"] == kind and set(error) == {"type", "message"}, (body, error)
    assert service.json("POST", "/Gradient", {"name": name}, expect=400)["error"]["type"] == "UnsupportedFeature"
    print(f"cached evaluation: {1000 * cached:.1f} ms")


def test_a_restart_goes_on(acinus, folder):
    data = folder + "/restart"
    with Service(acinus, data, "--jobs", "1", "--checkpoint-every", "1 s") as service:
        run, short = service.submit("lobule_hybrid", set=HYBRID)["id"], service.submit("two_cells", set=SHORT)["id"]
        wait_for_progress(service, run)
        assert service.end() == 0
        assert os.path.exists(f"{data}/runs/{run}/checkpoint.h5") and os.listdir(data + "/queue/running") == []
        service.start()
        beaten = subprocess.run([acinus, "serve", "--data", data, "--port", "0"], capture_output=True, text=True)
        assert beaten.returncode == 2 and "serves this folder" in beaten.stderr, beaten
        service.wait(run)
        service.wait(short)
        undisturbed = folder + "/undisturbed.run"
        sets = [word for key, value in HYBRID.items() for word in ("--set", f"{key}={value}")]
        subprocess.run([acinus, "run", "lobule_hybrid", *sets, "--threads", "1", "--out", undisturbed, "--quiet"], check=True)
        with open(undisturbed + "/summary.json") as file:
            assert json.load(file)["state_hash"] == summary_of(service, run)["state_hash"]


def test_limits(acinus, folder):
    with Service(acinus, folder + "/limits", "--jobs", "1", "--max-walltime", "3 s", "--max-cells", "30", "--max-waiting", "1", "--max-run-disk", "1MB") as service:
        assert "more than this service allows" in service.submit("lobule_cbm", expect=400)["error"]["message"]
        grown = service.submit("spheroid_cbm", set={"output.every": "10 days"})["id"]
        waiting = service.submit("two_cells", set=SHORT)["id"]
        assert "max-waiting" in service.submit("two_cells", expect=400)["error"]["message"]
        ended = service.wait(grown, ("completed", "stopped"))
        assert ended["cause"], ended
        service.wait(waiting, ("completed", "stopped"))
    with Service(acinus, folder + "/slow", "--jobs", "1", "--max-walltime", "2 s") as service:
        slow = service.wait(service.submit("lobule_dcm")["id"], ("stopped",))
        assert "limit" in slow["cause"], slow


def test_command_line(acinus, folder):
    for words, reported in [(["--address", "here"], "IP address"), (["--address", "0.0.0.0", "--no-token"], "--no-token"), (["--port", "70000"], "--port"),
                        (["--max-disk", "4"], "--max-disk")]:
        said = subprocess.run([acinus, "serve", "--data", folder + "/c", *words], capture_output=True, text=True, timeout=20)
        assert said.returncode == 2 and reported in said.stderr, said


def main():
    acinus = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        with Service(acinus, folder + "/data", "--jobs", "2", "--checkpoint-every", "1 s") as service:
            for test in (test_a_run_from_submission_to_files, test_stop_and_resume, test_events_tell_a_run, test_own_scenes_and_files, test_bad_submissions,
                         test_check_and_preview_keep_nothing, test_previews_are_limited, test_compare_two_runs,
                         test_who_may_ask, test_what_is_no_http, test_um_bridge):
                begin = time.monotonic()
                test(service, acinus)
                print(f"{test.__name__}: {time.monotonic() - begin:.1f} s", flush=True)
        for test in (test_a_restart_goes_on, test_limits, test_command_line):
            begin = time.monotonic()
            test(acinus, folder)
            print(f"{test.__name__}: {time.monotonic() - begin:.1f} s", flush=True)


if __name__ == "__main__":
    main()
