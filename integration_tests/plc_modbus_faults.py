#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""plc_modbus_faults.py TRUNNION MACHINES: a PLC with Modbus TCP, as client and server, is killed, swapped and given
another modbus.yaml while a cluster runs in virtual time. The other side knows the protocol from its specification alone
(MODBUS Application Protocol V1.1b3). The recording of all this verifies. Standard library only."""
import json, pathlib, shutil, signal, socket, struct, subprocess, sys, tempfile, threading, time

trunnion, machines = sys.argv[1], pathlib.Path(sys.argv[2])
LAMP = 1  # Y0.0 "ready": TRUE for as long as the machine is not in an emergency stop


def check(what, condition, shown=""):
    if not condition: raise SystemExit(f"does not hold: {what} {shown}")
    print(f"ok   {what}", flush=True)


def until(what, condition, seconds=60):  # only ends a hang
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = condition()
        if found: return found
        time.sleep(0.02)
    raise SystemExit(f"not within {seconds} s: {what}")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def receive(connection, count):
    data = b""
    while len(data) < count:
        part = connection.recv(count - len(data))
        if not part: raise ConnectionError
        data += part
    return data


class Device(threading.Thread):
    """Coils 0..7 that are written, discrete inputs 0..7 that are read."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.inputs, self.written, self.connections = 0, [], 0
        self.listening = socket.create_server(("127.0.0.1", port))

    def run(self):
        while True:
            connection = self.listening.accept()[0]
            self.connections += 1
            try:
                while True: self.answer(connection)
            except OSError: connection.close()

    def answer(self, connection):
        number, _, length, unit = struct.unpack(">HHHB", receive(connection, 7))
        request = receive(connection, length - 1)
        if request[0] == 15:
            self.written.append((time.monotonic(), request[6]))
            answer = request[:5]
        else: answer = bytes([request[0], 1, self.inputs])
        connection.sendall(struct.pack(">HHHB", number, 0, len(answer) + 1, unit) + answer)


def ask(port, request):
    """Function and data of the answer; None without a server."""
    try:
        with socket.create_connection(("127.0.0.1", port), timeout=20) as connection:
            connection.sendall(struct.pack(">HHHB", 7, 0, len(request) + 1, 1) + request)
            length = struct.unpack(">HHHB", receive(connection, 7))[2]
            return receive(connection, length - 1)
    except OSError: return None


def write_coil(port, address, on): return ask(port, struct.pack(">BHH", 5, address, 0xFF00 if on else 0))
def read_inputs(port, address):
    answer = ask(port, struct.pack(">BHH", 2, address, 8))
    return answer[2] if answer and answer[0] == 2 else None


def file_for(device, server, address, more=""):
    return f"""devices:
  valves:
    host: 127.0.0.1
    port: {device}
    period_ms: 20
    timeout_ms: 5000
    inputs:
      - {{table: discrete_inputs, address: 0, count: 8, at: X40}}
    outputs:
      - {{table: coils, address: 0, count: 8, at: Y0}}
{more}server:
  port: {server}
  inputs:
    - {{table: coils, address: 0, count: 8, at: X41}}
  outputs:
    - {{table: discrete_inputs, address: {address}, count: 8, at: Y0}}
"""


def main(work):
    machine, state = work / "m", work / "state"
    shutil.copytree(machines / "ac-table", machine, ignore=shutil.ignore_patterns("recordings"))
    text = (machine / "machine.yaml").read_text()
    (machine / "machine.yaml").write_text("".join(line for line in text.splitlines(True) if "gateway" not in line))
    device_port, server_port = free_port(), free_port()
    (machine / "plc" / "modbus.yaml").write_text(file_for(device_port, server_port, 0))
    device = Device(device_port)
    device.start()
    up = subprocess.run([trunnion, "up", machine, "--free-domain", "--time", "virtual", "--state", state, "--json"],
                        capture_output=True, text=True)
    check("the cluster starts", up.returncode == 0, up.stdout + up.stderr)
    domain = str(json.loads(up.stdout.splitlines()[-1])["domain"])

    def run(*words): return subprocess.run([trunnion, *words, "--domain", domain], capture_output=True, text=True)
    def pid():
        status = json.loads(run("status", "--json").stdout)
        return next((s["pid"] for s in status["services"] if s["service"] == "plc"), 0)
    def value(path):
        out = run("plc", "watch", path, "--count", "1").stdout
        return out.strip().rsplit(" = ", 1)[-1]
    def steady(since, what):
        wrong = [hex(byte) for at, byte in device.written if at >= since and not byte & LAMP]
        check(f"{what}: the output is never written otherwise", not wrong, wrong)

    recorder = None
    try:
        until("the output is at the device", lambda: device.written and device.written[-1][1] & LAMP)
        until("and at the server", lambda: (read_inputs(server_port, 0) or 0) & LAMP)
        since = time.monotonic()
        recorder = subprocess.Popen([trunnion, "record", work / "r.mcap", "--domain", domain],
                                    stdout=subprocess.DEVNULL, stderr=(work / "record").open("w"))
        until("the recording begins", lambda: (work / "r.mcap").exists() and (work / "r.mcap").stat().st_size > 0)
        device.inputs = 1
        check("others write an input", write_coil(server_port, 1, True) is not None)
        until("inputs are there", lambda: value("%X40") == "1" and value("%X41") == "2")

        for how in ("kill -9", "swap"):
            before, made = pid(), device.connections
            moving = subprocess.Popen([trunnion, "mdi", f"G53 G1 X{20 if how == 'swap' else 10} F2000", "--domain", domain],
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            if how == "swap":
                swapped = run("swap", "plc")
                check("the swap is made", swapped.returncode == 0, swapped.stdout + swapped.stderr)
            else: subprocess.run(["kill", "-9", str(before)], check=True)
            device.inputs |= 2 if how == "swap" else 4  # while nobody asks
            until(f"{how}: another process", lambda: pid() not in (0, before))
            until(f"{how}: it has connected again", lambda: device.connections > made)
            until(f"{how}: others find the server", lambda: (read_inputs(server_port, 0) or 0) & LAMP)
            until(f"{how}: what has changed meanwhile is there", lambda: value("%X40") == str(device.inputs))
            check(f"{how}: what others have written is kept", value("%X41") == "2", value("%X41"))
            moving.wait()
            steady(since, how)

        new = work / "next"
        shutil.copytree(machine / "plc", new)
        (new / "modbus.yaml").write_text(file_for(device_port, server_port, 0).replace("at: X41", "at: Z41"))
        wrong = run("plc", "load", str(new))
        check("a wrong modbus.yaml is refused with its place", wrong.returncode == 1 and "modbus.yaml:14:" in wrong.stdout,
              wrong.stdout + wrong.stderr)
        check("and nothing has changed", "0 online changes" in run("plc", "programs").stdout and (read_inputs(server_port, 0) or 0) & LAMP)
        (new / "modbus.yaml").write_text(file_for(device_port, server_port, 40))
        made = device.connections
        loaded = run("plc", "load", str(new))
        check("a new modbus.yaml is loaded", loaded.returncode == 0, loaded.stdout + loaded.stderr)
        check("what changes is said before", "Modbus: the server changes" in loaded.stdout and "valves" not in loaded.stdout, loaded.stdout)
        until("the server has the new addresses", lambda: (read_inputs(server_port, 40) or 0) & LAMP)
        check("and refuses the old ones", read_inputs(server_port, 0) is None)
        check("the connection to the device has gone on", device.connections == made)
        subprocess.run(["kill", "-9", str(pid())], check=True)
        until("after a kill the loaded file counts", lambda: (read_inputs(server_port, 40) or 0) & LAMP)
        undone = run("plc", "load", "--undo")
        check("the load is undone", undone.returncode == 0, undone.stdout + undone.stderr)
        until("the server has the old addresses", lambda: (read_inputs(server_port, 0) or 0) & LAMP)
        check("an input still comes", write_coil(server_port, 1, False) is not None)
        until("an input still comes", lambda: value("%X41") == "0")
        steady(since, "all in all")
        recorder.send_signal(signal.SIGINT)
        check("the recording ends", recorder.wait(60) == 0, (work / "record").read_text())
        recorder = None
        verified = subprocess.run([trunnion, "verify", "--service", "plc", "--recording", work / "r.mcap", "--machine", machine],
                                  capture_output=True, text=True)
        check("the recording verifies", verified.returncode == 0, verified.stdout + verified.stderr)
    finally:
        if recorder: recorder.kill()
        subprocess.run([trunnion, "down", "--domain", domain], capture_output=True)


with tempfile.TemporaryDirectory() as directory: main(pathlib.Path(directory))
