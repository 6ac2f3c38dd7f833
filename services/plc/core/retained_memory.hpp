// SPDX-License-Identifier: Apache-2.0
// The PLC's memory in mapped files: it survives kill -9 at any instant.
#pragma once

#include <optional>
#include <string>

#include "memory.hpp"
#include "storage/retained_pair.hpp"

namespace trunnion::plc {

class RetainedMemory {
 public:
  /// What the files keep.
  struct Content {
    static constexpr std::uint64_t own_layout = 3;
    char boot[56];
    std::uint64_t layout;  ///< of the memory; zero in files of versions before
    Memory memory;
  };

  /// `cells`: of the variables of the programs.
  explicit RetainedMemory(const std::string& path, std::size_t cells = 0);

  struct Kept {
    std::string boot;
    Memory memory;
  };
  struct Found {
    storage::KeptState state = storage::KeptState::absent;
    std::optional<Kept> kept;  ///< of `good` and `previous`
    std::string problem;       ///< of `previous` and `unusable`
  };
  /// The newest whole content. Changes nothing. Throws storage::StorageError.
  Found load() const;
  /// `boot` names the start of the cluster it belongs to; its first 55 bytes count. Cyclic, except that the
  /// first call makes the files. Throws storage::StorageError naming the file.
  void save(const std::string& boot, const Memory& memory);
  /// The programs have other variables: the files get the size for `cells` of them. A kill at any instant
  /// leaves the memory of before or this one. Not cyclic. Throws storage::StorageError.
  void resize(std::size_t cells, const std::string& boot, const Memory& memory);
  const std::string& path() const { return files_.path(); }

 private:
  std::optional<Kept> of_format_0() const;
  std::span<const std::uint8_t> fill(const std::string& boot, const Memory& memory);
  storage::RetainedPair files_;
  std::size_t size_;
  Content content_{};
};

}  // namespace trunnion::plc
