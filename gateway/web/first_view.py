#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""first_view.py DIRECTORY LIMIT: what a browser loads of the built page before its first view - index.html and the
scripts, styles and modules that it names - as it is sent, compressed. Exit status 1 when it is more than LIMIT bytes."""
import gzip, pathlib, re, sys

directory, limit = pathlib.Path(sys.argv[1]), int(sys.argv[2])


def static_imports(text):
    return re.findall(r"""(?:^|[;}\s])(?:import|export)\s*[\w${},*\s]*?(?:from\s*)?["']\./([^"']+\.js)["']""", text)


wanted, known = ["index.html"], {}
while wanted:
    name = wanted.pop()
    if name in known: continue
    path = directory / name
    packed = path.with_name(path.name + ".gz")
    text = path.read_text(encoding="utf-8")
    if gzip.decompress(packed.read_bytes()) != path.read_bytes(): sys.exit(f"error: {packed} is not {path} compressed")
    known[name] = packed.stat().st_size
    if name.endswith(".html"): wanted += [one.lstrip("/") for one in re.findall(r'(?:src|href)="([^"]+\.(?:js|css))"', text)]
    if name.endswith(".js"): wanted += [str(pathlib.PurePosixPath(name).parent / one) for one in static_imports(text)]
total = sum(known.values())
for name, size in sorted(known.items()): print(f"{size:8d}  {name}")
print(f"{total:8d}  bytes compressed in the first view, at most {limit}")
sys.exit(total > limit)
