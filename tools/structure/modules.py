#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The modules of libs/ and the arrows between them: libs/<module>/<library>.

A module uses another when a library of it links, or a source of it that is no test includes, a library of that one.
Checked by check_structure.py:

- no two libraries have one name, for an include names the library alone
- the top CMakeLists.txt has each module in one piece, none before what it uses: then the arrows make no circle
- the README.md of a module has a row with the content of each of its libraries, names the modules that it uses, and paths that are there
- the picture and the table in docs/architecture.md are current

    modules.py             prints who uses whom, and by which libraries
    modules.py --write     writes the picture and the table
"""
import functools, os, re, sys

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
DOCUMENT = "docs/architecture.md"
BEGIN, END = "<!-- modules: tools/structure/modules.py --write -->\n", "<!-- end of modules -->\n"


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as f: return f.read()


def directories(path):
    return sorted(entry.name for entry in os.scandir(os.path.join(ROOT, path)) if entry.is_dir() and not entry.name.startswith((".", "_")))


def places():
    """(module, library) in the order of the top CMakeLists.txt."""
    return re.findall(r"\blibs/(\w+)/(\w+)", re.sub(r"#.*", "", read("CMakeLists.txt")))


@functools.lru_cache(None)
def linked():
    """{library: the libraries that its targets link}; those of tests, fuzzers and benchmarks are free."""
    home, used = {}, {}
    for module, library in places():
        text = re.sub(r"#.*", "", read(f"libs/{module}/{library}/CMakeLists.txt"))
        for call, words in re.findall(r"\b(trunnion_library|add_library|target_link_libraries)\(([^()]*)\)", text):
            name, *rest = words.split()
            if call != "target_link_libraries": home[name] = library
            if call == "trunnion_library": rest = rest[rest.index("LINK") + 1:] if "LINK" in rest else []
            if name in home: used.setdefault(library, set()).update(word for word in rest if word.startswith("trunnion_"))
    return {library: {home[target] for target in targets if target in home} - {library} for library, targets in used.items()}


def included():
    """{library: the libraries whose headers its sources include}."""
    names, found = {library for _, library in places()}, {}
    for module, library in places():
        for folder, folders, files in os.walk(os.path.join(ROOT, "libs", module, library)):
            folders[:] = [f for f in folders if f not in ("test", "bench", "node_modules")]
            for name in files:
                if not name.endswith((".hpp", ".cpp")): continue
                found.setdefault(library, set()).update(re.findall(r'^#include "(\w+)/', read(os.path.relpath(os.path.join(folder, name), ROOT)), re.M))
    return {library: used & names - {library} for library, used in found.items() if library != "testing_support"}


@functools.lru_cache(None)
def arrows():
    """{module: {used module: the pairs of libraries that make it so}}."""
    home = {library: module for module, library in places()}
    found = {module: {} for module, _ in places()}
    for libraries in (linked(), included()):
        for library, used in libraries.items():
            for other in used:
                if home[library] != home[other]: found[home[library]].setdefault(home[other], set()).add(f"{library} -> {other}")
    return found


def reachable(module):
    """What a module uses, and what that uses."""
    found, ahead = set(), list(arrows()[module])
    while ahead:
        other = ahead.pop()
        if other not in found: found.add(other), ahead.extend(arrows()[other])
    return found


@functools.lru_cache(None)
def floor(library):
    """How many libraries stand below it, one on the other."""
    return max((floor(other) + 1 for other in linked().get(library, ())), default=0)


def drawn():
    """The picture without what is reached over other arrows, and the table."""
    modules = list(arrows())
    picture = [f"  {module} --> {other}" for module in reversed(modules) for other in reversed(modules)
               if other in arrows()[module] and not any(other in reachable(between) for between in arrows()[module])]
    table = ["| module | libraries, each with its floor | uses |", "|---|---|---|"]
    for module in modules:
        libraries = ", ".join(f"{library} {floor(library)}" for home, library in places() if home == module)
        table.append(f"| [{module}](../libs/{module}) | {libraries} | {', '.join(m for m in modules if m in arrows()[module]) or '-'} |")
    return "\n".join(["```mermaid", "flowchart TB", *picture, "```", "", *table]) + "\n"


def check_places():
    there = [(module, library) for module in directories("libs") for library in directories(f"libs/{module}")]
    errors = [f"CMakeLists.txt: libs/{module}/{library} is not in the list of directories" for module, library in there if (module, library) not in places()]
    names = [library for _, library in there]
    errors += [f"libs: two libraries have the name {name}" for name in sorted({n for n in names if names.count(n) > 1})]
    order = [module for module, _ in places()]
    errors += [f"CMakeLists.txt: the libraries of {module} do not follow each other" for module in dict.fromkeys(order)
               if order[order.index(module):][: order.count(module)] != [module] * order.count(module)]
    modules = list(arrows())
    return errors + [f"libs/{module} uses libs/{other}, which comes after it: {', '.join(sorted(why))}" for module in modules
                     for other, why in arrows()[module].items() if modules.index(other) > modules.index(module)]


def check_readme(module):
    path = f"libs/{module}/README.md"
    if not os.path.exists(os.path.join(ROOT, path)): return [f"{path} is not there"]
    text = read(path)
    rows = [label for label, target in re.findall(r"^\| \[(\w+)/\]\((\w+)\) \| *[^ |]", text, re.M) if label == target]
    errors = [f"{path}: {name} has no row with its content, or one and is not there" for name in sorted(set(directories(f"libs/{module}")) ^ set(rows))]
    uses = re.search(r"^Uses .*?\n\n", text + "\n", re.M | re.S)
    named = set(re.findall(r"\]\(\.\./(\w+)\)", uses[0])) if uses else set()
    errors += [f"{path}: says that it uses {name}, and nothing does" for name in sorted(named - set(arrows()[module]))]
    errors += [f"{path}: does not say that it uses {name}: {', '.join(sorted(arrows()[module][name]))}" for name in sorted(set(arrows()[module]) - named)]
    paths = re.findall(r"`([\w/]+/[\w.]+)`", text)
    return errors + [f"{path}: {name} is not there" for name in paths if not os.path.exists(os.path.join(ROOT, "libs", module, name))]


def check():
    errors = check_places()
    if errors: return errors
    for module in arrows(): errors += check_readme(module)
    if BEGIN + drawn() + END not in read(DOCUMENT): errors.append(f"{DOCUMENT}: the picture of the modules is not current: modules.py --write")
    return errors


def write():
    text = read(DOCUMENT)
    if BEGIN not in text: sys.exit(f"{DOCUMENT}: the line '{BEGIN.strip()}' is missing")
    before, after = text[: text.index(BEGIN)], text[text.index(END):]
    with open(os.path.join(ROOT, DOCUMENT), "w", encoding="utf-8") as f: f.write(before + BEGIN + drawn() + after)


if __name__ == "__main__":
    if "--write" in sys.argv: sys.exit(write())
    for module, used in arrows().items():
        print(module, *[f"  uses {other}: {', '.join(sorted(why))}" for other, why in used.items()], sep="\n")
