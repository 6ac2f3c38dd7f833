// SPDX-License-Identifier: Apache-2.0
#include "plc/source_files.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "plc/compile.hpp"

namespace trunnion::st {

bool is_source(const std::string& name) {
  return is_compiled(name) || name == "devices.yaml" || name == "messages.yaml" || name == "modbus.yaml";
}

const SourceFile* find(const SourceFiles& files, const std::string& name) {
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const SourceFile& file) { return file.name == name; });
  return found == files.end() ? nullptr : &*found;
}

SourceFiles read_sources(const std::string& directory) {
  SourceFiles files;
  if (!std::filesystem::is_directory(directory))
    throw std::runtime_error(directory + ": error: is no directory");
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const auto name = entry.path().filename().string();
    if (!is_source(name)) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) throw std::runtime_error(entry.path().string() + ": error: cannot be read");
    files.push_back({name, text.str()});
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return files;
}

}  // namespace trunnion::st
