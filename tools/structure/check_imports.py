#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the modules of the page, and those of the Python client, import each other in no circle.

An import of types alone counts, so does one within a function, and the script that a worker is started with.

    check_imports.py [--test]      --test tries the check itself
"""
import ast, graphlib, os, re, sys

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
ENDINGS = (".ts", ".tsx", ".mjs", ".py")
PAGE_IMPORT = re.compile(r"""(?:\bfrom|\bimport|\bnew Worker\(new URL)\s*\(?\s*["'](\.[^"']*)["']""")


def of_page(path, text):
    """The paths that a module of the page imports, most of them without their ending."""
    return [os.path.normpath(os.path.join(os.path.dirname(path), target)) for target in PAGE_IMPORT.findall(text)]


def of_client(path, text):
    """The paths of the package's modules that one of them imports, without their ending."""
    names = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import): names += [alias.name for alias in node.names]
        if isinstance(node, ast.ImportFrom): names.append("trunnion." * node.level + (node.module or ""))
    own = [name.partition(".")[2] or "__init__" for name in names if name.partition(".")[0] == "trunnion"]
    return [os.path.join(os.path.dirname(path), name) for name in own]


def graph(sources, imported):
    """The modules that each module imports, by path, and an error for each import that leads to none."""
    imports, errors = {path: [] for path in sorted(sources)}, []
    for path in imports:
        for target in imported(path, sources[path]):
            found = [target + ending for ending in ("", *ENDINGS) if target + ending in sources]
            imports[path] += found
            if not found and not target.endswith(".css"): errors.append(f"{path}: imports {target}, which is no module")
    return imports, errors


def circle(imports):
    """Modules of which each imports the next, the first at the end again; none when there is no circle."""
    try: graphlib.TopologicalSorter(imports).prepare()
    except graphlib.CycleError as error: return error.args[1][::-1]
    return []


def check(name, sources, imported):
    """The errors of the modules `sources`, text by path."""
    imports, errors = graph(sources, imported)
    if not any(imports.values()): errors.append(f"{name}: no module was found that imports another")
    if found := circle(imports): errors.append(f"{name}: modules import each other in a circle: {' -> '.join(found)}")
    return errors


def sources_of(*folders):
    found = {}
    for folder, _, files in (step for one in folders for step in os.walk(os.path.join(ROOT, one))):
        for path in (os.path.join(folder, name) for name in files if name.endswith(ENDINGS)):
            with open(path, encoding="utf-8") as f: found[os.path.relpath(path, ROOT)] = f.read()
    return found


def test():
    page = {
        "a.ts": 'import type { B } from "./b";\nimport "./a.css";\n',
        "b.tsx": 'import {\n  c,\n} from "./parts/c.mjs";\n',
        "parts/c.mjs": 'export * from "./d";\n',
        "parts/d.ts": 'export const e = () => import("../e");\n',
        "e.ts": 'new Worker(new URL("./a.ts", import.meta.url));\n',
    }
    found = check("page", page, of_page)
    assert len(found) == 1 and set(re.findall(r"\S+\.\w+", found[0])) == set(page), found
    for path in page: assert check("page", {**page, path: ""}, of_page)[1:] == [], path
    assert check("page", {**page, "e.ts": ""}, of_page) == []
    assert check("page", {"a.ts": 'import { b } from "./b";'}, of_page)[0] == "a.ts: imports b, which is no module"
    assert "no module was found" in check("page", {}, of_page)[0]
    client = {
        "p/__init__.py": '"""\n    import trunnion\n"""\nfrom .a import A\n',
        "p/a.py": "import json\nfrom trunnion.b import B\n",
        "p/b.py": "if TYPE_CHECKING:\n    from .c import C\n",
        "p/c.py": "def f():\n    import trunnion.a\n",
    }
    found = check("client", client, of_client)
    assert len(found) == 1 and set(re.findall(r"\S+\.py", found[0])) == {"p/a.py", "p/b.py", "p/c.py"}, found
    assert check("client", {**client, "p/c.py": "import trunnions\n"}, of_client) == []
    assert "__init__.py" in check("client", {**client, "p/b.py": "from . import c\n", "p/c.py": ""}, of_client)[0]


if __name__ == "__main__":
    test()
    if "--test" in sys.argv: sys.exit(0)
    errors = check("page", sources_of("gateway/web/src", "gateway/web/test", "gateway/web/browser"), of_page)
    errors += check("client", sources_of("clients/python/trunnion"), of_client)
    print("\n".join(errors), file=sys.stderr, end="\n" if errors else "")
    sys.exit(1 if errors else 0)
