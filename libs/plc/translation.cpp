// SPDX-License-Identifier: Apache-2.0
#include "plc/translation.hpp"

#include <algorithm>
#include <stdexcept>

#include "plc/compile.hpp"
#include "plc/instruction_list/compiler.hpp"
#include "plc/library/register_names.hpp"

namespace trunnion::st {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

}  // namespace

void require_cells(const ByteCode& code) {
  const auto cells = code.initial.size() - image_cells;
  if (cells > program_cells)
    throw std::runtime_error(
        "the variables of the PLC programs need " + std::to_string(cells) +
        " cells of 64 bits, and there are " + std::to_string(program_cells) +
        ": shorten arrays and strings, and use as few instances of function blocks as needed");
}

Translation translate_sources(SourceFiles files, bool simulated, const std::string& directory) {
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  const auto path = [&](const std::string& name) { return directory + name; };
  Translation programs;
  std::vector<Source> sources;
  for (auto& file : files)
    if (is_compiled(file.name)) sources.push_back({path(file.name), file.text});
  if (const auto* file = find(files, "devices.yaml"); simulated && file != nullptr) {
    auto devices = read_devices(file->text, path(file->name), interface_registers());
    sources.push_back({path(file->name), std::move(devices.program)});
    programs.switches = std::move(devices.switches);
  }
  if (const auto* file = find(files, "messages.yaml"))
    programs.messages = read_messages(file->text, path(file->name));
  Compilation compiled;
  if (!sources.empty()) {
    compiled = compile(sources, interface_registers());
    programs.warnings = compiled.lines();
    if (!compiled.good()) throw std::runtime_error(joined(programs.warnings));
    require_cells(*compiled.code);
    programs.code = compiled.code;
    programs.layout = compiled.layout();
    programs.variables = Variables(compiled);
  }
  il::Compiler compiler(il::interface_symbols());
  il::Program* lists[] = {&programs.fast, &programs.main};
  const char* names[] = {"fast", "main"};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto name = std::string(names[i]) + ".il";
    if (programs.code)
      for (std::size_t e = 0; e < programs.code->entries.size(); ++e)
        if (programs.code->entries[e].name == (i == 0 ? "FAST" : "MAIN")) programs.entries[i] = e;
    const auto* list = find(files, name);
    if (list != nullptr && programs.entries[i])
      throw std::runtime_error(path(name) + ": error: PROGRAM " + names[i] +
                               " of the .st and .xml files is this task too; keep one of them");
    if (list == nullptr && !programs.entries[i])
      throw std::runtime_error(path(name) +
                               ": error: cannot be opened, and no .st or .xml file has PROGRAM " + names[i]);
    if (list == nullptr) continue;
    *lists[i] = compiler.compile(list->text, path(name));
    add_uses(compiled, path(name), *lists[i]);
  }
  programs.uses = Uses(compiled);
  for (const auto& warning : compiler.warnings()) programs.warnings.push_back(warning);
  for (std::size_t e = 0; simulated && programs.code && e < programs.code->entries.size(); ++e)
    if (programs.code->entries[e].name == "SIMULATION") programs.entries[2] = e;
  return programs;
}

ModbusFile modbus_of(const SourceFiles& files, const std::string& directory) {
  const auto* file = find(files, "modbus.yaml");
  return file == nullptr ? ModbusFile() : read_modbus(file->text, directory + file->name);
}

}  // namespace trunnion::st
