// SPDX-License-Identifier: Apache-2.0
#include "plc/translation.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "plc/compile.hpp"
#include "plc/library/register_names.hpp"

namespace trunnion::st {
namespace {

constexpr std::array task_names = {"fast", "main"};
constexpr std::array<std::string_view, 3> entry_names = {"FAST", "MAIN", "SIMULATION"};
constexpr std::size_t simulation_task = 2;

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
  const auto compiled = compile(sources, interface_registers());
  programs.warnings = compiled.lines();
  if (!compiled.good()) throw std::runtime_error(joined(programs.warnings));
  require_cells(*compiled.code);
  programs.code = compiled.code;
  programs.layout = compiled.layout();
  programs.variables = Variables(compiled);
  programs.uses = Uses(compiled);
  for (std::size_t e = 0; e < programs.code->entries.size(); ++e)
    for (std::size_t task = 0; task < programs.entries.size(); ++task)
      if (programs.code->entries[e].name == entry_names[task] && (simulated || task != simulation_task))
        programs.entries[task] = e;
  for (std::size_t task = 0; task < simulation_task; ++task)
    if (!programs.entries[task])
      throw std::runtime_error(path(std::string(task_names[task]) + ".st") +
                               ": error: is missing, and no other file has PROGRAM " + task_names[task]);
  return programs;
}

ModbusFile modbus_of(const SourceFiles& files, const std::string& directory) {
  const auto* file = find(files, "modbus.yaml");
  return file == nullptr ? ModbusFile() : read_modbus(file->text, directory + file->name);
}

}  // namespace trunnion::st
