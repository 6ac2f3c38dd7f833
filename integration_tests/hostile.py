#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Attacks the gateway, the MTConnect agent and the Modbus server of a cluster of its own while a program runs in real time,
over 127.0.0.1 only and for a limited time. Meanwhile a user holds and continues the program, each by a connection of its
own, and a page shows the machine. It fails with a line that names attack, figure and limit. What holds on a busy computer
holds; what does not counts when the computer let threads run, or cannot have caused it, and is measured again otherwise.
Status 77: it was too busy five times. Standard library only."""
import argparse, http.client, itertools, json, multiprocessing, os, pathlib, resource, shutil, signal, socket, struct
import subprocess, sys, tempfile, threading, time

sys.dont_write_bytecode = True  # leaves nothing in the tree
import hostile_attacks
from hostile_attacks import HOST, attacks, head_of, upgrade

STOP_MS, PAGE_MS, GROWTH = 100, 1000, 0.10  # limits: answer to a stop order, silence of a page, memory of the gateway
CYCLIC_MS, ORDINARY_MS = 16, 50  # for which the computer may keep threads from running: half of the lead; half of STOP_MS
THREADS = 5  # that an order passes: station, connection, bus, channel and back; each may be kept
MEASUREMENTS, NO_MEASUREMENT = 5, 77
ENDLESS = "G54 G90 G94\nWHILE 1 DO 1\nG1 X20 F600\nG1 X-20\nEND 1\nM30\n"


class Failed(Exception): pass


def until(what, condition, seconds=60):  # only ends a hang
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = condition()
        if found: return found
        time.sleep(0.05)
    raise Failed(f"not within {seconds} s: {what}")


def free_port():
    with socket.socket() as one:
        one.bind((HOST, 0))
        return one.getsockname()[1]


class Cluster:
    """A delivered machine with users, a Modbus server and an endless program."""

    def __init__(self, trunnion, machines, scratch, virtual):
        self.trunnion, self.state, machine = trunnion, scratch / "state", scratch / "m"
        self.ports = {"mtconnect": free_port(), "modbus": free_port()}
        shutil.copytree(machines / "ac-table", machine, ignore=shutil.ignore_patterns("recordings"))
        with (machine / "machine.yaml").open("a") as file:
            file.write(f"auth: on\noperating_right: any\nmtconnect_port: {self.ports['mtconnect']}\n")
        (machine / "plc" / "modbus.yaml").write_text(f"server:\n  port: {self.ports['modbus']}\n  outputs:\n"
                                                     "    - {table: discrete_inputs, address: 0, count: 8, at: Y0}\n")
        (machine / "programs" / "endless.nc").write_text(ENDLESS)
        self.state.mkdir()
        self.command("user", "add", "miller", "--role", "operator", "--state", self.state, words="a long password\n")
        self.tokens = {role: json.loads(self.command("user", "token", role, "--role", role, "--state", self.state, "--json"))["token"]
                       for role in ("operator", "setter", "builder")}
        time_of = ("--time", "virtual") if virtual else ()
        up = json.loads(self.command("up", machine, "--free-domain", "--state", self.state, "--json", *time_of).splitlines()[-1])
        self.domain, self.ports["http"] = str(up["domain"]), up["port"]

    def command(self, *words_of_it, words=None):
        done = subprocess.run([self.trunnion, *map(str, words_of_it)], input=words, capture_output=True, text=True)
        if done.returncode != 0: raise Failed(f"trunnion {words_of_it[0]}: {done.stdout}{done.stderr}")
        return done.stdout

    def down(self): subprocess.run([self.trunnion, "down", "--domain", self.domain], stdout=subprocess.DEVNULL)

    def ask(self, method, path, body=None, token="builder", limit=60):
        """Status and body of the answer."""
        connection = http.client.HTTPConnection(HOST, self.ports["http"], timeout=limit)
        try:
            headers = {"Authorization": f"Bearer {self.tokens[token]}"} if token else {}
            connection.request(method, path, None if body is None else json.dumps(body), headers)
            answer = connection.getresponse()
            text = answer.read()
        finally: connection.close()
        return answer.status, json.loads(text) if text[:1] in (b"{", b"[") else {}

    def alarms(self): return [f"alarm {one['number']}: {one['text']}" for one in self.ask("GET", "/api/alarms")[1].get("alarms", ())]

    def run_program(self):
        """From whatever state the attack before has left."""
        def runs():
            try:
                state = self.ask("GET", "/api/channels/0")[1].get("state")
                if state == "RUNNING": return True
                self.ask("POST", "/api/channels/0/reset", {})
                self.ask("POST", "/api/alarms/reset", {})
                for order, body in (("mode", {"mode": "AUTO"}), ("select", {"program": "endless.nc"}), ("cycle-start", {})):
                    self.ask("POST", "/api/channels/0/" + order, body)
            except (OSError, http.client.HTTPException): pass
            time.sleep(0.2)
            return False
        until("the program runs", runs)

    def processes(self):
        status = subprocess.run([self.trunnion, "status", "--json", "--domain", self.domain], capture_output=True, text=True)
        return {one["service"]: one["pid"] for one in json.loads(status.stdout)["services"]}

    def starved(self):
        """Periods without a setpoint since the start: of a batch that is newer than the history of the topic, 1024 batches."""
        batches = self.command("topic", "echo", "feedback", "--count", 1200, "--timeout", 10, "--json", "--domain", self.domain)
        return json.loads(batches.splitlines()[-1])["starved"]

    def kept(self):
        """What only those with the right change."""
        return [self.ask("GET", path)[1] for path in ("/api/parameters", "/api/tools", "/api/work-offsets", "/api/programs", "/api/plc/forces")]


def memory(pid):
    """MB that a process has in the main memory."""
    try: lines = pathlib.Path(f"/proc/{pid}/status").read_text().splitlines()
    except OSError: return 0.0
    return next((int(line.split()[1]) / 1024 for line in lines if line.startswith("VmRSS")), 0.0)


def few_descriptors(pid, left):
    before = resource.prlimit(pid, resource.RLIMIT_NOFILE)
    used = set(map(int, os.listdir(f"/proc/{pid}/fd")))
    # One that it was given by whoever started it may have a high number, so the free ones are counted.
    limit = next(itertools.islice((n + 1 for n in itertools.count() if n not in used), left - 1, None))
    resource.prlimit(pid, resource.RLIMIT_NOFILE, (limit, before[1]))
    return before


class Witness:
    """For how long the computer kept threads from running that were due every millisecond, ms: on every processor one with
    the priority of the cyclic services, when it may have it, and one without (host_witness.cpp)."""

    def __init__(self):
        fork, kinds = multiprocessing.get_context("fork"), (True, False)
        self.longest = fork.Array("d", 2, lock=False)
        self.processes = [fork.Process(target=self.watch, args=(processor, cyclic), daemon=True)
                          for processor in os.sched_getaffinity(0) for cyclic in kinds]
        for process in self.processes: process.start()

    def watch(self, processor, cyclic):
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        os.sched_setaffinity(0, {processor})
        try: os.sched_setscheduler(0, os.SCHED_FIFO if cyclic else os.SCHED_OTHER, os.sched_param(20 if cyclic else 0))
        except OSError: pass  # refused here, it is refused to the services, too
        due = time.monotonic()
        while True:
            due = max(due + 0.001, time.monotonic())
            time.sleep(max(0, due - time.monotonic()))
            late = 1000 * (time.monotonic() - due)
            if late > self.longest[not cyclic]: self.longest[not cyclic] = late

    def end(self):
        for process in self.processes: process.terminate()
        for process in self.processes: process.join()
        return tuple(self.longest)


class Station:
    """What people and machines of the plant do meanwhile: stop orders and their continuation, a page that stays, and new
    pages and Modbus clients. `longest` has ms, `unanswered` what got none or a refusal."""

    def __init__(self, cluster):
        self.cluster, self.over, self.orders = cluster, threading.Event(), 0
        self.longest, self.unanswered = {"stop": 0.0, "page": 0.0, "modbus": 0.0}, []
        self.threads = [threading.Thread(target=one, daemon=True) for one in (self.press_keys, self.show_page, self.come_and_go)]
        for thread in self.threads: thread.start()

    def end(self):
        self.over.set()
        for thread in self.threads: thread.join(30)

    def took(self, kind, since): self.longest[kind] = max(self.longest[kind], 1000 * (time.monotonic() - since))

    def timed(self, kind, act):
        since = time.monotonic()
        try: refused = act()
        except (OSError, http.client.HTTPException) as error: refused = str(error) or type(error).__name__
        if refused and not self.over.is_set(): self.unanswered.append(f"a {kind} got no answer: {refused}")
        self.took(kind.split()[0], since)

    def press_keys(self):
        def hold():
            status, answer = self.cluster.ask("POST", "/api/channels/0/feed-hold", {}, None, 20)
            if status != 200: return f"{status} {answer.get('detail', answer)}"
        while not self.over.is_set():
            begin = time.monotonic()
            self.timed("stop order", hold)
            self.orders += 1
            self.over.wait(max(0, 0.05 - (time.monotonic() - begin)))
            try: self.cluster.ask("POST", "/api/channels/0/cycle-start", {}, "operator", 20)
            except (OSError, http.client.HTTPException): pass
            self.over.wait(max(0, 0.1 - (time.monotonic() - begin)))

    def open_page(self):
        page = socket.create_connection((HOST, self.cluster.ports["http"]), timeout=20)
        page.sendall(upgrade("/api/stream", self.cluster.tokens["operator"]))
        status, text = head_of(page)
        if status == 101: return page
        page.close()
        raise ConnectionError(f"status {status} {text.split(chr(10).encode())[-1][:200].decode(errors='replace')}")

    def show_page(self):
        """A page that is closed opens its stream again, as in a browser; until then it is silent."""
        page, heard = None, time.monotonic()
        while not self.over.is_set():
            try:
                page = page or self.open_page()
                page.settimeout(0.2)
                if not page.recv(1 << 20): raise ConnectionError
                self.took("page", heard)
                heard = time.monotonic()
            except TimeoutError: pass
            except OSError:
                if page: page.close()
                page = None
                self.over.wait(0.05)
        self.took("page", heard)

    def come_and_go(self):
        def page():
            with self.open_page() as one: one.recv(1)
        def modbus():
            with socket.create_connection((HOST, self.cluster.ports["modbus"]), timeout=20) as one:
                one.sendall(struct.pack(">HHHBBHH", 1, 0, 6, 1, 2, 0, 8))
                if not one.recv(260): return "closed"
        while not self.over.is_set():
            self.timed("page that is opened", page)
            self.timed("modbus client", modbus)
            self.over.wait(0.3)


def measure(cluster, name, seconds, virtual):
    cluster.run_program()
    before, kept = cluster.processes(), cluster.kept()
    row = {"attack": name, "starved": 0 if virtual else -cluster.starved(), "memory_before": memory(before["gateway"])}
    limit = few_descriptors(before["gateway"], 32) if attacks[name].few_descriptors else None
    witness = Witness()
    running = hostile_attacks.Running(name, {"ports": cluster.ports, "tokens": cluster.tokens, "changes": cluster.changes}, seconds)
    station = Station(cluster)
    while running.runs() and not running.result.poll(0.1): pass
    station.end()
    row.update(running.end())
    row["waited"] = witness.end()
    if limit and memory(before["gateway"]): resource.prlimit(before["gateway"], resource.RLIMIT_NOFILE, limit)
    row.update(orders=station.orders, longest=station.longest, unanswered=station.unanswered)
    try: row["alarms"] = cluster.alarms()
    except (OSError, http.client.HTTPException): row["alarms"] = []  # its end is said below
    row["ended"] = sorted(service for service, pid in before.items() if cluster.processes().get(service) != pid)
    if not virtual: row["starved"] += cluster.starved()
    row["memory_after"] = settled_memory(before["gateway"], row["memory_before"])
    row["changed"] = kept != cluster.kept()
    return row


def settled_memory(pid, before):
    """Connections that were left end within 30 s."""
    end = time.monotonic() + 40
    while time.monotonic() < end and memory(pid) > (1 + GROWTH) * before: time.sleep(0.5)
    return memory(pid)


def certain_problems(row, smoke):
    """What does not hold, whatever the computer did."""
    found = [f"the service {service} has ended" for service in row["ended"]] + row["broken"]
    if row["connections"] == 0: found.append("made no connection: nothing was tried")
    elif row["sent_bytes"] == 0 and not attacks[row["attack"]].silent: found.append("sent nothing: nothing was tried")
    if row["orders"] == 0: found.append("no stop order was sent: nothing was measured")
    if row["changed"]: found.append("parameters, tools, work offsets, programs or forced values are others than before")
    if not smoke and row["memory_after"] > (1 + GROWTH) * row["memory_before"] > 0:
        found.append(f"the gateway has grown from {row['memory_before']:.1f} MB to {row['memory_after']:.1f} MB, limit {GROWTH:.0%}")
    return found


def timed_problems(row):
    """What a busy computer may have caused, and whether it cannot have caused one of them."""
    cyclic, ordinary = row["waited"]
    quiet = cyclic <= CYCLIC_MS and ordinary <= ORDINARY_MS
    found, certain = [], quiet
    for kind, limit, what in (("stop", STOP_MS, f"the slowest of {row['orders']} stop orders took"), ("page", PAGE_MS, "a page was silent for"),
                              ("modbus", PAGE_MS, "a Modbus client waited")):
        took = row["longest"][kind]
        if took <= limit: continue
        found.append(f"{what} {took:.0f} ms, limit {limit} ms")
        certain = certain or took > limit + THREADS * ordinary
    if row["starved"]:
        found.append(f"{row['starved']} starved periods, limit 0")
        certain = certain or cyclic <= CYCLIC_MS
    if row["unanswered"]: found.append(f"{len(row['unanswered'])} orders or pages without an answer, limit 0; first: {row['unanswered'][0]}")
    return found + row["alarms"], certain


HEADER = ("attack", "connections", "orders", "stop[ms]", "page[ms]", "starved", "MB before", "MB after", "ended")


def print_row(row):
    print(f"{row['attack']:<18}{row['connections']:>12}{row['orders']:>8}{row['longest']['stop']:>10.0f}{row['longest']['page']:>10.0f}"
          f"{row['starved']:>9}{row['memory_before']:>11.1f}{row['memory_after']:>10.1f}  {' '.join(row['ended']) or '-'}", flush=True)


def tried(cluster, name, options):
    """The row of the attack with its `problems`; None when the computer was too busy."""
    for number in range(1, MEASUREMENTS + 1):
        row = measure(cluster, name, options.seconds, options.smoke)
        row["measurements"], row["problems"] = number, certain_problems(row, options.smoke)
        timed, certain = ([], True) if options.smoke else timed_problems(row)
        if not options.json: print_row(row)
        if certain or row["problems"] or not timed:
            row["problems"] += timed
            return row
        print(f"hostile: {name}: {timed[0]}: measurement {number} is none: the computer kept threads waiting up to {row['waited'][0]:.0f} ms "
              f"with priority (limit {CYCLIC_MS}), {row['waited'][1]:.0f} ms without (limit {ORDINARY_MS})", file=sys.stderr, flush=True)
    return None


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__, epilog="attacks: " + "; ".join(f"{name}: {one.about}" for name, one in attacks.items()))
    parser.add_argument("--trunnion", default=root / "build/release/bin/trunnion", help="the command (default: of build/release)")
    parser.add_argument("--attack", action="append", choices=attacks, metavar="NAME", help="this one; may be repeated (default: all)")
    parser.add_argument("--seconds", type=float, default=5, help="of each attack, 1 to 3600 (default: 5)")
    parser.add_argument("--smoke", action="store_true", help="in virtual time; judges no times and no memory")
    parser.add_argument("--json", action="store_true", help="the table as JSON")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))  # its cluster ends with it
    if not 1 <= options.seconds <= 3600: parser.error("--seconds: 1 to 3600")
    rows, unmeasured = [], []
    with tempfile.TemporaryDirectory() as scratch:
        cluster = Cluster(options.trunnion, root / "configs/machines", pathlib.Path(scratch), options.smoke)
        try:
            interface = cluster.ask("GET", "/api/openapi.json")[1]["paths"]
            cluster.changes = [(method.upper(), path.replace("{channel}", "0").replace("{number}", "1").replace("{name}", "none.nc"))
                               for path, methods in interface.items() for method in methods if method in ("post", "put", "delete")]
            if not options.json: print("{:<18}{:>12}{:>8}{:>10}{:>10}{:>9}{:>11}{:>10}  {}".format(*HEADER))
            for name in options.attack or attacks:
                row = tried(cluster, name, options)
                if row is None: unmeasured.append(name)
                else: rows.append(row)
        finally: cluster.down()
    if options.json: print(json.dumps(rows, indent=2))
    failed = [f"hostile: {row['attack']}: {problem}" for row in rows for problem in row["problems"]]
    for line in failed: print(line, file=sys.stderr)
    if unmeasured: print(f"hostile: the computer was too busy in all {MEASUREMENTS} measurements of {', '.join(unmeasured)}", file=sys.stderr)
    sys.exit(1 if failed else NO_MEASUREMENT if unmeasured else 0)


if __name__ == "__main__":
    try: main()
    except Failed as failure: sys.exit(f"hostile: {failure}")
