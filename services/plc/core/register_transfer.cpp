// SPDX-License-Identifier: Apache-2.0
#include "register_transfer.hpp"

#include <algorithm>
#include <limits>

namespace trunnion::plc {
namespace {

/// Calls `use` with the array of each area, in the order of st::Area.
template <class Image, class Use>
void each_area(Image& image, Use use) {
  using enum st::Area;
  use(x, image.x), use(y, image.y), use(f, image.f), use(g, image.g), use(r, image.r), use(b, image.b);
  use(w, image.w), use(d, image.d), use(t, image.t), use(c, image.c), use(k, image.k), use(p, image.p);
}

}  // namespace

RegisterTransfer::RegisterTransfer(std::span<const st::UsedRegister> used) {
  for (const auto& one : used) {
    const auto area = static_cast<std::size_t>(one.area);
    const Place place{st::address_of(one.area, one.index), one.index};
    used_[area].push_back(place);
    if (one.written) written_[area].push_back(place);
  }
}

void RegisterTransfer::load(const Registers& registers, std::span<std::uint64_t> memory) const {
  each_area(registers, [&](st::Area area, const auto& values) {
    for (const auto& place : used_[static_cast<std::size_t>(area)])
      memory[place.cell] = static_cast<std::uint64_t>(std::int64_t{values[place.index]});
  });
}

void RegisterTransfer::store(std::span<const std::uint64_t> memory, Registers& registers) const {
  each_area(registers, [&](st::Area area, auto& values) {
    using Value = std::decay_t<decltype(values[0])>;
    for (const auto& place : written_[static_cast<std::size_t>(area)])
      values[place.index] = static_cast<Value>(
          std::clamp<std::int64_t>(static_cast<std::int64_t>(memory[place.cell]),
                                   std::numeric_limits<Value>::min(), std::numeric_limits<Value>::max()));
  });
}

}  // namespace trunnion::plc
