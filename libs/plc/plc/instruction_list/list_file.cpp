// SPDX-License-Identifier: Apache-2.0
#include "plc/instruction_list/list_file.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "plc/instruction_list/list.hpp"
#include "plc/library/register_names.hpp"
#include "plc/syntax/parser.hpp"

namespace trunnion::st {
namespace {

struct WordLimits {
  const char *low, *high;
};
/// Where a word saturates that is stored in a variable of the type.
const std::map<std::string_view, WordLimits> word_limits = {{"SINT", {"-128", "127"}},
                                                            {"USINT", {"0", "255"}},
                                                            {"INT", {"-32768", "32767"}},
                                                            {"UINT", {"0", "65535"}},
                                                            {"DINT", {"-2147483648", "2147483647"}},
                                                            {"UDINT", {"0", "4294967295"}}};

struct NumberedBlock {
  const char *type, *prefix, *input;
  const char* preset;  ///< what the operand behind the number is for; none: there is none
};
/// Instructions that are function blocks, each with a number: TON 3, 500 calls ton_3.
const std::map<std::string_view, NumberedBlock> numbered_blocks = {
    {"TON", {"TON", "ton_", "IN", "PT := TO_TIME"}},
    {"TOF", {"TOF", "tof_", "IN", "PT := TO_TIME"}},
    {"CTU", {"CTU_DINT", "ctu_", "CU", "R := FALSE, PV := "}},
    {"R_TRIG", {"R_TRIG", "r_trig_", "CLK", nullptr}},
    {"F_TRIG", {"FALLING_EDGE", "f_trig_", "CLK", nullptr}}};

bool is_list_symbol(const Token& word, std::string_view text) {
  return word.kind == TokenKind::symbol && word.text == text;
}

bool is_list_word(const Token& word, std::string_view upper) {
  return word.kind == TokenKind::identifier && word.upper == upper;
}

const char* type_of_register(const RegisterAddress& at) {
  const int bits = info(at.area).bits;
  return at.is_bit() ? "BOOL" : bits == 8 ? "USINT" : bits == 16 ? "UINT" : "DINT";
}

/// Only of the areas that lists have had from the beginning: T1 or D2 may be a name.
bool is_bare_register(const Token& word) {
  return word.kind == TokenKind::identifier && word.upper.size() > 1 &&
         std::string_view("XYFGRB").find(word.upper[0]) != std::string_view::npos &&
         word.upper.find_first_not_of("0123456789", 1) == std::string::npos;
}

/// Registers without percent sign, X0.3 and B2, become %X0.3 and %B2. A member (memory.R1) and an input that
/// is named in a call (R1 := x) are none.
Tokens with_registers(const Tokens& words) {
  Tokens result;
  for (std::size_t i = 0; i < words.size(); ++i) {
    auto word = words[i];
    const bool is_member = i > 0 && is_list_symbol(words[i - 1], ".");
    const bool is_input = i + 1 < words.size() && is_list_symbol(words[i + 1], ":=");
    if (is_bare_register(word) && !is_member && !is_input) {
      const bool is_bit = i + 2 < words.size() && is_list_symbol(words[i + 1], ".") &&
                          words[i + 2].kind == TokenKind::integer;
      word.kind = TokenKind::direct;
      word.text = word.upper + (is_bit ? "." + words[i + 2].text : "");
      word.upper.clear();
      if (is_bit) i += 2;
    }
    result.push_back(std::move(word));
  }
  return result;
}

/// What is between VAR and END_VAR, one variable to a line, and the instructions around it.
class ListParts {
 public:
  ListParts(const Tokens& words, Diagnostics& diagnostics) : diagnostics_(diagnostics) {
    for (std::size_t i = 0; i < words.size(); ++i)
      take(words[i], i == 0 || words[i].at.line != words[i - 1].at.line);
    if (section_) diagnostics_.error(*section_, "VAR without END_VAR");
  }

  Tokens declarations, body;
  std::map<std::string, std::string> types;  ///< of the variables; both in capitals

 private:
  void take(const Token& word, bool begins_line) {
    const bool separates = is_list_symbol(word, ";");
    if (!section_) {
      if (begins_line && is_list_word(word, "VAR"))
        section_ = word.at, declarations.push_back(word);
      else if (!separates)
        body.push_back(word);
      return;
    }
    const bool ends = is_list_word(word, "END_VAR");
    if (begins_line || separates || ends) declare();
    const bool qualifies =
        is_list_word(word, "RETAIN") || is_list_word(word, "NON_RETAIN") || is_list_word(word, "CONSTANT");
    if (ends || (qualifies && variable_.empty()))
      declarations.push_back(word);
    else if (!separates)
      variable_.push_back(word);
    if (ends) section_.reset();
  }

  void declare() {
    if (variable_.empty()) return;
    const auto name = variable_.front();
    const auto last = variable_.back().at;
    auto words = with_registers(std::exchange(variable_, {}));
    if (is_bare_register(name))
      diagnostics_.error(name.at, "'" + name.text + "' is a register and cannot be the name of a variable");
    const auto colon =
        std::find_if(words.begin(), words.end(), [](const Token& word) { return is_list_symbol(word, ":"); });
    if (words.end() - colon > 1) {
      auto& type = colon[1];
      // A register of any width is INT in lists.
      const auto located = std::find_if(words.begin(), colon,
                                        [](const Token& word) { return word.kind == TokenKind::direct; });
      if (located != colon && type.upper == "INT")
        if (const auto at = parse_register(located->text, nullptr); at && !at->is_bit())
          type.text = type.upper = type_of_register(*at);
      for (auto word = words.begin(); word != colon; ++word)
        if (word->kind == TokenKind::identifier) types[word->upper] = type.upper;
    }
    append(declarations, std::move(words));
    declarations.push_back({TokenKind::symbol, ";", ";", 10, last});
  }

  Diagnostics& diagnostics_;
  std::optional<Position> section_;  ///< of its VAR
  Tokens variable_;
};

/// Words are computed with 32 bits and saturate; what is computed is kept in a variable for each depth of
/// parentheses, one for bits and one for words.
class FileList : public InstructionList {
 public:
  FileList(ListParts parts, std::uint16_t file, Diagnostics& diagnostics)
      : InstructionList(std::move(parts.body), file, diagnostics), types_(std::move(parts.types)) {}

  /// Behind run(): the variables that the statements use besides those of the list.
  Tokens hidden_variables(Position at) {
    for (const auto& [name, place] : resets_)
      if (!blocks_.contains(name)) fail(place, "the list has no CTU with this number");
    Tokens result;
    for (const auto& name : results_) {
      append(result, words("VAR_TEMP", at));
      result.push_back({TokenKind::identifier, name, name, 10, at});
      append(result, words(name.starts_with("@BIT") ? ": BOOL; END_VAR" : ": LINT; END_VAR", at));
    }
    for (const auto& [name, block] : blocks_)
      append(result, words("VAR " + name + " : " + block.type + "; END_VAR", block.at));
    return result;
  }

 protected:
  void instruction(Tokens line) override {
    const auto first = line[0];
    const auto op = first.kind == TokenKind::identifier ? first.upper : first.text;
    Tokens operands(line.begin() + 1, line.end());
    if (!op.starts_with("JMP")) operands = with_registers(operands);
    if (op == "MOVE") return move_word(operands, first.at);
    if (op == "CTR") return reset_counter(operands, first.at);
    if (const auto block = numbered_blocks.find(op); block != numbered_blocks.end())
      return call_numbered(first, block->second, operands);
    const bool loads = op == "LD" || op == "LDN";
    if (loads) {
      is_word_ = is_word(operands);
    } else if (is_call(op, first, operands)) {
      if (!current_.empty()) keep(first.at);
      is_word_ = true;
    }
    line.resize(1);
    append(line, std::move(operands));
    InstructionList::instruction(std::move(line));
    // A value that no instruction uses is checked too.
    if (loads && !current_.empty()) keep(first.at);
  }

  void open(const std::string& op, bool inverts, Tokens line, Position at) override {
    keep(at);
    outer_words_.push_back(is_word_);
    Tokens operand(line.begin() + 1, line.end());
    if (!operand.empty() && is_list_symbol(operand.back(), ")")) operand.pop_back();
    is_word_ = is_word(operand);
    InstructionList::open(op, inverts, std::move(line), at);
  }

  void close(Position at) override {
    if (!outer_words_.empty()) {
      is_word_ = outer_words_.back();
      outer_words_.pop_back();
    }
    InstructionList::close(at);
  }

  void apply(const std::string& op, bool inverts, Tokens operand, Position at) override {
    const bool of_bits = op == "AND" || op == "&" || op == "OR" || op == "XOR";
    const bool computes = op == "ADD" || op == "SUB" || op == "MUL" || op == "DIV" || op == "MOD";
    if (!has(!of_bits, at)) return;
    keep(at);
    if (!computes) {
      is_word_ = false;
      return InstructionList::apply(op, inverts, std::move(operand), at);
    }
    auto result = words("LIMIT(-2147483648,", at);
    append(result, op == "DIV" ? quotient(operand, at) : combined(op, operand, at));
    append(result, words(", 2147483647)", at));
    current_ = std::move(result);
    keep(at);
  }

  void store(const std::string& op, const Tokens& target, Position at) override {
    const auto limits = word_limits.find(type_of(target));
    if (op != "ST" || !is_word_ || limits == word_limits.end()) return InstructionList::store(op, target, at);
    if (!expression(target, at)) return;
    keep(at);
    write(target);
    write(":=", at);
    write(saturated(limits->first, current_, at));
    write(";", at);
  }

  Token new_value(Position at) override {
    const auto name = (is_word_ ? "@WORD_" : "@BIT_") + std::to_string(depth());
    results_.insert(name);
    return {TokenKind::identifier, name, name, 10, at};
  }

 private:
  struct Own {
    std::string type;
    Position at;
  };

  /// In capitals; of a number LINT; empty when it is not known.
  std::string type_of(const Tokens& operand) const {
    if (operand.empty()) return "";
    const auto& word = operand[0];
    if (operand.size() > 1) return is_list_symbol(word, "-") ? "LINT" : "";
    if (word.kind == TokenKind::integer) return "LINT";
    if (word.kind == TokenKind::direct) {
      const auto at = parse_register(word.text, nullptr);
      return at ? type_of_register(*at) : "";
    }
    if (const auto own = types_.find(word.upper); own != types_.end()) return own->second;
    const auto named = interface_registers().find(word.upper);
    return named == interface_registers().end() ? "" : type_of_register(named->second);
  }
  bool is_word(const Tokens& operand) const {
    const auto type = type_of(operand);
    return type == "LINT" || word_limits.contains(type);
  }

  bool has(bool word, Position at) {
    if (!has_result(at)) return false;
    if (is_word_ != word)
      fail(at, word ? "the current result is a bit, a word is needed"
                    : "the current result is a word, a bit is needed");
    return is_word_ == word;
  }

  Tokens combined(const std::string& op, const Tokens& operand, Position at) {
    auto result = current_;
    append(result, words(sign_of(op), at));
    append(result, words("(", at));
    append(result, operand);
    append(result, words(")", at));
    return result;
  }

  /// A division by zero gives zero.
  Tokens quotient(const Tokens& operand, Position at) {
    auto result = words("SEL((", at);
    append(result, operand);
    append(result, words(") = 0,", at));
    append(result, current_);
    append(result, words(", 0) / SEL((", at));
    append(result, operand);
    append(result, words(") = 0, TO_LINT(", at));
    append(result, operand);
    append(result, words("), 1)", at));
    return result;
  }

  Tokens saturated(std::string_view type, const Tokens& value, Position at) {
    const auto& limits = word_limits.at(type);
    auto result = words("TO_" + std::string(type) + "(LIMIT(" + limits.low + ",", at);
    append(result, value);
    append(result, words(std::string(",") + limits.high + "))", at));
    return result;
  }

  void move_word(const Tokens& operands, Position at) {
    if (!has(false, at)) return;
    const auto comma = std::find_if(operands.begin(), operands.end(),
                                    [](const Token& word) { return is_list_symbol(word, ","); });
    const Tokens source(operands.begin(), comma);
    const Tokens target(comma == operands.end() ? comma : comma + 1, operands.end());
    if (source.empty() || target.empty())
      return fail(at, "MOVE takes a word and a register, as MOVE 5, %W10");
    if (!expression(source, at) || !expression(target, at)) return;
    const auto limits = word_limits.find(type_of(target));
    if (!is_word(source)) return fail(source[0].at, "the operand must be a word");
    if (limits == word_limits.end())
      return fail(target[0].at, "the operand must be a register or variable of a word");
    keep(at);
    write("IF", at);
    write(current_);
    write("THEN", at);
    write(target);
    write(":=", at);
    auto value = words("TO_LINT(", at);
    append(value, source);
    append(value, words(")", at));
    write(saturated(limits->first, value, at));
    write("; END_IF;", at);
  }

  void call_numbered(const Token& op, const NumberedBlock& block, const Tokens& operands) {
    const auto at = op.at;
    if (!has(false, at)) return;
    const bool presets = block.preset != nullptr;
    const bool good =
        !operands.empty() && operands[0].kind == TokenKind::integer &&
        (presets ? operands.size() > 2 && is_list_symbol(operands[1], ",") : operands.size() == 1);
    if (!good)
      return fail(at, op.upper + (presets ? " takes a number and a value, as " + op.upper + " 3, 500"
                                          : " takes a number, as " + op.upper + " 3"));
    const Tokens preset(operands.begin() + (presets ? 2 : 1), operands.end());
    if (presets && !expression(preset, at)) return;
    const auto& number = operands[0];
    const auto name = block.prefix + number.text;
    const auto [own, fresh] = blocks_.emplace(name, Own{block.type, number.at});
    if (!fresh)
      return fail(number.at, op.upper + " " + number.text + " is there already in line " +
                                 std::to_string(own->second.at.line));
    keep(at);
    write(name + "(" + block.input + " :=", at);
    write(current_);
    if (presets) {
      write(std::string(", ") + block.preset + "(", at);
      write(preset);
      write(")", at);
    }
    write(");", at);
    current_ = words(name + ".Q", at);
  }

  /// CTU passes R := FALSE, so the reset holds for this call only.
  void reset_counter(const Tokens& operands, Position at) {
    if (!has(false, at)) return;
    if (operands.size() != 1 || operands[0].kind != TokenKind::integer)
      return fail(at, "CTR takes the number of a CTU, as CTR 3");
    const auto name = "ctu_" + operands[0].text;
    resets_.emplace_back(name, at);
    keep(at);
    write(name + "(R :=", at);
    write(current_);
    write(");", at);
  }

  std::map<std::string, std::string> types_;
  bool is_word_ = false;  ///< the current result
  std::vector<bool> outer_words_;
  std::set<std::string> results_;
  std::map<std::string, Own> blocks_;
  std::vector<std::pair<std::string, Position>> resets_;
};

}  // namespace

bool is_instruction_list(std::string_view name) { return name.ends_with(".il"); }

void import_list(const std::string& name, std::string_view text, std::uint16_t file, SourceTree& tree,
                 Diagnostics& diagnostics) {
  const auto before = diagnostics.errors();
  auto words = tokenize(text, file, diagnostics);
  const auto end = words.back();
  words.pop_back();
  Diagnostics ignored;
  const auto program = std::filesystem::path(name).stem().string();
  auto all = tokenize("PROGRAM " + program, file, ignored);
  all.pop_back();
  for (auto& word : all) word.at = {file, 1, 1};
  if (ignored.errors() > 0 || all.size() != 2 || all[1].text != program)
    diagnostics.error({file, 1, 1}, "'" + program +
                                        "' is no name of a program, which the list has from its file: "
                                        "letters, digits and _, a letter first");
  ListParts parts(words, diagnostics);
  append(all, std::move(parts.declarations));
  FileList list(std::move(parts), file, diagnostics);
  auto statements = list.run();
  append(all, list.hidden_variables({file, 1, 1}));
  append(all, std::move(statements));
  // What is missing would only be reported once more.
  if (diagnostics.errors() > before) return;
  all.push_back({TokenKind::identifier, "END_PROGRAM", "END_PROGRAM", 10, end.at});
  all.push_back(end);
  parse(std::move(all), tree, diagnostics);
}

}  // namespace trunnion::st
