# SPDX-License-Identifier: Apache-2.0
"""Operating one channel."""
from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any, Literal

from .data import ChannelState, Mode, active_alarms, from_json
from .errors import Error, NotConnected, ProgramStopped
from .http import Http
from .signals import Signals
from .stream import Stream


class Channel:
    """One channel of a machine: `machine.channel()`."""

    def __init__(self, http: Http, stream: Stream, period: float, number: int):
        """period: seconds of an interpolation cycle."""
        self._http = http
        self._stream = stream
        self._period = period
        self.number = number

    @property
    def state(self) -> ChannelState:
        """The newest state. Raises NotConnected when the channel has not reported."""
        return self._in(self._stream.state)

    def column(self, letter: str) -> int:
        """The number of an axis in the tables of recordings, as i of "actual[i]". Raises Error when the channel has none."""
        state = self.state
        if letter not in state.letters:
            raise Error(f"channel {self.number} has no axis {letter}, but {state.letters}")
        return sorted(map(int, self._stream.state["axes"])).index(state.axes[state.letters.index(letter)])

    def command(self, command: str, **fields: Any) -> None:
        """Any operator command of docs/operator-commands.md, for example command("dry-run", on=True). Raises Refused."""
        self._http.send("POST", f"/api/channels/{self.number}/{command}", fields)

    def set_mode(self, mode: Mode) -> None:
        """AUTO, MDI, JOG or REF. Raises Refused."""
        if self.state.mode != mode:
            self.command("mode", mode=mode)

    def select(self, program: str) -> None:
        """Selects a stored program. Raises Refused."""
        self.set_mode("AUTO")
        self.command("select", program=program)

    def start(self) -> None:
        """Cycle start. Raises Refused."""
        self.command("cycle-start")

    def hold(self) -> None:
        """Feed hold."""
        self.command("feed-hold")

    def reset(self) -> None:
        """Ends the program and clears the alarms of this channel whose cause is gone."""
        before = self.state.reset_count
        self.command("reset")
        self._stream.wait(lambda state: self._in(state).reset_count != before, 10.0)

    def run(self, program: str, signals: list[str] = (), timeout: float = 3600.0) -> Signals:
        """Selects a program, starts it and waits for its end.

        signals: names of what is sampled meanwhile (signals.py). timeout: seconds of this computer's clock.
        Raises Refused, ProgramStopped (alarm, reset, emergency stop) or TimedOut; the program then goes on.
        """
        self.select(program)
        with self.sampled(signals) as samples:
            self._do("cycle-start", {}, program, timeout)
        return samples

    def mdi(self, text: str, timeout: float = 600.0) -> None:
        """Executes lines one after the other and waits for the end of each.

        timeout: seconds for each line. Raises Refused, ProgramStopped or TimedOut; the lines after that are not executed.
        """
        self.set_mode("MDI")
        for line in filter(None, map(str.strip, text.splitlines())):
            self._do("mdi", {"line": line}, line, timeout)

    @contextlib.contextmanager
    def sampled(self, signals: list[str] = ()) -> Iterator[Signals]:
        """Samples signals while the block runs: `with channel.sampled(["X.torque"]) as samples:`."""
        state = self.state
        samples = Signals(list(signals), self.number, state.letters, state.axes, self._period)
        samples.begin(self._stream.state)
        self._stream.listen(samples.take)
        try:
            yield samples
        finally:
            self._stream.forget(samples.take)

    def wait(self, timeout: float = 3600.0, wanted: Literal["IDLE", "HELD"] = "IDLE") -> None:
        """Waits until the channel is idle (or held), and raises ProgramStopped when it stops for another reason."""
        self._wait(self.state.program or "the program", self._errors(), self.state.reset_count, timeout, wanted)

    def _in(self, state: dict[str, Any]) -> ChannelState:
        one = state.get("channels", {}).get(str(self.number))
        if one is None:
            raise NotConnected(f"channel {self.number} has not reported; there are {sorted(state.get('channels', {}))}")
        return from_json(ChannelState, one)

    def _errors(self) -> set[tuple[int, ...]]:
        return {alarm.key for alarm in active_alarms(self._stream.state) if alarm.is_error}

    def _do(self, command: str, fields: dict[str, Any], what: str, timeout: float) -> None:
        known, resets = self._errors(), self.state.reset_count
        self.command(command, **fields)
        self._wait(what, known, resets, timeout, "IDLE")

    def _wait(self, what: str, known: set[tuple[int, ...]], resets: int, timeout: float, wanted: str) -> None:
        def ended(state: dict[str, Any]) -> bool:
            one = self._in(state)
            new = [alarm for alarm in active_alarms(state) if alarm.is_error and alarm.key not in known]
            if one.needs_reset or one.reset_count != resets or one.state == "INTERRUPTED":
                raise ProgramStopped(f"{what} was ended by a reset or an emergency stop", new)
            if new and one.state in ("IDLE", "HELD"):
                raise ProgramStopped(f"{what} was stopped in line {one.line}", new)
            return one.state == wanted

        self._stream.wait(ended, timeout)
