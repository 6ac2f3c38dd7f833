// SPDX-License-Identifier: Apache-2.0
// Reads a whole program without a cluster, for what checks, draws or plans it. Moves and alarms are those of
// the channel, for they come from the same ProgramFlow; what the channel asks of others while the axes stand
// is done at once: the PLC carries out every function, a skip move meets nothing, a search for references
// ends at the reference position, the cycle of another service has no parts, spindles are homed,
// synchronized and without error, and signals of the PLC are 0 at first and then 1 and 0 in turn.
#pragma once

#include <functional>
#include <optional>

#include "program_execution/program_flow.hpp"
#include "program_execution/program_motion.hpp"

namespace trunnion::program_execution {

/// How the reading of a program ends.
enum class Ending : std::uint8_t {
  end,           ///< the program ends; M99 in the main program is an end
  repeats,       ///< it would repeat for ever, from repeats_from()
  idle,          ///< it reads on and on without a move: it may wait for a time
  returns,       ///< it has returned to earlier lines too often, the last time to repeats_from()
  alarm,         ///< alarm(), alarm_text()
  stopped,       ///< by ProgramReader::stop or the motion
  text_missing,  ///< the source of the text does not deliver
};

struct ReadingOptions {
  language::SkipLevels block_skip = 0;
  MoveGuard* guard = nullptr;             ///< looks at the moves; must outlive the reader
  language::BlockWatch* watch = nullptr;  ///< sees the blocks before their commands come; likewise
  bool find_repetition = true;
  /// To earlier lines, after which a program is Ending::returns.
  std::uint64_t most_returns = language::EndlessLoop::usual_most_returns;
  /// In a row, without a move, after which a program is Ending::idle.
  std::uint64_t most_idle_lines = 100000000;
  /// Values of spindles and signals, likewise.
  std::uint64_t most_idle_reads = 10000;
};

/// For one program. Too large for the stack of a small thread.
class ProgramReader {
 public:
  /// Judges moves as the channel of `machine` would. `machine` and `motion`, null: there is none, must
  /// outlive the reader.
  explicit ProgramReader(channel_setup::ChannelSetup& machine, const ReadingOptions& options = {},
                         ProgramMotion* motion = nullptr);
  /// Every move that the language allows is possible.
  explicit ProgramReader(language::Environment& environment, const ReadingOptions& options = {});
  ProgramReader(const ProgramReader&) = delete;
  ProgramReader& operator=(const ProgramReader&) = delete;

  /// Sees each command once the channel would have taken it, and its move as motion has got it; the two are
  /// the same but for skip moves, strokes of taps, threads and feeds per revolution. May be empty.
  std::function<void(const language::Command& command, const language::Command& move)> on_command;
  /// Ends the reading when it is true. Asked at least every few thousand commands; may be empty.
  std::function<bool()> stop;

  /// From `start`, machine coordinates.
  Ending read(language::TextSource& text, const AxisValues& start);

  /// Where the command before that of on_command ends, in its frame.
  const AxisValues& from() const { return from_; }
  language::Transformation transformation() const { return transformation_; }
  double tool_length() const { return tool_length_; }
  /// In on_command: just behind the step that has given the command.
  const language::Interpreter& interpreter() const { return flow_.interpreter(); }
  /// As ProgramFlow::alarm() and alarm_text().
  const language::Alarm& alarm() const { return flow_.placed_alarm(); }
  const std::string& alarm_text() const { return flow_.alarm_text(); }
  /// A line of the main program.
  std::uint32_t repeats_from() const { return loop_.line(); }

 private:
  std::optional<Ending> turn();
  std::optional<Ending> go_on_at_rest(FlowState state);
  std::optional<Ending> take(const language::Command& command);
  void answer_read();
  void begin_tapping(const language::Command& stroke);
  void end_tapping();
  void pass(const language::Command& command, const language::Command& move);

  language::Environment& environment_;
  const channel_setup::ChannelSetup* machine_ = nullptr;
  ReadingOptions options_;
  ProgramFlow flow_;
  MotionlessProgram motionless_;
  ProgramMotion* motion_;
  language::EndlessLoop loop_;
  Tapping tapping_;
  bool skip_on_its_way_ = false, read_on_its_way_ = false;
  std::uint64_t reads_ = 0;  // since the newest move
  AxisValues from_{};
  language::Transformation transformation_ = language::Transformation::none;
  double tool_length_ = 0;
};

}  // namespace trunnion::program_execution
