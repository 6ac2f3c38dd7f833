// SPDX-License-Identifier: Apache-2.0
// A file as memory: what is written survives kill -9 of the process at any instant.
#pragma once

#include <cstddef>
#include <string>

namespace trunnion::storage {

/// Not durable against a power failure: the kernel writes it out when it likes.
class MappedFile {
 public:
  /// Opens or makes the file and gives it `size` bytes, new ones zero. Throws StorageError.
  MappedFile(const std::string& path, std::size_t size);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  /// At the start of a page, so aligned for every type.
  void* data() const { return address_; }

 private:
  std::size_t size_;
  void* address_;
};

}  // namespace trunnion::storage
