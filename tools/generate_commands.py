#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Turns idl/operator_commands.yaml into the table in C++, the limits of the overrides and docs/operator-commands.md.

gateway/openapi.json gets its entries from generate_api.py, which reads the same table.
"""
import argparse, os, sys, textwrap
import yaml
from generate_contracts import Parser

FIELD_KEYS = {"name", "into", "argument", "about", "unit", "minimum", "maximum", "nonzero", "one_of", "optional",
              "word_optional"}
CHANNEL_KEYS = {"command", "route", "choice", "word", "about", "more", "modes", "busy", "stream", "motion", "refused", "fields"}
PANEL_KEYS = {"command", "stream", "route", "word", "about", "more"}
QUANTITIES = {"double", "int32", "uint32"}  # the smaller types are numbers of axes and masks, with limits of their own
MOTIONS = ("neither", "starts", "stops")
GIVEN_BY_CLIENT = {"client", "number", "channel", "command"}


def idl_type(path, name):
    return next(t for t in Parser(path).parse() if t.name == name)


def check(table, path, idl):
    """Stops with the row that contradicts the IDL or itself."""
    def fail(row, text): sys.exit(f"{path}: error: {row.get('command', row)}: {text}")
    request = idl_type(f"{idl}/channel.idl", "ChannelRequest")
    modes = idl_type(f"{idl}/channel.idl", "Mode").values
    fields = {name: field.base for name, field, _, _ in request.fields if name not in GIVEN_BY_CLIENT}
    for part, keys, kinds in (("channel", CHANNEL_KEYS, idl_type(f"{idl}/channel.idl", "CommandKind").values),
                              ("panel", PANEL_KEYS, idl_type(f"{idl}/plc.idl", "PanelRequestKind").values)):
        names = [row["command"] for row in table[part]]
        for row in table[part]:
            if row["command"] not in kinds: fail(row, "no such enumerator")
            if names.count(row["command"]) > 1: fail(row, "is there twice")
            if unknown := set(row) - keys: fail(row, f"unknown keys {sorted(unknown)}")
            if row.get("motion", "neither") not in MOTIONS: fail(row, f"no such motion: {row['motion']}")
            for mode in row.get("modes", []):
                if mode not in modes: fail(row, f"no such mode: {mode}")
            for field in row.get("fields", []):
                if unknown := set(field) - FIELD_KEYS: fail(row, f"unknown keys {sorted(unknown)}")
                into = field.setdefault("into", field["name"])
                if into not in fields: fail(row, f"ChannelRequest has no field {into}")
                limited = "one_of" in field or ("minimum" in field and "maximum" in field)
                if fields[into] in QUANTITIES and not limited: fail(row, f"{field['name']} needs limits")
    missing = set(idl_type(f"{idl}/channel.idl", "CommandKind").values) - {r["command"] for r in table["channel"]}
    if missing: sys.exit(f"{path}: error: no row for {sorted(missing)}")


def load(path):
    with open(path) as f: table = yaml.safe_load(f)
    check(table, path, os.path.dirname(path) or ".")
    return table


def quoted(text): return '"' + str(text).replace("\\", "\\\\").replace('"', '\\"') + '"'
def flag(value): return "true" if value else "false"


def field_cpp(field, one_of):
    return (f"    {{{quoted(field['name'])}, Into::{field['into']}, {quoted(field['argument'])}, "
            f"{float(field.get('minimum', 0))}, {float(field.get('maximum', 0))}, {flag(field.get('nonzero'))}, "
            f"{flag(field.get('optional'))}, {flag(field.get('word_optional'))}, {one_of}}},")


def cpp(table):
    out = ["// Generated from idl/operator_commands.yaml by tools/generate_commands.py.", '#include "commands/command_table.hpp"', "",
           "namespace trunnion::commands {", "namespace {", "using idl::channel::CommandKind;", "using idl::channel::Mode;",
           "using idl::plc::PanelRequestKind;"]
    rows = []
    for row in table["channel"]:
        name = row["command"].lower()
        fields, modes = "{}", "{}"
        if row.get("fields"):
            lines = []
            for field in row["fields"]:
                one_of = "{}"
                if "one_of" in field:
                    one_of = f"{field['into']}_of_{name}"
                    out.append(f"constexpr double {one_of}[] = {{{', '.join(str(float(v)) for v in field['one_of'])}}};")
                lines.append(field_cpp(field, one_of))
            fields = f"fields_of_{name}"
            out += [f"constexpr Field {fields}[] = {{"] + lines + ["};"]
        if row.get("modes"):
            modes = f"modes_of_{name}"
            out.append(f"constexpr Mode {modes}[] = {{{', '.join('Mode::' + m for m in row['modes'])}}};")
        choice = next(iter(row.get("choice", {"": ""}).items()))
        rows.append(f"    {{CommandKind::{row['command']}, {quoted(row['route'])}, {quoted(choice[0])}, {quoted(choice[1])}, "
                    f"{quoted(row['word'])}, {quoted(row['about'])}, {modes}, {flag(row.get('busy'))}, {flag(row.get('stream'))}, Motion::{row.get('motion', 'neither')}, {fields}}},")
    out += ["constexpr ChannelCommand channel_rows[] = {"] + rows + ["};", "constexpr PanelCommand panel_rows[] = {"]
    out += [f"    {{PanelRequestKind::{r['command']}, {flag(r.get('stream'))}, {quoted(r['route'])}, {quoted(r['word'])}, {quoted(r['about'])}}}," for r in table["panel"]]
    out += ["};", "}  // namespace", "", "std::span<const ChannelCommand> channel_commands() { return channel_rows; }",
            "std::span<const PanelCommand> panel_commands() { return panel_rows; }", "", "}  // namespace trunnion::commands"]
    return "\n".join(out) + "\n"


def override_limits(table):
    """For those who bring an override within its limits: the table's own check refuses what is outside."""
    out = ["// Generated from idl/operator_commands.yaml by tools/generate_commands.py.", "#pragma once", "", "#include <algorithm>", "",
           "namespace trunnion::commands {", "", "struct OverrideLimits {", "  double minimum, maximum;",
           "  constexpr double clamp(double fraction) const { return std::clamp(fraction, minimum, maximum); }", "};", ""]
    for row in table["channel"]:
        if row["route"] != "override": continue
        field = row["fields"][0]
        out.append(f"inline constexpr OverrideLimits {row['command'].lower()}{{{float(field['minimum'])}, {float(field['maximum'])}}};")
    return "\n".join(out + ["", "}  // namespace trunnion::commands"]) + "\n"


def number(value): return f"{value:,}" if isinstance(value, int) else f"{value:g}"


def limits(field):
    if "one_of" in field: text = ", ".join(number(v) for v in field["one_of"])
    elif "minimum" in field:
        text = f"{number(field['minimum'])} .. {number(field['maximum'])}" + (", not 0," if field.get("nonzero") else "")
    else: text = ""
    return " ".join(part for part in (text, field.get("unit", "")) if part)


def usage(row):
    def argument(field):
        name = field["argument"].replace("|", "\\|")
        return f"[{name}]" if field.get("optional") or field.get("word_optional") else name
    return " ".join([row["word"]] + [argument(f) for f in row.get("fields", [])])


def document(table):
    out = ["# Operator commands", "",
           "Generated from `idl/operator_commands.yaml`. Each command is a POST (body and answers: `/api/openapi.json`), a word of",
           "`trunnion channel` or `trunnion estop`, and a request on the bus (`idl/channel.idl`, `idl/plc.idl`). A refusal says why",
           "and changes nothing. *Busy* means that a program, an MDI line, a jog or the handwheel is being executed. What a function",
           "does in detail is in [operating.md](operating.md).", ""]
    stops = [f"`{row['route']}`" for row in table["channel"] if row.get("motion") == "stops"]
    starts = [f"`{row['route']}`" for row in table["channel"] if row.get("motion") == "starts"]
    out += [*textwrap.wrap(f"Over HTTP {' and '.join(stops)} are answered 202 when the channel does not answer within 0.3 s: the gateway "
                           f"repeats them until it does, for 10 s at most. A later {', '.join(starts[:-1])} or {starts[-1]} for the "
                           "channel ends that. Any other command without an answer is 504 after 2 s and is not kept.", 120), "",
           "## To a channel", "",
           "| `POST /api/channels/N/…` | `trunnion channel …` | what it does | fields | refused |", "|---|---|---|---|---|"]
    for row in table["channel"]:
        fields = [f"`{k}`: {quoted(v)}" for k, v in row.get("choice", {}).items()]
        for field in row.get("fields", []):
            about = field["about"][0].lower() + field["about"][1:] if field["about"][1:2].islower() else field["about"]
            bounds = limits(field)
            fields.append(f"`{field['name']}`: {about}" + (f" ({bounds})" if bounds else "") + (", may be left out" if field.get("optional") else ""))
        refused = ([] if row.get("busy") else ["busy"]) + ([f"mode not {' or '.join(row['modes'])}"] if row.get("modes") else [])
        refused += [row["refused"]] if row.get("refused") else []
        what = row["about"] + (". " + row["more"] if row.get("more") else "")
        out.append(f"| `{row['route']}` | `{usage(row)}` | {what} | {'; '.join(fields) or '–'} | {', '.join(refused) or '–'} |")
    out += ["", "## To the operator panel", "", "| `POST /api/panel/…` | `trunnion estop …` | what it does |", "|---|---|---|"]
    out += [f"| `{r['route']}` | `{r['word']}` | {r['about']}" + (f". {r['more']}" if r.get("more") else "") + " |" for r in table["panel"]]
    return "\n".join(out) + "\n"


def write(path, text):
    if os.path.exists(path) and open(path).read() == text: return
    with open(path, "w") as f: f.write(text)


if __name__ == "__main__":
    p = argparse.ArgumentParser(description=__doc__)
    for name in ("--table", "--cpp", "--limits", "--document"): p.add_argument(name, required=True)
    a = p.parse_args()
    rows = load(a.table)
    write(a.cpp, cpp(rows)); write(a.limits, override_limits(rows)); write(a.document, document(rows))
