# SPDX-License-Identifier: Apache-2.0
"""Conversion between the units of parameters. A unit of the catalogue may name alternatives: "mm/min|deg/min"."""
from __future__ import annotations

import math
from fractions import Fraction

from .errors import Error

# Fractions, so that 24 m/min are 24000 mm/min exactly.
_LENGTH = {"um": Fraction(1, 1000), "mm": Fraction(1), "m": Fraction(1000)}
_ANGLE = {"deg": Fraction(1), "rad": Fraction(180 / math.pi), "mrad": Fraction(0.18 / math.pi)}
_TIME = {"us": Fraction(1, 10**6), "ms": Fraction(1, 1000), "s": Fraction(1), "min": Fraction(60)}


def _factor(unit: str) -> tuple[str, Fraction]:
    """Dimension of a unit, and its size in mm, deg and s."""
    above, *below = unit.split("/")
    dimension, size = "", Fraction(1)
    for part, sign in ((above, 1), *((one, -1) for one in below)):
        power = 1
        while part and part[-1] in "23":
            power, part = int(part[-1]), part[:-1]
        for name, table in (("L", _LENGTH), ("A", _ANGLE), ("T", _TIME)):
            if part in table:
                dimension += name * power if sign > 0 else f"/{name}" * power
                size *= table[part] ** (sign * power)
                break
        else:
            return unit, Fraction(1)
    return dimension, size


def convert(value: float, unit: str, wanted: str) -> float:
    """A value in `unit` (one or several alternatives, as the catalogue has it) in the unit `wanted`.

    Raises Error when the two do not measure the same.
    """
    dimension, size = _factor(wanted)
    for one in unit.split("|"):
        if one == wanted:
            return value
        other, factor = _factor(one)
        if other == dimension:
            return float(Fraction(value) * factor / size)
    raise Error(f"a value in {unit or 'no unit'} cannot be given in {wanted}")
