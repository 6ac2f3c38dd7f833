// SPDX-License-Identifier: Apache-2.0
#include "compensation/text_tables.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "canonical/axes.hpp"

namespace trunnion::error_tables {
namespace {

using canonical::axis_letters;
constexpr double unit = 1e-3;               // um in mm, 0.001 deg in deg
constexpr double largest = 2147483647;      // the manual's values are 32 bits wide
constexpr std::size_t most_values = 10000;  // parameters 700000 .. 709999
constexpr const char* codes[] = {"X_Y", "X_Z", "Y_X", "Y_Z", "Z_X", "Z_Y", "X_X", "Y_Y", "Z_Z"};

struct Word {
  std::string_view text;
  std::size_t line = 0, column = 0;
};

std::vector<Word> words_of(std::string_view text) {
  std::vector<Word> words;
  std::size_t line = 1, start = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '\n') {
      ++line, start = ++i;
    } else if (c == '#' || c == ';') {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (c == ' ' || c == '\t' || c == '\r' || c == ',') {
      ++i;
    } else {
      const auto end = std::min(text.find_first_of(" \t\r\n,#;", i), text.size());
      words.push_back({text.substr(i, end - i), line, i - start + 1});
      i = end;
    }
  }
  words.push_back({"", line, text.size() - start + 1});
  return words;
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& file) : file_(file), words_(words_of(text)) {}

  TextTables parse() {
    while (!at_end()) {
      const Word word = next();
      if (word.text == "table" || word.text == "angle")
        table(word);
      else if (word.text == "squareness")
        squareness();
      else
        fail(word, "'" + std::string(word.text) + "': expected table, angle or squareness");
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const Word& at, const std::string& text) const {
    throw std::runtime_error(file_ + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": " +
                             text);
  }
  bool at_end() const { return at_ + 1 >= words_.size(); }
  const Word& peek() const { return words_[at_]; }
  Word next() {
    const Word word = words_[at_];
    if (!at_end()) ++at_;
    return word;
  }

  double number(const std::string& what, double low, double high) {
    const Word word = next();
    double value = 0;
    const auto* end = word.text.data() + word.text.size();
    const auto [stop, error] = std::from_chars(word.text.data(), end, value);
    if (word.text.empty() || error != std::errc() || stop != end || !std::isfinite(value))
      fail(word, "'" + std::string(word.text) + "': expected a number, " + what);
    if (value < low || value > high) {
      char limits[96];
      std::snprintf(limits, sizeof limits, " is not within %.0f .. %.0f, ", low, high);
      fail(word, std::string(word.text) + limits + what);
    }
    return value;
  }

  // X_Y, or the manual's code.
  std::pair<std::size_t, std::size_t> pair(int most_code) {
    const Word word = next();
    std::string name(word.text);
    if (name.size() == 1 && name[0] >= '1' && name[0] < '1' + most_code) name = codes[name[0] - '1'];
    const auto moving = name.size() == 3 ? axis_letters.find(name[0]) : std::string_view::npos;
    const auto compensated = name.size() == 3 ? axis_letters.find(name[2]) : std::string_view::npos;
    if (moving == std::string_view::npos || compensated == std::string_view::npos || name[1] != '_')
      fail(word, "'" + name + "': expected MOVING_COMPENSATED as X_Y, or a type code 1 .. " +
                     std::to_string(most_code));
    return {moving, compensated};
  }

  void squareness() {
    const Word at = peek();
    TextSquareness found;
    std::tie(found.moving, found.compensated) = pair(6);
    if (found.moving == found.compensated) fail(at, "an axis is square to another one");
    found.angle = number("the angle less 90 deg, 0.001 deg", -5000, 5000) * unit;
    result_.squareness.push_back(found);
  }

  void table(const Word& head) {
    TextTable table;
    std::tie(table.moving, table.compensated) = pair(9);
    if (head.text == "angle") {
      const Word arm = next();
      table.arm = arm.text.size() == 1 ? axis_letters.find(arm.text[0]) : std::string_view::npos;
      if (*table.arm == std::string_view::npos)
        fail(arm, "'" + std::string(arm.text) + "': expected the axis that is the lever arm");
    }
    bool has_values = false;
    while (!at_end() && peek().text != "table" && peek().text != "angle" && peek().text != "squareness") {
      const Word key = next();
      if (has_values) fail(key, "'" + std::string(key.text) + "': expected the next table after the values");
      if (key.text == "direction") {
        const Word at = peek();
        const double code = number("1 uni, 2 bi, 3 uni modulo, 4 bi modulo", 1, 4);
        if (code != std::floor(code)) fail(at, "the direction is 1, 2, 3 or 4");
        table.direction = static_cast<Direction>(static_cast<int>(code));
      } else if (key.text == "points") {
        const Word at = peek();
        const double points = number("the number of points", 1, static_cast<double>(most_values));
        if (points != std::floor(points)) fail(at, "the number of points is a whole number");
        table.points = static_cast<std::size_t>(points);
      } else if (key.text == "offset") {
        table.offset = number("the number of points below zero", -largest, largest);
      } else if (key.text == "spacing") {
        table.spacing = number("the distance of two points, um or 0.001 deg", 1, largest) * unit;
      } else if (key.text == "reference" && table.arm) {
        table.reference = number("the coordinate of the lever arm, um", -largest, largest) * unit;
      } else if (key.text == "values") {
        has_values = true;
        values(key, table);
      } else {
        fail(key, "'" + std::string(key.text) + "': expected direction, points, offset, spacing, " +
                      (table.arm ? "reference, " : "") + "values, or the next table");
      }
    }
    if (!has_values) fail(head, "table " + name_of(table) + " has no values");
    result_.tables.push_back(std::move(table));
  }

  void values(const Word& key, TextTable& table) {
    if (table.points == 0 || table.spacing == 0) fail(key, "points and spacing must precede the values");
    const std::size_t count = table.points * (both_ways(table.direction) ? 2 : 1);
    for (std::size_t i = 0; i < count; ++i) {
      const Word word = peek();
      const auto first = word.text.empty() ? 'e' : word.text[0];
      if ((first >= 'a' && first <= 'z') || at_end())
        fail(word, "table " + name_of(table) + " has " + std::to_string(i) + " of its " +
                       std::to_string(count) + " values" +
                       (both_ways(table.direction) ? " (both directions: twice the points)" : ""));
      table.values.push_back(number("a value, um or 0.001 deg", -100000, 100000) * unit);
    }
  }

  std::string file_;
  std::vector<Word> words_;
  std::size_t at_ = 0;
  TextTables result_;
};

std::string shown(double value) {
  char out[64];
  std::snprintf(out, sizeof out, "%.4f", value / unit);
  std::string text(out);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string pair_of(std::size_t moving, std::size_t compensated) {
  return std::string(1, axis_letters[moving]) + "_" + axis_letters[compensated];
}

}  // namespace

std::string name_of(const TextTable& table) {
  const auto name = pair_of(table.moving, table.compensated);
  return table.arm ? name + " " + axis_letters[*table.arm] : name;
}

TextTables parse_tables(const std::string& text, const std::string& file) {
  return Parser(text, file).parse();
}

std::string text_of(const TextTables& tables) {
  std::string text = "# um, 0.001 deg; positive values move the axis in positive direction\n";
  for (const auto& table : tables.tables) {
    text += (table.arm ? "angle " : "table ") + name_of(table) + "\ndirection " +
            std::to_string(static_cast<int>(table.direction)) + "\npoints " + std::to_string(table.points) +
            "\noffset " + shown(table.offset * unit) + "\nspacing " + shown(table.spacing);
    if (table.arm) text += "\nreference " + shown(table.reference);
    text += "\nvalues";
    for (std::size_t i = 0; i < table.values.size(); ++i)
      text += (i % table.points % 20 == 0 ? "\n" : " ") + shown(table.values[i]);
    text += "\n";
  }
  for (const auto& one : tables.squareness)
    text += "squareness " + pair_of(one.moving, one.compensated) + " " + shown(one.angle) + "\n";
  return text;
}

}  // namespace trunnion::error_tables
