#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compiles OSCAT Basic, a library of functions and function blocks in Structured Text, and checks results of its functions.

    OSCAT=DIR tools/oscat/check_oscat.py TRUNNION    DIR has the exports of CoDeSys (.exp), in any number of files

The library is not a part of this repository. Without a directory nothing is checked, and the reason is printed. The table has
every unit that is refused, with its first error or the refused unit that it uses; then come the counts and the calls of
calls.yaml. It fails when a result is another one or fewer units compile than calls.yaml says.
"""
import argparse
import collections
import json
import os
import re
import subprocess
import sys
import tempfile

import yaml

HERE = os.path.dirname(os.path.abspath(__file__))
UNIT = re.compile(r'^[ \t]*(FUNCTION_?BLOCK|FUNCTION|TYPE|VAR_GLOBAL)\b[ \t]*(\w*)', re.M | re.I)
ENDS = {'FUNCTION': 'END_FUNCTION', 'FUNCTION_BLOCK': 'END_FUNCTION_BLOCK', 'TYPE': 'END_TYPE', 'VAR_GLOBAL': 'END_VAR'}
Unit = collections.namedtuple('Unit', 'name kind text words')


def masked(text):
    """The text with blanks in the place of comments, which nest, and of strings."""
    result, depth, at = list(text), 0, 0
    while at < len(text):
        opens, closes = text.startswith('(*', at), depth > 0 and text.startswith('*)', at)
        length = 2 if opens or closes else 1
        string = re.compile(r"'(?:\$.|[^'$\n])*'").match(text, at) if depth == 0 and not opens else None
        depth += opens
        if string:
            length = string.end() - at
        if depth > 0 or string:
            result[at:at + length] = [c if c == '\n' else ' ' for c in text[at:at + length]]
        depth -= closes
        at += length
    return ''.join(result)


def units_of(text):
    """The declarations of a file, one each."""
    plain, at = masked(text), 0
    while found := UNIT.search(plain, at):
        kind = found[1].upper().replace('FUNCTIONBLOCK', 'FUNCTION_BLOCK')
        end = re.compile(r'\b' + ENDS[kind] + r'\b', re.I).search(plain, found.end())
        if end is None:
            return
        at = end.end()
        words = {word.upper() for word in re.findall(r'\w+', plain[found.start():at])}
        yield Unit(found[2].upper(), kind, text[found.start():at] + '\n', words)


def read_library(directory):
    units = {}
    for folder, _, files in sorted(os.walk(directory)):
        for name in sorted(files):
            if not name.lower().endswith(('.exp', '.st')):
                continue
            with open(os.path.join(folder, name), encoding='latin-1') as file:
                for unit in units_of(file.read()):
                    key = unit.name if unit.kind != 'VAR_GLOBAL' else f'GLOBALS_{len(units)}'
                    units.setdefault(key, unit._replace(name=key))
    return units


def add_globals(units):
    """Exports of single units are without the global variables: one for each CONSTANTS type, and the two lengths."""
    if any(unit.kind == 'VAR_GLOBAL' for unit in units.values()):
        return
    prefix = 'CONSTANTS_'
    lines = [f'  {name[len(prefix):]} : {name};' for name in units if name.startswith(prefix)]
    text = 'VAR_GLOBAL\n' + '\n'.join(lines) + '\nEND_VAR\n' if lines else ''
    text += 'VAR_GLOBAL CONSTANT\n  STRING_LENGTH : INT := 250;\n  LIST_LENGTH : INT := 250;\nEND_VAR\n'
    units['GLOBALS'] = Unit('GLOBALS', 'VAR_GLOBAL', text, {word.upper() for word in re.findall(r'\w+', text)})


def run_json(command):
    answer = subprocess.run(command, capture_output=True, text=True, errors='replace')
    try:
        return json.loads(answer.stdout)
    except ValueError:
        sys.exit(f'oscat: {" ".join(command[:3])}: {answer.stderr.strip() or answer.stdout.strip()}')


def write_units(units, directory):
    for unit in units.values():
        with open(os.path.join(directory, unit.name + '.exp'), 'w', encoding='latin-1') as file:
            file.write(unit.text)


def without_refused(trunnion, units, directory):
    """Units that compile together, and of each other one why it does not."""
    good, refused = dict(units), {}
    while good:
        files = [os.path.join(directory, name + '.exp') for name in good]
        errors = [d for d in run_json([trunnion, 'plc', 'check', '--json', *files])['diagnostics'] if d['severity'] == 'error']
        if not errors:
            break
        before = len(good)
        for error in errors:
            name = os.path.basename(error['file'])[:-len('.exp')]
            refused.setdefault(name, f"{error['line']}:{error['column']}: {error['text']}")
            good.pop(name, None)
        if len(good) == before:
            sys.exit(f"oscat: {errors[0]['file']}:{errors[0]['line']}: {errors[0]['text']}")
        while uses := {name: sorted(unit.words & refused.keys()) for name, unit in good.items() if unit.words & refused.keys()}:
            for name, others in uses.items():
                refused[name] = f'uses {", ".join(others)}'
                del good[name]
    return good, refused


def test_of(row):
    """A TEST of one call; its name is the call."""
    call, result = row['call'], row['result']
    check = f"ASSERT_NEAR({call}, {float(result)!r}, {row['within']:.9f})" if 'within' in row else f'ASSERT_EQ({call}, {result})'
    name = call.replace('$', '$$').replace("'", "$'")
    return f"TEST '{name}'\n{check};\nEND_TEST\n"


def check_calls(trunnion, groups, good, directory):
    """The calls with another result than expected."""
    rows = [row for rows in groups.values() for row in rows]
    called = [row for row in rows if row['call'].split('(')[0].upper() in good]
    with open(os.path.join(directory, 'calls_test.st'), 'w', encoding='utf-8') as file:
        file.write(''.join(test_of(row) for row in called))
    for name in os.listdir(directory):
        if name.endswith('.exp') and name[:-len('.exp')] not in good:
            os.remove(os.path.join(directory, name))
    answer = run_json([trunnion, 'plc', 'test', '--json', directory])
    if 'tests' not in answer:
        return [d['text'] for d in answer['diagnostics'] if d['severity'] == 'error'], 0, len(rows)
    wrong = [f"{test['name']}: {test['message']}" for test in answer['tests'] if not test['passed']]
    return wrong, len(called), len(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('trunnion')
    arguments = parser.parse_args()
    library = os.environ.get('OSCAT', '')
    if not os.path.isdir(library):
        print('oscat: skipped: OSCAT names no directory with the library; it is not a part of this repository')
        return 0
    with open(os.path.join(HERE, 'calls.yaml'), encoding='utf-8') as file:
        table = yaml.safe_load(file)
    units = read_library(library)
    add_globals(units)
    with tempfile.TemporaryDirectory() as directory:
        write_units(units, directory)
        good, refused = without_refused(arguments.trunnion, units, directory)
        wrong, called, rows = check_calls(arguments.trunnion, table['calls'], good, directory)
    for name in sorted(refused):
        print(f'{name:24} {units[name].kind:14} {refused[name]}')
    few = []
    for kind, least in table['compiled'].items():
        number = sum(unit.kind == kind for unit in good.values())
        print(f'{kind}: {number} of {sum(unit.kind == kind for unit in units.values())} compile')
        if number < least:
            few.append(f'{kind}: {number} compile, at least {least} did before')
    print(f'{called} of {rows} calls made, {len(wrong)} with another result')
    for line in wrong + few:
        print(line)
    return 1 if wrong or few else 0


if __name__ == '__main__':
    sys.exit(main())
