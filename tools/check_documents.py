#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the prose of the documents and of the texts that operators read.

Markdown: no line over 120 columns outside tables and code blocks. Markdown, alarm texts, parameter help, and the texts in
the sources of the product, on the page in English and in the tables of commands: none of the words that docs/glossary.md
refuses. Prints file:line: what, and exits with status 1 when something is found.
With --wrap FILES the prose of these Markdown files is wrapped instead.
"""
import argparse, os, re, sys, textwrap

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
WIDTH = 120
GLOSSARY = "docs/glossary.md"
TEXTS = ("libs/machine/machine/alarms.yaml", "libs/machine/machine/catalogue.yaml", "libs/plc/plc/library/registers.yaml")
PRODUCT = ("libs", "services", "gateway", "deploy", "idl")
SOURCE = re.compile(r"\.(cpp|hpp)$|/english\w*\.ts$|^gateway/openapi\.json$|^idl/\w+\.yaml$")
NOT_PRODUCT = re.compile(r"/(test|bench|browser|testing_support|node_modules)/|/templates/")
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')
MARKUP = re.compile(r"font-weight")
FENCE = re.compile(r"\s*(```|~~~)")
WHOLE = re.compile(r"`[^`]*`|\[[^\]]*\]\([^)]*\)")  # code and links, which stay on one line
ENTRY = re.compile(r"(\s*)((?:[-*+]|\d+\.)\s+)")


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as f: return f.read().split("\n")


def markdown_files():
    for folder, folders, files in os.walk(ROOT):
        folders[:] = sorted(f for f in folders if f not in ("build", "node_modules", "out") and not f.startswith("."))
        yield from (os.path.relpath(os.path.join(folder, f), ROOT) for f in sorted(files) if f.endswith(".md"))


def sources():
    for top in PRODUCT:
        for folder, _, files in os.walk(os.path.join(ROOT, top)):
            paths = (os.path.relpath(os.path.join(folder, f), ROOT) for f in sorted(files))
            yield from (p for p in paths if SOURCE.search(p) and not NOT_PRODUCT.search(p))


def sentences(line):
    """The literals of a line of source that have a blank: texts, not names."""
    if re.match(r"\s*(//|#|\*)", line): return []
    return [text for text in LITERAL.findall(line) if " " in text and not MARKUP.search(text)]


def refused_words():
    """(compiled expression, what to write) from the last table of the glossary."""
    rows = re.findall(r"^\| `(.+)` \| (.+) \|$", "\n".join(read(GLOSSARY)), re.M)
    if not rows: sys.exit(f"{GLOSSARY}: error: the table of refused words is missing")
    return [(re.compile(rf"\b(?:{word})\b".replace("\\|", "|"), re.I), instead) for word, instead in rows]


def plain(line):
    """A line without code, paths and link targets: names in them are not prose."""
    return re.sub(r"`[^`]*`|\]\([^)]*\)", " ", line)


def prose(lines):
    """(number, line, is_table) of every Markdown line outside code blocks."""
    code = False
    for number, line in enumerate(lines, 1):
        if FENCE.match(line):
            code = not code
            continue
        if not code: yield number, line, line.lstrip().startswith("|")


def check():
    words, found = refused_words(), []
    def find_words(path, number, text):
        for word, instead in words:
            match = word.search(text)
            if match: found.append(f"{path}:{number}: '{match.group()}': write {instead}")
    for path in markdown_files():
        refused_table = False
        for number, line, is_table in prose(read(path)):
            refused_table = path == GLOSSARY and (refused_table or line.startswith("| refused |"))
            if not is_table and len(line) > WIDTH and " " in line.strip():
                found.append(f"{path}:{number}: {len(line)} columns, at most {WIDTH}")
            if not refused_table: find_words(path, number, plain(line))
    for path in TEXTS:
        for number, line in enumerate(read(path), 1):
            for text in re.findall(r'(?:text|help|about): (.*)\}', line) if path.endswith("yaml") else re.findall(r'"([^"]*)"', line):
                find_words(path, number, text)
    for path in sources():
        for number, line in enumerate(read(path), 1):
            for text in sentences(line): find_words(path, number, text)
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


def wrap(path):
    """Joins the lines of each paragraph or list entry and wraps them."""
    out, paragraph, indent, hanging = [], [], "", ""

    def flush():
        nonlocal paragraph
        if paragraph:
            text = WHOLE.sub(lambda match: match.group().replace(" ", "\0"), " ".join(paragraph))
            out.extend(line.replace("\0", " ") for line in
                       textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=hanging, break_long_words=False, break_on_hyphens=False))
        paragraph = []

    code = False
    for line in read(path):
        fence = FENCE.match(line)
        if fence: code = not code
        if fence or code or not line.strip() or re.match(r"\s*(\||#|!\[|<)|>$", line):
            flush()
            out.append(line)
            continue
        if line.startswith("> "):
            if indent != "> ": flush()
            indent = hanging = "> "
            paragraph.append(line[2:].strip())
            continue
        entry = ENTRY.match(line)
        if entry or not paragraph:
            flush()
            indent = entry.group(1) + entry.group(2) if entry else re.match(r"\s*", line).group()
            hanging = " " * len(indent)
            line = line[len(indent):]
        paragraph.append(line.strip())
        if line.endswith("  "): flush()
    flush()
    with open(os.path.join(ROOT, path), "w", encoding="utf-8") as f: f.write("\n".join(out))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--wrap", metavar="FILE", nargs="+", help="wrap the prose of these Markdown files, paths from the top directory")
    arguments = parser.parse_args()
    if not arguments.wrap: sys.exit(check())
    for path in arguments.wrap: wrap(path)


if __name__ == "__main__":
    main()
