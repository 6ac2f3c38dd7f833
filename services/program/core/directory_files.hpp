// SPDX-License-Identifier: Apache-2.0
// The files of the program store in a directory of the disk.
#pragma once

#include "files.hpp"

namespace trunnion::program {

/// Files of one directory, which must exist.
class DirectoryFiles : public Files {
 public:
  explicit DirectoryFiles(std::string directory) : directory_(std::move(directory)) {}

  std::vector<std::string> list() override;
  std::size_t read(const std::string& name, std::uint64_t offset, std::span<std::uint8_t> bytes) override;
  void create(const std::string& name) override;
  void append(const std::string& name, std::uint64_t offset, std::span<const std::uint8_t> bytes) override;
  void publish(const std::string& from, const std::string& to) override;
  void remove(const std::string& name) override;
  storage::Kept read_kept(const std::string& name) override;
  void write_kept(const std::string& name, const std::string& text) override;

 private:
  std::string path(const std::string& name) const { return directory_ + "/" + name; }
  std::string directory_;
};

}  // namespace trunnion::program
