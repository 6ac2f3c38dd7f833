# SPDX-License-Identifier: Apache-2.0
"""Recordings in MCAP files.

The gateway has no interface for recordings: they are made by the command `trunnion record` on a computer that is connected to
the cluster's bus, in general the machine's own. So this needs that command, and gives files of the computer it runs on.
"""
from __future__ import annotations

import json
import pathlib
import shutil
import signal
import subprocess
import time
from collections.abc import Callable
from typing import Any

from .errors import Error, TimedOut


class Recording:
    """A recording that is being made: `with machine.recordings.start("part.mcap"):`. It ends with the block or stop()."""

    def __init__(self, path: pathlib.Path, process: subprocess.Popen[bytes]):
        self.path = path
        self._process = process

    def __enter__(self) -> Recording:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def stop(self, timeout: float = 30.0) -> pathlib.Path:
        """Ends the recording and gives its file. Raises Error with the reason when it failed, TimedOut after `timeout` s."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
        try:
            _, errors = self._process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.communicate()
            raise TimedOut(f"{self.path}: the recording did not end within {timeout:g} s") from None
        if self._process.returncode != 0:
            raise Error(f"{self.path}: {errors.decode(errors='replace').strip() or 'the recording failed'}")
        return self.path


class Recordings:
    """Recordings of this machine: start(), list(), info()."""

    def __init__(self, state: Callable[[], dict[str, Any]], command: str = "trunnion"):
        self._state = state
        #: The command, a name in PATH or a path.
        self.command = command

    def start(self, path: str | pathlib.Path, topics: list[str] = (), timeout: float = 10.0) -> Recording:
        """Begins a recording; the file must not exist.

        topics: handles of docs/topics.md, all without. Raises Error when the command is missing or fails at once.
        """
        path = pathlib.Path(path)
        if path.exists():
            raise Error(f"{path} exists already")
        arguments = [self._program(), "record", str(path), "--domain", str(self._domain())]
        if topics:
            arguments += ["--topics", ",".join(topics)]
        process = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        recording = Recording(path, process)
        until = time.monotonic() + timeout
        while not path.exists():
            if process.poll() is not None:
                recording.stop()
                raise Error(f"{path}: the recording ended at once")
            if time.monotonic() > until:
                process.kill()
                process.communicate()
                raise TimedOut(f"{path}: the recording did not begin within {timeout:g} s")
            time.sleep(0.02)
        return recording

    def list(self, directory: str | pathlib.Path = ".") -> list[pathlib.Path]:
        """The recordings in a directory, by name."""
        return sorted(pathlib.Path(directory).glob("*.mcap"))

    def info(self, path: str | pathlib.Path) -> dict[str, Any]:
        """What a recording holds: topics, rates, cycles, gaps, versions. Raises Error when it cannot be read."""
        done = subprocess.run([self._program(), "info", str(path), "--json"], capture_output=True, check=False)
        if done.returncode != 0:
            raise Error(f"{path}: {done.stderr.decode(errors='replace').strip()}")
        return json.loads(done.stdout)

    def _program(self) -> str:
        found = shutil.which(self.command)
        if not found:
            raise Error(f"the command {self.command} is not on this computer: recordings are made where the machine runs")
        return found

    def _domain(self) -> int:
        return int(self._state().get("cluster", {}).get("domain", 0))
