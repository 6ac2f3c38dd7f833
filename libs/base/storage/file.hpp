// SPDX-License-Identifier: Apache-2.0
// Files that are whole after a crash: an owned descriptor and the two steps that make a change last.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

namespace trunnion::storage {

/// The disk refused; what() names the file and the reason.
class StorageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An open file that closes itself. Every member throws StorageError.
class File {
 public:
  /// `flags` as open(2) takes them; a new file is readable by all users and writable by its owner.
  File(std::string path, int flags);
  ~File();
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  /// Bytes from `offset`, fewer at the end of the file; returns how many.
  std::size_t read(std::uint64_t offset, std::span<std::uint8_t> bytes) const;
  /// Writes at the end, which the caller gives as `end`; when this throws, the file ends there again.
  void append(std::uint64_t end, std::span<const std::uint8_t> bytes);
  /// Cuts or lengthens with zeros.
  void truncate(std::uint64_t size);
  /// Returns when everything written is on the disk.
  void sync();
  std::uint64_t size() const;

 private:
  std::string path_;
  int descriptor_;
};

/// Puts `from` in the place of `to`: after a crash `to` is old or new. It lasts once their directory is
/// synchronized. Throws StorageError.
void rename_over(const std::string& from, const std::string& to);

/// Makes `text` the content of the file: after a crash it is the old or the new, and nothing is left beside
/// it. Throws StorageError.
void replace_file(const std::string& path, const std::string& text);

/// Returns when the names in the directory are on the disk. Throws StorageError.
void sync_directory(const std::string& directory);

}  // namespace trunnion::storage
