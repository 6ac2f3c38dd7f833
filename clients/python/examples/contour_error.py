#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Records a stored program of a three-axis path and plots its contour error: contour_error.py [URL [PROGRAM]]"""
import sys
import trunnion

url, program, *_ = sys.argv[1:] + ["http://localhost:8080", "nas979_cone.nc"][len(sys.argv) - 1 :]
with trunnion.connect(url) as machine:
    channel, name = machine.channel(), machine.stored_recordings.start()
    try:
        channel.run(program)
    finally:
        machine.stored_recordings.stop(name)
    columns = [channel.column(letter) for letter in "XYZ"]
    table = machine.stored_recordings.table(name)
commanded, actual = (list(zip(*(table[f"{what}[{i}]"] for i in columns))) for what in ("commanded", "actual"))
errors = trunnion.contour_errors(commanded, actual)
print(f"largest contour error: {max(errors):.6f} mm in {len(errors)} cycles")
try:
    from matplotlib import pyplot
except ImportError:
    sys.exit()
pyplot.plot(table["cycle"], errors, label="contour error, mm")
pyplot.legend()
pyplot.show()
