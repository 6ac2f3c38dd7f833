// SPDX-License-Identifier: Apache-2.0
#include "program_files.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "compiler.hpp"
#include "plc/compile.hpp"
#include "plc/library/register_names.hpp"

namespace trunnion::plc {
namespace {

std::string read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error(path + ": error: cannot be read");
  return text.str();
}

std::vector<st::Source> structured_sources(const std::string& directory) {
  std::vector<st::Source> sources;
  if (!std::filesystem::is_directory(directory))
    throw std::runtime_error(directory + ": error: is no directory");
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const auto name = entry.path().filename().string();
    if (name.ends_with(".st") && !name.ends_with("_test.st")) sources.push_back({entry.path().string(), ""});
  }
  std::sort(sources.begin(), sources.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  for (auto& source : sources) source.text = read(source.name);
  return sources;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

}  // namespace

std::vector<std::string> load_programs(const std::string& directory, PlcCore& core) {
  StructuredPrograms structured;
  std::vector<std::string> warnings;
  if (const auto sources = structured_sources(directory); !sources.empty()) {
    const auto compiled = st::compile(sources, st::interface_registers());
    warnings = compiled.lines();
    if (!compiled.good()) throw std::runtime_error(joined(warnings));
    structured.code = compiled.code;
    structured.layout = compiled.layout();
  }
  Compiler compiler(interface_symbols());
  Program programs[2];
  const char* names[] = {"fast", "main"};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto path = directory + "/" + names[i] + ".il";
    if (structured.code)
      for (std::size_t e = 0; e < structured.code->entries.size(); ++e)
        if (structured.code->entries[e].name == (i == 0 ? "FAST" : "MAIN")) structured.entries[i] = e;
    const bool list = std::filesystem::exists(path);
    if (list && structured.entries[i])
      throw std::runtime_error(path + ": error: PROGRAM " + names[i] +
                               " of the .st files is this task too; keep one of them");
    if (!list && !structured.entries[i])
      throw std::runtime_error(path + ": error: cannot be opened, and no .st file has PROGRAM " + names[i]);
    if (list) programs[i] = compiler.compile(read(path), path);
  }
  core.load(std::move(programs[0]), std::move(programs[1]),
            structured.code ? StructuredText(std::move(structured)) : StructuredText());
  return warnings;
}

}  // namespace trunnion::plc
