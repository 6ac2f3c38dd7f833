// SPDX-License-Identifier: Apache-2.0
#include "storage/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace trunnion::storage {
namespace {

[[noreturn]] void fail(const std::string& path, const char* what) {
  throw StorageError(path + ": " + what + ": " + std::strerror(errno));
}

}  // namespace

File::File(std::string path, int flags)
    : path_(std::move(path)), descriptor_(open(path_.c_str(), flags | O_CLOEXEC, 0644)) {
  if (descriptor_ < 0) fail(path_, "cannot be opened");
}

File::~File() { close(descriptor_); }

std::size_t File::read(std::uint64_t offset, std::span<std::uint8_t> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto n =
        pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path_, "cannot be read");
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

void File::append(std::uint64_t end, std::span<const std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto n =
        pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(end + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const int reason = errno;
      static_cast<void>(ftruncate(descriptor_, static_cast<off_t>(end)) == 0);
      errno = reason;
      fail(path_, "cannot be written");
    }
    done += static_cast<std::size_t>(n);
  }
}

void File::truncate(std::uint64_t size) {
  if (ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail(path_, "cannot be cut");
}

void File::sync() {
  if (fsync(descriptor_) != 0) fail(path_, "cannot be synchronized");
}

std::uint64_t File::size() const {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) fail(path_, "has no size");
  return static_cast<std::uint64_t>(status.st_size);
}

void rename_over(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) fail(to, "cannot be replaced");
}

void sync_directory(const std::string& directory) { File(directory, O_RDONLY | O_DIRECTORY).sync(); }

void replace_file(const std::string& path, const std::string& text) {
  const std::string fresh = path + ".new";
  try {
    File out(fresh, O_WRONLY | O_CREAT | O_TRUNC);
    out.append(0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    out.sync();
  } catch (const StorageError&) {
    unlink(fresh.c_str());
    throw;
  }
  rename_over(fresh, path);
  const auto slash = path.rfind('/');
  sync_directory(slash == std::string::npos ? "." : path.substr(0, slash));
}

}  // namespace trunnion::storage
