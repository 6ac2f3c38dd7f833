// SPDX-License-Identifier: Apache-2.0
#include "recording/file_stream.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace trunnion::recording {

FileSink::FileSink(std::string path)
    : path_(std::move(path)), file_(open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
  if (file_ < 0) throw std::runtime_error(path_ + ": " + std::strerror(errno));
}

FileSink::~FileSink() { close(file_); }

bool FileSink::write(std::span<const std::uint8_t> bytes) {
  while (problem_.empty() && !bytes.empty()) {
    const auto written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0)
      problem_ = path_ + ": " + std::strerror(written < 0 ? errno : ENOSPC);
    else
      bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return problem_.empty();
}

bool FileSink::sync() {
  // Pipes and terminals cannot be synchronized and need not be.
  if (problem_.empty() && fsync(file_) != 0 && errno != EINVAL && errno != EROFS)
    problem_ = path_ + ": " + std::strerror(errno);
  return problem_.empty();
}

FileSource::FileSource(const std::string& path) : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat status {};
  if (file_ < 0 || fstat(file_, &status) != 0 || S_ISDIR(status.st_mode)) {
    const std::string reason = std::strerror(file_ >= 0 && S_ISDIR(status.st_mode) ? EISDIR : errno);
    if (file_ >= 0) close(file_);
    throw std::runtime_error(path + ": " + reason);
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

FileSource::~FileSource() { close(file_); }

std::size_t FileSource::read(std::uint64_t offset, std::span<std::uint8_t> out) {
  std::size_t done = 0;
  while (done < out.size()) {
    const auto count = pread(file_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

}  // namespace trunnion::recording
