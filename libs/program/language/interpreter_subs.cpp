// SPDX-License-Identifier: Apache-2.0
// The part of Interpreter that carries out the O words of LinuxCNC: subroutines, break and continue.
#include <algorithm>
#include <charconv>

#include "language/interpreter.hpp"
#include "language/linuxcnc_codes.hpp"
#include "language/linuxcnc_line.hpp"

namespace trunnion::language {
namespace {

constexpr std::size_t most_parameters = 30;

}  // namespace

// #1 to #30 of the subroutine are its arguments, and 0 where there are less.
Interpreter::State Interpreter::call_sub(std::string_view line) {
  arguments_.clear();
  arguments_.absolute = executor_.modal().absolute;
  for (std::size_t i = 0; i < most_parameters; ++i)
    arguments_.values[i + 1] = i < block_.argument_count ? block_.arguments[i] : Value::of(0);
  // The number may be computed.
  const bool numbered = block_.name >> 32 == 1;
  char* const begin = file_.data();
  file_size_ =
      numbered ? static_cast<std::size_t>(
                     std::to_chars(begin, begin + file_.size(), static_cast<std::uint32_t>(block_.name)).ptr -
                     begin)
               : o_word_file(line.substr(block_.at), file_);
  Call call;
  call.kind = CallKind::subroutine;
  call.name = block_.name;
  call.offset = call.program_offset = block_.at;
  return this->call(call, line);
}

// A definition is passed, except by the call that has come to it.
Interpreter::State Interpreter::begin_sub(std::string_view line) {
  CallLevel& level = levels_[depth_];
  const Fault nested{AlarmNumber::linuxcnc_sub_nested, block_.at};
  if (depth_ == 0) return jump(Purpose::sub_end, block_.name, position_, nested, line);
  if (level.sub != block_.name || level.defined) return fail(nested, line);
  level.defined = true;
  return State::running;
}

Interpreter::State Interpreter::return_from_sub(std::string_view line) {
  const CallLevel& level = levels_[depth_];
  const bool ends = block_.statement == Statement::end_sub;
  if (level.sub == 0 || (ends && level.sub != block_.name))
    return fail({AlarmNumber::linuxcnc_sub_outside, block_.at}, line);
  const bool given = block_.argument_count != 0;
  variables_.names().set_returned(given, given ? block_.arguments[0].number : 0);
  return return_from_subprogram({}, line);
}

// Out of all structures in the loop. A WHILE is read again, a DO goes on at its own WHILE.
Interpreter::State Interpreter::leave_loop(std::string_view line) {
  CallLevel& level = levels_[depth_];
  const std::size_t index = level.open.find_loop(block_.name);
  if (index == level.open.size()) return fail({AlarmNumber::linuxcnc_loop_missing, block_.at}, line);
  const bool again = block_.statement == Statement::continue_loop;
  const Structure& loop = level.open.at(index);
  if (again && loop.kind == Statement::begin_while) {
    const TextPosition begin = loop.begin;
    level.open.cut(index, level.open.divided());
    reader_.seek(*level.source, begin);
    return State::running;
  }
  return jump(again ? Purpose::last : Purpose::end, block_.name, position_,
              {AlarmNumber::begin_without_end, block_.at}, line, index + 1);
}

Interpreter::State Interpreter::change_modes(std::string_view line) {
  KeptModes& kept = kept_modes_[depth_];
  switch (block_.label) {
    case forget_state_m:
      kept.valid = kept.returns = false;
      break;
    case restore_state_m: {
      if (!kept.valid) return fail({AlarmNumber::linuxcnc_modes_missing, block_.at}, line);
      const Fault fault = executor_.restore_modes(kept.modes, levels_[depth_].program, line_, queue_);
      if (fault) return fail({fault.number, block_.at, fault.detail}, line);
      break;
    }
    default:
      kept.modes = executor_.save_modes();
      kept.valid = true;
      kept.returns = kept.returns || block_.label == save_for_return_m;
      break;
  }
  return execute_rest(line);
}

Fault Interpreter::return_modes() {
  KeptModes& kept = kept_modes_[depth_];
  const bool due = kept.returns;
  kept.valid = kept.returns = false;
  return due ? executor_.restore_modes(kept.modes, levels_[depth_].program, line_, queue_) : Fault{};
}

// Behind a second % there is no program any more.
Interpreter::State Interpreter::search_sub(const Outline& outline, TextPosition position,
                                           std::string_view line) {
  if (outline.head == Head::tape_mark && search_.begun) return search_ended();
  search_.begun = search_.begun || line.find_first_not_of(" \t") != std::string_view::npos;
  if (search_.purpose == Purpose::sub) {
    if (outline.statement != Statement::begin_sub || outline.name != search_.wanted) return State::searching;
    return found(*search_.source, search_.program, position, search_.dialect);
  }
  if (outline.statement == Statement::begin_sub) return fail(not_found_);
  if (outline.statement != Statement::end_sub || outline.name != search_.wanted) return State::searching;
  const OpenStructures& open = levels_[depth_].open;
  const JumpCache::Target target{reader_.position(), open.size(), false, open.divided()};
  jumps_.store(search_.source, search_.from.offset, key(search_.purpose, search_.wanted), target);
  return arrive(target);
}

// Subroutines of the started program are those of its files, too.
Interpreter::State Interpreter::search_sub_elsewhere() {
  const CallLevel& started = levels_[0];
  if (search_.in_file) return fail(not_found_);
  search_.begun = false;
  if (search_.source != started.source) {
    search_.source = started.source;
    search_.dialect = started.dialect;
    search_.program = 0;
    reader_.seek(*search_.source, {});
    return State::searching;
  }
  search_.source = find_file();
  if (search_.source == nullptr) return fail(not_found_);
  search_.in_file = true;
  return read_head(*search_.source, search_.program, Heading::Then::search);
}

TextSource* Interpreter::find_file() {
  if (file_size_ == 0) return nullptr;
  const std::string_view name(file_.data(), file_size_);
  const auto number = o_word_program(name);
  if (number) {
    search_.program = *number;
    return environment_.subprogram(ProgramName(*number).view());
  }
  std::size_t index = 0;
  while (index < named_text_count_ && std::string_view(named_texts_[index].data()) != name) ++index;
  if (index == named_texts_.size()) return nullptr;
  TextSource* const source = environment_.subprogram(name);
  if (source == nullptr) return nullptr;
  if (index == named_text_count_) {
    named_texts_[index] = {};
    std::copy(name.begin(), name.end(), named_texts_[index].begin());
    ++named_text_count_;
  }
  search_.program = named_texts + static_cast<std::uint32_t>(index);
  return source;
}

FileName Interpreter::file_name(std::uint32_t program) const {
  const std::size_t index = program < named_texts ? named_text_count_ : program - named_texts;
  return index < named_text_count_ ? named_texts_[index] : FileName{};
}

}  // namespace trunnion::language
