#include "language/block_executor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace trunnion::language {
namespace {

constexpr std::uint32_t highest_tool = 65535;
constexpr std::uint32_t highest_repetition = 999999;

bool is_whole(double value, double low, double high) {
  return value == std::floor(value) && value >= low && value <= high;
}

}  // namespace

void BlockExecutor::start(const AxisValues& position, const ModalState& modal) {
  modal_ = modal;
  position_ = position;
  work_offset_ = environment_.work_offset(modal.work_offset);
  radius_deviation_ = environment_.radius_deviation();
  channel_axes_ = environment_.axes();
  sequence_ = 0;
}

Fault BlockExecutor::execute(const Block& block, std::uint32_t program, std::uint32_t line, CommandQueue& out,
                             Flow& flow) {
  Codes codes;
  MCodes m;
  if (const Fault fault = collect_g(block, codes)) return fault;
  if (const Fault fault = collect_m(block, m)) return fault;
  program_ = program;
  line_ = line;
  used_ = Block::bit('N');

  const ModalState modal = modal_;
  const AxisValues position = position_;
  const Fault fault = run(block, codes, m, out, flow);
  if (fault) {
    if (modal_.work_offset != modal.work_offset) work_offset_ = environment_.work_offset(modal.work_offset);
    modal_ = modal;
    position_ = position;
    out.clear();
  }
  return fault;
}

Fault BlockExecutor::run(const Block& block, const Codes& codes, const MCodes& m, CommandQueue& out,
                         Flow& flow) {
  if (const Fault fault = set_units_and_feed(block, codes)) return fault;
  if (const Fault fault = select_spindle_and_tool(block, out)) return fault;
  auxiliary(m, When::before, out);
  set_modal_codes(codes);
  if (const Fault fault = set_tool_length(block, codes, out)) return fault;
  if (const Fault fault = move_or_dwell(block, codes, out)) return fault;
  auxiliary(m, When::after, out);
  if (const Fault fault = set_flow(block, m, flow)) return fault;

  const std::uint32_t unused = block.letters & ~used_;
  if (unused == 0) return {};
  std::uint16_t first = UINT16_MAX;
  for (std::uint32_t rest = unused; rest != 0; rest &= rest - 1) {
    first = std::min(first, block.offsets[static_cast<std::size_t>(std::countr_zero(rest))]);
  }
  return {AlarmNumber::unused_word, first};
}

void BlockExecutor::end_program(std::uint32_t number, std::uint32_t program, std::uint32_t line,
                                CommandQueue& out) {
  program_ = program;
  line_ = line;
  push(CommandKind::end, out).number = number;
}

void BlockExecutor::message(std::uint32_t number, std::uint32_t program, std::uint32_t line,
                            CommandQueue& out) {
  program_ = program;
  line_ = line;
  push(CommandKind::message, out).number = number;
  push(CommandKind::auxiliary, out).number = 0;
}

Command& BlockExecutor::push(CommandKind kind, CommandQueue& out) {
  Command& command = out.push();
  command = Command{};
  command.kind = kind;
  command.program = program_;
  command.line = line_;
  command.sequence = ++sequence_;
  command.target = position_;
  command.modal = modal_;
  return command;
}

Fault BlockExecutor::whole_number(const Block& block, char letter, std::uint32_t low, std::uint32_t high,
                                  std::uint32_t& value) {
  use(letter);
  const double number = block.value(letter);
  if (number != std::floor(number)) return {AlarmNumber::not_an_integer, block.offset(letter)};
  if (number < low || number > high) return {AlarmNumber::value_range, block.offset(letter)};
  value = static_cast<std::uint32_t>(number);
  return {};
}

Fault BlockExecutor::collect_g(const Block& block, Codes& codes) const {
  for (std::size_t i = 0; i < block.g_count; ++i) {
    const CodeWord& word = block.g[i];
    const double tenths = std::round(word.value * 10);
    const bool exact = std::abs(word.value * 10 - tenths) < 1e-9 && tenths >= 0 && tenths < 1000;
    const GCode* const code = exact ? g_code(static_cast<std::uint32_t>(tenths)) : nullptr;
    if (code == nullptr) return {AlarmNumber::unknown_g, word.offset};
    if (!code->available) return {AlarmNumber::unavailable_g, word.offset};
    if (codes.has(code->group)) return {AlarmNumber::group_twice, word.offset};
    codes.present |= 1u << static_cast<unsigned>(code->group);
    codes.tenths[static_cast<std::size_t>(code->group)] = code->tenths;
    codes.offsets[static_cast<std::size_t>(code->group)] = word.offset;
  }
  return {};
}

Fault BlockExecutor::collect_m(const Block& block, MCodes& codes) const {
  for (std::size_t i = 0; i < block.m_count; ++i) {
    const CodeWord& word = block.m[i];
    if (!is_whole(word.value, 0, highest_m)) return {AlarmNumber::unknown_m, word.offset};
    const MCode code = m_code(static_cast<std::uint16_t>(word.value));
    for (std::size_t k = 0; k < codes.count; ++k) {
      const bool same_group = code.group != MGroup::none && code.group == codes.codes[k].group;
      if (same_group || code.number == codes.codes[k].number) return {AlarmNumber::group_twice, word.offset};
    }
    codes.codes[codes.count] = code;
    codes.offsets[codes.count++] = word.offset;
  }
  return {};
}

Fault BlockExecutor::set_units_and_feed(const Block& block, const Codes& codes) {
  if (codes.has(Group::units)) modal_.metric = codes.code(Group::units) == 210;
  if (codes.has(Group::feed_mode)) {
    const std::uint16_t code = codes.code(Group::feed_mode);
    const FeedMode mode = code == 930   ? FeedMode::inverse_time
                          : code == 950 ? FeedMode::per_revolution
                                        : FeedMode::per_minute;
    // A number of one mode is nonsense in another.
    if (mode != modal_.feed_mode) modal_.feed = 0;
    modal_.feed_mode = mode;
  }
  if (block.has('F')) {
    use('F');
    const double feed = block.value('F');
    if (!(feed > 0)) return {AlarmNumber::feed_not_positive, block.offset('F')};
    modal_.feed = modal_.feed_mode == FeedMode::inverse_time ? feed : feed * length_scale();
  }
  return {};
}

Fault BlockExecutor::select_spindle_and_tool(const Block& block, CommandQueue& out) {
  if (block.has('S')) {
    use('S');
    const double speed = block.value('S');
    if (speed < 0) return {AlarmNumber::value_range, block.offset('S')};
    modal_.spindle_speed = speed;
    push(CommandKind::spindle_speed, out).value = speed;
  }
  if (block.has('T')) {
    std::uint32_t tool = 0;
    if (const Fault fault = whole_number(block, 'T', 0, highest_tool, tool)) return fault;
    modal_.selected_tool = static_cast<std::uint16_t>(tool);
    push(CommandKind::tool, out).number = tool;
  }
  return {};
}

void BlockExecutor::set_modal_codes(const Codes& codes) {
  if (codes.has(Group::plane)) {
    const std::uint16_t code = codes.code(Group::plane);
    modal_.plane = code == 180 ? Plane::zx : code == 190 ? Plane::yz : Plane::xy;
  }
  if (codes.has(Group::distance)) modal_.absolute = codes.code(Group::distance) == 900;
  if (codes.has(Group::path_control)) {
    const bool stop = codes.code(Group::path_control) == 610;
    modal_.path_control = stop ? PathControl::exact_stop : PathControl::continuous;
  }
  if (codes.has(Group::work_offset)) {
    modal_.work_offset = static_cast<std::uint8_t>(codes.code(Group::work_offset) / 10 - 54);
    work_offset_ = environment_.work_offset(modal_.work_offset);
  }
  if (codes.has(Group::motion)) modal_.motion = static_cast<std::uint8_t>(codes.code(Group::motion) / 10);
}

Fault BlockExecutor::set_tool_length(const Block& block, const Codes& codes, CommandQueue& out) {
  if (!codes.has(Group::tool_length)) return {};
  const std::uint16_t code = codes.code(Group::tool_length);
  std::uint32_t h = 0;
  double length = 0;
  if (code != 490) {
    if (!block.has('H')) return {AlarmNumber::missing_word, codes.offset(Group::tool_length)};
    if (const Fault fault = whole_number(block, 'H', 0, highest_tool, h)) return fault;
    if (h != 0) {
      const auto entry = environment_.tool_length(static_cast<std::uint16_t>(h));
      if (!entry) return {AlarmNumber::tool_length_unknown, block.offset('H')};
      length = *entry;
    }
  }
  const Transformation transformation = code == 434 ? Transformation::rtcp : Transformation::none;
  if (transformation == modal_.transformation && h == modal_.length_offset && length == modal_.tool_length) {
    return {};
  }
  // The machine stands still while the coordinates it is described in change.
  if (modal_.transformation == Transformation::rtcp) {
    position_ = environment_.machine_from_tip(position_, modal_.tool_length);
  }
  if (transformation == Transformation::rtcp) position_ = environment_.tip_from_machine(position_, length);
  modal_.transformation = transformation;
  modal_.length_offset = static_cast<std::uint16_t>(h);
  modal_.tool_length = length;
  push(CommandKind::transformation, out);
  return {};
}

void BlockExecutor::auxiliary(const MCodes& codes, When when, CommandQueue& out) {
  for (std::size_t i = 0; i < codes.count; ++i) {
    const MCode& code = codes.codes[i];
    if (code.when != when) continue;
    if (code.action == MAction::tool_change) modal_.tool = modal_.selected_tool;
    if (code.action == MAction::auxiliary || code.action == MAction::tool_change) {
      push(CommandKind::auxiliary, out).number = code.number;
    } else if (code.action == MAction::program_end) {
      push(CommandKind::end, out).number = code.number;
    }
  }
}

Fault BlockExecutor::set_flow(const Block& block, const MCodes& codes, Flow& flow) {
  flow = Flow{};
  for (std::size_t i = 0; i < codes.count; ++i) {
    const MAction action = codes.codes[i].action;
    if (action == MAction::auxiliary || action == MAction::tool_change) continue;
    flow.offset = codes.offsets[i];
    if (action == MAction::program_end) flow.kind = Flow::Kind::end;
    if (action == MAction::go_back) {
      flow.kind = Flow::Kind::go_back;
      flow.to_label = block.has('P');
      if (flow.to_label && (used_ & Block::bit('P')) != 0)
        return {AlarmNumber::unused_word, block.offset('P')};
      if (flow.to_label) {
        if (const Fault fault = whole_number(block, 'P', 0, 99999999, flow.subprogram)) return fault;
      }
    }
    if (action != MAction::call) continue;
    flow.kind = Flow::Kind::call;
    if (!block.has('P')) return {AlarmNumber::missing_word, flow.offset};
    // P and L have one meaning each: a dwell or turns in the same block leave none for the call.
    for (const char letter : {'P', 'L'}) {
      if (block.has(letter) && (used_ & Block::bit(letter)) != 0) {
        return {AlarmNumber::unused_word, block.offset(letter)};
      }
    }
    if (const Fault fault = whole_number(block, 'P', 1, 99999999, flow.subprogram)) return fault;
    if (block.has('L')) {
      if (const Fault fault = whole_number(block, 'L', 1, highest_repetition, flow.repetitions)) return fault;
    }
  }
  return {};
}

}  // namespace trunnion::language
