#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""clang-format over every C++ file, and the chosen clang-tidy checks over every source that is built into a program.

    tools/lint.py BUILD [FILE...]    of the named files only, with those that are compiled together with them

--within SECONDS begins no further file after that time: the sources that were changed last come first, and the last
line says how many were not read. What is clean is remembered by its content (tools/memory.py) once it is compiled in
BUILD, and not read again; TRUNNION_FORGET=1 reads all.

Any finding is an error. clang-tidy excludes tests, benchmarks and fuzzers: they include the test framework and would
nearly double the time. Sources that are compiled together (CMake's unity build) are checked together, so that the
headers are read once: their texts stand behind each other in one file, because clang-tidy looks less closely at a file
that is included. Without the precompiled headers of GCC, so a source that
relies on them for what it uses is found here.
"""
import argparse
import concurrent.futures
import itertools
import json
import os
import re
import subprocess
import sys
import time

from memory import Build, Memory

EXCLUDED = re.compile(r'(^|/)(test|bench|integration_tests)/')
NOISE = re.compile(r'warnings? generated|Suppressed|Use -header-filter|Use -system-headers')


def tracked(*patterns):
    return subprocess.run(['git', 'ls-files', *patterns], check=True, capture_output=True, text=True).stdout.split()


def sources_of(unit):
    """The sources of a unity build's file; none for an ordinary source."""
    if '/Unity/unity_' not in unit:
        return []
    with open(unit) as text:
        return re.findall(r'#include "(.*)"', text.read())


def joined(sources):
    """The texts behind each other, and [(first line, source)]."""
    text, starts, line = '', [], 1
    for source in sources:
        with open(source) as file:
            part = file.read() + '\n'
        starts.append((line, source))
        text, line = text + part, line + part.count('\n')
    return text, starts


def place(starts, line):
    """file:line of a line of the joined texts."""
    first, source = max(start for start in starts if start[0] <= line)
    return f'{os.path.relpath(source)}:{line - first + 1}'


def repeated_includes(files):
    """file:line of what is included a second time."""
    found = []
    for file in files:
        seen = set()
        with open(file) as text:
            for number, line in enumerate(text, 1):
                if line.startswith('#if'):
                    break  # what is included depends on a condition
                if line.startswith('#include') and line in seen:
                    found.append(f'{file}:{number}: error: included twice: {line.split()[1]}')
                seen.add(line)
    return found


def commands(build, wanted):
    """What holds the wanted sources (paths from the root): its folder with a compilation database, {file: starts},
    {file: the object that the build makes of it}."""
    chosen, objects, database = {}, {}, []
    with open(f'{build}/compile_commands.json') as text:
        entries = json.load(text)
    folder = os.path.abspath(f'{build}/lint')
    os.makedirs(folder, exist_ok=True)
    left = set(wanted)
    for entry in entries:
        unit = entry['file']
        # What the build generates is not ours to write, and may not be there yet.
        sources = [source for source in sources_of(unit) if not source.startswith(os.path.abspath(build) + '/')]
        held = {os.path.relpath(source) for source in sources or [unit]}
        if not held & left:
            continue
        left -= held
        command = re.sub(r' -Winvalid-pch| -include \S*cmake_pch\.hxx', '', entry['command'])
        if sources:
            file = f'{folder}/{os.path.relpath(unit, build).replace("/", "-")}.cpp'
            content, starts = joined(sources)
            with open(file, 'w') as text:
                text.write(content)
            quoted = ' '.join(f'-iquote {d}' for d in sorted({os.path.dirname(s) for s in sources}))
            command = command.replace(unit, f'{file} {quoted}')
        else:
            file, starts = unit, [(1, unit)]
        chosen[file] = starts
        objects[file] = re.search(r' -o (\S+)', entry['command']).group(1)
        database.append({'directory': entry['directory'], 'file': file, 'command': command})
    if left:
        sys.exit(f'lint: not compiled by {build}: {", ".join(sorted(left))}')
    with open(f'{folder}/compile_commands.json', 'w') as text:
        json.dump(database, text)
    return folder, chosen, objects


def tidy(folder, file, starts):
    done = subprocess.run(['clang-tidy-14', '-p', folder, '--quiet', file], capture_output=True, text=True)
    errors = '\n'.join(line for line in done.stderr.splitlines() if not NOISE.search(line))
    text = re.sub(re.escape(file) + r':(\d+)', lambda m: place(starts, int(m.group(1))), done.stdout + errors)
    return done.returncode, text.strip()


class Clean:
    """What was found clean."""

    def __init__(self, build, objects):
        self.build, self.objects, self.memory, self.known = Build(build), objects, Memory('lint'), 0
        self.rules = [self.build.content(os.path.realpath(file)) for file in ('.clang-tidy', __file__)]

    def key(self, file):
        """None when it is not known what the file includes."""
        compiled = self.build.compiled(self.objects[file])
        if compiled is None:
            return None
        return self.build.digest(self.build.tools, *self.rules, self.build.command(self.objects[file]), compiled)

    def has(self, file):
        key = self.key(file)
        found = key is not None and self.memory.has(key)
        self.known += found
        return found

    def add(self, file):
        if (key := self.key(file)) is not None:
            self.memory.add(key, file)


def newest_first(files):
    """The files of commands(), those first of which a source was changed last."""
    log = subprocess.run(['git', 'log', '--format=', '--name-only'], check=True, capture_output=True, text=True).stdout
    age = {}
    for name in log.split():
        age.setdefault(name, len(age))

    def newest(file):
        return min(age.get(os.path.relpath(source), len(age)) for _, source in files[file])

    return sorted(files, key=newest)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('build')
    parser.add_argument('files', nargs='*')
    parser.add_argument('--within', type=float, metavar='SECONDS')
    given = parser.parse_args()
    end = time.monotonic() + given.within if given.within is not None else float('inf')
    build, wanted = given.build, [os.path.relpath(file) for file in given.files]
    whole = not wanted
    if whole:
        format_check = ['clang-format-14', '--dry-run', '--Werror', *tracked('*.cpp', '*.hpp')]
        if subprocess.run(format_check).returncode != 0:
            sys.exit('lint: the layout differs, see above; `make format` mends it')
        wanted = [file for file in tracked('*.cpp') if not EXCLUDED.search(file)]
    repeated = repeated_includes([*wanted, *(f for f in tracked('*.hpp') if whole)])
    print('\n'.join(repeated), end='\n' if repeated else '', flush=True)
    folder, files, objects = commands(build, wanted)
    failed, unread = bool(repeated), itertools.count()
    clean = Clean(build, objects)
    ahead = [file for file in newest_first(files) if not clean.has(file)]

    def read(file):
        if time.monotonic() >= end:
            next(unread)
            return 0, ''
        code, text = tidy(folder, file, files[file])
        if code == 0 and not text:
            clean.add(file)
        return code, text

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for done, (code, text) in enumerate(pool.map(read, ahead), 1):
            failed |= code != 0
            if text:
                print(text, flush=True)
            if sys.stdout.isatty():
                print(f'[{done}/{len(ahead)}]', end='\r', flush=True)
    if failed:
        sys.exit('lint: findings, see above')
    left = next(unread)
    if left and left == len(ahead):
        sys.exit(f'lint: nothing was read within {given.within:.0f} s')
    if left:
        print(f'lint: clean as far as it was read: {left} of {len(files)} files were not, after {given.within:.0f} s')
    else:
        print(f'lint: {len(files)} files clean, {clean.known} of them remembered')


if __name__ == '__main__':
    main()
