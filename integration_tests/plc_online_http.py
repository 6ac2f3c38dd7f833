#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""plc_online_http.py TRUNNION MACHINES: the programs of a running PLC over HTTP and WebSocket, on a cluster in virtual
time: variables, sources, watch, force and release, trace, load with its comparison. Standard library only."""
import base64, http.client, json, os, pathlib, shutil, socket, struct, subprocess, sys, tempfile, time

trunnion, machines = sys.argv[1], pathlib.Path(sys.argv[2])
COUNTER = """FUNCTION_BLOCK Counter
VAR_INPUT step : UDINT; END_VAR
VAR_OUTPUT n : UDINT; END_VAR
VAR RETAIN hours : UDINT := 5; END_VAR
n := n + step;
IF hours > 1000 THEN n := 0; END_IF;
END_FUNCTION_BLOCK
"""


def check(what, condition, shown=""):
    if not condition: sys.exit(f"does not hold: {what} {shown}")
    print(f"ok   {what}")


class Page:
    def __init__(self, port): self.port = port

    def ask(self, method, path, body=None, status=200, patience=60):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.request(method, path, None if body is None else json.dumps(body))
        answer = connection.getresponse()
        content = answer.read()
        kind = answer.getheader("Content-Type", "")
        # The gateway answers from its start on; what it has not heard yet comes a moment later.
        if answer.status == 504 != status and b"has not published yet" in content and patience > 0:
            time.sleep(0.1)
            return self.ask(method, path, body, status, patience - 0.1)
        if answer.status != status: sys.exit(f"{method} {path}: {answer.status}, expected {status}: {content[:400]!r}")
        if status >= 400: check(f"{path} {status} is a problem document", kind == "application/problem+json", kind)
        return json.loads(content) if "json" in kind else content.decode()

    def until(self, what, condition, seconds=60):  # only ends a hang
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            found = condition()
            if found: return found
            time.sleep(0.05)
        sys.exit(f"not within {seconds} s: {what}")


class Watch:
    """A WebSocket client (RFC 6455): text messages, masked as a client must."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=60)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /api/plc/watch HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                             f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode())
        self.rest = b""
        while b"\r\n\r\n" not in self.rest: self.rest += self.socket.recv(4096)
        head, self.rest = self.rest.split(b"\r\n\r\n", 1)
        check("the watch is a WebSocket", b" 101 " in head.split(b"\r\n")[0], head)

    def send(self, message):
        data, mask = json.dumps(message).encode(), os.urandom(4)
        length = bytes([0x80 | len(data)]) if len(data) < 126 else bytes([0x80 | 126]) + struct.pack(">H", len(data))
        self.socket.sendall(b"\x81" + length + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(data)))

    def take(self, count):
        while len(self.rest) < count:
            part = self.socket.recv(65536)
            if not part: sys.exit("the watch was closed")
            self.rest += part
        data, self.rest = self.rest[:count], self.rest[count:]
        return data

    def next(self):
        while True:
            first, second = self.take(2)
            length = second & 127
            if length == 126: length = struct.unpack(">H", self.take(2))[0]
            data = self.take(length)
            if first & 15 == 1: return json.loads(data)

    def until(self, what, condition):
        for _ in range(200):
            message = self.next()
            if condition(message): return message
        sys.exit(f"the watch has not: {what}")


def variables(page):
    first = page.ask("GET", "/api/plc/variables?limit=7")
    paths = [one["path"] for one in first["variables"]]
    check("a page of variables", first["total"] > 7 and len(paths) == 7 and first["offset"] == 0, first)
    for offset in range(7, first["total"], 100):
        paths += [one["path"] for one in page.ask("GET", f"/api/plc/variables?limit=100&offset={offset}")["variables"]]
    check("the pages are the whole list, each once", len(paths) == first["total"] == len(set(paths)), first["total"])
    found = page.ask("GET", "/api/plc/variables?search=COUNTER.HO")
    check("a search", found["variables"] == [{"path": "fast.counter.hours", "type": "UDINT", "retained": True}], found)
    check("a prefix", page.ask("GET", "/api/plc/variables?prefix=fast.counter.")["total"] == 3)
    wrong = page.ask("GET", "/api/plc/variables?limit=many", status=400)
    check("a wrong number names its field", wrong["field"] == "limit" and wrong["status"] == 400, wrong)


def sources(page):
    running = page.ask("GET", "/api/plc/programs")
    check("which programs run", running["delivered"] and running["changes"] == 0 and running["phase"] == "NO_LOAD", running)
    check("with their files", {"counter.st", "fast.st", "main.st"} <= {one["name"] for one in running["files"]}, running)
    check("a source", page.ask("GET", "/api/plc/programs/counter.st") == COUNTER)
    page.ask("GET", "/api/plc/programs/none.st", status=404)
    page.ask("GET", "/api/plc/programs/counter.st?set=previous", status=409)


def values_follow_their_list(port):
    """A list as long as the one before never shows the values of that one: a hand that forces would add to them."""
    watch, expected = Watch(port), {"fast.counter.hours": "5", "spindle_override_0": "100"}
    paths, wrong = list(expected), []
    for _ in range(100):
        paths.reverse()
        watch.send({"paths": paths})
        watch.until("variables", lambda m: [one["path"] for one in m.get("variables", [])] == paths)
        values = watch.until("values", lambda m: "values" in m)["values"]
        if values != [expected[path] for path in paths]: wrong.append(values)
    check("100 lists of equal length have their own values", not wrong, f"{len(wrong)} have not, such as {wrong[:1]}")
    watch.socket.close()


def watch_and_force(page, port):
    watch = Watch(port)
    watch.send({"paths": ["fast.none"]})
    check("a path that does not exist is a problem", "there is no such variable" in watch.next()["problem"]["detail"])
    watch.send({"paths": ["fast.counter.hours", "spindle_override_0", "%G2968.0"]})
    known = watch.until("variables", lambda m: "variables" in m)["variables"]
    check("the variables are described", [one["path"] for one in known][0] == "fast.counter.hours" and known[1].get("unit") == "%", known)
    sample = watch.until("values", lambda m: "values" in m)
    check("and their values come", sample["values"][0] == "5" and sample["values"][1] == "100" and sample["forced"] == [], sample)
    values_follow_their_list(port)
    page.ask("POST", "/api/plc/force", {"values": [{"path": "fast.counter.hours", "value": "9"}, {"path": "%G2968.0", "value": "TRUE"}]})
    sample = watch.until("forced values", lambda m: m.get("forced") == [0, 2])
    check("forced values are marked", sample["values"][0] == "9" and sample["values"][2] == "TRUE", sample)
    times = page.ask("GET", "/api/plc/tasks")["tasks"]
    check("the tasks have their times", [one["name"] for one in times] == ["scan", "simulation", "fast", "main"] and
          all(0 <= one["last_us"] <= one["worst_us"] and one["budget_us"] == 1000 for one in times), times)
    found = page.ask("GET", "/api/plc/uses?path=fast.counter.hours")
    places = [(one["file"], one["reads"], one["calls"]) for one in found["uses"]]
    check("the places that use a variable come from the compiler", found["total"] == 2 and
          places == [("counter.st", True, False), ("fast.st", False, True)], found)
    check("without a path the field is named", page.ask("GET", "/api/plc/uses", status=400)["field"] == "path")
    check("what does not exist is refused", "no such variable" in page.ask("GET", "/api/plc/uses?path=nothing.x", status=409)["detail"])
    page.until("forces are listed", lambda: len(page.ask("GET", "/api/plc/forces")["values"]) == 2)
    refused = page.ask("POST", "/api/plc/force", {"values": [{"path": "fast.counter.hours", "value": "x"}]}, status=409)
    check("a wrong value is refused with what is expected", "write a whole number 0 .. 4294967295" in refused["detail"], refused)
    check("an unknown field is named", page.ask("POST", "/api/plc/force", {"value": 1}, status=400)["field"] == "value")
    page.ask("POST", "/api/plc/release", {"paths": ["fast.counter.hours"]})
    watch.until("the release", lambda m: m.get("forced") == [2])
    page.ask("POST", "/api/plc/release")
    watch.until("the release of all", lambda m: m.get("forced") == [])
    check("releases are shown", True)
    watch.socket.close()


def trace(page, mdi):
    begun = page.ask("POST", "/api/plc/trace", {"paths": ["fast.counter.n"], "scans": 50, "when": {"path": "fast.counter.n", "is": "changed"}})
    check("a trace begins", begun["variables"][0]["path"] == "fast.counter.n", begun)
    mdi("G53 G1 X1 F3000")
    rows = []
    while len(rows) < 50:
        part = page.until("rows", lambda: (lambda got: got if got["rows"] or got["complete"] else None)(page.ask("GET", f"/api/plc/trace?from={len(rows)}")))
        if not part["rows"]: break
        rows += part["rows"]
    check("it has as many rows as scans", len(rows) == 50, len(rows))
    # The counter adds 1 in each scan while the channel runs. At a standstill in virtual time scans take no time.
    values, times = [int(row["values"][0]) for row in rows], [row["time_ms"] for row in rows]
    check("each scan is a row", values == list(range(values[0], values[0] + 50)) and times == sorted(times), rows[:4])
    page.ask("DELETE", "/api/plc/trace")


def load(page, mdi):
    page.ask("POST", "/api/plc/load", {"files": [{"name": "counter.st", "text": "nonsense"}]})
    status = page.until("errors", lambda: (lambda now: now if now["phase"] == "WITH_ERRORS" else None)(page.ask("GET", "/api/plc/load")))
    check("errors have file and line", any(message.startswith("counter.st:1:") for message in status["messages"]), status)
    names = [one["name"] for one in page.ask("GET", "/api/plc/programs")["files"]]
    texts = {name: page.ask("GET", f"/api/plc/programs/{name}") for name in names}
    texts["counter.st"] = COUNTER.replace("n := n + step;", "n := n + 2 * step;")
    page.ask("POST", "/api/plc/load", {"files": [{"name": name, "text": text} for name, text in texts.items()]})
    page.until("translated", lambda: page.ask("GET", "/api/plc/load")["phase"] == "COMPILED")
    page.ask("POST", "/api/plc/load/compare")
    mdi("G53 G1 X2 F3000")
    status = page.until("a difference", lambda: (lambda now: now if now["differences"] > 0 else None)(page.ask("GET", "/api/plc/load")))
    check("the comparison finds the difference", any("fast.counter.n" in message for message in status["messages"]), status)
    page.ask("POST", "/api/plc/load/take-over", {}, status=409)
    page.ask("POST", "/api/plc/load/take-over", {"accept_differences": True})
    page.until("the new programs", lambda: page.ask("GET", "/api/plc/programs")["changes"] == 1)
    check("they run", "2 * step" in page.ask("GET", "/api/plc/programs/counter.st"))
    check("and those before are kept", page.ask("GET", "/api/plc/programs/counter.st?set=previous") == COUNTER)
    page.ask("POST", "/api/plc/load", {"undo": True})
    page.until("translated", lambda: page.ask("GET", "/api/plc/load")["phase"] == "COMPILED")
    page.ask("DELETE", "/api/plc/load")
    check("a load can be dropped", page.ask("GET", "/api/plc/load")["phase"] == "NO_LOAD")


def main():
    with tempfile.TemporaryDirectory() as scratch:
        machine = pathlib.Path(scratch) / "m"
        shutil.copytree(machines / "ac-table", machine, ignore=shutil.ignore_patterns("recordings"))
        (machine / "plc" / "counter.st").write_text(COUNTER)
        fast = machine / "plc" / "fast.st"
        text = fast.read_text().replace("  stop_latch AT %R0.0 : BOOL;", "  stop_latch AT %R0.0 : BOOL;\n  counter : Counter;", 1)
        text = text.replace("feed_hold := feed_hold_button;", "feed_hold := feed_hold_button;\nIF channel_running_0 THEN counter(step := 1); END_IF;", 1)
        fast.write_text(text)
        up = subprocess.run([trunnion, "up", str(machine), "--free-domain", "--time", "virtual", "--state", scratch + "/state",
                             "--json"], capture_output=True, text=True)
        if up.returncode != 0: sys.exit(up.stdout + up.stderr)
        started = json.loads(up.stdout.splitlines()[-1])
        domain, port = started["domain"], started["port"]

        def mdi(line): subprocess.run([trunnion, "mdi", line, "--domain", str(domain)], check=True, stdout=subprocess.DEVNULL)
        try:
            page = Page(port)
            page.until("the gateway answers", lambda: page.ask("GET", "/api/plc/programs") is not None)
            variables(page)
            sources(page)
            watch_and_force(page, port)
            trace(page, mdi)
            load(page, mdi)
        finally:
            subprocess.run([trunnion, "down", "--domain", str(domain)], stdout=subprocess.DEVNULL)


main()
