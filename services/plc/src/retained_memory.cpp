// SPDX-License-Identifier: Apache-2.0
#include "retained_memory.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace trunnion::plc {

struct RetainedMemory::Slot {
  std::uint64_t sequence;
  std::uint64_t checksum;
  std::uint64_t version;
  char boot[64];
  Memory memory;
};

struct RetainedMemory::Layout {
  Slot slots[2];
};

namespace {

constexpr std::uint64_t version = (std::uint64_t{1} << 32) | sizeof(Memory);

/// FNV-1a over 64-bit words: finds a slot that was half written when the power went.
template <class T>
std::uint64_t checksum(const T& value, std::uint64_t seed) {
  static_assert(sizeof(T) % 8 == 0);
  std::uint64_t hash = 14695981039346656037u ^ seed;
  const auto* bytes = reinterpret_cast<const char*>(&value);
  for (std::size_t i = 0; i < sizeof(T); i += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes + i, 8);
    hash = (hash ^ word) * 1099511628211u;
  }
  return hash;
}

}  // namespace

RetainedMemory::RetainedMemory(const std::string& path)
    : file_(path, sizeof(Layout)), layout_(static_cast<Layout*>(file_.data())) {}

std::optional<RetainedMemory::Kept> RetainedMemory::load() const {
  const Slot* newest = nullptr;
  for (const auto& slot : layout_->slots) {
    if (slot.version != version || slot.sequence == 0) continue;
    if (slot.checksum != checksum(slot.memory, slot.sequence)) continue;
    if (newest == nullptr || slot.sequence > newest->sequence) newest = &slot;
  }
  if (newest == nullptr) return std::nullopt;
  Kept kept;
  kept.boot.assign(newest->boot, strnlen(newest->boot, sizeof newest->boot));
  std::memcpy(&kept.memory, &newest->memory, sizeof(Memory));
  return kept;
}

void RetainedMemory::save(const std::string& boot, const Memory& memory) {
  auto& a = layout_->slots[0];
  auto& b = layout_->slots[1];
  const auto sequence = std::max(a.sequence, b.sequence) + 1;
  // A slot whose writer was killed is not whole, whatever its number: the other one must stay.
  const auto whole = [](const Slot& s) { return s.version == version ? s.sequence : 0; };
  auto& slot = whole(a) < whole(b) ? a : b;
  slot.version = 0;
  std::atomic_signal_fence(std::memory_order_seq_cst);
  std::memcpy(&slot.memory, &memory, sizeof(Memory));
  std::memset(slot.boot, 0, sizeof slot.boot);
  std::memcpy(slot.boot, boot.data(), std::min(boot.size(), sizeof slot.boot - 1));
  slot.sequence = sequence;
  slot.checksum = checksum(slot.memory, sequence);
  std::atomic_signal_fence(std::memory_order_seq_cst);
  slot.version = version;
}

}  // namespace trunnion::plc
