#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes one side of an S-shaped test piece, flank milling, as a five-axis program with tool tip control (RTCP).

The test piece of ISO 10791-7 is an S-shaped strip with ruled sides on a base. The HNC-8 five-axis manual ("S-shaped test
piece") gives 300 x 200 x 70 mm over all, a base of 30 mm, a rim 3 mm thick, a tool D20R0, 6500 1/min with 0.07 mm per tooth
and two teeth (910 mm/min), and names uneven steps and a tool axis that swings between them as the faults of programs. The
curves of the standard are not used: the sides here are our own, of the same kind, with even steps of the tool tip.

The side is ruled between two sine curves, at the base and at the top of the strip. The rulings lean by 8.5 to 18 deg and
never stand upright, so that no step passes a pole. The tool axis lies along the ruling, one radius from the side at half its
height; a ruled side is twisted, so above and below that the flank is off by what the header of the program says. The piece
lies with its middle at X0 Y0 and its lower face at Z0 of G54.
"""
import bisect
import math

from five_axis import add, cross, direction, dot, follow, milling, run, unit

BASE, TOP = 30.0, 70.0         # mm, height of the strip's lower and upper edge
HALF_LENGTH = 115.0            # mm, of the strip in X
AMPLITUDE, WIDENING = 60.0, 12.0  # mm, of the curve at the base, and how much larger it is at the top
LEAN = 6.0                     # mm in X between base and top
TOOL_RADIUS = 10.0             # mm
FLOOR = 4.5                    # mm between the tip and the base, so that a leaning tool does not touch it
OVERRUN = 0.03                 # of the curve's parameter, before and after the strip
STEPS = 200
RETRACT = 50.0                 # mm along the tool axis
SPEED, FEED_PER_TOOTH, TEETH = 6500, 0.07, 2


def surface(t, h):
    """Point of the side; t = 0 .. 1 along the strip, h = 0 .. 1 from the base to the top."""
    return (HALF_LENGTH * (2 * t - 1) + LEAN * h, -(AMPLITUDE + WIDENING * h) * math.sin(2 * math.pi * t),
            BASE + (TOP - BASE) * h)


def along(t, h):
    """Derivative of the side by t."""
    return (2 * HALF_LENGTH, -(AMPLITUDE + WIDENING * h) * 2 * math.pi * math.cos(2 * math.pi * t), 0.0)


def pose(t):
    """Tip and tool vector that mill the ruling at t."""
    ruling = add(surface(t, 1), surface(t, 0), -1)
    tool = unit(ruling)
    middle = add(surface(t, 0.5), unit(cross(along(t, 0.5), ruling)), TOOL_RADIUS)
    return add(middle, tool, (BASE + FLOOR - middle[2]) / tool[2]), tool


def even_parameters():
    """Parameters of tips at equal distances along the path of the tip."""
    fine = 20000
    at = [-OVERRUN + (1 + 2 * OVERRUN) * k / fine for k in range(fine + 1)]
    tips = [pose(t)[0] for t in at]
    length = [0.0]
    for p, q in zip(tips, tips[1:]):
        length.append(length[-1] + math.dist(p, q))
    for k in range(STEPS + 1):
        target = length[-1] * k / STEPS
        i = min(max(bisect.bisect_left(length, target), 1), fine)
        share = (target - length[i - 1]) / (length[i] - length[i - 1])
        yield at[i - 1] + share * (at[i] - at[i - 1])


def flank_error():
    """Largest difference of the side's distance from the tool axis and the radius, over rulings and heights."""
    largest = 0.0
    for k in range(201):
        tip, tool = pose(k / 200)
        for h in (0.1, 0.25, 0.5, 0.75, 1.0):
            nearest = math.inf
            for j in range(-50, 51):
                q = add(surface(k / 200 + 0.0008 * j, h), tip, -1)
                nearest = min(nearest, math.sqrt(dot(q, q) - dot(q, tool) ** 2))
            largest = max(largest, abs(nearest - TOOL_RADIUS))
    return largest


def check(machine, path):
    """The numbers a wrong sign or an uneven step would break."""
    assert max(math.dist(direction(machine, *pair), tool) for _, tool, pair in path) < 1e-12
    steps = [math.dist(p[0], q[0]) for p, q in zip(path, path[1:])]
    assert max(steps) < 1.01 * min(steps), "uneven steps"
    lean = [math.degrees(math.acos(tool[2])) for _, tool, _ in path]
    assert 8 < min(lean) and max(lean) < 20
    assert max(abs(q[2][1] - p[2][1]) for p, q in zip(path, path[1:])) < 5, "C jumps"
    for axis, half in ((0, 150), (1, 100)):
        assert all(abs(tip[axis]) < half for tip, _, _ in path), "beyond the piece"


def program(machine):
    tips = [pose(t) for t in even_parameters()]
    path = [(tip, tool, pair) for (tip, tool), pair in zip(tips, follow(machine, [tool for _, tool in tips]))]
    check(machine, path)
    comments = [
        "S-shaped test piece, one side: 300 x 200 x 70 mm, base 30 mm",
        f"tool 1: end mill {2 * TOOL_RADIUS:g} mm; G54: middle of the lower face",
        f"{STEPS} blocks of {math.dist(path[0][0], path[1][0]):.2f} mm, flank off the twisted side by {flank_error():.3f} mm at most",
    ]
    return milling(machine, "0791", comments, SPEED, round(SPEED * FEED_PER_TOOTH * TEETH), RETRACT, path)


if __name__ == "__main__":
    run(__doc__, lambda options: program(options.machine))
