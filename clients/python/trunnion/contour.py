# SPDX-License-Identifier: Apache-2.0
"""The contour error: how far from the commanded path an axis group was, wherever on it it should have been at that time."""
from __future__ import annotations

import math
from collections.abc import Sequence

Point = Sequence[float]


def _from_segment(p: Point, a: Point, b: Point) -> float:
    """Distance of p from the straight line between a and b."""
    along = [y - x for x, y in zip(a, b)]
    length = sum(x * x for x in along)
    share = 0.0 if length == 0 else sum((x - y) * z for x, y, z in zip(p, a, along)) / length
    share = min(1.0, max(0.0, share))
    return math.dist(p, [x + share * y for x, y in zip(a, along)])


def contour_errors(commanded: Sequence[Point], actual: Sequence[Point], reach: int = 100) -> list[float]:
    """Of each actual point its distance from the polyline of the commanded ones, in their unit.

    Both have one point for each cycle, with the same coordinates: mm in one frame, for example X Y Z of the machine. Only the part
    of the path from `reach` cycles before to one cycle behind the same cycle is looked at, so that another pass of the path at
    the same place does not count; `reach` has to be longer than the axes lag behind. Raises ValueError when the lengths differ.
    """
    if len(commanded) != len(actual):
        raise ValueError(f"{len(commanded)} commanded points and {len(actual)} actual ones")
    errors = []
    for cycle, point in enumerate(actual):
        part = commanded[max(0, cycle - reach) : cycle + 2]
        pairs = zip(part, part[1:]) if len(part) > 1 else [(part[0], part[0])]
        errors.append(min(_from_segment(point, a, b) for a, b in pairs))
    return errors
