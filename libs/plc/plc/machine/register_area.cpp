// SPDX-License-Identifier: Apache-2.0
#include "plc/machine/register_area.hpp"

#include <algorithm>

namespace trunnion::st {

std::optional<int> register_number(std::string_view text) {
  if (text.empty() || text.size() > 4) return std::nullopt;
  int value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + (c - '0');
  }
  return value;
}

std::optional<RegisterAddress> parse_register(std::string_view text, const char** problem) {
  const auto refuse = [&](const char* why) {
    if (problem != nullptr) *problem = why;
    return std::nullopt;
  };
  if (text.size() < 2) return refuse("an address is an area, a number and perhaps a bit: %X0.3, %G300");
  char letter = text[0];
  char size = '\0';
  text.remove_prefix(1);
  if (letter == 'I' || letter == 'Q' || letter == 'M') {
    if (text[0] < '0' || text[0] > '9') {
      size = text[0];
      text.remove_prefix(1);
    } else {
      size = 'X';
    }
    const bool small = size == 'X' || size == 'B';
    if (letter == 'I' && small)
      letter = 'X';
    else if (letter == 'Q' && small)
      letter = 'Y';
    else if (letter == 'M' && small)
      letter = 'R';
    else if (letter == 'M' && (size == 'W' || size == 'D'))
      letter = size;
    else
      return refuse(
          "inputs %I and outputs %Q are bits (%IX0.3) and bytes (%IB0); markers %M also %MW and %MD");
  }
  const auto found =
      std::find_if(areas.begin(), areas.end(), [&](const auto& a) { return a.letter == letter; });
  if (found == areas.end()) return refuse("the areas are X Y F G R B W D T C K P, and I Q M of the standard");
  const auto dot = text.find('.');
  const auto index = register_number(text.substr(0, dot));
  RegisterAddress address{static_cast<Area>(found - areas.begin()), 0, -1};
  if (!index || *index >= static_cast<int>(found->count))
    return refuse(found->count == 512 ? "the number is outside 0 .. 511" : "the number is outside 0 .. 3359");
  address.index = static_cast<std::uint16_t>(*index);
  if (dot != std::string_view::npos) {
    if (size != '\0' && size != 'X') return refuse("a bit is addressed with X: %IX0.3");
    const auto bit = register_number(text.substr(dot + 1));
    if (!bit || *bit >= found->bits)
      return refuse(found->bits == 8    ? "the bit is outside 0 .. 7"
                    : found->bits == 16 ? "the bit is outside 0 .. 15"
                                        : "the bit is outside 0 .. 31");
    address.bit = static_cast<std::int8_t>(*bit);
  } else if (size == 'X') {
    return refuse("the bit is missing: %IX0.3");
  }
  return address;
}

std::string register_text(const RegisterAddress& at) {
  return std::string("%") + info(at.area).letter + std::to_string(at.index) +
         (at.is_bit() ? "." + std::to_string(at.bit) : "");
}

}  // namespace trunnion::st
