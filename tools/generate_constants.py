#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the C++ constants of parameters, alarms and services from catalogue.yaml, alarms.yaml and services.yaml, so that a
misspelt name does not compile: trunnion::parameter::NAME, trunnion::alarm::NAME, trunnion::machine::service::NAME. Alarms of the
NC language are also trunnion::language::AlarmNumber::NAME: the interpreter is built without what a machine is. And its table of
words of other controls, from foreign_words.yaml.
"""
import argparse, json, os, re
import yaml
from alarm_table import AlarmTable
from foreign_word_table import foreign_words

PARAMETER_TYPES = {"integer": "IntegerParameter", "real": "RealParameter", "text": "TextParameter"}
SERVICE_KEYS = {"name", "required", "per_channel", "cyclic", "not_verified", "stage"}


ALARMS = "The alarms of libs/machine/machine/alarms.yaml."


def load(path, key):
    with open(path, encoding="utf-8") as f: document = yaml.safe_load(f)
    seen = set()
    for row in document[key]:
        name = str(row.get("name", ""))
        if not re.fullmatch(r"[a-z][a-z0-9_]*", name) or name == "all": fail(path, f"'{name}' is no name for a constant")
        if name in seen: fail(path, f"'{name}' is there twice")
        seen.add(name)
    return document


def fail(path, text): raise SystemExit(f"{path}: error: {text}")


def choice(path, row, key, allowed):
    if row.get(key) not in allowed: fail(path, f"{row['name']}: {key} '{row.get(key)}' is none of {', '.join(sorted(allowed))}")
    return row[key]


def parameters(path):
    document = load(path, "parameters")
    lines, numbers = [], {}
    for row in document["parameters"]:
        if row["class"] not in document["classes"]: fail(path, f"{row['name']}: unknown class '{row['class']}'")
        first = document["classes"][row["class"]]["base"] + row["offset"]
        for number in range(first, first + row.get("count", 1)):
            if number in numbers: fail(path, f"{row['name']}: {number:06} is {numbers[number]} already")
            numbers[number] = row["name"]
        kind = PARAMETER_TYPES[choice(path, row, "type", PARAMETER_TYPES)]
        lines.append(f"inline constexpr machine::{kind} {row['name']}{{{first}, \"{row['name']}\"}};")
    return header(("\"machine/parameter_key.hpp\"",), "The parameters of libs/machine/machine/catalogue.yaml.", "parameter", lines)


def alarms(table):
    lines = []
    for row in table.rows:
        lines.append(f"inline constexpr machine::AlarmDefinition {row['name']}{{\n    {row['number']}, \"{row['name']}\", "
                     f"machine::Severity::{row['severity']}, machine::Reaction::{row['reaction']}, machine::Subject::{row['about']},\n    {literal(row['text'])}}};")
    names = ", ".join(f"&{row['name']}" for row in table.rows)
    lines.append(f"/// Every alarm, by number.\ninline constexpr const machine::AlarmDefinition* all[] = {{{names}}};")
    lines.append("/// The alarm with this number of the table.\n"
                 "inline const machine::AlarmDefinition& numbered(std::uint32_t number) {\n"
                 "  for (const auto* one : all)\n    if (one->number == number) return *one;\n"
                 "  throw std::out_of_range(\"no alarm has the number \" + std::to_string(number));\n}")
    return header(("<cstdint>", "<stdexcept>", "<string>", "\"machine/alarm_definition.hpp\""), ALARMS, "alarm", lines)


def alarm_numbers(table):
    lines = ["enum class AlarmNumber : std::uint16_t {", "  none = 0,", *(f"  {row['name']} = {row['number']}," for row in table.language), "};", "",
             "struct AlarmText {", "  AlarmNumber number;", "  std::string_view text;", "};", "",
             "/// The texts. The word at fault is appended after a colon.", "inline constexpr AlarmText alarm_texts[] = {",
             *(f"    {{AlarmNumber::{row['name']}, {literal(row['text'])}}}," for row in table.language), "};"]
    return header(("<cstdint>", "<string_view>"), ALARMS, "language", lines)


def foreign_word_table(path):
    lines = ["inline constexpr ForeignWord foreign_word_table[] = {"]
    for row in foreign_words(path):
        cells = (row["word"], row["with"], row["control"], row["meaning"], row["shown"], row["here"])
        lines.append(f"    {{{', '.join(literal(cell) for cell in cells)}}},")
    return header(("\"language/foreign_words.hpp\"",), "The words of libs/program/language/foreign_words.yaml.", "language", lines + ["};"])


def literal(text): return json.dumps(text, ensure_ascii=False)


def services(path):
    rows = load(path, "services")["services"]
    lines, stages = [], 0
    for row in rows:
        if set(row) - SERVICE_KEYS: fail(path, f"{row['name']}: unknown key '{sorted(set(row) - SERVICE_KEYS)[0]}'")
        stage = row.get("stage", {})
        if stage and (set(stage) - {"input", "output"} or "output" not in stage or ("input" in stage) != (stages > 0)):
            fail(path, f"{row['name']}: a stage has an output, and all but the first an input")
        stages += bool(stage)
        flags = ", ".join(str(bool(row.get(key))).lower() for key in ("required", "per_channel", "cyclic", "not_verified"))
        text = lambda key: f'"{stage[key]}"' if key in stage else "nullptr"
        lines.append(f"inline constexpr ServiceDefinition {row['name']}{{\n    \"{row['name']}\", {flags}, {stages if stage else 0}, {text('input')}, {text('output')}}};")
    names = [row["name"] for row in rows]
    lines.append(f"/// Every service, in the order of the file.\ninline constexpr ServiceDefinition all[] = {{{', '.join(names)}}};")
    lines.append(f"/// Those that are a stage of the stream, by number from 1.\ninline constexpr ServiceDefinition stages[] = {{{', '.join(row['name'] for row in rows if row.get('stage'))}}};")
    return header(("\"machine/service_definition.hpp\"",), "The services of libs/machine/machine/services.yaml.", "machine::service", lines)


def header(includes, about, namespace, lines):
    return "\n".join([f"// {about} Generated by tools/generate_constants.py: do not edit.", "#pragma once", "", *(f"#include {name}" for name in includes), "",
                      f"namespace trunnion::{namespace} {{", "", *lines, "", f"}}  // namespace trunnion::{namespace}", ""])


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("catalogue"), p.add_argument("alarms"), p.add_argument("services"), p.add_argument("foreign_words")
    p.add_argument("--out", required=True, help="include directory of the headers")
    args = p.parse_args()
    table = AlarmTable(args.alarms)
    for name, text in (("machine/parameter_constants.hpp", parameters(args.catalogue)), ("machine/alarm_constants.hpp", alarms(table)),
                       ("machine/service_constants.hpp", services(args.services)), ("language/alarm_numbers.hpp", alarm_numbers(table)),
                       ("language/foreign_word_table.hpp", foreign_word_table(args.foreign_words))):
        path = os.path.join(args.out, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        if os.path.exists(path):
            with open(path, encoding="utf-8") as f:
                if f.read() == text: continue
        with open(path, "w", encoding="utf-8") as f: f.write(text)


if __name__ == "__main__":
    main()
