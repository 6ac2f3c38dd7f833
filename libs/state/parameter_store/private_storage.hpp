// SPDX-License-Identifier: Apache-2.0
// What another process's storage would become: everything is read from it, nothing is written to it.
#pragma once

#include <map>

#include "parameter_store/storage.hpp"

namespace trunnion::parameters {

class PrivateStorage : public Storage {
 public:
  /// `files` outlives this and is only read.
  explicit PrivateStorage(Storage& files) : files_(files) {}

  std::optional<std::string> read(const std::string& name) override;
  void replace(const std::vector<NamedText>& files) override;
  std::uint64_t append(const std::string& name, const std::string& text) override;
  void truncate(const std::string& name, std::uint64_t size) override;

 private:
  Storage& files_;
  std::map<std::string, std::string> written_;
};

}  // namespace trunnion::parameters
