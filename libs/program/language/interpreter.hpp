// SPDX-License-Identifier: Apache-2.0
// Program text to canonical commands, one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "language/block_executor.hpp"
#include "language/block_watch.hpp"
#include "language/control_variables.hpp"
#include "language/endless_loop.hpp"
#include "language/head_dialect.hpp"
#include "language/jump_cache.hpp"
#include "language/line_reader.hpp"
#include "language/macro_call.hpp"
#include "language/modal_calls.hpp"
#include "language/open_structures.hpp"

namespace trunnion::language {

enum class Step : std::uint8_t {
  command,   ///< a command was written
  working,   ///< a bounded number of blocks was read without a command: call again when convenient
  pending,   ///< the text source has to deliver first: call again later
  end,       ///< the end command was taken before
  alarm,     ///< see alarm(); stays so until start()
  position,  ///< a command before was a skip move or a search for references: set_position() must report
             ///< where it ended, for what the program does next depends on it
  answer,    ///< the command before calls a cycle of another service: answer() must report what it has said
  value,     ///< the command before reads a value of a spindle: give_value() must report it
  line,      ///< the line of stop_before_line() would be read next; it will be, when next() is called again
};

struct InterpreterOptions {
  SkipLevels block_skip = 0;  ///< leave out blocks that begin with / (level 1) or /n of a level in it
  bool repeat = true;         ///< M99 in the main program begins it again, else it ends it
  /// A skip move that ends where it was to end has touched there: nothing moves.
  bool assume_contact = false;
};

/// Variables of a control that has never run a program.
inline constexpr VariableStore no_variables{};

/// Interprets a program, pulled by its user. The commands are a function of the texts, the environment, the
/// options, the arguments of start() and the times of set_time() alone, whatever the sizes and delays of the
/// source's chunks; so the k-th command can be found again by taking k commands. Allocates in its constructor
/// only.
///
/// M98 P1234 and G65 P1234 call the program that begins with O1234 or %1234 in the same text, else the text
/// Environment::subprogram finds for "O1234"; M98 P31234 without L calls O1234 three times when there is no
/// O31234, and M98 P1234 H5 begins at its N5; G1007 calls %1007 of the text "USERDEF.CYC". A main program
/// ends with M2, M30, its text, a lone % or the head of the next program; M99 there starts it again from its
/// top. A subprogram must end with M99. GOTO and M99 P look for N forward, then from the top of the program.
/// While G66 is active, each block that moves, but for those of the called macro itself, is followed by the
/// call. What the NUM dialect has instead is in num_dialect.hpp.
///
/// Each text is read in its own dialect, its subprograms with it: that which its head names
/// (head_dialect.hpp), else dialect_without_head(). When its head names none, USERDEF.CYC is ISO, and a file
/// that an O word calls is LinuxCNC.
class Interpreter {
 public:
  /// `environment` and `dialect` must outlive the interpreter. With a dialect every text is read in it.
  explicit Interpreter(Environment& environment, InterpreterOptions options = {},
                       const Dialect* dialect = nullptr);
  Interpreter(const Interpreter&) = delete;
  Interpreter& operator=(const Interpreter&) = delete;

  /// Begins `text`, a program or an MDI line, at `position` (in the frame of `initial.transformation`) with
  /// the modal state of the control at power-on or of the program before, and its variables. Beginning::line
  /// continues in the frames, the cycle and the modal macro of the line before; `initial` is then its
  /// modal().
  void start(TextSource& text, const AxisValues& position, const ModalState& initial,
             const VariableStore& variables = no_variables, Beginning beginning = Beginning::program);

  /// Blocks to leave out, from the next start() on.
  void set_block_skip(SkipLevels levels) { options_.block_skip = levels; }

  /// Once, before `line` (from 1) of the started text is executed for the first time, next() gives
  /// Step::line: modal() and position() are then the state in which it begins. 0 = nowhere. Ends with
  /// start().
  void stop_before_line(std::uint32_t line) { stop_line_ = line; }

  /// Ends a program, without the end command, where `watch` finds that it repeats for ever. It must be used
  /// for one program and outlive it; null: none.
  void watch_loops(EndlessLoop* watch) { watch_ = watch; }

  /// Lets `watch` see the blocks as they are read; it must outlive the interpreter's use; null: none.
  void watch_blocks(BlockWatch* watch) { block_watch_ = watch; }

  /// The next command. Before start() there is only the end.
  Step next(Command& command);

  /// Why next() gave Step::alarm.
  const Alarm& alarm() const { return alarm_; }

  /// Sets where the machine really is, in the frame of modal().transformation, for the blocks not read yet:
  /// after a move that ended elsewhere than commanded. Only sensible when next() has nothing prepared: after
  /// Step::end, or the command of a block's end.
  void set_position(const AxisValues& position) { set_position(position, position); }
  /// The same behind a skip move; `touched` is where its input found the axes (#5061). A search for
  /// references (G28.2) leaves #5061.
  void set_position(const AxisValues& position, const AxisValues& touched);

  /// Step::position is that of a search for references.
  bool homing() const { return executor_.homing(); }
  /// The axes that had their reference when the text began, bit a for Axis a; nothing: it is not known any
  /// more, and a program that asks (#1321) has an alarm. All before the first call.
  void set_homed(std::optional<std::uint16_t> axes) { control_.set_homed(axes); }

  /// The parts machined, which #3901 reads until the program writes it.
  void set_parts(double parts) { control_.set_parts(parts); }

  /// The answer of a called cycle, which #3100 reads. Programs that are called from now on are looked for
  /// again: the service may have stored another text.
  void answer(double value);

  /// The value that a command of kind read has asked for. The line that needs it is read again.
  void give_value(double value) { control_.give_value(value); }

  /// What the variables of time show from now on; before the first call they show zero.
  void set_time(const ControlTime& time) { control_.set_time(time); }

  /// Of the started text; known with the first command or alarm.
  ProgramDialect dialect() const { return levels_[0].dialect; }
  /// The state after the last block that was read.
  const ModalState& modal() const { return executor_.modal(); }
  const AxisValues& position() const { return executor_.position(); }
  /// Where the last command that next() gave ends in the workpiece: without offsets and, but for tool tip
  /// control, the tool length.
  AxisValues workpiece(const Command& command) const;
  /// That of the blocks read so far.
  const ProgramFrame& frame() const { return executor_.frame(); }
  /// The frame in which a command that next() has just given was programmed.
  const ProgramFrame& frame_of(const Command& command) const {
    return executor_.frame_of(command.modal.frame);
  }
  /// Blocks executed since start(), a loop's each time.
  std::uint64_t blocks() const { return blocks_; }
  /// Lines read since start(), also those that a jump or a call has searched; a loop's each time. Those of a
  /// head that are read for its dialect do not count.
  std::uint64_t lines() const { return lines_; }
  const VariableStore& variables() const { return variables_.store(); }
  /// The local variables of the macro that is being read.
  const std::array<Value, local_variables>& locals() const { return variables_.locals(); }
  /// The line of the started text that is executed, or has called what is.
  std::uint32_t main_line() const { return depth_ == 0 ? line_ : levels_[1].call_line; }

  /// The text behind $ of the newest block that has one, as a display can show it, at most `longest_message`
  /// bytes: until next() is called behind its CommandKind::message.
  std::string_view message_text() const { return {message_.data(), message_size_}; }

  /// The line that a CommandKind::print has: until next() is called behind it.
  std::string_view print_text() const { return block_.printed.view(); }

  /// Positions, frames and tables as the program has left them, for system variables.
  const BlockExecutor& executor() const { return executor_; }

  static const Dialect& dialect_of(ProgramDialect name);
  static constexpr std::size_t longest_message = longest_text;

  /// Of a text from named_texts on that this program has called; else empty.
  FileName file_name(std::uint32_t program) const;

 private:
  struct CallLevel {
    TextSource* source = nullptr;
    std::uint32_t program = 0;
    TextPosition top;             // first line of what is called
    TextPosition home;            // first line of the program that it is in
    TextPosition resume;          // where the caller continues
    std::uint32_t call_line = 0;  // of the caller
    std::uint32_t remaining = 0;  // repetitions after this one
    bool started = false;         // a head or a word has been read
    bool taped = false;           // nothing but comments has been read behind the % of the tape
    bool own_variables = false;
    bool by_code = false;     // codes that call programs are ordinary ones here
    bool from_label = false;  // begins at `label`
    std::uint32_t label = 0;
    bool modal = false;  // called by G66
    ProgramDialect dialect = ProgramDialect::iso;
    std::uint64_t sub = 0;        // the subroutine, 0: no O word has called it
    bool defined = false;         // its definition was read
    std::size_t modal_above = 0;  // of ModalCalls::enter()
    OpenStructures open;
  };
  /// By M70 or M73 of LinuxCNC, at one level.
  struct KeptModes {
    SavedModes modes;
    bool valid = false;
    bool returns = false;  // at the end of the level
  };
  /// Where a call from one text leads, so that a long text is searched once and not at every call.
  struct Found {
    const TextSource* caller = nullptr;
    std::uint32_t number = 0;       // as it was called
    std::uint32_t repetitions = 0;  // when the number holds them
    bool cycle = false;
    bool local = false;  // the number is a sequence number of the program at `home`
    TextSource* source = nullptr;
    std::uint32_t program = 0;
    TextPosition top, home;
    ProgramDialect dialect = ProgramDialect::iso;
    std::uint64_t name = 0;  // of a subroutine
  };
  enum class State : std::uint8_t { running, heading, searching, done, failed };
  enum class Purpose : std::uint8_t {
    program,  ///< the head of a program
    label,    ///< a sequence number
    local,    ///< the sequence number at which a called part of the program begins
    branch,   ///< ELSEIF, ELSE or ENDIF of the innermost IF
    end,      ///< the line behind the end of a structure
    last,     ///< the end of a structure
    sub_end,  ///< the line behind the end of a subroutine
    sub,      ///< the definition of one
    leader,   ///< the % behind text that is no program; in no key()
  };
  /// State::heading: the head of a text is read for its dialect.
  struct Heading {
    enum class Then : std::uint8_t {
      start,   ///< the text is the started one
      enter,   ///< it is the program that is called
      search,  ///< the program that is called is in it
    };
    Then then = Then::start;
    TextSource* source = nullptr;
    std::uint32_t program = 0;  // as Command::program
  };
  struct Search {
    Purpose purpose = Purpose::program;
    ProgramDialect dialect = ProgramDialect::iso;  // of the source
    TextSource* source = nullptr;
    std::uint64_t wanted = 0;
    TextPosition from;          // of the line that jumps
    bool from_top = false;      // second half of the search for a label
    bool heading = false;       // of a label from the top on: the head of the program has not been passed
    bool begun = false;         // something before the line is no blank
    bool in_file = false;       // the file of a subroutine
    std::uint32_t program = 0;  // of the text in which a subroutine is looked for
    std::size_t depth = 0;      // structures open where the search must arrive
    OpenStructures open;
  };

  void use_dialect(ProgramDialect name);
  void take_rules();
  State read_head(TextSource& source, std::uint32_t program, Heading::Then then);
  State head_line(Step& step);
  /// The line may be text in front of the % with which a tape begins.
  bool passes_before_head(std::string_view line) const;
  State head_ended(ProgramDialect dialect);
  /// The dialect of the text whose head is read, when it names none.
  ProgramDialect headless() const;
  State fail_head(const HeadLine& head, std::uint32_t number, std::string_view line);

  State run_line(Step& step);
  State execute(std::string_view line);
  State execute_block(std::string_view line);
  State execute_words(std::string_view line);
  State ask_value(std::string_view line);
  Fault carry_out_requests();
  State go(const Flow& flow, std::string_view line);
  State end_of_text();
  bool jumped_back(std::uint64_t from, std::size_t depth) const;
  bool repeats_for_ever();
  State fail(const Fault& fault, std::string_view line);
  State fail(const Alarm& alarm);
  State report_line_status(LineReader::Status status, Step& step);
  Alarm located(const Fault& fault, std::string_view line);
  Alarm named(const Fault& fault, std::string_view line);

  State run_statement(std::string_view line);
  State call_cycle(std::string_view line);
  State branch(bool condition, std::string_view line);
  State execute_rest(std::string_view line);
  static constexpr std::size_t innermost = static_cast<std::size_t>(-1);
  /// `depth` counts the structure that the jump looks for the parts of.
  State jump(Purpose purpose, std::uint64_t wanted, TextPosition from, const Fault& in_vain,
             std::string_view line, std::size_t depth = innermost);
  State search(Purpose purpose, std::uint64_t wanted, TextPosition from, std::size_t depth = innermost);
  State arrive(const JumpCache::Target& target);
  State search_line(Step& step);
  State pass_leader(const Fault& fault, std::string_view line);
  State pass_leader(const Leader& leader, TextPosition position);
  State label_found(TextPosition position);
  bool structure_found(Statement statement, std::uint64_t named) const;
  State search_ended();
  static std::uint64_t key(Purpose purpose, std::uint64_t wanted) {
    return (wanted << 3) | static_cast<std::uint64_t>(purpose);
  }
  State repeat(std::string_view line);

  // O words of LinuxCNC (interpreter_subs.cpp).
  State call_sub(std::string_view line);
  State begin_sub(std::string_view line);
  State return_from_sub(std::string_view line);
  State leave_loop(std::string_view line);
  State change_modes(std::string_view line);
  /// Restores what M73 has saved at this level.
  Fault return_modes();
  State search_sub(const Outline& outline, TextPosition position, std::string_view line);
  State search_sub_elsewhere();
  /// The file with the name of the called subroutine; null when there is none.
  TextSource* find_file();

  State call_macro(Call& call, std::string_view line);
  Fault carry_out_beside(const Call& call);
  void add_settings(const Call& call);
  std::optional<State> call_by_code(std::string_view line);
  State call(const Call& call, std::string_view line);
  /// What begins at sequence number `call.number` of this program.
  State call_locally(const Call& call, std::string_view line);
  void begin_call(const Call& call);
  State found(TextSource& source, std::uint32_t program, TextPosition top, ProgramDialect dialect);
  State enter(const Found& target);
  State begin_program();
  /// The axis whose number is in L0: X Y Z U V W A B C.
  std::optional<std::size_t> homing_axis() const;
  State home_axis();
  State return_from_subprogram(const Flow& flow, std::string_view line);

  Environment& environment_;
  const Dialect* const chosen_;
  const Dialect* dialect_;  // of the text that is read
  ProgramDialect dialect_name_ = ProgramDialect::iso;
  DialectRules rules_;
  InterpreterOptions options_;
  BlockExecutor executor_;
  ControlVariables control_;
  Variables variables_;
  LineReader reader_;
  CommandQueue queue_;
  Block block_;
  Block beside_;  // the codes beside that of a call
  CycleMCodes cycle_m_codes_{};
  CodeCalls code_calls_;
  bool calls_by_code_ = false;
  std::array<CallLevel, max_nesting + 1> levels_{};
  std::array<KeptModes, max_nesting + 1> kept_modes_{};
  std::size_t depth_ = 0;
  State state_ = State::done;
  Alarm alarm_;
  std::array<char, longest_message> message_{};
  std::size_t message_size_ = 0;
  std::uint32_t line_ = 0;  // of the block being executed
  std::uint32_t stop_line_ = 0;
  EndlessLoop* watch_ = nullptr;
  BlockWatch* block_watch_ = nullptr;
  std::uint64_t blocks_ = 0, lines_ = 0;
  TextPosition position_;     // of that line
  bool else_if_due_ = false;  // the next line is an ELSEIF whose condition decides
  bool had_leader_ = false;   // of the started text
  bool begins_program_ = false;
  Heading heading_;
  // A jump or a call that looks for its target, and the alarms if it is not found or not allowed.
  Search search_;
  JumpCache jumps_;
  Alarm not_found_;
  Alarm not_allowed_;
  Alarm label_not_found_;  // of the sequence number at which a called program begins
  // A call that looks for its program: what was called and where to return to.
  Call call_;
  std::uint32_t called_ = 0;  // the number as written
  Arguments arguments_;
  TextPosition after_call_;
  std::uint32_t call_line_ = 0;
  ModalCalls modal_calls_;
  std::array<char, 64> file_{};  // of the called subroutine
  std::size_t file_size_ = 0;
  std::array<FileName, 32> named_texts_{};
  std::size_t named_text_count_ = 0;
  std::array<Found, 16> found_{};
  std::size_t next_found_ = 0;  // the entry the next search replaces
};

}  // namespace trunnion::language
