// SPDX-License-Identifier: Apache-2.0
#include "retained_memory.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

#include "storage/file.hpp"

namespace trunnion::plc {
namespace {

// The file of the version before: two slots in one file, written in turn.
// It ended before the variables of Structured Text.
constexpr std::size_t old_memory = offsetof(Memory, program);
struct Slot {
  std::uint64_t sequence;
  std::uint64_t checksum;
  std::uint64_t version;
  char boot[64];
  unsigned char memory[old_memory];
};
constexpr std::uint64_t slot_version = (std::uint64_t{1} << 32) | old_memory;

// FNV-1a over 64-bit words.
std::uint64_t checksum_of(const Slot& slot) {
  static_assert(old_memory % 8 == 0 && sizeof(Memory) % 8 == 0);
  std::uint64_t hash = 14695981039346656037u ^ slot.sequence;
  const auto* bytes = reinterpret_cast<const char*>(slot.memory);
  for (std::size_t i = 0; i < old_memory; i += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes + i, 8);
    hash = (hash ^ word) * 1099511628211u;
  }
  return hash;
}

// Bytes of the content with so many cells of variables.
std::size_t size_with(std::size_t cells) {
  constexpr auto boot = sizeof(Slot::boot);
  return boot + (cells == 0 ? old_memory : sizeof(Memory) - (program_cells - cells) * sizeof(std::uint64_t));
}

std::string text_of(const char (&boot)[64]) { return {boot, strnlen(boot, sizeof boot)}; }

}  // namespace

RetainedMemory::RetainedMemory(const std::string& path, std::size_t cells)
    : files_(path, "plc", size_with(cells)), size_(size_with(cells)) {}

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
  Kept kept{text_of(newest->boot), {}};
  std::memcpy(static_cast<void*>(&kept.memory), newest->memory, old_memory);
  return kept;
}

RetainedMemory::Found RetainedMemory::load() const {
  if (auto old = of_format_0()) return {storage::KeptState::good, std::move(old), ""};
  auto found = files_.load();
  // Programs with other variables have written files of another size.
  if (found.content.empty() && found.state != storage::KeptState::absent)
    if (auto other = storage::RetainedPair::of_files(path(), "plc").load(); !other.content.empty())
      found = other;
  Found result{found.state, std::nullopt, found.problem};
  const auto size = found.content.size();
  if (size < size_with(0) || size > sizeof(Content)) return result;
  Content content{};
  std::memcpy(static_cast<void*>(&content), found.content.data(), size);
  auto& program = content.memory.program;
  if (program.cells > program_cells || size != size_with(program.cells)) program = {};
  result.kept = Kept{text_of(content.boot), content.memory};
  return result;
}

void RetainedMemory::save(const std::string& boot, const Memory& memory) {
  std::memset(content_.boot, 0, sizeof content_.boot);
  std::memcpy(content_.boot, boot.data(), std::min(boot.size(), sizeof content_.boot - 1));
  std::memcpy(static_cast<void*>(&content_.memory), &memory, size_ - sizeof content_.boot);
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(&content_), size_);
  if (files_.is_open()) {
    files_.save(bytes);
    return;
  }
  // Files of another size are put aside like damaged ones; what they kept was read.
  const bool other_size = load().state == storage::KeptState::good && files_.load().content.empty();
  files_.open(bytes);
  if (!other_size) return;
  for (const auto* suffix : {"", storage::previous_suffix})
    unlink((path() + suffix + storage::damaged_suffix).c_str());
}

}  // namespace trunnion::plc
