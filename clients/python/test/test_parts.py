# SPDX-License-Identifier: Apache-2.0
"""The parts that need no cluster: units, WebSocket frames, patches, signals, a server that is none."""
import http.server
import json
import math
import random
import socket
import struct
import threading
import unittest

import trunnion
from trunnion.data import from_json
from trunnion.http import Http
from trunnion.stream import merge_patch
from trunnion.units import convert
from trunnion.websocket import Frames, frame


class Units(unittest.TestCase):
    def test_values_in_other_units_of_the_same_kind(self):
        self.assertEqual(convert(30000, "mm/min|deg/min", "m/min"), 30)
        self.assertEqual(convert(7200, "mm/min|deg/min", "deg/s"), 120)
        self.assertEqual(convert(20000, "mm/s2", "m/s2"), 20)
        self.assertEqual(convert(1000, "us", "ms"), 1)
        self.assertEqual(convert(5, "cycles", "cycles"), 5)
        for metres in range(1, 100):
            self.assertEqual(convert(metres, "m/min", "mm/min"), 1000 * metres)

    def test_a_length_is_no_angle(self):
        for unit, wanted in (("mm", "deg"), ("mm/min", "mm"), ("", "mm"), ("cycles", "s")):
            with self.subTest(unit=unit), self.assertRaisesRegex(trunnion.Error, f"cannot be given in {wanted}"):
                convert(1, unit, wanted)


class Tools(unittest.TestCase):
    def test_a_tool_has_its_life_and_none_from_a_gateway_that_knows_of_none(self):
        row = {"number": 3, "length": 80.5, "length_wear": 0, "radius": 4, "radius_wear": 0, "name": "drill"}
        plain = from_json(trunnion.Tool, row)
        self.assertEqual((plain.type, plain.life_used, plain.life_limit, plain.life_unit), ("", 0, 0, "MINUTES"))
        life = {"type": "drill", "life_used": 12.5, "life_limit": 90, "life_unit": "PIECES"}
        tool = from_json(trunnion.Tool, {**row, **life})
        self.assertEqual((tool.type, tool.life_used, tool.life_limit, tool.life_unit), ("drill", 12.5, 90, "PIECES"))


def server_frame(opcode, payload, final=True):
    head = bytes([(0x80 if final else 0) | opcode])
    if len(payload) < 126:
        return head + bytes([len(payload)]) + payload
    if len(payload) < 1 << 16:
        return head + struct.pack("!BH", 126, len(payload)) + payload
    return head + struct.pack("!BQ", 127, len(payload)) + payload


class WebSocketFrames(unittest.TestCase):
    def test_messages_of_every_size_however_their_bytes_arrive(self):
        chance = random.Random(7)
        sizes = [0, 1, 125, 126, 65535, 65536, 200_000]
        messages = [chance.randbytes(size) for size in sizes]
        data = b"".join(server_frame(1, message) for message in messages)
        frames, received = Frames(), []
        while data:
            cut = chance.choice([1, 2, 3, 1000, 70_000])
            frames.add(data[:cut])
            data = data[cut:]
            while (one := frames.next()) is not None:
                received.append(one)
        self.assertEqual(received, [(1, message) for message in messages])

    def test_a_split_message_with_a_ping_in_between(self):
        frames = Frames()
        frames.add(server_frame(1, b"ab", final=False) + server_frame(9, b"?") + server_frame(0, b"cd"))
        self.assertEqual([frames.next(), frames.next(), frames.next()], [(9, b"?"), (1, b"abcd"), None])

    def test_what_rfc_6455_does_not_permit_ends_the_connection(self):
        for data in (
            server_frame(0, b"x"),  # a continuation of nothing
            server_frame(1, b"x", final=False) + server_frame(1, b"y"),  # a message within a message
            bytes([0xC1, 0]),  # a reserved bit
            bytes([0x81, 0x80]) + bytes(4),  # a mask of a server
            server_frame(9, bytes(126)),  # a control frame that is too long
            bytes([0x81, 127]) + struct.pack("!Q", 1 << 62),  # more than memory
        ):
            with self.subTest(data=data[:4]), self.assertRaises(trunnion.NotConnected):
                frames = Frames()
                frames.add(data)
                while frames.next() is not None:
                    pass

    def test_random_bytes_give_messages_or_an_error_of_ours(self):
        chance = random.Random(11)
        for _ in range(3000):
            frames = Frames()
            frames.add(chance.randbytes(chance.randrange(40)))
            try:
                while frames.next() is not None:
                    pass
            except trunnion.NotConnected:
                pass

    def test_a_client_masks_what_it_sends(self):
        # RFC 6455, section 5.7: a single-frame masked text message "Hello".
        self.assertEqual(frame(1, b"Hello", bytes.fromhex("37fa213d")), bytes.fromhex("818537fa213d7f9f4d5158"))
        self.assertEqual(frame(1, bytes(126), bytes(4))[:8], bytes.fromhex("81fe007e00000000"))
        self.assertEqual(frame(1, bytes(65536), bytes(4))[:10], bytes.fromhex("81ff0000000000010000"))


class Patches(unittest.TestCase):
    def test_the_examples_of_rfc_7396(self):
        for target, patch, result in (
            ({"a": "b"}, {"a": "c"}, {"a": "c"}), ({"a": "b"}, {"b": "c"}, {"a": "b", "b": "c"}), ({"a": "b"}, {"a": None}, {}),
            ({"a": ["b"]}, {"a": "c"}, {"a": "c"}), ({"a": {"b": "c"}}, {"a": {"b": "d", "c": None}}, {"a": {"b": "d"}}),
            (["a", "b"], ["c", "d"], ["c", "d"]), ({"a": "foo"}, None, None), ([1, 2], {"a": "b", "c": None}, {"a": "b"}),
            ({}, {"a": {"bb": {"ccc": None}}}, {"a": {"bb": {}}}),
        ):
            with self.subTest(patch=patch):
                self.assertEqual(merge_patch(target, patch), result)


class SignalNames(unittest.TestCase):
    def make(self, *names):
        return trunnion.Signals(list(names), channel=1, letters="ZX", axes=[7, 3], period=0.001)

    def test_a_sample_is_taken_of_the_axis_with_that_letter(self):
        signals = self.make("X.actual", "feed", "drive.starved")
        for tick in (100, 150):
            signals.take({
                "drive": {"tick": tick, "starved": 2}, "channels": {"1": {"feed": 500}}, "axes": {"3": {"actual": -tick}, "7": {"actual": 1}},
            })
        signals.take({"drive": {"tick": 200}})  # without one of the values: no sample
        self.assertEqual(signals.time, [0.0, 0.05])
        self.assertEqual(signals["X.actual"], [-100.0, -150.0])
        self.assertEqual(signals["feed"], [500.0, 500.0])
        self.assertEqual(signals.largest("X.actual"), 150.0)
        with self.assertRaisesRegex(KeyError, "only X.actual, feed"):
            signals["Y.actual"]

    def test_a_name_that_is_none_is_refused_with_what_there_is(self):
        for name in ("Y.actual", "X.speed", "actual", "X", "", ".actual", "drive.feed", "ZX.actual"):
            with self.subTest(name=name), self.assertRaisesRegex(trunnion.Error, "there is no signal"):
                self.make(name)

    def test_numpy_is_used_where_it_is(self):
        try:
            import numpy
        except ImportError:
            self.skipTest("numpy is not installed")
        signals = self.make("X.actual", "feed")
        signals.take({"drive": {"tick": 1}, "channels": {"1": {"feed": 5}}, "axes": {"3": {"actual": 2}}})
        self.assertTrue(numpy.array_equal(signals.array(), [[2.0, 5.0]]))


class ContourErrors(unittest.TestCase):
    def test_of_a_circle_it_is_the_difference_of_the_radii_however_far_the_axes_lag_behind(self):
        # 50 mm in 2000 steps: a chord is within 50 (1 - cos(pi / 2000)) = 6.2e-5 mm of the circle.
        steps, lag, chord = 2000, 40, 6.2e-5
        circle = lambda radius, i: (radius * math.cos(2 * math.pi * i / steps), radius * math.sin(2 * math.pi * i / steps))
        commanded = [circle(50, i) for i in range(lag, lag + 2 * steps)]  # twice around
        actual = [circle(49.9, i) for i in range(2 * steps)]
        for error in trunnion.contour_errors(commanded, actual)[lag:]:
            self.assertTrue(0.1 - chord <= error <= 0.1 + 1e-9, error)
        self.assertGreater(math.dist(commanded[100], actual[100]), 6)  # the following error: 40 steps of 0.157 mm

    def test_a_cut_corner_is_the_distance_to_the_nearer_side(self):
        commanded = [(x, 0, 0) for x in range(11)] + [(10, y, 0) for y in range(1, 11)]
        start = [(0, 0, 0)] * 3  # the axes lag behind by three cycles
        actual = start + [(x, 0, 0) for x in range(8)] + [(8, 0.5, 0), (9, 1, 0), (9.75, 2, 0)] + [(10, y, 0) for y in range(1, 8)]
        self.assertEqual(trunnion.contour_errors(commanded, actual), [0] * 11 + [0.5, 1, 0.25] + [0] * 7)

    def test_points_that_are_no_pairs_are_refused(self):
        self.assertEqual(trunnion.contour_errors([], []), [])
        self.assertEqual(trunnion.contour_errors([(1, 2)], [(1, 4)]), [2])
        with self.assertRaisesRegex(ValueError, "2 commanded points and 1 actual"):
            trunnion.contour_errors([(0, 0), (1, 1)], [(0, 0)])


class Refusals(unittest.TestCase):
    def test_the_reason_is_the_one_that_the_gateway_gives_in_any_of_its_forms(self):
        bodies = {
            "/reason": {"accepted": False, "alarm": 141, "reason": "no program A.NC"},
            "/error": {"error": "no such path"},
            # RFC 9457, as of the programs of the PLC, measurements and the right to operate.
            "/detail": {"type": "about:blank", "title": "Conflict", "status": 409, "detail": "panel.st is being loaded"},
            "/none": {},
        }

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                content = json.dumps(bodies[self.path]).encode()
                self.send_response(409)
                self.send_header("Content-Length", str(len(content)))
                self.end_headers()
                self.wfile.write(content)

            def log_message(self, *arguments):
                pass

        with http.server.HTTPServer(("127.0.0.1", 0), Handler) as server:
            thread = threading.Thread(target=server.serve_forever)
            thread.start()
            gateway = Http(f"http://127.0.0.1:{server.server_port}")
            for path, reason, alarm in (
                ("/reason", "no program A.NC", 141), ("/error", "no such path", 0), ("/detail", "panel.st is being loaded", 0),
                ("/none", "the gateway answered 409", 0),
            ):
                with self.subTest(path=path), self.assertRaises(trunnion.Refused) as refused:
                    gateway.get(path)
                self.assertIn(reason, str(refused.exception))
                self.assertEqual(refused.exception.alarm, alarm)
            server.shutdown()
            thread.join()


class NoGateway(unittest.TestCase):
    def test_a_port_where_nothing_listens(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        with self.assertRaisesRegex(trunnion.NotConnected, f"127.0.0.1:{port} does not answer"):
            trunnion.connect(f"http://127.0.0.1:{port}")

    def test_a_server_that_is_no_gateway(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            def answer():
                peer, _ = server.accept()
                with peer:
                    peer.recv(4096)
                    peer.sendall(b"SSH-2.0-other\r\n\r\n")
            thread = threading.Thread(target=answer)
            thread.start()
            with self.assertRaisesRegex(trunnion.NotConnected, "opened no stream"):
                trunnion.connect(f"http://127.0.0.1:{server.getsockname()[1]}")
            thread.join()

    def test_a_url_of_another_kind(self):
        for url in ("ftp://x", "http://", "https://"):
            with self.subTest(url=url), self.assertRaises(ValueError):
                trunnion.connect(url)


if __name__ == "__main__":
    unittest.main()
