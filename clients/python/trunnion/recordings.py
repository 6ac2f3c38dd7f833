# SPDX-License-Identifier: Apache-2.0
"""Recordings in MCAP files.

Recordings: made by the command `trunnion record` on a computer that is connected to the cluster's bus, in general the machine's
own, into files of the computer this runs on. StoredRecordings: those that the gateway makes and the machine keeps.
"""
from __future__ import annotations

import json
import pathlib
import shutil
import signal
import subprocess
import time
import urllib.parse
from collections.abc import Callable
from typing import Any

from .errors import Error, TimedOut
from .http import Http


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


class StoredRecordings:
    """The recordings in the machine's state directory: `machine.stored_recordings.start()`."""

    def __init__(self, http: Http):
        self._http = http

    def list(self) -> list[dict[str, Any]]:
        """Name, size (bytes), modified (ISO 8601), etag, recording (whether it is being made), ascending by name."""
        found: list[dict[str, Any]] = self._http.get("/api/recordings")["recordings"]
        return found

    def start(self, name: str | None = None, duration: float | None = None) -> str:
        """Starts one and returns its name; name: with .mcap at the end, without one the time; duration: s. Raises Refused."""
        body = {key: value for key, value in {"name": name, "duration": duration}.items() if value is not None}
        return str(self._http.send("POST", "/api/recordings", body)["name"])

    def stop(self, name: str) -> None:
        """Ends it; its file is whole afterwards. Raises Refused."""
        self._http.send("POST", f"{self._path(name)}/stop")

    def download(self, name: str) -> bytes:
        """The MCAP file. Raises Refused when there is none."""
        return self._http.request("GET", self._path(name))

    def table(self, name: str) -> dict[str, list[float]]:
        """Its executed cycles by column: cycle, commanded[i] and actual[i] of each axis of the drive in mm or degrees, velocity[i]
        and torque[i], which are known once in a batch of cycles and nan in the others. Raises Refused when there is none."""
        lines = self._http.request("GET", f"{self._path(name)}/table").decode().splitlines()
        columns = zip(*(line.split(",") for line in lines[1:]))
        return {title: [float(value or "nan") for value in column] for title, column in zip(lines[0].split(","), columns)}

    def delete(self, name: str) -> None:
        """Deletes it. Raises Refused, for example while it is being made."""
        etag = next((one["etag"] for one in self.list() if one["name"] == name), "")
        self._http.request("DELETE", self._path(name), headers={"If-Match": etag})

    @staticmethod
    def _path(name: str) -> str:
        return f"/api/recordings/{urllib.parse.quote(name, safe='')}"
