// SPDX-License-Identifier: Apache-2.0
#include "machine_state/index_file.hpp"

#include <stdexcept>

#include "machine/roles.hpp"
#include "machine/yaml.hpp"

namespace trunnion::machine_state {

IndexFile read_index(const std::string& text) {
  IndexFile index;
  const auto document = machine::parse_yaml(text, index_file);
  try {
    index.revision = document["revision"].as<std::uint64_t>();
    for (const auto& node : document["programs"]) {
      const auto name = node["name"].as<std::string>();
      auto& row = index.rows[name];
      row.revision = node["revision"].as<std::uint64_t>();
      row.removed = node["removed"].IsDefined();
      row.removing = node["removing"].IsDefined();
      if (node["next_size"])
        row.next = {node["next_size"].as<std::uint64_t>(), node["next_crc32"].as<std::uint32_t>()};
      if (!node["size"]) continue;
      row.stored = {name,
                    row.revision,
                    node["size"].as<std::uint64_t>(),
                    node["crc32"].as<std::uint32_t>(),
                    node["lines"].as<std::uint32_t>(),
                    node["role"] ? node["role"].as<std::uint8_t>() : machine::role::setter};
    }
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(std::string(index_file) + ":" + std::to_string(e.mark.line + 1) + ":" +
                             std::to_string(e.mark.column + 1) + ": error: " + e.msg);
  }
  return index;
}

std::string write_index(const IndexFile& index) {
  std::string text =
      "# Kept by the program service.\nrevision: " + std::to_string(index.revision) + "\nprograms:\n";
  for (const auto& [name, row] : index.rows) {
    text += "  - {name: \"" + name + "\", revision: " + std::to_string(row.revision);
    if (row.stored)
      text += ", size: " + std::to_string(row.stored->size) +
              ", crc32: " + std::to_string(row.stored->crc32) +
              ", lines: " + std::to_string(row.stored->lines) + ", role: " + std::to_string(row.stored->role);
    if (row.next)
      text += ", next_size: " + std::to_string(row.next->size) +
              ", next_crc32: " + std::to_string(row.next->crc32);
    if (row.removing) text += ", removing: true";
    if (row.removed) text += ", removed: true";
    text += "}\n";
  }
  return text;
}

}  // namespace trunnion::machine_state
