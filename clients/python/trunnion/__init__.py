# SPDX-License-Identifier: Apache-2.0
"""Operates a Trunnion machine over its gateway: docs/python.md.

    import trunnion
    with trunnion.connect("http://localhost:8080") as machine:
        samples = machine.channel().run("nas979_cone.nc", ["X.following_peak", "feed"])
        print(samples.largest("X.following_peak"), "mm")

Needs the standard library only, from Python 3.11 on.
"""
from .channel import Channel
from .contour import contour_errors
from .data import Alarm, ChannelState, Parameter, PastAlarm, Plan, Program, Tool
from .errors import Error, NotConnected, ProgramStopped, Refused, TimedOut
from .machine import Machine, connect
from .recordings import Recording, Recordings, StoredRecordings
from .signals import Signals

__all__ = [
    "Alarm", "Channel", "ChannelState", "Error", "Machine", "NotConnected", "Parameter", "PastAlarm", "Plan", "Program", "ProgramStopped",
    "Recording", "Recordings", "Refused", "Signals", "StoredRecordings", "TimedOut", "Tool", "connect", "contour_errors",
]
