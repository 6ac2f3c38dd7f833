// SPDX-License-Identifier: Apache-2.0
#include "parameter_store/private_storage.hpp"

namespace trunnion::parameters {

std::optional<std::string> PrivateStorage::read(const std::string& name) {
  const auto found = written_.find(name);
  return found != written_.end() ? found->second : files_.read(name);
}

void PrivateStorage::replace(const std::vector<NamedText>& files) {
  for (const auto& file : files) written_[file.name] = file.text;
}

std::uint64_t PrivateStorage::append(const std::string& name, const std::string& text) {
  std::string whole = read(name).value_or("");
  const auto size = whole.size();
  written_[name] = whole + text;
  return size;
}

void PrivateStorage::truncate(const std::string& name, std::uint64_t size) {
  std::string whole = read(name).value_or("");
  whole.resize(size);
  written_[name] = whole;
}

}  // namespace trunnion::parameters
