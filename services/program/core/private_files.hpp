// SPDX-License-Identifier: Apache-2.0
// A view of another process's directory: reads come from it, writes stay in memory.
#pragma once

#include <map>

#include "files.hpp"

namespace trunnion::program {

class PrivateFiles : public Files {
 public:
  /// `files` outlives this and is only read.
  explicit PrivateFiles(Files& files) : files_(files) {}

  std::vector<std::string> list() override;
  std::size_t read(const std::string& name, std::uint64_t offset, std::span<std::uint8_t> bytes) override;
  void create(const std::string& name) override { own_[name].emplace(); }
  void append(const std::string& name, std::uint64_t offset, std::span<const std::uint8_t> bytes) override;
  void publish(const std::string& from, const std::string& to) override;
  void remove(const std::string& name) override { own_[name].reset(); }
  storage::Kept read_kept(const std::string& name) override {
    return own_.contains(name) ? Files::read_kept(name) : files_.read_kept(name);
  }

 private:
  using Text = std::vector<std::uint8_t>;
  Text& text_of(const std::string& name);
  Files& files_;
  std::map<std::string, std::optional<Text>> own_;  ///< nothing: removed
};

}  // namespace trunnion::program
