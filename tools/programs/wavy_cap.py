#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the paths the planner is measured with: a winding line over a wavy cap in blocks of 0.1 mm.

The cap is z = -r^2 / 160 with waves of 0.4 mm every 24 mm; the line winds over it by r = 20 + 8 sin 3f. With five axes, on an
A C table with tool tip control, the tool follows the surface normal and leans outwards besides, so that A never reaches 0 and
both rotary axes move all along. With --three-axis the rotary axes are left out: a dense three-axis path. Coordinates are
rounded to 0.0001 as a post-processor writes them. `trunnion bench motion` plans the same two paths.
"""
import math

from five_axis import run

STEP = 0.1             # mm of tip travel in a block
LEAN = 0.35            # tangent of the angle to the normal, outwards
WAVE, PITCH = 0.4, 24  # mm


def surface(f):
    """(x, y, z, dz/dx, dz/dy) where the line is at its parameter f."""
    r, k = 20 + 8 * math.sin(3 * f), 2 * math.pi / PITCH
    x, y = r * math.cos(f), r * math.sin(f)
    return (x, y, -(x * x + y * y) / 160 + WAVE * math.sin(k * x) * math.cos(k * y),
            -x / 80 + WAVE * k * math.cos(k * x) * math.cos(k * y), -y / 80 - WAVE * k * math.sin(k * x) * math.sin(k * y))


def angles(place, c_before):
    """A and C of a tool along the normal that leans outwards; C continues from `c_before` without a jump."""
    x, y, _, slope_x, slope_y = place
    radius = math.hypot(x, y)
    nx, ny = -slope_x + LEAN * x / radius, -slope_y + LEAN * y / radius
    c = math.degrees(math.atan2(nx, -ny))
    return math.degrees(math.atan(math.hypot(nx, ny))), c + 360 * round((c_before - c) / 360)


def parameters(length):
    """Of places at equal distances of tip travel, to second order."""
    h, f = 1e-5, 0.0
    for _ in range(round(length / STEP)):
        df = STEP * h / math.dist(surface(f)[:3], surface(f + h)[:3])
        df = STEP * h / math.dist(surface(f + df / 2)[:3], surface(f + df / 2 + h)[:3])
        f += df
        yield f


def program(length, three_axis, feed):
    yield "G90 G94 G64"
    if not three_axis:
        yield "T1 M6"
        yield "G43.4 H1"
    c = angles(surface(0), 0)[1]
    for f in parameters(length):
        place = surface(f)
        words = list(zip("XYZ", place))
        if not three_axis:
            a, c = angles(place, c)
            words += [("A", a), ("C", c)]
        assert all(math.isfinite(value) for _, value in words)
        yield "G1 " + " ".join(f"{letter}{value:.4f}" for letter, value in words) + feed
        feed = ""
    yield "M30"


if __name__ == "__main__":
    run(__doc__, lambda options: program(options.length, options.three_axis, f" F{options.feed:g}"), [
        ("--length", {"type": float, "default": 300.0, "help": "mm of tip travel (default 300)"}),
        ("--feed", {"type": float, "default": 2000.0, "help": "mm/min (default 2000)"}),
        ("--three-axis", {"action": "store_true", "help": "without rotary axes"}),
    ], machines=("ac-table",))
