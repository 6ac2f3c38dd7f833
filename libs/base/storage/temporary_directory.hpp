// SPDX-License-Identifier: Apache-2.0
// A directory that only this process's user can read and write, and that ends with the object.
#pragma once

#include <filesystem>
#include <string>

namespace trunnion::storage {

class TemporaryDirectory {
 public:
  /// In the directory for temporary files, under a name that nobody can foresee: `name`-XXXXXX. Throws
  /// StorageError.
  explicit TemporaryDirectory(const std::string& name);
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace trunnion::storage
