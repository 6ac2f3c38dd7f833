// The part of BlockExecutor that changes tables (G10).
#include "language/block_executor.hpp"
#include "language/letters.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint32_t highest_tool = 65535;
constexpr std::uint32_t highest_parameter = 999999;

}  // namespace

Fault BlockExecutor::change_table(const Block& block, const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if (!block.has('L')) return define_tool(block, at, out);
  std::uint32_t l = 0;
  if (const Fault fault = whole_number(block, 'L', 2, 50, l)) return fault;
  switch (l) {
    case 2:
    case 20:
      return change_work_offset(block, codes, l, out);
    case 10:
    case 11:
    case 12:
    case 13:
      return change_tool(block, codes, l, out);
    case 50:
      if (block.has('P') || block.has('R')) return change_parameter(block, 'P', out);
      parameter_input_ = true;
      return {};
    default:
      return {AlarmNumber::value_range, block.has('L') ? block.offset('L') : at};
  }
}

Fault BlockExecutor::change_work_offset(const Block& block, const Codes& codes, std::uint32_t l,
                                        CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if (!block.has('P')) return {AlarmNumber::missing_word, at};
  std::uint32_t number = 0;
  if (const Fault fault = whole_number(block, 'P', 1, l == 2 ? 6 : work_offset_count - 6, number))
    return fault;
  const auto index = static_cast<std::uint8_t>(l == 2 ? number - 1 : number + 5);
  std::uint32_t axes = 0;
  if (const Fault fault = take_axes(block, at, axes)) return fault;
  if (index == modal_.work_offset) {
    if (const Fault fault = refuse_in_compensation(at)) return fault;
  }
  AxisValues values = tables_.work_offset(index);
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    // Tables hold radii, so a diameter means nothing here.
    const double word = block.value(axis_letters[axis]) * (is_rotary(axis) ? 1.0 : length_scale());
    values[axis] = modal_.absolute ? word : values[axis] + word;
  }
  store_work_offset(index, values, out);
  return {};
}

void BlockExecutor::store_work_offset(std::uint8_t index, const AxisValues& values, CommandQueue& out) {
  tables_.set_work_offset(index, values);
  if (index == modal_.work_offset) {
    frame_.set_work_offset(values);
    locate(position_);
  }
  Command& command = push(CommandKind::table, out);
  command.table = Table::work_offset;
  command.number = index;
  command.target = values;
}

Fault BlockExecutor::write_work_offset(std::uint8_t index, std::size_t axis, double value,
                                       std::uint32_t program, std::uint32_t line, CommandQueue& out) {
  program_ = program;
  line_ = line;
  if (index == modal_.work_offset) {
    if (const Fault fault = refuse_in_compensation(0)) return fault;
  }
  AxisValues values = tables_.work_offset(index);
  values[axis] = value;
  store_work_offset(index, values, out);
  return settle(out);
}

Fault BlockExecutor::change_tool(const Block& block, const Codes& codes, std::uint32_t l, CommandQueue& out) {
  for (const char letter : {'P', 'R'}) {
    if (!block.has(letter)) return {AlarmNumber::missing_word, codes.offset(Group::one_block)};
  }
  std::uint32_t number = 0;
  if (const Fault fault = whole_number(block, 'P', 1, highest_tool, number)) return fault;
  const Table table = l == 10   ? Table::tool_length
                      : l == 11 ? Table::tool_length_wear
                      : l == 12 ? Table::tool_radius
                                : Table::tool_radius_wear;
  return store_tool(table, static_cast<std::uint16_t>(number), length_word(block, 'R'), !modal_.absolute,
                    block.offset('P'), out);
}

Fault BlockExecutor::store_tool(Table table, std::uint16_t number, double value, bool adds, std::uint16_t at,
                                CommandQueue& out) {
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
  Command& command = push(CommandKind::table, out);
  command.table = table;
  command.number = number;
  command.value = result;
  return {};
}

Fault BlockExecutor::write_tool(Table table, std::uint16_t number, double value, std::uint32_t program,
                                std::uint32_t line, CommandQueue& out) {
  program_ = program;
  line_ = line;
  if (const Fault fault = store_tool(table, number, value, false, 0, out)) return fault;
  return settle(out);
}

// The older form: P the entry, Z its length, R its radius; T only says which tool it is for.
Fault BlockExecutor::define_tool(const Block& block, std::uint16_t at, CommandQueue& out) {
  if (!block.has('P') || !(block.has('Z') || block.has('R'))) return {AlarmNumber::missing_word, at};
  std::uint32_t number = 0;
  if (const Fault fault = whole_number(block, 'P', 1, highest_tool, number)) return fault;
  use('T');
  ToolOffset tool = tables_.tool(static_cast<std::uint16_t>(number)).value_or(ToolOffset{});
  if (!tool.radius) tool.radius = 0;
  if (block.has('Z')) tool.length = length_word(block, 'Z');
  if (block.has('R')) tool.radius = length_word(block, 'R');
  if (!tables_.set_tool(static_cast<std::uint16_t>(number), tool)) {
    return {AlarmNumber::too_many_tools_changed, block.offset('P')};
  }
  for (const char letter : {'Z', 'R'}) {
    if (!block.has(letter)) continue;
    Command& command = push(CommandKind::table, out);
    command.table = letter == 'Z' ? Table::tool_length : Table::tool_radius;
    command.number = number;
    command.value = letter == 'Z' ? tool.length : *tool.radius;
  }
  return {};
}

Fault BlockExecutor::change_parameter(const Block& block, char number_letter, CommandQueue& out) {
  if (!block.has(number_letter) || !block.has('R')) return {AlarmNumber::parameter_line, 0};
  std::uint32_t number = 0;
  if (const Fault fault = whole_number(block, number_letter, 0, highest_parameter, number)) return fault;
  std::uint32_t axis = 0;
  if (number_letter == 'N' && block.has('P')) {
    // Parameters of axes are numbered 10a000: P chooses the axis for the family's number.
    if (const Fault fault = whole_number(block, 'P', 0, 99, axis)) return fault;
    if (number > highest_parameter - axis * 1000) return {AlarmNumber::value_range, block.offset('P')};
  }
  use('R');
  Command& command = push(CommandKind::table, out);
  command.table = Table::parameter;
  command.number = number + axis * 1000;
  command.value = block.value('R');
  return {};
}

}  // namespace trunnion::language
