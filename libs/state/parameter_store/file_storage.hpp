// SPDX-License-Identifier: Apache-2.0
// Storage in a directory, as kept texts (storage/kept_file.hpp). The journal and files that others write have
// neither checksum nor generations.
#pragma once

#include <map>

#include "parameter_store/storage.hpp"
#include "storage/kept_file.hpp"

namespace trunnion::parameters {

class FileStorage : public Storage {
 public:
  /// The directory must exist. `owner`: a damaged file whose previous generation is used is put aside and
  /// written again; otherwise nothing is changed by reading.
  explicit FileStorage(std::string directory, bool owner = false)
      : directory_(std::move(directory)), owner_(owner) {}

  std::optional<std::string> read(const std::string& name) override;
  void replace(const std::vector<NamedText>& files) override;
  std::uint64_t append(const std::string& name, const std::string& text) override;
  void truncate(const std::string& name, std::uint64_t size) override;

  std::string path(const std::string& name) const { return directory_ + "/" + name; }
  /// What reading has found damaged, by name.
  const std::map<std::string, storage::Kept>& damaged() const { return damaged_; }

 private:
  std::string directory_;
  bool owner_;
  std::map<std::string, storage::Kept> damaged_;
};

}  // namespace trunnion::parameters
