#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs cells of the fault matrix, two clusters at a time, and writes docs/fault-matrix.md when every cell holds.

A cell that has passed is not run again until --fresh: an interrupted run continues with the remaining cells. With --sample N it
runs N cells that --seed chooses and writes nothing.
"""
import argparse, json, os, random, subprocess, sys, threading, time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def cells(program):
    """Names, every fault of every service once before any with another layout: a run that is interrupted early has covered all of them."""
    listed = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
    found = [line.split()[0].split("/", 1)[1] for line in listed.splitlines() if line.startswith("  Cell/")]
    groups = {}  # by service, fault and situation, each with its layouts
    for name in found:
        service, fault, layout, situation = name.split("_", 3)
        groups.setdefault((service, fault, situation), []).append(name)
    rows = list(groups.values())
    return [row[(i + turn) % len(row)] for turn in range(len(rows[0])) for i, row in enumerate(rows)]


def measured(path):
    """The measured values of a cell."""
    with open(path, encoding="utf-8") as f: suites = json.load(f)["testsuites"]
    test = suites[0]["testsuite"][0]
    return {k: int(v) for k, v in test.items() if k in ("cycles_of_hold", "cycles_of_braking", "largest_deviation_nm", "cycles_gone_back", "unseen_cycles")}


class Run:
    def __init__(self, options, todo):
        self.options, self.todo, self.lock = options, list(todo), threading.Lock()
        self.total, self.done, self.failed = len(self.todo), 0, []

    def work(self, worker):
        while True:
            with self.lock:
                if not self.todo: return
                name = self.todo.pop(0)
            began = time.monotonic()
            result = os.path.join(self.options.results, name + ".json")
            log = os.path.join(self.options.results, name + ".log")
            part = result + ".part"
            environment = dict(os.environ)
            if self.options.domain is not None: environment["TRUNNION_TEST_DOMAIN"] = str(self.options.domain + worker)
            with open(log, "w", encoding="utf-8") as out:
                try:
                    status = subprocess.run([self.options.program, "--gtest_filter=*/" + name, "--gtest_output=json:" + part],
                                            stdout=out, stderr=subprocess.STDOUT, env=environment, timeout=900).returncode
                except subprocess.TimeoutExpired:
                    status = "no end in 900 s"
            with self.lock:
                self.done += 1
                if status == 0:
                    os.replace(part, result)
                else:
                    self.failed.append(name)
                    if os.path.exists(result): os.remove(result)
                print(f"{self.done:4d}/{self.total}  {'ok' if status == 0 else f'FAILED ({status}), see {log}':6}  {name}  {time.monotonic() - began:.1f} s", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, help="fault_matrix_test")
    parser.add_argument("--results", required=True, help="directory for the results of the cells")
    parser.add_argument("--jobs", type=int, default=2, help="clusters at a time")
    parser.add_argument("--domain", type=int, help="DDS domain of the first job; each further job uses the next one (default: free domains)")
    parser.add_argument("--sample", type=int, help="number of cells to run (default: all)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--match", default="", help="run only cells whose name contains this")
    parser.add_argument("--fresh", action="store_true", help="run cells again that have passed before")
    options = parser.parse_args()
    os.makedirs(options.results, exist_ok=True)
    every = cells(options.program)
    if options.sample:
        print(f"seed {options.seed}")
        todo = random.Random(options.seed).sample(every, options.sample)
    else:
        todo = [name for name in every if options.match in name]
        passed = lambda name: os.path.exists(os.path.join(options.results, name + ".json"))
        if options.fresh:
            for name in todo:
                if passed(name): os.remove(os.path.join(options.results, name + ".json"))
        before = len(todo)
        todo = [name for name in todo if not passed(name)]
        if before != len(todo): print(f"{before - len(todo)} of {before} cells have passed before", flush=True)
    run = Run(options, todo)
    workers = [threading.Thread(target=run.work, args=(i,)) for i in range(options.jobs)]
    for w in workers: w.start()
    for w in workers: w.join()
    if run.failed:
        print("failed: " + " ".join(run.failed))
        return 1
    if options.sample: return 0
    worst = {}
    for name in every:
        path = os.path.join(options.results, name + ".json")
        if not os.path.exists(path): return 0  # only some of the cells were requested
        for key, value in measured(path).items(): worst[key] = max(worst.get(key, 0), value)
    print("largest of all cells: " + ", ".join(f"{k} {v}" for k, v in sorted(worst.items())))
    environment = dict(os.environ, TRUNNION_WRITE_FAULT_MATRIX="1")
    return subprocess.run([options.program, "--gtest_filter=FaultMatrixDocument.*", "--gtest_brief=1"], env=environment).returncode


if __name__ == "__main__":
    sys.exit(main())
