#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Turns idl/*.idl and idl/topics.yaml into C++ types, topic handles, recording schemas and the documentation table.

The IDL subset is what the contracts use: modules, @final structs, enums, primitive types, bounded strings and
sequences, @key, and @min(N) and @max(N) for integers, which readers check. Anything
else is an error with file:line, so that a type never means less than it says.
"""
import argparse, hashlib, os, re, sys
import yaml

PRIMITIVES = {  # IDL name -> (C++ type, size in bytes)
    "boolean": ("bool", 1), "octet": ("std::uint8_t", 1), "uint8": ("std::uint8_t", 1), "int8": ("std::int8_t", 1),
    "uint16": ("std::uint16_t", 2), "int16": ("std::int16_t", 2), "uint32": ("std::uint32_t", 4),
    "int32": ("std::int32_t", 4), "uint64": ("std::uint64_t", 8), "int64": ("std::int64_t", 8),
    "float": ("float", 4), "double": ("double", 8)}
TOKEN = re.compile(r"\s*(?:(//[^\n]*)|(@\w+)|([A-Za-z_]\w*)|(-?\d+)|([{}<>;,()]))")


class Type:
    def __init__(self, base, bound=0, element=None):
        self.base, self.bound, self.element = base, bound, element
        self.limits = {}  # "min" and "max" of the value

    def idl(self):
        if self.base == "string": return f"string<{self.bound}>" if self.bound else "string"
        if self.base == "sequence": return f"sequence<{self.element.idl()}, {self.bound}>" if self.bound else f"sequence<{self.element.idl()}>"
        return self.base

    def cpp(self, scope):
        if self.base == "string": return "std::string"
        if self.base == "sequence": return f"std::vector<{self.element.cpp(scope)}>"
        return PRIMITIVES[self.base][0] if self.base in PRIMITIVES else scope.lookup(self.base)

    def user(self):
        if self.base == "sequence": return self.element.user()
        return None if self.base in PRIMITIVES or self.base == "string" else self.base


class Struct:
    def __init__(self, name, module): self.name, self.module, self.fields = name, module, []


class Enum:
    def __init__(self, name, module): self.name, self.module, self.values = name, module, []


class Parser:
    def __init__(self, path):
        self.path, self.types = path, []
        self.tokens, self.comments = [], {}
        with open(path) as f: text = f.read()
        at, line = 0, 1
        while at < len(text):
            m = TOKEN.match(text, at)
            if not m:
                if text[at:].strip() == "": break
                self.fail(text[:at].count("\n") + 1, f"cannot read '{text[at:].split()[0]}'")
            start = m.start(m.lastindex)
            line = text.count("\n", 0, start) + 1
            if m.group(1): self.comments[line] = m.group(1)[2:].strip()
            else: self.tokens.append((m.group(m.lastindex), line))
            at = m.end()
        self.pos = 0

    def fail(self, line, text): sys.exit(f"{self.path}:{line}: error: {text}")
    def peek(self): return self.tokens[self.pos][0] if self.pos < len(self.tokens) else None
    def line(self): return self.tokens[min(self.pos, len(self.tokens) - 1)][1]

    def take(self, want=None):
        token = self.peek()
        if token is None or (want and token != want): self.fail(self.line(), f"expected '{want}', found '{token}'")
        self.pos += 1
        return token

    def parse(self):
        self.take("module"); outer = self.take(); self.take("{")
        self.take("module"); self.module = f"{outer}::{self.take()}"; self.take("{")
        while self.peek() != "}": self.declaration()
        for token in ("}", ";", "}", ";"): self.take(token)
        return self.types

    def declaration(self):
        annotations = []
        while self.peek().startswith("@"): annotations.append(self.take())
        kind = self.take()
        if kind == "enum":
            e = Enum(self.take(), self.module); self.take("{")
            while True:
                e.values.append(self.take())
                if self.take() == "}": break
            self.take(";"); self.types.append(e)
        elif kind == "struct":
            if "@final" not in annotations: self.fail(self.line(), "a struct must be @final")
            s = Struct(self.take(), self.module); self.take("{")
            while self.peek() != "}":
                key, limits = False, {}
                while self.peek().startswith("@"):
                    annotation = self.take()
                    if annotation == "@key": key = True
                    elif annotation in ("@min", "@max"):
                        self.take("("); limits[annotation[1:]] = int(self.take()); self.take(")")
                    else: self.fail(self.line(), f"unknown annotation {annotation}")
                t = self.type(); line = self.line(); name = self.take(); self.take(";")
                t.limits = limits
                if limits and not re.fullmatch(r"octet|u?int\d+", t.base): self.fail(line, "@min and @max are for integers")
                if key and t.base in ("string", "sequence"): self.fail(line, "a key must be a primitive or an enum")
                s.fields.append((name, t, key, self.comments.get(line, "")))
            self.take("}"); self.take(";"); self.types.append(s)
        else: self.fail(self.line(), f"expected struct or enum, found '{kind}'")

    def type(self):
        base = self.take()
        if base == "string":
            if self.peek() != "<": self.fail(self.line(), "a string must be bounded")
            self.take("<"); bound = int(self.take()); self.take(">")
            return Type("string", bound)
        if base == "sequence":
            self.take("<"); element = self.type()
            if self.peek() != ",": self.fail(self.line(), "a sequence must be bounded")
            self.take(","); bound = int(self.take()); self.take(">")
            return Type("sequence", bound, element)
        return Type(base)


class Scope:
    def __init__(self, types):
        self.by_name = {}
        for t in types: self.by_name[f"{t.module}::{t.name}"] = t
        self.module = None

    def resolve(self, name):
        for candidate in (name, f"{self.module}::{name}"):
            if candidate in self.by_name: return self.by_name[candidate]
        sys.exit(f"error: unknown type '{name}' in {self.module}")

    def lookup(self, name):
        t = self.resolve(name)
        return f"{cpp_namespace(t.module)}::{t.name}"


def cpp_namespace(module): return "trunnion::idl::" + module.split("::")[1]
def cpp_name(t): return f"{cpp_namespace(t.module)}::{t.name}"


def schema(t, scope):
    """The type and everything it needs, in dependency order, as one IDL text."""
    done, order = set(), []
    def visit(x):
        if x in done: return
        done.add(x)
        if isinstance(x, Struct):
            for _, ft, _, _ in x.fields:
                if ft.user():
                    scope.module = x.module; visit(scope.resolve(ft.user()))
        order.append(x)
    visit(t)
    out = []
    for x in order:
        outer, inner = x.module.split("::")
        body = []
        if isinstance(x, Enum): body = [f"enum {x.name} {{ " + ", ".join(x.values) + " };"]
        else:
            body = ["@final", f"struct {x.name} {{"] + [f"  {'@key ' if k else ''}{ft.idl()} {n};" for n, ft, k, _ in x.fields] + ["};"]
        out += [f"module {outer} {{", f"module {inner} {{"] + body + ["};", "};"]
    return "\n".join(out) + "\n"


def quoted(names): return ", ".join(f'"{n}"' for n in names)


def digest(text, n=8): return hashlib.sha256(text.encode()).hexdigest()[:n]


def generate(args):
    types = []
    for path in sorted(args.idl): types += Parser(path).parse()
    scope = Scope(types)
    with open(args.topics) as f: document = yaml.safe_load(f)
    topics, standby_suffix = document["topics"], document["standby_suffix"]
    qos_names = {"batch", "state", "event", "history"}
    for t in topics:
        if t["type"] not in scope.by_name: sys.exit(f"{args.topics}: error: topic {t['name']} has the unknown type {t['type']}")
        if t["qos"] not in qos_names: sys.exit(f"{args.topics}: error: topic {t['name']} has the unknown qos {t['qos']}")
    contract = digest("".join(schema(t, scope) for t in types) + "".join(f"{t['name']}{t['type']}{t['qos']}" for t in topics), 16)

    hpp = ["// Generated from idl/ by tools/generate_contracts.py.", "#pragma once", "#include <cstdint>", "#include <string>", "#include <vector>",
           '#include "bus/fields.hpp"', ""]
    for t in types:
        hpp.append(f"namespace {cpp_namespace(t.module)} {{")
        if isinstance(t, Enum): hpp.append(f"enum class {t.name} : std::uint32_t {{ " + ", ".join(t.values) + " };")
        else:
            scope.module = t.module
            hpp.append(f"struct {t.name} {{")
            for name, ft, _, comment in t.fields:
                hpp.append(f"  {ft.cpp(scope)} {name}{{}};" + (f"  ///< {comment}" if comment else ""))
            hpp += [f"  bool operator==(const {t.name}&) const = default;", "};"]
        hpp.append("}")
    hpp.append("namespace trunnion::bus {")
    for t in types:
        if isinstance(t, Enum):
            hpp.append(f"template <> struct EnumNames<{cpp_name(t)}> {{ static constexpr const char* names[] = {{" + ", ".join(f'"{v}"' for v in t.values) + "}; };")
        else:
            visits = " ".join(f'v("{n}", t.{n}, {ft.bound}{", " + str(ft.element.bound) if ft.base == "sequence" and ft.element.bound else ""});' for n, ft, _, _ in t.fields)
            keys = " ".join(f'v("{n}", t.{n}, 0);' for n, ft, k, _ in t.fields if k)
            keyed = "true" if keys else "false"
            limits = " ".join(f'v("{n}", t.{n}, {ft.limits.get("min", 0)}, {ft.limits.get("max", "0x7fffffffffffffff")});' for n, ft, _, _ in t.fields if ft.limits)
            hpp += [f"template <> struct Fields<{cpp_name(t)}> {{",
                    f'  static constexpr const char* name = "{t.module}::{t.name}";',
                    f"  static constexpr bool keyed = {keyed};",
                    f"  template <class T, class V> static void visit(T& t, V&& v) {{ {visits} }}",
                    f"  template <class T, class V> static void visit_key([[maybe_unused]] T& t, [[maybe_unused]] V&& v) {{ {keys} }}",
                    f"  template <class T, class V> static void visit_limits([[maybe_unused]] const T& t, [[maybe_unused]] V&& v) {{ {limits} }}", "};"]
    hpp.append("}")

    handles = ["// Generated from idl/topics.yaml by tools/generate_contracts.py.", "#pragma once", '#include "bus/topic.hpp"', '#include "contracts/types.hpp"', "",
               "namespace trunnion::topics {", f'inline constexpr const char* contract_hash = "{contract}";',
               "/// Behind the name of a stage's topic: where it writes while it is on standby.",
               f'inline constexpr const char* standby_suffix = "{standby_suffix}";']
    registry = ['#include "contracts/topics.hpp"', '#include "bus/registry.hpp"', '#include "bus/typed_registry.hpp"', "", "namespace trunnion::bus {",
                "const std::vector<TopicEntry>& all_topics() {", "  static const std::vector<TopicEntry> entries{"]
    doc = ["# Topics", "", "Generated from `idl/topics.yaml`; the types and the meaning and unit of each field are in `idl/`.", "",
           "The type on the wire ends with the hash of its IDL, so that endpoints of different contracts never match.", "",
           "| topic | type on the wire | QoS | writers | readers | about |", "|---|---|---|---|---|---|"]
    for t in topics:
        kind = scope.by_name[t["type"]]
        text = schema(kind, scope)
        wire = t["type"] if t.get("frozen") else f"{t['type']}_{digest(text)}"
        handles.append(f'inline constexpr bus::Topic<{cpp_name(kind)}> {t["handle"]}{{"{t["name"]}", "{wire}", bus::QosKind::{t["qos"]}}};')
        registry.append(f'    typed_entry(topics::{t["handle"]}, "{t["handle"]}", R"idl({text})idl", "{t["about"]}", {{{quoted(t["writers"])}}}, {{{quoted(t["readers"])}}}),')
        doc.append(f"| `{t['name']}` | `{wire}` | {t['qos']} | {', '.join(t['writers'])} | {', '.join(t['readers'])} | {t['about']} |")
    handles.append("}")
    registry += ["  };", "  return entries;", "}", "}"]
    doc += ["", "## Quality of service", "", "All topics are reliable. `share/trunnion/sdk/fastdds.xml` has it as profiles.", "",
            "| QoS | durability | writers keep | readers keep |", "|---|---|---|---|",
            "| batch | transient local | the newest 1024 or more of the topic (twice what is written ahead, in batches, and 6) | all |",
            "| state | transient local | the newest of each key | the newest of each key |",
            "| event | writers: transient local, for recorders; readers: volatile | the newest 64; a slow reader loses old ones and stalls no writer | the newest 64 |",
            "| history | transient local | the newest 16 of each key | the newest 16 of each key |"]

    # One source per IDL file instantiates what walks over the fields of its types, so that no other source has to.
    codecs = {}
    for t in types:
        lines = codecs.setdefault(t.module.split("::")[1], ['#include "bus/cdr.hpp"', '#include "bus/json_fields.hpp"', '#include "contracts/types.hpp"', "",
                                                            "namespace trunnion::bus {"])
        if isinstance(t, Struct):
            c = cpp_name(t)
            lines += [f"template void encode(const {c}&, Bytes&);", f"template bool decode(std::span<const std::uint8_t>, {c}&, std::string*);",
                      f"template bool key_of<{c}>(std::span<const std::uint8_t>, KeyHash&);", f"template Json struct_to_json(const {c}&);"]
    for lines in codecs.values(): lines.append("}")

    os.makedirs(args.out, exist_ok=True)
    for name, lines in (("types.hpp", hpp), ("topics.hpp", handles), ("registry.cpp", registry), ("topics.md", doc),
                        *((f"codec_{module}.cpp", lines) for module, lines in codecs.items())):
        text = "\n".join(lines) + "\n"
        path = os.path.join(args.out, name)
        if not os.path.exists(path) or open(path).read() != text:
            with open(path, "w") as f: f.write(text)


if __name__ == "__main__":
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--topics", required=True); p.add_argument("--out", required=True); p.add_argument("idl", nargs="+")
    generate(p.parse_args())
