// SPDX-License-Identifier: Apache-2.0
// The files of a directory that make the programs of a PLC.
#pragma once

#include <string>
#include <vector>

namespace trunnion::st {

struct SourceFile {
  std::string name;  ///< main.st, fast.il, devices.yaml
  std::string text;
  bool operator==(const SourceFile&) const = default;
};
using SourceFiles = std::vector<SourceFile>;

/// Whether a file of this name is a source: what is compiled (is_compiled()), devices.yaml, messages.yaml,
/// modbus.yaml.
bool is_source(const std::string& name);

/// Null when there is no such file.
const SourceFile* find(const SourceFiles& files, const std::string& name);

/// Those of a directory in the order of their names. Throws std::runtime_error.
SourceFiles read_sources(const std::string& directory);

}  // namespace trunnion::st
