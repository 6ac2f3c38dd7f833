// SPDX-License-Identifier: Apache-2.0
// Files in memory, and what a client asks a program store for.
#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "files.hpp"
#include "program_store.hpp"
#include "storage/crc32.hpp"

namespace trunnion::program {

using idl::program::Operation;
using idl::program::ProgramReply;
using idl::program::ProgramRequest;

/// A disk that works.
class MemoryFiles : public Files {
 public:
  std::vector<std::string> list() override {
    std::vector<std::string> names;
    for (const auto& [name, text] : texts) names.push_back(name);
    return names;
  }
  std::size_t read(const std::string& name, std::uint64_t offset, std::span<std::uint8_t> bytes) override {
    largest_read = std::max(largest_read, bytes.size());
    const auto& text = texts.at(name);
    const auto n = offset < text.size() ? std::min<std::size_t>(bytes.size(), text.size() - offset) : 0;
    std::copy_n(text.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(offset, text.size())), n,
                bytes.begin());
    return n;
  }
  void create(const std::string& name) override { texts[name].clear(); }
  void append(const std::string& name, std::uint64_t offset, std::span<const std::uint8_t> bytes) override {
    texts.at(name).resize(offset);
    texts.at(name).append(bytes.begin(), bytes.end());
  }
  void publish(const std::string& from, const std::string& to) override {
    texts[to] = texts.at(from);
    texts.erase(from);
  }
  void remove(const std::string& name) override { texts.erase(name); }
  std::map<std::string, std::string> texts;
  std::size_t largest_read = 0;
};

inline ProgramRequest request(Operation operation, const std::string& name, std::uint64_t client = 1) {
  ProgramRequest r;
  r.client = client;
  r.operation = operation;
  r.name = name;
  return r;
}

inline ProgramReply upload(ProgramStore& store, const std::string& name, const std::string& text,
                           std::uint8_t role = 1) {
  if (auto reply = store.apply(request(Operation::BEGIN_UPLOAD, name), 0); !reply.accepted) return reply;
  for (std::size_t at = 0; at < text.size(); at += 7) {
    auto write = request(Operation::WRITE, name);
    write.offset = at;
    const auto piece = text.substr(at, 7);
    write.data.assign(piece.begin(), piece.end());
    if (auto reply = store.apply(write, 0); !reply.accepted) return reply;
  }
  auto commit = request(Operation::COMMIT_UPLOAD, name);
  commit.size = text.size();
  commit.crc32 = storage::crc32(text);
  commit.role = role;
  return store.apply(commit, 0);
}

}  // namespace trunnion::program
