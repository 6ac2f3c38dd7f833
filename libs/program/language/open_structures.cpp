// SPDX-License-Identifier: Apache-2.0
#include "language/open_structures.hpp"

#include "language/name_key.hpp"

namespace trunnion::language {

AlarmNumber OpenStructures::pass(Statement statement, std::uint64_t key, TextPosition position) {
  bool fits = true;
  switch (meaning(statement, key)) {
    case Statement::none:
    case Statement::assignment:
    case Statement::go_to:
    case Statement::call_cycle:
    case Statement::print:
    case Statement::begin_sub:
    case Statement::end_sub:
    case Statement::return_sub:
    case Statement::call_sub:
    case Statement::break_loop:
    case Statement::continue_loop:
    case Statement::modal_state:
      return AlarmNumber::none;
    case Statement::begin_if:
    case Statement::begin_while:
    case Statement::begin_do:
    case Statement::begin_repeat:
    case Statement::begin_until:
      if (size_ == max_structures) return AlarmNumber::structure_too_deep;
      open_[size_++] = {statement, key, position, false, 0, {}};
      return AlarmNumber::none;
    case Statement::else_if:
    case Statement::else_:
      if (!ends(Statement::begin_if, key)) return AlarmNumber::end_without_begin;
      if (statement == Statement::else_) open_[size_ - 1].divided = true;
      return AlarmNumber::none;
    case Statement::end_if:
      fits = ends(Statement::begin_if, key);
      break;
    case Statement::end_while:
      fits = ends(Statement::begin_while, key);
      break;
    case Statement::end_do:
      fits = inside(Statement::begin_do) && top().key == key;
      break;
    case Statement::end_repeat:
      fits = ends(Statement::begin_repeat, key);
      break;
    case Statement::end_until:
      fits = ends(Statement::begin_until, key);
      break;
  }
  if (!fits) return AlarmNumber::end_without_begin;
  --size_;
  return AlarmNumber::none;
}

bool OpenStructures::runs_again(std::uint64_t key) {
  if (!ends(Statement::begin_repeat, key) || top().remaining == 0) return false;
  --open_[size_ - 1].remaining;
  return true;
}

std::uint64_t OpenStructures::repetitions() const {
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < size_; ++i)
    if (open_[i].kind == Statement::begin_repeat) all = mixed(all ^ (open_[i].remaining + 1));
  return all;
}

std::size_t OpenStructures::find_loop(std::uint64_t key) const {
  for (std::size_t i = size_; i-- > 0;) {
    const bool loop = open_[i].kind == Statement::begin_while || open_[i].kind == Statement::begin_until;
    if (loop && open_[i].key == key) return i;
  }
  return size_;
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
