#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the reference tables of docs/ from the files that define their content: parameters, alarms, G and M codes, PLC registers,
the tables of IEC 61131-3; and what the page knows of alarms and codes.

With --check nothing is written: differences are printed and the exit status is 1.
"""
import argparse, difflib, json, os, re, sys, textwrap
import yaml
from alarm_table import AlarmTable

WIDTH = 120  # of a line of prose
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TEXT = r'((?:"(?:[^"\\]|\\.)*"\s*)+)'  # C++ string literals, which the compiler joins


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as f: return f.read()


def fail(path, text): sys.exit(f"{path}: error: {text}")


def cell(value): return str(value).replace("|", "\\|").replace("\n", " ")


def wrapped(line):
    """A paragraph or list entry in lines of at most WIDTH columns; a table row stays as it is."""
    if line.startswith("|") or not line: return [line]
    indent = "  " if line.startswith("- ") else ""
    return textwrap.wrap(line, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(cell(c) for c in row) + " |" for row in rows]


def entries(path, name, pattern):
    """Every NAME{...} of a C++ table; an entry that does not match the pattern is an error."""
    text = read(path)
    found = re.findall(name + r"\{\s*" + pattern + r"\s*\}", text)
    there = len(re.findall(name + r"\{", text))
    if not found or len(found) != there: fail(path, f"{len(found)} of {there} entries {name}{{...}} can be read")
    return found


def joined(literals): return "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', literals)).replace('\\"', '"')


def number(value):
    if isinstance(value, list): return " ".join(number(v) for v in value)
    return f"{value:g}" if abs(value) < 1e6 else f"{value:.0f}"


def parameters():
    path = "libs/machine/machine/catalogue.yaml"
    catalogue = yaml.safe_load(read(path))
    out = ["# Parameters", "", f"Generated from `{path}` by `tools/generate_docs.py`.", "",
           "The number of a parameter is the base of its class, plus 1000 for each unit (channel c, axis a), plus the offset: `10a034` is 100034 "
           "for axis 0 and 112034 for axis 12. Activation: *save* takes effect at once, *reset* at the next reset of a channel, *restart* at the "
           "start of the cluster. The numbers are those of the HNC-8 manual, with two exceptions: offsets 900 and above are Trunnion's own, and "
           "the manual does not define 30a020 to 30a024 and the numbers that are marked as inferred. Values are changed with `trunnion param`, on the "
           "page, or with `PUT /api/parameters/{number}`.", ""]
    known = set()
    for name, about in catalogue["classes"].items():
        letter = {"channel": "c", "axis": "a", "compensation": "a"}.get(name)
        if about["units"] > 1 and letter is None: fail(path, f"class {name} has several units and no letter for them here")
        rows = []
        for p in sorted((p for p in catalogue["parameters"] if p["class"] == name), key=lambda p: p["offset"]):
            known.add((name, p["name"]))
            first, last = p["offset"], p["offset"] + p.get("count", 1) - 1
            base = f"{about['base'] // 1000:03d}"
            digits = (lambda o: f"{base[:2]}{letter}{o:03d}") if letter else (lambda o: f"{about['base'] + o:06d}")
            text = p["type"] == "text"
            rows.append((f"`{digits(first)}`" + (f" .. `{digits(last)}`" if last > first else ""), p["name"], p["unit"].replace("|", " or "),
                         p["type"], "" if text else f"{number(p['min'])} .. {number(p['max'])}", p["default"] if text else number(p["default"]),
                         p["activation"], p["access"], p["help"]))
        out += [f"## {about['about'][0].upper()}{about['about'][1:]}", ""] + table(("number", "name", "unit", "type", "range", "default", "activation", "access", "meaning"), rows) + [""]
    if len(known) != len(catalogue["parameters"]): fail(path, "a parameter is in no class, or twice in one")
    return out


ALARMS = "libs/machine/machine/alarms.yaml"


def alarm_table(): return AlarmTable(os.path.join(ROOT, ALARMS))


def alarm_catalogue():
    """What the page shows of an alarm beside the service's own text."""
    alarms = alarm_table()
    english = {row["number"]: row for row in alarms.machine}
    languages = {"en": (english, alarms.remedy), **{name: alarms.translation(name) for name in ("zh", "de")}}
    out = ["// SPDX-License-Identifier: Apache-2.0", f"// Generated from {ALARMS} and its translations by tools/generate_docs.py.", "",
           "/** What an alarm says, its usual cause and what the operator does, by its number and the language. */",
           "export const alarmCatalogue: Readonly<Record<number, Readonly<Record<string, { text: string; cause: string; remedy: string }>>>> = {"]
    for number in english:
        out.append(f"  {number}: {{")
        for name, (texts, _) in languages.items():
            members = (f"{key}: {json.dumps(texts[number][key], ensure_ascii=False)}" for key in ("text", "cause", "remedy"))
            out.append(f"    {name}: {{ {', '.join(members)} }},")
        out.append("  },")
    remedies = (f"    {name}: {json.dumps(remedy, ensure_ascii=False)}," for name, (_, remedy) in languages.items())
    return out + ["};", "", "/** The alarms of the NC language, whose texts name place and cause: what the operator does, by the language. */",
                  "export const languageAlarms: { first: number; last: number; remedy: Readonly<Record<string, string>> } = {",
                  f"  first: {alarms.first},", f"  last: {alarms.last},", "  remedy: {", *remedies, "  },", "};"]


def alarms():
    alarms = alarm_table()
    out = ["# Alarms", "", f"Generated from `{ALARMS}` by `tools/generate_docs.py`.", "",
           "An alarm is latched: it stays until it is reset (`trunnion alarms --reset`, or on the page), and a reset clears only alarms whose cause "
           "is gone. While an alarm with a reaction other than *show* is active, every channel holds on its path and nothing can be started. For 110 "
           "to 113 the drive also brakes by itself; for 130 and 133 it brakes and switches the axes off. [faults.md](faults.md) describes the "
           "reaction to the loss of a process. *about*: the subject of the alarm. A reset of one channel clears the alarms about that channel and "
           "its axes, gantry slaves included, and all that the process of the channel has raised.", "", "## Machine and cluster", ""]
    out += table(("number", "name", "severity", "reaction", "about", "text", "usual cause", "remedy"),
                 [(a["number"], f"`{a['name']}`", *(a[key] for key in ("severity", "reaction", "about", "text", "cause", "remedy"))) for a in alarms.machine])
    common = alarms.common
    out += ["", "## NC language", "", f"Numbers {alarms.first} to {alarms.last}, severity *{common['severity']}*, reaction *{common['reaction']}*, about the "
            f"{common['about']}: the program ends at the fault. The text names the place, `program:line:column`, and the word. Remedy: {alarms.remedy}", ""]
    return out + table(("number", "text"), [(a["number"], a["text"]) for a in alarms.language])


def code_tables():
    """Rows of the G codes, of the calls and of the M codes, and the files they are from."""
    g_path, m_path, calls = (f"libs/program/language/{f}" for f in ("codes.cpp", "codes.hpp", "macro_call.hpp"))
    dialect = {"iso": "ISO", "fanuc": "Fanuc", "hnc": "HNC", "num": "NUM", "g2core": "g2core"}
    program = lambda text: "`" + joined(text).replace("\\n", " / ") + "`"
    shown = r",\s*Origin::(\w+),\s*" + TEXT + r",\s*" + TEXT
    g = [(int(t), group, joined(text), dialect[o], joined(since), program(example)) for t, group, text, o, since, example in
         entries(g_path, "GCode", r"(\d+),\s*Group::(\w+),\s*AxisWords::\w+,\s*run<[^>]*>,\s*" + TEXT + shown)]
    c = [(int(first), int(last), joined(text), dialect[o], joined(since), program(example)) for first, last, text, o, since, example in
         entries(calls, "CallCode", r"(\d+),\s*(\d+),\s*CallKind::\w+,\s*" + TEXT + shown)]
    m = [(int(n), when, action, group, joined(text)) for n, when, action, group, text in
         entries(m_path, "MCode", r"(\d+),\s*When::(\w+),\s*MAction::(\w+),\s*MGroup::(\w+),\s*" + TEXT)]
    return (g_path, m_path, calls), g, c, m


def code_name(tenths): return f"G{tenths // 10}" + (f".{tenths % 10}" if tenths % 10 else "")


def code_catalogue():
    """What the program editor of the page knows of the codes."""
    paths, g, c, m = code_tables()
    rows = lambda pairs: [f"  {json.dumps(code)}: {json.dumps(about, ensure_ascii=False)}," for code, about in pairs]
    return ["// SPDX-License-Identifier: Apache-2.0", f"// Generated from {', '.join(paths)} by tools/generate_docs.py.", "",
            "/** Meaning of each G code that is a function of a block. */", "export const gCodes: Readonly<Record<string, string>> = {",
            *rows((code_name(t), about) for t, _, about, *_ in g), "};", "",
            "/** Calls of macros and cycles, each from the first to the last code. */", "export const callCodes: readonly (readonly [first: string, last: string, about: string])[] = [",
            *(f"  [{json.dumps(code_name(a))}, {json.dumps(code_name(b))}, {json.dumps(about, ensure_ascii=False)}]," for a, b, about, *_ in c), "];", "",
            "/** M codes that the control knows; every other one up to M999 is the PLC's. */", "export const mCodes: Readonly<Record<string, string>> = {",
            *rows((f"M{n}", about) for n, _, _, _, about in m), "};"]


def codes():
    (g_path, m_path, calls), g, c, m = code_tables()
    version = re.search(r"project\(trunnion VERSION (\d+)\.(\d+)", read("CMakeLists.txt"))
    if not version: fail("CMakeLists.txt", "project(trunnion VERSION ...) is not there")
    for since in {row[4] for row in g} | {row[4] for row in c}:
        if [int(n) for n in since.split(".")] > [int(n) for n in version.groups()]:
            fail(g_path, f"a code is there since {since}, this is version {'.'.join(version.groups())}")
    out = ["# G and M codes", "", f"Generated from `{g_path}`, `{m_path}` and `{calls}` by `tools/generate_docs.py`.", "", "## G codes", "",
           "A block may contain one code of each group; a second one is an alarm. Every group except *one_block* and *exact_stop* is modal: the "
           "code stays active until another code of its group. "
           "A motion code ends a cycle. A channel with parameter 04c959 = 1 reads the functions of [num.md](num.md) instead, with 2 those of [linuxcnc.md](linuxcnc.md). *Dialect*: ISO 6983, Fanuc, HNC-8 or NUM controls, or g2core; *since*: the version of Trunnion. Each example is a program that a test runs; blocks are separated by /.", ""]
    out += table(("code", "group", "meaning", "dialect", "since", "example"), [(code_name(t), *rest) for t, *rest in g])
    out += ["", "## Calls", "", "Such a code is the only code of its block; see [macros.md](macros.md) for the arguments.", ""]
    out += table(("code", "meaning", "dialect", "since", "example"), [(code_name(a) + (f" .. {code_name(b)}" if b != a else ""), *rest) for a, b, *rest in c])
    out += ["", "## M codes", "", "*before* and *after*: the code acts before or after the motion of its block. A block may contain one M code of each group, and none "
            "twice. Parameters 04c944 to 04c949 list the M codes that the machine's logic carries out, in groups likewise; any other one is alarm 1104. "
            "Those that are not in this table go to the PLC before the motion, except those of parameters 010170 to 010177, which call G1007 to G1014.", ""]
    return out + table(("code", "acts", "group", "handled as", "meaning"), [(f"M{n}", when, "" if group == "none" else group, action, text) for n, when, action, group, text in m])


def macros():
    variables, functions, calls = (f"libs/program/language/{f}.hpp" for f in ("variables", "arithmetic", "macro_call"))
    v = [(int(a), int(b), w == "true", joined(text)) for a, b, w, text in
         entries(variables, "VariableRange", r"(\d+),\s*(\d+),\s*VariableKind::\w+,\s*(true|false),\s*" + TEXT)]
    f = [(joined(n), joined(text)) for n, text in entries(functions, "FunctionName", TEXT + r",\s*Function::\w+,\s*" + TEXT)]
    letters = re.findall(r"ArgumentLetter\{'(\w)',\s*(\d+)\}", read(calls))
    out = ["# Macros", "", f"The tables are generated from `{variables}`, `{functions}` and `{calls}` by `tools/generate_docs.py`.", "",
           "## Variables", "",
           "A variable without a value is vacant: it counts as 0 in a computation, `EQ` and `NE` distinguish it from 0, and a word whose number is a "
           "vacant variable is ignored. Where Fanuc and HNC-8 number variables differently, this table applies. Reading or writing any number "
           "that is not in it is alarm 1509 with that number. Lengths of system variables are in mm or inch according to G21 or G20. "
           "`#[expression]` names a variable by a computed number.", "",
           "Of HNC-8's own system variables from #1000 on, the available manuals name one, #1319 (the angle of G115, which does not exist here either). "
           "The numbers of the others are not known. Therefore none exists: a program that uses one stops with that alarm and does not continue with "
           "wrong values. Their functions exist under Fanuc's numbers: time from #3001, modal state from #4001, positions from #5001, tools from "
           "#2001, offsets from #5221 and #7001.", ""]
    out += table(("variables", "may be written", "meaning"), [(f"#{a}" + (f" .. #{b}" if b != a else ""), "yes" if w else "no", text) for a, b, w, text in v])
    out += ["", "## Expressions", "",
            "Precedence, highest first: functions and signs; `*` `/` `MOD` `AND`; `+` `-` `OR` `XOR`; the comparisons `EQ NE GT GE LT LE` or "
            "`== != <> > >= < <=`, which give 1 or 0; `&&`; `||`. `AND` `OR` `XOR` work on the bits of whole numbers; `&&` `||` `NOT` `!` on true "
            "(not 0) and false (0). Brackets are `[ ]`, at most 32 deep. "
            "`PI` is a constant. The number of any word may be `#variable` or `[expression]`, with a sign: `X[#1+2]`, `Y-#1`, `G#3`.", ""]
    out += table(("function", "meaning"), f)
    out += ["", "## Instructions", "",
            "An assignment or instruction is alone in its block, except for N. Several assignments may follow each other; one to a system variable is the last.", "",
            "| form | meaning |", "|---|---|",
            "| `#i = expression` | assignment |",
            "| `IF condition` .. `ELSEIF condition` .. `ELSE` .. `ENDIF` | the blocks after the first condition that is true, otherwise those after `ELSE`; `THEN` may end the line of `IF` and `ELSEIF` |",
            "| `IF condition GOTO n`, `IF condition THEN ...` | a jump, an assignment or words, if the condition is true |",
            "| `WHILE condition` .. `ENDW` | a loop |",
            "| `WHILE condition DO n` .. `END n`, `DO n` .. `END n` | a loop with a number; without `WHILE` until a jump leaves it |",
            "| `GOTO n` | to the block with that N: searched forward, then from the start of the program |", "",
            "`IF`, `WHILE` and `DO` nest 16 deep in a program. A jump may leave them but not enter one.", "",
            "## Calls", "",
            "`M98 P_ L_` calls a subprogram, which shares the local variables of its caller. Without L, and when no program has that number, the "
            "digits before the last four count the calls, as in Fanuc's old form: `M98 P60020` calls O0020 six times. `G65 P_ L_` and `G66 P_ L_` "
            "call a macro. `G1000` .. `G1999` and the M codes of parameters 010170 to 010177 call a cycle of `USERDEF.CYC`. Both have local variables "
            "of their own, which are set to the arguments at the start of each repetition. `M99` returns, `M99 P_` to the block of the caller "
            "with that N; in the main program `M99 P_` jumps to that block, and `M99` starts the program again. Calls nest 8 deep.", "",
            "`CYCLE1234(1, \"text\", , 4)` calls O1234 as a macro; its arguments are #1 #2 #3 #4, and vacant where one is left out or a text. The "
            "control has O9960 for `CYCLE9960` ([calibration.md](calibration.md#in-a-program)), O9801 "
            "([calibration-programs.md](calibration-programs.md)) and O9810 to O9819 ([measuring-cycles.md](measuring-cycles.md)); a stored "
            "program goes before them.", "",
            "`G66` calls after each block that moves, canned cycles included. `G66.1` calls instead of each following block until `G67`; the letters of the "
            "block are the arguments, and G (the last one), L, N and P are #10, #12, #14 and #16.", "",
            "The letters of a macro become the variables of Fanuc's argument list I. I, J and K may be given up to ten times, and are then #4 #5 #6, "
            "#7 #8 #9 and so on to #33 (list II). A letter that does not continue the order from I to K starts the next set. Of two words for one "
            "variable the later applies. The letters of a cycle are numbered by the alphabet, as on HNC-8: A is #0, B #1 .. Z #25. G, N and O are "
            "not arguments, nor are L and P of a macro and M of a cycle.", ""]
    return out + table([l for l, _ in letters], [[f"#{n}" for _, n in letters]])


def address(first, index, stride):
    kind, rest = first[0], first[1:]
    register, _, bit = rest.partition(".")
    if stride == "bit":
        width = next(int(bits) for area, bits, *_ in register_areas() if area == kind)
        return f"{kind}{int(register) + (int(bit) + index) // width}.{(int(bit) + index) % width}"
    return f"{kind}{int(register) + index * stride}" + (f".{bit}" if bit else "")


def register_areas():
    """Letter, bits, kept, number of registers and meaning of each area, from the table of the compiler."""
    row = re.compile(r"\{'(\w)', (\d+), (true|false), (true|false), (\d+), \"(.*)\"\}")
    return row.findall(read("libs/plc/plc/machine/register_area.hpp"))


def registers():
    path = "libs/plc/plc/library/registers.yaml"
    out = ["# PLC registers", "", f"Generated from `{path}` and `libs/plc/plc/machine/register_area.hpp` by `tools/generate_docs.py`.", "",
           "## Areas", "",
           "The areas of the manuals. Every register can be addressed as they print it: `%G2960`, `%F2636.10`, `%K15.6`, `%W50`, `%B31`. Instruction "
           "lists and Structured Text see the same registers.", ""]
    out += table(("area", "registers", "bits", "retained", "content"),
                 [(f"`{a}`", f"`{a}0` .. `{a}{int(n) - 1}`", bits, "yes" if kept == "true" else "", about)
                  for a, bits, signed, kept, n, about in register_areas()])
    out += ["",
            "Retained registers keep their values through a new start of the cluster, and so do registers of R, W, D and T that a program declares in "
            "`VAR RETAIN` ([plc.md](plc.md#registers)). F and G are divided into blocks:", ""]
    out += table(("block", "registers"),
                 [("axis a, 0 .. 31", "80 * a .. 80 * a + 79, for example `G[80*2+11]` is `%G171`"),
                  ("channel c, 0 .. 4", "2560 + 80 * c .. 2639 + 80 * c"), ("whole machine", "2960 .. 3119"),
                  ("channel 5 .. 7, which the manuals do not have", "3120, 3200, 3280 and 79 more")])
    out += ["", "## Registers with a function", "",
            "This is the interface between the PLC program and the other services; programs use the names. A name with several registers is `name_0`, "
            "`name_1` and so on. \"storage\" are registers to which only the manuals give a meaning. They and all without a name are storage of the programs: "
            "nothing else in this product reads or writes them. The languages are described in [plc.md](plc.md).", ""]
    rows = []
    for r in yaml.safe_load(read(path))["registers"]:
        channels = r.get("each") == "channel"
        count, stride = 8 if channels else r.get("count", 1), r.get("stride", 1)
        several = count > 1
        last = address(r["address"], 720, 1) if channels else address(r["address"], count - 1, stride)
        where = f"`{r['address']}`" + (f" .. `{last}`" if several else "")
        step = "" if not several else "each channel" if channels else "each bit" if stride == "bit" else f"every {stride}" if stride > 1 else "each"
        rows.append((f"`{r['name']}" + (f"_0` .. `_{count - 1}`" if several else "`"), where, step, r.get("unit", ""), r.get("about", "")))
    out += table(("name", "address", "step", "unit", "meaning"), rows)
    out += ["", "## Registers that the manuals name", ""]
    manual = yaml.safe_load(read(path))["manuals"]
    return out + table(("address", "meaning in the manuals", "here"), [(f"`{m['address']}`", m["about"], m["here"]) for m in manual])


def paragraphs(lines): return [line for paragraph in lines for line in wrapped(paragraph)]


def input_catalogue():
    """The inputs that have a name on every machine and the names of all registers, for the PLC's view of the page."""
    path = "libs/plc/plc/library/registers.yaml"
    named = yaml.safe_load(read(path))["registers"]
    inputs = [r for r in named if r["address"].startswith("X")]
    return ["// SPDX-License-Identifier: Apache-2.0", f"// Generated from {path} by tools/generate_docs.py.", "",
            "/** Names of input bits that every machine has, by their address. */", "export const inputNames: Readonly<Record<string, string>> = {",
            *(f"  {json.dumps(r['address'])}: {json.dumps(r['name'])}," for r in inputs), "};", "",
            "/** Names of registers; one that ends with _ has a number behind it. */", "export const registerNames: ReadonlySet<string> = new Set([",
            *(f"  {json.dumps(r['name'] + ('_' if 'each' in r or 'count' in r else ''))}," for r in named), "]);"]


STANDARD = "libs/plc/plc/conformance"


def standard_tables():
    """Every table of IEC 61131-3 by its number."""
    names = sorted(n for n in os.listdir(os.path.join(ROOT, STANDARD)) if n.endswith(".yaml"))
    tables = [t for n in names for t in yaml.safe_load(read(f"{STANDARD}/{n}"))["tables"]]
    return sorted(tables, key=lambda t: t["table"])


def standard():
    tables, words = standard_tables(), {"done": "yes", "partly": "partly", "not": "no"}
    plain = lambda text: re.sub(r"([*<`]|(?<!\w)_)", r"\\\1", text)
    status = [r.get("status", "done") for t in tables for r in t["rows"]]
    count = {s: status.count(s) for s in words}
    out = ["# The PLC and the tables of IEC 61131-3", "", f"Generated from `{STANDARD}` by `tools/generate_docs.py`.", "",
           f"IEC 61131-3:2013 (third edition) row by row: of {len(status)} rows {count['done']} are done, {count['partly']} partly, {count['not']} are not "
           "available; what is not available is refused with an error, never accepted without effect. Each row that is done has a program in the "
           "files above, which a test runs, or names the test that covers it. The features are in our own words; rows are counted as in the "
           "standard, where some of the later tables may differ in a letter. What the compiler has is described in [plc.md](plc.md#language).", ""]
    for t in tables:
        out += [f"## Table {t['table']}: {t['title']}", ""] + ([t["remark"], ""] if "remark" in t else [])
        out += table(("row", "feature", "done", "remark"),
                     [(r["row"], plain(r["feature"]), words[r.get("status", "done")], plain(r.get("remark", ""))) for r in t["rows"]]) + [""]
    return out


OUTPUTS = {
    "docs/parameters.md": lambda: paragraphs(parameters()), "docs/alarms.md": lambda: paragraphs(alarms()), "docs/codes.md": lambda: paragraphs(codes()),
    "docs/macros.md": lambda: paragraphs(macros()), "docs/plc-registers.md": lambda: paragraphs(registers()),
    "docs/plc-standard.md": lambda: paragraphs(standard()),
    "gateway/web/src/alarm_catalogue.ts": alarm_catalogue, "gateway/web/src/program/code_catalogue.ts": code_catalogue,
    "gateway/web/src/plc/input_catalogue.ts": input_catalogue,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="compare with the committed files instead of writing them")
    check = parser.parse_args().check
    stale = False
    for name, make in OUTPUTS.items():
        path = os.path.join(ROOT, name)
        text = "\n".join(make()).rstrip("\n") + "\n"
        old = ""
        if os.path.exists(path):
            with open(path, encoding="utf-8") as f: old = f.read()
        if old == text: continue
        if not check:
            with open(path, "w", encoding="utf-8") as f: f.write(text)
            continue
        stale = True
        sys.stdout.writelines(difflib.unified_diff(old.splitlines(True), text.splitlines(True), name, "as generated"))
    if stale: sys.exit("a committed file differs from the output of tools/generate_docs.py: run it and commit the result")


if __name__ == "__main__":
    main()
