// SPDX-License-Identifier: Apache-2.0
#include "language/table_codes.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint32_t highest_parameter = 999999;

}  // namespace

Fault TableCodes::check() const {
  constexpr std::uint32_t parameter_words = letter_bits("NPR");
  if (state_.parameter_input && !words_.g().is(Group::one_block, 110) &&
      (words_.has_codes() || (words_.letters() & ~parameter_words) != 0)) {
    return {AlarmNumber::parameter_line, words_.first_offset()};
  }
  return {};
}

Fault TableCodes::end_parameter_input(std::uint16_t) {
  state_.parameter_input = false;
  return {};
}

Fault TableCodes::change_table(std::uint16_t at) {
  if (!words_.has('L')) return define_tool(at);
  std::uint32_t l = 0;
  if (const Fault fault = words_.whole_number('L', 1, 50, l)) return fault;
  if (l == 1) l = 11;  // of older controls
  switch (l) {
    case 2:
    case 20:
      return change_work_offset(at, l);
    case 23:
      return change_setting_error(at);
    case 10:
    case 11:
    case 12:
    case 13:
      return change_tool(at, l);
    case 50:
      if (words_.has('P') || words_.has('R')) return change_parameter('P');
      state_.parameter_input = true;
      return {};
    default:
      return {AlarmNumber::value_range, words_.offset('L')};
  }
}

Fault TableCodes::change_work_offset(std::uint16_t at, std::uint32_t l) {
  if (!words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  std::uint32_t number = 0;
  const bool basic = l == 2;
  if (Fault fault = words_.whole_number('P', basic ? 0 : 1, basic ? 6 : work_offset_count - 6, number)) {
    if (!basic && fault.number == AlarmNumber::value_range) fault.detail = additional_work_offsets;
    return fault;
  }
  if (basic && number == 0) number = external_work_offset + 1;
  const auto index = static_cast<std::uint8_t>(basic ? number - 1 : number + 5);
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  if (acts(index)) {
    if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  }
  AxisValues values = tables_.work_offset(index);
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    // Tables hold radii, so a diameter means nothing here.
    const double word = words_.value(axis_letters[axis]) * (is_rotary(axis) ? 1.0 : words_.length_scale());
    values[axis] = state_.modal.absolute ? word : values[axis] + word;
  }
  store_work_offset(index, values);
  return {};
}

// The letters A B C are angles here, whatever axes the channel has.
Fault TableCodes::change_setting_error(std::uint16_t at) {
  if (!words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  std::uint32_t number = 0;
  if (const Fault fault = words_.whole_number('P', 1, setting_error_count, number)) return fault;
  const auto index = static_cast<std::uint8_t>(external_work_offset + number);
  if (acts(index)) {
    if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  }
  AxisValues values = tables_.work_offset(index);
  bool named = false;
  for (const Axis axis : {X, Y, Z, A, B, C}) {
    const char letter = axis_letters[axis];
    if (!words_.has(letter)) continue;
    words_.use(letter);
    named = true;
    const double word = words_.value(letter) * (is_rotary(axis) ? 1.0 : words_.length_scale());
    values[axis] = state_.modal.absolute ? word : values[axis] + word;
  }
  if (!named) return {AlarmNumber::missing_word, at, "needs X, Y, Z, A, B or C"};
  store_work_offset(index, values);
  return {};
}

void TableCodes::store_work_offset(std::uint8_t index, const AxisValues& values) {
  tables_.set_work_offset(index, values);
  if (acts(index)) {
    const std::uint8_t error = state_.frame().setting_error().number;
    state_.change_frame().set_work_offset(tables_.workpiece_zero(state_.modal.work_offset));
    if (error != 0) state_.change_frame().set_setting_error(error, tables_.setting_error(error));
    state_.locate(state_.position);
  }
  Command& command = output_.push(CommandKind::table);
  command.table = Table::work_offset;
  command.number = index;
  command.target = values;
}

Fault TableCodes::write_work_offset(std::uint8_t index, std::size_t axis, double value) {
  if (acts(index)) {
    if (const Fault fault = output_.refuse_in_compensation(0)) return fault;
  }
  AxisValues values = tables_.work_offset(index);
  values[axis] = value;
  store_work_offset(index, values);
  return output_.settle();
}

Fault TableCodes::change_tool(std::uint16_t at, std::uint32_t l) {
  for (const char letter : {'P', 'R'}) {
    if (!words_.has(letter)) return {AlarmNumber::missing_word, at, needs(letter)};
  }
  std::uint32_t number = 0;
  if (const Fault fault = words_.whole_number('P', 1, highest_tool, number)) return fault;
  const Table table = l == 10   ? Table::tool_length
                      : l == 11 ? Table::tool_length_wear
                      : l == 12 ? Table::tool_radius
                                : Table::tool_radius_wear;
  const double scale = l == 12 || l == 13 ? words_.radius_scale() : 1.0;
  return store_tool(table, static_cast<std::uint16_t>(number), scale * words_.length('R'),
                    !state_.modal.absolute, words_.offset('P'));
}

Fault TableCodes::store_tool(Table table, std::uint16_t number, double value, bool adds, std::uint16_t at) {
  const auto entry = tables_.tool(number);
  // A length or a radius makes an entry; wear or a change needs one.
  const bool makes = !adds && (table == Table::tool_length || table == Table::tool_radius);
  if (!entry && !makes) return {AlarmNumber::tool_undefined, at};
  ToolOffset tool = entry.value_or(ToolOffset{});
  if (!tool.radius) tool.radius = 0;
  double& place = table == Table::tool_length        ? tool.length
                  : table == Table::tool_length_wear ? tool.length_wear
                  : table == Table::tool_radius      ? *tool.radius
                                                     : tool.radius_wear;
  place = adds ? place + value : value;
  const double result = place;
  if (!tables_.set_tool(number, tool)) return {AlarmNumber::too_many_tools_changed, at};
  Command& command = output_.push(CommandKind::table);
  command.table = table;
  command.number = number;
  command.value = result;
  return {};
}

Fault TableCodes::write_tool(Table table, std::uint16_t number, double value) {
  if (const Fault fault = store_tool(table, number, value, false, 0)) return fault;
  return output_.settle();
}

// The older form: P the entry, Z its length, R its radius; T only names the tool it is for.
Fault TableCodes::define_tool(std::uint16_t at) {
  if (!words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  if (!words_.has('Z') && !words_.has('R')) return {AlarmNumber::missing_word, at, "needs Z or R"};
  std::uint32_t number = 0;
  if (const Fault fault = words_.whole_number('P', 1, highest_tool, number)) return fault;
  words_.use('T');
  ToolOffset tool = tables_.tool(static_cast<std::uint16_t>(number)).value_or(ToolOffset{});
  if (!tool.radius) tool.radius = 0;
  const bool adds = !state_.modal.absolute;
  if (words_.has('Z')) tool.length = (adds ? tool.length : 0.0) + words_.length('Z');
  if (words_.has('R')) tool.radius = (adds ? *tool.radius : 0.0) + words_.length('R');
  if (!tables_.set_tool(static_cast<std::uint16_t>(number), tool)) {
    return {AlarmNumber::too_many_tools_changed, words_.offset('P')};
  }
  for (const char letter : {'Z', 'R'}) {
    if (!words_.has(letter)) continue;
    Command& command = output_.push(CommandKind::table);
    command.table = letter == 'Z' ? Table::tool_length : Table::tool_radius;
    command.number = number;
    command.value = letter == 'Z' ? tool.length : *tool.radius;
  }
  return {};
}

Fault TableCodes::change_parameter(char number_letter) {
  if (!words_.has(number_letter) || !words_.has('R')) return {AlarmNumber::parameter_line, 0};
  std::uint32_t number = 0;
  if (const Fault fault = words_.whole_number(number_letter, 0, highest_parameter, number)) return fault;
  std::uint32_t axis = 0;
  if (number_letter == 'N' && words_.has('P')) {
    // Parameters of axes are numbered 10a000: P chooses the axis for the family's number.
    if (const Fault fault = words_.whole_number('P', 0, 99, axis)) return fault;
    if (number > highest_parameter - axis * 1000) return {AlarmNumber::value_range, words_.offset('P')};
  }
  words_.use('R');
  Command& command = output_.push(CommandKind::table);
  command.table = Table::parameter;
  command.number = number + axis * 1000;
  command.value = words_.value('R');
  return {};
}

}  // namespace trunnion::language
