// SPDX-License-Identifier: Apache-2.0
// Bytes that a cyclic task keeps: two mapped files, written in turn, so that kill -9 at any instant leaves
// one of them whole, and the loss or an old copy of either is found.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/kept_text.hpp"
#include "storage/mapped_file.hpp"

namespace trunnion::storage {

/// What a pair has kept.
struct Retained {
  KeptState state = KeptState::absent;
  std::vector<std::uint8_t> content;  ///< of `good` and `previous`
  std::string problem;                ///< of `previous` and `unusable`: what is wrong, with the file's name
};

/// The two files are `path` and `path` with previous_suffix. Not durable against a power failure, as
/// MappedFile.
class RetainedPair {
 public:
  /// `kind` (at most 15 bytes) and `size` of the content identify the format.
  RetainedPair(std::string path, std::string_view kind, std::size_t size);

  /// For files whose size is not known: that of the files there are.
  static RetainedPair of_files(const std::string& path, std::string_view kind);

  /// Reads the files; makes and changes nothing. A write that a kill has interrupted is no damage: its other
  /// file is the newest. Throws StorageError.
  Retained load() const;
  /// Makes the files, or takes those there are, with `content` in both. Files that are damaged are put aside
  /// (damaged_suffix). Not cyclic; before the first save(). Throws StorageError.
  void open(std::span<const std::uint8_t> content);
  /// Cyclic: no allocation, no system call. `content` has `size` bytes.
  void save(std::span<const std::uint8_t> content);
  bool is_open() const { return files_[0] != nullptr; }
  const std::string& path() const { return path_; }

 private:
  void write(void* file, std::uint64_t sequence, std::span<const std::uint8_t> content) const;

  std::string path_;
  std::string kind_;
  std::size_t size_;
  std::unique_ptr<MappedFile> files_[2];
  std::uint64_t sequence_ = 0;  ///< of the newest save
};

}  // namespace trunnion::storage
