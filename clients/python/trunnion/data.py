# SPDX-License-Identifier: Apache-2.0
"""Values that the gateway gives, as documented in its interface (/api/openapi.json)."""
from __future__ import annotations

import bisect
import dataclasses
from typing import Any, Literal, TypeVar

from .errors import Error
from .units import convert

Mode = Literal["AUTO", "MDI", "JOG", "REF"]
RunState = Literal["IDLE", "RUNNING", "HOLDING", "HELD", "WAITING", "INTERRUPTED"]
LifeUnit = Literal["MINUTES", "PIECES"]
_Type = TypeVar("_Type")


def from_json(kind: type[_Type], fields: dict[str, Any]) -> _Type:
    """A dataclass of the fields it knows; a newer gateway may send more."""
    names = {field.name for field in dataclasses.fields(kind)}  # type: ignore[arg-type]
    return kind(**{name: value for name, value in fields.items() if name in names})


@dataclasses.dataclass(frozen=True)
class Parameter:
    """One parameter with its limits. `value` is the active value, in `unit`."""

    number: int
    name: str
    unit: str
    type: Literal["integer", "real", "text"]
    value: float | str
    activation: Literal["save", "reset", "restart"]
    access: str
    help: str
    group: str
    minimum: float | None = None
    maximum: float | None = None
    default: float | str | None = None
    pending: bool = False
    #: The stored value that waits for a reset or restart.
    pending_value: float | str | None = None

    @property
    def stored(self) -> float | str:
        """The value after the activation: that which waits, otherwise the active one."""
        return self.pending_value if self.pending and self.pending_value is not None else self.value

    def value_in(self, unit: str) -> float:
        """The active value in another unit, for example "m/min". Raises Error when they do not measure the same."""
        if isinstance(self.value, str):
            raise Error(f"{self.number:06d} {self.name} is a text")
        return convert(self.value, self.unit, unit)


@dataclasses.dataclass(frozen=True)
class Program:
    """An entry of the stored programs."""

    name: str
    revision: int
    size: int
    crc32: int
    lines: int


@dataclasses.dataclass(frozen=True)
class Alarm:
    """An active alarm; docs/alarms.md has cause and remedy of every number."""

    number: int
    severity: Literal["HINT", "WARNING", "ERROR", "EMERGENCY"]
    reaction: Literal["SHOW", "FEED_HOLD", "AXIS_STOP", "EMERGENCY_STOP"]
    source: str
    text: str
    part: int
    instance: int
    cycle: int
    occurrences: int
    since: str

    @property
    def is_error(self) -> bool:
        """Whether it ends or holds what runs."""
        return self.severity in ("ERROR", "EMERGENCY")

    @property
    def key(self) -> tuple[int, int, int, int]:
        """The same for the same alarm; differs when it was raised again."""
        return self.instance, self.number, self.part, self.occurrences


def active_alarms(state: dict[str, Any]) -> list[Alarm]:
    """The alarms of a state of the stream, in its order."""
    return [from_json(Alarm, one) for one in state.get("alarms", {}).values()]


@dataclasses.dataclass(frozen=True)
class PastAlarm:
    """An alarm that there was. Times are ISO 8601; `cleared` is None while it is active."""

    number: int
    severity: Literal["HINT", "WARNING", "ERROR", "EMERGENCY"]
    source: str
    text: str
    part: int
    occurrences: int
    raised: str
    cleared: str | None = None


@dataclasses.dataclass(frozen=True)
class Plan:
    """What a stored program will do, at feed override 100 % and without the times of M, S and T; s and mm."""

    program: str
    revision: int
    seconds: float
    complete: bool
    moves: int
    lines: dict[str, list[float]]
    path: dict[str, list[float]]
    alarm: str | None = None

    def at(self, seconds: float) -> int:
        """The line that is executed at this time after the start."""
        index = bisect.bisect_right(self.lines["begin"], seconds)
        return int(self.lines["line"][max(0, index - 1)]) if self.lines["line"] else 0


@dataclasses.dataclass(frozen=True)
class Tool:
    """A row of the tool table, mm; the life in `life_unit`, as it was entered, with a limit of 0 for none."""

    number: int
    length: float
    length_wear: float
    radius: float
    radius_wear: float
    name: str
    type: str = ""
    life_used: float = 0
    life_limit: float = 0
    life_unit: LifeUnit = "MINUTES"


@dataclasses.dataclass(frozen=True)
class ChannelState:
    """The state of a channel: mm, deg, mm/min, 1/min. Lists have one entry for each axis, in the order of `letters`."""

    channel: int
    name: str
    cycle: int
    mode: Mode
    state: RunState
    program: str
    program_revision: int
    line: int
    lines_total: int
    modal: list[str]
    feed: float
    programmed_feed: float
    feed_override: float
    rapid_override: float
    spindle_override: float
    tool: int
    tool_length: float
    work_offset: int
    rtcp: bool
    axes: list[int]
    letters: str
    machine: list[float]
    workpiece: list[float]
    distance_to_go: list[float]
    reset_count: int
    homed: bool
    suspended: bool
    restart_line: int
    needs_reset: bool
    detail: str

    def position(self, letter: str, coordinates: Literal["machine", "workpiece"] = "machine") -> float:
        """The position of one axis, mm or deg."""
        if letter not in self.letters:
            raise Error(f"channel {self.channel} has no axis {letter}, only {self.letters}")
        return getattr(self, coordinates)[self.letters.index(letter)]
