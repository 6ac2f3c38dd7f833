// SPDX-License-Identifier: Apache-2.0
#include "language/block_executor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

namespace trunnion::language {
namespace {

constexpr double largest_angle = 360;  // deg
constexpr double read_seconds = 0.01;  // behind which a value is read: the PLC's main task has run

/// The groups from `first` to `last`, which act one after the other.
constexpr std::uint32_t groups(Group first, Group last) { return (group_bit(last) << 1) - group_bit(first); }
constexpr std::uint32_t frame_groups = groups(Group::stroke_zone, Group::rotation);

}  // namespace

void BlockExecutor::start(const AxisValues& position, const ModalState& modal, Beginning beginning) {
  ProgramState& state = context_.state;
  beginning_ = beginning;
  state.modal = modal;
  state.modal.cutter_side = CutterSide::off;
  if (state.modal.work_offset >= work_offset_count) state.modal.work_offset = 0;
  ProgramSettings& settings = state.change_settings();
  if (beginning == Beginning::program) {
    state.modal.cycle = 80;
    state.modal.polar = state.modal.scaled = state.modal.mirrored = state.modal.rotated = false;
    settings.frame = ProgramFrame{};
    settings.linuxcnc = {};
    settings.intermediate.reset();
    state.parameter_input = state.swing_due = false;
    state.parked = SpindleDirection::stopped;
    state.thread_lead = 0;
    state.length_given = false;
    state.machining_mode = state.modal.smoothing;
    state.accurate_path = false;
    state.modal.suppressed = 0;
    state.own_motion = 0;
    state.coolant = 0;
  }
  state.needs_position = state.homing = state.needs_contact = state.line_open = false;
  state.homed = 0;
  context_.tables.load(context_.environment);
  settings.frame.set_work_offset(context_.tables.workpiece_zero(state.modal.work_offset));
  settings.frame.set_tilt(state.modal.tilt);
  if (const std::uint8_t error = settings.frame.setting_error().number; error != 0)
    settings.frame.set_setting_error(error, context_.tables.setting_error(error));
  context_.words.configure(context_.environment);
  angle_codes_ = context_.environment.angle_m_codes();
  context_.output.start();
  context_.activity = Activity::none;
  m_codes_due_ = false;
  handlers_.motion.start();
  handlers_.cycles.reset();
  handlers_.curve.reset();
  handlers_.linuxcnc_curves.reset();
  state.locate(position);
}

Fault BlockExecutor::execute(const Block& block, std::uint32_t program, std::uint32_t line, CommandQueue& out,
                             Flow& flow) {
  context_.output.begin_block(program, line, out);
  context_.detail.number = AlarmNumber::none;
  if (const Fault fault = context_.words.begin(block)) return fault;
  if (const Fault fault = check_context()) return fault;
  context_.state.begin_block();
  if (block.message) context_.output.push(CommandKind::message).number = line_message;
  Fault fault = run(flow);
  if (!fault) fault = context_.output.check_room();
  if (!fault) fault = {context_.state.setting_fault(), 0, "with the setting error of G54.4"};
  if (fault) {
    context_.state.roll_back();
    context_.output.discard();
    context_.activity = Activity::none;
  }
  return fault;
}

Fault BlockExecutor::run(Flow& flow) {
  if (const Fault fault = carry_out(groups(Group::exact_stop, Group::feed_mode))) return fault;
  // F of a search for references is its speed, and no feed.
  const bool homes =
      context_.words.g().is(Group::one_block, 282) || context_.words.g().is(Group::one_block, 1590);
  if (!homes) {
    if (const Fault fault = handlers_.modal.feed_word()) return fault;
  }
  if (const Fault fault = carry_out(group_bit(Group::spindle_mode))) return fault;
  if (const Fault fault = select_spindle()) return fault;
  if (const Fault fault = handlers_.modal.spindle_word()) return fault;
  if (const Fault fault = handlers_.modal.tool_word()) return fault;
  if (const Fault fault = auxiliary(When::before)) return fault;
  if (const Fault fault = carry_out(groups(Group::plane, Group::cycle))) return fault;
  handlers_.cycles.restart_spindle();
  const GCodes& g = context_.words.g();
  if (const Fault fault = g.has(Group::tool_length) ? carry_out(group_bit(Group::tool_length))
                          : calls()                 ? Fault{}
                                                    : handlers_.tool.length_word())
    return fault;
  if (const Fault fault = g.has(Group::cutter_compensation) ? carry_out(group_bit(Group::cutter_compensation))
                                                            : handlers_.tool.radius_word())
    return fault;
  if (const Fault fault = act()) return fault;
  if (context_.words.thread() == ThreadBlock::alone)
    context_.state.modal.motion = context_.state.at_block_begin().modal.motion;
  if (const Fault fault = set_flow(flow)) return fault;
  context_.words.leave_to_logic();
  if (const Fault fault = report_unused()) return fault;
  m_codes_due_ = context_.activity != Activity::none;
  return m_codes_due_ ? Fault{} : finish_block();
}

// All of I J K beside a straight move are how posts write a direction of the tool.
Fault BlockExecutor::report_unused() const {
  const BlockWords& words = context_.words;
  Fault fault = words.report_unused();
  if (!fault) return fault;
  constexpr std::uint32_t vector = letter_bits("IJK");
  const bool directed = (words.letters() & vector) == vector && !words.used('I') && !words.used('J') &&
                        !words.used('K') && fault.offset == words.offset('I');
  if (directed && context_.state.modal.motion <= 1) fault.detail = "a tool direction I J K needs G43.5";
  return fault;
}

Fault BlockExecutor::carry_out(std::uint32_t which) {
  const GCodes& g = context_.words.g();
  for (std::uint32_t rest = g.present() & which; rest != 0; rest &= rest - 1) {
    const auto group = static_cast<Group>(std::countr_zero(rest));
    if (const Fault fault = g.code(group).execute(handlers_, g.offset(group))) return fault;
  }
  return {};
}

Fault BlockExecutor::finish_block() {
  if (const Fault fault = auxiliary(When::after)) return fault;
  return context_.output.drain();
}

Fault BlockExecutor::resume(CommandQueue& out) {
  context_.output.resume(out);
  Fault fault;
  switch (context_.activity) {
    case Activity::none:
      break;
    case Activity::holes:
      fault = handlers_.cycles.next_step();
      break;
    case Activity::vector:
      fault = handlers_.vectors.next_piece();
      break;
    case Activity::curve:
      fault = handlers_.curve.next_chord();
      break;
    case Activity::spline:
      fault = handlers_.linuxcnc_curves.next_chord();
      break;
    case Activity::passes:
      fault = handlers_.linuxcnc_threads.next_pass();
      break;
  }
  if (!fault) fault = {context_.state.setting_fault(), 0, "with the setting error of G54.4"};
  if (fault || context_.activity != Activity::none) return fault;
  if (!m_codes_due_) return context_.output.drain();
  m_codes_due_ = false;
  return finish_block();
}

// A swing is due, a curve or the parameter input is open: they decide what the block may hold.
Fault BlockExecutor::check_context() const {
  if (const Fault fault = handlers_.planes.check()) return fault;
  if (const Fault fault = handlers_.curve.check()) return fault;
  if (const Fault fault = handlers_.linuxcnc_curves.check()) return fault;
  return handlers_.tables.check();
}

// Codes that give axis words a meaning of their own, so that the block moves nothing.
Fault BlockExecutor::check_axis_words(bool& taken) const {
  const BlockWords& words = context_.words;
  const bool axes = (words.letters() & axis_bits) != 0;
  std::uint16_t at = 0;
  int takers = 0;
  for (const Group group :
       {Group::one_block, Group::stroke_zone, Group::scaling, Group::mirror, Group::rotation}) {
    if (!words.g().has(group)) continue;
    const AxisWords use = words.g().code(group).axis_words;
    if (use == AxisWords::move || use == AxisWords::passed || (use == AxisWords::shared && !axes)) continue;
    at = words.g().offset(group);
    ++takers;
  }
  taken = takers > 0;
  return takers > 1 ? Fault{AlarmNumber::codes_compete, at} : Fault{};
}

Fault BlockExecutor::act() {
  const GCodes& g = context_.words.g();
  const bool linuxcnc = context_.words.linuxcnc();
  if (linuxcnc) handlers_.linuxcnc_motion.note_codes();
  const bool one_block = g.has(Group::one_block) && g.code(Group::one_block).axis_words != AxisWords::passed;
  if (handlers_.curve.open()) return handlers_.curve.add_block();
  if (orientation_word() != '\0') return {};
  if (context_.state.parameter_input && !one_block) return handlers_.tables.parameter_line();
  if ((g.present() & (frame_groups | group_bit(Group::one_block))) != 0) {
    bool taken = false;
    if (const Fault fault = check_axis_words(taken)) return fault;
    if (const Fault fault = carry_out(frame_groups | group_bit(Group::one_block))) return fault;
    if (taken || one_block) return {};
  }
  if (linuxcnc) return handlers_.linuxcnc_motion.move();
  if (context_.words.axes_used()) return {};  // a modal code has taken them
  const ModalState& modal = context_.state.modal;
  if (modal.cycle != 80)
    return handlers_.num_tapping.active() ? handlers_.num_tapping.run() : handlers_.cycles.run();
  if (modal.motion == 62) return handlers_.curve.begin();
  return handlers_.motion.move();
}

Fault BlockExecutor::auxiliary(When when) {
  const MCodes& m = context_.words.m();
  for (std::size_t i = 0; i < m.count; ++i) {
    if (m.codes[i].when != when || selects_spindle(m.codes[i])) continue;
    if (const Fault fault = carry_out(m.codes[i], m.offsets[i])) return fault;
  }
  return {};
}

Fault BlockExecutor::carry_out(const MCode& code, std::uint16_t at) {
  ModalState& modal = context_.state.modal;
  if (!context_.words.reaches_logic(code)) return {};
  if (code.action == MAction::tool_change) modal.tool = modal.selected_tool;
  if (code.group == MGroup::spindle) {
    context_.state.parked = SpindleDirection::stopped;
    modal.spindle_direction = code.number == 3   ? SpindleDirection::cw
                              : code.number == 4 ? SpindleDirection::ccw
                                                 : SpindleDirection::stopped;
  }
  if (code.action == MAction::auxiliary || code.action == MAction::tool_change) {
    const char word = takes_angle(code.number) ? orientation_word() : '\0';
    double angle = 0;
    if (word != '\0') {
      if (const Fault fault = orientation(code.number, word, angle)) return fault;
    }
    Command& command = context_.output.push(CommandKind::auxiliary);
    command.number = code.number;
    command.value = angle;
    command.has_value = word != '\0';
    if (context_.words.linuxcnc()) handlers_.linuxcnc_modal_state.note_coolant(code.number);
    if (code.action == MAction::tool_change) return handlers_.modal.ready_tool();
  } else if (code.action == MAction::program_end) {
    if (handlers_.curve.open()) return {AlarmNumber::curve_incomplete, at};
    if (const Fault fault = handlers_.linuxcnc_curves.check_end(at)) return fault;
    if (const Fault fault = handlers_.linuxcnc_frames.check_end(at)) return fault;
    if (context_.words.linuxcnc()) handlers_.linuxcnc_modal_state.stop_at_end();
    if (const Fault fault = context_.output.push_end(code.number)) return fault;
  }
  return {};
}

// The S of a block of the NUM dialect is for the spindle that its M64 to M66 chooses.
bool BlockExecutor::selects_spindle(const MCode& code) const {
  constexpr std::uint16_t first_spindle = 64, last_spindle = 66;
  return context_.words.spindle_codes() && code.number >= first_spindle && code.number <= last_spindle;
}

Fault BlockExecutor::select_spindle() {
  const MCodes& m = context_.words.m();
  for (std::size_t i = 0; i < m.count; ++i) {
    if (!selects_spindle(m.codes[i])) continue;
    if (const Fault fault = carry_out(m.codes[i], m.offsets[i])) return fault;
  }
  return {};
}

bool BlockExecutor::takes_angle(std::uint16_t code) const {
  return std::find(angle_codes_.begin(), angle_codes_.end(), static_cast<std::int16_t>(code)) !=
         angle_codes_.end();
}

// Where nothing else of the block can mean R or P.
char BlockExecutor::orientation_word() const {
  constexpr std::uint32_t others = axis_bits | letter_bits("IJK");
  const BlockWords& words = context_.words;
  const ModalState& modal = context_.state.modal;
  if (words.g().present() != 0 || (words.letters() & others) != 0) return '\0';
  if (modal.cycle != 80 || modal.motion == 62 || handlers_.curve.open() || context_.state.parameter_input)
    return '\0';
  bool orients = false;
  for (std::size_t i = 0; i < words.m().count; ++i) {
    const MCode& code = words.m().codes[i];
    if (code.action == MAction::call || code.action == MAction::go_back) return '\0';
    orients = orients || takes_angle(code.number);
  }
  return !orients ? '\0' : words.has('R') ? 'R' : words.has('P') ? 'P' : '\0';
}

Fault BlockExecutor::orientation(std::uint16_t code, char word, double& angle) {
  context_.words.use(word);
  const double value = context_.words.value(word);
  if (std::abs(value) > largest_angle) {
    FaultDetail& detail = context_.detail;
    detail.number = AlarmNumber::value_range;
    std::snprintf(detail.text.data(), detail.text.size(), "the angle of M%u is -360 to 360 deg",
                  static_cast<unsigned>(code));
    return {detail.number, context_.words.offset(word)};
  }
  angle = std::fmod(value, largest_angle);
  if (angle < 0) angle += largest_angle;
  if (!(angle > 0 && angle < largest_angle)) angle = 0;
  return {};
}

void BlockExecutor::set_position(const AxisValues& position) {
  if (context_.output.compensating()) context_.output.drop_compensation();
  context_.state.needs_position = context_.state.homing = context_.state.needs_contact = false;
  context_.state.locate(position);
}

std::string_view BlockExecutor::fault_detail(AlarmNumber number) {
  FaultDetail& detail = context_.detail;
  if (number == AlarmNumber::compensation_interference) {
    detail.number = number;
    std::snprintf(detail.text.data(), detail.text.size(), "that of line %u", interference().contour_line);
  }
  if (number == AlarmNumber::corner_too_large || number == AlarmNumber::corner_chamfer_arc) {
    const auto& corner = context_.output.corner_measures();
    detail.number = number;
    std::snprintf(detail.text.data(), detail.text.size(), "%.4g mm in line %u, moves %.4g and %.4g mm",
                  corner.size, corner.line, corner.before, corner.behind);
  }
  return number == detail.number ? std::string_view(detail.text.data()) : std::string_view{};
}

Fault BlockExecutor::end_program(std::uint32_t number, std::uint32_t program, std::uint32_t line,
                                 CommandQueue& out) {
  context_.output.begin(program, line, out);
  if (handlers_.curve.open()) return {AlarmNumber::curve_incomplete, 0};
  // Behind a line of manual data input the next one may hold the swing.
  const bool more = number == 0 && beginning_ == Beginning::line;
  if (context_.state.swing_due && !more) return {AlarmNumber::tilt_swing_missing, 0};
  if (const Fault fault = handlers_.linuxcnc_curves.check_end(0)) return fault;
  if (const Fault fault = handlers_.linuxcnc_frames.check_end(0)) return fault;
  if (const Fault fault = context_.output.push_end(number)) return fault;
  const Fault fault = context_.output.settle();
  if (fault) context_.output.discard();
  return fault;
}

Fault BlockExecutor::write_work_offset(std::uint8_t index, std::size_t axis, double value,
                                       std::uint32_t program, std::uint32_t line, CommandQueue& out) {
  context_.output.begin(program, line, out);
  return handlers_.tables.write_work_offset(index, axis, value);
}

Fault BlockExecutor::write_tool(Table table, std::uint16_t number, double value, std::uint32_t program,
                                std::uint32_t line, CommandQueue& out) {
  context_.output.begin(program, line, out);
  return handlers_.tables.write_tool(table, number, value);
}

Fault BlockExecutor::message(std::uint32_t number, std::uint32_t program, std::uint32_t line,
                             CommandQueue& out) {
  context_.output.begin(program, line, out);
  context_.output.push(CommandKind::message).number = number;
  context_.output.push(CommandKind::auxiliary).number = 0;
  return context_.output.settle();
}

Fault BlockExecutor::print(std::uint32_t program, std::uint32_t line, CommandQueue& out) {
  context_.output.begin(program, line, out);
  if (const Fault fault = context_.output.refuse_in_compensation(0)) return fault;
  context_.output.push(CommandKind::print);
  return context_.output.settle();
}

Fault BlockExecutor::home_axis(std::size_t axis, std::uint32_t program, std::uint32_t line,
                               CommandQueue& out) {
  context_.output.begin(program, line, out);
  if (const Fault fault = handlers_.positioning.home_axis(axis)) return fault;
  return context_.output.settle();
}

Fault BlockExecutor::call_cycle(std::uint32_t number, std::uint32_t program, std::uint32_t line,
                                CommandQueue& out) {
  context_.output.begin(program, line, out);
  if (const Fault fault = context_.output.refuse_in_compensation(0)) return fault;
  context_.output.push(CommandKind::cycle).number = number;
  return context_.output.settle();
}

Fault BlockExecutor::read_value(std::uint32_t number, std::uint32_t program, std::uint32_t line,
                                CommandQueue& out) {
  context_.output.begin(program, line, out);
  if (const Fault fault = context_.output.refuse_in_compensation(0)) return fault;
  Command& command = context_.output.push(CommandKind::read);
  command.number = number;
  command.dwell_seconds = read_seconds;
  return context_.output.settle();
}

Fault BlockExecutor::order_spindle(std::uint32_t number, double value, std::uint32_t program,
                                   std::uint32_t line, CommandQueue& out) {
  context_.output.begin(program, line, out);
  Command& command = context_.output.push(CommandKind::spindle_order);
  command.number = number;
  command.value = value;
  return context_.output.settle();
}

Fault BlockExecutor::restore_modes(const SavedModes& saved, std::uint32_t program, std::uint32_t line,
                                   CommandQueue& out) {
  context_.output.begin_block(program, line, out);
  context_.detail.number = AlarmNumber::none;
  context_.state.begin_block();
  Fault fault = handlers_.linuxcnc_curves.check_end(0);
  if (!fault) fault = handlers_.linuxcnc_modal_state.restore(saved);
  if (!fault) fault = context_.output.settle();
  if (fault) {
    context_.state.roll_back();
    context_.output.discard();
  }
  return fault;
}

Fault BlockExecutor::write_parameter(std::uint32_t number, double value, std::uint32_t program,
                                     std::uint32_t line, CommandQueue& out) {
  context_.output.begin(program, line, out);
  Command& command = context_.output.push(CommandKind::table);
  command.table = Table::parameter;
  command.number = number;
  command.value = value;
  return context_.output.settle();
}

Fault BlockExecutor::write_parts(double parts, std::uint32_t program, std::uint32_t line, CommandQueue& out) {
  context_.output.begin(program, line, out);
  Command& command = context_.output.push(CommandKind::table);
  command.table = Table::parts;
  command.value = parts;
  return context_.output.settle();
}

void BlockExecutor::suppress(bool single_block, std::uint8_t value) {
  constexpr unsigned alone = canonical::no_single_block;
  const unsigned before = context_.state.modal.suppressed;
  const unsigned chosen = value;
  context_.state.modal.suppressed = static_cast<std::uint8_t>(
      single_block ? (before & ~alone) | chosen : (before & alone) | (chosen << canonical::path_suppression));
}

}  // namespace trunnion::language
