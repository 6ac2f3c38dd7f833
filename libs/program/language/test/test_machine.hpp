// SPDX-License-Identifier: Apache-2.0
// A small machine for the language tests: tables, an AC rotary table, and texts in memory.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "language/interpreter.hpp"
#include "language/name_dialects.hpp"

namespace trunnion::language::test {

/// An AC table: P = v2 + v1 + R1 [-v1 + R2 (w - v2)] with A about (-1,0,0), C about (0,0,-1), v1 = (0, off_y,
/// 0) and v2 = (Xc, Yc, Zc); P is the tool tip in machine coordinates, w the point on the table as it is at
/// A0 C0.
struct TestMachine : Environment {
  std::array<AxisValues, 6> offsets{};
  std::map<int, double> lengths;
  AxisValues reference{};
  std::map<int, AxisValues> further_references;  // G30 P
  std::map<int, ToolOffset> tools;               // beside lengths
  std::map<int, std::array<Vector3, 3>> planes;  // G68.1 Q
  std::map<int, AxisValues> more_offsets;        // G54.1 P
  AxisValues added{};                            // G10 L2 P0
  std::map<int, AxisValues> setting_errors;      // G54.4 P
  AxisValues last_way{};
  bool diameter = false;
  double factor_unit = 1;
  CutterSettings cutter;
  CycleSettings cycles;
  std::array<SkipSettings, 3> skips{{{2, 0}, {3, 0}, {4, 0}}};
  LengthMeasuring measuring;
  std::uint16_t axis_mask = 0b111111111;
  std::optional<std::uint16_t> spindles;  // nothing: every letter that is no axis
  double deviation = 0.1;
  double highest_speed = 0;
  double axis_feed = 0;  // mm/min
  double off_y = 0.1028;
  std::array<double, 3> centre = {-200.3605, -190.1897, -516.0118};
  std::map<std::string, std::unique_ptr<TextSource>, std::less<>> programs;
  std::array<std::uint16_t, 8> cycle_m_codes{};
  CodeCalls calls;
  bool blanks = true;  // of DPRNT
  std::array<canonical::RotaryWay, axis_count> ways{};
  std::optional<MFunctions> functions;  // nothing: every M code may stand
  DwellPoint point = DwellPoint::refused;
  TwoToolWords two_tools = TwoToolWords::refused;
  ProgramDialect dialect = ProgramDialect::iso;
  NameDialects names;
  bool radius_offsets = false;                 // of Haas programs
  std::map<std::uint32_t, double> external;    // parameters of the NUM dialect
  std::map<std::uint32_t, double> parameters;  // PRM
  bool by_axis = false;                        // #2501 is a work offset
  AngleMCodes angle_codes{19, -1, -1, -1};

  AxisValues work_offset(std::uint8_t index) const override {
    if (index < offsets.size()) return offsets.at(index);
    const auto found = more_offsets.find(index - 5);
    return found == more_offsets.end() ? AxisValues{} : found->second;
  }
  AxisValues external_offset() const override { return added; }
  AxisValues setting_error(std::uint8_t number) const override {
    const auto found = setting_errors.find(number);
    return found == setting_errors.end() ? AxisValues{} : found->second;
  }
  bool has_tool(std::uint32_t number) const override { return number < 90; }
  std::optional<ToolOffset> tool_offset(std::uint16_t number) const override {
    const auto found = tools.find(number);
    return found == tools.end() ? Environment::tool_offset(number) : std::optional(found->second);
  }
  std::optional<AxisValues> numbered_reference(std::uint8_t number) const override {
    const auto found = further_references.find(number);
    return found == further_references.end() ? std::nullopt : std::optional(found->second);
  }
  std::optional<std::array<Vector3, 3>> plane_points(std::uint8_t index) const override {
    const auto found = planes.find(index);
    return found == planes.end() ? std::nullopt : std::optional(found->second);
  }
  std::uint16_t spindle_axes() const override {
    return spindles.value_or(static_cast<std::uint16_t>(~axis_mask));
  }
  double highest_spindle_speed() const override { return highest_speed; }
  double highest_feed(std::size_t) const override { return axis_feed; }
  AxisValues approach() const override { return last_way; }
  bool diameter_programming() const override { return diameter; }
  double scaling_unit() const override { return factor_unit; }
  CutterSettings cutter_settings() const override { return cutter; }
  canonical::RotaryWay rotary_way(std::size_t axis) const override { return ways[axis]; }
  CycleSettings cycle_settings() const override { return cycles; }
  SkipSettings skip_settings(std::uint32_t number) const override { return skips.at(number - 1); }
  LengthMeasuring length_measuring() const override { return measuring; }
  const MFunctions* m_functions() const override { return functions ? &*functions : nullptr; }
  DwellPoint dwell_point() const override { return point; }
  TwoToolWords two_tool_words() const override { return two_tools; }
  ProgramDialect program_dialect() const override { return dialect; }
  bool haas_radius_offsets() const override { return radius_offsets; }
  std::optional<ProgramDialect> dialect_by_name(std::string_view name) const override {
    return names.of(name);
  }
  std::optional<double> parameter(std::uint32_t number) const override {
    const auto found = parameters.find(number);
    return found == parameters.end() ? std::nullopt : std::optional(found->second);
  }
  bool offsets_by_axis() const override { return by_axis; }
  std::optional<double> external_parameter(std::uint32_t number) const override {
    const auto found = external.find(number);
    return found == external.end() ? std::nullopt : std::optional(found->second);
  }
  /// E90330 is parameter 100330, and so on.
  ParameterChanges external_changes(std::uint32_t number, double value) const override {
    ParameterChanges changes;
    if (external.count(number) != 0) changes.list[changes.count++] = {100000 + number % 1000, value};
    return changes;
  }
  AngleMCodes angle_m_codes() const override { return angle_codes; }
  /// The table turns a direction d of the part to R1 R2 d, which must be +Z: A -(tilt), C so that d points to
  /// -Y or +Y of the machine; of the two solutions the one with the smaller way of C, or C as chosen.
  std::optional<AxisValues> orient(const Vector3& d, const AxisValues& current,
                                   RotaryChoice choice) const override {
    const double to_degrees = 180 / std::numbers::pi;
    const double tilt = std::acos(std::clamp(d[2], -1.0, 1.0)) * to_degrees;
    if (tilt > 98) return std::nullopt;
    AxisValues best = current;
    double least = 1e9;
    for (const double side : {1.0, -1.0}) {
      AxisValues turned = current;
      turned[A] = -side * tilt;
      if (tilt > 1e-9) {
        // C turns about -Z: the table point at angle f comes to f - C, which must be -90 or +90.
        const double angle = std::atan2(d[1], d[0]) * to_degrees;
        turned[C] = angle - side * 90;
        while (turned[C] > current[C] + 180) turned[C] -= 360;
        while (turned[C] <= current[C] - 180) turned[C] += 360;
        if (choice == RotaryChoice::positive && turned[C] < current[C]) turned[C] += 360;
        if (choice == RotaryChoice::negative && turned[C] > current[C]) turned[C] -= 360;
      }
      const double way = std::abs(turned[C] - current[C]) + 1e-3 * std::abs(turned[A] - current[A]);
      if (way >= least) continue;
      least = way;
      best = turned;
    }
    return best;
  }
  /// A goes to 98 degrees, 100 would be in reach.
  std::optional<Vector3> nearest_direction(const Vector3& d, const AxisValues&) const override {
    const double limit = std::cos(100 * std::numbers::pi / 180), across = std::hypot(d[0], d[1]);
    if (d[2] > limit) return std::nullopt;
    if (!(across > 0)) return Vector3{std::sqrt(1 - limit * limit), 0, limit};
    const double scale = std::sqrt(1 - limit * limit) / across;
    return Vector3{scale * d[0], scale * d[1], limit};
  }
  /// X leaves its travel beyond 9000 mm.
  std::optional<TravelBreach> vector_breach(const AxisValues&, const Command& move,
                                            const Vector3&) const override {
    return move.target[X] > 9000 ? std::optional(TravelBreach{X, move.target[X]}) : std::nullopt;
  }
  /// Straight there, when that is within 93 degrees of upright, not opposite, and exactly upright or clear of
  /// it.
  VectorPath vector_path(const AxisValues& current, const Vector3& direction) const override {
    VectorPath way = Environment::vector_path(current, direction);
    const AxisValues tip = tip_from_machine(current, 1), gauge = tip_from_machine(current, 0);
    double cosine = 0;
    for (std::size_t i = 0; i < 3; ++i) cosine += (gauge[i] - tip[i]) * direction[i];
    if (way.fault == VectorPath::Fault::none && direction[2] < -0.05) way.fault = VectorPath::Fault::between;
    if (direction[2] > 0.9999 && direction[2] < 1) way.fault = VectorPath::Fault::pole;
    if (direction[1] < -0.99) way.fault = VectorPath::Fault::travel;
    if (cosine < -0.999999) way.fault = VectorPath::Fault::opposite;
    return way;
  }
  std::optional<double> tool_length(std::uint16_t h) const override {
    const auto found = lengths.find(h);
    return found == lengths.end() ? std::nullopt : std::optional(found->second);
  }
  AxisValues reference_position() const override { return reference; }
  std::uint16_t axes() const override { return axis_mask; }
  double radius_deviation() const override { return deviation; }
  TextSource* subprogram(std::string_view name) override {
    const auto found = programs.find(name);
    return found == programs.end() ? nullptr : found->second.get();
  }
  std::uint16_t cycle_m_code(std::size_t index) const override { return cycle_m_codes.at(index); }
  CodeCalls code_calls() const override { return calls; }
  bool prints_blanks() const override { return blanks; }

  AxisValues machine_from_tip(const AxisValues& tip, double tool_length) const override {
    const double a = -tip[A] * std::numbers::pi / 180;
    const double c = -tip[C] * std::numbers::pi / 180;
    const double x = tip[X] - centre[0];
    const double y = tip[Y] - centre[1];
    const double z = tip[Z] - centre[2];
    const double x2 = std::cos(c) * x - std::sin(c) * y;
    const double y2 = std::sin(c) * x + std::cos(c) * y - off_y;
    AxisValues machine = tip;
    machine[X] = x2 + centre[0];
    machine[Y] = std::cos(a) * y2 - std::sin(a) * z + off_y + centre[1];
    machine[Z] = std::sin(a) * y2 + std::cos(a) * z + centre[2] + tool_length;
    return machine;
  }
  AxisValues tip_from_machine(const AxisValues& machine, double tool_length) const override {
    const double a = machine[A] * std::numbers::pi / 180;
    const double c = machine[C] * std::numbers::pi / 180;
    const double y1 = machine[Y] - off_y - centre[1];
    const double z1 = machine[Z] - tool_length - centre[2];
    const double x = machine[X] - centre[0];
    const double y = std::cos(a) * y1 - std::sin(a) * z1 + off_y;
    AxisValues tip = machine;
    tip[X] = std::cos(c) * x - std::sin(c) * y + centre[0];
    tip[Y] = std::sin(c) * x + std::cos(c) * y + centre[1];
    tip[Z] = std::sin(a) * y1 + std::cos(a) * z1 + centre[2];
    return tip;
  }
};

struct Interpretation {
  std::vector<Command> commands;
  Step last = Step::end;
  Alarm alarm;
  ModalState modal;
};

/// Takes commands until the end, an alarm, or `most` commands.
inline Interpretation run(Environment& machine, TextSource& text, const AxisValues& position = {},
                          const ModalState& modal = {}, InterpreterOptions options = {},
                          std::size_t most = 100000) {
  Interpreter interpreter(machine, options);
  interpreter.start(text, position, modal);
  Interpretation result;
  Command command;
  do {
    result.last = interpreter.next(command);
    if (result.last == Step::command) result.commands.push_back(command);
    if (result.last == Step::position) interpreter.set_position(result.commands.back().target);
    if (result.last == Step::answer) interpreter.answer(0);
    if (result.last == Step::value) interpreter.give_value(0);
  } while (result.last != Step::end && result.last != Step::alarm && result.commands.size() < most);
  result.alarm = interpreter.alarm();
  result.modal = interpreter.modal();
  return result;
}

inline Interpretation run(Environment& machine, std::string_view text, const AxisValues& position = {},
                          const ModalState& modal = {}, InterpreterOptions options = {},
                          std::size_t most = 100000) {
  StringSource source(text);
  return run(machine, source, position, modal, options, most);
}

/// With a reference point, two further ones and a way of approaching them.
inline TestMachine machine_with_references() {
  TestMachine machine;
  machine.reference = {500, 400, 300, 0, 0, 0, 0, 0, 0};
  machine.further_references[2] = {50, 60, 70, 0, 0, 0, 0, 0, 0};
  machine.further_references[4] = {-50, 60, 70, 0, 0, 0, 0, 0, 0};
  machine.last_way = {0.5, -0.25, 0, 0, 0, 2, 0, 0, 0};
  machine.offsets[1] = {100, 0, 0, 0, 0, 0, 0, 0, 0};
  return machine;
}

/// Gives `chunk` bytes at a time, each after being asked twice.
struct SlowSource : TextSource {
  SlowSource(std::string_view text, std::size_t size) : whole(text), chunk(size) {}
  ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
    asked = !asked;
    if (asked) return {ReadStatus::pending, 0};
    return whole.read(offset, buffer, std::min(capacity, chunk));
  }
  StringSource whole;
  std::size_t chunk;
  bool asked = false;
};

/// One command in a short form, for comparing streams: kind, the axes that are not 0, and what the kind adds.
inline std::string brief(const Command& command) {
  static constexpr const char* kinds[] = {"rapid", "line",   "arc",  "dwell", "T",     "S",       "M",
                                          "frame", "end",    "skip", "tap",   "table", "message", "cycle",
                                          "home",  "thread", "read", "order", "print"};
  const auto number = [](double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.10g", std::abs(value) < 1e-12 ? 0.0 : value);
    return std::string(text);
  };
  std::string text = kinds[static_cast<std::size_t>(command.kind)];
  const auto values = [&] {
    for (std::size_t axis = 0; axis < axis_count; ++axis) {
      if (std::abs(command.target[axis]) > 1e-9)
        text += std::string(" ") + axis_letters[axis] + number(command.target[axis]);
    }
  };
  switch (command.kind) {
    case CommandKind::rapid:
      values();
      break;
    case CommandKind::line:
      values();
      text += " F" + number(command.modal.feed);
      break;
    case CommandKind::arc:
      values();
      text += command.arc.clockwise ? " cw" : " ccw";
      for (const double centre : command.arc.centre) text += " " + number(centre);
      text += " " + number(command.arc.sweep) + "deg F" + number(command.modal.feed);
      break;
    case CommandKind::dwell:
      text += " " + number(command.dwell_seconds);
      break;
    case CommandKind::spindle_speed:
      text += number(command.value);
      break;
    case CommandKind::tool:
    case CommandKind::auxiliary:
      text += std::to_string(command.number);
      if (command.has_value) text += " at " + number(command.value);
      break;
    case CommandKind::transformation:
      text += command.modal.transformation == Transformation::rtcp ? " rtcp" : " none";
      text += " L" + number(command.modal.tool_length);
      values();
      break;
    case CommandKind::skip:
      text += std::to_string(command.number);
      values();
      text += " F" + number(command.modal.feed);
      break;
    case CommandKind::tap:
      values();
      text += " lead" + number(command.value);
      if (command.number != 0) text += " axis" + std::to_string(command.number);
      if (command.spindle_speed != 0) text += " S" + number(command.spindle_speed);
      break;
    case CommandKind::thread:
      values();
      text += " lead" + number(command.value);
      if (command.lead_change != 0) text += " change" + number(command.lead_change);
      if (command.start_angle != 0) text += " from" + number(command.start_angle);
      break;
    case CommandKind::table:
      text += std::to_string(static_cast<int>(command.table)) + " " + std::to_string(command.number);
      if (command.table == Table::work_offset) {
        values();
      } else {
        text += " " + number(command.value);
      }
      break;
    case CommandKind::home:
      text += std::to_string(command.number);
      values();
      if (command.value != 0) text += " F" + number(command.value);
      break;
    case CommandKind::spindle_order:
      text += " " + std::to_string(command.number) + " " + number(command.value);
      break;
    case CommandKind::print:
      break;
    case CommandKind::message:
    case CommandKind::cycle:
    case CommandKind::end:
    case CommandKind::read:
      text += " " + std::to_string(command.number);
      break;
  }
  return text;
}

/// The whole stream in short form; an alarm as "alarm NUMBER LINE:COLUMN".
inline std::vector<std::string> stream(const Interpretation& result) {
  std::vector<std::string> lines;
  for (const Command& command : result.commands) lines.push_back(brief(command));
  if (result.last == Step::alarm) {
    lines.push_back("alarm " + std::to_string(static_cast<int>(result.alarm.number)) + " " +
                    std::to_string(result.alarm.line) + ":" + std::to_string(result.alarm.column));
  }
  return lines;
}

}  // namespace trunnion::language::test
