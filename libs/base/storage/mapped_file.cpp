// SPDX-License-Identifier: Apache-2.0
#include "storage/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "storage/file.hpp"

namespace trunnion::storage {

MappedFile::MappedFile(const std::string& path, std::size_t size) : size_(size), address_(MAP_FAILED) {
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  int reason = errno;
  if (file >= 0) {
    if (ftruncate(file, static_cast<off_t>(size)) == 0)
      address_ = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    reason = errno;
    close(file);
  }
  if (address_ == MAP_FAILED) throw StorageError(path + ": cannot be mapped: " + std::strerror(reason));
}

MappedFile::~MappedFile() { munmap(address_, size_); }

}  // namespace trunnion::storage
