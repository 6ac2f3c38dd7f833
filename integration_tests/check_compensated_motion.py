#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_compensated_motion.py TRUNNION WORK: WORK/mill ran a program; kinematics_batch.csv and compensation_batch.csv have its
setpoints before and after compensation. Every axis stays within its speed, acceleration and jerk, and the tool on the true
machine is at most 15 % as far from the program as without compensation."""
import csv, math, re, subprocess, sys
trunnion, work = sys.argv[1:]
AXES = "XYZAC"
CYCLE = 1e-3  # s


def parameters():
    values = {}
    for line in open(f"{work}/mill/parameters.yaml", encoding="utf-8"):
        found = re.match(r'"(\d{6})": ([-+.\deE]+)', line)
        if found: values[int(found.group(1))] = float(found.group(2))
    return values


def rows(topic):
    with open(f"{work}/{topic}.csv", encoding="utf-8") as f: return list(csv.DictReader(f))


def setpoint(row): return [float(row[f"setpoint.axis{i}"]) for i in range(len(AXES))]


def true_poses(positions):
    """Tip and its deviation, mm, of the machine without compensation at each of the positions."""
    text = "\n".join(" ".join(f"{a}{v:.9f}" for a, v in zip(AXES, row)) for row in positions)
    out = subprocess.run([trunnion, "truth", f"{work}/mill", "--tool-length", "100", "--set", "040951=0"], input=text, text=True,
                         capture_output=True, check=True)
    poses = [[float(v) for v in line.split()] for line in out.stdout.splitlines()]
    return [pose[:3] for pose in poses], [[d / 1000 for d in pose[6:9]] for pose in poses]


def mean_length(vectors):
    """About the mean vector: setting the workpiece zero removes it."""
    mean = [sum(v[i] for v in vectors) / len(vectors) for i in range(3)]
    return sum(math.dist(v, mean) for v in vectors) / len(vectors)


def check_limits(after):
    values = parameters()
    failed = False
    for axis, letter in enumerate(AXES):
        base = 100000 + 1000 * axis
        limits = (values[base + 34] / 60, values[base + 36], values.get(base + 38, 60000))
        x = [setpoint(row)[axis] for row in after]
        for name, limit in zip(("speed", "acceleration", "jerk"), limits):
            x = [(b - a) / CYCLE for a, b in zip(x, x[1:])]
            used = max(abs(v) for v in x) / limit
            print(f"{letter} {name}: {100 * used:.1f} % of its limit")
            failed = failed or used > 1
    return failed


def check_place(before, after):
    cut = [i for i, row in enumerate(before) if row["snapshot.transformation"] == "RTCP" and float(row["snapshot.tool_length"]) == 100]
    tips, errors = true_poses([setpoint(before[i]) for i in cut])
    reached, _ = true_poses([setpoint(after[i]) for i in cut])
    left = [[r - (t - e) for r, t, e in zip(*v)] for v in zip(reached, tips, errors)]
    without, with_it = mean_length(errors), mean_length(left)
    print(f"{len(cut)} setpoints: mean deviation of the tip {1000 * without:.2f} um, compensated {1000 * with_it:.2f} um")
    return len(cut) < 50 or with_it > 0.15 * without


if __name__ == "__main__":
    kinematics, compensation = rows("kinematics_batch"), rows("compensation_batch")
    if [r["cycle"] for r in kinematics] != [r["cycle"] for r in compensation]: sys.exit("the cycles differ")
    if check_limits(compensation) | check_place(kinematics, compensation): sys.exit("a limit or the place is exceeded")
