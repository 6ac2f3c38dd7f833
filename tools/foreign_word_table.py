# SPDX-License-Identifier: Apache-2.0
"""The words of other controls, libs/program/language/foreign_words.yaml, as the generators of constants and documents read them."""
import re
import yaml

KEYS = ("word", "control", "meaning", "write", "here")
LONGEST = 48  # of what ends the text of an alarm


def fail(path, text): raise SystemExit(f"{path}: error: {text}")


def foreign_words(path):
    """The rows with `with`, which may be empty, and `shown`, the end of the alarm's text."""
    with open(path, encoding="utf-8") as f: rows = yaml.safe_load(f)["words"]
    seen = set()
    for row in rows:
        word = row.get("word", "")
        if not set(KEYS) <= set(row) <= {*KEYS, "with"}: fail(path, f"{word}: needs {', '.join(KEYS)}, and takes with")
        for key, text in row.items():
            if not (isinstance(text, str) and text and text == text.strip()): fail(path, f"{word}: {key} is no text")
        row.setdefault("with", "")
        for pattern in (word, row["with"]):
            if re.search(r"[a-z]|  ", pattern): fail(path, f"{word}: letters are capitals, and one blank is enough")
        if (word, row["with"]) in seen: fail(path, f"{word} is there twice")
        seen.add((word, row["with"]))
        row["shown"] = f"{row['control']}: {row['write']}"
        if len(row["shown"]) > LONGEST: fail(path, f"{word}: '{row['shown']}' has more than {LONGEST} characters")
    return rows
