# SPDX-License-Identifier: Apache-2.0
"""What the program generators know of five-axis machines: rotary angles of a tool direction, and the words of a program.

The tool direction points from the tip to the spindle, seen from the workpiece (docs/kinematics.md). A stays positive and B
stays positive, so that C turns without jumps as long as the direction does not pass the vertical.
"""
import argparse
import math
import sys

# Machine: letters of the rotary axes, travel of C in degrees (0: endless), height of the first safe place over the part in Z.
MACHINES = {"ac-table": ("AC", 0), "cb-head": ("BC", 380), "b-head-c-table": ("BC", 0)}


def add(a, b, factor=1.0):
    return tuple(x + factor * y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return tuple(x / math.sqrt(dot(a, a)) for x in a)


def rotate(axis, degrees, v):
    """Rodrigues' formula, as libs/motion/geometry turns a table."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    k = cross(axis, v)
    return tuple(c * v[i] + s * k[i] + (1 - c) * dot(axis, v) * axis[i] for i in range(3))


def direction(machine, swing, c):
    """The tool direction at the two rotary positions, in the order of the machine's letters."""
    if machine == "ac-table":
        return rotate((0, 0, -1), -c, rotate((-1, 0, 0), -swing, (0, 0, 1)))
    if machine == "cb-head":
        return rotate((0, 0, 1), c, rotate((0, 1, 0), swing, (0, 0, 1)))
    return rotate((0, 0, -1), -c, rotate((0, 1, 0), swing, (0, 0, 1)))


def angles(machine, tool):
    """(swing, C) with a positive swing. AC table: the tool leans to (sin A sin C, -sin A cos C); B with C: to (sin B cos C,
    sin B sin C), whether C turns the head or the table."""
    swing = math.degrees(math.atan2(math.hypot(tool[0], tool[1]), tool[2]))
    return swing, math.degrees(math.atan2(tool[0], -tool[1]) if machine == "ac-table" else math.atan2(tool[1], tool[0]))


def follow(machine, tools):
    """(swing, C) of each direction; C continues without jumps and, where its travel ends, about the middle of it."""
    path = []
    for tool in tools:
        swing, c = angles(machine, tool)
        if path:
            c += 360 * round((path[-1][1] - c) / 360)
        path.append((swing, c))
    travel = MACHINES[machine][1]
    if travel:
        middle = (min(c for _, c in path) + max(c for _, c in path)) / 2
        path = [(swing, c - 360 * round(middle / 360)) for swing, c in path]
        assert all(abs(c) <= travel for _, c in path), "C leaves its travel"
    return path


def word(letter, value):
    text = f"{value:.5f}".rstrip("0").rstrip(".")
    return letter + ("0" if text in ("-0", "") else text)


def linear(point):
    return " ".join(word(letter, value) for letter, value in zip("XYZ", point))


def rotary(machine, pair):
    return " ".join(word(letter, value) for letter, value in zip(MACHINES[machine][0], pair))


def milling(machine, number, comments, speed, feed, retract, path):
    """The lines of a program that mills along `path`, a list of (tip, tool direction, (swing, C)), with tool tip control.

    Exact stops where the contour begins and ends: how a corner is rounded there in time depends on the machine.
    """
    yield from ("%", f"O{number}")
    yield from (f"({comment})" for comment in comments)
    yield "G21 G17 G90 G54 G94 G64 G49"
    yield "T1 M6"
    yield f"S{speed} M3"
    yield "G53 G0 Z0"
    (tip, tool, pair), last = path[0], path[-1]
    yield f"G0 {rotary(machine, pair)}"
    yield "G43.4 H1"
    yield f"G9 G0 {linear(add(tip, tool, retract))}"
    yield f"G9 G1 {linear(tip)} F{feed}"
    for tip, _, pair in path[1:-1]:
        yield f"G1 {linear(tip)} {rotary(machine, pair)}"
    tip, tool, pair = last
    yield f"G9 G1 {linear(tip)} {rotary(machine, pair)}"
    yield f"G1 {linear(add(tip, tool, retract))}"
    yield from ("G49", "G53 G0 Z0", "M5", "M30", "%")


def run(description, lines_of, options=(), machines=tuple(sorted(MACHINES))):
    """The command line every generator has: `lines_of` makes the program from the parsed options, of which `options` are
    (name, keywords of add_argument) besides --machine and --output."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, keywords in options:
        parser.add_argument(name, **keywords)
    parser.add_argument("--machine", choices=machines, default="ac-table", help="machine the program is for")
    parser.add_argument("--output", help="file to write (default: standard output)")
    chosen = parser.parse_args()
    text = "\n".join(lines_of(chosen)) + "\n"
    if chosen.output:
        with open(chosen.output, "w", encoding="ascii", newline="\n") as file:
            file.write(text)
    else:
        sys.stdout.write(text)
