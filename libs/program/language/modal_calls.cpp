// SPDX-License-Identifier: Apache-2.0
#include "language/modal_calls.hpp"

#include <algorithm>

namespace trunnion::language {

bool ModalCalls::add(const Call& call, const Arguments& arguments) {
  if (count_ == most) return false;
  const auto place = entries_.begin() + static_cast<std::ptrdiff_t>(usable_);
  std::copy_backward(place, entries_.begin() + static_cast<std::ptrdiff_t>(count_),
                     entries_.begin() + static_cast<std::ptrdiff_t>(count_ + 1));
  *place = {call, arguments};
  ++count_, ++usable_;
  return true;
}

void ModalCalls::remove() {
  if (usable_ == 0) return;
  std::copy(entries_.begin() + static_cast<std::ptrdiff_t>(usable_),
            entries_.begin() + static_cast<std::ptrdiff_t>(count_),
            entries_.begin() + static_cast<std::ptrdiff_t>(usable_ - 1));
  --count_, --usable_;
}

std::size_t ModalCalls::enter() {
  const std::size_t above = count_ - usable_;
  --usable_;
  return above;
}

}  // namespace trunnion::language
