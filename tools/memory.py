# SPDX-License-Identifier: Apache-2.0
"""What was checked and found good, remembered by its content in the user's cache directory, so that it is not checked again
in any clone on this computer. tools/lint.py and tools/run_tests.py use it.

What a build compiles is known from Ninja: the sources of a target, the headers that its compilations read, the commands.
Paths below the checkout count as relative ones, so that another clone with the same content has the same keys.
"""
import functools
import hashlib
import os
import re
import subprocess
import time

DAYS = 30  # an entry that was not asked for for so long is dropped


class Memory:
    """The keys of one kind of check that were found good."""

    def __init__(self, kind):
        cache = os.environ.get('XDG_CACHE_HOME') or os.path.expanduser('~/.cache')
        self.folder = os.path.join(cache, 'trunnion', 'checked', kind)
        self.use = os.environ.get('TRUNNION_FORGET', '') == ''
        os.makedirs(self.folder, exist_ok=True)
        oldest = time.time() - DAYS * 86400
        for entry in os.scandir(self.folder):
            if entry.stat().st_mtime < oldest:
                os.unlink(entry.path)

    def has(self, key):
        path = os.path.join(self.folder, key)
        if not self.use or not os.path.exists(path):
            return False
        os.utime(path)
        return True

    def add(self, key, what):
        with open(os.path.join(self.folder, key), 'w') as file:
            file.write(what + '\n')


def run(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


class Build:
    """A Ninja build directory: the content of what is compiled in it."""

    def __init__(self, directory):
        self.directory = os.path.realpath(directory)
        self.root = os.path.realpath(run('git', 'rev-parse', '--show-toplevel').strip())
        self.tools = self._tools()
        self._dependencies = self._all_dependencies()

    @staticmethod
    def _tools():
        """Versions of all packages with compilers, headers and libraries: they decide what is compiled, too."""
        try:
            packages = run('dpkg-query', '-W', '-f', '${Package} ${Version}\n')
        except (OSError, subprocess.CalledProcessError):
            packages = ''
        kept = [line for line in packages.splitlines()
                if re.match(r'(lib|gcc|g\+\+|clang|cpp|binutils|mold|llvm|cyclonedds|python3 )', line)]
        return '\n'.join(kept) or run('c++', '--version')

    def _all_dependencies(self):
        """{object: files that its compilation read}; without those of an object that is older than one of them."""
        result, name = {}, None
        for line in run('ninja', '-C', self.directory, '--quiet', '-t', 'deps').splitlines():
            if line.startswith('    '):
                result[name].append(line[4:])
            elif ': #deps' in line:
                name = line.split(':')[0]
                result[name] = []
        return result

    def path(self, name):
        return os.path.realpath(os.path.join(self.directory, name))

    def relative(self, text):
        return text.replace(self.directory, '<build>').replace(self.root, '<root>')

    @functools.lru_cache(maxsize=None)
    def content(self, path):
        """Hash of a file, or of all files below a folder; paths of this clone in generated files do not count."""
        if os.path.isdir(path):
            names = sorted(os.path.join(at, file) for at, _, files in os.walk(path) for file in files)
            if path.startswith(self.root) and not path.startswith(self.directory):
                tracked = run('git', 'ls-files', '-co', '--exclude-standard', path, cwd=self.root).splitlines()
                names = sorted(os.path.join(self.root, name) for name in tracked)
            return self.digest(*(f'{self.relative(name)} {self.content(os.path.realpath(name))}' for name in names))
        if not os.path.isfile(path):
            return 'missing'
        with open(path, 'rb') as file:
            data = file.read()
        if path.startswith(self.directory):
            data = data.replace(self.directory.encode(), b'<build>').replace(self.root.encode(), b'<root>')
        return hashlib.sha256(data).hexdigest()

    @staticmethod
    def digest(*texts):
        return hashlib.sha256('\0'.join(texts).encode()).hexdigest()

    @functools.lru_cache(maxsize=None)
    def compiled(self, name):
        """What went into an object: text with a line for each file, or None when it is not built or out of date."""
        files = self._dependencies.get(name)
        built = self.path(name)
        if not files or not os.path.exists(built):
            return None
        age = os.path.getmtime(built)
        lines = []
        for file in files:
            path = self.path(file)
            if not path.startswith(self.root):
                continue  # of a package, whose version counts
            if path.endswith('.gch'):
                continue  # its headers are those of packages
            # The text of a generated source counts, not its time.
            if not path.startswith(self.directory) and os.path.getmtime(path) > age:
                return None
            lines.append(f'{self.relative(path)} {self.content(path)}')
        return '\n'.join(sorted(set(lines)))

    @functools.lru_cache(maxsize=None)
    def command(self, name):
        return self.relative(run('ninja', '-C', self.directory, '--quiet', '-t', 'commands', '-s', name))

    def linked(self, program):
        """What went into a program of the build directory, as compiled()."""
        name = os.path.relpath(program, self.directory)
        texts = [self.command(name)]
        for made in run('ninja', '-C', self.directory, '--quiet', '-t', 'inputs', name).splitlines():
            if not made.endswith('.o'):
                continue
            text = self.compiled(made)
            if text is None:
                return None
            texts += [made, text, self.command(made)]
        return self.digest(*texts)
