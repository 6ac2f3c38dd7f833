// SPDX-License-Identifier: Apache-2.0
#include "language/iso_dialect.hpp"

#include <cmath>
#include <cstddef>

#include "language/expression.hpp"
#include "language/iso_cycle.hpp"
#include "language/iso_line.hpp"
#include "language/letters.hpp"
#include "language/scanner.hpp"
#include "language/spaced_number.hpp"
#include "text/utf8.hpp"

namespace trunnion::language {
namespace {

class BlockReader {
 public:
  BlockReader(std::string_view line, SkipLevels skip, Variables& variables, Block& block)
      : line_(line), skip_(skip), scanner_(line), variables_(variables), block_(block) {}

  Fault read() {
    const Fault fault = read_items();
    return fault ? explained(fault) : fault;
  }

 private:
  Fault read_items() {
    block_.clear();
    if (!scanner_.more() || scanner_.peek() == '*') return {};
    if (scanner_.peek() == '/') {
      if (take_skip()) {
        block_.skipped = true;
        return {};
      }
    }
    if (!scanner_.at_end() && starts_head(scanner_.peek())) {
      if (const Fault fault = read_head(scanner_, block_.head, block_.program_number)) return fault;
    }
    while (scanner_.more()) {
      bool done = false;
      if (const Fault fault = item(done)) return fault;
      if (done) return {};
    }
    return {};
  }

  /// What is wrong behind a comment in a comment is that the first ) has ended both.
  Fault explained(const Fault& fault) const {
    if (fault.number == value_pending || calls_cycle_) return fault;
    const std::size_t inner = find_nested_comment(line_);
    if (inner == std::string_view::npos || inner > fault.offset) return fault;
    return {AlarmNumber::comment_in_comment, static_cast<std::uint16_t>(inner)};
  }

  /// Nothing but N and a block skip was read: here a statement may begin.
  bool at_start() const { return block_.head == Head::none && !word_is_read_; }

  Fault item(bool& done) {
    const char c = scanner_.peek();
    const char upper = letter(c);
    const std::uint16_t at = scanner_.offset();
    if (upper != '\0') {
      if (letter(scanner_.peek(1)) == '\0') return word(upper);
      return instruction(done);
    }
    if (c == '(') return scanner_.skip_comment() ? Fault{} : Fault{AlarmNumber::open_comment, at};
    if (c == ';') {
      done = true;
      return {};
    }
    if (c == '#') {
      if (!at_start()) return {AlarmNumber::statement_not_first, at};
      done = true;
      return assignments();
    }
    if (c == ',') return comma_word(at);
    if (c == '/') return skip(at, done);
    return rare_item(c, at);
  }

  Fault rare_item(char c, std::uint16_t at) {
    if (is_transmission(c)) {
      scanner_.advance();
      return {};
    }
    if (c == '$') return {AlarmNumber::unknown_character, at, "variables of SINUMERIK are not known"};
    if (c == '.' || is_digit(c)) return continue_number(at);
    if (begins_head(c)) {
      if (may_be_head()) return read_head(scanner_, block_.head, block_.program_number);
      if (c == '<' && block_.m_count != 0) return {AlarmNumber::call_by_name, at};
      if (c != '<') return {AlarmNumber::misplaced_head, at};
    }
    const bool broken = text::valid_utf8_prefix(line_.substr(at, 4)) == 0;
    return {broken ? AlarmNumber::not_utf8 : AlarmNumber::unknown_character, at};
  }

  /// Nothing but comments and a block skip was read.
  bool may_be_head() const { return at_start() && !block_.has('N'); }

  /// O behind comments, or a misplaced one.
  Fault late_head(std::uint16_t at) {
    if (!may_be_head()) return {AlarmNumber::misplaced_head, at};
    scanner_ = Scanner(line_, at);
    return read_head(scanner_, block_.head, block_.program_number);
  }

  /// Whether a level of the / here is on.
  bool take_skip() {
    const BlockSkip found = read_skip(scanner_, skip_);
    skip_is_read_ = true;
    lone_skip_ = !found.numbered;
    return found.active;
  }

  /// In the middle of a block / leaves out the rest of it. A / without a level has no other one in its block.
  Fault skip(std::uint16_t at, bool& done) {
    const bool start = at_start();
    const bool numbered = is_skip_level(scanner_.peek(1));
    if ((skip_is_read_ && (lone_skip_ || !numbered)) || follows_variable(at))
      return {AlarmNumber::misplaced_head, at, no_comment(line_, at)};
    done = take_skip();
    block_.skipped = done && start;
    if (!start && nothing_follows(scanner_)) return {AlarmNumber::misplaced_head, at};
    return {};
  }

  /// X#1/2 and X[#1]/2 mean a half.
  bool follows_variable(std::size_t at) const {
    while (at > 0 && (is_digit(line_[at - 1]) || line_[at - 1] == '.')) --at;
    return at > 0 && (line_[at - 1] == '#' || line_[at - 1] == ']');
  }

  /// The number behind a letter, literal or computed; N is literal, because jumps look for it in the text.
  Fault number(std::uint16_t at, bool may_be_computed, Value& value) {
    scanner_.skip_blanks();
    const char first = scanner_.peek(0);
    std::size_t ahead = first == '-' || first == '+' ? 1 : 0;
    while (ahead != 0 && is_blank(scanner_.peek(ahead))) ++ahead;
    const char c = scanner_.peek(ahead);
    if (!may_be_computed || (c != '#' && c != '[')) {
      Decimal decimal = scanner_.number();
      if (decimal.status == DecimalStatus::missing && may_be_computed) decimal = read_spaced_number(scanner_);
      if (decimal.status == DecimalStatus::missing) return {AlarmNumber::number_missing, at};
      if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
      value = Value::of(decimal.value);
      point_ = decimal.point;
      return {};
    }
    point_ = false;
    if (const Fault fault = ExpressionReader(scanner_, variables_).operand(value)) return fault;
    value.number = nearly_whole(value.number);
    if (std::abs(value.number) > largest_number) return {AlarmNumber::number_range, at};
    return {};
  }

  /// Behind G28.2 and G159 a letter without a number names an axis, as on NUM controls.
  bool names_axis(char name) {
    if (!homes_ || (Block::bit(name) & axis_bits) == 0) return false;
    if (!scanner_.more()) return true;
    const char next = scanner_.peek();
    return letter(next) != '\0' || next == ';' || next == '(';
  }

  Fault word(char name) {
    const std::uint16_t at = scanner_.offset();
    scanner_.advance();
    Value value;
    if (names_axis(name)) {
      value = Value::of(0);
      point_ = false;
    } else if (const Fault fault = number(at, name != 'N', value)) {
      return name == 'O' ? late_head(at) : fault;
    }
    if (name == 'O') return late_head(at);
    // A word counts even when it is left out because its variable is vacant.
    word_is_read_ = word_is_read_ || name != 'N';
    if (!value.given) return {};
    if (name == 'G') {
      if (block_.g_count == max_g_codes) return {AlarmNumber::too_many_codes, at};
      block_.g[block_.g_count++] = {value.number, at};
      note_code(value.number);
      return {};
    }
    if (name == 'M') {
      if (block_.m_count == max_m_codes) return {AlarmNumber::too_many_codes, at};
      block_.m[block_.m_count++] = {value.number, at};
      return {};
    }
    const bool centre = calls_macro_ && name >= 'I' && name <= 'K';
    if (centre) {
      if (block_.centre_count == max_call_centres) return {AlarmNumber::too_many_centres, at};
      block_.centres[block_.centre_count++] = {name, at, value.number};
    } else if (block_.has(name)) {
      if (name != 'T' || block_.two_tools) return {AlarmNumber::letter_twice, at};
      block_.two_tools = true;
      name = second_tool_word;
    }
    const auto index = static_cast<std::size_t>(name - 'A');
    block_.letters |= Block::bit(name);
    if (point_) block_.pointed |= Block::bit(name);
    block_.values[index] = value.number;
    block_.offsets[index] = at;
    return {};
  }

  void note_code(double code) {
    calls_macro_ = calls_macro_ || code == 65 || code == 66;
    homes_ = homes_ || code == 28.2 || code == 159;
  }

  /// The . or the digits at `at` belong to the number of the word before: X1 . 5. Two groups of digits
  /// without a point between them are refused: where a letter is forgotten, X5 5 would be X55.
  Fault continue_number(std::uint16_t at) {
    const Fault unknown{AlarmNumber::unknown_character, at, missing_letter(line_, at)};
    std::size_t first = at;
    while (first > 0 && (is_blank(line_[first - 1]) || belongs_to_number(line_[first - 1]))) --first;
    if (first == 0) return unknown;
    const std::size_t place = first - 1;
    const char name = letter(line_[place]);
    if (name == '\0' || name == 'N') return unknown;
    Scanner whole(line_, first);
    const Decimal decimal = read_spaced_number(whole);
    double* const value =
        decimal.status == DecimalStatus::ok && whole.offset() > at ? newest_value(name, place) : nullptr;
    if (value == nullptr) return unknown;
    scanner_ = whole;
    *value = decimal.value;
    if (name == 'G') note_code(decimal.value);
    return {};
  }

  static bool belongs_to_number(char c) { return is_digit(c) || c == '.' || c == '-' || c == '+'; }

  /// That of the word at `place`, if it was the last one.
  double* newest_value(char name, std::size_t place) {
    if (name == 'G' && block_.g_count != 0 && block_.g[block_.g_count - 1u].offset == place)
      return &block_.g[block_.g_count - 1u].value;
    if (name == 'M' && block_.m_count != 0 && block_.m[block_.m_count - 1u].offset == place)
      return &block_.m[block_.m_count - 1u].value;
    if (block_.centre_count != 0 && block_.centres[block_.centre_count - 1u].offset == place)
      return &block_.centres[block_.centre_count - 1u].value;
    if (name == 'T' && block_.two_tools) name = second_tool_word;
    const auto index = static_cast<std::size_t>(name - 'A');
    if (!block_.has(name) || block_.offsets[index] != place) return nullptr;
    block_.pointed |= Block::bit(name);
    return &block_.values[index];
  }

  /// ,C, ,R or ,A.
  Fault comma_word(std::uint16_t at) {
    scanner_.advance();
    const char name = scanner_.more() ? letter(scanner_.peek()) : '\0';
    if (name != 'C' && name != 'R' && name != 'A') return {AlarmNumber::unknown_character, at};
    scanner_.advance();
    Value value;
    if (const Fault fault = number(at, true, value)) return fault;
    word_is_read_ = true;
    if (!value.given) return {};
    const char word = name == 'C' ? chamfer_word : name == 'R' ? rounding_word : angle_word;
    if (block_.has(word)) return {AlarmNumber::letter_twice, at};
    const auto index = static_cast<std::size_t>(word - 'A');
    block_.letters |= Block::bit(word);
    block_.values[index] = value.number;
    block_.offsets[index] = at;
    return {};
  }

  Fault assignments() {
    while (scanner_.more() && scanner_.peek() == '#') {
      const std::uint16_t at = scanner_.offset();
      block_.at = at;
      scanner_.advance();
      ExpressionReader reader(scanner_, variables_);
      double number = 0;
      Value value;
      if (const Fault fault = reader.variable_number(number)) return fault;
      if (!scanner_.take('=')) return {AlarmNumber::operand_missing, scanner_.offset()};
      if (const Fault fault = reader.expression(value)) return fault;
      if (const AlarmNumber alarm = variables_.write(number, value); alarm != AlarmNumber::none)
        return {alarm, at};
      // What a system variable asks for is carried out before anything else.
      if (is_system_variable(number)) break;
    }
    return state(Statement::assignment);
  }

  Fault end_of_statement() { return end_of_line(scanner_); }

  Fault read_condition(bool& result) {
    Value value;
    if (const Fault fault = ExpressionReader(scanner_, variables_).expression(value)) return fault;
    result = value.number != 0;
    return {};
  }

  Fault label(std::uint32_t& result) {
    scanner_.skip_blanks();
    const std::uint16_t at = scanner_.offset();
    Value value;
    if (const Fault fault = ExpressionReader(scanner_, variables_).operand(value)) return fault;
    const double whole = nearly_whole(value.number);
    if (!value.given || whole != std::floor(whole)) return {AlarmNumber::not_an_integer, at};
    if (whole < 0 || whole > highest_label) return {AlarmNumber::value_range, at};
    result = static_cast<std::uint32_t>(whole);
    return {};
  }

  Fault state(Statement statement) {
    block_.statement = statement;
    return end_of_statement();
  }

  Fault instruction(bool& done) {
    const std::uint16_t at = scanner_.offset();
    block_.at = at;
    const bool first = at_start();
    done = true;
    Fault fault;
    if (scanner_.take_word("IF")) {
      fault = branch(done);
    } else if (scanner_.take_word("GOTO")) {
      fault = go_to();
    } else if (scanner_.take_word("WHILE")) {
      fault = loop();
    } else if (scanner_.take_word("DO")) {
      block_.condition = true;
      fault = labelled(Statement::begin_do);
    } else if (scanner_.take_word("ENDW")) {
      fault = state(Statement::end_while);
    } else if (scanner_.take_word("ENDIF")) {
      fault = state(Statement::end_if);
    } else if (scanner_.take_word("END")) {
      fault = labelled(Statement::end_do);
    } else if (scanner_.take_word("ELSEIF")) {
      block_.statement = Statement::else_if;
      block_.rest = scanner_.offset();
    } else if (scanner_.take_word("ELSE")) {
      fault = state(Statement::else_);
    } else if (scanner_.looking_at("CYCLE")) {
      calls_cycle_ = true;
      fault = read_cycle(scanner_, line_, variables_, block_);
    } else if (take_abbreviated(scanner_, "WHILE")) {
      fault = loop();
    } else if (take_abbreviated(scanner_, "END")) {
      fault = labelled(Statement::end_do);
    } else if (scanner_.take_word("DPRNT")) {
      fault = read_print(scanner_, variables_, block_.printed);
      if (!fault) fault = state(Statement::print);
    } else if (scanner_.take_word("POPEN") || scanner_.take_word("PCLOS")) {
      fault = end_of_statement();  // a file is not a line that somebody has to open
    } else if (scanner_.looking_at("BPRNT")) {
      return {AlarmNumber::binary_print, at};
    } else if (scanner_.looking_at("SETVN")) {
      return {AlarmNumber::variable_names, at};
    } else {
      return {AlarmNumber::unknown_instruction, at};
    }
    if (!first || (behind_then_ && is_structure(block_.statement))) {
      return {AlarmNumber::statement_not_first, at};
    }
    return fault;
  }

  Fault go_to() {
    if (const Fault fault = label(block_.label)) return fault;
    return state(Statement::go_to);
  }

  /// DO and END take their number as it is written, because searches look for it in the text.
  Fault labelled(Statement statement) {
    if (!scanner_.more() || !is_digit(scanner_.peek())) return {AlarmNumber::number_missing, block_.at};
    if (const Fault fault = label(block_.label)) return fault;
    return state(statement);
  }

  /// IF condition, alone or before GOTO or THEN, whose rest counts only when the condition holds.
  Fault branch(bool& done) {
    if (const Fault fault = read_condition(block_.condition)) return fault;
    if (scanner_.more() && scanner_.looking_at("GOTO")) {
      if (!block_.condition) return {};
      scanner_.take_word("GOTO");
      return go_to();
    }
    if (scanner_.more() && take_abbreviated(scanner_, "THEN")) {
      const Scanner behind = scanner_;
      if (end_of_statement().number == AlarmNumber::text_behind_statement) {
        scanner_ = behind;
        behind_then_ = true;
        done = !block_.condition;
        return {};
      }
      scanner_ = behind;
    }
    return state(Statement::begin_if);
  }

  Fault loop() {
    if (const Fault fault = read_condition(block_.condition)) return fault;
    if (scanner_.more() && scanner_.take_word("DO") && scanner_.more() && is_digit(scanner_.peek())) {
      return labelled(Statement::begin_do);
    }
    return state(Statement::begin_while);
  }

  std::string_view line_;
  SkipLevels skip_;
  Scanner scanner_;
  Variables& variables_;
  Block& block_;
  bool calls_macro_ = false;
  bool homes_ = false;  // G28.2 or G159 was read
  bool calls_cycle_ = false;
  bool skip_is_read_ = false;
  bool lone_skip_ = false;  // it had no level
  bool word_is_read_ = false;
  bool point_ = false;  // the newest number() has a decimal point
  /// Behind IF ... THEN on one line: nothing that opens or closes a structure may be here.
  bool behind_then_ = false;
};

}  // namespace

Fault IsoDialect::read_block(std::string_view line, SkipLevels skip, Variables& variables,
                             Block& block) const {
  return BlockReader(line, skip, variables, block).read();
}

Fault IsoDialect::read_condition(std::string_view line, std::uint16_t rest, const Variables& variables,
                                 bool& condition) const {
  Scanner scanner(line, rest);
  Value value;
  if (const Fault fault = ExpressionReader(scanner, variables).expression(value)) return fault;
  condition = value.number != 0;
  if (scanner.more()) take_abbreviated(scanner, "THEN");
  if (!nothing_follows(scanner)) return {AlarmNumber::text_behind_statement, scanner.offset()};
  return {};
}

}  // namespace trunnion::language
