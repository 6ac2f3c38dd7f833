#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks what the documents and the sources say of the structure:

- the table of README.md names every directory, and no directory that is not there
- the top CMakeLists.txt names every directory of services/
- the modules of libs/ are as their READMEs and docs/architecture.md say (modules.py)
- every path that CONTRIBUTING.md names is there
- no source includes a file of another directory by a way around its include root
- every source names its licence in its first two lines
"""
import os, re, subprocess, sys

import modules

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
GROUPS = ("libs", "services", "deploy", "configs", "examples", "tools", "docs")  # their directories have rows of their own
NOT_SOURCE = {"build", "out"}


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as f: return f.read()


def directories(path):
    return sorted(entry.name for entry in os.scandir(os.path.join(ROOT, path)) if entry.is_dir() and not entry.name.startswith((".", "_")))


def check_readme():
    wanted = {name for name in directories(".") if name not in NOT_SOURCE}
    wanted |= {f"{group}/{name}" for group in GROUPS for name in directories(group)}
    rows = [(label, target) for label, target in re.findall(r"^\| \[([^\]]+)/\]\(([^)]+)\) \|", read("README.md"), re.M)]
    errors = [f"README.md: the row of {label}/ links to {target}" for label, target in rows if label != target]
    named = [label for label, _ in rows]
    errors += [f"README.md: {name}/ has no row in the table of directories" for name in sorted(wanted - set(named))]
    errors += [f"README.md: {name}/ has a row and is not there" for name in sorted(set(named) - wanted)]
    errors += [f"README.md: {name}/ has two rows" for name in sorted({n for n in named if named.count(n) > 1})]
    return errors


def check_build():
    listed = set(re.findall(r"\bservices/\w+", read("CMakeLists.txt")))
    if "services/*" in read("CMakeLists.txt"): listed |= {f"services/{name}" for name in directories("services")}
    there = {f"services/{name}" for name in directories("services")}
    return [f"CMakeLists.txt: {name} is not in the list of directories" for name in sorted(there - listed)]


def check_contributing():
    paths = re.findall(r"`((?:idl|libs|services|gateway|deploy|configs|integration_tests|tools|docs|cmake)/[\w./-]*)`", read("CONTRIBUTING.md"))
    return [f"CONTRIBUTING.md: {path} is not there" for path in sorted(set(paths)) if not os.path.exists(os.path.join(ROOT, path))]


def check_includes():
    """An include root cannot refuse a way that goes up; within a directory it is the directory's own affair."""
    errors = []
    for group in ("libs", "services", "gateway", "deploy"):
        for folder, _, files in os.walk(os.path.join(ROOT, group)):
            if "node_modules" in folder: continue
            for name in files:
                if not name.endswith((".hpp", ".cpp")): continue
                path = os.path.relpath(os.path.join(folder, name), ROOT)
                home = "/".join(path.split("/")[: {"gateway": 1, "libs": 3}.get(group, 2)])
                for include in re.findall(r'^#include "(\.\.?/[^"]+)"', read(path), re.M):
                    target = os.path.normpath(os.path.join(os.path.dirname(path), include))
                    if not target.startswith(home + "/"): errors.append(f"{path}: includes {target}, which is not of {home}")
    return errors


def check_licence():
    """Of every file that git lists, or of none in an unpacked archive."""
    listed = subprocess.run(["git", "ls-files", "*.cpp", "*.hpp", "*.c", "*.h", "*.ts", "*.tsx", "*.idl", "*.py", "*.sh", "*.cmake", "*CMakeLists.txt"],
                            cwd=ROOT, capture_output=True, text=True)
    paths = [path for path in listed.stdout.split() if os.path.exists(os.path.join(ROOT, path))]
    return [f"{path}: no line 'SPDX-License-Identifier: Apache-2.0'" for path in paths
            if "SPDX-License-Identifier: Apache-2.0" not in "".join(read(path).splitlines(True)[:2])]


if __name__ == "__main__":
    errors = check_readme() + check_build() + modules.check() + check_contributing() + check_includes() + check_licence()
    print("\n".join(errors), file=sys.stderr, end="\n" if errors else "")
    sys.exit(1 if errors else 0)
