// SPDX-License-Identifier: Apache-2.0
#include "core/program_check.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "language/arc_geometry.hpp"
#include "language/macro_call.hpp"
#include "program_execution/program_reader.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;
using language::AxisValues;
using language::Command;
using language::CommandKind;
using program_execution::Ending;
using program_execution::ProgramReader;

constexpr double degrees_of_piece = 6;  ///< of arcs and of the swings of rotary axes
constexpr double decimals = 1e4;

bool moves(const Command& command) {
  return command.kind == CommandKind::rapid || command.kind == CommandKind::line ||
         command.kind == CommandKind::arc || command.kind == CommandKind::skip ||
         command.kind == CommandKind::tap || command.kind == CommandKind::thread;
}

/// Collects the path as columns.
class Path {
 public:
  explicit Path(const channel_setup::ChannelSetup& machine)
      : machine_(machine), zero_(machine.work_offset(0)) {}

  /// From `from` to the end of `command`, both in the command's frame.
  void add(const AxisValues& from, const Command& command, std::uint32_t line) {
    if (x_.empty()) point(from, command, line);
    const bool arc = command.kind == CommandKind::arc;
    double degrees = arc ? command.arc.sweep : 0;
    if (!arc && command.modal.transformation != language::Transformation::rtcp)
      for (std::size_t axis = 3; axis < 6; ++axis)
        degrees = std::max(degrees, std::abs(command.target[axis] - from[axis]));
    const auto pieces = static_cast<std::size_t>(std::ceil(std::min(degrees, 36000.0) / degrees_of_piece));
    for (std::size_t i = 1; i < pieces; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(pieces);
      AxisValues place = command.target;
      if (arc)
        place = language::point_on_arc(from, command.target, command.arc, share);
      else
        for (std::size_t axis = 0; axis < place.size(); ++axis)
          place[axis] = from[axis] + share * (command.target[axis] - from[axis]);
      point(place, command, line);
    }
    point(command.target, command, line);
  }

  Json json() const {
    return {{"x", x_}, {"y", y_}, {"z", z_}, {"line", line_}, {"rapid", rapid_}, {"whole", whole_}};
  }

 private:
  void point(const AxisValues& place, const Command& command, std::uint32_t line) {
    if (x_.size() == most_path_points) {
      whole_ = false;
      return;
    }
    const bool tip = command.modal.transformation == language::Transformation::rtcp;
    const auto at = tip ? place : machine_.tip_from_machine(place, command.modal.tool_length);
    const auto rounded = [&](std::size_t axis) {
      return std::round((at[axis] - zero_[axis]) * decimals) / decimals + 0.0;
    };
    x_.push_back(rounded(0)), y_.push_back(rounded(1)), z_.push_back(rounded(2));
    line_.push_back(line);
    rapid_.push_back(command.kind == CommandKind::rapid);
  }

  const channel_setup::ChannelSetup& machine_;
  AxisValues zero_;
  std::vector<double> x_, y_, z_;
  std::vector<std::uint32_t> line_;
  std::vector<bool> rapid_;
  bool whole_ = true;
};

Json error_of(const ProgramReader& reader) {
  const auto& alarm = reader.alarm();
  // Bodies and positions of a contact are more than an alarm of the language has room for.
  const auto& whole = reader.alarm_text();
  const std::string text = alarm.column == 0 ? whole.substr(whole.find(": ") + 2) : alarm.text.data();
  Json error = {{"line", alarm.line},
                {"column", alarm.column},
                {"number", static_cast<unsigned>(alarm.number)},
                {"text", text}};
  if (alarm.program == 0) return error;
  error["program"] = alarm.file_name.front() != '\0'
                         ? std::string(alarm.file_name.data())
                         : std::string(language::ProgramName(alarm.program).view());
  error["program_line"] = alarm.line;
  error["column"] = 0;
  error["line"] = alarm.calls > 0 ? alarm.chain[0].line : reader.interpreter().main_line();
  return error;
}

}  // namespace

Json check_program(language::TextSource& text, channel_setup::ChannelSetup& machine,
                   program_execution::MoveGuard* guard, const std::function<bool()>& stop) {
  program_execution::ReadingOptions options;
  options.guard = guard;
  const auto reader = std::make_unique<ProgramReader>(machine, options);
  Path path(machine);
  std::uint64_t moved = 0;
  reader->stop = stop;
  reader->on_command = [&](const Command& command, const Command&) {
    if (!moves(command)) return;
    // Of the text: a subprogram's moves are those of the line that calls it.
    path.add(reader->from(), command,
             command.program == 0 ? command.line : reader->interpreter().main_line());
    ++moved;
  };
  const auto ending = reader->read(text, machine.reference_position());
  const bool whole = ending == Ending::end || ending == Ending::repeats || ending == Ending::alarm;
  Json answer = {{"complete", whole}};
  answer["dialect"] = std::string(canonical::dialect_name(reader->interpreter().dialect()));
  if (ending == Ending::alarm) answer["error"] = error_of(*reader);
  answer["blocks"] = reader->interpreter().blocks();
  answer["moves"] = moved;
  answer["path"] = path.json();
  return answer;
}

}  // namespace trunnion::gateway
