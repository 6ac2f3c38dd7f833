# SPDX-License-Identifier: Apache-2.0
"""Signals over time, collected from the stream: one sample for each of its messages, up to 20 a second.

A name is that of an axis and one of its values, "X.following_peak", or a value of the channel, "feed", or of the drive,
"drive.starved". `following_peak` is the largest following error since the message before it, so no peak is between two
samples as long as this client gets every message.
"""
from __future__ import annotations

from typing import Any

from .errors import Error

AXIS_VALUES = ("commanded", "actual", "following_error", "following_peak", "position", "velocity", "torque")
CHANNEL_VALUES = ("feed", "programmed_feed", "line", "tool", "feed_override", "rapid_override", "spindle_override")
DRIVE_VALUES = ("executed", "tick", "starved")


class Signals:
    """Samples of the signals with these names."""

    def __init__(self, names: list[str], channel: int, letters: str, axes: list[int], period: float):
        """letters and axes: those of the channel; period: seconds of an interpolation cycle. Raises Error for a name."""
        self.names = list(names)
        self.channel = channel
        self._period = period
        self._read = [self._reader(name, letters, axes) for name in names]
        #: Machine time in seconds since begin().
        self.time: list[float] = []
        self._values: list[list[float]] = [[] for _ in names]
        self._first_tick: int | None = None

    def _reader(self, name: str, letters: str, axes: list[int]) -> tuple[str, str, str]:
        owner, _, value = name.rpartition(".")
        if owner == "" and value in CHANNEL_VALUES:
            return "channels", str(self.channel), value
        if owner == "drive" and value in DRIVE_VALUES:
            return "drive", "", value
        if len(owner) == 1 and owner in letters and value in AXIS_VALUES:
            return "axes", str(axes[letters.index(owner)]), value
        raise Error(
            f"there is no signal {name}: X.VALUE with an axis of {letters} and one of {', '.join(AXIS_VALUES)}; "
            f"one of {', '.join(CHANNEL_VALUES)}; or drive. with one of {', '.join(DRIVE_VALUES)}"
        )

    def begin(self, state: dict[str, Any]) -> None:
        """Time zero is that of this state; without it that of the first sample."""
        self._first_tick = (state.get("drive") or {}).get("tick")

    def take(self, state: dict[str, Any]) -> None:
        """Adds a sample; a state without one of the values adds none."""
        row = []
        for part, key, value in self._read:
            owner = state.get(part) or {}
            number = (owner.get(key) or {} if key else owner).get(value)
            if number is None:
                return
            row.append(float(number))
        tick = (state.get("drive") or {}).get("tick")
        if tick is None:
            return
        if self._first_tick is None:
            self._first_tick = tick
        self.time.append((tick - self._first_tick) * self._period)
        for values, number in zip(self._values, row):
            values.append(number)

    def __len__(self) -> int:
        return len(self.time)

    def __getitem__(self, name: str) -> list[float]:
        """The samples of one signal."""
        try:
            return self._values[self.names.index(name)]
        except ValueError:
            raise KeyError(f"{name} was not recorded, only {', '.join(self.names)}") from None

    def largest(self, name: str) -> float:
        """The largest magnitude of a signal; 0 without samples."""
        return max((abs(value) for value in self[name]), default=0.0)

    def array(self, *names: str) -> Any:
        """The samples as a numpy array with a column for each name (all without names). Needs numpy."""
        import numpy

        return numpy.array([self[name] for name in names or self.names], dtype=float).T
