# SPDX-License-Identifier: Apache-2.0
"""The table of alarms, libs/machine/machine/alarms.yaml, as the generators of constants, documents and the page's catalogue read it."""
import os, re
import yaml

CHOICES = {"severity": {"hint", "warning", "error", "emergency"}, "reaction": {"show", "feed_hold", "axis_stop", "emergency_stop"},
           "about": {"machine", "channel", "axis", "service"}}
RESERVED = {"all", "none", "numbered"}  # names that the generated code gives to something else


def fail(path, text): raise SystemExit(f"{path}: error: {text}")


def is_text(value): return isinstance(value, str) and value != ""


class AlarmTable:
    """`machine` and `language`: the rows of either kind by number; those of the NC language have what is the same for all."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as f: document = yaml.safe_load(f)
        self.path, self.common = path, document["nc_language"]
        self.first, self.last, self.remedy = (self.common[key] for key in ("first", "last", "remedy"))
        self.rows = sorted((self._filled(row) for row in document["alarms"]), key=lambda row: row["number"])
        for key in ("name", "number"):
            values = [row[key] for row in self.rows]
            for value in sorted({v for v in values if values.count(v) > 1}): fail(path, f"{key} {value} is there twice")
        self.machine = [row for row in self.rows if not self._of_language(row)]
        self.language = [row for row in self.rows if self._of_language(row)]

    def _of_language(self, row): return self.first <= row["number"] <= self.last

    def _filled(self, row):
        name = str(row.get("name", ""))
        if not re.fullmatch(r"[a-z][a-z0-9_]*", name) or name in RESERVED: fail(self.path, f"'{name}' is no name for a constant")
        if self._of_language(row):
            if set(row) != {"number", "name", "text"}: fail(self.path, f"{name}: an alarm of the NC language has number, name and text")
            row = {**{key: self.common[key] for key in CHOICES}, **row, "cause": "", "remedy": self.remedy}
        elif not (is_text(row.get("cause")) and is_text(row.get("remedy"))): fail(self.path, f"{name}: cause or remedy is missing")
        for key, allowed in CHOICES.items():
            if row.get(key) not in allowed: fail(self.path, f"{name}: {key} '{row.get(key)}' is none of {', '.join(sorted(allowed))}")
        if not is_text(row.get("text")): fail(self.path, f"{name}: text is missing")
        return row

    def translation(self, language):
        """Text, cause and remedy of every alarm of the machine by number, and the remedy of the NC language's alarms."""
        path = os.path.join(os.path.dirname(self.path), "translations", f"alarms.{language}.yaml")
        with open(path, encoding="utf-8") as f: texts = yaml.safe_load(f)
        remedy = texts.pop("nc_language", {}).get("remedy")
        if not is_text(remedy): fail(path, "the remedy of nc_language is missing")
        wrong = {row["number"] for row in self.machine} ^ set(texts)
        wrong |= {number for number, one in texts.items() if not all(is_text(one.get(key)) for key in ("text", "cause", "remedy"))}
        if wrong: fail(path, f"text, cause and remedy of these alarms are missing, or there are no such alarms: {', '.join(map(str, sorted(wrong)))}")
        return texts, remedy
