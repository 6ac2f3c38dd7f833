// SPDX-License-Identifier: Apache-2.0
#include "address.hpp"

#include <algorithm>
#include <limits>

namespace trunnion::plc {

namespace {

// The register in the array of its area; each has its own type of number.
template <class Image, class Use>
auto with_register(Image& registers, Address a, Use use) {
  switch (a.area) {
    case Area::x:
      return use(registers.x[a.index]);
    case Area::y:
      return use(registers.y[a.index]);
    case Area::f:
      return use(registers.f[a.index]);
    case Area::g:
      return use(registers.g[a.index]);
    case Area::r:
      return use(registers.r[a.index]);
    case Area::b:
      return use(registers.b[a.index]);
    case Area::w:
      return use(registers.w[a.index]);
    case Area::d:
      return use(registers.d[a.index]);
    case Area::t:
      return use(registers.t[a.index]);
    case Area::c:
      return use(registers.c[a.index]);
    case Area::k:
      return use(registers.k[a.index]);
    case Area::p:
      break;
  }
  return use(registers.p[a.index]);
}

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

std::int32_t load(const Registers& registers, Address a) {
  const auto value = with_register(registers, a, [](auto cell) { return static_cast<std::uint32_t>(cell); });
  return a.is_bit() ? static_cast<std::int32_t>((value >> a.bit) & 1u) : static_cast<std::int32_t>(value);
}

void store(Registers& registers, Address a, std::int64_t value) {
  with_register(registers, a, [&](auto& cell) { put(cell, a, value); });
}

}  // namespace trunnion::plc
