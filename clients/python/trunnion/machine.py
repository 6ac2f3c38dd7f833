# SPDX-License-Identifier: Apache-2.0
"""A machine: parameters, programs, alarms, tools, and its channels."""
from __future__ import annotations

import contextlib
import urllib.parse
from typing import Any

from .channel import Channel
from .data import Alarm, Parameter, PastAlarm, Plan, Program, Tool, active_alarms, from_json
from .errors import Error, NotConnected, Refused
from .http import Http
from .recordings import Recordings, StoredRecordings
from .stream import Stream
from .units import convert


def _digits(number: int | str) -> str:
    text = f"{number:06d}" if isinstance(number, int) else number
    if not (len(text) <= 6 and text.isdigit()):
        raise Error(f"{number}: a parameter has a number of at most six digits, for example 100034")
    return text


class Parameters:
    """The parameters by number: `machine.parameters[100034].value_in("m/min")`."""

    def __init__(self, http: Http):
        self._http = http

    def __getitem__(self, number: int | str) -> Parameter:
        """One parameter. Raises Refused when there is none with this number."""
        return from_json(Parameter, self._http.get(f"/api/parameters/{_digits(number)}"))

    def __setitem__(self, number: int | str, value: float | str) -> None:
        """Stores a value in the parameter's unit; it acts as the parameter's activation says. Raises Refused."""
        self.set(number, value)

    def set(self, number: int | str, value: float | str, unit: str | None = None, who: str = "python") -> None:
        """Stores a value, a number in `unit` (the parameter's own without). `who` is for the journal. Raises Refused."""
        if unit is not None:
            if isinstance(value, str):
                raise Error(f"{_digits(number)}: a text has no unit")
            value = self._into(number, value, unit)
        body: dict[str, Any] = {"who": who}
        body["text" if isinstance(value, str) else "value"] = value
        self._http.send("PUT", f"/api/parameters/{_digits(number)}", body)

    def restore(self, number: int | str, who: str = "python") -> None:
        """Back to the default. Raises Refused."""
        self._http.send("PUT", f"/api/parameters/{_digits(number)}", {"reset": True, "who": who})

    def find(self, search: str = "", group: str = "") -> list[Parameter]:
        """All with this text in number, name or help; group: nc, user, channel, axis, compensation or table."""
        found: list[Parameter] = []
        while True:
            query = {"search": search, "class": group, "offset": str(len(found)), "limit": "1000"}
            page = self._http.get("/api/parameters?" + urllib.parse.urlencode({k: v for k, v in query.items() if v}))
            found += [from_json(Parameter, one) for one in page["parameters"]]
            if not page["parameters"] or len(found) >= page["total"]:
                return found

    def _into(self, number: int | str, value: float, unit: str) -> float:
        own = self[number].unit
        # Of alternatives ("mm/min|deg/min") the one that measures the same as the given unit.
        for one in own.split("|"):
            try:
                return convert(value, unit, one)
            except Error:
                continue
        raise Error(f"{_digits(number)} has the unit {own or 'none'}, not {unit}")


class Programs:
    """The stored programs."""

    def __init__(self, http: Http):
        self._http = http

    def list(self) -> list[Program]:
        """All of them, by name."""
        return [from_json(Program, one) for one in self._http.get("/api/programs")["programs"]]

    def upload(self, name: str, text: str | bytes, replace: bool = False) -> None:
        """Stores a program. Without `replace` one of the same name raises Error and stays. Raises Refused."""
        if not replace and any(one.name == name for one in self.list()):
            raise Error(f"{name} is stored already; replace=True stores this text in its place")
        content = text.encode() if isinstance(text, str) else text
        self._http.request("PUT", self._path(name), content, "text/plain")

    def download(self, name: str) -> bytes:
        """The text of a program. Raises Refused when it is not stored."""
        return self._http.request("GET", self._path(name))

    def plan(self, name: str, channel: int = 0) -> Plan:
        """Its motion, planned as the channel will. Raises Refused when it is not stored."""
        return from_json(Plan, self._http.get(f"{self._path(name)}/plan?channel={channel}"))

    def delete(self, name: str) -> None:
        """Removes a program. Raises Refused, for example while a channel executes it."""
        self._http.send("DELETE", self._path(name))

    @staticmethod
    def _path(name: str) -> str:
        return f"/api/programs/{urllib.parse.quote(name, safe='')}"


class Machine:
    """A connection to a gateway: `with trunnion.connect() as machine:`."""

    def __init__(self, url: str, timeout: float, token: str | None = None, ca: str | None = None):
        self.http = Http(url, timeout, token, ca)
        self.parameters = Parameters(self.http)
        self.programs = Programs(self.http)
        self.stream = Stream(self.http)
        #: Seconds of an interpolation cycle, parameter 000001.
        self.period = self.parameters[1].value_in("s")
        self.recordings = Recordings(lambda: self.stream.state)
        self.stored_recordings = StoredRecordings(self.http)

    def __enter__(self) -> Machine:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the connection and gives the right to operate back; the machine is not affected."""
        with contextlib.suppress(Error):  # the gateway may be gone
            if "operating" in self.stream.state:
                self.http.send("POST", "/api/operating-right", {"action": "release"})
        self.stream.close()

    @property
    def name(self) -> str:
        """The name of the machine's directory."""
        return str(self.stream.state.get("cluster", {}).get("machine", ""))

    @property
    def ready(self) -> bool:
        """Whether every service of the cluster is active."""
        return bool(self.stream.state.get("cluster", {}).get("ready", False))

    @property
    def channels(self) -> list[Channel]:
        """Every channel that has reported, by number."""
        return [Channel(self.http, self.stream, self.period, number) for number in sorted(map(int, self.stream.state.get("channels", {})))]

    def channel(self, number: int | None = None) -> Channel:
        """One channel; without a number the first. Raises NotConnected when it has not reported."""
        there = self.channels
        for one in there:
            if number is None or one.number == number:
                return one
        raise NotConnected(f"{'a channel' if number is None else f'channel {number}'} has not reported")

    @property
    def alarms(self) -> list[Alarm]:
        """Active alarms, the oldest first."""
        return sorted(active_alarms(self.stream.state), key=lambda alarm: (alarm.since, alarm.number))

    def alarm_history(self, search: str = "", limit: int = 2000) -> list[PastAlarm]:
        """Alarms that there were, the newest first; `search`: part of number, text or source."""
        found = self.http.get(f"/api/alarms/history?limit={limit}&search={urllib.parse.quote(search)}")
        return [from_json(PastAlarm, one) for one in found["alarms"]]

    def reset_alarms(self) -> None:
        """Requests every service to clear the alarms whose cause is gone."""
        self.http.send("POST", "/api/alarms/reset")

    def emergency_stop(self) -> None:
        """Requests an emergency stop of the PLC. It does not replace the hard-wired one."""
        self.http.send("POST", "/api/panel/emergency-stop")

    def release_emergency_stop(self) -> None:
        """Releases the emergency stop of the panel; alarms and channels are reset separately."""
        self.http.send("POST", "/api/panel/release")
        self.http.send("POST", "/api/panel/reset")

    def take_right(self) -> None:
        """Takes the right to operate over. Raises Refused when its holder has to agree: a token below the role setter."""
        answer = self.http.send("POST", "/api/operating-right", {"action": "take"})
        if answer["one"] and not answer["mine"]:
            raise Refused(f"{answer['holder']['name']} operates this machine and has been asked", 409, 0)

    @property
    def tools(self) -> list[Tool]:
        """The tool table, by number."""
        return [from_json(Tool, one) for one in self.http.get("/api/tools")["tools"]]


def connect(url: str = "http://localhost:8080", timeout: float = 10.0, token: str | None = None, ca: str | None = None) -> Machine:
    """Connects to the gateway of a machine.

    timeout: seconds to wait for an answer. token: of `trunnion user token`, where users log in. ca: PEM file of the certificate of a
    machine with `tls: on`, for https. Raises NotConnected when it does not answer.
    """
    return Machine(url, timeout, token, ca)
