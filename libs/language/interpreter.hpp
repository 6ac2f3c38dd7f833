// Program text to canonical commands, one at a time.
#pragma once

#include <array>
#include <cstdint>

#include "language/block_executor.hpp"
#include "language/iso_dialect.hpp"
#include "language/line_reader.hpp"

namespace trunnion::language {

enum class Step : std::uint8_t {
  command,   ///< a command was written
  working,   ///< a bounded number of blocks was read without a command: call again when convenient
  pending,   ///< the text source has to deliver first: call again later
  end,       ///< the end command was taken before
  alarm,     ///< see alarm(); stays so until start()
  position,  ///< the command before was a skip move: set_position() must tell where it ended, for what the
             ///< program does next depends on it
};

struct InterpreterOptions {
  bool block_skip = false;  ///< leave out blocks that begin with /
};

/// Subprograms below the main program.
inline constexpr std::size_t max_nesting = 8;

/// Interprets a program, pulled by its user. The commands are a function of the texts, the environment, the
/// options and the arguments of start() alone, whatever the sizes and delays of the source's chunks; so the
/// k-th command can be found again by taking k commands. Allocates in its constructor only.
///
/// M98 P1234 calls the program that begins with O1234 or %1234 in the same text, else the text
/// Environment::subprogram finds for "O1234". A main program ends with M2, M30, its text, a lone % or the
/// head of the next program; M99 there starts it again from its top. A subprogram must end with M99.
class Interpreter {
 public:
  /// `environment` and `dialect` must outlive the interpreter.
  explicit Interpreter(Environment& environment, InterpreterOptions options = {},
                       const Dialect& dialect = iso_dialect());

  /// Begins `text`, a program or an MDI line, at `position` (in the frame of `initial.transformation`) with
  /// the modal state of the control at power-on or of the program before.
  void start(TextSource& text, const AxisValues& position, const ModalState& initial);

  /// The next command. Before start() there is only the end.
  Step next(Command& command);

  /// Why next() gave Step::alarm.
  const Alarm& alarm() const { return alarm_; }

  /// Tells where the machine really is, in the frame of modal().transformation, for the blocks not read yet:
  /// after a move that ended elsewhere than commanded. Only sensible when next() has nothing prepared: after
  /// Step::end, or the command of a block's end.
  void set_position(const AxisValues& position) { executor_.set_position(position); }

  /// The state after the last block that was read.
  const ModalState& modal() const { return executor_.modal(); }
  const AxisValues& position() const { return executor_.position(); }

  /// Positions, frames and tables as the program has left them, for system variables.
  const BlockExecutor& executor() const { return executor_; }

  static const Dialect& iso_dialect();

 private:
  struct Frame {
    TextSource* source = nullptr;
    std::uint32_t program = 0;
    TextPosition top;             // first line of the program
    TextPosition resume;          // where the caller goes on
    std::uint32_t remaining = 0;  // repetitions after this one
    bool begun = false;           // a head or a word has been read
  };
  /// Where a call from one text leads, so that a long text is searched once and not at every call.
  struct Found {
    const TextSource* caller = nullptr;
    std::uint32_t number = 0;
    TextSource* source = nullptr;
    std::uint32_t program = 0;
    TextPosition top;
  };
  enum class State : std::uint8_t { running, searching, done, failed };

  State run_line(Step& step);
  State search_line(Step& step);
  State execute(std::string_view line);
  State go(const Flow& flow, std::string_view line);
  State end_of_text();
  State found(TextSource& source, std::uint32_t program, TextPosition top);
  State enter(const Found& target);
  State return_from_subprogram();
  State fail(const Fault& fault, std::string_view line);
  State report_line_status(LineReader::Status status, Step& step);

  Environment& environment_;
  const Dialect& dialect_;
  InterpreterOptions options_;
  BlockExecutor executor_;
  LineReader reader_;
  CommandQueue queue_;
  Block block_;
  std::array<Frame, max_nesting + 1> frames_{};
  std::size_t depth_ = 0;
  State state_ = State::done;
  Alarm alarm_;
  std::uint32_t line_ = 0;  // of the block being executed
  // A call that looks for its program: what was called, where to come back, and the alarm if it is in vain.
  Flow call_;
  TextPosition after_call_;
  Alarm not_found_;
  std::array<Found, 16> found_{};
  std::size_t next_found_ = 0;  // the entry the next search replaces
};

}  // namespace trunnion::language
