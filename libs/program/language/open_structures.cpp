// SPDX-License-Identifier: Apache-2.0
#include "language/open_structures.hpp"

namespace trunnion::language {

AlarmNumber OpenStructures::pass(Statement statement, std::uint32_t label, TextPosition position) {
  bool fits = true;
  switch (statement) {
    case Statement::none:
    case Statement::assignment:
    case Statement::go_to:
    case Statement::call_cycle:
      return AlarmNumber::none;
    case Statement::begin_if:
    case Statement::begin_while:
    case Statement::begin_do:
      if (size_ == max_structures) return AlarmNumber::structure_too_deep;
      open_[size_++] = {statement, label, position};
      return AlarmNumber::none;
    case Statement::else_if:
    case Statement::else_:
      if (!inside(Statement::begin_if)) return AlarmNumber::end_without_begin;
      if (statement == Statement::else_) open_[size_ - 1].divided = true;
      return AlarmNumber::none;
    case Statement::end_if:
      fits = inside(Statement::begin_if);
      break;
    case Statement::end_while:
      fits = inside(Statement::begin_while);
      break;
    case Statement::end_do:
      fits = inside(Statement::begin_do) && top().label == label;
      break;
  }
  if (!fits) return AlarmNumber::end_without_begin;
  --size_;
  return AlarmNumber::none;
}

void OpenStructures::cut(std::size_t size, std::uint16_t divided) {
  size_ = size;
  for (std::size_t i = 0; i < size; ++i) open_[i].divided = ((divided >> i) & 1u) != 0;
}

std::uint16_t OpenStructures::divided() const {
  static_assert(max_structures <= 16);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < size_; ++i) bits |= open_[i].divided ? 1u << i : 0u;
  return static_cast<std::uint16_t>(bits);
}

std::size_t OpenStructures::common(const OpenStructures& other) const {
  std::size_t count = 0;
  while (count < size_ && count < other.size_ && open_[count].begin.offset == other.open_[count].begin.offset)
    ++count;
  return count;
}

}  // namespace trunnion::language
