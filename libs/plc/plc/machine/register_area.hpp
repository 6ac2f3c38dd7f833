// SPDX-License-Identifier: Apache-2.0
// The areas of PLC registers (HNC-8): sizes and how their cells are kept. The image has all of them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trunnion::st {

enum class Area : std::uint8_t { x, y, f, g, r, b, w, d, t, c, k, p };

struct AreaInfo {
  char letter;
  int bits;             ///< of one register
  bool is_signed;       ///< of a whole register
  bool retained;        ///< through a new start
  std::uint32_t count;  ///< registers
  const char* about;
};
/// F and G: 32 axis blocks of 80 registers from 0, channels 0 to 4 of 80 from 2560, the whole machine from
/// 2960, channels 5 to 7 from 3120.
inline constexpr std::array<AreaInfo, 12> areas = {{
    {'X', 8, false, false, 512, "inputs"},
    {'Y', 8, false, false, 512, "outputs"},
    {'F', 16, false, false, 3360, "from the NC"},
    {'G', 16, false, false, 3360, "to the NC"},
    {'R', 8, false, false, 512, "relays"},
    {'B', 32, true, true, 512, "kept registers"},
    {'W', 16, false, false, 512, "words"},
    {'D', 32, true, false, 512, "double words"},
    {'T', 32, true, false, 512, "timers"},
    {'C', 32, true, true, 512, "counters"},
    {'K', 8, false, true, 512, "switches"},
    {'P', 32, true, true, 512, "parameters of the machine builder"},
}};

constexpr const AreaInfo& info(Area area) { return areas[static_cast<std::size_t>(area)]; }

/// The registers are the first cells of the memory, area by area: the cell of register 0.
constexpr std::uint32_t first_cell(std::size_t area) {
  std::uint32_t cell = 0;
  for (std::size_t i = 0; i < area; ++i) cell += areas[i].count;
  return cell;
}
inline constexpr std::uint32_t image_cells = first_cell(areas.size());

struct RegisterAddress {
  Area area = Area::x;
  std::uint16_t index = 0;
  std::int8_t bit = -1;  ///< -1: the whole register
  bool is_bit() const { return bit >= 0; }
  bool operator==(const RegisterAddress&) const = default;
};

/// The decimal digits of a register's number or bit, at most four, so nothing overflows; nullopt for other
/// text.
std::optional<int> register_number(std::string_view text);

/// X0.3, G300, IX0.3 (= X), QX0.3 (= Y), MX0.3 (= R), IB5, QB5, MB5, MW7 (= W), MD7 (= D); capitals, without
/// percent sign. On failure `problem` says why.
std::optional<RegisterAddress> parse_register(std::string_view text, const char** problem);

/// %X0.3, %G300
std::string register_text(const RegisterAddress& at);

/// A register of the image that a program uses. Its cell is `address_of`.
struct UsedRegister {
  Area area = Area::x;
  std::uint16_t index = 0;
  bool written = false;
  bool operator==(const UsedRegister&) const = default;
};
constexpr std::uint32_t address_of(Area area, std::uint32_t index) {
  return first_cell(static_cast<std::size_t>(area)) + index;
}
/// The register of a cell below image_cells.
constexpr RegisterAddress register_at(std::uint32_t cell) {
  std::size_t area = 0;
  while (cell >= areas[area].count) cell -= areas[area++].count;
  return {static_cast<Area>(area), static_cast<std::uint16_t>(cell), -1};
}

}  // namespace trunnion::st
