# SPDX-License-Identifier: Apache-2.0
"""The client on a real cluster in virtual time. TRUNNION is the command that starts it; DOMAIN and PORT are its own."""
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import trunnion

COMMAND = os.environ.get("TRUNNION", "trunnion")
DOMAIN = os.environ.get("DOMAIN", "66")
PORT = os.environ.get("PORT", "18366")
URL = f"http://127.0.0.1:{PORT}"
EXAMPLE = pathlib.Path(__file__).parent.parent / "examples" / "following_error.py"

# A square of 40 mm sides at F3000 in machine coordinates: 3.2 s at the feed, and a little for the corners.
SQUARE = "G21 G90 G54 G94 G17 G40 G49\nG53 G0 X0 Y0\nG91 G1 X40 F3000\nY40\nX-40\nY-40\nM30\n"


class Cluster(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory(prefix="trunnion-python-")
        cls.addClassCleanup(cls.directory.cleanup)
        up = [COMMAND, "up", "ac-table", "--time", "virtual", "--domain", DOMAIN, "--port", PORT, "--state", f"{cls.directory.name}/state"]
        subprocess.run(up, check=True, stdout=subprocess.DEVNULL)
        cls.addClassCleanup(subprocess.run, [COMMAND, "down", "--domain", DOMAIN], stdout=subprocess.DEVNULL)
        cls.machine = trunnion.connect(URL)
        cls.addClassCleanup(cls.machine.close)
        cls.machine.recordings.command = COMMAND
        cls.machine.programs.upload("square.nc", SQUARE)

    def setUp(self):
        self.machine.reset_alarms()
        self.channel = self.machine.channel()
        self.channel.reset()

    def test_machine(self):
        self.assertEqual(self.machine.name, "ac-table")
        self.assertTrue(self.machine.ready)
        self.assertEqual(self.machine.period, 0.001)
        self.assertEqual([one.number for one in self.machine.channels], [0])
        self.assertEqual([tool.number for tool in self.machine.tools], [1, 2])
        with self.assertRaisesRegex(trunnion.NotConnected, "channel 5 has not reported"):
            self.machine.channel(5)

    def test_recordings_that_the_machine_keeps(self):
        stored = self.machine.stored_recordings
        name = stored.start("kept.mcap")
        self.channel.run("square.nc")
        self.assertTrue(next(one for one in stored.list() if one["name"] == name)["recording"])
        with self.assertRaisesRegex(trunnion.Refused, "is being recorded"):
            stored.start()
        stored.stop(name)
        table = stored.table(name)
        columns = [self.channel.column(letter) for letter in "XYZ"]
        self.assertEqual(columns, [0, 1, 2])
        with self.assertRaisesRegex(trunnion.Error, "no axis W"):
            self.channel.column("W")
        commanded, actual = (list(zip(*(table[f"{what}[{i}]"] for i in columns))) for what in ("commanded", "actual"))
        contour = trunnion.contour_errors(commanded, actual)
        following = [math.dist(one, other) for one, other in zip(commanded, actual)]
        self.assertEqual(len(contour), len(table["cycle"]))
        # The same cycle of the commanded path is one of the points that the contour error looks at.
        self.assertTrue(all(one <= other for one, other in zip(contour, following)))
        self.assertLess(max(contour), max(following))
        content = stored.download(name)
        self.assertEqual((content[:5], content[-7:-3]), (b"\x89MCAP", b"MCAP"))
        stored.delete(name)
        self.assertEqual(stored.list(), [])
        with self.assertRaises(trunnion.Refused):
            stored.download(name)

    def test_parameters_are_read_and_written_in_units(self):
        parameters = self.machine.parameters
        rapid = parameters[100034]
        self.assertEqual((rapid.value, rapid.value_in("m/min")), (30000, 30))
        parameters.set(100034, 24, "m/min")
        self.addCleanup(parameters.set, 100034, 30000)
        self.assertEqual(parameters["100034"].stored, 24000)
        with self.assertRaisesRegex(trunnion.Error, "has the unit .* not kg"):
            parameters.set(100034, 1, "kg")
        with self.assertRaises(trunnion.Refused) as refused:
            parameters[100034] = -5
        self.assertGreaterEqual(refused.exception.status, 400)
        with self.assertRaises(trunnion.Refused):
            parameters[999999]
        self.assertEqual(parameters[40000].value, "MILL")
        self.assertIn(100034, [one.number for one in parameters.find("rapid")])
        # Every page of a long list: the catalogue has more than one page of 1000.
        everything = [one.number for one in parameters.find()]
        self.assertGreater(len(everything), 2000)
        self.assertEqual(len(everything), len(set(everything)))

    def test_programs_are_stored_read_and_deleted(self):
        programs = self.machine.programs
        name = "ä b.nc"
        try:
            programs.upload(name, "G0 X1\nM30\n")
        except trunnion.Refused:
            name = "a_b.nc"  # a name that the store does not take is refused with a reason
            programs.upload(name, "G0 X1\nM30\n")
        self.assertEqual(programs.download(name), b"G0 X1\nM30\n")
        self.assertEqual([one.lines for one in programs.list() if one.name == name], [2])
        with self.assertRaisesRegex(trunnion.Error, "is stored already"):
            programs.upload(name, "G0 X2\n")
        programs.upload(name, "G0 X2\n", replace=True)
        self.assertEqual(programs.download(name), b"G0 X2\n")
        programs.delete(name)
        with self.assertRaises(trunnion.Refused):
            programs.download(name)

    def test_run_and_wait_gives_signals(self):
        samples = self.channel.run("square.nc", ["X.following_peak", "Y.actual", "feed"], timeout=60)
        state = self.channel.state
        self.assertEqual((state.state, state.program), ("IDLE", "square.nc"))
        self.assertLess(math.hypot(state.position("X"), state.position("Y")), 1e-3)
        # Four sides of 40 mm at 3000 mm/min take at least 3.2 s.
        self.assertGreater(samples.time[-1], 3.2)
        self.assertGreater(samples.largest("X.following_peak"), 0)
        self.assertEqual(len(samples["feed"]), len(samples))

    def test_an_error_of_the_program_is_raised_with_its_place(self):
        self.machine.programs.upload("wrong.nc", "G21 G90 G54\nG1 X1 F1000\nG1 X2 Q5\nM30\n", replace=True)
        with self.assertRaisesRegex((trunnion.ProgramStopped, trunnion.Refused), "wrong.nc:3"):
            self.channel.run("wrong.nc", timeout=60)

    def test_a_plan_takes_as_long_as_the_program(self):
        plan = self.machine.programs.plan("square.nc")
        self.assertTrue(plan.complete)
        self.assertIsNone(plan.alarm)
        self.assertEqual([plan.at(0.4), plan.at(plan.seconds - 0.4)], [3, 6])
        # The square begins where the axes are at rest, X0 Y0, so cycles are the plan's.
        self.channel.run("square.nc")
        before = self.channel.state.cycle
        samples = self.channel.run("square.nc", ["feed"])
        executed = (self.channel.state.cycle - before) * self.machine.period
        self.assertAlmostEqual(plan.seconds, executed, delta=0.3)
        self.assertGreater(len(samples), 0)
        with self.assertRaisesRegex(trunnion.Refused, "no program missing.nc"):
            self.machine.programs.plan("missing.nc")

    def test_mdi_of_several_lines_ends_at_the_first_error(self):
        self.channel.mdi("G90 G54 G0 X11\nG1 X12 F3000\n\nG0 X13.5", timeout=60)
        self.assertAlmostEqual(self.channel.state.position("X"), 13.5, places=3)
        with self.assertRaises((trunnion.ProgramStopped, trunnion.Refused)):
            self.channel.mdi("G0 X14\n?? X15\nG0 X16", timeout=60)
        self.assertAlmostEqual(self.channel.state.position("X"), 14, places=3)
        self.assertTrue(self.machine.alarms == [] or self.machine.alarms[0].text)

    def test_an_emergency_stop_ends_the_wait(self):
        self.machine.programs.upload("slow.nc", "G21 G90 G54\nG1 X300 F10\nM30\n", replace=True)
        stop = threading.Timer(0.7, self.machine.emergency_stop)
        stop.start()
        with self.assertRaises(trunnion.ProgramStopped) as stopped:
            self.channel.run("slow.nc", timeout=60)
        stop.join()
        # The PLC raises it: it may come behind the channel's state.
        self.machine.stream.wait(lambda state: any(one["number"] == 130 for one in state.get("alarms", {}).values()), 60)
        self.assertRegex(str(stopped.exception), "slow.nc was (ended|stopped)")
        self.machine.release_emergency_stop()
        self.machine.stream.wait(lambda state: not state["plc"]["emergency_stop"], 10)
        self.machine.reset_alarms()
        self.machine.stream.wait(lambda state: not state["alarms"], 10)
        past = self.machine.alarm_history("130")[0]
        self.assertEqual(past.number, 130)
        self.assertGreaterEqual(past.cleared, past.raised)
        self.assertEqual(self.machine.alarm_history("no such text"), [])

    def test_a_program_that_takes_too_long_goes_on(self):
        self.machine.programs.upload("slow.nc", "G21 G90 G54\nG1 X300 F10\nM30\n", replace=True)
        with self.assertRaises(trunnion.TimedOut):
            self.channel.run("slow.nc", timeout=0.5)
        self.assertEqual(self.channel.state.state, "RUNNING")
        with self.assertRaises(trunnion.Refused):
            self.channel.command("select", program="square.nc")
        self.channel.hold()
        self.channel.wait(timeout=20, wanted="HELD")
        self.channel.reset()

    def test_recordings_are_made_by_the_command(self):
        path = pathlib.Path(self.directory.name) / "square.mcap"
        with self.machine.recordings.start(path):
            self.channel.run("square.nc", timeout=60)
        self.assertEqual(self.machine.recordings.list(path.parent), [path])
        self.assertTrue(self.machine.recordings.info(path))
        with self.assertRaisesRegex(trunnion.Error, "exists already"):
            self.machine.recordings.start(path)
        missing = trunnion.Recordings(lambda: {}, "no-such-command")
        with self.assertRaisesRegex(trunnion.Error, "is not on this computer"):
            missing.start(path.parent / "other.mcap")

    def test_the_example_prints_the_largest_following_error(self):
        done = subprocess.run([sys.executable, EXAMPLE, URL, "square.nc"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, r"largest following error: [XYZAC] 0\.\d+")

    def test_a_second_client_sees_the_same_and_a_closed_one_says_so(self):
        with trunnion.connect(URL) as second:
            self.assertEqual(second.channel().state.letters, "XYZAC")
        with self.assertRaises(trunnion.NotConnected):
            second.channel()

    def test_a_gateway_that_is_killed_is_noticed_and_its_successor_answers(self):
        gateway = next(one for one in self.machine.http.get("/api/status")["services"] if one["service"] == "gateway")
        os.kill(gateway["pid"], signal.SIGKILL)
        with self.assertRaises(trunnion.NotConnected):
            self.machine.stream.wait(lambda state: False, 10)
        with self.assertRaises(trunnion.NotConnected):
            self.machine.alarms
        self.machine.close()
        until = time.monotonic() + 20
        while True:
            try:
                type(self).machine = trunnion.connect(URL)
                self.machine.stream.wait(lambda state: state.get("channels") and state.get("cluster", {}).get("ready"), 10)
                break
            except trunnion.Error:
                self.assertLess(time.monotonic(), until, "no gateway answers")
                time.sleep(0.1)
        self.machine.recordings.command = COMMAND
        self.addClassCleanup(self.machine.close)


if __name__ == "__main__":
    unittest.main()
