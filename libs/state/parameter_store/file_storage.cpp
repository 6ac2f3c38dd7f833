// SPDX-License-Identifier: Apache-2.0
#include "parameter_store/file_storage.hpp"

#include <fcntl.h>

namespace trunnion::parameters {
using storage::KeptState;

namespace {

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

std::optional<std::string> FileStorage::read(const std::string& name) {
  const auto kept = storage::read_kept(path(name));
  if (kept.state == KeptState::absent) return std::nullopt;
  if (kept.state != KeptState::good) damaged_.emplace(name, kept);
  if (kept.state == KeptState::unusable) return std::nullopt;
  if (owner_ && kept.state == KeptState::previous) storage::repair_kept(path(name), kept);
  return kept.content;
}

void FileStorage::replace(const std::vector<NamedText>& files) {
  std::size_t made = 0;
  try {
    for (const auto& file : files) {
      ++made;
      storage::prepare_kept(path(file.name), file.text);
    }
  } catch (const StorageError&) {
    for (std::size_t i = 0; i < made; ++i) storage::discard_kept(path(files[i].name));
    throw;
  }
  for (const auto& file : files) storage::publish_kept(path(file.name));
  storage::sync_directory(directory_);
}

std::uint64_t FileStorage::append(const std::string& name, const std::string& text) {
  storage::File out(path(name), O_WRONLY | O_CREAT);
  const auto size = out.size();
  try {
    out.append(size, bytes_of(text));
    out.sync();
  } catch (const StorageError&) {
    out.truncate(size);
    throw;
  }
  return size;
}

void FileStorage::truncate(const std::string& name, std::uint64_t size) {
  storage::File out(path(name), O_WRONLY);
  out.truncate(size);
  out.sync();
}

}  // namespace trunnion::parameters
