#include "file_storage.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

namespace trunnion::parameters {
namespace {

[[noreturn]] void fail(const std::string& path, const char* what) {
  throw StorageError(path + ": " + what + ": " + std::strerror(errno));
}

/// A file descriptor that closes itself.
class File {
 public:
  File(const std::string& path, int flags) : path_(path), fd_(open(path.c_str(), flags | O_CLOEXEC, 0644)) {
    if (fd_ < 0) fail(path_, "cannot be opened");
  }
  ~File() { close(fd_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  void write(const std::string& text) {
    std::size_t at = 0;
    while (at < text.size()) {
      const auto n = ::write(fd_, text.data() + at, text.size() - at);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail(path_, "cannot be written");
      at += static_cast<std::size_t>(n);
    }
  }
  void sync() {
    if (fsync(fd_) != 0) fail(path_, "cannot be synchronized");
  }
  void truncate(std::uint64_t size) {
    if (ftruncate(fd_, static_cast<off_t>(size)) != 0) fail(path_, "cannot be cut");
  }
  std::uint64_t size() const {
    struct stat status {};
    if (fstat(fd_, &status) != 0) fail(path_, "has no size");
    return static_cast<std::uint64_t>(status.st_size);
  }

 private:
  std::string path_;
  int fd_;
};

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
      File out(path(file.name) + ".new", O_WRONLY | O_CREAT | O_TRUNC);
      out.write(file.text);
      out.sync();
    }
  } catch (const StorageError&) {
    for (std::size_t i = 0; i < made; ++i) unlink((path(files[i].name) + ".new").c_str());
    throw;
  }
  for (const auto& file : files)
    if (std::rename((path(file.name) + ".new").c_str(), path(file.name).c_str()) != 0)
      fail(path(file.name), "cannot be replaced");
  sync_directory();
}

std::uint64_t FileStorage::append(const std::string& name, const std::string& text) {
  File out(path(name), O_WRONLY | O_CREAT | O_APPEND);
  const auto size = out.size();
  try {
    out.write(text);
    out.sync();
  } catch (const StorageError&) {
    out.truncate(size);
    throw;
  }
  return size;
}

void FileStorage::truncate(const std::string& name, std::uint64_t size) {
  File out(path(name), O_WRONLY);
  out.truncate(size);
  out.sync();
}

void FileStorage::sync_directory() const {
  File directory(directory_, O_RDONLY | O_DIRECTORY);
  directory.sync();
}

}  // namespace trunnion::parameters
