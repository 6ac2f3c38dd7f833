#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""An independent client of the MTConnect agent: the real gateway beside a fake cluster, asked with Python's standard library.

With MTCONNECT_SCHEMAS (a directory with MTConnectDevices_2.4_1.0.xsd and so on) every document is also validated by
xmllint; without it the structure alone is checked here: names, required attributes, references between documents.
"""
import glob, http.client, json, os, re, shutil, socket, subprocess, sys, tempfile, threading, time, unittest
import xml.etree.ElementTree as ET

GATEWAY, FAKE, MACHINE, DOMAIN = os.environ["GATEWAY"], os.environ["FAKE_CLUSTER"], os.environ["MACHINE"], os.environ.get("DOMAIN", "52")
SCHEMAS = os.environ.get("MTCONNECT_SCHEMAS", "")
VERSION = "2.4"
validated = {}


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def local(tag): return tag.rsplit("}", 1)[-1]


def validate(text):
    """Against the official schema, when there is one."""
    kind = re.search(r"<MTConnect(\w+)", text).group(1)
    if SCHEMAS:
        schema = os.path.join(SCHEMAS, f"MTConnect{kind}_{VERSION}_1.0.xsd")
        result = subprocess.run(["xmllint", "--nonet", "--noout", "--schema", schema, "-"], input=text.encode(), capture_output=True)
        if result.returncode: raise AssertionError(result.stderr.decode()[:2000] + "\n" + text[:3000])
        validated[kind] = validated.get(kind, 0) + 1
    root = ET.fromstring(text)
    assert root.tag == f"{{urn:mtconnect.org:MTConnect{kind}:{VERSION}}}MTConnect{kind}", root.tag
    header = root[0]
    assert local(header.tag) == "Header"
    required = {"creationTime", "sender", "instanceId", "version"}
    required |= {"Streams": {"bufferSize", "firstSequence", "lastSequence", "nextSequence", "deviceModelChangeTime"},
                 "Devices": {"bufferSize", "assetBufferSize", "assetCount", "deviceModelChangeTime"},
                 "Assets": {"assetBufferSize", "assetCount", "deviceModelChangeTime"}, "Error": {"bufferSize"}}[kind]
    assert required <= set(header.attrib), required - set(header.attrib)
    assert header.get("version") == VERSION
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z", header.get("creationTime"))
    return root


def find_all(root, name): return [one for one in root.iter() if local(one.tag) == name]


class Agent(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.mkdtemp(prefix="trunnion-mtconnect-")
        cls.port, cls.web = free_port(), free_port()
        cls.processes = [
            subprocess.Popen([FAKE, DOMAIN], stdout=subprocess.DEVNULL),
            subprocess.Popen([GATEWAY, "--machine", MACHINE, "--state", cls.scratch, "--domain", DOMAIN, "--instance", "20",
                              "--port", str(cls.web), "--mtconnect-port", str(cls.port)])]
        until = time.monotonic() + 30
        while time.monotonic() < until:
            try:
                status, text, _ = cls.ask("/probe")
                if status == 200: return
            except OSError:
                pass
            time.sleep(0.05)
        cls.tearDownClass()
        raise AssertionError("the agent does not answer")

    @classmethod
    def tearDownClass(cls):
        for process in cls.processes:
            process.terminate()
            process.wait()
        shutil.rmtree(cls.scratch)

    @classmethod
    def ask(cls, target, method="GET"):
        connection = http.client.HTTPConnection("127.0.0.1", cls.port, timeout=20)
        connection.request(method, target)
        answer = connection.getresponse()
        text = answer.read().decode()
        connection.close()
        return answer.status, text, answer.headers

    def document(self, target):
        status, text, headers = self.ask(target)
        self.assertEqual(status, 200, text)
        self.assertTrue(headers["Content-Type"].startswith("text/xml"))
        return validate(text)

    def error(self, target, status, code, method="GET"):
        got, text, _ = self.ask(target, method)
        self.assertEqual(got, status, text)
        root = validate(text)
        errors = find_all(root, "Error")
        self.assertEqual([one.get("errorCode") for one in errors], [code], text)
        self.assertTrue(errors[0].text)

    def order(self, path, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.web, timeout=20)
        connection.request("POST", "/api/" + path, json.dumps(body or {}))
        status = connection.getresponse().status
        connection.close()
        self.assertEqual(status, 200)

    def items(self):
        """Data items of the device by id, from the probe."""
        return {one.get("id"): one for one in find_all(self.document("/probe"), "DataItem")}

    def observations(self, root):
        found = [one for stream in find_all(root, "ComponentStream") for group in stream for one in group]
        return sorted(found, key=lambda one: int(one.get("sequence")))

    def current(self, item, target="/current"):
        return [one for one in self.observations(self.document(target)) if one.get("dataItemId") == item]

    def eventually(self, what):
        until = time.monotonic() + 20
        while time.monotonic() < until:
            if what(): return
            time.sleep(0.05)
        self.fail("it does not come about")

    def test_the_probe_describes_axes_controller_and_path(self):
        root = self.document("/probe")
        device = find_all(root, "Device")[0]
        self.assertEqual(device.get("name"), "gateway-test")
        self.assertEqual([one.get("name") for one in find_all(root, "Linear")], ["X", "Y", "Z"])
        self.assertEqual([one.get("name") for one in find_all(root, "Rotary")], ["A", "C"])
        self.assertEqual([one.get("name") for one in find_all(root, "Path")], ["Mill"])
        ids = [one.get("id") for one in root.iter() if one.get("id")]
        self.assertEqual(len(ids), len(set(ids)), "every id is unique")
        types = {(one.get("type"), one.get("subType")) for one in find_all(root, "DataItem")}
        for wanted in [("AVAILABILITY", None), ("EMERGENCY_STOP", None), ("EXECUTION", None), ("CONTROLLER_MODE", None),
                       ("PROGRAM", None), ("PATH_FEEDRATE", "ACTUAL"), ("PATH_FEEDRATE_OVERRIDE", "PROGRAMMED"),
                       ("POSITION", "ACTUAL"), ("ANGLE", "ACTUAL"), ("SYSTEM", None), ("TOOL_NUMBER", None)]:
            self.assertIn(wanted, types)
        for target in ("/", "/gateway-test", "/gateway-test/probe", "/" + device.get("uuid") + "/probe"):
            self.assertEqual(len(find_all(self.document(target), "DataItem")), len(types) and len(find_all(root, "DataItem")))

    def test_current_has_every_item_once_and_follows_the_machine(self):
        items = self.items()
        seen = self.observations(self.document("/current"))
        self.assertEqual({one.get("dataItemId") for one in seen}, set(items))
        for one in seen:
            item = items[one.get("dataItemId")]
            if item.get("category") == "CONDITION":
                self.assertIn(local(one.tag), ("Normal", "Warning", "Fault", "Unavailable"))
                self.assertEqual(one.get("type"), item.get("type"))
            else:
                self.assertEqual(local(one.tag), "".join(part.capitalize() for part in item.get("type").split("_")))
                self.assertEqual(one.get("subType"), item.get("subType"))
        self.order("channels/0/cycle-start")
        self.eventually(lambda: self.current("path0_execution")[0].text == "ACTIVE")
        # The fake machine turns at 1800 mm/min, which are 30 mm/s.
        self.eventually(lambda: self.current("path0_feed")[0].text == "30")
        self.order("channels/0/feed-hold")
        self.eventually(lambda: self.current("path0_execution")[0].text == "FEED_HOLD")
        self.order("channels/0/override", {"kind": "feed", "value": 0.5})
        self.eventually(lambda: self.current("path0_feed_override")[0].text == "50")
        self.order("channels/0/override", {"kind": "feed", "value": 1})
        self.order("channels/0/reset")
        self.assertEqual(self.current("path0_program")[0].text, "CIRCLE.NC")
        self.assertEqual(self.current("path0_tool_asset")[0].text, "T3")

    def test_alarms_are_conditions_until_they_are_reset(self):
        active = self.current("path0_motion") + self.current("controller_system")
        warnings = [one for one in active if local(one.tag) == "Warning"]
        self.assertEqual([one.get("nativeCode") for one in warnings], ["102/0"])
        self.assertIn("Redundancy lost", warnings[0].text)
        before = int(self.document("/current")[0].get("lastSequence"))
        self.order("alarms/reset")
        self.eventually(lambda: all(local(one.tag) == "Normal" for one in self.current("path0_motion") + self.current("controller_system")))
        again = self.document(f"/current?at={before}")
        self.assertIn("102/0", [one.get("nativeCode") for one in self.observations(again)], "at looks back")

    def test_sample_pages_through_the_buffer_without_a_gap(self):
        self.order("channels/0/cycle-start")
        self.eventually(lambda: int(self.document("/current")[0].get("lastSequence")) > 300)
        self.order("channels/0/reset")
        first = int(self.document("/sample?count=1")[0].get("firstSequence"))
        seen, at = [], first
        for _ in range(20):
            root = self.document(f"/sample?from={at}&count=17")
            page = [int(one.get("sequence")) for one in self.observations(root)]
            self.assertEqual(page, list(range(at, at + len(page))))
            self.assertLessEqual(len(page), 17)
            self.assertEqual(int(root[0].get("nextSequence")), at + len(page))
            seen += page
            at = int(root[0].get("nextSequence"))
        self.assertEqual(seen, list(range(first, first + len(seen))))
        back = self.document(f"/sample?from={first + 30}&count=-10")
        self.assertEqual([int(one.get("sequence")) for one in self.observations(back)], list(range(first + 21, first + 31)))

    def test_current_at_is_the_replay_of_the_samples(self):
        self.order("channels/0/cycle-start")
        self.eventually(lambda: int(self.document("/current")[0].get("lastSequence")) > 400)
        self.order("channels/0/reset")
        root = self.document("/sample?count=400")
        first = int(root[0].get("firstSequence"))
        self.assertEqual(first, 1, "the buffer has everything since the start")
        items, replay = self.items(), {}
        for one in self.observations(root):
            if items[one.get("dataItemId")].get("category") == "CONDITION": continue
            replay[one.get("dataItemId")] = (one.get("sequence"), one.text)
        last = self.observations(root)[-1].get("sequence")
        then = {one.get("dataItemId"): (one.get("sequence"), one.text) for one in self.observations(self.document(f"/current?at={last}"))
                if items[one.get("dataItemId")].get("category") != "CONDITION"}
        self.assertEqual(then, replay)

    def test_a_path_chooses_data_items(self):
        def ids(path): return {one.get("dataItemId") for one in self.observations(self.document("/current?path=" + path))}
        self.assertEqual(ids("//Linear[@name=%22X%22]//DataItem[@type=%22POSITION%22%20and%20@subType=%22ACTUAL%22]"), {"axis0_position"})
        self.assertEqual(ids("//Path"), {name for name in self.items() if name.startswith("path0_")})
        self.assertEqual(ids("//DataItem[@category=%22CONDITION%22]"), {name for name, one in self.items().items() if one.get("category") == "CONDITION"})
        self.assertEqual(ids("//Linear[@name=%22X%22]|//Linear[@name=%22Y%22]"), {name for name in self.items() if re.match("axis[01]_", name)})

    def test_errors_are_documents(self):
        for target, status, code in [
            ("/nothing", 404, "NO_DEVICE"), ("/other/probe", 404, "NO_DEVICE"), ("/gateway-test/nothing", 404, "INVALID_URI"),
            ("/current/more", 404, "INVALID_URI"), ("/current?path=//[", 400, "INVALID_PATH"), ("/current?path=//Door", 400, "INVALID_PATH"),
            ("/current?path=", 400, "INVALID_PATH"), ("/current?at=999999999", 400, "OUT_OF_RANGE"), ("/current?at=x", 400, "INVALID_REQUEST"),
            ("/current?at=1&interval=100", 400, "INVALID_REQUEST"), ("/sample?count=0", 400, "OUT_OF_RANGE"),
            ("/sample?count=99999999", 400, "OUT_OF_RANGE"), ("/sample?from=999999999", 400, "OUT_OF_RANGE"),
            ("/sample?from=-1", 400, "OUT_OF_RANGE"), ("/sample?interval=-1", 400, "OUT_OF_RANGE"),
            ("/sample?from=1&from=2", 400, "INVALID_REQUEST"), ("/sample?other=1", 400, "INVALID_REQUEST"),
            ("/sample?interval=100&from=999999999", 400, "OUT_OF_RANGE"), ("/assets/T99", 404, "ASSET_NOT_FOUND"),
            ("/%zz", 404, "INVALID_URI")]:
            with self.subTest(target): self.error(target, status, code)
        self.error("/probe", 405, "UNSUPPORTED", method="POST")

    def test_assets_are_the_tools(self):
        root = self.document("/assets")
        tools = {one.get("assetId"): one for one in find_all(root, "CuttingTool")}
        self.assertEqual(set(tools), {"T3", "T4"})
        lengths = {name: float(find_all(one, "FunctionalLength")[0].text) for name, one in tools.items()}
        self.assertEqual(lengths, {"T3": 112.25, "T4": 98.48})  # 98.5 - 0.02 of wear
        diameters = {name: float(find_all(one, "CuttingDiameterMax")[0].text) for name, one in tools.items()}
        self.assertEqual(diameters, {"T3": 10, "T4": 16.02})  # 2 (8 + 0.01)
        self.assertEqual([one.get("assetId") for one in find_all(self.document("/asset/T4"), "CuttingTool")], ["T4"])
        self.assertEqual(len(find_all(self.document("/assets?count=1"), "CuttingTool")), 1)
        self.assertEqual(len(find_all(self.document("/assets?type=Other"), "CuttingTool")), 0)

    def parts(self, target, enough):
        """Documents of a stream until `enough(documents)`."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        connection.request("GET", target)
        answer = connection.getresponse()
        self.assertEqual(answer.status, 200)
        kind, boundary = re.fullmatch(r"(multipart/x-mixed-replace);\s*boundary=(\S+)", answer.headers["Content-Type"]).groups()
        documents = []
        while not enough(documents):
            line = answer.readline().strip().decode()
            if not line: continue
            self.assertEqual(line, "--" + boundary)
            length = None
            while header := answer.readline().strip().decode():
                name, value = header.split(":", 1)
                if name.lower() == "content-length": length = int(value)
            documents.append(validate(answer.read(length).decode()))
        connection.close()
        return documents

    def test_a_stream_continues_without_gap_and_repetition(self):
        start = int(self.document("/current")[0].get("nextSequence"))
        self.order("channels/0/cycle-start")
        documents = self.parts(f"/sample?from={start}&interval=100&count=1000", lambda so_far: len(so_far) >= 8)
        self.order("channels/0/reset")
        sequences = [int(one.get("sequence")) for root in documents for one in self.observations(root)]
        self.assertEqual(sequences, list(range(start, start + len(sequences))))
        self.assertGreater(len(sequences), 20)

    def test_a_silent_stream_sends_a_heartbeat(self):
        path = "//DataItem[@type=%22PROGRAM%22]"
        start = int(self.document("/current")[0].get("nextSequence"))
        documents = self.parts(f"/sample?from={start}&interval=50&heartbeat=200&path={path}", lambda so_far: len(so_far) >= 3)
        self.assertEqual([len(self.observations(one)) for one in documents], [0, 0, 0])
        self.assertEqual(len(self.parts("/current?interval=50&path=" + path, lambda so_far: len(so_far) >= 3)), 3)

    def test_clients_that_do_not_read_delay_no_order(self):
        slow = []
        for _ in range(40):
            one = socket.create_connection(("127.0.0.1", self.port))
            one.sendall(b"GET /sample?interval=0&count=1000 HTTP/1.1\r\nHost: x\r\n\r\n")
            slow.append(one)
        for _ in range(20): self.order("channels/0/feed-hold")
        self.document("/current")
        for one in slow: one.close()

    def test_the_oldest_connection_of_the_address_with_most_gives_way(self):
        elsewhere = socket.create_connection(("127.0.0.1", self.port), timeout=60, source_address=("127.0.0.2", 0))
        elsewhere.sendall(b"GET /current?interval=20 HTTP/1.1\r\nHost: localhost\r\n\r\n")
        held = [socket.create_connection(("127.0.0.1", self.port), timeout=60) for _ in range(70)]
        self.assertEqual(self.ask("/probe")[0], 200)
        self.assertEqual(held[0].recv(1), b"", "closed by the agent")
        received = b""
        while received.count(b"</MTConnectStreams>") < 10: received += elsewhere.recv(65536) or self.fail("the stream has ended")
        for one in [elsewhere] + held: one.close()

    def test_bytes_that_are_no_request_end_the_connection_alone(self):
        for text in (b"nonsense\r\n\r\n", b"GET / HTTP/1.1\r\n" + b"x: " + b"y" * 20000 + b"\r\n\r\n", b"\0" * 100 + b"\r\n\r\n"):
            with socket.create_connection(("127.0.0.1", self.port), timeout=10) as one:
                one.sendall(text)
                one.recv(4096)
        self.document("/probe")

    @classmethod
    def summary(cls):
        print("validated against the official schemas: " + (json.dumps(validated) if SCHEMAS else "none, MTCONNECT_SCHEMAS is not set: structure only"))


if __name__ == "__main__":
    result = unittest.main(exit=False).result
    Agent.summary()
    sys.exit(not result.wasSuccessful())
