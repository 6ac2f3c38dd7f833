// SPDX-License-Identifier: Apache-2.0
#include "language/variables.hpp"

namespace trunnion::language {
namespace {

const VariableRange* system_range(double number) {
  for (const VariableRange& range : variable_ranges) {
    if (number >= range.first && number <= range.last) return &range;
  }
  return nullptr;
}

/// The variable is what the program itself has made of its position and its modal codes; N and O are not
/// among them.
bool is_own_state(const VariableRange& range, std::uint32_t index) {
  constexpr std::uint32_t modal_numbers = 200, sequence_number = 114, program_number = 115;
  switch (range.kind) {
    case VariableKind::block_end:
    case VariableKind::machine_position:
    case VariableKind::work_position:
    case VariableKind::active_length:
      return true;
    case VariableKind::modal: {
      const std::uint32_t word = (range.first + index) % modal_numbers;
      return word != sequence_number && word != program_number;
    }
    default:
      return false;
  }
}

/// Why a variable of Fanuc controls does not exist here.
AlarmNumber refusal(VariableKind kind) {
  switch (kind) {
    case VariableKind::setting:
      return AlarmNumber::settings_variable;
    case VariableKind::required_parts:
      return AlarmNumber::parts_required;
    case VariableKind::servo_deviation:
      return AlarmNumber::servo_deviation_unknown;
    default:
      return AlarmNumber::none;
  }
}

}  // namespace

void Variables::start(const VariableStore& store) {
  store_ = store;
  level_ = 0;
  system_reads_ = own_reads_ = 0;
  names_.start();
  written_count_ = 0;
  levels_[0].arguments.clear();
  levels_[0].values.fill({});
}

std::array<double, 9> Variables::skip_position() const {
  std::array<double, 9> position{};
  for (std::size_t i = 0; i < position.size(); ++i) position[i] = store_.skip[i].number;
  return position;
}

void Variables::set_skip_position(const std::array<double, 9>& position) {
  for (std::size_t i = 0; i < position.size(); ++i) store_.skip[i] = Value::of(position[i]);
}

void Variables::copy_to(VariableImage& image) const {
  image.store = store_;
  for (std::size_t i = 0; i <= level_; ++i) image.locals[i] = levels_[i].values;
  image.level = level_;
  image.names = names_.digest();
  image.system_reads = system_reads_;
  image.own_reads = own_reads_;
}

// The locals first: a loop counts in them most often.
bool Variables::same_as(const VariableImage& image) const {
  if (image.level != level_ || image.system_reads != system_reads_ || image.names != names_.digest())
    return false;
  for (std::size_t i = level_ + 1; i-- > 0;)
    if (image.locals[i] != levels_[i].values) return false;
  return image.store == store_;
}

void Variables::enter(const Arguments& arguments) {
  Level& level = levels_[++level_];
  level.arguments = arguments;
  level.values = arguments.values;
}

const Value* Variables::stored(double number) const {
  const auto in = [number](std::uint32_t first, const auto& values) -> const Value* {
    if (number < first || number >= first + values.size()) return nullptr;
    return &values[static_cast<std::size_t>(number) - first];
  };
  if (const Value* const value = in(50, store_.common)) return value;
  if (const Value* const value = in(500, store_.kept)) return value;
  if (const Value* const value = in(50000, store_.user)) return value;
  return in(900000, store_.extended);
}

AlarmNumber Variables::read_common(double number, Value& value) const {
  if (number_here_ != nullptr) number = number_here_(number);
  if (const Value* const found = stored(number)) {
    value = *found;
    return AlarmNumber::none;
  }
  const VariableRange* const range = system_range(number);
  if (range == nullptr) return AlarmNumber::variable_unknown;
  if (const AlarmNumber refused = refusal(range->kind); refused != AlarmNumber::none) return refused;
  const std::uint32_t index = static_cast<std::uint32_t>(number) - range->first;
  ++(is_own_state(*range, index) ? own_reads_ : system_reads_);
  return system_.read(*range, index, value);
}

AlarmNumber Variables::write(double number, Value value) {
  if (number < local_variables) {
    store(levels_[level_].values[static_cast<std::size_t>(number)], value);
    return AlarmNumber::none;
  }
  if (number_here_ != nullptr) number = number_here_(number);
  if (const Value* const found = stored(number)) {
    store(*const_cast<Value*>(found), value);  // our own store_, found through a const member
    return AlarmNumber::none;
  }
  const VariableRange* const range = system_range(number);
  if (range == nullptr) return AlarmNumber::variable_unknown;
  if (const AlarmNumber refused = refusal(range->kind); refused != AlarmNumber::none) return refused;
  if (!range->writable) return AlarmNumber::variable_read_only;
  return system_.write(*range, static_cast<std::uint32_t>(number) - range->first, value);
}

void Variables::store(Value& place, Value value) {
  if (written_count_ < written_.size()) written_[written_count_] = {&place, place};
  ++written_count_;
  place = value;
}

bool Variables::take_back() {
  if (written_count_ > written_.size()) return false;
  while (written_count_ > 0) {
    const Written& last = written_[--written_count_];
    *last.place = last.before;
  }
  return true;
}

AlarmNumber Variables::argument(double number, Value& value) const {
  if (number >= local_variables) return AlarmNumber::variable_unknown;
  const Arguments& arguments = levels_[level_].arguments;
  const bool given = arguments.values[static_cast<std::size_t>(number)].given;
  value = Value::of(!given ? 0 : arguments.absolute ? 90 : 91);
  return AlarmNumber::none;
}

}  // namespace trunnion::language
