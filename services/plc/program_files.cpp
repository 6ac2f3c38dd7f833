// SPDX-License-Identifier: Apache-2.0
#include "program_files.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "plc/source_files.hpp"

namespace trunnion::plc {

SourceFiles read_sources(const std::string& directory) {
  SourceFiles files;
  if (!std::filesystem::is_directory(directory))
    throw std::runtime_error(directory + ": error: is no directory");
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const auto name = entry.path().filename().string();
    if (!st::is_source(name)) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) throw std::runtime_error(entry.path().string() + ": error: cannot be read");
    files.push_back({name, text.str()});
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return files;
}

std::vector<std::string> load_programs(const std::string& directory, PlcCore& core, bool simulated) {
  auto programs = translate(read_sources(directory), simulated, directory + "/");
  auto warnings = programs.warnings;
  core.load(std::move(programs));
  return warnings;
}

}  // namespace trunnion::plc
