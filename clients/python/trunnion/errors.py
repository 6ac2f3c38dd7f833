# SPDX-License-Identifier: Apache-2.0
"""What can go wrong, from the caller's view."""
from __future__ import annotations


class Error(Exception):
    """Of everything that this package raises by itself."""


class NotConnected(Error):
    """The gateway does not answer: not started, another port, or the connection was lost."""


class Refused(Error):
    """The cluster has refused a request and changed nothing; the text is its reason.

    status: the HTTP status. alarm: the number of the alarm that explains it, 0 without.
    """

    def __init__(self, reason: str, status: int = 0, alarm: int = 0):
        super().__init__(reason + (f" (alarm {alarm})" if alarm else ""))
        self.status = status
        self.alarm = alarm


class TimedOut(Error):
    """Something did not happen within the given time."""


class ProgramStopped(Error):
    """A program or an MDI line did not come to its end. `alarms` has what was raised meanwhile."""

    def __init__(self, reason: str, alarms: list = ()):
        super().__init__("; ".join([reason, *(f"{one.number}: {one.text}" for one in alarms)]))
        self.alarms = list(alarms)
