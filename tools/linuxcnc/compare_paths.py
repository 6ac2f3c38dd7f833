#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the paths that LinuxCNC's interpreter and `trunnion check` make of the same programs of LinuxCNC.

    LINUXCNC=DIR tools/linuxcnc/compare_paths.py TRUNNION [FILE ...]    DIR has LinuxCNC's sources

Without files: the programs of LinuxCNC's own tests (tests/interp), with --examples those of nc_files, too. Neither is a part of
this repository, nor is rs274, LinuxCNC's interpreter (Debian package linuxcnc-uspace; RS274 names another one). Without LINUXCNC
nothing is compared, and the reason is printed.

Both begin at 0 with empty tables, but for the tool table beside the program. Machine coordinates are compared, which rs274 does
not print: its offsets, shift, rotation and tool length are added as its motion controller adds them. Moves without a way are
left out. Programs agree when they make the same moves, or when both refuse the program behind the same moves. It fails when the
share of those that agree is below --least.
"""
import argparse
import collections
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile

INCH = 25.4
TOLERANCE = 0.004  # mm: rs274 prints four decimals, of inches too
MOST_LINES = 400000
SECONDS = 5
NO_END = 'ended with no percent sign'  # in messages of rs274
Move = collections.namedtuple('Move', 'kind end centre plane turns')
Path = collections.namedtuple('Path', 'moves error endless')
CALL = re.compile(r'^\s*\d+\s+N\S*\s+(\w+)\((.*)\)\s*$')
PLANES = {'XY': (0, 1, 2), 'YZ': (1, 2, 0), 'ZX': (2, 0, 1)}
UNKNOWN = 'unknown'  # a curve, of which rs274 prints neither way nor end

PARAMETERS = '''"040000": MILL
"040001": 0
"040002": 1
"040003": 2
"040004": 3
"040005": 4
"040006": 5
"040959": 2
"040944": 3 4 5 19; 6; 7 8 9
''' + ''.join(f'"{100 + i}000": {name}\n' + (f'"{100 + i}001": 3\n' if name in 'ABC' else '')
             for i, name in enumerate('XYZABC')) + '''"106000": S
"106001": 10
"106035": 60000
"106036": 60000
'''


def numbers(text):
    return [float(number) for number in re.findall(r'-?\d+\.?\d*(?:e-?\d+)?', text)]


class Canonical:
    """Follows the canonical commands that rs274 prints, in machine coordinates and mm."""

    def __init__(self):
        self.unit = 1.0
        self.offset, self.shift, self.length = [0.0] * 6, [0.0] * 6, [0.0] * 6
        self.angle = 0.0
        self.plane = 'XY'
        self.at = [0.0] * 6
        self.moves = []

    def scaled(self, values):
        return [value * (self.unit if axis < 3 else 1) for axis, value in enumerate((values + [0.0] * 6)[:6])]

    def machine(self, point):
        x, y = point[0] + self.shift[0], point[1] + self.shift[1]
        c, s = math.cos(self.angle), math.sin(self.angle)
        turned = [c * x - s * y, s * x + c * y] + [point[i] + self.shift[i] for i in range(2, 6)]
        return [turned[i] + self.offset[i] + self.length[i] for i in range(6)]

    def go(self, kind, end, centre=None, turns=0):
        moved = any(abs(a - b) > TOLERANCE for a, b in zip(self.at, end))
        if moved or centre is not None:
            self.moves.append(Move(kind, end, centre, self.plane if centre else None, turns))
        self.at = end

    def straight(self, kind, values):
        self.go(kind, self.machine(self.scaled(values)))

    def arc(self, values):
        first, second, normal = PLANES[self.plane]
        point = [0.0] * 6
        point[first], point[second], point[normal] = values[0], values[1], values[5]
        point[3:] = values[6:9]
        centre = list(point)
        centre[first], centre[second] = values[2], values[3]
        end = self.machine(self.scaled(point))
        self.go('cw' if values[4] < 0 else 'ccw', end, self.machine(self.scaled(centre))[:3], abs(int(values[4])))

    def command(self, name, text):
        values = numbers(text)
        if name == 'USE_LENGTH_UNITS':
            self.unit = INCH if 'INCH' in text else 1.0
        elif name == 'SET_G5X_OFFSET':
            self.offset = self.scaled(values[1:])
        elif name == 'SET_G92_OFFSET':
            self.shift = self.scaled(values)
        elif name == 'SET_XY_ROTATION':
            self.angle = math.radians(values[0])
        elif name == 'USE_TOOL_LENGTH_OFFSET':
            self.length = self.scaled(values)
        elif name == 'SELECT_PLANE':
            self.plane = {'XY': 'XY', 'YZ': 'YZ', 'XZ': 'ZX'}[text.rsplit('_', 1)[1]]
        elif name == 'STRAIGHT_TRAVERSE':
            self.straight('rapid', values)
        elif name in ('STRAIGHT_FEED', 'STRAIGHT_PROBE'):
            self.straight('line', values)
        elif name == 'RIGID_TAP':
            start = list(self.at)
            end = self.machine(self.scaled(values[:3]))
            self.go('line', end[:3] + start[3:])
            self.go('line', start)
        elif name == 'ARC_FEED':
            self.arc(values)
        elif name.startswith('NURBS'):
            self.moves.append(Move(UNKNOWN, None, None, None, 0))


def output_of(command, folder):
    """Standard output, error output and whether it ended by itself within the time."""
    with tempfile.TemporaryFile('w+') as out, tempfile.TemporaryFile('w+') as err:
        process = subprocess.Popen(command, cwd=folder, stdout=out, stderr=err, stdin=subprocess.DEVNULL)
        try:
            process.wait(SECONDS)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            return '', '', None
        out.seek(0)
        err.seek(0)
        return out.read(), err.read(), process.returncode


def path_of_rs274(rs274, folder, program):
    command = [rs274, '-g']
    if os.path.exists(os.path.join(folder, 'test.tbl')):
        command += ['-t', 'test.tbl']
    if os.path.exists(os.path.join(folder, 'test.ini')):
        command += ['-i', 'test.ini']
    out, err, code = output_of(command + [program], folder)
    if code is None or out.count('\n') > MOST_LINES:
        return Path([], None, True)
    canonical = Canonical()
    for line in out.splitlines():
        call = CALL.match(line)
        if call:
            canonical.command(call[1], call[2])
    words = [line for line in err.splitlines() if line.strip() and line.strip() != 'executing']
    # It finds this behind the last move; here the text may end a program.
    if code == 0 or NO_END in err:
        return Path(canonical.moves, None, False)
    return Path(canonical.moves, words[-2] if len(words) > 1 else 'refused', False)


def moves_of_check(text):
    moves, error, at = [], None, [0.0] * 6
    for line in text.splitlines():
        row = json.loads(line)
        if 'error' in row:
            error = row['error']
        if 'kind' not in row:
            continue
        end = [row['mcs'].get(axis, 0.0) for axis in 'XYZABC']
        if row['kind'] == 'arc':
            kind, plane = ('cw' if row['cw'] else 'ccw'), row['plane']
            moves.append(Move(kind, end, row['center'], plane, row['turns']))
        elif any(abs(a - b) > TOLERANCE for a, b in zip(at, end)):
            moves.append(Move(row['kind'], end, None, None, 0))
        at = end
    return moves, error


def path_of_trunnion(trunnion, machine, folder, program):
    out, err, code = output_of([trunnion, 'check', '--machine', machine, '--jsonl', os.path.join(folder, program)],
                               folder)
    if code is None:
        return Path([], None, True)
    moves, error = moves_of_check(out)
    if code != 0 and error is None:
        error = {'number': 0, 'line': 0, 'text': err.strip() or f'exit code {code}'}
    return Path(moves, error, False)


def same(a, b):
    if a.kind != b.kind or any(abs(x - y) > TOLERANCE for x, y in zip(a.end, b.end)):
        return False
    if a.centre is None:
        return True
    first, second, _ = PLANES[a.plane]
    centres = all(abs(a.centre[axis] - b.centre[axis]) <= TOLERANCE for axis in (first, second))
    return a.plane == b.plane and centres and a.turns == b.turns


def ends_curve(next_move, ours):
    return any(move.kind != UNKNOWN and same(move, ours) for move in next_move)


def first_difference(theirs, ours):
    """Indexes of the first moves that differ; behind a curve any number of lines."""
    i = k = 0
    while i < len(theirs):
        if theirs[i].kind == UNKNOWN:
            i += 1
            while k < len(ours) and ours[k].kind == 'line' and not ends_curve(theirs[i:i + 1], ours[k]):
                k += 1
            continue
        if k == len(ours) or not same(theirs[i], ours[k]):
            return i, k
        i += 1
        k += 1
    return None if k == len(ours) else (i, k)


def shown(moves, index):
    if index >= len(moves):
        return 'nothing'
    move = moves[index]
    place = '' if move.end is None else ' '.join(f'{letter}{value:.4f}' for letter, value in zip('XYZABC', move.end)
                                                if abs(value) > TOLERANCE)
    return f'{move.kind} {place}'.strip() + (f' turns {move.turns}' if move.centre else '')


def compare(theirs, ours):
    """What a program is counted as, and why."""
    if theirs.endless or ours.endless:
        both = theirs.endless and ours.endless
        return 'left out', 'does not end' + ('' if both else ' in one of the two')
    difference = first_difference(theirs.moves, ours.moves)
    refusal = ours.error and f"{ours.error['number']} in line {ours.error['line']}: {ours.error['text']}"
    if theirs.error is not None and ours.error is not None:
        # How far each of them went before it found the fault does not matter, but both went the same way.
        shorter = min(len(theirs.moves), len(ours.moves))
        if difference is None or min(difference) >= shorter:
            return 'both refuse', f'{theirs.error} / {refusal}'
    if ours.error is not None and (difference is None or difference[1] == len(ours.moves)):
        return 'refused here', refusal
    if difference is not None:
        i, k = difference
        return 'differs', f'move {k + 1}: {shown(theirs.moves, i)} / {shown(ours.moves, k)}'
    return ('agrees', '') if theirs.error is None else ('refused there', theirs.error)


def tool_table(text, scale):
    """The rows of tools.yaml; rs274 takes the lengths of its table in the unit of the program."""
    rows = []
    for line in text.splitlines():
        words = dict(re.findall(r'([A-Za-z])\s*([-+]?\d+\.?\d*|[-+]?\.\d+)', line.split(';')[0]))
        words = {letter.upper(): float(value) for letter, value in words.items()}
        if words.get('T', 0) > 0:
            rows.append(f"- {{number: {int(words['T'])}, length: {words.get('Z', 0) * scale:.6f}, "
                        f"radius: {words.get('D', 0) * scale / 2:.6f}}}")
    return '\n'.join(rows) + '\n' if rows else '[]\n'


def make_machine(trunnion, folder):
    subprocess.run([trunnion, 'new', 'machine', 'linuxcnc-paths', '--from', 'four-axis'], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL)
    machine = os.path.join(folder, 'linuxcnc-paths')
    for name in ('bodies.yaml', 'work_offsets.yaml'):
        if os.path.exists(os.path.join(machine, name)):
            os.remove(os.path.join(machine, name))
    with open(os.path.join(machine, 'parameters.yaml'), 'w') as file:
        file.write(PARAMETERS)
    return machine


def prepare(source, machine, temporary):
    """A copy of the program's folder, and the tools of the machine for it."""
    folder = os.path.join(temporary, 'program')
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(os.path.dirname(source), folder, ignore_dangling_symlinks=True)
    subs = os.path.join(folder, 'subs')
    for name in os.listdir(subs) if os.path.isdir(subs) else []:
        if name.endswith('.ngc') and not os.path.exists(os.path.join(folder, name)):
            shutil.copy(os.path.join(subs, name), folder)
    with open(source, encoding='latin-1') as file:
        inches = re.search(r'(?im)^[^(;]*\bg\s*20(?!\d)', file.read()) is not None
    table = os.path.join(folder, 'test.tbl')
    text = open(table, encoding='latin-1').read() if os.path.exists(table) else ''
    with open(os.path.join(machine, 'tools.yaml'), 'w') as file:
        file.write(tool_table(text, INCH if inches else 1.0))
    return folder


def programs_below(folder):
    for at, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if name != 'subs')
        for name in sorted(files):
            if name.endswith('.ngc'):
                yield os.path.join(at, name)


def needs_python(program):
    folder = os.path.dirname(program)
    return any(name.endswith('.py') for name in os.listdir(folder)) or os.path.exists(os.path.join(folder, 'skip'))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n', 1)[0])
    parser.add_argument('trunnion')
    parser.add_argument('files', nargs='*')
    parser.add_argument('--examples', action='store_true', help='those of nc_files, too')
    parser.add_argument('--least', type=float, default=0, help='share that must agree, percent')
    options = parser.parse_args()
    sources, rs274 = os.environ.get('LINUXCNC', ''), os.environ.get('RS274', 'rs274')
    if not sources and not options.files:
        print('LINUXCNC names no folder with the sources of LinuxCNC: nothing is compared')
        return 0
    if shutil.which(rs274) is None:
        print(f'{rs274} is not installed (Debian package linuxcnc-uspace): nothing is compared')
        return 0
    programs = [os.path.abspath(name) for name in options.files]
    if not programs:
        for part in ['tests/interp'] + (['nc_files'] if options.examples else []):
            programs += programs_below(os.path.join(sources, part))
    if not programs:
        sys.exit(f'{sources}: no programs below tests/interp')
    count = collections.Counter()
    with tempfile.TemporaryDirectory() as temporary:
        machine = make_machine(os.path.abspath(options.trunnion), temporary)
        for program in programs:
            if needs_python(program):
                verdict, why = 'left out', 'needs Python, or its own test leaves it out'
            else:
                folder, name = prepare(program, machine, temporary), os.path.basename(program)
                theirs = path_of_rs274(rs274, folder, name)
                ours = path_of_trunnion(os.path.abspath(options.trunnion), machine, folder, name)
                verdict, why = compare(theirs, ours)
            count[verdict] += 1
            if verdict != 'agrees':
                print(f'{os.path.relpath(program, sources or ".")}: {verdict}: {why}')
    compared = sum(count.values()) - count['left out']
    agree = count['agrees'] + count['both refuse']
    share = 100 * agree / compared if compared else 0
    print(', '.join(f'{verdict} {count[verdict]}' for verdict in sorted(count)))
    print(f'{agree} of {compared} programs agree: {share:.1f} %')
    return 0 if share >= options.least else 1


if __name__ == '__main__':
    sys.exit(main())
