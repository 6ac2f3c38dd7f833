// SPDX-License-Identifier: Apache-2.0
#include "retained_memory.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <vector>

#include "storage/file.hpp"

namespace trunnion::plc {
namespace {

// What files of versions before kept in place of `Registers`; `Forces` followed nothing.
struct OldRegisters {
  std::uint8_t x[512], y[512], r[512];
  std::uint16_t f[512], g[512];
  std::int32_t b[512];
};
// Behind the registers: 256 timers of 16 bytes, 256 counters of 8 and 512 edges of the instruction lists,
// which are variables now.
constexpr std::size_t old_blocks = 256 * 16 + 256 * 8 + 512;
constexpr std::uint64_t layout_with_blocks = 2;
constexpr std::size_t behind_blocks = offsetof(Memory, forces) - offsetof(Memory, handshakes);
constexpr std::size_t old_memory = sizeof(OldRegisters) + old_blocks + behind_blocks;
constexpr std::size_t variables_header = offsetof(ProgramVariables, main);

// The memory of a version before; `bytes` ends before the variables of Structured Text or behind them.
// Inputs and outputs are not taken: other registers have their places.
Memory of_old(const unsigned char* bytes, std::size_t size) {
  Memory memory;
  OldRegisters registers;
  std::memcpy(&registers, bytes, sizeof registers);
  std::copy(std::begin(registers.b), std::end(registers.b), memory.registers.b.begin());
  std::memcpy(reinterpret_cast<unsigned char*>(&memory) + offsetof(Memory, handshakes),
              bytes + sizeof registers + old_blocks, behind_blocks);
  if (size < old_memory + variables_header) return memory;
  std::memcpy(static_cast<void*>(&memory.program), bytes + old_memory, variables_header);
  std::memcpy(memory.program.values.data(), bytes + old_memory + variables_header,
              std::min(size - old_memory - variables_header, sizeof memory.program.values));
  return memory;
}

// The oldest file: two slots in one file, written in turn.
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

// Cells for which a file has room: few changes of the programs change its size.
std::size_t room_for(std::size_t cells) {
  if (cells == 0) return 0;
  return std::min(std::bit_ceil(std::max<std::size_t>(cells, 256)), program_cells);
}

// Bytes of the content with room for so many cells of variables.
std::size_t size_with(std::size_t wanted) {
  const auto cells = room_for(wanted);
  constexpr auto before = offsetof(RetainedMemory::Content, memory);
  return before + (cells == 0 ? offsetof(Memory, program)
                              : sizeof(Memory) - (program_cells - cells) * sizeof(std::uint64_t));
}

template <std::size_t n>
std::string text_of(const char (&boot)[n]) {
  return {boot, strnlen(boot, n)};
}

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
  return Kept{"", of_old(newest->memory, old_memory)};
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
  constexpr auto before = offsetof(Content, memory);
  if (size < before + old_memory || size > sizeof(Content) + old_blocks) return result;
  Content content{};
  std::memcpy(static_cast<void*>(&content), found.content.data(), before);
  auto& program = content.memory.program;
  if (content.layout == 0) {  // of a version before: its outputs do not continue
    content.memory = of_old(found.content.data() + before, size - before);
    if (program.cells > program_cells ||
        (program.cells > 0 && size != before + old_memory + variables_header + program.cells * 8))
      program = {};
    result.kept = Kept{"", content.memory};
    return result;
  }
  auto& bytes = found.content;
  if (content.layout == layout_with_blocks && size >= size_with(0) + old_blocks) {
    const auto blocks = bytes.begin() + before + offsetof(Memory, handshakes);
    bytes.erase(blocks, blocks + old_blocks);
  } else if (content.layout != Content::own_layout || size < size_with(0) || size > sizeof(Content)) {
    return result;
  }
  std::memcpy(static_cast<void*>(&content), bytes.data(), bytes.size());
  if (program.cells > program_cells || bytes.size() != size_with(program.cells)) program = {};
  result.kept = Kept{text_of(content.boot), content.memory};
  return result;
}

std::span<const std::uint8_t> RetainedMemory::fill(const std::string& boot, const Memory& memory) {
  std::memset(content_.boot, 0, sizeof content_.boot);
  std::memcpy(content_.boot, boot.data(), std::min(boot.size(), sizeof content_.boot - 1));
  content_.layout = Content::own_layout;
  std::memcpy(static_cast<void*>(&content_.memory), &memory, size_ - offsetof(Content, memory));
  return {reinterpret_cast<const std::uint8_t*>(&content_), size_};
}

void RetainedMemory::resize(std::size_t cells, const std::string& boot, const Memory& memory) {
  if (size_with(cells) == size_) return;
  size_ = size_with(cells);
  const auto bytes = fill(boot, memory);
  const auto next = path() + ".next";
  for (const auto* suffix : {"", storage::previous_suffix}) unlink((next + suffix).c_str());
  storage::RetainedPair(next, "plc", size_).open(bytes);
  for (const auto* suffix : {storage::previous_suffix, ""})
    storage::rename_over(next + suffix, path() + suffix);
  files_ = storage::RetainedPair(path(), "plc", size_);
  files_.open(bytes);
}

void RetainedMemory::save(const std::string& boot, const Memory& memory) {
  const auto bytes = fill(boot, memory);
  if (files_.is_open()) {
    files_.save(bytes);
    return;
  }
  // Files of another size are put aside like damaged ones; what they kept was read.
  const bool other_size = load().state == storage::KeptState::good && files_.load().content.empty();
  files_.open(bytes);
  // Of a process that ended while it changed the size.
  for (const auto* suffix : {".next", ".next.new", ".next.previous", ".next.previous.new"})
    unlink((path() + suffix).c_str());
  if (!other_size) return;
  for (const auto* suffix : {"", storage::previous_suffix})
    unlink((path() + suffix + storage::damaged_suffix).c_str());
}

}  // namespace trunnion::plc
