#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the NAS 979 cone frustum, side milling, as a five-axis program with tool tip control (RTCP).

The test piece is a cone frustum on a base whose top is tilted. The side is milled with the flank of an end mill:
the tool axis lies along the cone's generatrix, one radius outside of it, the tip a little below the lower rim.

Dimensions. The HNC-8 five-axis manual ("Five-axis NAS Workpiece") gives a base tilted by 10 deg and, for large
machines, a base diameter of 254 mm, a thickness of 63.5 mm and a side slope of 15 deg on a base of 7.5 deg. Its figure with
the ordinary size is missing from the text at hand; the ordinary size here is the large one scaled to a base diameter
of 80 mm (thickness 80 * 63.5 / 254 = 20 mm) with the same slope of 15 deg, which the tilt of 10 deg must stay below so
that the tool never passes the vertical. Cutting data from the same section: end mill of 20 mm, 400 m/min, 0.05 to
0.10 mm per tooth (here four teeth, 0.08 mm).

Machine. The swing (A or B) stays positive, slope - tilt .. slope + tilt, and C turns continuously through one revolution
and a little more; a negative swing with C turned by 180 deg would be the mirror image. G54 is the centre of the base
plate on the table.
"""
import math

from five_axis import add, direction, follow, milling, run

SIZES = {  # base diameter mm, thickness mm, slope deg, tilt deg, height of the base under the cone's centre mm
    "standard": (80.0, 20.0, 15.0, 10.0, 40.0),
    "large": (254.0, 63.5, 15.0, 7.5, 60.0)}
TOOL_RADIUS = 10.0       # mm
OVERHANG = 2.0           # mm of the tip beyond the lower rim, along the tool axis
CLEARANCE = 6.0          # mm between flank and side at the beginning of the approach
APPROACH = 30.0          # degrees of turn in which the tool reaches the side, and leaves it
OVERLAP = 2.0            # degrees milled twice, so that start and end leave no ridge
RETRACT = 60.0           # mm along the tool axis
CHORD_ERROR = 0.002      # mm, at most
LARGEST_STEP = 0.5       # degrees of turn in one block
CUTTING_SPEED = 400.0    # m/min
FEED_PER_TOOTH, TEETH = 0.08, 4


class Cone:
    def __init__(self, size):
        diameter, self.thickness, self.slope, self.tilt, height = SIZES[size]
        self.radius = diameter / 2
        self.centre = (0.0, 0.0, height)
        # The tilted face is turned to the operator: its normal leans towards -Y.
        t = math.radians(self.tilt)
        self.u, self.v, self.axis = (1.0, 0.0, 0.0), (0.0, math.cos(t), math.sin(t)), (0.0, -math.sin(t), math.cos(t))

    def pose(self, turn, gap):
        """Tip and tool vector at `turn` degrees about the cone's axis with the flank `gap` mm off the side."""
        phi, s = math.radians(turn), math.radians(self.slope)
        outward = tuple(math.cos(phi) * x + math.sin(phi) * y for x, y in zip(self.u, self.v))
        tool = add(tuple(math.cos(s) * x for x in self.axis), outward, -math.sin(s))
        normal = add(tuple(math.cos(s) * x for x in outward), self.axis, math.sin(s))
        rim = add(self.centre, outward, self.radius)
        return add(add(rim, normal, TOOL_RADIUS + gap), tool, -OVERHANG), tool

    def tip_radius(self):
        s = math.radians(self.slope)
        return self.radius + TOOL_RADIUS * math.cos(s) + OVERHANG * math.sin(s)

    def step(self):
        """Degrees of turn of one block: a chord of the tip's circle is CHORD_ERROR inside of it at most."""
        return min(LARGEST_STEP, math.degrees(2 * math.acos(1 - CHORD_ERROR / self.tip_radius())))


def poses(cone):
    """(tip, tool vector) of every block end."""
    first, last = -APPROACH, 360.0 + OVERLAP + APPROACH
    count = math.ceil((last - first) / cone.step())
    # Where the cut begins the tool leans most, so that C turns slowest there.
    begin = 90.0
    # Clockwise about the piece: climb milling with M3.
    for k in range(count + 1):
        turn = first + (last - first) * k / count
        off = max(0.0, -turn, turn - 360.0 - OVERLAP) / APPROACH
        # The gap closes with the square of the way left, which meets the side tangentially.
        yield cone.pose(begin - turn, CLEARANCE * off * off)


def check(machine, cone, path):
    """The numbers a wrong sign or a wrong unwrapping would break."""
    largest = max(math.dist(direction(machine, a, c), tool) for _, a, c, tool in path)
    assert largest < 1e-12, f"rotary angles miss the tool vector by {largest}"
    assert all(cone.slope - cone.tilt - 1e-9 <= a <= cone.slope + cone.tilt + 1e-9 for _, a, _, _ in path)
    # The milled part turns C by one revolution and the ends; no step may be anything like a jump.
    jump = max(abs(q[2] - p[2]) for p, q in zip(path, path[1:]))
    assert jump < 10 * LARGEST_STEP, f"C jumps by {jump} deg"
    assert abs(path[-1][2] - path[0][2]) > 360.0
    # Where the tool cuts, its axis is one radius from the cone: distance of the tool axis's points from the side.
    s = math.radians(cone.slope)
    for tip, _, _, tool in path[len(path) // 4:3 * len(path) // 4]:
        for along in (OVERHANG, OVERHANG + cone.thickness / math.cos(s)):
            q = add(add(tip, tool, along), cone.centre, -1)
            h = sum(x * y for x, y in zip(q, cone.axis))
            rho = math.sqrt(max(0.0, sum(x * x for x in q) - h * h))
            assert abs((rho - (cone.radius - h * math.tan(s))) * math.cos(s) - TOOL_RADIUS) < 1e-9


def program(machine, size):
    cone = Cone(size)
    tips = list(poses(cone))
    path = [(tip, *pair, tool) for (tip, tool), pair in zip(tips, follow(machine, [tool for _, tool in tips]))]
    check(machine, cone, path)
    speed = round(CUTTING_SPEED * 1000 / (math.pi * 2 * TOOL_RADIUS))
    feed = round(speed * FEED_PER_TOOTH * TEETH)
    comments = [
        f"NAS 979 cone frustum, side: base {2 * cone.radius:g} mm, thickness {cone.thickness:g} mm,"
        f" slope {cone.slope:g} deg, tilted {cone.tilt:g} deg",
        f"tool 1: end mill {2 * TOOL_RADIUS:g} mm; G54: centre of the base plate on the table",
        f"blocks of {cone.step():.3f} deg, chord error at most {CHORD_ERROR:g} mm",
    ]
    milled = [(tip, tool, (a, c)) for tip, a, c, tool in path]
    return milling(machine, "0979", comments, speed, feed, RETRACT, milled)


if __name__ == "__main__":
    size = ("--size", {"choices": sorted(SIZES), "default": "standard", "help": "size of the test piece"})
    run(__doc__, lambda options: program(options.machine, options.size), [size])
