// SPDX-License-Identifier: Apache-2.0
#include "plc/machine/pointer.hpp"

#include <algorithm>

#include "plc/machine/arithmetic.hpp"

namespace trunnion::st {
namespace {

// From the lowest bit: address, entry of the table, offset with its sign, and the bit of NULL.
constexpr unsigned address_width = 20, entry_width = 15, offset_width = 28;
static_assert(most_cells == 1u << address_width && most_pointed == 1u << entry_width);
static_assert(address_width + entry_width + offset_width == 63);
constexpr std::int64_t farthest = (std::int64_t{1} << (offset_width - 1)) - 1;

constexpr std::uint64_t low_bits(std::uint64_t value, unsigned count) {
  return value & ((std::uint64_t{1} << count) - 1);
}

Fault fault_of(FaultKind kind, std::int64_t value = 0, std::int64_t low = 0, std::int64_t high = 0) {
  return {kind, 0, value, low, high};
}

/// What a pointer reaches.
struct Reached {
  Pointed variable;
  std::uint64_t address = 0, offset = 0;

  std::uint64_t element() const { return address + offset / variable.bytes * variable.cells; }
  bool begins_element() const { return offset % variable.bytes == 0; }
};

/// `bytes` from the pointer on are within the variable, and that is within the memory.
Fault reach(std::uint64_t pointer, std::span<const Pointed> table, std::size_t memory, std::uint64_t bytes,
            Reached& reached) {
  const auto entry = low_bits(pointer >> address_width, entry_width);
  if ((pointer & null_pointer) != 0 || entry >= table.size()) return fault_of(FaultKind::reference);
  reached.variable = table[entry];
  reached.address = pointer_address(pointer);
  const auto& variable = reached.variable;
  if (reached.address + std::uint64_t{variable.count} * variable.cells > memory)
    return fault_of(FaultKind::reference);
  const auto room = static_cast<std::int64_t>(std::uint64_t{variable.count} * variable.bytes);
  const auto first = pointer_offset(pointer), last = first + static_cast<std::int64_t>(bytes) - 1;
  if (first < 0 || last >= room) return fault_of(FaultKind::pointer, first < 0 ? first : last, 0, room - 1);
  reached.offset = static_cast<std::uint64_t>(first);
  return {};
}

/// The string that begins at a cell with its length.
class StringBytes {
 public:
  StringBytes(std::uint64_t* cells, std::uint32_t limit)
      : length_(cells), bytes_(reinterpret_cast<std::uint8_t*>(cells + 1)), limit_(limit) {}

  /// Behind the text there is a byte 0, behind that what was written there.
  std::uint8_t get(std::uint64_t at) const {
    return at == *length_ || at >= limit_ ? std::uint8_t{0} : bytes_[at];
  }
  bool put(std::uint64_t at, std::uint8_t byte) {
    if (at >= limit_) return byte == 0;
    bytes_[at] = byte;
    if (byte == 0) *length_ = std::min(*length_, at);
    if (byte != 0 && at == *length_) *length_ = end(at + 1);
    return true;
  }

 private:
  std::uint64_t end(std::uint64_t at) const {
    while (at < limit_ && bytes_[at] != 0) ++at;
    return at;
  }
  std::uint64_t* length_;
  std::uint8_t* bytes_;
  std::uint64_t limit_;
};

std::uint64_t read_bytes(const Reached& from, std::uint32_t count, std::span<std::uint64_t> memory) {
  std::uint64_t value = 0;
  auto reached = from;
  for (unsigned i = 0; i < count; ++i, ++reached.offset) {
    auto* cells = memory.data() + reached.element();
    const auto at = reached.offset % reached.variable.bytes;
    const auto byte = reached.variable.view == Pointed::View::string
                          ? StringBytes(cells, reached.variable.bytes - 1).get(at)
                          : low_bits(*cells >> (8 * at), 8);
    value |= std::uint64_t{byte} << (8 * i);
  }
  return value;
}

/// A cell has the form of its own type.
void put_number_byte(std::uint64_t& cell, std::uint64_t at, std::uint8_t byte, std::uint32_t form) {
  const auto shift = 8 * at;
  const auto value = (cell & ~(std::uint64_t{0xff} << shift)) | std::uint64_t{byte} << shift;
  cell = form == 1 ? std::uint64_t{byte != 0} : narrowed(value, form);
}

Fault write_bytes(const Reached& to, std::uint32_t count, std::uint64_t value,
                  std::span<std::uint64_t> memory) {
  auto reached = to;
  const auto& variable = reached.variable;
  for (unsigned i = 0; i < count; ++i, ++reached.offset) {
    auto* cells = memory.data() + reached.element();
    const auto at = reached.offset % variable.bytes;
    const auto byte = static_cast<std::uint8_t>(value >> (8 * i));
    if (variable.view == Pointed::View::number)
      put_number_byte(*cells, at, byte, variable.form);
    else if (!StringBytes(cells, variable.bytes - 1).put(at, byte))
      return fault_of(FaultKind::pointer, static_cast<std::int64_t>(reached.offset), 0,
                      static_cast<std::int64_t>(reached.offset) - 1);
  }
  return {};
}

}  // namespace

std::uint64_t pointer_cell(std::uint64_t address, std::uint32_t entry) {
  if (address >= most_cells) return null_pointer;
  return address | low_bits(entry, entry_width) << address_width;
}

std::uint64_t pointer_moved(std::uint64_t pointer, std::uint64_t bytes) {
  if ((pointer & null_pointer) != 0) return null_pointer;
  const auto offset =
      std::clamp(pointer_offset(pointer) + static_cast<std::int32_t>(bytes), -farthest, farthest);
  const auto kept = low_bits(pointer, address_width + entry_width);
  return kept | low_bits(static_cast<std::uint64_t>(offset), offset_width) << (address_width + entry_width);
}

std::uint64_t pointer_number(std::uint64_t pointer) {
  if ((pointer & null_pointer) != 0) return 0;
  const auto byte = std::int64_t{pointer_address(pointer)} * 8 + pointer_offset(pointer);
  return low_bits(static_cast<std::uint64_t>(byte), 32);
}

std::uint32_t pointer_address(std::uint64_t pointer) {
  return static_cast<std::uint32_t>(low_bits(pointer, address_width));
}

std::int64_t pointer_offset(std::uint64_t pointer) {
  // The bit of NULL is not part of it.
  return static_cast<std::int64_t>(pointer << 1) >> (64 - offset_width);
}

Fault use_pointer(const Instruction& in, std::span<const Pointed> table, std::span<std::uint64_t> memory,
                  std::uint64_t* frame) {
  const auto& wanted = table[static_cast<std::uint32_t>(in.c)];
  Reached reached;
  const auto size = std::uint64_t{wanted.count} * wanted.bytes;
  if (const auto fault = reach(frame[in.b], table, memory.size(), size, reached);
      fault.kind != FaultKind::none)
    return fault;
  const bool same = reached.variable.element == wanted.element && reached.begins_element();
  if (in.op == Op::point_cells) {
    if (!same) return fault_of(FaultKind::pointed_type);
    frame[in.a] = reached.element();
    return {};
  }
  if (same) {
    auto& cell = memory[reached.element()];
    if (in.op == Op::point_load)
      frame[in.a] = cell;
    else
      cell = frame[in.a];
    return {};
  }
  if (wanted.view != Pointed::View::number || reached.variable.view == Pointed::View::none)
    return fault_of(FaultKind::pointed_type);
  if (in.op == Op::point_save) return write_bytes(reached, wanted.bytes, frame[in.a], memory);
  const auto value = read_bytes(reached, wanted.bytes, memory);
  frame[in.a] = wanted.form == 1 ? std::uint64_t{value != 0} : narrowed(value, wanted.form);
  return {};
}

}  // namespace trunnion::st
