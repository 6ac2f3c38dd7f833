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
      return inside(Statement::begin_if) ? AlarmNumber::none : AlarmNumber::end_without_begin;
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

std::size_t OpenStructures::common(const OpenStructures& other) const {
  std::size_t count = 0;
  while (count < size_ && count < other.size_ && open_[count].begin.offset == other.open_[count].begin.offset)
    ++count;
  return count;
}

}  // namespace trunnion::language
