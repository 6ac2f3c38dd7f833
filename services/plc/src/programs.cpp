// SPDX-License-Identifier: Apache-2.0
#include "programs.hpp"

#include <algorithm>
#include <stdexcept>

#include "plc/compile.hpp"
#include "plc/instruction_list/compiler.hpp"
#include "plc/library/register_names.hpp"
#include "storage/crc32.hpp"

namespace trunnion::plc {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

void sort(SourceFiles& files) {
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
}

}  // namespace

const SourceFile* find(const SourceFiles& files, const std::string& name) {
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const SourceFile& file) { return file.name == name; });
  return found == files.end() ? nullptr : &*found;
}

std::uint32_t crc32_of(SourceFiles files) {
  sort(files);
  std::string all;
  for (const auto& file : files)
    all += file.name + '\0' + std::to_string(file.text.size()) + '\0' + file.text;
  return storage::crc32(all);
}

Programs translate(SourceFiles files, bool simulated, const std::string& directory) {
  sort(files);
  const auto path = [&](const std::string& name) { return directory + name; };
  Programs programs;
  StructuredPrograms structured;
  std::vector<st::Source> sources;
  for (auto& file : files)
    if (st::is_compiled(file.name)) sources.push_back({path(file.name), file.text});
  if (const auto* file = find(files, "devices.yaml"); simulated && file != nullptr) {
    auto devices = st::read_devices(file->text, path(file->name), st::interface_registers());
    sources.push_back({path(file->name), std::move(devices.program)});
    programs.switches = std::move(devices.switches);
  }
  if (const auto* file = find(files, "messages.yaml"))
    programs.messages = st::read_messages(file->text, path(file->name));
  st::Compilation compiled;
  if (!sources.empty()) {
    compiled = st::compile(sources, st::interface_registers());
    programs.warnings = compiled.lines();
    if (!compiled.good()) throw std::runtime_error(joined(programs.warnings));
    structured.code = compiled.code;
    structured.layout = compiled.layout();
    programs.variables = st::Variables(compiled);
  }
  il::Compiler compiler(il::interface_symbols());
  il::Program* lists[] = {&programs.fast, &programs.main};
  const char* names[] = {"fast", "main"};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto name = std::string(names[i]) + ".il";
    if (structured.code)
      for (std::size_t e = 0; e < structured.code->entries.size(); ++e)
        if (structured.code->entries[e].name == (i == 0 ? "FAST" : "MAIN")) structured.entries[i] = e;
    const auto* list = find(files, name);
    if (list != nullptr && structured.entries[i])
      throw std::runtime_error(path(name) + ": error: PROGRAM " + names[i] +
                               " of the .st and .xml files is this task too; keep one of them");
    if (list == nullptr && !structured.entries[i])
      throw std::runtime_error(path(name) +
                               ": error: cannot be opened, and no .st or .xml file has PROGRAM " + names[i]);
    if (list == nullptr) continue;
    *lists[i] = compiler.compile(list->text, path(name));
    st::add_uses(compiled, path(name), *lists[i]);
  }
  programs.uses = st::Uses(compiled);
  for (const auto& warning : compiler.warnings()) programs.warnings.push_back(warning);
  for (std::size_t e = 0; simulated && structured.code && e < structured.code->entries.size(); ++e)
    if (structured.code->entries[e].name == "SIMULATION")
      structured.entries[static_cast<std::size_t>(TaskName::simulation)] = e;
  if (structured.code) programs.structured = StructuredText(std::move(structured));
  return programs;
}

}  // namespace trunnion::plc
