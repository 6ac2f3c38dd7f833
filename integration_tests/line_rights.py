#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""line_rights.py TRUNNION MACHINES: what a line of MDI and a program may change, on a cluster in virtual time with users:
a line what the role of who enters it permits, a program that of who stored it. Standard library only."""
import http.client, json, pathlib, shutil, subprocess, sys, tempfile, time

trunnion, machines = sys.argv[1], pathlib.Path(sys.argv[2])
LIMIT = "G10 L50\nN100006 R5000\nG11\n"  # the software travel limit of X, in mm: a parameter of the builder
NEAR = 0.001


def check(what, condition, shown=""):
    if not condition: sys.exit(f"does not hold: {what} {shown}")
    print(f"ok   {what}")


def until(what, condition, seconds=60):  # only ends a hang
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = condition()
        if found: return found
        time.sleep(0.02)
    sys.exit(f"not within {seconds} s: {what}")


class User:
    def __init__(self, port, name, token): self.port, self.name, self.token = port, name, token

    def ask(self, method, path, body=None, expected=200):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        content = body if body is None or isinstance(body, str) else json.dumps(body)
        connection.request(method, path, content, {"Authorization": f"Bearer {self.token}"})
        answer = connection.getresponse()
        content = answer.read()
        if expected and answer.status != expected: sys.exit(f"{self.name}: {method} {path}: {answer.status} {content[:300]!r}")
        return json.loads(content) if content and expected == 200 else answer.status

    def post(self, command, **body): return self.ask("POST", "/api/channels/0/" + command, body)

    def at_rest(self):
        until("the channel is at rest", lambda: self.ask("GET", "/api/channels/0")["state"] == "IDLE")

    def refused(self, start, words):
        """`start` ends with alarm 152 that has these words, and no value is another."""
        before = values(self)
        start()
        alarm = until(words, lambda: next((one for one in self.ask("GET", "/api/alarms")["alarms"] if one["number"] == 152), None))
        check(f"{self.name}: {alarm['text']}", words in alarm["text"], words)
        check("nothing is changed", values(self) == before, (before, values(self)))

        def clear():
            self.post("reset")
            self.ask("POST", "/api/alarms/reset", {})
            return not self.ask("GET", "/api/alarms")["alarms"]
        until("no alarm is left", clear)
        self.at_rest()

    def line(self, *lines):
        def start():
            self.post("mode", mode="MDI")
            for line in lines:
                self.at_rest()
                self.post("mdi", line=line)
        return start

    def program(self, name):
        def start():
            self.post("mode", mode="AUTO")
            until("the program is listed", lambda: self.ask("POST", "/api/channels/0/select", {"program": name}, None) == 200)
            self.post("cycle-start")
        return start


def values(user):
    offsets = user.ask("GET", "/api/work-offsets")["offsets"]
    tools = user.ask("GET", "/api/tools")["tools"]
    parameters = [user.ask("GET", f"/api/parameters/{number}") for number in (100006, 100034)]
    return (*[one.get("pending_value", one["value"]) for one in parameters],  # also before the reset that activates it
            [one["values"] for one in offsets if one["channel"] == 0 and one["index"] == 0],
            [(one["length"], one["radius"]) for one in tools if one["number"] == 1])


def main():
    with tempfile.TemporaryDirectory() as scratch:
        machine, state = pathlib.Path(scratch) / "m", scratch + "/state"
        shutil.copytree(machines / "ac-table", machine, ignore=shutil.ignore_patterns("recordings"))
        with (machine / "machine.yaml").open("a") as file: file.write("auth: on\noperating_right: any\n")
        pathlib.Path(state).mkdir()
        tokens = {}
        for role in ("operator", "setter", "builder"):
            made = subprocess.run([trunnion, "user", "token", role, "--role", role, "--state", state, "--json"], capture_output=True, text=True)
            if made.returncode != 0: sys.exit(made.stdout + made.stderr)
            tokens[role] = json.loads(made.stdout)["token"]
        up = subprocess.run([trunnion, "up", str(machine), "--free-domain", "--time", "virtual", "--state", state, "--json"],
                            capture_output=True, text=True)
        if up.returncode != 0: sys.exit(up.stdout + up.stderr)
        started = json.loads(up.stdout.splitlines()[-1])
        try:
            operator, setter, builder = (User(started["port"], role, tokens[role]) for role in tokens)
            until("the gateway knows the machine", lambda: all(
                builder.ask("GET", path, None, None) != 504 for path in ("/api/channels/0", "/api/work-offsets", "/api/tools", "/api/parameters/100006")))
            until("the machine is ready", lambda: builder.ask("POST", "/api/channels/0/mode", {"mode": "MDI"}, None) == 200)

            needs = "needs the role {}, and this is changed for the role {}"
            for line in ("G10 L2 P1 X5", "#5221=3"):
                operator.refused(operator.line(line), "work offsets need the role setter, and this is changed for the role operator")
            operator.refused(operator.line("G10 L10 P1 R5"), "the tool table " + needs.format("setter", "operator"))
            operator.refused(operator.line("G10 L50", "N100006 R5000"), "parameter 100006 " + needs.format("builder", "operator"))
            setter.refused(setter.line("G10 L50", "N100006 R5000"), "parameter 100006 " + needs.format("builder", "setter"))
            operator.line("G11")()
            operator.at_rest()
            setter.line("G10 L2 P1 X5")()
            until("the setter's work offset", lambda: abs(values(setter)[2][0][0] - 5) < NEAR)
            setter.at_rest()

            setter.ask("PUT", "/api/programs/offset.nc", "G10 L2 P1 X7\nM30\n", None)
            setter.ask("PUT", "/api/programs/limit.nc", LIMIT + "M30\n", None)
            check("an operator stores no program", operator.ask("PUT", "/api/programs/own.nc", LIMIT, None) == 403)
            operator.program("offset.nc")()
            until("the offset by a program that the setter has released", lambda: abs(values(setter)[2][0][0] - 7) < NEAR)
            operator.at_rest()
            for user in (operator, builder):
                user.refused(user.program("limit.nc"), "parameter 100006 " + needs.format("builder", "setter"))
            builder.ask("PUT", "/api/programs/limit.nc", LIMIT + "M30\n", None)
            operator.program("limit.nc")()
            until("the limit by a program that the builder has released", lambda: values(setter)[0] == 5000)
            operator.at_rest()
            builder.line("G10 L50", "N100034 R9000", "G11")()
            until("the builder's line", lambda: values(setter)[1] == 9000)
            journal = "".join(path.read_text(errors="replace") for path in pathlib.Path(state).rglob("*") if path.is_file())
            for who in ("MDI of channel 0 by setter", "MDI of channel 0 by builder", "limit.nc line 2 of channel 0"):
                check(f"the journal names '{who}'", who in journal)
        finally:
            subprocess.run([trunnion, "down", "--domain", str(started["domain"])], stdout=subprocess.DEVNULL)


main()
