#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shows that a source that links one library finds the headers of what it links, and of nothing else.

refused_include.py COMPILER DIRECTORIES ALLOWED REFUSED: DIRECTORIES are the include directories of the library, with ; between
them; ALLOWED and REFUSED are headers as a source includes them.
"""
import re, subprocess, sys


def compile_include(compiler, directories, header):
    command = [compiler, "-std=c++20", "-fsyntax-only", "-x", "c++", "-"] + [f"-I{d}" for d in directories if d]
    return subprocess.run(command, input=f'#include "{header}"\n', text=True, capture_output=True)


if __name__ == "__main__":
    compiler, directories, allowed, refused = sys.argv[1], sys.argv[2].split(";"), sys.argv[3], sys.argv[4]
    found = compile_include(compiler, directories, allowed)
    if found.returncode != 0: sys.exit(f"{allowed} does not compile:\n{found.stderr}")
    hidden = compile_include(compiler, directories, refused)
    if hidden.returncode == 0 or not re.search(f"{re.escape(refused)}.*(No such file|file not found)", hidden.stderr): sys.exit(f"{refused} is found:\n{hidden.stderr}")
