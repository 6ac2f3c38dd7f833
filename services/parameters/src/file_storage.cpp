// SPDX-License-Identifier: Apache-2.0
#include "file_storage.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

namespace trunnion::parameters {
namespace {

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

std::optional<std::string> FileStorage::read(const std::string& name) {
  if (access(path(name).c_str(), F_OK) != 0) return std::nullopt;
  std::ifstream in(path(name), std::ios::binary);
  if (!in) throw StorageError(path(name) + ": cannot be opened");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void FileStorage::replace(const std::vector<NamedText>& files) {
  std::size_t made = 0;
  try {
    for (const auto& file : files) {
      ++made;
      storage::File out(path(file.name) + ".new", O_WRONLY | O_CREAT | O_TRUNC);
      out.append(0, bytes_of(file.text));
      out.sync();
    }
  } catch (const StorageError&) {
    for (std::size_t i = 0; i < made; ++i) unlink((path(files[i].name) + ".new").c_str());
    throw;
  }
  for (const auto& file : files) storage::rename_over(path(file.name) + ".new", path(file.name));
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
