// SPDX-License-Identifier: Apache-2.0
#include "analysis/file_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace trunnion::analysis {

using language::ReadResult;
using language::ReadStatus;

FileSource::FileSource(const std::string& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) throw std::runtime_error(path + ": " + std::generic_category().message(errno));
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0 && S_ISDIR(status.st_mode)) {
    ::close(descriptor_);
    throw std::runtime_error(path + ": is a directory");
  }
}

FileSource::~FileSource() { ::close(descriptor_); }

ReadResult FileSource::read(std::uint64_t offset, char* buffer, std::size_t capacity) {
  ssize_t size = 0;
  do {
    size = ::pread(descriptor_, buffer, capacity, static_cast<off_t>(offset));
  } while (size < 0 && errno == EINTR);
  if (size < 0) return {ReadStatus::failed, 0};
  if (size == 0) return {ReadStatus::end, 0};
  return {ReadStatus::bytes, static_cast<std::size_t>(size)};
}

}  // namespace trunnion::analysis
