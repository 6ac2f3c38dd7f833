// SPDX-License-Identifier: Apache-2.0
// Where a recording's bytes come from and go to: a file, or memory in tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace trunnion::recording {

using Bytes = std::vector<std::uint8_t>;

class Sink {
 public:
  virtual ~Sink() = default;
  /// Appends all of `bytes`; false when that is not possible, now and ever after.
  virtual bool write(std::span<const std::uint8_t> bytes) = 0;
};

class Source {
 public:
  virtual ~Source() = default;
  virtual std::uint64_t size() const = 0;
  /// Copies what there is from `offset` on, at most `out.size()` bytes; returns how many.
  virtual std::size_t read(std::uint64_t offset, std::span<std::uint8_t> out) = 0;
};

class MemorySink final : public Sink {
 public:
  bool write(std::span<const std::uint8_t> bytes) override {
    data.insert(data.end(), bytes.begin(), bytes.end());
    return true;
  }
  Bytes data;
};

/// Reads bytes that the caller keeps valid.
class MemorySource final : public Source {
 public:
  explicit MemorySource(std::span<const std::uint8_t> data) : data_(data) {}
  std::uint64_t size() const override { return data_.size(); }
  std::size_t read(std::uint64_t offset, std::span<std::uint8_t> out) override {
    if (offset >= data_.size() || out.empty()) return 0;
    const auto count = std::min<std::size_t>(out.size(), data_.size() - offset);
    std::memcpy(out.data(), data_.data() + offset, count);
    return count;
  }

 private:
  std::span<const std::uint8_t> data_;
};

}  // namespace trunnion::recording
