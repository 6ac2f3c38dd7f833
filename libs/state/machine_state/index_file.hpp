// SPDX-License-Identifier: Apache-2.0
// The file programs.yaml: what the store knew of each program when it changed last.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "contracts/types.hpp"

namespace trunnion::machine_state {

inline constexpr const char* index_file = "programs.yaml";
/// Before the name of a program: an empty file by which the operator accepts the program as it is now.
inline constexpr const char* accepted_prefix = ".accepted-";

/// Identifies a text.
struct TextIdentity {
  std::uint64_t size = 0;
  std::uint32_t crc32 = 0;
  bool operator==(const TextIdentity&) const = default;
};
inline TextIdentity identity_of(const idl::program::ProgramEntry& entry) { return {entry.size, entry.crc32}; }

struct IndexRow {
  std::uint64_t revision = 0;                        ///< newest one of this name
  std::optional<idl::program::ProgramEntry> stored;  ///< the program, when it is in the store
  bool removed = false;                              ///< removed on request, so not installed again
  std::optional<TextIdentity> next;  ///< its text is being replaced by this one; after a crash it is either
  bool removing = false;             ///< it is being removed; after a crash its file may still be there
};

struct IndexFile {
  std::uint64_t revision = 0;  ///< of the list
  std::map<std::string, IndexRow> rows;
};

/// Throws std::runtime_error with file:line:column.
IndexFile read_index(const std::string& text);
std::string write_index(const IndexFile& index);

}  // namespace trunnion::machine_state
