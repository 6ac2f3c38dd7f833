// SPDX-License-Identifier: Apache-2.0
#include "private_files.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace trunnion::program {

std::vector<std::string> PrivateFiles::list() {
  const auto there = files_.list();
  std::set<std::string> names(there.begin(), there.end());
  for (const auto& [name, text] : own_) {
    if (text)
      names.insert(name);
    else
      names.erase(name);
  }
  return {names.begin(), names.end()};
}

std::size_t PrivateFiles::read(const std::string& name, std::uint64_t offset, std::span<std::uint8_t> bytes) {
  const auto found = own_.find(name);
  if (found == own_.end()) return files_.read(name, offset, bytes);
  if (!found->second) throw StorageError(name + ": cannot be opened");
  const auto& text = *found->second;
  const auto from = std::min<std::size_t>(offset, text.size());
  const auto count = std::min(bytes.size(), text.size() - from);
  std::copy_n(text.begin() + static_cast<std::ptrdiff_t>(from), count, bytes.begin());
  return count;
}

void PrivateFiles::append(const std::string& name, std::uint64_t offset,
                          std::span<const std::uint8_t> bytes) {
  auto& text = text_of(name);
  text.resize(offset);
  text.insert(text.end(), bytes.begin(), bytes.end());
}

void PrivateFiles::publish(const std::string& from, const std::string& to) {
  auto text = std::move(text_of(from));
  own_[from].reset();
  own_[to] = std::move(text);
}

// Of a file that is not its own yet, a copy.
PrivateFiles::Text& PrivateFiles::text_of(const std::string& name) {
  auto& own = own_[name];
  if (own) return *own;
  own.emplace();
  std::uint8_t buffer[4096];
  for (std::size_t n = sizeof buffer; n == sizeof buffer;) {
    n = files_.read(name, own->size(), buffer);
    own->insert(own->end(), buffer, buffer + n);
  }
  return *own;
}

}  // namespace trunnion::program
