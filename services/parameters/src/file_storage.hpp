// SPDX-License-Identifier: Apache-2.0
// Storage in a directory: temporary file, fsync, rename, fsync of the directory.
#pragma once

#include "storage.hpp"

namespace trunnion::parameters {

class FileStorage : public Storage {
 public:
  /// The directory must exist.
  explicit FileStorage(std::string directory) : directory_(std::move(directory)) {}

  std::optional<std::string> read(const std::string& name) override;
  void replace(const std::vector<NamedText>& files) override;
  std::uint64_t append(const std::string& name, const std::string& text) override;
  void truncate(const std::string& name, std::uint64_t size) override;

 private:
  std::string path(const std::string& name) const { return directory_ + "/" + name; }
  std::string directory_;
};

}  // namespace trunnion::parameters
