# SPDX-License-Identifier: Apache-2.0
"""The client on a machine that is reached by TLS, with a certificate made by the command `trunnion certificate`."""
import json
import os
import pathlib
import shutil
import stat
import subprocess
import tempfile
import unittest

import trunnion

COMMAND = os.environ.get("TRUNNION", "trunnion")
DOMAIN = os.environ.get("ACCESS_DOMAIN", "78")
PORT = os.environ.get("ACCESS_PORT", "18367")
MACHINE = pathlib.Path(__file__).parents[3] / "configs" / "machines" / "ac-table"


class Tls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory(prefix="trunnion-tls-")
        cls.addClassCleanup(cls.directory.cleanup)
        scratch = pathlib.Path(cls.directory.name)
        shutil.copytree(MACHINE, scratch / "machine", ignore=shutil.ignore_patterns("recordings"))
        with open(scratch / "machine" / "machine.yaml", "a", encoding="utf-8") as file:
            file.write("tls: on\nmtconnect_port: 0\n")
        cls.state, cls.machine = scratch / "state", scratch / "machine"
        cls.made = cls.certificate("--name", "mill-3.example", "--days", "90")
        cls.ca = cls.made["certificate"]
        up = subprocess.run([COMMAND, "up", str(cls.machine), "--time", "virtual", "--domain", DOMAIN, "--port", PORT,
                             "--state", str(cls.state)], check=True, capture_output=True, text=True)
        cls.addClassCleanup(subprocess.run, [COMMAND, "down", "--domain", DOMAIN], stdout=subprocess.DEVNULL)
        cls.told = up.stdout

    @classmethod
    def certificate(cls, *arguments):
        answer = subprocess.run([COMMAND, "certificate", str(cls.machine), "--state", str(cls.state), "--json", *arguments],
                                check=True, capture_output=True, text=True)
        return json.loads(answer.stdout)

    def test_the_command_makes_a_pair_for_the_names_and_days_and_shows_it(self):
        self.assertEqual(self.made["names"][0], "mill-3.example")
        self.assertIn("127.0.0.1", self.made["names"])
        self.assertEqual(self.made["ends"] - self.made["begins"], 90 * 86400 + 3600)  # an hour before, for late clocks
        self.assertEqual(self.certificate("--show"), self.made)
        self.assertEqual(stat.S_IMODE((self.state / "certificate.key").stat().st_mode), 0o600)
        told = subprocess.run(["openssl", "x509", "-in", self.ca, "-noout", "-fingerprint", "-sha256"], check=True,
                              capture_output=True, text=True).stdout
        self.assertIn(self.made["sha256"], told)

    def test_the_command_line_names_the_address_with_https(self):
        self.assertIn(f"https://localhost:{PORT}", self.told)

    def test_a_program_is_stored_and_followed_by_tls(self):
        with trunnion.connect(f"https://localhost:{PORT}", ca=self.ca) as machine:
            machine.stream.wait(lambda state: state.get("cluster", {}).get("ready"), 20)
            machine.programs.upload("TLS.NC", "G21 G90 G54\nG1 X10 F1000\nM30\n")
            self.assertIn("TLS.NC", [one.name for one in machine.programs.list()])
            machine.emergency_stop()
            machine.stream.wait(lambda state: any(one["number"] for one in state.get("alarms", {}).values()), 10)

    def test_a_certificate_that_is_not_trusted_or_no_tls_is_one_clear_error(self):
        with self.assertRaisesRegex(trunnion.NotConnected, "certificate verify failed"):
            trunnion.connect(f"https://localhost:{PORT}")
        with self.assertRaisesRegex(trunnion.NotConnected, "https:// only"):
            trunnion.connect(f"http://localhost:{PORT}")
        with self.assertRaisesRegex(ValueError, "only with https"):
            trunnion.connect(f"http://localhost:{PORT}", ca=self.ca)
        with self.assertRaisesRegex(ValueError, "no certificates in PEM form"):
            trunnion.connect(f"https://localhost:{PORT}", ca=__file__)


if __name__ == "__main__":
    unittest.main()
