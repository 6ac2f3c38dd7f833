#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Keeps the gateway's interface current: in gateway/openapi.json the operator commands (idl/operator_commands.yaml) and
the schemas with "x-idl" (idl/*.idl), and of that document the page's types in gateway/web/src/contract.ts and the
reference docs/api.md.

Of a schema with "x-idl", `properties` and `required` are written here: the fields of the IDL type but those in
"x-without", and the hand-written ones in "x-with" and in the document's own schemas. With --check nothing is written and
the exit status is 1 when a file is not current.
"""
import argparse, glob, json, os, sys, textwrap
from generate_commands import load
from generate_contracts import Enum, Parser

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
DOCUMENT = f"{ROOT}/gateway/openapi.json"
CHANNEL, PANEL = "/api/channels/{channel}/", "/api/panel/"
WHOLE = {"uint8", "octet", "int8", "uint16", "int16", "uint32", "int32", "uint64", "int64"}
AXIS = {"oneOf": [{"type": "string"}, {"type": "integer", "minimum": 0}]}


def content(schema): return {"application/json": {"schema": schema}}


# The IDL types.

class Idl:
    def __init__(self, paths):
        self.types = {f"{t.module}::{t.name}": t for path in sorted(paths) for t in Parser(path).parse()}
        self.names = {}  # of IDL types that have a schema of their own

    def find(self, module, name):
        full = name if name in self.types else f"{module}::{name}"
        return full, self.types[full]

    def schema(self, t, module):
        if t.base == "boolean": return {"type": "boolean"}
        if t.base in WHOLE: return {"type": "integer"}
        if t.base in ("float", "double"): return {"type": "number"}
        if t.base == "string": return {"type": "string", "maxLength": t.bound}
        if t.base == "sequence": return {"type": "array", "items": self.schema(t.element, module), "maxItems": t.bound}
        full, kind = self.find(module, t.base)
        if full in self.names: return {"$ref": f"#/components/schemas/{self.names[full]}"}
        if isinstance(kind, Enum): return {"type": "string", "enum": kind.values}
        sys.exit(f"error: {full} needs a schema with x-idl")

    def fill(self, schema):
        kind = self.types[schema["x-idl"]]
        if isinstance(kind, Enum):
            schema.update({"type": "string", "enum": kind.values})
            return
        properties = {}
        for name, t, _, comment in kind.fields:
            if name in schema.get("x-without", []): continue
            properties[name] = self.schema(t, kind.module)
            if comment and "$ref" not in properties[name]: properties[name]["description"] = comment
        properties.update(schema.get("x-with", {}))
        schema.update({"type": "object", "properties": properties, "required": list(properties)})


# The operator commands.

def field_schema(field, idl):
    about = field["about"] + (f", {field['unit']}" if "unit" in field else "")
    into = field["into"]
    if into == "mode": schema = {"$ref": f"#/components/schemas/{idl.names['trunnion::channel::Mode']}"}
    elif into in ("program", "block"): schema = {"type": "string", "maxLength": 64 if into == "program" else 256}
    elif into == "on": schema = {"type": "boolean"}
    elif into == "axis": schema = dict(AXIS)
    elif into == "axes": schema = {"type": "array", "items": dict(AXIS)}
    elif into == "levels": schema = {"type": "array", "items": {"type": "integer", "minimum": field["minimum"], "maximum": field["maximum"]}}
    else:
        schema = {"type": "integer" if into in ("line", "counts", "press") else "number"}
        schema.update({"enum": field["one_of"]} if "one_of" in field else {"minimum": field["minimum"], "maximum": field["maximum"]})
    return {"description": about, **schema}


def body_schema(row, idl):
    properties = {name: {"const": value} for name, value in row.get("choice", {}).items()}
    properties.update({f["name"]: field_schema(f, idl) for f in row.get("fields", [])})
    required = [name for name in properties if not any(f["name"] == name and f.get("optional") for f in row.get("fields", []))]
    return {"type": "object", "properties": properties, "additionalProperties": False, **({"required": required} if required else {})}


def operation(rows, idl, parameters):
    bodies = [body_schema(row, idl) for row in rows]
    answers = {"200": {"description": "Accepted", "content": content({"$ref": "#/components/schemas/Accepted"})}}
    if rows[0].get("motion") == "stops":
        answers["202"] = {"description": "The channel has not answered yet: the stop is repeated until it does",
                          "content": content({"$ref": "#/components/schemas/Repeated"})}
    for status, name in (("400", "BadRequest"), ("404", "NotFound"), ("409", "Refused"), ("413", "TooLarge"), ("504", "Silent")):
        answers[status] = {"$ref": f"#/components/responses/{name}"}
    more = rows[0].get("more")
    return {"post": {"summary": rows[0]["about"], **({"description": more} if more else {}), **parameters,
                     "requestBody": {"required": "required" in bodies[0], "content": content(bodies[0] if len(bodies) == 1 else {"oneOf": bodies})},
                     "responses": answers}}


def commands(table, idl):
    number = {"parameters": [{"name": "channel", "in": "path", "required": True, "description": "Channel number",
                              "schema": {"type": "integer", "minimum": 0, "maximum": 31}}]}
    paths = {}
    for row in table["channel"]:
        path = CHANNEL + row["route"]
        if path not in paths: paths[path] = operation([r for r in table["channel"] if r["route"] == row["route"]], idl, number)
    for row in table["panel"]: paths[PANEL + row["route"]] = operation([row], idl, {})
    return paths


def updated(document, idl, table):
    schemas = document["components"]["schemas"]
    idl.names = {s["x-idl"]: name for name, s in schemas.items() if "x-idl" in s}
    for schema in schemas.values():
        if "x-idl" in schema: idl.fill(schema)
    paths = {}
    for path, item in document["paths"].items():
        if path.startswith(CHANNEL) or path.startswith(PANEL): continue
        paths[path] = item
        if path == CHANNEL.rstrip("/"): paths.update(commands(table, idl))
    return {**document, "paths": paths}


# TypeScript.

def ts_type(schema):
    if "$ref" in schema: return schema["$ref"].rsplit("/", 1)[1]
    if "const" in schema: return json.dumps(schema["const"])
    if "allOf" in schema: return " & ".join(ts_type(s) for s in schema["allOf"])
    if "enum" in schema and schema["type"] == "string": return " | ".join(json.dumps(v) for v in schema["enum"])
    if "oneOf" in schema: return " | ".join(ts_type(s) for s in schema["oneOf"])
    kind = schema.get("type")
    if kind == "array":
        item = ts_type(schema["items"])
        return f"({item})[]" if "|" in item else f"{item}[]"
    if kind == "object":
        if "properties" in schema: return "{ " + " ".join(ts_members(schema, "")) + " }" if schema["properties"] else "Record<string, never>"
        extra = schema.get("additionalProperties")
        return f"Record<string, {ts_type(extra)}>" if isinstance(extra, dict) else "object"
    return {"integer": "number", "number": "number", "string": "string", "boolean": "boolean", "null": "null"}[kind]


def ts_members(schema, indent):
    lines = []
    for name, s in schema["properties"].items():
        if indent and s.get("description"): lines.append(f"{indent}/** {s['description']} */")
        lines.append(f"{indent}{name}{'' if name in schema.get('required', []) else '?'}: {ts_type(s)};")
    return lines


def body_of(item): return item["post"]["requestBody"]["content"]["application/json"]["schema"]


def typescript(document):
    out = ["// SPDX-License-Identifier: Apache-2.0\n// Generated from gateway/openapi.json by tools/generate_api.py."]
    for name, schema in document["components"]["schemas"].items():
        if schema.get("description"): out.append(f"/** {schema['description']}. */")
        if schema.get("type") == "object" and "properties" in schema:
            out += [f"export interface {name} {{"] + ts_members(schema, "  ") + ["}", ""]
        else:
            out += [f"export type {name} = {ts_type(schema)};", ""]
    out += ["/** Bodies of POST /api/channels/{channel}/..., by the last part of the path. */", "export interface ChannelCommands {"]
    for path, item in document["paths"].items():
        if path.startswith(CHANNEL): out.append(f'  "{path[len(CHANNEL):]}": {ts_type(body_of(item))};')
    out += ["}", "", "/** What POST /api/channels/{channel}/override accepts as value, by the kind. */", "export const overrideLimits = {"]
    for kind in body_of(document["paths"][CHANNEL + "override"])["oneOf"]:
        value = kind["properties"]["value"]
        out.append(f"  {kind['properties']['kind']['const']}: {{ minimum: {value['minimum']}, maximum: {value['maximum']} }},")
    return "\n".join(out + ["};"]) + "\n"


# The reference, docs/api.md.

def md_type(schema):
    """What a value is, within a cell of a table."""
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[1]
        return f"[{name}](#{name.lower()})"
    if "const" in schema: return f"`{json.dumps(schema['const'], ensure_ascii=False)}`"
    if "allOf" in schema: return " and ".join(md_type(s) for s in schema["allOf"])
    if "oneOf" in schema: return " or ".join(md_type(s) for s in schema["oneOf"])
    if "enum" in schema: return ", ".join(f"`{value}`" for value in schema["enum"])
    kind = schema.get("type")
    if kind == "array":
        most = schema.get("maxItems")
        return f"list of {f'up to {most} ' if most else ''}{md_type(schema['items'])}"
    if kind == "object":
        if schema.get("properties"):
            required = schema.get("required", [])
            return ", ".join(f"`{name}`{'' if name in required else '?'}: {md_type(s)}" for name, s in schema["properties"].items())
        extra = schema.get("additionalProperties")
        return f"object of {md_type(extra)}" if isinstance(extra, dict) else "object"
    limits = ""
    if "minimum" in schema and "maximum" in schema: limits = f" {schema['minimum']} .. {schema['maximum']}"
    elif "minimum" in schema: limits = f" from {schema['minimum']}"
    elif "maxLength" in schema: limits = f" of up to {schema['maxLength']} bytes"
    return (kind or "any") + limits


def md_cell(text): return text.replace("|", "\\|").replace("\n", " ")


def md_body(content):
    return "; ".join(md_type(part["schema"]) if kind == "application/json" else f"`{kind}`" for kind, part in content.items())


def md_operation(path, method, operation, responses):
    asked = [f"{one['in']} `{one['name']}`{'' if one.get('required') else '?'}: {md_type(one['schema'])}"
             + (f" ({one['description']})" if one.get("description") else "") for one in operation.get("parameters", [])]
    if "requestBody" in operation:
        body = md_body(operation["requestBody"]["content"])
        if body != "object": asked.append(f"body{'' if operation['requestBody'].get('required') else '?'}: {body}")
    answers = []
    for status, answer in operation["responses"].items():
        if "$ref" in answer: answer = responses[answer["$ref"].rsplit("/", 1)[1]]
        body = md_body(answer.get("content", {})) if status.startswith("2") else ""
        answers.append(f"{status}{f' {body}' if body and body != 'object' else ''}")
    about = operation["summary"] + (f". {operation['description']}" if operation.get("description") else "")
    cells = [f"`{method.upper()} {path}`", about, "<br>".join(asked), "<br>".join(answers)]
    return "| " + " | ".join(md_cell(cell) for cell in cells) + " |"


def markdown(document):
    components = document["components"]
    out = ["# HTTP interface", "Generated from [gateway/openapi.json](../gateway/openapi.json), which the gateway also answers to",
           "`GET /api/openapi.json`. A name with `?` may be left out.", "", *textwrap.wrap(document["info"]["description"], 120), ""]
    groups = {}
    for path, item in document["paths"].items():
        for method, operation in item.items(): groups.setdefault(path.split("/")[2], []).append((path, method, operation))
    for group, operations in groups.items():
        out += [f"## /api/{group}", "| Request | What it does | Parameters and body | Answers |", "|---|---|---|---|"]
        out += [md_operation(*one, components["responses"]) for one in operations] + [""]
    out += ["## Answers that are no success", "| Answer | Body |", "|---|---|"]
    out += [f"| {md_cell(one['description'])} | {md_cell(md_body(one.get('content', {})))} |" for one in components["responses"].values()]
    out += ["", "## Types"]
    for name, schema in components["schemas"].items():
        out += [f"### {name}"] + textwrap.wrap(schema["description"] + "." if schema.get("description") else "", 120)
        if not schema.get("properties"):
            out += [*textwrap.wrap(md_type(schema), 120, break_long_words=False, break_on_hyphens=False), ""]
            continue
        required = schema.get("required", [])
        out += ["", "| Member | Value | Meaning |", "|---|---|---|"]
        out += [f"| `{member}`{'' if member in required else '?'} | {md_cell(md_type(s))} | {md_cell(s.get('description', ''))} |"
                for member, s in schema["properties"].items()]
        out.append("")
    return "\n".join(out).rstrip("\n") + "\n"


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--check", action="store_true")
    a = p.parse_args()
    with open(DOCUMENT) as f: text = f.read()
    document = updated(json.loads(text), Idl(glob.glob(f"{ROOT}/idl/*.idl")), load(f"{ROOT}/idl/operator_commands.yaml"))
    stale = []
    for path, wanted in ((DOCUMENT, json.dumps(document, indent=1, ensure_ascii=False) + "\n"),
                         (f"{ROOT}/gateway/web/src/contract.ts", typescript(document)), (f"{ROOT}/docs/api.md", markdown(document))):
        try:
            with open(path) as f: current = f.read()
        except FileNotFoundError: current = None
        if current == wanted: continue
        stale.append(path)
        if not a.check:
            with open(path, "w") as f: f.write(wanted)
    if a.check and stale: sys.exit(f"not current: {', '.join(stale)}: run tools/generate_api.py")


if __name__ == "__main__": main()
