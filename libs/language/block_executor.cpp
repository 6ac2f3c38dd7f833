#include "language/block_executor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "language/decimal.hpp"
#include "language/letters.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint32_t highest_repetition = 999999;

bool is_whole(double value, double low, double high) {
  return value == std::floor(value) && value >= low && value <= high;
}

}  // namespace

void BlockExecutor::start(const AxisValues& position, const ModalState& modal, Beginning beginning) {
  beginning_ = beginning;
  modal_ = modal;
  modal_.cutter_side = CutterSide::off;
  if (modal_.work_offset >= work_offset_count) modal_.work_offset = 0;
  if (beginning == Beginning::program) {
    modal_.cycle = 80;
    modal_.polar = modal_.scaled = modal_.mirrored = modal_.rotated = false;
    frame_ = ProgramFrame{};
    intermediate_.reset();
    parameter_input_ = swing_due_ = false;
    parked_ = SpindleDirection::stopped;
  }
  tables_.load(environment_);
  kept_revision_.reset();
  frame_.set_work_offset(tables_.work_offset(modal_.work_offset));
  frame_.set_tilt(modal_.tilt);
  compensation_.reset();
  compensation_.configure(environment_.cutter_settings());
  radius_deviation_ = environment_.radius_deviation();
  diameter_ = environment_.diameter_programming();
  channel_axes_ = environment_.axes();
  sequence_ = 0;
  needs_position_ = draining_ = held_too_many_ = false;
  activity_ = Activity::none;
  later_ = {};
  pattern_.clear();
  hole_.stop();
  curve_.stop();
  locate(position);
}

Fault BlockExecutor::execute(const Block& block, std::uint32_t program, std::uint32_t line, CommandQueue& out,
                             Flow& flow) {
  Codes codes;
  MCodes m;
  program_ = program;
  line_ = line;
  used_ = Block::bit('N');
  moves_ = false;
  detail_number_ = AlarmNumber::none;
  if (const Fault fault = check_numbers(block)) return fault;
  if (const Fault fault = collect_g(block, codes)) return fault;
  if (const Fault fault = collect_m(block, m)) return fault;
  if (const Fault fault = check_context(block, codes)) return fault;

  const ModalState modal = modal_;
  const AxisValues position = position_;
  const AxisValues program_position = program_position_;
  constexpr std::uint32_t frame_groups =
      1u << static_cast<unsigned>(Group::one_block) | 1u << static_cast<unsigned>(Group::work_offset) |
      1u << static_cast<unsigned>(Group::scaling) | 1u << static_cast<unsigned>(Group::mirror) |
      1u << static_cast<unsigned>(Group::rotation);
  const bool may_change_frame = (codes.present & frame_groups) != 0;
  std::optional<ProgramFrame> frame;
  if (may_change_frame) frame = frame_;
  Fault fault = run(block, codes, m, out, flow);
  if (!fault && held_too_many_) fault = {AlarmNumber::compensation_look_ahead, 0};
  if (fault) {
    if (frame) frame_ = *frame;
    modal_ = modal;
    position_ = position;
    program_position_ = program_position;
    held_too_many_ = draining_ = false;
    activity_ = Activity::none;
    out.clear();
  }
  return fault;
}

Fault BlockExecutor::run(const Block& block, const Codes& codes, const MCodes& m, CommandQueue& out,
                         Flow& flow) {
  exact_stop_once_ = codes.has(Group::exact_stop);
  if (const Fault fault = set_units_and_feed(block, codes)) return fault;
  if (const Fault fault = select_spindle_and_tool(block, codes, out)) return fault;
  if (const Fault fault = auxiliary(m, When::before, out)) return fault;
  if (const Fault fault = set_modal_codes(block, codes)) return fault;
  turn_spindle_again(m, out);
  if (const Fault fault = set_tool_length(block, codes, out)) return fault;
  if (const Fault fault = set_cutter_compensation(block, codes)) return fault;
  if (const Fault fault = act(block, codes, out)) return fault;
  if (const Fault fault = set_flow(block, m, flow)) return fault;
  if (const Fault fault = report_unused(block)) return fault;
  if (activity_ == Activity::none) return finish_block(m, out);
  later_ = m;
  return {};
}

Fault BlockExecutor::report_unused(const Block& block) const {
  const std::uint32_t unused = block.letters & ~used_;
  if (unused == 0) return {};
  std::uint16_t first = UINT16_MAX;
  for (std::uint32_t rest = unused; rest != 0; rest &= rest - 1) {
    first = std::min(first, block.offsets[static_cast<std::size_t>(std::countr_zero(rest))]);
  }
  return {AlarmNumber::unused_word, first};
}

Fault BlockExecutor::finish_block(const MCodes& m, CommandQueue& out) {
  if (const Fault fault = auxiliary(m, When::after, out)) return fault;
  return drain_compensation(out);
}

Fault BlockExecutor::resume(CommandQueue& out) {
  draining_ = false;
  Fault fault;
  if (activity_ == Activity::holes) fault = next_hole_step(out);
  if (activity_ == Activity::vector) fault = next_vector_piece(out);
  if (activity_ == Activity::curve) {
    Vector3 end{};
    if (curve_.next(end)) {
      AxisValues target = program_position_;
      std::copy(end.begin(), end.end(), target.begin());
      fault = move_straight(CommandKind::line, target, out);
    } else {
      activity_ = Activity::none;
    }
  }
  if (fault || activity_ != Activity::none) return fault;
  const MCodes m = later_;
  later_ = {};
  return finish_block(m, out);
}

// What else a block may mean in its place.
Fault BlockExecutor::check_context(const Block& block, const Codes& codes) const {
  const bool swing = codes.is(Group::one_block, 531) || codes.is(Group::one_block, 532);
  const bool alone = block.g_count == 1 && block.m_count == 0 && (block.letters & ~Block::bit('N')) == 0;
  std::uint16_t at = block.g_count > 0 ? block.g[0].offset : block.m_count > 0 ? block.m[0].offset : 0;
  if (block.g_count == 0 && block.m_count == 0) {
    at = block.offsets[static_cast<std::size_t>(std::countr_zero(block.letters))];
  }
  if (swing_due_ && !(swing && alone)) return {AlarmNumber::tilt_swing_missing, at};
  if (swing && !swing_due_) return {AlarmNumber::tilt_swing_misplaced, codes.offset(Group::one_block)};
  if (curve_.active() && (block.g_count > 0 || block.m_count > 0)) return {AlarmNumber::curve_incomplete, at};
  constexpr std::uint32_t parameter_words = letter_bits("NPR");
  if (parameter_input_ && !codes.is(Group::one_block, 110) &&
      (block.g_count > 0 || block.m_count > 0 || (block.letters & ~parameter_words) != 0)) {
    return {AlarmNumber::parameter_line, at};
  }
  return {};
}

// Codes that give axis words a meaning of their own, so that the block moves nothing.
bool BlockExecutor::takes_axis_words(const Block& block, const Codes& codes, std::uint16_t& at,
                                     int& takers) const {
  takers = 0;
  const auto take = [&](Group group) {
    at = codes.offset(group);
    ++takers;
  };
  const bool axes = (block.letters & axis_bits) != 0;
  if (codes.has(Group::one_block) && !codes.is(Group::one_block, 110) && !codes.is(Group::one_block, 921)) {
    take(Group::one_block);
  }
  if (codes.is(Group::scaling, 510)) take(Group::scaling);
  if (codes.has(Group::mirror) &&
      (axes || codes.code(Group::mirror) == 511 || codes.code(Group::mirror) == 240)) {
    take(Group::mirror);
  }
  if (codes.has(Group::rotation) && codes.code(Group::rotation) != 690) take(Group::rotation);
  return takers > 0;
}

Fault BlockExecutor::act(const Block& block, const Codes& codes, CommandQueue& out) {
  if (curve_.active()) return continue_curve(block);
  if (parameter_input_ && !codes.has(Group::one_block)) return change_parameter(block, 'N', out);
  std::uint16_t at = 0;
  int takers = 0;
  const bool taken = takes_axis_words(block, codes, at, takers);
  if (takers > 1) return {AlarmNumber::codes_compete, at};
  if (const Fault fault = set_frames(block, codes, out)) return fault;
  if (codes.has(Group::one_block)) {
    switch (codes.code(Group::one_block)) {
      case 40:
        return dwell(block, codes, out);
      case 100:
        return change_table(block, codes, out);
      case 110:
        parameter_input_ = false;
        return {};
      case 280:
      case 300:
        return return_to_reference(block, codes, out);
      case 290:
        return return_from_reference(block, codes, out);
      case 310:
        return move_until_skip(block, codes, out);
      case 520:
        return set_local_offset(block, codes);
      case 530:
        return move_in_machine_coordinates(block, codes, out);
      case 531:
      case 532:
        return swing(codes, out);
      case 533:
        return move_along_tool(block, codes, out);
      case 600:
        return approach_from_one_side(block, codes, out);
      case 700:
      case 710:
      case 780:
      case 790:
        return run_pattern(block, codes, out);
      case 920:
        return shift_coordinates(block, codes);
      default:
        return clear_shift(codes);
    }
  }
  if (taken) return {};
  if (modal_.cycle != 80) return run_cycle(block, codes, out);
  if (modal_.motion == 62) return start_curve(block, codes);
  return move(block, out);
}

Fault BlockExecutor::check_numbers(const Block& block) const {
  for (std::uint32_t rest = block.letters; rest != 0; rest &= rest - 1) {
    const auto letter = static_cast<std::size_t>(std::countr_zero(rest));
    if (!(std::abs(block.values[letter]) <= largest_number)) {
      return {AlarmNumber::number_range, block.offsets[letter]};
    }
  }
  return {};
}

double BlockExecutor::length_word(const Block& block, char letter) {
  if (!block.has(letter)) return 0;
  use(letter);
  return block.value(letter) * length_scale();
}

Fault BlockExecutor::refuse_in_compensation(std::uint16_t at) const {
  return compensation_.active() ? Fault{AlarmNumber::compensation_active, at} : Fault{};
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
    if (codes.has(code->group)) return {AlarmNumber::group_twice, word.offset};
    codes.present |= 1u << static_cast<unsigned>(code->group);
    codes.tenths[static_cast<std::size_t>(code->group)] = code->tenths;
    codes.offsets[static_cast<std::size_t>(code->group)] = word.offset;
  }
  // A cycle takes the place of the motion code.
  if (codes.has(Group::cycle) && codes.code(Group::cycle) != 800 && codes.has(Group::motion)) {
    return {AlarmNumber::group_twice, codes.offset(Group::cycle)};
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

Fault BlockExecutor::auxiliary(const MCodes& codes, When when, CommandQueue& out) {
  for (std::size_t i = 0; i < codes.count; ++i) {
    const MCode& code = codes.codes[i];
    if (code.when != when) continue;
    if (code.action == MAction::tool_change) modal_.tool = modal_.selected_tool;
    if (code.group == MGroup::spindle) {
      parked_ = SpindleDirection::stopped;
      modal_.spindle_direction = code.number == 3   ? SpindleDirection::cw
                                 : code.number == 4 ? SpindleDirection::ccw
                                                    : SpindleDirection::stopped;
    }
    if (code.action == MAction::auxiliary || code.action == MAction::tool_change) {
      push(CommandKind::auxiliary, out).number = code.number;
    } else if (code.action == MAction::program_end) {
      if (curve_.active()) return {AlarmNumber::curve_incomplete, codes.offsets[i]};
      if (const Fault fault = push_end(code.number, out)) return fault;
    }
  }
  return {};
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
      flow.counted = true;
    }
  }
  return {};
}

}  // namespace trunnion::language
