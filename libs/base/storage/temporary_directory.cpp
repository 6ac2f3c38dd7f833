// SPDX-License-Identifier: Apache-2.0
#include "storage/temporary_directory.hpp"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "storage/file.hpp"

namespace trunnion::storage {

TemporaryDirectory::TemporaryDirectory(const std::string& name) {
  auto path = (std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string();
  if (mkdtemp(path.data()) == nullptr) throw StorageError(path + ": cannot be made: " + std::strerror(errno));
  path_ = path;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace trunnion::storage
