#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs a stored program and prints the largest following error; plots it where matplotlib is: following_error.py [URL [PROGRAM]]"""
import sys
import trunnion

url, program, *_ = sys.argv[1:] + ["http://localhost:8080", "nas979_cone.nc"][len(sys.argv) - 1 :]
with trunnion.connect(url) as machine:
    channel = machine.channel()
    names = [f"{letter}.following_peak" for letter in channel.state.letters]
    samples = channel.run(program, names)
worst = max(names, key=samples.largest)
print(f"largest following error: {worst[0]} {samples.largest(worst):.6f} mm or deg, {len(samples)} samples in {samples.time[-1]:.1f} s")
try:
    from matplotlib import pyplot
except ImportError:
    sys.exit()
pyplot.plot(samples.time, list(zip(*(samples[name] for name in names))), label=names)
pyplot.legend()
pyplot.show()
