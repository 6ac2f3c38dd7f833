// SPDX-License-Identifier: Apache-2.0
#include "cluster_side/alarm_file.hpp"

#include <fcntl.h>

#include <fstream>
#include <iterator>

#include "storage/file.hpp"

namespace trunnion::gateway {

std::string AlarmFile::read() const {
  std::ifstream file(path_, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void AlarmFile::append(const std::string& lines) {
  try {
    storage::File file(path_, O_WRONLY | O_CREAT | O_CLOEXEC);
    file.append(file.size(), {reinterpret_cast<const std::uint8_t*>(lines.data()), lines.size()});
    failed_ = false;
  } catch (const storage::StorageError&) {
    failed_ = true;
  }
}

void AlarmFile::replace(const std::string& lines) {
  try {
    storage::replace_file(path_, lines);
    failed_ = false;
  } catch (const storage::StorageError&) {
    failed_ = true;
  }
}

}  // namespace trunnion::gateway
