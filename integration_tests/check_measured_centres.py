# SPDX-License-Identifier: Apache-2.0
"""check_measured_centres.py TRUNNION MACHINE VARIABLES: the centres that %001 has measured are those of the true machine.

At a measured centre with the rotary axes of its teaching point, the true tip is in the centre of the sphere in the frame
of the workpiece, as `trunnion truth` says."""
import json
import subprocess
import sys

trunnion, machine, file = sys.argv[1:]
with open(file, encoding="utf-8") as text:
    variables = {int(number): value for number, value in json.load(text).items()}
poses = []
for n in range(16):
    x, y, z = (variables[52900 + 3 * n + i] for i in range(3))
    base = 52100 + n if n < 8 else 52800 + n - 8
    poses.append(f"X{x:.9f} Y{y:.9f} Z{z:.9f} A{variables[base + 30]:.9f} C{variables[base + 40]:.9f}")
told = subprocess.run([trunnion, "truth", machine, "--tool-length", "150"], input="\n".join(poses) + "\n",
                      capture_output=True, text=True, check=True).stdout.splitlines()
worst = 0.0
for pose, line in zip(poses, told, strict=True):
    tip = [float(word) for word in line.split()[:3]]
    error = max(abs(a - b) for a, b in zip(tip, (120, 60, -330), strict=True))
    worst = max(worst, error)
    # The encoders count 10 nm and 0.36 arc seconds; the servos follow within some 0.1 um at F50.
    if error > 0.001:
        sys.exit(f"{pose}: the true tip is at {tip}, {error * 1000:.2f} um from the centre of the sphere")
print(f"largest deviation of 16 centres: {worst * 1000:.3f} um")
