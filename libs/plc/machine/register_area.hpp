// SPDX-License-Identifier: Apache-2.0
// The areas of PLC registers (HNC-8): sizes and how their cells are kept.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace trunnion::st {

enum class Area : std::uint8_t { x, y, f, g, r, b, w, d, t, c, k, p };

struct AreaInfo {
  char letter;
  int bits;        ///< of one register
  bool is_signed;  ///< of a whole register
  bool in_image;   ///< shared with the other tasks and services; others belong to the ST programs alone
  bool retained;   ///< through a new start
  const char* about;
};
inline constexpr std::uint32_t area_size = 512;  ///< registers of every area
inline constexpr std::array<AreaInfo, 12> areas = {{
    {'X', 8, false, true, false, "inputs"},
    {'Y', 8, false, true, false, "outputs"},
    {'F', 16, false, true, false, "from the NC"},
    {'G', 16, false, true, false, "to the NC"},
    {'R', 8, false, true, false, "relays"},
    {'B', 32, true, true, true, "kept registers"},
    {'W', 16, false, false, false, "words"},
    {'D', 32, true, false, false, "double words"},
    {'T', 32, true, false, false, "timers"},
    {'C', 32, true, false, true, "counters"},
    {'K', 8, false, false, true, "switches"},
    {'P', 32, true, false, true, "parameters of the machine builder"},
}};
inline constexpr std::uint32_t image_areas = 6;
/// The registers of the image are the first cells of the memory, area by area.
inline constexpr std::uint32_t image_cells = image_areas * area_size;

inline const AreaInfo& info(Area area) { return areas[static_cast<std::size_t>(area)]; }

struct RegisterAddress {
  Area area = Area::x;
  std::uint16_t index = 0;
  std::int8_t bit = -1;  ///< -1: the whole register
};

/// The decimal digits of a register's number or bit, at most four, so nothing overflows; nullopt for other
/// text.
std::optional<int> register_number(std::string_view text);

/// X0.3, G300, IX0.3 (= X), QX0.3 (= Y), MX0.3 (= R), IB5, QB5, MB5, MW7 (= W), MD7 (= D); capitals, without
/// percent sign. On failure `problem` says why.
std::optional<RegisterAddress> parse_register(std::string_view text, const char** problem);

/// A register of the image that a program uses. Its cell is `address_of`.
struct UsedRegister {
  Area area = Area::x;
  std::uint16_t index = 0;
  bool written = false;
  bool operator==(const UsedRegister&) const = default;
};
constexpr std::uint32_t address_of(Area area, std::uint32_t index) {
  return static_cast<std::uint32_t>(area) * area_size + index;
}

}  // namespace trunnion::st
