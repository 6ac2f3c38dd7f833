#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks a corpus of real part programs and compares the verdicts with integration_tests/corpus/programs.csv: docs/corpus.md.

    CORPUS=DIR tools/corpus.py TRUNNION             fails when a verdict is worse, or fewer than 95 % pass of those that should
    CORPUS=DIR tools/corpus.py TRUNNION --update    writes the verdicts into the table
    CORPUS=DIR tools/corpus.py --fetch              downloads the programs of the table that DIR does not have, by hash

The programs are not a part of this repository. Without a directory nothing is checked, and the reason is printed.
"""
import argparse
import collections
import concurrent.futures
import csv
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse
import urllib.request

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TABLE = os.path.join(ROOT, 'integration_tests', 'corpus', 'programs.csv')
PATHS = os.path.join(ROOT, 'tools', 'linuxcnc_path.py')
COLUMNS = ['sha256', 'repository', 'commit', 'path', 'called_by', 'control', 'machine', 'dialect', 'expected', 'verdict', 'reason']
PYTHON = '/usr/bin/python3'  # that of the package linuxcnc-uspace
SHARE = 0.95
SECONDS = 20  # for one program
PLACE = 1e-6  # mm, within which two paths agree
LONGEST = 140  # columns of a reason
ALARM = re.compile(r'^(?P<file>.*?):(?P<line>\d+):(?P<column>\d+:)? ?(?P<number>\d{3,4}): (?P<text>.*)$')
PLACED = re.compile(r'^(\S+?:)?\d+:(\d+:)? ')

# What the programs of the table run on: delivered machines without ends of travel and without bodies, with every tool, and
# with a logic that carries out every M code. `letters` renames a channel's axis; such a machine has no kinematics.
MACHINES = {
    'four-axis': {'of': 'four-axis'},
    'ac-table': {'of': 'ac-table'},
    'bc-table': {'of': 'bc-table'},
    'ab-table': {'of': 'ac-table', 'letters': {'040006': '040005'}},
    'lathe': {'of': 'lathe', 'tools': 99},
}
FUNCTIONS = '"040944": 3 4 5 19; 6; 7 8 9'
M_CODES = [code for code in range(10, 10000) if code != 19]


class Row(dict):
    """A line of the table: a program, or a text that another one calls."""

    def __getattr__(self, name):
        return self[name]

    def is_program(self):
        return self['called_by'] == ''

    def file(self, corpus):
        folder = (self['called_by'] or self['sha256'])[:12]
        return os.path.join(corpus, folder, os.path.basename(self['path']))


def read_table():
    with open(TABLE, encoding='utf-8', newline='') as file:
        return [Row(row) for row in csv.DictReader(file)]


def write_table(rows):
    with open(TABLE, 'w', encoding='utf-8', newline='') as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator='\n')
        writer.writeheader()
        writer.writerows(rows)


def digest(path):
    with open(path, 'rb') as file:
        return hashlib.sha256(file.read()).hexdigest()


def url_of(row):
    path = urllib.parse.quote(row.path)
    return f'https://raw.githubusercontent.com/{row.repository}/{row.commit}/{path}'


def fetch(rows, corpus):
    """Downloads what is missing or has another hash. False when a file could not be had."""
    missing = []
    for row in rows:
        path = row.file(corpus)
        if os.path.exists(path) and digest(path) == row.sha256:
            continue
        try:
            with urllib.request.urlopen(url_of(row), timeout=60) as answer:
                data = answer.read()
        except OSError as error:
            missing.append(f'{url_of(row)}: {error}')
            continue
        if hashlib.sha256(data).hexdigest() != row.sha256:
            missing.append(f'{url_of(row)}: another content than the table says')
            continue
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'wb') as file:
            file.write(data)
    print(f'{len(rows) - len(missing)} of {len(rows)} files in {corpus}')
    print('\n'.join(missing), end='\n' if missing else '')
    return not missing


def parameters_of(lines, letters):
    """The parameters without ends of travel, speeds of spindles and M functions."""
    for line in lines:
        number = re.match(r'"(\d{6})"', line)
        if number and number[1][0] == '1' and number[1][3:] in ('006', '007', '948', '985', '986', '973'):
            continue
        if number and (re.match(r'0409(4[4-9])|01092', number[1]) or (letters and number[1].startswith('0404'))):
            continue
        for old, new in letters.items():
            line = line.replace(f'"{old}"', f'"{new}"')
        yield line


def ranges_of(codes):
    """Codes as ranges: 10-18 20-29."""
    first = last = None
    for code in [*codes, None]:
        if first is not None and code != last + 1:
            yield f'{first}-{last}' if last > first else str(first)
            first = None
        first = code if first is None else first
        last = code


def make_machine(name, directory, codes):
    """A machine of MACHINES as a folder, with these M codes besides the usual ones."""
    wide, letters = MACHINES[name], MACHINES[name].get('letters', {})
    source = os.path.join(ROOT, 'configs', 'machines', wide['of'])
    folder = os.path.join(directory, name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    shutil.copytree(os.path.realpath(os.path.join(source, 'plc')), os.path.join(folder, 'plc'))
    with open(os.path.join(source, 'machine.yaml'), encoding='utf-8') as file:
        text = re.sub(r'(?m)^name: .*', f'name: {name}', file.read())
    texts = {'machine.yaml': text, 'work_offsets.yaml': '[]\n'}
    with open(os.path.join(source, 'parameters.yaml'), encoding='utf-8') as file:
        parameters = list(parameters_of(file.read().splitlines(), letters))
    texts['parameters.yaml'] = '\n'.join([*parameters, f'{FUNCTIONS}; {" ".join(ranges_of(codes))}', ''])
    texts['tools.yaml'] = ''.join(f'- {{number: {tool}, length: 0, radius: 0, name: T{tool}}}\n'
                                   for tool in range(1, wide.get('tools', 999) + 1))
    for file_name, text in texts.items():
        with open(os.path.join(folder, file_name), 'w', encoding='utf-8') as file:
            file.write(text)
    return folder


def run(command, errors=subprocess.STDOUT):
    """(exit status or None after SECONDS, output with the errors in it, or without)."""
    try:
        answer = subprocess.run(command, stdout=subprocess.PIPE, stderr=errors, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return None, ''
    return answer.returncode, answer.stdout.decode('utf-8', 'replace')


def machines(trunnion, directory):
    """{name: folder}. M codes that belong to the control are left to it: the check names them, one at a time."""
    result, codes = {'': ''}, list(M_CODES)
    program = os.path.join(directory, 'empty.nc')
    with open(program, 'w', encoding='ascii') as file:
        file.write('M30\n')
    for name in MACHINES:
        while True:
            folder = make_machine(name, directory, codes)
            status, text = run([trunnion, 'check', program, '--machine', folder])
            own = re.search(r'M(\d+) belongs to the control', text)
            if own is None or int(own[1]) not in codes:
                break
            codes.remove(int(own[1]))
        if status != 0:
            sys.exit(f'corpus: machine {name}: {text.strip()}')
        result[name] = folder
    return result


def command_of(trunnion, row, corpus, folders, *options):
    command = [trunnion, 'check', row.file(corpus), *options]
    if row.machine:
        command += ['--machine', folders[row.machine]]
    if row.dialect:
        command += ['--dialect', row.dialect]
    return command


def reason_of(text, file):
    """The first alarm with its place, in one line; what is in a called text begins with its name."""
    lines = text.splitlines()
    found = next(filter(None, map(ALARM.match, lines)), None)
    if found is None:
        return (lines[-1] if lines else 'no output').replace(file, os.path.basename(file))[:LONGEST]
    name = '' if found['file'] == file else os.path.basename(found['file']) + ':'
    return f"{name}{found['line']}:{found['column'] or ''} {found['number']}: {found['text']}"[:LONGEST]


def judge(trunnion, row, corpus, folders):
    """(verdict, reason)."""
    status, text = run(command_of(trunnion, row, corpus, folders))
    if status is None:
        return 'refused', f'not done within {SECONDS} s'
    if status == 0:
        return 'pass', ''
    return 'refused', reason_of(text, row.file(corpus))


def kind_of(reason):
    """A reason without its place."""
    return PLACED.sub('', reason)


def print_reasons(rows, verdicts):
    """Which reasons how often, with a program each."""
    kinds = collections.defaultdict(list)
    for row in rows:
        verdict, reason = verdicts[row.sha256]
        if verdict == 'refused':
            kinds[kind_of(reason)].append(row)
    for kind, of_kind in sorted(kinds.items(), key=lambda entry: (-len(entry[1]), entry[0])):
        print(f'{len(of_kind):4} {kind[:100]:100} {of_kind[0].sha256[:12]}:{verdicts[of_kind[0].sha256][1].split(" ")[0]}')


def worse(rows, verdicts):
    """What is no longer as the table has it, and must be looked at."""
    for row in rows:
        verdict, reason = verdicts[row.sha256]
        name = f'{row.sha256[:12]} {row.repository} {os.path.basename(row.path)}'
        if row.verdict == 'pass' and verdict == 'refused' and row.expected == 'pass':
            yield f'{name}: passed before: {reason}'
        if row.expected == 'refused' and verdict == 'pass':
            yield f'{name}: must be refused, and passes'
        if verdict == 'refused' and not PLACED.match(reason) and reason != row.reason:
            yield f'{name}: no alarm with a place: {reason}'


def passing(rows, verdicts, expected):
    """(how many pass, how many there are) of the programs with this expectation."""
    wanted = [row for row in rows if row.expected == expected]
    return sum(verdicts[row.sha256][0] == 'pass' for row in wanted), len(wanted)


def arc_of(move):
    """(centre within the plane, direction, turns) of an arc; None of a line."""
    if not move.get('center'):
        return None
    centre = [value for axis, value in zip('XYZ', move['center']) if axis in move['plane']]
    return centre, move['cw'], move['turns']


def moves_of(text):
    """[(end in mm and deg, arc)] of lines of JSON, without lines that have no length."""
    moves, last = [], [0.0] * len('XYZABC')
    for move in map(json.loads, text.splitlines()):
        if move.get('end'):
            continue
        end = [move['mcs'].get(axis, 0.0) for axis in 'XYZABC']
        if move.get('center') or not same_end(end, last):
            moves.append((end, arc_of(move)))
        last = end
    return moves


def near(one, other):
    return all(abs(a - b) <= PLACE for a, b in zip(one, other))


def same_end(one, other):
    """A rotary axis may have made whole turns more."""
    turned = [(a - b + 180) % 360 - 180 for a, b in zip(one[3:], other[3:])]
    return near(one[:3], other[:3]) and near(turned, [0.0] * 3)


def same_move(one, other):
    if not same_end(one[0], other[0]) or (one[1] is None) != (other[1] is None):
        return False
    return one[1] is None or (near(one[1][0], other[1][0]) and one[1][1:] == other[1][1:])


def differs(ours, theirs):
    """The index of the first move that is another one, or None."""
    for index, (one, other) in enumerate(zip(ours, theirs)):
        if not same_move(one, other):
            return index
    return None if len(ours) == len(theirs) else min(len(ours), len(theirs))


def compare_paths(trunnion, rows, corpus, folders):
    """Paths against those of LinuxCNC's interpreter, where that reads the program too."""
    counts = collections.Counter()
    if run([PYTHON, PATHS, os.devnull])[0] not in (0, 1):
        print('LinuxCNC: skipped: the package linuxcnc-uspace is not installed')
        return
    for row in rows:
        ours = run(command_of(trunnion, row, corpus, folders, '--jsonl'), subprocess.DEVNULL)
        theirs = run([PYTHON, PATHS, row.file(corpus)], subprocess.DEVNULL)
        if ours[0] != 0 or theirs[0] != 0:
            counts['not read by both'] += 1
            continue
        one, other = moves_of(ours[1]), moves_of(theirs[1])
        at = differs(one, other)
        counts['the same path' if at is None else 'another path'] += 1
        if at is not None:
            print(f'{row.sha256[:12]} {row.repository} {os.path.basename(row.path)}: move {at + 1}: '
                  f'{one[at:at + 1]} here, {other[at:at + 1]} in LinuxCNC')
    print('LinuxCNC: ' + ', '.join(f'{number} {what}' for what, number in sorted(counts.items())))


def check(arguments, rows, corpus):
    programs = [row for row in rows if row.is_program() and arguments.only in row.sha256 + row.repository + row.path]
    absent = [row for row in programs if not os.path.exists(row.file(corpus))]
    if absent:
        sys.exit(f'corpus: {len(absent)} of {len(programs)} programs are not in {corpus}: tools/corpus.py --fetch')
    if not os.path.exists(arguments.trunnion):
        sys.exit(f'corpus: {arguments.trunnion} is not there: make product')
    with tempfile.TemporaryDirectory() as directory:
        folders = machines(arguments.trunnion, directory)
        if arguments.paths:
            compare_paths(arguments.trunnion, programs, corpus, folders)
            return True
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            judged = pool.map(lambda row: judge(arguments.trunnion, row, corpus, folders), programs)
            verdicts = {row.sha256: verdict for row, verdict in zip(programs, judged)}
    print_reasons(programs, verdicts)
    passed, wanted = passing(programs, verdicts, 'pass')
    print(f'{passed} of {wanted} programs pass that should: {100 * passed / max(wanted, 1):.1f} %')
    for expected, what in (('later', 'of {} for turning pass'), ('refused', 'of {} pass that are to be refused')):
        number, of_all = passing(programs, verdicts, expected)
        print(number, what.format(of_all))
    print(f"{sum(verdict == 'pass' for verdict, _ in verdicts.values())} of {len(programs)} programs pass altogether")
    bad = list(worse(programs, verdicts))
    print('\n'.join(bad), end='\n' if bad else '')
    if arguments.update:
        for row in programs:
            row['verdict'], row['reason'] = verdicts[row.sha256]
        write_table(rows)
        return True
    changed = sum((row.verdict, row.reason) != verdicts[row.sha256] for row in programs)
    if changed:
        print(f'{changed} verdicts or reasons are not those of the table: tools/corpus.py --update')
    few = passed < SHARE * wanted and not arguments.only
    if few:
        print(f'fewer than {100 * SHARE:.0f} % pass')
    return not bad and not few


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('trunnion', nargs='?', default='build/release/bin/trunnion')
    parser.add_argument('--fetch', action='store_true', help='download what is missing')
    parser.add_argument('--update', action='store_true', help='write the verdicts into the table')
    parser.add_argument('--paths', action='store_true', help="compare the paths with those of LinuxCNC's interpreter")
    parser.add_argument('--only', default='', metavar='TEXT', help='programs with this in hash, repository or path')
    parser.add_argument('--jobs', type=int, default=1, help='programs at once')
    arguments = parser.parse_args()
    corpus = os.environ.get('CORPUS', '')
    if arguments.fetch:
        if corpus == '':
            sys.exit('corpus: CORPUS must name the directory to download to')
        return 0 if fetch(read_table(), corpus) else 1
    if not os.path.isdir(corpus):
        print('corpus: skipped: CORPUS names no directory with the programs; they are not a part of this repository')
        return 0
    return 0 if check(arguments, read_table(), corpus) else 1


if __name__ == '__main__':
    sys.exit(main())
