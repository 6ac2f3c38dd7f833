// SPDX-License-Identifier: Apache-2.0
// A program file as the interpreter reads it: in pieces, so that memory does not grow with its length.
#pragma once

#include <string>
#include <string_view>

#include "language/text_source.hpp"

namespace trunnion::analysis {

class FileSource final : public language::TextSource {
 public:
  /// Throws std::runtime_error when the file cannot be opened or is a directory.
  explicit FileSource(const std::string& path);
  ~FileSource() override;
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;

  language::ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override;
  std::string_view name() const override {
    return std::string_view(path_).substr(path_.find_last_of('/') + 1);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace trunnion::analysis
