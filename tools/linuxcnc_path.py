#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The path of a program as LinuxCNC's own interpreter reads it: lines of JSON like those of `trunnion check --jsonl`.

    /usr/bin/python3 tools/linuxcnc_path.py PROGRAM

Needs the Python module `gcode` of the Debian package linuxcnc-uspace, whose numbers have all digits; `rs274 -g` prints four
decimals. Every tool is there with length and radius 0, every offset is 0. Exit status 1 when LinuxCNC refuses the program,
2 when it is not installed.
"""
import ctypes
import json
import math
import os
import sys
import tempfile

MILLIMETRES = 25.4  # of the inch that the module counts in
TOOLS = 999
AXES = 'XYZABC'
ORDER = {1: (0, 1, 2), 2: (1, 2, 0), 3: (2, 0, 1)}  # first, second and normal axis of G17, G19 and G18
PLANES = {1: 'XY', 2: 'YZ', 3: 'ZX'}


class Path:
    """Receives the moves; orders that make no path have no effect."""

    def __init__(self, parameter_file):
        self.parameter_file = parameter_file
        self.offsets = {'g5x': (0.0,) * 6, 'g92': (0.0,) * 6}
        self.rotation = 0.0  # rad
        self.plane = 1

    def __getattr__(self, name):
        return lambda *arguments: None

    def get_tool(self, pocket):
        """Every pocket has the tool of its number, all of whose values are 0."""
        return (pocket,) + (0.0,) * 12 + (0,)

    def get_external_length_units(self):
        return 1.0 / MILLIMETRES

    def get_external_angular_units(self):
        return 1.0

    def get_axis_mask(self):
        return 0b111111

    def get_block_delete(self):
        return 0

    def set_plane(self, plane):
        self.plane = plane

    def set_g5x_offset(self, index, *values):
        self.offsets['g5x'] = values[:6]

    def set_g92_offset(self, *values):
        self.offsets['g92'] = values[:6]

    def set_xy_rotation(self, degrees):
        self.rotation = math.radians(degrees)

    def machine(self, point):
        """Machine coordinates in inch and deg of a point of the program."""
        x, y, *others = (value + offset for value, offset in zip(point, self.offsets['g92']))
        cosine, sine = math.cos(self.rotation), math.sin(self.rotation)
        turned = (x * cosine - y * sine, x * sine + y * cosine, *others)
        return [value + offset for value, offset in zip(turned, self.offsets['g5x'])]

    def write(self, kind, point, centre=None, turns=0):
        end = [value * (MILLIMETRES if i < 3 else 1.0) for i, value in enumerate(self.machine(point))]
        move = {'kind': kind, 'mcs': dict(zip(AXES, end))}
        if centre is not None:
            move['center'] = [value * MILLIMETRES for value in self.machine((*centre, 0.0, 0.0, 0.0))[:3]]
            move.update(plane=PLANES[self.plane], cw=turns < 0, turns=abs(turns))
        print(json.dumps(move))

    def straight_traverse(self, *point):
        self.write('rapid', point[:6])

    def straight_feed(self, *point):
        self.write('line', point[:6])

    def straight_probe(self, *point):
        self.write('line', point[:6])

    def rigid_tap(self, x, y, z):
        self.write('line', (x, y, z, 0.0, 0.0, 0.0))

    def arc_feed(self, first, second, centre_first, centre_second, turns, normal, *rotary):
        """An arc or helix; the centre is at the height of the end."""
        end, centre = [0.0] * 3, [0.0] * 3
        for axis, at, about in zip(ORDER[self.plane], (first, second, normal), (centre_first, centre_second, normal)):
            end[axis], centre[axis] = at, about
        self.write('arc', (*end, *rotary[:3]), centre, turns)


def load_tools(directory):
    """The interpreter has its tools from memory that LinuxCNC shares, a file in the home directory."""
    os.environ['HOME'] = directory
    table = os.path.join(directory, 'tools.tbl')
    with open(table, 'w', encoding='ascii') as file:
        file.writelines(f'T{tool} P{tool} Z0 D0\n' for tool in range(1, TOOLS + 1))
    library = ctypes.CDLL('libtooldata.so.0', ctypes.RTLD_GLOBAL)
    library._Z17tool_mmap_creatorPK13EMC_TOOL_STATi(None, 0)
    library._Z13tooldata_loadPKcPPc(table.encode(), None)


def main():
    with tempfile.TemporaryDirectory() as directory:
        try:
            load_tools(directory)
            import gcode
        except (ImportError, OSError, AttributeError):
            sys.exit(2)
        path = Path(os.path.join(directory, 'parameters.var'))
        with open(path.parameter_file, 'w', encoding='ascii'):
            pass
        result, line = gcode.parse(sys.argv[1], path, 'G21', '')
    if result > gcode.MIN_ERROR:
        print(f'{sys.argv[1]}:{line}: {gcode.strerror(result)}', file=sys.stderr)
        sys.exit(1)


if __name__ == '__main__':
    main()
