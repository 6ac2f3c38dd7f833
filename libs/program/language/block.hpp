// SPDX-License-Identifier: Apache-2.0
// A block as a reader hands it to the interpreter: letters and numbers, every expression resolved.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "language/alarms.hpp"
#include "language/print_line.hpp"
#include "language/variables.hpp"

namespace trunnion::language {

inline constexpr std::size_t max_g_codes = 20;
inline constexpr std::size_t max_m_codes = 8;
/// Letters I J K of one macro call: ten of each.
inline constexpr std::size_t max_call_centres = 30;
/// Arguments of CYCLE1234(...): #1 to #33, as many as a macro call can set.
inline constexpr std::size_t max_cycle_arguments = 33;
/// Of a message that a reader composes, bytes.
inline constexpr std::size_t longest_text = 96;

/// One G or M of a block.
struct CodeWord {
  double value = 0;
  std::uint16_t offset = 0;   ///< byte of the line, from 0
  std::uint16_t written = 0;  ///< its number in the program, where `value` is that of the same code here
};

enum class Head : std::uint8_t {
  none,
  tape_mark,  ///< a lone %: before the program its start, behind it its end
  program,    ///< %1234, O1234, :1234 or <NAME>
};

/// What a block does beside its words, which in the NUM dialect may be behind THEN and DO, too. IF ... GOTO
/// and IF ... THEN with something behind are gone: they are what is behind them, or an empty block.
enum class Statement : std::uint8_t {
  none,
  assignment,  ///< done by the reader
  go_to,       ///< label
  call_cycle,  ///< program_number and arguments
  print,       ///< printed
  begin_sub,   ///< name; the definition of a subroutine (LinuxCNC), passed but for a call
  end_sub,     ///< name, and the value that the subroutine returns, if any: the first of arguments
  return_sub,  ///< likewise
  call_sub,    ///< name and arguments
  break_loop,  ///< name
  continue_loop,
  modal_state,  ///< label is 70 to 73: M70 .. M73 (LinuxCNC)
  begin_if,     ///< condition
  else_if,      ///< the condition is at `rest`, not evaluated yet: see Dialect::read_condition
  else_,
  end_if,
  begin_while,  ///< condition; ends with ENDW
  end_while,
  begin_do,      ///< condition and label; ends with END and the same label
  end_do,        ///< label
  begin_repeat,  ///< name, and how often: the first of arguments
  end_repeat,
  begin_until,  ///< name; a loop whose condition is at its end
  end_until,    ///< condition. LinuxCNC writes WHILE: OpenStructures::meaning()
};

/// Whether the statement opens, divides or closes a structure of several blocks.
constexpr bool is_structure(Statement statement) { return statement >= Statement::begin_if; }

/// One I, J or K of a macro call, where they may be repeated.
struct CallCentre {
  char letter = 'I';
  std::uint16_t offset = 0;
  double value = 0;
};

/// Which G and M codes a block has.
enum class CodeTable : std::uint8_t { common, linuxcnc };

/// Words behind a comma, kept as further letters: ,C a chamfer and ,R a rounding at the end of the move, ,A
/// the angle of its line.
inline constexpr char chamfer_word = 'A' + 26, rounding_word = 'A' + 27, angle_word = 'A' + 28;
/// The second of two T words (ISO). No letter of the NUM dialect is twice in a block.
inline constexpr char second_tool_word = 'A' + 31;
/// The NUM dialect has no commas, but words of two letters: EC, EX and EZ of threads, EK, EH and ER of rigid
/// tapping.
inline constexpr char taught_angle_word = 'A' + 26, taught_x_word = 'A' + 27, taught_z_word = 'A' + 28;
inline constexpr char retract_ratio_word = 'A' + 29, work_plane_word = 'A' + 30, approach_word = 'A' + 31;
inline constexpr std::size_t word_count = 32;

/// What the thread of a block has to do with the threads around it.
enum class ThreadBlock : std::uint8_t {
  chained,  ///< one thread with those that come directly before and behind it
  first,    ///< begins a thread (NUM: G38+)
  alone,    ///< is a whole thread; the motion code from before it is active again behind it (NUM: G33)
};

/// A letter except G and M occurs at most once in a block, so words are looked up by letter.
struct Block {
  Head head = Head::none;
  bool skipped = false;        ///< begins with / and that level is switched on; nothing else of it was read
  bool message = false;        ///< shows the text at message_at of its line (NUM)
  bool ends_program = false;   ///< its M2 ends the program also where it is called (NUM)
  bool two_tools = false;      ///< T and second_tool_word
  bool spindle_codes = false;  ///< its M64 to M66 choose the spindle of its S (NUM)
  bool haas = false;        ///< words of dwells, cycles and tool offsets mean what they do on Haas controls
  bool local_call = false;  ///< its M98 calls the program that begins at sequence number P (Haas: M97)
  bool every_axis = false;  ///< its G28 is for all axes (Haas)
  Fault refused;  ///< of a code that the dialect does not have: an alarm, unless the code calls a program
  std::uint8_t work_offset = 0;  ///< of its G54.1, when P does not name it; 0: P does
  bool condition = false;
  char lead_word = 'F';  ///< of threads and taps; with K (NUM), F is a feed
  ThreadBlock thread = ThreadBlock::chained;
  Statement statement = Statement::none;
  CodeTable table = CodeTable::common;
  std::uint8_t text_size = 0;  ///< of a message that the reader has composed; 0: message_at tells where it is
  std::uint8_t g_count = 0;
  std::uint8_t m_count = 0;
  std::uint8_t centre_count = 0;
  std::uint16_t at = 0;          ///< byte of the statement
  std::uint16_t rest = 0;        ///< byte behind the word of the statement
  std::uint16_t message_at = 0;  ///< byte of the text behind $
  std::uint32_t label = 0;
  std::uint32_t program_number = 0;
  std::uint32_t called = 0;  ///< the program that the M98 among `m` calls, when P does not name it; 0: P does
  std::uint32_t pointed = 0;  ///< those of `letters` whose number is written with a decimal point
  std::uint32_t letters = 0;  ///< bit 0 = A .. bit 25 = Z, then the others; G and M are not in it
  std::array<double, word_count> values{};
  std::array<std::uint16_t, word_count> offsets{};
  std::array<CodeWord, max_g_codes> g{};
  std::array<CodeWord, max_m_codes> m{};
  std::array<CallCentre, max_call_centres> centres{};
  std::uint64_t name = 0;  ///< NameKey of an O word (LinuxCNC), 0: the statement is none
  std::array<char, longest_text> text{};
  std::uint8_t argument_count = 0;
  std::array<Value, max_cycle_arguments> arguments{};  ///< of call_cycle; vacant: skipped, or a text
  PrintLine printed;                                   ///< of print

  static constexpr std::uint32_t bit(char letter) { return 1u << (letter - 'A'); }
  bool has(char letter) const { return (letters & bit(letter)) != 0; }
  double value(char letter) const { return values[static_cast<std::size_t>(letter - 'A')]; }
  std::uint16_t offset(char letter) const { return offsets[static_cast<std::size_t>(letter - 'A')]; }
  /// What the ends of its structure must have in common with its beginning.
  std::uint64_t key() const { return name != 0 ? name : label; }
  bool empty() const { return letters == 0 && g_count == 0 && m_count == 0 && !message; }
  /// It holds more than its sequence number and its statement.
  bool has_more() const { return (letters & ~bit('N')) != 0 || g_count != 0 || m_count != 0 || message; }
  /// Makes the block empty; what is absent keeps what it had and means nothing.
  void clear() {
    head = Head::none;
    skipped = message = ends_program = two_tools = spindle_codes = haas = local_call = every_axis = false;
    work_offset = 0;
    refused = Fault{};
    lead_word = 'F';
    thread = ThreadBlock::chained;
    statement = Statement::none;
    table = CodeTable::common;
    name = called = 0;
    text_size = 0;
    g_count = m_count = centre_count = argument_count = 0;
    letters = pointed = 0;
  }
};

/// What a line is when it is not executed: enough to find labels, heads and the ends of loops and branches.
struct Outline {
  Head head = Head::none;
  Statement statement = Statement::none;
  std::uint32_t program_number = 0;
  std::optional<std::uint32_t> sequence_number;  ///< N
  std::uint32_t label = 0;                       ///< of begin_do and end_do
  std::uint64_t name = 0;                        ///< as Block::name
  Fault behind;  ///< of else_ and the ends: what read_block finds wrong behind the word
  std::uint64_t key() const { return name != 0 ? name : label; }
};

/// What a line is in front of a program, where a post, a printer or a transmission may leave text.
struct Leader {
  static constexpr std::size_t no_mark = static_cast<std::size_t>(-1);
  bool passes = false;         ///< it cannot be a block
  std::size_t mark = no_mark;  ///< the byte with which the program begins: its %
  bool named = false;          ///< O and a name: a head, if it is the first one behind a %
};

/// Bit n - 1 for block skip level n: /1 .. /9; a lone / is /1.
using SkipLevels = std::uint16_t;

/// What differs between dialects besides the form of a block.
struct DialectRules {
  bool text_ends_subprograms = false;  ///< their text or M2 ends them, and the caller continues
  bool cycle_m_codes = true;           ///< the M codes of parameters 010170 .. 010177 call cycles
  std::uint32_t homing_program = 0;    ///< a call of it, unless it is stored, homes the axis of L0; 0: none
  bool text_closes_else = false;       ///< the end of a program closes an IF behind its ELSE
  bool heads_end_text = true;          ///< a second head ends the started program
  bool returns_to_r = false;           ///< a program begins with G99
  bool number_counts = true;           ///< digits before the last four of a called number may be repetitions
  VariableNumber system_number = nullptr;  ///< as Variables::set_numbers()
  bool tool_times = false;                 ///< #5401 to #5500 are times of tools
  bool tool_diameters = false;  ///< variables and G10 have diameters of tools, where the machine has so
};

/// How one dialect writes blocks. A reader hands over the codes of `g_codes` and `m_codes`, under whatever
/// numbers its dialect has them. Implementations keep no state.
class Dialect {
 public:
  virtual ~Dialect() = default;
  virtual DialectRules rules() const { return {}; }
  /// A word that it does not have is looked up among those of other controls.
  virtual bool names_foreign_words() const { return true; }
  /// Reads one line (without its line end) into `block`; assignments in it are carried out.
  virtual Fault read_block(std::string_view line, SkipLevels skip, Variables& variables,
                           Block& block) const = 0;
  /// The condition of a Statement::else_if, at `rest` of its line.
  virtual Fault read_condition(std::string_view line, std::uint16_t rest, const Variables& variables,
                               bool& condition) const = 0;
  /// Reads no more than that; never fails, because read_block reads the line when it is executed.
  virtual Outline outline(std::string_view line, SkipLevels skip) const = 0;
  /// Of a line that read_block refuses before the program has begun.
  virtual Leader leader(std::string_view line) const {
    static_cast<void>(line);
    return {};
  }
};

}  // namespace trunnion::language
