#include "directory_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace trunnion::program {
namespace {

[[noreturn]] void fail(const std::string& path, const char* what) {
  throw FileError(path + ": " + what + ": " + std::strerror(errno));
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : fd_(open(path.c_str(), flags | O_CLOEXEC, 0644)) {
    if (fd_ < 0) fail(path, "cannot be opened");
  }
  ~Descriptor() { close(fd_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

}  // namespace

std::vector<std::string> DirectoryFiles::list() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(directory_, error))
    if (entry.is_regular_file(error)) names.push_back(entry.path().filename().string());
  if (error) throw FileError(directory_ + ": cannot be listed: " + error.message());
  std::sort(names.begin(), names.end());
  return names;
}

std::size_t DirectoryFiles::read(const std::string& name, std::uint64_t offset,
                                 std::span<std::uint8_t> bytes) {
  const Descriptor file(path(name), O_RDONLY);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto n =
        pread(file.get(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path(name), "cannot be read");
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

void DirectoryFiles::create(const std::string& name) {
  const Descriptor file(path(name), O_WRONLY | O_CREAT | O_TRUNC);
}

void DirectoryFiles::append(const std::string& name, std::uint64_t offset,
                            std::span<const std::uint8_t> bytes) {
  const Descriptor file(path(name), O_WRONLY);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto n =
        pwrite(file.get(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const int reason = errno;
      static_cast<void>(ftruncate(file.get(), static_cast<off_t>(offset)) == 0);
      errno = reason;
      fail(path(name), "cannot be written");
    }
    done += static_cast<std::size_t>(n);
  }
}

void DirectoryFiles::publish(const std::string& from, const std::string& to) {
  {
    const Descriptor file(path(from), O_WRONLY);
    if (fsync(file.get()) != 0) fail(path(from), "cannot be synchronized");
  }
  if (std::rename(path(from).c_str(), path(to).c_str()) != 0) fail(path(to), "cannot be replaced");
  sync_directory();
}

void DirectoryFiles::remove(const std::string& name) {
  if (unlink(path(name).c_str()) != 0 && errno != ENOENT) fail(path(name), "cannot be removed");
  sync_directory();
}

void DirectoryFiles::sync_directory() const {
  const Descriptor directory(directory_, O_RDONLY | O_DIRECTORY);
  if (fsync(directory.get()) != 0) fail(directory_, "cannot be synchronized");
}

}  // namespace trunnion::program
