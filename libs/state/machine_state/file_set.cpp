// SPDX-License-Identifier: Apache-2.0
#include "machine_state/file_set.hpp"

#include <fcntl.h>

#include <filesystem>
#include <set>

#include "storage/file.hpp"

namespace trunnion::machine_state {
namespace fs = std::filesystem;

std::string read_file(const std::string& path) {
  const storage::File file(path, O_RDONLY);
  std::string bytes(file.size(), '\0');
  bytes.resize(file.read(0, {reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size()}));
  return bytes;
}

void write_files(const std::string& directory, const FileSet& files) {
  fs::remove_all(directory);
  fs::create_directories(directory);
  std::set<fs::path> folders{directory};
  for (const auto& [name, bytes] : files) {
    const auto path = fs::path(directory) / name;
    fs::create_directories(path.parent_path());
    for (auto folder = path.parent_path(); folders.insert(folder).second;) folder = folder.parent_path();
    storage::File file(path.string(), O_WRONLY | O_CREAT | O_EXCL);
    file.append(0, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    file.sync();
  }
  for (const auto& folder : folders) storage::sync_directory(folder.string());
}

}  // namespace trunnion::machine_state
