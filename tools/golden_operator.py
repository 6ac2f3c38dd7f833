#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/golden_operator.py PORT PROGRAM...: the operator's requests during a golden recording, all of them over HTTP.

The parameters of parameters.yaml beside the programs, if there are any, are stored and activated by a reset first. Each
channel receives its program and runs it; before, between and after it follow requests of every kind: accepted and
refused, of a program and of the page. Every request is sent at rest, so that its place in the programs is defined.
"""
import json, os, sys, time, urllib.error, urllib.parse, urllib.request

import yaml


class Gateway:
    def __init__(self, port):
        self.base = f"http://127.0.0.1:{port}"

    def ask(self, method, path, body=None, origin=None, status=200):
        """The answer as JSON or text; ends the program when its status is another one."""
        data = json.dumps(body).encode() if isinstance(body, dict) else body
        if data is None and method != "GET": data = b""
        headers = {} if origin is None else {"Origin": origin}
        try:
            with urllib.request.urlopen(urllib.request.Request(self.base + path, data, headers, method=method), timeout=10) as answer:
                got, text = answer.status, answer.read().decode()
        except urllib.error.HTTPError as error:
            got, text = error.code, error.read().decode()
        if got != status: sys.exit(f"{method} {path} was answered {got} {text.strip()}; expected {status}")
        try: return json.loads(text)
        except json.JSONDecodeError: return text

    def post(self, path, body=None, **more):
        return self.ask("POST", path, {} if body is None else body, **more)

    def wait(self, what, ready, seconds=60):
        until = time.monotonic() + seconds
        while not ready():
            if time.monotonic() > until: sys.exit(f"it did not come to: {what}")
            time.sleep(0.02)

    def at_rest(self, channel, after=None):
        state = self.ask("GET", f"/api/channels/{channel}")
        return state["state"] == "IDLE" and (after is None or state["cycle"] > after)


def set_parameters(gateway, file, paths):
    """What exercises a stage that does nothing on the machine as it is delivered."""
    if not os.path.exists(file): return
    with open(file) as text: values = yaml.safe_load(text)
    for number, value in values.items():
        gateway.ask("PUT", f"/api/parameters/{int(number)}", {"value": value, "who": "golden"})
    for path in paths: gateway.post(path + "/reset")
    waiting = lambda: [n for n in values if gateway.ask("GET", f"/api/parameters/{int(n)}")["pending"]]
    gateway.wait(f"active parameters of {file}", lambda: not waiting())
    time.sleep(0.1)


def stop_and_recover(gateway, paths):
    """The emergency stop at rest, and the way back."""
    engaged = lambda: gateway.ask("GET", "/api/status")["plc"]["emergency_stop"]
    gateway.post("/api/panel/emergency-stop")
    gateway.wait("the emergency stop", engaged)
    time.sleep(0.1)
    gateway.post("/api/panel/release")
    gateway.post("/api/panel/reset")
    gateway.wait("drives that are on", lambda: not engaged())
    time.sleep(0.1)
    gateway.post("/api/alarms/reset")
    for path in paths: gateway.post(path + "/reset")
    time.sleep(0.1)


def main():
    gateway, files = Gateway(sys.argv[1]), sys.argv[2:]
    names = [os.path.basename(file) for file in files]
    paths = [f"/api/channels/{c}" for c in range(len(files))]
    for path in paths: gateway.wait("a channel that is there", lambda: gateway.ask("GET", "/api/channels")["channels"] and gateway.at_rest(path[-1]))
    set_parameters(gateway, os.path.join(os.path.dirname(files[0]), "parameters.yaml"), paths)
    for file, name in zip(files, names):
        with open(file, "rb") as text: gateway.ask("PUT", "/api/programs/" + urllib.parse.quote(name), text.read())
    stored = lambda: {p["name"] for p in gateway.ask("GET", "/api/programs")["programs"]}
    gateway.wait("every program in the list", lambda: stored() >= set(names))
    # The channel's copy of the list may be a moment behind the gateway's.
    time.sleep(0.1)
    gateway.ask("GET", "/api/programs/" + urllib.parse.quote(names[0]))
    gateway.post("/api/channels/0/override", {"kind": "feed", "value": 9}, status=400)
    gateway.post("/api/channels/31/reset", status=404)
    gateway.post("/api/channels/0/select", {"program": "NOT THERE.NC"}, status=409)
    gateway.post("/api/channels/0/cycle-start", origin="http://elsewhere.invalid", status=403)
    for path, name in zip(paths, names):
        gateway.post(path + "/mode", {"mode": "AUTO"})
        gateway.post(path + "/select", {"program": name}, origin=gateway.base)
        gateway.post(path + "/override", {"kind": "feed", "value": 0.9}, origin=gateway.base)
    before = [gateway.ask("GET", path)["cycle"] for path in paths]
    for path in paths: gateway.post(path + "/cycle-start")
    for c, cycle in enumerate(before): gateway.wait(f"the end of {names[c]}", lambda: gateway.at_rest(c, cycle))
    time.sleep(0.1)
    gateway.post("/api/channels/0/override", {"kind": "feed", "value": 1})
    gateway.post("/api/channels/0/mode", {"mode": "JOG"})
    cycle = gateway.ask("GET", "/api/channels/0")["cycle"]
    gateway.post("/api/channels/0/jog", {"axis": "X", "speed": 1200, "increment": 0.25}, origin=gateway.base)
    gateway.wait("the end of the jog", lambda: gateway.at_rest(0, cycle))
    time.sleep(0.1)
    gateway.post("/api/channels/0/mode", {"mode": "AUTO"})
    gateway.post("/api/alarms/reset")
    gateway.ask("PUT", "/api/work-offsets", {"channel": 0, "index": 5, "values": [1.5] + [0] * 8, "who": "golden"})
    gateway.ask("PUT", "/api/parameters/999999", {"value": 1}, status=404)
    stop_and_recover(gateway, paths)
    gateway.ask("DELETE", "/api/programs/" + urllib.parse.quote("NOT THERE.NC"), status=409)
    alarms = [a for a in gateway.ask("GET", "/api/alarms")["alarms"] if a["severity"] in ("ERROR", "EMERGENCY")]
    if alarms: sys.exit(f"alarm {alarms[0]['number']}: {alarms[0]['text']}")
    time.sleep(0.15)  # what the services wrote last is still on its way


main()
