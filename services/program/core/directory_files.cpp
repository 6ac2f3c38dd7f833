// SPDX-License-Identifier: Apache-2.0
#include "directory_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "storage/kept_file.hpp"

namespace trunnion::program {

std::vector<std::string> DirectoryFiles::list() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(directory_, error))
    if (entry.is_regular_file(error)) names.push_back(entry.path().filename().string());
  if (error) throw StorageError(directory_ + ": cannot be listed: " + error.message());
  std::sort(names.begin(), names.end());
  return names;
}

std::size_t DirectoryFiles::read(const std::string& name, std::uint64_t offset,
                                 std::span<std::uint8_t> bytes) {
  return storage::File(path(name), O_RDONLY).read(offset, bytes);
}

void DirectoryFiles::create(const std::string& name) {
  const storage::File file(path(name), O_WRONLY | O_CREAT | O_TRUNC);
}

void DirectoryFiles::append(const std::string& name, std::uint64_t offset,
                            std::span<const std::uint8_t> bytes) {
  storage::File(path(name), O_WRONLY).append(offset, bytes);
}

void DirectoryFiles::publish(const std::string& from, const std::string& to) {
  storage::File(path(from), O_WRONLY).sync();
  storage::rename_over(path(from), path(to));
  storage::sync_directory(directory_);
}

void DirectoryFiles::remove(const std::string& name) {
  if (unlink(path(name).c_str()) != 0 && errno != ENOENT)
    throw StorageError(path(name) + ": cannot be removed: " + std::strerror(errno));
  storage::sync_directory(directory_);
}

storage::Kept DirectoryFiles::read_kept(const std::string& name) { return storage::read_kept(path(name)); }

void DirectoryFiles::write_kept(const std::string& name, const std::string& text) {
  storage::write_kept(path(name), text);
}

}  // namespace trunnion::program
