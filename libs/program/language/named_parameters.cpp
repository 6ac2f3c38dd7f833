// SPDX-License-Identifier: Apache-2.0
#include "language/named_parameters.hpp"

#include <bit>

namespace trunnion::language {

void NamedParameters::start() {
  globals_.cut(0);
  locals_.cut(0);
  level_ = 0;
  levels_[0] = 0;
  set_returned(false, 0);
}

std::uint64_t NamedParameters::digest() const {
  const std::uint64_t result = std::bit_cast<std::uint64_t>(returned_) + (has_returned_ ? 1 : 0);
  return mixed(globals_.digest() ^ mixed(locals_.digest() ^ mixed(result)));
}

bool NamedParameters::Table::write(NameKey key, double value) {
  const std::size_t at = place(key);
  Slot& slot = slots_[at];
  if (slot.key == 0) {
    if (size_ == used_.size()) return false;
    used_[size_++] = static_cast<std::uint16_t>(at);
  } else {
    digest_ ^= trace(slot);
  }
  slot = {key, value};
  digest_ ^= trace(slot);
  return true;
}

void NamedParameters::Table::cut(std::size_t size) {
  while (size_ > size) {
    Slot& slot = slots_[used_[--size_]];
    digest_ ^= trace(slot);
    slot = Slot{};
  }
}

std::uint64_t NamedParameters::Table::trace(const Slot& slot) {
  return mixed(slot.key ^ mixed(std::bit_cast<std::uint64_t>(slot.value) + 1));
}

}  // namespace trunnion::language
