#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Adds a topic, a parameter, a G code and a stage to a scratch copy of the sources, in the places that "How to add" of
CONTRIBUTING.md names and in no other, generates code and documents, configures, and compiles what uses them.

how_to_add.py --source DIRECTORY --scratch DIRECTORY [--cmake PATH]
"""
import argparse, glob, os, re, shutil, subprocess, sys

STAGE = "thermal"
FILES = {
    "CMakeLists.txt": f"""trunnion_library(trunnion_{STAGE}_core SOURCES core/{STAGE}_core.cpp LINK trunnion_stream)
target_include_directories(trunnion_{STAGE}_core PUBLIC ${{CMAKE_CURRENT_SOURCE_DIR}}/core)
trunnion_service({STAGE} LINK trunnion_{STAGE}_core)
""",
    f"core/{STAGE}_core.hpp": """#pragma once
#include "machine/parameters.hpp"
#include "stream/stage_core.hpp"
namespace trunnion::thermal {
class ThermalCore : public stream::StageCore<idl::stream::AxisBatch> {
 public:
  void configure(const machine::Parameters& parameters, std::uint16_t channel) override;
  bool process(const idl::stream::AxisBatch& in, const stream::FeedbackWindow& feedback, idl::stream::AxisBatch& out) override;
  void load(std::span<const double>) override {}
  void save(stream::StateValues& state) const override { state.clear(); }
 private:
  double growth_ = 0;
};
}
""",
    f"core/{STAGE}_core.cpp": """#include "thermal_core.hpp"
#include "machine/parameter_constants.hpp"
namespace trunnion::thermal {
void ThermalCore::configure(const machine::Parameters& parameters, std::uint16_t) { growth_ = parameters.get(parameter::thermal_growth); }
bool ThermalCore::process(const idl::stream::AxisBatch& in, const stream::FeedbackWindow&, idl::stream::AxisBatch& out) {
  out.axes = in.axes;
  out.setpoints = in.setpoints;
  for (auto& setpoint : out.setpoints) setpoint += growth_;
  return true;
}
}
""",
    "service.hpp": """#pragma once
#include "core/thermal_core.hpp"
#include "stream/stage_service.hpp"
namespace trunnion::thermal {
class ThermalService : public stream::StageService<idl::stream::AxisBatch> {
 public:
  explicit ThermalService(service::Node& node);
 private:
  bus::Writer<idl::thermal::SpindleGrowth> growth_;
};
}
""",
    "service.cpp": """#include "service.hpp"
namespace trunnion::thermal {
ThermalService::ThermalService(service::Node& node)
    : StageService(node, stream::Stage::THERMAL, topics::gantry_batch, topics::thermal_batch,
                   [] { return std::make_unique<ThermalCore>(); }),
      growth_(node.bus().writer(topics::spindle_growth)) {}
}
""",
    "main.cpp": """#include "service.hpp"
int main(int argc, char** argv) {
  return trunnion::service::service_main<trunnion::thermal::ThermalService>(argc, argv, "thermal");
}
""",
}


class Scratch:
    def __init__(self, source, root):
        self.root = root
        shutil.rmtree(root, ignore_errors=True)
        os.makedirs(root)
        for name in os.listdir(source):
            if name in ("build", "out", ".git"): continue
            path = os.path.join(source, name)
            ignore = shutil.ignore_patterns("node_modules", "__pycache__", "*.mcap")
            if os.path.isdir(path): shutil.copytree(path, os.path.join(root, name), ignore=ignore)
            else: shutil.copy(path, root)
        self.guide = self.read("CONTRIBUTING.md")
        self.paragraph = ""

    def path(self, name): return os.path.join(self.root, name)
    def there(self, name): return os.path.exists(self.path(name))
    def read(self, name):
        with open(self.path(name), encoding="utf-8") as f: return f.read()
    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding="utf-8") as f: f.write(text)

    def follow(self, *titles):
        """What is edited from here on must be named in these paragraphs of CONTRIBUTING.md."""
        section = self.guide.split("## How to add", 1)[1]
        found = [re.search(rf"^\*\*{title}\b.*?(?=^\*\*|\Z)", section, re.M | re.S) for title in titles]
        for title, text in zip(titles, found):
            if text is None: sys.exit(f"CONTRIBUTING.md: 'How to add' has no paragraph '{title}'")
        self.paragraph = "".join(text.group(0) for text in found)

    def edit(self, name, pattern, replacement, named=None):
        """Replaces the first match; `named` is how the guide calls the file, when that is not its path."""
        if (named or name) not in self.paragraph: sys.exit(f"CONTRIBUTING.md: the paragraph does not name {named or name}")
        text, count = re.subn(pattern, replacement, self.read(name), count=1, flags=re.S | re.M)
        if count == 0: sys.exit(f"{name}: nothing matches {pattern}")
        self.write(name, text)

    def run(self, *command, expect=0):
        done = subprocess.run(command, cwd=self.root, text=True, capture_output=True)
        if done.returncode != expect: sys.exit(f"{' '.join(command)}: status {done.returncode}\n{done.stdout}{done.stderr}")


def contracts(s):
    """The contract of every service, as contract.h of the SDK names it."""
    out, idl = "build/contracts", [os.path.join("idl", name) for name in sorted(os.listdir(s.path("idl"))) if name.endswith(".idl")]
    s.run(sys.executable, "tools/generate_contracts.py", "--topics", "idl/topics.yaml", "--out", out, *idl)
    s.run(sys.executable, "tools/generate_sdk.py", "--topics", "idl/topics.yaml", "--handles", f"{out}/topics.hpp", "--out", out)
    return dict(re.findall(r'#define TRUNNION_CONTRACT_(\w+) "(\w+)"', s.read(f"{out}/contract.h")))


def add_topic(s):
    before = contracts(s)
    s.follow("A topic")
    s.write("idl/thermal.idl", "module trunnion {\n  module thermal {\n    @final struct SpindleGrowth {\n      @key uint16 axis;\n"
            "      double growth;                     // mm\n    };\n  };\n};\n")
    s.edit("idl/topics.yaml", r"\Z", '  - {handle: spindle_growth, name: trunnion/thermal/spindle_growth/1, type: "trunnion::thermal::SpindleGrowth", '
           "qos: state, writers: [thermal], readers: [gateway], about: growth of the spindle}\n")
    after = contracts(s)
    changed = [name for name in before if after[name] != before[name]]
    if changed != ["GATEWAY"]: sys.exit(f"the topic is the gateway's, and it changed the contracts of {changed}")


def add_parameter(s):
    s.follow("A parameter")
    s.edit("libs/machine/machine/catalogue.yaml", r"^  # class user\n", r'\g<0>  - {class: user, offset: 990, name: thermal_growth, unit: mm, type: real, min: 0, '
           "max: 1, default: 0.25, activation: reset, access: user, help: Growth of the spindle}\n")


def add_g_code(s):
    s.follow("A G code")
    # G4.1 waits a second: a row, and a function of the handler.
    s.edit("libs/program/language/codes.cpp", r'^    GCode\{40, (.*?)::dwell>(.*?)"G4 P500"\},\n', r'\g<0>    GCode{41, \g<1>::wait>\g<2>"G4.1"},\n')
    s.edit("libs/program/language/positioning.hpp", r"^  Fault dwell\([^\n]*\n", r"\g<0>  Fault wait(std::uint16_t at);  ///< G4.1\n", named="positioning")
    s.edit("libs/program/language/positioning.cpp", r"^Fault Positioning::check_machine_coordinates", "Fault Positioning::wait(std::uint16_t) {\n"
           "  output_.push(CommandKind::dwell).dwell_seconds = 1;\n  return {};\n}\n\n\\g<0>", named="positioning")


def add_operator_command(s):
    s.follow("An operator command")
    s.edit("idl/channel.idl", r"(enum CommandKind \{[^}]*SET_PARTS)", r"\g<1>, SET_LOT")
    s.edit("idl/channel.idl", r"^      uint32 parts; *// SET_PARTS\n", r"\g<0>      uint32 lot;                        // SET_LOT\n")
    s.edit("idl/operator_commands.yaml", r"^panel:", '  - {command: SET_LOT, route: lot, word: lot, busy: true, about: "Set the number of the lot",\n'
           '     fields: [{name: lot, argument: NUMBER, about: "Number of the lot", minimum: 0, maximum: 1000}]}\n\n\\g<0>')
    s.edit("libs/cluster/commands/command_table.hpp", r"^  tool\n", "  tool,\n  lot\n", named="libs/cluster/commands")
    file = "libs/cluster/commands/channel_request.cpp"
    s.edit(file, r"^    case Into::parts:\n      request.parts =(.*?)break;\n", r"\g<0>    case Into::lot:\n      request.lot =\g<1>break;\n", named="libs/cluster/commands")
    s.edit(file, r"^    case Into::parts:\n      return request.parts;\n", r"\g<0>    case Into::lot:\n      return request.lot;\n", named="libs/cluster/commands")
    s.edit("services/channel/core/channel_commands.cpp", r"^    case CommandKind::SET_PARTS:", r"    case CommandKind::SET_LOT:\n      return {};\n\g<0>")
    for part in ("operator_commands.yaml", "state_table_test.cpp"):
        if part not in s.paragraph: sys.exit(f"CONTRIBUTING.md: the paragraph does not name {part}")
    arguments = ["tools/generate_api.py"]
    s.run(sys.executable, *arguments)
    if "/lot" not in s.read("gateway/openapi.json"): sys.exit("openapi.json: the command is missing")


def add_stage(s):
    for name, text in FILES.items(): s.write(f"services/{STAGE}/{name}", text)
    s.follow("A service", "A stage")
    topic = ('  - {handle: thermal_batch, name: trunnion/thermal/axis_batch/1, type: "trunnion::stream::AxisBatch", qos: batch, '
             "writers: [thermal], readers: [drive], about: the same with the growth of the spindle}\n")
    s.edit("idl/topics.yaml", r"\Z", topic)
    s.edit("idl/stream.idl", r"(enum Stage \{[^}]*GANTRY)", rf"\g<1>, {STAGE.upper()}")
    s.edit("idl/topics.yaml", r"(handle: gantry_batch,.*?readers: \[)drive", rf"\g<1>{STAGE}")
    for path, _, files in os.walk(s.path("services/drive")):
        for name in files:
            file = os.path.relpath(os.path.join(path, name), s.root)
            if name.endswith(".cpp") and "topics::gantry_batch" in s.read(file):
                s.write(file, s.read(file).replace("topics::gantry_batch", "topics::thermal_batch"))
    s.edit("README.md", r"^(\| \[services/gantry/\][^\n]*\n)", rf"\g<1>| [services/{STAGE}/](services/{STAGE}) | stage: growth of the spindle |\n")
    for machine in os.listdir(s.path("configs/machines")):
        file = f"configs/machines/{machine}/machine.yaml"
        if s.there(file): s.edit(file, r"^(  - \{service: gantry)", rf"  - {{service: {STAGE}}}\n\g<1>", named="machine.yaml")
    s.edit("libs/machine/machine/services.yaml", r"^(  - \{name: gantry,[^\n]*\n)",
           rf"\g<1>  - {{name: {STAGE}, cyclic: true, stage: {{input: gantry_batch, output: thermal_batch}}}}\n")


def object_of(s, directory, target, source):
    """The object of a source, which is compiled with others of its target."""
    folder = f"{directory}/CMakeFiles/{target}.dir"
    for unit in sorted(glob.glob(f"{s.root}/build/release/{folder}/Unity/*.cxx")):
        with open(unit) as text:
            if f"/{source}\"" in text.read(): return f"{folder}/Unity/{os.path.basename(unit)}.o"
    sys.exit(f"{folder}: {source} is in no file of the unity build")


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--source", required=True), p.add_argument("--scratch", required=True), p.add_argument("--cmake", default="cmake")
    args = p.parse_args()
    s = Scratch(os.path.abspath(args.source), os.path.abspath(args.scratch))
    for add in (add_topic, add_parameter, add_g_code, add_operator_command, add_stage): add(s)
    s.run(sys.executable, "tools/structure/check_structure.py")
    s.run(sys.executable, "tools/generate_docs.py", "--check", expect=1)
    s.run(sys.executable, "tools/generate_docs.py")
    for document, added in (("docs/parameters.md", "thermal_growth"), ("docs/codes.md", "G4.1")):
        if added not in s.read(document): sys.exit(f"{document}: {added} is missing")
    s.run(args.cmake, "--preset", "release")
    build = [args.cmake, "--build", "--preset", "release", "--"]
    s.run(*build, "contracts_generated")
    if "trunnion/thermal/spindle_growth/1" not in s.read("build/release/generated/contracts/topics.md"): sys.exit("topics.md: the topic is missing")
    # The objects alone: an archive or a program would build the libraries again, for nothing that the compiler does not say.
    sources = ((f"services/{STAGE}", f"trunnion_{STAGE}_core", f"{STAGE}_core.cpp"), (f"services/{STAGE}", f"trunnion-{STAGE}", "main.cpp"),
               (f"services/{STAGE}", f"trunnion-{STAGE}", "service.cpp"), ("libs/program/language", "trunnion_language", "codes.cpp"),
               ("libs/program/language", "trunnion_language", "positioning.cpp"), ("libs/cluster/commands", "trunnion_commands", "channel_request.cpp"))
    s.run(*build, *sorted({object_of(s, *source) for source in sources}))
    shutil.rmtree(s.root)


if __name__ == "__main__": main()
