#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes contract.h: the names of the topics and of their types on the wire, for a service in C.

The name of a type on the wire ends with its hash, so it is taken from what the build has generated for C++.
"""
import re, sys

text = open(sys.argv[1]).read()
lines = ["/* Generated from idl/. */", "#ifndef CONTRACT_H", "#define CONTRACT_H",
         f'#define TRUNNION_CONTRACT "{re.search(r"contract_hash = .(.+?).;", text).group(1)}"',
         f'#define TRUNNION_STANDBY_SUFFIX "{re.search(r"standby_suffix = .(.+?).;", text).group(1)}"']
for handle, topic, wire_type in re.findall(r'Topic<[^>]+> (\w+)\{"([^"]+)", "([^"]+)"', text):
    lines += [f'#define TRUNNION_TOPIC_{handle.upper()} "{topic}"', f'#define TRUNNION_TYPE_{handle.upper()} "{wire_type}"']
with open(sys.argv[2], "w") as out: out.write("\n".join(lines + ["#endif"]) + "\n")
