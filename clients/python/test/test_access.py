# SPDX-License-Identifier: Apache-2.0
"""The client on a machine whose users log in, with users made by the command `trunnion user`."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import trunnion

COMMAND = os.environ.get("TRUNNION", "trunnion")
DOMAIN = os.environ.get("ACCESS_DOMAIN", "78")
PORT = os.environ.get("ACCESS_PORT", "18367")
URL = f"http://127.0.0.1:{PORT}"
MACHINE = pathlib.Path(__file__).parents[3] / "configs" / "machines" / "ac-table"


class Access(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory(prefix="trunnion-access-")
        cls.addClassCleanup(cls.directory.cleanup)
        scratch = pathlib.Path(cls.directory.name)
        shutil.copytree(MACHINE, scratch / "machine", ignore=shutil.ignore_patterns("recordings"))
        with open(scratch / "machine" / "machine.yaml", "a", encoding="utf-8") as file:
            file.write("auth: on\nmtconnect_port: 0\n")
        cls.state = scratch / "state"
        cls.state.mkdir()
        cls.user("add", "ann", "--role", "administrator", text="correct horse\n")
        cls.tokens = {role: cls.user("token", role, "--role", role).stdout.strip() for role in ("operator", "setter", "builder")}
        subprocess.run([COMMAND, "up", str(scratch / "machine"), "--time", "virtual", "--domain", DOMAIN, "--port", PORT,
                        "--state", str(cls.state)], check=True, stdout=subprocess.DEVNULL)
        cls.addClassCleanup(subprocess.run, [COMMAND, "down", "--domain", DOMAIN], stdout=subprocess.DEVNULL)

    @classmethod
    def user(cls, *arguments, text="", check=True):
        return subprocess.run([COMMAND, "user", arguments[0], "--state", str(cls.state), *arguments[1:]], input=text, text=True,
                              capture_output=True, check=check)

    def test_a_token_connects_and_has_its_role(self):
        with self.assertRaises(trunnion.Error):
            trunnion.connect(URL)
        with trunnion.connect(URL, token=self.tokens["operator"]) as machine:
            machine.stream.wait(lambda state: state.get("cluster", {}).get("ready"), 20)
            with self.assertRaisesRegex(trunnion.Refused, "needs the role setter"):
                machine.parameters.set(11, 0.2)
        with trunnion.connect(URL, token=self.tokens["setter"]) as machine:
            machine.parameters.set(11, 0.2)
            with self.assertRaisesRegex(trunnion.Refused, "needs the role builder"):
                machine.parameters.set(10, 0.01)
        with trunnion.connect(URL, token=self.tokens["builder"]) as machine:
            machine.parameters.set(10, 0.01)  # the setter's connection has given the right to operate back
            with trunnion.connect(URL, token=self.tokens["operator"]) as other:
                with self.assertRaisesRegex(trunnion.Refused, "builder .*operates this machine and has been asked"):
                    other.take_right()
            with trunnion.connect(URL, token=self.tokens["setter"]) as other:
                with self.assertRaisesRegex(trunnion.Refused, "builder .*operates this machine"):
                    other.parameters.set(11, 0.1)
                other.take_right()
                other.parameters.set(11, 0.1)
        self.assertIn('"builder"', (self.state / "journal.jsonl").read_text(encoding="utf-8"))

    def test_the_command_refuses_what_would_lock_everyone_out(self):
        listed = self.user("list").stdout
        self.assertRegex(listed, r"user +ann +administrator")
        self.assertRegex(listed, r"token +setter +setter")
        for arguments, text, reason in [
            (("remove", "ann"), "", "the only administrator"), (("remove", "bob"), "", "there is no user 'bob'"),
            (("add", "bob"), "short\n", "8 to 256 bytes"), (("add", "b b"), "long enough\n", "is no name"),
            (("add", "ann"), "long enough\n", "already"), (("add", "bob", "--role", "king"), "long enough\n", "no role"),
            (("token", "setter"), "", "already"), (("token", "other", "--remove"), "", "there is no token")]:
            with self.subTest(arguments):
                refused = self.user(*arguments, text=text, check=False)
                self.assertEqual(refused.returncode, 1)
                self.assertIn(reason, refused.stderr)
                self.assertEqual(refused.stderr.count("\n"), 1)
        self.assertEqual(self.user("list").stdout, listed, "nothing was changed")
        self.assertEqual(self.state.joinpath("users.json").stat().st_mode & 0o777, 0o600)


if __name__ == "__main__":
    unittest.main()
