// SPDX-License-Identifier: Apache-2.0
#include "language/num_dialect.hpp"

#include <array>
#include <bit>
#include <cmath>

#include "canonical/spindle_value.hpp"
#include "language/arithmetic.hpp"
#include "language/letters.hpp"
#include "language/macro_call.hpp"
#include "language/num_codes.hpp"
#include "language/num_expression.hpp"
#include "language/scanner.hpp"
#include "text/utf8.hpp"

namespace trunnion::language {
namespace {

constexpr double highest_sequence_number = 99999999;
constexpr double largest_parameter = 2147483647;
constexpr double tap_removal = 84.9;    // of g_codes
constexpr double thread_motion = 33;    // the same
constexpr double active_motion = 4001;  // variable with the motion code in force
constexpr std::uint32_t num_letters = letter_bits("ABCFHKRSTUVWXYZ");
constexpr std::uint32_t homing_program = 9990 + 9 * program_tenth;
constexpr const char* thread_cycle = "thread cutting cycle";

/// E and a letter: words of G84, and of functions that are not there.
struct PairWord {
  char second;
  char word;             ///< of the block; zero when the function is not there
  const char* function;  ///< that is not there
};
constexpr std::array pair_words = {
    PairWord{'A', '\0', thread_cycle},     PairWord{'B', '\0', thread_cycle},
    PairWord{'S', '\0', thread_cycle},     PairWord{'H', work_plane_word, ""},
    PairWord{'K', retract_ratio_word, ""}, PairWord{'R', approach_word, ""},
};

Fault program_of(double value, std::uint16_t at, std::uint32_t& number) {
  const double tenths = std::round(value * 10);
  if (std::abs(value * 10 - tenths) > 1e-6) return {AlarmNumber::not_an_integer, at};
  if (!(tenths >= 10 && tenths <= 999999)) return {AlarmNumber::value_range, at};
  const auto whole = static_cast<std::uint32_t>(tenths);
  number = whole / 10 + whole % 10 * program_tenth;
  return {};
}

/// A % and its number.
Fault read_num_head(Scanner& scanner, std::uint32_t& number) {
  const std::uint16_t at = scanner.offset();
  scanner.advance();
  scanner.skip_blanks();
  const Decimal decimal = scanner.number();
  if (decimal.status == DecimalStatus::missing) return {AlarmNumber::number_missing, at};
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  return program_of(decimal.value, at, number);
}

Fault read_sequence_number(Scanner& scanner, std::uint16_t at, std::uint32_t& number) {
  scanner.skip_blanks();
  const Decimal decimal = scanner.number();
  if (decimal.status == DecimalStatus::missing) return {AlarmNumber::number_missing, at};
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  if (decimal.value != std::floor(decimal.value)) return {AlarmNumber::not_an_integer, at};
  if (decimal.value < 0 || decimal.value > highest_sequence_number) return {AlarmNumber::value_range, at};
  number = static_cast<std::uint32_t>(decimal.value);
  return {};
}

/// Past blanks and comments; false at an open comment.
bool skip_remarks(Scanner& scanner) {
  while (scanner.more() && scanner.peek() == '(') {
    if (!scanner.skip_comment()) return false;
  }
  return true;
}

/// Takes the word that opens, divides or closes a structure.
Statement take_structure(Scanner& scanner) {
  if (scanner.take_word("IF")) return Statement::begin_if;
  if (scanner.take_word("ELSE")) return Statement::else_;
  if (scanner.take_word("ENDI")) return Statement::end_if;
  if (scanner.take_word("WHILE")) return Statement::begin_while;
  if (scanner.take_word("ENDW")) return Statement::end_while;
  return Statement::none;
}

class NumReader {
 public:
  NumReader(std::string_view line, SkipLevels skip, Variables& variables, Block& block)
      : line_(line),
        skip_(skip),
        scanner_(line),
        variables_(variables),
        expressions_(scanner_, variables),
        block_(block) {}

  Fault read() {
    block_.clear();
    if (scanner_.more() && scanner_.peek() == '/') {
      scanner_.advance();
      block_.skipped = (skip_ & 1u) != 0;
      if (block_.skipped) return {};
    }
    if (scanner_.more() && scanner_.peek() == '%') {
      if (const Fault fault = read_num_head(scanner_, block_.program_number)) return fault;
      block_.head = Head::program;
    }
    while (!done_ && scanner_.more()) {
      if (const Fault fault = item()) return fault;
    }
    return complete();
  }

 private:
  Fault item() {
    const char c = scanner_.peek();
    const char upper = letter(c);
    const std::uint16_t at = scanner_.offset();
    if (upper != '\0') {
      const Statement statement = take_structure(scanner_);
      if (statement != Statement::none) return structure(statement, at);
      if (upper == 'E') return e_item(at);
      if (upper == 'L') return assign_variable(at);
      const char second = letter(scanner_.peek(1));
      if (second != '\0' && second != 'E' && second != 'L' && !homes(upper))
        return {AlarmNumber::unknown_instruction, at};
      return word(upper, at);
    }
    if (c == '(') return scanner_.skip_comment() ? Fault{} : Fault{AlarmNumber::open_comment, at};
    if (c == '$') {
      scanner_.advance();
      block_.message = scanner_.more();
      done_ = true;
      return {};
    }
    if (c == '%' || c == '/') return {AlarmNumber::misplaced_head, at};
    const bool broken = text::valid_utf8_prefix(line_.substr(at, 4)) == 0;
    return {broken ? AlarmNumber::not_utf8 : AlarmNumber::unknown_character, at};
  }

  Fault structure(Statement statement, std::uint16_t at) {
    if (any_ || block_.head != Head::none) return {AlarmNumber::statement_not_first, at};
    any_ = true;
    block_.statement = statement;
    block_.at = at;
    const bool branch = statement == Statement::begin_if;
    if (!branch && statement != Statement::begin_while) return end_of_block();
    if (const Fault fault = expressions_.condition(block_.condition)) return fault;
    if (!scanner_.more() || !scanner_.take_word(branch ? "THEN" : "DO"))
      return {AlarmNumber::operand_missing, scanner_.offset(), branch ? "needs THEN" : "needs DO"};
    // What follows counts only when the condition holds.
    done_ = !block_.condition;
    return {};
  }

  /// Only comments may follow.
  Fault end_of_block() {
    done_ = true;
    if (!skip_remarks(scanner_)) return {AlarmNumber::open_comment, scanner_.offset()};
    return scanner_.at_end() ? Fault{} : Fault{AlarmNumber::text_behind_statement, scanner_.offset()};
  }

  Fault e_item(std::uint16_t at) {
    const char second = letter(scanner_.peek(1));
    if (second == '\0') return assign_parameter(at);
    if (second == 'C') return takes_up() ? taught_word(taught_angle_word, at) : spindle_angle(at);
    if (second == 'X') return taught_word(taught_x_word, at);
    if (second == 'Z') return taught_word(taught_z_word, at);
    for (const PairWord& pair : pair_words) {
      if (pair.second != second) continue;
      scanner_.advance(2);
      double value = 0;
      if (const Fault fault = number(at, value)) return fault;
      if (pair.word == '\0') return {AlarmNumber::num_function_missing, at, pair.function};
      any_ = true;
      if (block_.has(pair.word)) return {AlarmNumber::letter_twice, at};
      store(pair.word, value, at);
      return {};
    }
    return {AlarmNumber::unknown_instruction, at};
  }

  /// The thread of the block may begin in phase with one that is there: EC is its angle.
  bool takes_up() const { return thread_ == NumUse::one_pass || thread_ == NumUse::resumed; }

  /// EC, EX and EZ of G33; G38+ has its EC already.
  Fault taught_word(char name, std::uint16_t at) {
    scanner_.advance(2);
    double value = 0;
    if (const Fault fault = number(at, value)) return fault;
    any_ = true;
    if (thread_ != NumUse::one_pass && name != taught_angle_word) return {AlarmNumber::num_word, at};
    if (block_.has(name)) return {AlarmNumber::letter_twice, at};
    store(name, value, at);
    return {};
  }

  /// EC elsewhere: the angle of the synchronizations that are ordered from now on.
  Fault spindle_angle(std::uint16_t at) {
    scanner_.advance(2);
    double value = 0;
    if (const Fault fault = number(at, value)) return fault;
    any_ = assigned_ = true;
    orders_angle_ = true;
    angle_at_ = at;
    return order(canonical::order_angle, value, at);
  }

  Fault order(std::uint32_t number, double value, std::uint16_t at) {
    if (!orders_) order_at_ = at;
    orders_ = true;
    Fault fault = variables_.write_external(number, value);
    fault.offset = at;
    return fault;
  }

  Fault assigned(double& value) {
    any_ = assigned_ = true;
    if (!scanner_.take('=')) return {AlarmNumber::operand_missing, scanner_.offset(), "needs ="};
    return expressions_.expression(value);
  }

  Fault assign_variable(std::uint16_t at) {
    scanner_.advance();
    std::uint32_t number = 0;
    double value = 0;
    if (const Fault fault = expressions_.variable(at, number)) return fault;
    if (const Fault fault = assigned(value)) return fault;
    const AlarmNumber alarm = variables_.write(number, Value::of(value));
    return alarm == AlarmNumber::none ? Fault{} : Fault{alarm, at};
  }

  Fault assign_parameter(std::uint16_t at) {
    scanner_.advance();
    ExternalPlace place;
    double value = 0;
    if (const Fault fault = expressions_.parameter(at, place)) return fault;
    if (!place.is_free() && !place.row->writable) return {AlarmNumber::variable_read_only, at, place.name()};
    if (const Fault fault = assigned(value)) return fault;
    value = nearly_whole(value);
    if (!place.is_free()) {
      Fault fault = order(place.number(), value, at);
      if (fault && fault.number != value_pending && fault.detail == nullptr &&
          fault.number != AlarmNumber::spindle_without_mark)
        fault.detail = place.name();
      return fault;
    }
    if (value != std::floor(value) || std::abs(value) > largest_parameter)
      return {AlarmNumber::variable_value, at, "a whole number"};
    const AlarmNumber alarm = variables_.write(first_free_variable + place.index, Value::of(value));
    return alarm == AlarmNumber::none ? Fault{} : Fault{alarm, at};
  }

  /// The number behind a letter: literal, or the value of a variable or parameter.
  Fault number(std::uint16_t at, double& value) {
    scanner_.skip_blanks();
    const char sign = scanner_.peek(0);
    const char first = letter(scanner_.peek(sign == '-' || sign == '+' ? 1 : 0));
    if (first == 'L' || first == 'E') {
      if (const Fault fault = expressions_.value(value)) return fault;
      value = nearly_whole(value);
      return std::abs(value) > largest_number ? Fault{AlarmNumber::number_range, at} : Fault{};
    }
    const Decimal decimal = scanner_.number();
    if (decimal.status == DecimalStatus::missing) return {AlarmNumber::number_missing, at};
    if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
    value = decimal.value;
    return {};
  }

  Fault word(char name, std::uint16_t at) {
    scanner_.advance();
    if (name == 'G') return g_word(at);
    if (name == 'N') return sequence_number(at);
    if (thread_ == NumUse::one_pass && (name == 'P' || name == 'Q'))
      return {AlarmNumber::num_function_missing, at, thread_cycle};
    if (name != 'M' && (num_letters & Block::bit(name)) == 0) return {AlarmNumber::num_word, at};
    double value = 0;
    if (!names_axis(name)) {
      if (const Fault fault = number(at, value)) return fault;
    }
    any_ = true;
    if (name == 'M') {
      if (value == 30 || value == 98 || value == 99) return {AlarmNumber::num_m_unknown, at};
      return add_m(value, at);
    }
    if (block_.has(name)) return {AlarmNumber::letter_twice, at};
    store(name, value, at);
    return {};
  }

  /// `name` may be one of the axes of G159.
  bool homes(char name) const { return homes_ && (Block::bit(name) & axis_bits) != 0; }
  /// It is, and has no number.
  bool names_axis(char name) {
    if (!homes(name)) return false;
    if (!scanner_.more()) return true;
    const char next = scanner_.peek();
    return letter(next) != '\0' || next == '(' || next == '$';
  }

  Fault sequence_number(std::uint16_t at) {
    if (any_ || block_.has('N')) return {AlarmNumber::num_word, at};
    std::uint32_t number = 0;
    if (const Fault fault = read_sequence_number(scanner_, at, number)) return fault;
    store('N', number, at);
    return {};
  }

  Fault add_m(double value, std::uint16_t at) {
    if (block_.m_count == max_m_codes) return {AlarmNumber::too_many_codes, at};
    block_.m[block_.m_count++] = {value, at};
    return {};
  }

  void store(char name, double value, std::uint16_t at) {
    const auto index = static_cast<std::size_t>(name - 'A');
    block_.letters |= Block::bit(name);
    block_.values[index] = value;
    block_.offsets[index] = at;
  }

  Fault g_word(std::uint16_t at) {
    scanner_.skip_blanks();
    const Decimal decimal = scanner_.number();
    if (decimal.status == DecimalStatus::missing) return {AlarmNumber::number_missing, at};
    if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
    const bool plus = scanner_.peek(0) == '+';
    if (plus) scanner_.advance();
    const NumCode* const code = num_code(decimal.value, plus);
    if (code == nullptr) return {AlarmNumber::num_g_unknown, at};
    switch (code->use) {
      case NumUse::wait_mark:
        return {AlarmNumber::num_wait_mark, at};
      case NumUse::jump:
        return jump(at);
      case NumUse::call:
        any_ = true;
        if (calls_) return {AlarmNumber::group_twice, at};
        calls_ = true;
        call_at_ = at;
        return {};
      case NumUse::dwell:
        dwells_ = true;
        dwell_at_ = at;
        break;
      case NumUse::tap:
        taps_ = true;
        tap_at_ = at;
        break;
      case NumUse::removal:
        removes_ = true;
        removal_at_ = at;
        break;
      case NumUse::thread:
      case NumUse::resumed:
      case NumUse::one_pass:
        if (const Fault fault = thread(code->use, at)) return fault;
        break;
      case NumUse::home:
        homes_ = true;
        break;
      case NumUse::code:
        break;
    }
    any_ = true;
    if (block_.g_count == max_g_codes) return {AlarmNumber::too_many_codes, at};
    const double value = code->use == NumUse::removal ? tap_removal : code->code;
    block_.g[block_.g_count++] = {value, at};
    return {};
  }

  Fault thread(NumUse use, std::uint16_t at) {
    if (thread_ != NumUse::code) return {AlarmNumber::group_twice, at};
    thread_ = use;
    thread_at_ = at;
    if (use != NumUse::resumed) return {};
    for (const bool distance : {true, false}) {
      if (!skip_remarks(scanner_)) return {AlarmNumber::open_comment, scanner_.offset()};
      const std::uint16_t word_at = scanner_.offset();
      if (!scanner_.take_word(distance ? "J" : "EC"))
        return {AlarmNumber::missing_word, at, "needs J and EC behind it"};
      double value = 0;
      if (const Fault fault = number(word_at, value)) return fault;
      store(distance ? 'J' : taught_angle_word, value, word_at);
    }
    return {};
  }

  Fault jump(std::uint16_t at) {
    if (any_) return {AlarmNumber::statement_not_first, at};
    any_ = true;
    bool holds = true;
    if (scanner_.more() && letter(scanner_.peek()) != 'N') {
      if (const Fault fault = expressions_.condition(holds)) return fault;
    }
    if (!scanner_.more() || letter(scanner_.peek()) != 'N')
      return {AlarmNumber::missing_word, at, needs('N')};
    const std::uint16_t target = scanner_.offset();
    scanner_.advance();
    std::uint32_t label = 0;
    if (const Fault fault = read_sequence_number(scanner_, target, label)) return fault;
    if (const Fault fault = end_of_block()) return fault;
    if (!holds) return {};
    block_.statement = Statement::go_to;
    block_.label = label;
    block_.at = at;
    return {};
  }

  Fault complete() {
    block_.lead_word = 'K';
    if (const Fault fault = check_order()) return fault;
    if (const Fault fault = complete_thread()) return fault;
    if (const Fault fault = calls_ ? complete_call() : check_no_call()) return fault;
    if (const Fault fault = removes_ ? complete_removal() : taps_ ? check_tap() : check_no_tap())
      return fault;
    if (dwells_) {
      if (const Fault fault = complete_dwell()) return fault;
    }
    if (assigned_ && block_.statement == Statement::none && !block_.has_more())
      block_.statement = Statement::assignment;
    return {};
  }

  /// An order is carried out at rest, so it would end the thread that its block continues. In a block with a
  /// code of a thread, or with G39+, EC is no order.
  Fault check_order() const {
    if (!orders_) return {};
    if (orders_angle_ && removes_) return wrong_removal(removal_at_);
    if (orders_angle_ && thread_ != NumUse::code) return {AlarmNumber::num_word, angle_at_};
    if (block_.g_count != 0 || (block_.letters & axis_bits) == 0) return {};
    Value motion;
    const AlarmNumber alarm = variables_.read(active_motion, motion);
    const bool continues = alarm == AlarmNumber::none && motion.number == thread_motion;
    return continues ? Fault{AlarmNumber::num_word, order_at_} : Fault{};
  }

  Fault complete_thread() {
    if (thread_ == NumUse::code) return {};
    if (!block_.has('K')) return {AlarmNumber::missing_word, thread_at_, needs('K')};
    if (thread_ == NumUse::thread) return {};
    if ((block_.letters & axis_bits) == 0) return {AlarmNumber::missing_word, thread_at_, "needs an axis"};
    block_.thread = thread_ == NumUse::resumed ? ThreadBlock::first : ThreadBlock::alone;
    return thread_ == NumUse::resumed ? Fault{} : check_one_pass();
  }

  /// The words of G33.
  Fault check_one_pass() const {
    const std::uint32_t of_cycle = block_.letters & letter_bits("FRS");
    if (of_cycle != 0) return {AlarmNumber::num_function_missing, first_offset(of_cycle), thread_cycle};
    const std::uint32_t other_axes = block_.letters & axis_bits & ~letter_bits("XZ");
    if (other_axes != 0) return {AlarmNumber::num_word, first_offset(other_axes)};
    const bool angle = block_.has(taught_angle_word), x = block_.has(taught_x_word),
               z = block_.has(taught_z_word);
    if (x && z) return {AlarmNumber::num_thread_data, block_.offset(taught_z_word), "both EX and EZ"};
    if ((x || z) && !angle)
      return {AlarmNumber::num_thread_data, block_.offset(x ? taught_x_word : taught_z_word), "needs EC"};
    if (angle && !x && !z)
      return {AlarmNumber::num_thread_data, block_.offset(taught_angle_word), "needs EZ or EX"};
    return {};
  }

  /// Of the first of `letters` in the alphabet.
  std::uint16_t first_offset(std::uint32_t letters) const {
    return block_.offsets[static_cast<std::size_t>(std::countr_zero(letters))];
  }

  Fault check_no_call() const {
    return block_.has('H') ? Fault{AlarmNumber::num_word, block_.offset('H')} : Fault{};
  }

  /// G77 H is M98 with its program: it comes behind the words of its block.
  Fault complete_call() {
    if (!block_.has('H')) return {AlarmNumber::missing_word, call_at_, needs('H')};
    const std::uint16_t at = block_.offset('H');
    // On a NUM control S is how often; here it would be a speed.
    if (block_.has('S')) return {AlarmNumber::num_word, block_.offset('S')};
    if (const Fault fault = program_of(block_.value('H'), at, block_.called)) return fault;
    block_.letters &= ~Block::bit('H');
    block_.offsets['P' - 'A'] = at;  // where an alarm of the call points
    return add_m(98, call_at_);
  }

  Fault check_no_tap() const {
    for (const char word : {retract_ratio_word, work_plane_word, approach_word})
      if (block_.has(word)) return {AlarmNumber::num_word, block_.offset(word)};
    return {};
  }

  Fault check_tap() const {
    return block_.has('K') ? Fault{} : Fault{AlarmNumber::missing_word, tap_at_, needs('K')};
  }

  static Fault wrong_removal(std::uint16_t at) { return {AlarmNumber::num_removal_words, at, "NUM error 2"}; }

  /// The sense in which the spindle turns while the tap moves out is that of the hand of its thread: a
  /// right-hand one comes out counter-clockwise. The PLC gets neither M3 and M4 nor the range. M2 ends it.
  Fault complete_removal() {
    constexpr std::uint32_t axes = letter_bits("UVWXYZ"), others = letter_bits("KNS");
    const bool has_words =
        block_.has('S') && block_.has('K') && block_.value('K') > 0 && (block_.letters & axes) != 0;
    if (!has_words || (block_.letters & ~(axes | others)) != 0 || block_.g_count != 1 || calls_)
      return wrong_removal(removal_at_);
    int senses = 0, ranges = 0;
    bool clockwise = false;
    std::uint8_t kept = 0;
    for (std::size_t i = 0; i < block_.m_count; ++i) {
      const CodeWord m = block_.m[i];
      const auto within = [&](double first, double last) {
        return m.value == std::floor(m.value) && m.value >= first && m.value <= last;
      };
      if (within(3, 4)) {
        ++senses;
        clockwise = m.value == 3;
      } else if (within(40, 45)) {
        ++ranges;
      } else if (within(64, 66)) {
        block_.m[kept++] = m;
      } else {
        return wrong_removal(m.offset);
      }
    }
    if (senses == 0) return wrong_removal(removal_at_);
    if (senses > 1 || ranges > 1) return {AlarmNumber::num_removal_twice, removal_at_, "NUM error 1"};
    block_.m_count = kept;
    if (clockwise) block_.values['K' - 'A'] = -block_.value('K');
    return add_m(2, removal_at_);
  }

  /// The time of G4 is a word X of the codes here, in seconds.
  Fault complete_dwell() {
    if (!block_.has('F')) return {AlarmNumber::missing_word, dwell_at_, needs('F')};
    for (const char axis : {'X', 'U'}) {
      if (block_.has(axis)) return {AlarmNumber::num_word, block_.offset(axis)};
    }
    block_.letters &= ~Block::bit('F');
    store('X', block_.value('F'), block_.offset('F'));
    return {};
  }

  std::string_view line_;
  SkipLevels skip_;
  Scanner scanner_;
  Variables& variables_;
  NumExpressionReader expressions_;
  Block& block_;
  bool done_ = false;  // nothing more of the line is read
  bool any_ = false;   // more than N was read: no structure or jump may come
  bool assigned_ = false;
  bool orders_ = false, orders_angle_ = false;
  bool calls_ = false, dwells_ = false, homes_ = false, taps_ = false, removes_ = false;
  NumUse thread_ = NumUse::code;  // that of G33, G38 or G38+; code: the block has none of them
  std::uint16_t call_at_ = 0, dwell_at_ = 0, thread_at_ = 0, tap_at_ = 0, removal_at_ = 0;
  std::uint16_t order_at_ = 0, angle_at_ = 0;
};

}  // namespace

DialectRules NumDialect::rules() const { return {true, false, homing_program}; }

Fault NumDialect::read_block(std::string_view line, SkipLevels skip, Variables& variables,
                             Block& block) const {
  return NumReader(line, skip, variables, block).read();
}

Fault NumDialect::read_condition(std::string_view, std::uint16_t, const Variables&, bool& condition) const {
  condition = false;
  return {};
}

Outline NumDialect::outline(std::string_view line, SkipLevels skip) const {
  Outline outline;
  Scanner scanner(line);
  if (scanner.more() && scanner.peek() == '/') {
    if ((skip & 1u) != 0) return outline;
    scanner.advance();
  }
  if (scanner.more() && scanner.peek() == '%') {
    if (read_num_head(scanner, outline.program_number)) return outline;
    outline.head = Head::program;
  }
  if (!skip_remarks(scanner) || scanner.at_end()) return outline;
  if (letter(scanner.peek()) == 'N') {
    const std::uint16_t at = scanner.offset();
    scanner.advance();
    std::uint32_t number = 0;
    if (read_sequence_number(scanner, at, number)) return outline;
    outline.sequence_number = number;
    if (!skip_remarks(scanner) || scanner.at_end()) return outline;
  }
  if (outline.head == Head::none) outline.statement = take_structure(scanner);
  return outline;
}

}  // namespace trunnion::language
