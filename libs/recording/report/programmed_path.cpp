// SPDX-License-Identifier: Apache-2.0
#include "report/programmed_path.hpp"

#include <memory>

#include "channel_setup/channel_setup.hpp"
#include "motion/path_segment.hpp"
#include "program_execution/program_reader.hpp"

namespace trunnion::report {
namespace {

using language::AxisValues;
using language::CommandKind;

constexpr double chord_error = 1e-6;  // mm
constexpr int most_halvings = 16;

// Appends commands as chords.
class Tracer {
 public:
  Tracer(const channel_setup::ChannelSetup& environment, ProgrammedPath& out)
      : environment_(environment), out_(out) {}

  void begin(const AxisValues& position) {
    const AxisValues tip = environment_.tip_from_machine(position, 0);
    out_.path.start({tip[0], tip[1], tip[2]});
  }

  void take(const AxisValues& from, const language::Command& command) {
    ++out_.commands;
    switch (command.kind) {
      case CommandKind::rapid:
        trace(from, command);
        out_.rapid_lines.insert(command.line);
        break;
      case CommandKind::line:
      case CommandKind::skip:
      case CommandKind::tap:
      case CommandKind::thread:
      case CommandKind::arc: {
        trace(from, command);
        out_.feed_lines.insert(command.line);
        const auto offset = environment_.workpiece_zero(command.modal.work_offset);
        out_.zero = {offset[0], offset[1], offset[2]};
        break;
      }
      case CommandKind::transformation:
      case CommandKind::home:
        jump(command);
        break;
      default:
        break;
    }
  }

 private:
  // A tool length that becomes active moves the evaluated point, not the machine.
  void jump(const language::Command& command) {
    const bool rtcp = command.modal.transformation == language::Transformation::rtcp;
    const auto tip =
        rtcp ? command.target : environment_.tip_from_machine(command.target, command.modal.tool_length);
    if (out_.path.pieces().empty())
      out_.path.start({tip[0], tip[1], tip[2]});
    else
      out_.path.add({{tip[0], tip[1], tip[2]}, command.line, true});
  }

  void trace(const AxisValues& from, const language::Command& command) {
    const bool arc = command.kind == CommandKind::arc;
    const auto segment = arc ? motion::PathSegment::arc(from, command.target, command.arc)
                             : motion::PathSegment::line(from, command.target);
    const bool rtcp = command.modal.transformation == language::Transformation::rtcp;
    const auto tip_at = [&](double s) {
      const AxisValues p = segment.position(s);
      const AxisValues tip = rtcp ? p : environment_.tip_from_machine(p, command.modal.tool_length);
      return Vec3(tip[0], tip[1], tip[2]);
    };
    const bool turns =
        from[3] != command.target[3] || from[4] != command.target[4] || from[5] != command.target[5];
    piece_.line = command.line;
    piece_.rapid = command.kind == CommandKind::rapid;
    const Vec3 end = tip_at(segment.length());
    if (arc || (!rtcp && turns)) {
      // Start with quarters of a turn: a symmetric curve could coincide with its chord.
      const int parts = 4 + static_cast<int>((arc ? command.arc.sweep : 0) / 22.5);
      Vec3 last = tip_at(0);
      for (int k = 1; k <= parts; ++k) {
        const double s0 = segment.length() * (k - 1) / parts, s1 = segment.length() * k / parts;
        const Vec3 next = k == parts ? end : tip_at(s1);
        divide(tip_at, s0, last, s1, next, most_halvings);
        last = next;
      }
    } else {
      add(end);
    }
  }

  template <class TipAt>
  void divide(const TipAt& tip_at, double s0, const Vec3& a, double s1, const Vec3& b, int halvings) {
    const double middle = (s0 + s1) / 2;
    const Vec3 m = tip_at(middle);
    if (halvings == 0 || (m - (a + b) / 2).norm() <= chord_error) {
      add(b);
      return;
    }
    divide(tip_at, s0, a, middle, m, halvings - 1);
    divide(tip_at, middle, m, s1, b, halvings - 1);
  }
  void add(const Vec3& end) {
    const auto& pieces = out_.path.pieces();
    const Vec3 begin = pieces.empty() ? out_.path.start() : pieces.back().end;
    if (!piece_.rapid) out_.feed_length += (end - begin).norm();
    piece_.end = end;
    out_.path.add(piece_);
  }

  const channel_setup::ChannelSetup& environment_;
  ProgrammedPath& out_;
  Piece piece_;
};

}  // namespace

ProgrammedPath programmed_path(const std::string& text, const MachineTables& tables,
                               const AxisValues& position, const std::string& name) {
  ProgrammedPath result;
  channel_setup::ChannelSetup machine(tables);
  // What the machine made of the moves is in the recording: here it only has axes.
  language::Environment& environment = machine;
  const auto reader = std::make_unique<program_execution::ProgramReader>(environment);
  Tracer tracer(machine, result);
  tracer.begin(position);
  reader->on_command = [&](const language::Command& command, const language::Command&) {
    tracer.take(reader->from(), command);
  };
  language::StringSource source(text, name);
  if (reader->read(source, position) == program_execution::Ending::alarm) {
    const auto& alarm = reader->alarm();
    result.problem = std::to_string(alarm.line) + ":" + std::to_string(alarm.column) + ": " +
                     std::string(alarm.text.data());
  }
  result.path.build();
  return result;
}

}  // namespace trunnion::report
