// SPDX-License-Identifier: Apache-2.0
#include "plc/machine/byte_code.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace trunnion::st {
namespace {

constexpr std::uint32_t mark = 0x32545354;  // "TST2"
constexpr std::uint32_t longest_name = 1000;

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::uint32_t>(values.size()));
    for (const auto& value : values) put(value);
  }
  void put(const Entry& entry) {
    put(static_cast<std::uint32_t>(entry.name.size()));
    bytes_.insert(bytes_.end(), entry.name.begin(), entry.name.end());
    put(entry.routine), put(entry.base), put(static_cast<std::uint8_t>(entry.is_test));
  }
  void put(const UsedRegister& used) {
    put(static_cast<std::uint8_t>(used.area)), put(used.index), put(static_cast<std::uint8_t>(used.written));
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  template <class T>
  bool get(T& value) {
    if (bytes_.size() - at_ < sizeof value) return false;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return true;
  }
  /// Every element takes at least one byte, so a wrong count allocates no more than the bytes there are.
  template <class T>
  bool get(std::vector<T>& values, std::uint32_t most) {
    std::uint32_t count = 0;
    if (!get(count) || count > most || count > bytes_.size() - at_) return false;
    values.resize(count);
    return std::all_of(values.begin(), values.end(), [&](T& value) { return get(value); });
  }
  bool get(Entry& entry) {
    std::uint32_t size = 0;
    std::uint8_t test = 0;
    if (!get(size) || size > longest_name || size > bytes_.size() - at_) return false;
    entry.name.assign(reinterpret_cast<const char*>(bytes_.data()) + at_, size);
    at_ += size;
    if (!get(entry.routine) || !get(entry.base) || !get(test)) return false;
    entry.is_test = test != 0;
    return true;
  }
  bool get(UsedRegister& used) {
    std::uint8_t area = 0, written = 0;
    if (!get(area) || !get(used.index) || !get(written) || area >= areas.size()) return false;
    used.area = static_cast<Area>(area);
    used.written = written != 0;
    return true;
  }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<std::uint8_t> encode(const ByteCode& code) {
  Writer writer;
  writer.put(mark);
  writer.put(code.code), writer.put(code.routines), writer.put(code.ranges), writer.put(code.assertions);
  writer.put(code.pointed);
  writer.put(code.entries), writer.put(code.initial), writer.put(code.timers), writer.put(code.retained);
  writer.put(code.registers);
  return writer.take();
}

std::optional<ByteCode> decode(std::span<const std::uint8_t> bytes) {
  Reader reader(bytes);
  ByteCode code;
  std::uint32_t found = 0;
  constexpr std::uint32_t most = 1u << 16;
  const bool good = reader.get(found) && found == mark && reader.get(code.code, most_instructions) &&
                    reader.get(code.routines, most) && reader.get(code.ranges, most) &&
                    reader.get(code.assertions, most) && reader.get(code.pointed, most_pointed) &&
                    reader.get(code.entries, most) && reader.get(code.initial, most_cells) &&
                    reader.get(code.timers, most_cells) && reader.get(code.retained, most_cells) &&
                    reader.get(code.registers, most) && reader.at_end();
  if (!good) return std::nullopt;
  return code;
}

Position ByteCode::place_of(std::uint32_t instruction) const {
  const auto after =
      std::upper_bound(lines.begin(), lines.end(), instruction,
                       [](std::uint32_t i, const LineEntry& entry) { return i < entry.instruction; });
  return after == lines.begin() ? Position{} : std::prev(after)->at;
}

std::uint64_t ByteCode::identity() const {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const auto byte : encode(*this)) hash = (hash ^ byte) * 1099511628211u;
  return hash;
}

}  // namespace trunnion::st
