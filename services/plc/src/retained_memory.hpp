// SPDX-License-Identifier: Apache-2.0
// The PLC's memory in a mapped file: it survives kill -9 at any instant.
#pragma once

#include <optional>
#include <string>

#include "memory.hpp"
#include "storage/mapped_file.hpp"

namespace trunnion::plc {

/// Two slots, written in turn: when the process ends during a write, the other slot is valid.
class RetainedMemory {
 public:
  /// Throws storage::StorageError naming the file.
  explicit RetainedMemory(const std::string& path);

  struct Kept {
    std::string boot;
    Memory memory;
  };
  /// The newest whole slot, or nothing when the file is new or of another version.
  std::optional<Kept> load() const;
  /// `boot` names the start of the cluster it belongs to; its first 63 bytes count.
  void save(const std::string& boot, const Memory& memory);

 private:
  struct Slot;
  struct Layout;
  storage::MappedFile file_;
  Layout* layout_;
};

}  // namespace trunnion::plc
