#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""ctest without what has passed before with the same content.

    tools/run_tests.py BUILD KIND [CTEST OPTIONS...]

A test is remembered under KIND (sanitize, threads, fuzz, unit) when its program is built in BUILD: by the sources and headers of
the program, their commands, the versions of the packages, and the files and folders that its command and its compile
definitions name. Every other test runs each time. TRUNNION_FORGET=1 runs all. The last line says how many ran.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

from memory import Build, Memory, run


class Tests:
    def __init__(self, directory):
        self.build = Build(directory)
        definitions = {}
        with open(os.path.join(directory, 'compile_commands.json')) as text:
            for entry in json.load(text):
                # CMake says which source a command compiles; the object is the argument of -o.
                made = re.search(r' -o (\S+)', entry['command'])
                definitions[made.group(1)] = re.findall(r'-D\w+=\\+"(/[^"\\]*)', entry['command'])
        self.definitions = definitions

    def named(self, test):
        """The paths that the test is given, without its program."""
        words = test['command'][1:]
        for entry in test['properties']:
            if entry['name'] == 'ENVIRONMENT':
                words += [value.split('=', 1)[1] for value in entry['value']]
        name = os.path.relpath(test['command'][0], self.build.directory)
        for made in run('ninja', '-C', self.build.directory, '--quiet', '-t', 'inputs', name).splitlines():
            words += self.definitions.get(made, [])
        return sorted({word for word in words if word.startswith('/')})

    def key(self, test):
        """None when the test cannot be remembered."""
        if not test.get('command') or not test['command'][0].startswith(self.build.directory + '/'):
            return None
        texts = [self.build.tools, self.build.relative(json.dumps([test['command'], test['properties']], sort_keys=True))]
        programs = [test['command'][0]]
        for path in self.named(test):
            if path.startswith(self.build.directory + '/bin/'):
                programs.append(path)
            elif not path.startswith(self.build.directory + '/corpus-'):  # what a fuzzer has found
                texts += [self.build.relative(path), self.build.content(os.path.realpath(path))]
        for program in programs:
            text = self.build.linked(program)
            if text is None:
                return None
            texts.append(text)
        return self.build.digest(*texts)


def passed(report):
    return {case.get('name') for case in xml.etree.ElementTree.parse(report).iter('testcase') if case.get('status') == 'run'}


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    directory, kind, options = os.path.realpath(sys.argv[1]), sys.argv[2], sys.argv[3:]
    described = json.loads(run('ctest', '--test-dir', directory, '--show-only=json-v1', *options))
    memory, tests = Memory(kind), Tests(directory)
    wanted = [test for test in described['tests'] if 'command' in test]
    if not wanted:
        sys.exit(f'{kind}: no test is chosen')
    keys = {test['name']: tests.key(test) for test in wanted}
    left = [name for name, key in keys.items() if key is None or not memory.has(key)]
    if not left:
        print(f'{kind}: {len(wanted)} tests passed, all of them remembered')
        return 0
    with tempfile.NamedTemporaryFile(suffix='.xml') as report:
        chosen = '^(' + '|'.join(re.escape(name) for name in left) + ')$'
        done = subprocess.run(['ctest', '--test-dir', directory, '--output-on-failure', '-j', str(os.cpu_count()), *options,
                               '-R', chosen, '--output-junit', report.name])
        for name in passed(report.name) & set(left):
            if keys[name] is not None:
                memory.add(keys[name], f'{name} of {directory}')
    if done.returncode == 0:
        print(f'{kind}: {len(wanted)} tests passed, {len(wanted) - len(left)} of them remembered')
    return done.returncode


if __name__ == '__main__':
    sys.exit(main())
