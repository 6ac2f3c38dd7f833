// SPDX-License-Identifier: Apache-2.0
// What the keeper of parameters needs of a directory. An interface, so that every way to fail can be tested.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/file.hpp"

namespace trunnion::parameters {

using storage::StorageError;

struct NamedText {
  std::string name;
  std::string text;
};

class Storage {
 public:
  virtual ~Storage() = default;
  /// The whole file, or nothing when it does not exist.
  virtual std::optional<std::string> read(const std::string& name) = 0;
  /// Replaces files so that after a crash at any instant each is old or new. When this throws StorageError
  /// before the first file is in place, none is.
  virtual void replace(const std::vector<NamedText>& files) = 0;
  /// Appends durably and returns the size before; nothing is appended when this throws StorageError.
  virtual std::uint64_t append(const std::string& name, const std::string& text) = 0;
  /// Takes an append back.
  virtual void truncate(const std::string& name, std::uint64_t size) = 0;
};

}  // namespace trunnion::parameters
