// SPDX-License-Identifier: Apache-2.0
#include "retained_memory.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "storage/file.hpp"

namespace trunnion::plc {
namespace {

// The file of the version before: two slots in one file, written in turn.
struct Slot {
  std::uint64_t sequence;
  std::uint64_t checksum;
  std::uint64_t version;
  char boot[64];
  Memory memory;
};
constexpr std::uint64_t slot_version = (std::uint64_t{1} << 32) | sizeof(Memory);

// FNV-1a over 64-bit words.
std::uint64_t checksum_of(const Slot& slot) {
  static_assert(sizeof(Memory) % 8 == 0);
  std::uint64_t hash = 14695981039346656037u ^ slot.sequence;
  const auto* bytes = reinterpret_cast<const char*>(&slot.memory);
  for (std::size_t i = 0; i < sizeof(Memory); i += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes + i, 8);
    hash = (hash ^ word) * 1099511628211u;
  }
  return hash;
}

std::string text_of(const char (&boot)[64]) { return {boot, strnlen(boot, sizeof boot)}; }

}  // namespace

RetainedMemory::RetainedMemory(const std::string& path) : files_(path, "plc", sizeof(Content)) {}

std::optional<RetainedMemory::Kept> RetainedMemory::of_format_0() const {
  if (access((path() + storage::previous_suffix).c_str(), F_OK) == 0 || access(path().c_str(), F_OK) != 0)
    return std::nullopt;
  const storage::File file(path(), O_RDONLY);
  if (file.size() != 2 * sizeof(Slot)) return std::nullopt;
  std::vector<Slot> slots(2);
  file.read(0, {reinterpret_cast<std::uint8_t*>(slots.data()), 2 * sizeof(Slot)});
  const Slot* newest = nullptr;
  for (const auto& slot : slots) {
    if (slot.version != slot_version || slot.sequence == 0 || slot.checksum != checksum_of(slot)) continue;
    if (newest == nullptr || slot.sequence > newest->sequence) newest = &slot;
  }
  if (newest == nullptr) return std::nullopt;
  return Kept{text_of(newest->boot), newest->memory};
}

RetainedMemory::Found RetainedMemory::load() const {
  if (auto old = of_format_0()) return {storage::KeptState::good, std::move(old), ""};
  const auto found = files_.load();
  Found result{found.state, std::nullopt, found.problem};
  if (found.content.size() != sizeof(Content)) return result;
  Content content;
  std::memcpy(&content, found.content.data(), sizeof content);
  result.kept = Kept{text_of(content.boot), content.memory};
  return result;
}

void RetainedMemory::save(const std::string& boot, const Memory& memory) {
  std::memset(content_.boot, 0, sizeof content_.boot);
  std::memcpy(content_.boot, boot.data(), std::min(boot.size(), sizeof content_.boot - 1));
  std::memcpy(&content_.memory, &memory, sizeof memory);
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(&content_), sizeof content_);
  if (files_.is_open())
    files_.save(bytes);
  else
    files_.open(bytes);
}

}  // namespace trunnion::plc
