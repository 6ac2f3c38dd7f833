// SPDX-License-Identifier: Apache-2.0
// Recordings in files.
#pragma once

#include <string>

#include "recording/byte_stream.hpp"

namespace trunnion::recording {

class FileSink final : public Sink {
 public:
  /// Creates or overwrites `path`. Throws std::runtime_error naming the path and the reason.
  explicit FileSink(std::string path);
  ~FileSink() override;
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;
  bool write(std::span<const std::uint8_t> bytes) override;
  /// Waits until the bytes are on the disk; false when they are not.
  bool sync();
  /// Why write or sync failed: one line that names the file; else empty.
  const std::string& problem() const { return problem_; }

 private:
  std::string path_, problem_;
  int file_;
};

class FileSource final : public Source {
 public:
  /// Throws std::runtime_error naming the path and the reason.
  explicit FileSource(const std::string& path);
  ~FileSource() override;
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;
  std::uint64_t size() const override { return size_; }
  std::size_t read(std::uint64_t offset, std::span<std::uint8_t> out) override;

 private:
  int file_;
  std::uint64_t size_ = 0;
};

}  // namespace trunnion::recording
