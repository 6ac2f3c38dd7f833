#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""manual_page.py TRUNNION VERSION OUTPUT: the manual page trunnion(1), made of what the command says with --help."""
import re, subprocess, sys

program, version, output = sys.argv[1:]


def help_of(words):
    return subprocess.run(["trunnion", *words, "--help"], executable=program, capture_output=True, text=True, check=True).stdout


def escape(text): return re.sub(r"^([.'])", r"\\&\1", text.replace("\\", "\\e").replace("-", "\\-"), flags=re.M)


def subcommands(text):
    """Names under the groups of commands of CLI11's help, which indents them by two blanks. A heading follows an empty line;
    one within a footer, as of the help of channel, does not."""
    names, commands, empty = [], False, False
    for line in text.splitlines():
        if line and not line[0].isspace(): commands = empty and line.endswith(":") and line not in ("Options:", "Positionals:")
        elif commands and (name := re.match(r"  (\S+)", line)): names.append(name[1])
        empty = not line
    return names


def sections(words):
    text = help_of(words)
    yield " ".join(words), text
    for name in subcommands(text): yield from sections([*words, name])


page = [f'.TH TRUNNION 1 "" "trunnion {version}" "Trunnion"', ".SH NAME", "trunnion \\- starts, runs and watches a distributed CNC controller",
        ".SH SYNOPSIS", ".B trunnion", "COMMAND [OPTIONS]", ".SH DESCRIPTION",
        "Not safety\\-rated: a machine needs a hard\\-wired emergency stop that works without any of this software."]
for name, text in sections([]):
    page += [f'.SH "{("trunnion " + name).strip().upper()}"' if name else ".SH OPTIONS AND COMMANDS", ".nf", escape(text.rstrip()), ".fi"]
page += [".SH SEE ALSO", "/usr/share/doc/trunnion"]
with open(output, "w") as f: f.write("\n".join(page) + "\n")
