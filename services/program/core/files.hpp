// SPDX-License-Identifier: Apache-2.0
// What the program store needs of a directory. An interface, so that every way to fail can be tested.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "storage/file.hpp"
#include "storage/kept_text.hpp"

namespace trunnion::program {

using storage::StorageError;

class Files {
 public:
  virtual ~Files() = default;
  /// Regular files, ascending.
  virtual std::vector<std::string> list() = 0;
  /// Bytes from `offset`, fewer at the end of the file; returns how many. Throws StorageError.
  virtual std::size_t read(const std::string& name, std::uint64_t offset, std::span<std::uint8_t> bytes) = 0;
  /// Starts an empty file. Throws StorageError.
  virtual void create(const std::string& name) = 0;
  /// Writes at the end, `offset`; after StorageError the file ends at `offset` again.
  virtual void append(const std::string& name, std::uint64_t offset, std::span<const std::uint8_t> bytes) = 0;
  /// Makes `from` durable and puts it in the place of `to`: after a crash `to` is old or new. Throws
  /// StorageError.
  virtual void publish(const std::string& from, const std::string& to) = 0;
  /// Throws StorageError; a file that is not there is no error.
  virtual void remove(const std::string& name) = 0;
  /// A kept text (storage/kept_text.hpp); as it is where texts have no checksum. Throws StorageError.
  virtual storage::Kept read_kept(const std::string& name);
  /// Makes `text` the newest generation; after a crash it is old or new. Throws StorageError.
  virtual void write_kept(const std::string& name, const std::string& text);
};

}  // namespace trunnion::program
