// SPDX-License-Identifier: Apache-2.0
#include "address.hpp"

#include <algorithm>
#include <limits>

#include "plc/machine/register_area.hpp"

namespace trunnion::plc {

int width(Area area) {
  switch (area) {
    case Area::f:
    case Area::g:
      return 16;
    case Area::b:
      return 32;
    default:
      return 8;
  }
}

std::optional<Address> parse_address(std::string_view text) {
  if (!text.empty() && text[0] == '%') text.remove_prefix(1);
  if (text.empty()) return std::nullopt;
  constexpr std::string_view areas = "XYFGRB";
  const auto area = areas.find(text[0]);
  if (area == std::string_view::npos) return std::nullopt;
  text.remove_prefix(1);
  const auto dot = text.find('.');
  const auto index = st::register_number(text.substr(0, dot));
  Address address{static_cast<Area>(area), 0, -1};
  if (!index || *index >= static_cast<int>(register_count)) return std::nullopt;
  address.index = static_cast<std::uint16_t>(*index);
  if (dot != std::string_view::npos) {
    const auto bit = st::register_number(text.substr(dot + 1));
    if (!bit || *bit >= width(address.area)) return std::nullopt;
    address.bit = static_cast<std::int8_t>(*bit);
  }
  return address;
}

std::int32_t load(const Registers& registers, Address a) {
  std::uint32_t value = 0;
  switch (a.area) {
    case Area::x:
      value = registers.x[a.index];
      break;
    case Area::y:
      value = registers.y[a.index];
      break;
    case Area::r:
      value = registers.r[a.index];
      break;
    case Area::f:
      value = registers.f[a.index];
      break;
    case Area::g:
      value = registers.g[a.index];
      break;
    case Area::b:
      value = static_cast<std::uint32_t>(registers.b[a.index]);
      break;
  }
  return a.is_bit() ? static_cast<std::int32_t>((value >> a.bit) & 1u) : static_cast<std::int32_t>(value);
}

namespace {

template <class T>
void put(T& target, Address a, std::int64_t value) {
  if (a.is_bit()) {
    const auto mask = std::uint32_t{1} << a.bit;
    const auto old = static_cast<std::uint32_t>(target);
    target = static_cast<T>(value != 0 ? old | mask : old & ~mask);
  } else {
    target = static_cast<T>(
        std::clamp<std::int64_t>(value, std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
  }
}

}  // namespace

void store(Registers& registers, Address a, std::int64_t value) {
  switch (a.area) {
    case Area::x:
      return put(registers.x[a.index], a, value);
    case Area::y:
      return put(registers.y[a.index], a, value);
    case Area::r:
      return put(registers.r[a.index], a, value);
    case Area::f:
      return put(registers.f[a.index], a, value);
    case Area::g:
      return put(registers.g[a.index], a, value);
    case Area::b:
      return put(registers.b[a.index], a, value);
  }
}

}  // namespace trunnion::plc
